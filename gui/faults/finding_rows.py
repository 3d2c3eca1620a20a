"""The findings of a report as the rows of a table: sorted by any column, filtered by kind."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..panels.property_edit import sentence
from ..panels.row_table import RowModel
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


class FindingModel(RowModel):
    """Of FindingRows, of one kind or of all."""

    titles, tips, figures = TITLES, TIPS, frozenset({SIZE, GAP})

    def __init__(self) -> None:
        super().__init__(KIND)
        self._kind: Kind | None = None

    def set_kind(self, kind: Kind | None) -> None:
        """Show one kind alone, or all with None."""
        if kind != self._kind:
            self._kind = kind
            self.fill()

    def shown(self, row: FindingRow) -> bool:
        return self._kind in (None, row.kind)

    def key(self, column: int) -> Callable[[FindingRow], Any]:
        keys: dict[int, Callable[[FindingRow], Any]] = {
            SOLID: lambda row: row.report.name.casefold(),
            KIND: lambda row: (row.order, -row.finding.size),
            SIZE: lambda row: row.finding.size,
            GAP: lambda row: row.finding.gap,
            PLACE: lambda row: tuple(row.place.tolist()),
        }
        return keys[column]

    def texts(self, row: FindingRow) -> tuple[str, ...]:
        return row.texts()

    def ink(self, row: FindingRow, column: int) -> str:
        if column != KIND:
            return ""
        return colours_now().error if row.finding.kind in SEVERE else colours_now().warning

    def tip(self, row: FindingRow, column: int) -> str:
        return row.about.about if column == KIND else row.texts()[column]
