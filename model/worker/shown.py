"""What the window shows of evaluated solids, and the pictures it keeps: light to import, for a window that starts."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..document.document import Document
from ..document.nodes import Node
from ..document.resolve import Resolver
from ..measuring.measure import Measures
from ..solid.display import DisplayMesh
from ..solid.provenance import occurrences


@dataclass(frozen=True, slots=True)
class Message:
    """Something to tell about a node."""

    node_id: str
    name: str
    message: str
    error: bool

    @property
    def sentence(self) -> str:
        """The message with the node's name before it, unless it names that itself."""
        return self.message if self.message.startswith(self.name) else f"{self.name}: {self.message}"


@dataclass(frozen=True, slots=True)
class ShownSolid:
    """What a picture shows of one root. Equal keys are the same picture; `mesh` is None where the solid failed."""

    key: bytes
    mesh: DisplayMesh | None
    measures: Measures | None


@dataclass(frozen=True, slots=True)
class Shown:
    """The visible solids and profiles by their root's id, and what there is to tell about nodes."""

    solids: dict[str, ShownSolid]
    outlines: dict[str, ShownSolid]
    problems: tuple[Message, ...]


@dataclass(frozen=True, slots=True)
class Part:
    """A node by itself: its surface in its own axes, before its placement, and the measures of its first place.

    Equal keys have the same surface; `mesh` is None where there is none.
    """

    key: bytes
    mesh: DisplayMesh | None
    measures: Measures | None


def shown_key(root: Node, tolerance: float) -> bytes:
    """What a shown solid is kept under: its value, in place, at a tolerance, with its creases."""
    return root.digest + root.creases + f"{tolerance!r}".encode()


def relabelled(mesh: DisplayMesh, root: Node) -> DisplayMesh:
    """The mesh of an equal tree with the ids of this one."""
    owners = tuple(occurrence.path for occurrence in occurrences(root))
    return mesh if owners == mesh.owners else replace(mesh, owners=owners)


@dataclass(frozen=True, slots=True)
class _Kept:
    """A picture, and its messages with the way down to their node: the index of an operand at each level."""

    solid: ShownSolid
    messages: tuple[tuple[tuple[int, ...], Message], ...]


class Pictures:
    """The pictures of the last solids by key, up to `limit` bytes, so that going back to them asks nobody."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._resolver = Resolver()
        self._kept: OrderedDict[bytes, _Kept] = OrderedDict()
        self._last: dict[str, ShownSolid] = {}

    def keys(self) -> set[bytes]:
        return set(self._kept)

    def complete(self, document: Document, tolerance: float) -> bool:
        """Whether everything visible of the document is kept."""
        return all(shown_key(root, tolerance) in self._kept for root, _ in self._roots(document))

    def keep(self, document: Document, answers: Sequence[tuple[Any, ...]]) -> None:
        """Take a worker's answers for the visible solids and profiles: (key, mesh, measures, messages), or the key of a
        kept one."""
        for (root, _), answer in zip(self._roots(document), answers, strict=True):
            if len(answer) > 1:
                key, mesh, measures, messages = answer
                ways = _ways(root, {message.node_id for message in messages})
                placed = tuple((ways.get(message.node_id, ()), message) for message in messages)
                self._kept[key] = _Kept(ShownSolid(key, mesh, measures), placed)
        held = sum(_bytes(kept.solid) for kept in self._kept.values())
        current = {answer[0] for answer in answers}
        for key in list(self._kept):
            if held <= self._limit:
                break
            if key not in current:
                held -= _bytes(self._kept.pop(key).solid)

    def shown(self, document: Document, tolerance: float) -> Shown:
        """The document's pictures, all of which must be kept, with the ids of this document."""
        solids: dict[str, ShownSolid] = {}
        problems: list[Message] = []
        outlines: dict[str, ShownSolid] = {}
        for root, is_solid in self._roots(document):
            key = shown_key(root, tolerance)
            kept = self._kept[key]
            self._kept.move_to_end(key)
            solid = self._last.get(root.id)
            if solid is None or solid.key != key or not _same_ids(solid, root):
                mesh = None if kept.solid.mesh is None else relabelled(kept.solid.mesh, root)
                solid = kept.solid if mesh is kept.solid.mesh else ShownSolid(key, mesh, kept.solid.measures)
            (solids if is_solid else outlines)[root.id] = solid
            for way, message in kept.messages:
                node = root
                for index in way:
                    node = node.children[index]
                problems.append(Message(node.id, node.label, message.message, message.error))
        self._last = solids | outlines
        return Shown(solids, outlines, tuple(problems))

    def _roots(self, document: Document) -> list[tuple[Node, bool]]:
        """The visible roots in the order of a worker's answers, each with whether it is a solid."""
        resolved = self._resolver.resolve(document)
        roots = [(root, True) for root in resolved.solids] + [(root, False) for root in resolved.profiles]
        return [(root, is_solid) for root, is_solid in roots if root.visible]


def _ways(root: Node, ids: set[str]) -> dict[str, tuple[int, ...]]:
    """The way down to each of these nodes: the index of the operand at each level."""
    found: dict[str, tuple[int, ...]] = {}
    stack: list[tuple[Node, tuple[int, ...]]] = [(root, ())] if ids else []
    while stack and len(found) < len(ids):
        node, way = stack.pop()
        if node.id in ids:
            found.setdefault(node.id, way)
        stack += [(child, (*way, i)) for i, child in enumerate(node.children)]
    return found


def _same_ids(solid: ShownSolid, root: Node) -> bool:
    return solid.mesh is None or relabelled(solid.mesh, root) is solid.mesh


def _bytes(solid: ShownSolid) -> int:
    mesh = solid.mesh
    if mesh is None:
        return 100
    arrays = (mesh.points, mesh.normals, mesh.triangles, mesh.owner, mesh.facet, mesh.edge_points, mesh.edges,
              mesh.vertices, mesh.corners)  # fmt: skip
    return sum(array.nbytes for array in arrays)
