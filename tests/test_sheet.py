"""What pictures show of outlines that stand by themselves."""

from math import pi

import numpy as np
import pytest

from solidtree.model.script import bezier, circle, path, polygon, rectangle
from solidtree.model.solid.outlines.sheet import sheet_of


def area(mesh) -> float:
    a, b, c = (mesh.vertices[mesh.corners[:, i]] for i in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def test_the_triangles_cover_what_the_outline_fills_and_the_edges_go_round_it():
    mesh = sheet_of(path("M0 0h9v9h-9z M2 2v5h5v-5z").with_(id="n1"), 0.05)
    assert area(mesh) == pytest.approx(81 - 25)
    ends = mesh.edge_points[mesh.edges]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(36 + 20, rel=1e-6)
    assert mesh.sheet and mesh.owners == (("n1",),)


def test_it_stands_where_it_is_placed_with_its_normal():
    mesh = sheet_of(rectangle(3, 4).turned(x=90).at(0, 7, 0), 0.05)
    np.testing.assert_allclose(mesh.bounds, [[0, 7, 0], [3, 7, 4]], atol=1e-12)
    np.testing.assert_allclose(mesh.normals, np.broadcast_to((0, -1, 0), mesh.normals.shape), atol=1e-6)


def test_a_finer_tolerance_makes_it_rounder_and_a_larger_scale_too():
    areas = [area(sheet_of(circle(10), tolerance)) for tolerance in (0.5, 0.05, 0.005)]
    off = [100 * pi - found for found in areas]
    assert off[0] > off[1] > off[2] > 0 and off[2] < 20 * pi * 0.005
    assert len(sheet_of(circle(1).scaled(10), 0.05).edges) >= len(sheet_of(circle(10), 0.05).edges)


def test_an_open_curve_and_one_in_space_have_lines_alone():
    for node in (path("M0 0 L 3 4"), bezier([(0, 0, 0), (1, 1, 1), (3, 0, 0)])):
        mesh = sheet_of(node, 0.05)
        assert area(mesh) == 0 and len(mesh.edges)
        assert np.ptp(mesh.bounds, axis=0).max() > 2


def test_an_outline_of_nothing_is_a_sheet_of_nothing():
    mesh = sheet_of(polygon([(0, 0), (4, 0), (0, 3)]) & polygon([(9, 9), (8, 9), (9, 8)]), 0.05)
    assert area(mesh) == 0 and not len(mesh.edges)
