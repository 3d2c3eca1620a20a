"""What scripts do with dirty meshes and drawings: their faults within a tolerance, and repairs."""

from __future__ import annotations

import os
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from ..document.errors import Refusal
from ..document.nodes import Node
from ..mesh.faults.words import REPAIRS
from .documents import document_of, open_document

if TYPE_CHECKING:
    from ..checking.document_faults import NodeFaults
    from ..mesh.faults.drawings import DrawingFaults
    from ..mesh.faults.report import MeshFaults


def mesh_faults(solid: Node | str | os.PathLike[str], tolerance: float = 0.001) -> MeshFaults:
    """What is wrong with a mesh, with the surface of another solid, or with the only solid of a file: counts such as
    `open_edges`, `borders` and `slivers`, `sound`, and `findings` with places in mm. Raises Refusal.

    >>> str(mesh_faults(box(10)))
    '12 triangles, 8 vertices, 1 piece: nothing found'
    """
    return _only(solid, tolerance, "solid")  # type: ignore[return-value]


def drawing_faults(outline: Node | str | os.PathLike[str], tolerance: float = 0.001) -> DrawingFaults:
    """The same of an outline, or of the only one in a file: `open_ends`, `near_ends`, `crossings` and so on; places are
    in the outline's plane. Raises Refusal.

    >>> str(drawing_faults(path("M 0 0 L 10 0 L 10 10")))
    '2 lines: 2 open ends'
    """
    return _only(outline, tolerance, "outline")  # type: ignore[return-value]


def repaired(
    solid: Node, repairs: Collection[str] | str | None = None, tolerance: float = 0.001, longest: float | None = None
) -> Node:
    """A mesh after these repairs, by default all, within a tolerance in mm; `longest` is the longest border that is
    filled. Other solids become meshes first. An outline takes "weld", the default, and "cut". Raises Refusal.

    >>> lidless = polyhedron([(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6)], [(0, 2, 1), (0, 1, 3), (1, 2, 3)])
    >>> round(measure(repaired(lidless)).volume, 9)
    36.0
    """
    from ..document.outlines import is_outline
    from ..operations.curves.mending import repair_outline
    from ..operations.meshes.mending import repair_mesh
    from ..operations.meshes.mesh_nodes import MESHES, convert_to_mesh

    document = document_of(solid)
    (root,) = document.standing
    if is_outline(root):
        return repair_outline(document, root.id, ("weld",) if repairs is None else repairs, tolerance).standing[0]
    if not isinstance(root, MESHES):
        document = convert_to_mesh(document, root.id)
    wanted = tuple(REPAIRS) if repairs is None else repairs
    return repair_mesh(document, root.id, wanted, tolerance, longest).standing[0]


def _only(what: Node | str | os.PathLike[str], tolerance: float, kind: str) -> object:
    from ..checking.document_faults import document_faults

    document = document_of(what) if isinstance(what, Node) else open_document(Path(what))
    roots = document.profiles if kind == "outline" else document.solids
    if len(roots) != 1:
        raise Refusal(f"one {kind} is needed here, and there are {len(roots)}")
    found: NodeFaults = document_faults(document, tolerance, [roots[0].id])[0]
    if found.faults is None:
        raise Refusal(f"“{found.name}”: {found.message}")
    return found.faults


__all__ = ["drawing_faults", "mesh_faults", "repaired"]
