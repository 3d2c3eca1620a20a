"""A drawn page as a value: what every writer and the preview draw, in millimetres from its lower left corner, y up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ..solid.provenance import Path

Floats = NDArray[np.float64]
Anchor = Literal["start", "middle", "end"]

INK = "#1d242d"
EM = 1.39
"""The size of a sans-serif font by the height of its capitals, as Helvetica and Arial have it."""
WIDE = 0.8
"""The width of a letter by the height of the capitals, on average; digits have it exactly."""


@dataclass(frozen=True, slots=True)
class Pen:
    """A line's weight in mm, its colour #rrggbb, and the lengths of its dashes and gaps in mm, none for solid lines."""

    weight: float
    colour: str = INK
    dash: tuple[float, ...] = ()


VISIBLE = Pen(0.5)
HIDDEN = Pen(0.25, INK, (2.0, 0.75))
THIN = Pen(0.18)
"""Weights after ISO 128-2 (2022): wide lines, narrow dashed ones, dimensions. Gaps are its 3 widths, dashes 8 rather
than 12, so that what is small on paper still shows some; they are fitted to each line, see `dashes`."""


@dataclass(frozen=True, slots=True, eq=False)
class Strokes:
    """Polylines (k, 2), of k >= 2 points each, drawn with one pen. The role tells what they are: `visible`, ..."""

    role: str
    pen: Pen
    lines: tuple[Floats, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Fill:
    """An area of one colour #rrggbb inside closed contours (k, 2), by the even-odd rule."""

    role: str
    colour: str
    contours: tuple[Floats, ...]


@dataclass(frozen=True, slots=True)
class Text:
    """Words on a line that begins, has its middle or ends `at` (x, y); `height` is that of the capitals in mm.

    The line is turned by `angle` degrees counter-clockwise. A font's own widths are not known here; see `width`.
    """

    words: str
    at: tuple[float, float]
    height: float
    anchor: Anchor = "start"
    angle: float = 0.0
    role: str = "text"
    colour: str = INK

    @property
    def width(self) -> float:
        """In mm, by the average letter."""
        return width_of(self.words, self.height)


Item = Strokes | Fill | Text


@dataclass(frozen=True, slots=True)
class Group:
    """What belongs together, in the order in which it is painted: first its own items, then its groups.

    `path` holds the ids of the nodes on the way from the solid to the one that it shows, () for what shows none.
    """

    name: str
    role: str
    items: tuple[Item, ...] = ()
    groups: tuple[Group, ...] = ()
    path: Path = ()


@dataclass(frozen=True, slots=True)
class Page:
    """One page. `scale` is lengths on paper by lengths of the model, `title` a name for programs that list it."""

    width: float
    height: float
    groups: tuple[Group, ...]
    title: str = ""
    scale: float = 1.0


def walk(groups: tuple[Group, ...]) -> Iterator[Group]:
    """All groups and those in them, in the order in which they are painted."""
    stack = list(reversed(groups))
    while stack:
        group = stack.pop()
        yield group
        stack.extend(reversed(group.groups))


def items_of(page: Page, role: str | None = None) -> list[Item]:
    """All items of a page, or those of one role, in the order in which they are painted."""
    return [item for group in walk(page.groups) for item in group.items if role is None or item.role == role]


def width_of(words: str, height: float) -> float:
    """The width of a line of text in mm, by the average letter, from the height of its capitals."""
    return WIDE * height * len(words)


def box_of(items: tuple[Item, ...] | list[Item]) -> Floats | None:
    """The box [[left, low], [right, high]] around items, lines without their weight; None around nothing."""
    points = []
    for item in items:
        if isinstance(item, Text):
            points.append(_corners(item))
        else:
            points += item.lines if isinstance(item, Strokes) else item.contours
    if not points:
        return None
    every = np.concatenate(points)
    return np.array([every.min(axis=0), every.max(axis=0)])


def _corners(text: Text) -> Floats:
    start = {"start": 0.0, "middle": -0.5, "end": -1.0}[text.anchor] * text.width
    flat = np.array([[start, 0.0], [start + text.width, 0.0], [start, text.height], [start + text.width, text.height]])
    turn = np.radians(text.angle)
    cos, sin = np.cos(turn), np.sin(turn)
    return flat @ np.array([[cos, sin], [-sin, cos]]) + text.at
