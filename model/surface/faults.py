"""What is wrong with the bitmaps of a document's materials, told of the nodes that wear them."""

from __future__ import annotations

from ..document.document import Document
from ..document.errors import Refusal
from ..document.tree import walk
from ..worker.shown import Message
from .bitmaps import texels_of
from .material import BITMAPS, MOST_BITMAPS


def bitmap_faults(document: Document) -> tuple[Message, ...]:
    """Bitmaps that are missing or cannot be read, and more than a picture shows at once; each told once a material."""
    materials = {material.name: material for material in document.materials}
    if not materials:
        return ()
    found: list[Message] = []
    used: dict[tuple[str, str], None] = {}
    told: set[str] = set()
    for node in walk(*document.roots, *document.definitions):
        material = materials.get(str(node.material))
        if material is None or material.name in told:
            continue
        told.add(material.name)
        for field in BITMAPS:
            sha = getattr(material, field)
            if not sha:
                continue
            try:
                texels_of(sha)
            except Refusal as refusal:
                found.append(Message(node.id, node.label, f"the material “{material.name}”: {refusal}", False))
                continue
            used[(field, sha)] = None
            if len(used) == MOST_BITMAPS + 1:
                words = f"a picture shows {MOST_BITMAPS} bitmaps at once: those of “{material.name}” are left out"
                found.append(Message(node.id, node.label, words, False))
    return tuple(found)
