"""The window's side of the workers: asks for meshes when the document changes, keeps the latest answer, never waits."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from ..model.document.document import Document
from ..model.document.tree import walk
from ..model.editing.session import Session, State
from .jobs import Jobs
from .settings import TOLERANCE

if TYPE_CHECKING:
    from ..model.worker.lane import Lane
    from ..model.worker.messages import LaneMessage
    from ..model.worker.shown import Part, Shown

PATIENCE = 100  # milliseconds before the window says that it is busy
IDLE = 250  # milliseconds of rest before the worker gets ready for a drag of what is selected
MOST_EXAMINED = 64  # selected nodes that are looked at by themselves
PREVIEW = 4.0  # how much coarser the tolerance is while a value is being dragged, where the worker is not quick
QUICK = 0.02  # seconds that the worker may need for a picture of a drag


def new_lane(on_message: Callable[[LaneMessage], None]) -> Lane:
    from ..model.project.assets import default_store
    from ..model.worker.lane import Lane

    return Lane(on_message, default_store().folder)


def same_shape(a: Document, b: Document) -> bool:
    """Whether two documents are the same solids and outlines with the same creases, other looks and names apart."""
    if a.parameters != b.parameters:
        return False
    pairs = ((a.definitions, b.definitions), (a.standing, b.standing))
    return all([(r.id, r.digest, r.creases) for r in one] == [(r.id, r.digest, r.creases) for r in other]
               for one, other in pairs)  # fmt: skip


class Evaluation(QObject):
    """One lane evaluates; `jobs` has a second one, so that a long job never delays a drag."""

    shown = Signal(object, float)
    """A new answer (a Shown), and how many seconds it took."""
    busy = Signal(bool)
    progress = Signal(int, int, str)
    examined = Signal(object)
    """The selected nodes by themselves: a dict of Parts by id (see `parts`)."""
    notice = Signal(str)
    outdated = Signal()
    """What is shown is no longer what the document says, and nobody is at work on it."""
    _told = Signal(object)

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
        self.jobs = jobs = Jobs(make_lane, self)
        jobs.began.connect(self._be_patient)
        jobs.rested.connect(self._rest)
        jobs.notice.connect(self.notice)
        jobs.progress.connect(lambda *told: self.progress.emit(*told) if self._request is None else None)
        self._closed = False
        self.tolerance = TOLERANCE
        """Of the picture, in mm."""
        self._asked: tuple[Document, float] | None = None
        self._request: int | None = None
        self._drag: int | None = None
        """The first request of the drag under way: answers from there on are shown, though newer ones are asked for."""
        self._quick = False  # whether the worker has been so with this document lately
        self._is_busy = False
        self.latest: Shown | None = None
        self.parts: dict[str, Part] = {}
        """Of the selected nodes, by id; those of the last answer until the next one comes."""
        self._examined: tuple[object, ...] | None = None
        self._examination: int | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._ask)
        self._look = QTimer(self)
        self._look.setSingleShot(True)
        self._look.timeout.connect(self._examine)
        self._patience = QTimer(self)
        self._patience.setSingleShot(True)
        self._patience.setInterval(PATIENCE)
        self._patience.timeout.connect(lambda: self._set_busy(True))
        self._idle = QTimer(self)
        self._idle.setSingleShot(True)
        self._idle.setInterval(IDLE)
        self._idle.timeout.connect(self._prepare)
        self.lane: Lane | None = None

    def warm(self) -> None:
        """Start the worker before there is something to do; after the first picture, which it would delay."""
        if self.lane is None and not self._closed:
            # The lane calls from a thread of its own: only a queued signal crosses over.
            self.lane = self._make_lane(self._told.emit)
            self.lane.start()
            if self._session.document.roots:
                self.ask()

    @property
    def waiting(self) -> bool:
        """Whether an answer is outstanding."""
        unborn = self.lane is None and bool(self._session.document.roots)
        return unborn or self._soon.isActive() or self._request is not None

    @property
    def examining(self) -> bool:
        """Whether `parts` may tell of an earlier document or selection."""
        return self.waiting or self._look.isActive() or self._examination is not None

    def session_changed(self, before: State, after: State) -> None:
        """Ask once for each pass of the event loop, however many changes it held."""
        if self.lane is None:
            return  # it will be asked for what there is then
        if self._session.previewing and self._asked is not None and same_shape(self._asked[0], self._session.view):
            return  # a colour, say: nothing to cut
        if self._asked is None or self._asked[0] is not self._session.view or self._asked[1] != self._tolerance():
            self._soon.start(0)
        elif before.selection != after.selection:
            self._look.start(0)
            self._idle.start()

    def ask(self) -> None:
        """Ask for the document as it is."""
        self._soon.start(0)

    def cancel(self) -> None:
        """Give up what is being computed; what was shown stays."""
        self._soon.stop()
        if self._request is not None and self.lane is not None:
            self._request = None
            self.lane.cancel()
            self.outdated.emit()
            self.notice.emit("Cancelled: the picture shows the last result")
        self.jobs.cancel()
        self._rest()

    def close(self) -> None:
        if not self._closed:
            self._closed = True
            self._soon.stop()
            self._patience.stop()
            self._idle.stop()
            self._look.stop()
            if self.lane is not None:
                self.lane.close()
            self.jobs.close()

    def _examine(self) -> None:
        """Ask for the selected nodes by themselves, unless that has been done; on a drag's way only for new shapes."""
        selection = self._session.selection
        if self.lane is None or self._request is not None or self._soon.isActive():
            return  # the answer comes back here
        if not selection or len(selection) > MOST_EXAMINED:
            self._examination, self._examined = None, None
            if self.parts:
                self.parts = {}
                self.examined.emit(self.parts)
            return
        document = self._session.document
        if self._session.previewing:
            held = {node.id: node.shape_digest for node in walk(*document.roots)}
            asked: tuple[object, ...] = (tuple(held.get(i) for i in selection), document.parameters)
        else:
            asked = (selection, document.solids, document.definitions, document.parameters)
        if asked != self._examined:
            self._examined = asked
            self._examination = self.lane.examine(document, selection, self._tolerance())

    def _prepare(self) -> None:
        """Let the worker cut what does not depend on the selected node, so that dragging its values is quick."""
        selection = self._session.selection
        if self.lane is not None and not self.waiting and not self._session.previewing and len(selection) == 1:
            tolerance = self._tolerance()
            self.lane.prepare(self._session.document, selection[0], (tolerance, PREVIEW * tolerance))

    def set_tolerance(self, tolerance: float) -> None:
        """How fine the picture is to be, in mm."""
        if tolerance != self.tolerance:
            self.tolerance = tolerance
            if self.lane is not None:
                self.ask()

    def _tolerance(self) -> float:
        coarse = self._session.previewing and not self._quick
        return PREVIEW * self.tolerance if coarse else self.tolerance

    def _ask(self) -> None:
        if self.lane is None:
            return
        previewing = self._session.previewing
        self._asked = (self._session.view, self._tolerance())
        # Superseding each preview by the next would show none of a drag.
        self._request = self.lane.evaluate(*self._asked, supersedes=not previewing)
        if not previewing:
            self._drag = None
        elif self._drag is None:
            self._drag = self._request
        self._be_patient()

    def _be_patient(self) -> None:
        """Say that the window is busy, unless it is over soon."""
        if not self._is_busy and not self._patience.isActive():
            self._patience.start()

    def _receive(self, message: LaneMessage) -> None:
        from ..model.worker.messages import Cancelled, Died, Evaluated, Examined, Progress

        if self._closed:
            return
        match message:
            case Evaluated():
                if message.request == self._request:
                    self._request = None
                elif self._drag is None or message.request < self._drag:
                    return  # stale: a newer document has been asked for
                if message.evaluations:  # else it was kept from before, which says nothing
                    # A drag that has become coarse stays so: to and fro would flicker.
                    self._quick = message.seconds < QUICK and (self._quick or self._drag is None)
                self._rest()
                self.latest = message.shown
                self.shown.emit(message.shown, message.seconds)
                self._look.start(0)
                self._idle.start()
            case Examined():
                if message.request == self._examination:
                    self._examination = None
                    self.parts = message.parts
                    self.examined.emit(self.parts)
            case Progress(request, done, total, label):
                if request == self._request:
                    self.progress.emit(done, total, label)
            case Died(request, reason, given_up):
                if given_up and request == self._request:
                    self._request = None
                    self._rest()
                    self.outdated.emit()
                    self.notice.emit(f"Given up: {reason}, twice. Change the document to try again")
                else:
                    self.notice.emit(f"{reason.capitalize()}; it has been started again and nothing is lost")
            case Cancelled(request) if request == self._request:
                self._request = None
                self._rest()

    def _rest(self) -> None:
        if self._request is None and not self.jobs.at_work:
            self._patience.stop()
            self._set_busy(False)
        elif self._is_busy:
            self._say_job()

    def _set_busy(self, busy: bool) -> None:
        if busy != self._is_busy:
            self._is_busy = busy
            self.busy.emit(busy)
            self._say_job()

    def _say_job(self) -> None:
        """Name the job where it is what is waited for."""
        if self._is_busy and self._request is None and self.jobs.label:
            self.progress.emit(0, 0, self.jobs.label)
