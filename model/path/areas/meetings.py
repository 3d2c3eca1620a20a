"""Where many Bezier curves of one degree meet each other and themselves, all pairs together.

Pairs of pieces whose hulls overlap are halved until no direction of one is one of the other: then they cross once at
most, and Newton's method finds it. Pairs of curves that touch, or share a part, are left to curve/intersections.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...curve.bezier import derivatives, evaluated, extracted, polynomial, projected
from ...curve.intersections import boxes_meet, directions_differ, halved, intersections, self_intersections
from ..path import Floats, Numbers

FIRST = 4
"""Pieces of each curve that the first search by boxes takes."""
PATIENCE = 7, 11
"""Halvings after which curves that may have common directions are told to share a part, if many pieces of them are
near each other, or to touch."""
MANY = 16
MOST = 200
"""Pairs that are looked at one by one; each takes a tenth of a second."""
CROWD = 60_000
"""Pairs of pieces near each other that are followed at a time."""
DEPTH = 26
"""Halvings after which those that only cross, and that Newton's method did not find, are looked at by themselves."""
STEPS = 8
BEYOND = 1e-9
"""How far beyond the end of a curve, in its parameter, a crossing still counts as one at the end."""


class TooMany(Exception):
    """More curves touch, or share parts, than can be looked at one by one."""


def meetings(lifted: Floats, straight: NDArray[np.bool_], near: float) -> tuple[Numbers, Floats]:
    """Curves (k, 2) that meet, and the parameters (k, 2) on either; ends that several share are left out.

    `lifted` (n, degree + 1, 2), or (., ., 3) homogeneous, are the curves; `straight` tells which of them are lines. Of
    shared parts the ends are given. A curve with itself is there as well. Points nearer than `near` mm are one. Raises
    TooMany.
    """
    first, second, place, width = _candidates(lifted, straight, near)
    both = straight[first] & straight[second]
    one = np.unique(np.column_stack((first[both], second[both])), axis=0)
    found = [_of_lines(lifted, one, near), _of_equal(lifted, straight, first, second, near), _loops(lifted, straight)]
    same = _keys(found[1][0], len(lifted))
    left = ~both & ~np.isin(_keys(np.column_stack((first, second)), len(lifted)), same)
    pairs, parameters, hard = _crossings(lifted, first[left], second[left], place[left], width[left], near)
    found.append((pairs, parameters))
    if len(hard) > MOST:
        raise TooMany
    found += [_alone(lifted, int(i), int(j)) for i, j in hard]
    return np.concatenate([rows for rows, _ in found]), np.concatenate([rows for _, rows in found])


def plain(lifted: Floats) -> Floats:
    """Points (..., 2) of homogeneous ones (..., 3), or of plain ones."""
    return lifted if lifted.shape[-1] == 2 else projected(lifted)[0]


def _keys(pairs: Numbers, count: int) -> Numbers:
    return pairs[:, 0] * count + pairs[:, 1]


def overlapping(low: Floats, high: Floats) -> tuple[Numbers, Numbers]:
    """(k,), (k,) all pairs of boxes (n, 2) that overlap, each once, by a sweep along x."""
    order = np.argsort(low[:, 0], kind="stable")
    reach = np.searchsorted(low[order, 0], high[order, 0], "right")
    sizes = reach - np.arange(len(order)) - 1
    found: list[tuple[Numbers, Numbers]] = [(np.zeros(0, np.intp), np.zeros(0, np.intp))]
    blocks = np.searchsorted(np.cumsum(sizes), np.arange(0, sizes.sum() + 1, 2_000_000)[1:])
    for rows in np.split(np.arange(len(order)), blocks):
        one = np.repeat(rows, sizes[rows])
        two = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(sizes[rows]) - sizes[rows], sizes[rows])
        i, j = order[one], order[two]
        meet = (low[i, 1] <= high[j, 1]) & (low[j, 1] <= high[i, 1])
        found.append((i[meet], j[meet]))
    return np.concatenate([i for i, _ in found]), np.concatenate([j for _, j in found])


def _candidates(lifted: Floats, straight: NDArray[np.bool_], near: float) -> tuple[Numbers, Numbers, Floats, Floats]:
    """Curves first < second, and where on them pieces whose hulls overlap begin (k, 2), and their widths (k, 2)."""
    count = np.where(straight, 1, FIRST)
    curve = np.repeat(np.arange(len(lifted)), count)
    width = 1.0 / count[curve]
    begin = (np.arange(len(curve)) - np.repeat(np.cumsum(count) - count, count)) * width
    hull = plain(extracted(lifted[curve], begin, begin + width))
    i, j = overlapping(hull.min(axis=1) - near, hull.max(axis=1) + near)
    apart = curve[i] != curve[j]
    i, j = i[apart], j[apart]
    i, j = np.where(curve[i] < curve[j], i, j), np.where(curve[i] < curve[j], j, i)
    meet = boxes_meet(hull[i], hull[j], near)
    i, j = i[meet], j[meet]
    return curve[i], curve[j], np.column_stack((begin[i], begin[j])), np.column_stack((width[i], width[j]))


def _of_lines(lifted: Floats, pairs: Numbers, near: float) -> tuple[Numbers, Floats]:
    """Where lines cross, and which of their ends lie on the other one."""
    points = plain(lifted)[:, [0, -1]]
    a, b = points[pairs[:, 0]], points[pairs[:, 1]]
    u, v, gap = a[:, 1] - a[:, 0], b[:, 1] - b[:, 0], b[:, 0] - a[:, 0]
    sizes = np.linalg.norm(u, axis=1), np.linalg.norm(v, axis=1)
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    crossing = np.abs(area) > 1e-14 * sizes[0] * sizes[1]
    safe = np.where(crossing, area, 1.0)
    s = (gap[:, 0] * v[:, 1] - gap[:, 1] * v[:, 0]) / safe
    t = (gap[:, 0] * u[:, 1] - gap[:, 1] * u[:, 0]) / safe
    inner = crossing & (s > 0.0) & (s < 1.0) & (t > 0.0) & (t < 1.0)
    rows, found = [pairs[inner]], [np.column_stack((s, t))[inner]]
    for end in (0, 1):
        for line, size, other, point, swapped in (
            (a, sizes[0], u, b[:, end], True),
            (b, sizes[1], v, a[:, end], False),
        ):
            way = point - line[:, 0]
            share = np.clip((way * other).sum(axis=1) / np.maximum(size, 1e-300) ** 2, 0.0, 1.0)
            on = np.linalg.norm(way - share[:, None] * other, axis=1) <= near
            here = np.column_stack((share, np.full(len(share), float(end))))
            rows.append(pairs[on])
            found.append((here if swapped else here[:, ::-1])[on])
    return np.concatenate(rows), np.concatenate(found)


def _of_equal(
    lifted: Floats, straight: NDArray[np.bool_], first: Numbers, second: Numbers, near: float
) -> tuple[Numbers, Floats]:
    """Both ends of curves that are one, run through either way."""
    pairs = np.unique(np.column_stack((first, second)), axis=0).reshape(-1, 2)
    pairs = pairs[~straight[pairs].any(axis=1)]
    rows, found = [pairs[:0]], [np.zeros((0, 2))]
    for turned in (False, True):
        other = lifted[pairs[:, 1]]
        other = other[:, ::-1] if turned else other
        mine = lifted[pairs[:, 0]]
        if lifted.shape[-1] == 3:  # weights are alike but for a factor
            mine, other = mine / mine[:, :1, 2:], other / other[:, :1, 2:]
        same = (np.abs(mine - other) <= 0.1 * near).all(axis=(1, 2))
        for end in (0.0, 1.0):
            rows.append(pairs[same])
            found.append(np.tile([end, 1.0 - end if turned else end], (int(np.count_nonzero(same)), 1)))
    return np.concatenate(rows), np.concatenate(found)


def _loops(lifted: Floats, straight: NDArray[np.bool_]) -> tuple[Numbers, Floats]:
    """The two parameters at which a curve meets itself: of cubics in closed form."""
    none = np.zeros((0, 2), np.intp), np.zeros((0, 2))
    steps = np.diff(plain(lifted), axis=1)
    turns = np.arctan2(
        steps[:, :-1, 0] * steps[:, 1:, 1] - steps[:, :-1, 1] * steps[:, 1:, 0],
        (steps[:, :-1] * steps[:, 1:]).sum(axis=-1),
    )
    curved = np.flatnonzero(~straight & (np.abs(turns).sum(axis=1) > np.pi - 1e-6))
    if not len(curved):
        return none
    if lifted.shape[1] != 4 or lifted.shape[-1] == 3:
        found = [(row, _self(lifted[row])) for row in curved.tolist()]
        rows = [np.full((len(pair), 2), row, np.intp) for row, pair in found]
        return np.concatenate(rows), np.concatenate([pair for _, pair in found])
    c, b, a = np.moveaxis(polynomial(lifted[curved])[:, 1:], 1, 0)
    across = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):  # B(s) = B(t): a (s² + s t + t²) + b (s + t) + c = 0
        total = (c[:, 0] * a[:, 1] - c[:, 1] * a[:, 0]) / across
        product = total**2 + (c[:, 0] * b[:, 1] - c[:, 1] * b[:, 0]) / across
        root = np.sqrt(total**2 - 4.0 * product)
        pairs = 0.5 * np.column_stack((total - root, total + root))
        inside = (pairs >= 0.0).all(axis=1) & (pairs <= 1.0).all(axis=1) & (root > 1e-6)
    return np.repeat(curved[inside][:, None], 2, axis=1), pairs[inside]


def _self(lifted: Floats) -> Floats:
    points, weights = (lifted, None) if lifted.shape[-1] == 2 else projected(lifted)
    found, _ = self_intersections(points, weights)
    ends = (found[:, 0] <= BEYOND) & (found[:, 1] >= 1.0 - BEYOND)
    return found[~ends]


def _alone(lifted: Floats, i: int, j: int) -> tuple[Numbers, Floats]:
    one, two = lifted[i], lifted[j]
    weights = None, None
    if lifted.shape[-1] == 3:
        (one, u), (two, v) = projected(one), projected(two)
        weights = u, v
    meeting = intersections(one, two, weights)
    found = np.concatenate((np.column_stack((meeting.first, meeting.second)), meeting.shared.reshape(-1, 2)))
    return np.tile(np.array([i, j], np.intp), (len(found), 1)), found


def _crossings(
    lifted: Floats, first: Numbers, second: Numbers, place: Floats, width: Floats, near: float
) -> tuple[Numbers, Floats, Numbers]:
    """Pairs that cross, with both parameters, and the pairs (h, 2) that have to be looked at one by one."""
    one = extracted(lifted[first], place[:, 0], place[:, 0] + width[:, 0])
    two = extracted(lifted[second], place[:, 1], place[:, 1] + width[:, 1])
    pairs = np.column_stack((first, second))
    rows, found, hard = [pairs[:0]], [np.zeros((0, 2))], [pairs[:0]]
    for depth in range(DEPTH + 1):
        if not len(pairs):
            break
        if len(pairs) > CROWD and depth > 2:
            raise TooMany
        p, q = plain(one), plain(two)
        open_ = boxes_meet(p, q, near)
        ends, at_ends = _joined_ends(p, q, near)
        done = open_ & (ends >= 0)
        rows.append(pairs[done])
        found.append(place[done] + width[done] * at_ends[done])
        open_ &= ends < 0
        pairs, place, width, one, two = pairs[open_], place[open_], width[open_], one[open_], two[open_]
        apart = directions_differ(p[open_], q[open_])
        tried = np.flatnonzero(apart)
        at, good = _newton(lifted, pairs[tried], place[tried], width[tried], near)
        rows.append(pairs[tried[good]])
        found.append(at[good])
        left = np.ones(len(pairs), bool)
        left[tried[good]] = False
        lost = left & ~apart
        if depth < PATIENCE[0]:
            lost[:] = False
        elif depth < PATIENCE[1]:
            _, back, times = np.unique(_keys(pairs, len(lifted)), return_inverse=True, return_counts=True)
            lost &= times[back] > MANY
        elif depth == DEPTH:
            lost = left
        hard.append(np.unique(pairs[lost], axis=0).reshape(-1, 2))
        known = np.concatenate(hard)
        if len(known):
            left &= ~np.isin(_keys(pairs, len(lifted)), _keys(known, len(lifted)))
        pairs, place, width, one, two = pairs[left], place[left], 0.5 * width[left], one[left], two[left]
        (left_one, right_one), (left_two, right_two) = halved(one), halved(two)
        one = np.concatenate([left_one, left_one, right_one, right_one])
        two = np.concatenate([left_two, right_two, left_two, right_two])
        steps = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]])
        place = (place + width * steps[:, None]).reshape(-1, 2)
        pairs, width = np.tile(pairs, (4, 1)), np.tile(width, (4, 1))
    known = np.unique(np.concatenate(hard), axis=0).reshape(-1, 2)
    every, at = np.concatenate(rows), np.concatenate(found)
    clear = ~np.isin(_keys(every, len(lifted)), _keys(known, len(lifted)))
    return every[clear], np.clip(at[clear], 0.0, 1.0), known


def _joined_ends(p: Floats, q: Floats, near: float) -> tuple[Numbers, Floats]:
    """(k,) from 0 where two pieces share an end and their hulls nothing else, else -1; and which ends (k, 2)."""
    which, at = np.full(len(p), -1), np.zeros((len(p), 2))
    for number, (i, j) in enumerate(((0, 0), (0, -1), (-1, 0), (-1, -1))):
        rows = np.flatnonzero(np.abs(p[:, i] - q[:, j]).max(axis=1) <= near)
        if not len(rows):
            continue
        (one, wide), (two, broad) = (_fan(points[rows], end, near) for points, end in ((p, i), (q, j)))
        angle = np.arccos(np.clip((one * two).sum(axis=1), -1.0, 1.0))
        clear = rows[angle > wide + broad + 1e-6]
        which[clear], at[clear] = number, (-i, -j)
    return which, at


def _fan(points: Floats, end: int, near: float) -> tuple[Floats, Floats]:
    """The middle direction (k, 2) in which control points (k, n, 2) are seen from one end, and the half angle (k,)."""
    ways = points - points[:, [end]]
    sizes = np.linalg.norm(ways, axis=2)
    seen = sizes > 10.0 * near
    ways = np.where(seen[..., None], ways / np.maximum(sizes, 1e-300)[..., None], 0.0)
    middle = ways.sum(axis=1)
    size = np.linalg.norm(middle, axis=1)
    middle /= np.maximum(size, 1e-300)[:, None]
    cosine = np.where(seen, (ways * middle[:, None]).sum(axis=2), 1.0).min(axis=1)
    return middle, np.where(size > 1e-6, np.arccos(np.clip(cosine, -1.0, 1.0)), np.pi)


def _newton(
    lifted: Floats, pairs: Numbers, place: Floats, width: Floats, near: float
) -> tuple[Floats, NDArray[np.bool_]]:
    """Parameters (k, 2) at which the pieces cross, and whether they do within the pieces."""
    at = place + 0.5 * width
    if not len(at):
        return at, np.zeros(0, bool)
    a, b = lifted[pairs[:, 0]], lifted[pairs[:, 1]]
    for _ in range(STEPS):
        p, q = _with_slope(a, at[:, 0]), _with_slope(b, at[:, 1])
        gap = q[0] - p[0]
        area = p[1][:, 0] * q[1][:, 1] - p[1][:, 1] * q[1][:, 0]
        safe = np.where(area != 0.0, area, np.inf)
        step = np.column_stack(
            (
                (gap[:, 0] * q[1][:, 1] - gap[:, 1] * q[1][:, 0]) / safe,
                (gap[:, 0] * p[1][:, 1] - gap[:, 1] * p[1][:, 0]) / safe,
            )
        )
        at = at + np.clip(step, -width, width)
        if (np.abs(step) <= 1e-16).all():
            break
    inside = ((at >= place - BEYOND) & (at <= place + width + BEYOND)).all(axis=1)
    held = np.clip(at, 0.0, 1.0)
    off = np.abs(_points(a, held[:, 0]) - _points(b, held[:, 1])).max(axis=1)
    return held, inside & (off <= near)


def _points(lifted: Floats, t: Floats) -> Floats:
    return plain(evaluated(lifted, t[:, None])[:, 0])


def _with_slope(lifted: Floats, t: Floats) -> Floats:
    """(2, k, 2) points and derivatives."""
    found = derivatives(lifted, t[:, None], 1)[:, :, 0]
    if lifted.shape[-1] == 2:
        return found
    points = found[0, :, :2] / found[0, :, 2:]
    return np.stack((points, (found[1, :, :2] - found[1, :, 2:] * points) / found[0, :, 2:]))
