"""The meshes in the picture with the colours of their faces, found anew only for what has changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...model.document.document import Document
from .occurrences import paint_of


class Painted:
    """`by_node` tints each face by the node that made it, instead of the nodes' own colours."""

    def __init__(self) -> None:
        self._kept: dict[str, tuple[Any, Any, Any, Any]] = {}
        self._by_node = False

    @property
    def meshes(self) -> list[Any]:
        """What `of` gave last."""
        return [mesh for _, _, mesh, _ in self._kept.values()]

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
        for root in document.standing:
            mesh = meshes.get(root.id)
            if mesh is None or not root.visible or not len(mesh.triangles):
                continue
            old = self._kept.get(root.id)
            if old is None or old[0] is not root or old[1] is not document.definitions or old[2] is not mesh:
                old = (root, document.definitions, mesh, paint_of(document, root, mesh, self._by_node))
            kept[root.id] = old
        self._kept = kept
        return {root_id: (mesh, paint) for root_id, (_, _, mesh, paint) in kept.items()}
