"""Outline nodes as paths of curves, and a path as the fields of a node."""

from __future__ import annotations

from functools import singledispatch
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.expression import Number
from ..document.nodes import Broken, Instance, Node, range_fault
from ..document.outlines import Bezier, BSpline, Circle, Lettering, Path, Polygon, Rectangle, TextOnPath
from ..document.placement import Placement
from ..path import path as curves
from ..path import shapes
from ..spline.bspline import BSpline as Spline
from ..spline.knots import clamped_knots, closed, on_domain

LETTERS = {"L": curves.Kind.LINE, "Q": curves.Kind.QUADRATIC, "C": curves.Kind.CUBIC, "S": curves.Kind.SPLINE}
JOINTS = "csya"
"""In the order of `Node` of path/path.py."""
FLAT = 1e-12


def path_of(node: Node) -> curves.Path:
    """A resolved outline as a path of curves, placed by its own placement: in the plane, or in space where it leaves
    the plane z = 0. Raises Refusal that names the node."""
    made: list[curves.Path] = []
    stack: list[tuple[Node, bool]] = [(node, False)]
    while stack:
        here, ready = stack.pop()
        children = () if isinstance(here, TextOnPath) else here.children  # which asks for its own
        if not ready:
            stack.append((here, True))
            stack += [(child, False) for child in reversed(children)]
            continue
        fault = here.message if isinstance(here, Broken) else range_fault(here)
        if fault:
            raise Refusal(fault)
        size = len(children)
        below = made[len(made) - size :]
        del made[len(made) - size :]
        made.append(placed(_joined(here, below) if size else own_path(here), here.placement))
    return made[0]


def _joined(node: Node, paths: list[curves.Path]) -> curves.Path:
    if isinstance(node, Instance):
        return paths[0]
    from .joining import joined_path

    return joined_path(node, paths)


def placed(path: curves.Path, placement: Placement) -> curves.Path:
    """A path under a placement; see `path_of`."""
    return moved(path, placement.matrix()) if placement.steps else path


def moved(path: curves.Path, matrix: NDArray[np.float64]) -> curves.Path:
    """A path under a map (3, 4): in the plane as long as that leaves it there, else in space."""
    if not path.contours:
        return path
    plane = in_plane(matrix)
    if path.contours[0].dimension == 2 and plane is not None:
        return path.transformed(plane)
    return path.transformed(matrix)


def in_plane(matrix: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """The (2, 3) map that a (3, 4) one makes of the plane z = 0, or None where that goes elsewhere."""
    size = max(float(np.abs(matrix[:, :2]).max()), 1e-300)
    if np.abs(matrix[2, :2]).max() > FLAT * size or abs(matrix[2, 3]) > FLAT * max(np.abs(matrix[:, 3]).max(), size):
        return None
    return matrix[:2][:, [0, 1, 3]]


@singledispatch
def own_path(node: Node) -> curves.Path:
    """A resolved outline of `OUTLINES` as a path in its own axes, before its placement. Raises Refusal."""
    raise Refusal(f"{node.title}: a solid stands where an outline is needed")


@own_path.register
def path_of_rectangle(node: Rectangle) -> curves.Path:
    width, height = float(node.width), float(node.height)  # type: ignore[arg-type]
    corner = (-width / 2, -height / 2) if node.centred else (0.0, 0.0)
    return shapes.rectangle(width, height, corner=corner)


@own_path.register
def path_of_circle(node: Circle) -> curves.Path:
    """Exact, as a rational B-spline; a polygon where the circle has segments of its own."""
    radius = float(node.radius)  # type: ignore[arg-type]
    if node.segments is not None:
        return shapes.polygon(int(node.segments), radius, start=0.0)  # type: ignore[arg-type]
    return shapes.ellipse((0.0, 0.0), radius, exact=True)


@own_path.register
def path_of_polygon(node: Polygon) -> curves.Path:
    if len(node.points) < 3:
        raise Refusal("Polygon: three or more points are needed")
    points = np.array(node.points, dtype=np.float64)
    loops = node.loops or (tuple(range(len(points))),)
    contours = []
    for number, loop in enumerate(loops):
        if len(loop) < 3 or min(loop) < 0 or max(loop) >= len(points):
            raise Refusal(f"Polygon: loop {number} must name three or more of the points 0 to {len(points) - 1}")
        ring = points[[*loop, loop[0]]]
        contours.append(curves.Contour(ring, np.full(len(loop), curves.Kind.LINE, np.uint8), True))
    return curves.Path(tuple(contours), "evenodd")


@own_path.register
def path_of_lettering(node: Lettering) -> curves.Path:
    from ..lettering.lettering import path_of_lettering

    return path_of_lettering(node)


@own_path.register
def path_of_text_on_path(node: TextOnPath) -> curves.Path:
    from ..lettering.along import path_along

    return path_along(node)


@own_path.register
def path_of_bezier(node: Bezier) -> curves.Path:
    """Up to degree three without weights a segment of that kind, else a B-spline without inner knots."""
    points = _rows(node.points)
    if len(points) < 2:
        raise Refusal("Bezier curve: two or more control points are needed")
    weights = _weights(node.weights, len(points), node.title)
    degree = len(points) - 1
    if weights is None and degree <= 3:
        segment: Any = points
    else:
        segment = Spline(points, degree, clamped_knots(len(points), degree), weights)
    return curves.Path((_ring([segment], node.closed),))


@own_path.register
def path_of_bspline(node: BSpline) -> curves.Path:
    return curves.Path((_ring([spline_of(node)], node.closed),))


def spline_of(node: BSpline) -> Spline:
    """The curve of a resolved B-spline node, in its own axes. Raises Refusal."""
    points = _rows(node.points)
    degree = int(node.degree)  # type: ignore[arg-type]
    if degree != node.degree:
        raise Refusal(f"B-spline: the degree is a whole number, not {node.degree:g}")
    if len(points) <= degree:
        raise Refusal(f"B-spline: degree {degree} needs {degree + 1} or more control points; there are {len(points)}")
    weights = _weights(node.weights, len(points), node.title)
    knots = np.array(node.knots, dtype=np.float64)
    try:
        if node.closed:
            if len(knots) not in (0, len(points) + 1):
                raise Refusal(f"a closed one of {len(points)} control points has {len(points) + 1} knots, those of one "
                              f"turn; there are {len(knots)}")  # fmt: skip
            if not len(knots):
                return closed(points, degree, None, weights)
            return on_domain(closed(points, degree, np.diff(knots), weights), float(knots[0]), float(knots[-1]))
        return Spline(points, degree, knots if len(knots) else clamped_knots(len(points), degree), weights)
    except Refusal as refusal:
        raise Refusal(f"B-spline: {refusal}") from None


def _rows(points: tuple[tuple[Number, ...], ...]) -> NDArray[np.float64]:
    """(n, 2) or (n, 3)."""
    width = len(points[0]) if points else 2
    return np.fromiter(chain.from_iterable(points), np.float64, width * len(points)).reshape(-1, width)


def _weights(weights: tuple[Number, ...], count: int, title: str) -> NDArray[np.float64] | None:
    if not weights:
        return None
    if len(weights) != count:
        raise Refusal(f"{title}: {count} control points need as many weights; there are {len(weights)}")
    found = np.array(weights, dtype=np.float64)
    if (found <= 0.0).any():
        number = int(np.argmax(found <= 0.0))
        raise Refusal(f"{title}: weights are above 0, but that of control point {number} is {found[number]:g}")
    return found


def _ring(segments: list[Any], is_closed: bool) -> curves.Contour:
    """A contour, closed by a line where its ends are apart."""
    begin, end = curves.ends(segments[0])[0], curves.ends(segments[-1])[-1]
    if is_closed and np.abs(begin - end).max() > curves.ROUNDING * max(np.abs(begin).max(), np.abs(end).max()):
        segments = [*segments, np.array([end, begin])]
    return curves.Contour.of_segments(segments, is_closed)


@own_path.register
def path_of_path(node: Path) -> curves.Path:
    points = _rows(node.points)
    splines = iter(node.splines)
    contours: list[curves.Contour] = []
    joints, taken = node.joints, 0
    wrong = set(joints) - set(JOINTS)
    if wrong:
        raise Refusal(f"Path: “{min(wrong)}” is no kind of a node; there are c, s, y and a")
    for run in _runs(node.segments):
        contour, taken = _contour(run, points, taken, splines)
        if contour is None:
            continue
        count = len(contour.nodes)
        if node.joints:
            if len(joints) < count:
                raise Refusal(f"Path: nodes has {len(node.joints)} letters, too few for the nodes that there are")
            kinds = np.array([JOINTS.index(letter) for letter in joints[:count]], np.uint8)
            contour = curves.Contour(contour.points, contour.kinds, contour.closed, contour.splines, kinds)
            joints = joints[count:]
        contours.append(contour)
    if taken < len(points):
        raise Refusal(f"Path: {len(points)} points are more than the {taken} that its segments take")
    if next(splines, None) is not None:
        raise Refusal("Path: there are more B-splines than segments that take them")
    if node.joints and joints:
        raise Refusal(f"Path: nodes has {len(joints)} letters too many")
    return curves.Path(tuple(contours), "evenodd" if node.even_odd else "nonzero")


def _runs(segments: str) -> list[str]:
    """The letters of each contour. Raises Refusal for those that make none."""
    wrong = set(segments) - set("MLQCSlqcs")
    if wrong:
        raise Refusal(f"Path: “{min(wrong)}” is no segment; there are M, L, Q, C, S, and l, q, c, s that close")
    if segments and segments[0] != "M":
        raise Refusal("Path: segments begin with M, where a contour begins")
    runs = segments.split("M")[1:]
    for run in runs:
        if not run[:-1].isupper() and run[:-1]:
            raise Refusal(f"Path: a small letter closes a contour and stands last in it, unlike in “M{run:.40}”")
    return runs


def _contour(run: str, points: NDArray[np.float64], taken: int, splines: Any) -> tuple[curves.Contour | None, int]:
    """The contour of the letters after an M, and how many points are taken then."""
    is_closed = run.islower() or run[-1:].islower()
    kinds = np.array([LETTERS[letter.upper()] for letter in run], np.uint8)
    if not (kinds == curves.Kind.SPLINE).any():
        need = 1 + int(kinds.sum()) - is_closed
        _enough(points, taken + need)
        rows = points[taken : taken + need]
        if is_closed and need:
            rows = np.vstack((rows, rows[:1]))
        return (curves.Contour(rows, kinds, is_closed) if len(kinds) else None), taken + need
    _enough(points, taken + 1)
    here, begin = points[taken], points[taken]
    taken += 1
    segments: list[Any] = []
    for number, letter in enumerate(run):
        kind, last = int(LETTERS[letter.upper()]), number == len(run) - 1
        if kind != curves.Kind.SPLINE:
            need = kind - (is_closed and last)
            _enough(points, taken + need)
            rows = [here, *points[taken : taken + need], *([begin] if need < kind else [])]
            segments.append(np.array(rows))
        else:
            given = next(splines, None)
            if given is None:
                raise Refusal("Path: there are fewer B-splines than segments that take them")
            degree, knots, weights = given
            need = len(knots) - degree - 1
            _enough(points, taken + need)
            segments.append(
                Spline(points[taken : taken + need], degree, np.array(knots), np.array(weights) if weights else None)
            )
        taken += need
        here = curves.ends(segments[-1])[-1]
    return curves.Contour.of_segments(segments, is_closed), taken


def _enough(points: NDArray[np.float64], wanted: int) -> None:
    if wanted > len(points):
        raise Refusal(f"Path: its segments take {wanted} points or more; there are {len(points)}")


def fields_of(path: curves.Path) -> dict[str, Any]:
    """The geometric fields of a Path node that `own_path` makes the path of again."""
    points: list[list[float]] = []
    letters: list[str] = []
    splines: list[Any] = []
    words = {int(kind): letter for letter, kind in LETTERS.items()}
    for contour in path.contours:
        run = [words[kind] for kind in contour.kinds.tolist()]
        if contour.closed:
            run[-1] = run[-1].lower()
        letters += ["M", *run]
        if not contour.splines:
            points += contour.points[: len(contour.points) - contour.closed].tolist()
            continue
        points.append(contour.points[0].tolist())
        for number, segment in enumerate(contour.segments()):
            if isinstance(segment, np.ndarray):
                last = contour.closed and number == len(contour) - 1
                points += segment[1 : len(segment) - last].tolist()
            else:
                points += segment.points.tolist()
                weights = () if segment.weights is None else tuple(segment.weights.tolist())
                splines.append((segment.degree, tuple(segment.knots.tolist()), weights))
    nodes = [contour.nodes for contour in path.contours]
    plain = not any(kinds.any() for kinds in nodes)
    return {
        "points": tuple(map(tuple, points)),
        "segments": "".join(letters),
        "joints": "" if plain else "".join(JOINTS[kind] for kinds in nodes for kind in kinds.tolist()),
        "splines": tuple(splines),
        "even_odd": path.rule == "evenodd",
    }
