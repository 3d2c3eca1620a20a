"""Finding and changing nodes of a document. Every change returns a new document that shares what it did not touch.

Places are told by ids, which are unique in a document. Nothing here recurses: trees may be hundreds of levels deep.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from .document import Document
from .errors import Refusal
from .nodes import Node

MAX_NODES = 1_000_000


def walk(*roots: Node) -> Iterator[Node]:
    """Every node of the trees, parents before their children, in the order of the tree."""
    stack = list(reversed(roots))
    while stack:
        node = stack.pop()
        yield node
        stack += reversed(node.children)


def find(document: Document, node_id: str) -> Node:
    """The node with this id. Raises Refusal."""
    return trail(document, node_id)[-1]


def trail(document: Document, node_id: str) -> tuple[Node, ...]:
    """The nodes from the root down to the one with this id. Raises Refusal."""
    for root in document.roots:
        above: list[Node] = []
        stack: list[tuple[Node, int]] = [(root, 0)]
        while stack:
            node, depth = stack.pop()
            del above[depth:]
            above.append(node)
            if node.id == node_id:
                return tuple(above)
            stack += [(child, depth + 1) for child in reversed(node.children)]
    raise Refusal(f"there is no node {node_id} in the document")


def parent(document: Document, node_id: str) -> Node | None:
    """The node above, or None for a root. Raises Refusal."""
    nodes = trail(document, node_id)
    return nodes[-2] if len(nodes) > 1 else None


def change(document: Document, node_id: str, function: Callable[[Node], Node | None]) -> Document:
    """The document with `function` applied to one node; None takes the node out. Raises Refusal."""
    nodes = trail(document, node_id)
    new = function(nodes[-1])
    if new is nodes[-1]:
        return document
    for above, below in zip(reversed(nodes[:-1]), reversed(nodes[1:]), strict=True):
        new = above.with_(children=_swapped(above.children, below, new))
    for family in ("solids", "profiles", "definitions"):
        roots = getattr(document, family)
        if any(root is nodes[0] for root in roots):
            return document.with_(**{family: _swapped(roots, nodes[0], new)})
    raise AssertionError(node_id)


def _swapped(family: tuple[Node, ...], old: Node, new: Node | None) -> tuple[Node, ...]:
    place = next(i for i, member in enumerate(family) if member is old)
    return family[:place] + (() if new is None else (new,)) + family[place + 1 :]


def insert(document: Document, node: Node, parent_id: str | None = None, index: int | None = None) -> Document:
    """The document with `node` as a new solid, or as an operand of the parent, at `index` (None: last)."""

    def inserted(family: tuple[Node, ...]) -> tuple[Node, ...]:
        place = len(family) if index is None else index
        return (*family[:place], node, *family[place:])

    if parent_id is None:
        return document.with_(solids=inserted(document.solids))
    above = find(document, parent_id)
    most = type(above).operands[1]
    if most is not None and len(above.children) >= most:
        kind = type(above).title
        raise Refusal(f"{kind} takes no further operand" if most else f"“{above.label}” is a {kind.lower()}: "
                      "it holds no operands")  # fmt: skip
    return change(document, parent_id, lambda above: above.with_(children=inserted(above.children)))


def index_of(document: Document, node_id: str) -> int:
    """The node's place among its siblings. Raises Refusal."""
    *above, chosen = trail(document, node_id)
    families = (above[-1].children,) if above else (document.solids, document.profiles, document.definitions)
    return next(i for family in families for i, node in enumerate(family) if node is chosen)


def numbered(roots: Iterable[Node], first: int = 1) -> tuple[Node, ...]:
    """The trees with the ids n1, n2, ... in reading order, so that the same steps always give the same ids.

    Raises Refusal where the trees, written out, have more than a million nodes.
    """
    count = first - 1
    results: list[Node] = []
    for root in roots:
        # (node, None) on the way down, (node, its new id) on the way up; `done` is the operands' stack.
        done: list[Node] = []
        stack: list[tuple[Node, str | None]] = [(root, None)]
        while stack:
            node, new_id = stack.pop()
            if new_id is None:
                count += 1
                if count - first >= MAX_NODES:
                    raise Refusal(
                        f"the tree has more than {MAX_NODES:,} nodes; use instances or arrays for what repeats"
                    )
                new_id = f"n{count}"
                stack.append((node, new_id))
                stack += [(child, None) for child in reversed(node.children)]
                continue
            size = len(node.children)
            children = tuple(done[len(done) - size :])
            del done[len(done) - size :]
            same = all(a is b for a, b in zip(children, node.children, strict=True))
            done.append(node if same and new_id == node.id else node.with_(id=new_id, children=children))
        results += done
    return tuple(results)


def next_number(document: Document) -> int:
    """The first number above those of all ids in the document."""
    ids = (node.id[1:] for node in walk(*document.roots))
    return 1 + max((int(digits) for digits in ids if digits.isdecimal()), default=0)


def unique_name(wanted: str, taken: Iterable[str]) -> str:
    """`wanted`, or with the first number behind it that makes it unlike all that are taken."""
    used = set(taken)
    if wanted not in used:
        return wanted
    stem = wanted.rstrip("0123456789 ") or wanted
    number = 2
    while f"{stem} {number}" in used:
        number += 1
    return f"{stem} {number}"
