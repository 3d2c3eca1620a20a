"""The table of findings: up and down choose one, Enter zooms to it, F repairs; it is copied as text or CSV."""

from __future__ import annotations

import csv
import io

from PySide6.QtCore import QEvent, QModelIndex, QPoint, Qt, Signal
from PySide6.QtGui import QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QMenu, QTableView, QWidget

from .finding_rows import GAP, KIND, PLACE, SIZE, SOLID, TITLES, FindingModel, FindingRow

WIDTHS = {SOLID: 84, SIZE: 78, GAP: 78}


class FindingTable(QTableView):
    """`chosen` carries the row that is current now, None for none; `zoomed` and `repaired` one that was asked for."""

    chosen = Signal(object)
    zoomed = Signal(object)
    repair_asked = Signal(object)
    hole_asked = Signal(object)
    """The border of a row is to be closed."""
    left = Signal()
    """Escape was pressed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.findings = FindingModel(self)
        self.setModel(self.findings)
        self.setAccessibleName("Findings")
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
        for column in (KIND, PLACE):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        header.setMinimumSectionSize(60)
        for column, width in WIDTHS.items():
            self.setColumnWidth(column, width)
        self.setSortingEnabled(True)
        self.sortByColumn(KIND, Qt.SortOrder.AscendingOrder)
        self.customContextMenuRequested.connect(self._open_menu)
        self.doubleClicked.connect(lambda index: self.zoomed.emit(self.row_at(index)))
        self.selectionModel().currentRowChanged.connect(lambda index, _: self.chosen.emit(self.row_at(index)))
        self.findings.modelReset.connect(lambda: self.chosen.emit(None))

    @property
    def current(self) -> FindingRow | None:
        return self.row_at(self.currentIndex())

    def row_at(self, index: QModelIndex) -> FindingRow | None:
        rows = self.findings.rows
        return rows[index.row()] if index.isValid() and index.row() < len(rows) else None

    def choose_like(self, row: FindingRow | None) -> None:
        """Choose the finding of the same kind at the same place in the same node, without saying so; none if there is
        none."""
        places = self.findings.rows
        found = next((place for place, one in enumerate(places) if row is not None and one.like(row)), -1)
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
            return "\n".join("\t".join(line) for line in (TITLES, *(row.texts() for row in self.findings.rows)))
        written = io.StringIO()
        writer = csv.writer(written, lineterminator="\n")
        writer.writerow(("solid", "fault", "size_mm", "gap_mm", "x", "y", "z"))
        for row in self.findings.rows:
            finding = row.finding
            writer.writerow((row.report.name, row.texts()[KIND], finding.size, finding.gap, *row.place.tolist()))
        return written.getvalue()

    def copy(self, separator: str = "\t") -> None:
        QGuiApplication.clipboard().setText(self.text(separator))

    def _open_menu(self, at: QPoint) -> None:
        row = self.row_at(self.indexAt(at))
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        if row is not None:
            menu.addAction("Zoom to it\tEnter", lambda: self.zoomed.emit(row))
            menu.addAction(f"Repair “{row.report.name}”\tF", lambda: self.repair_asked.emit(row))
            if row.is_hole:
                menu.addAction("Close this hole", lambda: self.hole_asked.emit(row))
            menu.addAction("Copy this row", lambda: QGuiApplication.clipboard().setText("\t".join(row.texts())))
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
            (self.repair_asked if event.key() == Qt.Key.Key_F else self.zoomed).emit(row)

    def _own(self, event: QKeyEvent) -> bool:
        plain = event.modifiers() in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier)
        keys = (Qt.Key.Key_F, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape)
        return (plain and event.key() in keys) or event.matches(QKeySequence.StandardKey.Copy)
