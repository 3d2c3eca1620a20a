"""`solidtree info`: measurements as JSON."""

from __future__ import annotations

import argparse
import json

from ..command_line import DONE, NOT_IN_ORDER, TOLERANCE, Bar, positive
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `info`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    command.add_argument("--nodes", action="store_true", help="measure every node of the trees by itself, too")
    command.add_argument("--walls", action="store_true", help="estimate the least wall of each solid by 2,000 rays")
    add_parameter_options(command)


def info(options: argparse.Namespace) -> int:
    """Print the measures; the status is 1 where a solid has none."""
    from ...model.solid.information import information

    document = read_with_values(options)
    bar = Bar(document)
    try:
        answer, in_order = information(document, options.tolerance, bar, options.nodes, options.walls)
    finally:
        bar.end()
    print(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
    return DONE if in_order else NOT_IN_ORDER
