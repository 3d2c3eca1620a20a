"""A knot on its way along the line: how far it may go, what it snaps to, and how finely it is told."""

from __future__ import annotations

from collections.abc import Callable
from math import floor, inf, log10

from .knot_paint import Room

STILL = 3  # logical pixels that the pointer has to move before a drag begins
BESIDE = 0.01
"""How near a knot comes to one that it cannot lie on, as a part of the way between them at the beginning."""


def rounded(value: float, step: float) -> float:
    """To the decimals that a step (a pixel, say) tells apart, and one more."""
    return round(value, max(0, 1 - floor(log10(step)))) + 0.0


class KnotDrag:
    """Of all knots of one value, or of one alone. `numbers` are those that move; `room` is that of the beginning."""

    def __init__(
        self,
        room: Room,
        numbers: tuple[int, ...],
        value: float,
        pressed: float,
        reach: Callable[[tuple[int, ...]], tuple[float, float, bool, bool]],
    ) -> None:
        self.room, self.numbers = room, numbers
        self.going = False
        self._all, self._value, self._pressed, self._reach = numbers, value, pressed, reach
        self._bounds = reach(numbers)

    def to(self, x: float, alone: bool, snap: int) -> float | None:
        """The value for the pointer at `x`; None while it has hardly moved. `alone` counts when the drag begins."""
        if not self.going:
            if abs(x - self._pressed) < STILL:
                return None
            self._begin(x > self._pressed, alone)
        scale = self.room.scale
        return self._bounded(self._value + (x - self._pressed) / scale, snap / scale)

    def by(self, way: float, alone: bool) -> float | None:
        """The value so much higher or lower; None where it cannot go there."""
        self._begin(way > 0.0, alone)
        value = self._bounded(self._value + way, 0.0)
        return None if value == self._value else value

    def _begin(self, up: bool, alone: bool) -> None:
        """Of several knots of one value the last can go up, and the first down."""
        self.going = True
        if alone and len(self._all) > 1:
            self.numbers = (self._all[-1 if up else 0],)
            self._bounds = self._reach(self.numbers)

    def _bounded(self, wanted: float, snap: float) -> float:
        low, high, on_low, on_high = self._bounds
        for side, holds in ((low, on_low), (high, on_high)):
            if holds and abs(wanted - side) <= snap:
                return side
        if not on_low and low > -inf:
            low += BESIDE * (self._value - low)
        if not on_high and high < inf:
            high -= BESIDE * (high - self._value)
        value = rounded(wanted, 1.0 / self.room.scale)
        return min(max(value, low), high)
