"""The widgets of the Clearance panel: what is asked, what a check came to in words, the pairs, and rules of pairs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QMenu,
    QSizePolicy,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.proximity.words import remark_words, report_words
from ..icons import icon
from ..panels.number_field import NumberField, Steps
from ..panels.work_row import WorkRow
from ..theme import LIGHT, colours_now
from .pair_table import PairTable
from .rule_list import RuleList

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.proximity.findings import Report

IN_ORDER = ("#14703a", "#5fd38d")
"""The colour of what is in order, on light ground and on dark."""
CLEARANCE_TIP = "The least gap that all pairs of visible solids keep, in mm; 0: they do not overlap"
EMPTY = "The check of all pairs of visible solids begins as soon as there are two of them."


class ClearancePage(QWidget):
    """What it shows and does is the panel's."""

    check_asked = Signal()
    cancel_asked = Signal()
    report_asked = Signal()
    report_cancelled = Signal()
    clearance_typed = Signal(str)
    clearance_stepped = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.check = self._button("evaluate", "Check", "Look at all pairs again")
        self.check.clicked.connect(self.check_asked)
        self.clearance = NumberField(Steps(0.1, 0.01, 1.0, minimum=0.0), self)
        self.clearance.setFixedWidth(64)
        self.clearance.setAccessibleName("Clearance in mm")
        self.clearance.setToolTip(CLEARANCE_TIP)
        self.clearance.typed.connect(self.clearance_typed)
        self.clearance.stepping.connect(self.clearance_stepped)
        self.told = QLabel(EMPTY, self)
        self.told.setAccessibleName("Result")
        self.told.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.told.setWordWrap(True)
        self.told.setContentsMargins(12, 0, 12, 4)
        self.told.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)  # long words widen nothing
        self.out = self._button("export", "", "Copy the list, or save a report to print")
        self.out.setAccessibleName("Copy or save the findings")
        self.out.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        bar = QWidget(self)
        bar.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)  # the panel may be narrow
        line = QHBoxLayout(bar)
        line.setContentsMargins(6, 4, 6, 4)
        line.setSpacing(6)
        keep = QLabel("clearance", bar)
        keep.setProperty("muted", True)
        for widget in (self.check, keep, self.clearance, QLabel("mm", bar)):
            line.addWidget(widget)
        line.addStretch(1)
        line.addWidget(self.out)

        self.working = WorkRow("Give up this check; the next change begins another one", self)
        self.working.cancel_asked.connect(self.cancel_asked)
        self.writing = WorkRow("Give up the report", self)
        self.writing.cancel_asked.connect(self.report_cancelled)

        self.remarks = QLabel(self)
        self.remarks.setProperty("muted", True)
        self.remarks.setWordWrap(True)
        self.remarks.setContentsMargins(12, 2, 12, 4)
        self.remarks.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.table = PairTable(self)
        self.rules = RuleList(self)
        self.out.setMenu(self._out_menu())
        self.parts = QSplitter(Qt.Orientation.Horizontal, self)
        self.parts.setChildrenCollapsible(False)
        self.parts.addWidget(self.table)
        self.parts.addWidget(self.rules)
        self.parts.setStretchFactor(0, 3)
        self.parts.setStretchFactor(1, 1)
        self.parts.setSizes([460, 220])
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(bar)
        layout.addWidget(self.working)
        layout.addWidget(self.writing)
        layout.addWidget(self.told)
        layout.addWidget(self.remarks)
        layout.addWidget(self.parts, 1)
        layout.addStretch(0)
        self._report: Report | None = None
        self.show_report(None)

    def show_document(self, document: Document, anew: bool = False) -> None:
        """What is asked; `anew`: also where something else is typed."""
        if anew:
            self.clearance.setModified(False)
            self.clearance.set_fault(False)
        if not self.clearance.isModified():
            self.clearance.set_value(document.checks.clearance)
        self.rules.show_rules(document)
        self.table.ruled = frozenset(rule.ends for rule in document.checks.pairs)
        self._arrange()

    def show_report(self, report: Report | None) -> None:
        """None: nothing has been checked."""
        self._report = report
        findings = () if report is None else report.findings
        self.told.setText(EMPTY if report is None else report_words(report))
        self.recolour()
        remarks = [] if report is None else [remark_words(remark) for remark in report.remarks]
        self.remarks.setText("\n".join(remarks))
        self.remarks.setVisible(bool(remarks))
        if not findings and self.table.hasFocus():
            self.check.setFocus()  # else Qt would pick a field anywhere in the window
        self.table.listed.set_rows(findings)
        self.table.setVisible(bool(findings))
        self.out.setEnabled(report is not None and report.solids > 1)
        self._arrange()

    def recolour(self) -> None:
        """The words in the colours of the theme."""
        report = self._report
        fine = report is not None and report.in_order and report.solids > 1
        colour = IN_ORDER[0 if colours_now() == LIGHT else 1]
        self.told.setStyleSheet(f"color: {colour}" if fine else "")

    def show_work(self, words: str, done: int = 0, total: int = 0) -> None:
        """What is under way, "" for nothing."""
        self.working.show_work(words, done, total)
        self.check.setEnabled(not words)

    def show_report_work(self, words: str) -> None:
        """A report is being written, "" for none."""
        self.writing.show_work(words)

    def _arrange(self) -> None:
        self.parts.setVisible(not self.table.isHidden() or not self.rules.isHidden())

    def _out_menu(self) -> QMenu:
        menu = QMenu(self)
        menu.addAction("Copy as text", self.table.copy)
        menu.addAction("Copy as CSV", lambda: self.table.copy(","))
        menu.addSeparator()
        menu.addAction("Save a report to print …", self.report_asked.emit)
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
