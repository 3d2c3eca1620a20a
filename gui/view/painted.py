"""The meshes in the picture with the colours of their faces, found anew only for what has changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...model.document.document import Document
from ...model.document.nodes import Node
from ...model.document.resolve import Resolver
from .occurrences import paint_of


class Painted:
    """`by_node` tints each face by the node that made it, instead of the nodes' own colours."""

    def __init__(self) -> None:
        self._kept: dict[str, tuple[Any, ...]] = {}
        self._by_node = False
        self._resolver = Resolver()

    @property
    def meshes(self) -> list[Any]:
        """What `of` gave last."""
        return [kept[1] for kept in self._kept.values()]

    def set_by_node(self, by_node: bool) -> bool:
        """Whether that is another choice."""
        if by_node == self._by_node:
            return False
        self._by_node = by_node
        self._kept = {}
        return True

    def of(self, document: Document, meshes: Mapping[str, Any]) -> dict[str, tuple[Any, Any]]:
        """The mesh and the paint of each visible solid or profile that has faces, by its id."""
        kept = {}
        resolved: dict[str, Node] = {}
        if document.materials:
            resolved = {root.id: root for root in self._resolver.resolve(document).standing}
        for root in document.standing:
            mesh = meshes.get(root.id)
            if mesh is None or not root.visible or not len(mesh.triangles):
                continue
            old = self._kept.get(root.id)
            made_of = (root, mesh, document.definitions, document.materials, resolved.get(root.id))
            if old is None or any(a is not b for a, b in zip(old, made_of, strict=False)):
                paint = paint_of(document, root, mesh, self._by_node, None if mesh.sheet else resolved.get(root.id))
                old = (*made_of, paint)
            kept[root.id] = old
        self._kept = kept
        return {root_id: (made[1], made[-1]) for root_id, made in kept.items()}
