"""Filled areas joined, cut and shared, with outlines that stay curves: each segment is a part of one that was given.

All contours are cut where they meet (arrangement.py), winding numbers tell what lies on both sides of each edge
(winding.py), and the edges between inside and outside are chained. manifold3d does the same with polygons: should the
edges not close, or the areas differ, cubics are fitted to its polygons.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import atan2

import numpy as np
from manifold3d import CrossSection, OpType
from numpy.typing import NDArray

from ...curve.bezier import evaluated, extracted
from ...document.errors import Refusal
from ...spline.knots import extracted as part_of_spline
from ..flatten import flatten
from ..path import Contour, Floats, Node, Numbers, Path, Segment
from .arrangement import Arrangement, arranged
from .meetings import TooMany, plain
from .offsetting import FILL, check_near, through
from .winding import windings

KINDS = ("union", "difference", "intersection", "exclusion")
NEAR = (1e-11, 1e-8)
"""As parts of the size: how near two points are that are one; the second where the first does not close."""
TOLERANCE = 1e-4
"""Of the size: that of fitted cubics, where none is given."""
FINE = 0.1
"""Of the tolerance: that of the polygons that the result is compared with."""

COMMON = 1e-3
"""Radians: tangents that differ by less do not tell which edge of a vertex comes next."""


def combined(kind: str, paths: Sequence[Path], tolerance: float | None = None) -> Path:
    """What closed paths in the plane fill, each by its own rule, as one path that fills by "nonzero".

    `kind` is "union", "difference" (the first less the others), "intersection", or "exclusion" (what an odd number of
    them fills). Outer contours run counter-clockwise, holes clockwise, and none crosses or overlaps another. Segments
    keep their kind, B-splines are cut into B-splines; whole segments are as they were. New ends lie within 1e-10 of
    the size of where the curves meet. `tolerance` mm is for the case that this fails: then the result is cubics along
    polygons that fine, a ten-thousandth of the size by default. Raises Refusal for open contours and contours in space.
    """
    if kind not in KINDS:
        raise Refusal(f"outlines are combined as {', '.join(KINDS)}, not “{kind!s:.40}”")
    for path in paths:
        check_filled(path)
    paths = list(paths)
    check_near(paths)
    given = [contour for path in paths for contour in path.contours]
    if not given:
        return Path(())
    box = Path(tuple(given)).bounds()
    size = float(np.ptp(box, axis=0).max())
    if not size > 0.0:
        return Path(())
    tolerance = TOLERANCE * size if tolerance is None else tolerance
    fine = FINE * tolerance
    region = _region(kind, paths, fine)
    for near in NEAR:
        path = _exact(kind, paths, given, max(near * size, 4e-16 * float(np.abs(box).max())))
        if path is not None and abs(path.area() - region.area()) <= 2.0 * fine * sum(c.length() for c in given):
            return path
    return through(region, tolerance)


def check_filled(path: Path) -> None:
    """Raises Refusal for a path that fills nothing in its plane: with open contours, or contours in space."""
    for contour in path.contours:
        if contour.dimension != 2:
            raise Refusal("a curve that leaves its plane has no inside: only flat outlines are combined")
        if not contour.closed:
            place = ", ".join(f"{number:g}" for number in contour.points[-1])
            raise Refusal(f"an open curve has no inside, this one ends at ({place}): close it first")


def _region(kind: str, paths: list[Path], fine: float) -> CrossSection:
    sections = [
        CrossSection([np.ascontiguousarray(points) for points in flatten(path, fine)], FILL[path.rule])
        for path in paths
    ]
    if kind == "exclusion":
        found = sections[0]
        for section in sections[1:]:
            found = (found - section) + (section - found)
        return found
    types = {"union": OpType.Add, "difference": OpType.Subtract, "intersection": OpType.Intersect}
    return CrossSection.batch_boolean(sections, types[kind])


def _exact(kind: str, paths: list[Path], given: list[Contour], near: float) -> Path | None:
    """The combination of whole edges; None where they do not close."""
    try:
        found = arranged([path.contours for path in paths], near)
    except TooMany:
        return None
    left, right = _inside(kind, paths, found)
    rows = np.flatnonzero(left != right)
    forth = left[rows]  # what is filled is to be on the left
    ends = np.where(forth[:, None], found.ends[rows], found.ends[rows, ::-1])
    if (
        np.bincount(ends[:, 0], minlength=len(found.vertices)) != np.bincount(ends[:, 1], minlength=len(found.vertices))
    ).any():
        return None
    loops = _loops(found, rows, forth, ends)
    origin = _Origin(given)
    contours = [origin.contour(found, rows[loop], forth[loop], near) for loop in loops]
    kept = [(first, contour) for first, contour in contours if _is_wide(contour, near)]
    kept.sort(key=lambda pair: pair[0])
    return Path(tuple(contour for _, contour in kept))


def _is_wide(contour: Contour, near: float) -> bool:
    return abs(contour.area()) > near * contour.length()


def _inside(kind: str, paths: list[Path], found: Arrangement) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether the combination fills the left and the right of each edge."""
    rows = windings(found)
    odd = np.array([path.rule == "evenodd" for path in paths])[rows[:, 1]]
    count = len(found.ends)
    sides = []
    for side in (2, 3):
        filled = np.where(odd, rows[:, side] % 2 != 0, rows[:, side] != 0)
        if kind == "difference":
            base = np.bincount(rows[filled & (rows[:, 1] == 0), 0], minlength=count) > 0
            sides.append(base & (np.bincount(rows[filled & (rows[:, 1] != 0), 0], minlength=count) == 0))
            continue
        times = np.bincount(rows[filled, 0], minlength=count)
        sides.append({"union": times > 0, "intersection": times == len(paths), "exclusion": times % 2 == 1}[kind])
    return sides[0], sides[1]


def _loops(found: Arrangement, rows: Numbers, forth: NDArray[np.bool_], ends: Numbers) -> list[list[int]]:
    """The directed edges as closed rounds, each as places in `rows`, none of which comes to a vertex twice."""
    out: dict[int, list[int]] = {}
    for place, vertex in enumerate(ends[:, 0].tolist()):
        out.setdefault(vertex, []).append(place)
    following = np.empty(len(rows), np.intp)
    for place, vertex in enumerate(ends[:, 1].tolist()):
        if len(out[vertex]) == 1:
            following[place] = out[vertex][0]
    for vertex, leaving in out.items():
        if len(leaving) > 1:
            coming = np.flatnonzero(ends[:, 1] == vertex).tolist()
            _turned(found, rows, forth, vertex, coming, leaving, following)
    loops: list[list[int]] = []
    used = np.zeros(len(rows), bool)
    starts = ends[:, 0].tolist()
    for place in range(len(rows)):
        walk: list[int] = []
        seen: dict[int, int] = {}
        while not used[place]:
            used[place] = True
            if starts[place] in seen:  # a round within the round
                cut = seen[starts[place]]
                loops.append(walk[cut:])
                for gone in walk[cut:]:
                    del seen[starts[gone]]
                walk = walk[:cut]
            seen[starts[place]] = len(walk)
            walk.append(place)
            place = int(following[place])
        if walk:
            loops.append(walk)
    return loops


def _turned(
    found: Arrangement,
    rows: Numbers,
    forth: NDArray[np.bool_],
    vertex: int,
    coming: list[int],
    leaving: list[int],
    following: Numbers,
) -> None:
    """After each edge that comes to a vertex the one to its left-hand side: areas that touch there stay two."""
    curves = [found.lifted[rows[place]] for place in (*coming, *leaving)]
    curves = [
        curve[::-1] if bool(forth[place]) is arrives else curve
        for curve, place, arrives in zip(
            curves, (*coming, *leaving), (*(True for _ in coming), *(False for _ in leaving)), strict=True
        )
    ]
    angles = np.array([_tangent(curve, found.vertices[vertex]) for curve in curves])
    between = np.diff(np.sort(angles), append=angles.min() + 2.0 * np.pi)
    if between.min() < COMMON:
        radius = 0.05 * min(float(np.ptp(plain(curve), axis=0).max()) for curve in curves)
        angles = np.array([_direction(curve, found.vertices[vertex], radius) for curve in curves])
    ways, free = angles[: len(coming)], angles[len(coming) :]
    turns = (ways[:, None] - free) % (2.0 * np.pi)  # clockwise from where it came
    for _ in coming:
        i, j = np.unravel_index(np.argmin(turns), turns.shape)
        following[coming[int(i)]] = leaving[int(j)]
        turns[i], turns[:, j] = np.inf, np.inf


def _tangent(curve: Floats, place: Floats) -> float:
    """The angle at which a curve begins."""
    ways = plain(curve)[1:] - place
    sizes = np.abs(ways).max(axis=1)
    x, y = ways[int(np.argmax(sizes > 1e-6 * sizes.max()))].tolist()
    return atan2(y, x)


def _direction(curve: Floats, place: Floats, radius: float) -> float:
    """The angle at which a curve from `place` on first is `radius` mm away: tangents may be common."""
    t = np.linspace(0.0, 1.0, 65)
    away = np.linalg.norm(plain(evaluated(curve, t)) - place, axis=1)
    last = max(int(np.argmax(away > radius)), 1)
    low, high = t[last - 1], t[last]
    for _ in range(40):
        middle = 0.5 * (low + high)
        if np.linalg.norm(plain(evaluated(curve, middle)) - place) > radius:
            high = middle
        else:
            low = middle
    way = plain(evaluated(curve, high)) - place
    return atan2(*way[::-1].tolist())


class _Origin:
    """The segments that edges are parts of, by their numbers."""

    def __init__(self, contours: list[Contour]) -> None:
        self._segments: list[Segment] = [segment for contour in contours for segment in contour.segments()]
        counts = [len(contour) for contour in contours]
        self._contour = np.repeat(np.arange(len(contours)), counts)
        self._first = np.cumsum(counts) - np.array(counts)
        self._counts = counts
        self._nodes = np.concatenate([contour.nodes for contour in contours])

    def contour(self, found: Arrangement, edges: Numbers, forth: NDArray[np.bool_], near: float) -> tuple[int, Contour]:
        """A round of edges as a contour, and the number of the first segment in it."""
        span = np.where(forth[:, None], found.span[edges], found.span[edges, ::-1])
        ends = found.vertices[np.where(forth, found.ends[edges, 0], found.ends[edges, 1])]
        segment = found.segment[edges]
        on = np.append(segment[1:] == segment[:-1], segment[0] == segment[-1])
        on &= np.append(span[1:, 0], span[0, 0]) == span[:, 1]
        first = np.flatnonzero(~np.roll(on, 1))  # where another segment begins
        if not len(first):  # all of one closed segment
            first = np.array([0])
        whole = np.minimum(span[first, 0], 1.0 - span[first, 0]) == 0.0
        order = first[whole] if whole.any() else first
        begin = int(order[np.argmin(segment[order])])
        order = np.roll(np.arange(len(edges)), -begin)
        first = np.sort((first - begin) % len(edges))
        last = np.append(first[1:], len(edges)) - 1
        runs = [
            (int(segment[order[i]]), float(span[order[i], 0]), float(span[order[j], 1]), ends[order[i]])
            for i, j in zip(first.tolist(), last.tolist(), strict=True)
        ]
        return int(segment.min()), self._chained(runs, near)

    def _chained(self, runs: list[tuple[int, float, float, Floats]], near: float) -> Contour:
        places = np.array([place for _, _, _, place in runs])
        segments = [
            self._part(number, start, end, places[row], places[(row + 1) % len(runs)])
            for row, (number, start, end, _) in enumerate(runs)
        ]
        nodes = [self._node(runs[row - 1], runs[row]) for row in range(len(runs))]
        row = 0
        while row < len(segments) and len(segments) > 2:  # lines of two outlines that go on straight
            before, here = segments[row - 1], segments[row]
            if nodes[row] is None and _goes_on(before, here, near):
                segments[row - 1] = np.stack((before[0], here[-1]))  # type: ignore[index]
                del segments[row], nodes[row]
            else:
                row += 1
        kinds = [Node.CUSP if node is None else node for node in nodes]
        return Contour.of_segments(segments, True, np.array(kinds, np.uint8))

    def _part(self, number: int, start: float, end: float, begin: Floats, stop: Floats) -> Segment:
        segment = self._segments[number]
        held = np.stack((begin, stop))
        if isinstance(segment, np.ndarray):
            whole = segment if (start, end) == (0.0, 1.0) else segment[::-1] if (start, end) == (1.0, 0.0) else None
            part = extracted(segment, start, end) if whole is None else whole.copy()
            part[[0, -1]] = held
            return part
        if (start, end) in ((0.0, 1.0), (1.0, 0.0)):
            return segment if start < end else segment.reversed()
        low, high = segment.domain
        cut = part_of_spline(segment, *(low + (high - low) * np.array([start, end])).tolist())
        return replace(cut, points=np.concatenate((held[:1], cut.points[1:-1], held[1:])))

    def _node(self, before: tuple[int, float, float, Floats], after: tuple[int, float, float, Floats]) -> Node | None:
        """The kind of the node between two runs; None where none was."""
        if before[2] not in (0.0, 1.0) or after[1] != 1.0 - before[2]:
            return None
        contour = int(self._contour[before[0]])
        count, first = self._counts[contour], int(self._first[contour])
        step = 1 if before[2] == 1.0 else -1
        if self._contour[after[0]] != contour or (before[0] - first + step) % count != after[0] - first:
            return None
        kind = Node(int(self._nodes[after[0] if step == 1 else before[0]]))
        trimmed = before[1] != 1.0 - before[2] or after[2] != 1.0 - after[1]
        return Node.SMOOTH if trimmed and kind > Node.SMOOTH else kind


def _goes_on(before: Segment, here: Segment, near: float) -> bool:
    if not (isinstance(before, np.ndarray) and isinstance(here, np.ndarray) and len(before) == len(here) == 2):
        return False
    chord, way = here[1] - before[0], here[0] - before[0]
    size = float(chord @ chord)
    off = abs(chord[0] * way[1] - chord[1] * way[0])
    return 0.0 < chord @ way < size and off <= 4.0 * near * np.sqrt(size)
