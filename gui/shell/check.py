"""`solidtree check`: which solids overlap or come too near to each other, as JSON, and as a report to print."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable
from pathlib import Path

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.operations.checks import check_pair, set_clearance, solid_called
from ..command_line import DONE, NOT_IN_ORDER, TOLERANCE, Bar, naming, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `check`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument(
        "--clearance", type=_clearance, metavar="MM", help="the least gap; default what the project asks, else 0"
    )
    command.add_argument(
        "--pair", action="append", nargs=3, default=[], metavar=("A", "B", "MM"), help="a least gap of these two alone"
    )
    command.add_argument(
        "--touching", action="append", nargs=2, default=[], metavar=("A", "B"), help="these two are meant to touch"
    )
    command.add_argument("--report", metavar="OUT.html", help="write the findings there, with pictures, to be printed")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def check(options: argparse.Namespace) -> int:
    """Print the pairs that are not as asked; the status is 1 where there are some."""
    from ...model.proximity.checking import check_document, table_of
    from ...model.proximity.memo import PairMemo

    if options.report is not None:
        naming(options.report, lambda: _check_ending(options.report))
    document = _asked(read_with_values(options), options)
    if not document.solids:
        raise Refusal("the document holds no solid")
    bar, memo = Bar(document), PairMemo()

    def counted(what: str) -> Callable[[int, int], None]:
        return lambda done, total: bar.show(what, done / total)

    try:
        report = check_document(
            document,
            options.tolerance,
            memo=memo,
            progress=bar,
            told=counted("pairs of solids"),
            bodies=options.report is not None,
        )
        if options.report is not None:
            from ...model.proximity.findings import Triangles
            from .clearance_report import write_report

            title = Path(options.file).name
            surfaces = {
                one.root.id: Triangles(one.body.vertices, one.body.triangles)
                for one in memo.standing(document, options.tolerance)
            }
            naming(
                options.report,
                lambda: write_report(
                    options.report, title, document, report, surfaces, options.tolerance, counted("pictures")
                ),
            )
    finally:
        bar.end()
    status = told(options.file, report.messages, document)
    print(json.dumps(table_of(report), indent=2, ensure_ascii=False, allow_nan=False))
    return max(status, DONE) if report.in_order else NOT_IN_ORDER


def _asked(document: Document, options: argparse.Namespace) -> Document:
    """The document with what the options ask of its solids, over what it asks itself."""
    if options.clearance is not None:
        document = set_clearance(document, options.clearance)
    for one, other, text in options.pair:
        document = check_pair(document, solid_called(document, one), solid_called(document, other), _length(text))
    for one, other in options.touching:
        document = check_pair(document, solid_called(document, one), solid_called(document, other), touching=True)
    return document


def _check_ending(out: str) -> None:
    if not out.lower().endswith((".html", ".htm")):
        raise Refusal("a report is written as HTML: let the name end in .html")


def _length(text: str) -> float:
    try:
        length = float(text)
    except ValueError:
        length = math.nan
    if not 0.0 <= length < math.inf:
        raise Refusal(f"{text!r} is no clearance in mm, 0 or more")
    return length


def _clearance(text: str) -> float:
    try:
        return _length(text)
    except Refusal as refusal:
        raise argparse.ArgumentTypeError(str(refusal)) from None
