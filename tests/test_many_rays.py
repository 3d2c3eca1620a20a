"""100,000 rays at once: the same first hits as a caster that tries every triangle, and as the formulas."""

import numpy as np
import pytest
from test_rays import SCENES, tree_of

from solidtree.model.partition.rays import Rays
from solidtree.model.script import box, cylinder, sphere

COUNT, CHUNK = 100_000, 5_000
EDGE = 1e-6  # barycentric: nearer to a side it may go either way


def rays_through(low, high, seed):
    """Origins (n, 3) around a box and unit directions (n, 3) to places in it."""
    rng = np.random.default_rng(seed)
    origin = rng.normal(size=(COUNT, 3))
    origin = (low + high) / 2 + np.linalg.norm(high - low) * origin / np.linalg.norm(origin, axis=1, keepdims=True)
    along = rng.uniform(low, high, (COUNT, 3)) - origin
    return origin, along / np.linalg.norm(along, axis=1, keepdims=True)


def every_triangle(corners, origin, along):
    """The distances (n,) to the nearest of triangles (t, 3, 3), and which rays (n,) pass near a side of one: planes and
    barycentric coordinates as linear forms, nothing left out."""
    a, b, c = corners.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    square = np.einsum("ij,ij->i", normal, normal)
    first = np.cross(c - a, normal) / square[:, None]  # of a point p: its share of b is (p - a) · first
    second = np.cross(normal, b - a) / square[:, None]
    distance, doubtful = np.full(len(origin), np.inf), np.zeros(len(origin), bool)
    for start in range(0, len(origin), CHUNK):
        o, d = origin[start : start + CHUNK], along[start : start + CHUNK]
        with np.errstate(divide="ignore", invalid="ignore"):
            far = (np.einsum("ij,ij->i", normal, a) - o @ normal.T) / (d @ normal.T)
            u = o @ first.T + far * (d @ first.T) - np.einsum("ij,ij->i", first, a)
            v = o @ second.T + far * (d @ second.T) - np.einsum("ij,ij->i", second, a)
            inner = np.minimum(np.minimum(u, v), 1.0 - u - v)
        inner = np.where(np.isfinite(far) & (far >= 0.0), inner, -np.inf)
        distance[start : start + CHUNK] = np.where(inner >= 0.0, far, np.inf).min(axis=1)
        doubtful[start : start + CHUNK] = (np.abs(inner) < EDGE).any(axis=1)
    return distance, doubtful


@pytest.mark.parametrize("scene", ["crossing", "touching"])
def test_no_ray_away_from_edges_differs_from_a_caster_that_tries_every_triangle(scene):
    tree = tree_of(*SCENES[scene])
    corners = tree.faces.points[tree.faces.corners.reshape(-1, 3)]
    origin, along = rays_through(tree.faces.points.min(axis=0), tree.faces.points.max(axis=0), 3)
    distance, face = Rays(tree).first(origin, along)
    expected, doubtful = every_triangle(corners, origin, along)
    differ = ~np.isclose(distance, expected, rtol=0.0, atol=1e-9 * Rays(tree).size) & ~doubtful
    assert np.count_nonzero(differ) == 0 and doubtful.mean() < 0.001
    assert np.isfinite(expected).mean() > 0.4 and np.array_equal(face >= 0, np.isfinite(distance))


def test_rays_meet_a_box_a_ball_and_a_cylinder_where_the_formulas_say():
    origin, along = rays_through(np.array([-6.0, -6, -6]), np.array([6.0, 6, 6]), 5)
    with np.errstate(divide="ignore", invalid="ignore"):
        slabs = np.sort(np.stack(((-5 - origin) / along, (5 - origin) / along)), axis=0)
        enter, leave = slabs[0].max(axis=1), slabs[1].min(axis=1)
    found, _ = Rays(tree_of(box(10, centred=True))).first(origin, along)
    hit = enter < leave
    sure = np.abs(leave - enter) > 1e-6
    assert np.array_equal(np.isfinite(found)[sure], hit[sure])
    assert np.abs(found - enter)[hit & sure].max() < 1e-9

    middle = -np.einsum("ij,ij->i", origin, along)
    near = np.linalg.norm(origin + middle[:, None] * along, axis=1)
    found, _ = Rays(tree_of(sphere(5, segments=64))).first(origin, along)
    assert np.isfinite(found)[near < 4.9].all() and not np.isfinite(found)[near > 5.0].any()
    deep = near < 3.0
    assert np.abs(found - (middle - np.sqrt(np.maximum(25 - near**2, 0))))[deep].max() < 0.05  # facets lie inside

    flat = np.linalg.norm(along[:, :2], axis=1)
    middle = -np.einsum("ij,ij->i", origin[:, :2], along[:, :2]) / flat**2
    near = np.linalg.norm(origin[:, :2] + middle[:, None] * along[:, :2], axis=1)
    side = middle - np.sqrt(np.maximum(25 - near**2, 0)) / flat
    height = origin[:, 2] + side * along[:, 2]
    found, _ = Rays(tree_of(cylinder(5, 10, centred=True, segments=256))).first(origin, along)
    walls = (near < 3.0) & (np.abs(height) < 4.9)
    assert walls.sum() > 10_000 and np.abs(found - side)[walls].max() < 0.05
