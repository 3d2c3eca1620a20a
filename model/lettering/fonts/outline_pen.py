"""A fontTools pen that draws our contours, each segment of the kind that the font gives it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from fontTools.pens.basePen import BasePen

from ...path.path import Contour, Kind, Path

Place = tuple[float, float]


class OutlinePen(BasePen):
    """Implied points of TrueType become nodes; every contour closes; components are drawn where they belong."""

    def __init__(self, glyphs: Mapping[str, Any] | None = None) -> None:
        super().__init__(glyphs)
        self._points: list[Place] = []
        self._kinds: list[Kind] = []
        self._contours: list[Contour] = []

    def path(self) -> Path:
        return Path(tuple(self._contours))

    def _moveTo(self, pt: Place) -> None:
        self._finish()
        self._points = [pt]

    def _lineTo(self, pt: Place) -> None:
        if pt != self._points[-1]:
            self._points.append(pt)
            self._kinds.append(Kind.LINE)

    def _qCurveToOne(self, pt1: Place, pt2: Place) -> None:
        self._points += (pt1, pt2)
        self._kinds.append(Kind.QUADRATIC)

    def _curveToOne(self, pt1: Place, pt2: Place, pt3: Place) -> None:
        self._points += (pt1, pt2, pt3)
        self._kinds.append(Kind.CUBIC)

    def _closePath(self) -> None:
        self._finish()

    def _endPath(self) -> None:
        self._finish()

    def _finish(self) -> None:
        if self._points:
            self._lineTo(self._points[0])
        if self._kinds:
            self._contours.append(Contour(np.array(self._points, float), np.array(self._kinds, np.uint8), closed=True))
        self._points, self._kinds = [], []


class Overlaid(Mapping[str, Any]):
    """A font's glyphs, some of which other outlines stand for: for what is put together from them."""

    def __init__(self, glyphs: Mapping[str, Any], outlines: Mapping[str, Path]) -> None:
        self._glyphs, self._outlines = glyphs, outlines

    def __getitem__(self, name: str) -> Any:
        return _Outline(self._outlines[name]) if name in self._outlines else self._glyphs[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._glyphs)

    def __len__(self) -> int:
        return len(self._glyphs)


@dataclass(frozen=True, slots=True)
class _Outline:
    path: Path

    def draw(self, pen: Any) -> None:
        for contour in self.path.contours:
            points = [tuple(point) for point in contour.points.tolist()]
            pen.moveTo(points[0])
            at = 1
            for kind in contour.kinds.tolist():
                (pen.lineTo, pen.qCurveTo, pen.curveTo)[kind - 1](*points[at : at + kind])
                at += kind
            pen.closePath()
