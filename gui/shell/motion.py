"""`solidtree motion`: what meets while a motion of a document goes on, as JSON."""

from __future__ import annotations

import argparse
import json

from ...model.document.errors import Refusal
from ..command_line import DONE, TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `motion`."""
    command.add_argument("file", metavar="FILE", help="a project with a motion")
    command.add_argument("--name", metavar="NAME", help="the motion, where there are several")
    command.add_argument("--contacts", action="store_true", help="list the contacts of each step")
    command.add_argument("--between", action="store_true", help="look between the steps, too: slower, misses nothing")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def motion(options: argparse.Namespace) -> int:
    """Print the first contact of a motion, and the contacts of its steps where they are asked for."""
    from ...model.proximity.moving.playing import play

    document = read_with_values(options)
    if not document.solids:
        raise Refusal("the document holds no solid")
    bar = Bar(document)
    try:
        played = play(
            document, options.name, options.tolerance,
            lambda done, total, label: bar.show(label, done / max(total, 1)), options.between,
        )  # fmt: skip
    finally:
        bar.end()
    status = told(options.file, played.messages, document)
    print(json.dumps(played.table(options.contacts), indent=2, ensure_ascii=False, allow_nan=False))
    return max(status, DONE)
