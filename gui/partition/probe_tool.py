"""The tool that takes a point of a face for the tree to be probed with."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ..tools.click_tool import ClickTool


class ProbeTool(ClickTool):
    """Does nothing until `start`. `probed` carries a point (x, y, z); `said` what to do, "" at the end."""

    probed = Signal(object)
    said = Signal(str)
    active_changed = Signal(bool)

    active = False

    def takes_clicks(self) -> bool:
        return self.active

    def start(self) -> None:
        self._set(True)
        self._viewport.setFocus()
        self.said.emit("Click a face: the tree is walked down to that point; Escape ends this")

    def end(self) -> None:
        self._set(False)

    def _set(self, active: bool) -> None:
        if active == self.active:
            return
        self.active = active
        self.drop_press()
        self._viewport.setCursor(Qt.CursorShape.CrossCursor) if active else self._viewport.unsetCursor()
        if not active:
            self.said.emit("")
        self.active_changed.emit(active)

    def closing(self) -> None:
        self.end()
        super().closing()

    def clicked(self, position: QPointF) -> None:
        pick = None if self._viewer is None else self._viewer.pick(position.x(), position.y())
        if pick is not None:
            self.probed.emit(tuple(float(value) for value in pick.point))

    def key(self, event: QKeyEvent) -> bool:
        if not self.active or event.key() != Qt.Key.Key_Escape:
            return False
        self.end()
        return True
