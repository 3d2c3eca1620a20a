"""Lines of a picture that cover one another are drawn once: visible before hidden, outlines before other edges.

Pieces are sorted into straight lines by direction and distance from the middle of the picture; along each line all ends
are sorted, what lies between two of them belongs to the first of the pieces there, and neighbours that are alike become
one again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .lines import Lines
from .polygons import ranges

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

ANGLE = 1e-7
"""Radians by which directions of one line may differ from their neighbours in order."""
NEAR = 1e-6
"""How near lie ends that are one, and lines; as a part of the picture's size."""


def drawn_once(lines: Lines) -> Lines:
    """The lines without what covers others or is covered, joined where they touch in line and are alike.

    Ends that meet are equal to the last bit.
    """
    points = lines.ends.reshape(-1, 2)
    size = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    lines = lines.chosen(lines.lengths > NEAR * size)
    if not lines.count:
        return lines
    straight, along = _straight_lines(lines.ends, size)
    # The ends of all pieces as places, numbered line after line and along it.
    order = np.lexsort((along.reshape(-1), np.repeat(straight, 2)))
    on, at = np.repeat(straight, 2)[order], along.reshape(-1)[order]
    new = np.append(True, (on[1:] != on[:-1]) | (np.diff(at) > NEAR * size))
    place = np.empty(len(order), np.int64)
    place[order] = np.cumsum(new) - 1
    place_points = lines.ends.reshape(-1, 2)[order[new]]
    begin, end = np.sort(place.reshape(-1, 2), axis=1).T

    # Between two neighbouring places the first piece counts.
    rank = (lines.hidden * 8 + lines.kind).astype(np.int64) * (int(lines.layer.max()) + 1) + lines.layer
    piece, step = ranges(end - begin)
    gap = begin[piece] + step
    best = np.full(len(place_points), np.iinfo(np.int64).max)
    np.minimum.at(best, gap, rank[piece])
    covered = np.flatnonzero(best < np.iinfo(np.int64).max)
    first = np.append(True, (np.diff(covered) > 1) | (np.diff(best[covered]) != 0))
    run = np.flatnonzero(first)
    last = np.append(run[1:], len(covered)) - 1
    ends = np.stack((place_points[covered[run]], place_points[covered[last] + 1]), axis=1)
    alike, layer = np.divmod(best[covered[run]], int(lines.layer.max()) + 1)
    ends = _met(ends.reshape(-1, 2), NEAR * size).reshape(-1, 2, 2)
    return Lines(ends, (alike % 8).astype(np.int8), alike >= 8, layer.astype(np.int32))


def _straight_lines(ends: Floats, size: float) -> tuple[Numbers, Floats]:
    """(n,) the straight line that each piece is on, and where along it its ends are (n, 2), mm."""
    way = ends[:, 1] - ends[:, 0]
    length = np.hypot(way[:, 0], way[:, 1])
    angle = np.arctan2(way[:, 1], way[:, 0]) % np.pi
    angle[angle > np.pi - 10.0 * ANGLE] -= np.pi
    turn = _clustered(np.zeros(len(ends), np.int64), angle, ANGLE)
    leader = _longest(turn, length)[turn]
    unit = way[leader] / length[leader, None]
    arm = ends.mean(axis=1) - ends.reshape(-1, 2).mean(axis=0)
    offset = unit[:, 0] * arm[:, 1] - unit[:, 1] * arm[:, 0]
    straight = _clustered(turn, offset, NEAR * size)
    leader = _longest(straight, length)[straight]
    unit = way[leader] / length[leader, None]
    return straight, np.einsum("nij,nj->ni", ends - ends[leader, :1], unit)


def _clustered(group: Numbers, values: Floats, gap: float) -> Numbers:
    """(n,) numbers of clusters: values of one group whose neighbours lie no more than `gap` apart."""
    order = np.lexsort((values, group))
    new = np.append(True, (np.diff(group[order]) != 0) | (np.diff(values[order]) > gap))
    number = np.empty(len(order), np.int64)
    number[order] = np.cumsum(new) - 1
    return number


def _longest(cluster: Numbers, length: Floats) -> Numbers:
    """(c,) the longest piece of each cluster."""
    order = np.lexsort((-length, cluster))
    return order[np.append(True, np.diff(cluster[order]) != 0)]


def _met(points: Floats, gap: float) -> Floats:
    """Points (n, 2) with those that are one within `gap` in the same place."""
    column = _clustered(np.zeros(len(points), np.int64), points[:, 0], gap)
    spot = _clustered(column, points[:, 1], gap)
    _, first = np.unique(spot, return_index=True)
    return points[first][spot]
