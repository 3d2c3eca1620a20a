"""The pairs of a report as a table, the worst first, and what can be asked of one by keys and by its menu."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Qt, Signal, SignalInstance
from PySide6.QtWidgets import QMenu, QWidget

from ...model.proximity.findings import NEAR, OVERLAP
from ...model.proximity.words import finding_words, length_text, volume_text
from ..panels.row_table import RowModel, RowTable
from ..theme import colours_now

if TYPE_CHECKING:
    from ...model.proximity.findings import Finding

ONE, OTHER, FAULT, MEASURE, ASKED = range(5)
TITLES = ("Solid", "And", "Fault", "Gap or overlap", "Asked")
TIPS = ("", "", "What is wrong, the worst first", "The least way between them, or what they share", "What was to hold")


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


class PairModel(RowModel):
    """Of findings."""

    titles, tips, figures = TITLES, TIPS, frozenset({MEASURE, ASKED})

    def __init__(self) -> None:
        super().__init__(FAULT)
        self._places: dict[int, int] = {}

    def set_rows(self, rows: Sequence[Finding]) -> None:
        self._places = {id(finding): place for place, finding in enumerate(rows)}
        super().set_rows(rows)

    def key(self, column: int) -> Callable[[Finding], Any]:
        keys: dict[int, Callable[[Finding], Any]] = {
            ONE: lambda finding: finding.names[0].casefold(),
            OTHER: lambda finding: finding.names[1].casefold(),
            FAULT: lambda finding: self._places[id(finding)],
            MEASURE: lambda finding: (finding.gap, -(finding.overlap or 0.0)),
            ASKED: lambda finding: (finding.touching, finding.asked),
        }
        return keys[column]

    def texts(self, row: Finding) -> tuple[str, ...]:
        return texts_of(row)

    def ink(self, row: Finding, column: int) -> str:
        if column != FAULT:
            return ""
        return colours_now().error if row.fault == OVERLAP else colours_now().warning

    def tip(self, row: Finding, column: int) -> str:
        return finding_words(row)


class PairTable(RowTable):
    """Of findings; the signals carry one that something is asked for."""

    touching_asked = Signal(object)
    clearance_asked = Signal(object)
    rule_dropped = Signal(object)
    selection_asked = Signal(object)
    isolation_asked = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(PairModel(), "Pairs of solids", (ONE, OTHER, FAULT), FAULT, parent)
        self.ruled: frozenset[tuple[str, str]] = frozenset()
        """The pairs, by their ids in order, that have a rule of their own."""
        self.setColumnWidth(MEASURE, 130)
        self.setColumnWidth(ASKED, 90)

    @property
    def keys(self) -> Mapping[Qt.Key, SignalInstance]:
        return {
            Qt.Key.Key_T: self.touching_asked,
            Qt.Key.Key_C: self.clearance_asked,
            Qt.Key.Key_S: self.selection_asked,
            Qt.Key.Key_I: self.isolation_asked,
        }

    def same(self, row: Finding, other: Finding) -> bool:
        return set(row.ids) == set(other.ids)

    def table(self) -> tuple[tuple[str, ...], list[tuple[object, ...]]]:
        titles = ("a", "b", "fault", "gap_mm", "overlap_mm3", "asked_mm")
        return titles, [(*r.names, fault_text(r), r.gap, r.overlap or 0.0, r.asked) for r in self.listed.rows]

    def add_actions(self, menu: QMenu, row: Finding) -> None:
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
