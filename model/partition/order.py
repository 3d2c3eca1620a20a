"""The painter's order: all fragments from back to front as seen by an eye, without looking at a single coordinate.

What lies on the eye's side of a plane may hide what lies in it or behind it, never the other way round (Schumacker
1969; Fuchs, Kedem and Naylor 1980). In a leaf the fragments of a convex body are ordered by where they face: of two
that overlap in the picture the farther one faces away, or, seen from inside, the nearer one.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from . import native
from .faces import Floats
from .polygons import Numbers, spread
from .tree import CONVEX, INNER, Tree


class Sorter:
    """Puts the fragments of a tree, or the triangles that they are fanned into, into order; keeps what no eye changes.

    `fans` (t, 3) are places in `tree.corners`; triangle i is a piece of the fragment `fragment_of[i]`. Both go through
    the fragments in their own order. `compiled` asks for the compiled order or for NumPy's; None takes the better one
    that is there.
    """

    def __init__(self, tree: Tree, compiled: bool | None = None) -> None:
        self.tree = tree
        self._compiled: native.Order | None = None
        self.fans: Numbers
        self.fragment_of: Numbers
        if native.available() if compiled is None else compiled:
            self._compiled = native.Order(tree)
            self.fans, self.fragment_of = self._compiled.fans, self._compiled.fragment_of
            return
        sizes = np.diff(tree.starts).astype(np.int64) - 2
        self._fan_starts = np.concatenate(([0], np.cumsum(sizes)))
        self.fragment_of = np.repeat(np.arange(len(sizes)), sizes)
        begin = tree.starts[:-1].astype(np.int64)[self.fragment_of]
        step = np.arange(len(begin)) - self._fan_starts[:-1][self.fragment_of] + 1
        self.fans = np.column_stack((begin, begin + step, begin + step + 1))

    def fragments(self, eye: ArrayLike, parallel: bool = False, front_first: bool = False) -> Numbers:
        """(f,) the fragments from back to front, or from front to back.

        `eye` (3,) is a point, or with `parallel` the direction towards the eye.
        """
        if self._compiled:
            return self._compiled.fragments(eye, parallel, front_first)
        found = self._of_fragments.ordered(np.asarray(eye, float), parallel)
        return found[::-1] if front_first else found

    def triangles(self, eye: ArrayLike, parallel: bool = False, front_first: bool = False) -> Numbers:
        """(t,) the triangles of `fans` in the same order."""
        if self._compiled:
            return self._compiled.triangles(eye, parallel, front_first)
        found = self._of_triangles.ordered(np.asarray(eye, float), parallel)
        return found[::-1] if front_first else found

    @cached_property
    def _of_fragments(self) -> _Layout:
        return _Layout(self.tree, np.arange(len(self.tree.source) + 1))

    @cached_property
    def _of_triangles(self) -> _Layout:
        return _Layout(self.tree, self._fan_starts)


class _Layout:
    """The reachable nodes level by level, and the pieces that they own in the same order: fragments or triangles.

    `piece_starts` (f + 1,) says where the pieces of each fragment begin.
    """

    def __init__(self, tree: Tree, piece_starts: Numbers) -> None:
        self._tree = tree
        levels = tree.levels()
        reached = np.concatenate(levels) if levels else np.zeros(0, np.int64)
        self._plane = tree.plane[reached]
        place = np.full(len(tree.kind) + 1, len(reached))  # of a node among the reached; the last: nothing there
        place[reached] = np.arange(len(reached))

        first, count = tree.first[reached].astype(np.int64), tree.count[reached].astype(np.int64)
        fragments = spread(first, count)
        pieces = np.diff(piece_starts)[fragments]
        self._pieces = spread(piece_starts[fragments], pieces)
        self._plane_of = np.repeat(tree.faces.plane_of[tree.source[fragments]], pieces)
        before = np.concatenate(([0], np.cumsum(pieces)))
        ends = before[np.cumsum(count)] if len(count) else count
        self._begin = before[np.cumsum(count) - count]  # of the pieces of each node, then of their end
        self._own = ends - self._begin
        kind = np.repeat(tree.kind[reached], self._own)
        self._leafy, self._convex = kind != INNER, kind == CONVEX
        self._some_leaf = bool(self._leafy.any())

        # Pieces in the sub-trees behind and before each node; and each node's parent, level by level.
        self._back, self._front = np.zeros(len(reached), np.int64), np.zeros(len(reached), np.int64)
        parent = np.zeros(len(reached), np.int64)
        self._is_front = np.zeros(len(reached), bool)
        self._spans: list[tuple[int, int]] = []
        below = np.append(self._own, 0)
        end = len(reached)
        for level in reversed(levels):
            begin = end - len(level)
            back, front = place[tree.back[level]], place[tree.front[level]]
            self._back[begin:end], self._front[begin:end] = below[back], below[front]
            below[begin:end] += below[back] + below[front]
            for child, ahead in ((back, False), (front, True)):
                there = child < len(reached)
                parent[child[there]] = np.arange(begin, end)[there]
                self._is_front[child[there]] = ahead
            self._spans.append((begin, end))
            end = begin
        self._spans.reverse()
        self._parent = parent

    def ordered(self, towards: Floats, parallel: bool) -> Numbers:
        if not len(self._pieces):
            return np.zeros(0, np.int64)
        # Where each node's sub-tree begins in the picture: at its parent's begin, behind what is farther there.
        ahead = heights(self._plane, towards, parallel) >= 0.0
        farther = np.where(ahead, self._back, self._front)
        above = self._parent
        shift = np.where(self._is_front == ahead[above], farther[above] + self._own[above], 0)
        begin = np.zeros(len(above), np.int64)
        for first, last in self._spans[1:]:
            begin[first:last] = begin[above[first:last]] + shift[first:last]
        begin += farther

        # Within a node: inner ones as they come, in leaves what is farther first.
        piece = np.arange(len(self._pieces))
        if self._some_leaf:
            facing = heights(self._tree.faces.planes, towards, parallel) > 0.0
            nearer = (facing[self._plane_of] == self._convex) & self._leafy
            nearer_before = np.zeros(len(piece) + 1, np.int64)
            np.cumsum(nearer, out=nearer_before[1:])
            earlier = nearer_before[self._begin]
            nearer_own = nearer_before[self._begin + self._own] - earlier
            place_nearer = nearer_before[:-1] + np.repeat(begin + self._own - nearer_own - earlier, self._own)
            piece -= nearer_before[:-1]
            piece += np.repeat(begin - self._begin + earlier, self._own)
            np.copyto(piece, place_nearer, where=nearer)
        else:
            piece += np.repeat(begin - self._begin, self._own)
        found = np.empty(len(piece), np.int64)
        found[piece] = self._pieces
        return found


def heights(planes: Floats, towards: Floats, parallel: bool) -> Floats:
    """(p,) how far a point lies before planes (p, 4), or how much a direction agrees with their normals."""
    return planes[:, :3] @ towards - (0.0 if parallel else planes[:, 3])
