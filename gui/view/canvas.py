"""A native widget that a library other than Qt paints, once for each pass of the event loop at most."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPaintEngine, QPaintEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QWidget


class Canvas(QWidget):
    """Sub-classes `draw` and follow the widget's size in `resized`. `exposed` comes once, when it is on the screen."""

    exposed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_NativeWindow)
        self.setAttribute(Qt.WidgetAttribute.WA_DontCreateNativeAncestors)
        self.setAttribute(Qt.WidgetAttribute.WA_PaintOnScreen)
        self.setAttribute(Qt.WidgetAttribute.WA_NoSystemBackground)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._exposed = False
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.draw)

    def draw(self) -> None:
        """Draw now."""

    def resized(self) -> None:
        """The widget has another size or shows for the first time."""

    def draw_soon(self) -> None:
        if not self._timer.isActive():
            self._timer.start(0)

    def stop_drawing(self) -> None:
        """Forget what `draw_soon` has asked for."""
        self._timer.stop()

    def paintEngine(self) -> QPaintEngine:
        return None  # type: ignore[return-value]  # Qt does not paint here

    def paintEvent(self, event: QPaintEvent) -> None:
        if not self._exposed:
            self._exposed = True
            self.exposed.emit()
        else:
            self.draw_soon()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.resized()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.resized()

    def sizeHint(self) -> QSize:
        return QSize(900, 640)
