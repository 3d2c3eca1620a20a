"""`solidtree sight`: whether two points see each other, or how much of a part is seen from a point, as JSON."""

from __future__ import annotations

import argparse
import json
from typing import Any

from ...model.document.errors import Refusal
from ..command_line import TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values
from .ray import row_of
from .section import vector


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `sight`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("--from", type=vector, required=True, metavar="x,y,z", dest="start", help="the eye")
    what = command.add_mutually_exclusive_group(required=True)
    what.add_argument("--to", type=vector, metavar="x,y,z", dest="end", help="a point that is looked at")
    what.add_argument("--part", metavar="NAME", help="a solid or a node in one: how much of it is seen")
    what.add_argument("--face", type=vector, metavar="x,y,z", help="a point on a face: how much of that is seen")
    command.add_argument("--parallel", action="store_true", help="the eye is far away, in the direction --from")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def sight(options: argparse.Namespace) -> int:
    """Print the answer; that something hides what is looked at is one, too. The status is 1 where a solid failed."""
    from ...model.measuring.sight import Scenery

    if options.parallel and options.end is not None:
        raise Refusal("--parallel goes with --part or --face: two points see each other along the line between them")
    document = read_with_values(options)
    bar = Bar(document)
    try:
        scenery = Scenery(document, options.tolerance, progress=bar)
    finally:
        bar.end()
    status = told(options.file, scenery.messages, document)
    if options.end is not None:
        obstacle = scenery.obstacle(options.start, options.end)
        answer: dict[str, Any] = {"sees": obstacle is None, "obstacle": row_of(obstacle)}
    else:
        if options.part is not None:
            view = scenery.view_of(options.part, options.start, options.parallel)
        else:
            view = scenery.map_of(options.start, options.face, options.parallel)
        areas = [float(view.areas[view.state == state].sum()) for state in range(3)]
        answer = {
            "share": view.share,
            "error": view.error,
            "hiders": view.hiders,
            "words": view.words,
            "area": dict(zip(("seen", "hidden", "turned_away"), areas, strict=True)),
        }
    print(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
    return status
