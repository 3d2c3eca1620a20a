"""Nodes looked at by themselves: the surface of an operand, which its result may not show, and its measures."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Sequence

import numpy as np

from ..document.nodes import Node
from ..document.outlines import Outlines
from ..document.placement import Placement
from ..measuring.measure import Measures
from .display import DisplayMesh
from .entry import Bounds
from .evaluate import Evaluator
from .maps import moved
from .places import Place, places_of
from .results import display_of, measures_of, result_of
from .unbounded import box_within, coarse

ROOM = 0.15
"""How far what has no end is shown beyond its solid, as a share of the solid's size."""

Answer = tuple[str, bytes, DisplayMesh | None, Measures | None]


def examine(
    evaluator: Evaluator,
    solids: Sequence[Node],
    ids: Iterable[str],
    tolerance: float,
    known: Container[bytes],
    progress: Callable[[str], None] | None = None,
) -> list[Answer]:
    """For each node of the resolved trees (id, key, mesh, measures).

    The mesh lies in the node's own axes, before its placement, and is None where the key is `known` or the node has no
    surface; measures are those of its first place in the world, None where it failed or has no end.
    """
    answers: list[Answer] = []
    flat = Outlines()
    for node_id, places in places_of(solids, ids).items():
        place = places[0]
        bare = place.node.with_(placement=Placement())
        if bare in flat:
            continue
        endless = evaluator.ends.endless(bare)
        box = _room(evaluator, solids, place, tolerance, progress) if endless else None
        if endless and box is None:
            continue
        key = bare.digest + bare.creases + f"{tolerance!r}".encode() + (b"" if box is None else box.tobytes())
        entry = evaluator.within(bare, tolerance, box, progress)
        result = result_of(bare, entry)
        mesh = None if key in known else display_of(result, evaluator)
        measures = None
        if result.solid is not None and not endless:
            measures = measures_of(moved(result.solid, place.matrix).to_mesh64())
        answers.append((node_id, key, mesh, measures))
    return answers


def _room(
    evaluator: Evaluator,
    solids: Sequence[Node],
    place: Place,
    tolerance: float,
    progress: Callable[[str], None] | None,
) -> Bounds | None:
    """The box, in the node's own axes, that what has no end is shown within: around its solid, and a little more."""
    root = next(root for root in solids if root.id == place.path[0])
    seen = evaluator.evaluate(root, tolerance, progress).seen
    if seen is None or seen.is_empty():
        return None
    low, high = np.array(seen.bounding_box()).reshape(2, 3)
    margin = ROOM * float(np.max(high - low))
    return box_within(coarse(np.array([low - margin, high + margin])), place.matrix)
