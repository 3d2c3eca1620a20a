"""Elements that are chosen in the picture as operations on the mesh that they belong to."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.editing import echo
from ...model.mesh.selecting import converted
from ...model.mesh.winged import END, LEFT, RIGHT, START
from ...model.operations.operations import OPERATIONS
from ..view.occurrences import maker_of

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.mesh.inspected import InspectedMesh
    from ...model.operations.meshes.mesh_nodes import NodeMesh
    from ..window import MainWindow
    from .chosen import Chosen

AT_ONCE = 20_000
"""Triangles of a mesh that is edited while the window waits."""


class MeshEditing:
    """Edits the node that made the chosen elements; what it refuses it says in a Refusal."""

    def __init__(self, window: MainWindow, chosen: Chosen) -> None:
        self._window, self._chosen = window, chosen

    def fault(self) -> str | None:
        """Why what is chosen cannot be edited, or None."""
        from ...model.document.primitives import ImportedMesh, Polyhedron

        if self._chosen.mesh is None or not self._chosen.count:
            return "choose a vertex, an edge or a face first"
        makers = self._makers()
        if len(makers) != 1:
            return "choose elements that one node made" if makers else "no node made what is chosen"
        try:
            node = find(self._window.session.document, makers[0])
        except Refusal:
            return "the picture is behind the document"
        if not isinstance(node, ImportedMesh | Polyhedron):
            return f"“{node.label}” is no mesh: convert the solid to one first"
        return None

    def run(self, name: str) -> None:
        """An edit that needs nothing typed, by its name. Raises Refusal."""
        {
            "split_edge": lambda: self._edge("split_mesh_edge", "Split edge"),
            "flip_edge": lambda: self._edge("flip_mesh_edge", "Flip edge"),
            "collapse_edge": lambda: self._edge("collapse_mesh_edge", "Collapse edge"),
            "split_face": self._split_face,
            "reverse_faces": lambda: self._faces("reverse_mesh_faces", "Reverse faces"),
            "delete_faces": lambda: self._faces("delete_mesh_faces", "Delete faces"),
        }[name]()

    def move(self, by: Sequence[float]) -> None:
        """Move the vertices of all that is chosen by a vector in the node's own axes. Raises Refusal."""
        mesh, chosen = self._mesh(), self._chosen
        vertices = np.flatnonzero(converted(mesh.winged, chosen.members, chosen.kind, "vertex"))
        places, node = mesh.lists.vertices[vertices], self._makers()[0]
        self._step("move_mesh_vertices", "Move vertices", node, lambda own: [_vertices(own, places), list(by)])

    def convert(self, root: str) -> None:
        """Make one mesh of a solid. Raises Refusal."""
        self._step("convert_to_mesh", "Convert to mesh", root)

    def _edge(self, operation: str, label: str) -> None:
        mesh = self._mesh()
        if self._chosen.edge < 0:
            raise Refusal("choose one edge first")
        places = mesh.lists.vertices[mesh.winged.table[self._chosen.edge, [START, END]]]
        self._step(operation, label, self._makers()[0], lambda own: [_vertices(own, places)])

    def _faces(self, operation: str, label: str) -> None:
        corners = self._corners()
        self._step(operation, label, self._makers()[0], lambda own: [_triangles(own, corners)])

    def _split_face(self) -> None:
        corners = self._corners()
        if len(corners) != 1:
            raise Refusal("choose one triangle first, with triangles instead of polygons as faces")
        self._step("split_mesh_face", "Split face", self._makers()[0], lambda own: _triangles(own, corners))

    def _corners(self) -> np.ndarray:
        """(k, 3, 3) the corners of the triangles of the chosen faces. Raises Refusal."""
        mesh, chosen = self._mesh(), self._chosen
        if chosen.kind != "face":
            raise Refusal("choose some faces first")
        return mesh.lists.vertices[mesh.triangles[chosen.members[mesh.triangle_face]]]

    def _step(
        self, operation: str, label: str, node: str, arguments: Callable[[NodeMesh], list[Any]] | None = None
    ) -> None:
        """Do an operation on a node as a step, `arguments` found in its own mesh; in the background where it is large.
        Raises Refusal."""
        window, before = self._window, self._window.session.document

        def work() -> tuple[Document, str]:
            from ...model.operations.meshes.mesh_nodes import mesh_of_node

            found = [node] if arguments is None else [node, *arguments(mesh_of_node(before, node))]
            after = OPERATIONS[operation](before, *found)
            return after, echo.step(before, after, operation, *found)

        def done(result: tuple[Document, str]) -> None:
            if window.session.document is not before:
                window.actions_.refused.emit(f"{label}: the document has changed meanwhile; do it again")
                return
            after, line = result
            window.session.commit(label, after, line=line)

        mesh = self._chosen.mesh
        if mesh is None or len(mesh.triangles) <= AT_ONCE:
            done(work())
            return
        window.files.background.run(label, work, done, lambda refusal: window.actions_.refused.emit(str(refusal)))

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


def _vertices(own: NodeMesh, places: np.ndarray) -> list[int]:
    """The numbers that vertices of the picture have in the node's own mesh. Raises Refusal."""
    return _known(own.vertex_numbers(places), "vertex")


def _triangles(own: NodeMesh, corners: np.ndarray) -> list[int]:
    """The numbers that triangles of the picture have in the node's own mesh. Raises Refusal."""
    return _known(own.triangle_numbers(corners), "triangle")


def _known(numbers: np.ndarray, what: str) -> list[int]:
    if (numbers < 0).any():
        raise Refusal(
            f"a {what} that is shown is none of the node's own mesh, which is cut or joined with others here: "
            "convert the solid to a mesh first"
        )
    return numbers.tolist()
