"""Steps of the history that take more than one operation, and the materials that the program brings."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QImage, QImageWriter, QPainter

from ...model.document.document import Document
from ...model.document.tree import unique_name
from ...model.editing.echo import call
from ...model.editing.session import Session
from ...model.operations.operations import OPERATIONS
from ...model.surface.light import PROGRAM, Light
from ...model.surface.material import Material

CHECKER = "Checker"
SQUARES, SQUARE = 8, 64  # of the checker board along a side, and pixels along one
PALE, DEEP = "#f2efe6", "#3f6ea8"

Step = tuple[str, tuple[Any, ...], dict[str, Any]]
"""An operation's name, its arguments, and those by name."""


def do_steps(session: Session, label: str, steps: list[Step]) -> None:
    """Do operations one after the other as one step of the history. Raises Refusal and then changes nothing."""
    session.cancel()
    document, lines = session.document, []
    for name, arguments, keywords in steps:
        document = OPERATIONS[name](document, *arguments, **keywords)
        lines.append(call(name, *arguments, **keywords))
    session.commit(label, document, line="\n".join(lines))


def free_name(document: Document, wanted: str) -> str:
    return unique_name(wanted, [material.name for material in document.materials])


def new_material(document: Document, wanted: str, **values: Any) -> tuple[str, Step]:
    """The name of a new material, `wanted` where it is free, and the step that adds it with these fields."""
    name = free_name(document, wanted)
    return name, ("add_material", (name,), values)


def copied(material: Material, name: str) -> Step:
    """The step that adds a material as this one is."""
    plain = Material(name)
    changed = {key: value for key, value in asdict(material).items() if value != getattr(plain, key) and key != "name"}
    return "add_material", (name,), changed


def program_lights() -> list[Step]:
    """The steps that make the lights of the program those of the document."""
    return [_added(light) for light in PROGRAM]


def _added(light: Light) -> Step:
    plain = Light(light.name, light.kind)
    changed = {key: value for key, value in asdict(light).items() if value != getattr(plain, key)}
    if "direction" in changed:
        changed["direction"] = tuple(round(part, 6) for part in light.direction)
    return "add_light", (light.name, light.kind), changed


def put_checker(session: Session, ids: list[str]) -> None:
    """Put the checker board on nodes, as a material that is made where there is none yet."""
    steps: list[Step] = []
    if all(material.name != CHECKER for material in session.document.materials):
        steps.append(("add_material", (CHECKER,), {"texture": checker(), "specular": 0.05}))
    do_steps(session, "Put a checker board on", [*steps, ("use_material", (ids, CHECKER), {})])


def checker() -> str:
    """The SHA-256 of the checker board, now an asset: squares A1 at the lower left to H8, each with its name."""
    from ...model.project.assets import default_store

    side = SQUARES * SQUARE
    image = QImage(side, side, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    font = QFont("DejaVu Sans")
    font.setPixelSize(SQUARE * 2 // 5)
    font.setBold(True)
    painter.setFont(font)
    for row in range(SQUARES):
        for column in range(SQUARES):
            square = QRectF(column * SQUARE, side - (row + 1) * SQUARE, SQUARE, SQUARE)
            dark = (row + column) % 2 == 0
            painter.fillRect(square, QColor(DEEP if dark else PALE))
            painter.setPen(QColor(PALE if dark else DEEP))
            painter.drawText(square, Qt.AlignmentFlag.AlignCenter, f"{chr(ord('A') + column)}{row + 1}")
    painter.end()
    data = QByteArray()
    buffer = QBuffer(data)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    QImageWriter(buffer, b"png").write(image)
    return default_store().put(bytes(data.data()))
