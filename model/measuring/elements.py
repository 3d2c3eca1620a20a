"""What a click picks to measure: a point, an edge, a circle or a face, with its own figures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .distance import Axis
from .features import bits_of, features
from .figure import EXACT, SEEN, Figure, vector
from .landmarks import curved, face_at, patch_at
from .surfaces import (
    ConeSurface,
    CylinderSurface,
    Plane,
    SphereSurface,
    Surface,
    TorusSurface,
    surface_at,
)
from .thickness import thickness_at
from .vectors import three

if TYPE_CHECKING:
    from ..document.nodes import Node
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

RING = 4320
"""Edges that stand for a whole circle: distances to it are right to 3e-7 of its radius."""
MOST_WRITTEN = 30_000
"""Coordinates that are turned into the shortest decimals; what has more keeps the picture's."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line to draw, with its words: a distance, a radius or a wall."""

    start: Vector
    end: Vector
    text: str


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """`thing` is what distances go to (see distance.py); `direction` a straight edge's or an axis', `normal` a flat
    face's; `outline` (n, 2, 3) is drawn to show what was picked."""

    words: str
    thing: Floats
    figures: tuple[Figure, ...]
    outline: Floats
    direction: Vector | None = None
    normal: Vector | None = None
    axis: Axis | None = None
    centre: Vector | None = None
    line: Line | None = None


def point_element(point: Vector, words: str = "Point") -> Element:
    place = three(written(np.array(point)))
    return Element(words, np.array(place), (vector("Position", place, digits=SEEN),), np.empty((0, 2, 3)))


def edge_element(root: Node, mesh: DisplayMesh, point: Vector) -> Element:
    """The feature edge of a mesh that is nearest to a point: straight, round, or another line."""
    lines = features(mesh)
    ends = lines.points[lines.edges]
    way = ends[:, 1] - ends[:, 0]
    square = np.maximum(np.einsum("ij,ij->i", way, way), 1e-300)
    share = np.clip(np.einsum("ij,ij->i", np.asarray(point) - ends[:, 0], way) / square, 0, 1)
    near = int(np.linalg.norm(ends[:, 0] + share[:, None] * way - point, axis=1).argmin())
    chain = lines.chain[near]
    outline = ends[lines.chain == chain]
    straight = np.flatnonzero(lines.straight_chains == chain)
    if len(straight):
        a, b = written(lines.points[lines.straight[straight[0]]])
        length = float(np.linalg.norm(b - a))
        direction = three((b - a) / length) if length else None
        figures = [Figure("Length", (length,), digits=SEEN)]
        if direction is not None:
            figures.append(vector("Direction", direction, "", SEEN))
        return Element("Edge", np.array([a, b]), tuple(figures), np.array([[a, b]]), direction=direction)
    chord = np.linalg.norm(outline[:, 1] - outline[:, 0], axis=1)
    circle = np.flatnonzero(lines.circles.chains == chain)
    thing = outline[:, [0, 1, 1]]  # edges as triangles without area
    if not len(circle):
        return Element("Curve", thing, (Figure("Length", (float(chord.sum()),), digits=SEEN),), outline)
    number = circle[0]
    centre, radius = three(written(lines.circles.centres[number])), float(lines.circles.radii[number])
    axis = three(lines.circles.normals[number])
    digits = SEEN
    exact = _circle_at(root, mesh, lines.edges[near], centre, axis)
    if exact is not None:
        centre, axis, radius = exact
        digits = EXACT
    counts = np.bincount(lines.edges[lines.chain == chain].ravel())
    whole = bool((counts[counts > 0] == 2).all())
    if whole:
        thing = _ring(centre, axis, radius)
    length = 2 * math.pi * radius if whole else float(2 * radius * np.arcsin(np.minimum(chord / 2 / radius, 1)).sum())
    return Element(
        "Circle" if whole else "Arc",
        thing,
        (
            Figure("Radius", (radius,), digits=digits),
            Figure("Diameter", (2 * radius,), digits=digits),
            vector("Centre", centre, digits=SEEN),
            Figure("Length", (length,), digits=digits),
            vector("Axis", axis, "", SEEN),
        ),
        outline,
        axis=Axis(centre, axis),
        direction=axis,
        centre=centre,
        line=Line(centre, three(ends[near, 0]), f"R {short(radius)}"),
    )


def face_element(root: Node, mesh: DisplayMesh, triangle: int, point: Vector) -> Element:
    """The flat or curved face that holds a triangle, picked at a point of it."""
    surface = surface_at(root, mesh, triangle)
    bent = curved(mesh, triangle)
    face = face_at(mesh, triangle)
    triangles = patch_at(mesh, triangle) if bent else face.triangles
    corners = mesh.points[mesh.triangles[triangles]].astype(np.float64)
    corners = written(corners) if corners.size <= MOST_WRITTEN else corners
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    wall = thickness_at(mesh.points, mesh.triangles, point, face.normal)
    figures = [*_figures_of(surface, bent), Figure("Area", (float(area),), "mm²", SEEN)]
    if wall is not None:
        figures.append(Figure("Wall", (wall.length,), digits=7))
    line = None if wall is None else Line(wall.point, wall.exit, f"{short(wall.length)} mm")
    normal = axis = centre = direction = None
    match surface:
        case CylinderSurface(origin, along) | ConeSurface(origin, along):
            axis, direction = Axis(origin, along), along
        case TorusSurface(origin, along):
            axis, direction, centre = Axis(origin, along), along, origin
        case SphereSurface(origin):
            centre = origin
        case Plane(_, across) if not bent:
            normal = across
    if isinstance(surface, CylinderSurface | SphereSurface):
        start = np.array(surface.point if isinstance(surface, CylinderSurface) else surface.centre)
        if isinstance(surface, CylinderSurface):
            start = start + np.array(surface.axis) * (np.array(surface.axis) @ (np.asarray(point) - start))
        spoke = np.asarray(point) - start
        rim = start + spoke * surface.radius / max(float(np.linalg.norm(spoke)), 1e-300)
        line = Line(three(start), three(rim), f"R {short(surface.radius)}")
    outline = _border(corners) if bent else face.rim
    return Element(_words_of(surface, bent), corners, tuple(figures), outline, direction, normal, axis, centre, line)


def written(points: NDArray[np.floating]) -> Floats:
    """Coordinates of the picture's single precision as the shortest decimals that stand for them: 6.3 for 6.3000002.

    What was typed comes back so, and the rest stays as good as it was.
    """
    return np.asarray(points, dtype=np.float32).astype(str).astype(np.float64)


def short(value: float) -> str:
    """Up to 6 significant digits, without an exponent for sizes that people build."""
    value = round(value, 9) + 0.0
    if value and not 1e-4 <= abs(value) < 1e9:
        return f"{value:.6g}"
    whole = len(str(int(abs(value))))
    return f"{value:.{max(0, 6 - whole)}f}".rstrip("0").rstrip(".") if whole < 6 else f"{value:.0f}"


def _figures_of(surface: Surface, bent: bool) -> list[Figure]:
    match surface:
        case CylinderSurface(point, axis, radius, _, deviation):
            return [*_round(radius, deviation), vector("On axis", point), vector("Axis", axis, "")]
        case SphereSurface(centre, radius, _, deviation):
            return [*_round(radius, deviation), vector("Centre", centre)]
        case ConeSurface(apex, axis, half):
            return [Figure("Half angle", (half,), "°"), vector("Apex", apex), vector("Axis", axis, "")]
        case TorusSurface(centre, axis, radius, tube):
            parts = [Figure("Radius", (radius,)), Figure("Tube radius", (tube,))]
            return [*parts, vector("Centre", centre), vector("Axis", axis, "")]
    return [] if bent else [vector("Normal", surface.normal, "", SEEN)]


def _round(radius: float, deviation: float | None) -> list[Figure]:
    digits = EXACT if deviation is None else 7
    found = [Figure("Radius", (radius,), digits=digits), Figure("Diameter", (2 * radius,), digits=digits)]
    return found if deviation is None else [*found, Figure("Fitted within", (deviation,), digits=3)]


def _words_of(surface: Surface, bent: bool) -> str:
    hollow = getattr(surface, "hollow", False)
    match surface:
        case CylinderSurface():
            return "Round hole" if hollow else "Cylinder"
        case ConeSurface():
            return "Countersink" if hollow else "Cone"
        case SphereSurface():
            return "Hollow sphere" if hollow else "Sphere"
        case TorusSurface():
            return "Torus"
    return "Curved face" if bent else "Face"


def _circle_at(
    root: Node, mesh: DisplayMesh, edge: NDArray[np.int64], centre: Vector, axis: Vector
) -> tuple[Vector, Vector, float] | None:
    """Centre, axis and radius of a round edge from the cylinder beside it that meets its plane at right angles."""
    at = np.isin(bits_of(mesh.points), bits_of(mesh.edge_points[edge]))
    for triangle in np.flatnonzero(at[mesh.triangles].sum(axis=1) >= 2):
        surface = surface_at(root, mesh, int(triangle))
        if isinstance(surface, CylinderSurface) and surface.deviation is None:
            along = np.array(surface.axis)
            offset = np.array(centre) - surface.point
            if abs(along @ axis) > 1 - 1e-6 and np.linalg.norm(np.cross(along, offset)) < 1e-3 * surface.radius:
                return three(np.array(surface.point) + along * (along @ offset)), surface.axis, surface.radius
    return None


def _ring(centre: Vector, axis: Vector, radius: float) -> Floats:
    """(RING, 3, 3) a circle as edges, written as triangles without area, finer than any picture's."""
    across = np.linalg.svd(np.array([axis]))[2][1:]
    turn = np.linspace(0, 2 * np.pi, RING + 1)
    points = np.array(centre) + radius * np.column_stack((np.cos(turn), np.sin(turn))) @ across
    return np.stack([points[:-1], points[1:], points[1:]], axis=1)


def _border(corners: Floats) -> Floats:
    """(n, 2, 3) the sides that one of the triangles (k, 3, 3) has alone."""
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 3)
    bits = np.sort(bits_of(ends.reshape(-1, 3).astype(np.float32)).reshape(-1, 2), axis=1)
    key = bits[:, 0] * np.uint64(0x9E3779B97F4A7C15) + bits[:, 1]
    _, first, count = np.unique(key, return_index=True, return_counts=True)
    return ends[first[count == 1]]
