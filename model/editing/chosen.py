"""What is selected, looked up once for all commands that ask whether they can be used."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from ..document.document import Document
from ..document.nodes import Node
from ..document.tree import FAMILIES
from .session import Session


@dataclass(frozen=True, slots=True)
class Chosen:
    """The selected nodes in the order of selection; for each the node above it (None for a root), its place among
    its siblings, and the family of its root: solids, profiles or definitions."""

    nodes: tuple[Node, ...] = ()
    above: tuple[Node | None, ...] = ()
    places: tuple[int, ...] = ()
    families: tuple[str, ...] = ()

    @property
    def in_definition(self) -> tuple[bool, ...]:
        """Whether they stand in a definition."""
        return tuple(family == "definitions" for family in self.families)


def chosen(session: Session) -> Chosen:
    return _looked_up(session.document, session.selection)


@lru_cache(maxsize=2)
def _looked_up(document: Document, selection: tuple[str, ...]) -> Chosen:
    wanted = set(selection)
    found: dict[str, tuple[Node, Node | None, int, str]] = {}
    for family in FAMILIES if wanted else ():
        roots = getattr(document, family)
        stack = [(root, None, place) for place, root in enumerate(roots)]
        while stack and len(found) < len(wanted):
            node, above, place = stack.pop()
            if node.id in wanted:
                found[node.id] = (node, above, place, family)
            stack += [(child, node, i) for i, child in enumerate(node.children)]
    rows = [found[node_id] for node_id in selection if node_id in found]
    return Chosen(*(tuple(column) for column in zip(*rows, strict=True))) if rows else Chosen()
