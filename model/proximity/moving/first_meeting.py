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
SLIDE = 20_000
"""Gaps that are looked at between two steps of a pair; what slides so near for so long counts as having met."""


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
    last, now = standings[number - 1], standings[number]
    steps = len(standings) - 1
    bodies = parts.bodies
    both = np.array([boxes_of(bodies, last), boxes_of(bodies, now)])
    swept = np.stack((both[:, :, 0].min(axis=0), both[:, :, 1].max(axis=0)), axis=1)
    bulge = np.zeros(len(swept))
    moved = np.flatnonzero((last.shapes == now.shapes) & (np.abs(last.poses - now.poses).max(axis=(1, 2)) > 0.0))
    for part in moved.tolist():  # what turns goes by an arc, which leaves the box of its ends
        path = Path([last.poses[part], now.poses[part]], (0.0, 1.0))
        if path.screws[0].angle > 0.0:
            bulge[part] = 0.5 * float(path.speeds(corners_of(bodies[int(last.shapes[part])].bounds))[0])
    swept[:, 0] -= bulge[:, None]
    swept[:, 1] += bulge[:, None]
    goes = np.zeros(len(swept), bool)
    goes[moved] = True
    best: FirstContact | None = None
    until = 1.0
    for one, other in pairs_near(swept, 0.0) if wanted is None else sorted(wanted):
        recut = last.shapes[one] != now.shapes[one] or last.shapes[other] != now.shapes[other]
        if (one, other) in met or recut or not (goes[one] or goes[other]):
            continue
        tell(steps + number, 2 * steps, f"{parts.names[one]}, {parts.names[other]}")
        first, second = bodies[int(now.shapes[one])], bodies[int(now.shapes[other])]
        shares = np.array([number - 1, number]) / steps
        found = _meeting(first, second, [_against(standing, one, other) for standing in (last, now)], until)
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


def _against(standing: Standing, one: int, other: int) -> Floats:
    """(4, 4) the other's pose in the first one's axes."""
    return inverse_of(standing.poses[one]) @ standing.poses[other]


def _meeting(one: Body, other: Body, poses: list[Floats], until: float) -> tuple[float, Floats] | None:
    """The share of the way at which the other, on these poses, meets the first, and where, in the first one's axes;
    None where they do not, or do from the beginning."""
    if np.abs(np.array(poses) - poses[0]).max() == 0.0:
        return None
    path = Path(poses, np.linspace(0.0, 1.0, len(poses)))
    passed = advance(other, one, path, closeness(one, other), until, most=SLIDE)
    return (passed.time, passed.place) if passed.met and passed.time > 0.0 else None
