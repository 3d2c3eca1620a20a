"""The painter's order: all fragments from back to front as seen by an eye, without looking at a single coordinate.

What lies on the eye's side of a plane may hide what lies in it or behind it, never the other way round (Schumacker
1969; Fuchs, Kedem and Naylor 1980). In a leaf the fragments of a convex body are ordered by where they face: of two
that overlap in the picture the farther one faces away, or, seen from inside, the nearer one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .faces import Floats
from .tree import CONVEX, INNER, Tree

Numbers = NDArray[np.int64]


class Sorter:
    """Puts the fragments of a tree, or the triangles that they are fanned into, into order; keeps what no eye changes.

    `fans` (t, 3) are places in `tree.corners`; triangle i is a piece of the fragment `fragment_of[i]`. Both go through
    the fragments in their own order.
    """

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        sizes = np.diff(tree.starts).astype(np.int64) - 2
        self.fragment_of: Numbers = np.repeat(np.arange(len(sizes)), sizes)
        begin = tree.starts[:-1].astype(np.int64)[self.fragment_of]
        self._fan_starts = np.concatenate(([0], np.cumsum(sizes)))
        step = np.arange(len(begin)) - self._fan_starts[:-1][self.fragment_of] + 1
        self.fans: Numbers = np.column_stack((begin, begin + step, begin + step + 1)).astype(np.int64)
        self._levels = tree.levels()
        reached = np.concatenate(self._levels) if self._levels else np.zeros(0, np.int64)
        self._node_of = np.full(len(sizes), -1, np.int64)
        counts = tree.count[reached].astype(np.int64)
        owned = np.repeat(tree.first[reached] - np.cumsum(counts) + counts, counts) + np.arange(int(counts.sum()))
        self._node_of[owned] = np.repeat(reached, counts)

    def fragments(self, eye: ArrayLike, parallel: bool = False, front_first: bool = False) -> Numbers:
        """(f,) the fragments from back to front, or from front to back.

        `eye` (3,) is a point, or with `parallel` the direction towards the eye.
        """
        return self._ordered(eye, parallel, np.ones(len(self._node_of), np.int64), front_first, False)

    def triangles(self, eye: ArrayLike, parallel: bool = False, front_first: bool = False) -> Numbers:
        """(t,) the triangles of `fans` in the same order."""
        return self._ordered(eye, parallel, np.diff(self._fan_starts), front_first, True)

    def _ordered(self, eye: ArrayLike, parallel: bool, sizes: Numbers, front_first: bool, fanned: bool) -> Numbers:
        tree = self.tree
        if tree.root < 0:
            return np.zeros(0, np.int64)
        towards = np.asarray(eye, float)
        before = heights(tree.plane, towards, parallel) >= 0.0
        facing = (heights(tree.faces.planes, towards, parallel) > 0.0)[tree.faces.plane_of][tree.source]

        # Where each sub-tree and each node's own fragments begin, from the sizes of sub-trees, level by level.
        nodes = len(tree.kind)
        reached = self._node_of >= 0
        own = np.bincount(self._node_of[reached], sizes[reached], nodes).astype(np.int64)
        below = np.append(own, 0)  # the last one stands for "nothing there"
        for level in reversed(self._levels):
            below[level] += below[tree.front[level]] + below[tree.back[level]]
        begin = np.zeros(nodes + 1, np.int64)
        own_begin = np.zeros(nodes, np.int64)
        for level in self._levels:
            far = np.where(before[level], tree.back[level], tree.front[level])
            near = np.where(before[level], tree.front[level], tree.back[level])
            at = begin[level]
            begin[far] = at
            own_begin[level] = at + below[far]
            begin[near] = own_begin[level] + own[level]

        # Within a node: inner ones as they come, in leaves what is farther first.
        late = facing == (tree.kind == CONVEX)[self._node_of]
        late &= (tree.kind != INNER)[self._node_of]
        early = np.where(late | ~reached, 0, sizes)
        lately = np.where(late & reached, sizes, 0)
        before_early, before_late = np.cumsum(early) - early, np.cumsum(lately) - lately
        first = np.minimum(tree.first, max(len(sizes) - 1, 0)).astype(np.int64)
        node = self._node_of
        early_of_node = np.bincount(node[reached], early[reached], nodes).astype(np.int64)
        place = own_begin[node] + np.where(
            late, early_of_node[node] + before_late - before_late[first][node], before_early - before_early[first][node]
        )
        total = int(below[tree.root])
        result = np.empty(total, np.int64)
        if not fanned:
            result[place[reached]] = np.flatnonzero(reached)
        else:
            kept = reached[self.fragment_of]
            step = np.arange(len(self.fragment_of)) - self._fan_starts[:-1][self.fragment_of]
            result[(place[self.fragment_of] + step)[kept]] = np.flatnonzero(kept)
        return result[::-1] if front_first else result


def heights(planes: Floats, towards: Floats, parallel: bool) -> Floats:
    """(p,) how far a point lies before planes (p, 4), or how much a direction agrees with their normals."""
    return planes[:, :3] @ towards - (0.0 if parallel else planes[:, 3])
