"""A click tool that waits for a face: it marks the one under the pointer, and Escape ends it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ..view.viewport import Viewport
from .click_tool import ClickTool

if TYPE_CHECKING:
    from ...model.measuring.landmarks import Face
    from ...model.solid.display import DisplayMesh
    from ...render.handles.face_mark import FaceMark
    from ...render.viewer import Viewer


class FaceTool(ClickTool):
    """Sub-classes say what is `active`, and how it ends. `said` tells what to do, "" at the end."""

    said = Signal(str)
    began = Signal()
    ended = Signal()

    def __init__(self, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self._mark: FaceMark | None = None

    @property
    def active(self) -> bool:
        """Whether a face is waited for."""
        raise AssertionError(type(self).__name__)

    def end(self) -> None:
        """Wait no more."""

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.face_mark import FaceMark

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

    def _show(self, mesh: DisplayMesh | None = None, face: Face | None = None) -> None:
        """Mark a face, or none."""
        if self._mark is not None:
            self._mark.show(mesh, face)
            self._viewport.refresh()
