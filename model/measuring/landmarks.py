"""What a pointer on a face can mean: the face, its corners, its edges and their middles, its centre."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from .features import Features, Floats, Indices, bits_of, features
from .measure import component_labels

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

LEVEL = np.cos(np.radians(0.1))
"""Facets that meet at less than this are one plane."""
NARROW = 0.5
"""A facet is a piece of a curved face where the facets that go on smoothly have this share of its area or more; the
flat side of a rounded block has narrow neighbours."""


@dataclass(frozen=True, slots=True, eq=False)
class Face:
    """A flat face in one piece, in millimetres. `rim` (e, 2, 3) are its boundary edges, with the face on their left."""

    triangles: Indices  # (k,)
    centre: Floats  # (3,) of its area, holes taken into account
    normal: Floats  # (3,) unit, outward
    area: float
    rim: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Landmarks:
    """What there is to measure from and to snap to around a face.

    vertices  (v, 3)     corners
    edges     (m, 2, 3)  straight edges
    midpoints (m, 3)     their middles
    centres   (c, 3)     of its circular edges, and arcs
    centre, normal (3,)  of the face; None where it is a piece of a curved one
    """

    vertices: Floats
    edges: Floats
    midpoints: Floats
    centres: Floats
    centre: Floats | None
    normal: Floats | None


def face_at(mesh: DisplayMesh, triangle: int) -> Face:
    """The flat face that holds a triangle; of a curved surface, the facet alone."""
    return _surroundings(mesh).face(triangle)


def landmarks(mesh: DisplayMesh, triangle: int) -> Landmarks:
    """The landmarks of the face that holds a triangle; on a curved surface those of all its borders."""
    return _surroundings(mesh).landmarks(triangle)


def curved(mesh: DisplayMesh, triangle: int) -> bool:
    """Whether the triangle is a piece of a curved face that is cut as facets."""
    return _surroundings(mesh).curved(triangle)


def patch_at(mesh: DisplayMesh, triangle: int) -> Indices:
    """The triangles of the whole face, flat or curved, that a triangle belongs to: as far as the feature edges."""
    return _surroundings(mesh).patch(triangle)


class _Surroundings:
    """Faces and landmarks of one mesh, remembered. Knows the mesh's arrays but not the mesh, which forgets it."""

    def __init__(self, mesh: DisplayMesh) -> None:
        self._points = mesh.points
        self._triangles = mesh.triangles
        self._facet = mesh.facet
        self._features: Features = features(mesh)
        self._faces: dict[int, list[Face]] = {}
        self._curved: dict[int, bool] = {}
        self._landmarks: dict[int, Landmarks] = {}
        self._patches: Indices | None = None

    @cached_property
    def _bits(self) -> NDArray[np.uint64]:
        return bits_of(self._points)

    def face(self, triangle: int) -> Face:
        facet = int(self._facet[triangle])
        faces = self._faces.get(facet)
        if faces is None:
            faces = self._faces[facet] = self._pieces(facet)
        if len(faces) == 1:
            return faces[0]
        return next(face for face in faces if face.triangles[min(np.searchsorted(face.triangles, triangle),
                                                                 len(face.triangles) - 1)] == triangle)  # fmt: skip

    def landmarks(self, triangle: int) -> Landmarks:
        face = self.face(triangle)
        key = int(face.triangles[0])
        known = self._landmarks.get(key)
        if known is None:
            known = self._landmarks[key] = self._landmarks_of(face)
        return known

    def curved(self, triangle: int) -> bool:
        face = self.face(triangle)
        key = int(face.triangles[0])
        known = self._curved.get(key)
        if known is None:
            known = self._curved[key] = self._goes_on(face)
        return known

    def patch(self, triangle: int) -> Indices:
        patch = self._joined()
        return np.flatnonzero(patch == patch[triangle])

    def _landmarks_of(self, face: Face) -> Landmarks:
        lines = self._features
        bent = self.curved(int(face.triangles[0]))
        if bent:
            mine = self.patch(int(face.triangles[0]))
            sides = self._triangles[mine][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
            edges = np.unique(self._features.among(self._points[sides]))
        else:
            edges = self._features.among(face.rim.astype(np.float32))
        edges = edges[edges >= 0]
        chains = np.zeros(int(lines.chain.max()) + 1 if len(lines.chain) else 0, bool)
        chains[lines.chain[edges]] = True
        nodes = np.unique(lines.edges[chains[lines.chain]])
        corners = nodes[np.isin(nodes, lines.corners)]
        straight = lines.points[lines.straight[chains[lines.straight_chains]]]
        return Landmarks(
            vertices=lines.points[corners],
            edges=straight,
            midpoints=straight.mean(axis=1),
            centres=_different(lines.circles.centres[chains[lines.circles.chains]]),
            centre=None if bent else face.centre,
            normal=None if bent else face.normal,
        )

    def _pieces(self, facet: int) -> list[Face]:
        """The faces of a facet: a cut may have parted it."""
        mine = np.flatnonzero(self._facet == facet)
        used, corners = np.unique(self._triangles[mine], return_inverse=True)
        corners = corners.reshape(-1, 3)
        label = component_labels(len(used), corners)[corners[:, 0]]
        return [self._face(mine[label == number]) for number in np.unique(label)]

    def _face(self, triangles: Indices) -> Face:
        corners = self._triangles[triangles].astype(np.int64)
        points = self._points[corners].astype(np.float64)
        middle = points.mean(axis=(0, 1))
        points -= middle
        areas = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]) / 2
        total = areas.sum(axis=0)
        area = float(np.linalg.norm(total))
        normal = total / area if area > 0 else np.zeros(3)
        weight = areas @ normal
        centre = weight @ points.mean(axis=1) / area if area > 0 else np.zeros(3)
        ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
        key = np.sort(ends, axis=1) @ np.array([len(self._points), 1])
        _, first, count = np.unique(key, return_index=True, return_counts=True)
        rim = self._points[ends[np.sort(first[count == 1])]].astype(np.float64)
        return Face(triangles, middle + centre, normal, area, rim)

    def _goes_on(self, face: Face) -> bool:
        """Whether a face is a piece of a curved one: it goes on, out of its plane, beyond edges of its rim."""
        rim = face.rim.astype(np.float32)
        rim = rim[self._features.among(rim) < 0]
        if not len(rim):
            return False
        # Triangles with an edge of the rim: both of its ends among their corners.
        wanted = np.sort(bits_of(rim.reshape(-1, 3)).reshape(-1, 2), axis=1)
        ends = np.unique(wanted)
        place = np.minimum(np.searchsorted(ends, self._bits), len(ends) - 1)
        touching = ends[place] == self._bits
        near = np.flatnonzero(touching[self._triangles].sum(axis=1) >= 2)
        near = near[~np.isin(near, face.triangles)]
        sides = np.sort(self._bits[self._triangles[near][:, [[0, 1], [1, 2], [2, 0]]]], axis=2)
        mixed = np.uint64(0x9E3779B97F4A7C15)
        shared = np.isin(sides[..., 0] * mixed ^ sides[..., 1], wanted[:, 0] * mixed ^ wanted[:, 1]).any(axis=1)
        facets, first = np.unique(self._facet[near[shared]], return_index=True)
        beyond = near[shared][first].tolist()
        smooth = [facet for facet, triangle in zip(facets, beyond, strict=True) if not self._level(face, triangle)]
        return bool(smooth) and self._area(np.isin(self._facet, smooth)) >= NARROW * face.area

    def _level(self, face: Face, triangle: int) -> bool:
        a, b, c = self._points[self._triangles[triangle]].astype(np.float64)
        normal = np.cross(b - a, c - a)
        return bool(normal @ face.normal >= LEVEL * np.linalg.norm(normal))

    def _area(self, mine: NDArray[np.bool_]) -> float:
        a, b, c = (self._points[self._triangles[mine, i]].astype(np.float64) for i in range(3))
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2

    def _joined(self) -> Indices:
        """For each triangle (t,) the number of the face, flat or curved, that it belongs to: as far as features."""
        if self._patches is None:
            _, place = np.unique(self._bits, return_inverse=True)
            corners = place.reshape(-1)[self._triangles].astype(np.int64)
            ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
            ends.sort(axis=1)
            key = ends[:, 0] * (len(self._points) + 1) + ends[:, 1]
            order = np.argsort(key, kind="stable")
            ordered = key[order]
            pair = np.flatnonzero(ordered[:-1] == ordered[1:])
            half = order[pair]
            sides = np.stack([half % 3, (half + 1) % 3], axis=1)
            points = self._points[self._triangles[(half // 3)[:, None], sides]]
            within = self._features.among(points) < 0
            one, other = half[within] // 3, order[pair + 1][within] // 3
            self._patches = component_labels(len(self._triangles), np.stack([one, other], axis=1))
        return self._patches


def _surroundings(mesh: DisplayMesh) -> _Surroundings:
    kept = _kept.get(mesh)
    if kept is None:
        kept = _kept[mesh] = _Surroundings(mesh)
    return kept


def _different(points: Floats) -> Floats:
    """Points (n, 3) without those that are there already, but for rounding."""
    if len(points) < 2:
        return points
    step = 1e-5 * max(float(np.abs(points).max()), 1e-9)
    return points[np.sort(np.unique(np.round(points / step), axis=0, return_index=True)[1])]


_kept: WeakKeyDictionary[DisplayMesh, _Surroundings] = WeakKeyDictionary()
