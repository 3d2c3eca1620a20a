"""The lines of a drawing, and the polylines that they make up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..section.section import cycles

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

OUTLINE, INTERSECTION, FEATURE, BORDER = 0, 1, 2, 3
"""What a line is the picture of: a silhouette; an edge between faces of two leaves or solids; a sharp edge of one
leaf; the border of a surface that is not closed. Where lines coincide, the one with the lowest number is drawn."""
KINDS = ("outline", "intersection", "feature", "border")


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """Straight pieces, no two of which cover each other; those that touch in line and are alike are one."""

    ends: Floats  # (n, 2, 2) mm in the picture's plane
    kind: NDArray[np.int8]  # (n,)
    hidden: NDArray[np.bool_]  # (n,)
    layer: NDArray[np.int32]  # (n,) places in the drawing's layers

    @property
    def count(self) -> int:
        return len(self.ends)

    @property
    def lengths(self) -> Floats:
        """(n,) mm."""
        return np.hypot(*(self.ends[:, 1] - self.ends[:, 0]).T)

    def chosen(self, which: NDArray[np.bool_] | Numbers) -> Lines:
        return Lines(self.ends[which], self.kind[which], self.hidden[which], self.layer[which])


@dataclass(frozen=True, slots=True, eq=False)
class Polyline:
    """Pieces of one kind and layer, one after the other; a closed one ends in its first point."""

    points: Floats  # (k, 2) mm
    kind: int
    hidden: bool
    layer: int

    @property
    def closed(self) -> bool:
        return len(self.points) > 3 and bool((self.points[0] == self.points[-1]).all())


def polylines(lines: Lines) -> tuple[Polyline, ...]:
    """The lines with those that continue one another, and no third one, strung together."""
    if not lines.count:
        return ()
    group = (lines.kind * 2 + lines.hidden).astype(np.int64) * (int(lines.layer.max()) + 1) + lines.layer
    _, place = np.unique(lines.ends.reshape(-1, 2) @ (1.0, 1j), return_inverse=True)
    key = np.repeat(group, 2) * len(place) + place.reshape(-1)
    _, node = np.unique(key, return_inverse=True)
    node = node.reshape(-1)
    # Way 2i goes along line i, way 2i + 1 back. Each is followed by the way on, or where there is not just one, by the
    # way back: so the ways of an open string make one cycle, those of a closed one two.
    leaving = np.argsort(node, kind="stable")
    first = np.concatenate(([0], np.cumsum(np.bincount(node))))
    arriving = node.reshape(-1, 2)[:, ::-1].reshape(-1)
    back = np.arange(len(node)) ^ 1
    one, other = leaving[first[arriving]], leaving[np.minimum(first[arriving] + 1, len(leaving) - 1)]
    following = np.where(first[arriving + 1] - first[arriving] == 2, np.where(one == back, other, one), back)
    order, starts = cycles(following)
    found = []
    begins = lines.ends.reshape(-1, 2)
    for begin, end in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True):
        ways = order[begin:end]
        turns = np.flatnonzero(following[ways] == ways ^ 1)
        if len(turns):
            ways = np.roll(ways, -int(turns[0]) - 1)[: len(ways) // 2]
        elif ways[0] % 2:
            continue
        line = int(ways[0]) // 2
        points = np.concatenate((begins[ways], begins[ways[-1:] ^ 1]))
        found.append(Polyline(points, int(lines.kind[line]), bool(lines.hidden[line]), int(lines.layer[line])))
    return tuple(found)


NO_LINES = Lines(np.zeros((0, 2, 2)), np.zeros(0, np.int8), np.zeros(0, bool), np.zeros(0, np.int32))
