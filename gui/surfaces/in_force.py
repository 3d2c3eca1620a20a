"""The material that a node wears and the mapping of its bitmaps, by itself or by what it stands in."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from ...model.document.document import Document
from ...model.document.tree import trail
from ...model.surface.mapping import TextureMapping
from ...model.surface.material import Material


def material_in_force(document: Document, node_id: str) -> Material | None:
    """What a node wears, by itself or by what it stands in."""
    known = {material.name: material for material in document.materials}
    worn = (known.get(str(node.material)) for node in reversed(trail(document, node_id)))
    return next((material for material in worn if material is not None), None)


def mapping_in_force(document: Document, node_id: str) -> TextureMapping:
    """How bitmaps lie on a node, by itself or by what it stands in."""
    found = (node.mapping for node in reversed(trail(document, node_id)))
    return next((mapping for mapping in found if mapping is not None), TextureMapping())


def mapping_changes(document: Document, node_id: str) -> dict[str, Any]:
    """The fields that `set_mapping` is to be given beside what it changes, so that a node without a mapping of its own
    keeps the one that is in force."""
    if trail(document, node_id)[-1].mapping is not None:
        return {}
    plain = TextureMapping()
    return {k: v for k, v in asdict(mapping_in_force(document, node_id)).items() if v != getattr(plain, k)}
