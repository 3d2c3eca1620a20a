"""Contacts of parts that are dragged among others: where they meet, how far they may go, and how they slide along."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from .boxes import Floats
from .parts import Part
from .straight import Stop, Sweep

Kind = Literal["overlaps", "touches", "close", "near"]
KINDS: tuple[Kind, ...] = ("overlaps", "touches", "close", "near")
"""Worst first: `close` is nearer than the clearance, `near` is farther."""

MEETING = 1e-9
"""The share of the coordinates within which surfaces touch: what numbers in a document are rounded to."""
TURNS = 12
"""Contact planes that one move slides along, one after the other."""
LOOKS = 0.25
"""Degrees of a turn between two looks at what is so near that the gap allows less."""
HALVINGS = 40


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """A dragged part and one that stands; `gap` in mm, `points` (2, 3) its ends, the dragged one's last. Where they
    overlap the gap is 0 and the points are where their surfaces meet, None where one is inside the other."""

    moving: Part
    standing: Part
    kind: Kind
    gap: float
    points: Floats | None


class LiveContacts:
    """Of `dragged` parts among `standing` ones. `clearance` tells in mm what two of them, by their keys, have to keep;
    `reach` is how far away in mm others are told of.

    Poses (4, 4) are rigid and take all dragged parts from where their vertices are to where they are now. What they
    overlap at the pose they `begin` with they may go through, until they have come apart.
    """

    def __init__(
        self,
        standing: Sequence[Part],
        dragged: Sequence[Part],
        clearance: Callable[[str, str], float] = lambda one, other: 0.0,
        reach: float = 0.0,
    ) -> None:
        self.standing = [part for part in standing if not part.empty]
        self.dragged = [part for part in dragged if not part.empty]
        self._reach = reach
        self._clearances = {
            (part.key, other.key): clearance(part.key, other.key) for part in self.dragged for other in self.standing
        }
        self._farthest = max([reach, *self._clearances.values()])
        self._low, self._high = (np.array([part.bounds[k] for part in self.standing]).reshape(-1, 3) for k in range(2))
        self._faces: dict[tuple[str, str], tuple[int, int]] = {}
        self._through: frozenset[tuple[str, str]] = frozenset()
        self._sweeps: list[Sweep] = []
        self._let_through(())

    def begin(self, pose: ArrayLike | None = None) -> tuple[Contact, ...]:
        """The contacts there; what is overlapped may be gone through."""
        found = self.contacts(np.eye(4) if pose is None else pose)
        self._let_through(_ends(contact) for contact in found if contact.kind == "overlaps")
        return found

    def contacts(self, pose: ArrayLike) -> tuple[Contact, ...]:
        """What the dragged parts meet, and what is nearer than its clearance or the reach: worst and nearest first."""
        at = np.ascontiguousarray(pose, np.float64)
        found = [
            contact
            for part in self.dragged
            for number in self._within(part, at, self._farthest)
            if (contact := self._contact(part, self.standing[number], at)) is not None
        ]
        found.sort(key=lambda contact: (KINDS.index(contact.kind), contact.gap, contact.standing.key))
        return tuple(found)

    def came_apart(self, contacts: Sequence[Contact]) -> None:
        """Others than these are overlapped no more, and stop what is dragged from now on."""
        still = self._through & {_ends(contact) for contact in contacts if contact.kind == "overlaps"}
        if still != self._through:
            self._let_through(still)

    def stopped(self, by: ArrayLike, way: ArrayLike) -> tuple[Floats, Stop | None]:
        """How far (3,) the dragged parts, shifted by (3,) mm, come on a straight way (3,), and what stops them."""
        vector = np.array(way, np.float64)
        stop = self._first(np.array(by, np.float64), vector)
        return (vector if stop is None else _part(vector, stop)), stop

    def slid(self, by: ArrayLike, way: ArrayLike, within: ArrayLike | None = None) -> tuple[Floats, Stop | None]:
        """The same where what is left of the way is gone along the planes of the contacts, as far as that leads on.

        `within` (k, 3) are unit vectors at right angles, in whose span the parts stay.
        """
        start, left = np.array(by, np.float64), np.array(way, np.float64)
        span = np.eye(3) if within is None else np.reshape(np.asarray(within, np.float64), (-1, 3))
        whole, gone, normals = left.copy(), np.zeros(3), []
        last: Stop | None = None
        tiny = 1e-12 * max(float(np.linalg.norm(whole)), 1e-3)
        for _ in range(TURNS):
            stop = self._first(start + gone, left)
            if stop is None:
                return gone + left, last
            step, last = _part(left, stop), stop
            gone = gone + step
            if np.linalg.norm(step) > tiny:
                normals = []
            normals.append(stop.normal)
            left = _along(left - step, normals, span)
            if np.linalg.norm(left) <= tiny or left @ whole <= 0.0:
                break
        return gone, last

    def turned(self, poses: Callable[[float], Floats], start: float, end: float, about: Floats) -> float:
        """The last angle from `start` on towards `end`, in degrees, at which nothing is overlapped; `poses` gives the
        pose of an angle, `about` (3,) is a point of the axis.

        By conservative advancement (Mirtich 1996): no point moves farther than its way from the axis lets it. Where the
        gap allows less than a quarter of a degree it is looked at that often; what touches at the start may be
        overlapped by as much as `Part.shrunk` is smaller.
        """
        reach = max((self._radius(part, poses(start), about) for part in self.dragged), default=0.0)
        if start == end or not reach:
            return end
        meets = {_ends(one) for one in self.contacts(poses(start)) if one.kind == "touches"}
        sign, at = np.sign(end - start), start
        while at != end:
            gap = self._free(poses(at), meets, np.radians(abs(end - at)) * reach)
            step = max(float(np.degrees(gap / reach)), LOOKS)
            to = end if step >= abs(end - at) else at + sign * step
            if self._free(poses(to), meets) >= 0.0:
                at = to
                continue
            free, blocked = at, to
            for _ in range(HALVINGS):
                middle = (free + blocked) / 2.0
                if self._free(poses(middle), meets) >= 0.0:
                    free = middle
                else:
                    blocked = middle
            return free
        return end

    def _within(self, part: Part, pose: Floats, limit: float) -> list[int]:
        """Places of standing parts whose boxes come within a limit."""
        middle, half = part.bounds.mean(axis=0), np.ptp(part.bounds, axis=0) / 2.0
        centre, across = pose[:3, :3] @ middle + pose[:3, 3], np.abs(pose[:3, :3]) @ half
        low, high = centre - across - limit, centre + across + limit
        return np.flatnonzero(((self._low <= high) & (self._high >= low)).all(axis=1)).tolist()

    def _contact(self, part: Part, other: Part, pose: Floats) -> Contact | None:
        ends = part.key, other.key
        clearance = self._clearances[ends]
        near = MEETING * max(part.scale, other.scale)
        limit = max(clearance, self._reach, 2.0 * near)
        gap = other.tree.gap(part.tree, limit, pose, self._faces.get(ends))
        if gap.faces[0] >= 0:
            self._faces[ends] = gap.faces
        points = np.array([gap.a, gap.b])
        if gap.length <= near:
            through = part.has_inside and other.has_inside and self._overlaps(part, other, pose)
            return Contact(part, other, "overlaps" if through else "touches", 0.0, points)
        if self._inside(part, other, pose):
            return Contact(part, other, "overlaps", 0.0, None)
        if not np.isfinite(gap.length):
            return None
        return Contact(part, other, "close" if gap.length < clearance - near else "near", gap.length, points)

    def _overlaps(self, part: Part, other: Part, pose: Floats) -> bool:
        """Whether surfaces that meet go deeper than the shrinking: `shrunk` meets the other one, too, or is inside."""
        return other.tree.gap(part.shrunk, MEETING * part.scale, pose).length == 0.0 or self._inside(part, other, pose)

    def _inside(self, part: Part, other: Part, pose: Floats) -> bool:
        """Whether a piece of one, shrunk, lies inside the other, where their surfaces do not meet."""
        if not (part.has_inside and other.has_inside):
            return False
        marks = part.landmarks @ pose[:3, :3].T + pose[:3, 3]
        low, high = other.bounds
        boxed = ((marks > low) & (marks < high)).all(axis=1)
        if boxed.any() and self._held(other, part, marks[boxed], pose, True):
            return True
        back = (other.landmarks - pose[:3, 3]) @ pose[:3, :3]
        low, high = part.bounds
        boxed = ((back > low) & (back < high)).all(axis=1)
        return bool(boxed.any()) and self._held(part, other, back[boxed], pose, False)

    def _held(self, holder: Part, held: Part, marks: Floats, pose: Floats, standing: bool) -> bool:
        """Whether marks (k, 3), in the holder's space, are inside it and not merely on its surface."""
        inside = holder.tree.windings(marks) > 0
        if not inside.any():
            return False
        away = holder.tree.nearest(marks[inside]).distances
        return bool((away > MEETING * max(holder.scale, held.scale)).any())

    def _let_through(self, pairs: Iterable[tuple[str, str]]) -> None:
        """Only the other pairs stop each other from now on."""
        self._through = frozenset(pairs)
        self._sweeps = [
            Sweep(part, [other for other in self.standing if (part.key, other.key) not in self._through])
            for part in self.dragged
        ]

    def _first(self, by: Floats, way: Floats) -> Stop | None:
        """What stops the dragged parts first."""
        stops = [stop for sweep in self._sweeps if (stop := sweep.stop(by, way)) is not None]
        return min(stops, key=lambda stop: stop.way, default=None)

    def _free(self, pose: Floats, meets: Collection[tuple[str, str]], limit: float = 0.0) -> float:
        """The least gap below the limit, else that; less than 0 where something is overlapped. Those of the pairs that
        `meets` names are of the shrunk parts."""
        least = limit
        for part in self.dragged:
            for number in self._within(part, pose, limit):
                other = self.standing[number]
                ends = part.key, other.key
                if ends in self._through:
                    continue
                tree = part.shrunk if ends in meets else part.tree
                gap = other.tree.gap(tree, max(least, MEETING * part.scale), pose).length
                if gap == 0.0 or self._inside(part, other, pose):
                    return -1.0
                least = min(least, gap)
        return least

    @staticmethod
    def _radius(part: Part, pose: Floats, about: Floats) -> float:
        centre = pose[:3, :3] @ part.bounds.mean(axis=0) + pose[:3, 3]
        return float(np.linalg.norm(centre - about) + np.linalg.norm(np.ptp(part.bounds, axis=0)) / 2.0)


def _ends(contact: Contact) -> tuple[str, str]:
    return contact.moving.key, contact.standing.key


def _part(way: Floats, stop: Stop) -> Floats:
    """What of a way (3,) is gone where it is stopped; nothing of it is lost to rounding along one axis."""
    return way * (stop.way / float(np.linalg.norm(way)))


def _along(way: Floats, normals: Sequence[Floats], span: Floats) -> Floats:
    """What of a way (3,) goes against none of the planes with these normals, within a span (k, 3): the longest of the
    ways along one of them, or along the line where two meet."""
    flat = [normal @ span.T @ span for normal in normals]
    planes = [normal / size for normal in flat if (size := float(np.linalg.norm(normal))) > 1e-9]
    if len(planes) < len(flat) or len(span) < 2:
        return np.zeros(3)
    ways = [way - (way @ normal) * normal for normal in planes]
    if len(span) == 3:
        for one, other in combinations(planes, 2):
            line = np.cross(one, other)
            size = float(np.linalg.norm(line))
            if size > 1e-9:
                ways.append((way @ line) * line / size**2)
    tolerance = 1e-9 * float(np.linalg.norm(way))
    free = [one for one in ways if all(one @ normal >= -tolerance for normal in planes)]
    return max(free, key=lambda one: float(one @ one), default=np.zeros(3))
