"""Paths: contours of lines, quadratics, cubics and B-splines that keep their kind; commands in and out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal

if TYPE_CHECKING:
    from ..spline.bspline import BSpline

Floats: TypeAlias = NDArray[np.float64]
Numbers: TypeAlias = NDArray[np.intp]
Command: TypeAlias = tuple[Any, ...]
"""("move", p), ("line", p), ("quad", c, p), ("cubic", c1, c2, p), ("spline", BSpline) or ("close",)."""
Segment: TypeAlias = "Floats | BSpline"
"""Control points (2 to 4, d) of a line, a quadratic or a cubic; or a B-spline."""

RULES = ("nonzero", "evenodd")
ROUNDING = 1e-12
"""Ends that are nearer to each other than this share of the contour's size are one point."""


class Kind(IntEnum):
    """What a segment is; the number is the degree of a Bezier segment."""

    SPLINE = 0
    LINE = 1
    QUADRATIC = 2
    CUBIC = 3


class Node(IntEnum):
    """How the handles of a node hang together when one of them is moved."""

    CUSP = 0  # not at all
    SMOOTH = 1  # on one line through the node
    SYMMETRIC = 2  # and of one length
    AUTO = 3  # they follow from the neighbouring nodes


NAMES = {"line": Kind.LINE, "quad": Kind.QUADRATIC, "cubic": Kind.CUBIC}
WORDS = {kind: name for name, kind in NAMES.items()}


@dataclass(frozen=True, eq=False)
class Contour:
    """Segments that hang together, end to start. Arrays are read-only.

    `points` (m, d) are nodes and handles in their order, the node between two segments once: segment i of degree k has
    the controls points[starts[i] : starts[i] + k + 1], a spline the two nodes alone. In a closed contour the first
    node stands at the end again. `splines` has the B-splines in their order, `nodes` a `Node` for each node (one for
    each segment, and one more where the contour is open; none given: cusps).
    """

    points: Floats
    kinds: NDArray[np.uint8]  # (s,) of Kind
    closed: bool = False
    splines: tuple[BSpline, ...] = ()
    nodes: NDArray[np.uint8] = field(default_factory=lambda: np.zeros(0, np.uint8))

    def __post_init__(self) -> None:
        points = np.array(self.points, float)
        kinds = np.array(self.kinds, np.uint8)
        count = len(kinds) + (not self.closed)
        nodes = np.array(self.nodes, np.uint8) if len(self.nodes) else np.zeros(count, np.uint8)
        if points.ndim != 2 or points.shape[1] not in (2, 3) or not np.isfinite(points).all():
            raise ValueError("the points of a contour are finite, of two or three coordinates")
        if not len(kinds) or len(points) != np.maximum(kinds, 1).sum() + 1 or kinds.max() > Kind.CUBIC:
            raise ValueError("the points of a contour do not fit the kinds of its segments")
        if len(self.splines) != np.count_nonzero(kinds == Kind.SPLINE) or nodes.shape != (count,):
            raise ValueError("a contour needs its splines, and a kind for every node")
        if self.closed and (points[0] != points[-1]).any():
            raise ValueError("a closed contour must end where it begins")
        for name, array in (("points", points), ("kinds", kinds), ("nodes", nodes)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @classmethod
    def of_segments(cls, segments: Sequence[Segment], closed: bool = False, nodes: ArrayLike = ()) -> Contour:
        """From control points and B-splines, each beginning where the one before ends (its own first is not read)."""
        kinds, rows, splines = [], [ends(segments[0])[:1]], []
        for segment in segments:
            bezier = isinstance(segment, np.ndarray)
            kinds.append(len(segment) - 1 if bezier else Kind.SPLINE)
            rows.append(segment[1:] if bezier else ends(segment)[1:])
            if not bezier:
                splines.append(segment)
        points = np.concatenate(rows)
        if closed:
            points[-1] = points[0]
        return cls(points, np.array(kinds, np.uint8), closed, tuple(splines), np.asarray(nodes, np.uint8))

    def __len__(self) -> int:
        """How many segments."""
        return len(self.kinds)

    @property
    def dimension(self) -> int:
        return self.points.shape[1]

    @cached_property
    def starts(self) -> Numbers:
        """(s + 1,) where in `points` each segment begins, and the last one ends."""
        return np.concatenate(([0], np.cumsum(np.maximum(self.kinds, 1), dtype=np.intp)))

    @property
    def places(self) -> Floats:
        """(s, d) of the nodes where closed, else (s + 1, d)."""
        return self.points[self.starts[: len(self.kinds) + (not self.closed)]]

    def segment(self, number: int) -> Segment:
        if self.kinds[number] == Kind.SPLINE:
            return self.splines[int(np.count_nonzero(self.kinds[:number] == Kind.SPLINE))]
        return self.points[self.starts[number] : self.starts[number + 1] + 1]

    def segments(self) -> list[Segment]:
        splines, starts = iter(self.splines), self.starts.tolist()
        return [
            next(splines) if kind == Kind.SPLINE else self.points[starts[i] : starts[i + 1] + 1]
            for i, kind in enumerate(self.kinds.tolist())
        ]

    def reversed(self) -> Contour:
        """The same curve run through the other way; a closed one begins at the same node."""
        nodes = np.roll(self.nodes[::-1], 1) if self.closed else self.nodes[::-1]
        splines = tuple(spline.reversed() for spline in self.splines[::-1])
        return Contour(self.points[::-1], self.kinds[::-1], self.closed, splines, nodes)

    def transformed(self, matrix: ArrayLike) -> Contour:
        """By an affine matrix (2, 3) for the plane, or (3, 4), which also lifts a plane contour into space.

        Segments keep their kind; nodes that a shear or a scale makes uneven become smooth instead of symmetric.
        """
        affine = np.asarray(matrix, float)
        rows, columns = affine.shape
        if (rows, columns) not in ((2, 3), (3, 4)) or self.dimension > rows:
            raise ValueError(f"a matrix {affine.shape} does not move points of {self.dimension} coordinates")
        turn = affine[:, : self.dimension]
        gram = turn.T @ turn
        even = np.abs(gram - gram[0, 0] * np.eye(len(gram))).max() <= 1e-12 * max(gram[0, 0], 1e-300)
        nodes = self.nodes if even else np.where(self.nodes >= Node.SYMMETRIC, Node.SMOOTH, self.nodes)
        splines = tuple(replace(spline, points=spline.points @ turn.T + affine[:, -1]) for spline in self.splines)
        return Contour(self.points @ turn.T + affine[:, -1], self.kinds, self.closed, splines, nodes)

    def bounds(self) -> Floats:
        """(2, d) lowest and highest coordinates that the curve itself reaches."""
        return Path((self,)).bounds()

    def area(self) -> float:
        """Signed, mm², by Green's theorem: positive counter-clockwise. An open contour counts with its chord."""
        return Path((self,)).area()

    def length(self) -> float:
        """mm."""
        return Path((self,)).length()

    def commands(self) -> list[Command]:
        """The contour as commands; a closing line is left to ("close",)."""
        found: list[Command] = [("move", self.points[0])]
        for kind, segment in zip(self.kinds.tolist(), self.segments(), strict=True):
            found.append((WORDS[kind], *segment[1:]) if isinstance(segment, np.ndarray) else ("spline", segment))
        if self.closed:
            if self.kinds[-1] == Kind.LINE and len(self.kinds) > 1:
                found.pop()
            found.append(("close",))
        return found


def ends(segment: Segment) -> Floats:
    """(2, d) where a segment begins and where it ends."""
    if isinstance(segment, np.ndarray):
        return segment[[0, -1]]
    from ..spline.bspline import ends as ends_of_spline

    return ends_of_spline(segment)


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """Contours, and the rule that tells what they fill: "nonzero" or "evenodd"."""

    contours: tuple[Contour, ...]
    rule: str = "nonzero"

    def __post_init__(self) -> None:
        if self.rule not in RULES:
            raise Refusal(f"the fill rule of a path is “nonzero” or “evenodd”, not “{self.rule!s:.40}”")
        if len({contour.dimension for contour in self.contours}) > 1:
            raise ValueError("the contours of a path have the same number of coordinates")

    @classmethod
    def of_commands(cls, commands: Iterable[Command], rule: str = "nonzero") -> Path:
        """A path from commands with points (2,) or (3,), millimetres.

        After ("close",) the next contour begins, unless moved, where the closed one did. A spline that begins
        elsewhere is reached by a line. Contours without a segment are left out. Raises Refusal with the number of the
        command at fault, counted from 1.
        """
        from .commands import Reader

        reader = Reader()
        for number, command in enumerate(commands, 1):
            reader.read(number, command)
        reader.finish()
        return cls(tuple(reader.contours), rule)

    def commands(self) -> list[Command]:
        return [command for contour in self.contours for command in contour.commands()]

    def transformed(self, matrix: ArrayLike) -> Path:
        """By an affine matrix (2, 3) or (3, 4); see `Contour.transformed`."""
        return replace(self, contours=tuple(contour.transformed(matrix) for contour in self.contours))

    def reversed(self) -> Path:
        """Every contour run through the other way."""
        return replace(self, contours=tuple(contour.reversed() for contour in self.contours))

    def bounds(self) -> Floats:
        """(2, d) lowest and highest coordinates that the curves themselves reach. Raises ValueError when empty."""
        from .pieces import bounds, pieces_of

        if not self.contours:
            raise ValueError("a path without contours has no bounds")
        return bounds(pieces_of(self.contours))

    def area(self) -> float:
        """Sum of the contours' signed areas, mm², by Green's theorem: twice where two overlap, whatever the rule."""
        from .pieces import area, pieces_of

        if any(contour.dimension == 3 for contour in self.contours):
            raise ValueError("only a path in the plane has an area")
        if not self.contours:
            return 0.0
        chords = np.array([contour.points[[-1, 0]] for contour in self.contours])
        middle = chords.mean(axis=(0, 1))
        first, second = np.moveaxis(chords - middle, 1, 0)
        closing = 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]).sum()
        return float(area(pieces_of(self.contours), middle) + closing)

    def length(self) -> float:
        """mm, over all contours; relative error about 1e-13."""
        from .pieces import length, pieces_of

        return length(pieces_of(self.contours)) if self.contours else 0.0
