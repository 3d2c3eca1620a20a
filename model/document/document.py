"""The document: a value that holds all that a project file holds."""

from __future__ import annotations

import dataclasses
import keyword
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from .arithmetic import RESERVED, normal_name
from .errors import Refusal
from .expression import Expression, Number, number, resolved
from .nodes import Node


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
        if not isinstance(self.name, str) or not self.name.isidentifier():
            raise Refusal(f"{self.name!r:.60} is no name for a parameter: letters, digits and _ make one")
        name = normal_name(self.name)
        if name in RESERVED:
            raise Refusal(f"{name} is the name of a function, a constant or a unit; call the parameter otherwise")
        if keyword.iskeyword(name):
            raise Refusal(f"{name} is a word of the expressions' language; call the parameter otherwise")
        what = f"the parameter {name}"
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "value", number(self.value, what))
        for bound in ("minimum", "maximum"):
            limit = getattr(self, bound)
            if limit is not None:
                object.__setattr__(self, bound, _plain_number(limit, f"{what}: {bound}"))
        if self.minimum is not None and self.maximum is not None and self.minimum > self.maximum:
            raise Refusal(f"{what}: the minimum {self.minimum:g} is above the maximum {self.maximum:g}")
        if isinstance(self.choices, str) or not isinstance(self.choices, Iterable):
            raise Refusal(f"{what}: the choices must be a list of numbers, not {self.choices!r:.60}")
        object.__setattr__(self, "choices", tuple(_plain_number(c, f"{what}: a choice") for c in self.choices))
        for text in ("note", "group"):
            if not isinstance(getattr(self, text), str):
                raise Refusal(f"{what}: the {text} must be text, not {getattr(self, text)!r:.60}")
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


def _plain_number(value: object, what: str) -> float:
    plain = number(value, what)
    if isinstance(plain, Expression):
        raise Refusal(f"{what} must be a plain number")
    return plain


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
        names: set[str] = set()
        for parameter in self.parameters:
            if parameter.name in names:
                raise Refusal(f"there are two parameters called {parameter.name}")
            names.add(parameter.name)

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
    by_name = {parameter.name: parameter for parameter in parameters}
    needs = {name: _needs(parameter) & by_name.keys() for name, parameter in by_name.items()}
    users: dict[str, list[str]] = {name: [] for name in by_name}
    for name, needed in needs.items():
        for other in needed:
            users[other].append(name)
    values: dict[str, float] = {}
    faults: dict[str, str] = {}
    waiting = {name: len(needed) for name, needed in needs.items()}
    ready = [name for name, count in waiting.items() if count == 0]
    while True:
        while ready:
            name = ready.pop()
            if waiting.pop(name, None) is None:
                continue  # of a circle, and reached again from within it
            _settle(by_name[name], needs[name], values, faults)
            for user in users[name]:
                if user in waiting:
                    waiting[user] -= 1
                    if waiting[user] == 0:
                        ready.append(user)
        if not waiting:
            break
        circle = _circle(needs, waiting)
        for name in circle:
            faults[name] = f"the parameter {name} depends on itself: {', '.join(sorted(circle))} go in a circle"
        ready = circle
    return {name: values[name] for name in by_name if name in values}, faults


def _needs(parameter: Parameter) -> frozenset[str]:
    return parameter.value.names() if isinstance(parameter.value, Expression) else frozenset()


def _settle(parameter: Parameter, needs: Iterable[str], values: dict[str, float], faults: dict[str, str]) -> None:
    if parameter.name in faults:
        return
    wrong = min((name for name in needs if name in faults), default=None)
    if wrong is not None:
        faults[parameter.name] = f"the parameter {parameter.name} needs {wrong}, which has no value: {faults[wrong]}"
        return
    try:
        value = resolved(parameter.value, values)
    except Refusal as refusal:
        faults[parameter.name] = f"the parameter {parameter.name}: {refusal}"
        return
    fault = parameter.fault(value)
    if fault:
        faults[parameter.name] = fault
    else:
        values[parameter.name] = value


def _circle(needs: dict[str, frozenset[str]], waiting: dict[str, int]) -> list[str]:
    """One circle among the parameters that wait for one another: follow what each needs until one comes again."""
    way: dict[str, None] = {}
    name = next(iter(waiting))
    while name not in way:
        way[name] = None
        name = min(other for other in needs[name] if other in waiting)
    names = list(way)
    return names[names.index(name) :]
