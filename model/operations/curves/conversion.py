"""Outlines turned into paths, whose nodes can be edited, and into B-splines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.expression import Expression, number, symbolic
from ...document.nodes import Node
from ...document.outlines import Bezier, BSpline, Circle, Path, Polygon, Rectangle, is_outline
from ...document.tree import find, listed
from .addressing import Floats, kept, named, plain_values, put_instead, put_path
from .outline_areas import own_axes_path

if TYPE_CHECKING:
    from ...path.path import Contour
    from ...path.path import Path as Curves

SHARE = 1e-4
"""How far cubics may be from what they cannot be exactly, as a part of the outline's size."""


def convert_to_path(document: Document, ids: Sequence[str] | str, tolerance: float | None = None) -> Document:
    """Turn outlines into paths of lines, quadratics and cubics, with the place, name and looks that they had.

    Lines, Bezier curves and B-splines up to degree three stay exactly what they were. A circle becomes four cubics,
    which reach 0.027 % of the radius beyond it; other curves are true to a ten-thousandth of their size: `tolerance`,
    in millimetres, asks for better. Expressions stay where a point has them; sizes become numbers.
    """
    wanted = listed(ids)
    if not wanted:
        raise Refusal("select an outline first")
    if tolerance is not None:
        checked = number(tolerance, "the tolerance")
        if isinstance(checked, Expression) or checked <= 0.0:
            raise Refusal(f"the tolerance is a number above 0 mm, not {tolerance!s:.40}")
        tolerance = checked
    for node_id in wanted:
        node = _outline(document, node_id)
        if isinstance(node, Path) and not node.splines:
            continue
        document = put_path(document, node, _with_expressions(document, node, _as_path(document, node, tolerance)))
    return document


def _as_path(document: Document, node: Node, tolerance: float | None) -> Curves:
    from ...path.nodes import inferred
    from ...path.path import Path as Curves
    from ...path.shapes import ellipse

    if isinstance(node, Circle) and node.segments is None:
        return ellipse((0.0, 0.0), float(plain_values(document, node).radius), tolerance=tolerance)
    path = own_axes_path(document, node.id)
    if not path.contours:
        return path
    fine = tolerance or SHARE * float(np.ptp(path.bounds(), axis=0).max())
    made = []
    for contour in path.contours:
        if not contour.splines and not isinstance(node, Bezier):
            made.append(contour)
        else:
            made.append(_without_splines(contour, fine) if isinstance(node, Path) else
                        inferred(_without_splines(contour, fine)))  # fmt: skip
    return Curves(tuple(made), path.rule)


def _without_splines(contour: Contour, tolerance: float) -> Contour:
    """With Bezier segments for its B-splines; nodes between these are smooth where the curve is."""
    from ...path.editing import convert
    from ...path.nodes import inferred
    from ...path.path import Contour, Kind, Segment
    from ...spline.decomposition import decomposed

    segments: list[Segment] = []
    kinds: list[int] = []
    for i, segment in enumerate(contour.segments()):
        parts: list[Segment] = [segment]
        if not isinstance(segment, np.ndarray):
            if segment.weights is None and segment.degree <= Kind.CUBIC:
                parts = list(decomposed(segment).controls)
            else:
                alone = convert(Contour.of_segments([segment]), 0, Kind.CUBIC, tolerance)[0]
                parts = list(alone.segments())
        segments += parts
        kinds += [int(contour.nodes[i])] + [-1] * (len(parts) - 1)
    kinds += contour.nodes[len(contour) :].tolist()
    made = inferred(Contour.of_segments(segments, contour.closed))
    nodes = np.where(np.array(kinds) < 0, made.nodes, np.array(kinds))
    return Contour(made.points, made.kinds, made.closed, (), nodes)


def _with_expressions(document: Document, node: Node, path: Curves) -> dict[str, Any]:
    """The fields of the path, with the expressions of points that are where they were, and those of a rectangle."""
    from ...outline.paths import fields_of

    fields = fields_of(path)
    if isinstance(node, Rectangle) and node.symbolic:
        low = [-node.width / 2, -node.height / 2] if node.centred else [0.0, 0.0]
        high = [node.width / 2, node.height / 2] if node.centred else [node.width, node.height]
        plain = plain_values(document, node)
        middle = np.array([0.0, 0.0] if node.centred else [float(plain.width) / 2, float(plain.height) / 2])
        fields["points"] = tuple(
            tuple((high if above else low)[i] for i, above in enumerate((np.array(point) > middle).tolist()))
            for point in fields["points"]
        )
    elif isinstance(node, Path | Polygon | Bezier | BSpline) and symbolic(node.points):
        plain = plain_values(document, node)
        fields["points"] = kept(node, plain, fields["points"], False, {tuple(point) for point in plain.points})
    return fields


def convert_to_bspline(document: Document, node_id: str) -> Document:
    """Turn an outline of one contour into one B-spline, exactly: closed where the contour is, rational where it has
    arcs, with a knot as often as a corner asks for. Expressions stay where a control point has them."""
    from ...spline.decomposition import composed, ring
    from ...spline.knots import refined

    node = _outline(document, node_id)
    if isinstance(node, BSpline):
        return document
    path = own_axes_path(document, node_id)
    if len(path.contours) != 1:
        raise Refusal(
            f"“{node.label}” has {len(path.contours)} contours, and a B-spline is one: split it first"
            if path.contours
            else f"“{node.label}” is empty: draw something first"
        )
    (contour,) = path.contours
    controls, weights = _pieces(contour)
    if contour.closed:
        spline = named(node, lambda: ring(controls, weights))
        while len(spline.points) <= 2 * spline.degree:  # the outline has as many points of its own as the degree asks
            spline = refined(spline)
    else:
        spline = named(node, lambda: composed(controls, weights))
    degree = spline.degree
    count = len(spline.points) - (degree if contour.closed else 0)
    knots = spline.knots[degree : degree + count + 1] if contour.closed else spline.knots
    from .knots import EVEN, even_knots

    even = np.abs(knots - even_knots(count, degree, contour.closed)).max() <= EVEN
    points: Any = tuple(map(tuple, spline.points[:count].tolist()))
    if isinstance(node, Path | Polygon | Bezier) and symbolic(node.points):
        plain = plain_values(document, node)
        points = kept(node, plain, points, False, {tuple(point) for point in plain.points})
    fields: dict[str, Any] = {
        "points": points,
        "degree": degree,
        "knots": () if even else tuple(knots.tolist()),
        "weights": () if spline.weights is None else tuple(spline.weights[:count].tolist()),
        "closed": contour.closed,
    }
    return put_instead(document, node, BSpline, fields)


def _pieces(contour: Contour) -> tuple[Floats, Floats | None]:
    """(k, degree + 1, d) Bezier curves of one degree, with weights (k, degree + 1) where one is rational."""
    from ...curve.bezier import projected
    from ...curve.degree import elevated
    from ...spline.decomposition import decomposed

    parts: list[tuple[Floats, Floats]] = []
    rational = False
    for segment in contour.segments():
        if isinstance(segment, np.ndarray):
            parts.append((segment, np.ones(len(segment))))
            continue
        pieces = decomposed(segment)
        rational = rational or pieces.weights is not None
        weights = np.ones(pieces.controls.shape[:2]) if pieces.weights is None else pieces.weights
        parts += list(zip(pieces.controls, weights, strict=True))
    degree = max(len(points) for points, _ in parts) - 1
    if not rational:
        return np.array([elevated(points, degree + 1 - len(points)) for points, _ in parts]), None
    lifted = np.array([
        elevated(np.column_stack((points * weights[:, None], weights)), degree + 1 - len(points))
        for points, weights in parts
    ])  # fmt: skip
    return projected(lifted)


def _outline(document: Document, node_id: str) -> Node:
    node = find(document, node_id)
    if not is_outline(node, document.definitions):
        raise Refusal(f"“{node.label}” is no outline")
    return node
