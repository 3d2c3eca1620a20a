"""`solidtree check`: which solids overlap or come too near to each other, as JSON."""

from __future__ import annotations

import argparse
import json

from ...model.document.errors import Refusal
from ..command_line import DONE, NOT_IN_ORDER, TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `check`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("--clearance", type=_clearance, metavar="MM", help="the least gap; default: the document's")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def check(options: argparse.Namespace) -> int:
    """Print the pairs that overlap or are nearer than the clearance; the status is 1 where there are some."""
    from ...model.proximity.checking import checked

    document = read_with_values(options)
    if not document.solids:
        raise Refusal("the document holds no solid")
    bar = Bar(document)
    try:
        answer, messages = checked(document, options.clearance, options.tolerance, bar)
    finally:
        bar.end()
    status = told(options.file, messages, document)
    print(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
    return NOT_IN_ORDER if answer["pairs"] else max(status, DONE)


def _clearance(text: str) -> float:
    try:
        return float(text) and positive(text)
    except ValueError:
        return positive(text)
