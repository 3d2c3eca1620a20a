"""Measures by formula."""

import numpy as np
import pytest

from solidtree.model.script import box, cylinder, measure, polar_array, sphere, torus, union
from solidtree.model.solid.measure import component_count
from solidtree.model.solid.measure import measure as measure_mesh


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
