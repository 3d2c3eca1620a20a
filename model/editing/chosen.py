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
    its siblings, and whether it stands in a definition."""

    nodes: tuple[Node, ...] = ()
    above: tuple[Node | None, ...] = ()
    places: tuple[int, ...] = ()
    in_definition: tuple[bool, ...] = ()


def chosen(session: Session) -> Chosen:
    return _looked_up(session.document, session.selection)


@lru_cache(maxsize=2)
def _looked_up(document: Document, selection: tuple[str, ...]) -> Chosen:
    wanted = set(selection)
    found: dict[str, tuple[Node, Node | None, int, bool]] = {}
    for family in FAMILIES if wanted else ():
        roots = getattr(document, family)
        stack = [(root, None, place) for place, root in enumerate(roots)]
        while stack and len(found) < len(wanted):
            node, above, place = stack.pop()
            if node.id in wanted:
                found[node.id] = (node, above, place, family == "definitions")
            stack += [(child, node, i) for i, child in enumerate(node.children)]
    rows = [found[node_id] for node_id in selection if node_id in found]
    return Chosen(*(tuple(column) for column in zip(*rows, strict=True))) if rows else Chosen()
