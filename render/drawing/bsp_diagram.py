"""A BSP tree as a node-link diagram: the upper levels of a large one, its sub-trees below them folded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...model.partition.descent import sizes
from ...model.partition.tree import INNER, Tree
from .tidy_tree import TidyTree

RADIUS, LEVEL, GAP = 14.0, 46.0, 9.0  # of a node; from one level to the next; between neighbours
LETTER = 7.0  # about the width of one
LEVELS = 6
"""So many are shown where nothing has been unfolded."""
STEP = 4
"""Levels that unfolding adds."""


@dataclass(frozen=True, slots=True)
class Item:
    """One thing in the diagram; x, y is its middle, y downward."""

    node: int  # of the tree; of a fold the node above it; -1 for an empty cell
    role: str  # "plane", "leaf", "fold" or "empty"
    side: str  # "front" or "back" of the plane above; "" for the root and for a fold
    parent: int  # a place in the list of items, -1 for the root
    text: str
    half: float  # of the width
    x: float = 0.0
    y: float = 0.0


def bsp_diagram(tree: Tree, names: Sequence[str], opened: frozenset[int] = frozenset()) -> tuple[Item, ...]:
    """What is drawn of a tree: behind a plane on the left, before it on the right.

    `names` (k,) are of the nodes; `opened` are nodes below LEVELS whose children are shown all the same.
    """
    if tree.root < 0:
        return ()
    below = sizes(tree)
    items = [_item(tree, names, tree.root, "", -1)]
    depth = [0]
    place = 0
    while place < len(items):
        item = items[place]
        if item.role == "plane":
            back, front = int(tree.back[item.node]), int(tree.front[item.node])
            if depth[place] + 1 < LEVELS or item.node in opened:
                if back >= 0 or front >= 0:
                    items += [_item(tree, names, back, "back", place), _item(tree, names, front, "front", place)]
                    depth += [depth[place] + 1] * 2
            elif back >= 0 or front >= 0:
                text = f"+{int(below[item.node]) - 1:,}"
                items.append(Item(item.node, "fold", "", place, text, 0.5 * LETTER * len(text) + 8.0))
                depth.append(depth[place] + 1)
        place += 1
    children: list[list[int]] = [[] for _ in items]
    for place, item in enumerate(items):
        if item.parent >= 0:
            children[item.parent].append(place)
    halves = [item.half for item in items]
    laid = TidyTree(children, halves, halves, GAP)
    return tuple(
        replace(item, x=x, y=RADIUS + LEVEL * level) for item, x, level in zip(items, laid.x, laid.depth, strict=True)
    )


def unfolded(tree: Tree, node: int, opened: frozenset[int]) -> frozenset[int]:
    """`opened` with some levels below a node."""
    found, level = set(opened), [node]
    for _ in range(STEP):
        found.update(level)
        level = [int(child) for above in level for child in (tree.back[above], tree.front[above]) if child >= 0]
    return frozenset(found)


def _item(tree: Tree, names: Sequence[str], node: int, side: str, parent: int) -> Item:
    if node < 0:
        return Item(-1, "empty", side, parent, "", 4.0)
    text = names[node]
    role = "plane" if tree.kind[node] == INNER else "leaf"
    return Item(node, role, side, parent, text, max(RADIUS, 0.5 * LETTER * len(text) + 6.0))
