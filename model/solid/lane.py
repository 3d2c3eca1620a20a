"""A lane: one worker process, fed by a thread, so that whoever asks never waits and nothing shown is lost with it."""

from __future__ import annotations

import contextlib
import multiprocessing
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from ..document.document import Document
from ..document.nodes import Node
from ..document.resolve import Resolver
from ..document.table import to_table
from .display import DisplayMesh
from .measure import Measures
from .results import Message, relabelled
from .tessellation import DEFAULT_TOLERANCE
from .worker import serve, shown_key


@dataclass(frozen=True, slots=True)
class ShownSolid:
    """What a picture shows of one root. Equal keys are the same picture; `mesh` is None where the solid failed."""

    key: bytes
    mesh: DisplayMesh | None
    measures: Measures | None


@dataclass(frozen=True, slots=True)
class Shown:
    """The visible solids by their root's id, and what there is to tell about nodes."""

    solids: dict[str, ShownSolid]
    problems: tuple[Message, ...]


@dataclass(frozen=True, slots=True)
class Started:
    """A worker is ready."""

    pid: int


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a request is: operations done of all, and the name of the one at work."""

    request: int
    done: int
    total: int
    label: str


@dataclass(frozen=True, slots=True)
class Evaluated:
    """The answer to `Lane.evaluate`; `evaluations` counts the nodes that were not in the worker's memo."""

    request: int
    shown: Shown
    seconds: float
    evaluations: int


@dataclass(frozen=True, slots=True)
class Exported:
    """The answer to `Lane.export`; `fault` says in words why no file was written."""

    request: int
    path: str
    fault: str | None


@dataclass(frozen=True, slots=True)
class Cancelled:
    """The request was given up because the user asked for it."""

    request: int


@dataclass(frozen=True, slots=True)
class Died:
    """The worker ended by itself. The request is tried once more; `given_up` says that this was the second time."""

    request: int | None
    reason: str
    given_up: bool


LaneMessage = Started | Progress | Evaluated | Exported | Cancelled | Died


@dataclass(slots=True)
class _Job:
    number: int
    word: str
    document: Document
    tolerance: float
    path: str = ""
    solid: str | None = None
    tries: int = 0


class Lane:
    """Evaluates and exports in a process of its own. `on_message` is called from the lane's thread.

    A newer evaluation supersedes an older one. The pictures of the last solids are kept here by key, `kept` bytes of
    them, so that going back to them asks nobody.
    """

    def __init__(self, on_message: Callable[[LaneMessage], None], store_folder: Path, kept: int = 512 << 20) -> None:
        self._tell = on_message
        self._store_folder = store_folder
        self._context = multiprocessing.get_context("spawn")
        self._process: Any = None
        self._connection: Connection | None = None
        self._bell, self._ring = self._context.Pipe(duplex=False)
        self._lock = threading.Lock()
        self._evaluation: _Job | None = None
        self._exports: list[_Job] = []
        self._cancelled = False
        self._closed = False
        self._number = 0
        self._resolver = Resolver()
        self._limit = kept
        self._kept: OrderedDict[bytes, tuple[ShownSolid, tuple[tuple[tuple[int, ...], Message], ...]]] = OrderedDict()
        self._by_root: dict[str, ShownSolid] = {}
        self._thread = threading.Thread(target=self._work, name="solidtree lane", daemon=True)

    @property
    def pid(self) -> int | None:
        """The worker's process id, for tests and supervision."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start the worker; returns at once."""
        self._thread.start()

    def evaluate(self, document: Document, tolerance: float = DEFAULT_TOLERANCE) -> int:
        """Ask for a document's pictures and measures; the result is the number that the answer will carry."""
        with self._lock:
            self._number += 1
            self._evaluation = _Job(self._number, "evaluate", document, tolerance)
            number = self._number
        self._wake()
        return number

    def export(
        self, document: Document, path: Path | str, tolerance: float = DEFAULT_TOLERANCE, solid: str | None = None
    ) -> int:
        """Ask for a mesh file of all visible solids, or of the one with this name."""
        with self._lock:
            self._number += 1
            self._exports.append(_Job(self._number, "export", document, tolerance, str(path), solid))
            number = self._number
        self._wake()
        return number

    def cancel(self) -> None:
        """Give up what is being done: its process is ended and another started. What is shown stays."""
        with self._lock:
            self._cancelled = True
            self._evaluation = None
            self._exports.clear()
        self._wake()

    def close(self) -> None:
        """End the worker and the thread; waits for both."""
        self._closed = True
        self._wake()
        if self._thread.is_alive():
            self._thread.join()
        self._bell.close()
        self._ring.close()

    def _wake(self) -> None:
        with contextlib.suppress(OSError, ValueError):
            self._ring.send(None)

    # The lane's thread.

    def _work(self) -> None:
        self._spawn()
        job: _Job | None = None
        while not self._closed:
            if job is None:
                job = self._next()
            if job is not None and job.tries == 0 and self._answered_from_kept(job):
                job = None
                continue
            job = self._await(None if job is None else self._sent(job))
        self._end()

    def _next(self) -> _Job | None:
        with self._lock:
            self._cancelled = False
            if self._evaluation is not None:
                job, self._evaluation = self._evaluation, None
                return job
            return self._exports.pop(0) if self._exports else None

    def _sent(self, job: _Job) -> _Job:
        table = to_table(job.document)
        if job.word == "evaluate":
            request: tuple[Any, ...] = ("evaluate", job.number, table, job.tolerance, set(self._kept))
        else:
            request = ("export", job.number, table, job.path, job.tolerance, job.solid)
        assert self._connection is not None
        with contextlib.suppress(OSError):  # a worker that is gone is noticed when its answer is read
            self._connection.send(request)
        return job

    def _await(self, job: _Job | None) -> _Job | None:
        """Until the job is answered (None), must be tried again (the job), or there is something to begin."""
        superseding = False
        while not self._closed:
            assert self._connection is not None
            for ready in wait([self._connection, self._bell]):
                if ready is self._bell:
                    self._bell.recv()
                    if self._closed:
                        return None
                    if job is None:
                        return None
                    if self._cancelled:
                        self._respawn()
                        self._tell(Cancelled(job.number))
                        return None
                    if self._evaluation is not None and job.word == "evaluate" and not superseding:
                        superseding = True
                        with contextlib.suppress(OSError):
                            self._connection.send(("stop", 0))
                    continue
                try:
                    message = self._connection.recv()
                except (EOFError, OSError):
                    return self._after_death(job)
                if self._handled(message, job):
                    return None
        return None

    def _after_death(self, job: _Job | None) -> _Job | None:
        process = self._process
        process.join()
        reason = _reason(process.exitcode)
        self._respawn()
        if job is None:
            self._tell(Died(None, reason, False))
            return None
        job.tries += 1
        given_up = job.tries > 1
        self._tell(Died(job.number, reason, given_up))
        return None if given_up else job

    def _handled(self, message: tuple[Any, ...], job: _Job | None) -> bool:
        """Whether the message ends the job."""
        match message:
            case ("started", pid):
                self._tell(Started(pid))
            case ("progress", number, done, total, label):
                if job is not None and number == job.number:
                    self._tell(Progress(number, done, total, label))
            case ("superseded", number):
                return job is not None and number == job.number
            case ("evaluated", number, answers, seconds, evaluations) if job is not None and number == job.number:
                self._keep(job, answers)
                self._tell(Evaluated(number, self._shown(job), seconds, evaluations))
                return True
            case ("exported", number, path) if job is not None and number == job.number:
                self._tell(Exported(number, path, None))
                return True
            case ("refused", number, reason) if job is not None and number == job.number:
                if job.word == "export":
                    self._tell(Exported(number, job.path, reason))
                else:
                    fault = Message("", "", reason, True)
                    self._tell(Evaluated(number, Shown({}, (fault,)), 0.0, 0))
                return True
        return False

    # Pictures kept by key.

    def _roots(self, job: _Job) -> list[Node]:
        return [root for root in self._resolver.resolve(job.document).solids if root.visible]

    def _answered_from_kept(self, job: _Job) -> bool:
        if job.word != "evaluate":
            return False
        start = time.perf_counter()
        if any(shown_key(root, job.tolerance) not in self._kept for root in self._roots(job)):
            return False
        self._tell(Evaluated(job.number, self._shown(job), time.perf_counter() - start, 0))
        return True

    def _keep(self, job: _Job, answers: list[tuple[Any, ...]]) -> None:
        for root, answer in zip(self._roots(job), answers, strict=True):
            if len(answer) > 1:
                key, mesh, measures, messages = answer
                ways = _ways(root, {message.node_id for message in messages})
                placed = tuple((ways.get(message.node_id, ()), message) for message in messages)
                self._kept[key] = (ShownSolid(key, mesh, measures), placed)
        held = sum(_bytes(solid) for solid, _ in self._kept.values())
        current = {answer[0] for answer in answers}
        for key in list(self._kept):
            if held <= self._limit:
                break
            if key not in current:
                held -= _bytes(self._kept.pop(key)[0])

    def _shown(self, job: _Job) -> Shown:
        """The document's pictures from what is kept, with the ids of this document."""
        solids: dict[str, ShownSolid] = {}
        problems: list[Message] = []
        for root in self._roots(job):
            key = shown_key(root, job.tolerance)
            kept, placed = self._kept[key]
            self._kept.move_to_end(key)
            solid = self._by_root.get(root.id)
            if solid is None or solid.key != key or not _same_ids(solid, root):
                mesh = None if kept.mesh is None else relabelled(kept.mesh, root)
                solid = kept if mesh is kept.mesh else ShownSolid(key, mesh, kept.measures)
            solids[root.id] = solid
            for way, message in placed:
                node = root
                for index in way:
                    node = node.children[index]
                problems.append(Message(node.id, node.label, message.message, message.error))
        self._by_root = solids
        return Shown(solids, tuple(problems))

    # The process.

    def _spawn(self) -> None:
        ours, theirs = self._context.Pipe()
        self._process = self._context.Process(
            target=serve, args=(theirs, str(self._store_folder)), name="solidtree worker", daemon=True
        )
        self._process.start()
        theirs.close()
        self._connection = ours

    def _respawn(self) -> None:
        self._end()
        self._spawn()

    def _end(self) -> None:
        if self._connection is not None:
            self._connection.close()
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._process.close()
            self._process = None


def _reason(code: int | None) -> str:
    if code == -9:
        return "the worker was ended from outside, or ran out of memory"
    return f"the worker ended unexpectedly (status {code})"


def _ways(root: Node, ids: set[str]) -> dict[str, tuple[int, ...]]:
    """The way down to each of these nodes: the index of the operand at each level."""
    found: dict[str, tuple[int, ...]] = {}
    stack: list[tuple[Node, tuple[int, ...]]] = [(root, ())] if ids else []
    while stack and len(found) < len(ids):
        node, way = stack.pop()
        if node.id in ids:
            found.setdefault(node.id, way)
        stack += [(child, (*way, i)) for i, child in enumerate(node.children)]
    return found


def _same_ids(solid: ShownSolid, root: Node) -> bool:
    return solid.mesh is None or relabelled(solid.mesh, root) is solid.mesh


def _bytes(solid: ShownSolid) -> int:
    mesh = solid.mesh
    if mesh is None:
        return 100
    arrays = (mesh.points, mesh.normals, mesh.triangles, mesh.owner, mesh.facet, mesh.edge_points, mesh.edges)
    return sum(array.nbytes for array in arrays)
