"""The list of measurements: a row for each, with its figures, which can be copied and used in expressions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QScrollArea, QToolButton, QVBoxLayout, QWidget

from ..icons import icon
from .figures import FigureLabel, FigureUse

if TYPE_CHECKING:
    from ...model.measuring.measurement import Measurement
    from ..tools.measure import Taken

TITLE_WIDTH = 170


class Row(QFrame):
    """One measurement."""

    chosen = Signal()
    removed = Signal()

    def __init__(self, taken: Taken, use: FigureUse, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("measurement", True)
        found: Measurement = taken.measurement
        self.title = QLabel(found.title, self)
        self.title.setFixedWidth(TITLE_WIDTH)
        self.title.setWordWrap(True)
        self.title.setTextFormat(Qt.TextFormat.PlainText)
        self.figures = FigureLabel(use, named=True, parent=self)
        self.figures.subject = found.title.replace("\u2013", "to")
        self.figures.set_figures(found.figures)
        self.figures.setAccessibleName(found.title)
        for words in (self.title, self.figures):
            words.setContentsMargins(0, 4, 0, 2)
        copy = _button("copy", "Copy this measurement", self)
        copy.clicked.connect(lambda: use.copy(text_of([taken])))
        delete = _button("close", "Take this measurement out of the list", self)
        delete.clicked.connect(self.removed)
        line = QHBoxLayout(self)
        line.setContentsMargins(10, 1, 6, 1)
        line.setSpacing(8)
        for widget in (self.title, self.figures, copy, delete):
            line.addWidget(widget, 1 if widget is self.figures else 0, Qt.AlignmentFlag.AlignTop)

    def set_state(self, current: bool, stale: bool) -> None:
        for name, value in (("current", current), ("stale", stale)):
            if self.property(name) != value:
                self.setProperty(name, value)
                self.style().unpolish(self)
                self.style().polish(self)
        self.title.setEnabled(not stale)
        self.figures.set_faint(stale)
        self.setToolTip("The solid has been changed since this was measured" if stale else "")

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.chosen.emit()
        super().mousePressEvent(event)


class Measurements(QWidget):
    """Shows a list of measurements; what is asked for is done by the tool that holds them."""

    chosen = Signal(object)
    removed = Signal(object)
    cleared = Signal()
    start_asked = Signal()

    def __init__(self, use: FigureUse, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("measurements")
        self._use = use
        self._rows: dict[int, tuple[Taken, Row]] = {}
        self.measure = _button("measure", "<b>Measure</b>&nbsp;&nbsp;Shift+M", self)
        self.copy_all = _button("copy", "Copy all measurements", self)
        self.clear = _button("delete", "Take all measurements out of the list", self)
        self.measure.clicked.connect(self.start_asked)
        self.copy_all.clicked.connect(lambda: use.copy(text_of([taken for taken, _ in self._rows.values()])))
        self.clear.clicked.connect(self.cleared)
        buttons = QVBoxLayout()
        buttons.setContentsMargins(4, 4, 0, 4)
        buttons.setSpacing(2)
        for button in (self.measure, self.copy_all, self.clear):
            buttons.addWidget(button)
        buttons.addStretch(1)
        self.empty = QLabel("Nothing is measured yet. Start with Tools › Measure, then click in the picture.", self)  # noqa: RUF001
        self.empty.setProperty("muted", True)
        self.empty.setContentsMargins(10, 8, 10, 8)
        self.empty.setWordWrap(True)
        inside = QWidget(self)
        self._column = QGridLayout(inside)
        self._column.setContentsMargins(0, 2, 0, 2)
        self._column.setVerticalSpacing(0)
        self._column.addWidget(self.empty, 0, 0)
        self._column.setRowStretch(10_000, 1)
        self.area = QScrollArea(self)
        self.area.setWidgetResizable(True)
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.area.setWidget(inside)
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(0)
        line.addLayout(buttons)
        line.addWidget(self.area, 1)
        self.set_taken((), None)

    def row(self, index: int) -> Row:
        """The row of a measurement, the oldest first."""
        return list(self._rows.values())[index][1]

    def set_taken(self, taken: Sequence[Taken], current: Taken | None) -> None:
        """Bring the list up to date; rows that stay are left alone."""
        wanted = {id(one) for one in taken}
        for key in [key for key in self._rows if key not in wanted]:
            row = self._rows.pop(key)[1]
            self._column.removeWidget(row)
            row.hide()
            row.deleteLater()
        for one in taken:
            if id(one) not in self._rows:
                row = Row(one, self._use, self.area.widget())
                row.chosen.connect(lambda one=one: self.chosen.emit(one))
                row.removed.connect(lambda one=one: self.removed.emit(one))
                self._rows[id(one)] = (one, row)
        for place, one in enumerate(taken):
            row = self._rows[id(one)][1]
            self._column.addWidget(row, place + 1, 0)
            row.set_state(one is current, one.stale)
        self.empty.setVisible(not taken)
        self.copy_all.setEnabled(bool(taken))
        self.clear.setEnabled(bool(taken))
        if current is not None and id(current) in self._rows:
            row = self._rows[id(current)][1]
            QTimer.singleShot(0, row, lambda: self.area.ensureWidgetVisible(row, 0, 4))  # once it has its place


def text_of(taken: Sequence[Taken]) -> str:
    """Titles and figures as lines, all digits."""
    blocks = []
    for one in taken:
        lines = [one.measurement.title, *(figure.line() for figure in one.measurement.figures)]
        blocks.append("\n".join(lines))
    return "\n\n".join(blocks)


def _button(name: str, tip: str, parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setIcon(icon(name))
    button.setToolTip(tip)
    button.setAccessibleName(tip.split("<")[0] or "Measure")
    return button
