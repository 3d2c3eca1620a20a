"""Boxes around the fragments of well filled nodes, so that a ray need not try thousands of them one by one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .polygons import spread
from .tree import Tree

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

FEW = 16
"""Fragments of a node that are simply tried."""
WIDTH = 8
"""Boxes in a box, and fragments in one of the smallest."""
BITS = 10  # of each coordinate in a Morton number


class Clusters:
    """A hierarchy of boxes for each node with more than FEW fragments, all of them equally high.

    Fragments are put in the order of their Morton numbers, neighbours packed by eights (Lauterbach et al. 2009).
    """

    def __init__(self, tree: Tree) -> None:
        nodes = np.concatenate(tree.levels()) if tree.root >= 0 else np.zeros(0, np.int64)
        nodes = nodes[tree.count[nodes] > FEW]
        self._top = np.full(len(tree.kind), -1, np.int64)
        self._levels: list[tuple[Floats, Numbers, Numbers]] = []  # boxes (n, 2, 3), first and number of what is inside
        self._fragments = np.zeros(0, np.int64)
        if not len(nodes):
            return
        counts = tree.count[nodes].astype(np.int64)
        fragments = spread(tree.first[nodes].astype(np.int64), counts)
        boxes = _boxes(tree)[fragments]
        group = np.repeat(np.arange(len(nodes)), counts)
        begins = np.cumsum(counts) - counts
        order = np.argsort(_morton(boxes.mean(axis=1), begins, group), kind="stable")
        self._fragments, boxes = fragments[order], boxes[order]
        self._levels.append((boxes, np.arange(len(boxes)), np.ones(len(boxes), np.int64)))
        while True:
            packs = -(-counts // WIDTH)
            within = spread(np.zeros(len(packs), np.int64), packs)
            first = np.repeat(begins, packs) + WIDTH * within
            number = np.minimum(np.repeat(begins + counts, packs) - first, WIDTH)
            boxes = np.stack((np.minimum.reduceat(boxes[:, 0], first), np.maximum.reduceat(boxes[:, 1], first)), axis=1)
            self._levels.append((boxes, first, number))
            counts, begins = packs, np.cumsum(packs) - packs
            if counts.max() == 1:
                break
        self._top[nodes] = begins

    def holds(self, node: Numbers) -> NDArray[np.bool_]:
        """(k,) which of the nodes (k,) have boxes."""
        return self._top[node] >= 0

    @property
    def flat(self) -> tuple[Floats, Numbers, Numbers, Numbers]:
        """All boxes (n, 6), low and high, those of the fragments (f,) first; the first box in each and how many (n, 2);
        the box of each node (k,), -1 for none; and the fragments."""
        counts = [len(boxes) for boxes, _, _ in self._levels]
        offsets = np.cumsum([0, *counts])
        below = [0, *offsets[: max(len(counts) - 1, 0)]]
        boxes = [boxes.reshape(-1, 6) for boxes, _, _ in self._levels]
        inside = [
            np.column_stack((first + offset, number))
            for (_, first, number), offset in zip(self._levels, below, strict=False)
        ]
        top = np.where(self._top >= 0, self._top + (offsets[-2] if counts else 0), -1)
        return (
            np.ascontiguousarray(np.concatenate([np.zeros((0, 6)), *boxes]), np.float64),
            np.ascontiguousarray(np.concatenate([np.zeros((0, 2), np.int64), *inside]), np.int64),
            np.ascontiguousarray(top, np.int64),
            np.ascontiguousarray(self._fragments, np.int64),
        )

    def near(
        self, origin: Floats, direction: Floats, node: Numbers, begin: Floats, end: Floats, slack: float
    ) -> tuple[Numbers, Numbers]:
        """The fragments near lines: pairs of a row of the arguments (k, ...) and a fragment of its node.

        A line is looked at from `begin` to `end`; `slack` millimetres beside a box is in it.
        """
        row, box = np.arange(len(node)), self._top[node]
        inverse = 1.0 / np.where(np.abs(direction) < 1e-200, 1e-200, direction)
        for boxes, first, number in reversed(self._levels):
            enters, leaves = begin[row], end[row]
            for axis in range(3):  # a reduction over three numbers would take several times as long
                at, steep = origin[row, axis], inverse[row, axis]
                one = (boxes[box, 0, axis] - slack - at) * steep
                two = (boxes[box, 1, axis] + slack - at) * steep
                np.maximum(enters, np.minimum(one, two), out=enters)
                np.minimum(leaves, np.maximum(one, two), out=leaves)
            met = np.flatnonzero(enters <= leaves)
            row, box = row[met], box[met]
            inside = number[box]
            row, box = np.repeat(row, inside), spread(first[box], inside)
        return row, self._fragments[box]


def _boxes(tree: Tree) -> Floats:
    """(f, 2, 3) the least and greatest coordinates of all fragments."""
    corners, begins = tree.points[tree.corners], tree.starts[:-1]
    return np.stack((np.minimum.reduceat(corners, begins), np.maximum.reduceat(corners, begins)), axis=1)


def _morton(points: Floats, begins: Numbers, group: Numbers) -> Numbers:
    """(n,) keys that sort points (n, 3) by group and then along a curve through the box around each group."""
    low = np.minimum.reduceat(points, begins)
    size = np.maximum.reduceat(points, begins) - low
    cells = (points - low[group]) / np.where(size > 0.0, size, 1.0)[group] * (2**BITS - 1)
    key = np.zeros(len(points), np.int64)
    for bit in range(BITS):
        for axis in range(3):
            key |= ((cells[:, axis].astype(np.int64) >> bit) & 1) << (3 * bit + axis)
    return key | (group << (3 * BITS))
