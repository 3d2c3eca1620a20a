"""Knots and degree of B-splines. But for `set_knot`, `remove_knot` and `reduce_degree` the curve stays as it is.

Parameters are those of the outline's own knots; without any they run from 0 to 1. A closed curve stays closed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.expression import Expression, symbolic
from ...document.expression import number as plain_number
from ...document.outlines import BSpline
from ..parameters import declaring
from .addressing import ROUNDING, Floats, kept, named, whole
from .control_points import Controls, checked, controls

if TYPE_CHECKING:
    from ...spline.bspline import BSpline as Spline

EVEN = 1e-14
"""Knots that are nearer to even ones than this are these, and need not be told."""


def set_knot(document: Document, node_id: str, number: int, value: float) -> Document:
    """Put a knot, by its number, to another parameter, a number or an expression; it stays between its neighbours."""
    curve = _spline(document, node_id)
    given, plain = _knots(curve)
    row = whole(number)
    if not 0 <= row < len(given):
        raise Refusal(f"“{curve.node.label}” has no knot {row}; there are {len(given)}, counted from 0")
    wanted = plain_number(value, "a knot")
    if not isinstance(wanted, Expression):
        low = plain[row - 1] if row else -np.inf
        high = plain[row + 1] if row + 1 < len(plain) else np.inf
        if not low <= wanted <= high:
            beside = f"at {low:g} or above" if wanted < low else f"at {high:g} or below"
            raise Refusal(f"knots rise along a B-spline: knot {row} stays {beside}, and does not go to {wanted:g}")
    knots = tuple(wanted if i == row else one for i, one in enumerate(given))
    return checked(declaring(document, wanted), curve, {"knots": knots})


def insert_knot(document: Document, node_id: str, parameter: float, times: int = 1) -> Document:
    """Put a knot in, or several of one value, at most as many as the degree; the curve stays as it is."""
    from ...spline.knots import inserted

    curve, count = _spline(document, node_id), _times(times)
    return with_spline(document, curve, lambda spline: inserted(spline, _parameter(parameter), count))


def remove_knot(document: Document, node_id: str, parameter: float, times: int = 1) -> Document:
    """Take a knot out, or several of one value; the curve stays as near as it can be, which `deviation` tells."""
    from ...spline.knots import removed

    curve, count = _spline(document, node_id), _times(times)
    return with_spline(document, curve, lambda spline: removed(spline, _parameter(parameter), count)[0])


def refine_knots(document: Document, node_id: str) -> Document:
    """Put a knot in the middle of every interval; the curve stays as it is."""
    from ...spline.knots import refined

    return with_spline(document, _spline(document, node_id), lambda spline: refined(spline))


def elevate_degree(document: Document, node_id: str, times: int = 1) -> Document:
    """Raise the degree of a B-spline or a Bezier curve; the curve stays as it is."""
    from ...curve.bezier import projected
    from ...curve.degree import elevated as elevated_pieces
    from ...spline.decomposition import decomposed, ring
    from ...spline.knots import on_domain
    from ...spline.spline_degree import elevated

    curve = controls(document, node_id)

    def raised(spline: Spline) -> Spline:
        made = elevated(spline, _times(times))
        if not (isinstance(curve.plain, BSpline) and curve.plain.closed):
            return made
        pieces = decomposed(spline)
        lifted = elevated_pieces(pieces.lifted, times)
        around = (
            ring(lifted, None, pieces.breaks) if spline.weights is None else ring(*projected(lifted), pieces.breaks)
        )
        return on_domain(around, *spline.domain)

    return with_spline(document, curve, raised)


def reduce_degree(document: Document, node_id: str, times: int = 1) -> Document:
    """Lower the degree of a B-spline or a Bezier curve; the curve stays as near as it can be, which `deviation`
    tells."""
    from ...spline.spline_degree import reduced

    return with_spline(document, controls(document, node_id), lambda spline: reduced(spline, _times(times))[0])


def knot_between(curve: Controls, row: int) -> float:
    """A parameter for one knot more, where a control point comes before the one of that number: the middle of the
    interval between those that belong to its neighbours."""
    spline = _curve(curve)
    count, places = len(curve.points), spline.abscissae
    start, end = spline.domain
    if curve.plain.closed:
        turn = end - start
        places = np.concatenate((places[count - 1 : count] - turn, places[:count], places[:1] + turn))
        at = start + (0.5 * (places[row] + places[row + 1]) - start) % turn
    else:
        at = 0.5 * (places[max(row - 1, 0)] + places[min(row, count - 1)])
    breaks = np.unique(spline.knots[(spline.knots >= start) & (spline.knots <= end)])
    interval = int(np.clip(np.searchsorted(breaks, at, side="right") - 1, 0, len(breaks) - 2))
    return 0.5 * float(breaks[interval] + breaks[interval + 1])


def knots_of_points(curve: Controls, rows: list[int]) -> set[int]:
    """The numbers of the inner knots that go with control points: the nearest to the parameters of these."""
    spline, knots = _curve(curve), np.array(curve.plain.knots, float)
    start, end = spline.domain
    degree, closed = spline.degree, curve.plain.closed
    inner = list(range(1, len(knots) - 1) if closed else range(degree + 1, len(knots) - degree - 1))
    gone: set[int] = set()
    for row in rows:
        at = spline.abscissae[row]
        away = np.abs(knots - at)
        if closed:
            away = np.minimum(away, np.abs(away - (end - start)))
        nearest = min((i for i in inner if i not in gone), key=lambda i: away[i])
        gone.add(nearest)
    return gone


def _spline(document: Document, node_id: str) -> Controls:
    curve = controls(document, node_id)
    if not isinstance(curve.node, BSpline):
        raise Refusal(f"“{curve.node.label}” is a Bezier curve and has no knots: convert it to a B-spline first")
    return curve


def _times(times: Any) -> int:
    if whole(times) < 1:
        raise Refusal(f"once or more, not {times} times")
    return whole(times)


def _knots(curve: Controls) -> tuple[tuple[Any, ...], Floats]:
    """The knots of the outline, or the even ones that it has without any: as they are told, and as numbers."""
    node, plain = curve.node, curve.plain
    if isinstance(node, BSpline) and node.knots:
        return node.knots, np.array(plain.knots, float)
    even = even_knots(len(curve.points), int(plain.degree), plain.closed)
    return tuple(even.tolist()), even


def even_knots(count: int, degree: int, closed: bool) -> Floats:
    from ...spline.knots import clamped_knots

    return np.arange(count + 1) / count if closed else clamped_knots(count, degree)


def _curve(curve: Controls) -> Spline:
    """As a B-spline, on the outline's own knots. Raises Refusal for what makes no curve."""
    from ...outline.paths import own_path, spline_of

    plain = curve.plain
    if isinstance(plain, BSpline):
        return named(curve.node, lambda: spline_of(plain))
    from ...spline.bspline import BSpline as Spline
    from ...spline.knots import clamped_knots

    named(curve.node, lambda: own_path(plain))
    count = len(curve.points)
    weights = np.array(plain.weights, float) if plain.weights else None
    return Spline(curve.points, count - 1, clamped_knots(count, count - 1), weights)


def _parameter(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise Refusal(f"the parameter of a knot is a number, not {value!r:.40}")
    return float(value)


def with_spline(document: Document, curve: Controls, work: Callable[[Spline], Spline]) -> Document:
    """The document with another B-spline in the outline; a Bezier curve stays one."""
    spline = _curve(curve)
    made = named(curve.node, lambda: work(spline))
    node, plain, degree = curve.node, curve.plain, made.degree
    closed = isinstance(plain, BSpline) and plain.closed
    count = len(made.points) - (degree if closed else 0)
    points: Any = tuple(map(tuple, made.points[:count].tolist()))
    fields: dict[str, Any] = {"weights": () if made.weights is None else tuple(made.weights[:count].tolist())}
    if node.symbolic:
        points = kept(node, plain, points, False)
        if symbolic(node.weights):
            _refuse_expression(curve, "weights")
    fields["points"] = points
    if isinstance(node, BSpline):
        if degree != spline.degree:
            if isinstance(node.degree, Expression):
                _refuse_expression(curve, "degree")
            fields["degree"] = degree
        turn = made.knots[degree : degree + count + 1] if closed else made.knots
        even = not node.knots and np.abs(turn - even_knots(count, degree, closed)).max() <= EVEN
        fields["knots"] = () if even else _kept_knots(curve, turn)
    return checked(document, curve, fields)


def _kept_knots(curve: Controls, knots: Floats) -> tuple[Any, ...]:
    """New knots with the expressions of those that are still there."""
    given, old = _knots(curve)
    made: list[Any] = knots.tolist()
    if symbolic(given):
        slack, least = ROUNDING * float(old[-1] - old[0]), 0
        for before, was in zip(given, old.tolist(), strict=True):
            if isinstance(before, Expression):
                row = next((i for i in range(least, len(made)) if abs(knots[i] - was) <= slack), None)
                if row is None:
                    _refuse_expression(curve, "knots")
                else:
                    made[row], least = before, row + 1
    return tuple(made)


def _refuse_expression(curve: Controls, what: str) -> None:
    raise Refusal(
        f"“{curve.node.label}”: an expression stands in its {what}, which this would overwrite; put a number there"
    )
