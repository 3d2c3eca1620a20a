"""Rays and lines of sight past evaluated solids, with the nodes whose faces they meet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..document.document import Document
from ..document.errors import Refusal
from ..document.tree import chosen_solids, walk
from ..partition.build import build
from ..partition.faces import faces_of_meshes
from ..partition.rays import END, Hit, Rays
from ..partition.sight import Sight, line_of_sight
from ..solid.provenance import Path
from ..solid.tessellation import DEFAULT_TOLERANCE

if TYPE_CHECKING:
    from ..partition.tree import Tree
    from ..solid.display import DisplayMesh

Vector = tuple[float, float, float]

MOST_EDGES = 300
"""Edges that are drawn to show a node."""


@dataclass(frozen=True, slots=True)
class NodeHit:
    """Where a ray meets a face: millimetres from its origin, and the node that made the face.

    `normal` points out of the solid; `front` tells that the ray came from outside. `path` names the nodes from the root
    down, with the number of the copy below an array or a mirror; `name` is the last one's, `solid` the first one's.
    """

    distance: float
    point: Vector
    normal: Vector
    front: bool
    name: str
    solid: str
    path: tuple[str | int, ...]


class SolidRays:
    """Rays through the tree of meshes, and what they tell of these."""

    def __init__(self, tree: Tree, meshes: Sequence[DisplayMesh]) -> None:
        """The faces of the tree are the triangles of the meshes, as of `faces_of_meshes`."""
        self.rays = Rays(tree)
        self._meshes = tuple(meshes)
        self._ends = np.cumsum([len(mesh.triangles) for mesh in meshes])

    def first_hit(self, origin: ArrayLike, direction: ArrayLike) -> Hit | None:
        """The first face on a ray; one that it begins on does not count. Raises ValueError."""
        return self.rays.hit(origin, direction, END * self.rays.size)

    def sight(self, a: ArrayLike, b: ArrayLike) -> Sight:
        """See `line_of_sight`."""
        return line_of_sight(self.rays, a, b)

    def about(self, point: ArrayLike, normal: ArrayLike) -> tuple[Hit | None, Hit | None]:
        """What stands before a face and what ends the wall below it, from a point (3,) on it with its normal (3,)."""
        gap = self.first_hit(point, normal)
        wall = self.first_hit(point, -np.asarray(normal, float))
        return gap, None if wall is None or wall.front else wall

    def owner(self, face: int) -> Path:
        """The way from the root to the node that made a face of the tree."""
        mesh, triangle = self._mesh_of(face)
        owner = int(mesh.owner[triangle])
        return mesh.owners[owner] if owner >= 0 else mesh.owners[0][:1]

    def outline(self, hit: Hit) -> np.ndarray:
        """(n, 2, 3) the border of the flat face that was hit and the edges of its node; of many those nearest to it."""
        mesh, triangle = self._mesh_of(hit.face)
        corners = mesh.corners[mesh.facet == mesh.facet[triangle]].astype(np.int64)
        sides = np.stack((corners, corners[:, [1, 2, 0]]), axis=-1).reshape(-1, 2)
        keys = sides.min(axis=1) * len(mesh.vertices) + sides.max(axis=1)
        _, first, times = np.unique(keys, return_index=True, return_counts=True)
        near = (mesh.owner[mesh.edge_sides] == mesh.owner[triangle]).any(axis=1)
        found = np.concatenate((mesh.vertices[sides[first[times == 1]]], mesh.edge_points[mesh.edges[near]]))
        away = np.linalg.norm(found.mean(axis=1) - hit.point, axis=1)
        return found[np.argsort(away, kind="stable")[:MOST_EDGES]]

    def _mesh_of(self, face: int) -> tuple[DisplayMesh, int]:
        number = int(np.searchsorted(self._ends, face, side="right"))
        mesh = self._meshes[number]
        return mesh, face - int(self._ends[number]) + len(mesh.triangles)


class Scenery:
    """The visible solids of a document, evaluated, with their tree; one build for however many rays."""

    def __init__(
        self,
        document: Document,
        tolerance: float = DEFAULT_TOLERANCE,
        solid: str | None = None,
        progress: Callable[[str], None] | None = None,
    ) -> None:
        """`solid` names the one that counts alone. Raises Refusal where it is not there, or one failed."""
        from ..solid.results import evaluate_document

        wanted = [root.id for root in chosen_solids(document, solid)]
        if not wanted:
            raise Refusal("no solid is visible" if document.solids else "the document holds no solid")
        evaluation = evaluate_document(document, tolerance, wanted, progress=progress)
        self.messages = evaluation.messages
        meshes = []
        for result in evaluation.solids:
            mesh = evaluation.display(result)
            failed = result.solid is None and next((m for m in result.messages if m.error), None)
            if mesh is None or (failed and not len(mesh.triangles)):
                raise Refusal(f"“{result.root.name}”: {failed.message if failed else 'it has no surface'}")
            meshes.append(mesh)
        self._names = {node.id: node.label for node in walk(*(result.root for result in evaluation.solids))}
        self._solids = SolidRays(build(faces_of_meshes(meshes)), meshes)

    def first_hit(self, origin: ArrayLike, direction: ArrayLike) -> NodeHit | None:
        """The first face on a ray; None for a miss. A ray that begins on a face goes on from there. Raises Refusal."""
        try:
            hit = self._solids.first_hit(vector(origin, "origin"), vector(direction, "direction"))
        except ValueError as error:
            raise Refusal(str(error)) from None
        return None if hit is None else self._named(hit)

    def obstacle(self, a: ArrayLike, b: ArrayLike) -> NodeHit | None:
        """What stands between two points, seen from the first one; None where they see each other. Raises Refusal."""
        hit = self._solids.sight(vector(a, "first point"), vector(b, "second point")).obstacle
        return None if hit is None else self._named(hit)

    def _named(self, hit: Hit) -> NodeHit:
        path = tuple(step if isinstance(step, int) else self._names[step] for step in self._solids.owner(hit.face))
        words = [step for step in path if isinstance(step, str)]
        return NodeHit(hit.distance, hit.point, hit.normal, hit.front, words[-1], words[0], path)


def vector(value: ArrayLike, what: str) -> np.ndarray:
    """Three finite numbers (3,). Raises Refusal."""
    try:
        found = np.asarray(value, float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.shape != (3,) or not np.isfinite(found).all():
        raise Refusal(f"the {what} of a ray is three numbers, not {value!r:.60}")
    return found
