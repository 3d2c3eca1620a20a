"""A line of text in runs that can be shaped: of one direction, one script and one font."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from fontTools import unicodedata as scripts

from .bidi import levels_of, visual_order
from .fonts.face import Face

NEUTRAL = ("Zyyy", "Zinh", "Zzzz")
"""Scripts of characters that go with their neighbours: common, inherited, unknown."""
SHAPERS = 0xFE00, 0xFE0F
"""The first and the last of the variation selectors."""


@dataclass(frozen=True, slots=True)
class Piece:
    """Characters `begin` to `end` of a line, and how they are set; `face` is a number in the chain of fonts."""

    begin: int
    end: int
    level: int
    script: str
    face: int


def pieces_of(text: str, faces: Sequence[Face], direction: str = "auto") -> list[Piece]:
    """The runs of one line, from left to right as they stand.

    A character is set from the first face of the chain that has a glyph for it; one that none has is left to the
    first. Marks and joiners stay with the character before them.
    """
    if not text:
        return []
    levels, script, face = levels_of(text, direction), _scripts(text), _faces(text, faces)
    pieces, place = [], 0
    for (level, kind, number), same in groupby(zip(levels, script, face, strict=True)):
        length = len(list(same))
        pieces.append(Piece(place, place + length, level, kind, number))
        place += length
    return [pieces[number] for number in visual_order([piece.level for piece in pieces])]


def _scripts(text: str) -> list[str]:
    """ISO 15924 codes; neutral characters take that of what is before them, at the beginning of what comes after."""
    found = [scripts.script(one) for one in text]
    first = next((one for one in found if one not in NEUTRAL), "Latn")
    before = first
    for place, one in enumerate(found):
        if one in NEUTRAL:
            found[place] = before
        else:
            before = one
    return found


def _faces(text: str, faces: Sequence[Face]) -> list[int]:
    own = faces[0].characters
    if all(ord(one) in own for one in text):
        return [0] * len(text)
    result: list[int] = []
    for cluster in _clusters(text):
        needed = [ord(one) for one in cluster if not _invisible(one)]
        chosen = next((n for n, face in enumerate(faces) if all(code in face.characters for code in needed)), None)
        if chosen is None:  # a font that composes the marks itself has the first character at least
            chosen = next((n for n, face in enumerate(faces) if needed and needed[0] in face.characters), 0)
        result += [chosen] * len(cluster)
    return result


def _clusters(text: str) -> Iterator[str]:
    begin = 0
    for place, one in enumerate(text):
        if place > begin and not (unicodedata.combining(one) or _invisible(one)):
            yield text[begin:place]
            begin = place
    yield text[begin:]


def _invisible(character: str) -> bool:
    """Whether a character only says how others are set, and needs no glyph."""
    return unicodedata.category(character) in ("Cf", "Cc") or SHAPERS[0] <= ord(character) <= SHAPERS[1]


def missing_in(text: str, faces: Sequence[Face]) -> list[int]:
    """The code points that no face of the chain has a glyph for, in order, each once."""
    wanted = [ord(one) for one in dict.fromkeys(text) if not _invisible(one) and not one.isspace()]
    return [code for code in wanted if not any(code in face.characters for face in faces)]
