"""The Faults panel: checks, their findings in the picture, repairs. Nothing of it is made before it is looked at."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ..panels.property_edit import sentence
from .checked import is_mendable
from .checks import Checks, millimetres_from
from .repairing import Asked, Mended, Repairing

if TYPE_CHECKING:
    from ...model.checking.document_faults import NodeFaults
    from ...model.document.document import Document
    from ...model.editing.session import State
    from ..window import MainWindow
    from .fault_picture import FaultPicture
    from .finding_rows import FindingRow
    from .page import FaultsPage


class FaultsPanel(QWidget):
    """`refused` carries why something was not done, `said` what was; `dirty` that a file came in with faults."""

    refused = Signal(str)
    said = Signal(str)
    dirty = Signal(str)
    listed = Signal()
    """What can be repaired may have changed."""
    made = Signal()
    """The page and the picture are there, looked at for the first time."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("faults")
        self._window = window
        self.in_front = False
        self.page: FaultsPage | None = None
        self.picture: FaultPicture | None = None
        self.checks = Checks(window)
        self.repairing = Repairing(window, self)
        self.mended: tuple[Mended, ...] = ()
        self._after_repair: Document | None = None
        """The document that the last repair made, for as long as it is the present one."""
        self.checks.dirty.connect(self.dirty)
        self.checks.changed.connect(self.listed)
        self.checks.refused.connect(self.refused)
        self.repairing.refused.connect(self.refused)
        self.repairing.done.connect(self._repaired)

    # What happens.

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        if seen == self.in_front:
            return
        self.in_front = seen
        if seen:
            self._make()
        self.checks.set_watching(seen)
        if seen:
            self._fill()
        elif self.picture is not None:
            self.picture.forget()

    def session_changed(self, before: State, after: State) -> None:
        self.checks.session_changed(before, after)
        if before.document is not after.document:
            self._follow_repair()
        if self.in_front and before.selection != after.selection:
            self._name_check()

    def document_opened(self) -> None:
        self.mended, self._after_repair = (), None
        self.checks.document_opened()
        self.checks.set_watching(self.in_front)

    def check(self) -> None:
        """Look for faults in what is selected, or in all that is visible."""
        self.mended = ()
        self.checks.check()

    # The page.

    def _make(self) -> None:
        if self.page is not None:
            return
        from .fault_picture import FaultPicture
        from .page import FaultsPage

        self.picture = FaultPicture(self._window, self)
        self.page = page = FaultsPage(self)
        page.tolerance.set_value(self.checks.tolerance)
        page.check_asked.connect(self.check)
        page.cancel_asked.connect(self.checks.cancel)
        page.cancel_asked.connect(self.repairing.cancel)
        page.tolerance_typed.connect(self._type_tolerance)
        page.tolerance_stepped.connect(self._set_tolerance)
        page.repair_asked.connect(self.repair)
        page.hole_asked.connect(lambda: self._close_hole(page.table.current))
        page.table.hole_asked.connect(self._close_hole)
        page.report.linked.connect(self._link)
        page.table.chosen.connect(self._choose)
        page.table.zoomed.connect(self._zoom)
        page.table.repair_asked.connect(self._open_repairs)
        page.table.left.connect(self.leave)
        self.picture.left.connect(self.leave)
        self.checks.changed.connect(self._fill)
        self.checks.working.connect(page.show_work)
        self.repairing.working.connect(page.show_work)
        self._window.theme.changed.connect(lambda _: page.table.viewport().update())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(page)
        self.made.emit()

    def _fill(self) -> None:
        """Show the reports."""
        if self.page is None or not self.in_front:
            return
        chosen = self.page.table.current
        reports = self.checks.reports
        nothing = self.checks.checked and not reports
        self.page.show_findings(reports, nothing)
        self._tell()
        self._name_check()
        self.page.table.choose_like(chosen)
        self._choose(self.page.table.current, fly=False)

    def _tell(self) -> None:
        if self.page is not None:
            can_undo = self._after_repair is not None
            self.page.report.show_report(self.checks.reports, self.checks.tolerance, self.mended, can_undo)

    def _name_check(self) -> None:
        if self.page is not None:
            self.page.check.setText("Check selected" if self._window.session.selection else "Check all")

    def _choose(self, row: FindingRow | None, fly: bool = True) -> None:
        page, picture = self.page, self.picture
        if page is None or picture is None or not self.in_front:
            return
        picture.show(page.table.findings.rows, row)
        if row is not None and fly:
            picture.fly()
        whose, why_not = self._targets(row)
        kinds = {report.kind for report in self._mendable(row)}
        page.set_repairable(whose, why_not, kinds, row is not None and row.is_hole)

    def _zoom(self, row: FindingRow | None) -> None:
        if self.picture is not None and row is not None:
            self._choose(row, fly=False)
            self.picture.fly(close=True)

    def leave(self) -> None:
        """Choose no finding, and take its marks away."""
        if self.page is not None and self.picture is not None:
            self.page.table.leave()
            self.picture.show(())

    def _type_tolerance(self, text: str) -> None:
        page = self.page
        if page is None:
            return
        try:
            value = millimetres_from(text, "the tolerance")
        except Refusal as refusal:
            page.tolerance.set_fault(True)
            self.refused.emit(sentence(refusal))
            return
        page.tolerance.set_fault(False)
        self.refused.emit("")
        self._set_tolerance(value)

    def _set_tolerance(self, value: float) -> None:
        if self.page is not None:
            self.page.tolerance.setModified(False)
            self.page.tolerance.set_value(value)
            self.checks.set_tolerance(value)

    # Repairs.

    def _targets(self, row: FindingRow | None) -> tuple[str, str]:
        """Whose faults a repair would mend, in words; and why it would not, or ""."""
        reports = self._mendable(row)
        if reports:
            one = f"“{reports[0].name}”"
            return one if len(reports) == 1 else f"all {len(reports)} with faults", ""
        if row is not None:
            return "", f"“{row.report.name}” is made of other nodes; make a mesh of it first, by the link in the report"
        return "", "nothing is wrong with any mesh or outline"

    def _mendable(self, row: FindingRow | None) -> list[NodeFaults]:
        reports = self.checks.reports if row is None else (row.report,)
        return [report for report in reports if is_mendable(report)]

    @property
    def repairable(self) -> bool:
        """Whether there is something listed that can be repaired."""
        return self.in_front and not self.repairing.at_work and bool(self._mendable(None))

    def repair_all(self) -> None:
        """Do all repairs to all that is listed."""
        from .page import ALL

        self._repair(_asked(self._mendable(None)), ALL)

    def repair(self, repairs: tuple[str, ...]) -> None:
        """Repair what has the chosen finding, or all; see REPAIRS of meshes and of outlines for the names."""
        if self.page is not None:
            kinds = {"outline"} if "cut" in repairs else {"mesh", "outline"} if "weld" in repairs else {"mesh"}
            reports = self._mendable(self.page.table.current)
            self._repair(_asked(report for report in reports if report.kind in kinds), repairs)

    def _open_repairs(self, row: FindingRow) -> None:
        _, why_not = self._targets(row)
        if why_not:
            self.refused.emit(sentence(why_not))
        elif self.page is not None:
            self.page.open_repairs()

    def _close_hole(self, row: FindingRow | None) -> None:
        if row is not None and row.is_hole:
            self._repair([Asked(row.report.id, row.report.name, hole=int(row.finding.vertices[0]))], ("holes",))

    def _repair(self, asked: list[Asked], repairs: tuple[str, ...]) -> None:
        if self.page is not None:
            self.checks.cancel()
            self.repairing.start(asked, repairs, self.checks.tolerance, self.page.longest_border)

    def _repaired(self, mended: tuple[Mended, ...]) -> None:
        self.mended = mended
        self._after_repair = self._window.session.document
        self._tell()
        worse = sum(len(one.worse) for one in mended)
        names = f"“{mended[0].name}” is repaired" if len(mended) == 1 else f"{len(mended)} are repaired"
        self.said.emit(names + ("; something is worse now, see the panel" if worse else ""))

    def _follow_repair(self) -> None:
        """What was said of a repair counts as long as nothing else was done."""
        if self._after_repair is not None and self._window.session.document is not self._after_repair:
            self.mended, self._after_repair = (), None
            self._tell()

    def _link(self, link: str) -> None:
        word, _, node_id = link.partition(" ")
        if word == "undo":
            self._window.actions_.run("undo")
        elif word == "solid":
            self._window.session.select((node_id,))
        else:
            from .page import ALL

            name = next((report.name for report in self.checks.reports if report.id == node_id), "")
            self._repair([Asked(node_id, name, convert=True)], ALL)


def _asked(reports: Iterable[NodeFaults]) -> list[Asked]:
    return [Asked(report.id, report.name, flat=report.kind == "outline") for report in reports]
