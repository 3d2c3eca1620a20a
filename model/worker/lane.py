"""A lane: one worker process, fed by a thread, so that whoever asks never waits and nothing shown is lost with it."""

from __future__ import annotations

import contextlib
import threading
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..document.document import Document, Section
from ..document.errors import Refusal
from ..solid.tessellation import DEFAULT_TOLERANCE
from .answers import Answers
from .job import Job, request_of
from .messages import Cancelled, Died, LaneMessage, Started
from .process import WorkerProcess, reason_of
from .waiting import Waiting

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from ..drafting.plan import Plan
    from ..solid.display import DisplayMesh


MOST_DEATHS = 3
"""After so many deaths without a sign of life in between, no further worker is started unasked."""


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
        self._waiting = Waiting()
        self._cancelled = False
        self._killed = False
        self._closed = False
        self._started = False
        self._deaths = 0
        self._number = 0
        self._answers = Answers(on_message, kept)
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
        return self._ask("evaluate", document, tolerance, supersedes=supersedes)

    def export(
        self,
        document: Document,
        path: Path | str,
        tolerance: float = DEFAULT_TOLERANCE,
        solid: str | None = None,
        section: Section | None = None,
    ) -> int:
        """Ask for a mesh file of all visible solids, or of the one with this name; of a section for its outlines."""
        return self._ask("export", document, tolerance, path=str(path), solid=solid, section=section)

    def partition(self, meshes: tuple[DisplayMesh, ...]) -> int:
        """Ask for the BSP tree of the triangles of these meshes, one after the other; the answer is a Partitioned.

        A newer question takes the place of this one, at work or waiting; one for no meshes ends it.
        """
        return self._ask("partition", Document(), 0.0, meshes=meshes)

    def draw(
        self,
        document: Document,
        plan: Plan,
        tolerance: float | None = None,
        solid: str | None = None,
        path: Path | str = "",
    ) -> int:
        """Ask for the page that is drawn of a document; the answer is a Drawn. A newer question takes its place.

        Without a tolerance it follows the scale.
        With a path the page is written there, whatever is asked for meanwhile; the answer is an Exported.
        """
        return self._ask("draw", document, tolerance or 0.0, path=str(path), solid=solid, plan=plan)

    def stop_drawing(self) -> None:
        """Give up the page that is being drawn, or waits; no answer comes."""
        self._stop("draw")

    def find_faults(self, document: Document, ids: tuple[str, ...], tolerance: float) -> int:
        """Ask for the faults of these nodes within a tolerance in mm, of all that is visible where there are none; the
        answer is a FaultsFound. A newer question takes its place, and `stop_finding` ends it.
        """
        return self._ask("faults", document, tolerance, ids=ids)

    def stop_finding(self) -> None:
        """Give up the faults that are looked for, or wait; no answer comes."""
        self._stop("faults")

    def check_pairs(self, document: Document, tolerance: float) -> int:
        """Ask which pairs of visible solids are not as the document asks; the answer is a PairsChecked. A newer
        question takes its place. Pairs that are as they were at the last one are not looked at again.
        """
        return self._ask("pairs", document, tolerance)

    def stop_checking_pairs(self) -> None:
        """Give up the pairs that are checked, or wait; no answer comes."""
        self._stop("pairs")

    def play(self, document: Document, motion: str, tolerance: float, between: bool = False) -> int:
        """Ask for a motion of the document step by step, `between` them too; the answer is a MotionPlayed. A newer
        question takes its place, and `stop_playing` ends it."""
        return self._ask("play", document, tolerance, solid=motion, between=between)

    def stop_playing(self) -> None:
        """Give up the motion that is looked at, or waits; no answer comes."""
        with self._lock:
            self._waiting.stop("play", self._number)
        self._wake()

    def examine(self, document: Document, ids: tuple[str, ...], tolerance: float = DEFAULT_TOLERANCE) -> int:
        """Ask for nodes by themselves, as ghosts and measures need them; a newer question takes the place of this one.

        An evaluation that is asked for before the answer goes first.
        """
        return self._ask("examine", document, tolerance, ids=ids)

    def prepare(self, document: Document, node_id: str, tolerances: tuple[float, ...] = (DEFAULT_TOLERANCE,)) -> None:
        """Get ready for changes of one operand, while nothing else is asked for: the rest is cut without it."""
        self._ask("prepare", document, tolerances[0], solid=node_id, tolerances=tolerances)

    def cancel(self) -> None:
        """Give up what is being done: its process is ended and another started. What is shown stays."""
        with self._lock:
            self._cancelled = True
            self._waiting.clear()
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

    def _ask(self, word: str, document: Document, tolerance: float, **particulars: Any) -> int:
        with self._lock:
            self._number += 1
            number = self._number
            self._waiting.put(Job(number, word, document, tolerance, **particulars))
        self._wake()
        return number

    def _stop(self, word: str) -> None:
        with self._lock:
            self._waiting.stop(word, self._number)
        self._wake()

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
                if job is not None and job.tries == 0 and self._answers.told_from_pictures(job):
                    job = None
                    continue
                job = self._await(None if job is None else self._sent(job))
            except Refusal as refusal:  # a document that cannot be told to the worker
                if job is not None:
                    self._answers.refuse(job, str(refusal))
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
            job = self._waiting.next()
            self._current = job
            killed, self._killed = self._killed, False
        if killed and self._process is not None:  # it had answered just before
            self._process.restart()
        return job

    def _sent(self, job: Job) -> Job:
        request = request_of(job, *self._answers.keys())
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
                    if not superseding and self._superseded(job):
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

    def _superseded(self, job: Job) -> bool:
        with self._lock:
            return self._waiting.supersedes(job)

    def _wait_for_a_request(self) -> None:
        """A worker that cannot even start is not started again before somebody asks for something."""
        assert self._bell is not None
        while not self._closed:
            with self._lock:
                if self._waiting.urgent:
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
        if message[0] == "started":
            self._deaths = 0
            self._tell(Started(message[1]))
            return False
        if job is None or not self._answers.end(job, message):
            return False
        if message[0] == "superseded" and job.word == "examine":
            with self._lock:
                self._waiting.put_back(job)  # it is still wanted, after what came between
        return True
