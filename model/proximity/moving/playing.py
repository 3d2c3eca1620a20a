"""A motion step by step: where the parts are, which of them meet, and when the first do.

Pairs are pruned by boxes; trees are made once a shape and asked with poses; a pair whose parts have not moved against
each other is not asked again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...document.document import Document
from ...solid.tessellation import DEFAULT_TOLERANCE
from ...worker.shown import Message
from ..bodies import APART, TOUCHING
from ..motion import Motion
from .first_meeting import FirstContact, Told, first_between
from .moved import Stand, inverse_of, mapped, relation_moved
from .parts import MovingParts, Standing, boxes_of, motion_called, pairs_near
from .screws import Path

Floats = NDArray[np.float64]
HALVINGS = 12
"""Of the way between two steps, to find the time of a contact."""
STILL = 1e-13
"""The share of the coordinates below which two parts have not moved against each other."""


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """Two parts by number, and how the first stands to the second (see `bodies.Relation`).

    `place` (3,) in mm is where they are nearest, or where their surfaces meet. `asked` is the clearance in mm that it
    is too near for, 0 where nothing is asked.
    """

    one: int
    other: int
    kind: str
    gap: float
    points: Floats | None
    overlap: float | None
    place: Floats
    asked: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Played:
    """A motion in k = steps + 1 places: `times` (k,) in seconds, and the `touches` in each.

    Of n parts: their `ids`, `names`, and `moves` (k, n, 4, 4), the rigid motion from where the document has them;
    `recut` (k, n) tells where a part has another shape than there, and no motion. `first` is None where nothing meets
    that did not at the beginning.
    """

    motion: Motion
    ids: tuple[str, ...]
    names: tuple[str, ...]
    times: Floats
    moves: Floats
    recut: NDArray[np.bool_]
    touches: tuple[tuple[Touch, ...], ...]
    first: FirstContact | None
    messages: tuple[Message, ...]

    @property
    def moving(self) -> NDArray[np.bool_]:
        """(n,) which parts are not in one place all the time."""
        still = np.abs(self.moves - self.moves[:1]).max(axis=(0, 2, 3), initial=0.0) <= STILL
        return ~still | self.recut.any(axis=0)

    def is_new(self, touch: Touch) -> bool:
        """Whether two parts meet that did not at the beginning, or overlap at any time."""
        if touch.kind in (APART, TOUCHING):
            return touch.kind == TOUCHING and (touch.one, touch.other) not in _meeting_pairs(self.touches[0])
        return True

    def listed(self, share: float) -> tuple[Touch, ...]:
        """The contacts of the step at or before a share of the time, and the first one at its moment."""
        listed = self.touches[int(min(max(share, 0.0), 1.0) * self.motion.steps + 1e-9)]
        first = self.first
        if first is None or abs(share * self.motion.seconds - first.time) > 1e-9 * self.motion.seconds:
            return listed
        if (first.one, first.other) in _meeting_pairs(listed):
            return listed
        points = np.array([first.place, first.place])
        return (Touch(first.one, first.other, TOUCHING, 0.0, points, 0.0, first.place), *listed)

    def table(self, contacts: bool = True) -> dict[str, Any]:
        """Plain values, as JSON has them; without `contacts` the steps are left out."""
        motion, first = self.motion, self.first
        told: dict[str, Any] = {
            "motion": motion.name,
            "parameter": motion.parameter,
            "start": motion.start,
            "end": motion.end,
            "seconds": motion.seconds,
            "parts": len(self.ids),
            "moving": [name for name, moves in zip(self.names, self.moving.tolist(), strict=True) if moves],
            "first": None if first is None else {
                "time": first.time,
                "value": motion.value(first.time / motion.seconds),
                "a": self.names[first.one],
                "b": self.names[first.other],
                "place": first.place.tolist(),
            },
        }  # fmt: skip
        if contacts:
            told["steps"] = [
                {"time": time, "value": motion.value(k / motion.steps), "contacts": list(map(self._row, listed))}
                for k, (time, listed) in enumerate(zip(self.times.tolist(), self.touches, strict=True))
            ]
        return told

    def _row(self, touch: Touch) -> dict[str, Any]:
        return {
            "a": self.names[touch.one],
            "b": self.names[touch.other],
            "relation": touch.kind,
            "gap": touch.gap,
            "overlap_volume": touch.overlap,
            "points": None if touch.points is None else touch.points.tolist(),
        }

    def move(self, share: float) -> Floats:
        """(n, 4, 4) between the steps, at a share of the time, 0 to 1."""
        place = min(max(share, 0.0), 1.0) * (len(self.times) - 1)
        step = min(int(place), len(self.times) - 2)
        return blended(self.moves[step], self.moves[step + 1], place - step)


def blended(one: Floats, other: Floats, share: float) -> Floats:
    """(n, 4, 4) between rigid motions, by screws."""
    if share <= 0.0 or share >= 1.0:
        return one if share <= 0.0 else other
    changed = np.flatnonzero(np.abs(one - other).max(axis=(1, 2)) > 0.0)
    found = one.copy()
    for number in changed.tolist():
        found[number] = Path([one[number], other[number]], (0.0, 1.0)).pose(share)
    return found


def play(
    document: Document,
    name: str | None = None,
    tolerance: float = DEFAULT_TOLERANCE,
    told: Told | None = None,
    between: bool = False,
) -> Played:
    """Play a motion of a document, the only one or that of this name, without changing it; see `Played`.

    Looked at are pairs of visible solids. Listed are those that overlap, that touch and are not meant to, and that are
    nearer than the document's checks ask. The first contact is that of the pairs that meet in a step; with `between`
    all that come near are followed from step to step, but for parts that change their shape, so that nothing is jumped
    over. Raises Refusal.
    """
    motion = motion_called(document, name)
    steps = motion.steps
    tell = told or (lambda done, total, what: None)
    parts = MovingParts(document, motion, tolerance, lambda label: tell(0, 2 * steps, label))
    rest = parts.at_rest()
    standings = []
    for number in range(steps + 1):
        tell(number, 2 * steps, "Moving the parts")
        standings.append(parts.at(number / steps))
    look = _Look(parts, document)
    touches, early = [], None
    for number, standing in enumerate(standings):
        tell(steps + number, 2 * steps, "Looking for contacts")
        touches.append(look.touches(standing))
        if number and early is None:
            before, now = (_ranks(listed) for listed in touches[-2:])
            worse = {pair for pair, rank in now.items() if rank > before.get(pair, 0)}
            if between or worse:
                early = first_between(parts, standings, number, set(before), None if between else worse, tell)
                # Parts that change their shape, or touched already, are not followed: their way is halved.
                recut = standings[number - 1].shapes != standing.shapes
                left = worse if early is None else {p for p in worse if p in before or recut[list(p)].any()}
                if left:
                    early = _halved(look, number, left, before, touches[-1], early)
    count = len(parts.roots)
    moves = np.array([_from_rest(rest, standing) for standing in standings]).reshape(steps + 1, count, 4, 4)
    return Played(
        motion,
        tuple(root.id for root in parts.roots),
        parts.names,
        np.linspace(0.0, motion.seconds, steps + 1),
        moves,
        np.array([standing.shapes != rest.shapes for standing in standings]).reshape(steps + 1, count),
        tuple(touches),
        early,
        tuple(parts.messages),
    )


def _halved(
    look: _Look,
    number: int,
    pairs: set[tuple[int, int]],
    before: dict[tuple[int, int], int],
    listed: tuple[Touch, ...],
    early: FirstContact | None,
) -> FirstContact | None:
    """The first time between the step before and the `number`th at which some of the pairs are in a worse way than
    there, as they are in that step, by halving; `early` where that is earlier."""
    parts = look.parts
    motion = parts.motion
    low, high = (number - 1) / motion.steps, number / motion.steps
    found = [touch for touch in listed if (touch.one, touch.other) in pairs]
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        standing = parts.at(middle)
        seen = [touch for pair in sorted(pairs) if (touch := look.touch(*pair, standing)) is not None]
        worse = [touch for touch in seen if _rank(touch) > before.get((touch.one, touch.other), 0)]
        if worse:
            high, found = middle, worse
        else:
            low = middle
    time = high * motion.seconds
    if early is not None and early.time <= time:
        return early
    return FirstContact(time, found[0].one, found[0].other, found[0].place)


def _from_rest(rest: Standing, standing: Standing) -> Floats:
    """(n, 4, 4)"""
    turns = standing.poses[:, :3, :3] @ rest.poses[:, :3, :3].transpose(0, 2, 1)
    moves = np.tile(np.eye(4), (len(turns), 1, 1))
    moves[:, :3, :3] = turns
    moves[:, :3, 3] = standing.poses[:, :3, 3] - np.einsum("nij,nj->ni", turns, rest.poses[:, :3, 3])
    same = (standing.poses == rest.poses).all(axis=(1, 2)) | (standing.shapes != rest.shapes)
    moves[same] = np.eye(4)
    return moves


class _Look:
    """Contacts from step to step: what is known of a pair holds until one moves against the other."""

    def __init__(self, parts: MovingParts, document: Document) -> None:
        self.parts = parts
        checks = document.checks
        self._clearance = checks.clearance
        self._most = max([checks.clearance, *(pair.clearance or 0.0 for pair in checks.pairs)])
        place = {node_id: number for number, node_id in enumerate(root.id for root in parts.roots)}
        self._own = {
            tuple(sorted((place[pair.one], place[pair.other]))): pair
            for pair in checks.pairs
            if pair.one in place and pair.other in place
        }
        self._known: dict[tuple[int, int], tuple[int, int, Floats, Stand]] = {}

    def touches(self, standing: Standing) -> tuple[Touch, ...]:
        """The worst first: overlaps by their volume, then by gap."""
        boxes = boxes_of(self.parts.bodies, standing)
        found = []
        for one, other in pairs_near(boxes, 0.5 * self._most * (1.0 + 1e-9) + self._margin(boxes)):
            touch = self.touch(one, other, standing)
            if touch is not None:
                found.append(touch)
        found.sort(key=lambda touch: (touch.gap, -(touch.overlap or 0.0), touch.one, touch.other))
        return tuple(found)

    @staticmethod
    def _margin(boxes: Floats) -> float:
        return 1e-11 * float(np.nanmax(np.abs(boxes), initial=1.0))

    def touch(self, one: int, other: int, standing: Standing) -> Touch | None:
        """How a pair meets there; None where that is as asked."""
        own = self._own.get((one, other))
        asked = self._clearance if own is None else own.clearance
        asked = self._clearance if asked is None else asked
        touching = own is not None and own.touching
        limit = 0.0 if touching else asked
        stand = self._stand(one, other, standing, limit)
        relation = stand.relation
        if relation is None or (touching and relation.kind == TOUCHING):
            return None
        points = relation.points
        if points is not None:
            points = mapped(standing.poses[one], points)
        place = mapped(standing.poses[one], stand.ends).mean(axis=0)
        return Touch(one, other, relation.kind, relation.gap, points, relation.overlap, place, limit)

    def _stand(self, one: int, other: int, standing: Standing, limit: float) -> Stand:
        """In the axes of the first one's body."""
        shapes = int(standing.shapes[one]), int(standing.shapes[other])
        pose = inverse_of(standing.poses[one]) @ standing.poses[other]
        known = self._known.get((one, other))
        faces = None
        if known is not None and known[:2] == shapes:
            if np.abs(known[2] - pose).max() <= STILL * max(1.0, float(np.abs(pose).max())):
                return known[3]
            faces = known[3].faces
        bodies = self.parts.bodies
        stand = relation_moved(bodies[shapes[0]], bodies[shapes[1]], pose, limit, faces)
        self._known[one, other] = (*shapes, pose, stand)
        return stand


def _rank(touch: Touch) -> int:
    """The higher the worse."""
    return (APART, TOUCHING).index(touch.kind) if touch.kind in (APART, TOUCHING) else 2


def _ranks(touches: tuple[Touch, ...]) -> dict[tuple[int, int], int]:
    """Of the pairs that meet."""
    return {(touch.one, touch.other): _rank(touch) for touch in touches if touch.kind != APART}


def _meeting_pairs(touches: tuple[Touch, ...]) -> set[tuple[int, int]]:
    return {(touch.one, touch.other) for touch in touches if touch.kind != APART}
