"""The options that give a document's parameters other values, and `solidtree sets`."""

from __future__ import annotations

import argparse

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ..command_line import DONE, complain, read, warn


def add_options(command: argparse.ArgumentParser) -> None:
    """`--sets`, `--set` and `--parameter`, for commands that evaluate a document."""
    command.add_argument("--set", metavar="NAME", help="with this saved set of parameter values")
    command.add_argument("--sets", metavar="SETS.json", help="take the sets from this file, .json (OpenSCAD's) or .csv")
    command.add_argument(
        "--parameter",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="with another value of a parameter; repeatable, and stronger than --set",
    )


def read_with_values(options: argparse.Namespace) -> Document:
    """The document in the command's file, with the values that the options ask for. Raises Refusal."""
    from ...model.operations.parameter_sets import apply_set, find_set, unknown_in_set, with_texts

    document = read(options.file)
    if options.sets is not None:
        document = _with_file(document, options.sets, options.file)
    if options.set is not None:
        for name in unknown_in_set(document, find_set(document, options.set)):
            warn(options.file, f"the set “{options.set}”: {name} is no parameter of the document and is left out")
        document = apply_set(document, options.set)
    return with_texts(document, options.parameter)


def _with_file(document: Document, path: str, file: str) -> Document:
    from ...model.exchange.set_files import read_sets
    from ...model.operations.parameter_sets import fitting_sets, put_sets

    try:
        sets, left_out = fitting_sets(document, read_sets(path))
    except Refusal as refusal:
        raise Refusal(f"{path}: {refusal}") from None
    if left_out:
        warn(path, f"{', '.join(left_out)}: no such parameter in {file}; left out")
    return put_sets(document, [(one.name, one.values) for one in sets])


def add_sets_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="a project")
    command.add_argument("out", metavar="OUT", nargs="?", help="a file to write, .json (OpenSCAD's) or .csv")


def sets(options: argparse.Namespace) -> int:
    """Print the saved sets of parameter values, or write them to a file."""
    from ...model.exchange.set_files import json_of_sets, write_sets

    document = read(options.file)
    if options.out is None:
        print(json_of_sets(document.sets), end="")
        return DONE
    try:
        write_sets(options.out, document.sets)
    except Refusal as refusal:
        return complain(options.out, str(refusal))
    return DONE
