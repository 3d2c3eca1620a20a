"""Single elements of a node's mesh edited: edges split, flipped and collapsed, faces split, deleted and turned round.

Vertices and triangles are told by their numbers in the arrays of `mesh_of_node`; lengths are along the node's own axes.
What is taken out leaves no gap in the numbers, what is new comes last, and all others keep their order. Where a mesh
does not bound a solid, vertices at the very same place become one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ...document.document import Document
from ...document.errors import Refusal
from ...document.tree import find
from .mesh_nodes import Floats, NodeMesh, Numbers, mesh_of_node, numbers_of, with_mesh

if TYPE_CHECKING:
    from ...mesh.euler import EditedMesh

Edge = Sequence[int]
"""The numbers of the two vertices that it joins."""


def split_mesh_edge(document: Document, node_id: str, edge: Edge, at: float = 0.5) -> Document:
    """Put a vertex on an edge, `at` a share of the way from its first end, and cut all triangles beside it there."""
    mesh, (a, b) = _with_edge(document, node_id, edge)
    faces = mesh.triangles
    rows = _beside(faces, a, b)
    vertex = len(mesh.vertices)
    one, two = faces[rows].copy(), faces[rows].copy()
    one[one == b] = vertex
    two[two == a] = vertex
    changed = faces.copy()
    changed[rows] = one
    return with_mesh(
        document, node_id, np.vstack((mesh.vertices, _on(mesh.vertices, a, b, at))), np.vstack((changed, two))
    )


def flip_mesh_edge(document: Document, node_id: str, edge: Edge) -> Document:
    """Turn an edge between two triangles so that it joins their other two corners."""
    mesh, (a, b) = _with_edge(document, node_id, edge)
    faces = mesh.triangles
    near, number = _around(mesh, a, b)
    _tried(lambda: near.flip(number), number, a, b)
    one, two = _beside(faces, a, b).tolist()
    changed = faces.copy()
    changed[one] = np.where(faces[one] == a, _third(faces[two], a, b), faces[one])
    changed[two] = np.where(faces[two] == b, _third(faces[one], a, b), faces[two])
    rows = [one, two]
    before, after = (_normals(mesh.vertices, part[rows]) for part in (faces, changed))
    if (after @ before.sum(axis=0) <= 0.0).any():
        raise Refusal(f"the edge from vertex {a} to {b} cannot be flipped: a face would be laid over another one")
    return with_mesh(document, node_id, mesh.vertices, changed)


def collapse_mesh_edge(document: Document, node_id: str, edge: Edge, at: float = 0.5) -> Document:
    """Make the two ends of an edge one, `at` a share of the way from the first; the triangles beside it are gone.

    The first end's number stays.
    """
    mesh, (a, b) = _with_edge(document, node_id, edge)
    near, number = _around(mesh, a, b)
    point = _on(mesh.vertices, a, b, at, ends=True)
    _tried(lambda: near.collapse(number, point), number, a, b)
    points = mesh.vertices.copy()
    points[a] = point
    faces = np.where(mesh.triangles == b, a, mesh.triangles)
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    return with_mesh(document, node_id, points, faces)


def split_mesh_face(document: Document, node_id: str, face: int, at: Sequence[float] | None = None) -> Document:
    """Put a vertex into a triangle, in its middle or `at` a point (3,), and join it to the corners."""
    mesh = mesh_of_node(document, node_id)
    (row,) = numbers_of([face], len(mesh.triangles), "face", find(document, node_id).label)
    corners = mesh.triangles[row]
    point = mesh.vertices[corners].mean(axis=0) if at is None else _rows(at, 1, "a point")[0]
    vertex = len(mesh.vertices)
    a, b, c = corners
    changed = mesh.triangles.copy()
    changed[row] = a, b, vertex
    return with_mesh(
        document, node_id, np.vstack((mesh.vertices, point)), np.vstack((changed, [(b, c, vertex), (c, a, vertex)]))
    )


def delete_mesh_faces(document: Document, node_id: str, faces: Iterable[int]) -> Document:
    """Take triangles out of a mesh; vertices that no triangle has any more go with them."""
    mesh = mesh_of_node(document, node_id)
    rows = numbers_of(faces, len(mesh.triangles), "face", find(document, node_id).label)
    return with_mesh(document, node_id, mesh.vertices, np.delete(mesh.triangles, rows, axis=0))


def reverse_mesh_faces(document: Document, node_id: str, faces: Iterable[int] | None = None) -> Document:
    """Turn triangles round so that they face the other side; None: all."""
    mesh = mesh_of_node(document, node_id)
    every = range(len(mesh.triangles))
    rows = numbers_of(every if faces is None else faces, len(mesh.triangles), "face", find(document, node_id).label)
    changed = mesh.triangles.copy()
    changed[rows] = changed[rows, ::-1]
    return with_mesh(document, node_id, mesh.vertices, changed)


def move_mesh_vertices(document: Document, node_id: str, vertices: Iterable[int], by: ArrayLike) -> Document:
    """Move vertices `by` a vector (3,), or each by one of its own (k, 3)."""
    mesh = mesh_of_node(document, node_id)
    rows = numbers_of(vertices, len(mesh.vertices), "vertex", find(document, node_id).label)
    points = mesh.vertices.copy()
    points[rows] += _rows(by, len(rows), "a move")
    return with_mesh(document, node_id, points, mesh.triangles)


def _with_edge(document: Document, node_id: str, edge: Edge) -> tuple[NodeMesh, tuple[int, int]]:
    mesh = mesh_of_node(document, node_id)
    ends = list(edge) if hasattr(edge, "__iter__") else []
    if len(ends) != 2:
        raise Refusal(f"an edge is told by the numbers of its two vertices, not {edge!r:.60}")
    a, b = numbers_of(ends, len(mesh.vertices), "vertex", find(document, node_id).label).tolist()
    if not len(_beside(mesh.triangles, a, b)):
        raise Refusal(f"“{find(document, node_id).label}” has no edge from vertex {a} to {b}")
    return mesh, (a, b)


def _around(mesh: NodeMesh, a: int, b: int) -> tuple[EditedMesh, int]:
    """What lies around an edge, far enough for the operators to be tried on it, and the edge's number in it; vertices
    keep theirs. Raises Refusal where the surface is none there."""
    from ...mesh.euler import EditedMesh
    from ...mesh.lists import of_triangles
    from ...mesh.winged import END, LEFT, RIGHT, START, winged_edge

    faces = mesh.triangles
    ring = np.zeros(len(mesh.vertices), bool)
    ring[[a, b]] = True
    rows = ring[faces].any(axis=1)
    ring[faces[rows]] = True
    near = winged_edge(of_triangles(mesh.vertices, faces[ring[faces].any(axis=1)]))
    found = np.flatnonzero((np.sort(near.table[:, [START, END]], axis=1) == sorted((a, b))).all(axis=1))
    if len(found) > 1:
        raise Refusal(f"the edge from vertex {a} to {b} has more than two faces, or they disagree about the outside")
    for vertex in (a, b):
        beside = near.table[np.asarray(near.star(vertex))][:, [LEFT, RIGHT]]
        if len(np.setdiff1d(beside, [-1])) < int((faces == vertex).sum()):
            raise Refusal(f"surfaces meet in vertex {vertex} alone: there is more than one edge to follow")
    return EditedMesh(near), int(found[0])


def _tried(operator: Callable[[], object], number: int, a: int, b: int) -> None:
    try:
        operator()
    except Refusal as refusal:
        raise Refusal(re.sub(rf"\bedge {number}\b", f"the edge from vertex {a} to {b}", str(refusal))) from None


def _beside(faces: Numbers, a: int, b: int) -> Numbers:
    """The triangles that have both vertices."""
    return np.flatnonzero((faces == a).any(axis=1) & (faces == b).any(axis=1)) if a != b else np.zeros(0, np.int64)


def _third(corners: Numbers, a: int, b: int) -> int:
    return int(corners[(corners != a) & (corners != b)][0])


def _on(points: Floats, a: int, b: int, at: float, ends: bool = False) -> Floats:
    inside = 0.0 <= at <= 1.0 if ends else 0.0 < at < 1.0
    if not inside:
        between = "from 0 to 1" if ends else "between 0 and 1"
        raise Refusal(f"a place on an edge is a share of its length {between}, not {at!r:.40}")
    return (1.0 - at) * points[a] + at * points[b]


def _normals(points: Floats, faces: Numbers) -> Floats:
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def _rows(values: ArrayLike, count: int, what: str) -> Floats:
    """(count, 3) of one row for all or one for each. Raises Refusal."""
    try:
        rows = np.asarray(values, np.float64)
        rows = np.broadcast_to(rows, (count, 3))
    except (TypeError, ValueError):
        raise Refusal(f"{what} is three plain numbers, not {values!r:.60}") from None
    if not np.isfinite(rows).all():
        raise Refusal(f"{what} is three finite numbers, not {values!r:.60}")
    return rows
