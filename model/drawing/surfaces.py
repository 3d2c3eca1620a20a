"""A scene's faces as one view sees them: their planes in the picture, which of them face the eye, which hide others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..partition.faces import Faces
from ..solid.display import FEATURE
from .polygons import Ragged, ranges
from .projection import Projection
from .scene import Scene

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

EDGE_ON = 1e-7
"""Faces whose normal in the picture has less than this towards the eye are seen as a line."""


@dataclass(frozen=True, slots=True, eq=False)
class Surfaces:
    """Triangles are numbered through all meshes, planes are those of `faces`."""

    faces: Faces
    projection: Projection
    planes: Floats  # (p, 4) in the picture: unit normal and offset
    facing: NDArray[np.int8]  # (p,) 1 towards the eye, -1 away, 0 edge-on
    shown: NDArray[np.bool_]  # (t,) may be seen: faces the eye, or may be seen from behind
    owner: Numbers  # (t,) of all meshes, numbered through; those of one mesh have an unknown one after them
    layer: Numbers  # (t,)
    solid: Numbers  # (t,)
    subtracted: NDArray[np.bool_]  # (t,)
    sharp: Floats  # (t,) facets of one owner that meet at a smaller cosine have an edge between them

    def clipped(self, polygons: Ragged) -> tuple[Ragged, Numbers]:
        """Polygons of the world in the picture, what cannot be seen cut off, and which each piece is of."""
        left = Ragged(self.projection.viewed(polygons.points), polygons.starts)
        source = np.arange(polygons.count)
        for plane in self.projection.limits():
            left, kept = left.cut(left.points @ plane[:3] + plane[3])
            source = source[kept]
        return Ragged(self.projection.flattened(left.points), left.starts), source

    def hiding(self) -> tuple[Floats, Numbers]:
        """(n, 3, 3) triangles in the picture that hide what is behind them, and the plane (n,) of each."""
        which = np.flatnonzero(self.shown)
        corners = self.faces.corners.reshape(-1, 3)[which]
        polygons = Ragged(self.faces.points[corners.reshape(-1)], np.arange(0, 3 * len(which) + 1, 3))
        pieces, source = self.clipped(polygons)
        item, step = ranges(np.maximum(pieces.sizes - 2, 0))
        first = pieces.starts[:-1][item]
        fans = np.column_stack((first, first + step + 1, first + step + 2))
        return pieces.points[fans], self.faces.plane_of[which[source[item]]].astype(np.int64)


def surfaces_of(scene: Scene, projection: Projection) -> Surfaces:
    faces = scene.faces()
    planes = picture_planes(faces.planes, projection)
    facing = np.where(np.abs(planes[:, 2]) < EDGE_ON, 0, np.sign(planes[:, 2])).astype(np.int8)
    owner, layer, solid, subtracted, behind, sharp = [], [], [], [], [], []
    first = 0
    for mesh, closed, layers, solids in zip(scene.meshes, scene.closed, scene.layer_of, scene.solid_of, strict=True):
        owner.append(np.where(mesh.owner < 0, len(layers) - 1, mesh.owner) + first)
        first += len(layers)
        layer.append(layers[mesh.owner])
        solid.append(solids[mesh.owner])
        subtracted.append(mesh.subtracted)
        least = np.full(len(mesh.owners), FEATURE) if mesh.creases is None else mesh.creases.edge
        sharp.append(np.append(least, FEATURE)[mesh.owner])
        inside = not closed or (not projection.parallel and _is_inside(mesh.vertices[mesh.corners], projection.eye))
        behind.append(np.full(len(mesh.corners), inside))
    of_triangle = facing[faces.plane_of]
    owners, layers, solids = (np.concatenate([np.zeros(0, np.int64), *each]) for each in (owner, layer, solid))
    cut, from_behind = (np.concatenate([np.zeros(0, bool), *each]) for each in (subtracted, behind))
    shown = (of_triangle > 0) | (from_behind & (of_triangle < 0))
    return Surfaces(faces, projection, planes, facing, shown, owners, layers, solids, cut,
                    np.concatenate([np.zeros(0), *sharp]))  # fmt: skip


def picture_planes(planes: Floats, projection: Projection) -> Floats:
    """(p, 4) planes (p, 4) of the world in the picture: unit normal and offset, the normal still on the same side."""
    normals = planes[:, :3] @ projection.axes.T
    offsets = planes[:, 3] - planes[:, :3] @ projection.target
    if not projection.parallel:
        normals[:, 2] -= offsets / projection.focal
    length = np.linalg.norm(normals, axis=1)
    length[length == 0.0] = 1.0
    return np.column_stack((normals / length[:, None], offsets / length))


def _is_inside(triangles: Floats, eye: Floats) -> bool:
    """Whether a closed surface (t, 3, 3) is around a point: by its solid angle (Van Oosterom and Strackee 1983)."""
    arms = triangles - eye
    a, b, c = arms[:, 0], arms[:, 1], arms[:, 2]
    lengths = np.linalg.norm(arms, axis=2)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    ab, bc, ca = (np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
    below = lengths.prod(axis=1) + ab * lengths[:, 2] + bc * lengths[:, 0] + ca * lengths[:, 1]
    return float(np.arctan2(volume, below).sum()) > np.pi
