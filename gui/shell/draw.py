"""`solidtree draw`: a drawing with hidden faces and lines removed, on a page, as SVG, PDF or DXF."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ...model.document.errors import Refusal
from ...model.drafting.paper import SIZES, papers, scale_from
from ...model.drafting.plan import Eye, NothingToDraw, Plan
from ..command_line import NOT_IN_ORDER, Bar, naming, positive, warn
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values
from .render import add_view_options

Value = TypeVar("Value")


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `draw`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT.svg|.pdf|.dxf", help="DXF has the model's true size, whatever the scale")
    add_view_options(command, "full vertical angle; default is parallel projection")
    command.add_argument("--sheet", choices=("first", "third"), help="front, top and side view, and one from a corner")
    command.add_argument("--no-iso", action="store_true", help="with --sheet: without the view from a corner")
    command.add_argument(
        "--scale",
        type=_words(scale_from),
        metavar="1:2",
        help="paper by model: 1:2, 5:1, a number, or fit, the default",
    )
    command.add_argument(
        "--page",
        type=_words(_page),
        default="A4",
        metavar="A4",
        help=f"{', '.join(SIZES)}, also as A4-portrait or A4-landscape, or 300x200 in mm; default A4",
    )
    command.add_argument("--hidden", choices=("dashed", "omit"), default="dashed", help="hidden lines; default dashed")
    command.add_argument(
        "--faces", choices=("fill", "none"), default="none", help="in the solid's colour; default none"
    )
    command.add_argument(
        "--dimensions",
        action=argparse.BooleanOptionalAction,
        help="of the bounding box; default with --sheet, never in perspective",
    )
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--tolerance", type=positive, metavar="MM", help="default: 0.02 on the paper, 0.05 at most")
    add_parameter_options(command)


def draw(options: argparse.Namespace) -> int:
    """Evaluate, draw and write; the status is 1 where a solid failed or nothing is to be seen."""
    from ...model.drafting.drawing_file import check_drawing_ending, write_page
    from ...model.drafting.drawn import Draughts

    naming(options.out, lambda: check_drawing_ending(options.out))
    plan = _plan(options)
    document = read_with_values(options)
    bar = Bar(document)
    try:
        drawn = Draughts(document, options.tolerance, options.solid).page(plan, bar, bar.show)
    except NothingToDraw as refusal:
        bar.end()
        warn(options.file, f"{refusal}; nothing was written")
        return NOT_IN_ORDER
    finally:
        bar.end()
    status = told(options.file, drawn.messages, document)
    naming(options.out, lambda: write_page(options.out, drawn.page))
    return status


def _plan(options: argparse.Namespace) -> Plan:
    view: str | Eye = options.view or "iso"
    if options.eye is None and (options.target is not None or options.up is not None):
        raise Refusal("--target and --up need --eye")
    if options.eye is not None:
        if options.view is not None:
            raise Refusal("--view and --eye exclude each other")
        view = Eye(options.eye, options.target, options.up)
    if options.sheet is not None and (options.eye is not None or options.view is not None):
        raise Refusal("--sheet has views of its own: leave --view and --eye out")
    if options.no_iso and options.sheet is None:
        raise Refusal("--no-iso needs --sheet")
    return Plan(
        view=view,
        perspective=options.perspective,
        sheet=options.sheet,
        iso=not options.no_iso,
        page=options.page,
        scale=options.scale,
        hidden=options.hidden,
        faces=options.faces,
        dimensions=options.dimensions,
        title=Path(options.file).stem,
    )


def _page(words: str) -> str:
    papers(words)
    return words


def _words(read: Callable[[str], Value]) -> Callable[[str], Value]:
    """The reader of an option's words, whose refusals argparse tells."""

    def value(words: str) -> Value:
        try:
            return read(words)
        except Refusal as refusal:
            raise argparse.ArgumentTypeError(str(refusal)) from None

    return value
