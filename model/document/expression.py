"""Arithmetic expressions that may stand in any number field: `width / 2 + 3`, `2 in`, `sqrt(a**2 + b**2)`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from numbers import Real
from typing import TYPE_CHECKING, Any

from .arithmetic import CONSTANTS, FUNCTIONS, RESERVED, UNITS, binding, names_in, parse, reckon, renamed
from .errors import Refusal

if TYPE_CHECKING:
    from .document import Parameter

__all__ = ["CONSTANTS", "FUNCTIONS", "RESERVED", "UNITS", "Expression", "Number", "expressions_in", "number",
           "resolved", "symbolic", "vector"]  # fmt: skip
_BINDING = {"+": 1, "-": 1, "*": 2, "/": 2, "//": 2, "%": 2, "**": 3}


@dataclass(frozen=True, slots=True)
class Expression:
    """The text of an expression, as the user wrote it; its syntax is checked when it is made.

    `declares` holds the parameters that a script declared on the way to it; they take no part in equality.
    """

    text: str
    declares: tuple[Parameter, ...] = field(default=(), compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", self.text.strip())
        parse(self.text)

    def __str__(self) -> str:
        return self.text

    def __float__(self) -> float:
        raise Refusal(f"“{self.text}” has no value before the document is resolved")

    def names(self) -> frozenset[str]:
        """The parameters that the expression asks for."""
        return names_in(self.text)

    def evaluate(self, values: Mapping[str, float]) -> float:
        """The number, in millimetres or degrees. Raises Refusal in the user's words."""
        return reckon(self.text, values)

    def renamed(self, old: str, new: str) -> Expression:
        """The same with the parameter `old` called `new`."""
        return self if old not in self.names() else Expression(renamed(self.text, old, new))

    def _joined(self, sign: str, other: object, swapped: bool = False) -> Expression:
        if isinstance(other, Expression):
            text, declares = other.text, other.declares
        elif isinstance(other, Real) and not isinstance(other, bool):
            value = float(other)
            if not math.isfinite(value):
                raise Refusal(f"“{self.text}” cannot be reckoned with {value}")
            text, declares = repr(value).removesuffix(".0"), ()
        else:
            return NotImplemented
        left, right = (text, self.text) if swapped else (self.text, text)
        tightness = _BINDING[sign]
        left = left if binding(left) >= tightness + (sign == "**") else f"({left})"
        right = right if binding(right) > tightness else f"({right})"
        return Expression(
            f"{left} {sign} {right}", self.declares + tuple(p for p in declares if p not in self.declares)
        )

    def __add__(self, other: object) -> Expression:
        return self._joined("+", other)

    def __radd__(self, other: object) -> Expression:
        return self._joined("+", other, swapped=True)

    def __sub__(self, other: object) -> Expression:
        return self._joined("-", other)

    def __rsub__(self, other: object) -> Expression:
        return self._joined("-", other, swapped=True)

    def __mul__(self, other: object) -> Expression:
        return self._joined("*", other)

    def __rmul__(self, other: object) -> Expression:
        return self._joined("*", other, swapped=True)

    def __truediv__(self, other: object) -> Expression:
        return self._joined("/", other)

    def __rtruediv__(self, other: object) -> Expression:
        return self._joined("/", other, swapped=True)

    def __pow__(self, other: object) -> Expression:
        return self._joined("**", other)

    def __rpow__(self, other: object) -> Expression:
        return self._joined("**", other, swapped=True)

    def __floordiv__(self, other: object) -> Expression:
        return self._joined("//", other)

    def __mod__(self, other: object) -> Expression:
        return self._joined("%", other)

    def __neg__(self) -> Expression:
        return Expression(f"-{self.text}" if binding(self.text) > 2 else f"-({self.text})", self.declares)


Number = float | Expression


def number(value: object, what: str) -> Number:
    """`value` as a finite float or an Expression; text is read as an expression. Raises Refusal naming `what`."""
    if isinstance(value, Expression):
        try:
            return number(float(value.text), what)  # a plain number is no expression
        except ValueError:
            return value
    if isinstance(value, str):
        try:
            plain = float(value)
        except ValueError:
            try:
                return Expression(value)
            except Refusal as refusal:
                raise Refusal(f"{what}: {refusal}") from None
        return number(plain, what)
    if isinstance(value, bool | bytes | bytearray):
        raise Refusal(f"{what} must be a number, not {value!r:.60}")
    try:
        result = float(value) + 0.0  # type: ignore[arg-type]  # + 0.0 makes -0.0 and 0.0 the same value
    except OverflowError:
        raise Refusal(f"{what} is too large a number") from None
    except (TypeError, ValueError):
        raise Refusal(f"{what} must be a number, not {value!r:.60}") from None
    if not math.isfinite(result):
        raise Refusal(f"{what} must be a finite number, not {result}")
    return result


def vector(value: object, what: str, length: int = 3) -> tuple[Number, ...]:
    """`length` numbers as a tuple. Raises Refusal naming `what`."""
    try:
        items = tuple(value)  # type: ignore[arg-type]
    except TypeError:
        raise Refusal(f"{what} must be {length} numbers, not {value!r:.60}") from None
    if isinstance(value, str) or len(items) != length:
        raise Refusal(f"{what} must be {length} numbers, not {value!r:.60}")
    return tuple(number(item, what) for item in items)


def resolved(value: Any, values: Mapping[str, float]) -> Any:
    """A field's value with every expression in it (and in tuples of it) replaced by its number."""
    if isinstance(value, Expression):
        return value.evaluate(values)
    if isinstance(value, tuple):
        return tuple(resolved(item, values) for item in value)
    return value


def symbolic(value: object) -> bool:
    """Whether a field's value holds an expression."""
    return isinstance(value, Expression) or (isinstance(value, tuple) and any(symbolic(item) for item in value))


def expressions_in(value: object) -> Iterator[Expression]:
    """The expressions in a field's value, or in a list of values."""
    if isinstance(value, Expression):
        yield value
    elif isinstance(value, tuple | list):
        for item in value:
            yield from expressions_in(item)
