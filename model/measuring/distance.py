"""How far two things are apart, where they are nearest, and the angle between them.

A thing is an array of points: (3,) a point, (2, 3) a straight edge, (k, 3, 3) the triangles of a face; an `Axis` has no
ends. Nearest points of lines and triangles as in Ericson, Real-Time Collision Detection (2005), chapter 5: the nearest
points of two triangles lie at a corner of one of them, on an edge of each, or where one is pierced.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .vectors import three, unit

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

BLOCK = 16
"""Triangles that are looked at together as one box; more where there were too many boxes."""
MOST_BLOCKS = 1000
FIRST = 32
"""Pairs that are tried before the rest: most of which they leave out."""
BATCH = 20_000
"""Pairs of triangles that are reckoned at once."""
PARALLEL = 1e-12
"""The squared sine below which two directions are the same."""


@dataclass(frozen=True, slots=True)
class Axis:
    """A line without ends; `direction` is unit."""

    point: Vector
    direction: Vector


@dataclass(frozen=True, slots=True)
class Distance:
    """Millimetres between the nearest points `a` and `b`; both are the same where the things meet."""

    length: float
    a: Vector
    b: Vector

    @property
    def delta(self) -> Vector:
        """From a to b along x, y and z."""
        x, y, z = (to - start for start, to in zip(self.a, self.b, strict=True))
        return x, y, z


Thing = NDArray[np.floating] | Axis


def distance(one: Thing, other: Thing) -> Distance:
    """The shortest way from one thing to another. Raises ValueError for arrays of another shape and for empty ones."""
    if isinstance(other, Axis):
        if isinstance(one, Axis):
            return _answer(*_lines(*_ends(one), *_ends(other), (False, False)))
        return _swapped(distance(other, one))
    there = _checked(other)
    if isinstance(one, Axis):
        point, along = _ends(one)
        if there.ndim == 1:
            return _answer(*_point_line(there[None], point, along, bounded=False)[::-1])
        if there.ndim == 2:
            return _answer(*_lines(point, along, there[:1], there[1:] - there[:1], (False, True)))
        return _axis_triangles(point, along, there)
    here = _checked(one)
    if here.ndim > there.ndim:
        return _swapped(distance(there, here))
    if here.ndim == 3:
        return _triangles(here, there)
    if here.ndim == 2:
        if there.ndim == 2:
            return _answer(*_lines(here[:1], here[1:] - here[:1], there[:1], there[1:] - there[:1], (True, True)))
        return _triangles(here[[0, 1, 1]][None], there)
    if there.ndim == 1:
        return _answer(here[None], there[None])
    if there.ndim == 2:
        return _answer(here[None], _point_line(here[None], there[:1], there[1:] - there[:1])[1])
    return _answer(*_point_triangle(np.broadcast_to(here, (len(there), 3)), there))


def angle_between(one: Vector, other: Vector) -> float:
    """Degrees from 0 to 180 between two directions (Kahan's formula, exact also where they are nearly the same)."""
    a, b = unit(np.array(one, dtype=np.float64)), unit(np.array(other, dtype=np.float64))
    return math.degrees(2 * math.atan2(float(np.linalg.norm(a - b)), float(np.linalg.norm(a + b))))


def edge_angle(one: Vector, other: Vector) -> float:
    """Degrees from 0 to 90 between two lines, or the planes with two normals."""
    angle = angle_between(one, other)
    return min(angle, 180 - angle)


def edge_face_angle(edge: Vector, normal: Vector) -> float:
    """Degrees from 0, for a line in the plane, to 90, for one at right angles to it."""
    return 90 - edge_angle(edge, normal)


def _checked(thing: NDArray[np.floating]) -> Floats:
    points = np.asarray(thing, dtype=np.float64)
    if points.shape not in ((3,), (2, 3)) and (points.ndim != 3 or points.shape[1:] != (3, 3) or not len(points)):
        raise ValueError(f"a point (3,), an edge (2, 3) or triangles (k, 3, 3) are needed, not {points.shape}")
    return points


def _ends(axis: Axis) -> tuple[Floats, Floats]:
    return np.array([axis.point], dtype=np.float64), np.array([axis.direction], dtype=np.float64)


def _swapped(found: Distance) -> Distance:
    return Distance(found.length, found.b, found.a)


def _answer(a: Floats, b: Floats) -> Distance:
    """The nearest of the pairs of points (n, 3)."""
    lengths = np.linalg.norm(b - a, axis=1)
    best = int(np.argmin(lengths))
    return Distance(float(lengths[best]), three(a[best]), three(b[best]))


# Kernels, row by row: points (n, 3), lines as start and way (n, 3), triangles (n, 3, 3).


def _point_line(points: Floats, start: Floats, way: Floats, bounded: bool = True) -> tuple[Floats, Floats]:
    """The points, and the nearest ones of the lines."""
    square = np.einsum("ij,ij->i", way, way)
    part = np.einsum("ij,ij->i", points - start, way) / np.where(square > 0, square, 1)
    if bounded:
        part = np.clip(part, 0, 1)
    return points, start + part[:, None] * way


def _lines(a: Floats, u: Floats, b: Floats, v: Floats, bounded: tuple[bool, bool]) -> tuple[Floats, Floats]:
    """The nearest points of lines, with ends where `bounded`.

    Where both nearest points of the endless lines lie within they are the answer, else one of the ends is nearest.
    """
    uu, vv, uv = (np.einsum("ij,ij->i", x, y) for x, y in ((u, u), (v, v), (u, v)))
    gap = b - a
    ug, vg = np.einsum("ij,ij->i", u, gap), np.einsum("ij,ij->i", v, gap)
    determinant = uu * vv - uv * uv
    skew = determinant > PARALLEL * uu * vv
    safe = np.where(skew, determinant, 1)
    s, t = (ug * vv - vg * uv) / safe, (ug * uv - vg * uu) / safe
    inner = skew.copy()
    for parameter, ends in ((s, bounded[0]), (t, bounded[1])):
        if ends:
            inner &= (parameter >= 0) & (parameter <= 1)
    near_a, near_b = a + s[:, None] * u, b + t[:, None] * v
    best = np.where(inner, np.einsum("ij,ij->i", near_b - near_a, near_b - near_a), np.inf)
    candidates = []
    if bounded[0]:
        candidates += [_point_line(a, b, v, bounded[1]), _point_line(a + u, b, v, bounded[1])]
    if bounded[1]:
        candidates += [_point_line(b, a, u, bounded[0])[::-1], _point_line(b + v, a, u, bounded[0])[::-1]]
    if not any(bounded):
        candidates.append(_point_line(a, b, v, False))
    for one, other in candidates:
        square = np.einsum("ij,ij->i", other - one, other - one)
        nearer = square < best
        best = np.where(nearer, square, best)
        near_a, near_b = np.where(nearer[:, None], one, near_a), np.where(nearer[:, None], other, near_b)
    return near_a, near_b


def _point_triangle(points: Floats, triangles: Floats) -> tuple[Floats, Floats]:
    """The points, and the nearest ones of the triangles."""
    return points, nearest_on_triangles(points, triangles)


def nearest_on_triangles(points: Floats, triangles: Floats) -> Floats:
    """(n, 3) of triangles (n, 3, 3) the place nearest to each of points (n, 3): the foot where it lies within, else on
    a side."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    square = np.einsum("ij,ij->i", normal, normal)
    flat = square <= 1e-30 * np.maximum(np.einsum("ij,ij->i", b - a, b - a), np.einsum("ij,ij->i", c - a, c - a)) ** 2
    height = np.einsum("ij,ij->i", points - a, normal) / np.where(flat, 1, square)
    foot = points - height[:, None] * normal
    within = ~flat
    for start, end in ((a, b), (b, c), (c, a)):
        within &= np.einsum("ij,ij->i", np.cross(end - start, foot - start), normal) >= 0
    near = foot
    best = np.where(within, np.einsum("ij,ij->i", foot - points, foot - points), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        _, other = _point_line(points, start, end - start)
        gap = np.einsum("ij,ij->i", other - points, other - points)
        nearer = gap < best
        best, near = np.where(nearer, gap, best), np.where(nearer[:, None], other, near)
    return near


def _pierced(start: Floats, way: Floats, triangles: Floats, bounded: bool = True) -> tuple[NDArray[np.bool_], Floats]:
    """Which lines pass through their triangles, and where (Möller and Trumbore, 1997)."""
    a = triangles[:, 0]
    first, second = triangles[:, 1] - a, triangles[:, 2] - a
    across = np.cross(way, second)
    determinant = np.einsum("ij,ij->i", first, across)
    size = np.linalg.norm(np.cross(first, second), axis=1) * np.linalg.norm(way, axis=1)
    proper = np.abs(determinant) > 1e-14 * size
    safe = np.where(proper, determinant, 1)
    offset = start - a
    u = np.einsum("ij,ij->i", offset, across) / safe
    turned = np.cross(offset, first)
    v = np.einsum("ij,ij->i", way, turned) / safe
    t = np.einsum("ij,ij->i", second, turned) / safe
    hit = proper & (u >= 0) & (v >= 0) & (u + v <= 1)
    if bounded:
        hit &= (t >= 0) & (t <= 1)
    return hit, start + t[:, None] * way


def _triangle_pairs(one: Floats, other: Floats) -> tuple[Floats, Floats]:
    """The nearest points of pairs of triangles (n, 3, 3)."""
    found: list[tuple[Floats, Floats]] = []
    for i in range(3):
        found.append(_point_triangle(one[:, i], other))
        corner, foot = _point_triangle(other[:, i], one)
        found.append((foot, corner))
        u = _side(one, i)
        for j in range(3):
            found.append(_lines(one[:, i], u, other[:, j], _side(other, j), (True, True)))
        for start, way, pierced in ((one[:, i], u, other), (other[:, i], _side(other, i), one)):
            hit, where = _pierced(start, way, pierced)
            corner, foot = found[0]
            found.append((np.where(hit[:, None], where, corner), np.where(hit[:, None], where, foot)))
    gaps = np.array([np.einsum("ij,ij->i", b - a, b - a) for a, b in found])
    best = gaps.argmin(axis=0)
    rows = np.arange(len(one))
    return np.array([a for a, _ in found])[best, rows], np.array([b for _, b in found])[best, rows]


def _side(triangles: Floats, corner: int) -> Floats:
    """(n, 3) from a corner to the next one."""
    return triangles[:, (corner + 1) % 3] - triangles[:, corner]


def _axis_triangles(point: Floats, along: Floats, triangles: Floats) -> Distance:
    count = len(triangles)
    point, along = np.broadcast_to(point, (count, 3)), np.broadcast_to(along, (count, 3))
    hit, where = _pierced(point, along, triangles, bounded=False)
    if hit.any():
        first = where[np.argmax(hit)][None]
        return _answer(first, first)
    pairs = [_lines(point, along, triangles[:, i], _side(triangles, i), (False, True)) for i in range(3)]
    return _answer(np.concatenate([a for a, _ in pairs]), np.concatenate([b for _, b in pairs]))


def _triangles(one: Floats, other: Floats) -> Distance:
    """The nearest points of two sets of triangles.

    Boxes around blocks of neighbouring triangles, and then around the triangles, leave out what lies farther away than
    a distance already found.
    """
    one, other = _sorted(one), _sorted(other)
    rows_in, columns_in = (max(BLOCK, len(triangles) // MOST_BLOCKS) for triangles in (one, other))
    blocks, counter = _blocks(one, rows_in), _blocks(other, columns_in)
    lower = _box_gaps(blocks, counter).ravel()
    best = _answer(one[:1, 0], other[:1, 0])
    order = np.array([lower.argmin()])
    while len(order) and lower[order[0]] < best.length:
        rows, columns = np.divmod(order, len(counter))
        i = np.minimum(rows[:, None] * rows_in + np.arange(rows_in), len(one) - 1)
        j = np.minimum(columns[:, None] * columns_in + np.arange(columns_in), len(other) - 1)
        i = np.repeat(i[:, :, None], columns_in, axis=2).ravel()
        j = np.repeat(j[:, None, :], rows_in, axis=1).ravel()
        gap = np.maximum(one[i].min(axis=1) - other[j].max(axis=1), other[j].min(axis=1) - one[i].max(axis=1))
        square = (np.maximum(gap, 0) ** 2).sum(axis=1)
        near = np.flatnonzero(square < best.length**2)
        # The nearest boxes first: what is found there leaves out most of the rest.
        near = near[np.argsort(square[near], kind="stable")]
        for part in (near[:FIRST], near[FIRST:]):
            part = part[square[part] < best.length**2]
            if len(part):
                found = _answer(*_triangle_pairs(one[i[part]], other[j[part]]))
                best = min(best, found, key=lambda answer: answer.length)
        lower[order] = np.inf
        order = np.flatnonzero(lower < best.length)
        if len(order):
            order = order[np.argsort(lower[order], kind="stable")][: max(BATCH // (rows_in * columns_in), 1)]
    return best


def _sorted(triangles: Floats) -> Floats:
    """Neighbours side by side: in Morton order of their middles, with 10 bits for each axis."""
    if len(triangles) <= BLOCK:
        return triangles
    middles = triangles.mean(axis=1)
    low, size = middles.min(axis=0), np.maximum(np.ptp(middles, axis=0), 1e-300)
    cells = np.minimum((middles - low) / size * 1024, 1023).astype(np.int64)
    key = np.zeros(len(cells), np.int64)
    for bit in range(10):
        key |= (((cells >> bit) & 1) << (3 * bit + np.arange(3))).sum(axis=1)
    return triangles[np.argsort(key, kind="stable")]


def _blocks(triangles: Floats, size: int) -> Floats:
    """(b, 2, 3) boxes around blocks of `size` triangles."""
    starts = np.arange(0, len(triangles), size)
    low = np.minimum.reduceat(triangles.min(axis=1), starts)
    return np.stack([low, np.maximum.reduceat(triangles.max(axis=1), starts)], axis=1)


def _box_gaps(one: Floats, other: Floats) -> Floats:
    """(m, n) how far boxes (m, 2, 3) are from boxes (n, 2, 3)."""
    gaps = np.zeros((len(one), len(other)))
    for axis in range(3):
        low, high = one[:, None, 0, axis] - other[:, 1, axis], other[:, 0, axis] - one[:, None, 1, axis]
        gaps += np.maximum(np.maximum(low, high), 0) ** 2
    return np.sqrt(gaps)
