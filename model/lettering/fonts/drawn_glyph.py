"""A glyph as it was drawn by hand: what an edited font has in place of its file's own."""

from __future__ import annotations

from dataclasses import dataclass

from ...path.path import Path


@dataclass(frozen=True, slots=True, eq=False)
class DrawnGlyph:
    """In font units, y up: closed contours filled by the non-zero rule, and how far the pen moves on."""

    outline: Path
    advance: float
