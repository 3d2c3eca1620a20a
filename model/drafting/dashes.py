"""Dashes that fit the line they are on: it begins and ends in one, and what is short has shorter ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .page import Pen, Strokes

Floats = NDArray[np.float64]

GAPS, TURNS = 2, 6
"""Gaps of an open and of a closed line, where there is room for so many."""
LEAST, SHORTEST = 0.4, 0.25
"""What dashes may be shortened to for that, and for one gap at all: the gaps stay as wide as the line is."""
ROUNDED = 4
"""Decimals of a dash in mm, so that equal lines have equal pens."""


def dash_of(dash: tuple[float, float], length: float, closed: bool) -> tuple[float, float]:
    """The pattern, a dash and a gap, at the size at which it fits a line of this length in mm.

    A closed line has a whole number of periods, an open one ends with its last dash. Where no gap fits, one dash covers
    the line.
    """
    line, period = dash[0], sum(dash)
    end = 0.0 if closed else line
    gaps = max(round((length - end) / period), TURNS if closed else GAPS)
    gaps = min(gaps, int((length / LEAST - end) / period))
    if gaps < 1 + closed:  # one gap, two in a closed line, as long as it is one
        gaps = 1 + closed
        if length < SHORTEST * (gaps * period + end):
            return _sized(dash, length / line)
    return _sized(dash, length / (gaps * period + end))


def _sized(dash: tuple[float, float], size: float) -> tuple[float, float]:
    return round(dash[0] * size, ROUNDED), round(dash[1] * size, ROUNDED)


def dashed(role: str, pen: Pen, lines: list[Floats]) -> list[Strokes]:
    """Polylines (k, 2) in mm of paper with a pen of dashes, those together whose pattern is the same."""
    line, gap = pen.dash
    of_dash: dict[tuple[float, float], list[Floats]] = {}
    for points in lines:
        length = float(np.hypot(*np.diff(points, axis=0).T).sum())
        closed = len(points) > 3 and bool((points[0] == points[-1]).all())
        of_dash.setdefault(dash_of((line, gap), length, closed), []).append(points)
    return [Strokes(role, replace(pen, dash=dash), tuple(of_dash[dash])) for dash in sorted(of_dash, reverse=True)]
