"""A lane: one worker process, fed by a thread, so that whoever asks never waits and nothing shown is lost with it."""

from __future__ import annotations

import contextlib
import threading
import time
import traceback
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..document.document import Document, Section
from ..document.errors import Refusal
from ..solid.tessellation import DEFAULT_TOLERANCE
from .job import Job, request_of
from .messages import (
    Cancelled,
    Died,
    Drawn,
    Evaluated,
    Examined,
    Exported,
    LaneMessage,
    Partitioned,
    Progress,
    Started,
)
from .process import WorkerProcess, reason_of
from .shown import Message, Part, Pictures, Shown

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from ..drafting.plan import Plan
    from ..measuring.measure import Measures
    from ..solid.display import DisplayMesh


MOST_DEATHS = 3
"""After so many deaths without a sign of life in between, no further worker is started unasked."""


MOST_SURFACES = 64
"""Nodes by themselves whose surfaces are kept here."""


class Lane:
    """Evaluates, exports, draws and sorts in a process of its own. `on_message` is called from the lane's thread.

    A newer evaluation supersedes an older one. The pictures of the last solids are kept here by key, `kept` bytes of
    them, so that going back to them asks nobody.
    """

    def __init__(self, on_message: Callable[[LaneMessage], None], store_folder: Path, kept: int = 512 << 20) -> None:
        self._tell = on_message
        self._store_folder = store_folder
        self._process: WorkerProcess | None = None
        self._current: Job | None = None
        self._bell: Connection | None = None
        self._ring: Connection | None = None
        self._lock = threading.Lock()
        self._evaluation: Job | None = None
        self._exports: list[Job] = []
        self._partition: Job | None = None
        self._drawing: Job | None = None
        self._undrawn = 0  # drawings up to this number are no longer wanted
        self._examination: Job | None = None
        self._preparation: Job | None = None
        self._surfaces: OrderedDict[bytes, DisplayMesh | None] = OrderedDict()
        self._cancelled = False
        self._killed = False
        self._closed = False
        self._started = False
        self._deaths = 0
        self._number = 0
        self._pictures = Pictures(kept)
        self._thread = threading.Thread(target=self._work, name="solidtree lane", daemon=True)

    @property
    def pid(self) -> int | None:
        """The worker's process id, for tests and supervision."""
        return None if self._process is None else self._process.pid

    @property
    def at_work(self) -> int | None:
        """The number of the request that the worker has."""
        job = self._current
        return None if job is None else job.number

    def start(self) -> None:
        """Start the worker ahead of the first request, which else does; returns at once."""
        with self._lock:
            if not self._started and not self._closed:
                self._started = True
                self._thread.start()

    def evaluate(self, document: Document, tolerance: float = DEFAULT_TOLERANCE, supersedes: bool = True) -> int:
        """Ask for a document's pictures and measures; the result is the number that the answer will carry.

        What is being evaluated is given up for it, unless neither of both `supersedes`: then it waits, and of those
        that wait the newest is taken.
        """
        with self._lock:
            self._number += 1
            self._evaluation = Job(self._number, "evaluate", document, tolerance, supersedes=supersedes)
            number = self._number
        self._wake()
        return number

    def export(
        self,
        document: Document,
        path: Path | str,
        tolerance: float = DEFAULT_TOLERANCE,
        solid: str | None = None,
        section: Section | None = None,
    ) -> int:
        """Ask for a mesh file of all visible solids, or of the one with this name; of a section for its outlines."""
        with self._lock:
            self._number += 1
            self._exports.append(Job(self._number, "export", document, tolerance, str(path), solid, section=section))
            number = self._number
        self._wake()
        return number

    def partition(self, meshes: tuple[DisplayMesh, ...]) -> int:
        """Ask for the BSP tree of the triangles of these meshes, one after the other; the answer is a Partitioned.

        A newer question takes the place of this one, at work or waiting; one for no meshes ends it.
        """
        with self._lock:
            self._number += 1
            self._partition = Job(self._number, "partition", Document(), 0.0, meshes=meshes)
            number = self._number
        self._wake()
        return number

    def draw(
        self,
        document: Document,
        plan: Plan,
        tolerance: float = DEFAULT_TOLERANCE,
        solid: str | None = None,
        path: Path | str = "",
    ) -> int:
        """Ask for the page that is drawn of a document; the answer is a Drawn. A newer question takes its place.

        With a path the page is written there, whatever is asked for meanwhile; the answer is an Exported.
        """
        with self._lock:
            self._number += 1
            job = Job(self._number, "draw", document, tolerance, str(path), solid, plan=plan)
            if path:
                self._exports.append(job)
            else:
                self._drawing = job
            number = self._number
        self._wake()
        return number

    def stop_drawing(self) -> None:
        """Give up the page that is being drawn, or waits; no answer comes."""
        with self._lock:
            self._undrawn, self._drawing = self._number, None
        self._wake()

    def examine(self, document: Document, ids: tuple[str, ...], tolerance: float = DEFAULT_TOLERANCE) -> int:
        """Ask for nodes by themselves, as ghosts and measures need them; a newer question takes the place of this one.

        An evaluation that is asked for before the answer goes first.
        """
        with self._lock:
            self._number += 1
            self._examination = Job(self._number, "examine", document, tolerance, ids=ids)
            number = self._number
        self._wake()
        return number

    def prepare(self, document: Document, node_id: str, tolerances: tuple[float, ...] = (DEFAULT_TOLERANCE,)) -> None:
        """Get ready for changes of one operand, while nothing else is asked for: the rest is cut without it."""
        with self._lock:
            self._number += 1
            self._preparation = Job(
                self._number, "prepare", document, tolerances[0], solid=node_id, tolerances=tolerances
            )
        self._wake()

    def cancel(self) -> None:
        """Give up what is being done: its process is ended and another started. What is shown stays."""
        with self._lock:
            self._cancelled = True
            self._evaluation = None
            self._exports.clear()
            self._partition = self._drawing = self._examination = self._preparation = None
            # Not left to the thread, which waits as long as the worker does not read what it is being sent.
            if self._current is not None and self._process is not None:
                self._killed = True
                self._process.kill()
        self._wake()

    def close(self) -> None:
        """End the worker and the thread; waits for both."""
        self._closed = True
        self._wake()
        if self._thread.is_alive():
            self._thread.join()
        for end in (self._bell, self._ring):
            if end is not None:
                end.close()

    def _wake(self) -> None:
        if not self._closed:
            self.start()
        # Before there is a bell the thread has yet to look for its first request.
        if self._ring is not None:
            with contextlib.suppress(OSError, ValueError):
                self._ring.send(None)

    # The lane's thread.

    def _work(self) -> None:
        import multiprocessing  # late and here: a window that starts does not wait for it

        context = multiprocessing.get_context("spawn")
        self._bell, self._ring = context.Pipe(duplex=False)
        self._process = worker = WorkerProcess(context, str(self._store_folder))
        worker.start()
        job: Job | None = None
        while not self._closed:
            if job is None:
                job = self._next()
            try:
                if job is not None and job.tries == 0 and self._answered_from_pictures(job):
                    job = None
                    continue
                job = self._await(None if job is None else self._sent(job))
            except Refusal as refusal:  # a document that cannot be told to the worker
                if job is not None:
                    self._refuse(job, str(refusal))
                job = None
            except Exception as error:  # whatever it is: a lane that stands still would never answer again
                traceback.print_exc()
                worker.restart()
                self._tell(Died(None if job is None else job.number, f"the lane failed: {error}", True))
                job = None
        worker.end()

    def _next(self) -> Job | None:
        with self._lock:
            self._cancelled = False
            job: Job | None = None
            if self._evaluation is not None:
                job, self._evaluation = self._evaluation, None
            elif self._exports:
                job = self._exports.pop(0)
            elif self._drawing is not None:
                job, self._drawing = self._drawing, None
            elif self._partition is not None:
                job, self._partition = self._partition, None
            elif self._examination is not None:
                job, self._examination = self._examination, None
            else:
                job, self._preparation = self._preparation, None
            self._current = job
            killed, self._killed = self._killed, False
        if killed and self._process is not None:  # it had answered just before
            self._process.restart()
        return job

    def _answered_from_pictures(self, job: Job) -> bool:
        start = time.perf_counter()
        if job.word != "evaluate" or not self._pictures.complete(job.document, job.tolerance):
            return False
        self._tell_shown(job, start, 0)
        return True

    def _tell_shown(self, job: Job, start: float, evaluations: int) -> None:
        shown = self._pictures.shown(job.document, job.tolerance)
        self._tell(Evaluated(job.number, shown, time.perf_counter() - start, evaluations))

    def _sent(self, job: Job) -> Job:
        request = request_of(job, self._pictures.keys(), set(self._surfaces))
        assert self._process is not None and self._process.connection is not None
        with contextlib.suppress(OSError):  # a worker that is gone is noticed when its answer is read
            self._process.connection.send(request)
        return job

    def _await(self, job: Job | None) -> Job | None:
        """Until the job is answered (None), must be tried again (the job), or there is something to begin."""
        from multiprocessing.connection import wait

        superseding = False
        assert self._process is not None and self._bell is not None
        while not self._closed:
            connection = self._process.connection
            assert connection is not None
            for ready in wait([connection, self._bell]):
                if ready is self._bell:
                    self._bell.recv()
                    if self._closed:
                        return None
                    if job is None:
                        return None
                    if self._cancelled:
                        return self._after_cancel(job)
                    if not superseding and self._given_up(job):
                        superseding = True
                        with contextlib.suppress(OSError):
                            connection.send(("stop", 0))
                    continue
                try:
                    message = connection.recv()
                except (EOFError, OSError):
                    if self._cancelled and job is not None:
                        return self._after_cancel(job)
                    return self._after_death(job)
                if self._handled(message, job):
                    return None
        return None

    def _given_up(self, job: Job) -> bool:
        """Whether something newer takes the place of what is at work."""
        if job.word == "partition":
            return self._partition is not None
        if job.word == "draw":
            return not job.path and (self._drawing is not None or job.number <= self._undrawn)
        newer = self._evaluation
        return newer is not None and job.word != "export" and (newer.supersedes or job.supersedes)

    def _wait_for_a_request(self) -> None:
        """A worker that cannot even start is not started again before somebody asks for something."""
        assert self._bell is not None
        while not self._closed and not self._exports:
            if any(job is not None for job in (self._evaluation, self._partition, self._drawing)):
                return
            self._bell.recv()

    def _after_cancel(self, job: Job) -> None:
        assert self._process is not None
        self._killed = False
        self._process.restart()
        self._tell(Cancelled(job.number))

    def _after_death(self, job: Job | None) -> Job | None:
        assert self._process is not None
        reason = reason_of(self._process.exit_code())
        self._deaths += 1
        self._process.end()
        if self._deaths >= MOST_DEATHS:
            self._tell(Died(None if job is None else job.number, reason, True))
            self._wait_for_a_request()
            if not self._closed:
                self._deaths = 0
                self._process.start()
            return None
        self._process.start()
        if job is None:
            self._tell(Died(None, reason, False))
            return None
        job.tries += 1
        given_up = job.tries > 1
        self._tell(Died(job.number, reason, given_up))
        return None if given_up else job

    def _handled(self, message: tuple[Any, ...], job: Job | None) -> bool:
        """Whether the message ends the job."""
        match message:
            case ("started", pid):
                self._deaths = 0
                self._tell(Started(pid))
            case ("progress", number, done, total, label):
                if job is not None and number == job.number:
                    self._tell(Progress(number, done, total, label))
            case ("superseded", number) if job is not None and number == job.number:
                with self._lock:
                    if job.word == "examine" and self._examination is None:
                        self._examination = job  # it is still wanted, after what came between
                return True
            case ("examined", number, answers) if job is not None and number == job.number:
                self._tell(Examined(number, self._parts(answers)))
                return True
            case ("superseded" | "prepared", number):
                return job is not None and number == job.number
            case ("evaluated", number, answers, seconds, evaluations) if job is not None and number == job.number:
                self._pictures.keep(job.document, answers)
                self._tell_shown(job, time.perf_counter() - seconds, evaluations)
                return True
            case ("exported", number, path) if job is not None and number == job.number:
                self._tell(Exported(number, path, None))
                return True
            case ("drawn", number, page, messages) if job is not None and number == job.number:
                self._tell(Drawn(number, page, messages))
                return True
            case ("partitioned", number, tree, seconds) if job is not None and number == job.number:
                self._tell(Partitioned(number, tree, seconds))
                return True
            case ("refused", number, reason) if job is not None and number == job.number:
                self._refuse(job, reason)
                return True
        return False

    def _parts(self, answers: list[tuple[str, bytes, DisplayMesh | None, Measures | None]]) -> dict[str, Part]:
        parts = {}
        for node_id, key, mesh, measures in answers:
            self._surfaces.setdefault(key, mesh)
            self._surfaces.move_to_end(key)
            parts[node_id] = Part(key, self._surfaces[key], measures)
        while len(self._surfaces) > max(MOST_SURFACES, len(answers)):
            self._surfaces.popitem(last=False)
        return parts

    def _refuse(self, job: Job, reason: str) -> None:
        if job.path:
            self._tell(Exported(job.number, job.path, reason))
        elif job.word == "draw":
            self._tell(Drawn(job.number, None, (), reason))
        elif job.word == "partition":
            self._tell(Partitioned(job.number, None, 0.0, reason))
        elif job.word == "evaluate":
            self._tell(Evaluated(job.number, Shown({}, (Message("", "", reason, True),)), 0.0, 0))
