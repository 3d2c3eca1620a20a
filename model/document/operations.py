"""What can be done to a document: plain functions, document in, document out, that refuse in the user's words.

The console calls them by the same names, with the open document left out.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from .colours import hex_colour
from .document import Document, Parameter
from .errors import Refusal
from .expression import Expression, Number
from .nodes import KINDS, Broken, Difference, Instance, Intersection, Node, Union, field_specs
from .placement import Placement, Step
from .primitives import OUTLINES
from .tree import change, find, index_of, next_number, numbered, parent, trail, unique_name, walk
from .tree import insert as tree_insert

OPERATIONS: dict[str, Callable[..., Document]] = {}


def operation(function: Callable[..., Document]) -> Callable[..., Document]:
    OPERATIONS[function.__name__] = function
    return function


@operation
def insert(document: Document, node: Node, parent_id: str | None = None, index: int | None = None) -> Document:
    """Add a solid, or an operand of `parent_id` at `index` (None: last)."""
    (fresh,) = numbered([node], next_number(document))
    if parent_id is None and not fresh.name:
        fresh = fresh.with_(name=_solid_name(document, fresh.title))
    return tree_insert(document, fresh, parent_id, index)


@operation
def insert_document(document: Document, other: Document) -> Document:
    """Add all solids, definitions and parameters of another document; like-named parameters must agree."""
    known = {parameter.name: parameter for parameter in document.parameters}
    for parameter in other.parameters:
        if known.setdefault(parameter.name, parameter) != parameter:
            raise Refusal(f"both documents have a parameter {parameter.name}, with different values; rename one")
    roots = numbered([*other.solids, *other.definitions], next_number(document))
    renamed = {old.id: new.id for old, new in zip([*other.solids, *other.definitions], roots, strict=True)}
    result = document.with_(parameters=tuple(known.values()))
    for i, root in enumerate(roots):
        family = "solids" if i < len(other.solids) else "definitions"
        name = _solid_name(result, root.label) if family == "solids" else root.name
        result = result.with_(**{family: (*getattr(result, family), root.with_(name=name))})
    for node in [node for root in roots for node in walk(root) if isinstance(node, Instance)]:
        result = change(result, node.id, lambda n: n.with_(definition=renamed.get(n.definition, n.definition)))  # type: ignore[attr-defined]
    return result


@operation
def delete(document: Document, ids: Sequence[str]) -> Document:
    """Take nodes out of the document."""
    for node_id in _outermost(document, ids):
        nodes = trail(document, node_id)
        if any(node.id == nodes[0].id for node in document.definitions) and len(nodes) == 1:
            users = [n.label for n in walk(*document.roots) if isinstance(n, Instance) and n.definition == node_id]
            if users:
                raise Refusal(f"“{nodes[0].label}” is still used by {users[0]}; delete or unlink that first")
        if len(nodes) > 1 and len(nodes[-2].children) <= type(nodes[-2]).operands[0]:
            raise Refusal(f"“{nodes[-2].label}” cannot be without “{nodes[-1].label}”; delete it as a whole")
        document = change(document, node_id, lambda node: None)
    return document


@operation
def rename(document: Document, node_id: str, name: str) -> Document:
    """Give a node a name; solids have names of their own."""
    name = " ".join(str(name).split())
    if any(root.id == node_id for root in document.solids):
        if not name:
            raise Refusal("a solid needs a name")
        if any(root.name == name and root.id != node_id for root in document.solids):
            raise Refusal(f"there is a solid called “{name}” already")
    return change(document, node_id, lambda node: node if node.name == name else node.with_(name=name))


@operation
def set_field(document: Document, node_id: str, field: str, value: Any) -> Document:
    """Change one geometric field of a node; text is read as a number or an expression."""
    node = find(document, node_id)
    spec = next((spec for spec in field_specs(type(node)) if spec.name == field), None)
    if spec is None:
        raise Refusal(f"{node.title} has no field {field!r:.60}")
    checked = spec.checked(value, node.title)
    _check_names(document, checked)
    if checked == getattr(node, field):
        return document
    return change(document, node_id, lambda node: node.with_(**{field: checked}))


@operation
def place(document: Document, node_id: str, *steps: Step) -> Document:
    """Give a node these placement steps instead of its own."""
    for step in steps:
        _check_names(document, step.numbers)
    placement = Placement(tuple(steps))
    return change(
        document, node_id, lambda node: node if node.placement == placement else node.with_(placement=placement)
    )


@operation
def move(document: Document, ids: Sequence[str], x: Number = 0.0, y: Number = 0.0, z: Number = 0.0) -> Document:
    """Move nodes by millimetres, in their parent's axes."""
    for node_id in _outermost(document, ids):
        document = change(document, node_id, lambda node: node.at(x, y, z))
    return document


@operation
def set_colour(document: Document, ids: Sequence[str], colour: str | None) -> Document:
    """Colour nodes; None takes the colour away."""
    plain = None if colour is None else hex_colour(colour)
    for node_id in ids:
        document = change(document, node_id, lambda node: node if node.colour == plain else node.with_(colour=plain))
    return document


@operation
def set_visible(document: Document, ids: Sequence[str], visible: bool) -> Document:
    """Show or hide nodes."""
    for node_id in ids:
        document = change(document, node_id, lambda n: n if n.visible is visible else n.with_(visible=bool(visible)))
    return document


@operation
def set_note(document: Document, node_id: str, note: str) -> Document:
    """Attach a note to a node."""
    return change(document, node_id, lambda node: node if node.note == note else node.with_(note=str(note)))


@operation
def combine(document: Document, kind: str, ids: Sequence[str]) -> Document:
    """Put nodes under a new operation, which takes the place of the first; `kind` as in scripts, such as `union`."""
    operation_kind = _kind(kind)
    ids = _outermost(document, ids)
    if not ids:
        raise Refusal(f"select what the {operation_kind.title.lower()} should take")
    nodes = [find(document, node_id) for node_id in ids]
    most = operation_kind.operands[1]
    if most is not None and len(nodes) > most:
        wrapped: list[Node] = [Union(children=tuple(nodes))]
    else:
        wrapped = nodes
    if any(isinstance(node, OUTLINES) for node in nodes):
        raise Refusal(f"an outline is flat; a {operation_kind.title.lower()} takes solids")
    root = parent(document, ids[0]) is None
    number = next_number(document)
    if wrapped is not nodes:
        wrapped = [wrapped[0].with_(id=f"n{number + 1}")]
    new = operation_kind(id=f"n{number}", children=tuple(wrapped))
    if root:
        others = [solid.name for solid in document.solids if solid.id not in ids]
        new = new.with_(name=unique_name(new.title, others))
    above, index = parent(document, ids[0]), index_of(document, ids[0])
    if above is not None:
        index -= sum(child.id in ids[1:] for child in above.children[:index])
    else:
        index -= sum(solid.id in ids[1:] for solid in document.solids[:index])
    for node_id in ids:
        document = _taken_out(document, node_id, above)
    return tree_insert_unchecked(document, new, None if above is None else above.id, index)


def tree_insert_unchecked(document: Document, node: Node, parent_id: str | None, index: int) -> Document:
    """Insert where an operand has just been taken out, so that the parent may be full again."""
    if parent_id is None:
        return document.with_(solids=(*document.solids[:index], node, *document.solids[index:]))
    return change(
        document,
        parent_id,
        lambda above: above.with_(children=(*above.children[:index], node, *above.children[index:])),
    )


def _taken_out(document: Document, node_id: str, keeper: Node | None) -> Document:
    """Without the node; a parent that cannot be without it, other than `keeper`, makes the change refused."""
    above = parent(document, node_id)
    free = above is None or (keeper is not None and above.id == keeper.id)
    if above is not None and not free and len(above.children) <= type(above).operands[0]:
        raise Refusal(f"“{above.label}” cannot be without “{find(document, node_id).label}”")
    return change(document, node_id, lambda node: None)


@operation
def dissolve(document: Document, node_id: str) -> Document:
    """Replace an operation by its operands, which keep their place in space."""
    node = find(document, node_id)
    if not node.children:
        raise Refusal(f"“{node.label}” has no operands to set free")
    above, index = parent(document, node_id), index_of(document, node_id)
    most = None if above is None else type(above).operands[1]
    if above is not None and most is not None and len(above.children) - 1 + len(node.children) > most:
        raise Refusal(f"“{above.label}” takes only {most} operand{'' if most == 1 else 's'}")
    freed = [c.with_(placement=Placement(c.placement.steps + node.placement.steps)) for c in node.children]
    family = document.solids if above is None else above.children
    if above is None:
        names = {root.name for root in document.solids if root.id != node_id}
        for i, child in enumerate(freed):
            freed[i] = child.with_(name=unique_name(child.label, names))
            names.add(freed[i].name)
    new = (*family[:index], *freed, *family[index + 1 :])
    if above is None:
        return document.with_(solids=new)
    return change(document, above.id, lambda above: above.with_(children=new))


@operation
def change_kind(document: Document, node_id: str, kind: str) -> Document:
    """Turn an operation into another one with the same operands."""
    wanted = _kind(kind)
    node = find(document, node_id)
    if isinstance(node, wanted):
        return document
    if not node.children or wanted.operands[0] > len(node.children):
        raise Refusal(f"“{node.label}” cannot become a {wanted.title.lower()}")
    if wanted.operands[1] is not None and len(node.children) > wanted.operands[1]:
        raise Refusal(f"a {wanted.title.lower()} takes only {wanted.operands[1]} operand")
    kept = {n: getattr(node, n) for n in ("id", "name", "colour", "visible", "note", "placement", "children")}
    return change(document, node_id, lambda node: wanted(**kept))


@operation
def relocate(document: Document, ids: Sequence[str], parent_id: str | None, index: int | None = None) -> Document:
    """Move nodes to another place in the tree, before the sibling now at `index` (None: last)."""
    ids = _outermost(document, ids)
    if parent_id is not None and any(node.id in ids for node in trail(document, parent_id)):
        raise Refusal("a node cannot be moved into itself")
    nodes = [find(document, node_id) for node_id in ids]
    if parent_id is not None:
        above = find(document, parent_id)
        most = type(above).operands[1]
        coming = [node for node in nodes if all(node is not child for child in above.children)]
        if most is not None and len(above.children) + len(coming) > most:
            raise Refusal(
                f"“{above.label}” takes {'no' if not most else f'only {most}'} operand{'' if most == 1 else 's'}"
            )
    family = document.solids if parent_id is None else find(document, parent_id).children
    place_ = len(family) if index is None else index
    place_ -= sum(any(node is member for node in nodes) for member in family[:place_])
    keeper = None if parent_id is None else find(document, parent_id)
    for node_id in ids:
        document = _taken_out(document, node_id, keeper)
    for i, node in enumerate(nodes):
        if parent_id is None:
            node = node.with_(name=_solid_name(document, node.label))
        document = tree_insert_unchecked(document, node, parent_id, place_ + i)
    return document


@operation
def duplicate(document: Document, ids: Sequence[str]) -> Document:
    """Copy nodes, each beside its original."""
    for node_id in _outermost(document, ids):
        above = parent(document, node_id)
        document = insert(document, find(document, node_id).with_(name=_copy_name(document, node_id)),
                          None if above is None else above.id, index_of(document, node_id) + 1)  # fmt: skip
    return document


@operation
def link(document: Document, node_id: str) -> Document:
    """Make a node a definition, with an instance in its place, so that it can be used more than once."""
    node = find(document, node_id)
    if isinstance(node, Instance):
        raise Refusal(f"“{node.label}” is an instance already; duplicate it to use it once more")
    number = next_number(document)
    kept = {name: getattr(node, name) for name in ("name", "placement", "colour", "visible")}
    instance = Instance(id=f"n{number}", definition=node_id, **kept)
    document = change(document, node_id, lambda node: instance)
    definition = node.with_(placement=Placement(), colour=None, visible=True, name=node.label)
    return document.with_(definitions=(*document.definitions, definition))


@operation
def unlink(document: Document, node_id: str) -> Document:
    """Replace an instance by a copy of its definition; a definition that nobody uses any more goes."""
    node = find(document, node_id)
    if not isinstance(node, Instance):
        raise Refusal(f"“{node.label}” is not an instance")
    definition = find(document, node.definition)
    (copy,) = numbered([definition], next_number(document))
    kept = {name: getattr(node, name) for name in ("id", "name", "colour", "visible", "note")}
    copy = copy.with_(**kept, placement=Placement(copy.placement.steps + node.placement.steps))
    document = change(document, node_id, lambda node: copy)
    if not any(isinstance(n, Instance) and n.definition == definition.id for n in walk(*document.roots)):
        document = document.with_(definitions=tuple(d for d in document.definitions if d is not definition))
    return document


@operation
def set_parameter(document: Document, name: str, value: Number | str, **more: Any) -> Document:
    """Give a parameter a value, or declare it; `minimum`, `maximum`, `choices`, `note`, `group` as in scripts."""
    new = next((p for p in document.parameters if p.name == name), None)
    new = Parameter(name, value, **more) if new is None else new.with_(value=value, **more)  # type: ignore[arg-type]
    _check_names(document, new.value, {name})
    kept = [new if parameter.name == name else parameter for parameter in document.parameters]
    if new in document.parameters:
        return document
    return document.with_(parameters=tuple(kept if any(p is new for p in kept) else [*kept, new]))


@operation
def delete_parameter(document: Document, name: str) -> Document:
    """Take a parameter out that no expression uses."""
    document.parameter(name)
    for node in walk(*document.roots):
        if node.symbolic and name in _names_of([*node.values().values(), *(s.numbers for s in node.placement.steps)]):
            raise Refusal(f"the parameter {name} is used by “{node.label}”")
    for parameter in document.parameters:
        if parameter.name != name and name in _names_of(parameter.value):
            raise Refusal(f"the parameter {name} is used by the parameter {parameter.name}")
    return document.with_(parameters=tuple(p for p in document.parameters if p.name != name))


def _names_of(value: Any) -> set[str]:
    if isinstance(value, Expression):
        return set(value.names())
    if isinstance(value, tuple | list):
        return {name for item in value for name in _names_of(item)}
    return set()


def _check_names(document: Document, value: Any, also: set[str] = frozenset()) -> None:  # type: ignore[assignment]
    missing = sorted(_names_of(value) - {p.name for p in document.parameters} - also)
    if missing:
        raise Refusal(f"there is no parameter called {missing[0]}")


def _kind(word: str | type[Node]) -> type[Node]:
    from .echo import function_name

    for kind in KINDS.values():
        if kind not in (Node, Broken) and word in (kind, kind.__name__, function_name(kind)):
            return kind
    raise Refusal(f"there is no operation called {word!r:.60}")


def _outermost(document: Document, ids: Sequence[str]) -> list[str]:
    """The ids without doubles and without those that lie below another of them, in the order given."""
    wanted = list(dict.fromkeys([ids] if isinstance(ids, str) else ids))
    chosen = set(wanted)
    return [i for i in wanted if not any(node.id in chosen for node in trail(document, i)[:-1])]


def _solid_name(document: Document, wanted: str) -> str:
    return unique_name(wanted, [root.name for root in document.solids])


def _copy_name(document: Document, node_id: str) -> str:
    node = find(document, node_id)
    if any(root is node for root in document.solids):
        return _solid_name(document, node.name)
    return node.name


BOOLEANS: tuple[type[Node], ...] = (Union, Difference, Intersection)
