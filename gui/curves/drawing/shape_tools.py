"""Rectangles, ellipses, polygons, stars and arcs, by pointer and by numbers."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from ....model.document.errors import Refusal
from ....model.document.nodes import Node
from ....model.path import shapes
from ....model.path.path import Contour, Path
from .draft import Draft, Floats, Held, Sketch, along, path_node, polyline, same


class Spread(Draft):
    """From one point to another one, by a drag or by two clicks. Sub-classes say what lies between."""

    place = "corner"
    after = ""
    """What the keys do once it has begun."""

    @property
    def hint(self) -> str:  # type: ignore[override]
        if not self.points:
            return f"Drag, or click the {self.place}; or type x, y; Escape ends this"
        return f"Click, or type the numbers and Enter; {self.after}, Ctrl no snapping"

    def press(self, point: Floats, held: Held) -> None:
        self.pointer, self.held = point, held
        if self.points:
            self._settle()
        else:
            self.points = [point]

    def release(self, point: Floats, held: Held, dragged: bool) -> None:
        self.pointer, self.held = point, held
        if dragged and self.points and not self.complete:
            self._settle()

    def finish(self, closed: bool = False) -> None:
        if not self.points:
            raise Refusal(f"click the {self.place} first")
        self._settle()

    def _settle(self) -> None:
        self.path()  # may refuse
        self.complete = True

    def path(self) -> Path:
        """Raises Refusal where it has no size."""
        raise AssertionError(type(self).__name__)

    def node(self) -> Node:
        return path_node(self.path())

    def sketch(self) -> Sketch:
        if not self.points or self.pointer is None:
            return Sketch(nodes=self.places)
        try:
            return Sketch(self.path(), None, self.places)
        except Refusal:  # it has no size yet
            return Sketch(nodes=self.places)


class _Box(Spread):
    """What has a width and a height; Shift makes them even, Alt draws from the middle or no more so."""

    turns = False
    centred: ClassVar[bool] = False

    @property
    def from_middle(self) -> bool:
        return self.centred != self.held.alt

    @property
    def _way(self) -> Floats:
        """(2,) from the first point to the pointer, even with Shift."""
        assert self.pointer is not None
        way = self.pointer - self.points[0]
        if not self.held.shift:
            return way
        return np.where(way < 0.0, -1.0, 1.0) * self._even(way)

    def _even(self, way: Floats) -> float:
        return float(np.abs(way).max())

    def box(self) -> tuple[Floats, Floats]:
        """The lowest corner and the size, (2,) each. Raises Refusal."""
        way = self._way
        size = np.abs(way) * (2.0 if self.from_middle else 1.0)
        if not (size > 0.0).all():
            raise Refusal(f"this {self.kind} has no width or no height; go further from where it began")
        low = self.points[0] - np.abs(way) if self.from_middle else self.points[0] + np.minimum(way, 0.0)
        return low, size


class Rectangle(_Box):
    kind = "rectangle"
    after = "Shift makes a square, Alt draws from the middle"

    def names(self, polar: bool) -> tuple[str, ...]:
        return ("width", "height") if self.points else ("x", "y")

    def values(self, polar: bool) -> list[float]:
        if not self.points or self.pointer is None:
            return super().values(polar)
        return [float(size) for size in np.abs(self._way) * (2.0 if self.from_middle else 1.0)]

    def target(self, numbers: list[float], polar: bool) -> Floats:
        if not self.points:
            return super().target(numbers, polar)
        towards = np.ones(2) if self.pointer is None else np.where(self.pointer < self.points[0], -1.0, 1.0)
        self.held = Held(alt=self.held.alt)
        return self.points[0] + towards * np.array(numbers) * (0.5 if self.from_middle else 1.0)

    def path(self) -> Path:
        low, (width, height) = self.box()
        return shapes.rectangle(float(width), float(height), corner=low)


class Ellipse(_Box):
    """Drawn from its middle: with Shift the pointer is on the circle."""

    kind = "ellipse"
    place = "middle"
    centred = True
    after = "Shift makes a circle, Alt draws from corner to corner"

    def _even(self, way: Floats) -> float:
        return float(np.hypot(*way)) if self.from_middle else float(np.abs(way).max())

    def names(self, polar: bool) -> tuple[str, ...]:
        return ("radius", "radius y") if self.points else ("x", "y")

    def values(self, polar: bool) -> list[float]:
        if not self.points or self.pointer is None:
            return super().values(polar)
        return [float(size) for size in np.abs(self._way) * (1.0 if self.from_middle else 0.5)]

    def target(self, numbers: list[float], polar: bool) -> Floats:
        if not self.points:
            return super().target(numbers, polar)
        self.held = Held(alt=self.held.alt)
        return self.points[0] + np.array(numbers) * (1.0 if self.from_middle else 2.0)

    def filled(self, typed: list[float | None], polar: bool) -> list[float]:
        """One radius alone is that of a circle."""
        if self.points and typed[0] is not None and typed[1] is None:
            typed = [typed[0], typed[0]]
        return super().filled(typed, polar)

    def path(self) -> Path:
        low, size = self.box()
        return shapes.ellipse(low + size / 2.0, (float(size[0]) / 2.0, float(size[1]) / 2.0))


class Polygon(Spread):
    kind = "polygon"
    place = "middle"
    after = "Up and Down change the number of sides, Shift turns by 15°"
    counted = "sides"
    counts = True
    least = 3

    @property
    def count(self) -> int:
        return self.options.sides

    @count.setter
    def count(self, count: int) -> None:
        self.options.sides = count

    def step(self, by: int) -> None:
        self.count = max(self.count + by, self.least)

    def names(self, polar: bool) -> tuple[str, ...]:
        return ("radius", "angle", self.counted) if self.points else ("x", "y")

    def values(self, polar: bool) -> list[float]:
        if not self.points or self.pointer is None:
            return super().values(polar)
        return [*super().values(True), float(self.count)]

    def target(self, numbers: list[float], polar: bool) -> Floats:
        if not self.points:
            return super().target(numbers, polar)
        if not (self.least <= numbers[2] <= 1000 and numbers[2] == int(numbers[2])):
            raise Refusal(f"a {self.kind} has {self.least} to 1,000 {self.counted}, not {numbers[2]:g}")
        self.count = int(numbers[2])
        return self.points[0] + along(*numbers[:2])

    def path(self) -> Path:
        assert self.pointer is not None
        if same(self.pointer, self.points[0]):
            raise Refusal(f"this {self.kind} has no size; go further from where it began")
        x, y = self.pointer - self.points[0]
        return self._shape(float(np.hypot(x, y)), float(np.degrees(np.arctan2(y, x))))

    def _shape(self, radius: float, start: float) -> Path:
        return shapes.polygon(self.count, radius, self.points[0], start)


class Star(Polygon):
    kind = "star"
    after = "Up and Down change the number of tips, Shift turns by 15°"
    counted = "tips"

    @property
    def count(self) -> int:
        return self.options.tips

    @count.setter
    def count(self, count: int) -> None:
        self.options.tips = count

    def _shape(self, radius: float, start: float) -> Path:
        return shapes.star(self.count, radius, self.options.inner * radius, self.points[0], start)


class Arc(Draft):
    """From its start to its end, through a third point."""

    kind = "arc"

    @property
    def hint(self) -> str:  # type: ignore[override]
        return (
            "Click where the arc begins, or type x, y; Escape ends this",
            "Click where it ends, or type x, y or length<angle; Shift 15°, Ctrl no snapping",
            "Click a point that it goes through, or type its radius and Enter",
        )[min(len(self.points), 2)]

    def press(self, point: Floats, held: Held) -> None:
        self.pointer, self.held = point, held
        if len(self.points) == 2:
            self.contour()  # may refuse
            self.complete = True
        elif not (self.points and same(point, self.points[0])):
            self.points.append(point)

    def release(self, point: Floats, held: Held, dragged: bool) -> None:
        """A drag sets both ends."""
        self.pointer, self.held = point, held
        if dragged and len(self.points) == 1 and not same(point, self.points[0]):
            self.points.append(point)

    def finish(self, closed: bool = False) -> None:
        if len(self.points) < 2:
            raise Refusal("an arc needs both of its ends; click on, or press Escape to give it up")
        self.contour()
        self.complete = True

    def names(self, polar: bool) -> tuple[str, ...]:
        return ("radius",) if len(self.points) == 2 else super().names(polar)

    def values(self, polar: bool) -> list[float]:
        if len(self.points) < 2 or self.pointer is None:
            return super().values(polar)
        circle = _circle(self.points[0], self.pointer, self.points[1])
        return [float("inf") if circle is None else circle[1]]

    def target(self, numbers: list[float], polar: bool) -> Floats:
        if len(self.points) < 2:
            return super().target(numbers, polar)
        begin, end = self.points
        half = float(np.hypot(*(end - begin))) / 2.0
        if abs(numbers[0]) < half * (1.0 - 1e-12):
            raise Refusal(f"the ends are {2.0 * half:.6g} mm apart: the radius is {half:.6g} mm or more")
        across = np.array([begin[1] - end[1], end[0] - begin[0]]) / (2.0 * half)
        middle = (begin + end) / 2.0
        side = -1.0 if self.pointer is not None and (self.pointer - middle) @ across < 0.0 else 1.0
        rise = abs(numbers[0]) - np.sqrt(max(numbers[0] ** 2 - half**2, 0.0))
        return middle + side * rise * across

    def contour(self) -> Contour:
        """The arc through the pointer. Raises Refusal where that lies on its ends."""
        assert self.pointer is not None
        begin, end = self.points
        if same(self.pointer, begin) or same(self.pointer, end):
            raise Refusal("the third point must lie between the ends of the arc")
        circle = _circle(begin, self.pointer, end)
        if circle is None:
            return Contour.of_segments([np.array([begin, end])])
        centre, radius = circle
        start, through, stop = (
            float(np.degrees(np.arctan2(*(point - centre)[::-1]))) for point in (begin, self.pointer, end)
        )
        sweep = (stop - start) % 360.0
        if (through - start) % 360.0 > sweep:
            sweep -= 360.0
        (drawn,) = shapes.arc(centre, radius, start, sweep).contours
        points = drawn.points.copy()
        points[0], points[-1] = begin, end
        inner = np.full(len(drawn.nodes), 2, np.uint8)  # symmetric
        inner[[0, -1]] = 0
        return Contour(points, drawn.kinds, False, (), inner)

    def node(self) -> Node:
        return path_node(Path((self.contour(),)))

    def sketch(self) -> Sketch:
        if len(self.points) < 2 or self.pointer is None:
            ends = self.places if self.pointer is None or not self.points else [*self.points, self.pointer]
            return Sketch(None, polyline(ends), self.places)
        try:
            return Sketch(Path((self.contour(),)), polyline(self.points), self.places)
        except Refusal:  # the pointer is on an end
            return Sketch(polyline(self.points), None, self.places)


def _circle(one: Floats, two: Floats, three: Floats) -> tuple[Floats, float] | None:
    """Centre and radius of the circle through three points (2,); None where they lie on a line."""
    first, second = two - one, three - one
    double = 2.0 * float(first[0] * second[1] - first[1] * second[0])
    if abs(double) <= 1e-9 * float(np.hypot(*first) * np.hypot(*second)):
        return None
    squares = np.array([first @ first, second @ second])
    away = np.array([second[1] * squares[0] - first[1] * squares[1], first[0] * squares[1] - second[0] * squares[0]])
    return one + away / double, float(np.hypot(*away)) / abs(double)
