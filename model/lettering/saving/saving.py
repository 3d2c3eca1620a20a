"""A font with changed glyphs as a file: TrueType, OpenType with PostScript outlines, or Type 1; read back after."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np

from ...document.errors import Refusal
from ...path.path import Path
from ..fonts.drawn_glyph import DrawnGlyph
from ..fonts.edited_face import EditedFace
from ..fonts.face import DEFAULT, Face, Location
from ..fonts.failing import failing
from ..fonts.opening import open_face
from ..fonts.sfnt_face import SfntFace
from ..fonts.type1_face import Type1Face
from .cff import make_cff, rename_cff
from .cff import put_glyphs as put_charstrings
from .glyf import HINTS, make_truetype
from .glyf import put_glyphs as put_quadratics
from .naming import check_family, full_name, postscript_name, rename
from .type1 import Facts, glyph_names, type1_font

FORMS = ("ttf", "otf", "pfb")
STRIKES = ("EBDT", "EBLC", "EBSC", "CBDT", "CBLC", "sbix", "bdat", "bloc")
"""Tables of pictures of glyphs, which would show the old shapes."""
OTHER_OUTLINES = (
    "glyf",
    "loca",
    "CFF ",
    "CFF2",
    "VORG",
    "gvar",
    "avar",
    "HVAR",
    "VVAR",
    "MVAR",
    "fvar",
    "STAT",
    "VARC",
)
SAMPLES = 50
"""Unchanged glyphs that are compared after writing."""
WITHIN = 1.0
"""Font units that a written outline may be off."""
Outlines = Mapping[str, tuple[Path, float]]


class _Outlines(Outlines):
    """The outline and the advance of each glyph of a face, drawn when asked for."""

    def __init__(self, face: Face, location: Location) -> None:
        self._face, self._location = face, location
        self._drawn: dict[str, tuple[Path, float]] = {}

    def __getitem__(self, name: str) -> tuple[Path, float]:
        if name not in self._drawn:
            self._drawn[name] = self._face.outline(name, self._location), self._face.advance(name, self._location)
        return self._drawn[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._face.glyph_names)

    def __len__(self) -> int:
        return len(self._face.glyph_names)


@dataclass(frozen=True, slots=True)
class Saved:
    """A font file's bytes, and words on what in it is not as it was."""

    data: bytes
    remarks: tuple[str, ...]


def saved_font(
    data: bytes,
    number: int,
    glyphs: Mapping[str, DrawnGlyph],
    family: str,
    form: str,
    location: Location = DEFAULT,
) -> Saved:
    """The font in `data` (its face `number`) with `glyphs` drawn anew, as a "ttf", "otf" or "pfb" file.

    `family` is its new name; of a variable font the instance at `location` is saved. Copyright and licence stay.
    Raises Refusal, also where the file read back is not what was to be written.
    """
    if form not in FORMS:
        raise Refusal(f"a font is saved as {', '.join(f'.{one}' for one in FORMS)}, not “.{form:.20}”")
    family = check_family(data, number, family)
    base = open_face(data, number)
    face = EditedFace(base, glyphs)
    unknown = [name for name in glyphs if name not in set(base.glyph_names)]
    if unknown:
        raise Refusal(f"{base.name} has no glyph “{unknown[0]:.60}”")
    with failing("the font cannot be written"):
        outlines = _Outlines(face, location)
        names = {name: name for name in base.glyph_names}
        if form == "pfb":
            names = glyph_names(base.glyph_names, base.characters)
            written, remarks = _type1(base, {names[name]: outlines[name] for name in base.glyph_names}, family)
        else:
            written, remarks = _sfnt(data, number, base, glyphs, outlines, family, form, location)
    if isinstance(base, SfntFace) and base.axes:
        remarks.append("the font is one design of the variable one, without axes")
    _check(written, outlines, names, glyphs)
    return Saved(written, tuple(remarks))


def _sfnt(
    data: bytes,
    number: int,
    base: Face,
    glyphs: Mapping[str, DrawnGlyph],
    outlines: Outlines,
    family: str,
    form: str,
    location: Location,
) -> tuple[bytes, list[str]]:
    from fontTools.ttLib import TTFont

    remarks: list[str] = []
    name, full = postscript_name(family, base.style), full_name(family, base.style)
    if isinstance(base, SfntFace):
        font: Any = TTFont(BytesIO(data), fontNumber=number, recalcTimestamp=False)
        if "VARC" in font:
            raise Refusal("a font of variable composites (VARC) cannot be saved yet: save its letters as outlines")
        font.flavor = None
        font.ensureDecompiled()
        _complete(font)
        if "fvar" in font:
            font = _instance(font, base, location)
    else:
        font = _bare(base)
        remarks.append("Type 1 fonts keep their kerning in a file of its own, which is not read")
    truetype = form == "ttf"
    own = "glyf" if truetype else "CFF "
    kept = (own in font and font.sfntVersion == ("\x00\x01\x00\x00" if truetype else "OTTO")) or (
        own in font and not ({"glyf", "CFF ", "CFF2"} - {own}) & set(font.keys())
    )
    _drop(font, STRIKES if glyphs else (), ("DSIG", "FFTM"))
    if kept:
        changed = {name: outlines[name] for name in glyphs}
        (put_quadratics if truetype else put_charstrings)(font, changed)
        if changed and truetype:
            remarks.append("changed glyphs have lost their hinting")
    else:
        reversed_ = {name: (outline.reversed(), advance) for name, (outline, advance) in outlines.items()}
        other = reversed_ if isinstance(base, SfntFace) and (base.kind == "TrueType") != truetype else outlines
        if isinstance(base, Type1Face) and truetype:
            other = reversed_
        _drop(font, HINTS, OTHER_OUTLINES)
        if truetype:
            make_truetype(font, other)
        elif font.getGlyphOrder()[0] != ".notdef":
            raise Refusal("its first glyph is not “.notdef”, which OpenType with cubic curves asks for: save it as TTF")
        else:
            make_cff(font, other, name, {"FullName": full, "FamilyName": family})
        remarks.append(f"all outlines are {'quadratic' if truetype else 'cubic'} now, without hinting")
    rename(font, family, base.style)
    if "CFF " in font:
        rename_cff(font, name, family, full)
    out = BytesIO()
    font.save(out, reorderTables=False)
    return out.getvalue(), remarks


def _complete(font: Any) -> None:
    """Give a font the tables that it lacks and every font is to have."""
    from fontTools.fontBuilder import FontBuilder

    builder = FontBuilder(font=font)
    if "name" not in font:
        builder.setupNameTable({})
    if "post" not in font:
        builder.setupPost()


def _instance(font: Any, base: Face, location: Location) -> Any:
    """The one design of a variable font, whose glyphs are put in afterwards."""
    from fontTools.varLib.instancer import instantiateVariableFont

    given = {tag.ljust(4): float(value) for tag, value in location.items()}
    place = {axis.tag: min(max(given.get(axis.tag.ljust(4), axis.default), axis.low), axis.high) for axis in base.axes}
    return instantiateVariableFont(font, place, inplace=True)


def _bare(base: Face) -> Any:
    """A font of a Type 1 face's names, characters and metrics, without outlines yet."""
    from fontTools.fontBuilder import FontBuilder

    metrics = base.metrics
    builder = FontBuilder(round(base.units_per_em), isTTF=True)
    order = [base.missing, *(name for name in base.glyph_names if name != base.missing)]
    builder.setupGlyphOrder(order)
    builder.setupCharacterMap(dict(base.characters))
    builder.setupHorizontalMetrics({name: (0, 0) for name in order})
    rise, fall = round(metrics.ascender), round(metrics.descender)
    builder.setupHorizontalHeader(ascent=rise, descent=fall, lineGap=round(metrics.line_gap))
    builder.setupNameTable({"familyName": base.family, "styleName": base.style or "Regular"})
    builder.setupOS2(sTypoAscender=rise, sTypoDescender=fall, usWinAscent=max(rise, 0), usWinDescent=max(-fall, 0),
                     sxHeight=round(metrics.x_height), sCapHeight=round(metrics.cap_height))  # fmt: skip
    builder.setupPost(italicAngle=-metrics.slant)
    font: Any = builder.font
    font.recalcTimestamp = False
    font["head"].created = font["head"].modified = 0
    notice = getattr(base, "notice", "")
    if notice:
        font["name"].setName(notice, 0, 3, 1, 0x409)
    return font


def _type1(base: Face, outlines: Outlines, family: str) -> tuple[bytes, list[str]]:
    remarks = ["Type 1 fonts hold no hinting of ours"]
    legal = [text for text in getattr(base, "legal", [getattr(base, "notice", "")]) if text]
    if isinstance(base, SfntFace):
        remarks = [
            "Type 1 fonts hold neither kerning nor OpenType features",
            "all outlines are cubic now, without hinting",
        ]
        if base.kind == "TrueType":
            outlines = {name: (outline.reversed(), advance) for name, (outline, advance) in outlines.items()}
    facts = Facts(
        postscript_name(family, base.style),
        family,
        full_name(family, base.style),
        base.style or "Regular",
        " ".join(legal),
        "001.000",
        base.units_per_em,
        base.metrics.slant,
    )
    return type1_font(outlines, facts), remarks


def _drop(font: Any, *tags: tuple[str, ...]) -> None:
    for group in tags:
        for tag in group:
            if tag in font:
                del font[tag]


def _check(written: bytes, outlines: Outlines, names: Mapping[str, str], changed: Mapping[str, DrawnGlyph]) -> None:
    """Read the file back. Raises Refusal where a changed glyph, or one of some others, is not what it should be."""
    again = open_face(written)
    others = [name for name in outlines if name not in changed]
    for name in [*changed, *others[:: max(len(others) // SAMPLES, 1)]]:
        outline, advance = outlines[name]
        found, width = again.outline(names[name]), again.advance(names[name])
        fault = abs(width - max(advance, 0.0)) > WITHIN or not _alike(outline, found)
        if fault:
            raise Refusal(f"the glyph “{name}” did not come back from the written font as it was: nothing is saved")


def _alike(one: Path, two: Path) -> bool:
    """Whether two outlines have one box within a unit, and one area within a unit along their length."""
    if not one.contours or not two.contours:
        return abs(one.area()) <= one.length() * WITHIN if one.contours else not two.contours
    if np.abs(one.bounds() - two.bounds()).max() > WITHIN + 1e-6:
        return False
    return abs(abs(one.area()) - abs(two.area())) <= WITHIN * one.length() + 1.0
