"""The tool that engraves an outline into a face, or raises it: hover shows where it would go, a click does it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, QPointF, Qt, Signal

from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.editing.session import Session, State
from ...model.operations.operations import OPERATIONS
from ..view.viewport import Viewport
from .face_tool import FaceTool

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.document.placement import Placement

CATCH = 12.0
"""Logical pixels within which a flat face's centre draws the outline to it."""
DIGITS = 6
NOWHERE = "This face is neither flat nor the outside of a cylinder"


@dataclass(frozen=True, slots=True)
class Spot:
    """Where the outline's origin goes; `radius` is that of a cylinder, None on a flat face."""

    solid_id: str
    placement: Placement
    radius: float | None


class EngraveTool(FaceTool):
    """Does nothing until `start`."""

    refused = Signal(str)

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self._session = session
        self._outline, self._label = "", ""
        self._document: Document | None = None
        self._previewed: Document | None = None
        self.raised = False

    @property
    def active(self) -> bool:
        return self._document is not None

    def start(self, raised: bool) -> None:
        """Begin with the selected outline."""
        self.end()
        self._document, self.raised = self._session.document, raised
        (self._outline,) = self._session.selection
        self._label = find(self._document, self._outline).label
        self.began.emit()
        self._viewport.setCursor(Qt.CursorShape.CrossCursor)
        self._viewport.setFocus()
        self._say()

    def end(self) -> None:
        """Stop, and take back what is previewed."""
        if self._document is None:
            return
        self._document = None
        self.drop_press()
        if self._session.document is self._previewed:
            self._session.cancel()
        self._previewed = None
        self._show()
        self._viewport.unsetCursor()
        self.said.emit("")
        self.ended.emit()

    def _say(self) -> None:
        does = "stand out" if self.raised else "be engraved"
        self.said.emit(f"Click the face where “{self._label}” should {does}; Escape ends this")

    # Events.

    def session_changed(self, before: State, after: State) -> None:
        if self._document is None:
            return
        other = after.document is not self._document and after.document is not self._previewed
        if other or after.selection != (self._outline,):
            self.end()

    def pointed(self, position: QPointF | None) -> None:
        spot = self._spot(position) if position is not None else None
        if self._document is None or spot is None:
            if self.active:
                self._session.cancel()
            self._show()
            return
        try:
            self._previewed = OPERATIONS["place"](self._document, self._outline, *spot.placement.steps)
            self._session.preview(self._previewed)
        except Refusal as refusal:
            self.refused.emit(str(refusal))

    def clicked(self, position: QPointF) -> None:
        spot, outline, raised = self._spot(position), self._outline, self.raised
        if spot is None:
            return
        self.end()
        session = self._session
        keywords: dict[str, Any] = {} if spot.radius is None else {"radius": spot.radius}
        if raised:
            keywords["raised"] = True
        try:
            before = {node.id for node in find(session.document, spot.solid_id).children}
            label = "Emboss" if raised else "Engrave"
            document = session.do("engrave", outline, spot.solid_id, *spot.placement.steps, label=label, **keywords)
            made = [
                child.id
                for root in document.solids
                for child in root.children
                if any(operand.id == outline for operand in child.children) and child.id not in before
            ]
            session.select(made)
        except Refusal as refusal:
            self.refused.emit(str(refusal))

    # Places.

    def _spot(self, position: QPointF) -> Spot | None:
        """The place under the pointer, which is marked; None where nothing can be engraved."""
        from ...model.document.resolve import resolve
        from ...model.measuring.landmarks import curved, face_at
        from ...model.measuring.surface_kinds import CylinderSurface
        from ...model.measuring.surfaces import surface_at

        document, viewer = self._document, self._viewer
        pick = None if viewer is None else viewer.pick(position.x(), position.y())
        if document is None or viewer is None or pick is None or pick.triangle < 0:
            self._show()
            self._say()
            return None
        mesh = viewer.scene.meshes[pick.solid_id]
        root = next((root for root in resolve(document).solids if root.id == pick.solid_id), None)
        if root is None:
            return None
        if not curved(mesh, pick.triangle):
            face = face_at(mesh, pick.triangle)
            self._show(mesh, face)
            self._say()
            point = self._caught(position, tuple(face.centre.tolist())) or pick.point
            return Spot(root.id, _on_plane(point, pick.normal), None)
        surface = surface_at(root, mesh, pick.triangle)
        self._show()
        if not isinstance(surface, CylinderSurface) or surface.hollow:
            self.said.emit(NOWHERE)
            return None
        self._say()
        return Spot(root.id, _on_cylinder(pick.point, surface), round(surface.radius, DIGITS))

    def _caught(self, position: QPointF, centre: tuple[float, float, float]) -> tuple[float, float, float] | None:
        from ...render.camera import project

        if self._viewer is None:
            return None
        x, y, _ = project(self._viewer.camera, [centre], self._viewer.size)[0]
        return centre if abs(x - position.x()) + abs(y - position.y()) <= CATCH else None


def _on_plane(point: tuple[float, float, float], normal: tuple[float, float, float]) -> Placement:
    """The z axis along the normal, the x axis level."""
    import numpy as np

    from ..curves.drawing.work_plane import plane_of, rigid

    frame = plane_of((0.0, 0.0, 0.0), normal).matrix()
    frame = np.column_stack((frame[:, :3], np.round(point, DIGITS)))
    return rigid(frame)


def _on_cylinder(point: tuple[float, float, float], surface: object) -> Placement:
    """On the surface itself, not on a facet; the z axis away from the axis, y along it and rather up than down."""
    import numpy as np

    from ...model.measuring.surface_kinds import CylinderSurface
    from ..curves.drawing.work_plane import rigid

    assert isinstance(surface, CylinderSurface)
    axis, middle = np.array(surface.axis), np.array(surface.point)
    up = axis if (axis[2], axis[1], axis[0]) > (0.0, 0.0, 0.0) else -axis
    foot = middle + axis * float(axis @ (np.array(point) - middle))
    out = np.array(point) - foot
    out /= np.linalg.norm(out)
    return rigid(np.column_stack((np.cross(up, out), up, out, np.round(foot + surface.radius * out, DIGITS))))
