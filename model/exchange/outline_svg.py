"""Outlines as SVG (Scalable Vector Graphics 1.1, W3C 2011): one path for each solid, one user unit for a millimetre."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from ..project.disk import one_line
from ..section.hatch import ANGLES, hatch
from .outlines_out import Fill, NamedOutline

STROKE = 0.35  # mm, a visible edge (ISO 128); hatching has half of it
MARGIN = 1.0  # mm around all
LINE, GROUND = "#1d242d", "#c8d2dd"


def svg_of(
    outlines: Sequence[NamedOutline], fill: Fill = "none", stroke: str | None = LINE, spacing: float = 2.0
) -> str:
    """The drawing's text, v upwards, with holes left open.

    `fill` fills the cut areas with nothing, with the solid's colour, or with lines `spacing` mm apart, at another angle
    for each solid; `stroke` is the colour of the contours, None for none.
    """
    boxes = [box for named in outlines if (box := named.outline.bounds) is not None]
    low = np.min([box[0] for box in boxes], axis=0) - MARGIN if boxes else np.zeros(2)
    high = np.max([box[1] for box in boxes], axis=0) + MARGIN if boxes else np.ones(2)
    line = "none" if stroke is None else stroke
    body = []
    for number, named in enumerate(outlines):
        ground = (named.colour or GROUND) if fill == "colour" else "none"
        body.append(f'  <g fill="{ground}" stroke="{line}">')
        body.append(f"    <title>{escape(one_line(named.name))}</title>")
        if fill == "hatch":
            pieces = hatch(named.outline, spacing, ANGLES[number % len(ANGLES)])
            data = "".join(_path(piece, False) for piece in pieces)
            body.append(f'    <path class="hatch" stroke="{LINE}" stroke-width="{STROKE / 2}" d="{data}"/>')
        data = "".join(_path(contour) for contour in named.outline.contours)
        body.append(f'    <path class="outline" fill-rule="evenodd" d="{data}"/>')
        body.append("  </g>")
    return page_of(body, low, high)


def page_of(body: Sequence[str], low: NDArray[np.float64], high: NDArray[np.float64]) -> str:
    """The text of a file whose page reaches from (2,) `low` to `high`, mm, v upwards."""
    width, height = (high - low).tolist()
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{_text(width)}mm" height="{_text(height)}mm"',
            f'     viewBox="{_text(low[0])} {_text(-high[1])} {_text(width)} {_text(height)}" stroke-width="{STROKE}" '
            'stroke-linejoin="round">',
            *body,
            "</svg>",
            "",
        ]
    )


def _path(points: NDArray[np.float64], closed: bool = True) -> str:
    """SVG's y goes down, so v is negated here rather than by a transformation that some programs forget."""
    corners = (f"{_text(u)},{_text(-v)}" for u, v in points)
    return "M" + "L".join(corners) + ("Z" if closed else "")


def _text(value: float) -> str:
    return f"{round(float(value), 9) + 0.0:.12g}"
