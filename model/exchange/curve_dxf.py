"""Outlines as DXF (AutoCAD 2010) by ezdxf: what is straight as polylines, curves as splines, circles as circles."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..document.colours import rgb
from ..path.path import Contour, Kind
from ..spline.bspline import BSpline
from ..spline.knots import clamped, clamped_knots
from .curves_out import NamedCurves, circle_of
from .outline_dxf import layer_name


def dxf_of(outlines: Sequence[NamedCurves]) -> str:
    """The file's text: a layer for each outline, in millimetres; a Bezier curve is a spline without inner knots."""
    from ezdxf.enums import InsertUnits
    from ezdxf.filemanagement import new

    drawing = new("R2010", units=InsertUnits.Millimeters)
    drawing.header["$MEASUREMENT"] = 1
    space = drawing.modelspace()
    taken: set[str] = {"0", "DEFPOINTS"}  # layers' names are compared without regard to case
    for outline in outlines:
        name = layer_name(outline.name, taken)
        taken.add(name.upper())
        layer = drawing.layers.add(name)
        if outline.colour is not None:
            layer.rgb = rgb(outline.colour)
        for contour in outline.path.contours:
            _add(space, contour, {"layer": name})
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


def _add(space: Any, contour: Contour, attributes: dict[str, Any]) -> None:
    if (contour.kinds == Kind.LINE).all():
        points = contour.points[: len(contour.points) - contour.closed]
        space.add_lwpolyline(points.tolist(), close=contour.closed, dxfattribs=attributes)
        return
    circle = circle_of(contour)
    if circle is not None:
        space.add_circle(circle[0].tolist(), circle[1], dxfattribs=attributes)
        return
    for segment in contour.segments():
        if not isinstance(segment, np.ndarray):
            _add_spline(space, clamped(segment), attributes)
        elif len(segment) == 2:
            space.add_line(*segment.tolist(), dxfattribs=attributes)
        else:
            degree = len(segment) - 1
            _add_spline(space, BSpline(segment, degree, clamped_knots(degree + 1, degree)), attributes)


def _add_spline(space: Any, spline: BSpline, attributes: dict[str, Any]) -> None:
    entity = space.add_spline(degree=spline.degree, dxfattribs=attributes)
    entity.control_points = [(*point, 0.0) for point in spline.points.tolist()]
    entity.knots = spline.knots.tolist()
    if spline.weights is not None:
        entity.weights = spline.weights.tolist()
