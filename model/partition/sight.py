"""Whether two points see each other past bodies: no part of the line between them lies in one.

A line of sight may touch a body, run along its faces and end on them. Faces that bound no body stand in the way all the
same where the line goes through them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .rays import END, Floats, Hit, Hits, Rays, Vector

AWAY = np.array([0.4342944819, 0.5772156649, 0.6915090115])
"""A direction that the faces of hardly any model are square or parallel to."""
OFF = 4.0
"""How many tolerances before a face one looks whether it is free there."""


@dataclass(frozen=True, slots=True)
class Sight:
    """The line from `a` to `b`, `length` millimetres long, and what first stands in its way."""

    a: Vector
    b: Vector
    length: float
    obstacle: Hit | None

    @property
    def clear(self) -> bool:
        return self.obstacle is None


def line_of_sight(rays: Rays, a: ArrayLike, b: ArrayLike, tolerance: float | None = None) -> Sight:
    """What one sees of b (3,) from a (3,), where faces bound bodies that their normals point out of.

    Points at most `tolerance` millimetres (by default END of the scene's size) off a face are on it. Where a line goes
    into a body at its very beginning, the obstacle is the face there, 0 away. A point in a body sees as far as the
    body's surface. Raises ValueError where something is not finite.
    """
    start, end = np.asarray(a, float).reshape(3), np.asarray(b, float).reshape(3)
    if not (np.isfinite(start).all() and np.isfinite(end).all()):
        raise ValueError("a line of sight needs points whose coordinates are numbers")
    slack = _slack(rays, tolerance)
    length = float(np.linalg.norm(end - start))
    obstacle = _obstacle(rays, start, end, length, slack) if length > 2.0 * slack else None
    return Sight(_three(start), _three(end), length, obstacle)


def inside(rays: Rays, points: ArrayLike, tolerance: float | None = None) -> NDArray[np.bool_]:
    """(n,) which of points (n, 3) lie in a body, and farther than `tolerance` millimetres from all faces.

    A ray from there leaves one more body than it enters.
    """
    here = np.asarray(points, float).reshape(-1, 3)
    found = _bodies_around(rays, here) > 0
    found[rays.at(here, _slack(rays, tolerance))[0]] = False
    return found


def _buried(rays: Rays, points: Floats, slack: float) -> NDArray[np.bool_]:
    """(n,) which of points (n, 3) nothing is seen of: in a body, or between the faces of bodies that touch."""
    found = _bodies_around(rays, points) > 0
    row, face = rays.at(points, slack)
    if not len(row):
        return found
    # On a face: whether it is free before this face, or in the corner between it and the others.
    normals = rays.tree.faces.planes[rays.tree.faces.plane_of[face], :3]
    sums = np.column_stack([np.bincount(row, normals[:, axis], len(points)) for axis in range(3)])
    touching = np.unique(row)
    beside = np.concatenate((normals, sums[touching]))
    of = np.concatenate((row, touching))
    length = np.linalg.norm(beside, axis=1, keepdims=True)
    beside = points[of] + OFF * slack * beside / np.where(length > 0.0, length, 1.0)
    free = (_bodies_around(rays, beside) <= 0) & (length[:, 0] > 0.5)
    found[touching] = True
    found[of[free]] = False
    return found


def _bodies_around(rays: Rays, points: Floats) -> NDArray[np.float64]:
    """(n,) in how many bodies points (n, 3) lie; for those on a face anything."""
    found = rays.all(points, np.broadcast_to(AWAY, points.shape))
    turn = np.where(found.front, -1, 1)
    # An edge that is met is met twice: once for each face beside it.
    order = np.lexsort((found.distance, found.front, found.ray))
    ray, distance, turn = found.ray[order], found.distance[order], turn[order]
    again = (np.diff(ray, prepend=-1) == 0) & (np.diff(turn, prepend=0) == 0)
    again &= np.abs(np.diff(distance, prepend=-np.inf)) <= 16.0 * rays.tree.epsilon
    return np.bincount(ray[~again], turn[~again], len(points)).astype(np.float64)


def _slack(rays: Rays, tolerance: float | None) -> float:
    return max(END * rays.size if tolerance is None else float(tolerance), rays.tree.epsilon)


def _obstacle(rays: Rays, start: Floats, end: Floats, length: float, slack: float) -> Hit | None:
    along = (end - start) / length
    met = rays.all(start, along, slack, length - slack, grazing=slack)
    cuts = np.concatenate(([0.0], met.distance, [length]))
    gaps = np.flatnonzero(np.diff(cuts) > slack)
    middles = start + 0.5 * (cuts[gaps] + cuts[gaps + 1])[:, None] * along
    buried = gaps[_buried(rays, middles, slack)]
    through = np.flatnonzero(_well_inside(rays, met, start + met.distance[:, None] * along, slack))
    first = int(through[0]) if len(through) else len(met.face)
    if len(buried) and buried[0] <= first:
        gap = int(buried[0])
        if gap > 0:
            near = np.flatnonzero(np.abs(met.distance - cuts[gap]) <= slack)
            first = int(near[np.argmax(met.front[near])])
        else:
            touched = _face_at(rays, start, along)
            if touched is not None:
                return rays.hit_at(start, along, 0.0, touched)
            if not len(met.face):
                touched = _face_at(rays, end, -along)
                return None if touched is None else rays.hit_at(start, along, length, touched)
            first = 0
    if first == len(met.face):
        return None
    return rays.hit_at(start, along, float(met.distance[first]), int(met.face[first]))


def _face_at(rays: Rays, point: Floats, along: Floats) -> int | None:
    """The face at a point that a line which begins there goes behind."""
    slack = END * rays.size
    _, face = rays.at(point, slack)
    planes = rays.tree.faces.planes[rays.tree.faces.plane_of[face]]
    agree = planes[:, :3] @ along
    return int(face[np.argmin(agree)]) if len(face) and agree.min() < 0.0 else None


def _well_inside(rays: Rays, met: Hits, points: Floats, slack: float) -> NDArray[np.bool_]:
    """(k,) which hits at points (k, 3) are not on the border of their face."""
    faces = rays.tree.faces
    result = np.ones(len(met.face), bool)
    for i, face in enumerate(met.face):
        ring = faces.points[faces.corners[faces.starts[face] : faces.starts[face + 1]]]
        sides = np.roll(ring, -1, axis=0) - ring
        inwards = np.cross(faces.planes[faces.plane_of[face], :3], sides)
        away = np.einsum("ij,ij->i", inwards, points[i] - ring)
        result[i] = bool((away > slack * np.linalg.norm(sides, axis=1)).all())
    return result


def _three(values: Floats) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])
