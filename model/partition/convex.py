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
    group = np.full(len(corners), -1, np.int32)
    side = np.zeros(len(corners), np.int8)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0))) if len(vertices) else 0.0
    order = np.argsort(wanted, kind="stable")
    ordered = np.asarray(wanted)[order]
    firsts = np.flatnonzero(np.diff(ordered, prepend=-2))
    number = 0
    for first, last in zip(firsts, np.append(firsts[1:], len(order)), strict=True):
        value = int(ordered[first])
        if value < 0:
            continue
        members = order[first:last]
        sign = -1 if value % 2 else 1
        if known[value] or _mutually_behind(
            vertices, corners[members], planes[np.unique(plane_of[members])], sign, size
        ):
            group[members] = number
            side[members] = sign
            number += 1
    return group, side


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
