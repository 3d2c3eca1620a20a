"""Meshes of nodes repaired."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.tree import find
from ...mesh.faults.words import REPAIRS
from .mesh_nodes import mesh_of_node, numbers_of, with_mesh

if TYPE_CHECKING:
    from ...mesh.faults.repair import Repaired
    from ...mesh.faults.report import Progress

Repairs = Collection[str] | str


def repair_mesh(
    document: Document,
    node_id: str,
    repairs: Repairs = tuple(REPAIRS),
    tolerance: float = 0.001,
    longest: float | None = None,
) -> Document:
    """Repair the mesh of a node: "weld", "duplicates", "slivers", "orient" and "holes", or some of them.

    The tolerance and the `longest` border that is filled are in mm of the world. The document stays as it is where
    there is nothing to repair. Raises Refusal.
    """
    from ...mesh.faults.repair import mended

    mesh = mesh_of_node(document, node_id)
    before = mesh.in_world()
    try:
        points, faces, _ = mended(*before, tolerance, repairs, longest)
    except Refusal as refusal:
        raise Refusal(f"“{find(document, node_id).label}”: {refusal}") from None
    if np.array_equal(points, before[0]) and np.array_equal(faces, before[1]):
        return document
    return with_mesh(document, node_id, *mesh.from_world(points, faces))


def close_mesh_holes(document: Document, node_id: str, vertices: Iterable[int]) -> Document:
    """Fill the borders of a mesh that pass some of these vertices, told by their numbers in `mesh_of_node`.

    Raises Refusal where that closes nothing.
    """
    from ...mesh.faults.holes import close_holes

    mesh, label = mesh_of_node(document, node_id), find(document, node_id).label
    rows = numbers_of(vertices, len(mesh.vertices), "vertex", label)
    points, faces, said = close_holes(mesh.vertices, mesh.triangles, at=rows)
    if len(faces) == len(mesh.triangles):
        raise Refusal(f"“{label}”: {said or 'no border that could be filled passes there'}")
    return with_mesh(document, node_id, points, faces)


def repair_of(
    document: Document,
    node_id: str,
    repairs: Repairs = tuple(REPAIRS),
    tolerance: float = 0.001,
    longest: float | None = None,
    progress: Progress | None = None,
) -> Repaired:
    """What `repair_mesh` does, in the world's axes: words about each change, and the reports before and after.

    Raises Refusal.
    """
    from ...mesh.faults.repair import repaired

    return repaired(*mesh_of_node(document, node_id).in_world(), tolerance, repairs, longest, progress)
