"""Outlines as the areas that they fill, flattened within a tolerance."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, FillRule
from numpy.typing import NDArray

from ...document.errors import Refusal
from ...document.nodes import Broken, Difference, Intersection, LinearArray, Mirror, Node, PolarArray, range_fault
from ...document.outlines import Circle, Lettering, Stencil, TextOnPath
from ...outline.paths import own_path
from ...outline.stencil import stencilled
from ...path.flatten import flatten
from ...path.path import Path
from ..copies import copies
from ..failure import NoSolid
from ..maps import placed_tolerance
from ..tessellation import MAX_SEGMENTS, circle_segments

MOST_POINTS = 300_000
"""Of an outline; a solid of more would fill the memory."""
FARTHEST = 1e10
"""mm; manifold3d reckons outlines in whole multiples of 1e-8 mm, of which 64 bits hold twice as far."""
FILL = {"nonzero": FillRule.NonZero, "evenodd": FillRule.EvenOdd}


def section_of(node: Node, tolerance: float) -> CrossSection:
    """What a resolved outline fills in its plane, placed by its own placement, within `tolerance` mm.

    Raises NoSolid, and Refusal for numbers that make no curve.
    """
    made: list[CrossSection] = []
    stack: list[tuple[Node, float, bool]] = [(node, placed_tolerance(tolerance, node.placement), False)]
    while stack:
        here, fine, ready = stack.pop()
        children = () if isinstance(here, TextOnPath) else here.children  # of which one may be open
        if not ready:
            stack.append((here, fine, True))
            stack += [(child, placed_tolerance(fine, child.placement), False) for child in reversed(children)]
            continue
        fault = here.message if isinstance(here, Broken) else range_fault(here)
        if fault:
            raise NoSolid(fault)
        size = len(children)
        below = made[len(made) - size :]
        del made[len(made) - size :]
        made.append(_placed(_joined(here, below) if size else _own(here, fine), here))
    return made[0]


def area_of(path: Path, tolerance: float) -> CrossSection:
    """What a path in the plane fills. Raises NoSolid for one that is open, leaves the plane, or is too large or too
    fine."""
    for contour in path.contours:
        if contour.dimension != 2:
            raise NoSolid("the curve leaves its plane; only a flat outline has an inside")
        if not contour.closed:
            place = ", ".join(f"{number:g}" for number in contour.points[-1])
            raise NoSolid(f"the curve is open, it ends at ({place}): close it to give it an inside")
    try:
        rings = flatten(path, tolerance, MOST_POINTS)
    except Refusal as fault:
        raise NoSolid(str(fault)) from None
    return _filled(rings, path.rule)


def _filled(rings: list[NDArray[np.float64]], rule: str) -> CrossSection:
    _check_near(max((float(np.abs(points).max()) for points in rings if len(points)), default=0.0))
    return CrossSection([np.ascontiguousarray(points) for points in rings], FILL[rule])


def _own(node: Node, tolerance: float) -> CrossSection:
    if isinstance(node, Circle):
        radius = float(node.radius)  # type: ignore[arg-type]
        segments = node.segments
        if segments is not None and segments > MAX_SEGMENTS:  # type: ignore[operator]
            raise NoSolid(f"{node.title}: segments must be at most {MAX_SEGMENTS}, not {segments:g}")
        _check_near(radius, f"{node.label}: ")
        wanted = tolerance if node.tolerance is None else float(node.tolerance)  # type: ignore[arg-type]
        return CrossSection.circle(radius, int(segments or circle_segments(radius, wanted)))  # type: ignore[arg-type]
    try:
        if isinstance(node, Lettering):
            from ...lettering.lettering import rings_of_lettering

            return _filled(rings_of_lettering(node, tolerance, MOST_POINTS), "nonzero")
        if isinstance(node, TextOnPath):
            from ...lettering.along import rings_along

            return _filled(rings_along(node, tolerance, MOST_POINTS), "nonzero")
        return area_of(own_path(node), tolerance)
    except (NoSolid, Refusal) as fault:
        words = str(fault)
        raise NoSolid(words if words.startswith(node.title) else f"{node.label}: {words}") from None


def _joined(node: Node, sections: list[CrossSection]) -> CrossSection:
    if isinstance(node, Stencil):
        return stencilled(sections[0], node)
    if isinstance(node, (LinearArray, PolarArray, Mirror)):
        maps = [_flat(matrix, node) for matrix in copies(node)]
        sections = [_moved(section, matrix, node) for matrix in maps for section in sections]
    result = sections[0]
    for section in sections[1:]:
        if isinstance(node, Difference):
            result = result - section
        elif isinstance(node, Intersection):
            result = result ^ section
        else:
            result = result + section
    return result


def _placed(section: CrossSection, node: Node) -> CrossSection:
    return _moved(section, _flat(node.placement.matrix(), node), node) if node.placement.steps else section


def _moved(section: CrossSection, matrix: NDArray[np.float64], node: Node) -> CrossSection:
    if section.is_empty():
        return section
    low_x, low_y, high_x, high_y = section.bounds()
    corners = np.array([(x, y, 1.0) for x in (low_x, high_x) for y in (low_y, high_y)])
    _check_near(float(np.abs(corners @ matrix.T).max()), f"{node.label}: ")
    return section.transform(matrix)


def _check_near(reach: float, who: str = "") -> None:
    if not reach <= FARTHEST:
        raise NoSolid(f"{who}reaches farther than {FARTHEST:g} mm from the origin; that is too large to be exact")


def _flat(matrix: NDArray[np.float64], node: Node) -> NDArray[np.float64]:
    if np.abs(matrix[2, :2]).max() > 1e-12:
        raise NoSolid("an outline can be turned about z only")
    return matrix[:2][:, [0, 1, 3]]
