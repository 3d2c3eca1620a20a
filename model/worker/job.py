"""What a lane is asked to do, and how the worker is told."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ..document.document import Document, Section
from ..document.table import to_table

if TYPE_CHECKING:
    from ..drafting.plan import Plan
    from ..solid.display import DisplayMesh


@dataclass(slots=True)
class Job:
    """One request: `word` names the worker's method; the other fields are those that it takes.

    A tolerance of 0 is none.
    """

    number: int
    word: str
    document: Document
    tolerance: float
    path: str = ""
    solid: str | None = None
    tries: int = 0
    tolerances: tuple[float, ...] = ()
    ids: tuple[str, ...] = ()
    section: Section | None = None
    supersedes: bool = True
    meshes: tuple[DisplayMesh, ...] = ()
    plan: Plan | None = None
    between: bool = False


def request_of(job: Job, pictures: set[bytes], surfaces: set[bytes]) -> tuple[Any, ...]:
    """The message to the worker; `pictures` and `surfaces` are keys of what it need not send again. Raises Refusal."""
    if job.word == "partition":
        return "partition", job.number, tuple(_bare(mesh) for mesh in job.meshes)
    table = to_table(job.document)
    if job.word == "evaluate":
        return "evaluate", job.number, table, job.tolerance, pictures
    if job.word == "examine":
        return "examine", job.number, table, job.tolerance, job.ids, surfaces
    if job.word == "prepare":
        return "prepare", job.number, table, job.tolerances, job.solid
    if job.word == "draw":
        return "draw", job.number, table, job.tolerance or None, job.solid, job.plan, job.path
    if job.word == "faults":
        return "faults", job.number, table, job.tolerance, job.ids
    if job.word == "play":
        return "play", job.number, table, job.tolerance, job.solid, job.between
    if job.word == "pairs":
        return "pairs", job.number, table, job.tolerance
    return "export", job.number, table, job.path, job.tolerance, job.solid, job.section


def _bare(mesh: DisplayMesh) -> DisplayMesh:
    """A third of the mesh: what Faces are made from. The exact triangles stand in for those of the picture."""
    return replace(
        mesh, points=mesh.points[:0], normals=mesh.normals[:0], triangles=mesh.corners, owners=(),
        edge_points=mesh.edge_points[:0], edges=mesh.edges[:0], edge_sides=mesh.edge_sides[:0],
    )  # fmt: skip
