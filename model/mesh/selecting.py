"""Sets of vertices, edges and faces of a winged edge: by angle, maker, size; grown, walked and turned into each other.

A set is an array of flags, (n,) of vertices, (e,) of edges, (f,) of faces; no function changes one that it is given.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .inspected import FLAT, InspectedMesh
from .lists import Numbers
from .pieces import pieces
from .walks import chain
from .winged import END, LEFT, LEFT_AFTER, RIGHT, START, WingedEdge

Flags = NDArray[np.bool_]
Bend = Literal["any", "convex", "concave"]
Kind = Literal["vertex", "edge", "face"]


def flags(count: int, members: Iterable[int] | Numbers) -> Flags:
    """The set (count,) of these members."""
    found = np.zeros(count, bool)
    found[np.fromiter(members, np.int64) if not isinstance(members, np.ndarray) else members] = True
    return found


# Edges.


def bent_edges(mesh: InspectedMesh, least: float, way: Bend = "any") -> Flags:
    """Edges at which the surface turns by `least` degrees or more."""
    turn = {"any": np.abs(mesh.bend), "convex": mesh.bend, "concave": -mesh.bend}[way]
    with np.errstate(invalid="ignore"):
        return (turn >= least) & (turn > FLAT)


def short_edges(mesh: InspectedMesh, longest: float) -> Flags:
    """Edges no longer than so many millimetres."""
    return mesh.length <= longest


def edges_around(mesh: WingedEdge, faces: Flags) -> Flags:
    """The border of a set of faces: edges with one of them on one side only."""
    left, right = (_in(faces, mesh.table[:, column]) for column in (LEFT, RIGHT))
    return left != right


def loop_from(mesh: WingedEdge, edge: int, side: int) -> list[int]:
    """The edges of the face's loop that an edge is on with its left side (0) or its right one (1); none where there is
    no face."""
    if mesh.table[edge, LEFT + side] < 0:
        return []
    first, found = (edge, side), [edge]
    while True:
        vertex = int(mesh.table[edge, END - side])
        edge = int(mesh.table[edge, LEFT_AFTER + 2 * side])
        side = 0 if mesh.table[edge, START] == vertex else 1
        if (edge, side) == first:
            return found
        found.append(edge)


def loop_of_edge(mesh: InspectedMesh, edge: int, side: int = 0) -> list[int]:
    """The border that a naked edge is on; of another edge the loop of the face on a side."""
    if mesh.naked[edge]:
        return mesh.winged.border(edge)
    return loop_from(mesh.winged, edge, side) or loop_from(mesh.winged, edge, 1 - side)


def chain_of_edge(mesh: InspectedMesh, edge: int, least: float = 15.0, bend: float = 30.0) -> list[int]:
    """The edges that go on smoothly from one, of those that are as sharp: where the surface turns by `least` degrees or
    has a border, unless it does so at this edge neither."""
    marked = bent_edges(mesh, least) | mesh.naked | mesh.non_manifold
    return chain(mesh.winged, edge, marked if marked[edge] else None, bend)


# Faces.


def faces_of_makers(mesh: InspectedMesh, node_ids: Iterable[str]) -> Flags:
    """Faces that a node made, or what stands below one."""
    wanted = set(node_ids)
    mine = np.array([not wanted.isdisjoint(path) for path in mesh.owners] + [False], bool)
    return mine[mesh.maker]


def faces_towards(mesh: InspectedMesh, direction: ArrayLike, within: float) -> Flags:
    """Faces whose outward normal is within so many degrees of a direction (3,) of any length but 0."""
    way = np.asarray(direction, float)
    size = float(np.linalg.norm(way))
    if not size:
        return np.zeros(mesh.lists.face_count, bool)
    cosine = mesh.face_normals @ (way / size)
    return cosine >= np.cos(np.radians(within)) - 1e-12


def faces_of_area(mesh: InspectedMesh, least: float = 0.0, most: float = np.inf) -> Flags:
    """Faces of so many square millimetres."""
    return (mesh.area >= least) & (mesh.area <= most)


def connected_faces(mesh: InspectedMesh, faces: Flags, most: float = 180.0) -> Flags:
    """Faces that hang together with those of a set by edges at which the surface turns by `most` degrees at most."""
    with np.errstate(invalid="ignore"):
        crossed = np.flatnonzero(np.abs(mesh.bend) <= most + FLAT)
    sides = mesh.winged.table[crossed][:, [LEFT, RIGHT]]
    label = pieces(sides[:, 0], sides[:, 1], mesh.lists.face_count)
    reached = np.zeros(int(label.max(initial=-1)) + 1, bool)
    reached[label[faces]] = True
    return reached[label]


# From one kind to another.


def vertices_of_edges(mesh: WingedEdge, edges: Flags) -> Flags:
    """The ends of edges."""
    return flags(len(mesh.vertices), mesh.table[edges][:, [START, END]].reshape(-1))


def edges_of_vertices(mesh: WingedEdge, vertices: Flags, both: bool = True) -> Flags:
    """Edges with both ends in a set, or with one at least."""
    start, end = vertices[mesh.table[:, START]], vertices[mesh.table[:, END]]
    return start & end if both else start | end


def edges_of_faces(mesh: WingedEdge, faces: Flags) -> Flags:
    """The edges of all loops of faces."""
    return _in(faces, mesh.table[:, LEFT]) | _in(faces, mesh.table[:, RIGHT])


def faces_of_edges(mesh: WingedEdge, edges: Flags, all_of_them: bool = True) -> Flags:
    """Faces with all their edges in a set, or with one at least."""
    sides = mesh.table[:, [LEFT, RIGHT]]
    chosen = edges if not all_of_them else ~edges
    touched = np.zeros(mesh.face_count, bool)
    there = sides[chosen].reshape(-1)
    touched[there[there >= 0]] = True
    if not all_of_them:
        return touched
    edged = np.zeros(mesh.face_count, bool)
    edged[sides[sides >= 0]] = True
    return edged & ~touched


def converted(mesh: WingedEdge, chosen: Flags, kind: Kind, to: Kind) -> Flags:
    """A set of one kind as one of another: downwards all that bounds its members, upwards what they bound wholly."""
    if kind == to:
        return chosen
    if kind == "face":
        edges = edges_of_faces(mesh, chosen)
        return edges if to == "edge" else vertices_of_edges(mesh, edges)
    if kind == "vertex":
        edges = edges_of_vertices(mesh, chosen)
        return edges if to == "edge" else faces_of_edges(mesh, edges)
    return vertices_of_edges(mesh, chosen) if to == "vertex" else faces_of_edges(mesh, chosen)


def grown(mesh: WingedEdge, chosen: Flags, kind: Kind) -> Flags:
    """With what touches a set: vertices by an edge, edges and faces in a vertex."""
    if kind == "vertex":
        return chosen | vertices_of_edges(mesh, edges_of_vertices(mesh, chosen, both=False))
    vertices = converted(mesh, chosen, kind, "vertex")
    edges = edges_of_vertices(mesh, vertices, both=False)
    if kind == "edge":
        return chosen | edges
    return chosen | faces_of_edges(mesh, edges, all_of_them=False)


def shrunk(mesh: WingedEdge, chosen: Flags, kind: Kind) -> Flags:
    """Without what touches something outside a set: the opposite of growing what is not in it."""
    return ~grown(mesh, ~chosen, kind)


def _in(faces: Flags, column: NDArray[np.int32]) -> Flags:
    """(e,) whether the face of each edge on a side is in a set; nobody's is not."""
    return np.append(faces, False)[column]
