"""The contacts of a step as rows of a table: which parts, what they are to each other, by how much."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from ...model.proximity.bodies import APART, AROUND, INSIDE, OVERLAPPING, TOUCHING
from ..faults.finding_rows import length
from ..status import figure

if TYPE_CHECKING:
    from ...model.proximity.moving.playing import Played, Touch

KINDS = {
    OVERLAPPING: "Overlap", TOUCHING: "Touch", INSIDE: "Inside", AROUND: "Around", APART: "Too near",
}  # fmt: skip
TITLES = ("Part", "And", "Contact", "By")
KIND, BY = 2, 3


def amount_of(touch: Touch) -> str:
    """How much two parts share, or how far apart they are."""
    if touch.kind == APART:
        return f"{length(touch.gap)} of {figure(touch.asked)} mm"
    return f"{length(touch.overlap)} mm³" if touch.overlap else ""


def words_of(touch: Touch) -> str:
    """A contact as it stands in the picture."""
    return ", ".join(filter(None, (KINDS[touch.kind], amount_of(touch))))


class ContactTable(QTableWidget):
    """`chosen` carries the Touch that is current now, None for none; `zoomed` one that was asked for."""

    chosen = Signal(object)
    zoomed = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, len(TITLES), parent)
        self.touches: tuple[Touch, ...] = ()
        self.setHorizontalHeaderLabels(TITLES)
        self.setAccessibleName("Contacts in this step")
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(24)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        header = self.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setHighlightSections(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(KIND, QHeaderView.ResizeMode.Interactive)
        self.setColumnWidth(KIND, 84)
        self.itemSelectionChanged.connect(lambda: self.chosen.emit(self.current))
        self.itemDoubleClicked.connect(lambda item: self.zoomed.emit(self.touches[item.row()]))

    @property
    def current(self) -> Touch | None:
        rows = self.selectionModel().selectedRows()
        return self.touches[rows[0].row()] if rows and rows[0].row() < len(self.touches) else None

    def show_touches(self, played: Played, touches: tuple[Touch, ...]) -> None:
        """Another step's; the pair that is chosen stays so where it is there, and nothing is told."""
        if touches is self.touches:
            return
        before = self.current
        pair = None if before is None else (before.one, before.other)
        self.touches = touches
        self.blockSignals(True)
        self.clearSelection()
        self.setRowCount(len(touches))
        for row, touch in enumerate(touches):
            texts = (played.names[touch.one], played.names[touch.other], KINDS[touch.kind], amount_of(touch))
            for column, text in enumerate(texts):
                item = self.item(row, column)
                if item is None:
                    item = QTableWidgetItem()
                    self.setItem(row, column, item)
                item.setText(text)
                item.setToolTip(text)
            if (touch.one, touch.other) == pair:
                self.selectRow(row)
        self.blockSignals(False)

    def leave(self) -> None:
        """Choose none."""
        self.clearSelection()
        self.setCurrentIndex(QModelIndex())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        current = self.current
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and current is not None:
            self.zoomed.emit(current)
        elif event.key() == Qt.Key.Key_Escape:
            self.leave()
        else:
            super().keyPressEvent(event)
