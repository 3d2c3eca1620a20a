"""The findings of a report as the rows of a table: sorted by any column, filtered by kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor

from ..panels.property_edit import sentence
from ..status import figure
from ..theme import colours_now
from .checked import SEVERE, Kind, kinds_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ...model.checking.document_faults import NodeFaults
    from ...model.mesh.faults.report import Finding
    from ...model.mesh.faults.words import KindWords

SOLID, KIND, SIZE, GAP, PLACE = range(5)
TITLES = ("Solid", "Fault", "Size, mm", "Gap, mm", "Place, mm")
TIPS = (
    "What it was found in",
    "What is wrong, the worst first",
    "Of what is there: a border, an edge, a face, or what faces share",
    "How near things are, or how high a sliver is",
    "In the world: x, y, z",
)
Index = QModelIndex | QPersistentModelIndex


@dataclass(frozen=True, slots=True, eq=False)
class FindingRow:
    """A finding, and the report that it is from; `place` (3,) is in the world, of drawings too."""

    report: NodeFaults
    finding: Finding
    order: int
    """Of its kind, the worst first."""
    place: NDArray[np.float64]

    @property
    def kind(self) -> Kind:
        return self.report.kind == "outline", self.finding.kind

    @property
    def about(self) -> KindWords:
        return kinds_of(self.report)[self.finding.kind]

    @property
    def title(self) -> str:
        return sentence(self.about.one)

    @property
    def words(self) -> str:
        """What it is and how large, for the picture."""
        size, gap = self.finding.size, self.finding.gap
        if self.kind == (True, "crossing") or not (size or gap):  # two lines that cross have no size there
            return self.title
        told = f"{length(gap)} mm apart" if self.near else f"{length(size)} mm"
        return f"{self.title}, {told}".replace("\u202f", " ")

    @property
    def near(self) -> bool:
        """Whether it is a gap and has no other size."""
        return self.finding.kind.startswith("near")

    @property
    def is_hole(self) -> bool:
        """Whether it is a border of a mesh, which can be closed by itself."""
        return self.report.kind == "mesh" and self.finding.kind == "border"

    def like(self, other: FindingRow) -> bool:
        """Whether it is the same finding in a later report."""
        same = self.report.id == other.report.id and self.kind == other.kind
        return same and bool(np.allclose(self.place, other.place))

    def texts(self) -> tuple[str, ...]:
        """What stands in its columns."""
        finding = self.finding
        gap = length(finding.gap) if finding.gap else ""
        place = ", ".join(figure(value, 5).replace("-", "\u2212") for value in self.place.tolist())
        size = length(finding.size) if finding.size and not self.near else ""
        return self.report.name, self.title, size, gap, place


def length(value: float) -> str:
    """As people read it; of what is tiny two digits."""
    return figure(value, 5) if value >= 0.1 else f"{value:.2g}"


def rows_of(reports: Sequence[NodeFaults]) -> list[FindingRow]:
    """The findings of all reports, the worst kinds first and of each kind the largest."""
    rows = [
        FindingRow(report, finding, list(kinds_of(report)).index(finding.kind), place)
        for report in reports
        if report.faults is not None
        for finding, place in zip(report.faults.findings, report.places(), strict=True)
    ]
    return sorted(rows, key=lambda row: (row.order, -row.finding.size))


class FindingModel(QAbstractTableModel):
    """`rows` are those that are shown, in their order."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._every: list[FindingRow] = []
        self._kind: Kind | None = None
        self._sorted = (KIND, Qt.SortOrder.AscendingOrder)
        self.rows: list[FindingRow] = []

    def set_rows(self, rows: list[FindingRow]) -> None:
        self._every = rows
        self._fill()

    def set_kind(self, kind: Kind | None) -> None:
        """Show one kind alone, or all with None."""
        if kind != self._kind:
            self._kind = kind
            self._fill()

    def _fill(self) -> None:
        column, order = self._sorted
        rows = [row for row in self._every if self._kind in (None, row.kind)]
        keys: dict[int, Any] = {
            SOLID: lambda row: row.report.name.casefold(),
            KIND: lambda row: (row.order, -row.finding.size),
            SIZE: lambda row: row.finding.size,
            GAP: lambda row: row.finding.gap,
            PLACE: lambda row: tuple(row.place.tolist()),
        }
        rows.sort(key=keys[column], reverse=order == Qt.SortOrder.DescendingOrder)
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
        row, column = self.rows[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return row.texts()[column]
        if role == Qt.ItemDataRole.TextAlignmentRole and column in (SIZE, GAP):
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        if role == Qt.ItemDataRole.ForegroundRole and column == KIND:
            return QColor(colours_now().error if row.finding.kind in SEVERE else colours_now().warning)
        if role == Qt.ItemDataRole.ToolTipRole:
            return row.about.about if column == KIND else row.texts()[column]
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return TITLES[section]
        if role == Qt.ItemDataRole.ToolTipRole:
            return TIPS[section]
        if role == Qt.ItemDataRole.TextAlignmentRole and section in (SIZE, GAP):
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        return None

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        if column >= 0:
            self._sorted = (column, order)
            self._fill()
