"""Nodes on their way through a clipboard: a small document of them, and how it comes into another document."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..document.document import Document, Parameter
from ..document.errors import Refusal
from ..document.expression import Expression, expressions_in
from ..document.nodes import Instance, Node
from ..document.outlines import Outlines
from ..document.placement import Placement
from ..document.tree import change_each, family_of, next_number, numbered, outermost, put, trail, trails, walk
from ..proximity.checks import Checks
from .checks import copied_pairs
from .fitting import carried_into, check_fit, check_tree, named_apart, steps_above
from .linking import check_definitions, used_definitions
from .parameters import declaring
from .surfaces import with_like_materials


def clip(document: Document, ids: Sequence[str]) -> Document:
    """The nodes as solids and profiles at their places in space, with the definitions and parameters that they need,
    and what is asked of pairs of them.

    Of a definition it is an instance.
    """
    roots = {root.id: root for root in document.definitions}
    nodes: list[Node] = []
    ways = trails(document, outermost(document, ids))
    for node_id, (*way, node) in ways.items():
        if node_id in roots:
            node = Instance(definition=node_id, name=node.label)
        elif not (way and way[0].id in roots):  # a definition has no one place in space
            node = node.with_(placement=Placement((*node.placement.steps, *steps_above(way))))
        nodes.append(node)
    needed = used_definitions(*nodes)
    stack = list(needed)
    while stack:
        one = roots.get(stack.pop())
        new = (used_definitions(one) if one is not None else set()) - needed
        needed |= new
        stack += new
    definitions = tuple(root for root in document.definitions if root.id in needed)
    # An instance of a node that is copied too would give its id away twice.
    roots = numbered(nodes, next_number(document))
    pairs = copied_pairs(document.checks.pairs, {old: new.id for old, new in zip(ways, roots, strict=True)})
    flat = Outlines(document.definitions)
    families: dict[str, list[Node]] = {"solids": [], "profiles": []}
    for root in roots:
        families[family_of(root, flat)].append(root)
    worn = {node.material for node in walk(*roots, *definitions)}
    return Document(solids=tuple(families["solids"]), profiles=tuple(families["profiles"]), definitions=definitions,
                    parameters=_used_parameters(document, roots + definitions),
                    materials=tuple(material for material in document.materials if material.name in worn),
                    checks=Checks(pairs=pairs))  # fmt: skip


def _used_parameters(document: Document, roots: tuple[Node, ...]) -> tuple[Parameter, ...]:
    by_name = {parameter.name: parameter for parameter in document.parameters}
    names = {name for node in walk(*roots) for expression in node.expressions() for name in expression.names()}
    stack = list(names)
    while stack:
        parameter = by_name.get(stack.pop())
        if parameter is not None and isinstance(parameter.value, Expression):
            new = parameter.value.names() - names
            names |= new
            stack += new
    return tuple(parameter for parameter in document.parameters if parameter.name in names)


def paste(document: Document, other: Document, parent_id: str | None = None, index: int | None = None) -> Document:
    """Put the solids and profiles of another document into this one, as operands of `parent_id` at `index` (None:
    last).

    They keep their place in space. Definitions that this document has already are shared; parameters of the same
    name keep the value that they have here.
    """
    if not isinstance(other, Document):
        raise Refusal(f"a document is needed, not {other!r:.60}")
    known = {parameter.name for parameter in document.parameters}
    document = document.with_(parameters=(*document.parameters, *(p for p in other.parameters if p.name not in known)))
    declaring(document, [list(expressions_in([p.value])) for p in other.parameters])
    declaring(document, [node.expressions() for node in walk(*other.roots)])
    document, other = with_like_materials(document, other)
    here = {root.id: root for root in document.definitions}
    coming = _unlike(other.definitions, here)
    roots = numbered((*coming, *other.standing), next_number(document))
    renamed = {root.id: root.id for root in other.definitions}
    renamed |= {old.id: new.id for old, new in zip(coming, roots, strict=False)}
    # One whose definition is missing must not come upon a node of this document by chance.
    carrier = Document(definitions=roots)
    instances = [node.id for node in walk(*roots) if isinstance(node, Instance)]
    carrier = change_each(carrier, instances, lambda node: node.with_(
        definition=renamed.get(node.definition, "")))  # type: ignore[attr-defined]  # fmt: skip
    new, nodes = carrier.definitions[: len(coming)], list(carrier.definitions[len(coming) :])
    document = document.with_(definitions=(*document.definitions, *new))
    way = () if parent_id is None else trail(document, parent_id)
    flat = Outlines(document.definitions)
    for node in nodes:
        check_tree(node, flat)
        check_fit(way[-1] if way else None, node, flat)
    check_definitions(document, nodes, parent_id)
    if not way:
        nodes = named_apart(document, nodes)
        copies = {old.id: new.id for old, new in zip(other.standing, nodes, strict=True)}
        pairs = (*document.checks.pairs, *copied_pairs(other.checks.pairs, copies))
        document = document.with_(checks=document.checks.with_(pairs=pairs))
    elif way[0].id not in here:
        nodes = [carried_into(node, steps_above(way)) for node in nodes]
    return put(document, nodes, parent_id, index)


def _unlike(definitions: Sequence[Node], here: Mapping[str, Node]) -> list[Node]:
    """Those that are not in `here` already: an equal one is another too where an instance in it means another."""
    unlike = {root.id for root in definitions if here.get(root.id) != root}
    uses = {root.id: used_definitions(root) for root in definitions}
    while more := {node_id for node_id, used in uses.items() if used & unlike} - unlike:
        unlike |= more
    return [root for root in definitions if root.id in unlike]
