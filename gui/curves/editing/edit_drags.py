"""What can be dragged of an outline: from the pointer, or numbers that are typed, to operations on its node."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....model.document.expression import Number
from ...tools.entry import number_text
from ..active import Call, Place
from .edited import Edited

Floats = NDArray[np.float64]
ROUND = 9
"""Decimals of a millimetre that are kept: the bits behind them say nothing and would stand in the script."""


@dataclass(frozen=True, slots=True)
class Held:
    """Keys: Shift for 15° steps and even sides, Ctrl without snapping or about the middle, Alt to break a node."""

    shift: bool = False
    control: bool = False
    alt: bool = False


@dataclass(frozen=True, eq=False)
class Plane:
    """The plane of an outline's own axes in which something is dragged: coordinates `axes` change, from `place` (d,).

    `frame` (3, 4) takes these two coordinates to the world.
    """

    place: Floats
    axes: tuple[int, int]
    frame: Floats

    def lifted(self, point: Floats) -> Floats:
        """(d,) the point (2,) of the plane in the outline's own axes."""
        found = self.place.copy()
        found[list(self.axes)] = point
        return found

    def flat(self, point: Floats) -> Floats:
        """(2,) of a point (d,)."""
        return point[list(self.axes)]


@dataclass(frozen=True, eq=False)
class Wish:
    """What a drag snaps: nodes that do not count, the point (2,) that directions are taken from, or None."""

    exclude: frozenset[Place] = frozenset()
    origin: Floats | None = None
    angles: bool = False
    free: bool = False


class Drag:
    """`grabbed` (d,) is what the pointer has caught; it is what snaps. `numbers` are what the drag has come to."""

    names: tuple[str, ...] = ()
    label = ""
    first = 0

    def __init__(self, edited: Edited, plane: Plane) -> None:
        self.edited, self.plane = edited, plane
        self.numbers: list[float] = []
        self.resolve: Callable[[Number], float] = float

    def wish(self, held: Held) -> Wish:
        return Wish(free=held.control)

    def follow(self, point: Floats, held: Held) -> None:
        """What was grabbed would be at a point (2,) of the plane."""
        raise AssertionError(type(self).__name__)

    def take(self, typed: Sequence[Number | None]) -> None:
        """Numbers were typed; None where the text is empty."""
        for i, value in enumerate(typed):
            if value is not None:
                self.numbers[i] = self.resolve(value)

    def calls(self) -> list[Call]:
        """The operations; none where nothing would change."""
        raise AssertionError(type(self).__name__)

    def shown(self) -> list[str]:
        return [number_text(value) for value in self.numbers]

    def words(self) -> str:
        return "Δ " + ", ".join(self.shown())


def plain(values: Iterable[float]) -> tuple[float, ...]:
    return tuple(round(float(value), ROUND) + 0.0 for value in values)


class MoveDrag(Drag):
    """Nodes with their handles, or control points."""

    label = "Move nodes"

    def __init__(self, edited: Edited, plane: Plane, nodes: Iterable[Place]) -> None:
        super().__init__(edited, plane)
        self._nodes = sorted(nodes)
        self.names = ("x", "y", "z")[: edited.dimension]
        self.numbers = [0.0] * edited.dimension
        if edited.by_points:
            self.label = "Move control points"

    def wish(self, held: Held) -> Wish:
        origin = self.plane.flat(self.plane.place)
        return Wish(frozenset(self._nodes), origin, held.shift, held.control)

    def follow(self, point: Floats, held: Held) -> None:
        self.numbers = list(plain(self.plane.lifted(point) - self.plane.place))

    def take(self, typed: Sequence[Number | None]) -> None:
        """What is not typed stays where it was."""
        self.numbers = [0.0 if value is None else self.resolve(value) for value in typed]

    def calls(self) -> list[Call]:
        return move_calls(self.edited, self._nodes, tuple(self.numbers)) if any(self.numbers) else []


def move_calls(edited: Edited, nodes: Iterable[Place], by: tuple[float, ...]) -> list[Call]:
    """Move nodes, or control points, by (d,)."""
    if edited.by_points:
        return [("move_points", ([number for _, number in nodes], by), {})]
    return [("move_nodes", (list(nodes), by), {})]


class HandleDrag(Drag):
    """One handle; Alt makes its node a cusp, so that the handle across stays."""

    label = "Move handle"
    names = ("length", "angle")

    def __init__(self, edited: Edited, plane: Plane, handle: Place, node: int) -> None:
        super().__init__(edited, plane)
        self._handle, self._node = handle, edited.rows[node]
        self._root = edited.places[node]
        self._to: Floats | None = None
        self._breaks = False
        self._typed: dict[str, float] = {}
        self._measure(plane.place)

    def wish(self, held: Held) -> Wish:
        return Wish(frozenset(), self.plane.flat(self._root), held.shift, held.control)

    def follow(self, point: Floats, held: Held) -> None:
        self._to, self._breaks, self._typed = self.plane.lifted(point), held.alt, {}
        self._measure(self._to)

    def _measure(self, to: Floats) -> None:
        arm = self.plane.flat(to) - self.plane.flat(self._root)
        angle = float(np.degrees(np.arctan2(arm[1], arm[0])))
        self.numbers = [round(float(np.hypot(*arm)), 4) + 0.0, round(angle, 4) + 0.0]

    def take(self, typed: Sequence[Number | None]) -> None:
        super().take(typed)
        given = zip(self.names, typed, strict=True)
        self._typed = {name: self.resolve(value) for name, value in given if value is not None}

    def calls(self) -> list[Call]:
        steps: list[Call] = [("set_joints", ([self._node], "cusp"), {})] if self._breaks else []
        if self._typed:
            return [*steps, ("set_handle", (self._handle,), dict(self._typed))]
        if self._to is None:
            return []
        return [*steps, ("move_handle", (self._handle, plain(self._to)), {})]

    def words(self) -> str:
        length, angle = self.shown()
        return f"{length} mm, {angle}°" + (", node broken" if self._breaks else "")


class BendDrag(Drag):
    """The curve itself, at a parameter of one segment of a path: its handles follow."""

    label = "Bend"
    names = ("x", "y")

    def __init__(self, edited: Edited, plane: Plane, segment: int, parameter: float) -> None:
        super().__init__(edited, plane)
        self._segment = segment
        self._parameter = min(max(parameter, 0.02), 0.98)
        self.names = ("x", "y", "z")[: edited.dimension]
        self.numbers = [0.0] * edited.dimension

    def follow(self, point: Floats, held: Held) -> None:
        self.numbers = list(plain(self.plane.lifted(point) - self.plane.place))

    def take(self, typed: Sequence[Number | None]) -> None:
        self.numbers = [0.0 if value is None else self.resolve(value) for value in typed]

    def calls(self) -> list[Call]:
        if not any(self.numbers):
            return []
        contour, number = self.edited.segment_rows[self._segment].tolist()
        return [("bend_segment", (contour, number, round(self._parameter, 6), tuple(self.numbers)), {})]


class PullDrag(BendDrag):
    """The curve of a Bezier curve or B-spline: the control points that act there follow, as little as will do."""

    label = "Bend"

    def calls(self) -> list[Call]:
        share = shares(self.edited, self._segment, self._parameter)
        if not any(self.numbers) or share is None:
            return []
        # Of all moves of the control points that take the curve there the one of least squares.
        weight = share / float(share @ share)
        numbers = np.flatnonzero(np.abs(weight) > 1e-9)
        places = self.edited.places[numbers] + weight[numbers, None] * np.array(self.numbers)
        return [("place_points", (numbers.tolist(), [plain(place) for place in places]), {})]


def shares(edited: Edited, segment: int, parameter: float) -> Floats | None:
    """(k,) how much of each control point is in the point of the curve at a parameter from 0 to 1, together 1; None
    on the line that closes a curve."""
    if segment > 0:
        return None
    found = edited.path.contours[0].segment(0)
    count = len(edited.places)
    if isinstance(found, np.ndarray):
        from ....model.curve.bernstein import basis

        values = np.asarray(basis(count - 1, np.array([parameter])), float).reshape(-1)
    else:
        from ....model.spline.bspline import basis

        start, end = found.domain
        full = np.asarray(basis(found, np.array([(1.0 - parameter) * start + parameter * end])), float).reshape(-1)
        values = np.zeros(count)
        np.add.at(values, np.arange(len(full)) % count, full)  # a closed one uses the first control points again
    return values / float(values.sum())
