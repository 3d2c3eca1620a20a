"""What a tree is built from: flat convex faces, the planes they lie in, and which of them one convex body shares."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .convex import convex_groups, diagonal

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]

FLAT = 1e-7
"""A facet whose vertices leave its plane by more than this, as a part of the scene's size, has a plane a triangle."""


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """Flat convex faces with at least three corners each; counter-clockwise from where their normals point to.

    The faces of one group bound one convex body, which they all see from outside (`side` +1: any two of them are
    behind each other's planes, or in them) or from inside (−1, what a subtracted body leaves: in front of each other's
    planes). Between faces of one group no order has to be found by cutting; see `order`.
    """

    points: Floats  # (n, 3)
    corners: Indices  # (c,) into points, face after face
    starts: Indices  # (m + 1,) into corners
    planes: Floats  # (p, 4) unit normal and offset: normal · x = offset
    plane_of: Indices  # (m,)
    group: Indices  # (m,) -1: none
    side: NDArray[np.int8]  # (m,) +1 outside, -1 inside; 0 without a group

    @property
    def count(self) -> int:
        return len(self.starts) - 1

    @property
    def size(self) -> float:
        """The diagonal of the box around all points."""
        return diagonal(self.points)


def faces_of_polygons(polygons: Sequence[ArrayLike]) -> Faces:
    """Polygons (k, 3) that each lie in a plane of their own, without groups.

    Polygons without an area are left out of nothing: they keep their number, with any plane through them, and are
    never cut by it. Raises ValueError for one with fewer than three corners or that is not convex.
    """
    rings = [np.asarray(polygon, float).reshape(-1, 3) for polygon in polygons]
    for number, ring in enumerate(rings):
        if len(ring) < 3:
            raise ValueError(f"polygon {number} has {len(ring)} corners; a face has at least three")
        if not _is_convex(ring):
            raise ValueError(f"polygon {number} is not convex; cut it into convex ones")
    sizes = np.array([len(ring) for ring in rings], np.int64)
    points = np.concatenate(rings) if rings else np.zeros((0, 3))
    planes = np.array([plane_of_ring(ring) for ring in rings]).reshape(-1, 4)
    count = len(rings)
    return Faces(
        points=points,
        corners=np.arange(len(points), dtype=np.int32),
        starts=np.concatenate(([0], np.cumsum(sizes))).astype(np.int32),
        planes=planes,
        plane_of=np.arange(count, dtype=np.int32),
        group=np.full(count, -1, np.int32),
        side=np.zeros(count, np.int8),
    )


def plane_of_ring(ring: Floats) -> Floats:
    """(4,) the plane of a polygon (k, 3) by Newell's sums (Sutherland, Sproull and Schumacker 1974)."""
    middle = ring.mean(axis=0)
    arms = ring - middle
    normal = np.cross(arms, np.roll(arms, -1, axis=0)).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length <= 1e-24 * max(float((arms * arms).sum()), 1e-300):
        along = arms[int(np.argmax((arms * arms).sum(axis=1)))]
        normal = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
        length = float(np.linalg.norm(normal))
        if length == 0.0:
            normal, length = np.array([0.0, 0.0, 1.0]), 1.0
    normal = normal / length
    return np.append(normal, normal @ middle)


def faces_of_meshes(meshes: Sequence[DisplayMesh]) -> Faces:
    """The triangles of meshes, one mesh after the other: face i is the i-th triangle of all of them.

    Planes are those of the facets, groups the faces that one convex leaf left in one solid.
    """
    parts = [_mesh_faces(mesh) for mesh in meshes if len(mesh.triangles)]
    return joined(parts) if parts else faces_of_polygons(())


def joined(parts: Sequence[Faces]) -> Faces:
    """The faces of all parts as one, in their order."""
    if len(parts) == 1:
        return parts[0]
    points = corners = planes = groups = 0
    shifted_corners, shifted_starts, shifted_planes, shifted_groups = [], [np.zeros(1, np.int32)], [], []
    for part in parts:
        shifted_corners.append(part.corners + np.int32(points))
        shifted_starts.append(part.starts[1:] + np.int32(corners))
        shifted_planes.append(part.plane_of + np.int32(planes))
        shifted_groups.append(np.where(part.group < 0, np.int32(-1), part.group + np.int32(groups)))
        points += len(part.points)
        corners += len(part.corners)
        planes += len(part.planes)
        groups += int(part.group.max(initial=-1)) + 1
    return Faces(
        points=np.concatenate([part.points for part in parts]),
        corners=np.concatenate(shifted_corners),
        starts=np.concatenate(shifted_starts),
        planes=np.concatenate([part.planes for part in parts]),
        plane_of=np.concatenate(shifted_planes),
        group=np.concatenate(shifted_groups),
        side=np.concatenate([part.side for part in parts]),
    )


def _mesh_faces(mesh: DisplayMesh) -> Faces:
    triangles = len(mesh.corners)
    planes, plane_of = facet_planes(mesh.vertices, mesh.corners, mesh.facet)
    wanted = np.where(mesh.owner >= 0, 2 * mesh.owner + mesh.subtracted, -1)
    known = np.repeat(np.asarray(mesh.convex, bool), 2)
    group, side = convex_groups(mesh.vertices, mesh.corners, planes, plane_of, wanted, known)
    return Faces(
        points=mesh.vertices,
        corners=np.ascontiguousarray(mesh.corners, np.int32).reshape(-1),
        starts=np.arange(0, 3 * triangles + 1, 3, dtype=np.int32),
        planes=planes,
        plane_of=plane_of,
        group=group,
        side=side,
    )


def facet_planes(vertices: Floats, corners: Indices, facet: Indices) -> tuple[Floats, Indices]:
    """The planes (p, 4) of facets, and the plane (t,) of each triangle `corners` (t, 3) of a facet `facet` (t,).

    Normal and offset are means over the facet, weighted by area: a sliver's own normal is worth nothing. A facet that
    is not flat has a plane for each triangle instead.
    """
    a, b, c = (np.ascontiguousarray(vertices.take(corners[:, i], axis=0).T) for i in range(3))  # (3, t)
    (x, y, z), (u, v, w) = b - a, c - a
    areas = np.array([y * w - z * v, z * u - x * w, x * v - y * u])
    middles = (a + b + c) / 3.0
    count = int(facet.max(initial=-1)) + 1
    planes = _fitted(areas, middles, facet, count)
    size = diagonal(vertices)
    own = np.ascontiguousarray(planes.T).take(facet, axis=1)
    bent = np.zeros(count, bool)
    for corner in (a, b, c):
        bent[facet[np.abs(heights_of(corner, own)) > FLAT * size]] = True
    loose = np.flatnonzero(bent[facet])
    if not len(loose):
        return planes, facet.astype(np.int32)
    plane_of = facet.astype(np.int64)
    plane_of[loose] = count + np.arange(len(loose))
    singles = _fitted(areas[:, loose], middles[:, loose], np.arange(len(loose)), len(loose))
    return np.concatenate([planes, singles]), plane_of.astype(np.int32)


def _fitted(areas: Floats, middles: Floats, plane_of: NDArray[np.integer], count: int) -> Floats:
    """(count, 4) planes from the area vectors (3, t) and the middles (3, t) of their triangles."""
    sums = np.array([np.bincount(plane_of, column, count) for column in areas], float)
    length = np.sqrt(_dots(sums, sums))
    normals = np.where(length > 0.0, sums / np.where(length > 0.0, length, 1.0), [[0.0], [0.0], [1.0]])
    weights = np.sqrt(_dots(areas, areas)) + 1e-300
    offsets = np.bincount(plane_of, weights * _dots(normals.take(plane_of, axis=1), middles), count)
    total = np.bincount(plane_of, weights, count)
    return np.column_stack((*normals, offsets / np.where(total > 0.0, total, 1.0)))


def _dots(one: Floats, other: Floats) -> Floats:
    """(n,) the inner products of vectors (3, n)."""
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


def heights_of(points: Floats, planes: Floats) -> Floats:
    """(n,) how far each of points (3, n) lies before its plane of planes (4, n)."""
    height = points[0] * planes[0]
    height += points[1] * planes[1]
    height += points[2] * planes[2]
    height -= planes[3]
    return height


def _is_convex(ring: Floats) -> bool:
    """Whether a polygon (k, 3) turns one way only, seen along its normal."""
    sides = np.roll(ring, -1, axis=0) - ring
    turns = np.cross(sides, np.roll(sides, -1, axis=0)) @ plane_of_ring(ring)[:3]
    return bool((turns >= -1e-9 * max(float((sides * sides).sum()), 1e-300)).all())
