"""A matrix of four rows as numbers that can be edited, with words on each entry."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QFont, QFontDatabase, QMouseEvent
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.document.expression import Expression
from ...model.document.expression import number as number_from
from ...model.pipeline.explanation import MINUS, number
from ...model.pipeline.stages import Floats
from ..theme import colours_now

ROW = 23  # pixels


class MatrixGrid(QTableWidget):
    """`edited` carries the whole matrix (4, 4) with the entry that was typed; `refused` why one cannot be read;
    `pointed` row and column of the entry under the pointer or the cursor, (-1, -1) for none."""

    edited = Signal(object)
    refused = Signal(str)
    pointed = Signal(int, int)

    def __init__(self, title: str, parent: QWidget | None = None) -> None:
        super().__init__(4, 4, parent)
        self.setAccessibleName(f"{title} matrix")
        self.setProperty("matrix", True)
        self.setFont(monospaced(self.font()))
        self.horizontalHeader().hide()
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.horizontalHeader().setMinimumSectionSize(40)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFixedHeight(4 * ROW + 2)
        self.setMouseTracking(True)
        self.setWordWrap(False)
        self.matrix: Floats = np.eye(4)
        self._filling = False
        self._waiting: tuple[Floats, bool, Callable[[int, int], str]] | None = None
        """What is to be shown when an entry is no longer being typed."""
        self._items: dict[tuple[int, int], QTableWidgetItem] = {}
        for row in range(4):
            for column in range(4):
                item = QTableWidgetItem()
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                self.setItem(row, column, item)
                self._items[row, column] = item
        self.itemChanged.connect(self._typed)
        self.currentCellChanged.connect(lambda row, column, *_: self.pointed.emit(row, column))

    def show_matrix(self, matrix: Floats, changed: bool, words: Callable[[int, int], str]) -> None:
        """Show numbers, marked where they are `changed` here; `words` explains an entry."""
        if self.state() == QAbstractItemView.State.EditingState:
            self._waiting = matrix, changed, words
            return
        self._waiting = None
        self.matrix = matrix
        self._filling = True
        font = monospaced(self.font())
        font.setBold(changed)
        ink = QColor(colours_now().link if changed else colours_now().text)
        for (row, column), item in self._items.items():
            text = number(float(matrix[row, column]))
            if item.text() != text:
                item.setText(text)
            if item.font() != font or item.foreground().color() != ink:
                item.setFont(font)
                item.setForeground(ink)
            item.setToolTip(words(row, column))
        self._filling = False

    def _typed(self, item: QTableWidgetItem) -> None:
        if self._filling:
            return
        row, column = item.row(), item.column()
        old = number(float(self.matrix[row, column]))
        text = item.text().strip()
        if text == old:
            return
        try:
            read = number_from(text.replace(MINUS, "-"), "the entry")
            value = read.evaluate({}) if isinstance(read, Expression) else float(read)
        except Refusal as refusal:
            self._put_back(item, old)
            self.refused.emit(str(refusal))
            return
        matrix = self.matrix.copy()
        matrix[row, column] = value
        self._put_back(item, old)  # until it has been taken, which is when the editor has gone
        QTimer.singleShot(0, self, lambda: self.edited.emit(matrix))

    def closeEditor(self, editor: QWidget, hint: QAbstractItemDelegate.EndEditHint) -> None:
        super().closeEditor(editor, hint)
        if self._waiting is not None:
            self.show_matrix(*self._waiting)

    def _put_back(self, item: QTableWidgetItem, text: str) -> None:
        self._filling = True
        item.setText(text)
        self._filling = False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        index = self.indexAt(event.position().toPoint())
        self.pointed.emit(index.row(), index.column())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.pointed.emit(self.currentRow(), self.currentColumn())


def monospaced(beside: QFont) -> QFont:
    """The system's font of equal widths, as large as another one."""
    font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    font.setPointSizeF(beside.pointSizeF())
    return font
