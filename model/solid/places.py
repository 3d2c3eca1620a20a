"""Where a node stands in the world: once for each of its occurrences."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..document.nodes import LinearArray, Mirror, Node, PolarArray
from ..document.placement import IDENTITY, product
from .copies import copies
from .failure import NoSolid
from .provenance import Path

MOST_PLACES = 256
"""Of one node; a picture of more would say nothing."""
MOST_STEPS = 50_000
"""Occurrences looked at on the way, in arrays of arrays."""


@dataclass(frozen=True, slots=True)
class Place:
    """One occurrence of a node of a resolved tree. `outer` (3, 4) maps its parent's axes to the world's."""

    path: Path
    node: Node
    outer: NDArray[np.float64]

    @property
    def matrix(self) -> NDArray[np.float64]:
        """(3, 4), from the node's own axes to the world's."""
        return product(self.outer, self.node.placement.matrix())


def places_of(solids: Sequence[Node], ids: Iterable[str]) -> dict[str, tuple[Place, ...]]:
    """The places of nodes in resolved trees, at most MOST_PLACES of each; ids that are not there are left out."""
    wanted = set(ids)
    found: dict[str, list[Place]] = {}
    if not wanted:
        return {}
    leading = _leading(solids, wanted)
    stack: list[tuple[Path, Node, NDArray[np.float64]]] = [
        ((root.id,), root, IDENTITY) for root in reversed(solids) if id(root) in leading
    ]
    steps = 0
    while stack and steps < MOST_STEPS:
        steps += 1
        path, node, outer = stack.pop()
        if node.id in wanted:
            places = found.setdefault(node.id, [])
            if len(places) < MOST_PLACES:
                places.append(Place(path, node, outer))
        below = [child for child in node.children if id(child) in leading]
        if not below:
            continue
        try:
            maps = copies(node)[:MOST_PLACES]
        except NoSolid:
            continue
        several = isinstance(node, LinearArray | PolarArray | Mirror)
        inner = product(outer, node.placement.matrix()) if node.placement.steps else outer
        level = []
        for number, copy in enumerate(maps):
            step = (number,) if several else ()
            axes = inner if copy is IDENTITY else product(inner, copy)
            level += [((*path, *step, child.id), child, axes) for child in below]
        stack += reversed(level)
    return {node_id: tuple(places) for node_id, places in found.items()}


def _leading(solids: Sequence[Node], wanted: set[str]) -> set[int]:
    """The objects that are wanted or hold what is, by `id()`."""
    leading: set[int] = set()
    seen: set[int] = set()
    stack: list[tuple[Node, bool]] = [(root, False) for root in solids]
    while stack:
        node, done = stack.pop()
        if done:
            if node.id in wanted or any(id(child) in leading for child in node.children):
                leading.add(id(node))
        elif id(node) not in seen:
            seen.add(id(node))
            stack.append((node, True))
            stack += [(child, False) for child in node.children]
    return leading
