"""Hatching of a section: parallel lines, cut off at its contours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .section import SectionOutline

MOST_LINES = 4000
"""Across one outline; beyond that the lines are drawn farther apart."""

ANGLES = (45.0, 135.0, 22.5, 112.5, 67.5, 157.5)
"""Degrees, one after another for parts beside each other."""


def hatch(outline: SectionOutline, spacing: float, angle: float = 45.0, shift: float = 0.0) -> NDArray[np.float64]:
    """The pieces (h, 2, 2) of parallel lines inside an outline, in plane coordinates.

    `spacing` in mm, `angle` in degrees from u. The lines keep their places in the plane, whatever the outline: one
    goes through the origin, moved by `shift` spacings. Inside is told by the even-odd rule along each line. Raises
    ValueError for a spacing that is not above 0.
    """
    if not spacing > 0.0:
        raise ValueError(f"lines are drawn at a distance above 0, not {spacing}")
    turn = np.radians(angle)
    along, across = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
    if not len(outline.points):
        return np.zeros((0, 2, 2))
    height, place = outline.points @ across, outline.points @ along
    spacing = max(spacing, float(np.ptp(height)) / MOST_LINES)
    row = height / spacing - shift
    above = np.ceil(row).astype(np.int64)  # the first line at or above each corner
    following = outline.following
    low, high = np.minimum(above, above[following]), np.maximum(above, above[following])
    count = high - low  # lines from low on, high left out: a line through a corner counts at one of its sides
    side = np.repeat(np.arange(len(count)), count)
    line = np.repeat(low - np.cumsum(count) + count, count) + np.arange(len(side))
    if not len(side):
        return np.zeros((0, 2, 2))
    a, b = side, following[side]
    share = (line - row[a]) / (row[b] - row[a])
    where = place[a] + share * (place[b] - place[a])
    order = np.lexsort((where, line))
    line, where = line[order].reshape(-1, 2), where[order].reshape(-1, 2)
    level = (line + shift) * spacing
    return where[..., None] * along + level[..., None] * across
