"""TrueType, OpenType and variable fonts: outlines by fontTools, shaping by HarfBuzz."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from typing import Any

import uharfbuzz
from fontTools.misc.encodingTools import getEncoding
from fontTools.ttLib import TTFont

from ...document.errors import Refusal
from ...path.path import Path
from .face import DEFAULT, Axis, Face, Location, Metrics, Run, Shaped
from .failing import failing
from .outline_pen import OutlinePen, Overlaid

hb: Any = uharfbuzz  # a compiled module without types
LOCATIONS = 8
"""Designs of a variable font that are kept drawn from at a time."""


class SfntFace(Face):
    """A face of a file with a table directory. Raises Refusal for one that cannot be read."""

    def __init__(self, data: bytes, number: int = 0) -> None:
        with failing("the font cannot be read"):
            font: Any = TTFont(BytesIO(data), fontNumber=number, lazy=True)
            if not {"glyf", "CFF ", "CFF2", "VARC"} & set(font.keys()):
                raise Refusal("the font has no outlines: a bitmap font makes no lettering")
            self._font = font
            if font.sfntVersion != "OTTO" and "glyf" in font and "CFF " in font:
                del font["CFF "]  # the version says which of the two holds
            self.kind = next(kind for tag, kind in KINDS.items() if tag in font)
            self.units_per_em = float(font["head"].unitsPerEm)
            if not self.units_per_em:
                raise Refusal("the font is damaged: its em has no units")
            self.family, self.style = names_of(font)
            self.glyph_names = tuple(font.getGlyphOrder())
            self.characters = _characters(font)
            self._typed = _typed(font)
            self.axes = _axes(font)
            self.metrics = _metrics(font)
            self.missing = self.glyph_names[0] if self.glyph_names else ".notdef"
            self._face = hb.Face(data, number)
            self.features = _features(self._face)
        self._glyphs: dict[tuple[tuple[str, float], ...], tuple[Mapping[str, Any], Any]] = {}

    def outline(self, glyph: str, location: Location = DEFAULT, instead: Mapping[str, Path] | None = None) -> Path:
        glyphs, _ = self._at(location)
        self._known(glyph)
        with failing(f"the outline of glyph “{glyph}” cannot be read"):
            pen = OutlinePen(Overlaid(glyphs, instead) if instead else glyphs)
            glyphs[glyph].draw(pen)
            return pen.path()

    def advance(self, glyph: str, location: Location = DEFAULT) -> float:
        glyphs, _ = self._at(location)
        self._known(glyph)
        with failing(f"the width of glyph “{glyph}” cannot be read"):
            return float(glyphs[glyph].width)

    def shape(self, run: Run, location: Location = DEFAULT) -> list[Shaped]:
        _, font = self._at(location)
        buffer = hb.Buffer()
        buffer.add_str(run.text.translate(self._typed))
        buffer.direction, buffer.script = run.direction, run.script
        if run.language:
            buffer.language = run.language
        buffer.cluster_level = hb.BufferClusterLevel.MONOTONE_CHARACTERS
        hb.shape(font, buffer, dict(run.features))
        names = self.glyph_names
        return [
            Shaped(
                names[info.codepoint] if info.codepoint < len(names) else self.missing,
                info.cluster,
                (position.x_offset, position.y_offset),
                (position.x_advance, position.y_advance),
            )
            for info, position in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True)
        ]

    def parts(self, glyph: str) -> frozenset[str]:
        if "glyf" not in self._font:
            return frozenset()
        found: set[str] = set()
        open_ = [glyph]
        with failing(f"the outline of glyph “{glyph}” cannot be read"):
            while open_:
                drawn = self._font["glyf"][open_.pop()]
                new = {part.glyphName for part in drawn.components} - found if drawn.isComposite() else set()
                found |= new
                open_ += new
        return frozenset(found)

    @property
    def legal(self) -> list[str]:
        """Copyright, trademark and licence, as its records tell them."""
        names = self._font.get("name")
        found = [names.getDebugName(name_id) or "" for name_id in (0, 7, 13)] if names else []
        if "CFF " in self._font:
            top = self._font["CFF "].cff.topDictIndex[0]
            found += [str(getattr(top, "Notice", "") or ""), str(getattr(top, "Copyright", "") or "")]
        return [text for text in found if text]

    def _known(self, glyph: str) -> None:
        if glyph not in self._font.getReverseGlyphMap():
            raise Refusal(f"{self.name} has no glyph “{glyph}”")

    def _at(self, location: Location) -> tuple[Mapping[str, Any], Any]:
        """The glyphs and the shaper at a place in the design space; values beyond an axis stop at its end."""
        axes = {axis.tag: axis for axis in self.axes}
        unknown = [tag for tag in location if tag.ljust(4) not in axes]
        if unknown:
            known = f": it has {', '.join(tag.strip() for tag in axes)}" if axes else ""
            raise Refusal(f"{self.name} has no axis “{unknown[0]}”{known}")
        place = {
            tag.ljust(4): min(max(float(value), axes[tag.ljust(4)].low), axes[tag.ljust(4)].high)
            for tag, value in location.items()
        }
        key = tuple(sorted(place.items()))
        found = self._glyphs.get(key)
        if found is None:
            with failing("the font cannot be read"):
                font = hb.Font(self._face)
                if self.axes:
                    font.set_variations(place)
                found = self._font.getGlyphSet(location=place) if self.axes else self._font.getGlyphSet(), font
            while len(self._glyphs) >= LOCATIONS:
                del self._glyphs[next(iter(self._glyphs))]
            self._glyphs[key] = found
        return found


KINDS = {"glyf": "TrueType", "VARC": "TrueType", "CFF ": "CFF", "CFF2": "CFF2"}


def names_of(font: Any) -> tuple[str, str]:
    if "name" not in font:
        return "Nameless", ""
    table = font["name"]
    return table.getBestFamilyName() or "Nameless", table.getBestSubFamilyName() or ""


def _characters(font: Any) -> dict[int, str]:
    """By code point; of fonts without a Unicode map, from the map of symbols or that of old Macintosh systems."""
    if "cmap" not in font:
        return {}
    table = font["cmap"]
    best = table.getBestCmap()
    if best is not None:
        return dict(best)
    for one in table.tables:
        if (one.platformID, one.platEncID) == (3, 0):  # F000 to F0FF stand for the characters that typed them
            return {code - 0xF000 if 0xF000 <= code < 0xF100 else code: name for code, name in one.cmap.items()}
    for one in table.tables:
        encoding = _encoding(one)
        if encoding:
            found = ((bytes([code]).decode(encoding, "ignore"), name) for code, name in one.cmap.items() if code < 256)
            return {ord(text): name for text, name in found if len(text) == 1}
    return {}


def _encoding(table: Any) -> str | None:
    """Of a character map of old Macintosh systems; its language counts from 1, 0 being none."""
    if table.platformID != 1:
        return None
    return getEncoding(1, table.platEncID, table.language - 1 if table.language else 0)


def _typed(font: Any) -> dict[int, str]:
    """HarfBuzz takes every map of old Macintosh systems for Mac Roman: what it calls the characters of another."""
    if "cmap" not in font or font["cmap"].getBestCmap() is not None:
        return {}
    found = {}
    for one in font["cmap"].tables:
        encoding = _encoding(one)
        if encoding and encoding != "mac_roman":
            for code in one.cmap:
                text = bytes([code]).decode(encoding, "ignore") if code < 256 else ""
                if len(text) == 1:
                    found[ord(text)] = bytes([code]).decode("mac_roman")
    return found


def _features(face: Any) -> tuple[str, ...]:
    found: set[str] = set()
    for table in ("GSUB", "GPOS"):
        for script in range(len(face.get_table_script_tags(table))):
            languages = range(len(face.get_script_language_tags(table, script)))
            for language in (0xFFFF, *languages):
                found.update(face.get_language_feature_tags(table, script, language))
    return tuple(sorted(found))


def _axes(font: Any) -> tuple[Axis, ...]:
    if "fvar" not in font:
        return ()
    names = font.get("name")
    return tuple(
        Axis(
            axis.axisTag,
            (names.getDebugName(axis.axisNameID) if names else None) or axis.axisTag,
            axis.minValue,
            axis.defaultValue,
            axis.maxValue,
        )
        for axis in font["fvar"].axes
    )


def _metrics(font: Any) -> Metrics:
    em = float(font["head"].unitsPerEm)
    hhea = font.get("hhea")
    os2 = font.get("OS/2")
    ascender, descender, gap = (hhea.ascent, hhea.descent, hhea.lineGap) if hhea else (0.8 * em, -0.2 * em, 0.0)
    if os2 is not None and (not (ascender or descender) or os2.fsSelection & 0x80):  # USE_TYPO_METRICS
        ascender, descender, gap = os2.sTypoAscender, os2.sTypoDescender, os2.sTypoLineGap
    slant = -float(font["post"].italicAngle) if "post" in font else 0.0
    return Metrics(
        float(ascender),
        float(descender),
        float(gap),
        float(getattr(os2, "sxHeight", 0) or 0.5 * em),
        float(getattr(os2, "sCapHeight", 0) or 0.7 * em),
        slant,
    )
