"""Commands as files have them, read into contours; what is wrong is told with the number of the command."""

from __future__ import annotations

import numpy as np

from ..document.errors import Refusal
from .path import NAMES, ROUNDING, Command, Contour, Floats, Kind, ends


class Reader:
    """Gathers commands into contours."""

    def __init__(self) -> None:
        self.contours: list[Contour] = []
        self._dimension = 0
        self._begin([])

    def _begin(self, start: list[Floats]) -> None:
        self._rows, self._kinds, self._splines = list(start), [], []

    def read(self, number: int, command: Command) -> None:
        name = command[0] if command else ""
        if name == "move":
            self._take(number, command, 1)
            rows = [self._rows.pop()]
            self.finish()
            self._begin(rows)
        elif not self._rows:
            raise Refusal(f"command {number} of the path, “{name}”, has no point to begin at: put a “move” before it")
        elif name in NAMES:
            kind = NAMES[name]
            self._take(number, command, int(kind))
            self._kinds.append(kind)
        elif name == "spline":
            self._spline(number, command)
        elif name == "close":
            start = self._rows[0]
            self.finish(closed=True)
            self._begin([start])
        else:
            raise Refusal(
                f"command {number} of the path is “{name!s:.40}”; there are move, line, quad, cubic, spline and close"
            )

    def finish(self, closed: bool = False) -> None:
        if not self._kinds:
            return
        points = np.array(self._rows, float)
        if closed:
            gap = np.abs(points[-1] - points[0]).max()
            if gap <= ROUNDING * np.abs(points).max():
                points[-1] = points[0]
            else:
                points = np.vstack((points, points[:1]))
                self._kinds.append(Kind.LINE)
        self.contours.append(Contour(points, np.array(self._kinds, np.uint8), closed, tuple(self._splines)))

    def _take(self, number: int, command: Command, count: int) -> None:
        if len(command) != count + 1:
            raise Refusal(
                f"command {number} of the path, “{command[0]}”, needs {count} point{'s' * (count > 1)}, "
                f"not {len(command) - 1}"
            )
        for given in command[1:]:
            try:
                point = np.asarray(given, float)
                right = point.shape in ((2,), (3,)) and bool(np.isfinite(point).all())
            except (TypeError, ValueError):
                point, right = np.zeros(0), False
            if not right:
                raise Refusal(
                    f"command {number} of the path, “{command[0]}”, has a point that is not two or three finite "
                    f"numbers: {given!r:.60}"
                )
            self._agree(number, len(point))
            self._rows.append(point)

    def _agree(self, number: int, dimension: int) -> None:
        self._dimension = self._dimension or dimension
        if dimension != self._dimension:
            raise Refusal(
                f"command {number} of the path has a point of {dimension} coordinates, the ones before have "
                f"{self._dimension}"
            )

    def _spline(self, number: int, command: Command) -> None:
        spline = command[1] if len(command) == 2 else None
        if spline is None or not hasattr(spline, "knots"):
            raise Refusal(f"command {number} of the path, “spline”, needs one B-spline")
        begin, end = ends(spline)
        self._agree(number, len(begin))
        if np.abs(begin - self._rows[-1]).max() > ROUNDING * max(np.abs(begin).max(), np.abs(self._rows[-1]).max()):
            self._rows.append(begin)
            self._kinds.append(Kind.LINE)
        self._rows.append(end)
        self._kinds.append(Kind.SPLINE)
        self._splines.append(spline)
