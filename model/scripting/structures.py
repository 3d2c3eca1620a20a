"""What scripts do with the structures of a mesh, of a solid or of what an outline fills: lists, winged edge, tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.tree import walk
from .documents import document_of, evaluate

if TYPE_CHECKING:
    from ..mesh.inspected import InspectedMesh
    from ..mesh.lists import MeshLists
    from ..mesh.tables import Table
    from ..mesh.winged import WingedEdge


def inspected(solid: Node | Document, triangles: bool = False, tolerance: float = 0.05) -> InspectedMesh:
    """A solid's mesh with all that is known of it: `lists`, `winged`, `bend` and `length` of its edges, `area` and
    `maker` of its faces, `topology`; see solidtree.model.mesh.inspected. Its faces are polygons with holes, or
    `triangles`. Of an outline it is what that fills. solidtree.model.mesh.selecting has the functions that pick
    elements out. Raises Refusal.

    >>> inspected(box(10)).topology.euler
    2
    >>> washer = path("M 0 0 H 9 V 9 H 0 Z M 3 3 V 6 H 6 V 3 Z")
    >>> inspected(washer).area.tolist(), inspected(washer, triangles=True).lists.face_count
    ([72.0], 8)
    """
    from ..mesh.inspected import inspect_mesh

    evaluation = evaluate(solid, tolerance=tolerance)
    there = len(evaluation.solids) + len(evaluation.profiles)
    if there != 1:
        raise Refusal(f"one solid or outline is looked into at a time, and there are {there}")
    if evaluation.profiles:
        from ..solid.outlines.sheet import sheet_of

        mesh = sheet_of(evaluation.profiles[0].root, tolerance)
        if len(mesh.corners) < 2:
            raise Refusal(f"“{evaluation.profiles[0].root.label}” fills nothing: it is open, or leaves its plane")
        return inspect_mesh(mesh, not triangles)
    mesh = evaluation.display(evaluation.solids[0])
    if mesh is None:
        raise Refusal(next(message.message for message in evaluation.solids[0].messages if message.error))
    return inspect_mesh(mesh, not triangles)


def mesh_lists(solid: Node | Document, triangles: bool = False, tolerance: float = 0.05) -> MeshLists:
    """A solid as lists of vertices, normals and faces: polygons with holes, or `triangles`. Raises Refusal.

    >>> lists = mesh_lists(box(10))
    >>> len(lists.vertices), len(lists.normals), lists.face_count
    (8, 6, 6)
    """
    return inspected(solid, triangles, tolerance).lists


def winged_edge(solid: Node | Document, triangles: bool = False, tolerance: float = 0.05) -> WingedEdge:
    """A solid as a winged edge, with its walks: `star`, `loop`, `border`. Raises Refusal.

    >>> len(winged_edge(box(10))), len(winged_edge(box(10)).star(0))
    (12, 3)
    """
    return inspected(solid, triangles, tolerance).winged


def mesh_table(solid: Node | Document, name: str = "edges", triangles: bool = False, tolerance: float = 0.05) -> Table:
    """The table of a solid's "vertices", "normals", "faces" or "edges": its `titles`, its `rows()` as texts, and
    `write_csv(file)`. Raises Refusal.

    >>> next(mesh_table(box(10), "faces").rows())[:3]
    ['0', '1 0 4 5', '0 0 0 0']
    """
    from ..mesh.tables import TABLES, Tables

    if name not in TABLES:
        raise Refusal(f"no table is called {name!r}; take {', '.join(TABLES)}")
    document = document_of(solid)
    mesh = inspected(document, triangles, tolerance)
    return Tables(mesh, maker_names(document, mesh)).of(name)


def maker_names(document: Document, mesh: InspectedMesh) -> tuple[str, ...]:
    """The names of the nodes that a mesh's owners end at."""
    known = {node.id: node.label for node in walk(*document.roots)}
    ids = (next(str(part) for part in reversed(path) if isinstance(part, str)) for path in mesh.owners)
    return tuple(known.get(node_id, "") for node_id in ids)


__all__ = ["inspected", "mesh_lists", "mesh_table", "winged_edge"]
