"""The table of findings: up and down choose one, Enter zooms to it, F repairs; it is copied as text or CSV."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal, SignalInstance
from PySide6.QtWidgets import QMenu, QWidget

from ..panels.row_table import RowTable
from .finding_rows import GAP, KIND, PLACE, SIZE, SOLID, FindingModel, FindingRow

WIDTHS = {SOLID: 84, SIZE: 78, GAP: 78}


class FindingTable(RowTable):
    """The signals carry a row that something is asked for."""

    repair_asked = Signal(object)
    hole_asked = Signal(object)
    """The border of a row is to be closed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        model = FindingModel()
        super().__init__(model, "Findings", (KIND, PLACE), KIND, parent)
        self.findings = model
        for column, width in WIDTHS.items():
            self.setColumnWidth(column, width)

    @property
    def keys(self) -> Mapping[Qt.Key, SignalInstance]:
        return {Qt.Key.Key_F: self.repair_asked}

    def same(self, row: FindingRow, other: FindingRow) -> bool:
        return row.like(other)

    def table(self) -> tuple[tuple[str, ...], list[tuple[object, ...]]]:
        rows = [
            (row.report.name, row.texts()[KIND], row.finding.size, row.finding.gap, *row.place.tolist())
            for row in self.findings.rows
        ]
        return ("solid", "fault", "size_mm", "gap_mm", "x", "y", "z"), rows

    def add_actions(self, menu: QMenu, row: FindingRow) -> None:
        menu.addAction(f"Repair “{row.report.name}”\tF", lambda: self.repair_asked.emit(row))
        if row.is_hole:
            menu.addAction("Close this hole", lambda: self.hole_asked.emit(row))
