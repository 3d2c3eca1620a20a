"""What an outline gives to snap to: its nodes, the middles of its segments, and all of its curves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ....model.curve.nearest import nearest
from ....model.document.placement import inverse
from ....model.path.flatten import chords
from ....model.path.path import Path
from ....model.path.pieces import pieces_of

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

FINE = 2e-4
"""Of an outline's size: how far the chords may be off the curves that are looked for near the pointer."""
FLAT = 1e-6
"""Of the size of what is looked at: points that are nearer to a plane lie in it."""
HALF_WAY = {1: np.array([1.0, 1.0]) / 2.0, 2: np.array([1.0, 2.0, 1.0]) / 4.0, 3: np.array([1.0, 3.0, 3.0, 1.0]) / 8.0}
"""By degree, the shares of its control points in the middle of a Bezier curve."""


class Target:
    """A path (own axes, plane or space) and where it stands: `frame` (3, 4) to the world."""

    def __init__(self, path: Path, frame: Floats) -> None:
        self._path, self._frame = path, frame
        self._seen: dict[bytes, Flat] = {}

    def within(self, plane: Floats) -> Flat:
        """What of it lies in a plane (3, 4), in the plane's coordinates. The last few planes are remembered."""
        key = plane.tobytes()
        if key not in self._seen:
            if len(self._seen) > 4:
                self._seen.clear()
            self._seen[key] = self._flat(plane)
        return self._seen[key]

    def _flat(self, plane: Floats) -> Flat:
        into = inverse(plane)
        matrix = np.column_stack((into[:, :3] @ self._frame[:, :3], into[:, :3] @ self._frame[:, 3] + into[:, 3]))
        lifted = self._path.transformed(matrix)
        size = max((float(np.abs(contour.points).max()) for contour in lifted.contours), default=1.0)
        return Flat(lifted, FLAT * max(size, 1.0))


@dataclass(eq=False)
class Flat:
    """A path (3 coordinates each) seen from a plane, of which counts what is within `reach` mm of it."""

    path: Path
    reach: float

    @cached_property
    def _nodes(self) -> tuple[Floats, Numbers]:
        contours = self.path.contours
        if not contours:
            return np.zeros((0, 3)), np.zeros((0, 2), np.intp)
        places = np.concatenate([contour.places for contour in contours])
        rows = np.concatenate(
            [
                np.column_stack((np.full(len(contour.nodes), number), np.arange(len(contour.nodes))))
                for number, contour in enumerate(contours)
            ]
        )
        within = np.abs(places[:, 2]) <= self.reach
        return places[within], rows[within]

    @property
    def nodes(self) -> Floats:
        """(k, 2)"""
        return self._nodes[0][:, :2]

    @property
    def rows(self) -> Numbers:
        """(k, 2) contour and number of each node."""
        return self._nodes[1]

    @cached_property
    def segment_ends(self) -> Numbers:
        """(s, 3) of every segment: its contour, and the numbers of the nodes where it begins and ends."""
        rows = [np.zeros((0, 3), np.intp)]
        for number, contour in enumerate(self.path.contours):
            begin = np.arange(len(contour))
            rows.append(np.column_stack((np.full(len(begin), number), begin, (begin + 1) % len(contour.nodes))))
        return np.concatenate(rows)

    @cached_property
    def middles(self) -> tuple[Floats, Numbers]:
        """(k, 2) the middles of segments that are one curve, by parameter, and the numbers (k,) of the segments."""
        places, numbers = [np.zeros((0, 3))], [np.zeros(0, np.intp)]
        for group in pieces_of(self.path.contours) if self.path.contours else ():
            if group.weights is None and group.degree <= 3:
                places.append(np.einsum("k,mkd->md", HALF_WAY[group.degree], group.controls))
                numbers.append(group.segment)
        found, segment = np.concatenate(places), np.concatenate(numbers)
        single = np.bincount(segment, minlength=1)[segment] == 1
        kept = single & (np.abs(found[:, 2]) <= self.reach)
        return found[kept][:, :2], segment[kept]

    @cached_property
    def sides(self) -> tuple[Floats, Numbers]:
        """(m, 2, 2) chords along the curves that lie in the plane, and the segment (m,) of each."""
        if not self.path.contours:
            return np.zeros((0, 2, 2)), np.zeros(0, np.intp)
        low, high = self.path.bounds()
        found = chords(self.path, max(FINE * float(np.abs(high - low).max()), 1e-9))
        inner = np.ones(len(found.points), bool)
        inner[found.starts[:-1]] = False
        last = np.flatnonzero(inner)
        pairs = np.stack((found.points[last - 1], found.points[last]), axis=1)
        kept = (np.abs(pairs[:, :, 2]) <= self.reach).all(axis=1)
        return pairs[kept][:, :, :2], found.segment[last][kept]

    def foot(self, segment: int, point: Floats) -> Floats:
        """(2,) the point of a segment of the path that is nearest to (2,), exact but on B-splines."""
        contour = self.path.contours[int(self.segment_ends[segment, 0])]
        controls = contour.segment(int(self.segment_ends[segment, 1]))
        if not isinstance(controls, np.ndarray):
            return point
        from ....model.curve.bezier import evaluated

        t, _ = nearest(controls[:, :2], point)
        return np.asarray(evaluated(controls[:, :2], np.array([t])), float).reshape(-1, 2)[0]
