"""Knots of B-splines: inserted, removed, refined; curves cut, clamped and closed. But for removal the curve stays.

All of it is one step: the control points on other knots, by the Oslo algorithm (Cohen, Lyche and Riesenfeld 1980),
which puts in all knots at once what Boehm (1980) does for one.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from .bspline import BSpline, Floats, Numbers, basis_rows, combined, of_lifted

SAME = 1e-12
"""Parameters that are nearer to a knot than this part of the domain are that knot."""


def clamped_knots(count: int, degree: int) -> Floats:
    """(count + degree + 1,) knots from 0 to 1, even steps, `degree` + 1 at each end: there the curve has its ends."""
    return np.concatenate([np.zeros(degree), np.linspace(0.0, 1.0, count - degree + 1), np.ones(degree)])


def open_knots(count: int, degree: int) -> Floats:
    """(count + degree + 1,) evenly spaced knots, the domain from 0 to 1: the curve ends short of its control points."""
    return np.arange(-degree, count + 1) / (count - degree)


def closed(
    points: ArrayLike, degree: int = 3, intervals: ArrayLike | None = None, weights: ArrayLike | None = None
) -> BSpline:
    """The closed curve of control points (m, d), as smooth at its seam as elsewhere, on the domain from 0 to 1.

    `intervals` (m,) are the steps from knot to knot, else even; those of 0 make a knot that stands several times, up to
    `degree`, not the first or the last one: the seam is a simple knot. The value has the first `degree` points once
    more at its end, and is `periodic`.
    """
    points = np.asarray(points, float)
    count = len(points)
    steps = np.ones(count) if intervals is None else np.asarray(intervals, float)
    if count < 2 or steps.shape != (count,) or not (np.isfinite(steps) & (steps >= 0.0)).all():
        raise Refusal(
            "a closed B-spline needs two control points or more, and for each an interval of knots, not below 0"
        )
    if not (steps[0] > 0.0 and steps[-1] > 0.0):
        raise Refusal("a closed B-spline has one knot at its seam: its first and its last interval are above 0")
    around = np.arange(count + degree) % count
    base = np.concatenate([[0.0], np.cumsum(steps)[:-1]]) / steps.sum()
    ratios = None if weights is None else np.asarray(weights, float)[around]
    return BSpline(points[around], degree, _around(base, 1.0, degree), ratios)


def breaks(spline: BSpline) -> tuple[Floats, Numbers]:
    """(k,) the different knots of the domain with both its ends, and (k,) how often each stands among all knots."""
    start, end = spline.domain
    values, counts = np.unique(spline.knots, return_counts=True)
    inside = (values >= start) & (values <= end)
    return values[inside], counts[inside]


def multiplicity(spline: BSpline, t: float) -> int:
    """How often the parameter is a knot: the curve is at least degree - multiplicity times differentiable there."""
    return int(np.count_nonzero(spline.knots == snapped(spline, np.array([t]))[0]))


def inserted(spline: BSpline, t: float, times: int = 1) -> BSpline:
    """With a knot more at the parameter, or several (Boehm 1980). Raises Refusal outside and above `degree` of them."""
    return refined(spline, np.full(min(times, spline.degree + 1), float(t)))


def refined(spline: BSpline, parameters: ArrayLike | None = None) -> BSpline:
    """With knots at all the parameters (k,) more, or in the middle of every interval; a periodic one stays so."""
    if parameters is None:
        values, _ = breaks(spline)
        parameters = 0.5 * (values[:-1] + values[1:])
    new = snapped(spline, np.asarray(parameters, float).ravel())
    _check_new(spline, new)
    p, lifted, rational = spline.degree, spline.lifted, spline.weights is not None
    if not len(new):
        return spline
    if not spline.periodic:
        knots = np.sort(np.concatenate([spline.knots, new]))
        return of_lifted(on_knots(lifted, p, spline.knots, knots), p, knots, rational)
    start, end = spline.domain
    old, base = spline.knots[p : len(lifted)], np.sort(np.concatenate([spline.knots[p : len(lifted)], new]))
    extended, turns = _extended(lifted, old, end - start, p)
    knots = _around(base, end - start, p)
    made = on_knots(extended, p, _tiled(old, end - start, turns), knots)
    return of_lifted(made[np.arange(len(made)) % len(base)], p, knots, rational)


def removed(spline: BSpline, t: float, times: int = 1) -> tuple[BSpline, float]:
    """With a knot less at the parameter, or several, and the deviation in mm (see `farthest`).

    As in Tiller (1992) only the control points move that belong to the knot; they go to where putting the knot in
    again displaces the old ones least (Lyche and Mørken 1987). Raises Refusal for what is no inner knot.
    """
    found = multiplicity(spline, t)
    start, end = spline.domain
    knot = float(snapped(spline, np.array([t]))[0])
    if not start < knot < end or found < times:
        raise Refusal(
            f"the B-spline has no {times} inner knots at {t:g}; there are {found if start < knot < end else 0}"
        )
    made = spline
    for _ in range(times):
        made = _without(made, knot)
    from .decomposition import farthest

    return made, farthest(spline, made)


def with_multiplicity(spline: BSpline, t: float, times: int) -> tuple[BSpline, float]:
    """With the parameter as knot that many times, and the deviation in mm, which is 0 where it was less often."""
    more = times - multiplicity(spline, t)
    if more >= 0:
        return (inserted(spline, t, more) if more else spline), 0.0
    return removed(spline, t, -more)


def extracted(spline: BSpline, start: float, end: float) -> BSpline:
    """The part between two parameters, clamped, on its own part of the domain.

    Where `end` is the lesser it runs backwards, on the same domain; beyond the domain the outermost polynomials go on.
    """
    low, high = snapped(spline, np.array(sorted((start, end)), float))
    if not (np.isfinite([low, high]).all() and low < high):
        raise Refusal(f"the part of a B-spline from {start:g} to {end:g} has no length; give two different parameters")
    p = spline.degree
    inner = spline.knots[p + 1 : len(spline.points)]
    inner = inner[(inner > low) & (inner < high)]
    knots = np.concatenate([np.full(p + 1, low), inner, np.full(p + 1, high)])
    made = of_lifted(on_knots(spline.lifted, p, spline.knots, knots, p), p, knots, spline.weights is not None)
    return made if start < end else made.reversed()


def split(spline: BSpline, t: float) -> tuple[BSpline, BSpline]:
    """The parts before and after a parameter inside the domain, both clamped; they have its point in common."""
    start, end = spline.domain
    knot = float(snapped(spline, np.array([t]))[0])
    if not start < knot < end:
        raise Refusal(f"a B-spline is cut between {start:g} and {end:g}, not at {t:g}")
    return extracted(spline, start, knot), extracted(spline, knot, end)


def clamped(spline: BSpline) -> BSpline:
    """The same curve with `degree` + 1 equal knots at both ends, so that it ends at its outermost control points."""
    start, end = spline.domain
    return spline if spline.knots[0] == start and spline.knots[-1] == end else extracted(spline, start, end)


def on_domain(spline: BSpline, start: float, end: float) -> BSpline:
    """The same curve with its parameters from `start` to `end`, the first the lesser."""
    if not start < end:
        raise Refusal(f"the parameters of a B-spline rise, they do not run from {start:g} to {end:g}")
    low, high = spline.domain
    share = (spline.knots - low) / (high - low)
    return replace(spline, knots=(1.0 - share) * start + share * end)


def on_knots(points: Floats, degree: int, knots: Floats, finer: Floats, lowest: int = 0) -> Floats:
    """Control points (k, d) on the knots `finer` (k + degree + 1,) of the curve with points (n, d) on `knots`.

    `finer` has all knots of the old ones between its own, at least as often. `lowest` is the first interval that is
    used; `degree` cuts at the domain.
    """
    count = len(finer) - degree - 1
    span = np.clip(np.searchsorted(knots, finer[:count], side="right") - 1, lowest, len(points) - 1)
    arguments = np.stack([finer[i : i + count] for i in range(1, degree + 1)])
    return combined(basis_rows(knots, degree, span, arguments), span - degree, points)


def snapped(spline: BSpline, parameters: Floats) -> Floats:
    """Parameters (k,), exactly the knot where they are one but for rounding."""
    start, end = spline.domain
    values = np.unique(spline.knots)
    after = np.clip(np.searchsorted(values, parameters), 1, len(values) - 1)
    near = np.where(parameters - values[after - 1] < values[after] - parameters, values[after - 1], values[after])
    return np.where(np.abs(near - parameters) <= SAME * (end - start), near, parameters)


def _check_new(spline: BSpline, new: Floats) -> None:
    start, end = spline.domain
    outside = ~((new > start) & (new < end))  # also what is not a number
    if outside.any():
        raise Refusal(f"a knot goes between {start:g} and {end:g}, not to {new[np.argmax(outside)]:g}")
    values, counts = np.unique(np.concatenate([spline.knots, new]), return_counts=True)
    many = (counts > spline.degree) & np.isin(values, new)
    if many.any():
        raise Refusal(
            f"at {values[np.argmax(many)]:g} there would be {counts[np.argmax(many)]} knots; "
            f"a B-spline of degree {spline.degree} holds together with {spline.degree} at most"
        )


def _without(spline: BSpline, knot: float) -> BSpline:
    """Of one knot less."""
    p, lifted, rational = spline.degree, spline.lifted, spline.weights is not None
    if not spline.periodic:
        at = int(np.searchsorted(spline.knots, knot))
        return of_lifted(_lessened(lifted, p, spline.knots, at), p, np.delete(spline.knots, at), rational)
    count = len(lifted) - p
    if count <= p + 1:
        raise Refusal(
            f"a closed B-spline of degree {p} with {count} control points has no knot to spare; clamp it first"
        )
    start, end = spline.domain
    old = spline.knots[p : len(lifted)]
    extended, turns = _extended(lifted, old, end - start, p)
    tiled = _tiled(old, end - start, turns)
    at = int(np.searchsorted(tiled, knot))  # in the middle copy, where the values are those of `old` exactly
    made = _lessened(extended, p, tiled, at)
    base = np.delete(old, np.searchsorted(old, knot))
    # One turn of points that has all the moved ones; point 0 is the one whose knots begin `degree` before the start.
    numbers = np.arange(at - p, at - p + len(base))
    points = np.empty((len(base), lifted.shape[1]))
    points[(numbers - turns * count + p) % len(base)] = made[numbers]
    return of_lifted(points[np.arange(len(base) + p) % len(base)], p, _around(base, end - start, p), rational)


def _lessened(points: Floats, degree: int, knots: Floats, at: int) -> Floats:
    """Control points (n - 1, d) on the knots without `at`, the first of its value inside.

    Those of which putting it in again moves the old ones least; what has to be as it was stays.
    """
    fewer = np.delete(knots, at)
    old = np.arange(max(at - degree - 1, 0), min(at + degree + 1, len(points)))
    span = np.searchsorted(fewer, knots[old], side="right") - 1
    rows = basis_rows(fewer, degree, span, np.stack([knots[old + i] for i in range(1, degree + 1)]))
    column = span - degree + rows.argmax(0)
    same = rows.max(0) == 1.0
    made = np.delete(points, old[-1], axis=0)
    kept = np.bincount(column[same], minlength=len(made))
    sums = np.zeros_like(made)
    np.add.at(sums, column[same], points[old[same]])
    made[kept > 0] = sums[kept > 0] / kept[kept > 0, None]
    free = old[0] + np.flatnonzero(kept[old[0] : old[-1]] == 0)
    if len(free):
        mixed = np.flatnonzero(~same)
        matrix = np.zeros((len(mixed), len(made)))
        where = span[mixed] - degree + np.arange(degree + 1)[:, None]
        there = (where >= 0) & (where < len(made))
        matrix[np.broadcast_to(np.arange(len(mixed)), where.shape)[there], where[there]] = rows[:, mixed][there]
        made[free] = 0.0
        made[free] = np.linalg.lstsq(matrix[:, free], points[old[mixed]] - matrix @ made, rcond=None)[0]
    return made


def _tiled(base: Floats, period: float, turns: int) -> Floats:
    """((2 turns + 1) m,) knots of as many periods, the middle one exactly `base` (m,)."""
    return (base + period * np.arange(-turns, turns + 1)[:, None]).ravel()


def _around(base: Floats, period: float, degree: int) -> Floats:
    """(m + 2 degree + 1,) knots of a periodic B-spline whose domain begins with the knots `base` (m,)."""
    turns = ceil(degree / len(base)) + 1
    first = turns * len(base) - degree
    knots = _tiled(base, period, turns)[first : first + len(base) + 2 * degree + 1]
    knots[degree + len(base)] = base[0] + period
    return knots


def _extended(lifted: Floats, base: Floats, period: float, degree: int) -> tuple[Floats, int]:
    """Control points on the knots `_tiled` for a number of turns, and that number."""
    count = len(base)
    turns = ceil(degree / count) + 2
    numbers = np.arange((2 * turns + 1) * count - degree - 1) - turns * count + degree
    return lifted[numbers % count], turns
