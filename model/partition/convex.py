"""Which faces bound one convex body."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]

NEAR = 1e-8
"""How far a vertex may be on the wrong side of a plane, as a part of the scene's size."""
MOST = 20_000_000
"""Pairs of planes and vertices that are compared for one group; a larger one that nobody vouches for is taken apart."""
BLOCK = 2_000_000


def convex_groups(
    vertices: Floats,
    corners: Indices,
    planes: Floats,
    plane_of: Indices,
    wanted: NDArray[np.integer],
    known: NDArray[np.bool_],
) -> tuple[Indices, NDArray[np.int8]]:
    """The group (t,) and the side (t,) of each triangle, as in Faces.

    `wanted` (t,) says which triangles one leaf made: 2 * owner, + 1 where it was subtracted, -1 where nobody knows;
    `known` (2 * owners,) of which the leaf is convex by its kind. The others are looked at: a group is convex when none
    of its vertices lies before any of its planes (behind, for a subtracted one).
    """
    wanted = np.asarray(wanted)
    values = np.where(wanted >= 0, wanted, len(known))  # the last one stands for "nobody knows"
    there = np.zeros(len(known) + 1, bool)
    there[values] = True
    convex = np.append(known, False) & there
    open_ = there & ~convex
    open_[-1] = False
    if open_.any():
        size = diagonal(vertices)
        some = np.flatnonzero(open_[values])
        some = some[np.argsort(values[some], kind="stable")]
        firsts = np.flatnonzero(np.diff(values[some], prepend=-1))
        for members in np.split(some, firsts[1:]):
            value = int(values[members[0]])
            sign = -1 if value % 2 else 1
            used = planes[np.unique(plane_of[members])]
            convex[value] = _mutually_behind(vertices, corners[members], used, sign, size)
    number = np.where(convex, np.cumsum(convex) - 1, -1).astype(np.int32)
    sides = np.where(convex, 1 - 2 * (np.arange(len(convex)) % 2), 0).astype(np.int8)
    return number[values], sides[values]


def diagonal(points: Floats) -> float:
    """That of the box around points (n, 3)."""
    return float(np.linalg.norm([np.ptp(points[:, axis]) for axis in range(3)])) if len(points) else 0.0


def _mutually_behind(vertices: Floats, corners: Indices, planes: Floats, sign: int, size: float) -> bool:
    points = vertices[np.unique(corners)]
    if len(points) * len(planes) > MOST:
        return False
    step = max(BLOCK // max(len(points), 1), 1)
    for block in (planes[::97], *(planes[begin : begin + step] for begin in range(0, len(planes), step))):
        before = sign * (block[:, :3] @ points.T - block[:, 3:])
        if (before > NEAR * size).any():
            return False
    return True
