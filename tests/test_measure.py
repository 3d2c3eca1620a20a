"""Measures by formula."""

import numpy as np
import pytest
import trimesh

from solidtree.model.document.nodes import Node
from solidtree.model.measuring.measure import component_count, summed
from solidtree.model.measuring.measure import measure as measure_mesh
from solidtree.model.script import (
    box,
    cone,
    cylinder,
    document_of,
    extrude,
    hull,
    measure,
    polar_array,
    polygon,
    polyhedron,
    sphere,
    torus,
    union,
)
from solidtree.model.solid.results import arrays_of, evaluate_document


def test_a_box():
    measures = measure(box(2, 3, 4).at(10, 20, 30))
    assert measures.volume == pytest.approx(24, rel=1e-14) and measures.area == pytest.approx(52)
    assert measures.bounds == ((10, 20, 30), (12, 23, 34)) and measures.centroid == pytest.approx((11, 21.5, 32))
    assert (measures.triangles, measures.components, measures.genus, measures.closed) == (12, 1, 0, True)


def test_far_from_the_origin_no_digits_are_lost():
    near, far = measure(box(1).turned(10, 20, 30)), measure(box(1).turned(10, 20, 30).at(1e6, 1e6, 1e6))
    assert far.volume == pytest.approx(near.volume, rel=1e-8)


def test_genus_is_summed_over_the_surfaces_and_a_cavity_is_one():
    assert measure(torus(10, 2)).genus == 1
    drilled = box(30) - union(*(cylinder(1, 40).at(3 + 5 * i, 3, -5) for i in range(5)))
    assert measure(drilled).genus == 5
    hollow = measure(box(10) - sphere(2).at(5, 5, 5))
    assert (hollow.components, hollow.genus) == (2, 0)
    rings = measure(polar_array(torus(4, 1).at(20), 7))
    assert (rings.components, rings.genus) == (7, 7)


def test_parts_that_touch_in_an_edge_or_a_corner_count_as_two():
    assert measure(union(box(1), box(1).at(1, 1))).components == 2
    assert measure(union(box(1), box(1).at(1, 1, 1))).components == 2


def test_an_open_surface_has_no_volume_and_one_border_less():
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)], dtype=float)
    tent = np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
    measures = measure_mesh(points, tent, closed=False)
    assert measures.volume is None and measures.centroid is None and not measures.closed
    assert measures.inertia is None and measures.principal_moments is None
    assert measures.area == pytest.approx(4 * np.hypot(1, 0.5) / 2)


def test_components_of_long_chains_and_random_labels():
    rng = np.random.default_rng(0)
    strips = 9
    triangles = np.concatenate(
        [np.arange(1000)[:-2, None] + np.array([0, 1, 2]) + 1000 * strip for strip in range(strips)]
    )
    shuffled = rng.permutation(1000 * strips)[rng.permutation(triangles)]
    assert component_count(1000 * strips, shuffled) == strips


def test_nothing_measures_nothing():
    empty = measure(box(1) & box(1).at(5))
    assert (empty.volume, empty.area, empty.bounds, empty.triangles) == (0, 0, None, 0)
    assert (empty.components, empty.genus) == (0, 0)


def surface_of(solid: Node, tolerance: float = 0.05) -> tuple[np.ndarray, np.ndarray]:
    return arrays_of(evaluate_document(document_of(solid), tolerance).solids[0].mesh())


def cuboid_inertia(x: float, y: float, z: float) -> np.ndarray:
    return x * y * z / 12 * np.diag([y * y + z * z, x * x + z * z, x * x + y * y])


@pytest.mark.parametrize(
    "solid",
    [
        box(20, 30, 40).turned(20, 30, 40).at(5, 6, 7),
        sphere(7).at(-3, 2, 1) - cylinder(2, 30).at(-3, 2, -15),
        torus(15, 4).turned(x=30).scaled(1, 2, 3).at(40),
        union(box(5), box(5).at(20), sphere(3).at(0, 20)),
        box(10) - sphere(3).at(5, 5, 5),
        extrude(polygon([(0, 0), (9, 0), (9, 3), (3, 3), (3, 8), (0, 8)]), 7, twist=40),
        hull(sphere(4), box(3).at(10, 2, 2)),
    ],
    ids=lambda solid: solid.kind,
)
def test_mass_properties_equal_trimesh(solid):
    points, triangles = surface_of(solid)
    ours, theirs = measure_mesh(points, triangles), trimesh.Trimesh(points, triangles, process=False)
    assert ours.volume == pytest.approx(theirs.volume, rel=1e-9)
    assert ours.area == pytest.approx(theirs.area, rel=1e-9)
    assert np.allclose(ours.centroid, theirs.center_mass, rtol=1e-9, atol=1e-9)
    size = np.abs(theirs.moment_inertia).max()
    assert np.allclose(ours.inertia, theirs.moment_inertia, rtol=0, atol=1e-9 * size)
    assert np.allclose(ours.principal_moments, theirs.principal_inertia_components, rtol=1e-9)


def test_inertia_of_boxes_and_polyhedra_is_exact():
    turn = measure(box(1).turned(10, 20, 30))
    assert np.allclose(turn.inertia, np.eye(3) / 6, rtol=0, atol=1e-15)
    assert np.allclose(measure(box(2, 3, 4).at(7, 8, 9)).inertia, cuboid_inertia(2, 3, 4), rtol=1e-14, atol=1e-12)
    # Corner tetrahedron with legs a, b, c: the integral of x^2 is a^3 b c / 60, of x y it is a^2 b^2 c / 120.
    legs = np.array([2.0, 3.0, 5.0])
    corner = polyhedron([(0, 0, 0), *np.diag(legs).tolist()], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    volume = legs.prod() / 6
    second = volume / 20 * np.outer(legs, legs) + volume / 20 * np.diag(legs**2)
    second -= volume * np.outer(legs, legs) / 16
    expected = np.trace(second) * np.eye(3) - second
    assert np.allclose(measure(corner).inertia, expected, rtol=1e-13)


@pytest.mark.parametrize(
    ("solid", "volume", "area", "moments"),
    [
        (sphere(10), 4000 / 3 * np.pi, 400 * np.pi, [2 / 5 * 100] * 3),
        (cylinder(4, 10), 160 * np.pi, 112 * np.pi, [16 / 2, 16 / 4 + 100 / 12, 16 / 4 + 100 / 12]),
        (cone(5, 0, 12), 100 * np.pi, 90 * np.pi, [3 / 10 * 25, *[3 / 20 * 25 + 3 / 80 * 144] * 2]),
        (torus(15, 4), 480 * np.pi**2, 240 * np.pi**2, [*[225 / 2 + 5 / 8 * 16] * 2, 225 + 3 / 4 * 16]),
    ],
    ids=["sphere", "cylinder", "cone", "torus"],
)
def test_curved_primitives_come_to_the_formula_with_the_tolerance(solid, volume, area, moments):
    moments = np.array(moments) * volume
    errors = []
    for tolerance in (0.4, 0.1, 0.025):
        measures = measure_mesh(*surface_of(solid, tolerance))
        principal = np.array(measures.principal_moments)
        errors.append(
            [
                abs(measures.volume / volume - 1),
                abs(measures.area / area - 1),
                np.abs(principal / np.sort(moments) - 1).max(),
            ]
        )
        assert abs(measures.volume - volume) <= tolerance * area
    errors = np.array(errors)
    # The facets' distance goes with the tolerance, four times less each time, and so do all errors.
    assert (errors[1:] < errors[:-1] / 2.5).all() and (errors[-1] < 0.02).all()


def test_far_solids_keep_their_inertia_and_the_axes_are_principal():
    part = box(3, 5, 7).turned(10, 20, 30)
    near, far = measure(part), measure(part.at(1e6, -1e6, 1e6))
    assert np.allclose(far.inertia, near.inertia, rtol=1e-8)
    axes = np.array(near.principal_axes)
    assert np.allclose(axes @ np.array(near.inertia) @ axes.T, np.diag(near.principal_moments), atol=1e-11)
    assert np.linalg.det(axes) == pytest.approx(1)


def test_the_sum_of_parts_is_the_whole():
    low, high = box(4, 4, 4), box(4, 4, 6).at(0, 0, 4)
    both, whole = summed([measure(low), measure(high)]), measure(box(4, 4, 10))
    assert both.volume == pytest.approx(160) and both.bounds == whole.bounds
    assert both.centroid == pytest.approx(whole.centroid)
    assert np.allclose(both.inertia, whole.inertia, rtol=1e-13, atol=1e-10)
    assert both.area == pytest.approx(whole.area + 32)
