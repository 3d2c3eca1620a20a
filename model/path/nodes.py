"""Nodes and their handles: moving them together, and nodes that are cusps, smooth, symmetric or automatic.

The handles of a node are the inner control points of cubics beside it. A line, a quadratic or a spline has a direction
at the node instead, which a smooth node's handle on the other side follows.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ..curve.degree import elevated
from ..document.errors import Refusal
from ..spline.bspline import BSpline
from ..spline.knots import clamped
from .path import Contour, Floats, Kind, Node, Numbers


@dataclass(frozen=True, slots=True, eq=False)
class Handles:
    """Where in a contour's points its nodes have what; -1 where there is nothing."""

    node: Numbers  # (k,)
    before: Numbers  # (k,) the handle on the side of the segment that comes in
    after: Numbers  # (k,)
    previous: Numbers  # (k,) the node before
    following: Numbers  # (k,) the node after
    beside: Numbers  # (k, 2) the points that tell the directions where there is no handle: of line, quadratic


def handles(contour: Contour) -> Handles:
    kinds, starts = contour.kinds, contour.starts
    count = len(contour.nodes)
    node = starts[:count]
    incoming = np.arange(count) - 1
    outgoing = np.where(np.arange(count) < len(kinds), np.arange(count), -1)
    if contour.closed:
        incoming[0] = len(kinds) - 1
    in_kind = np.where(incoming >= 0, kinds[incoming], 255)
    out_kind = np.where(outgoing >= 0, kinds[outgoing], 255)
    in_point = np.where(incoming >= 0, starts[incoming + 1] - 1, -1)
    out_point = np.where(outgoing >= 0, starts[outgoing] + 1, -1)
    beside = np.stack(
        (
            np.where((in_kind == Kind.LINE) | (in_kind == Kind.QUADRATIC), in_point, -1),
            np.where((out_kind == Kind.LINE) | (out_kind == Kind.QUADRATIC), out_point, -1),
        ),
        axis=1,
    )
    return Handles(
        node,
        np.where(in_kind == Kind.CUBIC, in_point, -1),
        np.where(out_kind == Kind.CUBIC, out_point, -1),
        np.where(incoming >= 0, starts[incoming], -1),
        np.where(outgoing >= 0, starts[outgoing + 1], -1),
        beside,
    )


def move(contour: Contour, nodes: ArrayLike, by: ArrayLike) -> Contour:
    """Some nodes moved by (d,), or each by its own row (k, d), with their handles; automatic ones follow.

    The control point of a quadratic goes along where both ends do, halfway between where they would take it.
    Ends of B-splines move with their outermost control points; those that end elsewhere are clamped first.
    """
    chosen = np.atleast_1d(np.asarray(nodes, np.intp))
    count = len(contour.nodes)
    if ((chosen < 0) | (chosen >= count)).any():
        raise Refusal(f"there is no such node; the curve has {count}, counted from 0")
    shift = np.zeros((count, contour.dimension))
    shift[chosen] = by
    found = handles(contour)
    points = contour.points.copy()
    points[found.node] += shift
    for side in (found.before, found.after):
        points[side[side >= 0]] += shift[side >= 0]
    both = between(contour, chosen)
    quadratic = both[contour.kinds[both] == Kind.QUADRATIC]
    points[contour.starts[quadratic] + 1] += 0.5 * (shift[quadratic] + shift[(quadratic + 1) % count])
    if contour.closed:
        points[-1] = points[0]
    moved = replace(contour, points=points, splines=splines_moved(contour, shift))
    return settled(moved, chosen)


def between(contour: Contour, nodes: ArrayLike) -> Numbers:
    """The segments of which both ends are among the nodes."""
    count = len(contour.nodes)
    chosen = np.zeros(count, bool)
    chosen[np.asarray(nodes, np.intp)] = True
    rows = np.arange(len(contour))
    return np.flatnonzero(chosen[rows] & chosen[(rows + 1) % count])


def move_handle(contour: Contour, point: int, to: ArrayLike) -> Contour:
    """A handle, by its row in `points`, put to (d,); the one across turns with it where the node asks for it.

    A node that was automatic becomes smooth. The handle of a smooth node beside a line stays on the line's direction;
    the handles of smooth nodes at both ends of a quadratic follow its control point.
    """
    found = handles(contour)
    points = contour.points.copy()
    if not 0 <= point < len(points) or point in contour.starts:
        raise Refusal(f"point {point} of the curve is no handle")
    target = np.asarray(to, float)
    nodes = contour.nodes.copy()
    for side, across, place in ((found.before, found.after, 1), (found.after, found.before, 0)):
        for number in np.flatnonzero(side == point).tolist():
            nodes[number] = Node.SMOOTH if nodes[number] == Node.AUTO else nodes[number]
            here, other = points[found.node[number]], int(across[number])
            beside = int(found.beside[number, place])
            if nodes[number] == Node.CUSP:
                continue
            if other >= 0:
                arm = here - target
                size = np.linalg.norm(arm)
                if nodes[number] == Node.SMOOTH and size > 0.0:
                    arm *= np.linalg.norm(points[other] - here) / size
                if size > 0.0:
                    points[other] = here + arm
            elif beside >= 0:
                along = here - points[beside]
                if along.any():
                    target = here + max((target - here) @ along / (along @ along), 0.0) * along
    points[point] = target
    moved = replace(contour, points=points, nodes=nodes)
    segment = int(np.searchsorted(contour.starts, point)) - 1
    if contour.kinds[segment] != Kind.QUADRATIC:
        return moved
    return settled(moved, np.array([segment, (segment + 1) % len(nodes)]))


def set_kind(contour: Contour, nodes: ArrayLike, kind: Node) -> Contour:
    """Nodes made cusps, smooth, symmetric or automatic, and their handles accordingly.

    Lines on both sides of a node that is to be no cusp become cubics. Between a line, a quadratic or a spline and a
    cubic the cubic's handle follows the direction of the other.
    """
    chosen = np.zeros(len(contour.nodes), bool)
    numbers = np.atleast_1d(np.asarray(nodes, np.intp))
    if ((numbers < 0) | (numbers >= len(chosen))).any():
        raise Refusal(f"there is no such node; the curve has {len(chosen)}, counted from 0")
    chosen[numbers] = True
    if kind != Node.CUSP:
        contour = _curved(contour, chosen, kind)
    kinds = contour.nodes.copy()
    kinds[chosen] = kind
    changed = replace(contour, nodes=kinds)
    return changed if kind == Node.CUSP else _aligned(changed, chosen)


def _curved(contour: Contour, chosen: np.ndarray, kind: Node) -> Contour:
    """With cubics for the lines beside chosen nodes: where both sides are lines, or the node is to be automatic."""
    line = contour.kinds == Kind.LINE
    count = len(contour.nodes)
    rows = np.flatnonzero(chosen)
    before, after = rows - 1, rows
    if not contour.closed:
        rows = rows[(before >= 0) & (after < len(line))]
        before, after = rows - 1, rows
    before = before % len(line)
    both = np.ones(len(rows), bool) if kind == Node.AUTO else line[before] & line[after]
    bent = np.zeros(len(line), bool)
    bent[before[both]] = bent[after[both]] = True
    bent &= line
    if not bent.any():
        return contour
    segments = [
        elevated(segment, 2) if bend and isinstance(segment, np.ndarray) else segment
        for segment, bend in zip(contour.segments(), bent.tolist(), strict=True)
    ]
    fresh = Contour.of_segments(segments, contour.closed, contour.nodes)
    # Handles on a line say nothing yet of the curve that is wanted: they are laid as automatic ones are.
    return _automatic(fresh, np.isin(np.arange(count), rows[both]))


def settled(contour: Contour, moved: Numbers) -> Contour:
    """Automatic nodes at or beside those moved get new handles; smooth ones follow the lines beside them."""
    count = len(contour.nodes)
    near = np.zeros(count, bool)
    for step in (-1, 0, 1):
        there = moved + step
        near[there % count if contour.closed else there[(there >= 0) & (there < count)]] = True
    contour = _automatic(contour, near & (contour.nodes == Node.AUTO))
    return _aligned(
        contour, near & ((contour.nodes == Node.SMOOTH) | (contour.nodes == Node.SYMMETRIC)), lines_only=True
    )


def _automatic(contour: Contour, chosen: np.ndarray) -> Contour:
    """Handles a third of the way to the neighbours, along the tangent of the parabola that is even by distance."""
    found = handles(contour)
    rows = np.flatnonzero(chosen & (found.previous >= 0) & (found.following >= 0))
    if not len(rows):
        return contour
    points = contour.points.copy()
    here = points[found.node[rows]]
    back, ahead = points[found.previous[rows]] - here, points[found.following[rows]] - here
    behind, front = np.linalg.norm(back, axis=1, keepdims=True), np.linalg.norm(ahead, axis=1, keepdims=True)
    along = ahead * behind / np.where(front > 0.0, front, 1.0) - back * front / np.where(behind > 0.0, behind, 1.0)
    along = _unit(along)
    for side, reach in ((found.before[rows], -behind / 3.0), (found.after[rows], front / 3.0)):
        points[side[side >= 0]] = (here + reach * along)[side >= 0]
    if contour.closed:
        points[-1] = points[0]
    return replace(contour, points=points)


def _aligned(contour: Contour, chosen: np.ndarray, lines_only: bool = False) -> Contour:
    """Handles of smooth and symmetric nodes on one line, keeping their lengths or, symmetric, the mean of these."""
    contour = _automatic(contour, chosen & (contour.nodes == Node.AUTO))
    found = handles(contour)
    points = contour.points.copy()
    here = points[found.node]
    wanted = chosen & ((contour.nodes == Node.SMOOTH) | (contour.nodes == Node.SYMMETRIC))
    arms, splines = _arms(contour, found), _spline_arms(contour)
    sizes = [np.linalg.norm(arm, axis=1, keepdims=True) for arm in arms]
    fixed = [(found.beside[:, i] >= 0) | splines[i][0] for i in range(2)]
    loose = [found.before >= 0, found.after >= 0]
    for i, side in ((0, found.before), (1, found.after)):
        rows = np.flatnonzero(wanted & loose[i] & fixed[1 - i] & (sizes[1 - i][:, 0] > 0.0))
        points[side[rows]] = here[rows] - sizes[i][rows] * _unit(arms[1 - i][rows])
    rows = np.flatnonzero(wanted & loose[0] & loose[1]) if not lines_only else np.zeros(0, np.intp)
    if len(rows):
        along = _unit(_unit(arms[1][rows]) - _unit(arms[0][rows]))
        first, second = sizes[0][rows], sizes[1][rows]
        mean = 0.5 * (first + second)
        even = (contour.nodes[rows] == Node.SYMMETRIC)[:, None]
        points[found.before[rows]] = here[rows] - np.where(even, mean, first) * along
        points[found.after[rows]] = here[rows] + np.where(even, mean, second) * along
    return replace(contour, points=points)


def _unit(vectors: Floats) -> Floats:
    sizes = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(sizes > 0.0, sizes, 1.0)


def _spline_arms(contour: Contour) -> list[tuple[np.ndarray, Floats]]:
    """For both sides of each node, whether a spline lies there and the way to its next control point."""
    count = len(contour.nodes)
    sides = [(np.zeros(count, bool), np.zeros((count, contour.dimension))) for _ in range(2)]
    for segment, spline in zip(np.flatnonzero(contour.kinds == Kind.SPLINE).tolist(), contour.splines, strict=True):
        spline = clamped(spline)
        for side, node, way in (
            (0, (segment + 1) % count, spline.points[-2] - spline.points[-1]),
            (1, segment, spline.points[1] - spline.points[0]),
        ):
            sides[side][0][node], sides[side][1][node] = True, way
    return sides


def splines_moved(contour: Contour, shift: Floats) -> tuple[BSpline, ...]:
    """The splines after their end nodes have moved by rows of `shift`."""
    found = []
    for segment, spline in zip(np.flatnonzero(contour.kinds == Kind.SPLINE).tolist(), contour.splines, strict=True):
        by = shift[segment], shift[(segment + 1) % len(shift)]
        if not (by[0].any() or by[1].any()):
            found.append(spline)
        elif (by[0] == by[1]).all():
            found.append(replace(spline, points=spline.points + by[0]))
        else:
            ended = clamped(spline)
            points = ended.points.copy()
            points[0] += by[0]
            points[-1] += by[1]
            found.append(replace(ended, points=points))
    return tuple(found)


def inferred(contour: Contour, angle: float = 0.5) -> Contour:
    """With nodes smooth where the curve turns by at most `angle` degrees, symmetric where handles are even as well."""
    found = handles(contour)
    arms = _arms(contour, found)
    ways = [_unit(arm) for arm in arms]
    straight = -(ways[0] * ways[1]).sum(axis=1) >= np.cos(np.radians(angle))
    sizes = [np.linalg.norm(arm, axis=1) for arm in arms]
    even = (found.before >= 0) & (found.after >= 0) & (np.abs(sizes[0] - sizes[1]) <= 1e-9 * (sizes[0] + sizes[1]))
    lines = contour.kinds == Kind.LINE
    around = np.roll(lines, 1) if contour.closed else np.append(True, lines)
    curved = ~((lines if contour.closed else np.append(lines, True)) & around)
    kinds = np.where(straight & curved, np.where(even, Node.SYMMETRIC, Node.SMOOTH), Node.CUSP)
    return replace(contour, nodes=kinds)


def _arms(contour: Contour, found: Handles) -> list[Floats]:
    """[(k, d), (k, d)] from each node to its handle, or to what tells the direction, on either side; else 0."""
    here = contour.points[found.node]
    arms = []
    for side, place, (spline, way) in zip((found.before, found.after), (0, 1), _spline_arms(contour), strict=True):
        at = np.where(side >= 0, side, found.beside[:, place])
        arm = np.where((at >= 0)[:, None], contour.points[at] - here, 0.0)
        arms.append(np.where(spline[:, None], way, arm))
    return arms
