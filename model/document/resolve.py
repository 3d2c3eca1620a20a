"""A document with every expression replaced by its value and every instance filled in."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from dataclasses import dataclass

from .document import Document, parameter_values
from .errors import Refusal
from .nodes import Broken, Instance, Node, resolve_fields
from .project_font import ProjectFont, set_in


@dataclass(frozen=True, slots=True)
class Resolved:
    """Trees of plain numbers. A node without a value is a `Broken` of the same id that says why."""

    solids: tuple[Node, ...]
    values: dict[str, float]
    faults: dict[str, str]
    """Parameters that have no value, and why."""
    profiles: tuple[Node, ...] = ()

    @property
    def standing(self) -> tuple[Node, ...]:
        return self.solids + self.profiles


class Resolver:
    """Resolves documents one after another and remembers what it made, so that equal input gives identical nodes.

    Where another value of a parameter leaves a node's own numbers and all below as they were, it stays the same node.
    """

    def __init__(self) -> None:
        self._values: dict[str, float] = {}
        self._faults: dict[str, str] = {}
        self._made: dict[int, tuple[Node, Node]] = {}
        self._definitions: tuple[Node, ...] = ()
        self._fonts: tuple[ProjectFont, ...] = ()

    def resolve(self, document: Document) -> Resolved:
        values, faults = parameter_values(document.parameters)
        same = (values, faults) == (self._values, self._faults) and document.definitions is self._definitions
        same = same and document.fonts == self._fonts
        self._values, self._faults, self._definitions = values, faults, document.definitions
        self._fonts = document.fonts
        definitions = {node.id: node for node in document.definitions}
        before, self._made = self._made, {}
        solids, profiles = (
            tuple(self._node(root, values, faults, definitions, before, same) for root in family)
            for family in (document.solids, document.profiles)
        )
        return Resolved(solids, values, faults, profiles)

    def _node(
        self,
        root: Node,
        values: Mapping[str, float],
        faults: Mapping[str, str],
        definitions: Mapping[str, Node],
        before: dict[int, tuple[Node, Node]],
        same: bool,
    ) -> Node:
        # An explicit stack: (node, whether its children are done); `open_` holds the definitions being filled in.
        made = self._made
        stack: list[tuple[Node, bool]] = [(root, False)]
        open_: set[str] = set()
        while stack:
            node, ready = stack.pop()
            key = id(node)
            if key in made:
                continue
            if not node.symbolic:
                made[key] = (node, node)
                continue
            old = before.get(key)
            old = old if old is not None and old[0] is node else None
            if same and old is not None:
                made[key] = old
                continue
            definition = definitions.get(node.definition) if isinstance(node, Instance) else None
            if not ready:
                if definition is not None:
                    if definition.id in open_:
                        made[key] = (node, _broken(node, f"the definition “{definition.label}” holds itself"))
                        continue
                    open_.add(definition.id)
                stack.append((node, True))
                stack += [(child, False) for child in (node.children if definition is None else (definition,))]
                continue
            if definition is not None:
                open_.discard(definition.id)
                children = (made[id(definition)][1],)
            else:
                children = tuple(made[id(child)][1] for child in node.children)
            new = set_in(_resolved(node, values, faults, children, definition is None), self._fonts)
            made[key] = old if old is not None and _alike(old[1], new) else (node, new)
        return made[id(root)][1]


def _resolved(
    node: Node, values: Mapping[str, float], faults: Mapping[str, str], children: tuple[Node, ...], plain: bool
) -> Node:
    if isinstance(node, Instance) and plain:
        return _broken(node, f"the definition {node.definition or '?'} is not in the document")
    try:
        same = not isinstance(node, Instance) and all(map(operator.is_, children, node.children))
        if same and not node.expressions():
            return node
        return resolve_fields(node, values, children)
    except Refusal as refusal:
        asked = [name for expression in node.expressions() for name in sorted(expression.names())]
        wrong = next((faults[name] for name in asked if name in faults), None)
        return _broken(node, wrong or str(refusal), children)


def _alike(old: Node, new: Node) -> bool:
    """Whether two results for one node are the same, its operands by identity."""
    if old.digest != new.digest or len(old.children) != len(new.children):
        return False
    return all(a is b for a, b in zip(old.children, new.children, strict=True))


def _broken(node: Node, message: str, children: tuple[Node, ...] = ()) -> Broken:
    return Broken(
        id=node.id, name=node.name, visible=node.visible, message=message, stands_for=node.title, children=children
    )


def resolve(document: Document) -> Resolved:
    """The document's trees with plain numbers. Pure."""
    return Resolver().resolve(document)
