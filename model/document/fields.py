"""What a field of a node is: its type, unit and bounds, from which forms, files and checks are made."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

from .errors import Refusal
from .expression import number, vector

FieldType = Literal["length", "angle", "count", "factor", "vector", "direction", "flag", "text", "points", "faces"]


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

    @property
    def dimension(self) -> int:
        """How many numbers the field holds; 0 where it holds none."""
        return {"vector": 3, "direction": 3, "flag": 0, "text": 0, "points": 0, "faces": 0}.get(self.type, 1)

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
            case "text":
                if not isinstance(value, str):
                    raise Refusal(f"{what} must be text, not {value!r:.60}")
                return value
            case "points":
                width = 2 if self.unit == "2-D" else 3
                return tuple(vector(p, f"{what}: point {i}", width) for i, p in enumerate(_items(value, what)))
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


def text(default: str, label: str, tip: str = "") -> Any:
    return _field("text", default, label, tip)


def points(label: str, tip: str = "", *, flat: bool = False) -> Any:
    return _field("points", (), label, tip, unit="2-D" if flat else "mm")


def faces(label: str, tip: str = "") -> Any:
    return _field("faces", (), label, tip)


def tolerance() -> Any:
    return size(None, "Tolerance", "Largest distance between the true surface and its facets; empty: the document's",
                optional=True)  # fmt: skip


def segments() -> Any:
    return count(None, "Segments", "Facets around a full turn; empty: as the tolerance asks", minimum=3, optional=True)
