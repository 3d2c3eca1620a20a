"""Operations on the parameters, and what uses them."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from typing import Any

from ..document.document import Document, Parameter, ParameterSet
from ..document.errors import Refusal
from ..document.expression import Expression, Number, expressions_in
from ..document.nodes import Node, field_specs
from ..document.placement import Placement
from ..document.tree import change_each, walk


def set_parameter(document: Document, name: str, value: Number | str, **more: Any) -> Document:
    """Give a parameter a value, or declare it; `minimum`, `maximum`, `choices`, `note`, `group` as in scripts."""
    unknown = sorted(more.keys() - {"minimum", "maximum", "choices", "note", "group"})
    if unknown:
        raise Refusal(f"a parameter has no {unknown[0]}")
    old = next((p for p in document.parameters if p.name == name), None)
    new = Parameter(name, value, **more) if old is None else old.with_(value=value, **more)  # type: ignore[arg-type]
    document = declaring(document, new.value, also=new.name)
    if old is None:
        return document.with_(parameters=(*document.parameters, new))
    if new == old:
        return document
    return document.with_(parameters=tuple(new if p is old else p for p in document.parameters))


def rename_parameter(document: Document, name: str, new_name: str) -> Document:
    """Call a parameter otherwise, in every expression, every saved set and every motion too."""
    old = document.parameter(name)
    new = old.with_(name=new_name)
    if new.name == old.name:
        return document
    if any(parameter.name == new.name for parameter in document.parameters):
        raise Refusal(f"there is a parameter called {new.name} already")

    def renamed(value: Any) -> Any:
        if isinstance(value, Expression):
            return value.renamed(old.name, new.name)
        return tuple(renamed(item) for item in value) if isinstance(value, tuple) else value

    def changed(node: Node) -> Node:
        fields = {spec.name: renamed(getattr(node, spec.name)) for spec in field_specs(type(node))}
        steps = tuple(type(step)(renamed(step.numbers)) for step in node.placement.steps)
        return node.with_(placement=Placement(steps), **fields)

    document = change_each(document, [node.id for node in _users(document, old.name)], changed)
    parameters = (new if p is old else p.with_(value=renamed(p.value)) for p in document.parameters)
    motions = tuple(m.with_(parameter=new.name) if m.parameter == old.name else m for m in document.motions)
    document = document.with_(parameters=tuple(parameters), motions=motions)
    return _with_sets(
        document,
        lambda one: tuple((new.name if name == old.name else name, renamed(value)) for name, value in one.values),
    )


def delete_parameter(document: Document, name: str) -> Document:
    """Take a parameter out that no expression and no motion uses; saved sets forget it, and values that are reckoned
    from it."""
    document.parameter(name)
    for node in _users(document, name):
        raise Refusal(f"the parameter {name} is used by “{node.label}”")
    for parameter in document.parameters:
        if parameter.name != name and name in names_of(parameter.value):
            raise Refusal(f"the parameter {name} is used by the parameter {parameter.name}")
    for motion in document.motions:
        if motion.parameter == name:
            raise Refusal(f"the parameter {name} is driven by the motion “{motion.name}”")
    document = document.with_(parameters=tuple(p for p in document.parameters if p.name != name))
    return _with_sets(
        document, lambda one: tuple(pair for pair in one.values if name not in {pair[0], *names_of(pair[1])})
    )


def reorder_parameter(document: Document, name: str, index: int) -> Document:
    """Put a parameter at another place of the list, counted from 0 without itself."""
    old = document.parameter(name)
    if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < len(document.parameters):
        raise Refusal(f"the parameter {name} can stand at 0 to {len(document.parameters) - 1}, not {index!r:.60}")
    others = [parameter for parameter in document.parameters if parameter is not old]
    if document.parameters[index] is old:
        return document
    return document.with_(parameters=(*others[:index], old, *others[index:]))


def parameter_users(document: Document, name: str) -> tuple[str, ...]:
    """The ids of the nodes that a parameter reaches, by their own expressions or through other parameters."""
    document.parameter(name)
    reached, todo = {name}, [name]
    needs = {parameter.name: names_of(parameter.value) for parameter in document.parameters}
    while todo:
        one = todo.pop()
        fresh = {other for other, needed in needs.items() if one in needed} - reached
        reached |= fresh
        todo += fresh
    return tuple(node.id for node in walk(*document.roots) if reached & names_of(node.expressions()))


def _with_sets(document: Document, values: Callable[[ParameterSet], tuple[tuple[str, Number], ...]]) -> Document:
    """The document with other values in its sets; a set whose values stay the same is kept as it is."""
    new = []
    for one in document.sets:
        pairs = values(one)
        new.append(one if pairs == one.values else ParameterSet(one.name, pairs))
    changed = any(a is not b for a, b in zip(new, document.sets, strict=True))
    return document.with_(sets=tuple(new)) if changed else document


def _users(document: Document, name: str) -> Iterable[Node]:
    return (node for node in walk(*document.roots) if name in names_of(node.expressions()))


def names_of(value: object) -> set[str]:
    """The parameters that the expressions in a value ask for."""
    return {name for expression in expressions_in(value) for name in expression.names()}


def declared(expressions: Iterable[Expression]) -> dict[str, Parameter]:
    """The parameters that a script declared on the way to these expressions. Raises Refusal where two disagree."""
    found: dict[str, Parameter] = {}
    for expression in expressions:
        for parameter in expression.declares:
            if found.setdefault(parameter.name, parameter) != parameter:
                raise Refusal(f"the parameter {parameter.name} is declared twice, with different values")
    return found


def declaring(document: Document, value: object, also: str = "") -> Document:
    """The document with the parameters that the expressions in `value` declare, where it has none of that name.

    Raises Refusal where an expression asks for a parameter that is neither in the document nor declared nor `also`.
    """
    expressions = list(expressions_in(value))
    if not expressions:
        return document
    known = {parameter.name for parameter in document.parameters}
    fresh = tuple(p for name, p in declared(expressions).items() if name not in known and name != also)
    asked = names_of(expressions).union(*(names_of(parameter.value) for parameter in fresh))
    missing = sorted(asked - known - {parameter.name for parameter in fresh} - {also})
    if missing:
        raise Refusal(f"there is no parameter called {missing[0]}")
    return document.with_(parameters=(*document.parameters, *fresh)) if fresh else document


def parameter_arguments(parameter: Parameter) -> dict[str, Any]:
    """What `set_parameter` is called with, after name and value, to declare this parameter."""
    fields = dataclasses.fields(Parameter)[2:]
    return {f.name: getattr(parameter, f.name) for f in fields if getattr(parameter, f.name) != f.default}
