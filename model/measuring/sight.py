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
from .visibility import TEXELS, Eye
from .visible_parts import PartView, face_triangles, part_triangles, part_view, solid_of, words_of

if TYPE_CHECKING:
    from ..partition.tree import Tree
    from ..solid.display import DisplayMesh

Vector = tuple[float, float, float]

FACE_REACH = 1e-4
"""Of the scene's size: how far from a face a point may be that tells which one is meant."""
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


@dataclass(frozen=True, slots=True, eq=False)
class NamedView:
    """What is seen of a part or a face from a place: the `share` of the area turned there, 0 to 1, to within `error`;
    the share that each solid hides, by name; `words` that say so; and the texels: `points` (n, 3), `areas` (n,) in mm²,
    `state` (n,) 0 seen, 1 hidden, 2 turned away, and `obstacle` (n,), the name of what hides it or ""."""

    share: float
    error: float
    hiders: dict[str, float]
    words: str
    points: np.ndarray
    areas: np.ndarray
    state: np.ndarray
    obstacle: np.ndarray


class SolidRays:
    """Rays through the tree of meshes, and what they tell of these."""

    def __init__(self, tree: Tree, meshes: Sequence[DisplayMesh]) -> None:
        """The faces of the tree are the triangles of the meshes, as of `faces_of_meshes`."""
        self.rays = Rays(tree)
        self.meshes = tuple(meshes)
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

    def all_hits(self, origin: ArrayLike, direction: ArrayLike) -> tuple[Hit, ...]:
        """All faces on a ray, the nearest first; one that it begins on counts. Of an edge only one is told, and of
        triangles of a flat face side by side. Raises ValueError."""
        found = self.rays.all(origin, direction)
        facet = np.concatenate([mesh.facet for mesh in self.meshes])[found.face]
        solid = np.searchsorted(self._ends, found.face, side="right")
        keep: list[int] = []
        for k in range(len(found.face)):
            again = keep and found.distance[k] - found.distance[keep[-1]] <= END * self.rays.size
            if not (again and solid[k] == solid[keep[-1]] and (facet[k] == facet[keep[-1]] or
                    found.front[k] == found.front[keep[-1]])):  # fmt: skip
                keep.append(k)
        return tuple(self.rays.hit_at(origin, direction, float(found.distance[k]), int(found.face[k])) for k in keep)

    def seen(self, solid_id: str, triangles: np.ndarray, eye: Eye, texels: int = TEXELS) -> PartView:
        """See `part_view`."""
        return part_view(self.rays, self.meshes, solid_id, triangles, eye, texels)

    def face_at(self, point: ArrayLike, solid_id: str = "") -> tuple[str, np.ndarray] | None:
        """The solid's id and the triangles of the smooth face that a point (3,) is on; None where it is on none."""
        for face in self.rays.at(np.asarray(point, float), FACE_REACH * self.rays.size)[1]:
            mesh, triangle = self._mesh_of(int(face))
            if solid_id in ("", solid_of(mesh)):
                return solid_of(mesh), face_triangles(mesh, triangle)
        return None

    def mesh(self, solid_id: str) -> DisplayMesh | None:
        """The solid's own; None where it is not among them."""
        return next((mesh for mesh in self.meshes if solid_of(mesh) == solid_id), None)

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

    def solids_at(self, faces: np.ndarray) -> np.ndarray:
        """(n,) the places of the meshes that faces (n,) of the tree are of, -1 for -1."""
        return np.where(faces >= 0, np.searchsorted(self._ends, faces, side="right"), -1)

    def _mesh_of(self, face: int) -> tuple[DisplayMesh, int]:
        number = int(np.searchsorted(self._ends, face, side="right"))
        mesh = self.meshes[number]
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

    def all_hits(self, origin: ArrayLike, direction: ArrayLike) -> tuple[NodeHit, ...]:
        """All faces on a ray, the nearest first, each told once where it meets an edge. Raises Refusal."""
        try:
            found = self._solids.all_hits(vector(origin, "origin"), vector(direction, "direction"))
        except ValueError as error:
            raise Refusal(str(error)) from None
        return tuple(self._named(hit) for hit in found)

    def view_of(self, part: str, eye: ArrayLike, parallel: bool = False) -> NamedView:
        """What an eye (3,) sees of the first node of this name; `parallel`: from far away, where `eye` points to."""
        path = next((path for path in self._paths() if self._names[str(path[-1])] == part), None)
        if path is None:
            names = ", ".join(f"“{name}”" for name in dict.fromkeys(self._names[str(p[-1])] for p in self._paths()))
            raise Refusal(f"nothing that is visible is called “{part}”; there is {names}")
        mesh = self._solids.mesh(str(path[0]))
        assert mesh is not None
        return self._view(str(path[0]), part, part_triangles(mesh, path), eye, parallel)

    def map_of(self, eye: ArrayLike, point: ArrayLike, parallel: bool = False) -> NamedView:
        """What an eye (3,) sees of the smooth face at a point (3,) on it. Raises Refusal where there is none."""
        here = vector(point, "point on the face")
        face = self._solids.face_at(here)
        if face is None:
            raise Refusal(f"no face is at {tuple(here.tolist())}")
        return self._view(face[0], self._names[face[0]], face[1], eye, parallel)

    def _view(self, solid_id: str, part: str, triangles: np.ndarray, eye: ArrayLike, parallel: bool) -> NamedView:
        place = vector(eye, "eye")
        try:
            view = self._solids.seen(solid_id, triangles, Eye((place[0], place[1], place[2]), parallel))
        except ValueError as error:
            raise Refusal(str(error)) from None
        hidden = self._solids.solids_at(view.visibility.obstacle)
        words = words_of(view, f"“{part}”", self._names, "there")
        return NamedView(
            view.share,
            view.visibility.error,
            {self._names[other]: share for other, share in view.hiders},
            words,
            view.visibility.points,
            view.visibility.areas,
            view.visibility.state,
            np.array([*(self._names[solid_of(mesh)] for mesh in self._solids.meshes), ""])[hidden],
        )

    def _paths(self) -> list[Path]:
        """The solids' own, and those of what is in them from above down, the solids first."""
        whole = {path[: k + 1]: None for mesh in self._solids.meshes for path in mesh.owners for k in range(len(path))}
        return sorted((path for path in whole if isinstance(path[-1], str)), key=len)

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
