"""`solidtree section`: the outlines in which a plane cuts the solids, as a drawing and as figures."""

from __future__ import annotations

import argparse
import json
import math
from typing import TYPE_CHECKING, Any

from ...model.document.errors import Refusal
from ..command_line import NOT_IN_ORDER, TOLERANCE, Bar, naming, positive, warn
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values

if TYPE_CHECKING:
    from ...model.section.section import SectionOutline

TOWARDS = {"x": (1.0, 0.0, 0.0), "y": (0.0, -1.0, 0.0), "z": (0.0, 0.0, 1.0)}
"""Where the viewer of a standard plane is: on the right, in front, above."""


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `section`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT.svg|.dxf", help="in millimetres; default: the figures alone", nargs="?")
    where = command.add_mutually_exclusive_group(required=True)
    where.add_argument(
        "--plane",
        type=_plane,
        metavar="AXIS=MM",
        help="x=MM as seen from the right, y=MM from the front, z=MM from above",
    )
    where.add_argument("--point", type=vector, metavar="x,y,z", help="a point of the plane; needs --normal")
    where.add_argument("--name", metavar="SECTION", help="a section of the document, seen from its open side")
    command.add_argument("--normal", type=vector, metavar="x,y,z", help="towards the viewer")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--fill", choices=("none", "colour", "hatch"), default="none", help="of an SVG's cut areas")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def section(options: argparse.Namespace) -> int:
    """Cut, write and tell; the status is 1 where the plane meets nothing or a solid failed."""
    from ...model.exchange.outlines_out import check_outline_ending, write_outlines
    from ...model.operations.sections import find_section
    from ...model.section.solid_sections import document_sections, facing, named_outlines

    if (options.point is None) != (options.normal is None):
        raise Refusal("--point and --normal need each other")
    if options.out is not None:
        naming(options.out, lambda: check_outline_ending(options.out))
    document = read_with_values(options)
    if options.name is not None:
        point, normal = facing(find_section(document, options.name))
    elif options.point is not None:
        point, normal = options.point, options.normal
    else:
        point, normal = options.plane
    bar = Bar(document)
    try:
        found, messages = document_sections(document, point, normal, options.tolerance, options.solid, bar)
    finally:
        bar.end()
    status = told(options.file, messages, document)
    met = [one for one in found if len(one.outline.points)]
    if options.out is not None and met:
        naming(options.out, lambda: write_outlines(options.out, named_outlines(found), options.fill))
    elif not met:
        warn(options.file, "the plane meets no solid" + ("; nothing was written" if options.out else ""))
    figures = [{"name": one.name, **figures_of(one.outline)} for one in found]
    total = {key: sum(row[key] for row in figures) for key in ("area", "perimeter", "contours")}
    print(json.dumps({"solids": figures, "total": total}, indent=2, ensure_ascii=False, allow_nan=False))
    return status if met else NOT_IN_ORDER


def figures_of(outline: SectionOutline) -> dict[str, Any]:
    """mm and mm², in the plane's coordinates."""
    box = outline.bounds
    return {
        "area": outline.area,
        "perimeter": outline.perimeter,
        "contours": len(outline.contours),
        "bounds": None if box is None else box.tolist(),
        "centroid": outline.centroid,
    }


def _plane(text: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
    axis, _, value = text.partition("=")
    try:
        place = float(value)
    except ValueError:
        place = math.nan
    if axis not in TOWARDS or not math.isfinite(place):
        raise argparse.ArgumentTypeError(f"{text!r} is no plane such as z=5")
    return tuple(place if name == axis else 0.0 for name in TOWARDS), TOWARDS[axis]


def vector(text: str) -> tuple[float, ...]:
    """Three numbers, for options."""
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        x = y = z = math.nan
    if not all(math.isfinite(value) for value in (x, y, z)):
        raise argparse.ArgumentTypeError(f"{text!r} is not three numbers such as 10,-20,5")
    return x, y, z
