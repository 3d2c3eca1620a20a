"""The arithmetic that expressions are written in: its words, its white-list and its reckoning. No eval."""

from __future__ import annotations

import ast
import math
import operator
import re
import unicodedata
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from .errors import Refusal

MAX_LENGTH = 1000
MAX_DEPTH = 60

# Lengths are millimetres and angles degrees, so a unit is a factor.
UNITS = {
    "mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "in": 25.4, "inch": 25.4, "ft": 304.8,
    "deg": 1.0, "rad": 180 / math.pi,
}  # fmt: skip
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_UNIT = re.compile(rf"(?<![\w.])({_NUMBER})\s*({'|'.join(UNITS)})\b(?!\s*\()")
_TOKEN = re.compile(rf"\s*(?:{_NUMBER}(?![\w.])|[^\W\d]\w*|\*\*|//|[<>=!]=|[-+*/%<>(),]|$)")
_NAME = re.compile(r"(?<![\w.])[^\W\d]\w*")


def _power(base: float, exponent: float) -> float:
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
        return float(round(result)) if angle % 90 == 0 else result

    return of_degrees


_sin, _cos = _degrees(math.sin), _degrees(math.cos)


def _round(value: float, digits: float = 0.0) -> float:
    if digits != int(digits) or abs(digits) > 300:
        raise ValueError("the digits of round must be a whole number")
    return round(value, int(digits))


# Everything is reckoned in floats: whole numbers of Python have no bounds, and a power of them takes for ever.
FUNCTIONS: dict[str, Callable[..., float]] = {
    "abs": abs, "min": min, "max": max, "round": _round, "floor": lambda x: float(math.floor(x)),
    "ceil": lambda x: float(math.ceil(x)), "sqrt": math.sqrt, "hypot": math.hypot, "exp": math.exp, "log": math.log,
    "sin": _sin, "cos": _cos, "tan": lambda a: _sin(a) / _cos(a),
    "asin": lambda x: math.degrees(math.asin(x)), "acos": lambda x: math.degrees(math.acos(x)),
    "atan": lambda x: math.degrees(math.atan(x)), "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
}  # fmt: skip
_ARGUMENTS: dict[str, tuple[int, int]] = {
    "min": (2, MAX_LENGTH), "max": (2, MAX_LENGTH), "hypot": (1, MAX_LENGTH), "round": (1, 2), "log": (1, 2),
    "atan2": (2, 2),
}  # fmt: skip
CONSTANTS = {"pi": math.pi, "tau": math.tau}
RESERVED = frozenset(FUNCTIONS) | frozenset(CONSTANTS) | frozenset(UNITS)


def shortened(text: object, length: int = 60) -> str:
    """`text` for a message: a long one is cut."""
    plain = str(text)
    return plain if len(plain) <= length else plain[: length - 1] + "…"


def normal_name(text: str) -> str:
    """A name as Python reads it (Unicode NFKC)."""
    return unicodedata.normalize("NFKC", text)


@lru_cache(maxsize=4096)
def parse(text: str) -> ast.expr:
    """The checked syntax tree of an expression. Raises Refusal."""
    if not text:
        raise Refusal("a number or an expression is needed here")
    if len(text) > MAX_LENGTH:
        raise Refusal(f"an expression may have {MAX_LENGTH} characters, this one has {len(text)}")
    source = _UNIT.sub(lambda found: f"({found[1]}*{UNITS[found[2]]!r})", " ".join(text.split()))
    place = 0
    while place < len(source):
        token = _TOKEN.match(source, place)
        if token is None:
            wrong = source[place:].lstrip()[0]
            hint = "; write ** for a power" if wrong == "^" else ""
            raise Refusal(f"“{shortened(text)}” cannot be read from “{shortened(source[place:].strip(), 20)}” on{hint}")
        place = token.end()
    try:
        tree = ast.parse(source, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise Refusal(f"“{shortened(text)}” cannot be read as a number or an expression") from None
    _check(tree, shortened(text))
    return tree


def _check(tree: ast.expr, text: str) -> None:
    """White-list: numbers, names, arithmetic, comparison in a conditional, and calls of FUNCTIONS."""
    stack: list[tuple[ast.AST, int]] = [(tree, 0)]
    while stack:
        node, depth = stack.pop()
        if depth > MAX_DEPTH:
            raise Refusal(f"“{text}” is nested too deeply")
        match node:
            case ast.Constant(value=bool()):
                raise Refusal(f"“{text}”: write 1 or 0")
            case ast.Constant(value=int() | float() as value):
                if abs(value) > 1e300:
                    raise Refusal(f"“{text}” holds too large a number")
            case ast.Name(id=name):
                if name in FUNCTIONS:
                    raise Refusal(f"“{text}”: {name} is a function; write {name}(…)")
                if name in UNITS:
                    raise Refusal(f"“{text}”: {name} is a unit; it stands behind a plain number, as in 2 {name}")
            case ast.BinOp(op=op) if type(op) in _BINARY:
                # A sum of many is a chain to the left, and no deeper than a sum of two.
                chained = depth if isinstance(node.left, ast.BinOp) else depth + 1
                stack += [(node.left, chained), (node.right, depth + 1)]
            case ast.UnaryOp(op=ast.UAdd() | ast.USub(), operand=operand):
                stack.append((operand, depth + 1))
            case ast.IfExp():
                stack += [(node.test, depth + 1), (node.body, depth + 1), (node.orelse, depth + 1)]
            case ast.Compare(ops=[op], comparators=[right]) if type(op) in _COMPARE:
                stack += [(node.left, depth + 1), (right, depth + 1)]
            case ast.Call(func=ast.Name(id=name), keywords=[]):
                if name not in FUNCTIONS:
                    raise Refusal(f"“{text}”: there is no function {name}; known are {', '.join(sorted(FUNCTIONS))}")
                fewest, most = _ARGUMENTS.get(name, (1, 1))
                if not fewest <= len(node.args) <= most:
                    wanted = f"{fewest}" if fewest == most else f"{fewest} or {most}" if most == 2 else "two or more"
                    raise Refusal(f"“{text}”: {name} takes {wanted} number{'s' if most > 1 else ''}")
                stack += [(argument, depth + 1) for argument in node.args]
            case _:
                raise Refusal(f"“{text}” holds something that is not arithmetic")


def reckon(text: str, values: Mapping[str, float]) -> float:
    """The number that an expression comes to, in millimetres or degrees. Raises Refusal in the user's words."""
    words = shortened(text)
    try:
        return _finite(_value(parse(text), values))
    except Refusal as refusal:
        raise Refusal(f"“{words}”: {refusal}") from None
    except ZeroDivisionError:
        raise Refusal(f"“{words}” divides by zero") from None
    except OverflowError:
        raise Refusal(f"“{words}” is too large a number") from None
    except (ValueError, TypeError) as error:
        raise Refusal(f"“{words}” has no value: {error}") from None


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise OverflowError
    return value


def _value(node: ast.expr, values: Mapping[str, float]) -> float:
    # Depth is bounded by _check, but for the chains that are followed here.
    match node:
        case ast.Constant(value=value):
            return float(value)  # type: ignore[arg-type]
        case ast.Name(id=name):
            if name in CONSTANTS:
                return CONSTANTS[name]
            if name in values:
                return float(values[name])
            raise Refusal(f"there is no parameter called {name}")
        case ast.BinOp():
            chain: list[ast.BinOp] = []
            first: ast.expr = node
            while isinstance(first, ast.BinOp):
                chain.append(first)
                first = first.left
            total = _value(first, values)
            for step in reversed(chain):
                total = _finite(_BINARY[type(step.op)](total, _value(step.right, values)))
            return total
        case ast.UnaryOp(op=op, operand=operand):
            value = _value(operand, values)
            return -value if isinstance(op, ast.USub) else value
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _value(body if _value(test, values) else orelse, values)
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return float(_COMPARE[type(op)](_value(left, values), _value(right, values)))
        case ast.Call(func=ast.Name(id=name), args=args):
            return float(_finite(FUNCTIONS[name](*(_value(a, values) for a in args))))
    raise AssertionError(node)


def names_in(text: str) -> frozenset[str]:
    """The parameters that an expression asks for."""
    nodes = ast.walk(parse(text))
    return frozenset(n.id for n in nodes if isinstance(n, ast.Name) and n.id not in RESERVED)


def renamed(text: str, old: str, new: str) -> str:
    """The expression with the parameter `old` called `new`."""
    return _NAME.sub(lambda found: new if normal_name(found[0]) == old else found[0], text)


def binding(text: str) -> int:
    """How tightly an expression's outermost operation binds.

    0 is a conditional, 1 a sum or a sign, 2 a product, 3 a power, 4 a number, a name or a call.
    """
    match parse(text):
        case ast.BinOp(op=ast.Add() | ast.Sub()) | ast.UnaryOp():
            return 1
        case ast.BinOp(op=ast.Pow()):
            return 3
        case ast.BinOp():
            return 2
        case ast.Constant() | ast.Name() | ast.Call():
            return 4
    return 0
