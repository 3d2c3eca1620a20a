"""Triangles of a mesh that run into each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .box_pairs import near_triangles
from .sides import Flags, Floats, Numbers, distinct_places, normals_of

SAME_PLANE = 1e-11
"""As shares of the mesh's size: what lies nearer to a plane is in it; what is shorter than OVERLAP is no crossing."""
OVERLAP = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Crossings:
    """Pairs of `triangles` (k, 2), the middles `places` (k, 3) of what they share, and its lengths `sizes` (k,)."""

    triangles: Numbers
    places: Floats
    sizes: Floats


def crossings(vertices: Floats, triangles: Numbers, told: Callable[[float], None] | None = None) -> Crossings:
    """Triangles (m, 3) that share more than a point, and not only along sides of both; also those lying in one another.

    The intervals that two triangles leave of the line of their planes are compared (Möller 1997); in one plane the
    directions across the six sides are tried. Vertices at one place count as one, so that the seams of meshes whose
    vertices are not joined are no crossings. Triangles without area cross nothing.
    """
    size = float(np.ptp(vertices[triangles].reshape(-1, 3), axis=0).max(initial=0.0)) if len(triangles) else 0.0
    normals = normals_of(vertices, triangles)
    lengths = np.linalg.norm(normals, axis=1)
    rows = np.flatnonzero(lengths > 1e-16 * size * size)
    unit = normals / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    corners = vertices[triangles]
    same = distinct_places(vertices)[triangles]
    pairs: list[Numbers] = [np.zeros((0, 2), np.int64)]
    places: list[Floats] = [np.zeros((0, 3))]
    sizes: list[Floats] = [np.zeros(0)]
    for one, two in near_triangles(corners[rows], SAME_PLANE * size, told):
        one, two = rows[one], rows[two]
        shared = np.zeros(len(one), np.int64)
        for i in range(3):
            for j in range(3):
                shared += same[one, i] == same[two, j]
        kept = shared < 3
        one, two, shared = one[kept], two[kept], shared[kept]
        pair, place, length = _met(corners, unit, one, two, shared, size)
        pairs.append(pair)
        places.append(place)
        sizes.append(length)
    return Crossings(np.concatenate(pairs), np.concatenate(places), np.concatenate(sizes))


def _met(
    corners: Floats, unit: Floats, one: Numbers, two: Numbers, shared: Numbers, size: float
) -> tuple[Numbers, Floats, Floats]:
    over = _heights(corners, unit, two, one, size)
    kept = _meets(over)
    one, two, shared, over = one[kept], two[kept], shared[kept], over[kept]
    under = _heights(corners, unit, one, two, size)
    flat = (over == 0.0).all(axis=1) | (under == 0.0).all(axis=1)
    through, inside = np.flatnonzero(_meets(under) & ~flat & (shared < 2)), np.flatnonzero(flat)
    line = np.cross(unit[one[through]], unit[two[through]])
    line /= np.maximum(np.linalg.norm(line, axis=1, keepdims=True), 1e-300)
    origin = corners[one[through], 0]
    low_one, high_one = _interval(corners[one[through]], under[through], origin, line)
    low_two, high_two = _interval(corners[two[through]], over[through], origin, line)
    low, high = np.maximum(low_one, low_two), np.minimum(high_one, high_two)
    straddle = _straddles(under[through]) | _straddles(over[through])
    hit = (high - low > OVERLAP * size) & straddle
    middle = _foot(corners, unit, one[through], two[through], line) + ((low + high) / 2.0)[:, None] * line
    laid, centre, reach = _overlap(corners[one[inside]], corners[two[inside]], unit[one[inside]], size)
    rows = np.concatenate((through[hit], inside[laid]))
    places, sizes = np.concatenate((middle[hit], centre[laid])), np.concatenate(((high - low)[hit], reach[laid]))
    return np.column_stack((one[rows], two[rows])), places, sizes


def _heights(corners: Floats, unit: Floats, of: Numbers, over: Numbers, size: float) -> Floats:
    """(k, 3) how far the corners of triangles `of` lie before the planes of triangles `over`; 0 within rounding."""
    found = np.zeros((len(of), 3))
    for axis in range(3):  # several times as fast as arrays (k, 3, 3)
        along, origin = unit[over, axis], corners[over, 0, axis]
        for k in range(3):
            found[:, k] += (corners[of, k, axis] - origin) * along
    found[np.abs(found) <= SAME_PLANE * size] = 0.0
    return found


def _meets(heights: Floats) -> Flags:
    """(k,) whether a triangle with corners at heights (k, 3) has a point in the plane."""
    one, two, three = heights.T
    return ~(((one > 0) & (two > 0) & (three > 0)) | ((one < 0) & (two < 0) & (three < 0)))


def _straddles(heights: Floats) -> Flags:
    return (heights.min(axis=1, initial=np.inf) < 0.0) & (heights.max(axis=1, initial=-np.inf) > 0.0)


def _interval(corners: Floats, heights: Floats, origin: Floats, line: Floats) -> tuple[Floats, Floats]:
    """What the plane that heights (k, 3) are measured from leaves of triangles (k, 3, 3), as parameters on the line."""
    along = np.einsum("kij,kj->ki", corners - origin[:, None], line)
    after, along_after = np.roll(heights, -1, axis=1), np.roll(along, -1, axis=1)
    crosses = heights * after < 0.0
    span = np.where(crosses, heights - after, 1.0)
    cut = along + heights / span * (along_after - along)
    points = np.hstack((np.where(crosses, cut, np.nan), np.where(heights == 0.0, along, np.nan)))
    low = np.where(np.isnan(points), np.inf, points).min(axis=1, initial=np.inf)
    return low, np.where(np.isnan(points), -np.inf, points).max(axis=1, initial=-np.inf)


def _foot(corners: Floats, unit: Floats, one: Numbers, two: Numbers, line: Floats) -> Floats:
    """(k, 3) where the first corner of the first triangle falls on the line that the planes have in common."""
    start = corners[one, 0]
    way = np.cross(line, unit[one])
    fall = np.einsum("ij,ij->i", way, unit[two])
    height = np.einsum("ij,ij->i", corners[two, 0] - start, unit[two])
    return start + (height / np.where(np.abs(fall) > 1e-300, fall, 1.0))[:, None] * way


def _overlap(one: Floats, two: Floats, normal: Floats, size: float) -> tuple[Flags, Floats, Floats]:
    """Whether triangles (k, 3, 3) of one plane overlap by more than a line; middles and sizes of their common boxes."""
    depth = np.full(len(one), np.inf)
    for corners in (one, two):
        for k in range(3):
            across = np.cross(normal, corners[:, (k + 1) % 3] - corners[:, k])
            across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
            mine, other = (np.einsum("kij,kj->ki", part - corners[:, k, None], across) for part in (one, two))
            shared = np.minimum(mine.max(axis=1), other.max(axis=1)) - np.maximum(mine.min(axis=1), other.min(axis=1))
            depth = np.minimum(depth, shared)
    low = np.maximum(one.min(axis=1), two.min(axis=1))
    high = np.minimum(one.max(axis=1), two.max(axis=1))
    return depth > OVERLAP * size, (low + high) / 2.0, np.linalg.norm(high - low, axis=1)
