"""The widgets of the Faults panel: what is checked, the report in words, the table of findings, and repairs."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QSizePolicy,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
    QWidgetAction,
)

from ...model.document.errors import Refusal
from ...model.mesh.faults.words import REPAIRS
from ...model.operations.curves.mending import REPAIRS as OUTLINE_REPAIRS
from ..icons import icon
from ..panels.number_field import NumberField, Steps
from ..panels.property_edit import sentence
from ..panels.work_row import WorkRow
from .checked import Kind, counts_by_kind
from .checks import millimetres_from
from .finding_rows import GAP, SOLID, rows_of
from .finding_table import FindingTable
from .report_view import ReportView

if TYPE_CHECKING:
    from ...model.checking.document_faults import NodeFaults

TITLES = {
    "weld": "Weld", "duplicates": "Drop duplicates", "slivers": "Drop slivers", "orient": "Turn faces",
    "holes": "Close holes",
}  # fmt: skip
CUT = ("cut", "weld")
ALL = tuple(REPAIRS)
TOLERANCE_TIP = "How near things may be without being joined, and how high a face must be to be no sliver, in mm"
LONGEST_TIP = "The longest border that is closed, in mm; empty: any"
EMPTY = (
    "Nothing has been checked yet. A check finds open borders, faces that run into each other, turned, doubled and "
    "thin faces of meshes, and ends of drawings that nearly meet; each can be zoomed to and repaired."
)
NOTHING = "There is nothing visible to check. Import a mesh or a drawing (Ctrl+Shift+O), or make a solid."


class FaultsPage(QWidget):
    """What it shows and does is the panel's. `repair_asked` carries names of repairs."""

    check_asked = Signal()
    cancel_asked = Signal()
    tolerance_typed = Signal(str)
    tolerance_stepped = Signal(float)
    repair_asked = Signal(tuple)
    hole_asked = Signal()
    """The border that is chosen is to be closed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.check = self._button("evaluate", "Check", "Look for faults in what is selected, or in all that is visible")
        self.check.clicked.connect(self.check_asked)
        self.tolerance = NumberField(Steps(0.001, 0.0001, 0.01, minimum=0.0, above=True), self)
        self.tolerance.setFixedWidth(64)
        self.tolerance.setAccessibleName("Tolerance in mm")
        self.tolerance.setToolTip(TOLERANCE_TIP)
        self.tolerance.typed.connect(self.tolerance_typed)
        self.tolerance.stepping.connect(self.tolerance_stepped)
        self.kind = QComboBox(self)
        self.kind.setAccessibleName("Kind of fault")
        self.kind.setToolTip("Which findings are listed")
        self.kind.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.kind.setMinimumContentsLength(14)
        self.kind.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.kind.setMaximumWidth(280)
        self.repair = self._button("repair", "Repair", "")
        self.repair.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.copy = self._button("copy", "", "Copy the listed findings as text or CSV")
        self.copy.setAccessibleName("Copy the findings")
        self.copy.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.longest = NumberField(Steps(1.0, 0.1, 10.0, minimum=0.0, above=True), self)
        self.longest.typed.connect(self._type_longest)
        self.longest.stepping.connect(self._set_longest)
        self._longest: float | None = None
        self.repair.setMenu(self._repair_menu())
        bar = QWidget(self)
        bar.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)  # the panel may be narrow
        line = QHBoxLayout(bar)
        line.setContentsMargins(6, 4, 6, 4)
        line.setSpacing(6)
        within = QLabel("within", bar)
        within.setProperty("muted", True)
        for widget in (self.check, within, self.tolerance, QLabel("mm", bar)):
            line.addWidget(widget)
        line.addSpacing(8)
        line.addWidget(self.kind, 1)
        line.addStretch(0)
        line.addWidget(self.repair)
        line.addWidget(self.copy)

        self.working = WorkRow("Give up what is under way", self)
        self.working.cancel_asked.connect(self.cancel_asked)

        self.empty = QLabel(EMPTY, self)
        self.empty.setProperty("muted", True)
        self.empty.setWordWrap(True)
        self.empty.setContentsMargins(12, 6, 12, 6)
        self.empty.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.empty.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.report = ReportView(self)
        self.table = FindingTable(self)
        self.copy.setMenu(self._copy_menu())
        self.parts = QSplitter(Qt.Orientation.Horizontal, self)
        self.parts.setChildrenCollapsible(False)
        self.parts.addWidget(self.report)
        self.parts.addWidget(self.table)
        self.parts.setStretchFactor(0, 1)
        self.parts.setStretchFactor(1, 2)
        self.parts.setSizes([260, 500])
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(bar)
        layout.addWidget(self.working)
        layout.addWidget(self.empty)
        layout.addWidget(self.parts, 1)
        layout.addStretch(0)
        self.kind.currentIndexChanged.connect(lambda: self.table.findings.set_kind(self.listed_kind))
        self._kinds: list[Kind | None] = [None]
        self.show_findings(())

    @property
    def listed_kind(self) -> Kind | None:
        """The kind that is listed alone; None for all."""
        return self._kinds[max(self.kind.currentIndex(), 0)]

    @property
    def longest_border(self) -> float | None:
        """The longest border that is to be closed, in mm; None: any."""
        return self._longest

    def show_findings(self, reports: Sequence[NodeFaults], nothing: bool = False) -> None:
        """The table and its filter; the report in words is set by itself. `nothing` there is to check."""
        there = bool(reports)
        self.empty.setText(NOTHING if nothing else EMPTY)
        self.empty.setVisible(not there)
        self.parts.setVisible(there)
        rows = rows_of(reports)
        counts = counts_by_kind(reports)
        before = self.listed_kind
        self._kinds = [None, *counts]
        self.kind.blockSignals(True)
        self.kind.clear()
        total = sum(count for _, count in counts.values())
        what = f"{total:,} fault{'s' * (total != 1)}"
        self.kind.addItem(f"All {what}" if len(rows) == total else f"The worst {len(rows):,} of {what}")
        for words, count in counts.values():
            self.kind.addItem(words.counted(count))
            self.kind.setItemData(self.kind.count() - 1, words.about, Qt.ItemDataRole.ToolTipRole)
        self.kind.setCurrentIndex(self._kinds.index(before) if before in self._kinds else 0)
        self.kind.blockSignals(False)
        self.table.findings.set_kind(self.listed_kind)
        self.table.findings.set_rows(rows)
        self.table.setColumnHidden(GAP, not any(row.finding.gap for row in rows))
        self.table.setColumnHidden(SOLID, len({id(row.report) for row in rows}) < 2)
        if not rows and self.table.hasFocus():
            self.check.setFocus()  # else Qt would pick a field anywhere in the window
        self.table.setVisible(bool(rows))
        self.kind.setVisible(bool(rows))
        self.copy.setEnabled(bool(rows))

    def show_work(self, words: str, done: int = 0, total: int = 0) -> None:
        """What is under way, "" for nothing."""
        self.working.show_work(words, done, total)
        self.check.setEnabled(not words)

    def set_repairable(self, whose: str, why_not: str = "", kinds: Collection[str] = (), hole: bool = False) -> None:
        """Whose faults a repair would mend, in words; or why none can be. `kinds` are those of the reports that are
        meant, `hole` whether a border is chosen."""
        self.repair.setEnabled(not why_not)
        self.repair.setToolTip(f"Not now: {why_not}" if why_not else f"Repairs of {whose}")
        self._whose.setText(f"Repair {whose}")
        self._hole.setVisible(hole)
        for name, action in self._single.items():
            action.setVisible("mesh" in kinds or name == "weld")
        self._cut.setVisible("outline" in kinds)
        self._up_to.setVisible("mesh" in kinds)

    def open_repairs(self) -> None:
        """The menu of repairs, at the button."""
        self.repair.menu().popup(self.repair.mapToGlobal(self.repair.rect().bottomLeft()))

    def _type_longest(self, text: str) -> None:
        try:
            self._set_longest(millimetres_from(text, "the longest border") if text else None)
        except Refusal as refusal:
            self.longest.set_fault(True)
            self.longest.setToolTip(sentence(refusal))

    def _set_longest(self, value: float | None) -> None:
        self._longest = value
        self.longest.set_fault(False)
        self.longest.setToolTip(LONGEST_TIP)
        self.longest.setModified(False)
        self.longest.set_value(value)

    def _repair_menu(self) -> QMenu:
        menu = QMenu(self)
        menu.setToolTipsVisible(True)
        self._whose = menu.addAction("Repair", lambda: self.repair_asked.emit(ALL))
        self._whose.setToolTip("Meshes: all of these, one after the other; drawings are welded")
        self._hole = menu.addAction("Close this hole", self.hole_asked.emit)
        self._hole.setToolTip("Fill the chosen border alone")
        menu.addSeparator()
        self._single = {name: menu.addAction(TITLES[name]) for name in REPAIRS}
        for name, action in self._single.items():
            action.setToolTip(REPAIRS[name])
            action.triggered.connect(lambda _=False, name=name: self.repair_asked.emit((name,)))
        self._cut = menu.addAction("Cut lines and weld", lambda: self.repair_asked.emit(CUT))
        self._cut.setToolTip(f"{OUTLINE_REPAIRS['cut']}; then they are welded")
        menu.addSeparator()
        room = QWidget(menu)
        line = QHBoxLayout(room)
        line.setContentsMargins(24, 2, 10, 4)
        line.addWidget(QLabel("Close holes up to", room))
        self.longest.setParent(room)
        self.longest.setFixedWidth(64)
        self.longest.setPlaceholderText("any")
        self.longest.setAccessibleName("Longest border that is closed, in mm")
        self.longest.setToolTip(LONGEST_TIP)
        line.addWidget(self.longest)
        line.addWidget(QLabel("mm", room))
        self._up_to = QWidgetAction(menu)
        self._up_to.setDefaultWidget(room)
        menu.addAction(self._up_to)
        return menu

    def _copy_menu(self) -> QMenu:
        menu = QMenu(self)
        menu.addAction("As text", self.table.copy)
        menu.addAction("As CSV", lambda: self.table.copy(","))
        return menu

    def _button(self, picture: str, text: str, tip: str) -> QToolButton:
        button = QToolButton(self)
        button.setProperty("flat", True)
        button.setIcon(icon(picture))
        button.setText(text)
        button.setToolTip(tip)
        if text:
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        return button
