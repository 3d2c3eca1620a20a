"""Sections of a document's solids, exact ones of the evaluated surfaces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath

import numpy as np

from ..document.document import Document, Section
from ..document.errors import Refusal
from ..document.tree import chosen_solids
from ..exchange.outlines_out import NamedOutline, check_outline_ending, write_outlines
from ..solid.evaluate import Evaluator
from ..solid.provenance import Path, occurrences, owners_of_runs
from ..solid.results import SolidResult, arrays_of, evaluate_document, open_surface
from ..solid.tessellation import DEFAULT_TOLERANCE
from ..worker.shown import Message
from .section import SectionOutline, section

Vector = Sequence[float]


@dataclass(frozen=True, slots=True)
class SolidSection:
    """The outline of one solid in the world's axes. The numbers in `outline.owners` are places in `owners`."""

    name: str
    colour: str | None
    outline: SectionOutline
    owners: tuple[Path, ...]
    """The ways from the root to the leaves; -1 in `outline.owners` is none of them."""


def facing(plane: Section) -> tuple[Vector, Vector]:
    """Point and normal towards the viewer of a document's section: its own normal points into what stays."""
    x, y, z = plane.normal
    return plane.point, (-x, -y, -z)


def solid_section(result: SolidResult, evaluator: Evaluator, point: Vector, normal: Vector) -> SolidSection:
    """The section of an evaluated solid; the normal points to the viewer. Raises Refusal where the solid failed."""
    root = result.root
    if result.solid is None:
        surface = open_surface(root)
        if surface is None:
            raise Refusal(next((m.message for m in result.messages if m.error), f"“{root.name}” has no surface"))
        points, triangles = surface
        owner = np.zeros(len(triangles), np.int32)
    else:
        mesh = result.mesh()
        points, triangles = arrays_of(mesh)
        starts = np.asarray(mesh.run_index, np.int64) // 3
        owner = np.repeat(owners_of_runs(mesh, root, evaluator.originals), np.diff(starts))
    try:
        outline = section(points, triangles, point, normal, owner)
    except Refusal as refusal:
        raise Refusal(f"“{root.name}”: {refusal}") from None
    return SolidSection(root.name, root.colour, outline, tuple(o.path for o in occurrences(root)))


def document_sections(
    document: Document,
    point: Vector,
    normal: Vector,
    tolerance: float = DEFAULT_TOLERANCE,
    solid: str | None = None,
    progress: Callable[[str], None] | None = None,
) -> tuple[list[SolidSection], tuple[Message, ...]]:
    """The sections of the visible solids, or of the one of this name, and what there is to tell about their nodes.

    The normal points to the viewer. Raises Refusal where a solid failed or there is none.
    """
    wanted = [root.id for root in chosen_solids(document, solid)]
    if not wanted:
        raise Refusal("no solid is visible" if document.solids else "the document holds no solid")
    evaluation = evaluate_document(document, tolerance, wanted, progress=progress)
    found = [solid_section(result, evaluation.evaluator, point, normal) for result in evaluation.solids]
    return found, evaluation.messages


def named_outlines(sections: Sequence[SolidSection]) -> list[NamedOutline]:
    """As drawings name them."""
    return [NamedOutline(found.name, found.colour, found.outline) for found in sections]


def export_section(
    document: Document,
    plane: Section,
    path: FilePath,
    tolerance: float = DEFAULT_TOLERANCE,
    solid: str | None = None,
    progress: Callable[[str], None] | None = None,
) -> None:
    """Write what a section of the document cuts, as seen from its open side, as .svg or .dxf. Raises Refusal."""
    check_outline_ending(path)
    found, _ = document_sections(document, *facing(plane), tolerance, solid, progress)
    write_outlines(path, named_outlines(found))
