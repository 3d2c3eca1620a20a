"""Bending a path where its curve is caught."""

from __future__ import annotations

from collections.abc import Sequence

from ...document.document import Document
from ...document.errors import Refusal
from .addressing import contour_at, coordinates, drawn, named, whole, written


def bend_segment(
    document: Document, node_id: str, contour: int, segment: int, parameter: float, by: Sequence[float]
) -> Document:
    """Move the point of a path's segment at its parameter between 0 and 1, by millimetres along the path's own axes.

    The nodes stay; handles move as `path.bending.bend` says, and a line becomes a cubic.
    """
    from ...path.bending import bend

    outline = drawn(document, node_id)
    old = contour_at(outline, contour)
    if isinstance(parameter, bool) or not isinstance(parameter, int | float):
        raise Refusal(f"the parameter of a segment is a number between 0 and 1, not {parameter!r:.40}")
    shift = coordinates(by, "the way", old.dimension)
    if not shift.any():
        return document
    new = named(outline.node, lambda: bend(old, whole(segment), float(parameter), shift))
    contours = outline.path.contours
    return written(document, outline, [*contours[:contour], new, *contours[contour + 1 :]])
