"""The weight of the chosen control points: a logarithmic slider, and a number."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSlider, QVBoxLayout, QWidget

from ...panels.number_field import QUIET, NumberField, Steps
from ...partition.order_bar import StepSlider

FINE = 100  # steps of the slider for each tenfold; from a tenth to ten
WEIGHT = Steps(0.1, 0.01, 1.0, minimum=0.0, above=True)


class LevelSlider(StepSlider):
    """Leaves the wheel to what it stands in."""

    def wheelEvent(self, event: QWheelEvent) -> None:
        event.ignore()


class WeightRow(QWidget):
    """`stepping` carries a weight on its way, `stepped` tells that it stays; `typed` has what was written, and
    `all_one` asks for weights of 1 everywhere."""

    stepping = Signal(float)
    stepped = Signal()
    typed = Signal(str)
    all_one = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        tip = "Draws the curve to the chosen control points; 1 is plain"
        self.words = QLabel(self)
        self.words.setWordWrap(True)
        self.slider = LevelSlider(Qt.Orientation.Horizontal, self)
        self.slider.setRange(-FINE, FINE)
        self.slider.setPageStep(FINE // 5)
        self.slider.setTickPosition(QSlider.TickPosition.TicksBelow)
        self.slider.setTickInterval(FINE)
        self.slider.setAccessibleName("Weight, from 0.1 to 10")
        self.slider.setToolTip(f"{tip}. From 0.1 to 10")
        self.field = NumberField(WEIGHT, self)
        self.field.setAccessibleName("Weight")
        self.field.setToolTip(tip)
        self.field.setMaximumWidth(64)
        self.plain = QPushButton(self)
        self.plain.setAutoDefault(False)
        self.plain.setText("All 1")
        self.plain.setToolTip("Weight 1 for every control point: the curve is polynomial again")
        row = QHBoxLayout()
        row.setSpacing(6)
        row.addWidget(self.slider, 1)
        row.addWidget(self.field)
        row.addWidget(self.plain)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.words)
        layout.addLayout(row)
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.setInterval(QUIET)
        self._quiet.timeout.connect(self.stepped)
        self.slider.valueChanged.connect(self._slid)
        self.slider.sliderReleased.connect(self.stepped)
        self.field.typed.connect(self.typed)
        self.field.stepping.connect(self.stepping)
        self.field.stepped.connect(self.stepped)
        self.plain.clicked.connect(self.all_one)

    def show_weights(self, weights: Sequence[float], numbers: Sequence[int]) -> None:
        """All weights, and which control points are chosen."""
        chosen = [weights[number] for number in numbers]
        same = bool(chosen) and max(chosen) - min(chosen) <= 1e-9 * max(chosen)
        if not chosen:
            words = "Choose control points to weigh them."
        else:
            which = f"control point {numbers[0]}" if len(numbers) == 1 else f"{len(numbers)} control points"
            words = f"Of {which}"
        self.words.setText(words)
        self.words.setProperty("muted", True)
        for widget in (self.slider, self.field):
            widget.setEnabled(bool(chosen))
        self.field.setPlaceholderText("mixed" if chosen and not same else "")
        self.field.set_value(round(chosen[0], 9) if same else None)
        self.plain.setEnabled(any(weight != 1.0 for weight in weights))
        if not self.slider.isSliderDown() and not self._quiet.isActive():
            self.slider.blockSignals(True)
            self.slider.setValue(_level(chosen[0] if same else 1.0))
            self.slider.blockSignals(False)

    def _slid(self, level: int) -> None:
        self.stepping.emit(float(f"{10.0 ** (level / FINE):.3g}"))
        if not self.slider.isSliderDown():
            self._quiet.start()


def _level(weight: float) -> int:
    from math import log10

    return round(FINE * log10(min(max(weight, 0.1), 10.0)))
