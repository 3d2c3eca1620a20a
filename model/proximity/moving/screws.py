"""Rigid motions between two poses: turned about an axis and moved along it, as any of them can be (Chasles 1830)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...document.errors import Refusal

Floats = NDArray[np.float64]

RIGID = 1e-9
"""How far a pose's turn may be from one."""
LEAST_TURN = 1e-12
"""Radians; a motion that turns by less only moves."""


class Path:
    """A way through `poses` (k, 4, 4), rigid, at rising `times` (k,): from each to the next by the screw between them,
    evenly, so that a turn about an axis is one whatever the parts between."""

    def __init__(self, poses: ArrayLike, times: ArrayLike) -> None:
        self.poses = _rigid(poses)
        try:
            self.times: Floats = np.array(times, np.float64).reshape(-1)
        except (TypeError, ValueError):
            raise Refusal("the times of a path are numbers, each larger than the one before") from None
        if len(self.times) != len(self.poses):
            raise Refusal(f"a path has a time for each of its {len(self.poses)} poses, not {len(self.times)} times")
        if not np.isfinite(self.times).all() or (np.diff(self.times) <= 0.0).any():
            raise Refusal("the times of a path are numbers, each larger than the one before")

    @cached_property
    def screws(self) -> tuple[Screw, ...]:
        """(k - 1,) from each pose to the next."""
        pairs = zip(self.poses[:-1], self.poses[1:], strict=True)
        return tuple(screw_between(one, other) for one, other in pairs)

    def pose(self, time: float) -> Floats:
        """(4, 4) at a time; before the first and after the last as there."""
        if len(self.times) == 1 or time <= self.times[0]:
            return self.poses[0]
        if time >= self.times[-1]:
            return self.poses[-1]
        leg = int(np.searchsorted(self.times, time, "right")) - 1
        return self.along(leg, time)

    def along(self, leg: int, time: float) -> Floats:
        """(4, 4) at a time of the leg between two neighbouring poses."""
        begin, end = self.times[leg], self.times[leg + 1]
        return self.screws[leg].part((time - begin) / (end - begin)) @ self.poses[leg]

    def speeds(self, points: Floats) -> Floats:
        """(k - 1,) mm in a unit of time: on each leg no point of the hull of points (n, 3), given before the poses, is
        faster."""
        ways = [
            screw.longest_way(points @ pose[:3, :3].T + pose[:3, 3])
            for screw, pose in zip(self.screws, self.poses[:-1], strict=True)
        ]
        return np.array(ways, np.float64) / np.diff(self.times)


@dataclass(frozen=True, slots=True, eq=False)
class Screw:
    """A turn by `angle` radians about the line through `centre` along the unit vector `axis`, with a move by `shift`
    mm, which is along the axis where it turns at all."""

    axis: Floats
    angle: float
    centre: Floats
    shift: Floats

    def part(self, share: float) -> Floats:
        """(4, 4) the share of the motion, 1 for all of it."""
        from scipy.spatial.transform import Rotation

        pose = np.eye(4)
        turn = Rotation.from_rotvec(share * self.angle * self.axis).as_matrix()
        pose[:3, :3] = turn
        pose[:3, 3] = self.centre - turn @ self.centre + share * self.shift
        return pose

    def longest_way(self, points: Floats) -> float:
        """Millimetres that the farthest going of points (n, 3) goes; all keep their distance from the axis."""
        away = points - self.centre
        away = away - (away @ self.axis)[:, None] * self.axis
        radius = float(np.sqrt(np.einsum("ij,ij->i", away, away).max(initial=0.0)))
        return float(np.hypot(np.linalg.norm(self.shift), self.angle * radius))


def screw_between(one: Floats, other: Floats) -> Screw:
    """The motion that takes a pose (4, 4) to another by the smaller turn."""
    from scipy.spatial.transform import Rotation

    turn = other[:3, :3] @ one[:3, :3].T
    move = other[:3, 3] - turn @ one[:3, 3]
    vector = Rotation.from_matrix(turn).as_rotvec()
    angle = float(np.linalg.norm(vector))
    if angle < LEAST_TURN:
        return Screw(np.array([0.0, 0.0, 1.0]), 0.0, np.zeros(3), other[:3, 3] - one[:3, 3])
    axis = vector / angle
    along = float(move @ axis) * axis
    across = move - along
    centre = 0.5 * (across + np.cross(axis, across) / np.tan(0.5 * angle))
    return Screw(axis, angle, centre, along)


def _rigid(poses: ArrayLike) -> Floats:
    found: Floats
    try:
        found = np.array(poses, np.float64)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.ndim != 3 or found.shape[1:] not in ((3, 4), (4, 4)) or not len(found):
        raise Refusal("a path is a list of poses, each a matrix of 3 or 4 rows of 4 numbers")
    if not np.isfinite(found).all():
        raise Refusal("a pose holds a number that is not finite")
    turns = found[:, :3, :3]
    fault = np.abs(turns @ turns.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    wrong = np.flatnonzero((fault > RIGID) | (np.linalg.det(turns) < 0.0))
    if len(wrong):
        raise Refusal(f"pose {int(wrong[0])} does more than turn and move: what goes along a path keeps its shape")
    full = np.tile(np.eye(4), (len(found), 1, 1))
    full[:, :3] = found[:, :3]
    return full
