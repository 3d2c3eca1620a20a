"""`solidtree mesh`: the lists and the winged edge of a document's solids, in figures or as a table."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from ...model.document.errors import Refusal
from ...model.document.tree import chosen_solids
from ..command_line import NOT_IN_ORDER, TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values

if TYPE_CHECKING:
    from ...model.mesh.inspected import InspectedMesh

TABLES = ("vertices", "normals", "faces", "edges")


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `mesh`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT.csv", nargs="?", help="where the table goes; default: standard output")
    command.add_argument("--table", choices=TABLES, help="one solid's table as CSV instead of figures as JSON")
    command.add_argument("--triangles", action="store_true", help="triangles as faces instead of polygons with holes")
    command.add_argument("--from-1", action="store_true", help="count vertices, normals, faces and edges from 1")
    command.add_argument("--costs", action="store_true", help="measure what walks take in each representation, too")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def mesh(options: argparse.Namespace) -> int:
    """Look into each solid and tell; the status is 1 where one failed, or is not closed."""
    from ...model.mesh.inspected import inspect_mesh
    from ...model.mesh.tables import Tables
    from ...model.scripting.structures import maker_names
    from ...model.solid.results import evaluate_document

    document = read_with_values(options)
    roots = chosen_solids(document, options.solid)
    if not roots:
        raise Refusal("no solid is visible" if document.solids else "the document holds no solid")
    if options.out and not options.table:
        raise Refusal("say which table is to be written: --table vertices, normals, faces or edges")
    if options.table and len(roots) > 1:
        raise Refusal(f"a table is of one solid, and {len(roots)} are visible: name one with --solid")
    bar = Bar(document)
    try:
        evaluation = evaluate_document(document, options.tolerance, [root.id for root in roots], progress=bar)
    finally:
        bar.end()
    status = told(options.file, evaluation.messages, document)
    found: list[tuple[str, InspectedMesh]] = []
    for result, root in zip(evaluation.solids, roots, strict=True):
        shown = evaluation.display(result)
        if shown is not None:
            found.append((root.label, inspect_mesh(shown, not options.triangles)))
    if options.table:
        if not found:
            return status or NOT_IN_ORDER
        table = Tables(found[0][1], maker_names(document, found[0][1])).of(options.table)
        if options.out:
            with Path(options.out).open("w", encoding="utf-8", newline="") as file:
                table.write_csv(file, first=int(options.from_1))
        else:
            table.write_csv(sys.stdout, first=int(options.from_1))
        return status
    solids = [_figures(name, one, options.costs) for name, one in found]
    print(json.dumps({"solids": solids}, indent=2, allow_nan=False))
    whole = len(found) == len(roots) and all(one.topology.closed for _, one in found)
    return status if whole else NOT_IN_ORDER


def _figures(name: str, one: InspectedMesh, timed: bool) -> dict[str, object]:
    from ...model.mesh.costs import QUESTIONS, costs, sizes

    found = one.topology
    figures: dict[str, object] = {
        "name": name,
        "vertices": found.vertices,
        "normals": len(one.lists.normals),
        "edges": found.edges,
        "faces": found.faces,
        "loops": found.loops,
        "euler": found.euler,
        "genus": found.genus,
        "components": found.components,
        "borders": found.borders,
        "naked_edges": int(one.naked.sum()),
        "non_manifold_edges": int(one.non_manifold.sum()),
        "closed": found.closed,
        "bytes": sizes(one),
    }
    if timed:
        figures["seconds"] = {
            cost.name: {
                question: None if seconds != seconds else seconds
                for question, seconds in zip(QUESTIONS, cost.seconds, strict=True)
            }
            for cost in costs(one)
        }
    return figures
