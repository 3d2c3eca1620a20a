"""Outlines as DXF (AutoCAD 2010) by ezdxf: closed polylines, a layer for each solid, in millimetres."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence

from ..document.colours import rgb
from ..document.tree import unique_name
from ..project.disk import one_line
from .outlines_out import NamedOutline


def dxf_of(outlines: Sequence[NamedOutline]) -> str:
    """The file's text. Contours are LWPOLYLINEs in the x-y plane, holes clockwise."""
    from ezdxf.enums import InsertUnits
    from ezdxf.filemanagement import new

    drawing = new("R2010", units=InsertUnits.Millimeters)
    drawing.header["$MEASUREMENT"] = 1
    space = drawing.modelspace()
    taken: set[str] = {"0", "DEFPOINTS"}  # layers' names are compared without regard to case
    for named in outlines:
        name = layer_name(named.name, taken)
        taken.add(name.upper())
        layer = drawing.layers.add(name)
        if named.colour is not None:
            layer.rgb = rgb(named.colour)
        for contour in named.outline.contours:
            space.add_lwpolyline(contour.tolist(), close=True, dxfattribs={"layer": name})
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


def layer_name(name: str, taken: set[str]) -> str:
    """The solid's name without what layers' names may not hold, unlike all that are taken."""
    wanted = re.sub(r'[<>/\\":;?*|=`,\']', "_", one_line(name)).strip()[:200] or "Section"
    if wanted.upper() not in taken:
        return wanted
    return unique_name(wanted.upper(), taken)
