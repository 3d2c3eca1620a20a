"""The point that the Pipeline panel follows: a vertex of a solid, told in the axes of the node that made it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...model.document.errors import Refusal
from ...model.document.placement import IDENTITY, Affine, Move, Placement, inverse, product
from ...model.pipeline.stages import square
from ...model.solid.places import Place, places_of
from ..view.occurrences import Path, maker_of

if TYPE_CHECKING:
    from ...model.document.nodes import Node
    from ...model.solid.display import DisplayMesh

Floats = NDArray[np.float64]
NEAR = 1e-5
"""How near a picked corner is to a vertex of the exact mesh, as a part of the solid's size."""


@dataclass(frozen=True, slots=True, eq=False)
class Subject:
    """`own` (3,) in the axes of the occurrence at `path`, or in the world's where there is none; `vertex` is the number
    in the mesh of the solid `root_id`, -1 for a point that is no vertex."""

    own: Floats
    path: Path = ()
    root_id: str = ""
    vertex: int = -1


def point_subject(point: Sequence[float]) -> Subject:
    """A point of the world by itself."""
    return Subject(np.asarray(point, float))


def place_of(subject: Subject, solids: Sequence[Node]) -> Place | None:
    """Where its node stands in resolved trees; None where it has none, or it is gone."""
    if not subject.path:
        return None
    node_id = maker_of(subject.path)
    found = places_of(solids, [node_id]).get(node_id, ())
    return next((place for place in found if place.path == subject.path), None)


def vertex_subject(root_id: str, vertex: int, mesh: DisplayMesh, solids: Sequence[Node]) -> Subject:
    """A vertex by its number in a solid's mesh. Raises Refusal."""
    if not 0 <= vertex < len(mesh.vertices):
        raise Refusal(f"there is no vertex {vertex}: this solid has those from 0 to {len(mesh.vertices) - 1}")
    triangle = int(np.flatnonzero((mesh.corners == vertex).any(axis=1))[0])
    return _on(root_id, mesh.vertices[vertex], tuple(mesh.owners[int(mesh.owner[triangle])]), vertex, solids)


def picked_subject(
    path: Path, point: Sequence[float], meshes: Mapping[str, DisplayMesh], solids: Sequence[Node]
) -> Subject:
    """What was clicked at a point of the world on a face or an edge of the occurrence at `path`; a vertex where one is
    there."""
    root_id = str(path[0]) if path else ""
    mesh = meshes.get(root_id)
    if mesh is None or not len(mesh.vertices):
        return point_subject(point)
    away = np.linalg.norm(mesh.vertices - np.asarray(point, float), axis=1)
    vertex = int(away.argmin())
    size = float(np.linalg.norm(np.ptp(mesh.bounds, axis=0)))
    if away[vertex] <= NEAR * max(size, 1e-9):
        return _on(root_id, mesh.vertices[vertex], path, vertex, solids)
    return _on(root_id, np.asarray(point, float), path, -1, solids)


def _on(root_id: str, world: Floats, path: Path, vertex: int, solids: Sequence[Node]) -> Subject:
    place = place_of(Subject(world, path), solids)
    if place is None:
        return Subject(world, (), root_id, vertex)
    try:
        back = inverse(place.matrix)
    except Refusal:
        return Subject(world, (), root_id, vertex)
    return Subject(back[:, :3] @ world + back[:, 3], path, root_id, vertex)


def model_matrix(place: Place | None) -> Floats:
    """(4, 4) from the node's axes to the world's."""
    return square(IDENTITY if place is None else place.matrix)


def placed_by(place: Place, placement: Placement, wanted: Floats) -> Placement:
    """The placement that brings the node's axes to the world by the matrix `wanted` (4, 4): the steps it has, and one
    that does the rest. `placement` may hold expressions, those of the place are resolved. Raises Refusal."""
    own = product(inverse(place.outer), wanted[:3])
    rest = product(own, inverse(place.node.placement.matrix()))
    steps = placement.steps
    if steps and isinstance(steps[-1], Affine) and not placement.symbolic():
        rest, steps = product(rest, steps[-1].matrix()), steps[:-1]
    rest = np.round(rest, 12) + 0.0
    if np.array_equal(rest[:, :3], np.eye(3)):
        return Placement(steps).then(Move(tuple(float(value) for value in rest[:, 3])))
    return Placement((*steps, Affine(tuple(float(value) for value in rest.ravel()))))
