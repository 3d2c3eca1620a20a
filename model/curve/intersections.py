"""Where Bezier curves meet: two curves of any degree, a curve and a line, a curve and itself.

Pairs of pieces are halved while their boxes overlap, along the axes and along either chord, all pairs together. Two
pieces whose directions have none in common meet once at most (after Sederberg and Meyers 1988), which Newton's method
finds; where directions stay common the contact is looked for as such: points, tangents and, in osculation, curvatures
agree, a system whose solution is not a multiple one. What two curves share is found first, by Bezout's theorem.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import halves, roots
from .bezier import evaluated, extracted
from .contact import Curve, contacts, crossings, distinct, joined, touching
from .nearest import feet

Floats = NDArray[np.float64]

DEPTH = 44
"""How often pieces are halved at most."""
PATIENCE = 7
"""Halvings before a pair with common directions is tried for a contact."""
AGAIN = 3
"""Halvings between two such trials."""
NARROW = 1e-6
"""Below this width a pair with common directions around a known contact at an end has no other."""
MOST = 4096
"""Pairs that are followed; of more, all are tried as they are."""
LOOPS = 12
"""Halvings of a curve that meets itself, until no piece turns much; at a cusp they would not end."""
LOOP = 1e-8
"""A smaller loop, as a part of the curve's size, is a cusp."""
ROUNDING = 16.0 * float(np.finfo(float).eps)
"""What boxes are widened by, as a part of the size."""
SHARED = 1e-11
"""How near two curves are to each other where they are one, as a part of the box around them."""


@dataclass(frozen=True, slots=True, eq=False)
class Meeting:
    """All that two curves have in common. Rows ascend in the first curve's parameter."""

    first: Floats  # (k,) parameters on the first curve
    second: Floats  # (k,) those on the second
    points: Floats  # (k, d) between the two points of either curve
    tangent: NDArray[np.bool_]  # (k,) whether the curves touch there
    shared: Floats  # (s, 2, 2) ends of the shared parts: [[first, second] at one end, the same at the other]


def intersections(
    first: ArrayLike, second: ArrayLike, weights: tuple[ArrayLike | None, ArrayLike | None] = (None, None)
) -> Meeting:
    """Where two curves (m + 1, d), (n + 1, d) in the plane or in space meet.

    `weights` are those of the two. The points of shared parts are not listed as well.
    """
    a, b = Curve.of(first, weights[0]), Curve.of(second, weights[1])
    size = max(a.size, b.size)
    extent = float(np.ptp(np.concatenate([a.controls, b.controls]), axis=0).max())
    near = SHARED * extent + 8.0 * ROUNDING * size
    shared = _shared(a, b, near)
    if not len(shared):
        return _meeting(a, b, _isolated(a, b, size), shared)
    found = []
    cuts = [np.unique(np.concatenate([[0.0, 1.0], shared[:, :, side].ravel()])) for side in (0, 1)]
    for s0, s1 in zip(cuts[0][:-1], cuts[0][1:], strict=True):
        for t0, t1 in zip(cuts[1][:-1], cuts[1][1:], strict=True):
            pair = np.array([[s0, t0], [s1, t1]])
            one = [part for part in shared if np.array_equal(np.sort(part, 0), pair)]
            if one:  # the part crosses itself where the curve does
                rows = _loops(a.part(s0, s1), size)
                rows[:, :2] = s0 + (s1 - s0) * rows[:, :2]
                low, high = _partners(a, b, rows[:, 0], pair, near)
                if one[0][0, 1] > one[0][1, 1]:
                    low, high = high, low
                found += [
                    np.column_stack([rows[:, 0], high, rows[:, 2]]),
                    np.column_stack([rows[:, 1], low, rows[:, 2]]),
                ]
            else:
                rows = _isolated(a.part(s0, s1), b.part(t0, t1), size)
                rows[:, :2] = pair[0] + (pair[1] - pair[0]) * rows[:, :2]
                found.append(rows)
    rows = distinct(np.concatenate(found))
    for end in shared.reshape(-1, 2):
        rows = rows[np.abs(rows[:, :2] - end).max(-1) > 1e-7]
    return _meeting(a, b, rows, shared)


def self_intersections(controls: ArrayLike, weights: ArrayLike | None = None) -> tuple[Floats, Floats]:
    """The two parameters (k, 2), the lesser first, and the points (k, d) of all places where a curve meets itself.

    The ends of a closed curve are one of them, a cusp is none, nor is a straight curve that turns back on itself.
    """
    curve = Curve.of(controls, weights)
    local = curve.controls - curve.controls[0]
    straight = np.linalg.matrix_rank(local, tol=ROUNDING * curve.size) < 2
    rows = np.zeros((0, 3)) if straight else _loops(curve, curve.size)
    return rows[:, :2], 0.5 * (curve.points(rows[:, 0]) + curve.points(rows[:, 1]))


def with_line(
    controls: ArrayLike, start: ArrayLike, end: ArrayLike, weights: ArrayLike | None = None
) -> tuple[Floats, Floats]:
    """Where a plane curve (n + 1, 2) meets the endless line through two points.

    Its parameters (k,), ascending, and the line's (k,), which are 0 at `start`, 1 at `end`. None where the curve lies
    in the line. Raises ValueError where the two points are one.
    """
    controls, start, end = (np.asarray(value, float) for value in (controls, start, end))
    along = end - start
    if not along.any():
        raise ValueError("a line needs two points")
    away = controls - start
    height = away[:, 1] * along[0] - away[:, 0] * along[1]
    size = max(float(np.abs(away).max()), float(np.abs(along).max()))
    if np.abs(height).max() <= 1e-15 * size * float(np.abs(along).max()):
        return np.zeros(0), np.zeros(0)
    t = roots((height if weights is None else height * np.asarray(weights, float))[None])[1]
    return t, (evaluated(controls, t, weights) - start) @ along / (along @ along)


def _meeting(a: Curve, b: Curve, rows: Floats, shared: Floats) -> Meeting:
    points = 0.5 * (a.points(rows[:, 0]) + b.points(rows[:, 1]))
    return Meeting(rows[:, 0], rows[:, 1], points, rows[:, 2] > 0.0, shared)


def _isolated(a: Curve, b: Curve, size: float) -> Floats:
    """Rows (k, 3) of both parameters and whether the curves touch there; of curves that share no part."""
    tips = _tips(a, b, 8.0 * ROUNDING * size)
    points = [np.ptp(curve.controls, axis=0).max() <= ROUNDING * size for curve in (a, b)]
    if any(points):
        return tips[(tips[:, :2] == 0.0)[:, points].all(-1)]
    return _followed(a, b, size, np.zeros((1, 2)), np.ones((1, 2)), tips)


def _followed(a: Curve, b: Curve, size: float, place: Floats, width: Floats, known: Floats) -> Floats:
    """As `_isolated`, of the pieces of width (k, 2) from place (k, 2) on; `known` rows are part of the answer."""
    slack = ROUNDING * size
    one, two = (extracted(c.above, place[:, i], place[:, i] + width[:, i]) for i, c in enumerate((a, b)))
    crossed, touched = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for depth in range(DEPTH + 1):
        p, q = a.plain(one), b.plain(two)
        near = boxes_meet(p, q, slack)
        one, two, p, q, place, width = one[near], two[near], p[near], q[near], place[near], width[near]
        if not len(place):
            break
        apart = directions_differ(p, q)
        last = depth == DEPTH or len(place) > MOST
        around = np.maximum(place[:, None] - known[:, :2], known[:, :2] - place[:, None] - width[:, None])
        done = ~apart & (width.max(-1) < NARROW) & (around.max(-1) <= 0.0).any(-1)
        centre = place + 0.5 * width
        tried = np.flatnonzero(apart | last)
        rows, inside = crossings(a, b, centre[tried], width[tried], slack)
        crossed.append(rows[inside])
        done[tried[inside]] = True
        if last or (depth >= PATIENCE and (depth - PATIENCE) % AGAIN == 0):
            tried = np.flatnonzero(~apart & ~done)
            rows, inside = contacts(a, b, centre[tried], width[tried], slack)
            touched.append(rows[inside])
            done[tried[inside]] = True
        if last:
            break
        left, right = halved(one[~done])
        lower, upper = halved(two[~done])
        corner, width = place[~done], 0.5 * width[~done]
        one, two = np.concatenate([left, left, right, right]), np.concatenate([lower, upper, lower, upper])
        steps = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]])
        place = (corner + width * steps[:, None]).reshape(-1, 2)
        width = np.tile(width, (4, 1))
    return joined(a, b, distinct(np.concatenate([known, *crossed, *touched])), known, slack)


def _tips(a: Curve, b: Curve, near: float) -> Floats:
    """Rows (k, 3) as of `_isolated` where an end of a curve lies on the other one, within `near` mm."""
    found = []
    for curve, other, side in ((a, b, 1), (b, a, -1)):
        ends = np.array([0.0, 1.0])
        tips = curve.points(ends)
        at, t = feet(other.controls, tips, other.weights)
        at, t = np.concatenate([[0, 0, 1, 1], at]), np.concatenate([[0.0, 1.0, 0.0, 1.0], t])
        on = np.linalg.norm(other.points(t) - tips[at], axis=-1) <= near
        found.append(np.column_stack([ends[at[on]], t[on]])[:, ::side])
    rows = np.concatenate(found)
    return distinct(np.column_stack([rows, touching(a, b, rows).astype(float)]))


def halved(controls: Floats) -> tuple[Floats, Floats]:
    left, right = halves(np.moveaxis(controls, -1, -2))
    return np.moveaxis(left, -2, -1), np.moveaxis(right, -2, -1)


def boxes_meet(p: Floats, q: Floats, slack: float) -> NDArray[np.bool_]:
    """(k,) whether the boxes around pieces (k, ., d) overlap along the axes, and along and across either chord."""
    meet = np.ones(len(p), bool)
    meet &= ((p.min(1) <= q.max(1) + slack) & (q.min(1) <= p.max(1) + slack)).all(-1)
    for chord in (p[:, -1] - p[:, 0], q[:, -1] - q[:, 0]):
        frame = _frames(chord)
        u, v = p @ frame, q @ frame
        meet &= ((u.min(1) <= v.max(1) + slack) & (v.min(1) <= u.max(1) + slack)).all(-1)
    return meet


def _frames(chord: Floats) -> Floats:
    """(k, d, d) orthonormal columns, the first along the chords (k, d); the axes where a chord is 0."""
    axes = chord.shape[-1]
    frame = np.tile(np.eye(axes), (len(chord), 1, 1))
    size = np.linalg.norm(chord, axis=-1, keepdims=True)
    real = size[:, 0] > 0.0
    along = chord[real] / size[real]
    if axes == 2:
        frame[real] = np.stack([along, np.stack([-along[:, 1], along[:, 0]], -1)], -1)
    else:  # the reflection that takes the axis with the least share to the chord's direction, columns in any order
        least = np.eye(axes)[np.abs(along).argmin(-1)]
        second = least - (least * along).sum(-1, keepdims=True) * along
        second /= np.linalg.norm(second, axis=-1, keepdims=True)
        frame[real] = np.stack([along, second, np.cross(along, second)], -1)
    return frame


def _cones(points: Floats) -> tuple[Floats, Floats]:
    """Axis (k, d) and half angle (k,) of a cone with all directions of pieces (k, ., d); pi where there is none.

    The derivative is a positive combination of the steps between control points, for rational curves, too.
    """
    steps = np.diff(points, axis=1)
    size = np.linalg.norm(steps, axis=-1, keepdims=True)
    steps = np.divide(steps, size, out=np.zeros_like(steps), where=size > 0.0)
    chord = points[:, -1] - points[:, 0]
    length = np.linalg.norm(chord, axis=-1, keepdims=True)
    chord = np.divide(chord, length, out=np.zeros_like(chord), where=length > 0.0)
    cosine = np.where(size[..., 0] > 0.0, np.einsum("kid,kd->ki", steps, chord), 1.0)
    across = np.linalg.norm(steps - cosine[..., None] * chord[:, None], axis=-1)
    angle = np.where(size[..., 0] > 0.0, np.arctan2(across, cosine), 0.0).max(-1)
    return chord, np.where(length[:, 0] > 0.0, angle, np.pi)


def directions_differ(p: Floats, q: Floats) -> NDArray[np.bool_]:
    """(k,) whether no direction of one piece is parallel to one of the other: then they meet once at most."""
    (one, wide), (two, broad) = _cones(p), _cones(q)
    cosine = np.abs((one * two).sum(-1))
    across = np.linalg.norm(two - (one * two).sum(-1, keepdims=True) * one, axis=-1)
    return np.arctan2(across, cosine) > wide + broad


def _loops(curve: Curve, size: float) -> Floats:
    """Rows (k, 3) as of `_isolated`, of a curve with itself: simple pieces, each with all later ones."""
    starts, width = np.zeros(1), 1.0
    pieces: list[Floats] = []
    for depth in range(LOOPS + 1):
        simple = _cones(curve.plain(extracted(curve.above, starts, starts + width)))[1] < 0.25 * np.pi
        if depth == LOOPS:
            simple[:] = True
        pieces.append(np.column_stack([starts[simple], np.full(np.count_nonzero(simple), width)]))
        width *= 0.5
        starts = np.concatenate([starts[~simple], starts[~simple] + width])
        if not len(starts):
            break
    every = np.concatenate(pieces)
    every = every[np.argsort(every[:, 0])]
    one, two = np.triu_indices(len(every), 1)
    place, width = (np.column_stack([every[one, i], every[two, i]]) for i in (0, 1))
    tips = _tips(curve, curve, 8.0 * ROUNDING * size)
    joints = np.column_stack([every[:, 0], every[:, 0], np.ones(len(every))])
    rows = _followed(curve, curve, size, place, width, np.concatenate([tips[tips[:, 0] < tips[:, 1]], joints]))
    # A loop leads away from where it is closed; at a cusp neighbours only look like one.
    middle = curve.points(0.5 * (rows[:, 0] + rows[:, 1])) - curve.points(rows[:, 0])
    return rows[np.linalg.norm(middle, axis=-1) > LOOP * size]


def _shared(a: Curve, b: Curve, near: float) -> Floats:
    """(s, 2, 2) ends of the parts that the curves share: each is an end of one of them.

    Two algebraic curves of degrees m and n that meet in more than m n points are one (Bezout).
    """
    ends = _tips(a, b, near)[:, :2]
    count = 2 * (a.degree * b.degree) + 3
    made = []
    for i, low in enumerate(ends):
        for high in ends[i + 1 :]:
            if high[0] - low[0] < 1e-7 or abs(high[1] - low[1]) < 1e-7:
                continue
            t = low[0] + (high[0] - low[0]) * np.linspace(0.0, 1.0, count + 2)[1:-1]
            least, most = _partners(a, b, t, np.sort(np.array([low, high]), 0), near)
            one = most - least < 1e-9  # two where the curve crosses itself, nan where there is none
            along = np.diff(least[one]) * np.sign(high[1] - low[1])
            if np.isfinite(least).all() and (along > 0.0).all():
                made.append(np.array([low, high]))
                break
    return np.array(made).reshape(-1, 2, 2)


def _partners(a: Curve, b: Curve, t: Floats, span: Floats, near: float) -> tuple[Floats, Floats]:
    """(k,) the least and the greatest parameter within span (2, 2) at which b has the points of a at t (k,), or nan."""
    points = a.points(t)
    at, u = feet(b.controls, points, b.weights)
    on = np.linalg.norm(b.points(u) - points[at], axis=-1) <= near
    on &= (u >= span[0, 1] - 1e-9) & (u <= span[1, 1] + 1e-9)
    least, most = np.full(len(t), np.inf), np.full(len(t), -np.inf)
    np.minimum.at(least, at[on], u[on])
    np.maximum.at(most, at[on], u[on])
    return np.where(np.isinf(least), np.nan, least), np.where(np.isinf(most), np.nan, most)
