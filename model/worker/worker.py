"""The worker's side of a lane: a process that evaluates documents and keeps the solids."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..document.document import Section
from ..document.errors import Refusal
from ..document.nodes import Difference, Node
from ..document.resolve import Resolver
from ..document.table import Reuse, from_table
from ..document.tree import change, trail
from ..solid.display import DisplayMesh
from ..solid.entry import Superseded
from ..solid.evaluate import Evaluator
from ..solid.examine import examine
from ..solid.outlines.sheet import sheet_of
from ..solid.results import display_of, profile_result, result_of
from .shown import Message, shown_key

if TYPE_CHECKING:
    from ..drafting.drawn import Draughts
    from ..drafting.plan import Plan
    from ..proximity.memo import PairMemo

INTERVAL = 0.1
"""Seconds between two reports of progress."""
NICENESS = 5
"""How far the worker stands back, in the steps of Unix."""
SORTING = "Sorting faces"
PAIRS = "Pairs of solids"
MOST_FINDINGS = 5000
"""Of pairs, that are told: more than anybody reads through."""


def work(connection: Connection, store_folder: str) -> None:
    """Answer requests until the other side is gone."""
    _die_with_parent()
    _stand_back()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from ..project.assets import use_store

    use_store(Path(store_folder))
    worker = _Worker(connection)
    connection.send(("started", os.getpid()))
    try:
        while True:
            worker.answer(connection.recv())
    except (EOFError, BrokenPipeError, ConnectionResetError):
        pass


def _die_with_parent() -> None:
    """On Linux, end when the window does, even in the middle of a boolean."""
    if sys.platform == "linux":
        pr_set_pdeathsig = 1
        ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


def _stand_back() -> None:
    """Let the window draw first where both want the same processor."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)


class _Worker:
    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._evaluator = Evaluator(incremental=True)
        self._resolver = Resolver()
        self._reuse: Reuse = {}
        self._draughts: tuple[tuple[Any, ...], Draughts] | None = None
        self._pair_memo: PairMemo | None = None

    def answer(self, request: tuple[Any, ...]) -> None:
        word, number, *arguments = request
        if word == "stop":  # came when its request was answered already
            return
        try:
            result = getattr(self, "_" + word)(number, *arguments)
        except Superseded:
            result = ("superseded", number)
        except Refusal as refusal:
            result = ("refused", number, str(refusal))
        except MemoryError:
            result = ("refused", number, "there is not enough memory for this")
        self._connection.send(result)

    def _evaluate(self, number: int, table: dict[str, Any], tolerance: float, known: set[bytes]) -> tuple[Any, ...]:
        """Each visible solid, then each visible profile, as (key, mesh, measures, messages), of which a profile has no
        measures; those whose key is known as the key alone."""
        start, before = time.perf_counter(), self._evaluator.evaluations
        if len(self._reuse) > 4 * len(table["nodes"]) + 1000:
            self._reuse.clear()
        document = from_table(table, self._reuse)
        resolved = self._resolver.resolve(document)
        progress = _Progress(self._connection, number, len(table["nodes"]))
        answers: list[tuple[Any, ...]] = []
        for root in resolved.solids:
            if root.visible:
                key = shown_key(root, tolerance)
                answers.append((key,) if key in known else (key, *self._shown(root, tolerance, progress)))
        for root in resolved.profiles:
            if root.visible:
                key = shown_key(root, tolerance)
                answers.append((key,) if key in known else (key, *self._sheet(root, tolerance)))
        seconds = time.perf_counter() - start
        return "evaluated", number, answers, seconds, self._evaluator.evaluations - before

    def _shown(self, root: Node, tolerance: float, progress: _Progress) -> tuple[Any, Any, tuple[Message, ...]]:
        entry = self._evaluator.evaluate(root, tolerance, progress)
        progress.report("drawing")
        result = result_of(root, entry)
        return display_of(result, self._evaluator), result.measures(), result.messages

    def _sheet(self, root: Node, tolerance: float) -> tuple[DisplayMesh | None, None, tuple[Message, ...]]:
        result = profile_result(root)
        return None if result.path is None else sheet_of(root, tolerance), None, result.messages

    def _examine(
        self, number: int, table: dict[str, Any], tolerance: float, ids: tuple[str, ...], known: set[bytes]
    ) -> tuple[Any, ...]:
        """Each node by itself as (id, key, mesh, measures); without the mesh where its key is known."""
        document = from_table(table, self._reuse)
        solids = self._resolver.resolve(document).solids
        progress = _Progress(self._connection, number, len(table["nodes"]))
        return "examined", number, examine(self._evaluator, solids, ids, tolerance, known, progress)

    def _prepare(
        self, number: int, table: dict[str, Any], tolerances: tuple[float, ...], node_id: str
    ) -> tuple[Any, ...]:
        """Evaluate the solid without one operand, so that what it is cut from is at hand when it moves."""
        document = from_table(table, self._reuse)
        above = trail(document, node_id)[:-1]
        if any(isinstance(node, Difference) for node in above):
            without = change(document, node_id, lambda node: None)
            for root in self._resolver.resolve(without).solids:  # none of them where a definition holds the node
                for tolerance in tolerances if root.id == above[0].id else ():
                    self._evaluator.evaluate(root, tolerance, _Progress(self._connection, number, len(table["nodes"])))
        return "prepared", number

    def _export(
        self, number: int, table: dict[str, Any], path: str, tolerance: float, solid: str | None,
        section: Section | None = None,
    ) -> tuple[Any, ...]:  # fmt: skip
        progress = _Progress(self._connection, number, len(table["nodes"]))
        if section is None:
            from ..exchange.export import export_document

            export_document(from_table(table), Path(path), tolerance, solid, progress)
        else:
            from ..section.solid_sections import export_section

            export_section(from_table(table), section, Path(path), tolerance, solid, progress)
        return "exported", number, path

    def _partition(self, number: int, meshes: tuple[DisplayMesh, ...]) -> tuple[Any, ...]:
        """The BSP tree of all triangles."""
        from ..partition.build import build
        from ..partition.faces import faces_of_meshes

        start = time.perf_counter()
        progress = _Progress(self._connection, number, sum(len(mesh.corners) for mesh in meshes))
        try:
            tree = build(faces_of_meshes(meshes), progress=lambda done, total: progress.tell(done, total, SORTING))
        except (ValueError, OverflowError) as error:
            raise Refusal(str(error)) from error
        return "partitioned", number, tree, time.perf_counter() - start

    def _draw(
        self, number: int, table: dict[str, Any], tolerance: float | None, solid: str | None, plan: Plan, path: str
    ) -> tuple[Any, ...]:
        """The page of a plan, or where it was written; what the last plan had of this document is kept."""
        from ..drafting.drawing_file import write_page
        from ..drafting.drawn import Draughts

        progress = _Progress(self._connection, number, len(table["nodes"]))
        asked = (table, tolerance, solid)
        if self._draughts is None or self._draughts[0] != asked:
            self._draughts = (asked, Draughts(from_table(table), tolerance, solid))
        drawn = self._draughts[1].page(plan, progress, lambda label, share: progress.tell(int(100 * share), 100, label))
        if not path:
            return "drawn", number, drawn.page, drawn.messages
        write_page(path, drawn.page)
        return "exported", number, path

    def _faults(self, number: int, table: dict[str, Any], tolerance: float, ids: tuple[str, ...]) -> tuple[Any, ...]:
        from ..checking.document_faults import document_faults

        progress = _Progress(self._connection, number, 100)
        found = document_faults(
            from_table(table), tolerance, ids or None, lambda label, share: progress.tell(int(100 * share), 100, label)
        )
        return "faults", number, found

    def _play(
        self, number: int, table: dict[str, Any], tolerance: float, motion: str, between: bool
    ) -> tuple[Any, ...]:
        from ..proximity.moving.playing import play

        return (
            "played",
            number,
            play(from_table(table), motion, tolerance, _Progress(self._connection, number, 1).tell, between),
        )

    def _pairs(self, number: int, table: dict[str, Any], tolerance: float) -> tuple[Any, ...]:
        from ..proximity.checking import check_document
        from ..proximity.memo import PairMemo

        if self._pair_memo is None:
            self._pair_memo = PairMemo(self._evaluator, self._resolver)
        progress = _Progress(self._connection, number, len(table["nodes"]))
        report = check_document(
            from_table(table, self._reuse),
            tolerance,
            memo=self._pair_memo,
            progress=progress,
            told=lambda done, total: progress.tell(done, total, PAIRS),
            bodies=True,
            most=MOST_FINDINGS,
        )
        return "pairs", number, report


class _Progress:
    """Reports now and then, and stops when a newer request waits."""

    def __init__(self, connection: Connection, number: int, total: int) -> None:
        self._connection, self._number, self._total = connection, number, total
        self._done = 0
        self._next = time.perf_counter() + INTERVAL

    def __call__(self, label: str) -> None:
        self._done += 1
        self.report(label)

    def tell(self, done: int, total: int, label: str) -> None:
        self._done, self._total = done, total
        self.report(label)

    def report(self, label: str) -> None:
        now = time.perf_counter()
        if now < self._next:
            return
        self._next = now + INTERVAL
        if self._connection.poll():
            raise Superseded
        self._connection.send(("progress", self._number, min(self._done, self._total), self._total, label))
