"""Joints of paths made smooth, of one curvature by moving the node, or of one curvature by the handle after it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from .addressing import Floats, Place, edited

if TYPE_CHECKING:
    from ...path.path import Contour, Segment

    Pair = tuple[Floats, Floats]

SPLINES = "two B-splines meet at this node, which have no handles: make one of them cubic segments first"


def smooth_joints(document: Document, node_id: str, nodes: Iterable[Place]) -> Document:
    """Give the curve one tangent at nodes (G1): handles turn about their node and keep their lengths; lines and
    B-splines keep their direction."""
    return edited(document, node_id, nodes, lambda contour, rows: _each(contour, rows, _smoothed))


def harmonise_joints(document: Document, node_id: str, nodes: Iterable[Place]) -> Document:
    """Give the curve one curvature at nodes (G2) by moving each along the line of its handles, which are made one line
    first where they are none."""
    return edited(
        document, node_id, nodes, lambda contour, rows: _each(_each(contour, rows, _smoothed), rows, _harmonised)
    )


def match_curvature(document: Document, node_id: str, nodes: Iterable[Place]) -> Document:
    """Give the curve one curvature at nodes (G2) by the length of the handle after each, so that it goes on as it
    came; handles are made one line first where they are none."""
    from ...path.continuity import report

    def work(contour: Contour, rows: list[int]) -> Contour:
        contour = _each(contour, rows, _smoothed)
        if len(rows) == 1:
            return _each(contour, rows, _matched)
        try:
            contour = _each(contour, rows, _matched)
            joints = report(contour)
            if all(joints[row - 1].geometric == 2 for row in rows):
                return contour
        except Refusal:
            pass
        raise Refusal(
            "each of these handles bends the joint after it, and in a row they do not come out even: match the "
            "curvature of fewer joints, or harmonise them"
        )

    return edited(document, node_id, nodes, work)


def _each(contour: Contour, rows: list[int], work: Callable[[Segment, Segment], tuple[Segment, Segment]]) -> Contour:
    """The contour with `work` done on the segments before and after each of the nodes; quadratics become cubics there,
    so that their other ends stay as they are."""
    from ...path.path import Contour, Node

    count = len(contour)
    segments = contour.segments()
    kinds = contour.nodes.copy()
    for row in rows:
        if not contour.closed and row in (0, count):
            raise Refusal(f"node {row} is an end of an open curve, where nothing meets")
        if count == 1:
            raise Refusal("a curve of one segment meets itself here: put a node in first")
        before, after = (row - 1) % count, row
        one, other = work(_own_handles(segments[before]), _own_handles(segments[after]))
        segments[before], segments[after] = one, other
        if work is not _smoothed or kinds[row] != Node.SYMMETRIC:
            kinds[row] = Node.SMOOTH
    return Contour.of_segments(segments, contour.closed, kinds)


def _own_handles(segment: Segment) -> Segment:
    from ...curve.degree import elevated

    return elevated(segment, 1) if isinstance(segment, np.ndarray) and len(segment) == 3 else segment


def _smoothed(first: Segment, second: Segment) -> tuple[Segment, Segment]:
    from ...path.smoothing import smooth

    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return smooth(first, second)
    before, after = _beziers(first, second)
    if isinstance(first, np.ndarray):
        return smooth(first, after, keep="second")[0], second
    if isinstance(second, np.ndarray):
        return first, smooth(before, second, keep="first")[1]
    raise Refusal(SPLINES)


def _harmonised(first: Segment, second: Segment) -> tuple[Segment, Segment]:
    from ...path.smoothing import harmonised

    if not (isinstance(first, np.ndarray) and isinstance(second, np.ndarray)):
        raise Refusal("a B-spline ends at this node, which keeps it from moving: match the curvature instead")
    return harmonised(first, second)


def _matched(first: Segment, second: Segment) -> tuple[Segment, Segment]:
    from ...path.smoothing import same_curvature

    if isinstance(second, np.ndarray):
        before, weights = _last(first)
        return first, same_curvature(before, second, "first", weights)[1]
    if not isinstance(first, np.ndarray):
        raise Refusal(SPLINES)
    after, weights = _first(second)
    return same_curvature(first, after, "second", None, weights)[0], second


def _beziers(first: Segment, second: Segment) -> Pair:
    return _last(first)[0], _first(second)[0]


def _last(segment: Segment) -> tuple[Floats, Floats | None]:
    """The Bezier curve with which a segment ends, and its weights."""
    if isinstance(segment, np.ndarray):
        return segment, None
    return _piece(segment, -1)


def _first(segment: Segment) -> tuple[Floats, Floats | None]:
    if isinstance(segment, np.ndarray):
        return segment, None
    return _piece(segment, 0)


def _piece(segment: Segment, number: int) -> tuple[Floats, Floats | None]:
    from ...spline.decomposition import decomposed

    pieces = decomposed(segment)  # type: ignore[arg-type]
    return pieces.controls[number], None if pieces.weights is None else pieces.weights[number]
