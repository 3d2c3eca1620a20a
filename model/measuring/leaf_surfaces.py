"""On which surface a triangle of a leaf lies, in the leaf's own axes: one small function a kind."""

from __future__ import annotations

import math
from functools import singledispatch

import numpy as np
from numpy.typing import NDArray

from ..document.from_outlines import Extrude, Revolve
from ..document.nodes import Node
from ..document.outlines import Circle, Polygon, Rectangle
from ..document.primitives import Box, Cone, Cylinder, Halfspace, Polyhedron, Sphere, Torus
from .surface_kinds import ConeSurface, CylinderSurface, Plane, SphereSurface, TorusSurface, Vector
from .vectors import three

Floats = NDArray[np.float64]

EVEN = 1e-9
"""Relative: how far a map may be from keeping circles round."""
SLOPE = 0.2
"""The sine of the angle by which a facet may lean from the side of the outline that it was made of."""
CAP = math.sqrt(0.5)
"""A facet whose normal is nearer to the axis than 45 degrees may be the end of a round bar."""

RoundShape = CylinderSurface | ConeSurface | SphereSurface | TorusSurface
Shape = Plane | RoundShape | None
ORIGIN: Vector = (0.0, 0.0, 0.0)
UP: Vector = (0.0, 0.0, 1.0)

LEVEL = 1e-6
"""The z of the unit normal of an upright facet is below this."""


def round_shapes(leaf: Node) -> list[RoundShape]:
    """The curved surfaces that faces of a leaf may lie on, in its own axes; none where the model does not know them."""
    found: list[Shape] = []
    if isinstance(leaf, Revolve) and not isinstance(leaf.children[0], Circle):
        sides = _sides(leaf.children[0])
        for (low, foot), (high, top) in [] if sides is None else sides.tolist():
            if foot != top:
                found.append(_slanted(*((low, foot, high, top) if foot < top else (high, top, low, foot))))
    elif isinstance(leaf, Extrude | Revolve):
        corners = np.tile((1.0, 0.0, float(leaf.height) if isinstance(leaf, Extrude) else 0.0), (3, 1))
        if isinstance(leaf.children[0], Circle):  # its wall, and what leans
            found = [shape_of(leaf, corners, np.array(normal)) for normal in ((1.0, 0.0, 0.0), (0.6, 0.0, 0.8))]
    else:
        found = [shape_of(leaf, np.zeros((3, 3)), np.array((1.0, 0.0, 0.0)))]
    return [shape for shape in dict.fromkeys(found) if isinstance(shape, RoundShape)]


@singledispatch
def shape_of(leaf: Node, corners: Floats, normal: Floats) -> Shape:
    """None where the triangle itself is all there is to tell."""
    return None


@shape_of.register(Box | Polyhedron | Halfspace)
def _flat(leaf: Node, corners: Floats, normal: Floats) -> Shape:
    return Plane(three(corners.mean(axis=0)), three(normal))


@shape_of.register
def _sphere(leaf: Sphere, corners: Floats, normal: Floats) -> Shape:
    return SphereSurface(ORIGIN, float(leaf.radius))


@shape_of.register
def _cylinder(leaf: Cylinder, corners: Floats, normal: Floats) -> Shape:
    if abs(normal[2]) > CAP:
        return Plane(three(corners.mean(axis=0)), three(normal))
    return CylinderSurface(ORIGIN, UP, float(leaf.radius))


@shape_of.register
def _cone(leaf: Cone, corners: Floats, normal: Floats) -> Shape:
    height = float(leaf.height)
    foot = -height / 2 if leaf.centred else 0.0
    low, high = float(leaf.radius), float(leaf.top_radius)
    level = np.ptp(corners[:, 2]) <= 1e-6 * max(height, low, high)
    if level and abs(normal[2]) > 1 - 1e-6:
        return Plane(three(corners.mean(axis=0)), three(normal))
    return _slanted(low, foot, high, foot + height)


@shape_of.register
def _torus(leaf: Torus, corners: Floats, normal: Floats) -> Shape:
    return TorusSurface(ORIGIN, UP, float(leaf.radius), float(leaf.tube_radius))


@shape_of.register
def _extrusion(leaf: Extrude, corners: Floats, normal: Floats) -> Shape:
    outline = leaf.children[0]
    height = float(leaf.height)
    if abs(normal[2]) > 1 - 1e-6:
        return Plane(three(corners.mean(axis=0)), three(normal))
    if not isinstance(outline, Circle):
        return None if leaf.twist else Plane(three(corners.mean(axis=0)), three(normal))
    circle = _circle(outline)
    if circle is None:
        return None
    (x, y), radius = circle
    scale = float(leaf.top_scale)
    foot = (float(leaf.below) - height) / 2 if leaf.centred else 0.0
    if leaf.taper or leaf.bevel:
        if abs(normal[2]) < LEVEL:
            return CylinderSurface((x, y, 0.0), UP, radius)
        half, begin = (float(leaf.taper), foot) if leaf.taper else (45.0, foot + height - float(leaf.bevel))
        upper = (corners[:, 2].mean() > foot) == (half > 0.0)  # its apex is above its wide end
        way = 1.0 if upper else -1.0
        apex = begin + way * radius / math.tan(math.radians(abs(half)))
        return ConeSurface((x, y, apex), (0.0, 0.0, -way), abs(half))
    if scale == 1.0 and not (leaf.twist and (x or y)):
        return CylinderSurface((x, y, 0.0), UP, radius)
    return _slanted(radius, foot, scale * radius, foot + height) if x == y == 0.0 else None


@shape_of.register
def _revolution(leaf: Revolve, corners: Floats, normal: Floats) -> Shape:
    outline = leaf.children[0]
    middle = corners.mean(axis=0)
    if abs(normal[2]) > 1 - 1e-6:
        return Plane(three(middle), three(normal))
    around = math.hypot(middle[0], middle[1])
    radial = middle[:2] / around if around else np.zeros(2)
    if abs(float(radial @ normal[:2])) < 1e-3 and abs(normal[2]) < 1e-6:
        return Plane(three(middle), three(normal))  # the ends of less than a full turn
    if isinstance(outline, Circle):
        circle = _circle(outline)
        if circle is None or circle[0][0] < circle[1]:
            return None  # it is cut off at the axis
        (x, y), radius = circle
        return TorusSurface((0.0, 0.0, y), UP, x, radius)
    sides = _sides(outline)
    if sides is None:
        return None
    # The side that was turned: of those with the facet's slope the nearest one.
    first, along = sides[:, 0], sides[:, 1] - sides[:, 0]
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    slope = np.abs(along @ (float(radial @ normal[:2]), normal[2]))
    beside = np.abs((around - first[:, 0]) * along[:, 1] - (middle[2] - first[:, 1]) * along[:, 0])
    (low, foot), (high, top) = sides[np.argmin(np.where(slope < SLOPE, beside, np.inf))]
    return _slanted(*((low, foot, high, top) if foot < top else (high, top, low, foot)))


def _sides(outline: Node) -> Floats | None:
    """(k, 2, 2) the placed sides of a straight outline."""
    if isinstance(outline, Rectangle):
        width, height = float(outline.width), float(outline.height)
        corners = np.array([(0, 0), (width, 0), (width, height), (0, height)])
        corners -= (width / 2, height / 2) if outline.centred else 0.0
        loops = [corners]
    elif isinstance(outline, Polygon):
        points = np.array(outline.points, dtype=np.float64)
        loops = [points[list(loop)] for loop in outline.loops] or [points]
    else:
        return None
    matrix = outline.placement.matrix()[:2]
    placed = [loop @ matrix[:, :2].T + matrix[:, 3] for loop in loops]
    return np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in placed])


def _circle(outline: Circle) -> tuple[tuple[float, float], float] | None:
    """Centre and radius of a placed round outline; None for an ellipse."""
    matrix = outline.placement.matrix()
    scale = evenly(matrix[:2, :2])
    return None if scale is None else ((float(matrix[0, 3]), float(matrix[1, 3])), scale * float(outline.radius))


def _slanted(low: float, foot: float, high: float, top: float) -> Shape:
    """The cone, or cylinder, about z through two circles."""
    if low == high:
        return CylinderSurface(ORIGIN, UP, low)
    apex = foot + (top - foot) * low / (low - high)
    half = math.degrees(math.atan2(abs(low - high), top - foot))
    return ConeSurface((0.0, 0.0, apex), (0.0, 0.0, -1.0 if low > high else 1.0), half)


def evenly(linear: Floats) -> float | None:
    """The factor of a map (n, n) that scales alike in all directions, else None."""
    square = linear.T @ linear
    scale = float(np.trace(square)) / len(square)
    return math.sqrt(scale) if np.abs(square - scale * np.eye(len(square))).max() <= EVEN * scale else None
