"""Which triangles meet at which edges of a DisplayMesh, and its silhouettes."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from ..model.solid.display import DisplayMesh

Indices = NDArray[np.int32]
Floats = NDArray[np.float32]


class Adjacency:
    """The edges of a mesh with the triangles on their two sides.

    A DisplayMesh splits its points at creases; here points in the same place are one again.

    edges  (n, 2) int32  indices into the mesh's points
    sides  (n, 2) int32  triangles on both sides, -1 for none; where more than two meet, two of them
    """

    def __init__(self, mesh: "DisplayMesh") -> None:
        self._mesh = mesh
        self._weld = _places(mesh.points)
        corners = self._weld[mesh.triangles].astype(np.int64)
        ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
        ends.sort(axis=1)
        keys = ends[:, 0] * (len(mesh.points) + 1) + ends[:, 1]
        order = np.argsort(keys, kind="stable")
        keys = keys[order]
        first = np.flatnonzero(np.r_[len(keys) > 0, keys[1:] != keys[:-1]][: len(keys)])
        count = np.diff(np.r_[first, len(keys)])
        triangle = order // 3
        second = np.where(count > 1, triangle[np.minimum(first + 1, max(len(keys) - 1, 0))], -1)
        self.keys = keys[first]
        self.edges: Indices = ends[order[first]].astype(np.int32)
        self.sides: Indices = np.column_stack([triangle[first], second]).astype(np.int32)
        self._normals: NDArray[np.float32] | None = None

    def silhouette(self, eye: ArrayLike, parallel: bool = False) -> Indices:
        """The edges (s, 2) between a triangle that faces the eye and one that does not, and all borders.

        `eye` is a point, or with `parallel` the direction towards the eye.
        """
        mesh = self._mesh
        if self._normals is None:
            a, b, c = (mesh.points[mesh.triangles[:, corner]] for corner in range(3))
            self._normals = np.cross(b - a, c - a)
            self._heights = np.einsum("ij,ij->i", self._normals, a)
        facing = self._normals @ np.asarray(eye, np.float32) > (0.0 if parallel else self._heights)
        border = self.sides[:, 1] < 0
        return self.edges[border | (facing[self.sides[:, 0]] != facing[self.sides[:, 1]])]


def _places(points: NDArray[np.float32]) -> Indices:
    """For each of `points` (n, 3) the index of the first point in the same place."""
    if not len(points):
        return np.zeros(0, np.int32)
    x, y, z = (points + np.float32(0.0)).T  # -0.0 becomes 0.0
    order = np.lexsort((z, y, x))
    ordered = points[order]
    new = np.r_[True, (ordered[1:] != ordered[:-1]).any(axis=1)]
    groups = np.flatnonzero(new)
    first = np.minimum.reduceat(order, groups)
    result = np.empty(len(points), np.int32)
    result[order] = first[np.cumsum(new) - 1]
    return result
