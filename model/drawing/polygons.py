"""Many convex polygons at once, as one array of corners: gathering, cutting off, areas."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Ragged:
    """Polygons of any number of corners: polygon i has `points[starts[i] : starts[i + 1]]`."""

    points: Floats  # (c, d)
    starts: Numbers  # (m + 1,)

    @property
    def count(self) -> int:
        return len(self.starts) - 1

    @property
    def sizes(self) -> Numbers:
        return np.diff(self.starts)

    @property
    def polygon_of(self) -> Numbers:
        """(c,) the polygon of each corner."""
        return np.repeat(np.arange(self.count), self.sizes)

    def following(self) -> Numbers:
        """(c,) the next corner of the same polygon; none may be without corners."""
        following = np.arange(1, len(self.points) + 1)
        following[self.starts[1:] - 1] = self.starts[:-1]
        return following

    def taken(self, which: Numbers) -> Ragged:
        """The polygons `which`, in that order."""
        corners, starts = corners_of(self.starts, which)
        return Ragged(self.points[corners], starts)

    def low(self) -> Floats:
        return np.minimum.reduceat(self.points, self.starts[:-1], axis=0)

    def high(self) -> Floats:
        return np.maximum.reduceat(self.points, self.starts[:-1], axis=0)

    def areas(self) -> Floats:
        """(m,) signed areas in the first two coordinates."""
        if not self.count:
            return np.zeros(0)
        arms = self.points[:, :2] - self.points[self.starts[:-1], :2][self.polygon_of]
        ahead = arms[self.following()]
        return np.add.reduceat(arms[:, 0] * ahead[:, 1] - arms[:, 1] * ahead[:, 0], self.starts[:-1]) / 2.0

    def cut(self, heights: Floats) -> tuple[Ragged, Numbers]:
        """What lies where the corners' `heights` (c,) are not below zero, and the polygon that each piece is of.

        Sutherland and Hodgman (1974). New corners are reckoned from the end that is cut off.
        """
        kept = heights >= 0.0
        if kept.all():
            return self, np.arange(self.count)
        following = self.following()
        crossing = kept != kept[following]
        emitted = kept.astype(np.int64) + crossing
        begins = np.cumsum(emitted) - emitted
        points = np.empty((int(emitted.sum()), self.points.shape[1]))
        points[begins[kept]] = self.points[kept]
        here = np.flatnonzero(crossing)
        there = following[here]
        low, high = np.where(kept[here], there, here), np.where(kept[here], here, there)
        share = (heights[low] / (heights[low] - heights[high]))[:, None]
        points[begins[here] + kept[here]] = self.points[low] + share * (self.points[high] - self.points[low])
        sizes = np.add.reduceat(emitted, self.starts[:-1])
        left = np.flatnonzero(sizes >= 3)
        whole = Ragged(points, np.concatenate(([0], np.cumsum(sizes))))
        return whole.taken(left), left


def corners_of(starts: Numbers, which: Numbers) -> tuple[Numbers, Numbers]:
    """The corners of the polygons `which`, polygon after polygon, and where each begins (k + 1,)."""
    sizes = starts[which + 1] - starts[which]
    ends = np.cumsum(sizes)
    corners = np.repeat(starts[which] - ends + sizes, sizes) + np.arange(int(sizes.sum()))
    return corners, np.concatenate(([0], ends))


def ranges(counts: Numbers) -> tuple[Numbers, Numbers]:
    """For counts (n,): the item of each of their sum, and its number 0, 1, ... within the item."""
    item = np.repeat(np.arange(len(counts)), counts)
    return item, np.arange(len(item)) - np.repeat(np.cumsum(counts) - counts, counts)
