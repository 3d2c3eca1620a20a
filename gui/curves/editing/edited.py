"""An outline as it is edited: its nodes, handles and curves in arrays, in its own axes and in the world."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ....model.document.nodes import Node
from ....model.document.outlines import Bezier, BSpline
from ....model.path.flatten import chords
from ....model.path.path import Kind, Path
from ....render.curves.curve_marks import CurvePicture, Shape
from ..active import Place

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]
Flags = NDArray[np.bool_]

FINEST = 2e-6
"""Of an outline's size: chords are not finer, however near the eye is."""
MOST = 1000
"""Chosen nodes of which more are shown without their handles, which would cover everything."""
ARM = 1e-9
"""Of an outline's size: a handle that is nearer to its node lies on it."""


@dataclass(frozen=True, eq=False)
class Sides:
    """The curve as short lines: `own` (m, 2, d), `world` (m, 2, 3), the segment (m,) of each, and the parameters
    (m, 2) that it begins and ends with there."""

    own: Floats
    world: Floats
    segment: Numbers
    parameter: Floats


@dataclass(eq=False)
class Edited:
    """`node` is resolved and `path` has its curves; `frame` (3, 4) takes its axes to the world.

    `places` (k, d) and `rows` are those of ActiveCurve: nodes, or the control points of a Bezier curve or B-spline.
    """

    node: Node
    path: Path
    frame: Floats
    places: Floats
    rows: list[Place]

    @property
    def by_points(self) -> bool:
        return isinstance(self.node, (Bezier, BSpline))

    @property
    def dimension(self) -> int:
        return self.places.shape[1]

    @cached_property
    def size(self) -> float:
        """mm, the longer side of a box around the nodes."""
        return max(float(np.ptp(self.places, axis=0).max()), 1e-9) if len(self.places) else 1.0

    def world(self, points: Floats) -> Floats:
        """(n, 3) of points (n, d)."""
        return points @ self.frame[:, : points.shape[1]].T + self.frame[:, 3]

    @cached_property
    def nodes(self) -> Floats:
        """(k, 3)"""
        return self.world(self.places)

    @cached_property
    def first(self) -> Numbers:
        """(c + 1,) the number among all nodes at which those of each contour begin."""
        if self.by_points:
            return np.array([0, len(self.places)])
        return np.cumsum([0, *(len(contour.nodes) for contour in self.path.contours)])

    def number(self, place: Place) -> int:
        """The row of `places` that a node is in."""
        return int(self.first[place[0]]) + place[1]

    def flags(self, chosen: frozenset[Place]) -> Flags:
        """(k,) which nodes are chosen."""
        found = np.zeros(len(self.places), bool)
        if chosen:
            contour, number = np.array(sorted(chosen)).T
            found[self.first[contour] + number] = True
        return found

    # Segments.

    @cached_property
    def segment_rows(self) -> Numbers:
        """(s, 2) contour and number of every segment of the path."""
        rows = [np.column_stack((np.full(len(c), i), np.arange(len(c)))) for i, c in enumerate(self.path.contours)]
        return np.concatenate([np.zeros((0, 2), np.intp), *rows])

    @cached_property
    def segment_nodes(self) -> Numbers:
        """(s, 2) the rows of `places` where each segment of a Path begins and ends."""
        found = [np.zeros((0, 2), np.intp)]
        for begin, contour in zip(self.first.tolist(), self.path.contours, strict=False):
            number = np.arange(len(contour))
            found.append(begin + np.column_stack((number, (number + 1) % len(contour.nodes))))
        return np.concatenate(found)

    @cached_property
    def _handles(self) -> tuple[Floats, Numbers, Numbers]:
        """Handles (h, d), contour and row in its points (h, 2), and arms (a, 2): a handle and the row of its node."""
        places, rows, arms = [np.zeros((0, self.dimension))], [np.zeros((0, 2), np.intp)], [np.zeros((0, 2), np.intp)]
        count = 0
        for number, (begin, contour) in enumerate(zip(self.first.tolist(), self.path.contours, strict=False)):
            starts, kinds = contour.starts[:-1], contour.kinds
            cubic, quadratic = np.flatnonzero(kinds == Kind.CUBIC), np.flatnonzero(kinds == Kind.QUADRATIC)
            row = np.concatenate((starts[cubic] + 1, starts[cubic] + 2, starts[quadratic] + 1))
            after, before = np.concatenate((cubic, quadratic)), np.concatenate((cubic + 1, quadratic + 1))
            own = np.arange(len(row))
            c, q = len(cubic), len(quadratic)
            handle = np.concatenate((own[:c], own[2 * c :], own[c : 2 * c], own[2 * c :]))
            node = np.concatenate((after, before % len(contour.nodes)))
            places.append(contour.points[row])
            rows.append(np.column_stack((np.full(len(row), number), row)))
            arms.append(np.column_stack((count + handle, begin + node)))
            count += 2 * c + q
        return np.concatenate(places), np.concatenate(rows), np.concatenate(arms)

    @cached_property
    def handles(self) -> Floats:
        """(h, d) in its own axes."""
        return np.zeros((0, self.dimension)) if self.by_points else self._handles[0]

    @property
    def handle_rows(self) -> Numbers:
        """(h, 2) contour, and row of its points."""
        return self._handles[1]

    @property
    def arms(self) -> Numbers:
        """(a, 2) a handle, and the row of `places` that its node is in; handles of quadratics have two arms."""
        return np.zeros((0, 2), np.intp) if self.by_points else self._handles[2]

    def shown_handles(self, chosen: Flags) -> tuple[Numbers, Numbers, Flags]:
        """Of the chosen nodes and those beside them: handles (n,), arms (m,) and which of the handles (n,) belong to a
        chosen node. Those that lie on their nodes are left out."""
        if self.by_points or not 0 < np.count_nonzero(chosen) <= MOST:
            return np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0, bool)
        ends = self.segment_nodes
        near = chosen.copy()
        near[ends[chosen[ends[:, 1]], 0]] = True
        near[ends[chosen[ends[:, 0]], 1]] = True
        handle, node = self.arms.T
        long = np.linalg.norm(self.handles[handle] - self.places[node], axis=1) > ARM * self.size
        arms = np.flatnonzero(near[node] & long)
        shown = np.unique(handle[arms])
        own = np.zeros(len(self.handles), bool)
        own[handle[chosen[node]]] = True
        return shown, arms, own[shown]

    # Curves.

    def sides(self, tolerance: float) -> Sides:
        """Chords no further than `tolerance` (mm, in its own axes) from the curve."""
        if not self.path.contours:
            none = np.zeros((0, 2, self.dimension))
            return Sides(none, np.zeros((0, 2, 3)), np.zeros(0, np.intp), np.zeros((0, 2)))
        found = chords(self.path, max(tolerance, FINEST * self.size))
        inner = np.ones(len(found.points), bool)
        inner[found.starts[:-1]] = False
        last = np.flatnonzero(inner)
        own = np.stack((found.points[last - 1], found.points[last]), axis=1)
        world = self.world(own.reshape(-1, own.shape[2])).reshape(-1, 2, 3)
        same = (found.segment[last - 1] == found.segment[last]) & inner[last - 1]
        begin = np.where(same, found.parameter[last - 1], 0.0)
        return Sides(own, world, found.segment[last], np.column_stack((begin, found.parameter[last])))

    def picture(self, chosen: Flags, sides: Sides) -> CurvePicture:
        shown, arms, _ = self.shown_handles(chosen)
        bright = np.zeros(len(sides.segment), bool)
        if not self.by_points and chosen.any():
            whole = chosen[self.segment_nodes[:, 0]] & chosen[self.segment_nodes[:, 1]]
            bright = whole[sides.segment]
        handles = self.world(self.handles)
        return CurvePicture(
            sides.world,
            bright,
            self.nodes,
            self._shapes(),
            chosen,
            self._sizes(),
            self._ends(),
            handles[shown],
            self.nodes[self.arms[arms, 1]],
            handles[self.arms[arms, 0]],
            self._polygon(),
            self._starts(sides),
        )

    def _shapes(self) -> NDArray[np.uint8]:
        if self.by_points:
            return np.full(len(self.places), Shape.POINT, np.uint8)
        kinds = [np.zeros(0, np.uint8), *(contour.nodes for contour in self.path.contours)]
        return np.concatenate(kinds)

    def _sizes(self) -> Floats:
        """Control points of greater weight are larger."""
        weights = getattr(self.node, "weights", ())
        if not (self.by_points and weights):
            return np.ones(len(self.places))
        return np.clip(np.array(weights, float) ** 0.4, 0.55, 2.5)

    def _ends(self) -> Numbers:
        if self.by_points:
            return np.zeros(0, np.intp)
        ends = [
            number
            for begin, contour in zip(self.first.tolist(), self.path.contours, strict=False)
            if not contour.closed
            for number in (begin, begin + len(contour.nodes) - 1)
        ]
        return np.array(ends, np.intp)

    def _polygon(self) -> Floats:
        """The sides of the control polygon; of a path's B-splines too, whose points cannot be moved one by one."""
        if self.by_points:
            points = [self.nodes]
            if isinstance(self.node, BSpline) and self.node.closed:
                points = [np.vstack((self.nodes, self.nodes[:1]))]
        else:
            points = [self.world(spline.points) for contour in self.path.contours for spline in contour.splines]
        sides = [np.stack((one[:-1], one[1:]), axis=1) for one in points]
        return np.concatenate([np.zeros((0, 2, 3)), *sides])

    def _starts(self, sides: Sides) -> Floats:
        """For each contour the first side of some length, from its first node on."""
        if not len(sides.segment):
            return np.zeros((0, 2, 3))
        contour = self.segment_rows[sides.segment, 0]
        begin = np.flatnonzero(np.append(True, contour[1:] != contour[:-1]))
        return sides.world[begin]
