"""B-splines by their control points, and through points."""

from __future__ import annotations

import numpy as np

from ....model.document.errors import Refusal
from ....model.document.nodes import Node
from ....model.document.outlines import BSpline
from ....model.outline.paths import path_of
from ....model.path.path import Path
from ....model.spline.spline_fitting import interpolated
from .draft import Draft, Floats, Held, Sketch, need, polyline, same

DEGREE = 3


class ControlPoints(Draft):
    """Clicks are control points; the degree is three, or less as long as there are too few points."""

    kind = "B-spline"
    clicks = "control points"
    many = True
    closed = False

    @property
    def hint(self) -> str:  # type: ignore[override]
        if not self.points:
            return f"Click {self.clicks}, or type x, y; Escape ends this"
        return (
            "Enter or a double click ends it, C or a click on the first point closes; Backspace takes back, "
            "Shift 15°, Ctrl no snapping"
        )

    def press(self, point: Floats, held: Held) -> None:
        self.pointer, self.held = point, held
        if len(self.points) > 2 and same(point, self.points[0]):
            self.finish(closed=True)
        elif not any(same(point, known) for known in self.points[-1:]):
            self.points.append(point)

    def finish(self, closed: bool = False) -> None:
        need(len(self.points), 3 if closed else 2, f"a closed {self.kind}" if closed else f"a {self.kind}")
        self.closed = closed
        self.complete = True

    def node(self) -> Node:
        return self._made(np.array(self.points), self.closed)

    def _made(self, points: Floats, closed: bool) -> Node:
        return BSpline(points=rows(points), degree=min(DEGREE, len(points) - 1), closed=closed)

    def sketch(self) -> Sketch:
        points = list(self.points)
        closes = False
        if points and self.pointer is not None and not self.complete:
            closes = len(points) > 2 and same(self.pointer, points[0])
            if not closes and not same(self.pointer, points[-1]):
                points.append(self.pointer)
        curve = self._curve(np.array(points).reshape(-1, 2), closes or self.closed)
        polygon = polyline([*points, points[0]] if closes else points)
        return Sketch(curve, polygon, self.places)

    def _curve(self, points: Floats, closed: bool) -> Path | None:
        if len(points) < 2:
            return None
        try:
            return path_of(self._made(points, closed))
        except Refusal:  # two points are one yet
            return None


class ThroughPoints(ControlPoints):
    """Clicks are points of the curve: its ends have no curvature, closed it is as smooth at its start as elsewhere."""

    kind = "spline"
    clicks = "points that the curve goes through"

    def _made(self, points: Floats, closed: bool) -> Node:
        degree = min(DEGREE, len(points) - 1)
        if closed:
            spline = interpolated(points, degree, "closed")
            turn = spline.knots[degree : degree + len(points) + 1]
            return BSpline(points=rows(spline.points[: len(points)]), degree=degree, knots=tuple(turn.tolist()),
                           closed=True)  # fmt: skip
        spline = interpolated(points, degree, "natural" if degree == DEGREE else "free")
        return BSpline(points=rows(spline.points), degree=degree, knots=tuple(spline.knots.tolist()))

    def sketch(self) -> Sketch:
        found = super().sketch()
        return Sketch(found.settled, None, found.nodes)


def rows(points: Floats) -> tuple[tuple[float, ...], ...]:
    return tuple(map(tuple, points.tolist()))
