"""What can be done to a document: plain functions, document in, document out, that refuse in the user's words.

The console calls them by the same names, with the open document left out. Here stand those that dress and size a
node; structure.py, relocating.py, placing.py, arranging.py, linking.py, pasting.py and parameters.py hold the others;
OPERATIONS is the list of all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..document.colours import hex_colour
from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Instance, field_specs
from ..document.tree import change, change_each, find, listed
from .arranging import shift
from .linking import check_definitions, insert_document, link, unlink
from .parameter_sets import apply_set, delete_set, put_sets, rename_set, save_set, set_parameters
from .parameters import declaring, delete_parameter, rename_parameter, reorder_parameter, set_parameter
from .pasting import paste
from .placing import move, place, scale, shifted_within, turn
from .relocating import copy_to, duplicate, promote, relocate, reorder, swap
from .sections import add_section, delete_section, rename_section, set_section
from .structure import change_kind, combine, delete, dissolve, insert, replace


def rename(document: Document, node_id: str, name: str) -> Document:
    """Give a node a name; solids have names of their own."""
    name = " ".join(str(name).split())
    if any(root.id == node_id for root in document.solids):
        if not name:
            raise Refusal("a solid needs a name")
        if any(root.name == name and root.id != node_id for root in document.solids):
            raise Refusal(f"there is a solid called “{name}” already")
    return change(document, node_id, lambda node: node if node.name == name else node.with_(name=name))


def rename_each(document: Document, ids: Sequence[str] | str, pattern: str) -> Document:
    """Give nodes names with a number each, 1 for the first; it takes the place of `#`, or stands behind the words."""
    words, wanted = " ".join(str(pattern).split()), listed(ids)
    if words and "#" not in words and len(wanted) > 1:
        words += " #"
    names = {node_id: words.replace("#", str(number)) for number, node_id in enumerate(wanted, 1)}
    taken = {root.name for root in document.solids if root.id not in names}
    for root in document.solids:
        name = names.get(root.id, root.name)
        if not name:
            raise Refusal("a solid needs a name")
        if root.id in names and name in taken:
            raise Refusal(f"there is a solid called “{name}” already")
        taken.add(name)
    return change_each(
        document, wanted, lambda node: node if node.name == names[node.id] else node.with_(name=names[node.id])
    )


def set_field(document: Document, node_id: str, field: str, value: Any) -> Document:
    """Change one geometric field of a node; text is read as a number or an expression."""
    return _with_fields(document, node_id, {field: value})


def set_fields(document: Document, node_id: str, shift: Sequence[float] | None = None, **values: Any) -> Document:
    """Change several geometric fields of a node at once; `shift` moves it along its own axes, by their millimetres, so
    that the far side of what grows can stay where it is."""
    return _with_fields(document, node_id, values, shift)


def _with_fields(
    document: Document, node_id: str, values: dict[str, Any], shift: Sequence[float] | None = None
) -> Document:
    node = find(document, node_id)
    specs = {spec.name: spec for spec in field_specs(type(node))}
    for field in values:
        if field not in specs:
            raise Refusal(f"{node.title} has no field {field!r:.60}")
    checked = {field: specs[field].checked(value, node.title) for field, value in values.items()}
    changed = {field: value for field, value in checked.items() if value != getattr(node, field)}
    if shift is not None:
        placement = shifted_within(document, node.placement, shift)
        if placement != node.placement:
            changed["placement"] = placement
    if not changed:
        return document
    new = node.with_(**changed)
    if isinstance(node, Instance):
        check_definitions(document, [new], node_id)
    return change(declaring(document, list(checked.values())), node_id, lambda node: new)


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
        insert, insert_document, paste, replace, delete, combine, dissolve, change_kind, relocate, copy_to, duplicate,
        reorder, promote, swap, link, unlink, rename, rename_each, set_field, set_fields, place, move, turn, scale,
        shift, set_colour, set_visible, set_note,
        set_parameter, rename_parameter, delete_parameter, reorder_parameter, set_parameters,
        save_set, put_sets, apply_set, rename_set, delete_set,
        add_section, set_section, rename_section, delete_section,
    )
}  # fmt: skip
