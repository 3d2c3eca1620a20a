"""The document: a value that holds all that a project file holds."""

from __future__ import annotations

import dataclasses
import keyword
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from ..proximity.checks import Checks
from ..proximity.motion import Motion
from ..surface.light import MOST as MOST_LIGHTS
from ..surface.light import Light
from ..surface.material import SHADINGS, Material, one_of
from .arithmetic import RESERVED, normal_name
from .errors import Refusal
from .expression import Expression, Number, number, resolved, vector
from .nodes import Node
from .project_font import ProjectFont, font_key


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


@dataclass(frozen=True, slots=True)
class ParameterSet:
    """Values of parameters under a name, as a customizer saves them; parameters it does not name keep theirs."""

    name: str
    values: tuple[tuple[str, Number], ...] = ()

    def __post_init__(self) -> None:
        what = _proper_name(self.name, "a set of parameters")
        if isinstance(self.values, str) or not isinstance(self.values, Iterable):
            raise Refusal(f"{what}: pairs of a name and a value are needed, not {self.values!r:.60}")
        values: dict[str, Number] = {}
        for pair in self.values:
            if not (isinstance(pair, tuple | list) and len(pair) == 2 and isinstance(pair[0], str)):
                raise Refusal(f"{what}: {pair!r:.60} is no pair of a parameter's name and its value")
            if pair[0] in values:
                raise Refusal(f"{what} gives the parameter {pair[0]} twice")
            values[pair[0]] = number(pair[1], f"{what}: {pair[0]}")
        object.__setattr__(self, "values", tuple(values.items()))


@dataclass(frozen=True, slots=True)
class Section:
    """A plane that opens the picture: shown is what lies on the side that its normal points to, with the cut hatched.

    `point` in millimetres, on the plane; `normal` is kept as a unit vector.
    """

    name: str
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    normal: tuple[float, float, float] = (0.0, 0.0, -1.0)
    active: bool = True

    def __post_init__(self) -> None:
        what = _proper_name(self.name, "a section")
        if not isinstance(self.active, bool):
            raise Refusal(f"{what}: active must be true or false, not {self.active!r:.60}")
        for field in ("point", "normal"):
            numbers = vector(getattr(self, field), f"{what}: the {field}", 3)
            object.__setattr__(self, field, tuple(_plain_number(n, f"{what}: the {field}") for n in numbers))
        size = math.hypot(*self.normal)
        if not 1e-150 < size < 1e150:
            raise Refusal(f"{what}: the normal must be a direction, not {', '.join(f'{n:g}' for n in self.normal)}")
        if abs(size - 1.0) > 1e-15:
            object.__setattr__(self, "normal", tuple(n / size for n in self.normal))

    def with_(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)


def _proper_name(name: object, what: str) -> str:
    """Words for a named part in messages. Raises Refusal where it has no name."""
    if not isinstance(name, str) or not name.strip() or len(name) > 200:
        raise Refusal(f"{what} needs a name of 1 to 200 characters, not {name!r:.60}")
    return f"{what.split(' ', 1)[1]} “{name}”"


def _plain_number(value: object, what: str) -> float:
    plain = number(value, what)
    if isinstance(plain, Expression):
        raise Refusal(f"{what} must be a plain number")
    return plain


@dataclass(frozen=True, slots=True, eq=False)
class Document:
    """All that is undoable and saved. A change makes a new document that shares what it did not touch.

    `solids` are the roots of the CSG trees, `profiles` the outlines that stand by themselves, `definitions` the
    sub-trees that instances refer to by their root's id. `sets` are saved values of the parameters, `sections` the
    planes that open the picture, `fonts` those that names of fonts stand for, `materials` those that nodes name,
    `lights` those of the picture (none: the program's own), `shading` that of its pictures ("": the window decides),
    `checks` the clearances asked of the solids, `motions` the ways that parameters go in time.
    The names of either are all different.
    """

    solids: tuple[Node, ...] = ()
    profiles: tuple[Node, ...] = ()
    definitions: tuple[Node, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    sets: tuple[ParameterSet, ...] = ()
    sections: tuple[Section, ...] = ()
    fonts: tuple[ProjectFont, ...] = ()
    materials: tuple[Material, ...] = ()
    lights: tuple[Light, ...] = ()
    shading: str = ""
    checks: Checks = Checks()
    motions: tuple[Motion, ...] = ()
    notes: str = ""

    def __post_init__(self) -> None:
        for members, what in (
            (self.parameters, "parameters"),
            (self.sets, "sets"),
            (self.sections, "sections"),
            (self.materials, "materials"),
            (self.lights, "lights"),
            (self.motions, "motions"),
        ):
            names: set[str] = set()
            for member in members:
                if member.name in names:
                    raise Refusal(f"there are two {what} called {member.name}")
                names.add(member.name)
        if len({font_key(font.name) for font in self.fonts}) < len(self.fonts):
            raise Refusal("there are two fonts of one name")
        one_of(self.shading, ("", *SHADINGS), "the shading of a document")
        if sum(light.active for light in self.lights) > MOST_LIGHTS:
            raise Refusal(f"at most {MOST_LIGHTS} lights can shine at once: switch one off first")

    def __repr__(self) -> str:
        outlines = f", {len(self.profiles)} outlines" if self.profiles else ""
        return f"<Document of {len(self.solids)} solids{outlines}>"

    def with_(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)

    @property
    def standing(self) -> tuple[Node, ...]:
        """The roots that stand in space by themselves: solids and profiles, whose names are all different."""
        return self.solids + self.profiles

    @property
    def roots(self) -> tuple[Node, ...]:
        return self.solids + self.profiles + self.definitions

    def material(self, name: str) -> Material | None:
        return next((material for material in self.materials if material.name == name), None)

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
