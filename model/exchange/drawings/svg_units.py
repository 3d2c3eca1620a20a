"""Lengths, view boxes and transforms of SVG (SVG 1.1 chapter 7, SVG 2 chapter 8)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import reduce
from math import cos, hypot, isfinite, radians, sin, sqrt, tan

from .drawing_shapes import Affine

PIXEL = 25.4 / 96.0
"""mm of one px."""
UNITS = {"": 1.0, "px": 1.0, "pt": 4.0 / 3.0, "pc": 16.0, "mm": 96.0 / 25.4, "cm": 96.0 / 2.54, "in": 96.0}
"""px of each."""
IDENTITY: Affine = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
SPACE = r"[ \t\r\n\f]*+"
COMMA = rf"{SPACE},?+{SPACE}"
NUMBER = r"[-+]?(?:[0-9]++(?:\.[0-9]*+)?|\.[0-9]++)(?:[eE][-+]?[0-9]++)?"
LARGEST = 1e15
"""Numbers beyond it count as faults: no unit makes millimetres of them."""
_LENGTH = re.compile(rf"{SPACE}({NUMBER})(em|ex|px|pt|pc|mm|cm|in|%)?{SPACE}", re.IGNORECASE)
_NUMBER = re.compile(NUMBER)
# Some hundred at a time: a match keeps a way back for each.
_RUN = re.compile(rf"{COMMA}{NUMBER}(?:{COMMA}{NUMBER}){{0,499}}")
_FIRST = re.compile(rf"{SPACE}(?={NUMBER})")
_FUNCTION = re.compile(rf"{COMMA}(matrix|translate|scale|rotate|skewX|skewY){SPACE}\(([^()]*+)\){SPACE}")
_COUNTS = {"matrix": (6,), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3), "skewX": (1,), "skewY": (1,)}
_ALIGN = re.compile(r"x(Min|Mid|Max)Y(Min|Mid|Max)")
_SHARE = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}


@dataclass(frozen=True, slots=True)
class Viewport:
    """What percentages refer to, in user units."""

    width: float
    height: float

    def whole(self, axis: str) -> float:
        """100 % along "x" or "y", or of what has no direction."""
        if axis == "x":
            return self.width
        return self.height if axis == "y" else hypot(self.width, self.height) / sqrt(2.0)


def length(text: str, whole: float, font: float) -> float | None:
    """A length in user units, or None where the text is none; `whole` is 100 %, `font` 1 em (1 ex is half of it)."""
    match = _LENGTH.fullmatch(text)
    if not match:
        return None
    value, unit = float(match[1]), (match[2] or "").lower()
    if unit == "%":
        value *= whole / 100.0
    else:
        value *= font if unit == "em" else 0.5 * font if unit == "ex" else UNITS[unit]
    return value if abs(value) <= LARGEST else None


def numbers_at(text: str, at: int) -> tuple[list[float], int]:
    """The numbers of a list that stands at a place, and the place after the last; one that is too large ends it."""
    values: list[float] = []
    match = _FIRST.match(text, at)
    while match:
        at = match.end()
        if match := _RUN.match(text, at):
            run = list(map(float, _NUMBER.findall(text, at, match.end())))
            if max(run) > LARGEST or min(run) < -LARGEST:
                good = next(i for i, value in enumerate(run) if abs(value) > LARGEST)
                starts = [found.start() for found in _NUMBER.finditer(text, at, match.end())]
                return values + run[:good], starts[good]
            values += run
    return values, at


def numbers(text: str) -> tuple[list[float], bool]:
    """The numbers a list begins with, and whether it holds nothing else."""
    values, end = numbers_at(text, 0)
    return values, not text[end:].strip(" \t\r\n\f")


def product(outer: Affine, inner: Affine) -> Affine:
    """First `inner`, then `outer`."""
    a, b, c, d, e, f = outer
    p, q, r, s, t, u = inner
    return (a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f)


def scale_of(matrix: Affine) -> float:
    """The square root of how areas grow."""
    a, b, c, d, _, _ = matrix
    return sqrt(abs(a * d - b * c))


def stretch_of(matrix: Affine) -> float:
    """The most that a length grows: the larger singular value."""
    a, b, c, d, _, _ = matrix
    return 0.5 * (hypot(a + d, b - c) + hypot(a - d, b + c))


def transform(text: str) -> Affine | None:
    """The matrix of a transform attribute; None where it is not one."""
    found: list[Affine] = []
    at = 0
    while at < len(text):
        match = _FUNCTION.match(text, at)
        if not match:
            return None if text[at:].strip() else reduce(product, found, IDENTITY)
        values, whole = numbers(match[2])
        if not whole or len(values) not in _COUNTS[match[1]]:
            return None
        found.append(_function(match[1], values))
        at = match.end()
    matrix = reduce(product, found, IDENTITY)
    return matrix if all(map(isfinite, matrix)) else None


def _function(name: str, values: list[float]) -> Affine:
    if name == "matrix":
        a, b, c, d, e, f = values
        return (a, b, c, d, e, f)
    if name == "translate":
        return (1.0, 0.0, 0.0, 1.0, values[0], values[1] if len(values) > 1 else 0.0)
    if name == "scale":
        return (values[0], 0.0, 0.0, values[-1], 0.0, 0.0)
    if name == "rotate":
        c, s = _turn(values[0])
        x, y = values[1:] or (0.0, 0.0)
        return (c, s, -s, c, x - c * x + s * y, y - s * x - c * y)
    slope = tan(radians(values[0]))
    return (1.0, 0.0, slope, 1.0, 0.0, 0.0) if name == "skewX" else (1.0, slope, 0.0, 1.0, 0.0, 0.0)


def _turn(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact for quarter turns."""
    quarters, rest = divmod(angle, 90.0)
    if rest == 0.0:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters % 4.0)]
    return cos(radians(angle)), sin(radians(angle))


def view_box(text: str) -> tuple[float, float, float, float] | None:
    """(x, y, width, height), or None where there is none or it is wrong; a side of 0 hides everything."""
    values, whole = numbers(text)
    if not whole or len(values) != 4 or values[2] < 0.0 or values[3] < 0.0:
        return None
    return values[0], values[1], values[2], values[3]


def view_matrix(box: tuple[float, float, float, float], width: float, height: float, aspect: str) -> Affine:
    """From a view box with sides above 0 to a rectangle at (0, 0), by preserveAspectRatio."""
    x, y, w, h = box
    wide, high = width / w, height / h
    words = aspect.split()
    if words[:1] == ["defer"]:
        words = words[1:]
    if words[:1] == ["none"]:
        return (wide, 0.0, 0.0, high, -x * wide, -y * high)
    match = _ALIGN.fullmatch(words[0]) if words else None
    across, along = (_SHARE[match[1]], _SHARE[match[2]]) if match else (0.5, 0.5)
    scale = max(wide, high) if words[1:2] == ["slice"] else min(wide, high)
    return (scale, 0.0, 0.0, scale, across * (width - w * scale) - x * scale, along * (height - h * scale) - y * scale)
