"""The compiled half of this folder, partition/proximity.cpp and sweep.cpp: boxes of triangles and what they tell."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..partition.native import available, library

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]


class _View(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("triangles", "order", "boxes", "links", "oriented", "states")),
        ("nodes", ctypes.c_int64),
    )


class _SurfaceView(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("vertices", "corners")),
        *((name, ctypes.c_int64) for name in ("count", "faces")),
    )


class Tree:
    """Of triangles (n, 3, 3), contiguous. Raises MemoryError, and ValueError for coordinates that are no numbers."""

    def __init__(self, triangles: Floats) -> None:
        if not np.isfinite(triangles).all():
            raise ValueError("a triangle has a corner that is not a finite number")
        count = len(triangles)
        order = np.empty(count, np.int32)
        boxes, links = np.empty((2 * count, 6)), np.empty((2 * count, 3), np.int32)
        nodes = library().proximity_build(
            triangles.ctypes.data, count, order.ctypes.data, boxes.ctypes.data, links.ctypes.data
        )
        if nodes < 0:
            raise MemoryError("there is not enough memory for the boxes of a surface")
        self._held = triangles, order, boxes, links, np.empty((nodes, 15)), np.zeros(nodes, np.uint8)
        self.view = ctypes.byref(_View(*(array.ctypes.data for array in self._held), nodes))


class Surface:
    """Of vertices (n, 3) and triangles (m, 3) whose corners are among them. Raises ValueError for others, and for
    coordinates that are no numbers."""

    def __init__(self, vertices: Floats, triangles: NDArray[np.integer]) -> None:
        points, corners = np.ascontiguousarray(vertices, np.float64), np.ascontiguousarray(triangles, np.int32)
        if not np.isfinite(points).all():
            raise ValueError("a vertex is not a finite point")
        if len(corners) and not 0 <= int(corners.min()) <= int(corners.max()) < len(points):
            raise ValueError("a triangle has a corner that is no vertex")
        self._held = points, corners
        self._view = _SurfaceView(points.ctypes.data, corners.ctypes.data, len(points), len(corners))
        self.address = ctypes.addressof(self._view)


def distance(
    one: Tree, other: Tree, limit: float, pose: Floats | None = None, first: tuple[int, int] = (-1, -1)
) -> tuple[float, Floats, Floats, tuple[int, int]]:
    """See `boxes.BoxTree.gap`; `pose` (4, 4) is contiguous, and `first` are triangles that there are."""
    found, faces = np.empty(7), np.array(first, np.int32)
    moved = None if pose is None else pose.ctypes.data
    _check(library().proximity_distance(one.view, other.view, moved, limit, found.ctypes.data, faces.ctypes.data))
    return float(found[0]), found[1:4], found[4:], (int(faces[0]), int(faces[1]))


def near(surfaces: Sequence[Surface], boxes: Floats, pairs: Numbers, limits: Floats) -> tuple[Floats, Floats, Numbers]:
    """Of pairs (k, 2) of surfaces, whose boxes (n, 2, 3) are known, the shortest ways below finite limits (k,): lengths
    (k,), infinite where there is none, their ends (k, 2, 3), and the faces there (k, 2) or -1. No tree is kept."""
    views = np.array([surface.address for surface in surfaces], np.uintp)
    rows, most = np.ascontiguousarray(pairs, np.int32), np.ascontiguousarray(limits, np.float64)
    around, count = np.ascontiguousarray(boxes, np.float64), len(rows)
    found, faces = np.empty((count, 7)), np.empty((count, 2), np.int32)
    _check(
        library().proximity_near(
            views.ctypes.data, around.ctypes.data, rows.ctypes.data, most.ctypes.data, count,
            found.ctypes.data, faces.ctypes.data,
        )
    )  # fmt: skip
    return found[:, 0], found[:, 1:].reshape(-1, 2, 3), faces.astype(np.int64)


def nearest(tree: Tree, points: Floats, limit: float) -> tuple[Floats, Floats, Numbers]:
    """See `boxes.Nearest`; points (n, 3) are contiguous."""
    count = len(points)
    distances, places, faces = np.empty(count), np.empty((count, 3)), np.empty(count, np.int32)
    _check(
        library().proximity_nearest(
            tree.view, points.ctypes.data, count, limit, distances.ctypes.data, places.ctypes.data, faces.ctypes.data
        )
    )
    return distances, places, faces.astype(np.int64)


def sweep(
    moving: Tree, exact: Floats, standing: Tree, by: Floats, along: Floats, limit: float
) -> tuple[float, Floats, Floats, tuple[int, int]]:
    """See `straight.Sweep`; all arrays are contiguous, `moving` is the tree of `exact` (n, 3, 3) when shrunk."""
    found, faces = np.empty(7), np.empty(2, np.int32)
    _check(
        library().proximity_sweep(
            moving.view, exact.ctypes.data, standing.view, by.ctypes.data, along.ctypes.data, limit,
            found.ctypes.data, faces.ctypes.data,
        )
    )  # fmt: skip
    return float(found[0]), found[1:4], found[4:], (int(faces[0]), int(faces[1]))


def windings(tree: Tree, points: Floats) -> Numbers:
    """See `boxes.BoxTree.windings`; points (n, 3) are contiguous."""
    found = np.empty(len(points), np.int32)
    _check(library().proximity_windings(tree.view, points.ctypes.data, len(points), found.ctypes.data))
    return found.astype(np.int64)


def windings_of(surface: Surface, points: Floats) -> Numbers:
    """The same of a surface without a tree: for a few points."""
    found = np.empty(len(points), np.int32)
    library().proximity_windings_of(surface.address, points.ctypes.data, len(points), found.ctypes.data)
    return found.astype(np.int64)


def pieces(triangles: NDArray[np.integer], vertices: int) -> Numbers:
    """(n,) for each of `vertices` the least vertex of its piece of triangles (m, 3), -1 where none has it. The corners
    must be among the vertices."""
    corners, labels = np.ascontiguousarray(triangles, np.int32), np.empty(vertices, np.int32)
    library().proximity_pieces(corners.ctypes.data, len(corners), vertices, labels.ctypes.data)
    return labels.astype(np.int64)


def _check(status: int) -> None:
    if status:
        raise MemoryError("there is not enough memory for what surfaces are asked")


__all__ = ["Surface", "Tree", "available", "distance", "near", "nearest", "pieces", "sweep", "windings", "windings_of"]
