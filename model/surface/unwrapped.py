"""Triangles as they lie on a bitmap: how much of it they use, how dense its texels are, which lie mirrored or flat."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .mapping import Floats

Flags = NDArray[np.bool_]

SAMPLES, FEWEST = 512, 16
"""Along a side of one copy, where the bitmap's use is looked at; fewer where triangles go over many copies."""
MOST_ROWS = 2_000_000
FLAT = 1e-9
"""A triangle is flat on the bitmap whose area is less than this share of the square of its longest side."""


@dataclass(frozen=True, slots=True, eq=False)
class Unwrapped:
    """`mirrored` and `flat` (t,) say which triangles lie so; `used` is the share of the bitmap, 0 to 1, under any of
    them. `density` are the least, the mean and the most texels a millimetre of those that are not flat, each the
    square root of texels a square millimetre; None without a bitmap."""

    mirrored: Flags
    flat: Flags
    used: float
    density: tuple[float, float, float] | None

    @property
    def count(self) -> int:
        return len(self.flat)


def unwrapped(
    coordinates: Floats, corners: Floats, texels: tuple[int, int] | None = None, wrap: str = "repeat"
) -> Unwrapped:
    """Of triangles with texture coordinates (t, 3, 2) and corners (t, 3, 3) in mm, under a bitmap of so many texels
    (width, height), which goes on beyond its border as `wrap`, one of material.WRAPS, says."""
    area = signed_areas(coordinates)
    sides = coordinates - np.roll(coordinates, 1, axis=1)
    longest = (sides**2).sum(axis=2).max(axis=1, initial=0.0)
    flat = np.abs(area) <= FLAT * np.maximum(longest, 1e-30)
    density = None
    if texels is not None:
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        real = np.linalg.norm(np.cross(first, second), axis=1) / 2.0
        counts = ~flat & (real > 0.0)
        if counts.any():
            on_bitmap = np.abs(area[counts]) * texels[0] * texels[1]
            each = np.sqrt(on_bitmap / real[counts])
            mean = np.sqrt(on_bitmap.sum() / real[counts].sum())
            density = (float(each.min()), float(mean), float(each.max()))
    return Unwrapped(~flat & (area < 0.0), flat, used_share(coordinates, wrap), density)


def signed_areas(coordinates: Floats) -> Floats:
    """(t,) areas on the bitmap, in copies of it; negative where its picture is seen mirrored."""
    a, b = coordinates[:, 1] - coordinates[:, 0], coordinates[:, 2] - coordinates[:, 0]
    return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0


def used_share(coordinates: Floats, wrap: str = "repeat") -> float:
    """The share of one copy, 0 to 1, that lies on any of the triangles (t, 3, 2), by samples on a square grid.

    Each triangle is cut into rows of samples as by a scan line; a row's ends are put into a table of differences,
    whose running sum is the number of triangles on each sample.
    """
    samples = SAMPLES
    rows_of_one = np.ptp(coordinates[..., 1], axis=1).sum() if len(coordinates) else 0.0
    while samples > FEWEST and samples * rows_of_one > MOST_ROWS:
        samples //= 2
    side = 2 * samples if wrap == "mirror" else samples
    row, start, stop = _scanned(coordinates * samples - 0.5)
    if wrap == "clamp":
        within = (row >= 0) & (row < side)
        row, start, stop = row[within], np.clip(start[within], 0, side), np.clip(stop[within], 0, side)
    else:
        length = np.minimum(stop - start, side)
        row, start = row % side, start % side
        stop = start + length
    width = 2 * side + 1  # a row that goes on beyond the border comes in again on the left
    change = np.bincount(row * width + start, minlength=side * width).astype(np.int64)
    change -= np.bincount(row * width + stop, minlength=side * width)
    covered = change.reshape(side, width).cumsum(axis=1) > 0
    covered = covered[:, :side] | covered[:, side : 2 * side]
    if wrap == "mirror":
        covered = covered[:samples] | covered[samples:][::-1]
        covered = covered[:, :samples] | covered[:, samples:][:, ::-1]
    return float(covered.mean())


def triangles_at(coordinates: Floats, point: Floats) -> NDArray[np.intp]:
    """Which triangles (t, 3, 2) a point (2,) lies in, their borders included."""
    a, b, c = np.moveaxis(coordinates - point, 1, 0)
    sides = np.stack([p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((a, b), (b, c), (c, a))])
    inside = (sides >= 0.0).all(axis=0) | (sides <= 0.0).all(axis=0)
    return np.flatnonzero(inside & (np.abs(sides).sum(axis=0) > 0.0))


def _scanned(points: Floats) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Rows of whole numbers that triangles (t, 3, 2) cover: y, the first x, and the x after the last one."""
    low = np.ceil(points[..., 1].min(axis=1, initial=np.inf)).astype(np.int64)
    high = np.floor(points[..., 1].max(axis=1, initial=-np.inf)).astype(np.int64)
    count = np.maximum(high - low + 1, 0)
    owner = np.repeat(np.arange(len(points)), count)
    row = low[owner] + np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for one, other in ((0, 1), (1, 2), (2, 0)):
        a, b = points[owner, one], points[owner, other]
        rise = b[:, 1] - a[:, 1]
        crosses = (np.minimum(a[:, 1], b[:, 1]) <= row) & (row <= np.maximum(a[:, 1], b[:, 1])) & (rise != 0.0)
        x = a[:, 0] + (row - a[:, 1]) / np.where(rise == 0.0, 1.0, rise) * (b[:, 0] - a[:, 0])
        left = np.where(crosses, np.minimum(left, x), left)
        right = np.where(crosses, np.maximum(right, x), right)
    seen = left <= right
    row, left, right = row[seen], np.ceil(left[seen]).astype(np.int64), np.floor(right[seen]).astype(np.int64) + 1
    seen = right > left
    return row[seen], left[seen], right[seen]
