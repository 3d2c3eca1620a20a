"""Contours of paths: broken, joined, closed, turned round, added, and split into outlines of their own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from ...document.document import Document
from ...document.errors import Refusal
from ...document.nodes import Difference, LinearArray, Mirror, Node, PolarArray, Union
from ...document.outlines import BSpline, Path
from ...document.tree import index_of, next_number, put, trail
from ..fitting import check_free, named_apart
from .addressing import (
    Drawn,
    Floats,
    Place,
    by_contour,
    contour_at,
    drawn,
    named,
    pairs,
    swapped,
    whole,
    written,
)  # fmt: skip
from .control_points import checked, controls, has_control_points
from .knots import with_spline

if TYPE_CHECKING:
    from ...path.path import Contour

SEGMENTS = ("line", "quad", "cubic")
"""In the order of `Kind` of path/path.py, from 1 on."""


def break_path(document: Document, node_id: str, nodes: Iterable[Place]) -> Document:
    """Break a path at nodes: a closed contour opens there, an open one becomes two."""
    outline = drawn(document, node_id)
    found: list[Contour] = []
    groups = by_contour(outline, nodes)
    for number, contour in enumerate(outline.path.contours):
        rows = groups.get(number, [])
        found += named(outline.node, lambda contour=contour, rows=rows: _parts(contour, rows))
    return written(document, outline, found, [])


def _parts(contour: Contour, rows: list[int]) -> list[Contour]:
    from ...path.editing import break_at

    if not rows:
        return [contour]
    if contour.closed:
        first, *rest = rows
        (contour,) = break_at(contour, first)
        rows = [row - first for row in rest]
    else:
        inner = [row for row in rows if 0 < row < len(contour)]
        if not inner:
            raise Refusal("an open curve ends at this node already")
        rows = inner
    parts = []
    for row in reversed(rows):
        contour, after = break_at(contour, row)
        parts.append(after)
    return [contour, *reversed(parts)]


def join_nodes(document: Document, node_id: str, first: Place, second: Place, merge: bool = False) -> Document:
    """Join two ends of open contours of a path: by a line, or merged into one node midway. Two ends of one contour
    close it."""
    from ...path import editing

    outline = drawn(document, node_id)
    ends = [_end(outline, place) for place in (first, second)]
    (one, at_end), (other, from_end) = ends
    contours = outline.path.contours
    if one == other:
        if at_end == from_end:
            raise Refusal("two ends are joined, and both of these are one")
        joined = named(outline.node, lambda: editing.close(contours[one], bool(merge)))
        return written(document, outline, swapped(outline, one, joined), [])
    if not at_end and from_end:  # as they run already
        before, after = contours[other], contours[one]
    else:
        before = contours[one] if at_end else contours[one].reversed()
        after = contours[other].reversed() if from_end else contours[other]
    joined = named(outline.node, lambda: editing.join(before, after, bool(merge)))
    low, high = sorted((one, other))
    return written(document, outline, [*contours[:low], joined, *contours[low + 1 : high], *contours[high + 1 :]], [])


def _end(outline: Drawn, place: Place) -> tuple[int, bool]:
    """The contour of an end, and whether it is its last node."""
    ((number, (row,)), *_) = by_contour(outline, pairs([place])).items()
    contour = outline.path.contours[number]
    if contour.closed or row not in (0, len(contour)):
        where = f"node {row} of contour {number}"
        raise Refusal(f"“{outline.node.label}”: {where} is no end of an open curve: break the path there first")
    return number, row > 0


def close_contours(document: Document, node_id: str, contours: Iterable[int] | None = None) -> Document:
    """Close open contours of a path, all of them or those with these numbers: by a line where their ends are apart.

    A Bezier curve is closed by a line as well; a B-spline runs round then, on even knots.
    """
    from ...path import editing

    if has_control_points(document, node_id):
        curve = controls(document, node_id)
        _only_contour(curve.node, contours)
        if curve.node.closed:
            raise Refusal(f"“{curve.node.label}” is closed already")
        return checked(document, curve, {"closed": True, **({"knots": ()} if isinstance(curve.node, BSpline) else {})})
    outline = drawn(document, node_id)
    chosen = _chosen(outline, contours)
    if contours is None:
        chosen = [number for number in chosen if not outline.path.contours[number].closed]
        if not chosen:
            raise Refusal(f"“{outline.node.label}” is closed already")
    made = [
        named(outline.node, lambda contour=contour: editing.close(contour)) if number in chosen else contour
        for number, contour in enumerate(outline.path.contours)
    ]
    return written(document, outline, made, [])


def reverse_contours(document: Document, node_id: str, contours: Iterable[int] | None = None) -> Document:
    """Run contours of a path through the other way, all of them or those with these numbers; or a Bezier curve, or a
    B-spline."""
    if has_control_points(document, node_id):
        curve = controls(document, node_id)
        _only_contour(curve.node, contours)
        return with_spline(document, curve, lambda spline: spline.reversed())
    outline = drawn(document, node_id)
    chosen = _chosen(outline, contours)
    made = [
        contour.reversed() if number in chosen else contour for number, contour in enumerate(outline.path.contours)
    ]  # fmt: skip
    return written(document, outline, made, [])


def _only_contour(node: Node, contours: Iterable[int] | None) -> None:
    if contours is not None and list(contours) != [0]:
        raise Refusal(f"“{node.label}” is one contour, number 0")


def _chosen(outline: Drawn, contours: Iterable[int] | None) -> list[int]:
    if contours is None:
        return list(range(len(outline.path.contours)))
    try:
        numbers = [contours] if hasattr(contours, "__index__") else list(contours)
    except TypeError:
        raise Refusal(f"contours are told by their numbers, not {contours!r:.60}") from None
    for number in numbers:
        contour_at(outline, number)
    if not numbers:
        raise Refusal(f"select contours of “{outline.node.label}” first")
    return [whole(number) for number in numbers]


def set_segments(document: Document, node_id: str, segments: Iterable[Place], kind: str) -> Document:
    """Make segments of a path, told by (contour, segment), "line", "quad" or "cubic"; a B-spline becomes as many
    cubics as it takes. What that changes of the shape is the deviation."""
    from ...path.editing import convert
    from ...path.path import Kind

    if kind not in SEGMENTS:
        raise Refusal(f"a segment is {', '.join(SEGMENTS[:-1])} or {SEGMENTS[-1]}, not “{kind!s:.40}”")
    wanted = Kind(SEGMENTS.index(kind) + 1)
    outline = drawn(document, node_id)
    groups: dict[int, list[int]] = {}
    for number, segment in pairs(segments):
        count = len(contour_at(outline, number))
        if not 0 <= segment < count:
            where = f"segment {segment} in contour {number}"
            raise Refusal(f"“{outline.node.label}” has no {where}, which has {count}, counted from 0")
        groups.setdefault(number, []).append(segment)
    if not groups:
        raise Refusal(f"select segments of “{outline.node.label}” first")
    contours, leaving = list(outline.path.contours), []
    for number, rows in groups.items():
        contour = contours[number]
        if wanted == Kind.LINE:
            leaving += [_inside(contour, row) for row in rows]
        contours[number] = convert(contour, rows, wanted)[0]
    return written(document, outline, contours, leaving)


def _inside(contour: Contour, segment: int) -> Floats:
    return contour.points[contour.starts[segment] + 1 : contour.starts[segment + 1]]


def add_contour(document: Document, node_id: str, commands: str | Iterable[Sequence[Any]]) -> Document:
    """Add contours to a path, written as `path` takes them: commands, or the text of an SVG path."""
    from ...outline.drawn_commands import fields_of_commands
    from ...outline.paths import own_path

    outline = drawn(document, node_id)
    more = Path(**fields_of_commands(commands))
    if not own_path(more).contours:
        raise Refusal("there is nothing to add: a contour begins with “move” and needs a segment")
    drawn_before, added = outline.path.contours, own_path(more).contours
    if drawn_before and drawn_before[0].dimension != added[0].dimension:
        width = drawn_before[0].dimension
        raise Refusal(f"“{outline.node.label}” has points of {width} coordinates, and what is added {5 - width}")
    return written(document, outline, [*drawn_before, *added])


def split_outline(document: Document, node_id: str) -> Document:
    """Split a path into outlines of their own: each island with its holes, each open curve. The first stays this
    outline, the others come behind it, with its placement and its looks."""
    from ...path.areas.islands import islands

    outline = drawn(document, node_id)
    check_free(document, [node_id])
    node = outline.node
    groups = named(node, lambda: islands(outline.path))
    if len(groups) < 2:
        raise Refusal(f"“{node.label}” is of one piece already")
    *way, _ = trail(document, node_id)
    place = index_of(document, node_id)
    if way and not (
        isinstance(way[-1], Union | LinearArray | PolarArray | Mirror) or (isinstance(way[-1], Difference) and place)
    ):
        raise Refusal(f"“{way[-1].label}” takes “{node.label}” as one outline: take it out first")
    contours = outline.path.contours
    number = next_number(document)
    pieces = []
    for count, group in enumerate(groups[1:]):
        rest = [contour for i, contour in enumerate(contours) if i not in group]
        alone = Document(profiles=(node,), parameters=document.parameters)
        # What the others have may go here; each keeps its own expressions.
        (piece,) = written(alone, outline, [contours[i] for i in group], [c.points for c in rest]).profiles
        pieces.append(piece.with_(id=f"n{number + count}"))
    rest = [contour for i, contour in enumerate(contours) if i not in groups[0]]
    document = written(document, outline, [contours[i] for i in groups[0]], [c.points for c in rest])
    if not way:
        pieces = named_apart(document, pieces)
    return put(document, pieces, way[-1].id if way else None, place + 1)
