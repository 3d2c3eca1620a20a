"""The plane that new outlines are drawn on."""

from __future__ import annotations

from math import atan2, degrees, hypot
from typing import TYPE_CHECKING, Literal

from PySide6.QtCore import QObject, Signal

from ....model.document.errors import Refusal
from ....model.document.placement import Move, Placement, Turn
from ....model.document.tree import find
from ....model.editing.session import Session
from ...view.viewport import Viewport

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Name = Literal["xy", "xz", "yz", "face", "outline"]
TITLES: dict[str, str] = {"xy": "XY", "xz": "XZ", "yz": "YZ", "face": "Face", "outline": "Outline"}
STANDARD: dict[str, Placement] = {
    "xy": Placement(),
    "xz": Placement((Turn((90.0, 0.0, 0.0)),)),
    "yz": Placement((Turn((90.0, 0.0, 90.0)),)),
}
"""Each seen as the view of its name shows it: XY from the top, XZ from the front, YZ from the right."""
DIGITS = 9


class WorkPlane(QObject):
    """`placement` is what an outline gets that is drawn on it; `name` where it comes from."""

    changed = Signal()

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._viewport = session, viewport
        self.name: Name = "xy"
        self.placement = Placement()

    @property
    def frame(self) -> NDArray[np.float64]:
        """(3, 4) from the plane to the world."""
        return self.placement.matrix()

    def choose(self, name: Name) -> None:
        """One of the standard planes, by name."""
        self._set(name, STANDARD[name])

    def on_face(self, point: tuple[float, float, float], normal: tuple[float, float, float]) -> None:
        """The plane of a face: its origin is the world's, dropped on it; its x axis is level."""
        self._set("face", plane_of(point, normal))

    def on_outline(self) -> None:
        """The plane of the selected outline, its own axes. Raises Refusal."""
        from ....model.outline.frames import frame_of

        fault = self.outline_fault()
        if fault:
            raise Refusal(fault)
        self._set("outline", rigid(frame_of(self._session.document, self._session.selection[0])))

    def outline_fault(self) -> str | None:
        """Why the plane of the selection cannot be taken, or None."""
        from ....model.document.outlines import is_outline

        document, selection = self._session.document, self._session.selection
        if len(selection) != 1 or not is_outline(find(document, selection[0]), document.definitions):
            return "select an outline first"
        return None

    def look(self) -> None:
        """Turn the view square to the plane, from the side that it faces."""
        from dataclasses import replace

        import numpy as np

        from ....render.camera import vector_of

        viewer = self._viewport.viewer
        if viewer is None:
            return
        frame, camera = self.frame, viewer.camera
        target = np.asarray(camera.target) - frame[:, 2] * float(frame[:, 2] @ (camera.target - frame[:, 3]))
        position = target + camera.distance * frame[:, 2]
        self._viewport.move_to(
            replace(camera, position=vector_of(position), target=vector_of(target), up=vector_of(frame[:, 1]))
        )

    def _set(self, name: Name, placement: Placement) -> None:
        self.name, self.placement = name, placement
        self.changed.emit()


def plane_of(point: tuple[float, float, float], normal: tuple[float, float, float]) -> Placement:
    """The placement of the plane through a point across a unit normal, in tidy numbers: see `WorkPlane.on_face`."""
    x, y, z = normal
    flat = hypot(x, y)
    tilt = round(degrees(atan2(flat, z)), DIGITS)
    heading = round(degrees(atan2(x, -y)), DIGITS) if flat > 1e-9 else 0.0
    turn = Turn((tilt, 0.0, heading))
    axis = turn.matrix()[:, 2]
    height = float(axis @ point)
    move = tuple(round(height * float(part), DIGITS) + 0.0 for part in axis)
    return _steps(turn, move)


def rigid(frame: NDArray[np.float64]) -> Placement:
    """The placement that is a frame (3, 4) without its scale. Raises Refusal where that is no plane."""
    import numpy as np

    x, normal = frame[:, 0], np.cross(frame[:, 0], frame[:, 1])
    if not (np.linalg.norm(x) > 1e-12 and np.linalg.norm(normal) > 1e-12):
        raise Refusal("this outline is scaled to nothing and has no plane")
    x, normal = x / np.linalg.norm(x), normal / np.linalg.norm(normal)
    y = np.cross(normal, x)
    # R = Rz Ry Rx, as `Turn` has it.
    across = hypot(float(x[0]), float(x[1]))
    if across > 1e-12:
        angles = atan2(float(y[2]), float(normal[2])), atan2(-float(x[2]), across), atan2(float(x[1]), float(x[0]))
    else:
        angles = atan2(-float(normal[1]), float(y[1])), atan2(-float(x[2]), across), 0.0
    about_x, about_y, about_z = (round(degrees(angle), DIGITS) + 0.0 for angle in angles)
    return _steps(Turn((about_x, about_y, about_z)), tuple(round(float(part), DIGITS) + 0.0 for part in frame[:, 3]))


def _steps(turn: Turn, move: tuple[float, ...]) -> Placement:
    steps = (*([turn] if any(turn.numbers) else []), *([Move(move)] if any(move) else []))
    return Placement(steps)
