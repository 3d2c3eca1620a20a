"""Buttons and a slider for a motion: play, step by step, from contact to contact, over and over."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from ..icons import icon
from ..partition.order_bar import StepSlider


class PlayBar(QWidget):
    """`stepped` carries the step that is gone to; `toggled` asks to play or pause, `jumped` for the next contact (1) or
    the one before (-1)."""

    stepped = Signal(int)
    toggled = Signal()
    jumped = Signal(int)
    looped = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.slider = StepSlider(Qt.Orientation.Horizontal, self)
        self.slider.setAccessibleName("Step of the motion")
        self.slider.setToolTip("Steps of the motion; arrow keys go one further, Space plays")
        self.slider.valueChanged.connect(self.stepped)
        row = QHBoxLayout(self)
        row.setContentsMargins(6, 2, 8, 2)
        row.setSpacing(1)
        self.play = self._button("play", "Play the motion (Space)", self.toggled.emit)
        self.back = self._button("contact_before", "To the contact before", lambda: self.jumped.emit(-1))
        self.on = self._button("contact_next", "To the next contact", lambda: self.jumped.emit(1))
        self.loop = self._button("loop", "Over and over again", lambda: self.looped.emit(self.loop.isChecked()))
        self.loop.setCheckable(True)
        for button in (
            self._button("to_start", "To the beginning (Home)", lambda: self.go(0)),
            self._button("step_back", "One step back (Left)", lambda: self.go(self.step - 1)),
            self.play,
            self._button("step_forward", "One step on (Right)", lambda: self.go(self.step + 1)),
            self._button("to_end", "To the end (End)", lambda: self.go(self.slider.maximum())),
            self.loop,
        ):
            row.addWidget(button)
        row.addSpacing(6)
        row.addWidget(self.slider, 1)
        row.addSpacing(6)
        row.addWidget(self.back)
        row.addWidget(self.on)

    @property
    def step(self) -> int:
        return self.slider.value()

    def go(self, step: int) -> None:
        self.slider.setValue(step)

    def set_steps(self, steps: int) -> None:
        """So many, and nothing is told."""
        self.slider.blockSignals(True)
        self.slider.setRange(0, steps)
        self.slider.setPageStep(max(steps // 10, 1))
        self.slider.blockSignals(False)

    def show_step(self, step: int) -> None:
        """Where it is, without telling."""
        self.slider.blockSignals(True)
        self.slider.setValue(step)
        self.slider.blockSignals(False)

    def show_state(self, playing: bool, contacts: bool) -> None:
        self.play.setIcon(icon("pause" if playing else "play"))
        for button in (self.back, self.on):
            button.setEnabled(contacts)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Space:
            self.toggled.emit()
        else:
            super().keyPressEvent(event)

    def _button(self, picture: str, tip: str, act: Callable[[], object]) -> QToolButton:
        button = QToolButton(self)
        button.setProperty("flat", True)
        button.setIcon(icon(picture))
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.clicked.connect(lambda: act())
        return button
