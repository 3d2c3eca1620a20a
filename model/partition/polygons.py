"""Convex polygons of any number of corners in growing arrays: how far they reach across planes, and cutting them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .faces import Faces, Floats, heights_of

Numbers = NDArray[np.int64]


class Growing:
    """An array (n, ...) that takes further rows at its end."""

    def __init__(self, rows: NDArray[Any]) -> None:
        self._room = rows
        self._count = len(rows)

    @property
    def rows(self) -> NDArray[Any]:
        return self._room[: self._count]

    def append(self, rows: NDArray[Any]) -> int:
        """Puts rows at the end; returns the place of the first."""
        begin, end = self._count, self._count + len(rows)
        if begin == end:
            return begin  # the rows may still be those that were handed in, which are not ours to write
        if end > len(self._room):
            room = np.empty((max(end, begin + begin // 2), *self._room.shape[1:]), self._room.dtype)
            room[:begin] = self._room[:begin]
            self._room = room
        self._room[begin:end] = rows
        self._count = end
        return begin


class Polygons:
    """The faces, and the pieces that they are cut into. What is cut stays where it is and is referred to no more."""

    def __init__(self, faces: Faces) -> None:
        self.points = Growing(faces.points)  # (n, 3)
        self.corners = Growing(faces.corners.astype(np.int64))  # (c,) into points
        self.starts = Growing(faces.starts[:-1].astype(np.int64))  # (f,) into corners
        self.sizes = Growing(np.diff(faces.starts).astype(np.int64))  # (f,)
        self.source = Growing(np.arange(faces.count))  # (f,) the face that each is a piece of

    def cut(self, which: Numbers, planes: Floats, epsilon: float) -> tuple[Numbers, Numbers]:
        """The parts (m,) behind and (m,) before planes (4, m) of polygons `which` (m,) that reach across them.

        Corners within `epsilon` of the plane belong to both parts. A new corner is always reckoned from the end behind
        the plane, so that the pieces of two neighbours meet in the same point.
        """
        sizes = self.sizes.rows[which]
        begins = np.cumsum(sizes) - sizes
        here = self.corners.rows[spread(self.starts.rows[which], sizes)]
        height = heights_of(self.points.rows[here].T, np.repeat(planes, sizes, axis=1))
        after = np.arange(1, len(here) + 1)
        after[begins + sizes - 1] = begins
        ahead = height[after]
        behind, before = height < -epsilon, height > epsilon
        crosses = np.flatnonzero((behind & (ahead > epsilon)) | (before & (ahead < -epsilon)))
        rising = behind[crosses]
        low = np.where(rising, here[crosses], here[after[crosses]])
        high = np.where(rising, here[after[crosses]], here[crosses])
        depth = np.minimum(height[crosses], ahead[crosses])
        share = depth / (depth - np.maximum(height[crosses], ahead[crosses]))
        points = self.points.rows
        new = points[low] + share[:, None] * (points[high] - points[low])
        added = self.points.append(new) + np.arange(len(crosses))

        # Every corner gives one place to each part that it belongs to, and one more to both where its side crosses.
        crossing = np.zeros(len(here), np.int64)
        crossing[crosses] = 1
        polygon = np.repeat(np.arange(len(which)), sizes)
        parts: list[Numbers] = []
        for belongs in (~before, ~behind):
            places = belongs + crossing
            ends = np.cumsum(places)
            corners = np.empty(int(ends[-1]) if len(ends) else 0, np.int64)
            corners[(ends - places)[belongs]] = here[belongs]
            corners[ends[crosses] - 1] = added
            count = np.bincount(polygon, places, len(which)).astype(np.int64)
            first = self.corners.append(corners)
            start = self.starts.append(first + np.cumsum(count) - count)
            self.sizes.append(count)
            self.source.append(self.source.rows[which])
            parts.append(start + np.arange(len(which)))
        return parts[0], parts[1]


class Reach:
    """The coordinates of some polygons, laid out for asking how far they reach across plane after plane."""

    def __init__(self, polygons: Polygons, which: Numbers) -> None:
        self._polygons, self._which = polygons, which
        starts, sizes = polygons.starts.rows[which], polygons.sizes.rows[which]
        points, corners = polygons.points.rows, polygons.corners.rows
        # Most polygons are triangles: the first three corners go by whole columns, the others follow.
        # 3 x (3, f)
        self._three = [np.ascontiguousarray(points.take(corners[starts + i], axis=0).T) for i in range(3)]
        self._long = np.flatnonzero(sizes > 3)
        more = sizes[self._long] - 3
        self._rest = np.ascontiguousarray(points[corners[spread(starts[self._long] + 3, more)]].T)  # (3, e)
        self._begins = np.cumsum(more) - more
        self._more = more

    def taken(self, places: Numbers) -> Reach:
        """The same for some of the polygons."""
        return Reach(self._polygons, self._which[places])

    def across(self, planes: Floats) -> tuple[Floats, Floats]:
        """The lowest (f,) and the highest (f,) corner of each polygon over a plane of its own, `planes` (4, f)."""
        a, b, c = (heights_of(corner, planes) for corner in self._three)
        own = np.repeat(planes[:, self._long], self._more, axis=1) if len(self._long) else planes[:, :0]
        return self._bounds(a, b, c, heights_of(self._rest, own))

    def along(self, axis: int) -> tuple[Floats, Floats]:
        """The lowest (f,) and the highest (f,) coordinate of each polygon."""
        a, b, c = (corner[axis] for corner in self._three)
        return self._bounds(a, b, c, self._rest[axis])

    def first_corner(self, axis: int) -> Floats:
        """(f,) a coordinate that the polygon has."""
        return self._three[0][axis]

    def _bounds(self, a: Floats, b: Floats, c: Floats, rest: Floats) -> tuple[Floats, Floats]:
        low = np.minimum(np.minimum(a, b), c)
        high = np.maximum(np.maximum(a, b), c)
        if len(self._long):
            low[self._long] = np.minimum(low[self._long], np.minimum.reduceat(rest, self._begins))
            high[self._long] = np.maximum(high[self._long], np.maximum.reduceat(rest, self._begins))
        return low, high


def spread(starts: Numbers, sizes: Numbers) -> Numbers:
    """The places start, start + 1, ... start + size - 1 of one row after the other."""
    ends = np.cumsum(sizes)
    return np.repeat(starts - ends + sizes, sizes) + np.arange(int(ends[-1]) if len(ends) else 0)
