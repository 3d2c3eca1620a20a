"""A table of a mesh's elements: rows of arrays, as many as there are, sorted and picked out without copies of cells."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    Qt,
    Signal,
)
from PySide6.QtGui import QKeyEvent, QKeySequence, QMouseEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from ...model.mesh.tables import Table

Index = QModelIndex | QPersistentModelIndex
ROOT = QModelIndex()
ROWS = 24  # pixels
MOST_RUNS = 2_000
"""Runs of rows that are marked as selected; more than that would take longer than anybody wants to wait."""
OWN = (QKeySequence.StandardKey.Copy, QKeySequence.StandardKey.SelectAll)
"""Of rows where a table has the focus, not of nodes."""
SAMPLE = 60  # rows that columns are made wide enough for
WIDEST = 260  # pixels


class ElementModel(QAbstractTableModel):
    """`listed` (r,) are the elements in the order of the rows."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.table: Table | None = None
        self.first = 0
        self.listed: NDArray[np.int64] = np.zeros(0, np.int64)
        self._wanted: NDArray[np.int64] | None = None
        self._sorted = (-1, Qt.SortOrder.AscendingOrder)
        self._row_of: NDArray[np.int64] | None = None

    def show(self, table: Table | None, wanted: NDArray[np.int64] | None = None) -> None:
        """Another table; `wanted` are the elements that are listed, all by default."""
        self.beginResetModel()
        self.table = table
        self._list(wanted)
        self.endResetModel()

    def pick_out(self, wanted: NDArray[np.int64] | None) -> None:
        """List these elements alone, all for None."""
        self.beginResetModel()
        self._list(wanted)
        self.endResetModel()

    def set_first(self, first: int) -> None:
        """What numbers count from."""
        self.first = first
        self.beginResetModel()
        self.endResetModel()

    def rows_of(self, elements: NDArray[np.int64]) -> NDArray[np.int64]:
        """(k,) the rows of elements (k,), -1 where one is not listed."""
        if self.table is None or not len(elements):
            return np.full(len(elements), -1)
        if self._row_of is None:
            self._row_of = np.full(self.table.count, -1)
            self._row_of[self.listed] = np.arange(len(self.listed))
        return self._row_of[elements]

    def _list(self, wanted: NDArray[np.int64] | None) -> None:
        self._wanted, self._row_of = wanted, None
        if self.table is None:
            self.listed = np.zeros(0, np.int64)
            return
        members = np.arange(self.table.count) if wanted is None else wanted
        column, order = self._sorted
        if 0 < column < len(self.table.columns):
            key = self.table.columns[column].key[members]
            place = np.argsort(key, kind="stable")
            members = members[place]
        self.listed = members[::-1] if column >= 0 and order == Qt.SortOrder.DescendingOrder else members

    # What views ask.

    def rowCount(self, parent: Index = ROOT) -> int:
        return 0 if parent.isValid() else len(self.listed)

    def columnCount(self, parent: Index = ROOT) -> int:
        return 0 if parent.isValid() or self.table is None else len(self.table.columns)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if self.table is None or not index.isValid():
            return None
        column = self.table.columns[index.column()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            return column.text(int(self.listed[index.row()]), self.first, False).replace("-", "\u2212")
        if role == Qt.ItemDataRole.TextAlignmentRole:
            side = Qt.AlignmentFlag.AlignRight if column.right else Qt.AlignmentFlag.AlignLeft
            return side | Qt.AlignmentFlag.AlignVCenter
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if self.table is None or orientation != Qt.Orientation.Horizontal or section >= len(self.table.columns):
            return None
        column = self.table.columns[section]
        if role == Qt.ItemDataRole.DisplayRole:
            return column.title
        if role == Qt.ItemDataRole.ToolTipRole:
            return column.tip
        if role == Qt.ItemDataRole.TextAlignmentRole:
            side = Qt.AlignmentFlag.AlignRight if column.right else Qt.AlignmentFlag.AlignLeft
            return side | Qt.AlignmentFlag.AlignVCenter
        return None

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        if (column, order) != self._sorted:
            self._sorted = column, order
            self.pick_out(self._wanted)


class ElementView(QTableView):
    """`chosen` carries the elements that the user chose, as an array, and the one of the current row; `looked_for` one
    to look at closely; `copy_asked` that the rows are wanted in the clipboard."""

    chosen = Signal(object, int)
    looked_for = Signal(int)
    copy_asked = Signal()

    def __init__(self, name: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.elements = ElementModel(self)
        self.setModel(self.elements)
        self.verticalHeader().hide()
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.verticalHeader().setDefaultSectionSize(ROWS)
        self.verticalHeader().setMinimumSectionSize(ROWS)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setMinimumSectionSize(30)
        header.setSortIndicator(0, Qt.SortOrder.AscendingOrder)
        self.setSortingEnabled(True)
        self._following = False
        self.elements.modelReset.connect(self._after_reset)
        self.selectionModel().selectionChanged.connect(self._selected)
        self.doubleClicked.connect(lambda index: self.looked_for.emit(int(self.elements.listed[index.row()])))
        self._marked: tuple[NDArray[np.int64], int] = (np.zeros(0, np.int64), -1)

    def show_table(self, table: Table | None, wanted: NDArray[np.int64] | None = None) -> None:
        """Show a table from its first row on, columns as wide as the first rows need."""
        fresh = self.elements.table is None or table is None or self.elements.table.titles != table.titles
        self.elements.show(table, wanted)
        if fresh and table is not None:
            self._fit_columns()

    def mark(self, numbers: NDArray[np.int64], current: int) -> None:
        """Show which elements are chosen, and scroll to the current one."""
        self._marked = numbers, current
        model = self.elements
        found = model.rows_of(numbers)
        rows = np.sort(found[found >= 0])
        breaks = np.flatnonzero(np.diff(rows) != 1) + 1
        begins = np.concatenate(([0], breaks)) if len(rows) else breaks
        ends = np.append(breaks, len(rows)) if len(rows) else breaks
        selection = QItemSelection()
        if len(begins) <= MOST_RUNS:
            last = model.columnCount() - 1
            for begin, end in zip(rows[begins].tolist(), rows[ends - 1].tolist(), strict=True):
                selection.select(model.index(begin, 0), model.index(end, last))
        self._following = True
        self.selectionModel().select(selection, QItemSelectionModel.SelectionFlag.ClearAndSelect)
        row = int(model.rows_of(np.array([current]))[0]) if current >= 0 else -1
        if row < 0 and len(rows):
            row = int(rows[0])
        if row >= 0 and len(numbers):
            index = model.index(row, max(self.currentIndex().column(), 0))
            self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
            self.scrollTo(index)
        self._following = False

    def event(self, event: QEvent) -> bool:
        keys = event if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) else None
        if keys is not None and any(keys.matches(own) for own in OWN):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy_asked.emit()
        else:
            super().keyPressEvent(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        super().mousePressEvent(event)
        if not self.indexAt(event.position().toPoint()).isValid():
            self.clearSelection()

    def _selected(self) -> None:
        if self._following:
            return
        rows = [np.arange(run.top(), run.bottom() + 1) for run in self.selectionModel().selection().toList()]
        picked = self.elements.listed[np.unique(np.concatenate(rows))] if rows else np.zeros(0, np.int64)
        row = self.currentIndex().row()
        current = int(self.elements.listed[row]) if 0 <= row < len(self.elements.listed) else -1
        self.chosen.emit(picked, current if len(picked) and current in picked else -1)

    def _after_reset(self) -> None:
        self.mark(*self._marked)

    def _fit_columns(self) -> None:
        model, header, metrics = self.elements, self.horizontalHeader(), self.fontMetrics()
        for column in range(model.columnCount()):
            title = str(model.headerData(column, Qt.Orientation.Horizontal))
            texts = [str(model.index(row, column).data()) for row in range(min(SAMPLE, model.rowCount()))]
            widest = max([metrics.horizontalAdvance(text) for text in texts] + [metrics.horizontalAdvance(title) + 14])
            header.resizeSection(column, min(widest + 24, WIDEST))
