"""Outlines: flat things in the plane z = 0 of their own axes, and curves in space, of which solids are made."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

from . import fields
from .expression import Number
from .nodes import Difference, Instance, Intersection, LinearArray, Mirror, Node, PolarArray, Union

ALIGNMENTS = ("left", "centre", "right", "justify")
ANCHORS = ("baseline", "top", "middle", "bottom")
DIRECTIONS = ("auto", "ltr", "rtl")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Rectangle(Node):
    """An outline with its lowest corner at the origin."""

    title: ClassVar[str] = "Rectangle"
    width: Number = fields.size(20.0, "Width")
    height: Number = fields.size(10.0, "Height")
    centred: bool = fields.flag(False, "Centred", "The origin in the middle")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Circle(Node):
    """A round outline about the origin."""

    title: ClassVar[str] = "Circle"
    radius: Number = fields.size(10.0, "Radius")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Polygon(Node):
    """A closed outline of straight sides, with holes; it is filled where an odd number of loops goes round."""

    title: ClassVar[str] = "Polygon"
    points: tuple[tuple[Number, ...], ...] = fields.points("Points", flat=True)
    loops: tuple[tuple[int, ...], ...] = fields.faces("Loops", "Each the indices of its points; none: all in one loop")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Path(Node):
    """Contours of lines, quadratics, cubics and B-splines, which keep their kind.

    `segments` has a letter for each command, which takes its points from `points` in order: M begins a contour (1
    point), L is a line (1), Q a quadratic (2), C a cubic (3), S the next of `splines` (all its control points). The
    last segment of a closed contour is written small and ends where the contour began: l takes no point, q one, c two,
    s all its control points. `joints` has a letter for each node: c cusp, s smooth, y symmetric, a automatic; none:
    all are cusps. A spline is (degree, knots, weights), weights empty where all are 1.
    """

    title: ClassVar[str] = "Path"
    points: tuple[tuple[Number, ...], ...] = fields.curve_points("Points")
    segments: str = fields.letters("Segments", "A letter for each: M begins, L line, Q quadratic, C cubic, S B-spline; "
                                   "small: the one that closes")  # fmt: skip
    joints: str = fields.letters("Nodes", "A letter for each: c cusp, s smooth, y symmetric, a automatic")
    splines: tuple[tuple[int, tuple[float, ...], tuple[float, ...]], ...] = fields.splines("B-splines")
    even_odd: bool = fields.flag(False, "Even-odd", "Filled where an odd number of contours goes round; else where "
                                 "they go round more often one way than the other")  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Bezier(Node):
    """One Bezier curve of any degree, rational where it has weights."""

    title: ClassVar[str] = "Bezier curve"
    points: tuple[tuple[Number, ...], ...] = fields.curve_points("Control points")
    weights: tuple[Number, ...] = fields.numbers("Weights", "One for each control point; none: all 1")
    closed: bool = fields.flag(False, "Closed", "By a line from its end to its start")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class BSpline(Node):
    """One B-spline curve; NURBS where it has weights.

    Without knots they are uniform: clamped, so that the curve begins and ends at the outermost control points; or,
    where it is closed, running round, so that the first `degree` control points are used again at the end. Knots are
    then those of one turn, one more than control points.
    """

    title: ClassVar[str] = "B-spline"
    points: tuple[tuple[Number, ...], ...] = fields.curve_points("Control points")
    degree: Number = fields.count(3, "Degree", minimum=1)
    knots: tuple[Number, ...] = fields.numbers("Knots", "Rising, one more than control points and degree together; "
                                               "none: uniform")  # fmt: skip
    weights: tuple[Number, ...] = fields.numbers("Weights", "One for each control point; none: all 1")
    closed: bool = fields.flag(False, "Closed", "It runs round smoothly")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Lettering(Node):
    """Text in a font, whose letters are outlines: they stay text, and every contour fills by the non-zero rule.

    `size` is that of the em. `font` is the name of an installed or bundled font; with `asset`, the SHA-256 of a font
    file, it is that file's face number `face`, and `font` what it is called. `axes` has values of variable axes,
    "wght=700 wdth=85", and `features` those of OpenType, "kern=0 smcp".
    """

    title: ClassVar[str] = "Lettering"
    refers: ClassVar[bool] = True
    text: str = fields.text("Text", "Text", "Several lines if you like", "lines")
    font: str = fields.text("DejaVu Sans", "Font", "Family and style, as “DejaVu Sans Bold”", "font")
    asset: str = fields.text("", "Font file", "SHA-256 of a font file that the project carries")
    face: Number = fields.count(0, "Face", "Which face of a collection, from 0", minimum=0)
    size: Number = fields.size(10.0, "Size", "Of the em, from which capitals take about seven tenths")
    alignment: str = fields.choice("Alignment", ALIGNMENTS, "Of the lines, to x = 0 or about it")
    anchor: str = fields.choice("Anchor", ANCHORS, "What stands at y = 0: the first line's baseline, or the block's "
                                "top, middle or bottom")  # fmt: skip
    direction: str = fields.choice("Direction", DIRECTIONS, "Of the lines: that of their first letter, left to right "
                                   "or right to left")  # fmt: skip
    line_spacing: Number = fields.factor(1.0, "Line spacing", "Of the font's own distance of lines")
    letter_spacing: Number = fields.length(0.0, "Letter spacing", "Added after each letter")
    width: Number | None = fields.size(None, "Fit to width", "The longest line gets this width, by another size of "
                                       "all; empty: as it comes", optional=True)  # fmt: skip
    slant: Number = fields.angle(0.0, "Slant", "Leans each letter to the right about its baseline")
    weight: Number = fields.length(0.0, "Weight", "Grows each outline by this on every side; below 0: thinner")
    axes: str = fields.text("", "Axes", "Of a variable font, as “wght=700 wdth=85”", "line")
    features: str = fields.text("", "Features", "Of OpenType, as “kern=0 smcp liga=0”", "line")
    language: str = fields.text("", "Language", "As “tr” or “sr”, where letters differ by language", "line")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class TextOnPath(Node):
    """The first operand, a lettering, set along the second, a curve in the plane; every letter stays as it is.

    The x axis of the lettering runs along the curve, from its beginning, its middle or its end as the lettering is
    aligned; a letter stands on it with the middle of its advance, marks with their letter, and turns as the curve does
    there. A closed curve is run round once.
    """

    title: ClassVar[str] = "Text on a path"
    operands: ClassVar[tuple[int, int | None]] = (2, 2)
    start: Number = fields.length(0.0, "Start", "How much farther along the curve the lettering stands")
    shift: Number = fields.length(0.0, "Shift", "How far off the curve it stands, to the letters' top")
    flip: bool = fields.flag(False, "Other side", "It runs the other way, on the other side of the curve")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Stencil(Node):
    """An outline whose holes are joined by bridges to what lies around it, so that nothing falls out where it is cut.

    A bridge goes straight through the middle of its hole, where the wall is the thinner one of both sides.
    """

    title: ClassVar[str] = "Stencil"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    width: Number = fields.size(1.0, "Width", "Of each bridge")
    angle: Number = fields.angle(90.0, "Angle", "Of the bridges; 90: up and down")
    bridges: Number = fields.count(1, "Bridges", "Of each hole: 1, or 2 on opposite sides", minimum=1)


OUTLINES: tuple[type[Node], ...] = (Rectangle, Circle, Polygon, Path, Bezier, BSpline, Lettering, TextOnPath)
CURVES: tuple[type[Node], ...] = (Path, Bezier, BSpline)
"""The outlines whose points can be moved one by one."""
OF_OUTLINES: tuple[type[Node], ...] = (Union, Difference, Intersection, LinearArray, PolarArray, Mirror, Stencil)
"""The operations whose result is flat where their operands are; all but the stencil take solids as well."""


def is_outline(node: Node, definitions: Iterable[Node] = ()) -> bool:
    """Whether a node is flat: an outline, or an operation on outlines, which its first operand tells.

    `definitions` are those of its document, for trees whose instances are not resolved.
    """
    return isinstance(node, OUTLINES) or node in Outlines(definitions)


class Outlines:
    """`node in Outlines(definitions)` is `is_outline`, for many nodes of one document: each is looked at once."""

    def __init__(self, definitions: Iterable[Node] = ()) -> None:
        self._given = definitions
        self._definitions: Mapping[str, Node] | None = None
        self._known: dict[int, tuple[Node, bool]] = {}

    def __contains__(self, node: Node) -> bool:
        way: list[Node] = []
        here: Node | None = node
        answer = False
        while here is not None:
            known = self._known.get(id(here))
            if known is not None:
                answer = known[1]
                break
            if isinstance(here, OUTLINES):
                answer = True
                break
            way.append(here)
            self._known[id(here)] = (here, False)  # also the end of a circle of definitions, which documents refuse
            here = self._leading(here)
        for passed in way:
            self._known[id(passed)] = (passed, answer)
        return answer

    def _leading(self, node: Node) -> Node | None:
        """The node that tells what this one is, None for what makes solids."""
        if isinstance(node, Instance) and not node.children:
            if self._definitions is None:
                self._definitions = {root.id: root for root in self._given}
            return self._definitions.get(node.definition)
        return node.children[0] if node.children and isinstance(node, (Instance, *OF_OUTLINES)) else None
