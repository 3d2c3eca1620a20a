"""What a solid stands on, or would: the flat face that looks down most."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .landmarks import Floats, curved, face_at

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

LEAST = 0.02
"""The share of all area that a face has at least for a solid to stand on it."""
DOWN = np.cos(np.radians(60))
"""Faces that look down less are sides."""


def resting_face(mesh: DisplayMesh, matrix: Floats) -> tuple[Floats, Floats]:
    """The centre (3,) of the face a solid stands on and its outward normal (3,), both in the world.

    `mesh`, which has triangles, is mapped there by `matrix` (3, 4). It is the flat face of some size whose normal is
    nearest to straight down; where there is none, as under a ball, the lowest point with the normal straight down.
    """
    points = mesh.points.astype(np.float64) @ matrix[:, :3].T + matrix[:, 3]
    a, b, c = (points[mesh.triangles[:, i]] for i in range(3))
    hand = 1.0 if np.linalg.det(matrix[:, :3]) > 0 else -1.0  # a mirrored solid is not inside out
    areas = 0.5 * hand * np.cross(b - a, c - a)
    count = int(mesh.facet.max(initial=-1)) + 1
    total = np.column_stack([np.bincount(mesh.facet, areas[:, i], count) for i in range(3)])
    size = np.linalg.norm(total, axis=1)
    down = np.where(size >= LEAST * size.sum(), -total[:, 2] / np.maximum(size, 1e-300), -1.0)
    lowest = int(np.lexsort((-size, -np.round(down, 6)))[0])
    triangle = int(np.flatnonzero(mesh.facet == lowest)[0])
    if down[lowest] >= DOWN and not curved(mesh, triangle):
        return mapped_face(mesh, triangle, matrix)
    used = points[np.unique(mesh.triangles)]
    slack = 1e-6 * max(float(np.ptp(used[:, 2])), 1e-9)
    bottom = np.unique(used[used[:, 2] <= used[:, 2].min() + slack], axis=0)
    return bottom.mean(axis=0), np.array([0.0, 0.0, -1.0])


def mapped_face(mesh: DisplayMesh, triangle: int, matrix: Floats) -> tuple[Floats, Floats]:
    """Centre (3,) and outward normal (3,) of the face that holds a triangle, after a map (3, 4)."""
    face = face_at(mesh, triangle)
    normal: Floats = np.asarray(np.linalg.solve(matrix[:, :3].T, face.normal), np.float64)
    return matrix[:, :3] @ face.centre + matrix[:, 3], clean_direction(normal)


def clean_direction(vector: Floats) -> Floats:
    """The unit vector (3,) without the dust that single precision leaves: what is nearly along an axis is along it."""
    unit = np.asarray(vector, np.float64) / max(float(np.linalg.norm(vector)), 1e-300)
    unit = np.where(np.abs(unit) < 2e-6, 0.0, unit)
    return np.divide(unit, max(float(np.linalg.norm(unit)), 1e-300))


def digits_of(mesh: DisplayMesh) -> int:
    """How many decimals of a millimetre the single precision of a mesh's points is good for."""
    reach = max(float(np.abs(mesh.bounds).max()), 1e-6)
    return int(np.clip(np.floor(-np.log10(4.0 * np.finfo(np.float32).eps * reach)), 0, 9))
