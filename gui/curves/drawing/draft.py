"""An outline being drawn: what presses, moves and numbers do to it, in the coordinates of its plane. Knows no Qt."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....model.document.errors import Refusal
from ....model.document.nodes import Node
from ....model.document.outlines import Path as PathNode
from ....model.outline.paths import fields_of
from ....model.path.path import Contour, Kind, Path

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Held:
    """The keys that are held: Shift for 15 degrees or even sides, Alt for the other way of drawing."""

    shift: bool = False
    alt: bool = False


@dataclass(slots=True)
class Options:
    """What the bar sets, and what stays from one outline to the next."""

    sides: int = 6
    tips: int = 5
    inner: float = 0.5  # of a star: its inner radius as a share of the outer one
    tolerance: float = 2.5  # of a freehand stroke, in pixels
    pixel: float = 0.1  # millimetres that a pixel of the picture has


@dataclass(frozen=True, slots=True, eq=False)
class Sketch:
    """What is seen of a draft: what is settled, what would come with a click now, nodes (k, 2), and handles as arms
    (m, 2, 2) from their nodes."""

    settled: Path | None = None
    coming: Path | None = None
    nodes: Floats = field(default_factory=lambda: np.zeros((0, 2)))
    arms: Floats = field(default_factory=lambda: np.zeros((0, 2, 2)))


class Draft:
    """Sub-classes say what a point does. `complete` when nothing more is to come; then `node` is the outline.

    Typed numbers mean a point: `names` what they are, `target` which one.
    """

    hint = ""
    turns = True
    """Whether Shift holds directions at 15 degrees; else it means even sides."""
    snaps = True
    """Whether points go to what is near."""
    many = False
    """Whether it has any number of points, so that Enter and a double click end it, and C closes it."""
    counts = False
    """Whether the arrow keys up and down count something."""
    kind = "outline"

    def __init__(self, options: Options) -> None:
        self.options = options
        self.points: list[Floats] = []
        self.pointer: Floats | None = None
        self.held = Held()
        self.complete = False

    @property
    def begun(self) -> bool:
        return bool(self.points)

    @property
    def last(self) -> Floats | None:
        """(2,) the point that was set last."""
        return self.points[-1] if self.points else None

    @property
    def origin(self) -> Floats | None:
        """What directions are told from, and what a point may be in line with."""
        return self.last

    @property
    def places(self) -> Floats:
        """(k, 2) its own points to snap to."""
        return np.array(self.points).reshape(-1, 2)

    # The pointer. Points are (2,).

    def press(self, point: Floats, held: Held) -> None:
        """The button goes down."""
        raise AssertionError(type(self).__name__)

    def drag(self, point: Floats, held: Held) -> None:
        """The button is held, and the pointer has moved by more than a click."""
        self.hover(point, held)

    def release(self, point: Floats, held: Held, dragged: bool) -> None:
        """The button is up again."""

    def hover(self, point: Floats, held: Held) -> None:
        self.pointer, self.held = point, held

    # Keys.

    def finish(self, closed: bool = False) -> None:
        """Let what there is be all. Raises Refusal where that is no outline."""
        raise AssertionError(type(self).__name__)

    def back(self) -> None:
        """Without the last point."""
        if self.points:
            self.points.pop()

    def step(self, by: int) -> None:
        """One more or one less of what the arrow keys count."""

    # Numbers.

    def names(self, polar: bool) -> tuple[str, ...]:
        """What the numbers are that may be typed now; `polar` after a `<`."""
        return ("length", "angle") if polar and self.last is not None else ("x", "y")

    def values(self, polar: bool) -> list[float]:
        """The numbers for where the pointer is."""
        if self.pointer is None:
            return [0.0] * len(self.names(polar))
        if polar and self.last is not None:
            x, y = self.pointer - self.last
            return [float(np.hypot(x, y)), float(np.degrees(np.arctan2(y, x)))]
        return [float(number) for number in self.pointer]

    def target(self, numbers: list[float], polar: bool) -> Floats:
        """(2,) the point that numbers mean. Raises Refusal."""
        if polar and self.last is not None:
            return self.last + along(*numbers[:2])
        return np.array(numbers[:2])

    def filled(self, typed: list[float | None], polar: bool) -> list[float]:
        """What is not typed is as the pointer has it."""
        return [here if number is None else number for number, here in zip(typed, self.values(polar), strict=True)]

    # What comes of it.

    def node(self) -> Node:
        """Raises Refusal."""
        raise AssertionError(type(self).__name__)

    def sketch(self) -> Sketch:
        raise AssertionError(type(self).__name__)


def along(length: float, degrees: float) -> Floats:
    """(2,) a way of so many millimetres, exact along the axes."""
    way = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    way[np.abs(way) < 1e-15] = 0.0
    return length * way


def same(one: Floats, other: Floats) -> bool:
    return bool(np.abs(one - other).max() <= 1e-9 * max(float(np.abs(one).max()), 1.0))


def path_node(path: Path) -> Node:
    return PathNode(**fields_of(path))


def polyline(points: ArrayLike) -> Path | None:
    """Lines through points (k, 2); None for fewer than two."""
    rows = np.asarray(points, float).reshape(-1, 2)
    if len(rows) < 2:
        return None
    return Path((Contour(rows, np.full(len(rows) - 1, Kind.LINE, np.uint8)),))


def need(count: int, least: int, what: str) -> None:
    if count < least:
        raise Refusal(f"{what} needs {least} points or more; click on, or press Escape to give it up")
