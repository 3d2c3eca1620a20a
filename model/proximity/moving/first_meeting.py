"""When two parts of a motion first meet, between two of its steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..bodies import Body
from .moved import corners_of, inverse_of, mapped
from .parts import MovingParts, Standing, boxes_of, pairs_near
from .screws import Path
from .sweeping import advance, closeness

Floats = NDArray[np.float64]
Told = Callable[[int, int, str], None]
"""Hears how much of how much is done, and of what; may raise to stop."""

FINER = 16
"""Parts of the way between two steps when the time of the first contact is looked for."""
SLIDE = 4_000
"""Gaps that are looked at between two steps of a pair; what slides so near for so long counts as having met."""
DOUBLINGS = 6
"""How often the way between two steps is halved where parts do not go by the screw between its ends."""
ASIDE = 1e-6
"""The share of the parts' size by which they may go beside that."""


@dataclass(frozen=True, slots=True, eq=False)
class FirstContact:
    """The first meeting of two parts that did not at the beginning: `time` in seconds, at a `place` (3,) in mm."""

    time: float
    one: int
    other: int
    place: Floats


def first_between(
    parts: MovingParts,
    standings: list[Standing],
    number: int,
    met: set[tuple[int, int]],
    wanted: set[tuple[int, int]] | None,
    tell: Told,
) -> FirstContact | None:
    """The first meeting on the way from the step before to this one, the `number`th of all, of the wanted pairs (None:
    all) that have not `met` there already."""
    steps = len(standings) - 1
    ends = (number - 1) / steps, number / steps
    some = None if wanted is None else {part for pair in wanted for part in pair}
    way = _sampled(parts, standings[number - 1], standings[number], ends, some)
    bodies = parts.bodies
    shapes, poses = (np.array([getattr(standing, name) for standing in way]) for name in ("shapes", "poses"))
    boxes = np.array([boxes_of(bodies, standing) for standing in way])
    swept = np.stack((boxes[:, :, 0].min(axis=0), boxes[:, :, 1].max(axis=0)), axis=1)
    recut = (shapes != shapes[0]).any(axis=0)
    bulge = np.zeros(len(swept))
    moved = np.flatnonzero(~recut & (np.abs(poses - poses[0]).max(axis=(0, 2, 3)) > 0.0))
    for part in moved.tolist():  # what turns goes by an arc, which leaves the box of its ends
        path = Path(poses[:, part], np.arange(len(way)))
        if any(screw.angle > 0.0 for screw in path.screws):
            bulge[part] = 0.5 * float(path.speeds(corners_of(bodies[int(shapes[0, part])].bounds)).max())
    swept[:, 0] -= bulge[:, None]
    swept[:, 1] += bulge[:, None]
    goes = np.zeros(len(swept), bool)
    goes[moved] = True
    best: FirstContact | None = None
    until = 1.0
    for one, other in pairs_near(swept, 0.0) if wanted is None else sorted(wanted):
        if (one, other) in met or recut[one] or recut[other] or not (goes[one] or goes[other]):
            continue
        tell(steps + number, 2 * steps, f"{parts.names[one]}, {parts.names[other]}")
        first, second = bodies[int(shapes[0, one])], bodies[int(shapes[0, other])]
        shares = np.array(ends)
        found = _meeting(first, second, [_against(standing, one, other) for standing in way], until)
        if found is None:
            continue
        until = found[0]
        for _ in range(2):  # as the parts do go, where that is not quite the screw
            begin, end = shares
            share = begin + found[0] * (end - begin)
            width = (end - begin) / FINER
            around = np.clip([share - width, share + width], begin, end)
            finer = [
                _against(parts.at(float(part)), one, other) for part in np.linspace(around[0], around[1], FINER + 1)
            ]
            again = _meeting(first, second, finer, 1.0)
            if again is None:
                break
            found, shares = again, around
        begin, end = shares
        time = (begin + found[0] * (end - begin)) * parts.motion.seconds
        pose = parts.at(float(time / parts.motion.seconds)).poses[one]
        if best is None or time < best.time:
            best = FirstContact(float(time), one, other, mapped(pose, found[1][None])[0])
    return best


def _sampled(
    parts: MovingParts, last: Standing, now: Standing, ends: tuple[float, float], some: set[int] | None
) -> list[Standing]:
    """Evenly between two steps at shares of the motion, the steps included: so many that some parts, None: all, go by
    the screws between them."""
    found = [last, now]
    for _ in range(DOUBLINGS):
        shares = np.linspace(*ends, 2 * len(found) - 1)[1::2]
        middles = [parts.at(float(share)) for share in shares]
        legs = zip(found[:-1], middles, found[1:], strict=True)
        if not any(_beside(parts.bodies, *leg, some) for leg in legs):
            break
        found = [found[0], *(standing for pair in zip(middles, found[1:], strict=True) for standing in pair)]
    return found


def _beside(bodies: list[Body], one: Standing, middle: Standing, other: Standing, some: set[int] | None) -> bool:
    """Whether a part goes beside the screw from one standing to the other."""
    moves = np.abs(middle.poses - one.poses).max(axis=(1, 2)) + np.abs(other.poses - one.poses).max(axis=(1, 2))
    whole = (one.shapes == middle.shapes) & (one.shapes == other.shapes)
    for part in np.flatnonzero(whole & (moves > 0.0)).tolist():
        body = bodies[int(one.shapes[part])]
        if body.empty or (some is not None and part not in some):
            continue
        expected = Path([one.poses[part], other.poses[part]], (0.0, 1.0)).pose(0.5)
        corners = corners_of(body.bounds)
        aside = np.linalg.norm(mapped(expected, corners) - mapped(middle.poses[part], corners), axis=1).max()
        if aside > ASIDE * float(np.linalg.norm(np.ptp(body.bounds, axis=0))):
            return True
    return False


def _against(standing: Standing, one: int, other: int) -> Floats:
    """(4, 4) the other's pose in the first one's axes."""
    return inverse_of(standing.poses[one]) @ standing.poses[other]


def _meeting(one: Body, other: Body, poses: list[Floats], until: float) -> tuple[float, Floats] | None:
    """The share of the way at which the other, on these poses, meets the first, and where, in the first one's axes;
    None where they do not, or do from the beginning."""
    if np.abs(np.array(poses) - poses[0]).max() == 0.0:
        return None
    path = Path(poses, np.linspace(0.0, 1.0, len(poses)))
    near = closeness(one, other)
    start = one.tree.gap(other.tree, 4.0 * near, path.poses[0]).length
    if 0.0 < start < 4.0 * near:  # they begin nearer to each other than counts as a contact elsewhere
        near = start / 4.0
    passed = advance(other, one, path, near, until, most=SLIDE)
    met = passed.met or passed.looked >= SLIDE
    return (passed.time, passed.place) if met and passed.time > 0.0 else None
