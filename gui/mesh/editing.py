"""Elements that are chosen in the picture as operations on the mesh that they belong to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.mesh.selecting import converted
from ...model.mesh.winged import END, LEFT, RIGHT, START
from ..view.occurrences import maker_of

if TYPE_CHECKING:
    from ...model.editing.session import Session
    from ...model.mesh.inspected import InspectedMesh
    from .chosen import Chosen


class MeshEditing:
    """Edits the node that made the chosen elements; what it refuses it says in a Refusal."""

    def __init__(self, session: Session, chosen: Chosen) -> None:
        self._session, self._chosen = session, chosen

    def fault(self) -> str | None:
        """Why what is chosen cannot be edited, or None."""
        from ...model.document.primitives import ImportedMesh, Polyhedron

        if self._chosen.mesh is None or not self._chosen.count:
            return "choose a vertex, an edge or a face first"
        makers = self._makers()
        if len(makers) != 1:
            return "choose elements that one node made" if makers else "no node made what is chosen"
        try:
            node = find(self._session.document, makers[0])
        except Refusal:
            return "the picture is behind the document"
        if not isinstance(node, ImportedMesh | Polyhedron):
            return f"“{node.label}” is no mesh: convert the solid to one first"
        return None

    def edge(self, operation: str, label: str) -> None:
        """Do something to the only edge that is chosen. Raises Refusal."""
        mesh = self._mesh()
        if self._chosen.edge < 0:
            raise Refusal("choose one edge first")
        ends = mesh.winged.table[self._chosen.edge, [START, END]]
        node = self._makers()[0]
        self._session.do(operation, node, self._vertices(node, ends), label=label)

    def run(self, name: str) -> None:
        """An edit that needs nothing typed, by its name. Raises Refusal."""
        {
            "split_edge": lambda: self.edge("split_mesh_edge", "Split edge"),
            "flip_edge": lambda: self.edge("flip_mesh_edge", "Flip edge"),
            "collapse_edge": lambda: self.edge("collapse_mesh_edge", "Collapse edge"),
            "split_face": self.split_face,
            "reverse_faces": lambda: self.faces("reverse_mesh_faces", "Reverse faces"),
            "delete_faces": lambda: self.faces("delete_mesh_faces", "Delete faces"),
        }[name]()

    def faces(self, operation: str, label: str) -> None:
        """Do something to the triangles of all faces that are chosen. Raises Refusal."""
        node = self._makers()[0]
        self._session.do(operation, node, self._triangles(node), label=label)

    def split_face(self) -> None:
        """Put a vertex into the middle of the only triangle that is chosen. Raises Refusal."""
        node = self._makers()[0]
        triangles = self._triangles(node)
        if len(triangles) != 1:
            raise Refusal("choose one triangle first, with triangles instead of polygons as faces")
        self._session.do("split_mesh_face", node, triangles[0], label="Split face")

    def move(self, by: Sequence[float]) -> None:
        """Move the vertices of all that is chosen by a vector in the node's own axes. Raises Refusal."""
        mesh, chosen = self._mesh(), self._chosen
        vertices = np.flatnonzero(converted(mesh.winged, chosen.members, chosen.kind, "vertex"))
        node = self._makers()[0]
        self._session.do("move_mesh_vertices", node, self._vertices(node, vertices), list(by), label="Move vertices")

    def _mesh(self) -> InspectedMesh:
        fault = self.fault()
        if fault or self._chosen.mesh is None:
            raise Refusal(fault or "there is no mesh")
        return self._chosen.mesh

    def _makers(self) -> list[str]:
        """The nodes that made the chosen faces, or those beside chosen edges, or about chosen vertices."""
        mesh, chosen = self._chosen.mesh, self._chosen
        if mesh is None:
            return []
        if chosen.kind == "face":
            faces = chosen.numbers
        else:
            table = mesh.winged.table
            edges = chosen.members if chosen.kind == "edge" else chosen.members[table[:, [START, END]]].any(axis=1)
            faces = table[edges][:, [LEFT, RIGHT]].reshape(-1)
            faces = faces[faces >= 0]
        makers = np.unique(mesh.maker[faces])
        return list(dict.fromkeys(maker_of(mesh.owners[maker]) for maker in makers.tolist() if maker >= 0))

    def _vertices(self, node: str, vertices: np.ndarray) -> list[int]:
        """The numbers that vertices of the picture have in the node's own mesh. Raises Refusal."""
        from ...model.operations.meshes.mesh_nodes import mesh_of_node

        own = mesh_of_node(self._session.document, node)
        return self._known(own.vertex_numbers(self._mesh().lists.vertices[vertices]), "vertex")

    def _triangles(self, node: str) -> list[int]:
        """The numbers that the triangles of the chosen faces have in the node's own mesh. Raises Refusal."""
        from ...model.operations.meshes.mesh_nodes import mesh_of_node

        mesh, chosen = self._mesh(), self._chosen
        if chosen.kind != "face":
            raise Refusal("choose some faces first")
        mine = mesh.triangles[chosen.members[mesh.triangle_face]]
        own = mesh_of_node(self._session.document, node)
        return self._known(own.triangle_numbers(mesh.lists.vertices[mine]), "triangle")

    def _known(self, numbers: np.ndarray, what: str) -> list[int]:
        if (numbers < 0).any():
            raise Refusal(
                f"a {what} that is shown is none of the node's own mesh, which is cut or joined with others here: "
                "convert the solid to a mesh first"
            )
        return numbers.tolist()
