"""What lies near the pointer in a plane: places, curves, lines through nodes, directions, and the grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....model.document.errors import Refusal
from ....model.document.placement import inverse
from ....render.camera import Camera, project, ray
from ....render.ground import step_for
from .snap_targets import Flat

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Kind = Literal["node", "corner", "midpoint", "centre", "curve", "edge", "guide", "angle", "grid", "free"]

REACH = 8.0
"""Logical pixels between the pointer and what it snaps to."""
ANGLE = 15.0
"""Degrees from one direction to the next one."""
IN_LINE = 24
"""So many of the nearest nodes are those that a point may be in line with."""


@dataclass(frozen=True, slots=True, eq=False)
class Snap:
    """`point` (2,) in the plane's coordinates; `words` for the status, "" where nothing was there to snap to.

    `guides` are lines (2, 2) in the plane from what the point is in line with.
    """

    point: Floats
    words: str
    kind: Kind
    guides: tuple[Floats, ...] = ()


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane (3, 4) as a camera sees it in a picture of `size` pixels."""

    frame: Floats
    camera: Camera
    size: tuple[float, float]

    def at(self, pixel: tuple[float, float]) -> Floats | None:
        """(2,) the point of the plane under a pixel; None where the plane is edge-on or behind the eye."""
        origin, direction = ray(self.camera, *pixel, self.size)
        try:
            into = inverse(self.frame)
        except Refusal:
            return None
        start, along = into[:, :3] @ origin + into[:, 3], into[:, :3] @ direction
        if abs(along[2]) <= 1e-3 * np.linalg.norm(along):
            return None
        distance = -start[2] / along[2]
        if distance <= 0.0 and not self.camera.parallel:
            return None
        return (start + distance * along)[:2]

    def pixels(self, points: ArrayLike) -> Floats:
        """(k, 2) where points (k, 2) of the plane are seen, nan behind the eye."""
        flat = np.asarray(points, float).reshape(-1, 2)
        return project(self.camera, flat @ self.frame[:, :2].T + self.frame[:, 3], self.size)[:, :2]

    def scales(self, point: Floats) -> Floats:
        """(2,) pixels that a millimetre along x and along y has about a point."""
        step = 1e-3 * self.camera.half_height
        here, *beside = self.pixels(point + step * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
        return np.linalg.norm(np.array(beside) - here, axis=1) / step


@dataclass(frozen=True, eq=False)
class Lines:
    """Of x and of y: the coordinate that the point takes, and the place (2,) it has it from; None where from none."""

    x: tuple[float, Floats] | None
    y: tuple[float, Floats] | None


class Near:
    """What lies near one pixel, and near the point (2,) of the plane that it means."""

    def __init__(self, plane: Plane, pixel: Floats, point: Floats) -> None:
        self._plane, self._pixel, self._point = plane, pixel, point
        self._scales = np.maximum(plane.scales(point), 1e-12)
        self._step = step_for(2.0 * plane.camera.half_height)

    def tidy(self, point: Floats) -> Floats:
        """The point with no more decimals than pixels tell apart."""
        digits = int(np.ceil(np.log10(float(self._scales.max())) - 1e-9))
        return np.round(point, min(max(digits, -6), 12)) + 0.0

    def _on_grid(self, value: Floats) -> Floats:
        """The nearest multiples of the grid's step, without the last bits that the product leaves."""
        digits = max(0, 2 - int(np.floor(np.log10(self._step))))
        return np.round(self._step * np.round(value / self._step), digits) + 0.0

    def nearest(self, places: Floats) -> Floats | None:
        """Of places (k, 2) the nearest one within reach."""
        if not len(places):
            return None
        away = np.linalg.norm(self._plane.pixels(places) - self._pixel, axis=1)
        away[np.isnan(away)] = np.inf
        best = int(np.argmin(away))
        return places[best] if away[best] <= REACH else None

    def in_line(self, places: Floats) -> Lines:
        """Which of the nearest of the places (k, 2) the point is above or below, and beside."""
        if not len(places):
            return Lines(None, None)
        off = np.abs(places - self._point) * self._scales
        closest = np.argsort(np.linalg.norm(off, axis=1), kind="stable")[:IN_LINE]
        found: list[tuple[float, Floats] | None] = []
        for axis in (0, 1):
            # Of places in one line the nearest is the one that the guide leads to.
            best = closest[np.argmin(np.round(off[closest, axis]))]
            found.append((float(places[best, axis]), places[best]) if off[best, axis] <= REACH else None)
        return Lines(*found)

    def on_curve(self, flats: list[tuple[Flat, Flags, Flags]], lines: Lines) -> Snap | None:
        """The nearest point of a curve within reach; better the one on a guide, where that is within reach as well."""
        best: tuple[float, Floats] | None = None
        crossing: tuple[float, Floats, Floats] | None = None
        for flat, _, still in flats:
            sides, segment = flat.sides
            kept = still[segment]
            sides, segment = sides[kept], segment[kept]
            start, along = sides[:, 0], sides[:, 1] - sides[:, 0]
            square = np.maximum((along * along).sum(axis=1), 1e-300)
            share = np.clip(((self._point - start) * along).sum(axis=1) / square, 0.0, 1.0)
            away = np.linalg.norm((start + share[:, None] * along - self._point) * self._scales, axis=1)
            close = np.flatnonzero(away <= 2.0 * REACH)
            if not len(close):
                continue
            row = close[np.argmin(away[close])]
            if away[row] <= REACH and (best is None or away[row] < best[0]):
                best = float(away[row]), flat.foot(int(segment[row]), self._point)
            for axis, line in enumerate((lines.x, lines.y)):
                if line is None:
                    continue
                for place in _crossings(sides[close], axis, line[0]):
                    off = float(np.linalg.norm((place - self._point) * self._scales))
                    if off <= REACH and (crossing is None or off < crossing[0]):
                        crossing = off, place, np.array([line[1], place])
        if crossing is not None:
            return Snap(crossing[1], "on curve, in line with a node", "curve", (crossing[2],))
        return None if best is None else Snap(best[1], "on curve", "curve")

    def on_lines(self, lines: Lines) -> Snap:
        """In line with nodes, else on the grid, for x and y each; a tidy number where there is neither."""
        grid = self._on_grid(self._point)
        on_grid = np.abs(grid - self._point) * self._scales <= REACH
        point = np.where(on_grid, grid, self.tidy(self._point))
        guides = []
        taken = [(axis, line) for axis, line in enumerate((lines.x, lines.y)) if line is not None]
        for axis, line in taken:
            point[axis] = line[0]
        for _, line in taken:
            if (line[1] != point).any():
                guides.append(np.array([line[1], point]))
        if guides:
            return Snap(point, "in line with a node", "guide", tuple(guides))
        if not on_grid.any():
            return Snap(point, "", "free")
        where = "" if on_grid.all() else f" in {'xy'[int(np.argmax(on_grid))]}"
        return Snap(point, f"{self._step:g} mm grid{where}", "grid")

    def on_angle(self, origin: Floats, places: Floats) -> Snap:
        """On a ray of 15° steps from the origin, as long as the grid's step or a node beside it asks for."""
        away = self._point - origin
        turn = np.degrees(np.arctan2(away[1], away[0]))
        angle = ANGLE * round(float(turn) / ANGLE)
        way = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        way[np.abs(way) < 1e-12] = 0.0
        length = max(float(away @ way), 0.0)
        scale = float(np.linalg.norm(way * self._scales))
        stepped = float(self._on_grid(np.array(length)))
        guide: tuple[Floats, ...] = ()
        best = REACH
        for axis in (0, 1):
            if abs(way[axis]) > 1e-6 and len(places):
                reached = (places[:, axis] - origin[axis]) / way[axis]
                off = np.abs(reached - length) * scale
                row = int(np.argmin(off))
                if off[row] <= best and reached[row] > 0.0:
                    best, stepped = float(off[row]), float(reached[row])
                    guide = (np.array([places[row], origin + stepped * way]),)
        if abs(stepped - length) * scale > REACH or stepped <= 0.0:
            stepped = float(self.tidy(np.array([length, 0.0]))[0])
        point = np.round(origin + stepped * way, 9) + 0.0
        return Snap(point, f"{angle % 360:g}°, {round(stepped, 4):g} mm", "angle", guide)


def _crossings(sides: Floats, axis: int, value: float) -> Floats:
    """(k, 2) where sides (m, 2, 2) cross the line on which one coordinate has a value."""
    begin, end = sides[:, 0, axis], sides[:, 1, axis]
    cross = (np.minimum(begin, end) <= value) & (np.maximum(begin, end) >= value) & (begin != end)
    share = (value - begin[cross]) / (end[cross] - begin[cross])
    found = sides[cross, 0] + share[:, None] * (sides[cross, 1] - sides[cross, 0])
    found[:, axis] = value
    return found
