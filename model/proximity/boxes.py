"""Triangles in a tree of boxes: how near two surfaces are, nearest points of one, and how it winds round points.

Descending a pair of trees, the nearer boxes first, after Larsen, Gottschalk, Lin and Manocha (1999, "Fast proximity
queries with swept sphere volumes"). Compiled code has boxes along the axes, and for pairs of trees boxes that lie as
their triangles do (Gottschalk, Lin and Manocha 1996, "OBBTree"), made where a question comes by; NumPy
has the former alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..measuring.distance import distance, nearest_on_triangles
from . import native

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

BATCH = 1 << 14
"""Points that go down the tree together, in NumPy."""
BITS = 10
"""Of each coordinate in a Morton number."""


@dataclass(frozen=True, slots=True, eq=False)
class Gap:
    """The shortest way between two surfaces: `length` in mm, its ends `a` and `b` (3,), and the `faces` they are on.

    `length` is infinite and the faces are -1 where nothing is nearer than the limit.
    """

    length: float
    a: Floats
    b: Floats
    faces: tuple[int, int]


@dataclass(frozen=True, slots=True, eq=False)
class Nearest:
    """Of n points: `distances` (n,) mm to the surface, `places` (n, 3) on it, `faces` (n,) there; infinite and -1 where
    nothing is nearer than the limit."""

    distances: Floats
    places: Floats
    faces: Numbers


class BoxTree:
    """Of triangles (n, 3, 3), finite, in mm. What it holds is made when it is first asked for."""

    def __init__(self, triangles: ArrayLike) -> None:
        self.triangles: Floats = np.ascontiguousarray(triangles, np.float64).reshape(-1, 3, 3)

    def gap(
        self,
        other: BoxTree,
        limit: float = np.inf,
        pose: ArrayLike | None = None,
        first: tuple[int, int] | None = None,
    ) -> Gap:
        """The shortest way to another surface, where that is below `limit` mm; 0 where they meet.

        `pose` (4, 4) is the rigid motion that takes the other surface to where it is now; `b` is told there, too.
        Where `first` names a triangle of each, such as the nearest ones of before, the search begins with these.
        """
        moved = None if pose is None else np.ascontiguousarray(pose, np.float64).reshape(4, 4)
        if native.available():
            faces = first or (-1, -1)
            if faces[0] >= len(self.triangles) or faces[1] >= len(other.triangles) or min(faces) < 0:
                faces = (-1, -1)
            return Gap(*native.distance(self._compiled, other._compiled, limit, moved, faces))
        if not len(self.triangles) or not len(other.triangles):
            return Gap(np.inf, np.zeros(3), np.zeros(3), (-1, -1))
        if moved is not None:
            other = BoxTree(other.triangles @ moved[:3, :3].T + moved[:3, 3])
        found = distance(self.triangles, other.triangles)
        if not found.length < limit:
            return Gap(np.inf, np.zeros(3), np.zeros(3), (-1, -1))
        a, b = np.array(found.a), np.array(found.b)
        faces = [int(tree.nearest(point[None]).faces[0]) for tree, point in ((self, a), (other, b))]
        return Gap(found.length, a, b, (faces[0], faces[1]))

    def nearest(self, points: ArrayLike, limit: float = np.inf) -> Nearest:
        """The places of the surface nearest to points (n, 3), where they are below `limit` mm."""
        asked = np.ascontiguousarray(points, np.float64).reshape(-1, 3)
        if native.available():
            return Nearest(*native.nearest(self._compiled, asked, limit))
        if not len(self.triangles):
            return Nearest(np.full(len(asked), np.inf), asked, np.full(len(asked), -1))
        parts = [self._nearest_of(asked[k : k + BATCH], limit) for k in range(0, len(asked), BATCH)]
        if not parts:
            return Nearest(np.zeros(0), np.zeros((0, 3)), np.zeros(0, np.int64))
        return Nearest(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    def windings(self, points: ArrayLike) -> Numbers:
        """(n,) how often a closed surface winds round points (n, 3): 1 inside, 0 outside; on the surface either.

        A ray upwards is counted through it. A point straight below a side or a corner is taken to lie a little to the
        side, for all triangles there alike, so that no ray slips through or counts twice.
        """
        asked = np.ascontiguousarray(points, np.float64).reshape(-1, 3)
        if native.available():
            return native.windings(self._compiled, asked)
        if not len(self.triangles):
            return np.zeros(len(asked), np.int64)
        parts = [self._windings_of(asked[k : k + BATCH]) for k in range(0, len(asked), BATCH)]
        return np.concatenate(parts) if parts else np.zeros(0, np.int64)

    @cached_property
    def _compiled(self) -> native.Tree:
        return native.Tree(self.triangles)

    # In NumPy: triangles in Morton order, packed by twos, level upon level, the last of one box.

    @cached_property
    def _order(self) -> Numbers:
        middles = self.triangles.mean(axis=1)
        low, size = middles.min(axis=0), max(float(np.ptp(middles, axis=0).max()), 1e-300)
        cells = ((middles - low) / size * ((1 << BITS) - 1)).astype(np.int64)
        key = np.zeros(len(cells), np.int64)
        for bit in range(BITS):
            key |= (((cells >> bit) & 1) << (3 * bit + np.arange(3))).sum(axis=1)
        return np.argsort(key, kind="stable")

    @cached_property
    def _levels(self) -> list[tuple[Floats, Floats]]:
        ordered = self.triangles[self._order]
        low, high = ordered.min(axis=1), ordered.max(axis=1)
        found = [(low, high)]
        while len(low) > 1:
            starts = np.arange(0, len(low), 2)
            low, high = np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)
            found.append((low, high))
        return found

    def _nearest_of(self, points: Floats, limit: float) -> tuple[Floats, Floats, Numbers]:
        best = np.full(len(points), float(limit))
        places, faces = points.copy(), np.full(len(points), -1)
        row, node = np.arange(len(points)), np.zeros(len(points), np.int64)
        for level, (low, high) in reversed(list(enumerate(self._levels))):
            row, node = _opened(row, node, len(low))
            away = np.maximum(np.maximum(low[node] - points[row], points[row] - high[node]), 0.0)
            # Nothing farther away than some corner of each box's triangles is wanted.
            corner = self.triangles[self._order[node << level], 0]
            np.minimum.at(best, row, np.nextafter(np.linalg.norm(corner - points[row], axis=1), np.inf))
            kept = np.linalg.norm(away, axis=1) <= best[row]
            row, node = row[kept], node[kept]
        if len(row):
            foot = nearest_on_triangles(points[row], self.triangles[self._order[node]])
            length = np.linalg.norm(foot - points[row], axis=1)
            order = np.lexsort((length, row))
            first = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
            first = first[length[first] < limit]
            at = row[first]
            places[at], faces[at] = foot[first], self._order[node[first]]
        distances = np.where(faces >= 0, np.linalg.norm(places - points, axis=1), np.inf)
        return distances, places, faces

    def _windings_of(self, points: Floats) -> Numbers:
        row, node = np.arange(len(points)), np.zeros(len(points), np.int64)
        for low, high in reversed(self._levels):
            row, node = _opened(row, node, len(low))
            x, y, z = points[row].T
            kept = (x >= low[node, 0]) & (x <= high[node, 0]) & (y >= low[node, 1]) & (y <= high[node, 1])
            kept &= z <= high[node, 2]
            row, node = row[kept], node[kept]
        corners, point = self.triangles[self._order[node]], points[row]
        sides = [_side_of(corners[:, k], corners[:, (k + 1) % 3], point) for k in range(3)]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        above = np.einsum("ij,ij->i", normal, corners[:, 0] - point) * sides[0] > 0.0
        met = (sides[0] == sides[1]) & (sides[1] == sides[2]) & above
        return np.bincount(row[met], sides[0][met], len(points)).astype(np.int64)


def _opened(row: Numbers, node: Numbers, count: int) -> tuple[Numbers, Numbers]:
    """The two below each node; the node itself where the level is that of the root."""
    if count == 1:
        return row, node
    rows, nodes = np.repeat(row, 2), (2 * node[:, None] + np.arange(2)).reshape(-1)
    there = nodes < count
    return rows[there], nodes[there]


def _side_of(a: Floats, b: Floats, points: Floats) -> Numbers:
    """(k,) 1 where points lie to the left of lines from a to b, seen from above, else -1; see `BoxTree.windings`."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    turned = (ax > bx) | ((ax == bx) & ((ay > by) | ((ay == by) & (az > bz))))
    start, end = np.where(turned[:, None], b, a), np.where(turned[:, None], a, b)
    way = end - start
    turn = way[:, 0] * (points[:, 1] - start[:, 1]) - way[:, 1] * (points[:, 0] - start[:, 0])
    tie = np.where(way[:, 1] > 0.0, -1, 1)  # as if the point lay a little to the right, and less above
    side = np.where(turn > 0.0, 1, np.where(turn < 0.0, -1, tie))
    return np.where(turned, -side, side)
