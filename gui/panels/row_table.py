"""A table of things that are found: sorted by any column, chosen one at a time, asked of by keys, copied as text."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QPoint,
    Qt,
    Signal,
    SignalInstance,
)
from PySide6.QtGui import QColor, QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QMenu, QTableView, QWidget

Index = QModelIndex | QPersistentModelIndex
ROW = 24  # pixels


class RowModel(QAbstractTableModel):
    """`rows` are those that are shown, in their order. Sub-classes say what stands in the columns."""

    titles: ClassVar[tuple[str, ...]] = ()
    tips: ClassVar[tuple[str, ...]] = ()
    """Of the titles; "" for none."""
    figures: ClassVar[frozenset[int]] = frozenset()
    """The columns that stand to the right."""

    def __init__(self, column: int, parent: QObject | None = None) -> None:
        """Sorted by a column at first."""
        super().__init__(parent)
        self._every: Sequence[Any] = ()
        self._sorted = (column, Qt.SortOrder.AscendingOrder)
        self.rows: list[Any] = []

    def set_rows(self, rows: Sequence[Any]) -> None:
        self._every = rows
        self.fill()

    def fill(self) -> None:
        """Show what is to be shown of all rows."""
        column, order = self._sorted
        rows = [row for row in self._every if self.shown(row)]
        rows.sort(key=self.key(column), reverse=order == Qt.SortOrder.DescendingOrder)
        self.beginResetModel()
        self.rows = rows
        self.endResetModel()

    # What a row is.

    def shown(self, row: Any) -> bool:
        return True

    def key(self, column: int) -> Callable[[Any], Any]:
        """What a column is sorted by."""
        raise AssertionError(type(self).__name__)

    def texts(self, row: Any) -> tuple[str, ...]:
        """What stands in its columns."""
        raise AssertionError(type(self).__name__)

    def ink(self, row: Any, column: int) -> str:
        """A colour, "" for the usual one."""
        return ""

    def tip(self, row: Any, column: int) -> str:
        return self.texts(row)[column]

    # What Qt asks for.

    def rowCount(self, parent: Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.titles)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if not index.isValid() or index.row() >= len(self.rows):
            return None
        row, column = self.rows[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return self.texts(row)[column]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self._side(column)
        if role == Qt.ItemDataRole.ForegroundRole:
            ink = self.ink(row, column)
            return QColor(ink) if ink else None
        if role == Qt.ItemDataRole.ToolTipRole:
            return self.tip(row, column)
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self.titles[section]
        if role == Qt.ItemDataRole.ToolTipRole:
            return self.tips[section] or None
        return self._side(section) if role == Qt.ItemDataRole.TextAlignmentRole else None

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        if column >= 0:
            self._sorted = (column, order)
            self.fill()

    def _side(self, column: int) -> Any:
        return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter if column in self.figures else None


class RowTable(QTableView):
    """`chosen` carries the row that is current now, None for none; `zoomed` one that was asked for by Enter or a double
    click. Sub-classes have more in `keys`."""

    chosen = Signal(object)
    zoomed = Signal(object)
    left = Signal()
    """Escape was pressed."""

    def __init__(self, model: RowModel, name: str, wide: Sequence[int], column: int, parent: QWidget | None) -> None:
        """Called `name`, with `wide` columns that share the room, sorted by a `column` at first."""
        super().__init__(parent)
        model.setParent(self)
        self.listed = model
        self.setModel(model)
        self.setAccessibleName(name)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        header = self.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setHighlightSections(False)
        header.setMinimumSectionSize(60)
        for number in wide:
            header.setSectionResizeMode(number, QHeaderView.ResizeMode.Stretch)
        self.setSortingEnabled(True)
        self.sortByColumn(column, Qt.SortOrder.AscendingOrder)
        self.customContextMenuRequested.connect(self._open_menu)
        self.doubleClicked.connect(lambda index: self.zoomed.emit(self.row_at(index)))
        self.selectionModel().currentRowChanged.connect(lambda index, _: self.chosen.emit(self.row_at(index)))
        model.modelReset.connect(lambda: self.chosen.emit(None))

    # What sub-classes say.

    @property
    def keys(self) -> Mapping[Qt.Key, SignalInstance]:
        """What letters ask of the current row."""
        return {}

    def same(self, row: Any, other: Any) -> bool:
        """Whether it is the same thing in a later list."""
        raise AssertionError(type(self).__name__)

    def table(self) -> tuple[tuple[str, ...], list[tuple[object, ...]]]:
        """Titles and rows of a CSV file."""
        raise AssertionError(type(self).__name__)

    def add_actions(self, menu: QMenu, row: Any) -> None:
        """What else the menu of a row has."""

    # The rows.

    @property
    def current(self) -> Any:
        return self.row_at(self.currentIndex())

    def row_at(self, index: QModelIndex) -> Any:
        rows = self.listed.rows
        return rows[index.row()] if index.isValid() and index.row() < len(rows) else None

    def choose_like(self, row: Any) -> None:
        """Choose the same thing as `row` is, without saying so; none if there is none."""
        found = -1
        if row is not None:
            found = next((place for place, one in enumerate(self.listed.rows) if self.same(one, row)), -1)
        self.selectionModel().blockSignals(True)
        if found < 0:
            self.setCurrentIndex(QModelIndex())
        else:
            self.selectRow(found)
        self.selectionModel().blockSignals(False)
        self.viewport().update()

    def leave(self) -> None:
        """Choose none."""
        self.clearSelection()
        self.setCurrentIndex(QModelIndex())

    def text(self, separator: str = "\t") -> str:
        """All rows that are shown, below their titles; as CSV with a comma."""
        if separator == "\t":
            lines = (self.listed.titles, *(self.listed.texts(row) for row in self.listed.rows))
            return "\n".join("\t".join(line) for line in lines)
        written = io.StringIO()
        titles, rows = self.table()
        csv.writer(written, lineterminator="\n").writerows((titles, *rows))
        return written.getvalue()

    def copy(self, separator: str = "\t") -> None:
        QGuiApplication.clipboard().setText(self.text(separator))

    def _open_menu(self, at: QPoint) -> None:
        row = self.row_at(self.indexAt(at))
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        if row is not None:
            texts = "\t".join(self.listed.texts(row))
            menu.addAction("Zoom to it\tEnter", lambda: self.zoomed.emit(row))
            self.add_actions(menu, row)
            menu.addAction("Copy this row", lambda: QGuiApplication.clipboard().setText(texts))
            menu.addSeparator()
        menu.addAction("Copy as text", self.copy)
        menu.addAction("Copy as CSV", lambda: self.copy(","))
        menu.popup(self.viewport().mapToGlobal(at))

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and self._own(event):
            event.accept()  # the window's shortcut with this key would take it
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        row = self.current
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy()
        elif not self._own(event):
            super().keyPressEvent(event)
        elif event.key() == Qt.Key.Key_Escape:
            self.left.emit()
        elif row is not None:
            self.keys.get(Qt.Key(event.key()), self.zoomed).emit(row)

    def _own(self, event: QKeyEvent) -> bool:
        plain = event.modifiers() in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier)
        keys = (*self.keys, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape)
        return (plain and event.key() in keys) or event.matches(QKeySequence.StandardKey.Copy)
