"""What scripts do with fonts: their facts, texts and glyphs as data, and changed fonts saved."""

from __future__ import annotations

import os
from typing import Any

from ..document.document import Document


def font_facts(font: str | os.PathLike[str] = "DejaVu Sans", face: int = 0) -> dict[str, Any]:
    """A font's names, kind, metrics in font units, axes and features; by its name, or the path of its file.

    >>> font_facts("GFS Didot")["units_per_em"]
    1000.0
    """
    from ..lettering.fonts.opening import face_count, open_face
    from ..lettering.report import facts_of

    data, number = _data(font, face)
    return facts_of(open_face(data, number), face_count(data))


def font_text(
    text: str,
    font: str | os.PathLike[str] = "DejaVu Sans",
    *,
    face: int = 0,
    size: float | None = None,
    slant: float = 0,
    axes: str = "",
    features: str = "",
    direction: str = "auto",
    language: str = "",
) -> dict[str, Any]:
    """A text as a font shapes it: each glyph's name, place, advance and contours; mm with a `size`, else font units.

    >>> [glyph["x"] for glyph in font_text("AVTo", features="kern=0")["glyphs"]]
    [0.0, 1401.0, 2802.0, 4053.0]
    """
    from ..lettering.fonts.opening import open_face
    from ..lettering.layout import Style
    from ..lettering.lettering import features_of, location_of
    from ..lettering.report import text_of

    opened = open_face(*_data(font, face))
    style = Style(size or opened.units_per_em, slant=slant, direction=direction, language=language,
                  features=features_of(features))  # fmt: skip
    return text_of(opened, text, style, location_of(axes))


def font_glyph(glyph: str, font: str | os.PathLike[str] = "DejaVu Sans", *, face: int = 0) -> dict[str, Any]:
    """One glyph, by its name or its character, as `font_text` gives it, in font units.

    >>> font_glyph("α", "GFS Didot")["glyphs"][0]["advance"]
    627.0
    """
    from ..lettering.fonts.opening import open_face
    from ..lettering.layout import Style
    from ..lettering.report import glyph_of

    opened = open_face(*_data(font, face))
    return glyph_of(opened, glyph, Style(opened.units_per_em), {})


def save_font(
    path: str | os.PathLike[str],
    font: str | os.PathLike[str] = "DejaVu Sans",
    *,
    face: int = 0,
    document: Document | None = None,
    characters: str = "",
    slant: float = 0,
    weight: float = 0,
    family: str | None = None,
) -> tuple[str, ...]:
    """Write a font as TTF, OTF or PFB, by the ending of `path`; what comes back is words on what is not as it was.

    Glyphs of `characters`, such as "α-ω" (none: all), are leaned by `slant` degrees and grown by `weight` units.
    With a `document`, its edited glyphs of the font called `font` come first. `family` is the new font's name; without
    one it is the first that the font's licence allows.
    """
    from ..lettering.fonts.changing import write_changed_font
    from ..lettering.fonts.in_document import file_of

    drawn = None
    if document is None:
        data, number = _data(font, face)
    else:
        data, number, drawn = file_of(document, os.fspath(font))
    return write_changed_font(data, number, path, family, drawn=drawn, characters=characters, slant=slant,
                              weight=weight)  # fmt: skip


def _data(font: str | os.PathLike[str], face: int) -> tuple[bytes, int]:
    from ..lettering.fonts.changing import font_data

    return font_data(font, face)


__all__ = ["font_facts", "font_glyph", "font_text", "save_font"]
