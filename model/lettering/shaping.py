"""A line of text as glyphs with places: in runs by direction, script and font, each shaped by HarfBuzz."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .fonts.face import DEFAULT, Face, Location, Run
from .runs import pieces_of


@dataclass(frozen=True, slots=True)
class Set:
    """A glyph as it is set: `x`, `y` of its origin from the line's beginning and its `advance`, all in ems.

    `face` is the number of its font in the chain; `character` the place in the line of what it stands for.
    """

    face: int
    glyph: str
    character: int
    x: float
    y: float
    advance: float


def set_line(
    text: str,
    faces: Sequence[Face],
    location: Location = DEFAULT,
    features: Sequence[tuple[str, int]] = (),
    direction: str = "auto",
    language: str = "",
    spacing: float = 0.0,
) -> tuple[list[Set], float]:
    """The glyphs of one line from left to right, and its length in ems.

    `location` is that of the first face; `spacing`, in ems, comes after each character that takes room. `direction`
    is "auto", "ltr" or "rtl". Raises Refusal.
    """
    found: list[Set] = []
    x = 0.0
    for piece in pieces_of(text, faces, direction):
        face = faces[piece.face]
        run = Run(
            text[piece.begin : piece.end],
            "rtl" if piece.level % 2 else "ltr",
            piece.script,
            language,
            tuple(features),
        )
        em = face.units_per_em
        for shaped in face.shape(run, location if piece.face == 0 else DEFAULT):
            advance = shaped.advance[0] / em
            place = x + shaped.offset[0] / em, shaped.offset[1] / em
            if advance:
                advance += spacing
            found.append(Set(piece.face, shaped.glyph, piece.begin + shaped.character, *place, advance))
            x += advance
    return found, x
