"""Polygons and lines cut off at the six sides of what is visible, in clip coordinates, before the division."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .stages import Floats, divided

PLANES = np.array([(1, 0, 0, 1), (-1, 0, 0, 1), (0, 1, 0, 1), (0, -1, 0, 1), (0, 0, 1, 1), (0, 0, -1, 1)], float)
"""Left, right, bottom, top, near, far: a point is inside where the product with each row is not negative."""
NAMES = ("left", "right", "bottom", "top", "near", "far")


@dataclass(frozen=True, slots=True, eq=False)
class Polygons:
    """Polygons of up to k corners: `corners` (n, k, 4), of which the first `counts` (n,) are used; 0 where nothing is
    left."""

    corners: Floats
    counts: NDArray[np.int64]

    def polygon(self, number: int) -> Floats:
        """(c, 4) the corners of one."""
        return self.corners[number, : self.counts[number]]


def clipped(triangles: Floats, planes: Floats = PLANES) -> Polygons:
    """Triangles (n, 3, 4), or polygons (n, k, 4) of k corners each, in clip coordinates, cut off at planes (p, 4).

    Sutherland and Hodgman (1974): each plane takes the corners inside it, and where a side crosses it the crossing; all
    polygons at once. What lies inside all planes, or outside one of them, is known without (Cohen and Sutherland).
    """
    corners = np.asarray(triangles, float)
    counts = np.full(len(corners), corners.shape[1], np.int64)
    within = corners @ planes.T >= 0.0  # (n, k, p)
    whole, gone = np.all(within, axis=(1, 2)), np.any(np.all(~within, axis=1), axis=1)
    torn = np.flatnonzero(~whole & ~gone)
    some, some_counts = corners[torn], counts[torn]
    for plane in planes:
        some, some_counts = _cut(some, some_counts, plane)
    result = np.zeros((len(corners), max(corners.shape[1], some.shape[1]), 4))
    result[whole, : corners.shape[1]] = corners[whole]
    result[torn, : some.shape[1]] = some
    counts[gone], counts[torn] = 0, some_counts
    return Polygons(result, counts)


def _cut(corners: Floats, counts: NDArray[np.int64], plane: Floats) -> tuple[Floats, NDArray[np.int64]]:
    count, most = corners.shape[:2]
    used = np.arange(most) < counts[:, None]
    after = np.where(np.arange(1, most + 1) < counts[:, None], np.arange(1, most + 1), 0)
    height = corners @ plane
    if ((height >= 0.0) | ~used).all():
        return corners, counts
    beyond = np.take_along_axis(height, after, axis=1)
    inside, inside_after = height >= 0.0, beyond >= 0.0
    following = np.take_along_axis(corners, after[..., None], axis=1)
    # From the end inside: two polygons with this side in common get the same crossing.
    start, end = np.where(inside[..., None], corners, following), np.where(inside[..., None], following, corners)
    near, far = np.where(inside, height, beyond), np.where(inside, beyond, height)
    span = near - far
    share = near / np.where(span != 0.0, span, 1.0)
    crossing = start + share[..., None] * (end - start)
    # Of each corner come itself, where it is inside, and the crossing of the side after it.
    kept = np.stack((inside & used, (inside != inside_after) & used), axis=2).reshape(count, 2 * most)
    found = np.stack((corners, crossing), axis=2).reshape(count, 2 * most, 4)
    new_counts = kept.sum(axis=1)
    place = np.cumsum(kept, axis=1) - 1
    result = np.zeros((count, max(int(new_counts.max(initial=0)), 1), 4))
    row, column = np.nonzero(kept)
    result[row, place[row, column]] = found[row, column]
    return result, new_counts


def clipped_lines(lines: Floats, planes: Floats = PLANES) -> tuple[Floats, NDArray[np.bool_]]:
    """Lines (n, 2, 4) in clip coordinates, cut off at planes; and (n,) whether anything of each is left.

    By the parameters at which a line enters and leaves (Liang and Barsky 1984; in homogeneous coordinates Blinn and
    Newell 1978).
    """
    ends = np.asarray(lines, float)
    heights = ends @ planes.T  # (n, 2, p)
    a, b = heights[:, 0], heights[:, 1]
    span = np.where(a != b, a - b, 1.0)
    at = a / span
    enter = np.where((a < 0.0) & (b >= 0.0), at, 0.0).max(axis=1, initial=0.0)
    leave = np.where((a >= 0.0) & (b < 0.0), at, 1.0).min(axis=1, initial=1.0)
    visible = ~((a < 0.0) & (b < 0.0)).any(axis=1) & (enter <= leave)
    way = ends[:, 1] - ends[:, 0]
    return np.stack((ends[:, 0] + enter[:, None] * way, ends[:, 0] + leave[:, None] * way), axis=1), visible


def front_facing(polygons: Polygons) -> NDArray[np.bool_]:
    """(n,) whether polygons within what is visible run counter-clockwise on the screen."""
    device = divided(np.where(polygons.corners[..., 3:] == 0.0, 1.0, polygons.corners))[..., :2]
    most = device.shape[1]
    used = np.arange(most) < polygons.counts[:, None]
    after = np.where(np.arange(1, most + 1) < polygons.counts[:, None], np.arange(1, most + 1), 0)
    following = np.take_along_axis(device, after[..., None], axis=1)
    area = device[..., 0] * following[..., 1] - device[..., 1] * following[..., 0]
    return np.where(used, area, 0.0).sum(axis=1) > 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """What is left of t triangles: `polygons` in clip coordinates, each with the number of the triangle it is of in
    `source` (n,), and whether a plane has cut it in `cut` (n,). `outside` (t,) and `away` (t,) tell the triangles of
    which nothing is left, and those whose rest faces away from the eye."""

    polygons: Polygons
    source: NDArray[np.int64]
    cut: NDArray[np.bool_]
    outside: NDArray[np.bool_]
    away: NDArray[np.bool_]


def drawn(clip: Floats, triangles: NDArray[np.integer], cull: bool = True, planes: Floats = PLANES) -> Drawn:
    """What is drawn of triangles (t, 3) over points with clip coordinates (n, 4): cut off at planes (p, 4), and with
    `cull` without those that face away."""
    corners = clip[np.asarray(triangles)]
    within = np.all(corners @ planes.T >= 0.0, axis=(1, 2))
    polygons = clipped(corners, planes)
    left = polygons.counts >= 3
    facing = front_facing(polygons)
    kept = np.flatnonzero(left & (facing | (not cull)))
    return Drawn(Polygons(polygons.corners[kept], polygons.counts[kept]), kept, ~within[kept], ~left, left & ~facing)
