"""Lines of text laid out: glyph outlines where they belong, in millimetres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.outlines import ALIGNMENTS, ANCHORS, DIRECTIONS
from .fonts.face import DEFAULT, Face, Location
from .runs import missing_in
from .shaping import Set, set_line

STEEPEST = 80.0
"""Degrees of slant."""


@dataclass(frozen=True, slots=True)
class Style:
    """How lines are laid out. Lengths in mm; `size` is that of the em; `spacing` is between letters.

    `line_spacing` is a factor on the font's own distance of lines; `width` what the longest line is fitted to, by
    another size of all; `slant` in degrees shears each letter to the right about its baseline.
    """

    size: float = 10.0
    alignment: str = "left"
    anchor: str = "baseline"
    line_spacing: float = 1.0
    spacing: float = 0.0
    width: float | None = None
    slant: float = 0.0
    direction: str = "auto"
    language: str = ""
    features: tuple[tuple[str, int], ...] = ()

    @property
    def shear(self) -> float:
        """How far a letter leans, in parts of its height."""
        return math.tan(math.radians(self.slant))


@dataclass(frozen=True, slots=True)
class Laid:
    """One glyph of a layout: its font's number in the chain, its place in the text, its advance in mm, and the map
    (2, 3) that takes its outline from font units to millimetres."""

    face: int
    glyph: str
    character: int
    advance: float
    matrix: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Layout:
    """`em` is the size of the em, mm, after fitting; `widths` those of the lines; `missing` code points."""

    glyphs: tuple[Laid, ...]
    em: float
    widths: tuple[float, ...]
    missing: tuple[int, ...]


def lay_out(text: str, faces: Sequence[Face], style: Style, location: Location = DEFAULT) -> Layout:
    """Lines one below the other; the first one's baseline, or what `anchor` says, is at y = 0. Raises Refusal."""
    _check(style)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    spacing = style.spacing / style.size
    set_lines = [
        set_line(line, faces, location, style.features, style.direction, style.language, spacing) for line in lines
    ]
    widths = np.array([max(length - spacing, 0.0) if glyphs else 0.0 for glyphs, length in set_lines])
    em = style.size
    if style.width is not None and widths.max() > 0.0:
        em = style.width / float(widths.max())
    first = faces[0]
    metrics = first.metrics
    gap = style.line_spacing * (metrics.ascender - metrics.descender + metrics.line_gap) / first.units_per_em
    top = metrics.ascender / first.units_per_em
    bottom = metrics.descender / first.units_per_em - gap * (len(lines) - 1)
    lift = {"baseline": 0.0, "top": -top, "middle": -(top + bottom) / 2, "bottom": -bottom}[style.anchor]
    longest = float(widths.max())
    laid: list[Laid] = []
    begin = 0
    for number, (line, (glyphs, _)) in enumerate(zip(lines, set_lines, strict=True)):
        width = float(widths[number])
        stretched, start = glyphs, 0.0
        if style.alignment == "justify" and number < len(lines) - 1:
            stretched = _justified(line, glyphs, longest - width)
        else:
            start = {"left": 0.0, "justify": 0.0, "centre": -width / 2, "right": -width}[style.alignment]
        for one in stretched:
            scale = em / faces[one.face].units_per_em
            place = (em * (start + one.x), em * (lift - number * gap + one.y))
            matrix = np.array(((scale, style.shear * scale, place[0]), (0.0, scale, place[1])))
            laid.append(Laid(one.face, one.glyph, begin + one.character, em * one.advance, matrix))
        begin += len(line) + 1
    return Layout(tuple(laid), em, tuple((em * widths).tolist()), tuple(missing_in(text, faces)))


def _check(style: Style) -> None:
    for value, known, what in (
        (style.alignment, ALIGNMENTS, "alignment"),
        (style.anchor, ANCHORS, "anchor"),
        (style.direction, DIRECTIONS, "direction"),
    ):
        if value not in known:
            raise Refusal(f"the {what} of lettering is one of {', '.join(known)}, not “{value!s:.40}”")
    if not style.size > 0.0 or not (style.width is None or style.width > 0.0):
        raise Refusal("the size and the width of lettering must be above 0 mm")
    if abs(style.slant) > STEEPEST:
        raise Refusal(f"letters lean by at most {STEEPEST:g} degrees, not {style.slant:g}")


def _justified(line: str, glyphs: Sequence[Set], more: float) -> list[Set]:
    """The glyphs of a line with `more` ems shared among its spaces."""
    spaces = [place for place, one in enumerate(glyphs) if line[one.character].isspace()]
    if not spaces:
        return list(glyphs)
    share, shift, found = more / len(spaces), 0.0, []
    for place, one in enumerate(glyphs):
        found.append(Set(one.face, one.glyph, one.character, one.x + shift, one.y, one.advance))
        if place in spaces:
            shift += share
    return found
