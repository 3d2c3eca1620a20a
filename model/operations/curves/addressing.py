"""From a node of the document to its curves, and back: coordinates that stay keep the expressions they had."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ...document.document import Document, parameter_values
from ...document.errors import Refusal
from ...document.expression import Expression, symbolic, vector
from ...document.nodes import Node, resolve_fields
from ...document.outlines import Bezier, BSpline, Path, Polygon, is_outline
from ...document.project_font import set_in
from ...document.tree import change, find, trail
from ..fitting import root_name

if TYPE_CHECKING:
    from ...path.path import Contour
    from ...path.path import Path as Curves

Floats = NDArray[np.float64]
Place = tuple[int, int]
Made = TypeVar("Made")
Pointed = Path | Polygon | Bezier | BSpline
"""The outlines that keep points."""

ROUNDING = 1e-12
"""Coordinates that differ by less than this part of the outline's size have not changed."""


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """An outline with nodes of its own: as the document has it, in plain numbers, and as curves in its own axes."""

    node: Path | Bezier
    plain: Path | Bezier
    path: Curves


def drawn(document: Document, node_id: str) -> Drawn:
    """A Path, or a Bezier curve that fits in one: up to degree three, without weights. Raises Refusal for others."""
    from ...outline.paths import own_path

    node = find(document, node_id)
    if not isinstance(node, Path) and not (isinstance(node, Bezier) and len(node.points) <= 4 and not node.weights):
        raise Refusal(f"{_without_nodes(document, node)}: convert it to a path first")
    plain = plain_values(document, node)
    return Drawn(node, plain, named(node, lambda: own_path(plain)))


def plain_values(document: Document, node: Any) -> Any:
    """An outline without operands with numbers for its expressions. Raises Refusal where one has no value."""
    if not node.symbolic:
        return node
    values, _ = parameter_values(document.parameters)
    return set_in(named(node, lambda: resolve_fields(node, values, ())), document.fonts)


def _without_nodes(document: Document, node: Node) -> str:
    if not is_outline(node, document.definitions):
        return f"“{node.label}” is no outline and has no nodes"
    if isinstance(node, Bezier | BSpline):
        return f"“{node.label}” is a {node.title[0].lower() if isinstance(node, Bezier) else 'B'}{node.title[1:]}, " \
               "which has control points instead of nodes"  # fmt: skip
    return f"“{node.label}” is a {node.title.lower()}, whose nodes cannot be edited one by one"


def named(node: Node, make: Callable[[], Made]) -> Made:
    """What `make` makes; what it refuses says which outline it is about."""
    try:
        return make()
    except Refusal as refusal:
        raise Refusal(f"“{node.label}”: {refusal}") from None


def edited(
    document: Document,
    node_id: str,
    nodes: Iterable[Place],
    work: Callable[[Contour, list[int]], Contour | None],
    gone: Callable[[Contour, list[int]], Floats] | None = None,
) -> Document:
    """The document with `work` done on each contour that has some of the nodes; None takes a contour out.

    `gone` tells the points (k, d) of a contour that may go, although an expression stands in them.
    """
    outline = drawn(document, node_id)
    contours: list[Contour | None] = list(outline.path.contours)
    leaving: list[Floats] | None = None if gone is None else []
    for number, rows in by_contour(outline, nodes).items():
        contour = outline.path.contours[number]
        if gone is not None and leaving is not None:
            leaving.append(gone(contour, rows))
        contours[number] = named(outline.node, lambda contour=contour, rows=rows: work(contour, rows))
    kept = tuple(contour for contour in contours if contour is not None)
    return written(document, outline, kept, leaving)


def by_contour(outline: Drawn, nodes: Iterable[Place]) -> dict[int, list[int]]:
    """The numbers of the nodes in each contour that has some, rising. Raises Refusal for what there is not."""
    found: dict[int, list[int]] = {}
    for number, node in pairs(nodes):
        contour = contour_at(outline, number)
        count = len(contour.nodes)
        if not 0 <= node < count:
            raise Refusal(
                f"“{outline.node.label}” has no node {node} in contour {number}, which has {count}, counted from 0"
            )
        found.setdefault(number, []).append(node)
    if not found:
        raise Refusal(f"select nodes of “{outline.node.label}” first")
    return {number: sorted(set(rows)) for number, rows in found.items()}


def pairs(places: Iterable[Place]) -> list[Place]:
    """Places (contour, number) as plain numbers; one alone may come without a list. Raises Refusal."""
    if hasattr(places, "tolist"):
        places = places.tolist()  # type: ignore[union-attr]
    try:
        items = list(places)
        if len(items) == 2 and all(hasattr(item, "__index__") for item in items):
            items = [items]  # type: ignore[list-item]
        return [(whole(contour), whole(number)) for contour, number in items]
    except (TypeError, ValueError):
        raise Refusal(f"nodes are told by pairs of numbers, (contour, node), not {places!r:.60}") from None


def whole(number: Any) -> int:
    """A number of something. Raises Refusal."""
    if isinstance(number, bool) or not hasattr(number, "__index__"):
        raise Refusal(f"what is counted has a whole number, not {number!r:.40}")
    return int(number)


def contour_at(outline: Drawn, number: Any) -> Contour:
    contours = outline.path.contours
    if not 0 <= whole(number) < len(contours):
        raise Refusal(
            f"“{outline.node.label}” has no contour {number}; there are {len(contours)}, counted from 0"
            if contours
            else f"“{outline.node.label}” is empty: draw something first"
        )
    return contours[number]


def swapped(outline: Drawn, number: int, *contours: Contour) -> list[Contour]:
    """The contours of an outline with others, or none, in the place of one."""
    before = outline.path.contours
    return [*before[:number], *contours, *before[number + 1 :]]


def coordinates(value: Any, what: str, dimension: int) -> Floats:
    """(dimension,) plain numbers. Raises Refusal."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    given = vector(value, what, dimension)
    if symbolic(given):
        raise Refusal(f"{what} must be plain numbers, not {value!r:.60}")
    return np.array(given, float)


def rows_of(values: Any, what: str, count: int, dimension: int) -> Floats:
    """(count, dimension) plain numbers; one row may stand by itself for one place. Raises Refusal."""
    if hasattr(values, "tolist"):
        values = values.tolist()
    try:
        items = list(values)
    except TypeError:
        raise Refusal(f"{what} must be {count} points, not {values!r:.60}") from None
    if count == 1 and len(items) == dimension and not any(hasattr(item, "__len__") for item in items):
        items = [items]
    if len(items) != count:
        raise Refusal(f"{what} must be {count} points, one for each, not {len(items)}")
    return np.array([coordinates(item, what, dimension) for item in items]).reshape(count, dimension)


def written(
    document: Document, outline: Drawn, contours: Sequence[Contour], leaving: Sequence[Floats] | None = None
) -> Document:
    """The document with other contours in the outline. Raises Refusal where an expression would have to change.

    Points correspond one to one as long as the segments are of the same kinds; with `leaving`, points (k, d) that may
    go with the expressions in them, they are known by where they lie.
    """
    from ...outline.paths import fields_of

    before, node = outline.path.contours, outline.node
    if len(contours) == len(before) and all(a is b for a, b in zip(contours, before, strict=True)):
        return document
    if not contours:
        raise Refusal(f"nothing would be left of “{node.label}”: delete the outline instead")
    fields = fields_of(replace(outline.path, contours=tuple(contours)))
    if node.symbolic and symbolic(node.points):
        same = leaving is None and isinstance(node, Path) and node.segments == fields["segments"]
        gone = {tuple(point) for points in leaving or () for point in points.tolist()}
        fields["points"] = kept(node, outline.plain, fields["points"], same, gone)
    if isinstance(node, Path):
        new: Node = node.with_(**fields)
        return document if new == node else change(document, node.id, lambda _: new)
    return put_path(document, node, fields)


def put_path(document: Document, node: Node, fields: dict[str, Any]) -> Document:
    """The document with a path in place of another outline, which keeps all that does not make its shape."""
    return put_instead(document, node, Path, fields)


def put_instead(document: Document, node: Node, kind: type[Node], fields: dict[str, Any]) -> Document:
    name = node.name
    if name and name.rstrip("0123456789 ") == node.title:  # the name that it was given, not one that somebody chose
        name = kind.title
        if len(trail(document, node.id)) == 1:
            name = root_name(document, kind.title, [node.id])
    new = kind(
        id=node.id, name=name, colour=node.colour, visible=node.visible, note=node.note, placement=node.placement,
        **fields,
    )  # fmt: skip
    return change(document, node.id, lambda node: new)


def kept(
    node: Pointed, plain: Pointed, points: Sequence[Any], same: bool, gone: Iterable[tuple[Any, ...]] = ()
) -> tuple[tuple[Any, ...], ...]:
    """New points for an outline, in plain numbers, with the expressions that the old ones have: one to one where they
    are the `same`, else where a point lies as before.

    Raises Refusal where a coordinate with an expression would change, but for the points that may be `gone`.
    """
    given, old = node.points, cast("tuple[tuple[float, ...], ...]", plain.points)
    if same and len(points) == len(given):
        size = float(np.abs(np.array(old)).max())
        return tuple(
            _coordinates(node, number, before, was, now, ROUNDING * size) if symbolic(before) else now
            for number, (before, was, now) in enumerate(zip(given, old, points, strict=True))
        )
    places: dict[tuple[float, ...], list[int]] = {}
    for number, point in enumerate(old):
        if symbolic(given[number]):
            places.setdefault(tuple(point), []).append(number)
    taken: dict[tuple[float, ...], int] = {}
    made = []
    for point in map(tuple, points):
        rows = places.get(point)
        if rows is None:
            made.append(point)
            continue
        turn = taken[point] = taken.get(point, -1) + 1
        made.append(given[rows[min(turn, len(rows) - 1)]])
    for point, rows in places.items():
        if point not in taken and point not in gone:
            _refuse(node, rows[0], next(n for n in given[rows[0]] if isinstance(n, Expression)))
    return tuple(made)


def _coordinates(
    node: Node, number: int, given: Sequence[Any], old: Sequence[float], new: Sequence[float], slack: float
) -> tuple[Any, ...]:
    for before, was, now in zip(given, old, new, strict=True):
        if isinstance(before, Expression) and abs(now - was) > slack:
            _refuse(node, number, before)
    return tuple(
        before if isinstance(before, Expression) else now for before, now in zip(given, new, strict=True)
    )  # fmt: skip


def _refuse(node: Node, number: int, expression: Expression) -> None:
    raise Refusal(
        f"“{node.label}”: point {number} follows the expression “{expression.text:.60}”, which this would overwrite; "
        "change the expression, or put a number in its place"
    )
