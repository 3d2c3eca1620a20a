"""A slider over a range of numbers: one run of steps, by mouse, keys or wheel, is one change."""

from __future__ import annotations

import math

from PySide6.QtCore import QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QSlider, QStyle, QStyleOptionSlider, QWidget

from ..panels.number_field import QUIET

HANDLE = 14  # pixels; the groove ends half of it before the widget does


def slider_step(low: float, high: float) -> float:
    """A round number that cuts a range into 50 to 500 steps."""
    span = high - low
    return 10.0 ** math.floor(math.log10(span / 50)) if span > 0 else 1.0


class ValueSlider(QSlider):
    """`stepping` tells values on the way, then `stepped` once; Escape tells `reverted` instead."""

    stepping = Signal(float)
    stepped = Signal()
    reverted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.low, self.high = 0.0, 1.0
        self._size = 1.0
        self._running = False
        self._dragging = False
        self._wheel = QTimer(self)
        self._wheel.setSingleShot(True)
        self._wheel.setInterval(QUIET)
        self._wheel.timeout.connect(self._end)

    def set_range(self, low: float, high: float) -> None:
        self.low, self.high, self._size = low, high, slider_step(low, high)
        self.blockSignals(True)
        self.setRange(0, max(1, math.ceil((high - low) / self._size - 1e-9)))
        self.setPageStep(10)
        self.blockSignals(False)

    def set_value(self, value: float) -> None:
        """Show a value, unless the slider is the one that is changing it."""
        if not self._running:
            self.setValue(round((value - self.low) / self._size))

    def _go(self, place: int) -> None:
        place = min(max(place, self.minimum()), self.maximum())
        if place != self.value():
            self._running = True
            self.setValue(place)
            self.stepping.emit(min(self.high, round(self.low + place * self._size, 9)))

    def submit(self) -> None:
        """End a run of steps that is under way."""
        self._end()

    def _end(self) -> None:
        self._wheel.stop()
        self._dragging = False
        if self._running:
            self._running = False
            self.stepped.emit()

    def _place_at(self, x: float) -> int:
        span = self.width() - HANDLE
        return QStyle.sliderValueFromPosition(self.minimum(), self.maximum(), round(x - HANDLE / 2), max(1, span))

    def handle_centre(self, place: int) -> QPoint:
        """Where the handle stands at a step, in pixels of the widget."""
        x = QStyle.sliderPositionFromValue(self.minimum(), self.maximum(), place, self.width() - HANDLE)
        return QPoint(x + HANDLE // 2, self.height() // 2)

    def initStyleOption(self, option: QStyleOptionSlider) -> None:
        super().initStyleOption(option)
        if self._dragging:
            option.state |= QStyle.StateFlag.State_Sunken

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._dragging = True
            self._go(self._place_at(event.position().x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._dragging:
            self._go(self._place_at(event.position().x()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._end()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        steps = {
            Qt.Key.Key_Right: 1, Qt.Key.Key_Up: 1, Qt.Key.Key_Left: -1, Qt.Key.Key_Down: -1,
            Qt.Key.Key_PageUp: self.pageStep(), Qt.Key.Key_PageDown: -self.pageStep(),
            Qt.Key.Key_Home: -self.maximum(), Qt.Key.Key_End: self.maximum(),
        }  # fmt: skip
        step = steps.get(Qt.Key(event.key()))
        if event.key() == Qt.Key.Key_Escape and self._running:
            self._wheel.stop()
            self._running = self._dragging = False
            self.reverted.emit()
        elif step is not None:
            coarse = bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier) and abs(step) == 1
            self._go(self.value() + step * (self.pageStep() if coarse else 1))
        else:
            event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if not event.isAutoRepeat() and not self._dragging:
            self._end()
        super().keyReleaseEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if not self.hasFocus():  # the panel scrolls instead
            event.ignore()
            return
        notches = (event.angleDelta().y() or event.angleDelta().x()) / 120
        self._go(self.value() + (math.ceil(notches) if notches > 0 else math.floor(notches)))
        self._wheel.start()
        event.accept()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._end()
        super().focusOutEvent(event)
