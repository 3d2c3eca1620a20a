"""The basis functions of a B-spline outline and its knots: how often each stands, and how far it can be moved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..document.errors import Refusal
from ..document.outlines import BSpline
from ..spline.bspline import basis
from .paths import spline_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

SAMPLES = 200


@dataclass(frozen=True, slots=True)
class Stack:
    """Knots of one value: its numbers among the outline's knots, and how smooth the curve is there at least.

    `smoothness` k is for C^k: degree less multiplicity. None at an end, and beyond it, where nothing goes on.
    """

    value: float
    numbers: tuple[int, ...]
    smoothness: int | None


@dataclass(frozen=True, slots=True, eq=False)
class Basis:
    """Of a B-spline outline: its own `knots` (k,), the even ones where it has none; those of one turn where closed.

    `values` (m, n) are what its n control points weigh at the parameters `at` (m,), which go over the domain.
    """

    degree: int
    closed: bool
    clamped: bool
    domain: tuple[float, float]
    knots: Floats
    at: Floats
    values: Floats
    stacks: tuple[Stack, ...]

    def stack_of(self, number: int) -> int:
        """The row in `stacks` of the knot with this number."""
        return next(row for row, stack in enumerate(self.stacks) if number in stack.numbers)


def basis_of(node: BSpline) -> Basis:
    """Of a resolved outline. Raises Refusal for what makes no curve."""
    spline = spline_of(node)
    count, degree = len(node.points), spline.degree
    start, end = spline.domain
    knots = spline.knots[degree : degree + count + 1] if node.closed else spline.knots
    inner = knots[(knots >= start) & (knots <= end)]
    at = np.unique(np.concatenate((np.linspace(start, end, SAMPLES), inner)))
    values = basis(spline, at)
    if node.closed:  # the first points are used once more at the end
        around = np.zeros((len(at), count))
        for column in range(values.shape[1]):
            around[:, column % count] += values[:, column]
        values = around
    clamped = not node.closed and spline.clamped
    return Basis(degree, node.closed, clamped, (start, end), knots, at, values, _stacks(knots, degree, node.closed,
                 (start, end)))  # fmt: skip


def _stacks(knots: Floats, degree: int, closed: bool, domain: tuple[float, float]) -> tuple[Stack, ...]:
    values, first, counts = np.unique(knots, return_index=True, return_counts=True)
    made = []
    for value, begin, times in zip(values.tolist(), first.tolist(), counts.tolist(), strict=True):
        inside = closed or domain[0] < value < domain[1]
        made.append(Stack(value, tuple(range(begin, begin + times)), degree - times if inside else None))
    return tuple(made)


def in_order(knots: Floats, targets: Mapping[int, float]) -> list[int]:
    """The numbers of knots that go to other values, so that moved one by one none passes another: those that rise from
    the last, then those that fall from the first."""
    rising = [number for number in sorted(targets, reverse=True) if targets[number] > knots[number]]
    return rising + [number for number in sorted(targets) if targets[number] <= knots[number]]


def reach(node: BSpline, basis: Basis, numbers: tuple[int, ...]) -> tuple[float, float, bool, bool]:
    """How far knots of one stack can be moved: the values of their neighbours, infinite beyond the ends, and whether
    they may come to lie on these."""
    low = float(basis.knots[numbers[0] - 1]) if numbers[0] else -np.inf
    high = float(basis.knots[numbers[-1] + 1]) if numbers[-1] + 1 < len(basis.knots) else np.inf
    return low, high, _holds(node, basis, numbers, low), _holds(node, basis, numbers, high)


def _holds(node: BSpline, basis: Basis, numbers: tuple[int, ...], value: float) -> bool:
    if not np.isfinite(value):
        return False
    knots = basis.knots.copy()
    knots[list(numbers)] = value
    try:
        spline_of(node.with_(knots=tuple(knots.tolist())))
    except Refusal:
        return False
    return True
