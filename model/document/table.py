"""A document as plain JSON values: a flat table of nodes, for files and for messages to other processes."""

from __future__ import annotations

import dataclasses
import operator
from collections.abc import Mapping
from typing import Any, TypeVar

from ..proximity.checks import Checks, PairCheck
from ..proximity.motion import Motion
from ..surface.light import Light
from ..surface.mapping import TextureMapping
from ..surface.material import Material
from . import from_outlines, outlines, primitives  # which register their kinds
from .colours import hex_colour
from .document import Document, Parameter, ParameterSet, Section
from .errors import Refusal
from .expression import Expression, Number
from .nodes import KINDS, Broken, Instance, Node, field_specs
from .placement import STEPS, Placement
from .project_font import ProjectFont
from .tree import FAMILIES, MAX_NODES, walk

MAX_ID = 100
_Dress = TypeVar("_Dress", Material, Light, TextureMapping, PairCheck)
_DEFAULTS: dict[type[Node], dict[str, Any]] = {}
assert from_outlines and outlines and primitives


def _default(kind: type[Node], name: str) -> Any:
    if kind not in _DEFAULTS:
        _DEFAULTS[kind] = {field.name: field.default for field in dataclasses.fields(kind)}
    return _DEFAULTS[kind][name]


def to_table(document: Document) -> dict[str, Any]:
    """The document as dictionaries, lists, text and numbers. Fields that have their default are left out."""
    nodes: dict[str, Any] = {}
    stack = list(document.roots)
    while stack:
        node = stack.pop()
        if nodes.setdefault(node.id, None) is not None:
            raise Refusal(f"two nodes have the id {node.id}")
        nodes[node.id] = _row(node)
        stack += node.children
    table: dict[str, Any] = {"nodes": nodes}
    for family in FAMILIES:
        table[family] = [node.id for node in getattr(document, family)]
    table["parameters"] = [_parameter_row(parameter) for parameter in document.parameters]
    table["sets"] = [{"name": one.name, "values": [[n, _plain(v)] for n, v in one.values]} for one in document.sets]
    table["sections"] = [
        {"name": one.name, "point": _plain(one.point), "normal": _plain(one.normal), "active": one.active}
        for one in document.sections
    ]
    table["fonts"] = [
        {"name": one.name, "base": one.base, "face": one.face, "asset": one.asset} for one in document.fonts
    ]
    table["materials"] = [_changed(one, Material) for one in document.materials]
    table["lights"] = [_changed(one, Light) for one in document.lights]
    table["shading"] = document.shading
    there = {root.id for root in document.roots}
    pairs = [_changed(pair, PairCheck) for pair in document.checks.pairs if there.issuperset(pair.ends)]
    table["checks"] = {"clearance": _plain(document.checks.clearance), "pairs": pairs}
    table["motions"] = [
        {field.name: _plain(getattr(motion, field.name)) for field in dataclasses.fields(Motion)}
        for motion in document.motions
    ]
    table["notes"] = document.notes
    return table


def _row(node: Node) -> dict[str, Any]:
    kind = type(node)
    row: dict[str, Any] = {"kind": kind.__name__}
    for spec in field_specs(kind):
        value = getattr(node, spec.name)
        if value != _default(kind, spec.name):
            row[spec.name] = _plain(value)
    for name in ("name", "colour", "visible", "note"):
        value = getattr(node, name)
        if value != _default(Node, name):
            row[name] = value
    if node.material:
        row["material"] = node.material if isinstance(node.material, str) else node.material.name
    if node.mapping is not None:
        row["mapping"] = _changed(node.mapping, TextureMapping)
    if node.crease is not None:
        row["crease"] = _plain(node.crease)
    if node.placement.steps:
        row["placement"] = [[step.word, *(_plain(n) for n in step.numbers)] for step in node.placement.steps]
    if node.children:
        row["children"] = [child.id for child in node.children]
    return row


def _changed(value: _Dress, kind: type[_Dress]) -> dict[str, Any]:
    """The fields that have not their default."""
    found = ((field.name, getattr(value, field.name), field.default) for field in dataclasses.fields(kind))
    return {name: _plain(now) for name, now, default in found if now != default}


def _plain(value: Any) -> Any:
    """Expressions become text that begins with “=”, whole numbers lose their fraction."""
    if isinstance(value, Expression):
        return "=" + value.text
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return int(value)
    return value


def _parameter_row(parameter: Parameter) -> dict[str, Any]:
    row: dict[str, Any] = {"name": parameter.name, "value": _plain(parameter.value)}
    for name in ("minimum", "maximum", "choices", "note", "group"):
        value = getattr(parameter, name)
        if value not in (None, "", ()):
            row[name] = _plain(value)
    return row


Reuse = dict[str, tuple[dict[str, Any], Node]]
"""The rows read last time and their nodes, by id."""


def from_table(table: Mapping[str, Any], reuse: Reuse | None = None) -> Document:
    """The document of a table. Raises Refusal that names the node at fault.

    With `reuse`, rows that are as they were give the very nodes of last time, and it is brought up to date.
    """
    rows = _expect(table.get("nodes", {}), dict, "“nodes”")
    if len(rows) > MAX_NODES:
        raise Refusal(f"there are {len(rows):,} nodes; at most {MAX_NODES:,} are read")
    roots = {family: _ids(table.get(family, []), f"“{family}”") for family in FAMILIES}
    made: dict[str, Node] = {}
    owner: dict[str, str] = {}
    for family in FAMILIES:
        for root in roots[family]:
            _claim(owner, root, f"“{family}”")
            _build(root, rows, made, owner, reuse)
    if reuse is not None:
        for gone in reuse.keys() - made.keys():
            del reuse[gone]
    parameters = _expect(table.get("parameters", []), list, "“parameters”")
    return Document(
        **{family: tuple(made[root] for root in roots[family]) for family in FAMILIES},
        parameters=tuple(_parameter(row) for row in parameters),
        sets=tuple(_set(row) for row in _expect(table.get("sets", []), list, "“sets”")),
        sections=tuple(_section(row) for row in _expect(table.get("sections", []), list, "“sections”")),
        fonts=tuple(_font(row) for row in _expect(table.get("fonts", []), list, "“fonts”")),
        materials=tuple(
            _restored(row, "a material", Material) for row in _expect(table.get("materials", []), list, "“materials”")
        ),
        lights=tuple(_restored(row, "a light", Light) for row in _expect(table.get("lights", []), list, "“lights”")),
        shading=_expect(table.get("shading", ""), str, "“shading”"),
        checks=_checks(table.get("checks", {})),
        motions=tuple(_motion(row) for row in _expect(table.get("motions", []), list, "“motions”")),
        notes=_expect(table.get("notes", ""), str, "“notes”"),
    )


def _build(
    root: str, rows: Mapping[str, Any], made: dict[str, Node], owner: dict[str, str], reuse: Reuse | None
) -> None:
    stack: list[tuple[str, bool]] = [(root, False)]
    while stack:
        node_id, ready = stack.pop()
        row = rows.get(node_id)
        if not isinstance(row, dict):
            raise Refusal(f"node {node_id}, asked for by {owner[node_id]}, is missing")
        children = _ids(row.get("children", []), f"node {node_id}: “children”")
        if ready:
            below = tuple(made[child] for child in children)
            old = None if reuse is None else reuse.get(node_id)
            if old is not None and old[0] == row and all(map(operator.is_, old[1].children, below)):
                made[node_id] = old[1]
                continue
            made[node_id] = _node(node_id, row, below)
            if reuse is not None:
                reuse[node_id] = (row, made[node_id])
            continue
        stack.append((node_id, True))
        for child in children:
            _claim(owner, child, f"node {node_id}")
            stack.append((child, False))


def _claim(owner: dict[str, str], node_id: str, who: str) -> None:
    # A node has one place; this also rules out circles.
    if node_id in owner:
        raise Refusal(f"node {node_id} has two places, in {owner[node_id]} and in {who}: a circle or a double")
    owner[node_id] = who


def _node(node_id: str, row: Mapping[str, Any], children: tuple[Node, ...]) -> Node:
    name = row.get("kind")
    kind = KINDS.get(name) if isinstance(name, str) else None
    if kind is None or kind in (Node, Broken):
        raise Refusal(f"node {node_id} is of an unknown kind, {name!r:.60}")
    specs = {spec.name: spec for spec in field_specs(kind)}
    if kind is Instance and children:
        raise Refusal(f"node {node_id}: an instance holds no operands")
    known = {"kind", "name", "colour", "visible", "note", "material", "mapping", "crease", "placement", "children",
             *specs}  # fmt: skip
    try:
        extra = sorted(set(row) - known)
        if extra:
            raise Refusal(f"{kind.title} has no field {extra[0]!r:.60}")
        changes: dict[str, Any] = {}
        for name, spec in specs.items():
            if name in row:
                changes[name] = row[name] if spec.type in ("text", "letters", "choice") else _value(row[name])
        for name, wanted in (("name", str), ("note", str), ("visible", bool), ("material", str)):
            if name in row:
                changes[name] = _expect(row[name], wanted, f"“{name}”")
        if row.get("colour") is not None:
            changes["colour"] = hex_colour(row["colour"])
        if "mapping" in row:
            changes["mapping"] = _restored(row["mapping"], "a texture's mapping", TextureMapping)
        if "crease" in row:
            changes["crease"] = row["crease"]
        if "placement" in row:
            changes["placement"] = Placement(
                tuple(_step(step) for step in _expect(row["placement"], list, "“placement”"))
            )
        return kind(id=node_id, children=children, **changes)
    except Refusal as refusal:
        raise Refusal(f"node {node_id}: {refusal}") from None
    except (TypeError, ValueError, AttributeError):
        raise Refusal(f"node {node_id}: a field of this {kind.title.lower()} has the wrong form") from None


def _step(row: Any) -> Any:
    if not isinstance(row, list) or not row or not isinstance(row[0], str) or row[0] not in STEPS:
        raise Refusal(f"{row!r:.60} is no step of a placement; known are {', '.join(STEPS)}")
    return STEPS[row[0]](tuple(_value(number) for number in row[1:]))


def _value(value: Any, depth: int = 0) -> Any:
    if isinstance(value, list):
        if depth == 3:
            raise Refusal("a list stands too deep in other lists")
        return tuple(_value(item, depth + 1) for item in value)
    if isinstance(value, str) and value.startswith("="):
        return Expression(value[1:])
    return value


def _parameter(row: Any) -> Parameter:
    row = dict(_expect(row, dict, "a parameter"))
    names = {field.name for field in dataclasses.fields(Parameter)}
    extra = sorted(set(map(str, row)) - names)
    if extra or "name" not in row or "value" not in row:
        raise Refusal(
            f"the parameter {row.get('name', '?')!r:.60} has {'no value' if not extra else f'no field {extra[0]}'}"
        )
    for text in ("name", "note", "group"):
        row[text] = _expect(row.get(text, ""), str, f"a parameter's {text}")
    value: Number = _value(row.pop("value"))
    choices = _expect(row.pop("choices", []), list, f"the choices of {row['name']}")
    try:
        return Parameter(value=value, choices=tuple(choices), **row)
    except (TypeError, ValueError):
        raise Refusal(f"the parameter {row['name']!r:.60} has a field of the wrong form") from None


def _set(row: Any) -> ParameterSet:
    row = _fields(row, "a set of parameters", ParameterSet)
    pairs = [_expect(pair, list, "a value in a set of parameters") for pair in _expect(row["values"], list, "“values”")]
    return ParameterSet(row["name"], tuple((pair[0], _value(pair[1])) if len(pair) == 2 else pair for pair in pairs))


def _section(row: Any) -> Section:
    row = _fields(row, "a section", Section)
    return Section(row["name"], _value(row["point"]), _value(row["normal"]), row["active"])


def _font(row: Any) -> ProjectFont:
    return ProjectFont(**_fields(row, "a font", ProjectFont))


def _checks(row: Any) -> Checks:
    row = _expect(row, dict, "“checks”")
    if extra := sorted(map(str, row.keys() - {"clearance", "pairs"})):
        raise Refusal(f"“checks” has no field {extra[0]!r:.60}")
    pairs = [
        _restored({"one": "", "other": "", **_expect(pair, dict, "a checked pair")}, "a checked pair", PairCheck)
        for pair in _expect(row.get("pairs", []), list, "the pairs of “checks”")
    ]
    return Checks(row.get("clearance", 0.0), tuple(pairs))


def _motion(row: Any) -> Motion:
    return Motion(**_fields(row, "a motion", Motion))


def _restored(row: Any, what: str, kind: type[_Dress]) -> _Dress:
    row = _expect(row, dict, what)
    known = {field.name: field.default for field in dataclasses.fields(kind)}
    extra = sorted(map(str, row.keys() - known.keys()))
    if extra or ("name" in known and "name" not in row):
        raise Refusal(f"{what} has no field {extra[0]!r:.60}" if extra else f"{what} has no name")
    values: dict[str, Any] = {name: tuple(value) if isinstance(value, list) else value for name, value in row.items()}
    return kind(**values)


def _fields(row: Any, what: str, kind: type[ParameterSet | Section | ProjectFont | Motion]) -> dict[str, Any]:
    row = _expect(row, dict, what)
    names = {field.name for field in dataclasses.fields(kind)}
    wrong = sorted(names ^ set(row))
    if wrong:
        raise Refusal(f"{what} has {'no' if wrong[0] in names else 'an unknown'} field {wrong[0]!r:.60}")
    return row


def _ids(value: Any, what: str) -> list[str]:
    ids = _expect(value, list, what)
    for item in ids:
        if len(_expect(item, str, f"an id in {what}")) > MAX_ID:
            raise Refusal(f"an id in {what} has more than {MAX_ID} characters")
    return ids


def _expect(value: Any, wanted: type, what: str) -> Any:
    if not isinstance(value, wanted):
        names = {dict: "an object", list: "a list", str: "text", bool: "true or false"}
        raise Refusal(f"{what} must be {names[wanted]}, not {value!r:.60}")
    return value


def same_document(a: Document, b: Document) -> bool:
    """Whether two documents hold the same, names and colours included, ids apart."""
    return _anonymous(a) == _anonymous(b)


def _anonymous(document: Document) -> Any:
    table = to_table(document)
    order = {node.id: f"#{i}" for i, node in enumerate(walk(*document.roots))}
    rows = {}
    for node_id, row in table["nodes"].items():
        row = {**row, "children": [order[child] for child in row.get("children", [])]}
        if "definition" in row:
            row["definition"] = order.get(row["definition"], row["definition"])
        rows[order[node_id]] = row
    pairs = [
        {**row, **dict(zip(("one", "other"), sorted((order[row["one"]], order[row["other"]])), strict=True))}
        for row in table["checks"]["pairs"]
    ]
    fonts = [row for row in table["fonts"] if row["asset"]]  # which version of an installed font is no part of it
    return {
        **table,
        "nodes": rows,
        "fonts": fonts,
        "checks": {**table["checks"], "pairs": sorted(pairs, key=lambda row: (row["one"], row["other"]))},
        **{family: [order[i] for i in table[family]] for family in FAMILIES},
    }
