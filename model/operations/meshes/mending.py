"""Meshes of nodes repaired."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.tree import find
from ...mesh.faults.repair import REPAIRS, Repaired, mended, repaired
from ...mesh.faults.report import Progress
from .mesh_nodes import mesh_of_node, with_mesh

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
    mesh = mesh_of_node(document, node_id)
    before = mesh.in_world()
    try:
        *after, _ = mended(*before, tolerance, repairs, longest)
    except Refusal as refusal:
        raise Refusal(f"“{find(document, node_id).label}”: {refusal}") from None
    if all(np.array_equal(one, other) for one, other in zip(before, after, strict=True)):
        return document
    return with_mesh(document, node_id, *mesh.from_world(*after))


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
    return repaired(*mesh_of_node(document, node_id).in_world(), tolerance, repairs, longest, progress)
