"""Polygons as pixels: which pixel centres each covers, how deep, and what is in front."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .clipping import Polygons, clipped
from .stages import Floats, divided

SUB = 256
"""Steps within a pixel to which corners are rounded, as graphics cards do: then sums of products are exact."""
MOST_TOGETHER = 1 << 21
"""Pixels in the boxes around triangles that are looked at in one go."""

Integers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Raster:
    """A picture (h, w): `depth` of what is in front, 1 where nothing is; `polygon` its number, -1 where nothing is;
    and how many polygons cover each pixel, in `layers`. `triangles` is how many the polygons were cut into."""

    depth: Floats
    polygon: Integers
    layers: Integers
    triangles: int

    @property
    def fragments(self) -> int:
        """Pixels of all polygons, hidden ones included."""
        return int(self.layers.sum())

    @property
    def pixels(self) -> int:
        """Pixels of the picture that are covered."""
        return int((self.layers > 0).sum())


def raster(
    polygons: Polygons,
    viewport: Floats,
    size: tuple[int, int],
    stopped: Callable[[], bool] = lambda: False,
) -> Raster | None:
    """The picture of polygons in clip coordinates, `size` = (width, height) pixels; None where it was stopped.

    A pixel belongs to a polygon that holds its centre: on the right side of each side's line (Pineda 1988), where on a
    line itself it belongs to what lies to the right or below, so that no pixel along a shared side is drawn twice or
    not at all. Depth is linear in the picture.
    """
    width, height = size
    corners = _in_picture(polygons, viewport, size)
    source, triangles, depths = _fans(corners)
    count = width * height
    deepest, front = np.full(count, np.inf), np.full(count, -1, np.int64)
    layers = np.zeros(count, np.int64)
    for some in _portions(triangles):
        if stopped():
            return None
        which, pixel, depth = _fragments(triangles[some], depths[some], width, height)
        layers += np.bincount(pixel, minlength=count)
        np.minimum.at(deepest, pixel, depth)
        best = depth == deepest[pixel]
        front[pixel[best]] = source[some][which[best]]
    shape = (height, width)
    seen = np.where(front >= 0, deepest, 1.0)
    return Raster(seen.reshape(shape), front.reshape(shape), layers.reshape(shape), len(triangles))


def _in_picture(polygons: Polygons, viewport: Floats, size: tuple[int, int]) -> Polygons:
    """Homogeneous pixels, cut off at the picture's border and at what is behind the eye, which has no pixel."""
    width, height = size
    border = np.array([(1, 0, 0, 0), (-1, 0, 0, width), (0, 1, 0, 0), (0, -1, 0, height), (0, 0, 0, 1)], float)
    placed = polygons.corners @ viewport.T
    # Corners beyond the count repeat the first one, which changes nothing.
    unused = np.arange(placed.shape[1]) >= polygons.counts[:, None]
    placed = np.where(unused[..., None], placed[:, :1], placed)
    return clipped(placed, border)


def _fans(polygons: Polygons) -> tuple[Integers, Integers, Floats]:
    """Polygon numbers (t,), corners (t, 3, 2) in steps of 1 / SUB pixel, running so that their inside counts positive,
    and depths (t, 3)."""
    corners = divided(np.where(polygons.corners[..., 3:] > 0.0, polygons.corners, np.nan))
    fan = np.arange(1, corners.shape[1] - 1)
    three = np.stack((np.zeros_like(fan), fan, fan + 1), axis=1)
    number, part = np.nonzero(fan + 1 < polygons.counts[:, None])
    found = corners[number[:, None], three[part]]  # (t, 3, 3)
    proper = np.isfinite(found).all(axis=(1, 2))
    number, found = number[proper], found[proper]
    steps = np.round(found[..., :2] * SUB).astype(np.int64)
    one, other = steps[:, 1] - steps[:, 0], steps[:, 2] - steps[:, 0]
    area = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    back = area < 0
    steps[back], found[back] = steps[back][:, ::-1], found[back][:, ::-1]
    there = area != 0
    return number[there].astype(np.int64), steps[there], found[there, :, 2]


def _portions(triangles: Integers) -> Iterator[slice]:
    """Runs of triangles whose boxes hold about MOST_TOGETHER pixels."""
    boxes = (np.ptp(triangles, axis=1) // SUB + 1).prod(axis=1)
    ends = np.flatnonzero(np.diff(np.cumsum(boxes) // MOST_TOGETHER, append=-1)) + 1
    start = 0
    for end in ends.tolist():
        yield slice(start, end)
        start = end


def _fragments(triangles: Integers, depths: Floats, width: int, height: int) -> tuple[Integers, Integers, Floats]:
    """Of each covered pixel the triangle's number, the pixel's, row by row, and the depth; (f,) each.

    The lines of the sides are solved for the columns of each row.
    """
    top, bottom = triangles[..., 1].min(axis=1), triangles[..., 1].max(axis=1)
    first = np.maximum(-((SUB // 2 - top) // SUB), 0)
    last = np.minimum((bottom - SUB // 2) // SUB, height - 1)
    which, row = _runs(first, last - first + 1)
    y = SUB * row + SUB // 2
    left, right = np.zeros(len(row), np.int64), np.full(len(row), width - 1, np.int64)
    for side in range(3):
        a, b = triangles[which, side], triangles[which, (side + 1) % 3]
        dx, dy = (b - a).T
        owned = (dy < 0) | ((dy == 0) & (dx > 0))  # a left side or an upper one
        room = dx * (y - a[:, 1]) + dy * a[:, 0] - dy * (SUB // 2) - np.where(owned, 0, 1)
        # Inside is where SUB * dy * column <= room.
        by = SUB * np.where(dy == 0, 1, dy)
        right = np.where(dy > 0, np.minimum(right, room // by), right)
        left = np.where(dy < 0, np.maximum(left, -(-room // by)), left)
        right = np.where((dy == 0) & (room < 0), -1, right)
    span, column = _runs(left, right - left + 1)
    which, row = which[span], row[span]
    return which, row * width + column, _depth(triangles, depths, which, row, column)


def _depth(triangles: Integers, depths: Floats, which: Integers, row: Integers, column: Integers) -> Floats:
    one, other = (triangles[:, 1] - triangles[:, 0]) / SUB, (triangles[:, 2] - triangles[:, 0]) / SUB
    area = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    rise, rise_other = depths[:, 1] - depths[:, 0], depths[:, 2] - depths[:, 0]
    along_x = (rise * other[:, 1] - rise_other * one[:, 1]) / area
    along_y = (rise_other * one[:, 0] - rise * other[:, 0]) / area
    start = triangles[:, 0] / SUB
    at = depths[:, 0] - along_x * (start[:, 0] - 0.5) - along_y * (start[:, 1] - 0.5)
    found = at[which] + along_x[which] * column + along_y[which] * row
    # A sliver's slope may leave what its corners have.
    return np.clip(found, depths.min(axis=1)[which], depths.max(axis=1)[which])


def _runs(starts: Integers, counts: Integers) -> tuple[Integers, Integers]:
    """The places of the runs, and the numbers from each start on, `counts` of them (none below 1)."""
    counts = np.maximum(counts, 0)
    which = np.repeat(np.arange(len(counts)), counts)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts) + starts[which]
