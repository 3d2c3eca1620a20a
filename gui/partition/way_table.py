"""The way of a point p down a tree, plane by plane: f(p) and the side it lies on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from ..status import figure
from .inks import inks_now

if TYPE_CHECKING:
    from ...model.partition.descent import Step

TITLES = ("Node", "f(p)", "p lies")
SIDES = {"front": "in front (> 0)", "back": "behind (< 0)", "in": "in the plane (= 0)"}


class WayTable(QTableWidget):
    """`chosen` carries the node of a row that the user chose."""

    chosen = Signal(int)

    def __init__(self, unit: str, parent: QWidget | None = None) -> None:
        """`unit` stands behind f(p)."""
        super().__init__(0, len(TITLES), parent)
        self._unit = unit
        self._steps: Sequence[Step] = ()
        self.setAccessibleName("The way of the point p down the tree")
        self.setHorizontalHeaderLabels(TITLES)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(24)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        header = self.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setHighlightSections(False)
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        for column in (0, 1):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.itemSelectionChanged.connect(self._selected)

    def show_way(self, steps: Sequence[Step], names: Sequence[str]) -> None:
        """`names` are of the tree's nodes."""
        self._steps = steps
        self.blockSignals(True)
        self.clearSelection()
        self.setRowCount(len(steps))
        inks = inks_now()
        for row, step in enumerate(steps):
            if step.side:
                unit = f" {self._unit}" if self._unit else ""
                height = figure(step.height, 5).replace("-", "\u2212")
                texts = (names[step.node], f"{height}{unit}", SIDES[step.side])
            else:
                texts = (names[step.node], "", "in this leaf's cell")
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                if column and step.side != "in" and step.side:
                    item.setForeground(QColor(inks.front if step.side == "front" else inks.back))
                item.setToolTip(text)
                self.setItem(row, column, item)
        self.blockSignals(False)

    def _selected(self) -> None:
        rows = self.selectionModel().selectedRows()
        if rows and rows[0].row() < len(self._steps):
            self.chosen.emit(self._steps[rows[0].row()].node)
