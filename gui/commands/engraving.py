"""The window's commands that engrave the selected outline, in the menu Curve. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.editing.chosen import chosen
from ...model.editing.commands import Command
from .curves import outlines_fault

if TYPE_CHECKING:
    from ..window import MainWindow


def _fault(window: MainWindow) -> str | None:
    fault = outlines_fault(1, 1)(window)
    if fault is not None:
        return fault
    document = window.session.document
    (node,) = chosen(window.session).nodes
    if all(root.id != node.id for root in document.profiles):
        return f"“{node.label}” is an operand already"
    return None if any(root.visible for root in document.solids) else "no solid is visible"


def _start(raised: bool) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        window.place_on_face.end()
        window.measure.end()
        window.sight.end()
        window.face_plane.end()
        window.draw.end()
        window.engrave.start(raised)

    return run


ENGRAVING_COMMANDS: tuple[Command, ...] = (
    Command("engrave", "Engrave …", "Curve", _start(False), _fault, "Ctrl+Alt+E", "engrave",
            "Cut the selected outline into a face that you click, flat or round; depth and draft are then properties"),
    Command("emboss", "Emboss …", "Curve", _start(True), _fault, "Alt+Shift+E", "emboss",
            "Raise the selected outline from a face that you click, flat or round"),
)  # fmt: skip
