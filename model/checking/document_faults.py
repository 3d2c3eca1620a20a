"""The faults of a document's meshes, solids and outlines, each with its places in the world."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.outlines import Outlines
from ..document.placement import IDENTITY, Placement
from ..document.resolve import resolve
from ..document.tree import walk
from ..mesh.faults.drawings import DrawingFaults, find_drawing_faults
from ..mesh.faults.report import MeshFaults, Progress, find_faults
from ..operations.meshes.mesh_nodes import MESHES, NodeMesh, part_of
from ..solid.places import Place, places_of
from ..solid.tessellation import DEFAULT_TOLERANCE

Floats = NDArray[np.float64]

FINENESS = 0.1
"""Curves of outlines are looked at as chords within this share of the tolerance, but no finer than FINEST mm."""
FINEST = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class NodeFaults:
    """What is wrong with a node: `kind` is "mesh" (as it came, before it becomes a solid), "solid" or "outline".

    Vertices of a mesh's findings are numbered as in `mesh_of_node`. `matrix` (3, 4) maps the findings' places to the
    world: those of outlines are in the outline's own plane. Where `faults` is None, `message` says why there is no
    report.
    """

    id: str
    name: str
    kind: str
    faults: MeshFaults | DrawingFaults | None
    matrix: Floats
    message: str = ""

    def __str__(self) -> str:
        return self.message if self.faults is None else str(self.faults)

    def places(self) -> Floats:
        """(k, 3) mm, where the findings are in the world."""
        if self.faults is None or not self.faults.findings:
            return np.zeros((0, 3))
        own = np.array([finding.place for finding in self.faults.findings])
        return own @ self.matrix[:, : own.shape[1]].T + self.matrix[:, 3]

    def table(self) -> dict[str, Any]:
        """Plain values, as JSON has them; places are those in the world."""
        head = {"id": self.id, "name": self.name, "kind": self.kind, "words": str(self)}
        if self.faults is None:
            return head
        told = self.faults.table()
        for finding, place in zip(told["findings"], self.places().tolist(), strict=True):
            finding["place"] = place
        return head | told


def document_faults(
    document: Document,
    tolerance: float = 1e-3,
    ids: Iterable[str] | None = None,
    progress: Callable[[str, float], None] | None = None,
    fineness: float = DEFAULT_TOLERANCE,
) -> tuple[NodeFaults, ...]:
    """Faults of the visible roots, and of every mesh that stands as an operand in them; or of the nodes with these ids.

    Meshes are looked at as they came, in the first place where they stand, other solids as they evaluate within
    `fineness` mm, outlines in their own plane. `progress` hears what is looked at and which share is done, 0 to 1. The
    tolerance is in mm. Raises Refusal for one that is none.
    """
    if not np.isfinite(tolerance) or tolerance < 0.0:
        raise Refusal(f"a tolerance must be a number from 0 mm up, not {tolerance!r:.40}")
    resolved = resolve(document)
    standing = (*resolved.solids, *resolved.profiles)
    wanted = _chosen(standing) if ids is None else list(dict.fromkeys(ids))
    places = places_of(standing, wanted)
    flat = Outlines()
    found = []
    for number, node_id in enumerate(wanted):
        if node_id not in places:
            raise Refusal(f"there is no node {node_id} in the document's solids and outlines")
        place = places[node_id][0]
        told = _told(progress, place.node.label, number, len(wanted))
        if isinstance(place.node, MESHES):
            found.append(_of_mesh(place, tolerance, told))
        elif place.node in flat:
            found.append(_of_outline(place, tolerance, told))
        else:
            found.append(_of_solid(place, tolerance, fineness, told))
    return tuple(found)


def _chosen(standing: Iterable[Node]) -> list[str]:
    """The visible roots, each followed by the meshes within it."""
    found: dict[str, None] = {}
    for root in standing:
        if root.visible:
            found[root.id] = None
            found |= dict.fromkeys(node.id for node in walk(root) if isinstance(node, MESHES))
    return list(found)


def _of_mesh(place: Place, tolerance: float, told: Progress | None) -> NodeFaults:
    try:
        part = part_of(place.node)
        mesh = NodeMesh(part.vertices, part.triangles.astype(np.int64), place.matrix)
        return _found(place, "mesh", find_faults(*mesh.in_world(), tolerance, told))
    except Refusal as refusal:
        return _none(place, "mesh", str(refusal))


def _of_solid(place: Place, tolerance: float, fineness: float, told: Progress | None) -> NodeFaults:
    from ..solid.evaluate import Evaluator
    from ..solid.maps import moved
    from ..solid.results import arrays_of, messages_of

    bare = place.node.with_(placement=Placement())
    entry = Evaluator().evaluate(bare, fineness)
    if entry.solid is None:
        why = next((message.message for message in messages_of(bare, entry.problems) if message.error), "it failed")
        return _none(place, "solid", why)
    try:
        mesh = arrays_of(moved(entry.solid, place.matrix).to_mesh64())
        return _found(place, "solid", find_faults(*mesh, tolerance, told))
    except Refusal as refusal:
        return _none(place, "solid", str(refusal))


def _of_outline(place: Place, tolerance: float, told: Progress | None) -> NodeFaults:
    from ..outline.paths import path_of

    try:
        path = path_of(place.node.with_(placement=Placement()))
        if any(contour.dimension == 3 for contour in path.contours):
            return _none(place, "outline", "it leaves its plane: only what is flat is looked at")
        found = find_drawing_faults(segments_of(path, tolerance), tolerance, told)
        found = replace(found, segments=sum(len(contour) for contour in path.contours))  # the user's, not the chords
        return NodeFaults(place.node.id, place.node.label, "outline", found, place.matrix)
    except Refusal as refusal:
        return _none(place, "outline", str(refusal))


def segments_of(path: Any, tolerance: float) -> Floats:
    """(n, 2, 2) the chords of a flat path."""
    from ..path.flatten import chords

    drawn = chords(path, max(FINENESS * tolerance, FINEST))
    inner = np.ones(len(drawn.points), bool)
    inner[drawn.starts[1:] - 1] = False
    begins = np.flatnonzero(inner)
    return np.stack((drawn.points[begins], drawn.points[begins + 1]), axis=1)


def _found(place: Place, kind: str, faults: MeshFaults) -> NodeFaults:
    return NodeFaults(place.node.id, place.node.label, kind, faults, IDENTITY)


def _none(place: Place, kind: str, why: str) -> NodeFaults:
    return NodeFaults(place.node.id, place.node.label, kind, None, IDENTITY, why)


def _told(progress: Progress | None, label: str, number: int, count: int) -> Progress | None:
    return (lambda what, share: progress(label, (number + share) / count)) if progress else None
