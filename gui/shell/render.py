"""`solidtree render`: a picture of a document."""

from __future__ import annotations

import argparse
import re
from typing import TYPE_CHECKING

from ...model.document.colours import hex_colour, rgb
from ...model.document.document import Document, Section
from ...model.document.errors import Refusal
from ...model.operations.sections import MOST_ACTIVE
from ...model.surface.appearance import appearances, is_dressed
from ...model.surface.faults import bitmap_faults
from ...model.surface.light import lights_of
from ...model.surface.material import SHADINGS
from ..command_line import NOT_IN_ORDER, TOLERANCE, Bar, complain, positive, warn
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...model.document.nodes import Node
    from ...model.solid.display import DisplayMesh
    from ...render.camera import Camera
    from ...render.look import Paint

VIEWS = ("iso", "front", "back", "left", "right", "top", "bottom")


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `render`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT.png")
    command.add_argument(
        "--size", type=picture_size, default=(1200, 800), metavar="WxH", help="in pixels, default 1200x800"
    )
    add_view_options(command)
    command.add_argument("--hidden-surface", choices=("zbuffer", "bsp"), default="zbuffer", help="default zbuffer")
    command.add_argument("--style", choices=("shaded", "edges", "wireframe", "hidden-line"), default="shaded")
    command.add_argument("--shading", choices=SHADINGS, help="default that of the document, else phong")
    command.add_argument(
        "--compare-shadings",
        action="store_true",
        help="flat, Gouraud, Phong, and Phong with bumps side by side; prints by how much they differ",
    )
    command.add_argument("--opacity", type=_share, default=1.0, metavar="A", help="from 0 to 1")
    command.add_argument(
        "--colours",
        choices=("own", "nodes"),
        default="own",
        help="the nodes' own colours, or one for each node on the faces that it made",
    )
    command.add_argument("--background", metavar="COLOUR", help="#rrggbb, a name, or transparent")
    command.add_argument(
        "--section",
        type=_section,
        action="append",
        default=[],
        metavar="x,y,z:nx,ny,nz",
        help="open the solids by the plane through a point: what its direction points to stays; may come repeatedly",
    )
    command.add_argument("--sections", action="store_true", help="open the solids by the document's own sections")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)
    command.add_argument(
        "--ids",
        nargs="?",
        const="solids",
        choices=("solids", "faces"),
        help="no light, no smoothing: each solid, or each face, in the 24-bit colour of its number, from 1",
    )


def add_view_options(command: argparse.ArgumentParser, angle: str = "full vertical angle, default 30") -> None:
    """From where, and how projected; `angle` tells of the perspective's."""
    command.add_argument("--view", choices=VIEWS, default=None, help="default iso")
    for name, what in (
        ("eye", "where the eye is"),
        ("target", "what it looks at"),
        ("up", "what is up in the picture"),
    ):
        command.add_argument(f"--{name}", type=_point, metavar="x,y,z", help=what)
    projection = command.add_mutually_exclusive_group()
    projection.add_argument("--parallel", action="store_true", help="parallel projection")
    projection.add_argument("--perspective", type=_angle, metavar="ANGLE", help=angle)


def picture_size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    size = (int(found[1]), int(found[2])) if found else (0, 0)
    if not all(1 <= side <= 16384 for side in size):
        raise argparse.ArgumentTypeError(f"{text!r} is no size such as 1200x800, at most 16384 a side")
    return size


def _point(text: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no point such as 10,-20,5") from None
    if not all(abs(value) < float("inf") for value in (x, y, z)):
        raise argparse.ArgumentTypeError(f"{text!r} is no point such as 10,-20,5")
    return x, y, z


def _section(text: str) -> Section:
    point, colon, normal = text.partition(":")
    try:
        return Section("--section", _point(point), _point(normal if colon else ""))
    except (argparse.ArgumentTypeError, Refusal):
        message = f"{text!r} is no point with a direction such as 0,0,5:0,0,-1"
        raise argparse.ArgumentTypeError(message) from None


def _share(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number from 0 to 1")
    return value


def _angle(text: str) -> float:
    value = positive(text)
    if value >= 180:
        raise argparse.ArgumentTypeError(f"{text!r} is not an angle below 180")
    return value


def render(options: argparse.Namespace) -> int:
    """Evaluate and draw; the status is 1 where something failed or nothing is to be seen."""
    if not options.out.lower().endswith(".png"):
        raise SystemExit(complain(options.out, "a picture is written as PNG: let the name end in .png"))
    background = options.background
    if background is not None and background != "transparent":
        background = tuple(value / 255 for value in rgb(hex_colour(background)))
    document = read_with_values(options)
    sections = [*options.section, *(s for s in document.sections if options.sections and s.active)]
    if sections and options.ids is not None:
        raise Refusal("--ids numbers whole solids: leave the sections out")
    if options.compare_shadings and (options.ids is not None or sections or options.hidden_surface == "bsp"):
        raise Refusal("--compare-shadings goes with neither --ids, sections nor --hidden-surface bsp")
    if len(sections) > MOST_ACTIVE:
        raise Refusal(f"at most {MOST_ACTIVE} sections open a picture at once, not {len(sections)}")
    bar = Bar(document)
    try:
        from ...model.solid.outlines.sheet import sheet_of
        from ...model.solid.results import evaluate_document

        evaluation = evaluate_document(document, options.tolerance, progress=bar)
    finally:
        bar.end()
    results = (*evaluation.visible, *(result for result in evaluation.profiles if result.root.visible))
    messages = [message for result in results for message in result.messages]
    status = told(options.file, [*messages, *bitmap_faults(document)], document)
    shown = [(result.root, mesh) for result in evaluation.visible if (mesh := evaluation.display(result)) is not None]
    whole = len(shown) == len(evaluation.visible)
    if options.ids is None:  # which numbers solids
        outlines = [result for result in evaluation.profiles if result.root.visible]
        sheets = [(result.root, sheet_of(result.root, options.tolerance)) for result in outlines if result.path]
        shown, whole = shown + sheets, whole and len(sheets) == len(outlines)
    meshes = [mesh for _, mesh in shown]

    from ...render import picture

    view, perspective = camera_wanted(options, meshes)
    if options.compare_shadings:
        pixels = _compared(options, document, [(r, m) for r, m in shown if not m.sheet], view, perspective)
    elif options.ids is not None:
        numbers = picture.facet_numbers(meshes) if options.ids == "faces" else None
        pixels = picture.ids_picture(meshes, options.size, view, numbers=numbers, perspective=perspective,
                                     hidden_surface=options.hidden_surface)  # fmt: skip
    else:
        pixels = picture.picture(
            [(mesh, _paint(document, root, mesh, options.colours == "nodes")) for root, mesh in shown],
            options.size,
            view,
            style=options.style,
            shading=options.shading or document.shading or "phong",
            opacity=options.opacity,
            background=background,
            perspective=perspective,
            sections=sections,
            hidden_surface=options.hidden_surface,
            lights=lights_of(document.lights),
        )
    try:
        picture.write_png(options.out, pixels)
    except OSError as error:
        from ...model.project.disk import reason_of

        raise SystemExit(complain(options.out, reason_of(error))) from None
    for section in sections:
        if meshes and not any(_leaves(section, mesh) for mesh in meshes):
            warn(options.file, f"the section at {_numbers(section)} leaves nothing")
            return NOT_IN_ORDER
    if not any(len(mesh.triangles) for mesh in meshes):
        warn(options.file, "there is nothing to be seen")
        return NOT_IN_ORDER
    return status if whole else NOT_IN_ORDER


def _compared(
    options: argparse.Namespace,
    document: Document,
    solids: list[tuple[Node, DisplayMesh]],
    view: Camera | str,
    perspective: float | None,
) -> NDArray[np.uint8]:
    """The columns of a comparison in one picture; what they differ by is printed."""
    from itertools import pairwise

    import numpy as np

    from ...render.camera import Camera
    from ...render.look import LIGHT
    from ...render.surfaces.comparison import SHADINGS as COLUMNS
    from ...render.surfaces.comparison import Comparison, columns_of, difference
    from ...render.views import camera_of

    width, height = max(options.size[0] // len(COLUMNS), 1), options.size[1]
    comparison = Comparison(LIGHT)
    try:
        comparison.show(columns_of(document, solids), lights_of(document.lights))
        if not isinstance(view, Camera):
            view = camera_of(comparison.bounds(), width / height, view, perspective=perspective)
        pictures = comparison.draw(view, (width, height))
    finally:
        comparison.close()
    for (one, other), names in zip(pairwise(pictures), pairwise(COLUMNS), strict=True):
        found = difference(one, other)
        share = f"more than 2 on {100.0 * found.share():.1f} % of the picture"
        print(f"{names[0]} and {names[1]}: up to {found.greatest} grey levels, {share}")
    return np.hstack(pictures)


def _leaves(section: Section, mesh: DisplayMesh) -> bool:
    """Whether a part of the mesh lies on the side that the section keeps."""
    return bool(((mesh.points - section.point) @ section.normal > 0.0).any())


def _numbers(section: Section) -> str:
    return ":".join(",".join(f"{value:g}" for value in values) for values in (section.point, section.normal))


def _paint(document: Document, root: Node, mesh: DisplayMesh, by_node: bool) -> Paint:
    from ...model.document.distinct_colours import distinct_colour
    from ...model.solid.provenance import occurrences
    from ...render.look import Paint

    found = occurrences(root)
    if by_node:
        return Paint(None, tuple(distinct_colour(occurrence.leaf.id) for occurrence in found))
    if not mesh.sheet and is_dressed(document, root):
        looks = appearances(document, root, mesh.owners)
        return Paint(root.colour, tuple(look.colour for look in looks), looks)
    return Paint(root.colour, tuple(occurrence.colour for occurrence in found))


def camera_wanted(options: argparse.Namespace, meshes: list) -> tuple[Camera | str, float | None]:
    """A camera where the eye is given, else a view's name; and the angle, None for parallel projection."""
    perspective = None if options.parallel else options.perspective or 30.0
    if options.eye is None:
        if options.target is not None or options.up is not None:
            raise Refusal("--target and --up need --eye")
        return options.view or "iso", perspective
    if options.view is not None:
        raise Refusal("--view and --eye exclude each other")
    import numpy as np

    from ...render.views import camera_of

    bounds = [mesh.bounds for mesh in meshes if len(mesh.triangles)]
    box = np.array([np.min([b[0] for b in bounds], axis=0), np.max([b[1] for b in bounds], axis=0)]) if bounds else None
    try:
        camera = camera_of(
            box,
            options.size[0] / options.size[1],
            eye=options.eye,
            target=options.target,
            up=options.up,
            perspective=perspective,
        )
    except ValueError as error:
        raise Refusal(str(error)) from None
    return camera, perspective
