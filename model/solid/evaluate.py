"""Evaluation: a memoised pure function from nodes to solids.

Each kind of operation is a generator that asks for its operands' entries with `yield` and returns its own; a stack runs
them, so that no tree is too deep. The memo's key is a node's digest without its placement, the tolerance it is wanted
at, and, for what has no end, the box it is cut to.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Generator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from manifold3d import Error, Manifold, OpType
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.nodes import (
    Broken,
    Difference,
    Hull,
    Instance,
    Intersection,
    LinearArray,
    Minkowski,
    Mirror,
    Node,
    PolarArray,
    Union,
    range_fault,
)  # fmt: skip
from ..document.placement import IDENTITY, Placement, product
from ..document.primitives import OUTLINES, Halfspace
from .combine import Cuts, Operand, forced, joint_key, union_of
from .copies import copies
from .failure import NoSolid, words
from .leaves import solid_of
from .tessellation import DEFAULT_TOLERANCE
from .unbounded import Ends, bounding_reach, box_within, coarse, halfspace_box, mapped, planes_of

Bounds = NDArray[np.float64]  # (2, 3)
Key = tuple[bytes, float, bytes]


@dataclass(frozen=True, slots=True)
class Problem:
    """Something to tell about a node; `place` is the way down to it, the index of an operand at each level."""

    place: tuple[int, ...]
    message: str
    error: bool = True


@dataclass(frozen=True, slots=True)
class Entry:
    """What the memo keeps for a value: the solid in its own axes, or None where it failed, and what there is to say."""

    key: Key
    solid: Manifold | None
    problems: tuple[Problem, ...] = ()

    @property
    def bytes(self) -> int:
        return 400 if self.solid is None else 400 + 150 * self.solid.num_tri()


@dataclass(frozen=True, slots=True)
class Wanted:
    """One request of an operation: an operand under a map of this operation's own (a copy of an array, say)."""

    node: Node
    tolerance: float
    box: Bounds | None


Steps = Generator[Wanted, Entry, Entry]


class Superseded(Exception):
    """The result is no longer wanted."""


class Evaluator:
    """Evaluates resolved trees and remembers the solids, up to `limit` bytes.

    `incremental` lets a difference of many operands start from the last one like it: right for an editor, where the
    triangles of a flat face may then depend on the order of the edits; files are written without it.
    `evaluations` counts the entries that were not in the memo.
    """

    def __init__(self, limit: int = 2 << 30, incremental: bool = False) -> None:
        self.evaluations = 0
        self._limit = limit
        self.originals: dict[int, bytes] = {}
        """The digest of the leaf that each of manifold3d's originals was made for."""
        self._held = 0
        self._memo: OrderedDict[Key | bytes, Entry | Manifold] = OrderedDict()
        self._ends = Ends()
        self._cuts = Cuts() if incremental else None
        self._progress: Callable[[str], None] = lambda label: None

    def evaluate(
        self,
        root: Node,
        tolerance: float = DEFAULT_TOLERANCE,
        progress: Callable[[str], None] | None = None,
    ) -> Entry:
        """The entry of a resolved tree, with the root's placement applied.

        `progress(label)` is called before each operation and may raise Superseded to stop.
        """
        self._progress = progress or (lambda label: None)
        box = None
        if self._ends.endless(root):
            try:
                reach = self._reach(root, tolerance)
            except (NoSolid, Refusal) as fault:
                return Entry((root.digest, tolerance, b""), None, (Problem((), str(fault)),))
            box = np.array([[-reach] * 3, [reach] * 3])
        try:
            entry = self._run(Wanted(root, _local(tolerance, root.placement), box))
        except Refusal as fault:
            return Entry((root.digest, tolerance, b""), None, (Problem((), str(fault)),))
        if entry.solid is None:
            return entry
        if box is not None and not entry.solid.is_empty():
            low, high = np.array(entry.solid.bounding_box()).reshape(2, 3)
            if max(-low.min(), high.max()) > 0.75 * box[1, 0]:
                return Entry(entry.key, None, (*entry.problems, Problem((), _endless_words(root))))
        if not root.placement.steps:
            return entry
        try:
            return Entry(entry.key, _moved(entry.solid, root.placement.matrix()), entry.problems)
        except (NoSolid, Refusal) as fault:
            return Entry(entry.key, None, (*entry.problems, Problem((), str(fault))))

    def _reach(self, root: Node, tolerance: float) -> float:
        """How far from the origin a solid that half-spaces bound can have a vertex, in the root's axes, with room."""
        planes = planes_of(root, copies)
        extent = 0.0
        stack: list[tuple[Node, NDArray[np.float64]]] = [(root, IDENTITY)]
        while stack:
            node, matrix = stack.pop()
            if not self._ends.endless(node):
                entry = self._run(Wanted(node, tolerance, None))
                if entry.solid is not None and not entry.solid.is_empty():
                    bounds = np.array(entry.solid.bounding_box()).reshape(2, 3)
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
        stack: list[tuple[Key, Steps]] = [self._opened(wanted)]
        answer: Entry | None = None
        while stack:
            key, steps = stack[-1]
            try:
                asked = steps.send(answer)  # type: ignore[arg-type]  # None starts it
            except StopIteration as stop:
                answer = stop.value
            except (NoSolid, Refusal) as fault:
                answer = Entry(key, None, (Problem((), str(fault)),))
            else:
                answer = self._kept(asked)
                if answer is None:
                    stack.append(self._opened(asked))
                continue
            stack.pop()
            assert answer is not None
            self._keep(key, answer)
        assert answer is not None
        return answer

    def _opened(self, wanted: Wanted) -> tuple[Key, Steps]:
        self._progress(wanted.node.label)
        self.evaluations += 1
        return self._key(wanted), self._steps(wanted)

    def _key(self, wanted: Wanted) -> Key:
        cut = b"" if wanted.box is None else wanted.box.tobytes()
        return wanted.node.shape_digest, wanted.tolerance, cut

    def _kept(self, wanted: Wanted) -> Entry | None:
        key = self._key(wanted)
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

    def _remember(self, key: bytes, make: Callable[[], Manifold]) -> Manifold:
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
        if isinstance(node, OUTLINES):
            raise NoSolid(f"“{node.label}” is flat; extrude or revolve it to make a solid")
        operation = _OPERATIONS.get(type(node))
        if operation is not None:
            entry = yield from operation(self, wanted)
            return entry
        for place, child in enumerate(node.children):
            fault = child.message if isinstance(child, Broken) else range_fault(child)
            if fault:
                return Entry(self._key(wanted), None, (Problem((place,), fault),))
        if isinstance(node, Halfspace):
            assert wanted.box is not None
            return self._original(wanted, halfspace_box(node, wanted.box))
        return self._original(wanted, _sound(solid_of(node, wanted.tolerance), node))

    def _original(self, wanted: Wanted, solid: Manifold) -> Entry:
        if not solid.is_empty():
            self.originals[solid.original_id()] = wanted.node.shape_digest
        return Entry(self._key(wanted), solid)

    # Operations. Each asks for its operands and combines them.

    def _operand(self, wanted: Wanted, place: tuple[int, ...], child: Node, matrix: NDArray[np.float64],
                 box: Bounds | None, problems: list[Problem]) -> Generator[Wanted, Entry, Operand | None]:  # fmt: skip
        inner = None if box is None else box_within(box, matrix)
        scale = 1.0 if matrix is IDENTITY else _scale(matrix)
        entry = yield Wanted(child, _coarse_tolerance(wanted.tolerance, scale), inner)
        problems += [Problem((*place, *p.place), p.message, p.error) for p in entry.problems]
        if entry.solid is None:
            return None
        digest, tolerance, cut = entry.key
        key = joint_key(f"{tolerance}", [digest, cut, matrix.tobytes()])
        return Operand(key, entry.solid if matrix is IDENTITY else _moved(entry.solid, matrix))

    def _joined(
        self,
        wanted: Wanted,
        place: tuple[int, ...],
        node: Node,
        matrix: NDArray[np.float64],
        box: Bounds | None,
        problems: list[Problem],
    ) -> Generator[Wanted, Entry, list[Operand] | None]:
        """The operands whose union `node` is, those of unions within it included, so that the kernel sees them all at
        once; None where one failed."""
        operands: list[Operand] = []
        failed = False
        stack = [(place, node, matrix)]
        while stack:
            place, node, matrix = stack.pop()
            if type(node) is Union or (node is wanted.node and type(node) in _JOINING):
                level = []
                for copy in copies(node):
                    outer = _product(matrix, copy)
                    level += [((*place, i), c, _product(outer, _matrix(c))) for i, c in enumerate(node.children)]
                stack += reversed(level)
                continue
            limits = box if self._ends.endless(node) else None
            operand = yield from self._operand(wanted, place, node, matrix, limits, problems)
            failed = failed or operand is None
            if operand is not None:
                operands.append(operand)
        return None if failed else operands

    def _union(self, wanted: Wanted) -> Steps:
        problems: list[Problem] = []
        operands = yield from self._joined(wanted, (), wanted.node, IDENTITY, wanted.box, problems)
        if operands is None:
            return Entry(self._key(wanted), None, _distinct(problems))
        if not operands:
            problems.append(Problem((), f"“{wanted.node.label}” holds nothing", False))
        return self._done(wanted, forced(union_of(operands, self._remember)), problems)

    def _difference(self, wanted: Wanted) -> Steps:
        problems: list[Problem] = []
        children = wanted.node.children
        if not children:
            problems.append(Problem((), f"“{wanted.node.label}” holds nothing", False))
            return self._done(wanted, Manifold(), problems)
        box = wanted.box if self._ends.endless(children[0]) else None
        first = yield from self._operand(wanted, (0,), children[0], _matrix(children[0]), box, problems)
        limits: Bounds | None = None
        tail: list[Operand] = []
        failed = first is None
        for place, child in enumerate(children[1:], 1):
            if self._ends.endless(child):
                if first is None or first.solid.is_empty():
                    continue
                if limits is None:
                    limits = coarse(np.array(first.solid.bounding_box()).reshape(2, 3))
            operands = yield from self._joined(wanted, (place,), child, _matrix(child), limits, problems)
            failed = failed or operands is None
            tail += operands or ()
        if failed or first is None:
            return Entry(self._key(wanted), None, _distinct(problems))
        if self._cuts is not None:
            solid = self._cuts.difference_of(first, tail, self._remember)
        else:
            solid = first.solid - union_of(tail, self._remember) if tail else first.solid
        solid = forced(solid)
        if solid.is_empty() and not first.solid.is_empty():
            problems.append(Problem((), f"“{wanted.node.label}” leaves nothing", False))
        return self._done(wanted, solid, problems)

    def _intersection(self, wanted: Wanted) -> Steps:
        problems: list[Problem] = []
        children = wanted.node.children
        found: dict[int, Operand] = {}
        failed = False
        limits: Bounds | None = None
        # Bounded operands first: their common box bounds the others.
        order = sorted(range(len(children)), key=lambda i: self._ends.endless(children[i]))
        for place in order:
            child = children[place]
            endless = self._ends.endless(child)
            if endless and limits is not None and (limits[0] > limits[1]).any():
                continue
            box = (wanted.box if limits is None else coarse(limits)) if endless else None
            operand = yield from self._operand(wanted, (place,), child, _matrix(child), box, problems)
            if operand is None:
                failed = True
                continue
            found[place] = operand
            if not endless:
                bounds = np.array(operand.solid.bounding_box()).reshape(2, 3)
                if operand.solid.is_empty():
                    bounds = np.array([[1.0] * 3, [-1.0] * 3])
                limits = bounds if limits is None else np.array(
                    [np.maximum(limits[0], bounds[0]), np.minimum(limits[1], bounds[1])]
                )  # fmt: skip
        if failed:
            return Entry(self._key(wanted), None, _distinct(problems))
        solids = [found[place].solid for place in sorted(found)]
        if len(found) < len(children) or not solids:
            solid = Manifold()
        else:
            solid = solids[0] if len(solids) == 1 else forced(Manifold.batch_boolean(solids, OpType.Intersect))
        if not children:
            problems.append(Problem((), f"“{wanted.node.label}” holds nothing", False))
        elif solid.is_empty():
            problems.append(Problem((), f"the operands of “{wanted.node.label}” have nothing in common", False))
        return self._done(wanted, solid, problems)

    def _around(self, wanted: Wanted) -> Steps:
        """Hull and Minkowski sum: new surfaces, so the result is an original of its own."""
        problems: list[Problem] = []
        operands: list[Operand] = []
        node = wanted.node
        for place, child in enumerate(node.children):
            if self._ends.endless(child):
                raise NoSolid(f"“{child.label}” goes on without end; a {node.title.lower()} needs solids that end")
            operand = yield from self._operand(wanted, (place,), child, _matrix(child), None, problems)
            if operand is not None:
                operands.append(operand)
        if len(operands) < len(node.children):
            return Entry(self._key(wanted), None, _distinct(problems))
        if not operands:
            problems.append(Problem((), f"“{node.label}” holds nothing", False))
            return self._done(wanted, Manifold(), problems)
        if isinstance(node, Hull):
            solid = Manifold.batch_hull([operand.solid for operand in operands])
        else:
            solid = operands[0].solid
            for operand in operands[1:]:
                solid = solid.minkowski_sum(operand.solid)
        entry = self._original(wanted, _sound(forced(solid).as_original(), node))
        return Entry(entry.key, entry.solid, _distinct(problems))

    def _done(self, wanted: Wanted, solid: Manifold, problems: list[Problem]) -> Entry:
        return Entry(self._key(wanted), _sound(solid, wanted.node), _distinct(problems))


_JOINING = (Union, LinearArray, PolarArray, Mirror, Instance)
_OPERATIONS: dict[type[Node], Callable[[Evaluator, Wanted], Steps]] = {
    **dict.fromkeys(_JOINING, Evaluator._union),
    Difference: Evaluator._difference,
    Intersection: Evaluator._intersection,
    Hull: Evaluator._around,
    Minkowski: Evaluator._around,
}


def _sound(solid: Manifold, node: Node) -> Manifold:
    if solid.status() != Error.NoError:
        raise NoSolid(f"{node.title}: {words(solid.status())}")
    return solid


def _distinct(problems: list[Problem]) -> tuple[Problem, ...]:
    return tuple(dict.fromkeys(problems))


def _matrix(node: Node) -> NDArray[np.float64]:
    return node.placement.matrix() if node.placement.steps else IDENTITY


def _product(outer: NDArray[np.float64], inner: NDArray[np.float64]) -> NDArray[np.float64]:
    if outer is IDENTITY:
        return inner
    return outer if inner is IDENTITY else product(outer, inner)


def _moved(solid: Manifold, matrix: NDArray[np.float64]) -> Manifold:
    if abs(float(np.linalg.det(matrix[:, :3]))) < 1e-300:
        raise NoSolid("a scale factor is 0: the solid would be flat")
    return solid.transform(matrix)


@lru_cache(maxsize=1 << 12)
def _scale_of(linear: bytes) -> float:
    return float(np.linalg.norm(np.frombuffer(linear).reshape(3, 3), 2))


def _scale(matrix: NDArray[np.float64]) -> float:
    """By how much a (3, 4) map stretches what it stretches most."""
    return _scale_of(matrix[:, :3].tobytes())


def _coarse_tolerance(tolerance: float, scale: float) -> float:
    """`tolerance` before the map, in steps of the square root of two, never coarser than asked."""
    if abs(scale - 1) < 1e-9 or scale <= 0:
        return tolerance
    return float(tolerance / 2.0 ** (np.ceil(2 * np.log2(scale) - 1e-9) / 2))


def _local(tolerance: float, placement: Placement) -> float:
    return _coarse_tolerance(tolerance, _scale(placement.matrix())) if placement.steps else tolerance


def _endless_words(root: Node) -> str:
    return f"“{root.label}” goes on without end: intersect the half-space with something that has one"
