"""The measures of a node or a solid as lines of figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QToolButton, QWidget

from ...model.measuring.figure import Figure
from ..icons import icon
from .figures import FigureLabel, FigureUse
from .property_fields import LABEL_WIDTH

if TYPE_CHECKING:
    from ...model.measuring.measure import Measures

DASH = "\u2013"
FINE = {"Volume": 9, "Area": 9, "Triangles": 12}
"""Digits shown where they are more than the usual ones."""
TIPS = {
    "Inertia": "Moments of inertia about the centroid, along the world's axes, for a density of 1",
    "Products": "The tensor's elements beside the diagonal: xy, xz, yz",
    "Principal": "Moments of inertia about the principal axes through the centroid, least first",
    "Genus": "Holes that go through",
    "Size": "Of the box around it",
    "From": "The lowest corner of the box around it",
    "To": "The highest corner of the box around it",
}
NAMES = ("Volume", "Area", "Size", "From", "To", "Centroid", "Inertia", "Products", "Principal", "Triangles", "Genus")


class MeasuresView(QWidget):
    """A row for each figure; a dash where there is no value."""

    def __init__(self, use: FigureUse, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._use = use
        self._figures: tuple[Figure, ...] = ()
        self.copy_button = QToolButton()
        self.copy_button.setProperty("flat", True)
        self.copy_button.setIcon(icon("copy"))
        self.copy_button.setToolTip("Copy all")
        self.copy_button.clicked.connect(lambda: use.copy(self.text()))
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        grid.setColumnMinimumWidth(0, LABEL_WIDTH)
        grid.setColumnStretch(1, 1)
        self._rows: dict[str, FigureLabel] = {}
        for row, name in enumerate(NAMES):
            label = QLabel(name, self)
            label.setProperty("muted", True)
            label.setToolTip(TIPS.get(name, ""))
            value = FigureLabel(use, parent=self)
            value.setAccessibleName(name)
            grid.addWidget(label, row, 0, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop)
            grid.addWidget(value, row, 1)
            self._rows[name] = value
        self.set_measures(None)

    def row(self, name: str) -> FigureLabel:
        return self._rows[name]

    def text(self) -> str:
        """A line for each figure, with all digits."""
        return "\n".join(figure.line() for figure in self._figures)

    def set_measures(self, measures: Measures | None, subject: str = "") -> None:
        """`subject` names what was measured, for parameters."""
        if measures is not None:
            from ...model.measuring.mass_figures import mass_figures

            self._figures = mass_figures(measures)
        else:
            self._figures = ()
        known = {figure.name: figure for figure in self._figures}
        for name, row in self._rows.items():
            row.subject, row.every = subject, self._figures
            if name in known:
                row.set_figures((known[name],), FINE.get(name, 6))
            else:
                open_ = name == "Volume" and measures is not None
                row.set_words(f"{DASH} (the surface is not closed)" if open_ else DASH)
        self.copy_button.setEnabled(bool(known))
