"""The followed vertex at each stage of the pipeline, and how the chosen stage comes about."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from ...model.pipeline.explanation import MINUS, Stage, number
from .inks import inks_now
from .matrix_grid import monospaced

TITLES = ("", "x", "y", "z", "w")
ROW = 22  # pixels
PIXEL = "Pixel"
FIRST = 3
"""The row that is chosen at first: clip coordinates, where it is decided what is seen."""


class StageTable(QTableWidget):
    """`chosen` tells that another row is."""

    chosen = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, len(TITLES), parent)
        self.stages: Sequence[Stage] = ()
        self._items: dict[tuple[int, int], QTableWidgetItem] = {}
        self.setAccessibleName("The vertex at each stage")
        self.setHorizontalHeaderLabels(TITLES)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.setShowGrid(False)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setMinimumSectionSize(30)
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        self.itemSelectionChanged.connect(self.chosen)
        self.show_stages(())

    def show_stages(self, stages: Sequence[Stage]) -> None:
        """The rows; the choice stays."""
        self.stages = stages
        self.setVisible(bool(stages))
        if self.rowCount() != len(stages):
            self.setRowCount(len(stages))
            self._items.clear()
            for row in range(len(stages)):
                for column in range(len(TITLES)):
                    item = QTableWidgetItem()
                    if column:
                        item.setFont(monospaced(self.font()))
                        item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                    self.setItem(row, column, item)
                    self._items[row, column] = item
            if stages:
                self.selectRow(FIRST)
            self.setFixedHeight(ROW * len(stages) + self.horizontalHeader().sizeHint().height() + 3)
        ink = QColor(inks_now().ray)
        for row, stage in enumerate(stages):
            texts = [stage.name, *(_text(stage, value) for value in stage.coordinates)]
            for column, text in enumerate(texts + [""] * (len(TITLES) - len(texts))):
                item = self._items[row, column]
                if item.text() != text:
                    item.setText(text)
                if stage.name == PIXEL and item.foreground().color() != ink:
                    item.setForeground(ink)
                item.setToolTip(stage.words)

    @property
    def place(self) -> int:
        """The chosen row, -1 for none."""
        rows = self.selectionModel().selectedRows()
        return rows[0].row() if rows else -1

    def words(self) -> str:
        """What the chosen row is, with its formulas; of none what there is to see."""
        if not 0 <= self.place < len(self.stages):
            return "Choose a stage to see how its numbers come about."
        stage = self.stages[self.place]
        formulas = "<br>".join(f"<code>{escape(formula)}</code>" for formula in stage.formulas)
        return f"<b>{stage.name}</b>: {escape(stage.words)}." + (f"<br>{formulas}" if formulas else "")


def _text(stage: Stage, value: float) -> str:
    """Pixels to a hundredth, other numbers to five digits."""
    if stage.name == PIXEL and 1.5 < abs(value) < 1e6:
        return f"{value:.2f}".replace("-", MINUS)
    return number(value)
