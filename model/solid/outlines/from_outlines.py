"""Solids of outlines, in their own axes: drawn up, and turned."""

from __future__ import annotations

import math

import numpy as np
from manifold3d import CrossSection, Manifold

from ...document.from_outlines import Extrude, Revolve, Wrap
from ...document.nodes import Node, range_fault
from ...document.outlines import CURVES, Lettering
from ...outline.paths import path_of
from ...path.path import Contour, Path
from ..failure import NoSolid
from ..leaves import fineness_of, segments_of
from ..tessellation import MAX_SEGMENTS, circle_segments
from .drawn import drawn_solid
from .rings import MOST_POINTS, check_size
from .sections import area_of, section_of
from .taper import tapered

STEEPEST = 89.0


@drawn_solid.register
def solid_of_extrude(node: Extrude, tolerance: float) -> Manifold:
    height, below = float(node.height), float(node.below)
    (outline,) = node.children
    if isinstance(outline, Lettering) and not (node.bevel or node.taper or node.twist or node.top_scale != 1.0):
        from .letters import extruded_letters

        letters = extruded_letters(outline, _fine(node, tolerance), height + below)
        if letters is not None:
            lift = -0.5 * (height + below) if node.centred else -below
            return (letters.translate((0.0, 0.0, lift)) if lift else letters).as_original()
    section = section_of(outline, _fine(node, tolerance))
    if section.is_empty():
        raise NoSolid("Extrusion: the outline encloses nothing")
    if node.bevel:
        solid = _bevelled(node, section, height, below)
        return solid.translate((0.0, 0.0, 0.5 * (below - height))) if node.centred else solid
    solid = _risen(node, section, height, 1.0, tolerance)
    if below > 0.0:
        if node.taper or node.twist or node.top_scale != 1.0:
            lower = _risen(node, section, below, -below / height, tolerance).mirror((0.0, 0.0, 1.0))
            solid = (solid + lower).as_original()
        else:
            solid = Manifold.extrude(section, height + below).translate((0.0, 0.0, -below))
    if node.centred:
        solid = solid.translate((0.0, 0.0, 0.5 * (below - height)))
    return solid.as_original()


def _bevelled(node: Extrude, section: CrossSection, height: float, below: float) -> Manifold:
    bevel = float(node.bevel)
    if node.taper or node.twist or node.top_scale != 1.0:
        raise NoSolid("Extrusion: a bevel goes with no taper, twist or top scale: set these to 0, 0 and 1")
    if bevel > height:
        raise NoSolid(f"Extrusion: a bevel of {bevel:g} mm is larger than the height, {height:g} mm")
    upright = height - bevel + below
    return tapered(section, bevel, 1.0, upright).translate((0.0, 0.0, -below)).as_original()


def _risen(node: Extrude, section: CrossSection, height: float, share: float, tolerance: float) -> Manifold:
    """The part above the outline, so high, with the `share` of the twist and of the change of scale that the node has.

    A negative share is for the part below, which is mirrored then: it turns the other way, and is scaled alike.
    """
    taper, twist, scale = float(node.taper), share * float(node.twist), float(node.top_scale)
    if taper:
        if twist or scale != 1.0:
            raise NoSolid("Extrusion: a taper goes with neither a twist nor a top scale: set these to 0 and 1")
        if abs(taper) > STEEPEST:
            raise NoSolid(f"Extrusion: the taper lies between -{STEEPEST:g}° and {STEEPEST:g}°, not at {taper:g}°")
        return tapered(section, height, math.tan(math.radians(taper)))
    scale = 1.0 + (scale - 1.0) * abs(share)
    if scale < 0.0:  # it has come to a point before
        height, twist, scale = height / (1.0 - scale), twist / (1.0 - scale), 0.0
    reach = float(np.abs(np.array(section.bounds())).max())
    divisions = 0
    if twist:
        divisions = math.ceil(abs(twist) / 360 * segments_of(node, max(reach, 1e-9), tolerance))
        if node.segments is None:
            # A wall of length L twisted by an angle a between two levels is L a / 4 away from its two triangles.
            longest = max(
                float(np.linalg.norm(np.roll(c, -1, axis=0) - c, axis=1).max()) for c in section.to_polygons()
            )
            levels = math.radians(abs(twist)) * longest / (4 * fineness_of(node, tolerance)[1])
            divisions = max(divisions, math.ceil(levels))
    divisions = min(divisions, MAX_SEGMENTS)
    _check_size(node, section, divisions + 2)
    return Manifold.extrude(section, height, divisions, twist, (scale, scale))


@drawn_solid.register
def solid_of_revolve(node: Revolve, tolerance: float) -> Manifold:
    section = _profile(node.children[0], _fine(node, tolerance))
    if section.is_empty():
        raise NoSolid("Revolution: the outline encloses nothing")
    reach = section.bounds()[2]
    if reach <= 0:
        raise NoSolid("Revolution: the outline lies at x < 0; only what is right of the y axis is turned")
    angle, start = min(float(node.angle), 360.0), float(node.start)
    segments = segments_of(node, reach, tolerance)
    _check_size(node, section, math.ceil(segments * angle / 360.0) + 1)
    solid = section.revolve(segments, angle)
    return solid.rotate((0.0, 0.0, start)).as_original() if start else solid


@drawn_solid.register
def solid_of_wrap(node: Wrap, tolerance: float) -> Manifold:
    fine = _fine(node, tolerance) / 2.0
    section = section_of(node.children[0], fine)
    if section.is_empty():
        raise NoSolid("Wrap: the outline encloses nothing")
    radius, height, below = float(node.radius), float(node.height), float(node.below)
    if below >= radius:
        raise NoSolid(f"Wrap: {below:g} mm below is through the axis of a cylinder of radius {radius:g} mm")
    if height + below <= 0.0:
        raise NoSolid("Wrap: height and below are both 0: it has no thickness")
    low, _, high, _ = section.bounds()
    if high - low > 2.0 * math.pi * radius:
        raise NoSolid(f"Wrap: the outline is {high - low:g} mm wide, which is more than once round")
    step = 2.0 * math.pi * radius / circle_segments(radius + height, fine)
    if 4.0 * section.area() / step**2 > MOST_POINTS:
        raise NoSolid(f"Wrap: a tolerance of {2.0 * fine:g} mm makes too many points of it; take a coarser one")
    flat = Manifold.extrude(section, height + below).refine_to_length(step)

    def bent(points: np.ndarray) -> np.ndarray:
        angle, reach = points[:, 0] / radius, radius - below + points[:, 2]
        return np.column_stack((reach * np.sin(angle), -reach * np.cos(angle), points[:, 1]))

    return flat.warp_batch(bent).as_original()


def _fine(node: Extrude | Revolve | Wrap, tolerance: float) -> float:
    """The tolerance of its outline: the node's own where it has one, also beside segments of its own."""
    return tolerance if node.tolerance is None else float(node.tolerance)


def _check_size(node: Extrude | Revolve, section: CrossSection, rings: int) -> None:
    try:
        check_size(rings, section.num_vert())
    except NoSolid as fault:
        raise NoSolid(f"{node.title}: {fault}") from None


def _profile(outline: Node, tolerance: float) -> CrossSection:
    """What an outline fills; an open curve is closed along the axis, as a profile that is turned is meant."""
    if not isinstance(outline, CURVES) or range_fault(outline):
        return section_of(outline, tolerance)
    path = path_of(outline)
    if all(contour.closed or contour.dimension != 2 for contour in path.contours):
        return section_of(outline, tolerance)
    contours = tuple(contour if contour.closed else _along_axis(contour) for contour in path.contours)
    return area_of(Path(contours, path.rule), tolerance)


def _along_axis(contour: Contour) -> Contour:
    """An open contour, closed by lines to the axis, along it, and back."""
    begin, end = contour.points[0], contour.points[-1]
    corners = np.array([end, (0.0, end[1]), (0.0, begin[1]), begin])
    sides = [side for side in np.stack((corners[:-1], corners[1:]), axis=1) if (side[0] != side[1]).any()]
    return Contour.of_segments([*contour.segments(), *sides], True)
