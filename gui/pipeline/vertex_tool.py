"""The tool that takes the vertex to be followed from the picture, and marks its pixel there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ..tools.click_tool import ClickTool

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...render.handles.pixel_mark import PixelMark
    from ...render.handles.snap import Snap, Snapper
    from ...render.handles.snap_mark import SnapMark
    from ..view.viewport import Viewport

HINT = "Click a corner: its way to the screen is followed; Escape ends this"
NOTHING = "There is nothing here: click a corner, or a point of an edge or a face; Escape ends this"


class VertexTool(ClickTool):
    """`picked` carries the occurrence's path and a point (x, y, z) of the world; `said` what to do, "" at the end."""

    picked = Signal(object, object)
    said = Signal(str)
    began = Signal()
    ended = Signal()

    def __init__(self, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self.active = False
        self._snapper: Snapper | None = None
        self._snap_mark: SnapMark | None = None
        self.mark: PixelMark | None = None
        self._marked: NDArray[np.float64] | None = None

    def takes_clicks(self) -> bool:
        return self.active

    def start(self) -> None:
        if not self.active:
            self.active = True
            self._make()
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
            self._viewport.setFocus()
            self.said.emit(HINT)

    def end(self) -> None:
        """Stop picking; the mark stays."""
        if self.active:
            self.active = False
            self.drop_press()
            self._snap(None)
            self._viewport.unsetCursor()
            self.said.emit("")
            self.ended.emit()

    def show_mark(self, point: NDArray[np.float64] | None) -> None:
        """Mark the pixel of a point (3,) of the world, or none."""
        same = point is self._marked or (
            point is not None and self._marked is not None and bool((point == self._marked).all())
        )
        self._marked = point
        if same:
            return
        if point is not None:
            self._make()
        if self.mark is not None:
            self.mark.show(point)
            self._draw()

    def closing(self) -> None:
        self.end()
        super().closing()
        self._snapper = self._snap_mark = self.mark = None

    def pointed(self, position: QPointF | None) -> None:
        self._snap(None if position is None else self._find(position))

    def clicked(self, position: QPointF) -> None:
        snap = self._find(position)
        if snap is None:
            self.said.emit(NOTHING)
            return
        self.picked.emit(snap.path, snap.point)
        self.said.emit(HINT)

    def key(self, event: QKeyEvent) -> bool:
        if not self.active or event.key() != Qt.Key.Key_Escape:
            return False
        self.end()
        return True

    def _make(self) -> None:
        """What the tool draws with, when it is first needed."""
        if self._viewer is None or self.mark is not None:
            return
        from ...render.handles.pixel_mark import PixelMark
        from ...render.handles.snap import Snapper
        from ...render.handles.snap_mark import SnapMark

        self._snapper, self._snap_mark, self.mark = Snapper(self._viewer), SnapMark(), PixelMark()
        self._viewer.overlay.add(self.mark)
        self._viewer.overlay.add(self._snap_mark)

    def _find(self, position: QPointF) -> Snap | None:
        snap = None if self._snapper is None else self._snapper.find(position.x(), position.y())
        return None if snap is None or snap.kind == "grid" else snap

    def _snap(self, snap: Snap | None) -> None:
        if self._snap_mark is not None and self._snap_mark.show(snap):
            self._draw()

    def _draw(self) -> None:
        if self._viewer is not None:
            self._viewer.needs_render = True
            self._viewport.refresh()
