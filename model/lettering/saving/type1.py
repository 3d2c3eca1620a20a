"""Type 1 fonts written from outlines (Adobe Type 1 Font Format, version 1.1, 1990), in the segments of a PFB file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from fontTools import agl
from fontTools.encodings.StandardEncoding import StandardEncoding
from fontTools.misc.eexec import encrypt
from fontTools.misc.psCharStrings import T1CharString

from ...curve.degree import elevated
from ...path.path import Kind, Path

PRIVATE_KEY, CHARSTRING_KEY, LEADING = 55665, 4330, b"\0\0\0\0"
NO_GLYPH = ".notdef"
LINE = 512
"""Zeros behind the encrypted part, in lines of 64."""


@dataclass(frozen=True, slots=True)
class Facts:
    """What the font's dictionary says beside its glyphs."""

    name: str
    family: str
    full: str
    weight: str
    notice: str
    version: str
    units_per_em: float
    slant: float


def type1_font(outlines: Mapping[str, tuple[Path, float]], facts: Facts) -> bytes:
    """The bytes of a PFB file of these glyphs, each with its outline and advance in font units."""
    glyphs = dict(outlines)
    glyphs.setdefault(NO_GLYPH, (Path(()), 0.5 * facts.units_per_em))
    header = _header(glyphs, facts).encode("ascii")
    private = encrypt(LEADING + _private(glyphs), PRIVATE_KEY)[0]
    trailer = (b"0" * 64 + b"\n") * (LINE // 64) + b"cleartomark\n"
    parts = ((1, header), (2, private), (1, trailer))
    return (
        b"".join(b"\x80" + bytes([kind]) + len(part).to_bytes(4, "little") + part for kind, part in parts) + b"\x80\x03"
    )


def glyph_names(names: tuple[str, ...], characters: Mapping[int, str]) -> dict[str, str]:
    """For each glyph a name by which Type 1 readers find its character: those of the Adobe Glyph List."""
    codes: dict[str, int] = {}
    for code, name in characters.items():
        codes.setdefault(name, code)
    found: dict[str, str] = {}
    taken: set[str] = set()
    for number, name in enumerate(names):
        new = name if name != names[0] or name == NO_GLYPH else NO_GLYPH if name not in codes else name
        code = codes.get(name)
        if code is not None and agl.toUnicode(name) != chr(code):
            new = agl.UV2AGL.get(code) or (f"uni{code:04X}" if code < 0x10000 else f"u{code:X}")
        if not re.fullmatch(r"[A-Za-z0-9._]{1,127}", new) or new in taken:
            new = f"glyph{number}"
        taken.add(new)
        found[name] = new
    return found


def _header(glyphs: Mapping[str, tuple[Path, float]], facts: Facts) -> str:
    boxes = [outline.bounds() for outline, _ in glyphs.values() if outline.contours]
    low = np.floor(np.min([box[0] for box in boxes], axis=0)) if boxes else np.zeros(2)
    high = np.ceil(np.max([box[1] for box in boxes], axis=0)) if boxes else np.zeros(2)
    widths = {round(advance) for _, advance in glyphs.values()}
    scale = f"{1.0 / facts.units_per_em:.10g}"
    return f"""%!PS-AdobeFont-1.0: {facts.name} {facts.version}
12 dict begin
/FontInfo 9 dict dup begin
/version {_string(facts.version)} readonly def
/Notice {_string(facts.notice)} readonly def
/FullName {_string(facts.full)} readonly def
/FamilyName {_string(facts.family)} readonly def
/Weight {_string(facts.weight)} readonly def
/ItalicAngle {-facts.slant:g} def
/isFixedPitch {"true" if len(widths) == 1 else "false"} def
/UnderlinePosition {round(-0.1 * facts.units_per_em)} def
/UnderlineThickness {round(0.05 * facts.units_per_em)} def
end readonly def
/FontName /{facts.name} def
/PaintType 0 def
/FontType 1 def
/FontMatrix [{scale} 0 0 {scale} 0 0] readonly def
{_encoding(glyphs)}/FontBBox {{{" ".join(f"{n:g}" for n in (*low, *high))}}} readonly def
currentdict end
currentfile eexec
"""


def _encoding(glyphs: Mapping[str, tuple[Path, float]]) -> str:
    """The standard one where the font has most of its letters, else the first 256 glyphs one after the other."""
    if sum(name in glyphs for name in StandardEncoding if name != NO_GLYPH) >= 26:
        return "/Encoding StandardEncoding def\n"
    rows = "".join(f"dup {code} /{name} put\n" for code, name in enumerate(list(glyphs)[:256]) if name != NO_GLYPH)
    return f"/Encoding 256 array\n0 1 255 {{1 index exch /.notdef put}} for\n{rows}readonly def\n"


def _string(text: str) -> str:
    plain = " ".join(text.replace("©", "(c)").encode("ascii", "replace").decode().split())[:2000]
    return "(" + re.sub(r"([()\\])", r"\\\1", plain) + ")"


def _private(glyphs: Mapping[str, tuple[Path, float]]) -> bytes:
    subroutine = encrypt(LEADING + _compiled(["return"]), CHARSTRING_KEY)[0]  # readers want one, used or not
    parts = [
        b"dup /Private 10 dict dup begin\n"
        b"/RD {string currentfile exch readstring pop} executeonly def\n"
        b"/ND {noaccess def} executeonly def\n/NP {noaccess put} executeonly def\n"
        b"/BlueValues [] def\n/MinFeature {16 16} def\n/password 5839 def\n/lenIV 4 def\n",
        b"/Subrs 1 array\ndup 0 %d RD %s NP\nND\n" % (len(subroutine), subroutine),
        b"2 index /CharStrings %d dict dup begin\n" % len(glyphs),
    ]
    for name, (outline, advance) in glyphs.items():
        string = encrypt(LEADING + _charstring(outline, advance), CHARSTRING_KEY)[0]
        parts.append(b"/%s %d RD %s ND\n" % (name.encode(), len(string), string))
    parts.append(
        b"end\nend\nreadonly put\nnoaccess put\ndup /FontName get exch definefont pop\nmark currentfile closefile\n"
    )
    return b"".join(parts)


def _charstring(outline: Path, advance: float) -> bytes:
    program: list[int | str] = [0, round(advance), "hsbw"]
    here = np.zeros(2, np.int64)
    for contour in outline.contours:
        points = _cubic_points(outline, contour)
        if len(points) < 2:
            continue
        for operator, rows in points:
            flat: list[int] = []
            for row in rows:
                flat += (row - here).tolist()
                here = row
            program += [*flat, operator]
        program.append("closepath")
    return _compiled([*program, "endchar"])


def _compiled(program: list[int | str]) -> bytes:
    string = T1CharString(program=program)
    string.compile()
    return string.bytecode or b""


def _cubic_points(outline: Path, contour: object) -> list[tuple[str, np.ndarray]]:
    from ...path.path import Contour

    assert isinstance(contour, Contour)
    found: list[tuple[str, np.ndarray]] = [("rmoveto", np.round(contour.points[:1]).astype(np.int64))]
    at, kinds = 1, contour.kinds.tolist()
    for number, kind in enumerate(kinds):
        rows = contour.points[at - 1 : at + kind]
        at += kind
        if kind == Kind.LINE:
            if number < len(kinds) - 1:  # closepath draws the last one
                found.append(("rlineto", np.round(rows[1:]).astype(np.int64)))
        else:
            cubic = elevated(rows, 1) if kind == Kind.QUADRATIC else rows
            found.append(("rrcurveto", np.round(cubic[1:]).astype(np.int64)))
    return found
