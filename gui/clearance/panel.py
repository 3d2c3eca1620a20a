"""The Clearance panel: the check of all pairs, the chosen one in the picture, and what is asked of pairs. Nothing of
it is made before it is looked at."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QInputDialog, QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ...model.proximity.checks import clearance_of
from ..panels.property_edit import sentence
from .pair_checks import PairChecks

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ...model.proximity.checks import PairCheck
    from ...model.proximity.findings import Finding
    from ..window import MainWindow
    from .page import ClearancePage
    from .pair_picture import PairPicture
    from .report_process import ReportProcess


class ClearancePanel(QWidget):
    """`refused` carries why something was not done, `said` what was."""

    refused = Signal(str)
    said = Signal(str)
    made = Signal()
    """The page and the picture are there, looked at for the first time."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("clearance")
        self._window = window
        self.in_front = False
        self.page: ClearancePage | None = None
        self.picture: PairPicture | None = None
        self.checks = PairChecks(window)
        self.reporting: ReportProcess | None = None
        self.checks.refused.connect(self.refused)

    # What happens.

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        if seen == self.in_front:
            return
        self.in_front = seen
        if seen:
            self._make()
            self._follow()
        elif self.picture is not None:
            self.picture.show(None)
        self.checks.set_watching(seen)
        if seen:
            self._fill()

    def session_changed(self, before: State, after: State) -> None:
        self.checks.session_changed(before, after)
        old, new = before.document, after.document
        if old.checks is not new.checks or old.solids is not new.solids:
            self._follow(old.checks.clearance != new.checks.clearance)

    def document_opened(self) -> None:
        self.checks.document_opened()
        self._follow(True)

    # The page.

    def _make(self) -> None:
        if self.page is not None:
            return
        from .page import ClearancePage
        from .pair_picture import PairPicture

        self.picture = PairPicture(self._window, self)
        self.page = page = ClearancePage(self)
        page.check_asked.connect(self.checks.check)
        page.cancel_asked.connect(self.checks.cancel)
        page.report_asked.connect(self.save_report)
        page.report_cancelled.connect(self._cancel_report)
        page.clearance_typed.connect(self._type_clearance)
        page.clearance_stepped.connect(self._set_clearance)
        page.table.chosen.connect(self._choose)
        page.table.zoomed.connect(self._zoom)
        page.table.touching_asked.connect(lambda finding: self._ask_of(*finding.ids, touching=True))
        page.table.clearance_asked.connect(self._ask_clearance)
        page.table.rule_dropped.connect(lambda finding: self._ask_of(*finding.ids))
        page.table.selection_asked.connect(lambda finding: self._window.session.select(finding.ids))
        page.table.isolation_asked.connect(self._isolate)
        page.table.left.connect(self.leave)
        page.rules.dropped.connect(lambda rule: self._ask_of(*rule.ends))
        page.rules.clearance_asked.connect(self._ask_clearance)
        self.picture.left.connect(self.leave)
        self.checks.changed.connect(self._fill)
        self.checks.working.connect(page.show_work)
        self._window.theme.changed.connect(lambda _: page.recolour())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(page)
        self.made.emit()

    def _fill(self) -> None:
        """Show the report."""
        if self.page is None or not self.in_front:
            return
        chosen = self.page.table.current
        self.page.show_report(self.checks.report)
        self.page.table.choose_like(chosen)
        self._choose(self.page.table.current, fly=False)

    def _follow(self, anew: bool = False) -> None:
        """Show what the document asks; `anew`: also where something else is typed."""
        if self.page is not None:
            self.page.show_document(self._window.session.document, anew)

    def _choose(self, finding: Finding | None, fly: bool = True) -> None:
        if self.picture is None or not self.in_front:
            return
        self.picture.show(finding)
        if finding is not None and fly:
            self.picture.fly()

    def _zoom(self, finding: Finding | None) -> None:
        if self.picture is not None and finding is not None:
            self._choose(finding, fly=False)
            self.picture.fly(close=True)

    def leave(self) -> None:
        """Choose no pair, and take its marks away."""
        if self.page is not None and self.picture is not None:
            self.page.table.leave()
            self.picture.show(None)

    def _isolate(self, finding: Finding) -> None:
        """Show its two solids alone; everything again where they are alone already."""
        session = self._window.session
        session.isolate(() if set(session.isolated) == set(finding.ids) else finding.ids)

    # What is asked.

    def _type_clearance(self, text: str) -> None:
        assert self.page is not None
        try:
            value = clearance_of(text)
        except Refusal as refusal:
            self.page.clearance.set_fault(True)
            self.refused.emit(sentence(refusal))
            return
        self.page.clearance.set_fault(False)
        self.refused.emit("")
        self._set_clearance(value)

    def _set_clearance(self, value: float) -> None:
        assert self.page is not None
        self.page.clearance.setModified(False)
        self._do("set_clearance", value, label="Clearance")
        self._follow()

    def _ask_of(self, one: str, other: str, clearance: float | None = None, touching: bool = False) -> None:
        more: dict[str, Any] = {"clearance": clearance} if clearance is not None else {"touching": touching}
        self._do("check_pair", one, other, label="Meant to touch" if touching else "Clearance of a pair", **more)

    def _ask_clearance(self, pair: Finding | PairCheck) -> None:
        """Ask for the clearance of a pair."""
        names = {root.id: root.name for root in self._window.session.document.solids}
        rule = self._window.session.document.checks.pair(pair.one, pair.other)
        now = self._window.session.document.checks.clearance if rule is None else rule.clearance or 0.0

        def answered(text: str) -> None:
            try:
                self._ask_of(pair.one, pair.other, clearance_of(text))
            except Refusal as refusal:
                self.refused.emit(sentence(refusal))

        dialog = QInputDialog(self._window)
        dialog.setWindowTitle("Clearance of a pair")
        dialog.setLabelText(
            f"The least gap between “{names.get(pair.one, '?')}” and “{names.get(pair.other, '?')}”, in mm; "
            "0: they do not overlap"
        )
        dialog.setTextValue(f"{now:g}")
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.textValueSelected.connect(answered)
        dialog.open()

    def _do(self, name: str, *arguments: Any, label: str, **more: Any) -> None:
        try:
            self._window.session.do(name, *arguments, label=label, **more)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))

    # The report.

    def save_report(self) -> None:
        """Ask where to, and write what is found as a page to print."""
        from ..dialogs import ask_report_path

        files = self._window.files
        start = Path(self._window.settings.folder, f"{files.name} clearance.html")
        ask_report_path(self._window, start, self.write_report)

    def write_report(self, out: str) -> None:
        """Write the report of the document as it is now, by a process of its own: its pictures take their time."""
        from .report_process import ReportProcess

        if self.reporting is None:
            self.reporting = ReportProcess(self)
            self.reporting.ended.connect(self._reported)
        try:
            self.reporting.write(self._window.session.document, self._window.files.name, Path(out))
        except Refusal as refusal:
            self._reported(Path(out).name, str(refusal))
            return
        if self.page is not None:
            self.page.show_report_work(f"Writing {Path(out).name}")

    def _reported(self, name: str, fault: str) -> None:
        if self.page is not None:
            self.page.show_report_work("")
        if fault:
            self.refused.emit(f"{name} was not written: {fault}")
        else:
            self.said.emit(f"Wrote {name}")

    def _cancel_report(self) -> None:
        if self.reporting is not None and self.reporting.at_work:
            self.reporting.cancel()
            self._reported("The report", "it was cancelled")

    def close_work(self) -> None:
        """The window closes."""
        if self.reporting is not None:
            self.reporting.cancel()
