"""A font with glyphs drawn by hand: the font's file and, kept apart, the glyphs that have been changed."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...document.errors import Refusal
from ...document.outlines import Path as PathNode
from ...outline.paths import fields_of, own_path
from ...path.nodes import inferred
from ...path.path import Path
from .drawn_glyph import DrawnGlyph
from .face import DEFAULT, Face, Location, Run, Shaped

MARK = b'{"solidtree_font":'
"""What the bytes of edited glyphs begin with."""
VERSION = 1
FINE = 5e-4
"""Share of the em within which a glyph's outline is grown."""


class EditedFace(Face):
    """Glyphs that are put together from changed ones change with them, as in the font files that are written of it.

    Changed glyphs are the same at every place of a variable font's design space.
    """

    def __init__(self, base: Face, drawn: Mapping[str, DrawnGlyph]) -> None:
        self.base = base
        self.drawn = dict(drawn)
        self._instead = {name: glyph.outline for name, glyph in self.drawn.items()}
        self.kind, self.family, self.style = base.kind, base.family, base.style
        self.units_per_em, self.metrics, self.glyph_names = base.units_per_em, base.metrics, base.glyph_names
        self.characters, self.axes, self.features = base.characters, base.axes, base.features
        self.missing = base.missing

    def outline(self, glyph: str, location: Location = DEFAULT, instead: Mapping[str, Path] | None = None) -> Path:
        drawn = self._instead if instead is None else {**self._instead, **instead}
        return drawn[glyph] if glyph in drawn else self.base.outline(glyph, location, drawn)

    def advance(self, glyph: str, location: Location = DEFAULT) -> float:
        drawn = self.drawn.get(glyph)
        return self.base.advance(glyph, location) if drawn is None else drawn.advance

    def shape(self, run: Run, location: Location = DEFAULT) -> list[Shaped]:
        """As the font's file has it, with the changed advances."""
        found = []
        for one in self.base.shape(run, location):
            drawn = self.drawn.get(one.glyph)
            if drawn is not None and run.direction in ("ltr", "rtl"):
                wider = drawn.advance - self.base.advance(one.glyph, location)
                one = Shaped(one.glyph, one.character, one.offset, (one.advance[0] + wider, one.advance[1]))
            found.append(one)
        return found

    def parts(self, glyph: str) -> frozenset[str]:
        return frozenset() if glyph in self.drawn else self.base.parts(glyph)

    def source(self, glyph: str) -> Face:
        changed = glyph in self.drawn or not self.drawn.keys().isdisjoint(self.base.parts(glyph))
        return self if changed else self.base


def glyphs_as_bytes(base: str, number: int, drawn: Mapping[str, DrawnGlyph]) -> bytes:
    """Edited glyphs of face `number` of the font file with the SHA-256 `base`: equal edits make equal bytes."""
    rows = {name: glyph_fields(glyph) for name, glyph in sorted(drawn.items())}
    table = {"solidtree_font": VERSION, "base": base, "face": number, "glyphs": rows}
    return json.dumps(table, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()


def glyphs_from_bytes(data: bytes) -> tuple[str, int, dict[str, DrawnGlyph]]:
    """The font file's SHA-256, the number of the face, and the glyphs by name. Raises Refusal."""
    try:
        table = json.loads(data)
        base, number, rows = table["base"], table["face"], table["glyphs"]
        if table["solidtree_font"] != VERSION:
            raise Refusal("the font was edited by a newer Solidtree: update this one")
        if not isinstance(base, str) or type(number) is not int or not isinstance(rows, dict):
            raise Refusal("the edited glyphs of the font are damaged")
        return base, number, {name: drawn_glyph(name, row) for name, row in rows.items()}
    except (ValueError, KeyError, TypeError, RecursionError):
        raise Refusal("the edited glyphs of the font are damaged") from None


def glyph_fields(glyph: DrawnGlyph) -> dict[str, Any]:
    """What `drawn_glyph` makes the glyph of again: its advance, and points, segments and joints as a Path node's."""
    fields = fields_of(glyph.outline)
    return {"advance": glyph.advance, **{name: fields[name] for name in ("points", "segments", "joints")}}


def drawn_glyph(name: str, fields: Mapping[str, Any]) -> DrawnGlyph:
    """A glyph from what `glyph_fields` gives. Raises Refusal, also for what no font can hold."""
    try:
        row = dict(fields)
        advance = float(row.pop("advance"))
        points = tuple(tuple(float(n) for n in point) for point in row.pop("points", ()))
        node = PathNode(points=points, segments=str(row.pop("segments", "")), joints=str(row.pop("joints", "")))
    except (KeyError, TypeError, ValueError):
        raise Refusal(f"the glyph “{name:.60}” needs an advance, points and segments, all in font units") from None
    if row:
        raise Refusal(f"the glyph “{name:.60}” has no field {next(iter(row))!r:.60}")
    path = own_path(node) if node.segments else Path(())
    check_glyph(name, DrawnGlyph(path, advance))
    return DrawnGlyph(path, advance)


FARTHEST = 32767.0
"""Font units: what files can hold."""


def check_glyph(name: str, glyph: DrawnGlyph) -> None:
    """Raises Refusal for what no glyph can be."""
    who = f"the glyph “{name:.60}”"
    if not math.isfinite(glyph.advance) or abs(glyph.advance) > FARTHEST:
        raise Refusal(f"{who} cannot be {glyph.advance:g} units wide; {FARTHEST:g} are the most")
    for contour in glyph.outline.contours:
        if not contour.closed:
            raise Refusal(f"{who} has an open contour: those of letters are closed")
        if contour.dimension != 2 or contour.splines:
            raise Refusal(f"{who} has a contour that no font can hold: B-splines, or one in space")
        if not (abs(contour.points) <= FARTHEST).all():
            raise Refusal(f"{who} reaches farther than {FARTHEST:g} units from its origin, more than a font can hold")


def transformed(face: Face, name: str, matrix: NDArray[np.float64], weight: float) -> DrawnGlyph:
    """A glyph under an affine map (2, 3), grown by `weight` on every side; all in font units.

    Its width goes with the map's scale along x; the side bearings stay as it grows. Raises Refusal.
    """
    own = face.outline(name)
    if not isinstance(face.source(name), EditedFace):  # files do not say which nodes are smooth
        own = replace(own, contours=tuple(inferred(contour) for contour in own.contours))
    outline = own.transformed(matrix)
    advance = face.advance(name) * abs(float(matrix[0, 0]))
    if weight and outline.contours:
        from ...path.areas.offsetting import offset

        outline = offset(outline, weight, FINE * face.units_per_em, "miter").transformed(
            ((1.0, 0.0, weight), (0.0, 1.0, 0.0))
        )
        advance += 2.0 * weight
    return DrawnGlyph(outline, advance)


def touched(face: Face, glyphs: Iterable[str]) -> set[str]:
    """Those glyphs and all that are put together from them."""
    wholes = _wholes(face.base if isinstance(face, EditedFace) else face)
    changed = set(glyphs)
    return changed.union(*(wholes.get(name, ()) for name in changed))


@lru_cache(maxsize=4)
def _wholes(face: Face) -> dict[str, list[str]]:
    """For each glyph those that are put together from it."""
    found: dict[str, list[str]] = {}
    for name in face.glyph_names:
        for part in face.parts(name):
            found.setdefault(part, []).append(name)
    return found
