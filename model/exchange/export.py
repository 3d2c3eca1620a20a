"""A document's solids evaluated and written as a mesh file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..document.document import Document
from ..document.errors import Refusal
from ..document.tree import chosen_solids
from ..solid.results import Evaluation, SolidResult, arrays_of, evaluate_document, owned_faces
from ..solid.tessellation import DEFAULT_TOLERANCE
from ..surface.appearance import is_dressed
from .curves_out import is_drawing_ending, outlines_to_write, write_curves
from .dress import check_bitmaps, dress_of
from .meshes_out import OutSolid, check_ending, holds_materials, write_meshes


def export_document(
    document: Document,
    path: Path,
    tolerance: float = DEFAULT_TOLERANCE,
    solid: str | None = None,
    progress: Callable[[str], None] | None = None,
) -> tuple[SolidResult, ...]:
    """Write the visible solids, or the one of this name, in the format of the path's ending; to SVG and DXF outlines.

    The result is what was evaluated; empty solids are left out of the file. Raises Refusal, and then writes nothing,
    where a solid failed or nothing is left to write.
    """
    if is_drawing_ending(path):
        write_curves(path, outlines_to_write(document, solid), tolerance)
        return ()
    check_ending(path)
    results, solids = solids_to_write(document, tolerance, solid, progress, holds_materials(path))
    write_meshes(path, solids)
    return results


def solids_to_write(
    document: Document,
    tolerance: float,
    solid: str | None,
    progress: Callable[[str], None] | None = None,
    dressed: bool = False,
) -> tuple[tuple[SolidResult, ...], list[OutSolid]]:
    """What was evaluated, and of it what goes into a file, `dressed` with its materials. Raises Refusal as
    `export_document` does."""
    wanted = [root.id for root in chosen_solids(document, solid)]
    evaluation = evaluate_document(document, tolerance, wanted, progress=progress)
    results = evaluation.solids
    for result in results:
        if result.solid is None:
            raise Refusal(next(f"“{m.name}”: {m.message}" for m in result.messages if m.error))
    full = [result for result in results if result.solid is not None and not result.solid.is_empty()]
    solids = [_out_solid(document, evaluation, result, dressed) for result in full]
    if not solids:
        raise Refusal("there is nothing to write: every solid is empty" if results else "the document holds no solid")
    return results, solids


def _out_solid(document: Document, evaluation: Evaluation, result: SolidResult, dressed: bool) -> OutSolid:
    root = result.root
    if dressed and is_dressed(document, root):
        faces = owned_faces(result, evaluation.evaluator)
        dress = dress_of(document, root, faces)
        if dress is not None:
            check_bitmaps(dress)
            return OutSolid(root.name, root.colour, faces.vertices, faces.corners, dress)
    return OutSolid(root.name, root.colour, *arrays_of(result.mesh()))
