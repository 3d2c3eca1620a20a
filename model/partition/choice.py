"""Which plane a node gets.

A few planes are tried on a sample of the polygons: some that polygons lie in, large ones and small, and the medians
along the three axes. The best has the lowest expected cost (in the spirit of Naylor 1993): cuts, and what either side
will cost in turn.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .faces import Faces, Floats
from .polygons import Numbers, Polygons, Reach

SAMPLE = 64
"""Polygons of a node that the planes are tried on."""
RANKS = (0.0, 0.1, 0.25, 0.5, 0.8)
"""Which of the sample's own planes are tried, from that with the largest area (0) to that with the smallest (1)."""
CUT = 8.0
"""What one cut costs, against n log2 n for a side with n polygons."""
AXES = np.eye(3, 4)


@dataclass(slots=True)
class Choice:
    """The plane of each node of a level, and which nodes may be leaves because no plane tried parts their sample."""

    planes: Floats  # (4, l)
    number: Numbers  # (l,) of the plane among those of the faces; -1: an axis plane
    behind: NDArray[np.bool_]  # (l,) nothing of the sample lies before any plane tried
    before: NDArray[np.bool_]  # (l,) nothing of it behind


def choose(
    faces: Faces,
    polygons: Polygons,
    which: Numbers,
    begins: Numbers,
    reach: Reach,
    areas: Floats,
    epsilon: float,
    rng: np.random.Generator,
) -> Choice:
    """Planes for nodes whose polygons are `which` (f,), node after node from begins (l + 1,); `reach` is theirs.

    `areas` (p,) of the faces in each plane; each node has a polygon at least whose plane has one.
    """
    places, starts = sampled(begins, faces.group[polygons.source.rows[which]], rng)
    sizes = np.diff(starts)
    nodes = len(sizes)
    everything = len(places) == len(which)
    tried = which if everything else which[places]
    reach = reach if everything else reach.taken(places)
    at = np.repeat(np.arange(nodes), sizes)
    plane_of = faces.plane_of[polygons.source.rows[tried]]
    group = faces.group[polygons.source.rows[tried]]
    judge = _Judge(starts[:-1], sizes, group, epsilon)

    best = np.full(nodes, np.inf)
    planes = np.zeros((4, nodes))
    number = np.full(nodes, -1)
    behind, before = np.ones(nodes, bool), np.ones(nodes, bool)
    ranked = np.lexsort((-areas[plane_of], at))
    for rank in RANKS:
        own = plane_of[ranked[starts[:-1] + (sizes * rank).astype(np.int64)]]
        candidate = np.ascontiguousarray(faces.planes[own].T)
        low, high = reach.across(candidate.take(at, axis=1))
        same = plane_of == own[at]
        low[same] = high[same] = 0.0
        score, back, front, cuts = judge.score(low, high)
        usable = areas[own] > 0.0
        behind &= ((front == 0) & (cuts == 0)) | ~usable
        before &= ((back == 0) & (cuts == 0)) | ~usable
        better = usable & (score < best)
        best[better] = score[better]
        planes[:, better] = candidate[:, better]
        number[better] = own[better]
    for axis in range(3):
        middle = _medians(reach.first_corner(axis), at, starts)
        low, high = reach.along(axis)
        score, back, front, _ = judge.score(low - middle[at], high - middle[at])
        better = (score < best) & (back > 0) & (front > 0)
        best[better] = score[better]
        planes[:, better] = AXES[axis][:, None]
        planes[3, better] = middle[better]
        number[better] = -1

    lost = np.flatnonzero(~np.isfinite(best))
    if len(lost):
        number[lost] = _largest(areas, faces.plane_of[polygons.source.rows[which]], begins)[lost]
        planes[:, lost] = faces.planes[number[lost]].T
    return Choice(planes, number, behind, before)


class _Judge:
    """Counts what lies on the sides of planes, sample after sample."""

    def __init__(self, starts: Numbers, sizes: Numbers, group: NDArray[np.integer], epsilon: float) -> None:
        self._starts, self._epsilon = starts, epsilon
        self._group = group if (group >= 0).any() else None
        most = int(sizes.max(initial=0)) + 1
        self._cost = np.arange(float(most)) * np.log2(np.arange(1.0, most + 1.0))

    def score(self, low: Floats, high: Floats) -> tuple[Floats, Numbers, Numbers, Numbers]:
        """The costs (l,) of planes, and how many polygons lie behind, before and across them, from their reach (s,)."""
        back, front = low < -self._epsilon, high > self._epsilon
        backs, fronts, cuts = (
            np.add.reduceat(side, self._starts, dtype=np.int64) for side in (back, front, back & front)
        )
        score = CUT * cuts + self._side(back, backs) + self._side(front, fronts)
        return score, backs - cuts, fronts - cuts, cuts

    def _side(self, there: NDArray[np.bool_], count: Numbers) -> Floats:
        cost = self._cost[count]
        if self._group is None:
            return cost
        least = np.minimum.reduceat(np.where(there, self._group, np.int32(2**31 - 1)), self._starts)
        most = np.maximum.reduceat(np.where(there, self._group, np.int32(-2)), self._starts)
        return np.where((least == most) & (least >= 0), 0.0, cost)


def sampled(begins: Numbers, group: NDArray[np.integer], rng: np.random.Generator) -> tuple[Numbers, Numbers]:
    """Places of the polygons that stand for those of each node, and where each node's begin (l + 1,).

    A small node is its own sample. That of a large one has two groups at least where the node has: otherwise it would
    seem finished, and planes would cut what only has to be kept from the few others.
    """
    sizes = np.diff(begins)
    large = sizes > SAMPLE
    taken = np.minimum(sizes, SAMPLE)
    starts = np.concatenate(([0], np.cumsum(taken)))
    if not large.any():
        return np.arange(int(begins[-1])), starts
    step = np.arange(int(starts[-1])) - np.repeat(starts[:-1], taken)
    jitter = np.where(np.repeat(large, taken), rng.random(len(step)), 0.0)
    inside = np.minimum(
        ((step + jitter) * np.repeat(sizes / taken, taken)).astype(np.int64), np.repeat(sizes - 1, taken)
    )
    places = np.repeat(begins[:-1], taken) + inside
    numbered = group.astype(np.int64) * len(group) + np.arange(len(group))
    places[starts[:-1][large]] = (np.minimum.reduceat(numbered, begins[:-1]) % len(group))[large]
    places[starts[1:][large] - 1] = (np.maximum.reduceat(numbered, begins[:-1]) % len(group))[large]
    return places, starts


def _medians(values: Floats, at: Numbers, starts: Numbers) -> Floats:
    """(l,) the middle one of each node's values."""
    order = np.lexsort((values, at))
    return values[order[(starts[:-1] + starts[1:]) // 2]]


def _largest(areas: Floats, plane_of: NDArray[np.integer], begins: Numbers) -> Numbers:
    """(l,) the plane with the largest area among those of each node's polygons."""
    order = np.lexsort((-areas[plane_of], np.repeat(np.arange(len(begins) - 1), np.diff(begins))))
    return plane_of[order[begins[:-1]]].astype(np.int64)
