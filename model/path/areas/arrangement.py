"""Contours cut where they meet: vertices, and the edges between them, of those that lie on each other one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...curve.bezier import evaluated, extracted
from ...curve.degree import elevated
from ...curve.nearest import nearest
from ..path import Contour, Floats, Kind, Numbers
from ..pieces import pieces_of
from .meetings import meetings, overlapping, plain

SAMPLES = np.array([0.25, 0.5, 0.75])


@dataclass(frozen=True, slots=True, eq=False)
class Arcs:
    """The segments of contours as Bezier curves of one degree, splines as several of them."""

    lifted: Floats  # (n, degree + 1, 2), or (n, degree + 1, 3) homogeneous
    segment: Numbers  # (n,) among all segments of all contours
    begin: Floats  # (n,) parameters of the segment where the arc begins and ends
    end: Floats  # (n,)
    kind: Numbers  # (n,) of the segment


@dataclass(frozen=True, slots=True, eq=False)
class Arrangement:
    """Edges that meet at vertices alone. Of edges that lie on each other there is one; `uses` tells all of them."""

    vertices: Floats  # (v, 2)
    lifted: Floats  # (e, degree + 1, 2 or 3) curves of the edges
    ends: Numbers  # (e, 2) vertices
    segment: Numbers  # (e,) a segment whose part the edge is
    span: Floats  # (e, 2) the part, in the segment's parameter
    uses: Numbers  # (u, 3) edge, path, and how often more the path runs along it than against it


def arranged(groups: Sequence[Sequence[Contour]], near: float) -> Arrangement:
    """The closed contours of several paths in the plane. Points nearer than `near` mm are one."""
    contours = [contour for group in groups for contour in group]
    path = np.repeat(np.arange(len(groups)), [sum(len(contour) for contour in group) for group in groups])
    arcs = _arcs(contours)
    straight = arcs.kind == Kind.LINE
    pairs, at = meetings(arcs.lifted, straight, near)
    arc = np.concatenate((pairs[:, 0], pairs[:, 1]))
    t = np.concatenate((at[:, 0], at[:, 1]))
    count = len(arcs.lifted)
    tips = plain(arcs.lifted[:, [0, -1]])
    cuts = plain(evaluated(arcs.lifted[arc], t[:, None])[:, 0])
    points = np.concatenate((tips[:, 0], tips[:, 1], cuts))
    label = _clusters(points, near)
    own = np.concatenate((np.arange(count), np.arange(count), arc))
    t = np.concatenate((np.zeros(count), np.ones(count), t))
    order = np.lexsort((t, own))
    own, t, label = own[order], t[order], label[order]
    following = np.flatnonzero((own[1:] == own[:-1]) & (t[1:] > t[:-1]))
    # What begins and ends at one vertex is a loop, or nothing.
    lifted = extracted(arcs.lifted[own[following]], t[following], t[following + 1])
    size = np.ptp(plain(lifted), axis=1).max(axis=1, initial=0.0)
    real = (label[following] != label[following + 1]) | (size > 4.0 * near)
    following, lifted = following[real], lifted[real]
    ends = np.column_stack((label[following], label[following + 1]))
    lifted = _held(lifted, points[ends])
    owner = own[following]
    low, high = arcs.begin[owner], arcs.end[owner]
    span = np.column_stack([(1.0 - t[at]) * low + t[at] * high for at in (following, following + 1)])
    return _merged(points, lifted, ends, arcs.segment[owner], span, arcs.kind[owner], path, near)


def _arcs(contours: list[Contour]) -> Arcs:
    groups = pieces_of(contours)
    degree = max(3, *(group.degree for group in groups))
    rational = any(group.weights is not None for group in groups)
    kinds = np.concatenate([contour.kinds for contour in contours]).astype(np.intp)
    rows, owner, begin, end = [], [], [], []
    for group in groups:
        lifted = group.lifted
        if rational and group.weights is None:
            lifted = np.concatenate((lifted, np.ones((*lifted.shape[:2], 1))), axis=2)
        rows.append(elevated(lifted, degree - group.degree))
        owner.append(group.segment)
        begin.append(group.begin)
        end.append(group.end)
    lifted, segment = np.concatenate(rows), np.concatenate(owner)
    place = np.argsort(np.concatenate([group.place for group in groups]), kind="stable")
    real = np.ptp(plain(lifted), axis=1).max(axis=1) > 0.0
    place = place[real[place]]
    return Arcs(
        lifted[place], segment[place], np.concatenate(begin)[place], np.concatenate(end)[place], kinds[segment[place]]
    )


def _held(lifted: Floats, ends: Floats) -> Floats:
    """Curves that begin and end exactly at the points (k, 2, 2)."""
    for number, end in ((0, 0), (1, -1)):
        weight = 1.0 if lifted.shape[-1] == 2 else lifted[:, end, 2:]
        lifted[:, end, :2] = ends[:, number] * weight
    return lifted


def _clusters(points: Floats, near: float) -> Numbers:
    """(n,) for each point the first one that is it, or hangs together with it by points that are it."""
    turned = points @ np.array([[0.8, -0.6], [0.6, 0.8]])  # outlines have many points one above the other
    i, j = overlapping(turned - 0.5 * near, turned + 0.5 * near)
    label = np.arange(len(points))
    while True:
        low = np.minimum(label[i], label[j])
        before = label.copy()
        np.minimum.at(label, i, low)
        np.minimum.at(label, j, low)
        label = label[label]
        if (label == before).all():
            return label


def _merged(
    points: Floats,
    lifted: Floats,
    ends: Numbers,
    segment: Numbers,
    span: Floats,
    kind: Numbers,
    path: Numbers,
    near: float,
) -> Arrangement:
    """Edges between the same vertices that lie on each other become one: of these the simplest kind."""
    key = np.sort(ends, axis=1)
    order = np.lexsort((np.where(kind == Kind.SPLINE, 9, kind), key[:, 1], key[:, 0]))
    key = key[order]
    fresh = np.append(True, (key[1:] != key[:-1]).any(axis=1)) if len(key) else np.zeros(0, bool)
    run = np.cumsum(fresh) - 1
    sizes = np.bincount(run)
    edge, sign = np.arange(len(ends)), np.ones(len(ends), np.intp)
    start = np.cumsum(sizes) - sizes
    place = np.arange(len(order)) - start[run]
    for step in range(1, int(sizes.max(initial=0))):  # with the one so many places further on in the run
        rows = np.flatnonzero(place + step < sizes[run])
        one, two = order[rows], order[rows + step]
        free = edge[two] == two
        one, two = one[free], two[free]
        way = _along(lifted[one], lifted[two], near)
        on = way != 0
        edge[two[on]] = edge[one[on]]
        sign[two[on]] = way[on] * sign[one[on]]
    kept, edge = np.unique(edge, return_inverse=True)
    uses = np.column_stack((edge, path[segment]))
    which, back = np.unique(uses, axis=0, return_inverse=True)
    times = np.zeros(len(which), np.intp)
    np.add.at(times, back.ravel(), sign)
    return Arrangement(
        points, lifted[kept], ends[kept], segment[kept], span[kept], np.column_stack((which, times))[times != 0]
    )


def _along(one: Floats, two: Floats, near: float) -> Numbers:
    """(k,) 1 where two curves are one, -1 where one is the other backwards, 0 where they are two."""
    near *= 4.0
    here, there = (plain(evaluated(curve, SAMPLES)) for curve in (one, two))
    found = np.zeros(len(one), np.intp)
    for sign, points in ((1, there), (-1, there[:, ::-1])):
        found[(found == 0) & (np.abs(here - points).max(axis=(1, 2)) <= near)] = sign
    low, high = plain(two).min(axis=1) - near, plain(two).max(axis=1) + near
    inside = ((here >= low[:, None]) & (here <= high[:, None])).all(axis=(1, 2))
    for row in np.flatnonzero((found == 0) & inside).tolist():
        curve = two[row]
        weights = None if curve.shape[-1] == 2 else curve[:, 2]
        t, away = nearest(plain(curve), here[row], weights)
        if away.max() <= near and (np.diff(t) > 0.0).all() | (np.diff(t) < 0.0).all():
            found[row] = 1 if t[-1] > t[0] else -1
    return found
