"""How far a body can be moved along a direction until it meets others.

What moves is tested a hair smaller than it is, so that what it lies flush with holds it back only where it would go in;
how far it can go is then told by the very planes that come together: a corner's and a face's, or of two sides (Canny
1986, "Collision detection for moving polyhedra"). The boxes that triangles sweep leave few pairs of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import native
from .bodies import Body, relation
from .boxes import BoxTree, Floats

HAIR = 1e-9
"""The share of the coordinates by which what moves is shrunk."""
BATCH = 1 << 18
"""Pairs of triangles at a time, in NumPy."""


@dataclass(frozen=True, slots=True, eq=False)
class Stop:
    """Where a body is held back after `way` mm: by which of those that stand (`other`, its place in their list), at a
    `point` (3,), and the unit `normal` (3,) there, which points from that one to the body."""

    way: float
    other: int
    point: Floats
    normal: Floats


class Sweep:
    """A body that may move without turning, past others. Those that it overlaps at first do not hold it back."""

    def __init__(self, moving: Body, standing: Sequence[Body]) -> None:
        self.moving, self.standing = moving, tuple(standing)
        self._free: set[int] = {k for k, body in enumerate(self.standing) if body.empty}
        self._known: set[int] = set(self._free)
        if not moving.empty:
            most = max([float(np.abs(body.bounds).max()) for body in (moving, *self.standing) if not body.empty])
            self._shrunk = BoxTree(drawn_in(moving.vertices, moving.triangles, HAIR * most)[moving.triangles])
            self._boxes = np.array([np.zeros((2, 3)) if body.empty else body.bounds for body in self.standing])

    def stop(self, by: ArrayLike, way: ArrayLike) -> Stop | None:
        """What holds the body back on a way (3,) in mm from where it was first, shifted by (3,); None for nothing."""
        start, whole = np.array(by, float).reshape(3), np.array(way, float).reshape(3)
        length = float(np.linalg.norm(whole))
        if self.moving.empty or not self.standing or not length > 0.0:
            return None
        along = whole / length
        low, high = self.moving.bounds + start
        swept = np.minimum(low, low + whole), np.maximum(high, high + whole)
        near = (self._boxes[:, 0] <= swept[1]).all(axis=1) & (self._boxes[:, 1] >= swept[0]).all(axis=1)
        best: Stop | None = None
        for k in np.flatnonzero(near).tolist():
            if self._lets_through(k):
                continue
            found = self._meeting(k, start, along, length if best is None else best.way)
            if found is not None:
                best = found
        return best

    def _lets_through(self, k: int) -> bool:
        """Whether the body overlapped this one at first."""
        if k not in self._known:
            self._known.add(k)
            found = relation(self.moving, self.standing[k], 0.0)
            if found is not None and found.overlap:
                self._free.add(k)
        return k in self._free

    def _meeting(self, k: int, start: Floats, along: Floats, limit: float) -> Stop | None:
        standing = self.standing[k].tree
        if native.available():
            way, point, normal, (face, _) = native.sweep(
                self._shrunk._compiled, self.moving.tree.triangles, standing._compiled, start, along, limit
            )
            return None if face < 0 else Stop(way, k, point, normal)
        found = _met(
            self._shrunk.triangles + start, self.moving.tree.triangles + start, standing.triangles, along, limit
        )
        return None if found is None else Stop(found[0], k, *found[1:])


def drawn_in(vertices: Floats, triangles: NDArray[np.integer], by: float) -> Floats:
    """(n, 3) the vertices drawn in by about `by` mm, along the sums of their faces' normals weighted with the angles
    there (Baerentzen and Aanaes 2005, "Signed distance computation using the angle weighted pseudonormal")."""
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    sums = np.zeros_like(vertices)
    for k in range(3):
        one, other = (corners[:, (k + step) % 3] - corners[:, k] for step in (1, 2))
        angle = np.arctan2(np.linalg.norm(np.cross(one, other), axis=1), np.einsum("ij,ij->i", one, other))
        np.add.at(sums, triangles[:, k], angle[:, None] * normals)
    return vertices - by * sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-300)


def _met(
    shrunk: Floats, exact: Floats, standing: Floats, way: Floats, limit: float
) -> tuple[float, Floats, Floats] | None:
    """The least way of triangles (n, 3, 3) along a unit vector to those that stand (m, 3, 3), with point and normal."""
    low, high = shrunk.min(axis=(0, 1)), shrunk.max(axis=(0, 1))
    far = way * limit
    kept = (standing.min(axis=1) <= np.maximum(high, high + far)).all(axis=1)
    kept &= (standing.max(axis=1) >= np.minimum(low, low + far)).all(axis=1)
    there = standing[kept]
    best: tuple[float, Floats, Floats] | None = None
    step = max(BATCH // max(len(there), 1), 1)
    for first in range(0, len(shrunk) if len(there) else 0, step):
        i, j = (axis.reshape(-1) for axis in np.indices((len(shrunk[first : first + step]), len(there))))
        small, whole, other = shrunk[first + i], exact[first + i], there[j]
        for ways, points, normals in _contacts(small, whole, other, way):
            some = np.flatnonzero(ways < (limit if best is None else best[0]))
            if len(some):
                k = some[np.argmin(ways[some])]
                turned = normals[k] if normals[k] @ way < 0.0 else -normals[k]
                best = float(ways[k]), points[k], turned / np.linalg.norm(turned)
    return best


def _contacts(small: Floats, whole: Floats, other: Floats, way: Floats) -> Iterator[tuple[Floats, Floats, Floats]]:
    """For pairs of triangles (k, 3, 3): ways (k,), infinite for none, points (k, 3) and normals (k, 3), for corners on
    faces and sides on sides."""
    face = np.cross(other[:, 1] - other[:, 0], other[:, 2] - other[:, 0])
    own = np.cross(whole[:, 1] - whole[:, 0], whole[:, 2] - whole[:, 0])
    ways = np.broadcast_to(way, face.shape)
    for k in range(3):
        yield _come_together(_through(small[:, k], ways, other), whole[:, k], other[:, 0], face, ways, None)
        yield _come_together(_through(other[:, k], -ways, small), whole[:, 0], other[:, k], own, ways, other[:, k])
        u, whole_u = small[:, (k + 1) % 3] - small[:, k], whole[:, (k + 1) % 3] - whole[:, k]
        for m in range(3):
            v = other[:, (m + 1) % 3] - other[:, m]
            hit, where = _beside(small[:, k], u, ways, other[:, m], v)
            yield _come_together(hit, whole[:, k], other[:, m], np.cross(whole_u, v), ways, where)


def _come_together(
    hit: NDArray[np.bool_], start: Floats, end: Floats, normal: Floats, ways: Floats, where: Floats | None
) -> tuple[Floats, Floats, Floats]:
    speed = np.einsum("ij,ij->i", ways, normal)
    hit = hit & (speed != 0.0)
    speed = np.where(hit, speed, 1.0)
    time = np.where(hit, np.maximum(np.einsum("ij,ij->i", end - start, normal) / speed, 0.0), np.inf)
    points = start + np.where(hit, time, 0.0)[:, None] * ways if where is None else where
    return time, points, normal


def _through(points: Floats, ways: Floats, triangles: Floats) -> NDArray[np.bool_]:
    """(k,) which points that go along ways come through triangles (Moeller and Trumbore 1997)."""
    u, v = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across, normal, offset = np.cross(ways, v), np.cross(u, v), points - triangles[:, 0]
    turned, determinant = np.cross(offset, u), np.einsum("ij,ij->i", u, across)
    lies = determinant**2 > 1e-24 * np.einsum("ij,ij->i", normal, normal)
    safe = np.where(lies, determinant, 1.0)
    a, b, time = (np.einsum("ij,ij->i", *pair) / safe for pair in ((offset, across), (ways, turned), (v, turned)))
    return lies & (a >= 0.0) & (b >= 0.0) & (a + b <= 1.0) & (time >= 0.0)


def _beside(a: Floats, u: Floats, ways: Floats, b: Floats, v: Floats) -> tuple[NDArray[np.bool_], Floats]:
    """(k,) which sides from a that go along ways come upon sides from b, and (k, 3) where."""
    normal, gap = np.cross(u, v), b - a
    square, speed = np.einsum("ij,ij->i", normal, normal), np.einsum("ij,ij->i", ways, normal)
    lies = (square > 1e-24 * np.einsum("ij,ij->i", u, u) * np.einsum("ij,ij->i", v, v)) & (speed**2 > 1e-24 * square)
    time = np.einsum("ij,ij->i", gap, normal) / np.where(lies, speed, 1.0)
    left, safe = gap - time[:, None] * ways, np.where(lies, square, 1.0)
    s, r = (np.einsum("ij,ij->i", np.cross(left, side), normal) / safe for side in (v, u))
    hit = lies & (time >= 0.0) & (s >= 0.0) & (s <= 1.0) & (r >= 0.0) & (r <= 1.0)
    return hit, b + np.where(hit, r, 0.0)[:, None] * v
