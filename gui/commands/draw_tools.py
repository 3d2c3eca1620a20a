"""The window's commands for drawing outlines, and for the plane that they are drawn on. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..curves.drawing.work_plane import Name
    from ..window import MainWindow

_TOOLS = (
    ("pen", "Pen", "Shift+P", "Corners by clicks, curves by drags; begun on an open end of the selected path, it goes "
     "on with that", True),
    ("freehand", "Freehand", "Alt+D", "What is drawn becomes a smooth curve with corners", True),
    ("rectangle", "Draw rectangle", "", "Corner to corner; Shift makes a square, Alt draws from the middle", True),
    ("ellipse", "Draw ellipse", "", "From its middle; Shift makes a circle, a typed radius as well", True),
    ("polygon", "Draw polygon", "", "A regular one from its middle; Up and Down change the number of sides", False),
    ("star", "Draw star", "", "From its middle; Up and Down change the number of tips", False),
    ("arc", "Draw arc", "", "Its start, its end, and a point that it goes through or its radius", False),
    ("control_points", "Draw B-spline", "", "Clicks are its control points", False),
    ("through_points", "Draw spline through points", "", "Clicks are points that the curve goes through", False),
)  # fmt: skip
_PLANES: tuple[tuple[Name, str, str], ...] = (
    ("xy", "XY", "The ground"),
    ("xz", "XZ", "Upright, as seen from the front"),
    ("yz", "YZ", "Upright, as seen from the right"),
)


def _draw(window: MainWindow, kind: str) -> None:
    if window.draw.kind == kind:
        window.draw.end()
        return
    window.place_on_face.end()
    window.measure.end()
    window.sight.end()
    window.face_plane.end()
    window.draw.start(kind)
    window.actions_.refresh()


def _from_face(window: MainWindow) -> None:
    """What was being drawn with goes on, on the face."""
    if window.face_plane.active:
        window.face_plane.end()
        return
    window.place_on_face.end()
    window.measure.end()
    window.sight.end()
    window.face_plane.resumed = window.draw.kind
    window.draw.end()
    window.face_plane.start()


def _no_face(window: MainWindow) -> str | None:
    return None if any(root.visible for root in window.session.document.solids) else "no solid is visible"


DRAW_COMMANDS: tuple[Command, ...] = (
    *(
        Command(f"draw_{kind}", title, "Curve", lambda w, kind=kind: _draw(w, kind), shortcut=keys,
                icon=f"draw_{kind}", tip=tip, toolbar=bar, checked=lambda w, kind=kind: w.draw.kind == kind)
        for kind, title, keys, tip, bar in _TOOLS
    ),
    *(
        Command(f"work_plane_{name}", title, "Curve/Work plane", lambda w, name=name: w.work_plane.choose(name),
                icon="work_plane", tip=f"{tip}: what is drawn next lies on it",
                checked=lambda w, name=name: w.work_plane.name == name)
        for name, title, tip in _PLANES
    ),
    Command("work_plane_face", "From face …", "Curve/Work plane", _from_face, _no_face, icon="work_plane_face",
            tip="The plane of a flat face that you click; its origin is the world's, dropped on it",
            checked=lambda w: w.work_plane.name == "face"),
    Command("work_plane_outline", "Of the selected outline", "Curve/Work plane", lambda w: w.work_plane.on_outline(),
            lambda w: w.work_plane.outline_fault(), icon="work_plane",
            tip="The plane and the axes of the outline that is selected",
            checked=lambda w: w.work_plane.name == "outline"),
    Command("look_at_plane", "Look at the work plane", "Curve", lambda w: w.work_plane.look(), icon="look_at_plane",
            tip="Turn the view square to the plane that is drawn on"),
)  # fmt: skip
