"""All that is known of a solid's mesh as data structures: lists, winged edge, bends, who made which face."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .lists import Floats, MeshLists, Numbers, faces_of_facets, flat_facets, of_triangles
from .topology import Topology, topology
from .walks import bends
from .winged import END, LEFT, RIGHT, START, WingedEdge, winged_edge

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh
    from ..solid.provenance import Path

FLAT = 1e-4
"""Degrees up to which an edge counts as flat."""


@dataclass(frozen=True, eq=False)
class InspectedMesh:
    """Read-only. `polygons`: the faces are polygons, else triangles.

    Vertices keep the numbers that they have in the solid's mesh, whether faces are polygons or triangles. A vertex in
    the middle of a flat face belongs to no loop and has no edge; one on a straight side stays a corner of both faces
    there where a third face ends in it, or where both have it anyway. Flat faces are those that the solid's evaluation
    tells; of meshes that are no solids, which it does not look into, triangles side by side in one plane.
    """

    lists: MeshLists
    winged: WingedEdge
    triangles: Numbers  # (t, 3) vertices
    triangle_face: Numbers  # (t,) the face that each is of
    maker: Numbers  # (f,) who made each face, a place in `owners`, -1 for nobody
    owners: tuple[Path, ...]
    bend: Floats  # (e,) degrees, see walks.bends
    length: Floats  # (e,) mm
    area: Floats  # (f,) mm², without the holes
    topology: Topology
    polygons: bool

    @property
    def face_normals(self) -> Floats:
        """(f, 3) unit."""
        return self.lists.normals[self.lists.face_normal]

    @cached_property
    def degree(self) -> Numbers:
        """(n,) how many edges each vertex has."""
        ends = self.winged.table[:, [START, END]].reshape(-1)
        return np.bincount(ends, minlength=len(self.lists.vertices))

    @cached_property
    def copies(self) -> Numbers:
        """(e,) how many edges stand for the same pair of vertices, 1 where all is well."""
        return np.bincount(self.winged.copy_of, minlength=len(self.winged))[self.winged.copy_of]

    @cached_property
    def naked(self) -> NDArray[np.bool_]:
        """(e,) edges with a face on one side only, and no other edge between the same vertices."""
        bare = (self.winged.table[:, [LEFT, RIGHT]] < 0).any(axis=1)
        return bare & (self.copies == 1)

    @cached_property
    def non_manifold(self) -> NDArray[np.bool_]:
        """(e,) edges at which more than two faces meet, or two that run the same way."""
        return self.copies > 1

    @cached_property
    def edge_kind(self) -> NDArray[np.str_]:
        """(e,) in one word each."""
        kind = np.full(len(self.winged), "flat", "<U12")
        kind[self.bend > FLAT] = "convex"
        kind[self.bend < -FLAT] = "concave"
        kind[self.naked] = "naked"
        kind[self.non_manifold] = "non-manifold"
        return kind

    def edges_of_face(self, face: int) -> Numbers:
        """The edges that have a face on a side, in rising order."""
        table = self.winged.table
        return np.flatnonzero((table[:, LEFT] == face) | (table[:, RIGHT] == face))


def inspect_mesh(mesh: DisplayMesh, polygons: bool = True) -> InspectedMesh:
    """The structures of a solid's mesh, its faces as polygons with holes or as the triangles they are drawn by.

    Of an outline that stands by itself, what it fills: a face with its holes for each part.
    """
    used = slice(0, len(mesh.corners) - mesh.sheet)  # the last triangle of a sheet, and its vertex, are none of it
    vertices = mesh.vertices[: len(mesh.vertices) - mesh.sheet]
    triangles, facets, owner = mesh.corners[used].astype(np.int64), mesh.facet[used], mesh.owner[used]
    if polygons:
        told = len(triangles) == 0 or mesh.sheet or int(facets.max()) + 1 < len(triangles) or _paired(triangles)
        lists, triangle_face = faces_of_facets(
            vertices, triangles, facets if told else flat_facets(vertices, triangles)
        )
    else:
        lists, triangle_face = of_triangles(vertices, triangles), np.arange(len(triangles))
    winged = winged_edge(lists)
    maker = np.full(lists.face_count, -1)
    maker[triangle_face[::-1]] = owner[::-1]
    maker[maker >= len(mesh.owners)] = -1
    ends = lists.vertices[winged.table[:, [START, END]]]
    areas = np.zeros((lists.face_count, 3))
    np.add.at(areas, lists.loop_faces(), lists.loop_areas())
    return InspectedMesh(
        lists=lists,
        winged=winged,
        triangles=triangles,
        triangle_face=triangle_face,
        maker=maker,
        owners=mesh.owners,
        bend=bends(winged, lists.normals[lists.face_normal]) if len(lists.normals) else np.zeros(0),
        length=np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1),
        area=np.linalg.norm(areas, axis=1),
        topology=topology(winged),
        polygons=polygons,
    )


def _paired(triangles: Numbers) -> bool:
    """Whether every side of triangles (t, 3) is one of two between the same vertices, as in what is evaluated."""
    starts, ends = triangles.reshape(-1), triangles[:, [1, 2, 0]].reshape(-1)
    keys = np.sort(np.minimum(starts, ends) * (int(triangles.max()) + 1) + np.maximum(starts, ends))
    return len(keys) % 2 == 0 and bool((keys[::2] == keys[1::2]).all() and (keys[1:-1:2] != keys[2::2]).all())
