"""How placements take one map more and stay readable: steps that join, turns before the position, expressions kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..document.expression import Expression, Number, symbolic
from ..document.placement import Affine, Move, Placement, Scale, Step, Turn, axis_turn

Matrix = NDArray[np.float64]

EXACT = 1e-12
"""What is smaller, beside the numbers that it came from, is nothing."""
LONGEST = 4
"""Turns, scalings and matrices in a row; more of them become one matrix."""


def combined(matrix: Matrix, numbers: Sequence[Number]) -> tuple[Number, ...]:
    """`matrix` (3, 3) times three numbers, which may be expressions."""
    if not symbolic(tuple(numbers)):
        return tuple(tidy(value) for value in matrix @ np.array(numbers, dtype=np.float64))
    rows: list[Number] = []
    for row in matrix:
        total: Number = 0.0
        for factor, value in zip((tidy(factor) for factor in row), numbers, strict=True):
            if factor == 0.0 or value == 0.0:
                continue
            term = value if factor == 1.0 else -value if factor == -1.0 else factor * value
            total = term if total == 0.0 else total + term
        rows.append(total)
    return tuple(rows)


def shifted(placement: Placement, numbers: Sequence[Number]) -> Placement:
    """The placement followed by a move. It joins a move that comes last, unless two numbers would have to be added of
    which one is an expression."""
    by = tuple(numbers)
    steps = placement.steps
    if not any(by) or not steps or not isinstance(steps[-1], Move):
        return placement if not any(by) else Placement((*steps, Move(by)))
    last = steps[-1].numbers
    total: list[Number] = []
    for a, b in zip(last, by, strict=True):
        if isinstance(a, Expression) or isinstance(b, Expression):
            if a != 0.0 and b != 0.0:
                return Placement((*steps, Move(by)))
            total.append(a if b == 0.0 else b)
        else:
            total.append(tidy(a + b))
    return Placement((*steps[:-1], Move(tuple(total))) if any(total) else steps[:-1])


def followed(
    placement: Placement, step: Step, centre: Sequence[float] | None, values: Mapping[str, float]
) -> Placement:
    """The placement followed by a map that fixes the point `centre`; None: the point where the own origin lies.

    `step` is the map about the origin. Where expressions stand in the placement its present values count.
    """
    if centre is not None and symbolic(step.numbers):
        away = shifted(placement, tuple(-float(c) for c in centre))
        return shifted(Placement((*away.steps, step)), tuple(map(float, centre)))
    steps = list(placement.steps)
    moves: list[Step] = []
    while steps and isinstance(steps[-1], Move):
        moves.insert(0, steps.pop())
    known = Placement(tuple(steps)).resolve(values)
    start = known.matrix()[:, 3]
    reach = max((abs(n) for s in known.steps for n in s.numbers if isinstance(n, float)), default=0.0)
    fixed = bool(np.abs(start).max() <= EXACT * max(1.0, reach))
    if fixed:
        start = np.zeros(3)
    else:
        steps.append(Move(tuple(-float(c) for c in start)))
    steps = _joined(steps, step)
    rest = start
    if centre is not None:
        position = sum((np.array(m.numbers) for m in Placement(tuple(moves)).resolve(values).steps), np.zeros(3))
        middle = np.array(centre, dtype=np.float64)
        rest = step.matrix()[:, :3] @ (start + position - middle) + middle - position
    return shifted(Placement((*steps, *moves)), tuple(tidy(c) for c in rest))


def linear_step(linear: Matrix) -> Step | None:
    """One step for a (3, 3) map: a turn or a scaling where it is one, a matrix elsewhere; None for no change."""
    size = float(np.abs(linear).max())
    if np.abs(linear - np.diag(np.diag(linear))).max() <= EXACT * size:
        factors = tuple(tidy(f) for f in np.diag(linear))
        return None if factors == (1.0, 1.0, 1.0) else Scale(factors)
    if np.abs(linear @ linear.T - np.eye(3)).max() <= 10 * EXACT and np.linalg.det(linear) > 0:
        return Turn(turn_angles(linear))
    return Affine(tuple(np.column_stack((linear, np.zeros(3))).ravel()))


def turn_angles(rotation: Matrix) -> tuple[float, float, float]:
    """Degrees about x, then y, then z (fixed axes) of a (3, 3) rotation.

    z and y are taken after x has been turned back, so that no digits are lost where y is near 90 degrees.
    """
    flat = np.hypot(rotation[2, 1], rotation[2, 2]) <= EXACT
    x = 0.0 if flat else float(np.degrees(np.arctan2(rotation[2, 1], rotation[2, 2])))
    rest = rotation @ axis_turn(0, x).T
    y = float(np.degrees(np.arctan2(-rest[2, 0], rest[2, 2])))
    z = float(np.degrees(np.arctan2(-rest[0, 1], rest[1, 1])))
    return tidy(x), tidy(y), tidy(z)


def led(steps: tuple[Step, ...], step: Scale) -> list[Step]:
    """The steps after a scaling along the node's own axes."""
    if steps and isinstance(steps[0], Scale) and not symbolic((*steps[0].numbers, *step.numbers)):
        return [*(_one(steps[0], step) or []), *steps[1:]]
    return [step, *steps] if any(factor != 1.0 for factor in step.numbers) else list(steps)


def _joined(steps: list[Step], step: Step) -> list[Step]:
    """The steps followed by one that keeps the origin, in as few steps as stay readable."""
    if not symbolic(step.numbers):
        first = len(steps)
        while first and not isinstance(steps[first - 1], Move) and not symbolic(steps[first - 1].numbers):
            first -= 1
        run = steps[first:]
        if isinstance(step, Scale) and len(set(step.numbers)) == 1:  # commutes with all that keep the origin
            for i, other in enumerate(run):
                if isinstance(other, Scale):
                    run[i : i + 1] = _one(other, step) or []
                    return steps[:first] + run
        if run and (one := _one(run[-1], step)) is not None:
            run[-1:] = one
        elif len(run) < LONGEST:
            run.append(step)
        else:
            whole = step.matrix() @ np.vstack((Placement(tuple(run)).matrix(), (0, 0, 0, 1)))
            plain = linear_step(whole[:, :3]) if not whole[:, 3].any() else Affine(tuple(whole.ravel()))
            run = [] if plain is None else [plain]
        return steps[:first] + run
    if steps and isinstance(step, Turn) and isinstance(steps[-1], Turn) and (one := _slots(steps[-1], step)):
        return [*steps[:-1], one]
    return [*steps, step]


def _one(last: Step, step: Step) -> list[Step] | None:
    """Two steps in a row as one, or as none where they take each other back; None where they stay two."""
    if isinstance(last, Scale) and isinstance(step, Scale):
        factors = tuple(tidy(a * b) for a, b in zip(last.numbers, step.numbers, strict=True))  # type: ignore[operator]
        return [] if factors == (1.0, 1.0, 1.0) else [Scale(factors)]
    if isinstance(last, Turn) and isinstance(step, Turn):
        joined = _slots(last, step)
        if joined is None:
            joined = Turn(turn_angles(step.matrix()[:, :3] @ last.matrix()[:, :3]))
        return [joined] if any(joined.numbers) else []
    if isinstance(last, Affine) or isinstance(step, Affine):
        linear = step.matrix()[:, :3]
        if last.matrix()[:, 3].any():
            return [Affine(tuple((linear @ last.matrix()).ravel()))]
        one = linear_step(linear @ last.matrix()[:, :3])
        return [] if one is None else [one]
    return None


def _slots(last: Turn, step: Turn) -> Turn | None:
    """Two turns as one where that only adds angles: x comes before y, y before z."""
    used = [i for i, n in enumerate(last.numbers) if n != 0.0]
    new = [i for i, n in enumerate(step.numbers) if n != 0.0]
    if used and new and max(used) > min(new):
        return None
    numbers: list[Number] = []
    for a, b in zip(last.numbers, step.numbers, strict=True):
        if a == 0.0 or b == 0.0:
            numbers.append(b if a == 0.0 else a)
        elif isinstance(a, Expression) or isinstance(b, Expression):
            return None
        else:
            numbers.append(tidy((a + b + 180.0) % 360.0 - 180.0) if abs(a + b) > 180.0 else tidy(a + b))
    return Turn(tuple(numbers))


def tidy(value: float) -> float:
    """Without the last bits that sines and sums leave."""
    return round(float(value), 12) + 0.0
