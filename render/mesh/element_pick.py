"""Which vertex, edge or face of a mesh lies under the pointer."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...model.mesh.winged import END, START
from ..camera import project

if TYPE_CHECKING:
    from ...model.mesh.inspected import InspectedMesh
    from ...model.mesh.selecting import Kind
    from ..pick import Pick
    from ..viewer import Viewer

REACH = 12.0
"""Logical pixels from the pointer to a vertex or an edge that it means."""
RIM = 7.0
"""So far beside a solid its silhouette is still meant."""
AROUND = RIM * np.array([(x, y) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0) if x or y])


def pick_near(viewer: Viewer, x: float, y: float) -> Pick | None:
    """The triangle under pixel (x, y), or one that the pointer has just missed; None for what is cut open."""
    pick = viewer.pick(x, y)
    for dx, dy in AROUND if pick is None else ():
        pick = viewer.pick(x + dx, y + dy)
        if pick is not None:
            break
    return None if pick is None or pick.triangle < 0 else pick


def element_at(
    viewer: Viewer, mesh: InspectedMesh, triangle: int, kind: Kind, x: float, y: float, reach: float = REACH
) -> int:
    """The face of a triangle, or the edge or corner of that face nearest to pixel (x, y); -1 for none within reach."""
    face = int(mesh.triangle_face[triangle])
    if kind == "face":
        return face
    edges = mesh.edges_of_face(face)
    if not len(edges):
        return -1
    ends = mesh.winged.table[edges][:, [START, END]]
    vertices, places = np.unique(ends, return_inverse=True)
    pixels = project(viewer.camera, mesh.lists.vertices[vertices], viewer.size)[:, :2]
    pointer = np.array([x, y])
    if kind == "vertex":
        away = np.linalg.norm(pixels - pointer, axis=1)
        found = vertices
    else:
        start, end = pixels[places.reshape(-1, 2)[:, 0]], pixels[places.reshape(-1, 2)[:, 1]]
        along = end - start
        length = np.maximum(np.einsum("ij,ij->i", along, along), 1e-12)
        share = np.clip(np.einsum("ij,ij->i", pointer - start, along) / length, 0.0, 1.0)
        away = np.linalg.norm(start + share[:, None] * along - pointer, axis=1)
        found = edges
    away = np.where(np.isfinite(away), away, np.inf)
    nearest = int(np.argmin(away))
    return int(found[nearest]) if away[nearest] <= reach else -1
