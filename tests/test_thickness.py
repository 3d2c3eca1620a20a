"""Walls by formula."""

import numpy as np
import pytest

from solidtree.model.document.nodes import Node
from solidtree.model.document.placement import Turn
from solidtree.model.measuring.thickness import Thickness, thickness_at, thinnest
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.results import arrays_of, evaluate_document


def wall(solid: Node, point, normal) -> Thickness | None:
    return thickness_at(*arrays_of(evaluate_document(document_of(solid)).solids[0].mesh()), point, normal)


def least(solid: Node, **options) -> Thickness | None:
    manifold = evaluate_document(document_of(solid)).solids[0].solid
    assert manifold is not None
    return thinnest(manifold, **options)


def test_a_box_is_as_thick_as_it_is_long():
    part = box(10, 20, 30)
    assert wall(part, (10, 5, 5), (1, 0, 0)) == Thickness(10, (10, 5, 5), (0, 5, 5))
    assert wall(part, (5, 5, 30), (0, 0, 1)).length == pytest.approx(30)
    assert wall(part, (10, 5, 5), (1, 1, 0)).length == pytest.approx(5 * np.sqrt(2))


def test_the_first_way_out_counts_and_an_edge_is_no_gap():
    hollow = box(20, centred=True) - box(14, centred=True)
    for point in ((10, 0, 0), (10, 3, 3), (10, 6.9, -2)):  # the first ones on the diagonals of faces
        assert wall(hollow, point, (1, 0, 0)).length == pytest.approx(3)
    assert wall(hollow, (7, 1, 2), (-1, 0, 0)).length == pytest.approx(3)
    assert wall(hollow, (10, 8, 0), (1, 0, 0)).length == pytest.approx(20)


def test_far_from_the_origin_and_turned():
    part = (box(10) - box(10, 10, 8).at(0, 0, 1)).turned(20, 30, 40).at(1e5, -1e5, 1e5)
    turn = Turn((20.0, 30.0, 40.0)).matrix()[:, :3]
    point = turn @ (5, 5, 10) + (1e5, -1e5, 1e5)
    assert wall(part, point, turn @ (0, 0, 1)).length == pytest.approx(1, abs=1e-9)


def test_a_surface_that_is_not_closed_has_no_wall_where_nothing_is_behind():
    points = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)])
    assert thickness_at(points, np.array([(0, 1, 2)]), (0.2, 0.2, 0), (0, 0, 1)) is None


def test_the_thinnest_wall_is_found_and_is_the_same_each_time():
    part = box(20, centred=True) - box(18, 18, 16, centred=True)
    found = least(part)
    assert found.length == pytest.approx(1, abs=1e-9) and found == least(part)
    assert least(part, seed=1) != found
    shell = sphere(10, tolerance=0.005) - sphere(8.5, tolerance=0.005)
    assert least(shell).length == pytest.approx(1.5, abs=0.02)


def test_a_thin_spot_is_missed_by_few_rays_and_never_underrated():
    pocket = box(20, 20, 5) - cylinder(1, 10, segments=32).at(10, 10, 0.5)
    assert least(pocket, rays=20).length == pytest.approx(5)
    assert least(pocket, rays=20_000).length == pytest.approx(0.5)


def test_nothing_has_no_wall():
    assert least(box(1) & box(1).at(5)) is None
