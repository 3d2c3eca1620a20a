"""The operations of a CSG tree on solids. Each is a generator: it asks for its operands and combines them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import Error, Manifold, OpType

from ..document.nodes import (
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
)
from ..document.placement import IDENTITY
from .combine import Operand, forced, union_of
from .entry import Bounds, Entry, Problem, Steps, Wanted, distinct
from .failure import NoSolid, words
from .unbounded import coarse

if TYPE_CHECKING:
    from .evaluate import Evaluator

JOINING = (Union, LinearArray, PolarArray, Mirror, Instance)
"""Kinds whose value is the union of (copies of) their operands."""


def sound(solid: Manifold, node: Node) -> Manifold:
    """The solid, if the kernel made one. Raises NoSolid."""
    if solid.status() != Error.NoError:
        raise NoSolid(f"{node.title}: {words(solid.status())}")
    return solid


def _done(wanted: Wanted, solid: Manifold, problems: list[Problem]) -> Entry:
    return Entry(wanted.key, sound(solid, wanted.node), distinct(problems))


def union(evaluator: Evaluator, wanted: Wanted) -> Steps:
    problems: list[Problem] = []
    operands = yield from evaluator.joined(wanted, (), wanted.node, IDENTITY, wanted.box, problems)
    if operands is None:
        return Entry(wanted.key, None, distinct(problems))
    if not operands:
        problems.append(Problem((), f"“{wanted.node.label}” holds nothing", False))
    return _done(wanted, forced(union_of(operands, evaluator.remember)), problems)


def difference(evaluator: Evaluator, wanted: Wanted) -> Steps:
    problems: list[Problem] = []
    children = wanted.node.children
    if not children:
        problems.append(Problem((), f"“{wanted.node.label}” holds nothing", False))
        return _done(wanted, Manifold(), problems)
    box = wanted.box if evaluator.ends.endless(children[0]) else None
    first = yield from evaluator.operand(wanted, (0,), children[0], IDENTITY, box, problems)
    limits: Bounds | None = None
    tail: list[Operand] = []
    failed = first is None
    for place, child in enumerate(children[1:], 1):
        if evaluator.ends.endless(child):
            if first is None or first.solid.is_empty():
                continue
            if limits is None:
                limits = coarse(np.array(first.solid.bounding_box()).reshape(2, 3))
        operands = yield from evaluator.joined(wanted, (place,), child, IDENTITY, limits, problems)
        failed = failed or operands is None
        tail += operands or ()
    if failed or first is None:
        return Entry(wanted.key, None, distinct(problems))
    if evaluator.cuts is not None:
        solid = evaluator.cuts.difference_of(first, tail, evaluator.remember)
    else:
        solid = first.solid - union_of(tail, evaluator.remember) if tail else first.solid
    solid = forced(solid)
    if solid.is_empty() and not first.solid.is_empty():
        problems.append(Problem((), f"“{wanted.node.label}” leaves nothing", False))
    return _done(wanted, solid, problems)


def intersection(evaluator: Evaluator, wanted: Wanted) -> Steps:
    problems: list[Problem] = []
    children = wanted.node.children
    found: dict[int, Operand] = {}
    failed = False
    limits: Bounds | None = None
    # Bounded operands first: their common box bounds the others.
    order = sorted(range(len(children)), key=lambda i: evaluator.ends.endless(children[i]))
    for place in order:
        child = children[place]
        endless = evaluator.ends.endless(child)
        if endless and (failed or (limits is not None and (limits[0] > limits[1]).any())):
            continue
        box = (wanted.box if limits is None else coarse(limits)) if endless else None
        operand = yield from evaluator.operand(wanted, (place,), child, IDENTITY, box, problems)
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
        return Entry(wanted.key, None, distinct(problems))
    solids = [found[place].solid for place in sorted(found)]
    if len(found) < len(children) or not solids:
        solid = Manifold()
    else:
        solid = solids[0] if len(solids) == 1 else forced(Manifold.batch_boolean(solids, OpType.Intersect))
    if not children:
        problems.append(Problem((), f"“{wanted.node.label}” holds nothing", False))
    elif solid.is_empty():
        problems.append(Problem((), f"the operands of “{wanted.node.label}” have nothing in common", False))
    return _done(wanted, solid, problems)


def around(evaluator: Evaluator, wanted: Wanted) -> Steps:
    """Hull and Minkowski sum: new surfaces, so the result is an original of its own."""
    problems: list[Problem] = []
    operands: list[Operand] = []
    node = wanted.node
    for place, child in enumerate(node.children):
        if evaluator.ends.endless(child):
            raise NoSolid(f"“{child.label}” goes on without end; a {node.title.lower()} needs solids that end")
        operand = yield from evaluator.operand(wanted, (place,), child, IDENTITY, None, problems)
        if operand is not None:
            operands.append(operand)
    if len(operands) < len(node.children):
        return Entry(wanted.key, None, distinct(problems))
    if not operands:
        problems.append(Problem((), f"“{node.label}” holds nothing", False))
        return _done(wanted, Manifold(), problems)
    if isinstance(node, Hull):
        solid = Manifold.batch_hull([operand.solid for operand in operands])
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
}
