"""The dimensions of a bounding box in a parallel view (ISO 129-1): extension lines, arrows, figures in millimetres."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .page import INK, THIN, Fill, Item, Strokes, Text, width_of

if TYPE_CHECKING:
    from ..drawing.projection import Projection

Floats = NDArray[np.float64]

OFFSET = 9.0  # mm from the box to the dimension line
GAP, BEYOND = 1.0, 2.0  # mm that extension lines begin off the box and go on behind the dimension line
ARROW, HALF_WIDTH = 3.0, 0.5  # mm
HEIGHT, ABOVE = 2.5, 1.0  # mm: capitals, and how far they stand above their line
ROOM = OFFSET + ABOVE + HEIGHT + 2.0
"""mm beside a view that a dimension takes."""
SHORTEST = 1e-3  # of the longest edge in the picture: what is shorter there is seen from its end
DOWNWARD = {0: (0.0, -1.0), 1: (0.35, -1.0), 2: (-1.0, 0.0)}
"""On which side of the view the dimension along each axis of the world stands, where there is a choice."""


@dataclass(frozen=True, slots=True)
class _Edge:
    """An edge of the box in the picture, and the unit directions along it and of its extension lines."""

    ends: Floats  # (2, 2)
    along: Floats
    out: Floats


def dimension_words(length: float) -> str:
    """A length in mm with two decimals at most, as dimensions have it."""
    return f"{length:.2f}".rstrip("0").rstrip(".")


def box_dimensions(
    projection: Projection, extent: Floats, scale: float, sides: Mapping[int, tuple[float, float]] = DOWNWARD
) -> list[Item]:
    """The dimensions of a box (2, 3) along the axes in `sides`, in mm of paper from the picture's origin.

    `sides` has for each axis of the world the direction in the picture in which its dimension is best put. An axis that
    is seen from its end has none.
    """
    corners = np.array([[extent[(place >> axis) & 1, axis] for axis in range(3)] for place in range(8)])
    flat = projection.picture(corners)[:, :2] * scale
    items: list[Item] = []
    for axis, side in sides.items():
        edge = _best_edge(flat, axis, np.asarray(side, float))
        if edge is not None:
            items += _dimension(edge, dimension_words(float(extent[1, axis] - extent[0, axis])))
    return items


def _best_edge(flat: Floats, axis: int, side: Floats) -> _Edge | None:
    """Of the four edges along an axis that on the box's outline which lies farthest to a side, with extension lines
    along another axis that lead away from the box."""
    spans = [flat[1 << other] - flat[0] for other in range(3)]
    size = max(float(np.linalg.norm(span)) for span in spans)
    length = float(np.linalg.norm(spans[axis]))
    if length <= SHORTEST * size:
        return None
    along = spans[axis] / length
    normal = np.array([-along[1], along[0]])
    if normal @ side < 0.0:
        normal = -normal
    found: list[tuple[float, _Edge]] = []
    for other in range(3):
        across = float(spans[other] @ normal)
        if other == axis or abs(across) <= SHORTEST * size:
            continue
        out = spans[other] / np.linalg.norm(spans[other]) * np.sign(across)
        base = _outermost(flat, axis, other, normal)
        tilt = 1.0 - float(out @ normal)  # extension lines square to the dimension are best, then those to the side
        found.append((float(out @ side) - 2.0 * tilt, _Edge(flat[[base, base | 1 << axis]], along, out)))
    if not found:  # a flat box, seen square: nothing tells where it ends
        heights = flat @ normal
        base = next(
            place for place in range(8) if not place >> axis & 1 and heights[place] >= heights.max() - 1e-9 * size
        )
        return _Edge(flat[[base, base | 1 << axis]], along, normal)
    return max(found, key=lambda pair: pair[0])[1]


def _outermost(flat: Floats, axis: int, other: int, normal: Floats) -> int:
    """The lower corner of the edge along `axis` that lies farthest along the normal; of two, the one nearer to the
    viewer's lower left, so that the choice is the same every time."""
    bases = [place for place in range(8) if not place >> axis & 1]
    heights = [round(float(flat[base] @ normal), 6) for base in bases]
    return bases[heights.index(max(heights))]


def _dimension(edge: _Edge, words: str) -> list[Item]:
    along, out = edge.along, edge.out
    square = max(abs(float(out @ np.array([-along[1], along[0]]))), 0.2)
    reach = OFFSET / square  # the line is so far from the box whatever the tilt of its extension lines
    start, end = edge.ends + out * reach
    lines = [np.array([corner + out * GAP, corner + out * (reach + BEYOND)]) for corner in edge.ends]
    length = float(np.linalg.norm(end - start))
    if along[0] < -1e-9 or (abs(along[0]) <= 1e-9 and along[1] < 0.0):  # to be read from below or from the right
        along, start, end = -along, end, start
    angle = float(np.degrees(np.arctan2(along[1], along[0])))
    up = np.array([-along[1], along[0]])
    wide = width_of(words, HEIGHT)
    inside = length >= 2.0 * ARROW + 2.0
    heads = [(start, -along), (end, along)] if inside else [(start, along), (end, -along)]
    if inside:
        lines.append(np.array([start, end]))
    else:
        lines.append(np.array([start - along * 2.0 * ARROW, end + along * 2.0 * ARROW]))
    middle, anchor = (start + end) / 2.0 + up * ABOVE, "middle"
    if wide > length - 1.0 and not inside:  # beside the arrows, on a line that goes on below it
        lines[-1] = np.array([start - along * 2.0 * ARROW, end + along * (2.0 * ARROW + wide)])
        middle, anchor = end + along * 2.0 * ARROW + up * ABOVE, "start"
    arrows = tuple(np.array([tip, *(tip - way * ARROW + side * up for side in (HALF_WIDTH, -HALF_WIDTH))])
                   for tip, way in heads)  # fmt: skip
    return [
        Strokes("dimension", THIN, tuple(lines)),
        *(Fill("dimension", INK, (arrow,)) for arrow in arrows),
        Text(words, (float(middle[0]), float(middle[1])), HEIGHT, anchor, angle, "dimension"),
    ]
