"""The operations of a CSG tree on solids. Each is a generator: it asks for its operands and combines them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import Error, Manifold, OpType

from ..document.nodes import (
    Difference,
    Displace,
    Hull,
    Instance,
    Intersection,
    LinearArray,
    Minkowski,
    Mirror,
    Node,
    PolarArray,
    Union,
)
from ..document.placement import IDENTITY
from .combine import Operand, forced, union_of
from .entry import Bounds, Entry, Problem, Steps, Wanted, distinct
from .failure import NoSolid, words
from .unbounded import coarse

if TYPE_CHECKING:
    from .evaluate import Evaluator

LARGEST = 1e9
NOTHING = "holds nothing"
"""Messages are kept with the value, which has no name: they must make sense behind any."""

JOINING = (Union, LinearArray, PolarArray, Mirror, Instance)
"""Kinds whose value is the union of (copies of) their operands."""


def sound(solid: Manifold, node: Node) -> Manifold:
    """The solid, if the kernel made one of a size that can be reckoned with. Raises NoSolid."""
    if solid.status() != Error.NoError:
        raise NoSolid(f"{node.title}: {words(solid.status())}")
    if not solid.is_empty() and not np.abs(solid.bounding_box()).max() <= LARGEST:
        raise NoSolid(
            f"{node.title}: reaches farther than {LARGEST:g} mm from the origin; that is too large to be exact"
        )
    return solid


def _done(wanted: Wanted, solid: Manifold, problems: list[Problem], empty: str = "") -> Entry:
    """The entry of a result; where an operand failed, of a failure with a rest. `empty`: what to tell of nothing."""
    solid = sound(solid, wanted.node)
    if any(problem.error for problem in problems):
        return Entry(wanted.key, None, distinct(problems), solid)
    if empty and solid.is_empty():
        problems.append(Problem((), empty, False))
    return Entry(wanted.key, solid, distinct(problems))


def union(evaluator: Evaluator, wanted: Wanted) -> Steps:
    problems: list[Problem] = []
    operands = yield from evaluator.joined(wanted, (), wanted.node, IDENTITY, wanted.box, problems)
    empty = "" if operands else NOTHING
    return _done(
        wanted, forced(union_of(operands, evaluator.remember if evaluator.incremental else None)), problems, empty
    )


def difference(evaluator: Evaluator, wanted: Wanted) -> Steps:
    problems: list[Problem] = []
    node = wanted.node
    if not node.children:
        return _done(wanted, Manifold(), problems, NOTHING)
    box = wanted.box if evaluator.ends.endless(node.children[0]) else None
    first = yield from evaluator.operand(wanted, (0,), node.children[0], IDENTITY, box, problems)
    limits: Bounds | None = None
    tail: list[Operand] = []
    for place, child in enumerate(node.children[1:], 1):
        if evaluator.ends.endless(child):
            if first is None or first.solid.is_empty():
                continue
            if limits is None:
                limits = coarse(np.array(first.solid.bounding_box()).reshape(2, 3))
        tail += yield from evaluator.joined(wanted, (place,), child, IDENTITY, limits, problems)
    if first is None:
        return Entry(wanted.key, None, distinct(problems))
    if not tail:
        solid = first.solid
    elif evaluator.incremental:
        solid = evaluator.cuts.difference_of(first, tail, evaluator.remember)
    else:
        solid = forced(first.solid - union_of(tail))
    return _done(wanted, solid, problems, "" if first.solid.is_empty() else "nothing is left of the first operand")


def intersection(evaluator: Evaluator, wanted: Wanted) -> Steps:
    problems: list[Problem] = []
    node = wanted.node
    if not node.children:
        return _done(wanted, Manifold(), problems, NOTHING)
    found: dict[int, Operand] = {}
    limits: Bounds | None = None
    disjoint = False
    # Bounded operands first: their common box bounds the others.
    for place in sorted(range(len(node.children)), key=lambda i: evaluator.ends.endless(node.children[i])):
        child = node.children[place]
        endless = evaluator.ends.endless(child)
        box = (wanted.box if limits is None else coarse(limits)) if endless and not disjoint else None
        if endless and box is None:
            continue  # nothing is left of it, or what would have bounded it has failed
        operand = yield from evaluator.operand(wanted, (place,), child, IDENTITY, box, problems)
        if operand is None:
            continue
        found[place] = operand
        if operand.solid.is_empty():
            disjoint = True
        elif not endless:
            low, high = np.array(operand.solid.bounding_box()).reshape(2, 3)
            if limits is not None:
                low, high = np.maximum(limits[0], low), np.minimum(limits[1], high)
            disjoint = disjoint or bool((low > high).any())
            limits = np.array([low, high])
    solids = [found[place].solid for place in sorted(found)]
    if disjoint or not solids:
        solid = Manifold()
    else:
        solid = solids[0] if len(solids) == 1 else forced(Manifold.batch_boolean(solids, OpType.Intersect))
    return _done(wanted, solid, problems, "the operands have nothing in common")


def around(evaluator: Evaluator, wanted: Wanted) -> Steps:
    """Those of SURFACES: new surfaces, so the result is an original of its own."""
    problems: list[Problem] = []
    operands: list[Operand] = []
    node = wanted.node
    for place, child in enumerate(node.children):
        if evaluator.ends.endless(child):
            problems.append(Problem((place,), f"goes on without end; a {node.title.lower()} needs solids that end"))
            continue
        operand = yield from evaluator.operand(wanted, (place,), child, IDENTITY, None, problems)
        if operand is not None:
            operands.append(operand)
    if any(problem.error for problem in problems):
        return Entry(wanted.key, None, distinct(problems))
    if not operands:
        return _done(wanted, Manifold(), problems, NOTHING)
    if isinstance(node, Hull):
        solid = Manifold.batch_hull([operand.solid for operand in operands])
    elif isinstance(node, Displace):
        from .relief import displaced

        solid = displaced(node, operands[0].solid)
    else:
        solid = operands[0].solid
        for operand in operands[1:]:
            solid = solid.minkowski_sum(operand.solid)
    entry = evaluator.original(wanted, sound(forced(solid).as_original(), node))
    return Entry(entry.key, entry.solid, distinct(problems))


OPERATIONS: dict[type[Node], Callable[[Evaluator, Wanted], Steps]] = {
    **dict.fromkeys(JOINING, union),
    Difference: difference,
    Intersection: intersection,
    Hull: around,
    Minkowski: around,
    Displace: around,
}
