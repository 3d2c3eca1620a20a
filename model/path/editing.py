"""Editing contours: nodes in and out, breaking, joining, closing, and what kind a segment is.

A contour comes in, another goes out; what an operation does not touch stays as it was. Nodes and segments are numbered
from 0 along the contour; segment i goes from node i to the next.
"""

from __future__ import annotations

from math import ceil, sqrt

import numpy as np
from numpy.typing import ArrayLike

from ..curve.bezier import derivatives, evaluated, split
from ..curve.degree import elevated
from ..document.errors import Refusal
from ..spline.knots import split as cut
from .fitting import fitted
from .path import Contour, Floats, Kind, Node, Segment, ends
from .pieces import Pieces, pieces_of

SAMPLES = 64
"""Points of each piece that a refit looks at."""
MOST_CUBICS = 1024
"""How many cubics one piece of a B-spline becomes at most."""


def insert(contour: Contour, segment: int, parameter: float) -> Contour:
    """Another node on a segment at its parameter in (0, 1); the curve stays as it is.

    The node is smooth on curves, a cusp on lines; nodes at the ends of the segment that were symmetric or automatic
    become smooth, for their handles get shorter.
    """
    _segment(contour, segment)
    if not 0.0 < parameter < 1.0:
        raise Refusal(f"a node goes between the ends of a segment: at more than 0, less than 1, not {parameter:g}")
    segments = contour.segments()
    old = segments[segment]
    if isinstance(old, np.ndarray):
        parts: list[Segment] = list(split(old, parameter))
    else:
        parts = list(cut(old, (1.0 - parameter) * old.domain[0] + parameter * old.domain[1]))
    nodes = contour.nodes.copy()
    if contour.kinds[segment] != Kind.LINE:
        for end in (segment, (segment + 1) % len(nodes)):
            nodes[end] = min(nodes[end], Node.SMOOTH)
    fresh = Node.CUSP if contour.kinds[segment] == Kind.LINE else Node.SMOOTH
    nodes = np.insert(nodes, segment + 1, fresh)
    return Contour.of_segments([*segments[:segment], *parts, *segments[segment + 1 :]], contour.closed, nodes)


def delete(contour: Contour, nodes: ArrayLike, refit: bool = True) -> Contour | None:
    """Without some nodes; None where fewer than two are left.

    Where nodes between two others go, one segment comes in place of those between: a line where all were lines, else
    the cubic of least squares through what was there, with the tangents of the two nodes, or, unless `refit`, a cubic
    with their outer handles. The end of an open contour goes with its segment.
    """
    count = len(contour.nodes)
    gone = np.zeros(count, bool)
    gone[_nodes(contour, nodes)] = True
    kept = np.flatnonzero(~gone)
    if len(kept) < 2:
        return None
    if not gone.any():
        return contour
    segments = contour.segments()
    turned = segments * 2  # a run over the seam of a closed contour
    followers = np.append(kept[1:], kept[0] + count) if contour.closed else kept[1:]
    found: list[Segment] = []
    for first, last in zip(kept[: len(followers)].tolist(), followers.tolist(), strict=True):
        run = turned[first:last]
        found.append(run[0] if len(run) == 1 else _one(run, refit))
    kinds = contour.nodes[kept].copy()
    beside = np.array([first + 1 < last for first, last in zip(kept[: len(followers)], followers, strict=True)])
    touched = beside | np.roll(beside, 1) if contour.closed else np.append(beside, False) | np.append(False, beside)
    kinds[touched] = np.minimum(kinds[touched], Node.SMOOTH)
    return Contour.of_segments(found, contour.closed, kinds)


def _one(run: list[Segment], refit: bool) -> Floats:
    """The one line or cubic (2 or 4, d) in place of several segments."""
    if all(isinstance(segment, np.ndarray) and len(segment) == 2 for segment in run):
        return np.stack((ends(run[0])[0], ends(run[-1])[1]))
    sampled, first, last = _sampled(run)
    if not refit:
        before, after = run[0], run[-1]
        if isinstance(before, np.ndarray) and isinstance(after, np.ndarray):
            return np.stack((before[0], _cubic(before)[1], _cubic(after)[2], after[-1]))
    return fitted(sampled[None], first[None], -last[None], 0.0)[0][0]


def _sampled(run: list[Segment]) -> tuple[Floats, Floats, Floats]:
    """Points (n, d) along segments that hang together, and the unit tangents where they begin and end."""
    groups = pieces_of([Contour.of_segments(run)])
    count = max(int(group.place.max()) for group in groups) + 1
    t = np.linspace(0.0, 1.0, SAMPLES + 1)
    points = np.empty((count, len(t), groups[0].controls.shape[2]))
    speeds = np.empty_like(points)
    for group in groups:
        points[group.place], speeds[group.place] = derivatives(group.controls, t, 1, group.weights)
    flat = np.vstack((points[:, :-1].reshape(-1, points.shape[2]), points[-1:, -1]))
    return flat, _unit(speeds[0]), _unit(speeds[-1][::-1])


def _unit(speeds: Floats) -> Floats:
    """The direction of the first of derivatives (k, d) that is not nought: handles may lie on their nodes."""
    sizes = np.linalg.norm(speeds, axis=1)
    row = int(np.argmax(sizes > 1e-9 * sizes.max())) if sizes.max() > 0.0 else 0
    return speeds[row] / max(sizes[row], 1e-300)


def break_at(contour: Contour, node: int) -> tuple[Contour, ...]:
    """A closed contour opened at a node, or an open one as the two parts before and after it."""
    _nodes(contour, node)
    segments, nodes = contour.segments(), contour.nodes
    if contour.closed:
        turned = np.roll(nodes, -node)
        turned = np.append(turned, turned[0])
        turned[[0, -1]] = Node.CUSP
        return (Contour.of_segments(segments[node:] + segments[:node], False, turned),)
    if node in (0, len(segments)):
        raise Refusal("an open curve ends at this node already")
    before, after = nodes[: node + 1].copy(), nodes[node:].copy()
    before[-1] = after[0] = Node.CUSP
    return Contour.of_segments(segments[:node], False, before), Contour.of_segments(segments[node:], False, after)


def join(first: Contour, second: Contour, merge: bool = False) -> Contour:
    """The end of one open contour and the beginning of another: by a line, or `merge`d into one node midway."""
    if first.closed or second.closed:
        raise Refusal("a closed curve has no end that could be joined: break it first")
    if first.dimension != second.dimension:
        raise Refusal("a curve in the plane and one in space cannot be joined")
    end, begin = first.points[-1], second.points[0]
    same = bool((end == begin).all())
    if not (merge or same):
        nodes = np.concatenate((first.nodes, second.nodes))
        return Contour.of_segments([*first.segments(), np.stack((end, begin)), *second.segments()], False, nodes)
    middle = 0.5 * (end + begin)
    before, after = _ended(first, -1, middle).segments(), _ended(second, 0, middle).segments()
    nodes = np.concatenate((first.nodes[:-1], [Node.CUSP], second.nodes[1:]))
    return Contour.of_segments(before + after, False, nodes)


def close(contour: Contour, merge: bool = False) -> Contour:
    """An open contour closed: by a line, or with its ends `merge`d into one node midway."""
    if contour.closed:
        raise Refusal("this curve is closed already")
    begin, end = contour.points[0], contour.points[-1]
    same = bool((end == begin).all())
    if not (merge or same):
        return Contour.of_segments([*contour.segments(), np.stack((end, begin))], True, contour.nodes)
    if len(contour) == 1 and contour.kinds[0] == Kind.LINE:
        raise Refusal("a single line cannot be closed")
    middle = 0.5 * (end + begin)
    moved = _ended(_ended(contour, 0, middle), -1, middle)
    nodes = contour.nodes[:-1].copy()
    nodes[0] = Node.CUSP
    return Contour.of_segments(moved.segments(), True, nodes)


def _ended(contour: Contour, row: int, place: Floats) -> Contour:
    """With the first (0) or last (-1) node moved, its handle with it."""
    from .nodes import move

    number = 0 if row == 0 else len(contour.nodes) - 1
    return move(contour, number, place - contour.points[row])


def convert(contour: Contour, segments: ArrayLike, kind: Kind, tolerance: float | None = None) -> tuple[Contour, float]:
    """One or more segments as another kind, and how far, in mm, the curve has moved at most.

    To a line, its chord; to a higher degree exactly; a cubic to one quadratic, or to as many as keep `tolerance` mm
    (Sederberg and Farouki's bound of √3/36 |Δ³|); a spline to the cubics that keep it.
    """
    chosen = set(np.atleast_1d(np.asarray(segments, np.intp)).tolist())
    for number in chosen:
        _segment(contour, number)
    if kind not in (Kind.LINE, Kind.QUADRATIC, Kind.CUBIC):
        raise Refusal("a segment can become a line, a quadratic or a cubic")
    count = len(contour.nodes)
    kinds = contour.nodes.tolist()
    found: list[Segment] = []
    nodes: list[int] = []
    worst = 0.0
    for number, old in enumerate(contour.segments()):
        nodes.append(kinds[number])
        if number not in chosen:
            found.append(old)
            continue
        parts, off = _converted(old, Kind(kind), tolerance)
        found += parts
        nodes += [Node.SMOOTH] * (len(parts) - 1)
        worst = max(worst, off)
    nodes += kinds[len(contour) :]
    if kind == Kind.LINE:  # then no parts are made, and nodes keep their numbers
        for number in chosen:
            for end in (number, (number + 1) % count):
                nodes[end] = min(nodes[end], Node.SMOOTH)
    return Contour.of_segments(found, contour.closed, nodes), worst


def _converted(old: Segment, kind: Kind, tolerance: float | None) -> tuple[list[Floats], float]:
    if kind == Kind.LINE:
        (group,) = pieces_of([Contour.of_segments([old])])
        return [ends(old)], _off_chord(group, *ends(old))
    if isinstance(old, np.ndarray):
        if len(old) <= kind + 1:
            return [elevated(old, kind + 1 - len(old))], 0.0
        return _quadratics(old, tolerance)
    cubics, off = _cubics(old, tolerance)
    if kind == Kind.CUBIC:
        return cubics, off
    found = [_quadratics(cubic, tolerance) for cubic in cubics]
    return [part for parts, _ in found for part in parts], off + max(moved for _, moved in found)


def _quadratics(cubic: Floats, tolerance: float | None) -> tuple[list[Floats], float]:
    third = float(np.linalg.norm(np.diff(cubic, 3, axis=0)))
    off = sqrt(3.0) / 36.0 * third
    count = 1 if tolerance is None else max(ceil((off / tolerance) ** (1.0 / 3.0)), 1)
    found = []
    for number in range(count):
        part = cubic
        if number < count - 1:
            part, cubic = split(cubic, 1.0 / (count - number))
        found.append(np.stack((part[0], 0.25 * (3.0 * (part[1] + part[2]) - part[0] - part[3]), part[3])))
    return found, off / count**3


def _cubics(spline: Segment, tolerance: float | None) -> tuple[list[Floats], float]:
    (group,) = pieces_of([Contour.of_segments([spline])])
    if group.weights is None and group.degree <= Kind.CUBIC:
        return [_cubic(curve) for curve in group.controls], 0.0
    size = float(np.ptp(group.controls, axis=(0, 1)).max())
    found, worst = [], 0.0
    for row, controls in enumerate(group.controls):
        weights = None if group.weights is None else group.weights[row]
        cubics, off = _hermite(controls, weights, tolerance or 1e-6 * size)
        found += list(cubics)
        worst = max(worst, off)
    return found, worst


def _hermite(controls: Floats, weights: Floats | None, tolerance: float) -> tuple[Floats, float]:
    """(k, 4, d) cubics with the points and derivatives of one curve at even parameters, and how far it is from them.

    The distance is that at equal parameters, which is never less than the true one; it falls with the fourth power of
    the number of cubics (de Boor, A Practical Guide to Splines, 1978, chapter IV).
    """
    count = 1
    within = np.arange(1, 16) / 16.0
    while True:
        points, speeds = derivatives(controls, np.linspace(0.0, 1.0, count + 1), 1, weights)
        arms = speeds / (3.0 * count)
        cubics = np.stack((points[:-1], points[:-1] + arms[:-1], points[1:] - arms[1:], points[1:]), axis=1)
        true = evaluated(controls, ((np.arange(count)[:, None] + within) / count).ravel(), weights)
        off = float(np.linalg.norm(evaluated(cubics, within).reshape(true.shape) - true, axis=1).max())
        if off <= tolerance or count >= MOST_CUBICS:
            return cubics, off
        count *= 2


def _cubic(curve: Floats) -> Floats:
    return elevated(curve, 4 - len(curve))


def _off_chord(group: Pieces, begin: Floats, end: Floats) -> float:
    t = np.linspace(0.0, 1.0, SAMPLES + 1)
    points = evaluated(group.controls, t, group.weights)
    chord = end - begin
    share = np.clip((points - begin) @ chord / max(chord @ chord, 1e-300), 0.0, 1.0)
    return float(np.linalg.norm(points - begin - share[..., None] * chord, axis=-1).max())


def _segment(contour: Contour, number: int) -> None:
    if not 0 <= number < len(contour):
        raise Refusal(f"there is no segment {number}; the curve has {len(contour)}, counted from 0")


def _nodes(contour: Contour, numbers: ArrayLike) -> np.ndarray:
    found = np.atleast_1d(np.asarray(numbers, np.intp))
    if ((found < 0) | (found >= len(contour.nodes))).any():
        raise Refusal(f"there is no such node; the curve has {len(contour.nodes)}, counted from 0")
    return found
