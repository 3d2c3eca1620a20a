"""A document evaluated in this process: solids, measures and messages by node, for scripts and the command line."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold, Mesh64, OpType
from numpy.typing import NDArray

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Hull, Node
from ..document.outlines import Lettering, TextOnPath
from ..document.primitives import Box, Cone, Cylinder, Halfspace, ImportedMesh, Sphere, Torus
from ..document.resolve import Resolver
from ..measuring.measure import Measures, measure
from ..path.path import Path
from ..pipeline.round_surfaces import round_surfaces
from ..worker.shown import Message
from .display import Creases, DisplayMesh, creases_at, display_mesh
from .entry import Entry, Problem
from .evaluate import Evaluator
from .outlines.profiles import profile_of
from .provenance import Occurrence, occurrences, owners_of_runs
from .provenance import Path as OccurrencePath
from .tessellation import DEFAULT_TOLERANCE

CONVEX = (Box, Sphere, Cylinder, Cone, Halfspace, Hull)
"""Kinds that are convex whatever their numbers."""

ROUND = (Sphere, Torus)
"""Kinds without creases."""


@dataclass(frozen=True, slots=True)
class SolidResult:
    """One evaluated root: its resolved tree, and the solid in the world's axes or None.

    `rest` is what a picture shows of a solid that failed: it without the operands that are to blame.
    """

    root: Node
    solid: Manifold | None
    messages: tuple[Message, ...]
    rest: Manifold | None = None

    def mesh(self) -> Mesh64:
        """The surface; empty where the solid failed."""
        return (self.solid or Manifold()).to_mesh64()

    def measures(self) -> Measures | None:
        """None where the solid failed; an imported surface that is not closed has some all the same."""
        if self.solid is not None:
            return measures_of(self.mesh())
        surface = open_surface(self.root)
        return None if surface is None else measure(*surface, closed=False)


@dataclass(frozen=True, slots=True)
class ProfileResult:
    """One outline that stands by itself: its resolved tree, and its curves or None; see `profile_path`."""

    root: Node
    path: Path | None
    messages: tuple[Message, ...]


def arrays_of(mesh: Mesh64) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Points (n, 3) and triangles (m, 3)."""
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)


def open_surface(root: Node) -> tuple[NDArray[np.float64], NDArray[np.int64]] | None:
    """Points and triangles, in place, of an imported mesh that is no solid; None for other nodes."""
    if not isinstance(root, ImportedMesh):
        return None
    from ..exchange.meshes_in import parts_of_asset

    try:
        part = parts_of_asset(root.asset, root.file_format)[int(root.part)]  # type: ignore[arg-type]
    except (Refusal, IndexError):
        return None
    matrix = root.placement.matrix()
    points = part.vertices * float(root.unit) @ matrix[:, :3].T + matrix[:, 3]  # type: ignore[arg-type]
    return points, part.triangles.astype(np.int64)


def measures_of(mesh: Mesh64) -> Measures:
    return measure(*arrays_of(mesh))


def messages_of(root: Node, problems: Iterable[Problem]) -> tuple[Message, ...]:
    """The problems with the nodes they are about."""
    found = []
    for problem in problems:
        node = root
        for index in problem.place:
            node = node.children[index]
        found.append(Message(node.id, node.label, problem.message, problem.error))
    return tuple(dict.fromkeys(found))


def result_of(root: Node, entry: Entry) -> SolidResult:
    return SolidResult(root, entry.solid, messages_of(root, entry.problems) + remarks_on_lettering(root), entry.rest)


def profile_result(root: Node) -> ProfileResult:
    path, problems = profile_of(root)
    return ProfileResult(root, path, messages_of(root, problems) + remarks_on_lettering(root))


def remarks_on_lettering(root: Node) -> tuple[Message, ...]:
    """What there is to say of the lettering of a resolved tree, each told once a node: characters that its fonts lack,
    or that have no room on a curve."""
    found: dict[Message, None] = {}
    stack, seen = [root], {id(root)}
    while stack:
        node = stack.pop()
        if isinstance(node, Lettering | TextOnPath):
            from ..lettering.along import remarks_along
            from ..lettering.lettering import remarks_on

            remarks = remarks_on(node) if isinstance(node, Lettering) else remarks_along(node)
            found |= dict.fromkeys(Message(node.id, node.label, remark, False) for remark in remarks)
        for child in reversed(node.children):
            if id(child) not in seen:  # what instances share stands in many places
                seen.add(id(child))
                stack.append(child)
    return tuple(found)


@dataclass(frozen=True, slots=True, eq=False)
class OwnedFaces:
    """A solid's triangles (t, 3), `corners`, over its vertices (n, 3), and who made them: the numbers in `owner` (t,)
    are places in `owners`."""

    vertices: NDArray[np.float64]
    corners: NDArray[np.int64]
    owner: NDArray[np.int32]
    owners: tuple[OccurrencePath, ...]


def owned_faces(result: SolidResult, evaluator: Evaluator) -> OwnedFaces:
    """What a file needs of an evaluated root."""
    mesh = result.mesh()
    found = occurrences(result.root)
    of_run = owners_of_runs(mesh, result.root, evaluator.originals, found)
    owner = np.repeat(of_run, np.diff(np.asarray(mesh.run_index).astype(np.int64) // 3))
    return OwnedFaces(*arrays_of(mesh), owner, tuple(occurrence.path for occurrence in found))


def creases_of(found: tuple[Occurrence, ...]) -> Creases:
    """The creases of the owners: the angle that the node nearest to the leaf says, else that of the leaf's kind."""
    asked = [next((node.crease for node in reversed(o.nodes) if node.crease is not None), None) for o in found]
    return creases_at(asked, [isinstance(occurrence.leaf, ROUND) for occurrence in found])


def display_of(result: SolidResult, evaluator: Evaluator) -> DisplayMesh | None:
    """The picture's side of an evaluated root; None where nothing of it can be shown."""
    root = result.root
    found = occurrences(root)
    solid = result.rest if result.solid is None else result.solid
    if solid is None:
        surface = open_surface(root)
        if surface is None:
            return None
        triangles = surface[1].astype(np.uint64)
        runs = np.array([0, 3 * len(triangles)], np.uint64)
        mesh = Mesh64(surface[0], triangles, run_index=runs, run_original_id=np.zeros(1, np.uint32))
        return display_mesh(mesh, np.zeros(1, dtype=np.int32), tuple(o.path for o in found), creases=creases_of(found))
    mesh = solid.to_mesh64()
    owner = owners_of_runs(mesh, root, evaluator.originals, found)
    convex = np.array([isinstance(occurrence.leaf, CONVEX) for occurrence in found], dtype=bool)
    paths = tuple(occurrence.path for occurrence in found)
    return display_mesh(mesh, owner, paths, convex, creases_of(found), round_surfaces(found))


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A document's results, in the order of its solids and of its profiles."""

    solids: tuple[SolidResult, ...]
    evaluator: Evaluator
    profiles: tuple[ProfileResult, ...] = ()

    @property
    def messages(self) -> tuple[Message, ...]:
        return tuple(message for result in (*self.solids, *self.profiles) for message in result.messages)

    @property
    def visible(self) -> tuple[SolidResult, ...]:
        return tuple(result for result in self.solids if result.root.visible)

    def display(self, result: SolidResult) -> DisplayMesh | None:
        return display_of(result, self.evaluator)

    def total(self) -> Manifold:
        """The union of the visible solids that have not failed."""
        solids = [result.solid for result in self.visible if result.solid is not None]
        return Manifold.batch_boolean(solids, OpType.Add) if len(solids) > 1 else solids[0] if solids else Manifold()


def evaluate_document(
    document: Document,
    tolerance: float = DEFAULT_TOLERANCE,
    ids: Iterable[str] | None = None,
    evaluator: Evaluator | None = None,
    progress: Callable[[str], None] | None = None,
) -> Evaluation:
    """Evaluate a document's solids and profiles (all, or the roots with these ids)."""
    evaluator = evaluator or Evaluator()
    wanted = None if ids is None else set(ids)
    resolved = Resolver().resolve(document)
    results = []
    for root in resolved.solids:
        if wanted is None or root.id in wanted:
            entry = evaluator.evaluate(root, tolerance, progress)
            results.append(result_of(root, entry))
    profiles = [profile_result(root) for root in resolved.profiles if wanted is None or root.id in wanted]
    return Evaluation(tuple(results), evaluator, tuple(profiles))
