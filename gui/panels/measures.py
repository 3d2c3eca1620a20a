"""The measures of a solid as lines that can be copied."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QGridLayout, QLabel, QToolButton, QWidget

from ..icons import icon
from ..status import figure
from .property_fields import LABEL_WIDTH

if TYPE_CHECKING:
    from ...model.solid.measure import Measures


class MeasuresView(QWidget):
    """A table of words; a dash where there is no value."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("measures_of_solid")
        self.copy_button = QToolButton()
        self.copy_button.setProperty("flat", True)
        self.copy_button.setIcon(icon("copy"))
        self.copy_button.setToolTip("Copy the measures")
        self.copy_button.clicked.connect(self._copy)
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(4)
        self._grid.setColumnMinimumWidth(0, LABEL_WIDTH)
        self._grid.setColumnStretch(1, 1)
        self._values: dict[str, QLabel] = {}
        for row, name in enumerate(("Volume", "Area", "Size", "From", "To", "Centroid", "Triangles", "Genus")):
            label = QLabel(name, self)
            label.setProperty("muted", True)
            value = QLabel("\u2013", self)
            value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            value.setWordWrap(True)
            right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop
            self._grid.addWidget(label, row, 0, right)
            self._grid.addWidget(value, row, 1)
            self._values[name] = value

    def text(self) -> str:
        return "\n".join(f"{name}\t{value.text()}" for name, value in self._values.items())

    def set_measures(self, measures: Measures | None) -> None:
        words = {} if measures is None else words_of(measures)
        for name, label in self._values.items():
            label.setText(words.get(name, "\u2013"))
        self.copy_button.setEnabled(bool(words))

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(self.text())


def words_of(measures: Measures) -> dict[str, str]:
    words = {
        "Volume": f"{figure(measures.volume, 9)} mm³"
        if measures.volume is not None
        else "\u2013 (the surface is not closed)",
        "Area": f"{figure(measures.area, 9)} mm²",
        "Triangles": figure(measures.triangles, 12),
        "Genus": str(measures.genus)
        if measures.components == 1
        else f"{measures.genus} in {measures.components} surfaces",
    }
    if measures.bounds is not None:
        low, high = measures.bounds
        words["Size"] = " × ".join(figure(b - a) for a, b in zip(low, high, strict=True)) + " mm"
        words["From"] = ", ".join(figure(a) for a in low)
        words["To"] = ", ".join(figure(b) for b in high)
    if measures.centroid is not None:
        words["Centroid"] = ", ".join(figure(x) for x in measures.centroid)
    return words
