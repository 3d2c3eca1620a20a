"""`solidtree export` and `solidtree convert`: mesh files, drawings of outlines and projects by their endings."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..command_line import DONE, NOT_IN_ORDER, TOLERANCE, Bar, naming, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `export`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument(
        "out", metavar="OUT", help="the file to write, by its ending: meshes get the solids, .svg and .dxf the outlines"
    )
    command.add_argument(
        "--solid", metavar="NAME", help="this solid, or this outline, alone; default: all that are visible"
    )
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def add_convert_options(command: argparse.ArgumentParser) -> None:
    """The options of `convert`."""
    command.add_argument("file", metavar="IN")
    command.add_argument("out", metavar="OUT")
    command.set_defaults(solid=None, tolerance=TOLERANCE, set=None, sets=None, parameter=[])


def export(options: argparse.Namespace) -> int:
    """Evaluate and write; the status is 1 where a solid is empty or has failed."""
    from ...model.exchange.curves_out import is_drawing_ending
    from ...model.exchange.export import solids_to_write
    from ...model.exchange.meshes_out import check_ending, holds_materials, write_meshes

    out = Path(options.out)
    if is_drawing_ending(out):
        return _export_outlines(options, out)
    project = out.suffix.lower() == ".solidtree"
    if not project:
        naming(options.out, lambda: check_ending(out))
    document = read_with_values(options)
    if project:
        from ...model.project.project_file import save_project

        naming(options.out, lambda: save_project(document, out))
        return DONE
    bar = Bar(document)
    try:
        results, solids = solids_to_write(document, options.tolerance, options.solid, bar, holds_materials(out))
    finally:
        bar.end()
    naming(options.out, lambda: write_meshes(out, solids))
    status = told(options.file, (message for result in results for message in result.messages), document)
    empty = [result for result in results if result.solid is None or result.solid.is_empty()]
    return NOT_IN_ORDER if empty else status


def _export_outlines(options: argparse.Namespace, out: Path) -> int:
    from ...model.exchange.curves_out import outlines_to_write, write_curves

    outlines = outlines_to_write(read_with_values(options), options.solid)
    naming(options.out, lambda: write_curves(out, outlines, options.tolerance))
    return DONE
