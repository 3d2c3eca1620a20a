"""Bodies that are moved without being made anew: the trees of before answer for them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..bodies import APART, MEETING, Body, Relation, _relation

Floats = NDArray[np.float64]

IDENTITY = np.eye(4)
IDENTITY.flags.writeable = False


def mapped(pose: Floats, points: Floats) -> Floats:
    """(n, 3) points under a pose (4, 4)."""
    return points @ pose[:3, :3].T + pose[:3, 3]


def inverse_of(pose: Floats) -> Floats:
    """(4, 4) of a rigid pose."""
    back = np.eye(4)
    back[:3, :3] = pose[:3, :3].T
    back[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return back


def moved_body(body: Body, pose: Floats) -> Body:
    """The same body elsewhere, by a pose (4, 4)."""
    solid = None if body.solid is None else body.solid.transform(pose[:3])
    return Body(body.name, mapped(pose, body.vertices), body.triangles, solid)


def corners_of(bounds: Floats) -> Floats:
    """(8, 3) of a box (2, 3)."""
    picks = np.indices((2, 2, 2)).reshape(3, 8).T
    return bounds[picks, np.arange(3)]


def meeting_of(one: Body, other: Body, pose: Floats) -> float:
    """Millimetres within which the surfaces of one and of the other, moved, count as meeting."""
    reach = np.abs(mapped(pose, corners_of(other.bounds))).max()
    return MEETING * 2.0 * max(float(np.abs(one.bounds).max()), float(reach))


@dataclass(frozen=True, slots=True, eq=False)
class Stand:
    """How two bodies stand: `ends` (2, 3) are where their surfaces are nearest, or meet, and `faces` the triangles
    there."""

    relation: Relation | None
    ends: Floats
    faces: tuple[int, int]


def relation_moved(
    one: Body,
    other: Body,
    pose: Floats,
    limit: float = np.inf,
    first: tuple[int, int] | None = None,
) -> Stand:
    """What `bodies.relation` says where the other is moved by a pose (4, 4). `first` are the nearest triangles of the
    question before about these two."""
    near = meeting_of(one, other, pose)
    gap = one.tree.gap(other.tree, max(limit, 2.0 * near), pose, first)
    ends = np.array([gap.a, gap.b])
    if gap.length > near and _boxes_apart(one, other, pose):
        within = gap.length < limit - near
        shared = 0.0 if one.closed and other.closed else None
        return Stand(Relation(APART, gap.length, ends, shared) if within else None, ends, gap.faces)
    return Stand(_relation(one, moved_body(other, pose), gap.length, ends, limit, near), ends, gap.faces)


def _boxes_apart(one: Body, other: Body, pose: Floats) -> bool:
    corners = mapped(pose, corners_of(other.bounds))
    low, high = one.bounds
    return bool((corners.max(axis=0) < low).any() or (corners.min(axis=0) > high).any())
