"""The row of a node's form for the angle at which its faces stop to look smooth."""

from __future__ import annotations

from typing import Any

from ...model.document.document import Document
from ...model.document.nodes import Node
from ...model.document.tree import trail, walk
from ..panels.form import Form
from ..panels.number_field import Steps
from ..panels.property_edit import Edit
from ..panels.property_fields import NumberRow
from ..surfaces.rows import plain_number

STEPS = Steps(5.0, 1.0, 15.0, minimum=0.0, maximum=180.0)
TIP = "Faces that meet at less than this look smooth, at more there is an edge: 0 all flat, 180 all smooth"


class CreaseRow(NumberRow):
    """Empty: as what the node is part of, or as its kind has it."""

    def __init__(self, form: Form, ids: list[str]) -> None:
        edit = Edit(form.session, "set_crease", "Change crease angle", self._arguments)
        super().__init__("Crease", "°", STEPS, edit.preview, edit.commit, edit.cancel, TIP, True, form)
        self._form, self._ids = form, ids
        self.field.setObjectName("crease")
        form.rows.append(self._refresh)
        form.column.addWidget(self)

    def _arguments(self, document: Document, value: Any) -> tuple[Any, ...]:
        return self._ids, None if value is None else plain_number(value, "the crease angle")

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        document = self._form.session.view
        wanted = set(self._ids)
        nodes = [node] if len(self._ids) == 1 else [one for one in walk(*document.roots) if one.id in wanted]
        angles = {one.crease for one in nodes}
        own = next(iter(angles)) if len(angles) == 1 else None
        self.set_value(own, own)
        self.field.setPlaceholderText("several" if len(angles) > 1 else _from_above(self._form.session.document, node))


def _from_above(document: Document, node: Node) -> str:
    """What holds for a node that says nothing itself."""
    found = (one.crease for one in reversed(trail(document, node.id)[:-1]))
    above = next((crease for crease in found if crease is not None), None)
    return "auto" if above is None else f"as its parent: {above:g}"
