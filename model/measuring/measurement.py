"""One measurement: what was picked, its figures, and the lines that show them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .distance import Axis, Distance, Thing, angle_between, distance, edge_angle, edge_face_angle
from .elements import Element, Line, short
from .figure import SEEN, Figure, vector

FLUSH = 1e-6
"""Degrees between directions that count as parallel."""
CORNER = 1e-6
"""Millimetres between the ends of edges that meet."""


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """`line` is the one to draw; `legs` say whether its way along x, y and z is drawn too; `outline` (n, 2, 3)."""

    title: str
    figures: tuple[Figure, ...]
    line: Line | None
    legs: bool
    outline: NDArray[np.float64]


def measurement(first: Element, second: Element | None = None) -> Measurement:
    """Of one element its own figures; of two how far they are apart, and at which angle."""
    if second is None:
        return Measurement(first.words, first.figures, first.line, False, first.outline)
    found = distance(first.thing, second.thing)
    main = _apart("Distance", found)
    figures = [*main]
    shown = found
    if first.centre is not None and second.centre is not None:
        between = distance(np.array(first.centre), np.array(second.centre))
        figures += _apart("Centres", between)
        shown = between
    elif first.axis is not None and second.axis is not None:
        between = distance(first.axis, second.axis)
        figures += _apart("Axes", between)
    elif first.axis is not None or second.axis is not None:
        ends = tuple(element.axis or _middle(element) for element in (first, second))
        figures += _apart("From the axis", distance(*ends))
    if first.normal is not None and second.normal is not None and edge_angle(first.normal, second.normal) < FLUSH:
        gap = abs(float(np.dot(first.normal, second.thing[0, 0] - first.thing[0, 0])))
        figures.append(Figure("Between planes", (gap,), digits=SEEN))
    angle = _angle(first, second)
    if angle is not None:
        figures.append(Figure("Angle", (angle,), "°", SEEN))
    line = Line(shown.a, shown.b, f"{short(shown.length)} mm") if shown.length > 0 else None
    outline = np.concatenate([first.outline, second.outline])
    return Measurement(f"{first.words} \u2013 {second.words}", tuple(figures), line, line is not None, outline)


def _middle(element: Element) -> Thing:
    return element.thing if element.centre is None else np.array(element.centre)


def _apart(name: str, found: Distance) -> list[Figure]:
    delta = vector("Δ" if name == "Distance" else f"{name} Δ", found.delta, digits=SEEN)
    return [Figure(name, (found.length,), digits=SEEN), delta]


def _angle(first: Element, second: Element) -> float | None:
    one, other = first.direction or first.normal, second.direction or second.normal
    if one is None or other is None:
        return None
    if first.direction is not None and second.direction is not None:
        corner = _corner(first, second)
        return edge_angle(one, other) if corner is None else corner
    if first.direction is None and second.direction is None:
        return edge_angle(one, other)
    return edge_face_angle(one, other)


def _corner(first: Element, second: Element) -> float | None:
    """The angle in which two straight edges meet that have an end in common."""
    if first.thing.shape != (2, 3) or second.thing.shape != (2, 3) or isinstance(first.axis, Axis):
        return None
    for i in range(2):
        for j in range(2):
            if np.linalg.norm(first.thing[i] - second.thing[j]) < CORNER:
                ways = first.thing[1 - i] - first.thing[i], second.thing[1 - j] - second.thing[j]
                return angle_between(*(tuple(way.tolist()) for way in ways))  # type: ignore[arg-type]
    return None
