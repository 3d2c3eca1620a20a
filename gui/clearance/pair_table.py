"""The pairs of a report as a table, the worst first, and what can be asked of one by keys and by its menu."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QObject, QPersistentModelIndex, QPoint, Qt, Signal
from PySide6.QtGui import QColor, QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QMenu, QTableView, QWidget

from ...model.proximity.findings import NEAR, OVERLAP
from ...model.proximity.words import finding_words, length_text, volume_text
from ..theme import colours_now

if TYPE_CHECKING:
    from ...model.proximity.findings import Finding

ONE, OTHER, FAULT, MEASURE, ASKED = range(5)
TITLES = ("Solid", "And", "Fault", "Gap or overlap", "Asked")
TIPS = ("", "", "What is wrong, the worst first", "The least way between them, or what they share", "What was to hold")
Index = QModelIndex | QPersistentModelIndex


def fault_text(finding: Finding) -> str:
    """What is wrong, in a word or three."""
    if finding.fault == OVERLAP:
        return "The same body" if finding.coincident else "One inside the other" if finding.nested else "Overlap"
    if finding.fault == NEAR:
        return "Contact" if finding.gap == 0.0 else "Too near"
    return "Apart"


def texts_of(finding: Finding) -> tuple[str, ...]:
    """What stands in its columns."""
    measure = volume_text(finding.overlap or 0.0) if finding.fault == OVERLAP else length_text(finding.gap)
    asked = "to touch" if finding.touching else length_text(finding.asked) if finding.asked else "no overlap"
    return *finding.names, fault_text(finding), measure, asked


class PairModel(QAbstractTableModel):
    """`rows` are findings, in their order."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._every: Sequence[Finding] = ()
        self._sorted = (FAULT, Qt.SortOrder.AscendingOrder)
        self.rows: list[Finding] = []

    def set_rows(self, findings: Sequence[Finding]) -> None:
        self._every = findings
        self._fill()

    def _fill(self) -> None:
        column, order = self._sorted
        places = {id(finding): place for place, finding in enumerate(self._every)}
        keys: dict[int, Any] = {
            ONE: lambda finding: finding.names[0].casefold(),
            OTHER: lambda finding: finding.names[1].casefold(),
            FAULT: lambda finding: places[id(finding)],
            MEASURE: lambda finding: (finding.gap, -(finding.overlap or 0.0)),
            ASKED: lambda finding: (finding.touching, finding.asked),
        }
        rows = sorted(self._every, key=keys[column], reverse=order == Qt.SortOrder.DescendingOrder)
        self.beginResetModel()
        self.rows = rows
        self.endResetModel()

    # What Qt asks for.

    def rowCount(self, parent: Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(TITLES)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if not index.isValid() or index.row() >= len(self.rows):
            return None
        finding, column = self.rows[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return texts_of(finding)[column]
        if role == Qt.ItemDataRole.TextAlignmentRole and column in (MEASURE, ASKED):
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        if role == Qt.ItemDataRole.ForegroundRole and column == FAULT:
            return QColor(colours_now().error if finding.fault == OVERLAP else colours_now().warning)
        if role == Qt.ItemDataRole.ToolTipRole:
            return finding_words(finding)
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return TITLES[section]
        if role == Qt.ItemDataRole.ToolTipRole:
            return TIPS[section] or None
        if role == Qt.ItemDataRole.TextAlignmentRole and section in (MEASURE, ASKED):
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        return None

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        if column >= 0:
            self._sorted = (column, order)
            self._fill()


class PairTable(QTableView):
    """`chosen` carries the finding that is current now, None for none; the others one that something is asked for."""

    chosen = Signal(object)
    zoomed = Signal(object)
    touching_asked = Signal(object)
    clearance_asked = Signal(object)
    rule_dropped = Signal(object)
    selection_asked = Signal(object)
    isolation_asked = Signal(object)
    left = Signal()
    """Escape was pressed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.pairs = PairModel(self)
        self.ruled: frozenset[tuple[str, str]] = frozenset()
        """The pairs, by their ids in order, that have a rule of their own."""
        self.setModel(self.pairs)
        self.setAccessibleName("Pairs of solids")
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(24)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        header = self.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setHighlightSections(False)
        header.setMinimumSectionSize(70)
        for column in (ONE, OTHER, FAULT):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        self.setColumnWidth(MEASURE, 130)
        self.setColumnWidth(ASKED, 90)
        self.setSortingEnabled(True)
        self.sortByColumn(FAULT, Qt.SortOrder.AscendingOrder)
        self.customContextMenuRequested.connect(self._open_menu)
        self.doubleClicked.connect(lambda index: self.zoomed.emit(self.row_at(index)))
        self.selectionModel().currentRowChanged.connect(lambda index, _: self.chosen.emit(self.row_at(index)))
        self.pairs.modelReset.connect(lambda: self.chosen.emit(None))

    @property
    def current(self) -> Finding | None:
        return self.row_at(self.currentIndex())

    def row_at(self, index: QModelIndex) -> Finding | None:
        rows = self.pairs.rows
        return rows[index.row()] if index.isValid() and index.row() < len(rows) else None

    def choose_like(self, finding: Finding | None) -> None:
        """Choose the finding of the same pair, without saying so; none if there is none."""
        rows = self.pairs.rows
        found = next((n for n, one in enumerate(rows) if finding is not None and set(one.ids) == set(finding.ids)), -1)
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
        """All rows below their titles; as CSV with a comma."""
        if separator == "\t":
            return "\n".join("\t".join(line) for line in (TITLES, *(texts_of(row) for row in self.pairs.rows)))
        written = io.StringIO()
        writer = csv.writer(written, lineterminator="\n")
        writer.writerow(("a", "b", "fault", "gap_mm", "overlap_mm3", "asked_mm"))
        for row in self.pairs.rows:
            writer.writerow((*row.names, fault_text(row), row.gap, row.overlap or 0.0, row.asked))
        return written.getvalue()

    def copy(self, separator: str = "\t") -> None:
        QGuiApplication.clipboard().setText(self.text(separator))

    def _open_menu(self, at: QPoint) -> None:
        row = self.row_at(self.indexAt(at))
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        if row is not None:
            menu.addAction("Zoom to it\tEnter", lambda: self.zoomed.emit(row))
            menu.addAction("Select both\tS", lambda: self.selection_asked.emit(row))
            menu.addAction("Show these two alone\tI", lambda: self.isolation_asked.emit(row))
            menu.addSeparator()
            if row.touching:
                menu.addAction("Not meant to touch", lambda: self.rule_dropped.emit(row))
            else:
                menu.addAction("Meant to touch\tT", lambda: self.touching_asked.emit(row))
            menu.addAction("Clearance of this pair …\tC", lambda: self.clearance_asked.emit(row))
            if not row.touching and tuple(sorted(row.ids)) in self.ruled:
                menu.addAction("As all others", lambda: self.rule_dropped.emit(row))
            menu.addSeparator()
            menu.addAction("Copy this row", lambda: QGuiApplication.clipboard().setText("\t".join(texts_of(row))))
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
        asked = {Qt.Key.Key_T: self.touching_asked, Qt.Key.Key_C: self.clearance_asked,
                 Qt.Key.Key_S: self.selection_asked, Qt.Key.Key_I: self.isolation_asked}  # fmt: skip
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy()
        elif not self._own(event):
            super().keyPressEvent(event)
        elif event.key() == Qt.Key.Key_Escape:
            self.left.emit()
        elif row is not None:
            asked.get(Qt.Key(event.key()), self.zoomed).emit(row)

    def _own(self, event: QKeyEvent) -> bool:
        plain = event.modifiers() in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier)
        keys = (Qt.Key.Key_T, Qt.Key.Key_C, Qt.Key.Key_S, Qt.Key.Key_I, Qt.Key.Key_Return, Qt.Key.Key_Enter,
                Qt.Key.Key_Escape)  # fmt: skip
        return (plain and event.key() in keys) or event.matches(QKeySequence.StandardKey.Copy)
