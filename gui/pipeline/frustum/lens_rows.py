"""Sliders for the angle and for the near and far plane that are tried."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from ....model.document.errors import Refusal
from ....model.document.expression import Expression
from ....model.document.expression import number as number_from
from ....model.pipeline.matrices import Lens
from ...panels.number_field import NumberField, Steps
from ...panels.property_edit import sentence
from ...parameters.value_slider import ValueSlider

ROWS = (
    ("angle", "Angle", "The full vertical angle of the perspective, in degrees"),
    ("near", "Near", "The near plane, in mm before the eye: what is nearer is cut off"),
    ("far", "Far", "The far plane, in mm before the eye: what is farther is cut off"),
)
ANGLES = (5.0, 150.0)
FIELD = 74  # pixels


class LensRows(QWidget):
    """`tried` carries the name of a number and its value; `refused` why what was typed is none."""

    tried = Signal(str, float)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.fields: dict[str, NumberField] = {}
        self.sliders: dict[str, ValueSlider] = {}
        grid = QGridLayout(self)
        grid.setContentsMargins(8, 2, 8, 2)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(2)
        for row, (name, title, tip) in enumerate(ROWS):
            label = QLabel(title, self)
            slider = ValueSlider(self)
            slider.stepping.connect(lambda value, name=name: self.tried.emit(name, value))
            field = NumberField(Steps(plain=1.0, minimum=0.0, above=True), self)
            field.setFixedWidth(FIELD)
            field.setAlignment(Qt.AlignmentFlag.AlignRight)
            field.typed.connect(lambda text, name=name: self._typed(name, text))
            field.stepping.connect(lambda value, name=name: self.tried.emit(name, value))
            for widget in (label, slider, field):
                widget.setToolTip(tip)
                widget.setAccessibleName(title)
            grid.addWidget(label, row, 0)
            grid.addWidget(slider, row, 1)
            grid.addWidget(field, row, 2)
            self.sliders[name], self.fields[name] = slider, field

    def show_lens(self, lens: Lens | None, distance: float, tried: bool) -> None:
        """The numbers, None where the projection has none. The sliders' ranges stay while numbers are `tried`."""
        self.setEnabled(lens is not None)
        if lens is None:
            return
        for name in self.fields:
            value = getattr(lens, name)
            self.sliders[name].setEnabled(value is not None)
            self.fields[name].setEnabled(value is not None)
            if value is None:
                continue
            if not tried:
                self.sliders[name].set_range(*_range(name, lens, distance))
            self.sliders[name].set_value(value)
            self.fields[name].set_value(float(f"{value:.6g}"))

    def _typed(self, name: str, text: str) -> None:
        field = self.fields[name]
        try:
            read = number_from(text, "the number")
            value = read.evaluate({}) if isinstance(read, Expression) else float(read)
        except Refusal as refusal:
            field.set_fault(True)
            self.refused.emit(sentence(refusal))
            return
        field.setModified(False)
        self.tried.emit(name, value)


def _range(name: str, lens: Lens, distance: float) -> tuple[float, float]:
    if name == "angle":
        return ANGLES
    low = 0.01 * distance if lens.angle is not None else min(lens.near, 0.0)
    return (low, max(2.0 * distance, lens.near)) if name == "near" else (low, max(3.0 * distance, lens.far))
