"""How far a surface goes straight on before it meets another one, and the plane that it meets it in.

Along the way, vertices meet faces and edges meet edges at times that linear equations give (Schwarzer, Saha and Latombe
2005 call the question dynamic collision checking); seen along the way both are questions in two dimensions. Of what
moves, only faces that look ahead count, of what stands only those that look against the way: surfaces slide along each
other freely.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.faults.box_pairs import meeting
from .boxes import Floats, Numbers
from .parts import SHRINK, Part

LEVEL = 1e-9
"""The cosine from which a face looks ahead rather than sideways."""
TOGETHER = 1 << 21
"""Pairs of boxes that are compared without a tree."""


@dataclass(frozen=True, slots=True, eq=False)
class Hit:
    """The `share` of the way, 0 to 1, that is free, the unit `normal` (3,) there, of what stands, and the parts."""

    share: float
    normal: Floats
    moving: Part
    standing: Part


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """What counts of a part, seen along the way, which is the last axis: `places` (n, 3) and the `looser` ones, shrunk
    of what moves; faces (m, 3), edges (k, 2) and vertices (v,) by their numbers."""

    places: Floats
    looser: Floats
    faces: Numbers
    edges: Numbers
    vertices: Numbers


def first_hit(moving: Part, pose: Floats, standing: Part, way: Floats) -> Hit | None:
    """What stops a part at `pose` (4, 4), rigid, on its way (3,) in mm; None where nothing does.

    The part does not overlap the standing one at the beginning; it may touch it.
    """
    length = float(np.linalg.norm(way))
    if not length or moving.empty or standing.empty:
        return None
    axes = _axes(way / length)
    slack = 4.0 * SHRINK * moving.scale
    turned = axes @ pose[:3, :3]
    places = moving.vertices @ turned.T + axes @ pose[:3, 3]
    others = standing.vertices @ axes.T
    low, high = places.min(axis=0) - slack, places.max(axis=0) + slack + (0.0, 0.0, length)
    if (low > others.max(axis=0)).any() or (high < others.min(axis=0)).any():
        return None
    looser = moving.shrunk_vertices @ turned.T + axes @ pose[:3, 3]
    ahead = moving.normals @ turned[2] > LEVEL
    against = standing.normals @ axes[2] < -LEVEL
    stands = _side(standing, others, others, against, low, high)
    goes = _side(
        moving, places, looser, ahead, others.min(axis=0) - slack - (0.0, 0.0, length), others.max(axis=0) + slack
    )
    found = [*_corners_on_faces(goes, stands, length + slack), *_edges_on_edges(goes, stands, length + slack)]
    times = np.concatenate([times for times, _ in found]) if found else np.zeros(0)
    if not len(times) or times.min() > length:
        return None
    first = int(np.argmin(times))
    normal = np.concatenate([normals for _, normals in found])[first]
    normal = normal / np.linalg.norm(normal)
    normal = normal if normal[2] < 0.0 else -normal
    return Hit(max(float(times[first]), 0.0) / length, normal @ axes, moving, standing)


def _axes(along: Floats) -> Floats:
    """(3, 3) rows, right-handed: the last is the unit vector `along`; exact where that is one of the axes."""
    other = np.eye(3)[int(np.argmin(np.abs(along)))]
    first = np.cross(other, along)
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(along, first), along])


def _side(part: Part, places: Floats, looser: Floats, facing: NDArray[np.bool_], low: Floats, high: Floats) -> _Side:
    """What faces the other one and lies within a box."""
    rows = np.flatnonzero(facing)
    corners = places[part.triangles[rows]]
    rows = rows[((corners.max(axis=1) >= low) & (corners.min(axis=1) <= high)).all(axis=1)]
    faces = part.triangles[rows].astype(np.int64)
    chosen = np.zeros(len(part.triangles), bool)
    chosen[rows] = True
    ends, sides = part.edges
    return _Side(places, looser, faces, ends[chosen[sides].any(axis=1)], np.unique(faces))


Found = tuple[Floats, Floats]
"""Ways (k,) in mm, and normals (k, 3) of either sign."""


def _corners_on_faces(goes: _Side, stands: _Side, length: float) -> Iterator[Found]:
    """Corners of what moves on faces of what stands, and the other way round."""
    for corners, faces, sign in ((goes, stands, 1.0), (stands, goes, -1.0)):
        points, triangles = corners.looser[corners.vertices], faces.looser[faces.faces]
        ahead = (0.0, 0.0, length)
        low, high = points, points + ahead
        lowest, highest = triangles.min(axis=1), triangles.max(axis=1)
        if sign < 0.0:
            low, high = points - ahead, points
        for one, other in _pairs(low, high, lowest, highest):
            at = points[one]
            inside = _inside(triangles[other], at)
            one, other, at = one[inside], other[inside], at[inside]
            normal = _normals(triangles[other])
            gone = sign * _rise(triangles[other][:, 0], normal, at)
            there = gone >= -1e-12 * length
            one, other, normal = one[there], other[there], normal[there]
            exact = corners.places[corners.vertices[one]]
            yield sign * _rise(faces.places[faces.faces[other, 0]], normal, exact), normal


def _edges_on_edges(goes: _Side, stands: _Side, length: float) -> Iterator[Found]:
    mine, theirs = goes.looser[goes.edges], stands.looser[stands.edges]
    if not len(mine) or not len(theirs):
        return
    high = mine.max(axis=1) + (0.0, 0.0, length)
    for one, other in _pairs(mine.min(axis=1), high, theirs.min(axis=1), theirs.max(axis=1)):
        a, along, c, across = mine[one, 0], mine[one, 1] - mine[one, 0], theirs[other, 0], None
        across = theirs[other, 1] - c
        normal = np.cross(along, across)
        turn = normal[:, 2]
        kept = np.abs(turn) > LEVEL * np.linalg.norm(normal, axis=1)
        one, other, a, along, c, across = (rows[kept] for rows in (one, other, a, along, c, across))
        normal, turn = normal[kept], turn[kept]
        from_a = c - a
        s = (from_a[:, 0] * across[:, 1] - from_a[:, 1] * across[:, 0]) / turn
        r = (from_a[:, 0] * along[:, 1] - from_a[:, 1] * along[:, 0]) / turn
        crossing = (s >= 0.0) & (s <= 1.0) & (r >= 0.0) & (r <= 1.0)
        gone = np.einsum("ij,ij->i", from_a, normal) / turn
        crossing &= gone >= -1e-12 * length
        one, normal, c = one[crossing], normal[crossing], c[crossing]
        exact = goes.places[goes.edges[one, 0]]
        yield np.einsum("ij,ij->i", c - exact, normal) / normal[:, 2], normal


def _inside(triangles: Floats, points: Floats) -> NDArray[np.bool_]:
    """(k,) whether points (k, 3) lie in triangles (k, 3, 3), seen along the last axis; their borders count."""
    flat, at = triangles[:, :, :2], points[:, None, :2]
    sides = np.roll(flat, -1, axis=1) - flat
    turn = sides[:, :, 0] * (at - flat)[:, :, 1] - sides[:, :, 1] * (at - flat)[:, :, 0]
    return (turn >= 0.0).all(axis=1) | (turn <= 0.0).all(axis=1)


def _normals(triangles: Floats) -> Floats:
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def _rise(on: Floats, normal: Floats, points: Floats) -> Floats:
    """(k,) how far from points (k, 3), along the last axis, planes lie that go through `on` (k, 3)."""
    return np.einsum("ij,ij->i", on - points, normal) / normal[:, 2]


def _pairs(low: Floats, high: Floats, lowest: Floats, highest: Floats) -> Iterator[tuple[Numbers, Numbers]]:
    """Pairs of boxes of one list and of another that meet, in batches."""
    if not len(low) or not len(lowest):
        return
    count = len(low)
    if count * len(lowest) > TOGETHER:
        lows, highs = np.concatenate((low, lowest)), np.concatenate((high, highest))
        for one, other in meeting(lows, highs):
            one, other = np.minimum(one, other), np.maximum(one, other)
            mixed = (one < count) & (other >= count)
            yield one[mixed], other[mixed] - count
        return
    near = np.ones((count, len(lowest)), bool)
    for axis in range(3):
        near &= (low[:, None, axis] <= highest[None, :, axis]) & (high[:, None, axis] >= lowest[None, :, axis])
    yield tuple(np.nonzero(near))  # type: ignore[misc]
