"""Type 1 fonts (PFA, PFB, and as Unix and old Macintosh systems keep them)."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from typing import Any

from fontTools import agl
from fontTools.t1Lib import T1Font

from ...document.errors import Refusal
from ...path.path import Path
from .face import DEFAULT, Face, Location, Metrics, Run, Shaped
from .failing import failing
from .outline_pen import OutlinePen


class Type1Face(Face):
    """Its characters are those that its glyphs are named for; it has no kerning of its own (that is in AFM files)."""

    kind = "Type 1"

    def __init__(self, data: bytes) -> None:
        with failing("the font cannot be read"):
            font: Any = _parsed(data)
            facts = font.font
            self._glyphs = font.getGlyphSet()
            self.glyph_names = tuple(sorted(self._glyphs.keys()))
            matrix = [float(value) for value in facts.get("FontMatrix", (0.001,))]
            self.units_per_em = round(1.0 / matrix[0], 6) if matrix[0] else 1000.0
            info = facts.get("FontInfo", {})
            self.family = str(info.get("FamilyName") or facts.get("FontName") or "Nameless")
            self.style = style_of(info, self.family)
            self.notice = str(info.get("Notice") or "")
            box = [float(value) for value in facts.get("FontBBox", ())] or [0.0, -200.0, 1000.0, 800.0]
            slant = -float(info.get("ItalicAngle") or 0.0)
        self.characters = {}
        for name in self.glyph_names:
            text = agl.toUnicode(name)
            if len(text) == 1:
                self.characters.setdefault(ord(text), name)
        self.missing = ".notdef" if ".notdef" in self._glyphs else self.glyph_names[0]
        self.metrics = Metrics(box[3], box[1], 0.0, self._height("x", 0.5), self._height("H", 0.7), slant)

    def outline(self, glyph: str, location: Location = DEFAULT, instead: Mapping[str, Path] | None = None) -> Path:
        self._known(glyph, location)
        with failing(f"the outline of glyph “{glyph}” cannot be read"):
            pen = OutlinePen(self._glyphs)
            self._glyphs[glyph].draw(pen)
            return pen.path()

    def advance(self, glyph: str, location: Location = DEFAULT) -> float:
        self._known(glyph, location)
        with failing(f"the width of glyph “{glyph}” cannot be read"):
            drawn = self._glyphs[glyph]
            if not hasattr(drawn, "width"):
                drawn.draw(OutlinePen(self._glyphs))
            return float(drawn.width)

    def shape(self, run: Run, location: Location = DEFAULT) -> list[Shaped]:
        """A glyph for each character; accents have no place but their own width."""
        found = []
        for place, character in enumerate(run.text):
            if unicodedata.category(character) in ("Cf", "Cc"):
                continue
            shown = character
            if run.direction == "rtl" and unicodedata.mirrored(character):
                shown = MIRRORED.get(character, character)
            name = self.characters.get(ord(shown), self.missing)
            found.append(Shaped(name, place, (0.0, 0.0), (self.advance(name), 0.0)))
        return found[::-1] if run.direction == "rtl" else found

    def _known(self, glyph: str, location: Location) -> None:
        if location:
            raise Refusal(f"{self.name} has no axis “{next(iter(location))}”: Type 1 fonts are not variable")
        if glyph not in self._glyphs:
            raise Refusal(f"{self.name} has no glyph “{glyph}”")

    def _height(self, glyph: str, otherwise: float) -> float:
        try:
            return float(self.outline(glyph).bounds()[1, 1])
        except (Refusal, ValueError):
            return otherwise * self.units_per_em


MIRRORED = dict(zip("()[]{}<>«»\u2039\u203a≤≥", ")(][}{><»«\u203a\u2039≥≤", strict=True))


def _parsed(data: bytes) -> Any:
    """fontTools opens Type 1 fonts by path alone; the parts of a font that has one are what it makes of the file."""
    import tempfile
    from pathlib import Path as FilePath

    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder) / ("font.pfb" if data[:1] == b"\x80" else "font.pfa")
        file.write_bytes(data)
        font: Any = T1Font(str(file))
        font.parse()
    if "CharStrings" not in font.font or not font.font["CharStrings"]:
        raise Refusal("the font has no glyphs")
    return font


def style_of(info: Mapping[str, Any], family: str) -> str:
    """The style in a Type 1 font's facts: what its full name has beyond the family, else its weight."""
    full = str(info.get("FullName") or "")
    rest = full.removeprefix(family).strip(" -")
    return rest if full.startswith(family) else str(info.get("Weight") or "")
