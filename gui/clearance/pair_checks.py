"""Checks of all pairs: asked of the second worker, and made again when the document has changed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ...model.proximity.findings import Report
    from ..window import MainWindow

REST = 300  # milliseconds without a change before a check is made again by itself
TOLERANCE = 0.05
"""Millimetres within which solids are evaluated."""


class PairChecks(QObject):
    """`changed` tells of another `report`; `working` what is under way and how far, "" for nothing; `refused` why there
    is no report."""

    changed = Signal()
    working = Signal(str, int, int)
    refused = Signal(str)

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.report: Report | None = None
        self._watching = False
        self._seen: tuple[object, ...] = ()
        """What the report is of."""
        self._asked: tuple[object, ...] | None = None
        self._given_up: tuple[object, ...] = ()
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(REST)
        self._soon.timeout.connect(self._again)
        jobs = window.evaluation.jobs
        jobs.pairs_checked.connect(self._found)
        jobs.pairs_progress.connect(self._progress)

    @property
    def at_work(self) -> bool:
        return self._asked is not None

    @property
    def settled(self) -> bool:
        """Whether the report is the last word on the present document."""
        return not self.at_work and not self._soon.isActive()

    def set_watching(self, watching: bool) -> None:
        """Whether somebody looks: then the report follows the document."""
        self._watching = watching
        if watching:
            self._soon.start(0)

    def check(self) -> None:
        """Look at all pairs now."""
        self._soon.stop()
        self._asked = self._now()
        self._window.evaluation.jobs.check_pairs(self._window.session.document, TOLERANCE)
        self.working.emit("Checking", 0, 0)

    def cancel(self) -> None:
        """Give up the check that is under way; the last report stays, and no other is made before something changes."""
        self._soon.stop()
        if self._asked is not None:
            self._given_up, self._asked = self._asked, None
            self._window.evaluation.jobs.stop_checking_pairs()
            self.working.emit("", 0, 0)

    def session_changed(self, before: State, after: State) -> None:
        if before.document is not after.document and self._watching:
            self._soon.start()

    def document_opened(self) -> None:
        self.cancel()
        self._seen = self._given_up = ()
        if self.report is not None:
            self.report = None
            self.changed.emit()
        if self._watching:
            self._soon.start()

    def _now(self) -> tuple[object, ...]:
        document = self._window.session.document
        roots = tuple((root.id, root.digest, root.name) for root in document.solids if root.visible)
        return roots, document.checks, document.definitions, document.parameters, document.fonts

    def _again(self) -> None:
        if self._window.session.previewing:
            self._soon.start()
        elif self._watching and self._now() not in (self._seen, self._asked, self._given_up):
            self.check()

    def _progress(self, done: int, total: int, label: str) -> None:
        if self.at_work:
            self.working.emit(f"Checking {label}", done, total)

    def _found(self, report: Report | None, fault: str) -> None:
        if self._asked is None:
            return
        asked, self._asked = self._asked, None
        self.working.emit("", 0, 0)
        if report is None:
            self._given_up = asked
            self.refused.emit(f"Not checked: {fault}")
            return
        self.report, self._seen = report, asked
        self.changed.emit()
        if self._watching:
            self._soon.start()
