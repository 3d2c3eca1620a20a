"""Outlines mended: open curves joined where their ends nearly meet, and lines cut where they cross."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from .addressing import drawn, named, written

if TYPE_CHECKING:
    from ...path.path import Contour

REPAIRS = {
    "cut": "Open lines are cut where they cross, and at ends within the tolerance beside them",
    "weld": "Ends within the tolerance become one; lines with the same ends are kept once",
}
"""What can be asked for, in the order in which it is done, in words for the user."""
LEAST = 1e-9
"""A gap in mm within which ends meet whatever the tolerance."""


def repair_outline(
    document: Document, node_id: str, repairs: Collection[str] | str = ("weld",), tolerance: float = 0.001
) -> Document:
    """Join the open curves of a path whose ends lie within `tolerance` mm of each other, "weld"; they stay curves.

    "cut" cuts open ones before that where they cross or pass an end, which only straight lines allow; what comes to be
    closed is a contour of its own. Closed contours stay as they are. Raises Refusal.
    """
    from ...path.path import Path

    wanted = [repairs] if isinstance(repairs, str) else list(repairs)
    for name in wanted:
        if name not in REPAIRS:
            raise Refusal(f"{name!r:.40} is no repair of outlines; there are {', '.join(REPAIRS)}")
    if not np.isfinite(tolerance) or tolerance < 0.0:
        raise Refusal(f"a tolerance must be a number from 0 mm up, not {tolerance!r:.40}")
    outline = drawn(document, node_id)
    open_ = [contour for contour in outline.path.contours if not contour.closed]
    if any(contour.dimension == 3 for contour in open_):
        raise Refusal(f"“{outline.node.label}” leaves its plane: only flat outlines are mended")
    found = open_
    if "cut" in wanted:
        found = named(outline.node, lambda: _cut(open_, tolerance))
    if "weld" in wanted:
        found = _welded(found, tolerance)
    if _alike(open_, found):
        return document
    closed = [contour for contour in outline.path.contours if contour.closed]
    gone = [contour.points for contour in open_]
    made = Path((*closed, *found)).contours
    return written(document, outline, made, gone)


def _cut(contours: list[Contour], tolerance: float) -> list[Contour]:
    from ...mesh.faults.drawings import cut_segments
    from ...path.path import Contour, Kind

    if not contours:
        return contours
    if any((contour.kinds != Kind.LINE).any() for contour in contours):
        raise Refusal("only straight lines are cut where they cross, and some of these curve: make them lines first")
    lines = np.concatenate([np.stack((one.points[:-1], one.points[1:]), axis=1) for one in contours])
    cut, said = cut_segments(lines, tolerance)
    return [Contour.of_segments([line]) for line in cut] if said else contours


def _welded(contours: list[Contour], tolerance: float) -> list[Contour]:
    from ...exchange.drawings.dxf_chains import Piece, join
    from ...path.nodes import inferred
    from ...path.path import Path

    pieces = [Piece(contour.points[0], contour.commands()[1:]) for contour in contours]
    found = join(pieces, max(tolerance, LEAST))
    commands = [
        command
        for piece in (*found.closed, *found.open)
        for command in (("move", piece.start), *piece.commands, *((("close",),) if piece.closed else ()))
    ]
    return [inferred(contour) for contour in Path.of_commands(commands).contours]


def _alike(before: list[Contour], after: list[Contour]) -> bool:
    """Whether the same curves are there, in whatever order."""
    if len(before) != len(after):
        return False
    one, two = (np.concatenate([c.points for c in part]) if part else np.zeros((0, 2)) for part in (before, after))
    return len(one) == len(two) and bool((one[np.lexsort(one.T)] == two[np.lexsort(two.T)]).all())
