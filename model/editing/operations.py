"""What can be done to a document: plain functions, document in, document out, that refuse in the user's words.

The console calls them by the same names, with the open document left out. Here stand those that dress and size a
node; structure.py, linking.py and parameters.py hold the others; OPERATIONS is the list of all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..document.colours import hex_colour
from ..document.document import Document
from ..document.errors import Refusal
from ..document.expression import Number
from ..document.nodes import Instance, field_specs
from ..document.placement import Placement, Step, moved
from ..document.tree import change, change_each, find, outermost
from .linking import check_definitions, insert_document, link, unlink
from .parameters import declaring, delete_parameter, rename_parameter, set_parameter
from .structure import change_kind, combine, delete, dissolve, duplicate, insert, relocate, replace


def rename(document: Document, node_id: str, name: str) -> Document:
    """Give a node a name; solids have names of their own."""
    name = " ".join(str(name).split())
    if any(root.id == node_id for root in document.solids):
        if not name:
            raise Refusal("a solid needs a name")
        if any(root.name == name and root.id != node_id for root in document.solids):
            raise Refusal(f"there is a solid called “{name}” already")
    return change(document, node_id, lambda node: node if node.name == name else node.with_(name=name))


def set_field(document: Document, node_id: str, field: str, value: Any) -> Document:
    """Change one geometric field of a node; text is read as a number or an expression."""
    node = find(document, node_id)
    spec = next((spec for spec in field_specs(type(node)) if spec.name == field), None)
    if spec is None:
        raise Refusal(f"{node.title} has no field {field!r:.60}")
    checked = spec.checked(value, node.title)
    if checked == getattr(node, field):
        return document
    new = node.with_(**{field: checked})
    if isinstance(node, Instance):
        check_definitions(document, [new], node_id)
    return change(declaring(document, checked), node_id, lambda node: new)


def place(document: Document, node_id: str, *steps: Step) -> Document:
    """Give a node these placement steps instead of its own."""
    placement = Placement(tuple(steps))
    node = find(document, node_id)
    if node.placement == placement:
        return document
    document = declaring(document, [step.numbers for step in steps])
    return change(document, node_id, lambda node: node.with_(placement=placement))


def move(document: Document, ids: Sequence[str], x: Number = 0.0, y: Number = 0.0, z: Number = 0.0) -> Document:
    """Move nodes by millimetres, in their parent's axes."""
    document = declaring(document, moved(x, y, z).numbers)
    return change_each(document, outermost(document, ids), lambda node: node.at(x, y, z))


def set_colour(document: Document, ids: Sequence[str], colour: str | None) -> Document:
    """Colour nodes; None takes the colour away."""
    plain = None if colour is None else hex_colour(colour)
    return change_each(document, ids, lambda node: node if node.colour == plain else node.with_(colour=plain))


def set_visible(document: Document, ids: Sequence[str], visible: bool) -> Document:
    """Show or hide nodes."""
    shown = bool(visible)
    return change_each(document, ids, lambda node: node if node.visible is shown else node.with_(visible=shown))


def set_note(document: Document, node_id: str, note: str) -> Document:
    """Attach a note to a node."""
    text = str(note)
    return change(document, node_id, lambda node: node if node.note == text else node.with_(note=text))


OPERATIONS: dict[str, Callable[..., Document]] = {
    function.__name__: function
    for function in (
        insert, insert_document, replace, delete, combine, dissolve, change_kind, relocate, duplicate, link, unlink,
        rename, set_field, place, move, set_colour, set_visible, set_note,
        set_parameter, rename_parameter, delete_parameter,
    )
}  # fmt: skip
