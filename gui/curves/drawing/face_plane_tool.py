"""The tool that takes the work plane from a face: hover marks the flat face, a click takes it."""

from __future__ import annotations

from PySide6.QtCore import QObject, QPointF, Qt, Signal

from ...tools.face_tool import FaceTool
from ...view.viewport import Viewport
from .work_plane import WorkPlane

WANTED = "Click the flat face to draw on; Escape ends this"
CURVED = "This face is curved: click a flat one to draw on"


class FacePlaneTool(FaceTool):
    """Does nothing until `start`. `taken` tells that the work plane is a face's."""

    taken = Signal()

    def __init__(self, viewport: Viewport, plane: WorkPlane, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self._plane = plane
        self._waiting = False
        self.resumed = ""
        """The drawing tool that goes on afterwards."""

    @property
    def active(self) -> bool:
        return self._waiting

    def start(self) -> None:
        if not self.active:
            self._waiting = True
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
        self._viewport.setFocus()
        self.said.emit(WANTED)

    def end(self) -> None:
        if self.active:
            self._waiting = False
            self.drop_press()
            self._show()
            self._viewport.unsetCursor()
            self.said.emit("")
            self.ended.emit()

    def pointed(self, position: QPointF | None) -> None:
        from ....model.measuring.landmarks import curved, face_at

        pick = None if position is None or self._viewer is None else self._viewer.pick(position.x(), position.y())
        if pick is None or pick.triangle < 0 or self._viewer is None:
            self._show()
            return
        mesh = self._viewer.scene.meshes[pick.solid_id]
        bent = curved(mesh, pick.triangle)
        self._show(*((None, None) if bent else (mesh, face_at(mesh, pick.triangle))))
        self.said.emit(CURVED if bent else WANTED)

    def clicked(self, position: QPointF) -> None:
        from ....model.document.placement import IDENTITY
        from ....model.measuring.landmarks import curved
        from ....model.measuring.resting import digits_of, mapped_face
        from ....render.camera import vector_of

        pick = None if self._viewer is None else self._viewer.pick(position.x(), position.y())
        if pick is None or self._viewer is None:
            return
        point, normal = pick.point, pick.normal
        if pick.triangle >= 0:
            mesh = self._viewer.scene.meshes[pick.solid_id]
            if curved(mesh, pick.triangle):
                self.said.emit(CURVED)
                return
            centre, across = mapped_face(mesh, pick.triangle, IDENTITY)
            digits = min(digits_of(mesh), 6)
            point, normal = vector_of(round(float(part), digits) for part in centre), vector_of(across)
        self.end()
        self._plane.on_face(point, normal)
        self.taken.emit()
