"""The islands of a path: which contours fill one connected area, with the holes in it."""

from __future__ import annotations

import numpy as np

from ...curve.bezier import evaluated
from ..flatten import flatten
from ..path import Floats, Numbers, Path
from ..pieces import pieces_of

FINE = 1e-4
"""How far chords may be from the curves, as a part of the path's size, when it is asked what lies within what."""
PROBES = 7
"""Points of a contour that vote whether it lies within another one: contours may touch."""


def islands(path: Path) -> list[list[int]]:
    """The numbers of the contours of each island and its holes, by the path's rule; each open contour by itself.

    In the order of the first contour of each. Contours that neither fill nor empty anything go with what is around
    them. The contours must not cross: then they count as what most of their points lie in.
    """
    contours = path.contours
    closed = [i for i, contour in enumerate(contours) if contour.closed and contour.dimension == 2]
    around = _around(path, closed)
    turns = np.array([np.sign(contours[i].area()) for i in closed], np.intp)
    outside = around @ turns
    inside = outside + turns
    if path.rule == "evenodd":
        outside, inside = around.sum(axis=1) % 2, (around.sum(axis=1) + 1) % 2
    owner: dict[int, int] = {}
    order = np.argsort(around.sum(axis=1), kind="stable").tolist()  # what is around before what is within
    for row in order:
        within = np.flatnonzero(around[row])
        inner = within[np.argmax(around[within].sum(axis=1))] if len(within) else None
        begins = inner is None or (outside[row] == 0 and inside[row] != 0)
        owner[row] = row if begins or inner is None else owner[int(inner)]
    groups: dict[int, list[int]] = {}
    for row, number in enumerate(closed):
        groups.setdefault(closed[owner[row]], []).append(number)
    for number in range(len(contours)):
        if number not in closed:
            groups[number] = [number]
    return sorted(groups.values())


def _around(path: Path, closed: list[int]) -> np.ndarray:
    """(k, k) whether contour j of the closed ones lies around contour i."""
    count = len(closed)
    found = np.zeros((count, count), bool)
    if count < 2:
        return found
    size = float(np.ptp(path.bounds(), axis=0).max())
    parts = [Path((path.contours[i],)) for i in closed]
    polygons = [flatten(part, FINE * size)[0] for part in parts]
    boxes = np.array([part.bounds() for part in parts])
    areas = np.abs([part.area() for part in parts])
    probes = [_probes(part) for part in parts]
    for j in range(count):
        low, high = boxes[j]
        inner = np.flatnonzero(
            (boxes[:, 0] >= low - FINE * size).all(axis=1)
            & (boxes[:, 1] <= high + FINE * size).all(axis=1)
            & (areas < areas[j])
        )
        for i in inner.tolist():
            found[i, j] = 2 * np.count_nonzero(_within(polygons[j], probes[i])) > PROBES
    return found


def _probes(part: Path) -> Floats:
    """(PROBES, 2) points spread over a contour, none of them a node."""
    groups = pieces_of(part.contours)
    count = sum(len(group.place) for group in groups)
    points: Floats = np.empty((PROBES, 2))
    for probe, where in enumerate(((np.arange(PROBES) * 0.618034 + 0.31) % 1.0 * count).tolist()):
        for group in groups:
            for row in np.flatnonzero(group.place == int(where)).tolist():
                weights = None if group.weights is None else group.weights[row]
                points[probe] = evaluated(group.controls[row], where % 1.0, weights)
    return points


def _within(polygon: Floats, points: Floats) -> Numbers:
    """(m,) whether points (m, 2) lie within a polygon (n, 2), by the number of its edges to the right of them."""
    begin, end = polygon, np.roll(polygon, -1, axis=0)
    x, y = points[:, 0, None], points[:, 1, None]
    spans = (begin[:, 1] <= y) != (end[:, 1] <= y)
    rise = np.where(spans, end[:, 1] - begin[:, 1], 1.0)
    cross = begin[:, 0] + (y - begin[:, 1]) * (end[:, 0] - begin[:, 0]) / rise
    return np.count_nonzero(spans & (cross > x), axis=1) % 2
