"""How deep two solids are in each other: a short way on which one leaves the other.

For convex solids the depth is exact: the distance of the origin from the surface of their Minkowski difference (Cameron
1997, "Enhancing GJK"), found by growing a hull of its extreme points outwards where it is nearest to the origin (van
den Bergen 2001, "Proximity queries and penetration depth computation on 3D game objects"). For others it is an upper
bound: the shortest found among a number of directions, each way exact along its own direction, seen from outside.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from .bodies import APART, OVERLAP, Body, overlap_of
from .moving.moved import IDENTITY, moved_body, relation_moved
from .moving.screws import Path
from .moving.sweeping import advance, closeness, outermost

Floats = NDArray[np.float64]

FLAT = 1e-10
"""The share of its volume by which a convex solid may differ from its hull."""
SURE = 1e-12
"""The share of the bodies' size within which the depth of convex ones is known."""
ROUNDS = 500
"""Of growing the hull."""
MOST_DIRECTIONS = 40
"""That are tried where a solid is not convex."""
LOOKS = 4000
"""Gaps that are looked at along each of them."""
PARTS = np.array([0.0625, 0.125, 0.25, 0.5, 1.0])
"""Of the thickness of what is shared."""
CLEAR = 1e-9
"""By which share a depth is lengthened where it is tried out."""


@dataclass(frozen=True, slots=True, eq=False)
class Penetration:
    """The first solid leaves the second when it is moved by `depth` mm along the unit vector `direction` (3,).

    `exact`: no shorter move separates them; else there may be one.
    """

    depth: float
    direction: Floats
    exact: bool

    @property
    def move(self) -> Floats:
        """(3,) mm."""
        return self.depth * self.direction


def penetration(one: Body, other: Body, told: Callable[[int, int], None] | None = None) -> Penetration | None:
    """The shortest move found that takes one solid out of the other; None where they share nothing.

    Both must be closed, else Refusal. What is exact and what a bound is told at the top. `told` hears how many of the
    directions are done, and may raise to stop.
    """
    for body in (one, other):
        if not body.closed:
            raise Refusal(f"“{body.name}” is not closed: nothing can be inside it")
    if one.empty or other.empty or not _share(one, other):
        return None
    least = _out_of_hull(outermost(one), outermost(other))
    if _convex(one) and _convex(other):
        return Penetration(least.depth, least.direction, True)
    best = least
    mesh = overlap_of(one, other).to_mesh64()
    shared = np.asarray(mesh.vert_properties)[:, :3]
    found = _directions(one, other, least.direction, shared, np.asarray(mesh.tri_verts).astype(np.int64))
    for number, direction in enumerate(found):
        if told is not None:
            told(number, len(found))
        way = _shortened(one, other, direction, float(np.ptp(shared @ direction)), best.depth)
        if way < best.depth:
            best = Penetration(way, direction, False)
    return Penetration(best.depth, best.direction, False)


def _share(one: Body, other: Body) -> bool:
    return float(overlap_of(one, other).volume()) > OVERLAP * min(one.volume, other.volume)


def _convex(body: Body) -> bool:
    assert body.solid is not None
    return abs(body.solid.hull().volume() - body.volume) <= FLAT * body.volume


def _out_of_hull(one: Floats, other: Floats) -> Penetration:
    """Of the hulls of points (n, 3) and (m, 3) that share something, exactly."""
    from scipy.spatial import ConvexHull, QhullError

    def reach(directions: Floats) -> tuple[Floats, Floats]:
        """Of other - one: the farthest points (k, 3) in directions (k, 3), and how far (k,) they are."""
        far, near = other @ directions.T, one @ directions.T
        ends = other[far.argmax(axis=0)] - one[near.argmin(axis=0)]
        return ends, far.max(axis=0) - near.min(axis=0)

    size = float(max(np.ptp(one, axis=0).max(), np.ptp(other, axis=0).max()))
    grid = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3), -1).reshape(-1, 3)
    first = grid[np.abs(grid).any(axis=1)]
    first /= np.linalg.norm(first, axis=1)[:, None]
    points, depths = reach(first)
    depth, direction = float(depths.min()), first[depths.argmin()]
    for _ in range(ROUNDS):
        try:
            planes = ConvexHull(points).equations
        except QhullError:
            break
        nearest = np.argsort(-planes[:, 3])[:16]  # the inner hull's faces, those nearest to the origin first
        normals = planes[nearest, :3]
        ends, depths = reach(normals)
        if depths.min() < depth:
            depth, direction = float(depths.min()), normals[depths.argmin()]
        fresh = depths + planes[nearest, 3] > SURE * size  # faces of the inner hull that are not yet the outer one's
        if depth + planes[nearest[0], 3] <= SURE * size or not fresh.any():
            break
        points = np.vstack((points, ends[fresh]))
    return Penetration(depth, direction, True)


def _directions(one: Body, other: Body, first: Floats, shared: Floats, triangles: NDArray[np.int64]) -> Floats:
    """(k, 3) unit vectors along which the first may leave: that of the hulls, the axes, the flattest ways through what
    they share, of vertices (n, 3) and triangles (m, 3), and its largest flat sides, which are parts of both."""
    corners = shared[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    normals = normals[areas > 0.0] / areas[areas > 0.0, None]
    _, place = np.unique(np.round(normals, 6), axis=0, return_inverse=True)
    weights = np.bincount(place.reshape(-1), areas[areas > 0.0])
    picks = np.zeros(len(weights), np.int64)
    picks[place.reshape(-1)] = np.arange(len(normals))
    sides = normals[picks[np.argsort(-weights)[: MOST_DIRECTIONS // 2]]]
    spread = np.linalg.svd(shared - shared.mean(axis=0), full_matrices=False)[2]
    ways = np.vstack((first[None], spread, np.eye(3), sides))
    ways = np.vstack((ways, -ways))
    middle = one.bounds.mean(axis=0) - other.bounds.mean(axis=0)
    if np.linalg.norm(middle) > 0.0:
        ways = np.vstack((ways, middle / np.linalg.norm(middle)))
    _, kept = np.unique(np.round(ways, 6), axis=0, return_index=True)
    ways = ways[np.sort(kept)]
    return ways[np.argsort(np.ptp(shared @ ways.T, axis=0))]


def _shortened(one: Body, other: Body, direction: Floats, thickness: float, depth: float) -> float:
    """Millimetres along a direction after which the first is out of the other; `depth` where that is not less.

    It comes back from where it is out, until they meet: the place before is out, too. That is looked for where it has
    gone by parts of the `thickness` of what they share, the least first, and where it has passed all of the other.
    """
    close = closeness(one, other)
    passed_all = float((other.vertices @ direction).max() - (one.vertices @ direction).min())
    pose = IDENTITY.copy()
    for start in (*(thickness * PARTS + close), min(passed_all * (1.0 + CLEAR) + close, depth)):
        pose[:3, 3] = start * direction
        if start > depth or other.tree.gap(one.tree, close, pose).length < 0.25 * close:
            continue
        stand = relation_moved(other, one, pose)
        if stand.relation is not None and stand.relation.kind == APART:
            path = Path(np.array([pose, IDENTITY]), (0.0, start))
            return float(start) - advance(one, other, path, 0.5 * close, float(start), stand.faces, LOOKS).time
    return depth


def separated(one: Body, other: Body, way: Penetration) -> bool:
    """Whether the move does take the first out of the other."""
    pose = IDENTITY.copy()
    pose[:3, 3] = (1.0 + CLEAR) * way.move
    return not _share(moved_body(one, pose), other)
