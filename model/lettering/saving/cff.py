"""Glyphs of OpenType with PostScript outlines: cubic charstrings in whole units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fontTools.pens.t2CharStringPen import T2CharStringPen

from ...path.path import Path
from .drawing import draw


def charstring_of(outline: Path, advance: float, private: Any = None, shared: Any = None) -> Any:
    """A Type 2 charstring without hints; quadratics are elevated, which changes nothing."""
    width: float | None = round(advance)
    if private is not None:
        if width == getattr(private, "defaultWidthX", 0):
            width = None
        else:
            width = round(advance) - getattr(private, "nominalWidthX", 0)
    pen = T2CharStringPen(width, None)
    draw(outline, pen)
    return pen.getCharString(private, shared)


def put_glyphs(font: Any, outlines: Mapping[str, tuple[Path, float]]) -> None:
    """Put outlines and advances in the place of those that an open font with a CFF table has."""
    cff = font["CFF "].cff
    top = cff.topDictIndex[0]
    strings = top.CharStrings
    for name, (outline, advance) in outlines.items():
        private = strings[name].private
        strings[name] = charstring_of(outline, advance, private, cff.GlobalSubrs)
        font["hmtx"][name] = (max(round(advance), 0), left_of(outline))


def make_cff(font: Any, outlines: Mapping[str, tuple[Path, float]], name: str, facts: Mapping[str, str]) -> None:
    """Give an open font a CFF table for all its glyphs instead of the outlines that it has."""
    from fontTools.fontBuilder import FontBuilder

    builder = FontBuilder(font=font)
    builder.isTTF = False  # which it would tell from what it has so far
    strings = {glyph: charstring_of(outline, advance) for glyph, (outline, advance) in outlines.items()}
    builder.setupCFF(name, dict(facts), strings, {})
    for glyph, (outline, advance) in outlines.items():
        font["hmtx"][glyph] = (max(round(advance), 0), left_of(outline))
    builder.setupMaxp()
    font["maxp"].numGlyphs = len(outlines)
    post = font["post"]
    post.formatType = 3.0
    for gone in ("extraNames", "mapping"):
        if hasattr(post, gone):
            delattr(post, gone)


def left_of(outline: Path) -> int:
    return round(float(outline.bounds()[0, 0])) if outline.contours else 0


def rename_cff(font: Any, name: str, family: str, full: str) -> None:
    """Call the CFF table otherwise; its unique numbers were the old font's."""
    cff = font["CFF "].cff
    cff.fontNames[0] = name
    top = cff.topDictIndex[0]
    top.FamilyName, top.FullName = family, full
    for gone in ("UniqueID", "XUID"):
        if hasattr(top, gone):
            delattr(top, gone)
        top.rawDict.pop(gone, None)
