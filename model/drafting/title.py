"""The frame around a page, and the line at its foot: name, projection, scale, unit and size. No date: the same drawing
is the same file every day."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..project.disk import one_line
from .page import INK, Group, Item, Pen, Strokes, Text, width_of
from .paper import Paper
from .plan import Angle

FRAME = Pen(0.35)
RULE = Pen(0.18)
HEIGHT = 2.5  # mm of capitals
LINE = 8.0  # mm, the height of the title line
PADDING = 3.0  # mm beside words
AXES = Pen(0.13, INK, (3.0, 0.8, 0.6, 0.8))


def margin(paper: Paper) -> float:
    """mm between the edge of the page and its frame; the 10 mm of ISO 5457 from A4 on."""
    return min(10.0, 0.05 * min(paper.width, paper.height))


def room(paper: Paper) -> tuple[float, float, float, float]:
    """Left, low, width and height in mm of what the frame leaves to the drawing."""
    edge = margin(paper)
    inside = min(4.0, 0.4 * edge)
    left, low = edge + inside, edge + LINE + inside
    return left, low, paper.width - 2.0 * left, paper.height - low - edge - inside


@dataclass(frozen=True, slots=True)
class Title:
    """What the title line tells."""

    name: str
    view: str
    scale: str
    angle: Angle | None


def frame_group(paper: Paper, title: Title) -> Group:
    """The frame and the title line. Cells that a narrow page has no room for are left out, the name is shortened."""
    edge = margin(paper)
    left, right, low = edge, paper.width - edge, edge
    box = np.array([[left, low], [right, low], [right, paper.height - edge], [left, paper.height - edge], [left, low]])
    rules = [np.array([[left, low + LINE], [right, low + LINE]])]
    base = low + (LINE - HEIGHT) / 2.0
    items: list[Item] = []
    place, most = right, 0.6 * (right - left)
    for words in (paper.name, "mm", title.scale, title.view):
        wide = width_of(words, HEIGHT) + 2.0 * PADDING
        if not words or right - (place - wide) > most:
            continue
        items.append(Text(words, (place - wide / 2.0, base), HEIGHT, "middle", role="title"))
        place -= wide
        rules.append(np.array([[place, low], [place, low + LINE]]))
    if title.angle is not None and right - (place - SYMBOL) <= most:
        items += symbol(title.angle, (place - SYMBOL / 2.0, low + LINE / 2.0))
        place -= SYMBOL
        rules.append(np.array([[place, low], [place, low + LINE]]))
    letters = int((place - left - 2.0 * PADDING) / width_of("x", HEIGHT))
    name = one_line(title.name)
    name = name if len(name) <= letters else name[: max(letters - 1, 0)].rstrip() + "…"
    if letters >= 2 and name:
        items.append(Text(name, (left + PADDING, base), HEIGHT, role="title"))
    return Group("Frame", "frame", (Strokes("frame", FRAME, (box,)), Strokes("frame", RULE, tuple(rules)), *items))


SYMBOL = 22.0  # mm wide with its padding


def symbol(angle: Angle, middle: tuple[float, float]) -> list[Item]:
    """The symbol of ISO 5456-2: a cone without its top, and its view from the small end, where the method puts it."""
    large, small, length, apart = 4.4, 2.2, 5.0, 4.9
    way = 1.0 if angle == "first" else -1.0
    x, y = middle
    cone, round_ = x - way * apart, x + way * apart
    left, right = cone - length / 2.0, cone + length / 2.0
    trapezium = np.array([[left, y - small / 2], [right, y - large / 2], [right, y + large / 2], [left, y + small / 2],
                          [left, y - small / 2]])  # fmt: skip
    circles = tuple(_circle(round_, y, size / 2.0) for size in (large, small))
    axes = (
        np.array([[left - 1.0, y], [right + 1.0, y]]),
        np.array([[round_ - 3.1, y], [round_ + 3.1, y]]),
        np.array([[round_, y - 3.1], [round_, y + 3.1]]),
    )
    return [Strokes("symbol", FRAME, (trapezium, *circles)), Strokes("symbol", AXES, axes)]


def _circle(x: float, y: float, radius: float) -> NDArray[np.float64]:
    turn = np.linspace(0.0, 2.0 * np.pi, 49)
    return np.column_stack([x + radius * np.cos(turn), y + radius * np.sin(turn)])
