"""The mesh that a node holds as arrays, and arrays as the mesh of a node."""

from __future__ import annotations

import io
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...document.document import Document
from ...document.errors import Refusal
from ...document.nodes import Broken, Node
from ...document.outlines import is_outline
from ...document.placement import Placement, inverse
from ...document.primitives import ImportedMesh, Polyhedron
from ...document.tree import change, find
from ..curves.addressing import plain_values

if TYPE_CHECKING:
    from ...exchange.parts import Part

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

MESHES = (ImportedMesh, Polyhedron)
"""The kinds of nodes that hold a mesh of their own."""
FORMAT = "ply"
"""Of the meshes that operations make: binary PLY keeps every bit of the coordinates."""
NEAR = 1e-6
"""Within this share of a mesh's size a place is that of a vertex."""


@dataclass(frozen=True, slots=True, eq=False)
class NodeMesh:
    """`vertices` (n, 3) in mm and `triangles` (m, 3) in a node's own axes; `matrix` (3, 4) maps these to the world."""

    vertices: Floats
    triangles: Numbers
    matrix: Floats

    @property
    def mirrored(self) -> bool:
        return bool(np.linalg.det(self.matrix[:, :3]) < 0.0)

    def in_world(self) -> tuple[Floats, Numbers]:
        """Vertices in the world, and triangles that face there as they do in the node's own axes."""
        points = self.vertices @ self.matrix[:, :3].T + self.matrix[:, 3]
        return points, self.triangles[:, ::-1] if self.mirrored else self.triangles

    def from_world(self, points: Floats, triangles: Numbers) -> tuple[Floats, Numbers]:
        """The way back of what was made of `in_world`: vertices that stayed come back to the very same coordinates."""
        from ...mesh.faults.sides import distinct_places

        before, _ = self.in_world()
        _, first, which = np.unique(
            distinct_places(np.concatenate((before, points))), return_index=True, return_inverse=True
        )
        origin = first[which[len(before) :]]
        stayed = origin < len(before)
        back = inverse(self.matrix)
        own = points @ back[:, :3].T + back[:, 3]
        own[stayed] = self.vertices[origin[stayed]]
        return own, triangles[:, ::-1] if self.mirrored else triangles

    def vertex_numbers(self, places: ArrayLike) -> Numbers:
        """(k,) which vertices lie at places (k, 3) of the world, -1 where none does.

        A picture has its own numbers: manifold3d sorts the vertices of what is closed, and joins what is very near.
        """
        from scipy.spatial import KDTree

        rows = np.asarray(places, np.float64).reshape(-1, 3)
        if not len(self.vertices):
            return np.full(len(rows), -1)
        back = inverse(self.matrix)
        reach = NEAR * max(float(np.ptp(self.vertices, axis=0).max()), 1e-300)
        tree = KDTree(self.vertices)
        _, found = tree.query(rows @ back[:, :3].T + back[:, 3], distance_upper_bound=reach)
        return np.where(found < len(self.vertices), found, -1).astype(np.int64)

    def triangle_numbers(self, corners: ArrayLike) -> Numbers:
        """(k,) which triangles have their corners at places (k, 3, 3) of the world, -1 where none has."""
        wanted = np.sort(self.vertex_numbers(corners).reshape(-1, 3), axis=1)
        own = np.sort(self.triangles, axis=1)
        both, which = np.unique(np.concatenate((own, wanted)), axis=0, return_inverse=True)
        which = which.reshape(-1)
        first = np.full(len(both), -1)
        first[which[: len(own)][::-1]] = np.arange(len(own))[::-1]
        return first[which[len(own) :]]


def mesh_of_node(document: Document, node_id: str) -> NodeMesh:
    """The mesh of an imported mesh or of a polyhedron as it came: vertices at the very same place are one, polygons are
    cut into triangles, nothing else is changed. The matrix is that of the node's first place. Raises Refusal.
    """
    from ...document.resolve import resolve
    from ...solid.places import places_of

    node = find(document, node_id)
    places = places_of(resolve(document).solids, [node_id]).get(node_id)
    plain = places[0].node if places else plain_values(document, node)
    matrix = places[0].matrix if places else plain.placement.matrix()
    part = part_of(plain)
    return NodeMesh(part.vertices, part.triangles.astype(np.int64), matrix)


def part_of(node: Node) -> Part:
    """The mesh of a resolved node in its own axes, in mm. Raises Refusal."""
    from ...exchange.meshes_in import parts_of_asset
    from ...exchange.parts import make_part

    if isinstance(node, Polyhedron):
        from ...solid.leaves import triangles_of_faces

        points = np.array(node.points, np.float64).reshape(-1, 3)
        for number, face in enumerate(node.faces):
            if len(face) < 3 or min(face) < 0 or max(face) >= len(points):
                raise Refusal(f"“{node.label}”: face {number} must name three or more of its {len(points)} points")
        if not node.faces:
            raise Refusal(f"“{node.label}” has no faces")
        return make_part("", None, points, triangles_of_faces(points, node.faces)[0])
    if isinstance(node, Broken):
        raise Refusal(f"“{node.label}”: {node.message}")
    if not isinstance(node, ImportedMesh):
        raise Refusal(f"“{node.label}” is no mesh: convert it to one first")
    try:
        parts = parts_of_asset(node.asset, node.file_format)
    except Refusal as refusal:
        raise Refusal(f"“{node.label}”: {refusal}") from None
    index, unit = int(node.part), float(node.unit)  # type: ignore[arg-type]
    if index >= len(parts):
        raise Refusal(f"“{node.label}”: its file holds {len(parts)} solids, not number {index}")
    part = parts[index]
    return part if unit == 1.0 else make_part("", None, part.vertices, part.triangles, unit=unit)


def numbers_of(values: Iterable[int], count: int, what: str, label: str) -> Numbers:
    """The numbers of vertices or faces, `what`, of `count` that a node has, each once. Raises Refusal for others."""
    try:
        rows = np.asarray(list(values) if not hasattr(values, "dtype") else values)
    except TypeError:
        raise Refusal(f"a {what} is told by its number, not {values!r:.60}") from None
    if not rows.size:
        raise Refusal(f"select what is to change of “{label}” first")
    if rows.ndim != 1 or rows.dtype.kind not in "iu":
        raise Refusal(f"a {what} is told by its number, not {values!r:.60}")
    bad = np.flatnonzero((rows < 0) | (rows >= count))
    if len(bad):
        raise Refusal(f"“{label}” has no {what} {rows[bad[0]]}; there are {count:,}, counted from 0")
    _, first = np.unique(rows, return_index=True)
    return rows[np.sort(first)].astype(np.int64)


def with_mesh(document: Document, node_id: str, vertices: Floats, triangles: NDArray[np.integer]) -> Document:
    """The document with these arrays, in a node's own axes, as its mesh; the node keeps all that is not its shape.

    Raises Refusal where nothing is left.
    """
    from ...exchange.parts import make_part
    from ...exchange.ply import write_ply
    from ...exchange.solids import OutSolid
    from ...project.assets import default_store

    node = find(document, node_id)
    if not len(triangles):
        raise Refusal(f"nothing would be left of “{node.label}”: delete it instead")
    part = make_part("", None, vertices, np.asarray(triangles))  # as it will be read
    file = io.BytesIO()
    write_ply(file, [OutSolid("", None, part.vertices, part.triangles)])
    asset = default_store().put(file.getvalue())
    return change(
        document,
        node_id,
        lambda node: ImportedMesh(
            id=node.id, name=node.name, colour=node.colour, visible=node.visible, note=node.note,
            material=node.material, mapping=node.mapping, crease=node.crease, placement=node.placement, asset=asset,
            file_format=FORMAT,
        ),
    )  # fmt: skip


def convert_to_mesh(document: Document, node_id: str, tolerance: float = 0.05) -> Document:
    """Turn a solid, or an operand, into a mesh: what it evaluates to within `tolerance` mm, in its place.

    Its operands are gone. A polyhedron becomes the mesh of its faces, closed or not. Raises Refusal.
    """
    from ...document.resolve import resolve
    from ...solid.evaluate import Evaluator
    from ...solid.places import places_of
    from ...solid.results import arrays_of, messages_of

    node = find(document, node_id)
    if isinstance(node, ImportedMesh):
        raise Refusal(f"“{node.label}” is a mesh already")
    if is_outline(node, document.definitions):
        raise Refusal(f"“{node.label}” is an outline, which has no surface: extrude it first")
    if not np.isfinite(tolerance) or tolerance <= 0.0:
        raise Refusal(f"the tolerance of a mesh must be a number above 0 mm, not {tolerance!r:.40}")
    places = places_of(resolve(document).solids, [node_id]).get(node_id)
    if not places:
        raise Refusal(f"“{node.label}” stands in no solid: nothing says which mesh it would become")
    plain = places[0].node.with_(placement=Placement())
    if isinstance(plain, Polyhedron):
        part = part_of(plain)
        return with_mesh(document, node_id, part.vertices, part.triangles)
    entry = Evaluator().evaluate(plain, float(tolerance))
    if entry.solid is None:
        why = next((message.message for message in messages_of(plain, entry.problems) if message.error), "it failed")
        raise Refusal(f"“{node.label}” cannot become a mesh: {why}")
    if entry.solid.is_empty():
        raise Refusal(f"“{node.label}” is empty: there is no surface to become a mesh")
    return with_mesh(document, node_id, *arrays_of(entry.solid.to_mesh64()))
