"""Outlines into drawings that keep their curves: SVG and DXF, in millimetres."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..curve.bezier import evaluated
from ..document.document import Document
from ..document.errors import Refusal
from ..document.placement import Placement
from ..document.resolve import resolve
from ..outline import paths
from ..path.path import Contour, Floats
from ..path.path import Path as Curves
from ..project.disk import replace_file
from ..solid.tessellation import DEFAULT_TOLERANCE
from ..spline.decomposition import decomposed


@dataclass(frozen=True, slots=True, eq=False)
class NamedCurves:
    """An outline in the plane, with its name and its colour (#rrggbb or None)."""

    name: str
    colour: str | None
    path: Curves


def _svg(stream: BinaryIO, outlines: Sequence[NamedCurves], tolerance: float) -> None:
    from .curve_svg import svg_of

    stream.write(svg_of(outlines, tolerance).encode())


def _dxf(stream: BinaryIO, outlines: Sequence[NamedCurves], tolerance: float) -> None:
    from .curve_dxf import dxf_of

    stream.write(dxf_of(outlines).encode())


WRITERS: dict[str, Callable[[BinaryIO, Sequence[NamedCurves], float], None]] = {"svg": _svg, "dxf": _dxf}
"""By ending."""


def is_drawing_ending(path: str | os.PathLike[str]) -> bool:
    """Whether the path's ending names a drawing of outlines."""
    return Path(path).suffix.lower().removeprefix(".") in WRITERS


def outlines_to_write(document: Document, name: str | None = None) -> list[NamedCurves]:
    """The visible profiles of a document, or the one called `name`, each in the plane.

    One that leaves the plane z = 0 is written in its own plane. Raises Refusal where there is none, or where one fails.
    """
    roots = [root for root in resolve(document).profiles if (root.visible if name is None else root.name == name)]
    if not roots:
        known = ", ".join(f"“{root.name}”" for root in document.profiles)
        if name is not None:
            raise Refusal(f"there is no outline called “{name}”; there is {known or 'none at all'}")
        raise Refusal(
            "the document holds no visible outline; of solids a section or a drawing can be written to SVG and DXF"
            if document.solids
            else "the document holds no visible outline"
        )
    found = []
    for root in roots:
        try:
            path = paths.path_of(root)
            if path.contours and path.contours[0].dimension == 3:
                path = paths.path_of(root.with_(placement=Placement()))
        except Refusal as refusal:
            raise Refusal(f"“{root.label}”: {refusal}") from None
        if any(contour.dimension == 3 for contour in path.contours):
            raise Refusal(f"“{root.label}” does not lie in a plane, so that it cannot be drawn flat")
        if path.contours:
            found.append(NamedCurves(root.name, root.colour, path))
    if not found:
        raise Refusal("there is nothing to write: every outline is empty")
    return found


def write_curves(
    path: str | os.PathLike[str], outlines: Sequence[NamedCurves], tolerance: float = DEFAULT_TOLERANCE
) -> None:
    """Write outlines in the format of the path's ending, wholly or not at all. Raises Refusal.

    Lines and Bezier curves stay what they are, B-splines too in DXF; SVG gets those of degree 3 and less as the Bezier
    curves that they are, and the others as cubics within `tolerance` mm.
    """
    writer = WRITERS[Path(path).suffix.lower().removeprefix(".")]
    replace_file(path, lambda stream: writer(stream, outlines, tolerance))


def bounds(outlines: Sequence[NamedCurves]) -> np.ndarray:
    """(2, 2) lowest and highest coordinates of all."""
    boxes = np.array([outline.path.bounds() for outline in outlines])
    return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def circle_of(contour: Contour) -> tuple[Floats, float] | None:
    """(centre (2,), radius) of a closed contour that is a whole circle, exactly: a rational quadratic B-spline."""
    spline = contour.splines[0] if len(contour) == 1 and contour.splines else None
    if spline is None or not contour.closed or spline.weights is None or spline.degree != 2:
        return None
    pieces = decomposed(spline)
    if len(pieces.controls) < 3 or pieces.weights is None:
        return None
    corners = pieces.controls[:, 0]
    centre = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    seen = evaluated(pieces.controls, np.linspace(0.0, 1.0, 5), pieces.weights).reshape(-1, 2)
    radii = np.linalg.norm(seen - centre, axis=1)
    radius = float(radii.mean())
    round_ = bool(np.abs(radii - radius).max() <= 1e-12 * radius)
    around = np.linalg.norm(np.diff(corners, axis=0, append=corners[:1]), axis=1).sum()
    return (centre, radius) if round_ and around > 4.0 * radius else None
