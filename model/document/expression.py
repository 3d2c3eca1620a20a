"""Arithmetic expressions that may stand in any number field: `width / 2 + 3`, `2 in`, `sqrt(a**2 + b**2)`."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from .errors import Refusal

if TYPE_CHECKING:
    from .document import Parameter

MAX_LENGTH = 1000
MAX_DEPTH = 60

# Lengths are millimetres and angles degrees, so a unit is a factor.
UNITS = {
    "mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "in": 25.4, "inch": 25.4, "ft": 304.8,
    "deg": 1.0, "rad": 180 / math.pi,
}  # fmt: skip
_UNIT = re.compile(r"(?<![\w.])((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(" + "|".join(UNITS) + r")\b(?!\s*\()")


def _power(base: float, exponent: float) -> float:
    if abs(exponent) > 1000:
        raise OverflowError
    result = base**exponent
    if isinstance(result, complex):
        raise ValueError("a root of a negative number")
    return result


_BINARY: dict[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: _power,
}
_COMPARE: dict[type, Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


def _degrees(function: Callable[[float], float]) -> Callable[[float], float]:
    """Sines of whole right angles come out exact, as a draughtsman expects."""

    def of_degrees(angle: float) -> float:
        result = function(math.radians(angle))
        return float(round(result)) if angle % 90 == 0 and abs(result) < 2 else result

    return of_degrees


FUNCTIONS: dict[str, Callable[..., float]] = {
    "abs": abs, "min": min, "max": max, "round": round, "floor": math.floor, "ceil": math.ceil,
    "sqrt": math.sqrt, "hypot": math.hypot, "exp": math.exp, "log": math.log,
    "sin": _degrees(math.sin), "cos": _degrees(math.cos), "tan": lambda a: math.tan(math.radians(a)),
    "asin": lambda x: math.degrees(math.asin(x)), "acos": lambda x: math.degrees(math.acos(x)),
    "atan": lambda x: math.degrees(math.atan(x)), "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
}  # fmt: skip
CONSTANTS = {"pi": math.pi, "tau": math.tau}
RESERVED = frozenset(FUNCTIONS) | frozenset(CONSTANTS) | frozenset(UNITS)


@dataclass(frozen=True, slots=True)
class Expression:
    """The text of an expression, as the user wrote it; its syntax is checked when it is made.

    `declares` holds the parameters that a script declared on the way to it; they take no part in equality.
    """

    text: str
    declares: tuple[Parameter, ...] = field(default=(), compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", self.text.strip())
        _parse(self.text)

    def __str__(self) -> str:
        return self.text

    def __float__(self) -> float:
        raise Refusal(f"“{self.text}” has no value before the document is resolved")

    def names(self) -> frozenset[str]:
        """The parameters that the expression asks for."""
        nodes = ast.walk(_parse(self.text))
        return frozenset(n.id for n in nodes if isinstance(n, ast.Name) and n.id not in RESERVED)

    def evaluate(self, values: Mapping[str, float]) -> float:
        """The number, in millimetres or degrees. Raises Refusal in the user's words."""
        try:
            result = float(_value(_parse(self.text), values))
        except Refusal as refusal:
            raise Refusal(f"“{self.text}”: {refusal}") from None
        except ZeroDivisionError:
            raise Refusal(f"“{self.text}” divides by zero") from None
        except OverflowError:
            raise Refusal(f"“{self.text}” is too large a number") from None
        except (ValueError, TypeError) as error:
            raise Refusal(f"“{self.text}” has no value: {error}") from None
        if not math.isfinite(result):
            raise Refusal(f"“{self.text}” is not a finite number")
        return result

    def _joined(self, sign: str, other: object, swapped: bool = False) -> Expression:
        if isinstance(other, Expression):
            text, declares = _operand(other.text), other.declares
        elif isinstance(other, int | float):
            text, declares = _operand(repr(float(other)).removesuffix(".0")), ()
        else:
            return NotImplemented
        left, right = (text, _operand(self.text)) if swapped else (_operand(self.text), text)
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

    def __neg__(self) -> Expression:
        return Expression(f"-{_operand(self.text)}", self.declares)


Number = float | Expression


def _operand(text: str) -> str:
    return text if re.fullmatch(r"[\w.]+", text) else f"({text})"


@lru_cache(maxsize=4096)
def _parse(text: str) -> ast.expr:
    if not text:
        raise Refusal("a number or an expression is needed here")
    if len(text) > MAX_LENGTH:
        raise Refusal(f"an expression may have {MAX_LENGTH} characters, this one has {len(text)}")
    source = _UNIT.sub(lambda found: f"({found[1]}*{UNITS[found[2]]!r})", text)
    try:
        tree = ast.parse(source, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise Refusal(f"“{text}” cannot be read as a number or an expression") from None
    _check(tree, text)
    return tree


def _check(tree: ast.expr, text: str) -> None:
    """White-list: numbers, names, arithmetic, comparison in a conditional, and calls of FUNCTIONS."""
    stack: list[tuple[ast.AST, int]] = [(tree, 0)]
    while stack:
        node, depth = stack.pop()
        if depth > MAX_DEPTH:
            raise Refusal(f"“{text[:40]}…” is nested too deeply")
        match node:
            case ast.Constant(value=bool()):
                raise Refusal(f"“{text}”: write 1 or 0")
            case ast.Constant(value=int() | float() as value):
                if isinstance(value, int) and value.bit_length() > 1000:
                    raise Refusal(f"“{text[:40]}…” holds too large a number")
                continue
            case ast.Name():
                continue
            case ast.BinOp(op=op) if type(op) in _BINARY:
                stack += [(node.left, depth + 1), (node.right, depth + 1)]
            case ast.UnaryOp(op=ast.UAdd() | ast.USub(), operand=operand):
                stack.append((operand, depth + 1))
            case ast.IfExp():
                stack += [(node.test, depth + 1), (node.body, depth + 1), (node.orelse, depth + 1)]
            case ast.Compare(ops=[op], comparators=[right]) if type(op) in _COMPARE:
                stack += [(node.left, depth + 1), (right, depth + 1)]
            case ast.Call(func=ast.Name(id=name), keywords=[]):
                if name not in FUNCTIONS:
                    raise Refusal(f"“{text}”: there is no function {name}; known are {', '.join(sorted(FUNCTIONS))}")
                stack += [(argument, depth + 1) for argument in node.args]
            case _:
                raise Refusal(f"“{text}” holds something that is not arithmetic")


def _value(node: ast.expr, values: Mapping[str, float]) -> float:
    # Depth is bounded by _check.
    match node:
        case ast.Constant(value=value):
            return float(value)  # type: ignore[arg-type]
        case ast.Name(id=name):
            if name in values:
                return values[name]
            if name in CONSTANTS:
                return CONSTANTS[name]
            raise Refusal(f"there is no parameter called {name}")
        case ast.BinOp(left=left, op=op, right=right):
            return _BINARY[type(op)](_value(left, values), _value(right, values))
        case ast.UnaryOp(op=op, operand=operand):
            value = _value(operand, values)
            return -value if isinstance(op, ast.USub) else value
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _value(body if _value(test, values) else orelse, values)
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return float(_COMPARE[type(op)](_value(left, values), _value(right, values)))
        case ast.Call(func=ast.Name(id=name), args=args):
            return FUNCTIONS[name](*(_value(a, values) for a in args))
    raise Refusal("this is not arithmetic")


def number(value: object, what: str) -> Number:
    """`value` as a finite float or an Expression; text is read as an expression. Raises Refusal naming `what`."""
    if isinstance(value, Expression):
        return value
    if isinstance(value, str):
        try:
            return float(value) + 0.0 if math.isfinite(float(value)) else _not_finite(value, what)
        except ValueError:
            pass
        try:
            return Expression(value)
        except Refusal as refusal:
            raise Refusal(f"{what}: {refusal}") from None
    if isinstance(value, bool):
        raise Refusal(f"{what} must be a number, not {value}")
    try:
        result = float(value) + 0.0  # type: ignore[arg-type]  # + 0.0 makes -0.0 and 0.0 the same value
    except (TypeError, ValueError, OverflowError):
        raise Refusal(f"{what} must be a number, not {value!r:.60}") from None
    return result if math.isfinite(result) else _not_finite(value, what)


def _not_finite(value: object, what: str) -> float:
    raise Refusal(f"{what} must be a finite number, not {value}")


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
