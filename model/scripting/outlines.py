"""Outlines as values, and the solids they make."""

# Nodes take numbers as text too, and keep them as expressions; their types tell what they keep.
# pyright: reportArgumentType=false

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from ..document.from_outlines import Extrude, Loft, Pipe, Revolve, Sweep, Wrap
from ..document.nodes import Node
from ..document.outlines import Bezier, BSpline, Circle, Path, Polygon, Rectangle
from .shapes import Value

if TYPE_CHECKING:
    from ..outline.construction import Construction
    from ..outline.joints import JointAt


def rectangle(width: Value = 20, height: Value = 10, centred: bool = False) -> Rectangle:
    """An outline with its lowest corner at the origin.

    >>> measure(extrude(rectangle(4, 5), 6)).volume
    120.0
    """
    return Rectangle(width=width, height=height, centred=centred)


def circle(radius: Value = 10, segments: int | None = None, tolerance: Value | None = None) -> Circle:
    """A round outline about the origin.

    >>> circle(4).at(12)
    <Circle ...>
    """
    return Circle(radius=radius, segments=segments, tolerance=tolerance)


def polygon(points: Iterable[Sequence[Value]] = (), loops: Iterable[Sequence[int]] = ()) -> Polygon:
    """A closed outline of straight sides through `points` (n, 2); `loops` of indices make holes (even-odd rule).

    >>> measure(extrude(polygon([(0, 0), (4, 0), (0, 3)]), 2)).volume
    12.0
    """
    return Polygon(points=tuple(tuple(p) for p in points), loops=tuple(tuple(loop) for loop in loops))


def path(
    drawn: str | Iterable[Sequence[Any]] = (),
    *,
    points: Iterable[Sequence[Value]] = (),
    segments: str = "",
    joints: str = "",
    splines: Iterable[Any] = (),
    even_odd: bool = False,
) -> Path:
    """An outline, or an open curve, of lines, quadratics, cubics and B-splines.

    `drawn` are commands, or the text of an SVG path (y up, in millimetres). A command is ("move", p), ("line", p),
    ("quad", c, p), ("cubic", c1, c2, p), or ("close",); points have two coordinates, or three. The other arguments are
    the fields of the node, as the document keeps them.

    >>> measure(extrude(path("M 0 0 H 4 V 3 Z"), 2)).volume
    12.0
    >>> path([("move", (0, 0)), ("cubic", (0, 5), (10, 5), (10, 0)), ("close",)])
    <Path ...>
    """
    if isinstance(drawn, str):
        if not drawn:
            return Path(
                points=tuple(points), segments=segments, joints=joints, splines=tuple(splines), even_odd=even_odd
            )
    elif not (drawn := list(drawn)):
        return path("", points=points, segments=segments, joints=joints, splines=splines, even_odd=even_odd)
    from ..outline.drawn_commands import fields_of_commands

    return Path(**fields_of_commands(drawn), joints=joints, even_odd=even_odd)


def outlines(path: str | os.PathLike[str]) -> list[Path]:
    """The shapes of an SVG or DXF file as outlines, in millimetres with y up, from back to front.

    What is filled is closed; names and colours come along.
    """
    from ..exchange.drawings.drawings_in import read_drawing
    from ..exchange.drawings.outlines_in import document_of_drawing

    document = document_of_drawing(read_drawing(path), PurePath(path).stem)
    return [node for node in document.profiles if isinstance(node, Path)]


def continuity(outline: Node) -> list[JointAt]:
    """The joints of an outline: where each is, its `grade` (0 to 2 for G0 to G2, -1 a gap), and its `joint`, which
    has the gap, the angle in degrees, the curvatures before and after in 1/mm, and their jump.

    >>> [joint.grade for joint in continuity(rectangle(4, 5))]
    [0, 0, 0, 0]
    """
    from ..document.resolve import resolve
    from ..outline.joints import joints_of
    from ..outline.paths import path_of
    from .documents import document_of

    (root,) = resolve(document_of(outline)).profiles or (outline,)
    return joints_of(path_of(root))


def construction(outline: Node, t: float, contour: int = 0, segment: int = 0) -> Construction:
    """De Casteljau's construction of a point, de Boor's in a B-spline, at t from 0 to 1 of a segment.

    It has the `levels` of points, the `basis`, the `point`, its unit `tangent` and the `polynomial`.

    >>> made = construction(bezier([(0, 0), (0, 8), (8, 8)]), 0.5)
    >>> [len(level) for level in made.levels], made.point.tolist(), made.basis.tolist()
    ([3, 2, 1], [2.0, 6.0], [0.25, 0.5, 0.25])
    """
    from ..document.resolve import resolve
    from ..outline.construction import construct, segment_at
    from ..outline.paths import path_of
    from .documents import document_of

    (root,) = resolve(document_of(outline)).profiles or (outline,)
    return construct(segment_at(path_of(root), contour, segment), t)


def bezier(points: Iterable[Sequence[Value]] = (), weights: Iterable[Value] = (), closed: bool = False) -> Bezier:
    """One Bezier curve of any degree; `weights` make it rational, `closed` adds a line from its end to its start.

    >>> measure(extrude(bezier([(0, 0), (0, 3), (3, 0)], closed=True), 2)).volume > 0
    True
    """
    return Bezier(points=tuple(points), weights=tuple(weights), closed=closed)


def bspline(
    points: Iterable[Sequence[Value]] = (),
    degree: int = 3,
    knots: Iterable[Value] = (),
    weights: Iterable[Value] = (),
    closed: bool = False,
) -> BSpline:
    """One B-spline curve; without `knots` they are uniform, clamped where it is open.

    >>> bspline([(0, 0), (10, 10), (20, 0), (30, 10)])
    <BSpline ...>
    """
    return BSpline(points=tuple(points), degree=degree, knots=tuple(knots), weights=tuple(weights), closed=closed)


def extrude(
    outline: Node,
    height: Value = 10,
    twist: Value = 0,
    top_scale: Value = 1,
    centred: bool = False,
    segments: int | None = None,
    tolerance: Value | None = None,
    *,
    below: Value = 0,
    taper: Value = 0,
    bevel: Value = 0,
) -> Extrude:
    """An outline drawn up along z, and `below` to the other side, twisted by degrees and scaled towards the top.

    `taper` are the degrees that its walls lean inwards; `bevel` cuts the edge of the top at 45 degrees, which goes
    with none of the three.

    >>> extrude(circle(10), height=5, top_scale=0.5)
    <Extrude ...>
    >>> round(measure(extrude(rectangle(10, 10), 5, bevel=1)).volume, 6)  # 4 mm upright, then a frustum
    481.333333
    """
    return Extrude(
        children=(outline,),
        height=height,
        below=below,
        taper=taper,
        bevel=bevel,
        twist=twist,
        top_scale=top_scale,
        centred=centred,
        segments=segments,
        tolerance=tolerance,
    )


def revolve(
    outline: Node,
    angle: Value = 360,
    segments: int | None = None,
    tolerance: Value | None = None,
    *,
    start: Value = 0,
) -> Revolve:
    """An outline turned about its y axis, which becomes z, from `start` on over `angle` degrees.

    >>> revolve(circle(4).at(12), angle=180)
    <Revolve ...>
    """
    return Revolve(children=(outline,), angle=angle, start=start, segments=segments, tolerance=tolerance)


def sweep(
    outline: Node,
    along: Node,
    twist: Value = 0,
    end_scale: Value = 1,
    segments: int | None = None,
    tolerance: Value | None = None,
) -> Sweep:
    """An outline drawn along a path, across which it stands without turning about it.

    >>> sweep(circle(2), path([("move", (0, 0, 0)), ("cubic", (0, 0, 10), (10, 0, 10), (10, 0, 20))]))
    <Sweep ...>
    """
    return Sweep(children=(outline, along), twist=twist, end_scale=end_scale, segments=segments, tolerance=tolerance)


def loft(*outlines: Node, smooth: bool = False, closed: bool = False, tolerance: Value | None = None) -> Loft:
    """A solid stretched over outlines, each where it is placed, from the first to the last.

    >>> loft(rectangle(20, 20, centred=True), circle(6).at(0, 0, 30))
    <Loft ...>
    """
    return Loft(children=outlines, smooth=smooth, closed=closed, tolerance=tolerance)


def pipe(
    along: Node,
    radius: Value = 2,
    bore: Value = 0,
    rounded: bool = False,
    segments: int | None = None,
    tolerance: Value | None = None,
) -> Pipe:
    """A round bar along a path, or a tube where it has a bore.

    >>> pipe(path([("move", (0, 0, 0)), ("line", (0, 0, 10))]), radius=2, bore=1)
    <Pipe ...>
    """
    return Pipe(children=(along,), radius=radius, bore=bore, rounded=rounded, segments=segments, tolerance=tolerance)


def wrap(
    outline: Node, radius: Value = 20, height: Value = 1, below: Value = 1, tolerance: Value | None = None
) -> Wrap:
    """An outline laid round a cylinder about the z axis, from `below` under its surface to `height` above it.

    >>> cylinder(radius=20, height=30) - wrap(lettering("Ada", 12).at(-12, 10), radius=20)
    <Difference ...>
    """
    return Wrap(children=(outline,), radius=radius, height=height, below=below, tolerance=tolerance)


__all__ = [
    "bezier", "bspline", "circle", "construction", "continuity", "extrude", "loft", "outlines", "path", "pipe",
    "polygon", "rectangle", "revolve", "sweep", "wrap",
]  # fmt: skip
