"""A rectangle of a plane with a grid on it, as large as the part of a box that it cuts."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground import step_for
from .placed_cells import Cells

CELLS = 12.0  # about so many along the longer side
CORNERS = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)])
SIDES = np.array([(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit])


@dataclass(frozen=True, slots=True)
class PlaneGrid:
    """The rectangle, its grid, and the box (2, 3) around it; all empty where the plane misses the box."""

    faces: Cells
    lines: Cells
    bounds: NDArray[np.float64]


def plane_grid(normal: ArrayLike, point: ArrayLike, box: NDArray[np.float64]) -> PlaneGrid:
    """`normal` (3,) and `point` (3,) of the plane, `box` (2, 3), all in the same axes, of which the grid takes the ones
    that lie nearest to the plane."""
    upward = np.asarray(normal, float) / np.linalg.norm(normal)
    axis = np.zeros(3)
    axis[int(np.argmin(np.abs(upward)))] = 1.0
    first = axis - upward * (axis @ upward)
    first /= np.linalg.norm(first)
    frame = np.array([first, np.cross(upward, first)])
    origin = np.asarray(point, float)
    cut = _cut(upward, origin, box)
    if len(cut) < 3:
        none = np.zeros((0, 3))
        cells = np.zeros((0, 3), np.int32)
        return PlaneGrid(Cells(none, cells), Cells(none, cells[:, :2]), np.array([origin, origin]))
    flat = (cut - origin) @ frame.T
    low, high = flat.min(axis=0), flat.max(axis=0)
    step = step_for(40.0 / CELLS * float((high - low).max()))
    low, high = np.floor(low / step) * step, np.ceil(high / step) * step
    ends = []
    for along in (0, 1):
        marks = np.arange(round(low[along] / step), round(high[along] / step) + 1) * step
        line = np.empty((len(marks), 2, 2))
        line[:, :, along] = marks[:, None]
        line[:, :, 1 - along] = low[1 - along], high[1 - along]
        ends.append(line.reshape(-1, 2))
    lines = np.concatenate(ends) @ frame + origin
    corners = np.array([low, (high[0], low[1]), high, (low[0], high[1])]) @ frame + origin
    pairs = np.arange(len(lines), dtype=np.int32).reshape(-1, 2)
    bounds = np.array([corners.min(axis=0), corners.max(axis=0)])
    return PlaneGrid(Cells(corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32)), Cells(lines, pairs), bounds)


def _cut(normal: NDArray[np.float64], point: NDArray[np.float64], box: NDArray[np.float64]) -> NDArray[np.float64]:
    """(k, 3) where the plane meets the sides of the box."""
    corners = box[0] + CORNERS * (box[1] - box[0])
    heights = (corners - point) @ normal
    a, b = heights[SIDES].T
    crossing = (a <= 0.0) != (b <= 0.0)
    share = (a[crossing] / (a[crossing] - b[crossing]))[:, None]
    start, end = corners[SIDES[crossing, 0]], corners[SIDES[crossing, 1]]
    return start + share * (end - start)
