"""Parts of a drag: surfaces with what is asked of them again and again, and the same a little shrunk."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .bodies import Body
from .boxes import BoxTree, Floats
from .straight import drawn_in

SHRINK = 1e-6
"""The share of a part's coordinates by which it is shrunk."""


class Part(Body):
    """Of vertices (n, 3) in mm and triangles (m, 3), welded; `key` names it. No boolean is asked of it, so that it
    needs no solid.

    `shrunk` has each vertex a little further inside: it meets nothing that the part merely touches, however coordinates
    are rounded.
    """

    def __init__(self, key: str, vertices: Floats, triangles: NDArray[np.integer]) -> None:
        super().__init__(key, np.ascontiguousarray(vertices, np.float64), triangles)
        self.key = key

    @cached_property
    def scale(self) -> float:
        """The largest coordinate, in mm: what rounding goes by."""
        return max(float(np.abs(self.bounds).max()), 1e-9)

    @cached_property
    def has_inside(self) -> bool:
        """Whether each edge has a face on either side."""
        begin, end = self.triangles.reshape(-1).astype(np.int64), self.triangles[:, [1, 2, 0]].reshape(-1)
        count = len(self.vertices)
        return np.array_equal(np.sort(begin * count + end), np.sort(end * count + begin))

    @cached_property
    def shrunk(self) -> BoxTree:
        vertices = drawn_in(self.vertices, self.triangles, SHRINK * self.scale)
        return BoxTree(vertices[self.triangles])

    def prepare(self) -> None:
        """Make now what a drag asks for."""
        if not self.empty:
            self.tree.gap(self.shrunk, 0.0)
            _ = self.landmarks, self.has_inside
