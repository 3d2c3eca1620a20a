"""The window's side of the workers: asks for meshes when the document changes and keeps the latest answer. Never waits."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from ..model.document.assets import default_store
from ..model.document.document import Document
from ..model.document.session import Session, State
from ..model.solid.lane import Cancelled, Died, Evaluated, Exported, Lane, LaneMessage, Progress, Shown
from ..model.solid.tessellation import DEFAULT_TOLERANCE

PATIENCE = 100  # milliseconds before the window says that it is busy
PREVIEW = 4.0  # how much coarser the tolerance is while a value is being dragged


def new_lane(on_message: Callable[[LaneMessage], None]) -> Lane:
    return Lane(on_message, default_store().folder)


class Evaluation(QObject):
    """One lane evaluates; a second one, started when first needed, exports, so that a long job never delays a drag."""

    shown = Signal(object, float)
    """A new answer (a Shown), and how many seconds it took."""
    busy = Signal(bool)
    progress = Signal(int, int, str)
    exported = Signal(str, str)
    """Path, and "" or why nothing was written."""
    notice = Signal(str)
    _told = Signal(object)
    _told_of_job = Signal(object)

    def __init__(
        self,
        session: Session,
        parent: QObject | None = None,
        make_lane: Callable[[Callable[[LaneMessage], None]], Lane] = new_lane,
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._make_lane = make_lane
        self._told.connect(self._receive, Qt.ConnectionType.QueuedConnection)
        self._told_of_job.connect(self._receive_job, Qt.ConnectionType.QueuedConnection)
        self._closed = False
        self._asked: tuple[Document, float] | None = None
        self._request: int | None = None
        self._is_busy = False
        self._exports: set[int] = set()
        self.latest: Shown | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._ask)
        self._patience = QTimer(self)
        self._patience.setSingleShot(True)
        self._patience.setInterval(PATIENCE)
        self._patience.timeout.connect(lambda: self._set_busy(True))
        # The lanes call from threads of their own: only a queued signal crosses over.
        self.lane = make_lane(self._told.emit)
        self.lane.start()
        self.jobs: Lane | None = None

    @property
    def waiting(self) -> bool:
        """Whether an answer is outstanding."""
        return self._soon.isActive() or self._request is not None

    @property
    def exporting(self) -> bool:
        return bool(self._exports)

    def session_changed(self, before: State, after: State) -> None:
        """Ask once for each pass of the event loop, however many changes it held."""
        if self._asked is None or self._asked[0] is not after.document or self._asked[1] != self._tolerance():
            self._soon.start(0)

    def ask(self) -> None:
        """Ask for the document as it is."""
        self._soon.start(0)

    def cancel(self) -> None:
        """Give up what is being computed; what was shown stays."""
        self._soon.stop()
        if self._request is not None:
            self._request = None
            self.lane.cancel()
            self.notice.emit("Cancelled: the picture shows the last result")
        if self._exports and self.jobs is not None:
            self._exports.clear()
            self.jobs.cancel()
            self.notice.emit("The export was cancelled; no file was written")
        self._rest()

    def export(
        self, document: Document, path: str | Path, tolerance: float | None = None, solid: str | None = None
    ) -> None:
        """Write a mesh file; `exported` tells when that is done."""
        if self.jobs is None:
            self.jobs = self._make_lane(self._told_of_job.emit)
            self.jobs.start()
        self._exports.add(self.jobs.export(document, path, tolerance or DEFAULT_TOLERANCE, solid))
        self._patience.start()

    def close(self) -> None:
        if not self._closed:
            self._closed = True
            self._soon.stop()
            self._patience.stop()
            for lane in (self.lane, self.jobs):
                if lane is not None:
                    lane.close()

    def _tolerance(self) -> float:
        return PREVIEW * DEFAULT_TOLERANCE if self._session.previewing else DEFAULT_TOLERANCE

    def _ask(self) -> None:
        self._asked = (self._session.document, self._tolerance())
        self._request = self.lane.evaluate(*self._asked)
        if not self._is_busy and not self._patience.isActive():
            self._patience.start()

    def _receive(self, message: LaneMessage) -> None:
        if self._closed:
            return
        match message:
            case Evaluated():
                if message.request != self._request:
                    return  # stale: a newer document has been asked for
                self._request = None
                self._rest()
                self.latest = message.shown
                self.shown.emit(message.shown, message.seconds)
            case Progress(request, done, total, label):
                if request == self._request:
                    self.progress.emit(done, total, label)
            case Died(request, reason, given_up):
                if given_up and request == self._request:
                    self._request = None
                    self._rest()
                    self.notice.emit(f"Given up: {reason}, twice. Change the document to try again")
                else:
                    self.notice.emit(f"{reason.capitalize()}; it has been started again and nothing is lost")
            case Cancelled(request) if request == self._request:
                self._request = None
                self._rest()

    def _receive_job(self, message: LaneMessage) -> None:
        if self._closed:
            return
        match message:
            case Exported(request, path, fault) if request in self._exports:
                self._exports.discard(request)
                self._rest()
                self.exported.emit(path, fault or "")
            case Progress(request, done, total, label) if request in self._exports and self._request is None:
                self.progress.emit(done, total, f"Exporting {label}")
            case Died(request, reason, given_up) if given_up and request in self._exports:
                self._exports.discard(request)
                self._rest()
                self.exported.emit("", reason)

    def _rest(self) -> None:
        if self._request is None and not self._exports:
            self._patience.stop()
            self._set_busy(False)

    def _set_busy(self, busy: bool) -> None:
        if busy != self._is_busy:
            self._is_busy = busy
            self.busy.emit(busy)
