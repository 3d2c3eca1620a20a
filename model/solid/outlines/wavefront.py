"""A polygon whose sides move inwards, or outwards, all at the same speed: where its corners go, meet and part.

The traces of the corners are the arcs of the straight skeleton (Aichholzer, Aurenhammer, Alberts and Gärtner 1995). An
event is one of three: a side has shrunk to a point; a corner that points the way the wave goes has come upon a side;
two sides have met along their whole length, as under the ridge of a roof.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

OPPOSITE = 1e-13
"""1 + the cosine between the normals of two sides; below this they face each other."""
SLACK = 1e-9
"""Share of the size by which a corner may miss the end of a side and still meets it."""
AT_ONCE = 1_000_000
"""Pairs of a corner and a side that are looked at in one go."""


class Wavefront:
    """Corners in linked rings; each begins a side, and the places where corners begin and end are nodes.

    `side` is 1 for sides that move to their left, into what counter-clockwise rings enclose, -1 for the other way.
    After `run` the traces are in `arcs`: rows (face, node, node), so that the arcs of each face, a face for each side
    that there was at first, go round it counter-clockwise as seen from outside; each arc has its opposite in another
    face. `lid` has the rings that are left, as numbers of nodes.
    """

    def __init__(self, rings: Sequence[Floats], side: float) -> None:
        points = np.concatenate(rings)
        count = len(points)
        self.size = float(np.ptp(points, axis=0).max())
        ends = np.cumsum([len(ring) for ring in rings])
        numbers = np.arange(count)
        after, before = numbers + 1, numbers - 1
        after[ends - 1] = np.append(0, ends[:-1])
        before[after] = numbers
        along = points[after] - points
        self.along = along / np.linalg.norm(along, axis=1, keepdims=True)  # (faces, 2)
        self.normal = side * np.column_stack((-self.along[:, 1], self.along[:, 0]))  # (faces, 2) the way they move
        self.side = side
        self.way = 0.0
        room = 5 * count + 64
        self.count = count
        self.before, self.after = _grown(before, room), _grown(after, room)
        self.arriving, self.leaving = _grown(before, room), _grown(numbers, room)  # the faces of the sides
        self.birth = _grown(numbers, room)
        self.place, self.since = _grown(points, room), np.zeros(room)
        self.speed = np.zeros((room, 2))
        self.alive = np.arange(room) < count
        self.sharp = np.zeros(room, bool)  # points the way that the wave goes
        self.zipping = np.zeros(room, bool)
        self.gone = np.full(room, np.inf)  # when the side that a corner begins has shrunk to a point
        self.struck = np.full(room, np.inf)  # when a corner comes upon a side
        self.target = np.full(room, -1)  # and the corner that begins that side
        self.nodes: list[tuple[float, float, float]] = [(x, y, 0.0) for x, y in points.tolist()]
        self.arcs: list[tuple[int, int, int]] = [(k, k, int(after[k])) for k in range(count)]
        self.lid: list[list[int]] = []
        self._set_off(numbers)
        for corner in numbers[self.zipping[:count]].tolist():
            self._zip(corner)
        self._look(numbers[self.sharp[:count]])

    def run(self, end: float) -> bool:
        """On until the sides have moved by `end` mm, or are all gone; False where more happens than has room."""
        while self.count + 2 <= len(self.alive):
            live = self.alive[: self.count]
            if not live.any():
                return True
            side, corner = int(np.argmin(self.gone[: self.count])), int(np.argmin(self.struck[: self.count]))
            when = min(self.gone[side], self.struck[corner])
            if when >= end:
                self._close(end)
                return True
            self.way = max(self.way, float(when))
            if self.gone[side] <= self.struck[corner] + 1e-12 * self.size:
                self._shrunk(side)
            else:
                self._split(corner, int(self.target[corner]))
        return False

    # Events.

    def _shrunk(self, first: int) -> None:
        """The side from a corner to the next is gone; its neighbours meet."""
        second = int(self.after[first])
        ends = self.at(np.array([first, second]))
        if self.zipping[first]:
            place = ends[1]
        elif self.zipping[second]:
            place = ends[0]
        else:
            place = ends.mean(axis=0)
        node = self._node(place)
        self._end(first, node)
        self._end(second, node)
        self._begin(
            [(int(self.before[first]), int(self.after[second]), int(self.arriving[first]), int(self.leaving[second]))],
            node,
        )

    def _split(self, corner: int, begin: int) -> None:
        """A corner has come upon the side that begins at another corner."""
        end, face = int(self.after[begin]), int(self.leaving[begin])
        node = self._node(self.at(np.array([corner]))[0])
        self._end(corner, node)
        self._begin(
            [
                (int(self.before[corner]), end, int(self.arriving[corner]), face),
                (begin, int(self.after[corner]), face, int(self.leaving[corner])),
            ],
            node,
        )

    def _begin(self, corners: list[tuple[int, int, int, int]], node: int) -> None:
        """New corners at a node: the corner before, the one after, the faces on both sides."""
        new = np.arange(self.count, self.count + len(corners))
        self.count += len(corners)
        for number, (before, after, arriving, leaving) in zip(new.tolist(), corners, strict=True):
            self.before[number], self.after[number] = before, after
            self.after[before] = self.before[after] = number
            self.arriving[number], self.leaving[number] = arriving, leaving
            self.birth[number], self.place[number], self.since[number] = node, self.nodes[node][:2], self.way
            self.alive[number] = True
        self._set_off(new)
        left = []
        for number in new.tolist():
            if self.alive[number] and self.after[self.after[number]] == number:
                self._ridge(number)
            elif self.alive[number]:
                left.append(number)
        for number in left:
            if self.zipping[number]:
                self._zip(number)
        changed = np.unique([*left, *(int(self.before[number]) for number in left)]).astype(np.intp)
        self._look_again(changed, np.array([number for number in left if self.sharp[number]], np.intp))

    def _ridge(self, first: int) -> None:
        """Two sides are all that is left of a ring: they lie on each other."""
        second = int(self.after[first])
        here, there = self.at(np.array([first, second]))
        one = int(self.birth[first]) if self.since[first] == self.way else self._node(here)
        other = one if np.abs(here - there).max() <= 1e-12 * self.size else self._node(there)
        self._end(first, one)
        self._end(second, other)
        if one != other:
            self.arcs += [(int(self.leaving[first]), other, one), (int(self.leaving[second]), one, other)]

    def _zip(self, corner: int) -> None:
        """The sides of a corner have met: the shorter is gone at once, as far as its other end."""
        before, after = int(self.before[corner]), int(self.after[corner])
        here, back, on = self.at(np.array([corner, before, after]))
        shorter = before if ((back - here) ** 2).sum() <= ((on - here) ** 2).sum() else corner
        self.gone[before] = self.gone[corner] = np.inf
        self.gone[shorter] = self.way

    def _end(self, corner: int, node: int) -> None:
        birth = int(self.birth[corner])
        if birth != node:
            self.arcs += [(int(self.arriving[corner]), birth, node), (int(self.leaving[corner]), node, birth)]
        self.alive[corner] = False
        self.gone[corner] = self.struck[corner] = np.inf

    def _close(self, end: float) -> None:
        self.way = end
        left = np.flatnonzero(self.alive[: self.count])
        places = self.at(left)
        top = dict(zip(left.tolist(), (self._node(place) for place in places), strict=True))
        waiting = set(top)
        while waiting:
            first = here = waiting.pop()
            ring = [first]
            while (here := int(self.after[here])) != first:
                waiting.discard(here)
                ring.append(here)
            self.lid.append([top[corner] for corner in ring])
            self.arcs += [(int(self.leaving[c]), top[int(self.after[c])], top[c]) for c in ring]
        for corner, node in top.items():
            self._end(corner, node)

    # Motion.

    def at(self, corners: Numbers) -> Floats:
        """(k, 2) where corners are now."""
        return self.place[corners] + (self.way - self.since[corners])[:, None] * self.speed[corners]

    def _node(self, place: Floats) -> int:
        self.nodes.append((float(place[0]), float(place[1]), self.way))
        return len(self.nodes) - 1

    def _set_off(self, corners: Numbers) -> None:
        """How corners move from now, and when the sides are gone that end or begin there."""
        one, other = self.normal[self.arriving[corners]], self.normal[self.leaving[corners]]
        share = 1.0 + (one * other).sum(axis=1)
        first, then = self.along[self.arriving[corners]], self.along[self.leaving[corners]]
        turn = self.side * (first[:, 0] * then[:, 1] - first[:, 1] * then[:, 0])
        self.zipping[corners] = (share < OPPOSITE) & ((turn >= 0.0) | (corners >= len(self.along)))
        self.sharp[corners] = (turn < 0.0) & ~self.zipping[corners]
        self.speed[corners] = (one + other) / np.maximum(share, OPPOSITE)[:, None]
        self.speed[corners[self.zipping[corners]]] = 0.0
        begin = np.unique(np.concatenate([corners, self.before[corners]]))
        end = self.after[begin]
        along = self.along[self.leaving[begin]]
        length = ((self.at(end) - self.at(begin)) * along).sum(axis=1)
        growth = ((self.speed[end] - self.speed[begin]) * along).sum(axis=1)
        shrinking = growth < -1e-14
        wait = np.maximum(length, 0.0) / np.where(shrinking, -growth, 1.0)
        self.gone[begin] = np.where(shrinking, self.way + wait, np.inf)
        self.gone[begin[self.zipping[begin] | self.zipping[end]]] = np.inf

    def _look_again(self, changed: Numbers, new: Numbers) -> None:
        """After the sides from `changed` corners have changed, and sharp corners have begun."""
        sharp = np.flatnonzero(self.sharp[: self.count] & self.alive[: self.count])
        target = self.target[sharp]
        lost = (target >= 0) & (~self.alive[target] | np.isin(target, changed))
        again = lost | np.isin(sharp, new)
        rest = sharp[~again]
        if len(rest) and len(changed):
            when = self._meetings(rest, changed)
            best = np.argmin(when, axis=1)
            earliest = when[np.arange(len(rest)), best]
            sooner = earliest < self.struck[rest]
            self.struck[rest[sooner]], self.target[rest[sooner]] = earliest[sooner], changed[best[sooner]]
        self._look(sharp[again])

    def _look(self, corners: Numbers) -> None:
        """The first side that each corner will come upon."""
        sides = np.flatnonzero(self.alive[: self.count])
        for rows in np.array_split(corners, max(len(corners) * len(sides) // AT_ONCE, 1)) if len(corners) else ():
            when = self._meetings(rows, sides)
            best = np.argmin(when, axis=1)
            self.struck[rows] = when[np.arange(len(rows)), best]
            self.target[rows] = np.where(np.isfinite(self.struck[rows]), sides[best], -1)

    def _meetings(self, corners: Numbers, sides: Numbers) -> Floats:
        """(c, s) when corners come upon the sides that begin at others; infinite where they do not.

        A corner meets the neighbours of its own sides only where these are gone.
        """
        ends = self.after[sides]
        normal, along = self.normal[self.leaving[sides]], self.along[self.leaving[sides]]
        here, begin, end = self.at(corners), self.at(sides), self.at(ends)
        gap = here @ normal.T - (begin * normal).sum(axis=1)
        closing = 1.0 - self.speed[corners] @ normal.T
        slack = SLACK * self.size
        with np.errstate(divide="ignore", invalid="ignore"):
            wait = np.where((closing > 1e-12) & (gap > -1e-3 * slack), np.maximum(gap, 0.0) / closing, np.inf)
        before, after = self.before[corners], self.after[corners]
        own = sides == np.stack((corners, before, after, self.before[before]))[..., None]
        wait[own.any(axis=0)] = np.inf
        row, column = np.nonzero(np.isfinite(wait))
        time = wait[row, column][:, None]
        place = here[row] + time * self.speed[corners[row]]
        low = ((place - begin[column] - time * self.speed[sides[column]]) * along[column]).sum(axis=1)
        high = ((end[column] + time * self.speed[ends[column]] - place) * along[column]).sum(axis=1)
        missed = (low < -slack) | (high < -slack)
        wait[row[missed], column[missed]] = np.inf
        return self.way + wait


def _grown(array: NDArray, room: int) -> NDArray:
    result = np.zeros((room, *array.shape[1:]), array.dtype)
    result[: len(array)] = array
    return result
