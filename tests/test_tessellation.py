"""No facet is farther from the true surface than the tolerance, for every curved kind."""

import numpy as np
import pytest

from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.outlines import Circle, Rectangle
from solidtree.model.document.primitives import Cone, Cylinder, Sphere, Torus
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import arrays_of
from solidtree.model.solid.tessellation import circle_segments, sphere_segments


def facets(node, tolerance):
    points, triangles = arrays_of(Evaluator().evaluate(node, tolerance).solid.to_mesh64())
    corners = points[triangles]
    weights = np.array([[1, 1, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1]]) / np.array([[3], [2], [2], [2]])
    return points, np.einsum("wk,tkx->twx", weights, corners).reshape(-1, 3)


@pytest.mark.parametrize("tolerance", [1.0, 0.1, 0.01])
@pytest.mark.parametrize("radius", [0.5, 7.0, 300.0])
def test_spheres(radius, tolerance):
    points, inside = facets(Sphere(radius=radius), tolerance)
    assert np.allclose(np.linalg.norm(points, axis=1), radius, rtol=1e-12)
    assert radius - np.linalg.norm(inside, axis=1).min() <= tolerance


@pytest.mark.parametrize("tolerance", [1.0, 0.1, 0.01])
def test_cylinders_and_cones(tolerance):
    for node in (Cylinder(radius=20, height=5), Cone(radius=20, top_radius=20, height=5)):
        _, inside = facets(node, tolerance)
        walls = inside[(inside[:, 2] > 0.1) & (inside[:, 2] < 4.9)]
        assert 20 - np.hypot(walls[:, 0], walls[:, 1]).min() <= tolerance


@pytest.mark.parametrize("tolerance", [1.0, 0.1, 0.02])
def test_tori(tolerance):
    _, inside = facets(Torus(radius=30, tube_radius=8), tolerance)
    from_tube = np.hypot(np.hypot(inside[:, 0], inside[:, 1]) - 30, inside[:, 2])
    assert 8 - from_tube.min() <= tolerance


def test_a_twisted_wall_keeps_its_volume_within_the_tolerance():
    node = Extrude(children=(Rectangle(width=20, height=10, centred=True),), height=10, twist=90)
    points, triangles = arrays_of(Evaluator().evaluate(node, 0.02).solid.to_mesh64())
    a, b, c = (points[triangles[:, i]] for i in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    # Every level is the rectangle, so the true volume is the straight bar's; the walls have about 60 mm x 10 mm.
    assert volume == pytest.approx(2000, abs=0.02 * 60 * 10)


def test_segments_win_over_tolerance():
    points, _ = facets(Cylinder(radius=5, segments=7), 0.001)
    assert len(points) == 14
    assert Evaluator().evaluate(Extrude(children=(Circle(radius=3, segments=5),)), 1).solid.num_vert() == 10


def test_counts_are_multiples_of_four_so_that_bounds_are_exact():
    for tolerance in (3.0, 0.3, 0.03):
        assert circle_segments(10, tolerance) % 4 == 0 and sphere_segments(10, tolerance) % 4 == 0
        bounds = Evaluator().evaluate(Sphere(radius=10), tolerance).solid.bounding_box()
        assert bounds == (-10, -10, -10, 10, 10, 10)


def test_a_tolerance_above_the_radius_still_makes_a_solid():
    assert Evaluator().evaluate(Sphere(radius=0.01), 5).solid.volume() > 0
