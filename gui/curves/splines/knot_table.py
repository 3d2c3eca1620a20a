"""The knots of a B-spline as a table: where, how often, and how smooth the curve is there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

if TYPE_CHECKING:
    from ....model.outline.basis import Basis, Stack

TITLES = ("Knot", "Times", "Smooth")
TIPS = (
    "The parameter; double-click to write another one",
    "How often it stands there; each time takes one from the smoothness",
    "C2: place, direction and curvature go on; C1: place and direction; C0: a corner may be there",
)
ROW, SHOWN = 22, 6  # height of a row, and how many are seen at once


class KnotTable(QTableWidget):
    """A row for each value. `picked` carries a row that was chosen here, `written` a row and its new text, and
    `editor_closed` tells that what stands there is to be shown again."""

    picked = Signal(int)
    written = Signal(int, str)
    editor_closed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, len(TITLES), parent)
        self._filling = False
        self.setAccessibleName("Knots")
        self.setHorizontalHeaderLabels(TITLES)
        self.setShowGrid(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.DoubleClicked | QAbstractItemView.EditTrigger.EditKeyPressed)
        self.setTabKeyNavigation(False)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        for column, tip in enumerate(TIPS):
            item = self.horizontalHeaderItem(column)
            if item is not None:
                item.setToolTip(tip)
                item.setTextAlignment(_side(column))
        self.itemSelectionChanged.connect(self._chosen)
        self.itemChanged.connect(self._changed)

    def show_stacks(self, basis: Basis, texts: list[str], focused: int) -> None:
        """`texts` are the values as the outline tells them, expressions too; `focused` is a row."""
        if self.state() == QAbstractItemView.State.EditingState:
            return
        self._filling = True
        try:
            last = len(basis.stacks) - 1
            self.setRowCount(last + 1)
            for row, (stack, text) in enumerate(zip(basis.stacks, texts, strict=True)):
                for column, words in enumerate(
                    (text, str(len(stack.numbers)), _smooth(basis, stack, row in (0, last)))
                ):
                    item = self.item(row, column)
                    if item is None:
                        item = QTableWidgetItem()
                        item.setTextAlignment(_side(column))
                        if column:
                            item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
                        self.setItem(row, column, item)
                    if item.text() != words:
                        item.setText(words)
            if self.currentRow() != focused or not self.selectedItems():
                self.selectRow(focused)
        finally:
            self._filling = False
        shown = min(max(len(basis.stacks), 3), SHOWN)
        self.setFixedHeight(self.horizontalHeader().sizeHint().height() + shown * ROW + 2 * self.frameWidth())

    def closeEditor(self, editor: QWidget, hint: QAbstractItemDelegate.EndEditHint) -> None:
        super().closeEditor(editor, hint)
        self.editor_closed.emit()

    def _chosen(self) -> None:
        if not self._filling and self.currentRow() >= 0:
            self.picked.emit(self.currentRow())

    def _changed(self, item: QTableWidgetItem) -> None:
        if not self._filling:
            self.written.emit(item.row(), item.text().strip())


def _side(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignLeft if column == 2 else Qt.AlignmentFlag.AlignRight
    return side | Qt.AlignmentFlag.AlignVCenter


def _smooth(basis: Basis, stack: Stack, outermost: bool) -> str:
    if stack.smoothness is None:
        return "end" if stack.value in basis.domain else "outside"
    words = "C0, corner" if stack.smoothness == 0 else f"C{stack.smoothness}"
    return f"{words}, seam" if basis.closed and outermost else words
