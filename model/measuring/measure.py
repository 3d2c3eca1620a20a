"""Measures of a solid's surface mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .vectors import three

Tensor = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True, slots=True)
class Measures:
    """Millimetres throughout. `components` counts connected surfaces (a cavity is one); `genus` sums theirs.

    A mesh that is not closed has no volume, no centroid and no inertia. `inertia` is the tensor (3, 3) about the
    centroid along the world's axes, for a density of 1: in mm^5.
    """

    volume: float | None
    area: float
    bounds: tuple[tuple[float, ...], tuple[float, ...]] | None
    centroid: tuple[float, ...] | None
    triangles: int
    components: int
    genus: int
    closed: bool
    inertia: Tensor | None = None

    @property
    def principal_moments(self) -> tuple[float, float, float] | None:
        """The inertia about the principal axes through the centroid, least first, in mm^5."""
        return None if self.inertia is None else three(np.linalg.eigvalsh(np.array(self.inertia)))

    @property
    def principal_axes(self) -> Tensor | None:
        """Unit vectors (3, 3), one a row, right-handed, in the order of `principal_moments`."""
        if self.inertia is None:
            return None
        axes = np.linalg.eigh(np.array(self.inertia))[1].T
        # Each axis has two directions: the one taken has its largest component positive.
        largest = np.take_along_axis(axes, np.abs(axes).argmax(axis=1)[:, None], axis=1)
        axes = axes * np.sign(largest)
        axes[2] *= np.sign(np.linalg.det(axes))
        return _tensor(axes)

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
            "inertia": None if self.inertia is None else [list(row) for row in self.inertia],
            "principal_moments": None if self.principal_moments is None else list(self.principal_moments),
        }


def measure(points: NDArray[np.float64], triangles: NDArray[np.integer], closed: bool = True) -> Measures:
    """Measures of points (n, 3) and outward triangles (m, 3) that share their corners.

    Volume, centroid and inertia by the divergence theorem, as sums of signed tetrahedra about the middle of the bounds,
    so that a solid far from the origin loses no digits; the second moments of a tetrahedron are polynomials of its
    corners (Tonon, Explicit exact formulas for the 3-D tetrahedron inertia tensor, 2004).
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
    centroid = inertia = None
    if closed and total > 0:
        corners = a + b + c
        offset = (sixfold @ corners) / (4 * total)
        centroid = tuple(float(x) for x in middle + offset)
        second = sum(((corner.T * sixfold) @ corner for corner in (a, b, c, corners)), np.zeros((3, 3))) / 120
        second -= total / 6 * np.outer(offset, offset)
        inertia = _tensor(np.trace(second) * np.eye(3) - (second + second.T) / 2)
    return Measures(
        total / 6 if closed else None,
        area,
        (tuple(map(float, low)), tuple(map(float, high))),
        centroid,
        len(triangles),
        components,
        components - chi // 2,
        closed,
        inertia,
    )


def summed(parts: Sequence[Measures]) -> Measures:
    """Of several solids as if none overlapped: sums, the box around all, centroid and inertia of all together."""
    boxes = np.array([part.bounds for part in parts if part.bounds is not None])
    closed = all(part.closed for part in parts)
    volumes = np.array([part.volume or 0.0 for part in parts])
    volume = float(volumes.sum())
    centroid = inertia = None
    solid = [part for part in parts if part.inertia is not None and part.centroid is not None]
    if closed and volume > 0:
        weights = np.array([part.volume for part in solid])
        centres = np.array([part.centroid for part in solid])
        middle = weights @ centres / weights.sum()
        apart = centres - middle
        # Steiner's theorem carries each tensor to the common centroid.
        second = (apart.T * weights) @ apart
        own = np.array([part.inertia for part in solid]).sum(axis=0)
        centroid = three(middle)
        inertia = _tensor(own + np.trace(second) * np.eye(3) - second)
    return Measures(
        volume if closed else None,
        sum(part.area for part in parts),
        (three(boxes[:, 0].min(axis=0)), three(boxes[:, 1].max(axis=0))) if len(boxes) else None,
        centroid,
        sum(part.triangles for part in parts),
        sum(part.components for part in parts),
        sum(part.genus for part in parts),
        closed,
        inertia,
    )


def _tensor(rows: NDArray[np.float64]) -> Tensor:
    return three(rows[0]), three(rows[1]), three(rows[2])


def _edge_count(triangles: NDArray[np.integer]) -> int:
    ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).astype(np.int64), axis=1)
    return len(np.unique(ends[:, 0] * (int(ends.max()) + 1) + ends[:, 1]))


def component_count(size: int, triangles: NDArray[np.integer]) -> int:
    """How many connected surfaces triangles (m, 3) over `size` vertices form."""
    return len(np.unique(component_labels(size, triangles)[triangles[:, 0]]))


def component_labels(size: int, cells: NDArray[np.integer]) -> NDArray[np.int64]:
    """(size,) for each vertex the least one that it is connected with by cells (m, k).

    Labels are hooked to the least neighbouring one and shortened until nothing changes (Shiloach and Vishkin, 1982).
    """
    label = np.arange(size, dtype=np.int64)
    corners = np.ascontiguousarray(cells, dtype=np.int64)
    while True:
        least = label[corners].min(axis=1) if len(corners) else label[:0]
        before = label.copy()
        for i in range(corners.shape[1]):
            np.minimum.at(label, before[corners[:, i]], least)
            np.minimum.at(label, corners[:, i], least)
        while True:
            shorter = label[label]
            if (shorter == label).all():
                break
            label = shorter
        if (label == before).all():
            return label
