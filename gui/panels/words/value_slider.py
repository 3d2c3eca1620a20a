"""A slider for a number between two limits: what it passes is previewed, what it is left at is kept."""

from __future__ import annotations

from collections.abc import Callable
from math import floor, log10

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QFocusEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ...partition.order_bar import StepSlider
from ..number_field import QUIET


class ValueSlider(StepSlider):
    """From `low` to `high` in steps of a power of ten; a double click asks for `default`.

    `preview` takes each value on the way and `commit` the last one: on release, or a moment after keys and wheel.
    `cancel` is called by Escape.
    """

    def __init__(
        self,
        limits: tuple[float, float, float],
        preview: Callable[[float], object],
        commit: Callable[[float], object],
        cancel: Callable[[], object],
        parent: QWidget | None = None,
    ) -> None:
        """`limits` are (low, default, high)."""
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._low, self._default, self._high = limits
        span = self._high - self._low
        power = floor(log10(span / 100)) if span > 0 else 0
        self._digits, self._step = max(-power, 0), 10.0**power
        self._preview, self._commit, self._cancel = preview, commit, cancel
        self.setRange(0, max(round(span / self._step), 0))
        self.setPageStep(max(self.maximum() // 10, 1))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._moved = False
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.setInterval(QUIET)
        self._quiet.timeout.connect(self._keep)
        self.valueChanged.connect(self._slid)
        self.sliderReleased.connect(self._keep)

    @property
    def number(self) -> float:
        """Where it stands."""
        return min(round(self._low + self.value() * self._step, self._digits), self._high)

    def show_number(self, number: float, previewing: bool) -> None:
        """Stand at a number, or at the limit next to it, unless it is on the way itself."""
        if not previewing and not self.isSliderDown():
            self._forget()
        if not self._moved and not self.isSliderDown():
            self._stand_at(number)

    def _stand_at(self, number: float) -> None:
        self.blockSignals(True)
        self.setValue(round((min(max(number, self._low), self._high) - self._low) / self._step))
        self.blockSignals(False)
        self.update()

    def _slid(self) -> None:
        self._moved = True
        self._preview(self.number)
        if not self.isSliderDown():
            self._quiet.start()

    def _keep(self) -> None:
        moved = self._moved
        self._forget()
        if moved:
            self._commit(self.number)

    def _forget(self) -> None:
        self._quiet.stop()
        self._moved = False

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._forget()
            self.setSliderDown(False)
            self._commit(self._default)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._moved:
            self._forget()
            self.setSliderDown(False)
            self._cancel()
        else:
            super().keyPressEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:  # the form scrolls instead
            event.ignore()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if not self.signalsBlocked():
            self._keep()
