"""Parts of a drag: a surface with what is asked of it again and again, and itself a little shrunk."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .bodies import Body
from .boxes import BoxTree, Floats, Numbers

SHRINK = 1e-6
"""The share of a part's coordinates by which it is shrunk."""


class Part(Body):
    """Of vertices (n, 3) in mm and triangles (m, 3), welded; `key` names it. A surface that bounds nothing has
    no inside.

    `shrunk` has each vertex a little further inside: it overlaps nothing that the part merely touches or slides along,
    so that rounding decides nothing.
    """

    def __init__(
        self, key: str, name: str, vertices: Floats, triangles: NDArray[np.integer], has_inside: bool = True
    ) -> None:
        super().__init__(name, np.ascontiguousarray(vertices, np.float64), triangles)
        self.key, self.has_inside = key, has_inside

    @cached_property
    def scale(self) -> float:
        """The largest coordinate, in mm: what rounding goes by."""
        return max(float(np.abs(self.bounds).max()), 1e-9)

    @cached_property
    def normals(self) -> Floats:
        """(m, 3) of unit length, 0 of faces without an area."""
        corners = self.vertices[self.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        return normals / np.where(length > 0.0, length, 1.0)

    @cached_property
    def edges(self) -> tuple[Numbers, Numbers]:
        """The ends (k, 2) of the edges between two faces that do not lie in one plane, and those faces (k, 2)."""
        begin, end = self.triangles.reshape(-1).astype(np.int64), self.triangles[:, [1, 2, 0]].reshape(-1)
        key = np.minimum(begin, end) * len(self.vertices) + np.maximum(begin, end)
        order = np.argsort(key, kind="stable")
        first = np.flatnonzero(key[order][:-1] == key[order][1:])
        sides = np.stack((order[first], order[first + 1]), axis=1) // 3
        bent = np.einsum("ij,ij->i", *(self.normals[sides[:, k]] for k in range(2))) < 1.0 - 1e-14
        ends = np.stack(np.divmod(key[order[first]], len(self.vertices)), axis=1)
        return ends[bent], sides[bent]

    @cached_property
    def shrunk_vertices(self) -> Floats:
        """(n, 3) each moved inwards along the mean of its faces' normals, weighted by their angles."""
        corners = self.vertices[self.triangles]
        sides = corners[:, [1, 2, 0]] - corners
        length = np.linalg.norm(sides, axis=2)
        before = [2, 0, 1]
        cosine = -np.einsum("tij,tij->ti", sides, sides[:, before]) / np.maximum(length * length[:, before], 1e-300)
        angles = np.arccos(np.clip(cosine, -1.0, 1.0))
        weighted = (angles[:, :, None] * self.normals[:, None]).reshape(-1, 3)
        at = self.triangles.reshape(-1)
        total = np.column_stack([np.bincount(at, weighted[:, k], len(self.vertices)) for k in range(3)])
        size = np.linalg.norm(total, axis=1, keepdims=True)
        return self.vertices - SHRINK * self.scale * total / np.where(size > 0.0, size, 1.0)

    @cached_property
    def shrunk(self) -> BoxTree:
        return BoxTree(self.shrunk_vertices[self.triangles])

    @cached_property
    def radius(self) -> float:
        """Half the diagonal of its box, in mm."""
        return float(np.linalg.norm(np.ptp(self.bounds, axis=0))) / 2.0

    def prepare(self) -> None:
        """Make now what a drag asks for."""
        if not self.empty:
            self.tree.gap(self.tree, 0.0)
            _ = self.edges, self.shrunk, self.landmarks
