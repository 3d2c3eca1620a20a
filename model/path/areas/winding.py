"""How often paths wind around the two sides of the edges of an arrangement."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...curve.bernstein import derivative, product, roots
from ...curve.bezier import evaluated, extracted
from ..path import Floats, Numbers
from .arrangement import Arrangement
from .meetings import plain

BANDS = 512
"""Strips into which the plane is cut, so that a ray looks at few curves."""
HALVINGS = 54
TURNS = (np.array([[1.0, 0.0], [0.0, 1.0]]), np.array([[0.0, -1.0], [1.0, 0.0]]))
"""Points times these: as they are, and turned by -90 degrees, so that a ray to the right goes up instead."""


def windings(arrangement: Arrangement) -> Numbers:
    """Rows (w, 4): edge, path, and the winding numbers of the path on the edge's left and right; no rows of zeros.

    A ray from the middle of each edge, across it, counts what it crosses. Edges are taken in parts that rise or fall
    all along in both coordinates, so that most crossings are told by the parts' ends alone.
    """
    lifted = arrangement.lifted
    edge, low, high = _monotone(lifted)
    part = extracted(lifted[edge], low, high)
    ends = plain(part[:, [0, -1]])
    # Where two parts of an edge meet is one point for both.
    inner = np.flatnonzero(edge[1:] == edge[:-1])
    ends[inner, 1] = ends[inner + 1, 0]
    extent = np.abs(ends[:, 1] - ends[:, 0])
    order = np.lexsort((extent.max(axis=1), edge))
    chosen = order[np.flatnonzero(np.diff(edge[order], append=-1))]  # the longest part of each edge
    middle = plain(evaluated(part[chosen], 0.5))
    upright = extent[chosen, 1] >= extent[chosen, 0]
    ray, crossed, sign, left = [], [], [], np.zeros(len(chosen), bool)
    for turn, rows in zip(TURNS, (np.flatnonzero(upright), np.flatnonzero(~upright)), strict=True):
        tips = ends @ turn
        rising = tips[:, 1, 1] > tips[:, 0, 1]
        at, over = _beyond(part, tips, turn, middle[rows] @ turn, chosen[rows])
        ray.append(rows[at])
        crossed.append(edge[over])
        sign.append(np.where(rising[over], 1, -1))
        left[rows] = ~rising[chosen[rows]]  # whether the ray leaves on the edge's left
    return _summed(arrangement.uses, np.concatenate(ray), np.concatenate(crossed), np.concatenate(sign), left)


def _summed(uses: Numbers, ray: Numbers, crossed: Numbers, sign: Numbers, left: NDArray[np.bool_]) -> Numbers:
    first = np.searchsorted(uses[:, 0], np.arange(len(left) + 1))
    sizes = np.diff(first)[crossed]
    number = np.repeat(first[:-1][crossed], sizes) + np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    ray, sign = np.repeat(ray, sizes), np.repeat(sign, sizes)
    # Rows: edge, path, what the ray counts, and what the edge itself adds on its left.
    far = np.column_stack((ray, uses[number, 1], sign * uses[number, 2], np.zeros_like(ray)))
    own = np.column_stack((uses[:, :2], np.zeros(len(uses), np.intp), uses[:, 2]))
    rows = np.concatenate((far, own))
    keys, back = np.unique(rows[:, :2], axis=0, return_inverse=True)
    counted, step = np.zeros(len(keys), np.intp), np.zeros(len(keys), np.intp)
    np.add.at(counted, back.ravel(), rows[:, 2])
    np.add.at(step, back.ravel(), rows[:, 3])
    leaves_left = left[keys[:, 0]]
    found = np.column_stack(
        (keys, np.where(leaves_left, counted, counted + step), np.where(leaves_left, counted - step, counted))
    )
    return found[found[:, 2:].any(axis=1)]


def _monotone(lifted: Floats) -> tuple[Numbers, Floats, Floats]:
    """The parts of curves in which both coordinates rise or fall: curve (m,), and where they begin and end."""
    count = len(lifted)
    numbers, t = [np.arange(count), np.arange(count)], [np.zeros(count), np.ones(count)]
    for axis in (0, 1):
        slope = derivative(lifted[..., axis])
        if lifted.shape[-1] == 3:
            slope = product(slope, lifted[..., 2]) - product(lifted[..., axis], derivative(lifted[..., 2]))
        at, found = roots(slope)
        numbers.append(at)
        t.append(found)
    which, where = np.concatenate(numbers), np.concatenate(t)
    order = np.lexsort((where, which))
    which, where = which[order], where[order]
    begin = np.flatnonzero((which[1:] == which[:-1]) & (where[1:] > where[:-1]))
    return which[begin], where[begin], where[begin + 1]


def _beyond(part: Floats, tips: Floats, turn: Floats, points: Floats, own: Numbers) -> tuple[Numbers, Numbers]:
    """Which rays to the right from points (r, 2) cross which parts, other than their own."""
    bottom, top = tips[..., 1].min(axis=1), tips[..., 1].max(axis=1)
    low, high = tips[..., 0].min(axis=1), tips[..., 0].max(axis=1)
    at, over = _in_band(bottom, top, points[:, 1])
    meet = (bottom[over] <= points[at, 1]) & (points[at, 1] < top[over])
    meet &= (high[over] >= points[at, 0]) & (over != own[at])
    at, over = at[meet], over[meet]
    close = np.flatnonzero(low[over] <= points[at, 0])
    curve, point = part[over[close]], points[at[close]]
    rising = tips[over[close], 1, 1] > tips[over[close], 0, 1]
    begin, end = np.zeros(len(close)), np.ones(len(close))
    for _ in range(HALVINGS if len(close) else 0):
        middle = 0.5 * (begin + end)
        above = ((_at(curve, middle) @ turn)[:, 1] > point[:, 1]) == rising
        begin, end = np.where(above, begin, middle), np.where(above, middle, end)
    right = np.ones(len(at), bool)
    right[close] = (_at(curve, 0.5 * (begin + end)) @ turn)[:, 0] > point[:, 0]
    return at[right], over[right]


def _at(lifted: Floats, t: Floats) -> Floats:
    return plain(evaluated(lifted, t[:, None])[:, 0])


def _in_band(bottom: Floats, top: Floats, heights: Floats) -> tuple[Numbers, Numbers]:
    """Pairs of heights and intervals that share a strip."""
    if not (len(heights) and len(bottom)):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    base, reach = bottom.min(), max(float(np.ptp(np.concatenate((bottom, top)))), 1e-300)

    def band(values: Floats) -> Numbers:
        return np.clip((values - base) / reach * BANDS, 0, BANDS - 1).astype(np.intp)

    first, last = band(bottom), band(top)
    spread = last - first + 1
    member = np.repeat(np.arange(len(bottom)), spread)
    strip = np.repeat(first, spread) + np.arange(len(member)) - np.repeat(np.cumsum(spread) - spread, spread)
    order = np.argsort(strip, kind="stable")
    begins = np.searchsorted(strip[order], np.arange(BANDS + 1))
    mine = band(heights)
    sizes = begins[mine + 1] - begins[mine]
    at = np.repeat(np.arange(len(heights)), sizes)
    place = np.repeat(begins[mine], sizes) + np.arange(len(at)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return at, member[order[place]]
