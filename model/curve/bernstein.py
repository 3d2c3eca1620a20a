"""Polynomials in Bernstein form: values, products, powers of t, and their real roots in [0, 1].

A polynomial of degree n is its coefficients (..., n + 1); see Farouki, "The Bernstein polynomial basis: a centennial
retrospective" (2012), for the forms and for why they are the well-conditioned ones on [0, 1].
"""

from __future__ import annotations

from functools import cache
from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

EPSILON = float(np.finfo(float).eps)
DEPTH = 52
"""How often an interval is halved at most while roots are told apart."""
STEPS = 60
"""Steps of the bracketed Newton iteration; bisection alone would need as many."""


@cache
def binomials(degree: int) -> Floats:
    """(degree + 1,) binomial coefficients; read-only."""
    row = np.array([comb(degree, i) for i in range(degree + 1)], float)
    row.flags.writeable = False
    return row


def basis(degree: int, t: ArrayLike) -> Floats:
    """Values (*t.shape, degree + 1) of the Bernstein polynomials: non-negative in [0, 1], their sum 1 but for rounding.

    The last axis is a view of rows that lie one after the other in memory.
    """
    t = np.asarray(t, float)
    rows = np.empty((degree + 1, *t.shape))
    rows[0] = 1.0
    for i in range(1, degree + 1):
        np.multiply(rows[i - 1], t, out=rows[i, ...])
    if degree:
        s = 1.0 - t
        power = s.copy()
        for i in range(degree - 1, -1, -1):
            rows[i] *= power
            if 0 < i < degree:
                rows[i] *= comb(degree, i)
            if i:
                power *= s
    return np.moveaxis(rows, 0, -1)


def value(coefficients: ArrayLike, t: ArrayLike) -> Floats:
    """The value of each polynomial (..., n + 1) at its own t (...), broadcast."""
    coefficients = np.asarray(coefficients, float)
    return (basis(coefficients.shape[-1] - 1, t) * coefficients).sum(-1)


def derivative(coefficients: ArrayLike) -> Floats:
    """Coefficients (..., n) of the derivative; (..., 1) zeros for a constant."""
    coefficients = np.asarray(coefficients, float)
    degree = coefficients.shape[-1] - 1
    return degree * np.diff(coefficients, axis=-1) if degree else np.zeros_like(coefficients)


def product(first: ArrayLike, second: ArrayLike) -> Floats:
    """Coefficients (..., m + n + 1) of the product of polynomials (..., m + 1) and (..., n + 1), broadcast."""
    first, second = np.asarray(first, float), np.asarray(second, float)
    m, n = first.shape[-1] - 1, second.shape[-1] - 1
    a, b = first * binomials(m), second * binomials(n)
    made = np.zeros((*np.broadcast_shapes(a.shape[:-1], b.shape[:-1]), m + n + 1))
    for i in range(m + 1):
        made[..., i : i + n + 1] += a[..., i : i + 1] * b
    return made / binomials(m + n)


def halves(coefficients: Floats) -> tuple[Floats, Floats]:
    """Coefficients (..., n + 1) of the polynomial on [0, 1/2] and on [1/2, 1] (de Casteljau 1959)."""
    left, right = np.empty_like(coefficients), np.empty_like(coefficients)
    row = coefficients
    for i in range(coefficients.shape[-1]):
        left[..., i] = row[..., 0]
        right[..., -1 - i] = row[..., -1]
        row = 0.5 * (row[..., :-1] + row[..., 1:])
    return left, right


def roots(coefficients: ArrayLike) -> tuple[Numbers, Floats]:
    """All real roots in [0, 1] of polynomials (k, n + 1): the polynomial of each (r,) and t (r,), both ascending.

    Intervals are halved until the coefficients change sign once, which isolates a root (Lane and Riesenfeld 1981),
    or all of them are rounding; the isolated ones are bracketed Newton steps. All intervals of all polynomials go
    together. A multiple root comes once, as the root of the derivative in which it is a simple one. A polynomial that
    is 0 throughout has none.
    """
    given = np.asarray(coefficients, float)
    scale = np.abs(given).max(-1, initial=0.0)
    rows = np.flatnonzero(scale > 0.0)
    pieces = given[rows] / scale[rows, None]
    if given.shape[-1] <= 3:
        return _of_quadratics(rows, pieces)
    noise = 2.0 * EPSILON * given.shape[-1]
    unit = np.zeros((len(given), given.shape[-1]))
    unit[rows] = pieces
    starts, width = np.zeros(len(rows)), 1.0
    found_rows: list[Numbers] = []
    found: list[Floats] = []
    for depth in range(DEPTH + 1):
        low, high = pieces.min(-1), pieces.max(-1)
        open_ = (low <= noise) & (high >= -noise)
        blank = open_ & (np.maximum(-low, high) <= noise)
        if depth == DEPTH:
            blank = open_
        found_rows.append(rows[blank])
        found.append(_multiple(unit[rows[blank]], starts[blank] + 0.5 * width, noise))
        keep = open_ & ~blank
        rows, pieces, starts, low, high = rows[keep], pieces[keep], starts[keep], low[keep], high[keep]
        if not len(rows):
            break
        signs = np.where(np.abs(pieces) <= noise, 0, np.sign(pieces))
        alone = (np.abs(np.diff(signs, axis=-1)).sum(-1) == 2) & (signs[:, 0] * signs[:, -1] < 0)
        found_rows.append(rows[alone])
        found.append(_bracketed(unit[rows[alone]], starts[alone], starts[alone] + width))
        rows, pieces, starts = rows[~alone], pieces[~alone], starts[~alone]
        left, right = halves(pieces)
        width *= 0.5
        rows, pieces = np.concatenate([rows, rows]), np.concatenate([left, right])
        starts = np.concatenate([starts, starts + width])
    return _distinct(np.concatenate(found_rows), np.concatenate(found), unit)


def _of_quadratics(rows: Numbers, coefficients: Floats) -> tuple[Numbers, Floats]:
    if coefficients.shape[-1] == 1:
        return rows[:0], np.zeros(0)
    first, last = coefficients[:, 0], coefficients[:, -1]
    middle = coefficients[:, 1] if coefficients.shape[-1] == 3 else 0.5 * (first + last)
    a, b = first - 2.0 * middle + last, first - middle  # a t^2 - 2 b t + first
    inside = b * b - a * first
    # What is below 0 by rounding alone touches the axis.
    inside = np.where(np.abs(inside) <= 4.0 * EPSILON * b * b, 0.0, inside)
    straight = np.abs(a) <= 2.0 * EPSILON
    with np.errstate(divide="ignore", invalid="ignore"):
        sum_ = b + np.copysign(np.sqrt(inside), b)
        t = np.column_stack([first / sum_, np.where(straight | (inside == 0.0), np.nan, sum_ / a)])
    slack = 4.0 * EPSILON
    at, which = np.nonzero((t >= -slack) & (t <= 1.0 + slack))
    values = np.clip(t[at, which], 0.0, 1.0)
    order = np.lexsort([values, at])
    return rows[at[order]], values[order]


def _bracketed(coefficients: Floats, low: Floats, high: Floats) -> Floats:
    """The one root of each polynomial in its interval, where its sign changes: Newton, halving where that leaves it."""
    slopes = derivative(coefficients)
    rising = value(coefficients, high) > value(coefficients, low)
    t = 0.5 * (low + high)
    for _ in range(STEPS if len(t) else 0):
        f = value(coefficients, t)
        below = (f < 0.0) == rising
        low, high = np.where(below, t, low), np.where(below, high, t)
        with np.errstate(divide="ignore", invalid="ignore"):
            stepped = t - f / value(slopes, t)
        inside = (stepped >= low) & (stepped <= high)
        moved = np.where(f == 0.0, t, np.where(inside, stepped, 0.5 * (low + high)))
        if (np.abs(moved - t) <= EPSILON * np.abs(t)).all():
            return moved
        t = moved
    return t


def _multiple(coefficients: Floats, t: Floats, noise: float) -> Floats:
    """Roots near t (k,) where polynomials are rounding: of the highest derivative whose root is theirs, too."""
    slopes = derivative(coefficients)
    for order in range(2, coefficients.shape[-1]):
        bends = derivative(slopes)
        moved = t
        for _ in range(4 if len(t) else 0):
            with np.errstate(divide="ignore", invalid="ignore"):
                moved = moved - value(slopes, moved) / value(bends, moved)
        near = (np.abs(moved - t) <= 8.0 * noise ** (1.0 / order)) & (moved >= -noise) & (moved <= 1.0 + noise)
        moved = np.clip(np.where(near, moved, t), 0.0, 1.0)
        t = np.where(np.abs(value(coefficients, moved)) <= 2.0 * noise, moved, t)
        slopes = bends
    return t


def _distinct(rows: Numbers, t: Floats, coefficients: Floats) -> tuple[Numbers, Floats]:
    """Roots in order; neighbours between which the polynomial is rounding are one, in their middle."""
    order = np.lexsort([t, rows])
    rows, t = rows[order], t[order]
    if len(t) < 2:
        return rows, t
    steps = np.linspace(0.0, 1.0, 5)[1:-1]
    between = t[:-1, None] + steps * np.diff(t)[:, None]
    small = np.abs(value(coefficients[rows[:-1], None], between)).max(-1) <= 8.0 * EPSILON * coefficients.shape[-1]
    same = (np.diff(rows) == 0) & (small | (np.diff(t) <= 4.0 * EPSILON))
    firsts = np.flatnonzero(np.concatenate([[True], ~same]))
    counts = np.diff(np.append(firsts, len(t)))
    return rows[firsts], np.add.reduceat(t, firsts) / counts
