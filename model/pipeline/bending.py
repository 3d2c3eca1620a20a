"""Places brought onto curved surfaces, where they cross others, and where a surface turns away from the eye.

All by Newton's method with the least step (Hartley and Zisserman 2004, appendix 6): to second order in the distance.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .round_surfaces import RoundSurfaces

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]
Conditions = Callable[[Floats, Numbers], tuple[Floats, Floats]]
"""Of places (n, 3), those of the rows (n,), the values (n, k) that are to be 0 and their gradients (n, k, 3)."""

STEPS = 12
DONE = 1e-13
"""Of the size of the model: a step below it is the last one."""
REACHED = 1e-9
"""Of the size of the model: within so much of all surfaces a place has reached them."""
DAMPING = 1e-12
"""Of the squared gradients, so that surfaces that touch have a least step too."""


@dataclass(frozen=True, slots=True, eq=False)
class Eye:
    """Where it is, or with `parallel` the direction towards it; (3,)."""

    place: Floats
    parallel: bool

    def rays(self, places: Floats) -> Floats:
        """(n, 3) from places to the eye."""
        return np.broadcast_to(self.place, places.shape) if self.parallel else self.place - places


def bent(places: Floats, reach: Floats, size: float, conditions: Conditions) -> tuple[Floats, NDArray[np.bool_]]:
    """The places (n, 3) moved to where the conditions hold, and (n,) which got there, none farther than `reach` (n,)
    mm; the others stay. `size` is that of the model."""
    here = places.copy()
    rows = np.arange(len(places))
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            if not len(rows):
                break
            values, slopes = conditions(here[rows], rows)
            square = slopes @ slopes.transpose(0, 2, 1)
            diagonal = np.arange(square.shape[1])
            own = square[:, diagonal, diagonal]
            square[:, diagonal, diagonal] = np.where(own > 0.0, (1.0 + DAMPING) * own, 1.0)
            try:
                step = -np.einsum("nki,nk->ni", slopes, np.linalg.solve(square, values[:, :, None])[:, :, 0])
            except np.linalg.LinAlgError:
                step = -np.einsum("nki,nk->ni", slopes, np.einsum("nkj,nj->nk", np.linalg.pinv(square), values))
            here[rows] += np.where(np.isfinite(step).all(axis=1)[:, None], step, 0.0)
            rows = rows[np.linalg.norm(step, axis=1) > DONE * size]
        every = np.arange(len(places))
        values, slopes = conditions(here, every)
        away = np.abs(values) / np.maximum(np.linalg.norm(slopes, axis=2), 1e-300)
        there = (np.where(values == 0.0, 0.0, away) <= REACHED * size).all(axis=1)
        there &= np.linalg.norm(here - places, axis=1) <= reach
    return np.where(there[:, None], here, places), there


def on_surfaces(surfaces: RoundSurfaces, planes: Floats, which: Numbers) -> Conditions:
    """To lie on each of the surfaces `which` (n, k): below `surfaces.count` a curved one, from there on one of the
    planes (p, 4), unit normal and offset; -1: none."""
    count = surfaces.count

    def conditions(places: Floats, rows: Numbers) -> tuple[Floats, Floats]:
        wanted = which[rows]
        values = np.zeros(wanted.shape)
        slopes = np.zeros((*wanted.shape, 3))
        row, slot = np.nonzero((wanted >= 0) & (wanted < count))
        values[row, slot], slopes[row, slot] = surfaces.gradients(places[row], wanted[row, slot])
        row, slot = np.nonzero(wanted >= count)
        flat = planes[wanted[row, slot] - count]
        values[row, slot] = np.einsum("ni,ni->n", flat[:, :3], places[row]) - flat[:, 3]
        slopes[row, slot] = flat[:, :3]
        return values, slopes

    return conditions


def turning_away(surfaces: RoundSurfaces, which: Numbers, eye: Eye, size: float) -> Conditions:
    """That the surface `which` (n,) is seen edge-on at a place: its gradient is at right angles to the ray."""
    step = 1e-5 * size

    def conditions(places: Floats, rows: Numbers) -> tuple[Floats, Floats]:
        wanted = which[rows]
        rays = eye.rays(places)
        lengths = np.maximum(np.linalg.norm(rays, axis=1, keepdims=True), 1e-300)
        along = rays / lengths
        _, slope = surfaces.gradients(places, wanted)
        _, before = surfaces.gradients(places - step * along, wanted)
        _, after = surfaces.gradients(places + step * along, wanted)
        change = (after - before) / (2.0 * step)
        if not eye.parallel:
            change = change - slope / lengths
        return np.einsum("ni,ni->n", slope, along)[:, None], change[:, None]

    return conditions


def both(one: Conditions, other: Conditions) -> Conditions:
    def conditions(places: Floats, rows: Numbers) -> tuple[Floats, Floats]:
        pairs = one(places, rows), other(places, rows)
        values, slopes = zip(*pairs, strict=True)
        return np.concatenate(values, axis=1), np.concatenate(slopes, axis=1)

    return conditions
