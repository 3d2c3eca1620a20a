"""Glyphs of TrueType: quadratic contours in whole units."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from fontTools.cu2qu import curve_to_quadratic
from fontTools.pens.ttGlyphPen import TTGlyphPen

from ...path.path import Path
from .drawing import draw

Place = tuple[float, float]
FINE = 0.2
"""Font units that quadratics may be off the cubics they stand for; rounding adds up to 0.71."""
HINTS = ("cvt ", "cvar", "fpgm", "prep", "hdmx", "VDMX", "LTSH")
"""Tables of TrueType's hinting."""


def glyph_of(outline: Path) -> Any:
    """A `glyf` entry without hints; quadratics as they are, cubics as quadratics within FINE."""
    pen = TTGlyphPen(None)
    draw(outline, _Quadratics(pen))
    return pen.glyph()


class _Quadratics:
    """A pen that gives cubics on as quadratics whose ends are points of their own: those that are implied halfway
    between control points are rounded again by some readers."""

    def __init__(self, pen: Any) -> None:
        self._pen, self._here = pen, (0.0, 0.0)
        self.closePath = pen.closePath

    def moveTo(self, point: Place) -> None:
        self._here = point
        self._pen.moveTo(point)

    def lineTo(self, point: Place) -> None:
        self._here = point
        self._pen.lineTo(point)

    def qCurveTo(self, control: Place, point: Place) -> None:
        self._here = point
        self._pen.qCurveTo(control, point)

    def curveTo(self, first: Place, second: Place, point: Place) -> None:
        _, *controls, end = curve_to_quadratic([self._here, first, second, point], FINE)
        for one, two in pairwise(controls):
            self.qCurveTo(one, (0.5 * (one[0] + two[0]), 0.5 * (one[1] + two[1])))
        self.qCurveTo(controls[-1], end)


def put_glyphs(font: Any, outlines: Mapping[str, tuple[Path, float]]) -> None:
    """Put outlines and advances in the place of those that an open TrueType font has."""
    glyf, metrics = font["glyf"], font["hmtx"]
    for name, (outline, advance) in outlines.items():
        glyph = glyph_of(outline)
        glyf[name] = glyph
        glyph.recalcBounds(glyf)
        metrics[name] = (max(round(advance), 0), getattr(glyph, "xMin", 0) if glyph.numberOfContours else 0)


def make_truetype(font: Any, outlines: Mapping[str, tuple[Path, float]]) -> None:
    """Give an open font TrueType outlines for all its glyphs instead of what it has."""
    from fontTools.fontBuilder import FontBuilder

    builder = FontBuilder(font=font)
    builder.isTTF = True  # which it would tell from what it has so far
    font.sfntVersion = "\x00\x01\x00\x00"
    builder.setupGlyf({name: glyph_of(outline) for name, (outline, _) in outlines.items()})
    glyf = font["glyf"]
    for name, (_, advance) in outlines.items():
        font["hmtx"][name] = (max(round(advance), 0), getattr(glyf[name], "xMin", 0))
    builder.setupMaxp()
    post = font["post"]
    post.formatType, post.extraNames, post.mapping = 2.0, [], {}
    post.glyphOrder = font.getGlyphOrder()
    font["head"].glyphDataFormat = 0
