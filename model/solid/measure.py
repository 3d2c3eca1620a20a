"""Measures of a solid's surface mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Measures:
    """Millimetres throughout. `components` counts connected surfaces (a cavity is one); `genus` sums theirs.

    A mesh that is not closed has no volume and no centroid.
    """

    volume: float | None
    area: float
    bounds: tuple[tuple[float, ...], tuple[float, ...]] | None
    centroid: tuple[float, ...] | None
    triangles: int
    components: int
    genus: int
    closed: bool

    def as_json(self) -> dict[str, Any]:
        """As `solidtree info` prints it."""
        return {
            "volume": self.volume,
            "area": self.area,
            "bounds": None if self.bounds is None else [list(corner) for corner in self.bounds],
            "centroid": None if self.centroid is None else list(self.centroid),
            "triangles": self.triangles,
            "components": self.components,
            "genus": self.genus,
            "closed": self.closed,
        }


def measure(points: NDArray[np.float64], triangles: NDArray[np.integer], closed: bool = True) -> Measures:
    """Measures of points (n, 3) and outward triangles (m, 3) that share their corners.

    Volume and centroid by the divergence theorem, as sums of signed tetrahedra about the middle of the bounds, so that
    a solid far from the origin loses no digits.
    """
    if not len(triangles):
        return Measures(0.0, 0.0, None, None, 0, 0, 0, True)
    used = points[np.unique(triangles)] if len(points) > 3 * len(triangles) else points
    low, high = used.min(axis=0), used.max(axis=0)
    middle = (low + high) / 2
    a, b, c = (points[triangles[:, i]] - middle for i in range(3))
    normals = np.cross(b - a, c - a)
    area = float(np.linalg.norm(normals, axis=1).sum()) / 2
    sixfold = np.einsum("ij,ij->i", a, normals)
    total = float(sixfold.sum())
    components = component_count(len(points), triangles)
    edges = len(triangles) * 3 // 2 if closed else _edge_count(triangles)
    vertices = len(np.unique(triangles))
    chi = vertices - edges + len(triangles)
    centroid = None
    if closed and total > 0:
        centroid = tuple(float(x) for x in middle + (sixfold @ (a + b + c)) / (4 * total))
    return Measures(
        total / 6 if closed else None,
        area,
        (tuple(map(float, low)), tuple(map(float, high))),
        centroid,
        len(triangles),
        components,
        components - chi // 2,
        closed,
    )


def _edge_count(triangles: NDArray[np.integer]) -> int:
    ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).astype(np.int64), axis=1)
    return len(np.unique(ends[:, 0] * (int(ends.max()) + 1) + ends[:, 1]))


def component_count(size: int, triangles: NDArray[np.integer]) -> int:
    """How many connected surfaces triangles (m, 3) over `size` vertices form.

    Labels are hooked to the least neighbouring one and shortened until nothing changes (Shiloach and Vishkin, 1982).
    """
    label = np.arange(size, dtype=np.int64)
    corners = np.ascontiguousarray(triangles, dtype=np.int64)
    while True:
        least = label[corners].min(axis=1)
        before = label.copy()
        for i in range(3):
            np.minimum.at(label, before[corners[:, i]], least)
            np.minimum.at(label, corners[:, i], least)
        while True:
            shorter = label[label]
            if (shorter == label).all():
                break
            label = shorter
        if (label == before).all():
            return len(np.unique(label[corners[:, 0]]))
