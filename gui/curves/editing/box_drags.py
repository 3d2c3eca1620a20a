"""Drags of the box around chosen nodes: it scales and turns them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from ....render.handles.drag import stepped_angle, unwrapped
from ..active import Call, Place
from .edit_drags import Drag, Held, Plane, Wish, plain
from .edited import Edited

Floats = NDArray[np.float64]


class _BoxDrag(Drag):
    def __init__(self, edited: Edited, plane: Plane, nodes: Iterable[Place]) -> None:
        super().__init__(edited, plane)
        self._nodes = sorted(nodes)
        places = edited.places[[edited.number(node) for node in self._nodes]]
        self.low, self.high = places.min(axis=0), places.max(axis=0)

    def matrix(self) -> Floats:
        """(2, 3)"""
        raise AssertionError(type(self).__name__)

    def calls(self) -> list[Call]:
        matrix = self.matrix()
        if np.allclose(matrix, np.eye(2, 3), rtol=0.0, atol=1e-12):
            return []
        return transform_calls(self._nodes, matrix)

    def wish(self, held: Held) -> Wish:
        return Wish(frozenset(self._nodes), None, False, held.control)


def transform_calls(nodes: Sequence[Place], matrix: Floats) -> list[Call]:
    """Nodes, or control points, mapped by a matrix (2, 3) of the outline's own axes."""
    return [("transform_nodes", (list(nodes), [plain(row) for row in matrix]), {})]


class ScaleDrag(_BoxDrag):
    """A knob of the box, `step` (2,) from its middle; Shift keeps the proportion, Ctrl scales about the middle."""

    label = "Scale nodes"
    names = ("x", "y")

    def __init__(self, edited: Edited, plane: Plane, nodes: Iterable[Place], step: Floats) -> None:
        super().__init__(edited, plane, nodes)
        self._step = step
        self.numbers = [1.0, 1.0]
        self.first = 0 if step[0] else 1
        self._about = self._anchor(False)

    def _anchor(self, middle: bool) -> Floats:
        centre = 0.5 * (self.low + self.high)
        return centre if middle else centre - 0.5 * self._step * (self.high - self.low)

    def follow(self, point: Floats, held: Held) -> None:
        self._about = self._anchor(held.control)
        corner = 0.5 * (self.low + self.high) + 0.5 * self._step * (self.high - self.low)
        reach = corner - self._about
        free = np.abs(reach) > 1e-12
        factors = np.where(free, (point - self._about) / np.where(free, reach, 1.0), 1.0)
        if held.shift and free.any():
            along = reach[free] @ (point - self._about)[free] / (reach[free] @ reach[free])
            factors = np.full(2, along)
        self.numbers = [round(float(factor), 6) + 0.0 for factor in factors]

    def matrix(self) -> Floats:
        factors = np.array(self.numbers)
        return np.column_stack((np.diag(factors), self._about - factors * self._about))

    def words(self) -> str:
        return "× " + ", ".join(self.shown())


class TurnDrag(_BoxDrag):
    """The knob above the box; Shift keeps to 15° steps."""

    label = "Turn nodes"
    names = ("angle",)

    def __init__(self, edited: Edited, plane: Plane, nodes: Iterable[Place]) -> None:
        super().__init__(edited, plane, nodes)
        self.numbers = [0.0]
        self._middle = 0.5 * (self.low + self.high)
        self._begin: float | None = None
        self._last = 0.0

    def wish(self, held: Held) -> Wish:
        return Wish(free=True)

    def begin(self, point: Floats) -> None:
        self._begin = self._angle(point)

    def _angle(self, point: Floats) -> float:
        away = point - self._middle
        return float(np.degrees(np.arctan2(away[1], away[0])))

    def follow(self, point: Floats, held: Held) -> None:
        if self._begin is None:
            self.begin(point)
        assert self._begin is not None
        self._last = unwrapped(self._angle(point) - self._begin, self._last)
        if held.shift:
            self.numbers = [15.0 * round(self._last / 15.0)]
        else:
            self.numbers = [stepped_angle(self._last, fine=held.control)]

    def matrix(self) -> Floats:
        turn = np.radians(self.numbers[0])
        rows = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        return np.column_stack((rows, self._middle - rows @ self._middle))

    def words(self) -> str:
        return f"{self.shown()[0]}°"
