"""Finding and changing nodes of a document. Every change returns a new document that shares what it did not touch.

Places are told by ids, which are unique in a document. Nothing here recurses: trees may be hundreds of levels deep.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

from .document import Document
from .errors import Refusal
from .nodes import Instance, Node
from .outlines import Outlines

MAX_NODES = 1_000_000
FAMILIES = ("solids", "profiles", "definitions")


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


def chosen_solids(document: Document, name: str | None) -> list[Node]:
    """The solids of this name, or all that are visible for None. Raises Refusal where none is called so."""
    if name is None:
        return [root for root in document.solids if root.visible]
    found = [root for root in document.solids if root.name == name]
    if not found:
        names = ", ".join(f"“{root.name}”" for root in document.solids)
        raise Refusal(f"there is no solid called “{name}”; there is {names or 'none at all'}")
    return found


def trail(document: Document, node_id: str) -> tuple[Node, ...]:
    """The nodes from the root down to the one with this id. Raises Refusal."""
    return trails(document, [node_id])[node_id]


def trails(document: Document, ids: Iterable[str]) -> dict[str, tuple[Node, ...]]:
    """`trail` for many nodes in one go, in the order of the ids. Raises Refusal."""
    wanted = list(ids)
    missing = dict.fromkeys(wanted)
    found: dict[str, tuple[Node, ...]] = {}
    for root in document.roots:
        above: list[Node] = []
        stack: list[tuple[Node, int]] = [(root, 0)]
        while stack and missing:
            node, depth = stack.pop()
            del above[depth:]
            above.append(node)
            if node.id in missing:
                del missing[node.id]
                found[node.id] = tuple(above)
            stack += [(child, depth + 1) for child in reversed(node.children)]
    for node_id in missing:
        raise Refusal(f"there is no node {node_id} in the document")
    return {node_id: found[node_id] for node_id in wanted}


def homes(document: Document, ids: Iterable[str]) -> dict[str, Node]:
    """The roots of the trees that hold these nodes, by id, in the order of the ids; unknown ids are left out."""
    wanted = list(ids)
    missing = set(wanted)
    held: dict[str, Node] = {}
    for root in document.roots:
        if not missing:
            break
        for node in walk(root):
            if node.id in missing:
                missing.discard(node.id)
                held[node.id] = root
    return {held[node_id].id: held[node_id] for node_id in wanted if node_id in held}


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
    return _with_roots(document, lambda root: new if root is nodes[0] else root)


def _with_roots(document: Document, changed: Callable[[Node], Node | None]) -> Document:
    """The document with its roots replaced, or taken out (None); one that has become an outline, or has ceased to be
    one, goes to the end of its new family."""
    changes: dict[str, tuple[Node, ...]] = {}
    leaving: list[Node] = []
    flat = Outlines(document.definitions)
    for family in reversed(FAMILIES):  # definitions first: they tell what their instances are
        roots = getattr(document, family)
        kept: list[Node] = []
        for old in roots:
            new = changed(old)
            if new is None:
                continue
            if new is not old and family != "definitions" and family != family_of(new, flat):
                leaving.append(new)
            else:
                kept.append(new)
        if len(kept) < len(roots) or any(a is not b for a, b in zip(kept, roots, strict=True)):
            changes[family] = tuple(kept)
            flat = Outlines(changes[family]) if family == "definitions" else flat
    for root in leaving:
        family = family_of(root, flat)
        held = changes[family] if family in changes else getattr(document, family)
        changes[family] = (*held, root)
    return document.with_(**changes) if changes else document


def family_of(root: Node, flat: Outlines) -> str:
    """Where a root stands that is no definition."""
    return "profiles" if root in flat else "solids"


def _swapped(family: tuple[Node, ...], old: Node, new: Node | None) -> tuple[Node, ...]:
    place = next(i for i, member in enumerate(family) if member is old)
    return family[:place] + (() if new is None else (new,)) + family[place + 1 :]


def listed(ids: Iterable[str] | str) -> list[str]:
    """Ids as operations take them: one or many, without doubles. Raises Refusal."""
    try:
        wanted = list(dict.fromkeys([ids] if isinstance(ids, str) else ids))
    except TypeError:
        raise Refusal(f"nodes are told by their ids, not {ids!r:.60}") from None
    for item in wanted:
        if not isinstance(item, str):
            raise Refusal(f"a node is told by its id, not {item!r:.60}")
    return wanted


def outermost(document: Document, ids: Iterable[str] | str) -> list[str]:
    """The ids without doubles and without those that lie below another of them, in the order given. Raises Refusal."""
    wanted = listed(ids)
    missing = dict.fromkeys(wanted)
    outer: set[str] = set()
    stack = [(root, False) for root in document.roots]
    while stack:
        node, inside = stack.pop()
        if node.id in missing:
            del missing[node.id]
            if not inside:
                outer.add(node.id)
                inside = True
        stack += [(child, inside) for child in node.children]
    for node_id in missing:
        raise Refusal(f"there is no node {node_id} in the document")
    return [node_id for node_id in wanted if node_id in outer]


def change_each(document: Document, ids: Iterable[str] | str, function: Callable[[Node], Node | None]) -> Document:
    """Like `change` for many nodes, in one go, operands before what they stand in. Raises Refusal."""
    wanted = set(listed(ids))
    above: dict[str, str | None] = {root.id: None for root in document.roots}
    for node in walk(*document.roots):
        for child in node.children:
            above[child.id] = node.id
    touched: set[str] = set()
    for node_id in wanted:
        if node_id not in above:
            raise Refusal(f"there is no node {node_id} in the document")
        place: str | None = node_id
        while place is not None and place not in touched:
            touched.add(place)
            place = above[place]
    new: dict[str, Node | None] = {}
    stack = [(root, False) for root in document.roots if root.id in touched]
    while stack:
        node, ready = stack.pop()
        if not ready:
            stack.append((node, True))
            stack += [(child, False) for child in node.children if child.id in touched]
            continue
        made = _over(node, [new.get(child.id, child) for child in node.children])
        new[node.id] = function(made) if node.id in wanted else made
    return _with_roots(document, lambda root: new.get(root.id, root))


def _over(node: Node, children: list[Node | None]) -> Node:
    kept = tuple(child for child in children if child is not None)
    if len(kept) < len(children):
        if len(kept) < type(node).operands[0]:
            gone = next(old for old, new in zip(node.children, children, strict=True) if new is None)
            raise Refusal(f"“{node.label}” cannot be without “{gone.label}”")
    elif all(a is b for a, b in zip(kept, node.children, strict=True)):
        return node
    return node.with_(children=kept)


def room(node: Node) -> int | None:
    """How many operands more the node takes; None: any number."""
    most = 0 if isinstance(node, Instance) else type(node).operands[1]
    return None if most is None else max(most - len(node.children), 0)


def check_room(above: Node, count: int) -> None:
    """Raises Refusal where the node takes less than so many operands more."""
    left, most = room(above), type(above).operands[1]
    if left is not None and count > left:
        if isinstance(above, Instance) or not most:
            raise Refusal(f"“{above.label}” holds no operands")
        raise Refusal(f"“{above.label}” takes only {most} operand{'' if most == 1 else 's'}")


def put(document: Document, nodes: Iterable[Node], parent_id: str | None = None, index: int | None = None) -> Document:
    """The document with the nodes as solids and profiles, or as operands of the parent, from `index` on (None: last).

    Without a parent the index is a place in the family of the first node, solids or profiles; nodes of the other one
    come last in it. Raises Refusal.
    """
    new = tuple(nodes)

    def family(old: tuple[Node, ...], new: tuple[Node, ...], index: int | None) -> tuple[Node, ...]:
        place = position(old, index)
        return (*old[:place], *new, *old[place:])

    if parent_id is None:
        flat = Outlines(document.definitions)
        apart: dict[str, list[Node]] = {}
        for node in new:
            apart.setdefault(family_of(node, flat), []).append(node)
        return document.with_(**{
            name: family(getattr(document, name), tuple(nodes), index if place == 0 else None)
            for place, (name, nodes) in enumerate(apart.items())
        })  # fmt: skip
    check_room(find(document, parent_id), len(new))
    return change(document, parent_id, lambda node: node.with_(children=family(node.children, new, index)))


def insert(document: Document, node: Node, parent_id: str | None = None, index: int | None = None) -> Document:
    """`put` for one node."""
    return put(document, (node,), parent_id, index)


def position(family: tuple[Node, ...], index: int | None) -> int:
    """`index` as a place among siblings; None: behind the last. Raises Refusal."""
    if index is None:
        return len(family)
    if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index <= len(family):
        raise Refusal(f"there is no place {index!r:.60}; places go from 0 to {len(family)}")
    return index


def index_of(document: Document, node_id: str) -> int:
    """The node's place among its siblings. Raises Refusal."""
    *above, chosen = trail(document, node_id)
    families = (above[-1].children,) if above else tuple(getattr(document, family) for family in FAMILIES)
    return next(i for family in families for i, node in enumerate(family) if node is chosen)


def numbered(roots: Iterable[Node], first: int = 1) -> tuple[Node, ...]:
    """The trees with the ids n1, n2, ... in reading order, so that the same steps always give the same ids.

    Raises Refusal where the trees, written out, have more than a million nodes.
    """
    roots = tuple(roots)
    if _written_out(roots) > MAX_NODES:
        raise Refusal(f"the tree has more than {MAX_NODES:,} nodes; use instances or arrays for what repeats")
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


def _written_out(roots: tuple[Node, ...]) -> int:
    """How many nodes the trees have where a node that stands in several places counts at each of them."""
    sizes: dict[int, int] = {}
    stack = [(root, False) for root in roots]
    while stack:
        node, ready = stack.pop()
        if id(node) in sizes:
            continue
        if ready:
            sizes[id(node)] = 1 + sum(sizes[id(child)] for child in node.children)
        else:
            stack.append((node, True))
            stack += [(child, False) for child in node.children]
    return sum(sizes[id(root)] for root in roots)


def next_number(document: Document) -> int:
    """The first number above those of all ids in the document, and of solids that are gone but had been checked."""
    there = [node.id for node in walk(*document.roots)] + [end for pair in document.checks.pairs for end in pair.ends]
    ids = (node_id[1:] for node_id in there if len(node_id) < 1000)
    return 1 + max((int(digits) for digits in ids if digits.isdecimal()), default=0)


def unique_name(wanted: str, taken: Iterable[str]) -> str:
    """`wanted`, or with the first number behind it that makes it unlike all that are taken: Box, Box 2, Box 3."""
    return Names(taken).take(wanted)


class Names:
    """Names of many things, each unlike the others; see `unique_name`."""

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._used = set(taken)
        self._next: dict[str, int] = {}

    def take(self, wanted: str) -> str:
        """`wanted`, or with a number behind it; it is taken then."""
        name = wanted
        if name in self._used:
            stem = re.sub(r" \d+$", "", wanted)
            number = self._next.get(stem, 2)  # all below are taken, and stay so
            while (name := f"{stem} {number}") in self._used:
                number += 1
            self._next[stem] = number + 1
        self._used.add(name)
        return name
