"""The tool that takes the work plane from a face: hover marks the flat face, a click takes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...tools.click_tool import ClickTool
from ...view.viewport import Viewport
from .work_plane import WorkPlane

if TYPE_CHECKING:
    from ....render.handles.face_mark import FaceMark
    from ....render.viewer import Viewer

WANTED = "Click the flat face to draw on; Escape ends this"
CURVED = "This face is curved: click a flat one to draw on"


class FacePlaneTool(ClickTool):
    """Does nothing until `start`. `said` tells what to do, "" at the end; `taken` that the work plane is a face's."""

    said = Signal(str)
    began = Signal()
    ended = Signal()
    taken = Signal()

    def __init__(self, viewport: Viewport, plane: WorkPlane, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self._plane = plane
        self._mark: FaceMark | None = None
        self.active = False
        self.resumed = ""
        """The drawing tool that goes on afterwards."""

    def start(self) -> None:
        if not self.active:
            self.active = True
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
        self._viewport.setFocus()
        self.said.emit(WANTED)

    def end(self) -> None:
        if self.active:
            self.active = False
            self.drop_press()
            self._hide()
            self._viewport.unsetCursor()
            self.said.emit("")
            self.ended.emit()

    def attached(self, viewer: Viewer) -> None:
        from ....render.handles.face_mark import FaceMark

        super().attached(viewer)
        self._mark = FaceMark(viewer)

    def closing(self) -> None:
        self.end()
        super().closing()
        self._mark = None

    def takes_clicks(self) -> bool:
        return self.active

    def key(self, event: QKeyEvent) -> bool:
        if not self.active or event.key() != Qt.Key.Key_Escape:
            return False
        self.end()
        return True

    def pointed(self, position: QPointF | None) -> None:
        from ....model.measuring.landmarks import curved, face_at

        pick = None if position is None or self._viewer is None else self._viewer.pick(position.x(), position.y())
        if pick is None or pick.triangle < 0 or self._viewer is None or self._mark is None:
            self._hide()
            return
        mesh = self._viewer.scene.meshes[pick.solid_id]
        bent = curved(mesh, pick.triangle)
        self._mark.show(*((None, None) if bent else (mesh, face_at(mesh, pick.triangle))))
        self.said.emit(CURVED if bent else WANTED)
        self._viewport.refresh()

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

    def _hide(self) -> None:
        if self._mark is not None:
            self._mark.show()
            self._viewport.refresh()
