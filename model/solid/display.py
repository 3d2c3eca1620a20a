"""A solid's mesh as pictures need it: split at creases, with normals, owners, facets and feature edges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .provenance import Path

if TYPE_CHECKING:
    from manifold3d import Mesh64

    from ..pipeline.round_surfaces import RoundSurfaces

SMOOTH = np.cos(np.radians(35))
"""Facets that meet at less than this share a normal."""
COARSE = np.cos(np.radians(70))
"""The same for spheres and tori, whose coarsest facets are those of an octahedron cut in four."""
FEATURE = np.cos(np.radians(25))
"""Facets of one owner that meet at more than this have an edge between them."""
SEAM = np.cos(np.radians(10))
"""Facets of two owners that meet at more than this have one; less is a tangent joint of a faceted surface."""
ROUNDING = 1e-9
"""By how much more than nothing facets have to bend to meet at an angle."""
MOST_AROUND = 300
"""A vertex with more facets than this keeps their own normals."""


@dataclass(frozen=True, slots=True, eq=False)
class Creases:
    """Cosines of angles between facets, by owner."""

    smooth: NDArray[np.float64]  # (o,) facets that meet at a larger cosine share a normal
    edge: NDArray[np.float64]  # (o,) those that meet at a smaller one have an edge between them

    def by_side(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Both (2 o + 2,) for faces of owner k, 2 k, and those subtracted from it, 2 k + 1; the last two: of nobody."""
        return np.append(np.repeat(self.smooth, 2), [SMOOTH] * 2), np.append(np.repeat(self.edge, 2), [FEATURE] * 2)


def creases_at(angles: Sequence[float | None], round_: Sequence[bool]) -> Creases:
    """The creases of owners whose facets meet smoothly at less than so many degrees (None: as their kind has it);
    `round_` are those of a kind without creases, however coarse their facets are."""
    own = np.array([angle is not None for angle in angles], dtype=bool)
    cosine = np.cos(np.radians([0.0 if angle is None else angle for angle in angles])).reshape(-1)
    of_kind = np.where(np.asarray(round_, dtype=bool), COARSE, SMOOTH)
    return Creases(np.where(own, cosine, of_kind), np.where(own, cosine - ROUNDING, FEATURE))


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class DisplayMesh:
    """Read-only arrays of one solid. The numbers in `owner` are places in `owners`."""

    points: NDArray[np.float32]  # (p, 3)
    normals: NDArray[np.float32]  # (p, 3) unit
    triangles: NDArray[np.int32]  # (t, 3) counter-clockwise from outside
    owner: NDArray[np.int32]  # (t,)
    owners: tuple[Path, ...]
    subtracted: NDArray[np.bool_]  # (t,) left by a subtracted operand
    facet: NDArray[np.int32]  # (t,) number of the flat face
    edge_points: NDArray[np.float32]  # (q, 3)
    edges: NDArray[np.int32]  # (e, 2)
    edge_sides: NDArray[np.int32]  # (e, 2) the triangles on both sides of each edge
    bounds: NDArray[np.float64]  # (2, 3)
    vertices: NDArray[np.float64]  # (v, 3) the solid's own, as exact as they are
    corners: NDArray[np.int32]  # (t, 3) the triangles by those
    convex: NDArray[np.bool_]  # (o,) owners whose whole surface, before it was cut, is known to be convex
    sheet: bool = False
    """Whether it is an outline that stands by itself, which encloses nothing (see sheet.py)."""
    creases: Creases | None = None
    """What the normals and the edges went by; None: no owner says anything."""
    round: RoundSurfaces | None = None
    """The curved surfaces that the facets stand for, as far as the leaves tell; None: nobody has asked."""


def display_mesh(
    mesh: Mesh64,
    owner_of_run: NDArray[np.int32],
    owners: tuple[Path, ...] = (),
    convex: NDArray[np.bool_] | None = None,
    creases: Creases | None = None,
    round_: RoundSurfaces | None = None,
) -> DisplayMesh:
    """The picture's side of a result of manifold3d. `owner_of_run` as from provenance.owners_of_runs; `convex` (o,)
    where it is known."""
    convex = np.zeros(len(owners), dtype=bool) if convex is None else convex
    points = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3]
    triangles = np.asarray(mesh.tri_verts).astype(np.int64)
    count = len(triangles)
    if not count:
        return _empty(owners, convex)
    starts = np.asarray(mesh.run_index, dtype=np.int64) // 3
    run = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    flags = np.asarray(mesh.run_flags, dtype=np.int64)
    subtracted = (flags[run] & 1).astype(bool) if len(flags) else np.zeros(count, dtype=bool)
    owner = owner_of_run[run]

    face = np.asarray(mesh.face_id, dtype=np.int64)
    face = face if len(face) == count else np.arange(count)
    facet = _ranked(run * (int(face.max()) + 1) + face)
    corners = points[triangles]  # (t, 3, 3)
    sides = corners[:, [1, 2, 0]] - corners
    areas = np.cross(sides[:, 0], -sides[:, 2])
    facets = int(facet.max()) + 1
    facet_normal = _unit(_sums(facet, areas, facets))

    # Render points are pairs of a vertex and a facet, sorted by vertex.
    order, ordered = _sorted((triangles * facets + facet[:, None]).reshape(-1))
    first = np.diff(ordered, prepend=-1) != 0
    pairs = ordered[first]
    corner_point = np.empty(3 * count, dtype=np.int64)
    corner_point[order] = np.cumsum(first) - 1
    vertex, pair_facet = np.divmod(pairs, facets)
    angle = np.bincount(corner_point, _angles(sides).reshape(-1), len(pairs)).astype(np.float64)
    owner_of_facet = np.empty(facets, dtype=np.int64)
    owner_of_facet[facet] = 2 * owner + subtracted
    creases = creases_at([None] * len(owners), [False] * len(owners)) if creases is None else creases
    least, sharp = creases.by_side()
    normals = _smooth(vertex, facet_normal[pair_facet], angle, owner_of_facet[pair_facet], least)

    edges, edge_sides = _feature_edges(triangles, facet, facet_normal, owner_of_facet, sharp, len(points))
    used, edge_ends = np.unique(edges, return_inverse=True)
    return DisplayMesh(
        points=points[vertex].astype(np.float32),
        normals=normals.astype(np.float32),
        triangles=corner_point.reshape(-1, 3).astype(np.int32),
        owner=owner.astype(np.int32),
        owners=owners,
        subtracted=subtracted,
        facet=facet.astype(np.int32),
        edge_points=points[used].astype(np.float32),
        edges=edge_ends.reshape(-1, 2).astype(np.int32),
        edge_sides=edge_sides.astype(np.int32),
        bounds=np.array([points.min(axis=0), points.max(axis=0)]),
        vertices=np.ascontiguousarray(points),
        corners=triangles.astype(np.int32),
        convex=convex,
        creases=creases,
        round=round_,
    )


def _empty(owners: tuple[Path, ...], convex: NDArray[np.bool_]) -> DisplayMesh:
    none = np.empty((0, 3), dtype=np.float32)
    numbers = np.empty(0, dtype=np.int32)
    return DisplayMesh(
        none, none, numbers.reshape(0, 3), numbers, owners, numbers.astype(bool), numbers, none,
        numbers.reshape(0, 2), numbers.reshape(0, 2), np.zeros((2, 3)), np.zeros((0, 3)), numbers.reshape(0, 3), convex,
    )  # fmt: skip


def _ranked(key: NDArray[np.int64]) -> NDArray[np.int64]:
    """(n,) the place of each of `key` (n,), none of them negative, among its different values."""
    top = int(key.max()) + 1
    if top > 32 * len(key):
        return np.unique(key, return_inverse=True)[1].reshape(-1)
    there = np.zeros(top, dtype=bool)
    there[key] = True
    return (np.cumsum(there) - 1)[key]


def _sorted(key: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The order (n,) that sorts `key` (n,), none of them negative, and the sorted keys.

    Key and place packed into one number are sorted several times faster than by `argsort`.
    """
    bits = max(len(key) - 1, 1).bit_length()
    if int(key.max(initial=0)) >> (62 - bits):
        order = np.argsort(key, kind="stable")
        return order, key[order]
    packed = np.sort((key << bits) | np.arange(len(key)))
    return packed & ((1 << bits) - 1), packed >> bits


def _sums(group: NDArray[np.int64], rows: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """(count, k) the sum of the rows (n, k) of each group."""
    return np.column_stack([np.bincount(group, rows[:, i], count) for i in range(rows.shape[1])]).astype(np.float64)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    size = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(size > 0, size, 1)


def _angles(sides: NDArray[np.float64]) -> NDArray[np.float64]:
    """(t, 3) the angle at each corner of triangles whose sides (t, 3, 3) leave their corners."""
    size = np.sqrt(np.einsum("tij,tij->ti", sides, sides))
    before = [2, 0, 1]
    cosine = -np.einsum("tij,tij->ti", sides, sides[:, before]) / np.maximum(size * size[:, before], 1e-300)
    return np.arccos(np.clip(cosine, -1, 1))


def _smooth(
    vertex: NDArray[np.int64],
    normal: NDArray[np.float64],
    angle: NDArray[np.float64],
    owner: NDArray[np.int64],
    least: NDArray[np.float64],
) -> NDArray[np.float64]:
    """(p, 3) normals of points sorted by vertex: the angle-weighted mean over facets that meet there at a cosine above
    the `least` of their owner."""
    first = np.flatnonzero(np.diff(vertex, prepend=-1))
    size = np.diff(first, append=len(vertex))
    group = np.repeat(np.arange(len(first)), size)
    around = np.where((size > 1) & (size <= MOST_AROUND), size, 0)[group]
    if not around.any():
        return normal
    # Every point of a vertex against every later one of it.
    place = np.arange(len(vertex)) - first[group]
    later = np.where(around > 0, around - 1 - place, 0)
    one = np.repeat(np.arange(len(vertex)), later)
    other = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(later) - later, later)
    meets = (owner[one] == owner[other]) & (np.einsum("ij,ij->i", normal[one], normal[other]) > least[owner[one]])
    one, other = one[meets], other[meets]
    weighted = normal * angle[:, None]
    total = weighted + _sums(one, weighted[other], len(vertex)) + _sums(other, weighted[one], len(vertex))
    return np.where(around[:, None] > 0, _unit(total), normal)


def _feature_edges(
    triangles: NDArray[np.int64],
    facet: NDArray[np.int64],
    facet_normal: NDArray[np.float64],
    owner: NDArray[np.int64],
    sharp: NDArray[np.float64],
    points: int,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The edges (e, 2) where two facets of an owner meet at a cosine below its `sharp`, or those of two owners out of
    plane, and the triangles (e, 2) on their two sides."""
    begin, end = triangles.reshape(-1), triangles[:, [1, 2, 0]].reshape(-1)
    order, ordered = _sorted(np.minimum(begin, end) * points + np.maximum(begin, end))
    pair = np.flatnonzero(ordered[:-1] == ordered[1:])
    sides = np.stack((order[pair], order[pair + 1]), axis=1) // 3
    a, b = facet[sides[:, 0]], facet[sides[:, 1]]
    cosine = np.einsum("ij,ij->i", facet_normal[a], facet_normal[b])
    least = np.where(owner[a] == owner[b], sharp[owner[a]], SEAM)
    edge = (a != b) & (cosine < least)
    return np.stack(np.divmod(ordered[pair[edge]], points), axis=1), sides[edge]
