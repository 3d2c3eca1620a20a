"""Small vector pictures of the kinds of nodes: shaded primitives, and the symbols of the operations."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...model.document.colours import rgb

WIDTH, HEIGHT = 44.0, 38.0  # of a primitive's picture; its corner is at 0, 0
RADIUS = 15.0  # of an operation's circle; its symbol is about 0, 0

Point = tuple[float, float]
Path = tuple[tuple[str, tuple[float, ...]], ...]
"""Absolute SVG commands and their numbers: M and L (x, y), C (three points), Z."""


@dataclass(frozen=True, slots=True)
class Gradient:
    """From `start` to `end`, or (radial) about `start` with `end` on the rim; each stop is (place, shade)."""

    start: Point
    end: Point
    stops: tuple[tuple[float, float], ...]
    radial: bool = False


@dataclass(frozen=True, slots=True)
class Shape:
    """A path, filled with the node's colour in a shade (-1 black, 0 the colour itself, 1 white) unless it is None.

    Holes are what an even number of its loops goes round. `line`: with an outline.
    """

    path: Path
    fill: float | Gradient | None = 0.0
    line: bool = True


def shaded(colour: str, shade: float) -> str:
    """The colour mixed with white or black, as `#rrggbb`."""
    towards = 255 if shade > 0 else 0
    mixed = (round(part + (towards - part) * abs(shade)) for part in rgb(colour))
    return "#" + "".join(f"{part:02x}" for part in mixed)


def lines(*points: Point, closed: bool = True) -> Path:
    path = tuple(("L" if i else "M", point) for i, point in enumerate(points))
    return (*path, ("Z", ())) if closed else path


def arc(centre: Point, rx: float, ry: float, start: float, end: float, join: str = "M") -> Path:
    """A part of an ellipse from one angle to another (degrees, y downwards), as Bezier curves of at most 90 degrees.

    The curves' error is below 0.03 % of the radius (handles of 4/3 tan(angle / 4)).
    """
    count = max(1, math.ceil(abs(end - start) / 90 - 1e-9))
    step = math.radians(end - start) / count
    handle = 4 / 3 * math.tan(step / 4)
    cx, cy = centre

    def at(angle: float) -> Point:
        return cx + rx * math.cos(angle), cy + ry * math.sin(angle)

    path: list[tuple[str, tuple[float, ...]]] = [(join, at(math.radians(start)))]
    for i in range(count):
        a = math.radians(start) + i * step
        b = a + step
        (ax, ay), (bx, by) = at(a), at(b)
        one = (ax - handle * rx * math.sin(a), ay + handle * ry * math.cos(a))
        two = (bx + handle * rx * math.sin(b), by - handle * ry * math.cos(b))
        path.append(("C", (*one, *two, bx, by)))
    return tuple(path)


def ellipse(centre: Point, rx: float, ry: float) -> Path:
    return (*arc(centre, rx, ry, 0, 360), ("Z", ()))


_ROUND = ((0.0, -0.12), (0.3, 0.4), (0.7, -0.05), (1.0, -0.38))  # across a cylinder lit from the upper left


def _across(left: float, right: float) -> Gradient:
    return Gradient((left, 0), (right, 0), _ROUND)


def _cylinder() -> tuple[Shape, ...]:
    top, foot, x, rx, ry = 8.0, 31.0, 22.0, 12.0, 4.5
    side = (*arc((x, foot), rx, ry, 180, 0), *arc((x, top), rx, ry, 0, -180, "L"), ("Z", ()))
    return Shape(side, _across(x - rx, x + rx)), Shape(ellipse((x, top), rx, ry), 0.35)


def _cone() -> tuple[Shape, ...]:
    x, foot, rx, ry = 22.0, 31.0, 13.0, 4.5
    return (Shape((*arc((x, foot), rx, ry, 180, 0), ("L", (x, 4.0)), ("Z", ())), _across(x - rx, x + rx)),)


def _torus() -> tuple[Shape, ...]:
    ring = (*ellipse((22, 19), 19, 12), *ellipse((22, 17.5), 8, 3.6))
    return (
        Shape(ring, Gradient((15, 9), (44, 30), ((0.0, 0.4), (0.45, 0.0), (1.0, -0.38)), radial=True)),
        Shape(arc((22, 16.2), 9.5, 4.6, 20, 160), None),
    )


def _halfspace() -> tuple[Shape, ...]:
    plane = lines((2, 20), (15, 11), (42, 15), (29, 25))
    hatch = tuple(
        part
        for x, y in ((7, 21.5), (13, 22.6), (19, 23.6), (25, 24.6), (31, 23.6), (36, 19.8))
        for part in lines((x, y), (x - 3, y + 8), closed=False)
    )
    arrow = (*lines((22, 18), (22, 4), closed=False), *lines((18.5, 8), (22, 3), (25.5, 8), closed=False))
    return Shape(hatch, None), Shape(plane, 0.25), Shape(arrow, None)


def _gem() -> tuple[Shape, ...]:
    a, b, c, d, e, f = (22, 2), (6, 15), (18, 21), (38, 16), (27, 12), (22, 36)
    return (
        Shape(lines(a, b, c), 0.35), Shape(lines(a, c, d), 0.1), Shape(lines(b, c, f), -0.1),
        Shape(lines(c, d, f), -0.3), Shape((*lines(a, e, d, closed=False),), None, False),
    )  # fmt: skip


def _mesh() -> tuple[Shape, ...]:
    rim = ((12, 5), (31, 4), (41, 17), (34, 33), (13, 34), (3, 19))
    middle = (21, 17)
    shades = (0.4, 0.12, -0.18, -0.32, -0.12, 0.22)
    return tuple(
        Shape(lines(middle, rim[i], rim[(i + 1) % 6]), shade) for i, shade in enumerate(shades)
    )  # fmt: skip


PRIMITIVES: dict[str, tuple[Shape, ...]] = {
    "box": (
        Shape(lines((22, 2), (38, 10), (22, 18), (6, 10)), 0.38),
        Shape(lines((6, 10), (22, 18), (22, 36), (6, 28)), 0.05),
        Shape(lines((38, 10), (22, 18), (22, 36), (38, 28)), -0.25),
    ),
    "sphere": (
        Shape(
            ellipse((22, 19), 16, 16),
            Gradient((16, 12), (16, 36), ((0.0, 0.7), (0.35, 0.12), (1.0, -0.42)), radial=True),
        ),
    ),
    "cylinder": _cylinder(),
    "cone": _cone(),
    "torus": _torus(),
    "halfspace": _halfspace(),
    "polyhedron": _gem(),
    "imported_mesh": _mesh(),
    "relief": (
        Shape(lines((2, 26), (10, 15), (15, 20), (23, 6), (30, 17), (34, 13), (42, 24), (42, 32), (2, 32)), 0.2),
        Shape(lines((15, 20), (23, 6), (30, 17), (23, 24)), -0.2),
    ),
    "rectangle": (Shape(lines((5, 8), (39, 8), (39, 30), (5, 30)), 0.3),),
    "circle": (Shape(ellipse((22, 19), 15, 15), 0.3),),
    "path": (
        Shape(
            (("M", (6, 31)), ("C", (6, 6, 20, 22, 24, 10)), ("C", (26, 4, 38, 4, 38, 12)), ("L", (38, 31)), ("Z", ())),
            0.3,
        ),
    ),
    "bezier": (
        Shape(lines((6, 32), (6, 8), (36, 6), closed=False), None),
        Shape((("M", (6, 32)), ("C", (6, 14, 16, 6, 36, 6))), None),
        *(Shape(ellipse(place, 2.4, 2.4), 0.3) for place in ((6, 32), (6, 8), (36, 6))),
    ),
    "bspline": (
        Shape((("M", (4, 26)), ("C", (12, 10, 14, 10, 20, 19)), ("C", (26, 28, 30, 28, 40, 12))), None),
        *(Shape(ellipse(place, 2.4, 2.4), 0.3) for place in ((4, 26), (13, 7), (27, 31), (40, 12))),
    ),
    "polygon": (Shape(lines((10, 6), (36, 10), (30, 22), (39, 33), (6, 31)), 0.3),),
    "lettering": (
        Shape(
            (
                *lines((5, 33), (18, 5), (26, 5), (39, 33), (32, 33), (29, 26), (15, 26), (12, 33)),
                *lines((17.5, 20), (26.5, 20), (22, 10)),
            ),
            0.3,
        ),
    ),
}
"""By the name that scripts use."""

UNKNOWN: tuple[Shape, ...] = (Shape(lines((5, 4), (39, 4), (39, 34), (5, 34)), 0.3),)
FRAME = lines((1, 1), (WIDTH - 1, 1), (WIDTH - 1, HEIGHT - 1), (1, HEIGHT - 1))
"""Around the picture of an instance, dashed."""


def _squares() -> Path:
    return tuple(part for x in (-9, -2.5, 4) for part in lines((x, -2.5), (x + 5, -2.5), (x + 5, 2.5), (x, 2.5)))


def _circles() -> Path:
    places = ((6.5 * math.cos(math.radians(a)), 6.5 * math.sin(math.radians(a))) for a in (-90, -18, 54, 126, 198))
    return tuple(part for place in places for part in ellipse(place, 2.2, 2.2))


SYMBOLS: dict[str, Path] = {
    "union": (*lines((-6, -8), (-6, 1), closed=False), *arc((0, 1), 6, 6.5, 180, 0, "L"), ("L", (6, -8))),
    "intersection": (*lines((-6, 8), (-6, -1), closed=False), *arc((0, -1), 6, 6.5, 180, 360, "L"), ("L", (6, 8))),
    "difference": lines((-7, 0), (7, 0), closed=False),
    "minkowski": (*lines((-7, 0), (7, 0), closed=False), *lines((0, -7), (0, 7), closed=False)),
    "displace": (
        ("M", (-8.0, 6.0)), ("L", (-8.0, 0.0)), ("C", (-5.0, -8.0, -3.0, -8.0, 0.0, 0.0)),
        ("C", (3.0, 8.0, 5.0, 0.0, 8.0, -4.0)), ("L", (8.0, 6.0)), ("Z", ()),
    ),
    "hull": lines((-7, -1), (-1, -8), (7, -4), (6, 5), (-4, 7)),
    "linear_array": _squares(),
    "polar_array": _circles(),
    "mirror": (
        *lines((0, -9), (0, 9), closed=False), *lines((-3, -5), (-3, 5), (-9, 5)), *lines((3, -5), (3, 5), (9, 5)),
    ),
    "extrude": (
        *lines((-8, 7), (8, 7), closed=False), *lines((0, 3), (0, -8), closed=False),
        *lines((-4, -4), (0, -8), (4, -4), closed=False),
    ),
    "sweep": (
        *ellipse((-5, 5), 3.5, 3.5), ("M", (-5, 1.5)), ("C", (-5, -5, -1, -8, 8, -8)),
        ("M", (-1.5, 5)), ("C", (-1.5, 0, 1, -1.5, 8, -1.5)),
    ),
    "loft": (
        *lines((-4, -8), (4, -8), closed=False), *lines((-8, 8), (8, 8), closed=False),
        ("M", (-4, -8)), ("C", (-4, -2, -8, 2, -8, 8)), ("M", (4, -8)), ("C", (4, -2, 8, 2, 8, 8)),
    ),
    "pipe": (
        ("M", (-9, -2)), ("L", (-4, -2)), ("C", (-1, -2, 2, 1, 2, 4)), ("L", (2, 9)),
        ("M", (-9, -8)), ("L", (-4, -8)), ("C", (3, -8, 8, -3, 8, 4)), ("L", (8, 9)),
    ),
    "wrap": (
        *ellipse((0, -6), 7, 2.5), *lines((-7, -6), (-7, 6), closed=False), *arc((0, 6), 7, 2.5, 180, 0, "L"),
        ("L", (7, -6)), *lines((-4, 5), (-1.5, -1), (1, 5.5), closed=False),
    ),
    "text_on_path": (
        ("M", (-9, 8)), ("C", (-5, 3, 5, 3, 9, 8)),
        *lines((-4.5, 1.5), (0, -9), (4.5, 1.5), closed=False), *lines((-3, -2), (3, -2), closed=False),
    ),
    "stencil": (*arc((-1, 0), 7, 8, 105, 255), *arc((1, 0), 7, 8, -75, 75)),
    "revolve": (*arc((0, 0), 7, 7, -60, 220), *lines((-9, -8.5), (-5.4, -4.5), (-10.3, -2.6), closed=False)),
}  # fmt: skip
