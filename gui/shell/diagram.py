"""`solidtree diagram`: the tree as the textbook draws it, as SVG."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..command_line import DONE, complain, read


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `diagram`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT.svg")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all")


def diagram(options: argparse.Namespace) -> int:
    """Write the diagram of the document's trees. Raises Refusal."""
    from ...render.drawing import csg_diagram

    out = Path(options.out)
    if out.suffix.lower() != ".svg":
        return complain(out, "a diagram is written as SVG; let the name end in .svg")
    csg_diagram.diagram(read(options.file), out, options.solid)
    return DONE
