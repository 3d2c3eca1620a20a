"""What a field of a node is: its type, unit and bounds, from which forms, files and checks are made."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, Literal

from .errors import Refusal
from .expression import number, vector

FieldType = Literal["length", "angle", "count", "factor", "vector", "direction", "flag", "text", "points", "faces",
                    "letters", "numbers", "splines", "choice"]  # fmt: skip


BARE = ("flag", "text", "points", "faces", "letters", "numbers", "splines", "choice")
"""The types that no row of numbers in a form can show."""


@dataclass(frozen=True, slots=True)
class FieldSpec:
    """One geometric field of a kind of node, as forms and files see it."""

    name: str
    type: FieldType
    label: str
    tip: str = ""
    unit: str = ""
    minimum: float | None = None
    above: bool = False
    """Whether the minimum itself is refused."""
    optional: bool = False
    """Whether the field may be None: then the program chooses."""
    options: tuple[str, ...] = ()
    """What a choice is one of."""
    editor: str = ""
    """How a form lets text be written: "line", "lines" or "font"; "" where it only shows it."""

    @property
    def dimension(self) -> int:
        """How many numbers the field holds; 0 where it holds none."""
        return {"vector": 3, "direction": 3, **dict.fromkeys(BARE, 0)}.get(self.type, 1)

    def checked(self, value: Any, kind: str) -> Any:
        """`value` in the form that nodes keep. Raises Refusal."""
        what = f"{kind}: {self.label.lower()}"
        if value is None and self.optional:
            return None
        match self.type:
            case "vector" | "direction":
                return vector(value, what)
            case "flag":
                if value not in (True, False) or not isinstance(value, bool | int):
                    raise Refusal(f"{what} must be true or false, not {value!r:.60}")
                return bool(value)
            case "text" | "letters":
                if not isinstance(value, str):
                    raise Refusal(f"{what} must be text, not {value!r:.60}")
                return value
            case "choice":
                if value not in self.options:
                    raise Refusal(f"{what} is one of {', '.join(self.options)}, not {value!r:.60}")
                return value
            case "points":
                return _points(value, what, self.unit)
            case "numbers":
                return tuple(number(item, f"{what}: {i}") for i, item in enumerate(_items(value, what)))
            case "splines":
                return tuple(_spline(item, f"{what}: {i}") for i, item in enumerate(_items(value, what)))
            case "faces":
                return tuple(tuple(_index(i, what) for i in _items(face, what)) for face in _items(value, what))
        return number(value, what)

    def range_fault(self, value: Any) -> str | None:
        """Why a resolved value is out of its bounds, or None."""
        if self.minimum is None or value is None:
            return None
        for one in value if isinstance(value, tuple) else (value,):
            if one < self.minimum or (self.above and one == self.minimum):
                bound = "above" if self.above else "at least"
                return f"{self.label.lower()} must be {bound} {self.minimum:g}, not {one:g}"
        return None


def _items(value: Any, what: str) -> Iterable[Any]:
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise Refusal(f"{what} must be a list, not {value!r:.60}")
    return value


def _points(value: Any, what: str, unit: str) -> tuple[tuple[Any, ...], ...]:
    """Points as tuples: of two coordinates, of three, or of as many as the first one has."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    items = list(_items(value, what))
    width = {"2-D": 2, "mm": 3}.get(unit)
    if width is None:
        first = items[0] if items else ()
        width = len(first) if isinstance(first, tuple | list) and len(first) == 3 else 2
    if set(map(type, items)) == {tuple} and set(map(len, items)) == {width}:
        plain = plain_coordinates(items)
        if plain is not None and all(map(math.isfinite, plain)):
            zeros = (n for n in plain if n == 0.0) if 0.0 in plain else ()
            if all(math.copysign(1.0, n) > 0.0 for n in zeros):
                return tuple(items)  # as nodes keep them already: a path may have many thousands
    return tuple(vector(p, f"{what}: point {i}", width) for i, p in enumerate(items))


def plain_coordinates(points: Sequence[tuple[Any, ...]]) -> list[float] | None:
    """All coordinates one after the other, or None where one of them is no float."""
    found = list(chain.from_iterable(points))
    return found if set(map(type, found)) <= {float} else None


def _spline(value: Any, what: str) -> tuple[int, tuple[float, ...], tuple[float, ...]]:
    """(degree, knots, weights) in plain numbers."""
    try:
        degree, knots, weights = value
    except (TypeError, ValueError):
        raise Refusal(f"{what} must be a degree, knots and weights, not {value!r:.60}") from None
    plain = [tuple(number(n, what) for n in _items(part, what)) for part in (knots, weights)]
    if any(not isinstance(n, float) for part in plain for n in part):
        raise Refusal(f"{what}: knots and weights of a segment are plain numbers")
    return _index(degree, what), plain[0], plain[1]  # type: ignore[return-value]


def _index(value: object, what: str) -> int:
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise Refusal(f"{what}: a face is made of whole numbers, not {value!r:.60}")
    return int(value)  # type: ignore[call-overload]


def _field(type_: FieldType, default: Any, label: str, tip: str, **more: Any) -> Any:
    make: Callable[[], Any] | None = more.pop("factory", None)
    metadata = {"spec": FieldSpec("", type_, label, tip, **more)}
    if make is not None:
        return dataclasses.field(default_factory=make, metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


def length(default: float | None, label: str, tip: str = "", *, minimum: float | None = None, **more: Any) -> Any:
    return _field("length", default, label, tip, unit="mm", minimum=minimum, **more)


def size(default: float | None, label: str, tip: str = "", **more: Any) -> Any:
    """A length above zero."""
    return _field("length", default, label, tip, unit="mm", minimum=0.0, above=True, **more)


def sizes(default: tuple[float, float, float], label: str, tip: str = "") -> Any:
    return _field("vector", default, label, tip, unit="mm", minimum=0.0, above=True)


def angle(default: float, label: str, tip: str = "", **more: Any) -> Any:
    return _field("angle", default, label, tip, unit="°", **more)


def count(default: int | None, label: str, tip: str = "", *, minimum: int = 1, **more: Any) -> Any:
    return _field("count", default, label, tip, minimum=minimum, **more)


def factor(default: float, label: str, tip: str = "", **more: Any) -> Any:
    return _field("factor", default, label, tip, **more)


def position(default: tuple[float, float, float], label: str, tip: str = "") -> Any:
    return _field("vector", default, label, tip, unit="mm")


def direction(default: tuple[float, float, float], label: str, tip: str = "") -> Any:
    return _field("direction", default, label, tip)


def flag(default: bool, label: str, tip: str = "") -> Any:
    return _field("flag", default, label, tip)


def text(default: str, label: str, tip: str = "", editor: str = "") -> Any:
    return _field("text", default, label, tip, editor=editor)


def choice(label: str, options: tuple[str, ...], tip: str = "") -> Any:
    """One of some words, the first unless another is chosen."""
    return _field("choice", options[0], label, tip, options=options)


def points(label: str, tip: str = "", *, flat: bool = False) -> Any:
    return _field("points", (), label, tip, unit="2-D" if flat else "mm")


def curve_points(label: str, tip: str = "") -> Any:
    """Points of two coordinates each, or of three each."""
    return _field("points", (), label, tip, unit="2-D or 3-D")


def letters(label: str, tip: str = "") -> Any:
    return _field("letters", "", label, tip)


def numbers(label: str, tip: str = "") -> Any:
    return _field("numbers", (), label, tip)


def splines(label: str, tip: str = "") -> Any:
    return _field("splines", (), label, tip)


def faces(label: str, tip: str = "") -> Any:
    return _field("faces", (), label, tip)


def tolerance() -> Any:
    return size(None, "Tolerance", "Largest distance between the true surface and its facets; empty: the document's",
                optional=True)  # fmt: skip


def segments() -> Any:
    return count(None, "Segments", "Facets around a full turn; empty: as the tolerance asks", minimum=3, optional=True)
