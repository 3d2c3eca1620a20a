"""What the construction of a point tells in words: its polynomial, how its levels come about, where it is."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, degrees
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ...model.outline.construction import Construction
    from ...model.path.path import Path, Segment

SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
AXES = "xyz"
MINUS = "\N{MINUS SIGN}"
DIGITS = 5


def polynomial(coefficients: Sequence[float], letter: str) -> str:
    """Coefficients of 1, t, t², ... as "2 t³ − 4.5 t + 1", highest first; what is rounding beside the others is left
    out."""
    largest = max(map(abs, coefficients), default=0.0)
    words = ""
    for power in reversed(range(len(coefficients))):
        value = coefficients[power]
        if abs(value) <= 1e-12 * largest:
            continue
        size = f"{abs(value):.{DIGITS}g}"
        factor = "" if power == 0 else letter if power == 1 else letter + str(power).translate(SUPERSCRIPTS)
        term = factor if size == "1" and factor else f"{size} {factor}".strip()
        sign = MINUS if value < 0 else "+"
        if words:
            words += f" {sign} {term}"
        else:
            words = MINUS + term if value < 0 else term
    return words or "0"


def number(value: float) -> str:
    """Five digits, without a zero below 0."""
    return f"{round(value, 6) + 0.0:.{DIGITS}g}".replace("-", MINUS)


def polynomials(made: Construction) -> str:
    """A line for each axis with its polynomial, and one with the point that they give."""
    letter = "t" if made.interval == (0.0, 1.0) else "u"
    lines = []
    for axis, column in zip(AXES, made.polynomial.T.tolist(), strict=False):
        top = polynomial(column, letter)
        lines.append(f"{axis}({letter}) = {top if made.denominator is None else f'({top}) / w({letter})'}")
    if made.denominator is not None:
        lines.append(f"w({letter}) = {polynomial(made.denominator.tolist(), letter)}")
    return "\n".join(lines)


def value(made: Construction) -> str:
    """Where the point is, and where it goes."""
    return f"({'; '.join(number(one) for one in made.point.tolist())}) mm{_direction(made)}"


def _direction(made: Construction) -> str:
    if len(made.tangent) != 2 or not made.tangent.any():
        return ""
    return f", tangent at {number(degrees(atan2(made.tangent[1], made.tangent[0])))}°"


def interval(made: Construction) -> str:
    """Of a B-spline the knot interval in which the point is, else nothing."""
    if made.interval == (0.0, 1.0):
        return ""
    start, end = made.interval
    return f"Parameter {made.parameter:.5g}, in the knot interval {start:.5g} to {end:.5g}; u = {made.u:.4f} there"


def lerp(made: Construction) -> str:
    """How the points of one level make those of the next, for the one who learns it."""
    if made.degree < 1:
        return ""
    if made.plain:
        words = "Each point of a level is (1 \N{MINUS SIGN} t) of the one before and t of the next (de Casteljau)."
    elif made.denominator is None:
        words = (
            "Each point of a level lies between two of the level before, at the share of its knot interval that the "
            "parameter has gone through (de Boor)."
        )
    else:
        words = (
            "Each point of a level lies between two of the level before; the one with more weight draws it nearer "
            "(rational: points times weights are mixed, then divided by the mixed weight)."
        )
    counts = " → ".join(str(len(level)) for level in made.levels)
    return f"{words}\nPoints of the levels: {counts}"


def place(path: Path, at: tuple[int, int], segment: Segment) -> str:
    """Which segment it is."""
    from ...model.outline.construction import kind_of

    contour, row = at
    return f"contour {contour}, segment {row} of {len(path.contours[contour])}, {kind_of(segment)}"
