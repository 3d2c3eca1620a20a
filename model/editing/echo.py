"""Nodes and calls as the Python that makes them again."""

from __future__ import annotations

import dataclasses
from typing import Any

from ..document.document import Document
from ..document.expression import Expression
from ..document.kind_names import function_name
from ..document.nodes import Instance, Node, field_specs
from ..document.placement import Affine, Move, Placement, Reflect, Scale, Step, Turn
from ..document.table import to_table
from ..document.tree import numbered
from ..operations.parameters import parameter_arguments
from ..operations.surfaces import with_materials_of
from ..surface.mapping import TextureMapping
from ..surface.material import Material

MAX_NESTING = 60
"""Python cannot read calls nested some 200 deep; such a tree is written as its table."""


def number_text(value: Any) -> str:
    """A field's value in Python: whole numbers without a fraction, expressions as text, arrays as lists."""
    if hasattr(value, "tolist"):  # NumPy's numbers and arrays
        value = value.tolist()
    if isinstance(value, Expression):
        return repr(value.text)
    if isinstance(value, tuple):
        inner = ", ".join(number_text(item) for item in value)
        return f"({inner},)" if len(value) == 1 else f"({inner})"
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return repr(value)


def call(name: str, *arguments: Any, **keywords: Any) -> str:
    """`name(arguments)`; nodes among them are written as what makes them."""
    parts = [_argument(argument) for argument in arguments]
    parts += [f"{key}={_argument(value)}" for key, value in keywords.items()]
    return f"{name}({', '.join(parts)})"


def step(before: Document, after: Document, name: str, *arguments: Any, **keywords: Any) -> str:
    """The lines that do again what an operation did: parameters that came with an expression are set first."""
    known = {parameter.name for parameter in before.parameters}
    if name == "set_parameter":
        known.add(arguments[0] if arguments else keywords["name"])
    elif name == "rename_parameter":
        known |= {parameter.name for parameter in after.parameters}
    elif name in ("add_motion", "set_motion", "set_in_motion"):  # these make the parameter that they drive
        known |= {motion.parameter for motion in after.motions}
    lines = [
        call("set_parameter", parameter.name, parameter.value, **parameter_arguments(parameter))
        for parameter in after.parameters
        if parameter.name not in known
    ]
    return "\n".join([*lines, call(name, *arguments, **keywords)])


def depth(root: Node) -> int:
    """How many levels a tree has."""
    deepest, stack = 0, [(root, 1)]
    while stack:
        node, depth = stack.pop()
        deepest = max(deepest, depth)
        stack += [(child, depth + 1) for child in node.children]
    return deepest


def _argument(value: Any) -> str:
    if isinstance(value, Node):
        if depth(value) <= MAX_NESTING:
            return script_of(value)
        document, roots = with_materials_of(Document(), numbered([value]))
        return f"{_argument(document.with_(solids=tuple(roots)))}.solids[0]"
    if isinstance(value, Document):
        return f"document_from({to_table(value)!r})"
    if isinstance(value, Step):
        return _step(value).removeprefix(".")
    if isinstance(value, list):
        return f"[{', '.join(_argument(item) for item in value)}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key!r}: {_argument(item)}' for key, item in value.items())}}}"
    if isinstance(value, type) and issubclass(value, Node):
        return repr(function_name(value))
    return number_text(value)


def script_of(root: Node) -> str:
    """One expression of the script API that makes the tree again, ids apart."""
    made: list[str] = []
    stack: list[tuple[Node, bool]] = [(root, False)]
    while stack:
        node, ready = stack.pop()
        if not ready:
            stack.append((node, True))
            stack += [(child, False) for child in reversed(node.children)]
            continue
        size = len(node.children)
        operands = made[len(made) - size :]
        del made[len(made) - size :]
        made.append(_one(node, operands))
    return made[0]


def _one(node: Node, operands: list[str]) -> str:
    kind = type(node)
    defaults = {field.name: field.default for field in dataclasses.fields(kind)}
    parts = list(operands)
    for spec in field_specs(kind):
        value = getattr(node, spec.name)
        if value != defaults[spec.name] or isinstance(node, Instance):
            parts.append(f"{spec.name}={number_text(value)}")
    text = f"{function_name(kind)}({', '.join(parts)})"
    text += _placed(node.placement)
    dress = [_dress(part) for part in (node.material, node.mapping) if part]
    if dress:
        text += f".dressed({', '.join(dress)})"
    if node.crease is not None:
        text += f".creased({number_text(node.crease)})"
    for method, value in (("named", node.name), ("coloured", node.colour), ("noted", node.note)):
        if value:
            text += f".{method}({value!r})"
    return text if node.visible else text + ".hidden()"


def _dress(dress: str | Material | TextureMapping) -> str:
    if isinstance(dress, str):
        return repr(dress)
    changed = {
        field.name: getattr(dress, field.name)
        for field in dataclasses.fields(dress)
        if getattr(dress, field.name) != field.default and field.name != "name"
    }
    if isinstance(dress, TextureMapping):
        return call("texture", **changed)
    return call("material", dress.name, **changed)


def _placed(placement: Placement) -> str:
    joined = Placement()
    for one in placement.steps:
        joined = joined.then(one)
    if joined == placement:
        return "".join(map(_step, placement.steps))
    return f".placed({', '.join(_step(one).removeprefix('.') for one in placement.steps)})"


_METHODS: dict[type[Step], str] = {Move: "at", Turn: "turned", Scale: "scaled"}


def _step(step: Step) -> str:
    if isinstance(step, Reflect):
        return f".mirrored({number_text(step.numbers)})"
    if isinstance(step, Affine):
        rows = tuple(step.numbers[i : i + 4] for i in (0, 4, 8))
        return f".transformed({number_text(rows)})"
    return f".{_METHODS[type(step)]}({', '.join(number_text(n) for n in step.numbers)})"
