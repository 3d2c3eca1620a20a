"""Where a node stands: moves, turns, scalings and mirrorings in the order in which they are applied."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from .errors import Refusal
from .expression import Number, resolved, symbolic, vector


@dataclass(frozen=True, slots=True)
class Step:
    """One affine step, given by numbers whose meaning is its kind's."""

    numbers: tuple[Number, ...]
    word: ClassVar[str] = ""
    length: ClassVar[int] = 3

    def __post_init__(self) -> None:
        object.__setattr__(self, "numbers", vector(self.numbers, self.word, self.length))

    def matrix(self) -> NDArray[np.float64]:
        """(3, 4); the numbers must be resolved."""
        raise AssertionError(self.word)

    def inverse(self) -> tuple[Step, ...]:
        """The steps that take this one back; expressions stay expressions. Raises Refusal for one that flattens."""
        raise AssertionError(self.word)


@dataclass(frozen=True, slots=True)
class Move(Step):
    """Translation by (x, y, z) millimetres."""

    word: ClassVar[str] = "move"

    def matrix(self) -> NDArray[np.float64]:
        return np.column_stack((np.eye(3), np.array(self.numbers, dtype=np.float64)))

    def inverse(self) -> tuple[Step, ...]:
        return (Move(tuple(-number for number in self.numbers)),)


@dataclass(frozen=True, slots=True)
class Turn(Step):
    """Rotation by x degrees about the x axis, then y about y, then z about z (all axes fixed)."""

    word: ClassVar[str] = "turn"

    def matrix(self) -> NDArray[np.float64]:
        x, y, z = (axis_turn(axis, float(angle)) for axis, angle in enumerate(self.numbers))  # type: ignore[arg-type]
        return np.column_stack((z @ y @ x, np.zeros(3)))

    def inverse(self) -> tuple[Step, ...]:
        x, y, z = (-number for number in self.numbers)
        single = (Turn((0.0, 0.0, z)), Turn((0.0, y, 0.0)), Turn((x, 0.0, 0.0)))
        return tuple(turn for turn in single if turn.numbers != (0.0, 0.0, 0.0))


@dataclass(frozen=True, slots=True)
class Scale(Step):
    """Scaling by a factor along each axis."""

    word: ClassVar[str] = "scale"

    def matrix(self) -> NDArray[np.float64]:
        return np.column_stack((np.diag(np.array(self.numbers, dtype=np.float64)), np.zeros(3)))

    def inverse(self) -> tuple[Step, ...]:
        if 0.0 in self.numbers:
            raise Refusal("a scale factor is 0: the solid would be flat")
        return (Scale(tuple(1.0 / number for number in self.numbers)),)


@dataclass(frozen=True, slots=True)
class Reflect(Step):
    """Reflection in the plane through the origin with this normal."""

    word: ClassVar[str] = "mirror"

    def matrix(self) -> NDArray[np.float64]:
        normal = unit(self.numbers, "the mirror's normal")
        return np.column_stack((np.eye(3) - 2 * np.outer(normal, normal), np.zeros(3)))

    def inverse(self) -> tuple[Step, ...]:
        return (self,)


@dataclass(frozen=True, slots=True)
class Affine(Step):
    """Any affine map: the twelve numbers of a (3, 4) matrix, row by row."""

    word: ClassVar[str] = "matrix"
    length: ClassVar[int] = 12

    def matrix(self) -> NDArray[np.float64]:
        return np.array(self.numbers, dtype=np.float64).reshape(3, 4)

    def inverse(self) -> tuple[Step, ...]:
        if symbolic(self.numbers):
            raise Refusal("a matrix of expressions cannot be taken back")
        return (Affine(tuple(inverse(self.matrix()).ravel())),)


def moved(x: Any = 0, y: Any = 0, z: Any = 0) -> Move:
    """A move by x, y, z millimetres."""
    return Move((x, y, z))


def turned(x: Any = 0, y: Any = 0, z: Any = 0) -> Turn:
    """A turn by x degrees about x, then y about y, then z about z."""
    return Turn((x, y, z))


def scaled(x: Any = 1, y: Any = None, z: Any = None) -> Scale:
    """A scaling by one factor, or by one for each axis."""
    rest = x if y is None and z is None else 1.0
    return Scale((x, rest if y is None else y, rest if z is None else z))


def affine(matrix: Any) -> Affine:
    """A map by a (3, 4) matrix, or a (4, 4) one whose last row is 0, 0, 0, 1. Raises Refusal."""
    try:
        rows = [list(row) for row in matrix]
    except TypeError:
        rows = []
    if len(rows) not in (3, 4) or any(len(row) != 4 for row in rows):
        raise Refusal("a matrix of 3 rows of 4 numbers is needed")
    if len(rows) == 4 and vector(rows[3], "a matrix's last row", 4) != (0.0, 0.0, 0.0, 1.0):
        raise Refusal("the last row of a (4, 4) matrix must be 0, 0, 0, 1")
    return Affine(tuple(value for row in rows[:3] for value in row))


STEPS: dict[str, type[Step]] = {step.word: step for step in (Move, Turn, Scale, Reflect, Affine)}


@dataclass(frozen=True, slots=True)
class Placement:
    """Steps applied in order, about the origin of the parent."""

    steps: tuple[Step, ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.steps, tuple) or not all(isinstance(step, Step) for step in self.steps):
            raise Refusal("a placement is a tuple of moves, turns, scalings and mirrorings")

    def then(self, step: Step) -> Placement:
        """This placement followed by `step`; two moves in a row become one, and a move by nothing is none."""
        if isinstance(step, Move) and step.numbers == (0.0, 0.0, 0.0):
            return self
        if self.steps and isinstance(step, Move) and isinstance(self.steps[-1], Move):
            last = self.steps[-1]
            if not symbolic(step.numbers) and not symbolic(last.numbers):
                total = tuple(a + b for a, b in zip(last.numbers, step.numbers, strict=True))  # type: ignore[operator]
                return Placement((*self.steps[:-1], Move(total)) if any(total) else self.steps[:-1])
        return Placement((*self.steps, step))

    def moved_to(self, numbers: tuple[Number, ...]) -> Placement:
        """The placement whose last step is this move."""
        steps = self.steps[:-1] if self.steps and isinstance(self.steps[-1], Move) else self.steps
        return Placement(steps if numbers == (0.0, 0.0, 0.0) else (*steps, Move(numbers)))

    @property
    def position(self) -> tuple[Number, ...]:
        """The numbers of a move that comes last; zero where there is none."""
        return self.steps[-1].numbers if self.steps and isinstance(self.steps[-1], Move) else (0.0, 0.0, 0.0)

    def symbolic(self) -> bool:
        return any(symbolic(step.numbers) for step in self.steps)

    def resolve(self, values: Mapping[str, float]) -> Placement:
        if not self.symbolic():
            return self
        return Placement(tuple(type(step)(resolved(step.numbers, values)) for step in self.steps))

    def matrix(self) -> NDArray[np.float64]:
        """The (3, 4) matrix of all steps, read-only; the numbers must be resolved."""
        return _matrix(self)

    def key(self) -> tuple[tuple[str, tuple[Number, ...]], ...]:
        return tuple((step.word, step.numbers) for step in self.steps)


@lru_cache(maxsize=1 << 16)
def _matrix(placement: Placement) -> NDArray[np.float64]:
    result = IDENTITY
    for step in placement.steps:
        result = product(step.matrix(), result)
    result.flags.writeable = False
    return result


def product(outer: NDArray[np.float64], inner: NDArray[np.float64]) -> NDArray[np.float64]:
    """The (3, 4) matrix that applies `inner`, then `outer`."""
    result = outer[:, :3] @ inner
    result[:, 3] += outer[:, 3]
    return result


def inverse(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """The (3, 4) inverse. Raises Refusal for a map that flattens."""
    with np.errstate(all="ignore"):
        if abs(np.linalg.det(matrix[:, :3])) < 1e-300:
            raise Refusal("a scale factor is 0: the solid would be flat")
        linear = np.asarray(np.linalg.inv(matrix[:, :3]), dtype=np.float64)
        return np.column_stack((linear, -linear @ matrix[:, 3]))


def axis_turn(axis: int, degrees: float) -> NDArray[np.float64]:
    """(3, 3) rotation about a coordinate axis, exact at multiples of 90 degrees."""
    quarter, rest = divmod(degrees % 360, 90)
    cos, sin = (np.cos(np.radians(degrees)), np.sin(np.radians(degrees)))
    if rest == 0:
        cos, sin = ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarter) % 4]  # -1e-300 % 360 is 360
    result = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    result[i, i], result[i, j], result[j, i], result[j, j] = cos, -sin, sin, cos
    return result


def turn_about(axis: tuple[float, ...], degrees: float, point: tuple[float, ...] = (0, 0, 0)) -> NDArray[np.float64]:
    """(3, 4) rotation about the line through `point` along `axis` (Rodrigues' formula)."""
    direction = unit(axis, "the axis")
    which = np.flatnonzero(direction)
    if len(which) == 1:
        linear = axis_turn(int(which[0]), degrees * float(direction[which[0]]))
    else:
        x, y, z = direction
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        angle = np.radians(degrees)
        linear = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    centre = np.asarray(point, dtype=np.float64)
    return np.column_stack((linear, centre - linear @ centre))


def unit(numbers: tuple[Number, ...], what: str) -> NDArray[np.float64]:
    """`numbers` as a unit vector. Raises Refusal for the zero vector."""
    direction = np.array(numbers, dtype=np.float64)
    size = float(np.linalg.norm(direction))
    if size == 0:
        raise Refusal(f"{what} must not be 0, 0, 0")
    return np.divide(direction, size)


IDENTITY = np.eye(3, 4)
IDENTITY.flags.writeable = False
