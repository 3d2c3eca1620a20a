"""When a body that moves along a path first meets others: by conservative advancement, so that nothing is jumped over.

At every moment the gap says how long nothing can happen, since no point is faster than a known speed (Mirtich 1996,
"Impulse-based dynamic simulation of rigid body systems"; Zhang, Lee and Kim 2006, "Interactive continuous collision
detection for non-convex polyhedra", for turning bodies). The parts go by screws (see screws.py), on which every point
keeps its distance from the axis, so that the bound is the true speed of the farthest one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...document.errors import Refusal
from ..bodies import APART, TOUCHING, Body
from .moved import relation_moved
from .screws import Path

Floats = NDArray[np.float64]

CLOSE = 1e-6
"""The share of the bodies' size within which they have met, where no tolerance is given."""
MOST = 20_000
"""Gaps that are looked at on the way of one body past another."""


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """The first meeting: `time` in the path's unit, `other` the number of the body that is met, `place` (3,) in mm.

    `kind` is "touching", or where they overlap or hold each other at the very beginning what `bodies.relation` says;
    `place` is None then. `gap` in mm is what was left between the surfaces, below the tolerance.
    """

    time: float
    other: int
    place: Floats | None
    kind: str = TOUCHING
    gap: float = 0.0


def first_contact(
    moving: Body,
    standing: Sequence[Body],
    poses: ArrayLike,
    times: ArrayLike,
    tolerance: float | None = None,
    told: Callable[[int, int], None] | None = None,
) -> Contact | None:
    """When a body, taken along the poses (k, 4, 4) at rising times (k,), first meets one of the others; None: never.

    A pose takes the body from where it is given to where it is at that time. They have met where the gap is at most
    `tolerance` mm, by default a millionth of their size: the time is early by at most what that gap takes to close.
    `told` hears how many of the others are done, and may raise to stop. Raises Refusal for a path that is none, and for
    one along which a body slides so near to another that the question has no end.
    """
    path = Path(poses, times)
    if tolerance is not None and not 0.0 < tolerance < np.inf:
        raise Refusal(f"a tolerance is more than 0 mm, and finite, not {tolerance}")
    first: Contact | None = None
    until = float(path.times[-1])
    for number, other in enumerate(standing):
        if told is not None:
            told(number, len(standing))
        found = meeting(moving, other, path, tolerance or closeness(moving, other), until)
        if found is not None and (first is None or found.time < first.time):
            first, until = Contact(found.time, number, found.place, found.kind, found.gap), found.time
    return first


def closeness(one: Body, other: Body) -> float:
    """The tolerance in mm where none is given."""
    sizes = [float(np.linalg.norm(np.ptp(body.bounds, axis=0))) for body in (one, other) if not body.empty]
    return CLOSE * max(sizes, default=1.0)


def meeting(moving: Body, other: Body, path: Path, tolerance: float, until: float = np.inf) -> Contact | None:
    """See `first_contact`, of one other body, looking no further than the time `until`."""
    if moving.empty or other.empty:
        return None
    start = float(path.times[0])
    stand = relation_moved(other, moving, path.poses[0])
    found, faces = stand.relation, stand.faces
    assert found is not None
    if found.kind != APART:
        return Contact(start, 0, None if found.points is None else found.points[0], found.kind)
    passed = advance(moving, other, path, tolerance, min(until, float(path.times[-1])), faces)
    if passed.looked >= MOST:
        raise Refusal(
            f"“{moving.name}” slides past “{other.name}” within {passed.gap:g} mm for too long: "
            f"ask with a larger tolerance than {tolerance:g} mm"
        )
    return Contact(passed.time, 0, passed.place, TOUCHING, passed.gap) if passed.met else None


@dataclass(frozen=True, slots=True, eq=False)
class Passage:
    """How far an advancement came: the `time`, the `gap` there with its end on the other body, whether they have met,
    and how many gaps were looked at."""

    time: float
    gap: float
    place: Floats
    met: bool
    looked: int


def advance(
    moving: Body,
    other: Body,
    path: Path,
    tolerance: float,
    until: float,
    first: tuple[int, int] | None = None,
    most: int = MOST,
) -> Passage:
    """Go on from the beginning of the path for as long as bodies that are apart there stay apart, at most to `until`
    and for `most` looks. They never are nearer than the gap at the end, within the tolerance in mm."""
    speeds = path.speeds(outermost(moving))
    spans = np.diff(path.times)
    left = np.append(np.cumsum((speeds * spans)[::-1])[::-1], 0.0)  # (k,) mm still to go from each pose
    time, leg, faces, looked = float(path.times[0]), 0, first, 0
    gap, place = np.inf, np.zeros(3)
    while True:
        pose = path.along(leg, time) if leg < len(speeds) else path.poses[-1]
        rest = 0.0 if leg == len(speeds) else left[leg + 1] + speeds[leg] * (path.times[leg + 1] - time)
        found = other.tree.gap(moving.tree, rest + 2.0 * tolerance, pose, faces)
        looked += 1
        if not np.isfinite(found.length):  # farther than all of the way that is left
            return Passage(until, np.inf, place, False, looked)
        gap, place, faces = found.length, found.a, found.faces
        if gap <= tolerance:
            return Passage(float(time), gap, place, True, looked)
        if looked >= most:
            return Passage(float(time), gap, place, False, looked)
        free = gap - 0.5 * tolerance
        while leg < len(speeds):  # spend what is free, leg by leg
            need = speeds[leg] * (path.times[leg + 1] - time)
            if need > free:
                time += free / speeds[leg]
                break
            free -= need
            leg += 1
            time = float(path.times[leg])
        if leg == len(speeds) or time >= until:
            return Passage(until, gap, place, False, looked)


def outermost(body: Body) -> Floats:
    """(n, 3) vertices whose hull is that of the body: those of a small body as they are."""
    used = body.vertices[np.unique(body.triangles)]
    if len(used) <= 64 or body.solid is None:
        return used
    return np.asarray(body.solid.hull().to_mesh64().vert_properties)[:, :3]
