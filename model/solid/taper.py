"""Outlines drawn up with leaning walls: the polygon moves inwards or outwards as it rises, from event to event.

Between two events every corner moves along the bisector of its sides (the wavefront of the straight skeleton:
Aichholzer, Aurenhammer, Alberts and Gärtner 1995), which makes a frustum; at an event a side has shrunk to a point or a
corner has met another side, and what is left is a polygon again.
"""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, Error, FillRule, Manifold, Mesh64, OpType, triangulate
from numpy.typing import NDArray

from .failure import NoSolid

Floats = NDArray[np.float64]

MOST_EVENTS = 4000
SAME = 1e-9
"""Corners nearer to each other than this share of the outline's size are one."""


def tapered(section: CrossSection, height: float, slope: float) -> Manifold:
    """The solid over a section whose walls move inwards by `slope` mm for each mm of the height; outwards below 0.

    It ends below the height where the walls have met everywhere. Raises NoSolid.
    """
    size = float(np.ptp(np.reshape(section.bounds(), (2, 2)), axis=0).max())
    parts: list[Manifold] = []
    level, rings = 0.0, _rings(section, size)
    for _ in range(MOST_EVENTS):
        if not rings:
            break
        wave = _Wave(rings, np.sign(slope) or 1.0)
        left = abs(slope) * (height - level)
        way = min(wave.next_event(), left)
        step = height - level if way >= left else way / abs(slope)
        if step > SAME * height:
            parts.append(_frustum(wave, way, level, step))
        level += step
        if way >= left:
            break
        moved = [np.ascontiguousarray(ring) for ring in wave.rings_at(way)]
        rings = _rings(CrossSection(moved, FillRule.Positive), size)
    else:
        raise NoSolid("Extrusion: the outline is too intricate for a taper: give it a coarser tolerance")
    if not parts:
        raise NoSolid("Extrusion: the walls meet at once: make the taper smaller")
    return Manifold.batch_boolean(parts, OpType.Add)


def _rings(section: CrossSection, size: float) -> list[Floats]:
    """Its contours without corners that are one with the next, or that lie on a straight side."""
    found = []
    for polygon in section.simplify(SAME * size).to_polygons():
        ring = np.asarray(polygon, float)
        ring = ring[np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1) > SAME * size]
        if len(ring) >= 3:
            found.append(ring)
    return found


class _Wave:
    """Corners of contours, outer ones counter-clockwise, and how they move: `side` 1 inwards, -1 outwards."""

    def __init__(self, rings: list[Floats], side: float) -> None:
        self.rings, self.side = rings, side
        self.points = np.vstack(rings)
        count = len(self.points)
        starts = np.cumsum([0, *map(len, rings)])
        self.before, self.after = np.arange(count) - 1, np.arange(count) + 1
        self.before[starts[:-1]], self.after[starts[1:] - 1] = starts[1:] - 1, starts[:-1]
        self.starts = starts
        along = self.points[self.after] - self.points
        self.lengths = np.linalg.norm(along, axis=1)
        self.along = along / self.lengths[:, None]
        self.inward = side * np.column_stack((-self.along[:, 1], self.along[:, 0]))
        one, other = self.inward[self.before], self.inward
        # So that both sides are reached: at a corner that turns back on itself it would be without end.
        share = np.maximum(1.0 + (one * other).sum(axis=1), 1e-9)
        self.speed = (one + other) / share[:, None]

    def next_event(self) -> float:
        """How far the sides move until one is gone or is met by a corner; infinite where that never happens."""
        shrink = ((self.speed[self.after] - self.speed) * self.along).sum(axis=1)
        with np.errstate(divide="ignore"):
            gone = np.where(shrink < 0.0, -self.lengths / shrink, np.inf)
        return float(min(gone.min(), self._meeting(float(gone.min()))))

    def _meeting(self, limit: float) -> float:
        """When a corner that points into what the wave crosses first comes upon a side, if before `limit`."""
        turn = self.along[self.before, 0] * self.along[:, 1] - self.along[self.before, 1] * self.along[:, 0]
        blunt = np.flatnonzero(self.side * turn < 0.0)
        best = limit
        for rows in np.array_split(blunt, max(len(blunt) * len(self.points) // 2_000_000, 1)) if len(blunt) else ():
            gap = ((self.points[rows, None] - self.points) * self.inward).sum(axis=2)  # (r, n) before the sides
            closing = 1.0 - self.speed[rows] @ self.inward.T
            with np.errstate(divide="ignore", invalid="ignore"):
                when = np.where((closing > 1e-12) & (gap > 0.0), gap / closing, np.inf)
            own = np.arange(len(self.points))
            when[(own == rows[:, None]) | (own == self.before[rows][:, None])] = np.inf
            near, side = np.nonzero(when < best)
            if not len(near):
                continue
            time = when[near, side][:, None]
            place = self.points[rows[near]] + time * self.speed[rows[near]]
            begin = self.points[side] + time * self.speed[side]
            end = self.points[self.after[side]] + time * self.speed[self.after[side]]
            along = self.along[side]
            slack = 1e-9 * self.lengths.max()
            low, high = ((place - begin) * along).sum(axis=1), ((end - place) * along).sum(axis=1)
            hit = (low >= -slack) & (high >= -slack)
            if hit.any():
                best = min(best, float(time[hit].min()))
        return best

    def rings_at(self, way: float) -> list[Floats]:
        moved = self.points + way * self.speed
        return [moved[a:b] for a, b in zip(self.starts[:-1], self.starts[1:], strict=True)]


def _frustum(wave: _Wave, way: float, level: float, step: float) -> Manifold:
    """What lies between the contours and where they have moved to."""
    count = len(wave.points)
    low = np.column_stack((wave.points, np.full(count, level)))
    high = np.column_stack((wave.points + way * wave.speed, np.full(count, level + step)))
    floor = np.asarray(triangulate(wave.rings, 0.0), np.int64).reshape(-1, 3)
    a = np.arange(count)
    b = wave.after
    walls = np.vstack((np.column_stack((a, b, b + count)), np.column_stack((a, b + count, a + count))))
    # The lid has the triangles of the floor: between events they stay turned the same way round, or nearly so.
    triangles = np.vstack((floor[:, ::-1], floor + count, walls))
    solid = Manifold(Mesh64(np.vstack((low, high)), triangles.astype(np.uint64)))
    if solid.status() != Error.NoError:
        raise NoSolid("Extrusion: the taper makes no solid of this outline: give it a coarser tolerance")
    return solid
