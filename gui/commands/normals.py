"""The window's commands on normals: shown, turned round, smooth or split by angle. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.document.outlines import Outlines
from ...model.document.tree import find
from ...model.editing.commands import Command
from ..normals.turning import flip, make_consistent, no_mesh

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "Tools/Normals"
NORMAL_SEPARATORS = ("smooth_faces",)


def _no_solid(window: MainWindow) -> str | None:
    return None if any(root.visible for root in window.session.document.solids) else "no solid is visible"


def _no_surface(window: MainWindow) -> str | None:
    if not window.session.selection:
        return "select a node first"
    document = window.session.document
    outlines = Outlines(document.definitions)
    flat = next((n for n in (find(document, i) for i in window.session.selection) if n in outlines), None)
    return None if flat is None else f"“{flat.label}” is an outline, which is flat; select solids"


def _without_crease(window: MainWindow) -> str | None:
    fault = _no_surface(window)
    if fault:
        return fault
    document = window.session.document
    own = any(find(document, node_id).crease is not None for node_id in window.session.selection)
    return None if own else "no selected node has a crease angle of its own"


def _crease(label: str, angle: float | None) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        ids = list(window.session.selection)
        window.session.do("set_crease", ids, *(() if angle is None else (angle,)), label=label)

    return run


def _ask_angle(window: MainWindow) -> None:
    """Go to the field for it among the properties."""
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QLineEdit

    window.docks["Properties"].show()
    window.docks["Properties"].raise_()
    field = window.properties.findChild(QLineEdit, "crease")
    if field is not None:
        window.properties.ensureWidgetVisible(field)
        field.setFocus(Qt.FocusReason.ShortcutFocusReason)
        field.selectAll()


NORMAL_COMMANDS: tuple[Command, ...] = (
    *(
        Command(f"{kind}_normals", title, "View", lambda w, kind=kind: w.needles.toggle(kind), _no_solid, keys,
                f"{kind}_normals", f"{tip}, of the selected nodes or of all",
                checked=lambda w, kind=kind: w.needles.is_on(kind))
        for kind, title, keys, tip in (
            ("face", "Normals of faces", "Alt+N", "A needle from the middle of each flat face to its outside"),
            ("vertex", "Normals of vertices", "", "Needles along the normals that smooth shading goes by"),
        )
    ),
    Command("flip_normals", "Flip", MENU, flip, no_mesh, "", "flip_normals",
            "Turn the faces of the selected meshes to their other side; a closed one is shown from outside either way"),
    Command("consistent_normals", "Make consistent", MENU, make_consistent, no_mesh, "", "consistent_normals",
            "Turn the faces of the selected meshes that disagree with their neighbours, and all to the outside"),
    Command("smooth_faces", "Smooth", MENU, _crease("Smooth faces", 180.0), _no_surface, "", "smooth_faces",
            "Shade the selected nodes without any edge: a crease angle of 180°"),
    Command("split_normals", "Split by angle …", MENU, _ask_angle, _no_surface, "", "split_normals",
            "Say at which angle between faces the selected nodes have an edge: Crease among the properties"),
    Command("flat_faces", "Flat", MENU, _crease("Flat faces", 0.0), _no_surface, "", "flat_faces",
            "Shade each flat face of the selected nodes by itself: a crease angle of 0°"),
    Command("own_creases", "Creases as by kind", MENU, _crease("Creases as by kind", None), _without_crease,
            tip="Take the crease angle of the selected nodes away"),
)  # fmt: skip
