"""Which of many edges or triangles come near each other: a hierarchy of boxes walked in pairs, in whole batches."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

BATCH = 1 << 18
BITS = 10  # of each coordinate in a Morton number
RUNNING = 4.0
"""How many times as much as across it edges run in a direction that boxes are turned to."""


def meeting(
    low: Floats, high: Floats, told: Callable[[float], None] | None = None
) -> Iterator[tuple[Numbers, Numbers]]:
    """Pairs of boxes with a point in common, in batches: two arrays (k,) of their numbers, each pair once.

    Boxes are `low`, `high` (n, d), of two or three dimensions. They are put in the order of their Morton numbers and
    neighbours packed by twos, level upon level; pairs of packs that meet are opened. `told` hears the share of the work
    that is done, 0 to 1.
    """
    count = len(low)
    if count < 2:
        return
    order = np.argsort(_morton((low + high) / 2.0), kind="stable")
    levels = _levels(low[order], high[order])
    root = np.zeros(1, np.int64)
    # Every pair that waits has its part of the work, which is handed down to the pairs within it.
    waiting = [(len(levels) - 1, root, root, 1.0)]
    done = 0.0
    while waiting:
        level, one, two, share = waiting.pop()
        if level == 0:
            apart = one != two
            yield order[one[apart]], order[two[apart]]
            done += share
        else:
            one, two = _opened(levels[level - 1], one, two)
            batches = max(-(-len(one) // BATCH), 1)
            for part in range(batches if len(one) else 0):
                rows = slice(part * BATCH, (part + 1) * BATCH)
                waiting.append((level - 1, one[rows], two[rows], share / batches))
            done += 0.0 if len(one) else share
        if told:
            told(min(done, 1.0))


def near_segments(
    a: Floats, b: Floats, margin: float, told: Callable[[float], None] | None = None
) -> Iterator[tuple[Numbers, Numbers]]:
    """Pairs of segments a b (n, 3) whose boxes, larger by `margin` on all sides, meet, in batches."""
    axes = _axes(b - a)
    one, two = a @ axes, b @ axes
    yield from meeting(np.minimum(one, two) - margin, np.maximum(one, two) + margin, told)


def near_triangles(
    corners: Floats, margin: float, told: Callable[[float], None] | None = None
) -> Iterator[tuple[Numbers, Numbers]]:
    """The same of triangles (n, 3, 3)."""
    turned = corners @ _axes((np.roll(corners, -1, axis=1) - corners).reshape(-1, 3))
    yield from meeting(turned.min(axis=1) - margin, turned.max(axis=1) + margin, told)


def _axes(ways: Floats) -> Floats:
    """(3, 3) columns that boxes lie along: where most of the length runs one way, that way is one of them, since long
    edges side by side would all meet in boxes that lie askew to them."""
    spread, axes = np.linalg.eigh(ways.T @ ways)
    return axes if spread[2] > RUNNING * spread[1] else np.eye(3)


def _opened(level: tuple[Floats, Floats], one: Numbers, two: Numbers) -> tuple[Numbers, Numbers]:
    """The pairs within pairs of packs, of those that meet on the level below."""
    low, high = level
    same = one == two
    packs, a, b = one[same], one[~same], two[~same]
    first = np.concatenate((2 * packs, 2 * packs, 2 * packs + 1, 2 * a, 2 * a, 2 * a + 1, 2 * a + 1))
    second = np.concatenate((2 * packs, 2 * packs + 1, 2 * packs + 1, 2 * b, 2 * b + 1, 2 * b, 2 * b + 1))
    there = (first < len(low)) & (second < len(low))
    first, second = first[there], second[there]
    for axis in range(low.shape[1]):  # axis by axis, since most pairs part on the first
        kept = (low[first, axis] <= high[second, axis]) & (low[second, axis] <= high[first, axis])
        first, second = first[kept], second[kept]
    return first, second


def _levels(low: Floats, high: Floats) -> list[tuple[Floats, Floats]]:
    found = [(low, high)]
    while len(low) > 1:
        starts = np.arange(0, len(low), 2)
        low, high = np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)
        found.append((low, high))
    return found


def _morton(centres: Floats) -> Numbers:
    """The bits of the coordinates, each in its turn."""
    least = centres.min(axis=0)
    reach = max(float(np.ptp(centres, axis=0).max()), 1e-300)
    steps = ((centres - least) / reach * ((1 << BITS) - 1)).astype(np.int64)
    width = centres.shape[1]
    found = np.zeros(len(centres), np.int64)
    for bit in range(BITS):
        for axis in range(width):
            found |= ((steps[:, axis] >> bit) & 1) << (width * bit + axis)
    return found
