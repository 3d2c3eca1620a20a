"""Control points of Bezier curves and B-splines, told by their number: moved, put to places, put in, taken out,
weighed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.expression import Expression, number, symbolic
from ...document.outlines import Bezier, BSpline, is_outline
from ...document.tree import change, find
from ..parameters import declaring
from .addressing import Floats, Place, coordinates, kept, named, plain_values, rows_of, whole


@dataclass(frozen=True, slots=True, eq=False)
class Controls:
    """A Bezier curve or a B-spline: as the document has it, in plain numbers, and its control points (n, d)."""

    node: Bezier | BSpline
    plain: Any
    points: Floats


def has_control_points(document: Document, node_id: str) -> bool:
    return isinstance(find(document, node_id), Bezier | BSpline)


def controls(document: Document, node_id: str) -> Controls:
    """Raises Refusal for what has no control points."""
    node = find(document, node_id)
    if not isinstance(node, Bezier | BSpline):
        if not is_outline(node, document.definitions):
            raise Refusal(f"“{node.label}” is no outline and has no control points")
        raise Refusal(f"“{node.label}” is a {node.title.lower()} and has no control points: convert it to a B-spline")
    plain = plain_values(document, node)
    points = np.array(plain.points, float)
    return Controls(node, plain, points.reshape(len(points), points.shape[1] if len(points) else 2))


def move_points(document: Document, node_id: str, numbers: Iterable[int], by: Sequence[float]) -> Document:
    """Move control points along the outline's own axes, by millimetres."""
    curve = controls(document, node_id)
    rows = _rows(curve, numbers)
    points = curve.points.copy()
    points[rows] += coordinates(by, "the way", points.shape[1])
    return _with_points(document, curve, points)


def place_points(
    document: Document, node_id: str, numbers: Iterable[int], places: Sequence[Sequence[float]]
) -> Document:
    """Put control points to places, one for each, in the outline's own axes."""
    curve = controls(document, node_id)
    rows = _rows(curve, numbers)
    points = curve.points.copy()
    points[rows] = rows_of(places, "places", len(rows), points.shape[1])
    return _with_points(document, curve, points)


def mapped_points(
    document: Document, node_id: str, places: Sequence[Place], mapped: Callable[[Floats], Floats]
) -> Document:
    """Control points, told by (0, number), put to where a function of their (k, d) coordinates says."""
    curve = controls(document, node_id)
    if any(contour for contour, _ in places):
        raise Refusal(f"“{curve.node.label}” has control points in contour 0 alone")
    rows = _rows(curve, [row for _, row in places])
    points = curve.points.copy()
    points[rows] = mapped(points[rows])
    return _with_points(document, curve, points)


def _with_points(document: Document, curve: Controls, points: Floats) -> Document:
    new = tuple(map(tuple, points.tolist()))
    if curve.node.symbolic:
        new = kept(curve.node, curve.plain, new, True)
    node = curve.node.with_(points=new)
    return document if node == curve.node else change(document, node.id, lambda _: node)


def insert_point(document: Document, node_id: str, number: int, place: Sequence[float]) -> Document:
    """Put a control point before the one of this number; the number after the last puts it at the end.

    It changes the curve. Knots that stand in the outline get another one between those of the neighbours, weights the
    mean of theirs.
    """
    curve = controls(document, node_id)
    node, plain, count = curve.node, curve.plain, len(curve.points)
    if not 0 <= whole(number) <= count:
        raise Refusal(f"“{node.label}” has {count} control points; a new one is number 0 to {count}")
    point = tuple(coordinates(place, "the place", curve.points.shape[1]).tolist())
    fields: dict[str, Any] = {"points": _spliced(node.points, number, point)}
    if node.weights:
        beside = [plain.weights[i] for i in (number - 1, number) if 0 <= i < count]
        fields["weights"] = _spliced(node.weights, number, sum(beside) / len(beside))
    if isinstance(node, BSpline) and node.knots:
        from .knots import knot_between

        value = knot_between(curve, number)
        place_of = int(np.searchsorted(np.array(plain.knots, float), value))
        fields["knots"] = _spliced(node.knots, place_of, value)
    return checked(document, curve, fields)


def delete_points(document: Document, node_id: str, numbers: Iterable[int]) -> Document:
    """Take control points out; a Bezier curve loses degrees with them, a B-spline the knots that are nearest."""
    curve = controls(document, node_id)
    rows = _rows(curve, numbers)
    node, count = curve.node, len(curve.points)
    left = count - len(rows)
    least = int(curve.plain.degree) + 1 if isinstance(node, BSpline) else 2
    if left < least:
        raise Refusal(
            f"“{node.label}” would have {left} control points and needs {least}: delete the outline instead"
            + (", or reduce its degree first" if least > 2 else "")
        )
    stay = sorted(set(range(count)) - set(rows))
    fields: dict[str, Any] = {"points": tuple(node.points[i] for i in stay)}
    if node.weights:
        fields["weights"] = tuple(node.weights[i] for i in stay)
    if isinstance(node, BSpline) and node.knots:
        from .knots import knots_of_points

        gone = knots_of_points(curve, rows)
        fields["knots"] = tuple(knot for i, knot in enumerate(node.knots) if i not in gone)
    return checked(document, curve, fields)


def set_weights(document: Document, node_id: str, numbers: Iterable[int], weight: float) -> Document:
    """Give control points a weight above 0, a number or an expression: more draws the curve nearer, 1 for all makes it
    polynomial again."""
    curve = controls(document, node_id)
    rows = _rows(curve, numbers)
    value = number(weight, "the weight of a control point")
    if not isinstance(value, Expression) and value <= 0.0:
        raise Refusal(f"the weight of a control point is above 0, not {value:g}")
    node = curve.node
    weights = list(node.weights) or [1.0] * len(curve.points)
    if len(weights) != len(curve.points):
        raise Refusal(f"“{node.label}” has {len(curve.points)} control points, and weights for {len(weights)} of them")
    for row in rows:
        weights[row] = value
    plain = not symbolic(tuple(weights)) and all(one == 1.0 for one in weights)
    return checked(declaring(document, value), curve, {"weights": () if plain else tuple(weights)})


def checked(document: Document, curve: Controls, fields: dict[str, Any]) -> Document:
    """The document with other fields of the outline, which must make a curve. Raises Refusal."""
    from ...outline.paths import own_path

    node = curve.node.with_(**fields)
    if node == curve.node:
        return document
    plain = plain_values(document, node)
    named(node, lambda: own_path(plain))
    return change(document, node.id, lambda _: node)


def _rows(curve: Controls, numbers: Iterable[int]) -> list[int]:
    """The numbers in their order, none twice. Raises Refusal."""
    try:
        given = [numbers] if hasattr(numbers, "__index__") else list(numbers)
    except TypeError:
        raise Refusal(f"control points are told by their numbers, not {numbers!r:.60}") from None
    rows = [whole(one) for one in given]
    count = len(curve.points)
    for row in rows:
        if not 0 <= row < count:
            raise Refusal(f"“{curve.node.label}” has no control point {row}; there are {count}, counted from 0")
    if not rows:
        raise Refusal(f"select control points of “{curve.node.label}” first")
    if len(set(rows)) < len(rows):
        raise Refusal(f"control point {max(rows, key=rows.count)} of “{curve.node.label}” is there twice")
    return rows


def _spliced(given: tuple[Any, ...], place: int, new: Any) -> tuple[Any, ...]:
    return (*given[:place], new, *given[place:])
