"""Outlines as SVG (Scalable Vector Graphics 1.1, W3C 2011): one path each, one user unit for a millimetre, y turned."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from ..path.editing import convert
from ..path.path import Contour, Kind, Path
from ..project.disk import one_line
from .curves_out import NamedCurves, bounds, circle_of
from .outline_svg import LINE, MARGIN, page_of

_WORDS = {Kind.LINE: "L", Kind.QUADRATIC: "Q", Kind.CUBIC: "C"}


def svg_of(outlines: Sequence[NamedCurves], tolerance: float) -> str:
    """The drawing's text. Closed outlines that have a colour are filled with it, the others are lines."""
    low, high = bounds(outlines)
    low, high = low - MARGIN, high + MARGIN
    body, taken = [], set()
    for outline in outlines:
        path = Path(tuple(_plain(contour, tolerance) for contour in outline.path.contours), outline.path.rule)
        closed = all(contour.closed for contour in path.contours)
        fill = outline.colour if closed and outline.colour else "none"
        stroke = LINE if fill == "none" and outline.colour is None else outline.colour
        rule = "evenodd" if path.rule == "evenodd" else "nonzero"
        body += [
            f'  <path id={quoteattr(_identifier(outline.name, taken))} fill="{fill}" fill-rule="{rule}" '
            f'stroke="{stroke}" d="{path_data(path)}">',
            f"    <title>{escape(one_line(outline.name))}</title>",
            "  </path>",
        ]
    return page_of(body, low, high)


def path_data(path: Path) -> str:
    """The `d` of an SVG path, y downwards, of a path of lines, quadratics, cubics and whole circles."""
    parts: list[str] = []
    for contour in path.contours:
        circle = circle_of(contour)
        if circle is not None:
            (x, y), radius = circle
            west, east = _pair([x - radius, -y]), _pair([x + radius, -y])
            arc = f"A{_text(radius)} {_text(radius)} 0 0 0 "
            parts.append(f"M{east}{arc}{west}{arc}{east}Z")
            continue
        points = (contour.points * (1.0, -1.0)).tolist()
        parts.append(f"M{_pair(points[0])}")
        at = 1
        last = len(contour) - 1
        for number, kind in enumerate(contour.kinds.tolist()):
            row = points[at : at + kind]
            at += kind
            if contour.closed and number == last and kind == Kind.LINE:
                break  # Z draws it
            parts.append(_WORDS[Kind(kind)] + " ".join(map(_pair, row)))
        if contour.closed:
            parts.append("Z")
    return "".join(parts)


def _plain(contour: Contour, tolerance: float) -> Contour:
    """Without B-splines, but for one that is a circle."""
    while (contour.kinds == Kind.SPLINE).any() and circle_of(contour) is None:
        contour, _ = convert(contour, int(np.argmax(contour.kinds == Kind.SPLINE)), Kind.CUBIC, tolerance)
    return contour


def _identifier(name: str, taken: set[str]) -> str:
    """A name as XML's ids are, unlike those that are taken."""
    wanted = re.sub(r"[^\w.-]+", "_", one_line(name)).strip("_") or "outline"
    wanted = wanted if wanted[0].isalpha() else f"_{wanted}"
    found, number = wanted, 2
    while found in taken:
        found, number = f"{wanted}_{number}", number + 1
    taken.add(found)
    return found


def _pair(point: list[float]) -> str:
    return f"{_text(point[0])},{_text(point[1])}"


def _text(value: float) -> str:
    return f"{round(float(value), 12) + 0.0:.15g}"
