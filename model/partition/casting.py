"""The first face on each of many rays, compiled; rays.py has the same in NumPy."""

from __future__ import annotations

import ctypes

import numpy as np

from . import native
from .clusters import Clusters, Floats, Numbers
from .lines import Lines
from .tree import Tree

_ADDRESS, _COUNT, _REAL = ctypes.c_void_p, ctypes.c_int64, ctypes.c_double


class _Rays(ctypes.Structure):
    _fields_ = (
        *((name, _ADDRESS) for name in ("tree", "planes", "plane_of", "sides", "top", "boxes", "inside", "fragments")),
        ("leaves", _COUNT),
        ("epsilon", _REAL),
        ("size", _REAL),
    )


class Caster:
    """Keeps what no ray changes. Raises ValueError for arrays that are no tree."""

    def __init__(self, tree: Tree, clusters: Clusters, sides: Floats, size: float) -> None:
        """`sides` (c, 4) are the planes across the sides of the fragments."""
        view, held = native.tree_view(tree)
        boxes, inside, top, fragments = clusters.flat
        arrays = (
            np.ascontiguousarray(tree.faces.planes, np.float64),
            np.ascontiguousarray(tree.faces.plane_of, np.int32),
            np.ascontiguousarray(sides, np.float64),
            top, boxes, inside, fragments,
        )  # fmt: skip
        self._held = view, held, arrays
        addresses = (array.ctypes.data for array in arrays)
        self._view = _Rays(ctypes.addressof(view), *addresses, len(fragments), tree.epsilon, size)

    def first(self, lines: Lines, slack: float) -> tuple[Floats, Numbers]:
        """The distance (n,) and the face (n,) of the first hits; inf and -1 for a miss."""
        columns = (lines.origin, lines.direction, lines.begin, lines.end, lines.before)
        given = [np.ascontiguousarray(column, np.float64) for column in columns]
        distance, face = np.empty(len(lines.begin)), np.empty(len(lines.begin), np.int64)
        addresses = [array.ctypes.data for array in given]
        native.check(
            native.library().bsp_first_hits(
                ctypes.byref(self._view), *addresses, len(distance), slack, distance.ctypes.data, face.ctypes.data
            )
        )
        return distance, face
