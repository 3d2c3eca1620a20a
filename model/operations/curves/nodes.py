"""Nodes of paths and their handles: moved, put to places, put in, taken out, made smooth or not.

A node is told by (contour, node), a handle by (contour, row in `Contour.points`); coordinates are those of the
outline's own axes, before its placement, in millimetres.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import cos, isfinite, radians, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from .addressing import (
    Drawn,
    Floats,
    Place,
    by_contour,
    contour_at,
    coordinates,
    drawn,
    edited,
    named,
    pairs,
    rows_of,
    swapped,
    whole,
    written,
)  # fmt: skip

if TYPE_CHECKING:
    from ...path.path import Contour

JOINTS = ("cusp", "smooth", "symmetric", "auto")
"""In the order of `Node` of path/path.py."""


def move_nodes(document: Document, node_id: str, nodes: Iterable[Place], by: Sequence[float]) -> Document:
    """Move nodes of a path along its own axes, by millimetres; handles go along, automatic nodes beside them follow."""
    from ...path import nodes as handles

    def work(contour: Contour, rows: list[int]) -> Contour:
        shift = coordinates(by, "the way", contour.dimension)
        return handles.move(contour, rows, shift) if shift.any() else contour

    return edited(document, node_id, nodes, work)


def place_nodes(
    document: Document, node_id: str, nodes: Iterable[Place], places: Sequence[Sequence[float]]
) -> Document:
    """Put nodes of a path to places, one for each, in its own axes; handles go along."""
    from ...path import nodes as handles

    outline = drawn(document, node_id)
    wanted = pairs(nodes)
    by_contour(outline, wanted)  # refuses those that there are not
    targets = rows_of(places, "places", len(wanted), outline.path.contours[0].dimension)
    contours = list(outline.path.contours)
    for number in dict.fromkeys(number for number, _ in wanted):
        contour = contours[number]
        target = {node: targets[i] for i, (where, node) in enumerate(wanted) if where == number}
        rows = list(target)
        put = np.array(list(target.values()))
        moved = handles.move(contour, rows, put - contour.places[rows])
        if not contour.splines:  # exactly there, not up to the rounding of the way
            points = moved.points.copy()
            points[contour.starts[rows]] = put
            if contour.closed:
                points[-1] = points[0]
            moved = replace(moved, points=points)
        contours[number] = moved
    return written(document, outline, contours)


def move_handle(document: Document, node_id: str, handle: Place, to: Sequence[float]) -> Document:
    """Put a handle of a path to a place; the one across turns with it where the node is smooth or symmetric."""
    from ...path import nodes as handles

    outline, number, row = _handle(document, node_id, handle)
    contour = outline.path.contours[number]
    target = coordinates(to, "the place", contour.dimension)
    moved = named(outline.node, lambda: handles.move_handle(contour, row, target))
    return written(document, outline, swapped(outline, number, moved))


def set_handle(
    document: Document, node_id: str, handle: Place, length: float | None = None, angle: float | None = None
) -> Document:
    """Give a handle its length, in millimetres from its node, and its angle, in degrees from the x axis of the outline.

    None keeps what it has. The handle of a quadratic counts from the node where its segment begins.
    """
    outline, number, row = _handle(document, node_id, handle)
    contour = outline.path.contours[number]
    segment = int(np.searchsorted(contour.starts, row)) - 1
    first = contour.kinds[segment] == 2 or row == contour.starts[segment] + 1
    here = contour.points[contour.starts[segment if first else segment + 1]]
    arm = contour.points[row] - here
    reach = float(np.linalg.norm(arm))
    for value, what in ((length, "length"), (angle, "angle")):
        if value is not None and not (isinstance(value, int | float) and isfinite(value)):
            raise Refusal(f"the {what} of a handle is a number, not {value!r:.40}")
    size = reach if length is None else float(length)
    if size < 0.0:
        raise Refusal(f"the length of a handle is 0 mm or more, not {size:g}")
    if angle is not None:
        if contour.dimension == 3:
            raise Refusal("a handle of a curve in space has no one angle: put it to a place instead")
        way = np.array([cos(radians(angle)), sin(radians(angle))])
    elif reach > 0.0:
        way = arm / reach
    else:
        raise Refusal("this handle lies on its node and has no direction: give it an angle as well")
    return move_handle(document, node_id, (number, row), tuple((here + size * way).tolist()))


def set_joints(document: Document, node_id: str, nodes: Iterable[Place], kind: str) -> Document:
    """Make nodes of a path "cusp", "smooth", "symmetric" or "auto", and their handles accordingly."""
    from ...path import nodes as handles
    from ...path.path import Node

    if kind not in JOINTS:
        raise Refusal(f"a node is {', '.join(JOINTS[:-1])} or {JOINTS[-1]}, not “{kind!s:.40}”")
    wanted = Node(JOINTS.index(kind))
    return edited(document, node_id, nodes, lambda contour, rows: handles.set_kind(contour, rows, wanted))


def insert_node(document: Document, node_id: str, contour: int, segment: int, parameter: float) -> Document:
    """Put a node on a segment of a path, at its parameter between 0 and 1; the curve stays as it is."""
    from ...path import editing

    outline = drawn(document, node_id)
    old = contour_at(outline, contour)
    if isinstance(parameter, bool) or not isinstance(parameter, int | float):
        raise Refusal(f"the parameter of a segment is a number between 0 and 1, not {parameter!r:.40}")
    new = named(outline.node, lambda: editing.insert(old, whole(segment), float(parameter)))
    return written(document, outline, swapped(outline, contour, new))


def delete_nodes(document: Document, node_id: str, nodes: Iterable[Place], refit: bool = True) -> Document:
    """Take nodes out of a path. One segment comes in place of those beside them: fitted to what was there, or, unless
    `refit`, with the handles that are left. A contour of which fewer than two nodes are left goes altogether."""
    from ...path import editing

    return edited(
        document, node_id, nodes, lambda contour, rows: editing.delete(contour, rows, bool(refit)), _touched
    )  # fmt: skip


def transform_nodes(
    document: Document, node_id: str, nodes: Iterable[Place], matrix: Sequence[Sequence[float]]
) -> Document:
    """Map nodes of a path, with their handles, by a matrix (2, 3) in its own axes; of a Bezier curve or a B-spline
    control points, told by (0, number)."""
    from ...path.transforming import lifted, transform
    from .control_points import has_control_points, mapped_points

    affine = np.array(
        rows_of(matrix, "the matrix", 2, 3) if len(list(matrix)) == 2 else rows_of(matrix, "the matrix", 3, 4)
    )
    if has_control_points(document, node_id):
        return mapped_points(document, node_id, pairs(nodes), lambda points: _mapped(points, affine, lifted))

    def work(contour: Contour, rows: list[int]) -> Contour:
        if affine.shape[0] > contour.dimension:
            raise Refusal("a flat curve is mapped by a matrix of two rows of three numbers")
        return transform(contour, rows, affine)

    return edited(document, node_id, nodes, work)


def _mapped(points: Floats, affine: Floats, lifted: Any) -> Floats:
    if affine.shape[0] > points.shape[1]:
        raise Refusal("a flat curve is mapped by a matrix of two rows of three numbers")
    whole = lifted(affine) if points.shape[1] == 3 else affine
    return points @ whole[:, :-1].T + whole[:, -1]


def _touched(contour: Contour, rows: list[int]) -> Floats:
    """(k, d) the nodes that go, and all points inside the segments beside them."""
    count = len(contour)
    found = [contour.places[rows]]
    for node in rows:
        for segment in (node - 1, node):
            if contour.closed or 0 <= segment < count:
                start, end = contour.starts[segment % count], contour.starts[segment % count + 1]
                found.append(contour.points[start + 1 : end])
    return np.concatenate(found)


def _handle(document: Document, node_id: str, handle: Place) -> tuple[Drawn, int, int]:
    """The outline, the contour and the row of a handle. Raises Refusal."""
    outline = drawn(document, node_id)
    ((number, row),) = pairs([handle])
    contour = contour_at(outline, number)
    if not 0 <= row < len(contour.points) or row in contour.starts:
        raise Refusal(f"“{outline.node.label}” has no handle {handle!r:.40}: they are told by (contour, point)")
    return outline, number, row
