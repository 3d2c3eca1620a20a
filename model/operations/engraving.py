"""Outlines cut into a solid, or raised from it."""

from __future__ import annotations

from ..document.document import Document
from ..document.errors import Refusal
from ..document.expression import Number, number
from ..document.nodes import Difference, Node, Union
from ..document.outlines import Outlines
from ..document.placement import Step
from ..document.tree import find
from .outlining import make_solid
from .placing import place
from .relocating import relocate
from .structure import combine

OVERLAP = 0.1
"""Share of the depth by which an engraving begins above the face, and raised outlines below it: flush faces are no
cut."""


def engrave(
    document: Document,
    outline_id: str,
    solid_id: str,
    *steps: Step,
    depth: Number = 1.0,
    draft: Number = 0.0,
    raised: bool = False,
    radius: Number | None = None,
) -> Document:
    """Cut an outline that stands by itself into a solid, or raise it, by `depth` mm.

    `steps` place it on the face, its z axis out of the solid; none: where it stands. `draft` in degrees makes an
    engraving narrower with its depth, and what is raised narrower to its top. With `radius` the outline is laid round
    a cylinder of it, which it touches at its origin. The outline stays as it is, as the operand of an extrusion or a
    wrap, which becomes an operand of the solid.
    """
    outline, solid = find(document, outline_id), find(document, solid_id)
    flat = Outlines(document.definitions)
    if outline not in flat or all(root is not outline for root in document.profiles):
        raise Refusal(f"“{outline.label}” is no outline that stands by itself")
    if solid in flat or all(root is not solid for root in document.solids):
        raise Refusal(f"“{solid.label}” is no solid that stands by itself")
    deep, lean = number(depth, "the depth"), number(draft, "the draft")
    if isinstance(deep, float) and deep <= 0.0:
        raise Refusal(f"the depth must be above 0 mm, not {deep:g}")
    if radius is not None and lean != 0.0:
        raise Refusal("what is laid round a cylinder has no draft")
    over = deep * OVERLAP
    fields: dict[str, Number] = {"height": deep if raised else over, "below": over if raised else deep}
    if radius is None:
        fields["taper"] = lean
    else:
        fields["radius"] = radius
    before = {root.id for root in document.solids}
    if steps:
        document = place(document, outline_id, *steps)
    document = make_solid(document, "extrude" if radius is None else "wrap", [outline_id], **fields)
    (new,) = (root.id for root in document.solids if root.id not in before)
    wanted: type[Node] = Union if raised else Difference
    if type(solid) is wanted and solid.children:
        return relocate(document, [new], solid_id)
    return combine(document, "union" if raised else "difference", [solid_id, new], solid.name)
