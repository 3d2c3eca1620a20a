"""`solidtree bsp`: the BSP tree of a document's faces, in figures."""

from __future__ import annotations

import argparse
import json

from ...model.document.errors import Refusal
from ...model.document.tree import chosen_solids
from ..command_line import NOT_IN_ORDER, TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `bsp`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument(
        "--builder",
        choices=("good", "textbook"),
        default="good",
        help="the good one, which looks for planes that cut little, or the textbook's: the faces as they come",
    )
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def bsp(options: argparse.Namespace) -> int:
    """Build, measure and tell; the status is 1 where there is no face to sort, or a solid failed."""
    from ...model.partition.faces import faces_of_meshes
    from ...model.partition.report import builder_fault, built
    from ...model.solid.results import evaluate_document

    document = read_with_values(options)
    ids = [root.id for root in chosen_solids(document, options.solid)]
    if not ids:
        raise Refusal("no solid is visible" if document.solids else "the document holds no solid")
    bar = Bar(document)
    try:
        evaluation = evaluate_document(document, options.tolerance, ids, progress=bar)
    finally:
        bar.end()
    status = told(options.file, evaluation.messages, document)
    meshes = [evaluation.display(result) for result in evaluation.solids]
    faces = faces_of_meshes([mesh for mesh in meshes if mesh is not None])
    fault = builder_fault(options.builder, faces.count)
    if fault:
        raise Refusal(fault)
    _, report = built(faces, options.builder)
    print(json.dumps(report.json(), indent=2, allow_nan=False))
    return status if faces.count and all(mesh is not None for mesh in meshes) else NOT_IN_ORDER
