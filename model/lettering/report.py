"""What a font tells about itself, and its letters as data: for the command line and scripts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..document.errors import Refusal
from ..path.path import WORDS, Contour, Kind
from .fonts.face import Face
from .layout import Style, lay_out


def facts_of(face: Face, faces: int) -> dict[str, Any]:
    """Of a face, in font units, as plain JSON values; `faces` is how many its file has."""
    metrics = face.metrics
    return {
        "name": face.name,
        "family": face.family,
        "style": face.style,
        "kind": face.kind,
        "faces": faces,
        "units_per_em": face.units_per_em,
        "glyphs": len(face.glyph_names),
        "characters": len(face.characters),
        "ascender": metrics.ascender,
        "descender": metrics.descender,
        "line_gap": metrics.line_gap,
        "x_height": metrics.x_height,
        "cap_height": metrics.cap_height,
        "slant": metrics.slant,
        "axes": [
            {"tag": axis.tag, "name": axis.name, "low": axis.low, "default": axis.default, "high": axis.high}
            for axis in face.axes
        ],
        "features": list(face.features),
    }


def text_of(face: Face, text: str, style: Style, location: Mapping[str, float]) -> dict[str, Any]:
    """A text in one font as plain JSON values: each glyph with its place and its contours about its own origin.

    Lengths are those of the style's size: font units where that is the units of the em. Raises Refusal.
    """
    layout = lay_out(text, [face], style, location)
    rows = []
    for one in layout.glyphs:
        x, y = one.matrix[:, 2].tolist()
        matrix = one.matrix.copy()
        matrix[:, 2] = 0.0
        rows.append(
            {"name": one.glyph, "x": x, "y": y, "advance": one.advance, **_drawn(face, one.glyph, matrix, location)}
        )
    return {"units_per_em": face.units_per_em, "glyphs": rows, "missing": list(layout.missing)}


def glyph_of(face: Face, glyph: str, style: Style, location: Mapping[str, float]) -> dict[str, Any]:
    """One glyph, by its name or its character, as `text_of` gives it. Raises Refusal."""
    name = glyph
    if glyph not in face.glyph_names:
        if len(glyph) != 1 or ord(glyph) not in face.characters:
            raise Refusal(f"{face.name} has no glyph “{glyph:.60}”")
        name = face.characters[ord(glyph)]
    scale = style.size / face.units_per_em
    matrix = np.array(((scale, style.shear * scale, 0.0), (0.0, scale, 0.0)))
    row = {"name": name, "x": 0.0, "y": 0.0, "advance": scale * face.advance(name, location)}
    return {
        "units_per_em": face.units_per_em,
        "glyphs": [{**row, **_drawn(face, name, matrix, location)}],
        "missing": [],
    }


def _drawn(face: Face, glyph: str, matrix: Any, location: Mapping[str, float]) -> dict[str, Any]:
    path = face.outline(glyph, location).transformed(matrix)
    return {"contours": [_commands(contour) for contour in path.contours]}


def _commands(contour: Contour) -> list[list[Any]]:
    """Ends where it begins."""
    points = contour.points.tolist()
    found: list[list[Any]] = [["move", points[0]]]
    at = 1
    for kind in contour.kinds.tolist():
        found.append([WORDS[Kind(kind)], *points[at : at + kind]])
        at += kind
    return found
