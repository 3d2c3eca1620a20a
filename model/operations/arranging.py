"""Moving nodes to where others stand: the operation, and what was measured in the world as its arguments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.document import Document
from ..document.errors import Refusal
from ..document.expression import symbolic, vector
from ..document.placement import Placement, Step, Turn, inverse, product
from ..document.tree import change_each, listed, outermost
from .placing import outer_maps
from .steps import followed, linear_step, shifted, tidy

Matrix = NDArray[np.float64]

ANGLE_DIGITS = 5
"""Decimals of a degree that the normals of meshes in single precision are good for."""


def shift(document: Document, moves: Mapping[str, Sequence[float]]) -> Document:
    """Move each node by millimetres of its own, in its parent's axes: `{"n1": (5, 0, 0), "n4": (0, 2, 0)}`."""
    if not isinstance(moves, Mapping):
        raise Refusal(f"the moves are told by the nodes' ids, as {{'n1': (5, 0, 0)}}, not {moves!r:.60}")
    ids = listed(moves)
    inner = sorted(set(ids).difference(outermost(document, ids)))
    if inner:
        raise Refusal(f"{inner[0]} moves with what it stands in, and cannot have a move of its own as well")
    by = {node_id: vector(moves[node_id], "move") for node_id in ids}
    if any(symbolic(numbers) for numbers in by.values()):
        raise Refusal("measured moves are numbers; `move` takes expressions")
    return change_each(
        document,
        [node_id for node_id in ids if any(by[node_id])],
        lambda node: node.with_(placement=shifted(node.placement, by[node.id])),
    )


def parent_moves(document: Document, ids: Sequence[str], moves: ArrayLike) -> dict[str, tuple[float, ...]]:
    """What `shift` takes for moves (n, 3) along the world's axes; nodes that stay are left out. Raises Refusal."""
    outer = outer_maps(document, ids)
    found: dict[str, tuple[float, ...]] = {}
    for node_id, by in zip(ids, np.asarray(moves, np.float64), strict=True):
        own = tuple(tidy(value) for value in inverse(outer[node_id])[:, :3] @ by)
        if any(own):
            found[node_id] = own
    return found


def followed_in_world(
    placement: Placement, outer: Matrix, matrix: Matrix, values: Mapping[str, float], digits: int = 9
) -> Placement:
    """A placement followed by a map (3, 4) of the world, for a node whose parent's axes are mapped by `outer` (3, 4).

    The map comes as one turn where it is one, by angles rounded to ANGLE_DIGITS, and a move rounded to `digits`;
    expressions stay, with their present values counting. Raises Refusal where `outer` flattens.
    """
    inner = product(inverse(outer), product(matrix, outer))
    wanted = product(inner, placement.resolve(values).matrix())
    step = linear_step(inner[:, :3])
    new = placement if step is None else followed(placement, step, None, values)
    new = Placement(tuple(rounded for one in new.steps for rounded in _rounded(one, placement)))
    rest = wanted[:, 3] - new.resolve(values).matrix()[:, 3]
    return shifted(new, tuple(round(float(value), digits) + 0.0 for value in rest))


def _rounded(step: Step, before: Placement) -> tuple[Step, ...]:
    """A turn that was not there before, by rounded angles; none where nothing remains of it."""
    if not isinstance(step, Turn) or step in before.steps or symbolic(step.numbers):
        return (step,)
    angles = tuple(round(float(angle), ANGLE_DIGITS) + 0.0 for angle in step.numbers)  # type: ignore[arg-type]
    return (Turn(angles),) if any(angles) else ()
