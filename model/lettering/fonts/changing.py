"""Glyphs of a font leaned and grown, for characters or for all: what scripts and the command line save."""

from __future__ import annotations

import math
import os
from pathlib import Path, PurePath
from typing import BinaryIO

import numpy as np

from ...document.errors import Refusal
from ...project.disk import replace_file
from ..layout import STEEPEST
from .drawn_glyph import DrawnGlyph
from .edited_face import EditedFace, check_glyph, transformed
from .face import Face
from .library import ENDINGS, bytes_of, find
from .opening import font_bytes, open_face


def font_data(font: str | os.PathLike[str], number: int = 0) -> tuple[bytes, int]:
    """What is in a font's file, and the number of its face, by its path or its name. Raises Refusal."""
    name = os.fspath(font)
    if PurePath(name).suffix.lower() in ENDINGS and (Path(name).is_file() or find(name) is None):
        try:
            return font_bytes(name), number
        except Refusal as refusal:
            raise Refusal(f"{PurePath(name).name}: {refusal}") from None
    return bytes_of(name)


def characters_in(text: str) -> set[int]:
    """The code points of "abc" and of ranges such as "α-ω"; a hyphen that stands for itself comes first or last.

    Raises Refusal for a range that runs backwards.
    """
    found: set[int] = set()
    place = 0
    while place < len(text):
        if text[place + 1 : place + 2] == "-" and place + 2 < len(text):
            low, high = ord(text[place]), ord(text[place + 2])
            if high < low:
                raise Refusal(f"the range “{text[place : place + 3]}” runs backwards")
            found |= set(range(low, high + 1))
            place += 3
        else:
            found.add(ord(text[place]))
            place += 1
    return found


def changed_glyphs(face: Face, characters: str = "", slant: float = 0.0, weight: float = 0.0) -> dict[str, DrawnGlyph]:
    """Glyphs by name, leaned by `slant` degrees and grown by `weight` units; of all characters where none is given.

    Raises Refusal where the font has none of them.
    """
    if not (math.isfinite(slant) and abs(slant) <= STEEPEST):
        raise Refusal(f"letters lean by at most {STEEPEST:g} degrees, not {slant:g}")
    wanted = characters_in(characters)
    names = {name for code, name in face.characters.items() if not wanted or code in wanted}
    if not names:
        raise Refusal(f"{face.name} has none of the characters “{characters:.60}”")
    if not (slant or weight):
        return {}
    matrix = np.array(((1.0, math.tan(math.radians(slant)), 0.0), (0.0, 1.0, 0.0)))
    glyphs = {name: transformed(face, name, matrix, weight) for name in sorted(names)}
    for name, glyph in glyphs.items():
        check_glyph(name, glyph)
    return glyphs


def write_changed_font(
    data: bytes,
    number: int,
    path: str | os.PathLike[str],
    family: str | None = None,
    *,
    drawn: dict[str, DrawnGlyph] | None = None,
    characters: str = "",
    slant: float = 0.0,
    weight: float = 0.0,
    form: str | None = None,
) -> tuple[str, ...]:
    """Write a font, with glyphs that were `drawn` anew and then leaned and grown, and read it back to check it.

    `form` is "ttf", "otf" or "pfb", None: that of the file's ending; `family` the new font's, None: the first that the
    licence allows. What comes back is words on what is not as it was. Raises Refusal; the file that was there is then
    untouched.
    """
    from ..saving.naming import proposed_family
    from ..saving.saving import saved_font

    face: Face = open_face(data, number)
    if drawn:
        face = EditedFace(face, drawn)
    glyphs = {**(drawn or {}), **changed_glyphs(face, characters, slant, weight)}
    ending = PurePath(path).suffix[1:].lower()
    saved = saved_font(data, number, glyphs, family or proposed_family(data, number), form or ending)

    def write(stream: BinaryIO) -> None:
        stream.write(saved.data)

    replace_file(path, write)
    return saved.remarks
