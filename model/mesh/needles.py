"""Where the normals of a shown solid begin and where they point: of its flat faces, and of its vertices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]

MOST = 20_000
"""Normals of one kind that are drawn; of more, one in so many."""
ALIKE = 200.0
"""Normals of one vertex that differ by less than the reciprocal of this are one."""
SHORTEST, LONGEST = 0.012, 0.06
"""Length of a needle, as a share of the diagonal of what they are of; between these as long as faces are wide."""


@dataclass(frozen=True, slots=True, eq=False)
class Needles:
    """Feet (n, 3) mm and unit normals (n, 3); `total` is how many there would be without the limit."""

    feet: Floats
    normals: Floats
    total: int

    def lines(self, length: float) -> Floats:
        """(n, 2, 3) from the feet on."""
        return np.stack((self.feet, self.feet + length * self.normals), axis=1)


def face_needles(mesh: DisplayMesh, chosen: NDArray[np.bool_] | None = None, most: int = MOST) -> Needles:
    """One for each flat face with a triangle among the `chosen` (t,): the mean normal of these by their areas, at their
    centroid or, where that lies beside the face, in the middle of the nearest of them."""
    rows = np.arange(len(mesh.corners)) if chosen is None else np.flatnonzero(chosen)
    facets, facet = np.unique(mesh.facet[rows], return_inverse=True)
    if len(facets) > most:
        kept = np.zeros(len(facets), dtype=bool)
        kept[:: -(-len(facets) // most)] = True
        rows, facet = rows[kept[facet]], np.cumsum(kept)[facet[kept[facet]]] - 1
    count = int(facet.max(initial=-1)) + 1
    corners = mesh.vertices[mesh.corners[rows]]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    double = np.cross(first, second)
    area = np.linalg.norm(double, axis=1)
    whole = np.bincount(facet, area, count)
    total = np.column_stack([np.bincount(facet, double[:, i], count) for i in range(3)]).reshape(-1, 3)
    size = np.linalg.norm(total, axis=1)
    drawn = (whole > 0.0) & (size > 0.0)
    middles = corners.mean(axis=1)
    sums = np.column_stack([np.bincount(facet, area * middles[:, i], count) for i in range(3)]).reshape(-1, 3)
    feet = sums / np.where(drawn, whole, 1.0)[:, None]
    # Barycentric coordinates of each face's centroid in each of its triangles.
    arm = feet[facet] - corners[:, 0]
    squared = np.maximum(area * area, 1e-300)
    u = np.einsum("ij,ij->i", np.cross(arm, second), double) / squared
    v = np.einsum("ij,ij->i", np.cross(first, arm), double) / squared
    within = np.zeros(count, dtype=bool)
    within[facet[(u > -1e-9) & (v > -1e-9) & (u + v < 1.0 + 1e-9)]] = True
    far = np.linalg.norm(middles - feet[facet], axis=1)
    order = np.lexsort((far, facet))
    nearest = order[np.flatnonzero(np.diff(facet[order], prepend=-1))]
    feet = np.where(within[:, None], feet, middles[nearest])
    return Needles(feet[drawn], total[drawn] / size[drawn, None], len(facets))


def vertex_needles(mesh: DisplayMesh, chosen: NDArray[np.bool_] | None = None, most: int = MOST) -> Needles:
    """The normals that the vertices of the `chosen` triangles (t,) are shaded by: one where all faces around a vertex
    share theirs, several where creases part them."""
    points, normals = mesh.points, mesh.normals
    if chosen is not None:
        used = np.zeros(len(points), dtype=bool)
        used[mesh.triangles[chosen]] = True
        points, normals = points[used], normals[used]
    if not len(points):
        return Needles(np.zeros((0, 3)), np.zeros((0, 3)), 0)
    rounded = np.rint(normals * ALIKE)
    rows = np.concatenate((points, rounded + np.float32(0.0)), axis=1)
    new = np.flatnonzero(np.append(True, (rows[1:] != rows[:-1]).any(axis=1)))  # those of one vertex stand together
    step = -(-len(new) // most)
    kept = new[::step]
    _, first = np.unique(rows[kept], axis=0, return_index=True)
    kept = kept[np.sort(first)]
    total = len(kept) if step == 1 else len(new)
    return Needles(points[kept].astype(np.float64), normals[kept].astype(np.float64), total)


def needle_length(mesh: DisplayMesh, diagonal: float) -> float:
    """How long needles on a mesh should be, in mm, among meshes in a box of this diagonal: shorter where faces are
    small."""
    sides = np.linalg.norm(mesh.vertices[mesh.corners[:, 1]] - mesh.vertices[mesh.corners[:, 0]], axis=1)
    wide = float(np.median(sides)) if len(sides) else 0.0
    return float(np.clip(0.7 * wide, SHORTEST * diagonal, LONGEST * diagonal))
