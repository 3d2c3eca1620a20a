"""Path data of SVG (SVG 1.1 section 8.3, SVG 2 section 9.3): what is right before the first fault is kept."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from ...document.errors import Refusal
from ...path.shapes import svg_arc
from .drawing_shapes import Outline
from .svg_units import COMMA, LARGEST, NUMBER, SPACE, numbers_at

_SPACE = re.compile(SPACE)
_COMMA = re.compile(COMMA)
_NUMBER = re.compile(NUMBER)
# The two flags are one digit each, which nothing need part from what follows: “a25 25 0 1125-25”.
_ARC = re.compile(
    rf"({NUMBER}){COMMA}({NUMBER}){COMMA}({NUMBER}){COMMA}([01]){COMMA}([01]){COMMA}({NUMBER}){COMMA}({NUMBER})"
)
_COUNT = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "t": 2, "a": 7, "z": 0}


def read_path(text: str, tolerance: float | None = None) -> tuple[Outline, str]:
    """The outline of path data in its own units, y as it stands, and words for the first fault (empty: none).

    Every kind stays what it is but arcs, which become cubics: a quarter turn each at most, which leave the arc by at
    most 2.73e-4 of its larger radius, or as many as keep within `tolerance` units. Without a moveto there is nothing.
    """
    reader = _PathReader(text, tolerance)
    fault = reader.read()
    return reader.outline, fault


def path_commands(text: str, tolerance: float | None = None) -> list[tuple[Any, ...]]:
    """The commands of path data, y as it stands, in millimetres. Raises Refusal at the first fault."""
    outline, fault = read_path(text, tolerance)
    if fault:
        raise Refusal(f"the path cannot be read: {fault}")
    commands = [command for contour in outline.contours((1.0, 0.0, 0.0, 1.0, 0.0, 0.0)) for command in contour]
    if not commands:
        raise Refusal("the path has no segment; it begins like “M 0 0 L 10 0”")
    return [(word, *(tuple(point.tolist()) for point in points)) for word, *points in commands]


def _after(pattern: re.Pattern[str], text: str, at: int) -> int:
    """Where a pattern that stands at a place ends."""
    match = pattern.match(text, at)
    return match.end() if match else at


class _PathReader:
    def __init__(self, text: str, tolerance: float | None) -> None:
        self.text, self.tolerance = text, tolerance
        self.outline = Outline()
        self.x = self.y = 0.0
        self.start = (0.0, 0.0)
        self.handle: tuple[str, float, float] = ("", 0.0, 0.0)  # of the segment before: "c" or "q", and its last handle
        self.closed = False

    def read(self) -> str:
        text = self.text
        at = _after(_SPACE, text, 0)
        while at < len(text):
            letter = text[at]
            kind = letter.lower()
            if kind not in _COUNT:
                return self._fault(at, "is no command")
            if kind != "m" and not self.outline.words:
                return self._fault(at, "stands before the first moveto")
            at = _after(_SPACE, text, at + 1)
            if kind == "z":
                self._close()
                continue
            values, end = self._arcs(at) if kind == "a" else numbers_at(text, at)
            at = _after(_SPACE, text, end)
            good = len(values) - len(values) % _COUNT[kind]
            if good:
                self._segments(kind, values[:good], letter == kind)
            if not values or good < len(values):
                return self._fault(at, f"stands where “{letter}” needs {_COUNT[kind]} numbers")
        return ""

    def _fault(self, at: int, what: str) -> str:
        word = self.text[at : at + 12].split(maxsplit=1)
        found = f"“{word[0]}”" if word else "its end"
        number = _NUMBER.match(self.text, at)
        if number and abs(float(number[0])) > LARGEST:
            what = "is too large a number"
        return f"character {at + 1:,} of the path data: {found} {what}; what stands before it is kept"

    def _arcs(self, at: int) -> tuple[list[float], int]:
        values: list[float] = []
        end = at
        while match := _ARC.match(self.text, at):
            group = [float(word) for word in match.groups()]
            if max(map(abs, group)) > LARGEST:
                break
            values += group
            end = match.end()
            at = _after(_COMMA, self.text, end)
        # What begins as one more arc is a fault in it; a letter begins the next command.
        return values, end if self.text[at : at + 1].isalpha() else at

    def _close(self) -> None:
        if not self.closed:
            self.outline.add("close")
        self.x, self.y = self.start
        self.handle, self.closed = ("", 0.0, 0.0), True

    def _segments(self, kind: str, values: list[float], relative: bool) -> None:
        if kind == "m":
            x, y = values[0] + relative * self.x, values[1] + relative * self.y
            self.outline.add("move", x, y)
            self.x, self.y, self.start = x, y, (x, y)
            self.handle, self.closed = ("", 0.0, 0.0), False
            kind, values = "l", values[2:]
        elif self.closed:
            self.outline.add("move", self.x, self.y)
            self.closed = False
        if kind in "lhv":
            self._lines(kind, values, relative)
        elif kind == "a":
            self._elliptical(values, relative)
        else:
            self._curves(kind, values, relative)

    def _lines(self, kind: str, values: list[float], relative: bool) -> None:
        outline = self.outline
        if kind == "l":
            points = self._absolute(values, 2) if relative else values
        else:
            x, y, points = self.x, self.y, []
            for value in values:
                if kind == "h":
                    x = value + x if relative else value
                else:
                    y = value + y if relative else value
                points += (x, y)
        outline.points += points
        outline.words += ["line"] * (len(points) // 2)
        self.x, self.y = points[-2:] or (self.x, self.y)
        self.handle = ("", 0.0, 0.0)

    def _absolute(self, values: list[float], count: int) -> list[float]:
        """Segments of `count` numbers that are relative to where each begins."""
        if len(values) <= count:
            return [value + (self.y if i % 2 else self.x) for i, value in enumerate(values)]
        steps = np.array(values).reshape(-1, count // 2, 2)
        begins = np.cumsum(np.vstack(([self.x, self.y], steps[:-1, -1])), axis=0)
        return (begins[:, None] + steps).ravel().tolist()

    def _curves(self, kind: str, values: list[float], relative: bool) -> None:
        count, family = _COUNT[kind], "c" if kind in "cs" else "q"
        points = self._absolute(values, count) if relative else values
        if kind in "st":
            points = self._smooth(points, count, family)
        self.outline.points += points
        self.outline.words += ["cubic" if family == "c" else "quad"] * (len(values) // count)
        hx, hy, self.x, self.y = points[-4:]
        self.handle = (family, hx, hy)

    def _smooth(self, values: list[float], count: int, family: str) -> list[float]:
        """With the handle that is left out: the one before, mirrored about the node, or the node itself."""
        x, y = self.x, self.y
        last, hx, hy = self.handle
        found: list[float] = []
        for i in range(0, len(values), count):
            found += (2.0 * x - hx, 2.0 * y - hy) if last == family else (x, y)
            found += values[i : i + count]
            last = family
            hx, hy, x, y = found[-4:]
        return found

    def _elliptical(self, values: list[float], relative: bool) -> None:
        for i in range(0, len(values), 7):
            rx, ry, rotation, large, sweep, x, y = values[i : i + 7]
            if relative:
                x, y = x + self.x, y + self.y
            if min(abs(rx), abs(ry)) < 1e-150:
                self.outline.add("line", x, y)
            else:
                start = (self.x, self.y)
                self.outline.cubics(
                    svg_arc(start, (rx, ry), rotation, large == 1.0, sweep == 1.0, (x, y), self.tolerance)
                )
            self.x, self.y = x, y
        self.handle = ("", 0.0, 0.0)
