"""The document: a value that holds all that a project file holds."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from .errors import Refusal
from .expression import RESERVED, Expression, Number, number, resolved
from .nodes import Node

_NAME = re.compile(r"[^\W\d]\w*")


@dataclass(frozen=True, slots=True)
class Parameter:
    """A named number that expressions may use. Its own value may be an expression of other parameters."""

    name: str
    value: Number
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[float, ...] = ()
    note: str = ""
    group: str = ""

    def __post_init__(self) -> None:
        what = f"the parameter {self.name}"
        if not isinstance(self.name, str) or not _NAME.fullmatch(self.name):
            raise Refusal(f"{self.name!r:.60} is no name for a parameter: letters, digits and _ make one")
        if self.name in RESERVED:
            raise Refusal(f"{self.name} is the name of a function, a constant or a unit; call the parameter otherwise")
        object.__setattr__(self, "value", number(self.value, what))
        for bound in ("minimum", "maximum"):
            limit = getattr(self, bound)
            if limit is not None:
                limit = number(limit, f"{what}: {bound}")
                if isinstance(limit, Expression):
                    raise Refusal(f"{what}: {bound} must be a plain number")
                object.__setattr__(self, bound, limit)
        if self.minimum is not None and self.maximum is not None and self.minimum > self.maximum:
            raise Refusal(f"{what}: the minimum {self.minimum:g} is above the maximum {self.maximum:g}")
        choices = tuple(number(choice, f"{what}: choice") for choice in self.choices)
        object.__setattr__(self, "choices", choices)
        if isinstance(self.value, float):
            fault = self.fault(self.value)
            if fault:
                raise Refusal(fault)

    def fault(self, value: float) -> str | None:
        """Why the parameter may not have this value, or None."""
        if self.minimum is not None and value < self.minimum:
            return f"the parameter {self.name} must be at least {self.minimum:g}, not {value:g}"
        if self.maximum is not None and value > self.maximum:
            return f"the parameter {self.name} must be at most {self.maximum:g}, not {value:g}"
        if self.choices and value not in self.choices:
            return (
                f"the parameter {self.name} must be one of {', '.join(f'{c:g}' for c in self.choices)}, not {value:g}"
            )
        return None

    def with_(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)


@dataclass(frozen=True, slots=True, eq=False)
class Document:
    """All that is undoable and saved. A change makes a new document that shares what it did not touch.

    `solids` are the roots of the CSG trees, `profiles` the outlines that stand by themselves, `definitions` the
    sub-trees that instances refer to by their root's id.
    """

    solids: tuple[Node, ...] = ()
    profiles: tuple[Node, ...] = ()
    definitions: tuple[Node, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    notes: str = ""

    def __post_init__(self) -> None:
        names = [parameter.name for parameter in self.parameters]
        for name in names:
            if names.count(name) > 1:
                raise Refusal(f"there are two parameters called {name}")

    def __repr__(self) -> str:
        return f"<Document of {len(self.solids)} solids>"

    def with_(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)

    @property
    def roots(self) -> tuple[Node, ...]:
        return self.solids + self.profiles + self.definitions

    def parameter(self, name: str) -> Parameter:
        """The parameter of this name. Raises Refusal."""
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        raise Refusal(f"there is no parameter called {name}")


def parameter_values(parameters: Iterable[Parameter]) -> tuple[dict[str, float], dict[str, str]]:
    """The parameters' numbers, and for those that have none the reason, both by name."""
    pending = {parameter.name: parameter for parameter in parameters}
    values: dict[str, float] = {}
    faults: dict[str, str] = {}
    while pending:
        ready = [
            p for p in pending.values() if not isinstance(p.value, Expression) or not (p.value.names() & pending.keys())
        ]
        if not ready:
            for name in pending:
                faults[name] = f"the parameter {name} depends on itself: {', '.join(sorted(pending))} go in a circle"
            break
        for parameter in ready:
            del pending[parameter.name]
            try:
                value = resolved(parameter.value, values)
                fault = parameter.fault(value)
            except Refusal as refusal:
                value, fault = 0.0, f"the parameter {parameter.name}: {refusal}"
            if fault:
                faults[parameter.name] = fault
            else:
                values[parameter.name] = value
    return values, faults
