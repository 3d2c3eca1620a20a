"""The font that a lettering is set in, as its form asks for it."""

from __future__ import annotations

from ....model.document.document import Document
from ....model.document.errors import Refusal
from ....model.document.nodes import Node, resolve_fields
from ....model.document.outlines import Lettering
from ....model.document.project_font import set_in
from ....model.lettering.fonts.face import Face


def lettering_in(document: Document, node: Node, values: dict[str, float]) -> Lettering | None:
    """The lettering with its numbers, in the font file that the document has for it; None where it has none."""
    try:
        found = set_in(resolve_fields(node, values, ()), document.fonts)
    except Refusal:
        return None
    return found if isinstance(found, Lettering) else None


def face_in_use(document: Document, node: Node, values: dict[str, float]) -> Face | None:
    """The font's face; None where it is missing or broken, which the problems tell."""
    from ....model.lettering.fonts.library import face_of

    lettering = lettering_in(document, node, values)
    if lettering is None:
        return None
    try:
        return face_of(lettering.font, lettering.asset, int(float(lettering.face)))  # type: ignore[arg-type]
    except Refusal:
        return None
