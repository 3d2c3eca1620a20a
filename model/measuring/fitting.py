"""A cylinder or a sphere through the points of a mesh whose maker is not known, by least squares."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .landmarks import curved, patch_at
from .surface_kinds import CylinderSurface, SphereSurface
from .vectors import three

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]

ROUND = 0.01
"""How far a point may lie beside the fitted surface, as a share of its radius."""
LEAN = 0.17
"""The mean sine of the angle by which facets may lean from the surface at their middle."""
FEWEST = 6
STEPS = 30


def fitted_surface(mesh: DisplayMesh, triangle: int) -> CylinderSurface | SphereSurface | None:
    """The better of a cylinder and a sphere through the curved face around a triangle.

    None where the face is flat, or neither fits to a hundredth of its radius.
    """
    if not curved(mesh, triangle):
        return None
    corners = mesh.triangles[patch_at(mesh, triangle)]
    points = np.unique(mesh.points[np.unique(corners)].astype(np.float64), axis=0)
    if len(points) < FEWEST:
        return None
    a, b, c = (mesh.points[corners[:, i]].astype(np.float64) for i in range(3))
    areas = np.cross(b - a, c - a)
    middles = (a + b + c) / 3
    found: list[tuple[float, CylinderSurface | SphereSurface]] = []
    centre, radius, beside = fitted_sphere(points)
    if beside <= ROUND * radius:
        lean, hollow = _lean(areas, middles - centre)
        found.append((lean, SphereSurface(three(centre), radius, hollow, beside)))
    point, axis, radius, beside = fitted_cylinder(points, areas)
    if beside <= ROUND * radius:
        offset = middles - point
        lean, hollow = _lean(areas, offset - np.outer(offset @ axis, axis))
        found.append((lean, CylinderSurface(three(point), three(axis), radius, hollow, beside)))
    # The two rims of a cylinder lie on a sphere, too: which it is the facets' slopes tell.
    lean, surface = min(found, key=lambda pair: pair[0], default=(np.inf, None))
    return surface if lean < LEAN else None


def _lean(areas: Floats, spokes: Floats) -> tuple[float, bool]:
    """The mean sine of the angle between facets' normals and the spokes (m, 3) to their middles, and whether the
    normals point inwards."""
    sizes = np.maximum(np.linalg.norm(areas, axis=1), 1e-300)
    lengths = np.maximum(np.linalg.norm(spokes, axis=1), 1e-300)
    sines = np.linalg.norm(np.cross(areas, spokes), axis=1) / lengths
    return float(sines.sum() / sizes.sum()), bool(np.einsum("ij,ij->", areas, spokes) < 0)


def fitted_sphere(points: Floats) -> tuple[Floats, float, float]:
    """Centre (3,), radius and the largest distance of the points (n, 3) from the sphere; Kåsa's fit (1976) in space."""
    centre, radius = _ball(points)
    return centre, radius, _worst(points - centre, radius)


def fitted_cylinder(points: Floats, areas: Floats) -> tuple[Floats, Floats, float, float]:
    """A point on the axis (3,), its unit direction (3,), radius and the largest distance of the points (n, 3).

    The axis starts as the direction that the facets' area vectors (m, 3) have least of, and is then bettered together
    with the circle by Gauss and Newton's method on the points' distances.
    """
    axis = np.linalg.svd(areas, full_matrices=False)[2][-1]
    mean = points.mean(axis=0)
    offset = points - mean
    for _ in range(STEPS):
        across = np.linalg.svd(axis[None])[2][1:]  # (2, 3) at right angles to the axis
        flat = offset @ across.T
        centre, radius = _ball(flat)
        spoke = flat - centre
        length = np.maximum(np.linalg.norm(spoke, axis=1), 1e-300)
        outward = spoke / length[:, None]
        along = offset @ axis
        # The distance changes with the centre, the radius, and a lean of the axis, which shifts what is far along it.
        slopes = np.column_stack([-outward, -np.ones(len(points)), -outward * along[:, None]])
        change = np.linalg.lstsq(slopes, radius - length, rcond=None)[0]
        lean = change[3:] @ across
        turned = axis + lean
        axis = turned / np.linalg.norm(turned)
        if np.abs(lean).max() < 1e-15:
            break
    across = np.linalg.svd(axis[None])[2][1:]
    centre, radius = _ball(offset @ across.T)
    return mean + centre @ across, axis, radius, _worst(offset @ across.T - centre, radius)


def _ball(points: Floats) -> tuple[Floats, float]:
    """Centre (d,) and radius of the circle or sphere through points (n, d): linear least squares."""
    mean = points.mean(axis=0)
    offset = points - mean
    rows = np.column_stack([2 * offset, np.ones(len(points))])
    solution = np.linalg.lstsq(rows, (offset**2).sum(axis=1), rcond=None)[0]
    centre = solution[:-1]
    return mean + centre, float(np.sqrt(max(solution[-1] + centre @ centre, 1e-300)))


def _worst(offsets: Floats, radius: float) -> float:
    return float(np.abs(np.linalg.norm(offsets, axis=1) - radius).max())
