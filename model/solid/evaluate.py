"""Evaluation: a memoised pure function from nodes to solids.

Each kind of operation is a generator that asks for its operands' entries with `yield` and returns its own; a stack runs
them, so that no tree is too deep.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Generator

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.from_outlines import FROM_OUTLINES
from ..document.nodes import Broken, Node, Union, range_fault
from ..document.outlines import is_outline
from ..document.placement import IDENTITY, product
from ..document.primitives import Halfspace
from .combine import Cuts, Operand, joint_key
from .copies import MOST_OCCURRENCES, copies, occurrence_count
from .entry import Bounds, Entry, Key, Problem, Steps, Wanted
from .failure import NoSolid
from .leaves import solid_of
from .maps import chained, matrix_of, moved, placed_tolerance, tolerance_before
from .operations import JOINING, OPERATIONS, sound
from .outlines import from_outlines as from_outlines  # these three register what they make
from .outlines import lofts as lofts
from .outlines import sweeps as sweeps
from .outlines.drawn import drawn_solid
from .outlines.profiles import outline_problems
from .tessellation import DEFAULT_TOLERANCE
from .unbounded import Ends, bounding_reach, box_within, halfspace_box, mapped, planes_of

ENDLESS = "goes on without end: intersect the half-space with something that has one"
OVERFLOW = "the numbers are too large or too small to make a solid of"
SMALL = 1 << 20
"""Placed operands below so many bytes are kept, up to an eighth of the memo's limit: a wide operation has thousands."""


class Evaluator:
    """Evaluates resolved trees and remembers the solids, up to `limit` bytes.

    `incremental` cuts wide unions into a hidden tree, and lets a difference of many operands start from the last one
    like it: right for an editor, where the triangles of a flat face may then depend on the order of the edits; files
    are written without it.
    `evaluations` counts the entries that were not in the memo.
    """

    def __init__(self, limit: int = 2 << 30, incremental: bool = False) -> None:
        self.evaluations = 0
        self._limit = limit
        self.originals: dict[int, bytes] = {}
        """The digest of the leaf that each of manifold3d's originals was made for."""
        self._held = 0
        self._memo: OrderedDict[Key | bytes, Entry | Manifold] = OrderedDict()
        self._operands: dict[tuple[bytes, float, bytes, bytes], Operand] = {}
        self._operand_bytes = 0
        self.ends = Ends()
        self.incremental = incremental
        self.cuts = Cuts()
        self._progress: Callable[[str], None] = lambda label: None

    def evaluate(
        self,
        root: Node,
        tolerance: float = DEFAULT_TOLERANCE,
        progress: Callable[[str], None] | None = None,
    ) -> Entry:
        """The entry of a resolved tree, with the root's placement applied.

        `progress(label)` is called when a node is done, with the name of the next, and may raise Superseded to stop.
        """
        self._progress = progress or (lambda label: None)
        with np.errstate(all="ignore"):  # what overflows is told in words
            try:
                return self._evaluated(root, tolerance)
            except (ArithmeticError, ValueError, np.linalg.LinAlgError):
                return Entry((root.digest, tolerance, b""), None, (Problem((), OVERFLOW),))

    def within(
        self, node: Node, tolerance: float, box: Bounds | None, progress: Callable[[str], None] | None = None
    ) -> Entry:
        """The entry of a resolved node in its own axes, before its placement, cut to `box` (2, 3) if it has no end."""
        self._progress = progress or (lambda label: None)
        with np.errstate(all="ignore"):
            wanted = Wanted(node, tolerance, box)
            try:
                entry = self._run(wanted)
                if box is None or entry.seen is None:
                    return entry
                # What has no end covers more than the box; only what lies within is meant.
                low, high = box
                room = Manifold.cube(tuple(high - low)).translate(tuple(low))
                return Entry(entry.key, entry.seen ^ room, entry.problems)
            except (ArithmeticError, ValueError, np.linalg.LinAlgError):
                return Entry(wanted.key, None, (Problem((), OVERFLOW),))

    def _evaluated(self, root: Node, tolerance: float) -> Entry:
        count = occurrence_count(root)
        if count > MOST_OCCURRENCES:
            fault = f"unfolds to {count:,} parts; at most {MOST_OCCURRENCES:,} are made"
            return Entry((root.digest, tolerance, b""), None, (Problem((), fault),))
        box = None
        if self.ends.endless(root):
            try:
                reach = self._reach(root, tolerance)
            except (NoSolid, Refusal) as fault:
                return Entry((root.digest, tolerance, b""), None, (Problem((), str(fault)),))
            box = np.array([[-reach] * 3, [reach] * 3])
        try:
            entry = self._run(Wanted(root, placed_tolerance(tolerance, root.placement), box))
        except Refusal as fault:
            return Entry((root.digest, tolerance, b""), None, (Problem((), str(fault)),))
        seen = entry.seen
        if seen is None:
            return entry
        if box is not None and not seen.is_empty():
            low, high = np.array(seen.bounding_box()).reshape(2, 3)
            if max(-low.min(), high.max()) > 0.75 * box[1, 0]:
                return self._without_end(root, tolerance, entry)
        try:
            seen = sound(moved(seen, root.placement.matrix()), root) if root.placement.steps else seen
        except (NoSolid, Refusal) as fault:
            return Entry(entry.key, None, (*entry.problems, Problem((), str(fault))))
        if entry.solid is None:
            return Entry(entry.key, None, entry.problems, seen)
        return Entry(entry.key, seen, entry.problems)

    def _without_end(self, root: Node, tolerance: float, entry: Entry) -> Entry:
        """The entry of a root that goes on for ever; of a union the operands that do are to blame, the rest is seen."""
        endless = [self.ends.endless(child) for child in root.children]
        if not isinstance(root, Union) or all(endless):
            return Entry(entry.key, None, (*entry.problems, Problem((), ENDLESS)))
        blamed = [Problem((place,), ENDLESS) for place, without in enumerate(endless) if without]
        kept = tuple(child for child, without in zip(root.children, endless, strict=True) if not without)
        rest = self._evaluated(root.with_(children=kept), tolerance)
        return Entry(entry.key, None, (*entry.problems, *blamed), rest.seen)

    def _reach(self, root: Node, tolerance: float) -> float:
        """How far from the origin a solid that half-spaces bound can have a vertex, in the root's axes, with room."""
        planes = planes_of(root, copies)
        extent = 0.0
        stack: list[tuple[Node, NDArray[np.float64]]] = [(root, IDENTITY)]
        while stack:
            node, matrix = stack.pop()
            if not self.ends.endless(node):
                entry = self._run(Wanted(node, tolerance, None))
                if entry.seen is not None and not entry.seen.is_empty():
                    bounds = np.array(entry.seen.bounding_box()).reshape(2, 3)
                    extent = max(extent, float(np.abs(mapped(bounds, matrix)).max()))
                continue
            for copy in copies(node):
                stack += [(c, product(product(matrix, copy), c.placement.matrix())) for c in node.children]
        return bounding_reach(planes, extent)

    def _run(self, wanted: Wanted) -> Entry:
        """Runs the generators of a tree on a stack of its own."""
        entry = self._kept(wanted)
        if entry is not None:
            return entry
        stack: list[tuple[Key, Steps, str]] = [self._opened(wanted)]
        answer: Entry | None = None
        while stack:
            key, steps, label = stack[-1]
            try:
                asked = steps.send(answer)  # type: ignore[arg-type]  # None starts it
            except StopIteration as stop:
                answer = stop.value
            except (NoSolid, Refusal) as fault:
                answer = Entry(key, None, (Problem((), str(fault)),))
            except (ArithmeticError, ValueError, np.linalg.LinAlgError):
                answer = Entry(key, None, (Problem((), OVERFLOW),))
            else:
                answer = self._kept(asked)
                if answer is None:
                    stack.append(self._opened(asked))
                continue
            stack.pop()
            assert answer is not None
            self._keep(key, answer)
            self._progress(stack[-1][2] if stack else label)
        assert answer is not None
        return answer

    def _opened(self, wanted: Wanted) -> tuple[Key, Steps, str]:
        self.evaluations += 1
        return wanted.key, self._steps(wanted), wanted.node.label

    def _kept(self, wanted: Wanted) -> Entry | None:
        key = wanted.key
        entry = self._memo.get(key)
        if entry is not None:
            self._memo.move_to_end(key)
        return entry  # type: ignore[return-value]

    def _keep(self, key: Key | bytes, value: Entry | Manifold) -> None:
        size = value.bytes if isinstance(value, Entry) else 150 * value.num_tri()
        self._memo[key] = value
        self._held += size
        while self._held > self._limit and len(self._memo) > 1:
            _, old = self._memo.popitem(last=False)
            self._held -= old.bytes if isinstance(old, Entry) else 150 * old.num_tri()

    def remember(self, key: bytes, make: Callable[[], Manifold]) -> Manifold:
        """The kept solid of a key of combine.py, or what `make` makes."""
        solid = self._memo.get(key)
        if solid is None:
            solid = make()
            self._keep(key, solid)
        return solid  # type: ignore[return-value]

    def _steps(self, wanted: Wanted) -> Steps:
        node = wanted.node
        if isinstance(node, Broken):
            raise NoSolid(node.message)
        fault = range_fault(node)
        if fault:
            raise NoSolid(fault)
        if is_outline(node):
            raise NoSolid(f"{node.title}: an outline is flat; extrude or revolve it to make a solid")
        operation = OPERATIONS.get(type(node))
        if operation is not None:
            return (yield from operation(self, wanted))
        if isinstance(node, Halfspace):
            assert wanted.box is not None
            return self.original(wanted, halfspace_box(node, wanted.box))
        if not isinstance(node, FROM_OUTLINES):
            return self.original(wanted, sound(solid_of(node, wanted.tolerance), node))
        try:
            return self.original(wanted, sound(drawn_solid(node, wanted.tolerance), node))
        except (NoSolid, Refusal):
            blamed = [Problem((place, *problem.place), problem.message)
                      for place, child in enumerate(node.children) for problem in outline_problems(child)]  # fmt: skip
            if not blamed:
                raise
            return Entry(wanted.key, None, tuple(blamed))

    def original(self, wanted: Wanted, solid: Manifold) -> Entry:
        """The entry of a solid that begins here: its faces will name this node's value."""
        if not solid.is_empty():
            self.originals[solid.original_id()] = wanted.node.shape_digest
        return Entry(wanted.key, solid)

    def operand(self, wanted: Wanted, place: tuple[int, ...], child: Node, outer: NDArray[np.float64],
                 box: Bounds | None, problems: list[Problem]) -> Generator[Wanted, Entry, Operand | None]:  # fmt: skip
        """The child, placed by its own placement and then by `outer`, cut to `box`; None where it failed."""
        known = (child.digest, wanted.tolerance, b"" if outer is IDENTITY else outer.tobytes(),
                 b"" if box is None else box.tobytes())  # fmt: skip
        operand = self._operands.get(known)
        if operand is not None:
            return operand
        matrix = chained(outer, matrix_of(child))
        inner = None if box is None else box_within(box, matrix)
        entry = yield Wanted(child, tolerance_before(wanted.tolerance, matrix), inner)
        problems += [Problem((*place, *p.place), p.message, p.error) for p in entry.problems]
        if entry.seen is None:
            return None
        digest, tolerance, cut = entry.key
        key = joint_key(f"{tolerance}", [digest, cut, matrix.tobytes()])
        operand = Operand(key, entry.seen if matrix is IDENTITY else moved(entry.seen, matrix))
        if entry.bytes < SMALL and not entry.problems:
            self._operand_bytes += entry.bytes
            if self._operand_bytes > self._limit // 8:
                self._operands.clear()
                self._operand_bytes = entry.bytes
            self._operands[known] = operand
        return operand

    def joined(
        self,
        wanted: Wanted,
        place: tuple[int, ...],
        node: Node,
        outer: NDArray[np.float64],
        box: Bounds | None,
        problems: list[Problem],
    ) -> Generator[Wanted, Entry, list[Operand]]:
        """The operands whose union `node` is, those of unions within it included, so that the kernel sees them all at
        once; without those that failed, of which the problems tell."""
        operands: list[Operand] = []
        stack = [(place, node, outer)]
        while stack:
            place, node, outer = stack.pop()
            if type(node) is Union or (node is wanted.node and type(node) in JOINING):
                level = []
                inner = outer if node is wanted.node else chained(outer, matrix_of(node))
                for copy in copies(node):
                    below = chained(inner, copy)
                    level += [((*place, i), child, below) for i, child in enumerate(node.children)]
                stack += reversed(level)
                continue
            limits = box if self.ends.endless(node) else None
            operand = yield from self.operand(wanted, place, node, outer, limits, problems)
            if operand is not None:
                operands.append(operand)
        return operands
