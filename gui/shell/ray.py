"""`solidtree ray`: the first face on a ray, or whether two points see each other."""

from __future__ import annotations

import argparse
import json
from typing import TYPE_CHECKING, Any

from ...model.document.errors import Refusal
from ..command_line import TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values
from .section import vector

if TYPE_CHECKING:
    from ...model.measuring.sight import NodeHit


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `ray`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("--origin", type=vector, metavar="x,y,z", help="where the ray begins; needs --direction")
    command.add_argument("--direction", type=vector, metavar="x,y,z", help="of any length")
    command.add_argument("--from", type=vector, metavar="x,y,z", dest="start", help="a point; needs --to")
    command.add_argument("--to", type=vector, metavar="x,y,z", dest="end", help="whether the first point sees this one")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def ray(options: argparse.Namespace) -> int:
    """Tell what was met, a miss is an answer, too; the status is 1 where a solid failed."""
    from ...model.measuring.sight import Scenery

    along, between = (options.origin, options.direction), (options.start, options.end)
    if (None in along and None in between) or any(p is not None for p in along) == any(p is not None for p in between):
        raise Refusal("give --origin and --direction for a ray, or --from and --to for a line of sight")
    document = read_with_values(options)
    bar = Bar(document)
    try:
        scenery = Scenery(document, options.tolerance, options.solid, bar)
    finally:
        bar.end()
    status = told(options.file, scenery.messages, document)
    if options.origin is not None:
        answer: dict[str, Any] = {"hit": row_of(scenery.first_hit(*along))}
    else:
        obstacle = scenery.obstacle(*between)
        answer = {"sees": obstacle is None, "obstacle": row_of(obstacle)}
    print(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
    return status


def row_of(hit: NodeHit | None) -> dict[str, Any] | None:
    """A hit for JSON."""
    if hit is None:
        return None
    return {
        "distance": hit.distance,
        "point": list(hit.point),
        "normal": list(hit.normal),
        "front": hit.front,
        "node": hit.name,
        "solid": hit.solid,
        "path": list(hit.path),
    }
