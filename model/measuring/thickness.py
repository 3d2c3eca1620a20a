"""How thick a wall is: from a point of a surface straight inwards to where the solid ends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .vectors import three

if TYPE_CHECKING:
    from manifold3d import Manifold

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

START = 1e-6
"""How far below the surface a ray begins, as a share of the solid's size: the surface itself is no exit."""
RAYS = 2000


@dataclass(frozen=True, slots=True)
class Thickness:
    """Millimetres from `point` on the surface to `exit`, where a ray along the inward normal leaves the solid."""

    length: float
    point: Vector
    exit: Vector


def thickness_at(
    points: NDArray[np.floating], triangles: NDArray[np.integer], point: ArrayLike, normal: ArrayLike
) -> Thickness | None:
    """The wall under `point`, on a surface of points (n, 3) and outward triangles (m, 3) with this outward normal.

    None where the ray meets nothing that it leaves by, as in a surface that is not closed. Möller and Trumbore's test
    (1997) on the triangles whose boxes the ray's box meets.
    """
    start = np.asarray(point, dtype=np.float64)
    way = -np.asarray(normal, dtype=np.float64)
    way = way / np.linalg.norm(way)
    corners = np.asarray(points, dtype=np.float64) - start
    size = float(np.ptp(corners, axis=0).max())
    # In axes with the ray along z the triangle is hit where its shadow covers the origin.
    across = np.linalg.svd(way[None])[2][1:]
    flat, depth = corners @ across.T, corners @ way
    rows = np.arange(len(triangles))
    for axis in range(2):  # a triangle all on one side of an axis does not cover the origin
        sides = flat[:, axis]
        one, two, last = (sides[triangles[rows, i]] for i in range(3))
        low, high = np.minimum(np.minimum(one, two), last), np.maximum(np.maximum(one, two), last)
        rows = rows[(low <= 0) & (high >= 0)]
    if not len(rows):
        return None
    a, b, c = (flat[triangles[rows, i]] for i in range(3))
    weights = np.column_stack((_cross(b, c), _cross(c, a), _cross(a, b)))
    area = weights.sum(axis=1)
    turned = np.where(area < 0, -1.0, 1.0)[:, None] * weights
    slack = 1e-12 * np.abs(area) + 1e-14 * size * size
    inside = (turned >= -slack[:, None]).all(axis=1) & (np.abs(area) > 1e-14 * size * size)
    rows, weights, area = rows[inside], weights[inside], area[inside]
    where = np.einsum("ij,ij->i", weights, depth[triangles[rows]]) / area
    sides = corners[triangles[rows]]
    out = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0]) @ way > 0
    beyond = where[out & (where > START * size)]
    if not len(beyond):
        return None
    length = float(beyond.min())
    return Thickness(length, three(start), three(start + length * way))


def thinnest(solid: Manifold, rays: int = RAYS, seed: int = 0) -> Thickness | None:
    """An estimate of the least wall of a solid: the shortest of `rays` rays from points spread evenly over its surface.

    What is thinner nowhere near a point is missed: the true least wall is this or less. The same solid and seed give
    the same answer. Rays start at facets' points, so at a sharp edge the wall goes to nothing, and they find that; rays
    that leave through a face that is not opposite (its normal less than 45 degrees from the ray) are left out as being
    no wall. None for what is empty or has no walls.
    """
    mesh = solid.to_mesh64()
    points = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3]
    corners = points[np.asarray(mesh.tri_verts).astype(np.int64)]
    if not len(corners):
        return None
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(crosses, axis=1)
    chance = np.random.default_rng(seed)
    # One point in each of `rays` equal shares of the area, so that none of them goes without.
    shares = (np.arange(rays) + chance.random(rays)) / rays * areas.sum()
    chosen = np.minimum(np.searchsorted(np.cumsum(areas), shares), len(areas) - 1)
    p, q = chance.random((2, rays))
    over = p + q > 1
    p, q = np.where(over, 1 - p, p)[:, None], np.where(over, 1 - q, q)[:, None]
    a, b, c = (corners[chosen, i] for i in range(3))
    starts = a + p * (b - a) + q * (c - a)
    normals = crosses[chosen] / np.maximum(areas[chosen], 1e-300)[:, None]
    reach = float(np.linalg.norm(np.ptp(points, axis=0))) * 1.01
    best: Thickness | None = None
    for start, normal in zip(starts, normals, strict=True):
        first = start - START * reach * normal
        limit = reach if best is None else min(best.length, reach)
        for hit in solid.ray_cast(tuple(first), tuple(start - limit * normal)):
            if np.dot(hit.normal, normal) < -OPPOSITE:
                exit_ = np.asarray(hit.position, dtype=np.float64)
                length = float(np.linalg.norm(exit_ - start))
                if best is None or length < best.length:
                    best = Thickness(length, three(start), three(exit_))
            break
    return best


OPPOSITE = np.cos(np.radians(45))


def _cross(one: Floats, other: Floats) -> Floats:
    return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
