"""`solidtree faults`: what is wrong with the meshes, solids and outlines of a file, and a file of them mended."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.tree import find
from ..command_line import DONE, NOT_IN_ORDER, TOLERANCE, Bar, naming, positive, warn
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `faults`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument(
        "--tolerance",
        type=_length,
        default=0.001,
        metavar="MM",
        help="how near is too near, and how thin too thin; default 0.001",
    )
    command.add_argument("--solid", metavar="NAME", help="this solid, or outline, alone; default: all that are visible")
    command.add_argument("--repair", metavar="OUT", help="write the mended solids or outlines there, by OUT's ending")
    command.add_argument(
        "--repairs",
        metavar="weld,holes,...",
        help="of meshes weld, duplicates, slivers, orient and holes; of outlines weld and cut; default: all of the "
        "former, weld of the latter",
    )
    command.add_argument("--longest", type=positive, metavar="MM", help="the longest border that is filled")
    add_parameter_options(command)


def faults(options: argparse.Namespace) -> int:
    """Look, mend where asked to, and tell; the status is 1 where faults are found, or left."""
    from ...model.checking.document_faults import document_faults

    if options.repair is not None:
        naming(options.repair, lambda: _check_ending(Path(options.repair)))
    document = read_with_values(options)
    ids = _chosen(document, options.solid)
    bar = Bar(document)
    try:
        found = document_faults(document, options.tolerance, ids, bar.show)
        if options.repair is None:
            told: list[dict[str, Any]] = [one.table() for one in found]
        else:
            document, told = _mended(document, [one.id for one in found], options)
            after = document_faults(document, options.tolerance, [one.id for one in found], bar.show)
            told = [
                {"name": one.name, "before": one.table(), **said, "after": then.table()}
                for one, said, then in zip(found, told, after, strict=True)
            ]
            found = after
    finally:
        bar.end()
    if options.repair is not None:
        naming(options.repair, lambda: _write(document, options))
    for one in found:
        if one.faults is None:
            warn(options.file, f"“{one.name}”: {one.message}")
    print(json.dumps({"nodes": told, "tolerance": options.tolerance}, indent=2, ensure_ascii=False, allow_nan=False))
    return DONE if all(one.faults is not None and one.faults.sound for one in found) else NOT_IN_ORDER


def _chosen(document: Document, name: str | None) -> list[str] | None:
    if name is None:
        if not any(root.visible for root in document.standing):
            raise Refusal("nothing in it is visible" if document.standing else "the document is empty")
        return None
    found = [root.id for root in document.standing if root.name == name]
    if not found:
        names = ", ".join(f"“{root.name}”" for root in document.standing)
        raise Refusal(f"there is no solid or outline called “{name}”; there is {names or 'none at all'}")
    return found


def _mended(document: Document, ids: list[str], options: argparse.Namespace) -> tuple[Document, list[dict[str, Any]]]:
    """The document with its meshes and outlines mended, and for each node what was done and what is worse for it."""
    from ...model.document.outlines import is_outline
    from ...model.mesh.faults.words import REPAIRS
    from ...model.operations.curves.mending import repair_outline
    from ...model.operations.meshes.mending import repair_mesh, repair_of
    from ...model.operations.meshes.mesh_nodes import MESHES

    given = None if options.repairs is None else [word.strip() for word in options.repairs.split(",")]
    told: list[dict[str, Any]] = []
    for node_id in ids:
        node = find(document, node_id)
        said: dict[str, Any] = {"changes": [], "worse": []}
        if isinstance(node, MESHES):
            wanted = tuple(REPAIRS) if given is None else given
            done = repair_of(document, node_id, wanted, options.tolerance, options.longest)
            said = {"changes": list(done.words), "worse": list(done.worse)}
            if len(done.triangles):
                document = repair_mesh(document, node_id, wanted, options.tolerance, options.longest)
            else:
                said = {"changes": [], "worse": [], "refused": "nothing would be left of it"}
        elif is_outline(node, document.definitions):
            try:
                before = document
                document = repair_outline(document, node_id, given or ("weld",), options.tolerance)
                said["changes"] = [] if document is before else ["curves joined where their ends met"]
            except Refusal as refusal:
                said["refused"] = str(refusal)
        told.append(said)
    return document, told


def _check_ending(out: Path) -> None:
    from ...model.exchange.curves_out import is_drawing_ending
    from ...model.exchange.meshes_out import check_ending

    if out.suffix.lower() != ".solidtree" and not is_drawing_ending(out):
        check_ending(out)


def _write(document: Document, options: argparse.Namespace) -> None:
    """Meshes are written as they are, closed or not; other solids as they evaluate."""
    from ...model.exchange.curves_out import is_drawing_ending, outlines_to_write, write_curves
    from ...model.exchange.export import solids_to_write
    from ...model.exchange.meshes_out import write_meshes
    from ...model.exchange.solids import OutSolid
    from ...model.operations.meshes.mesh_nodes import MESHES, mesh_of_node
    from ...model.project.project_file import save_project

    out = Path(options.repair)
    if out.suffix.lower() == ".solidtree":
        save_project(document, out)
        return
    if is_drawing_ending(out):
        write_curves(out, outlines_to_write(document, options.solid), TOLERANCE)
        return
    solids: list[OutSolid] = []
    for root in document.solids:
        if root.name != options.solid if options.solid is not None else not root.visible:
            continue
        if isinstance(root, MESHES):
            solids.append(OutSolid(root.name, root.colour, *mesh_of_node(document, root.id).in_world()))
        else:
            solids += solids_to_write(document, TOLERANCE, root.name)[1]
    write_meshes(out, solids)


def _length(text: str) -> float:
    """A number from zero up, for options."""
    return 0.0 if text.strip() in ("0", "0.0") else positive(text)
