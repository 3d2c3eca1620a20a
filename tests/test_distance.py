"""Distances and nearest points, against formulas, an optimiser and brute force."""

import itertools

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize

from solidtree.model.measuring.distance import Axis, angle_between, distance, edge_angle, edge_face_angle

coordinate = st.integers(-40, 40).map(lambda number: number / 4)
points = st.tuples(coordinate, coordinate, coordinate).map(np.array)


def corners(count: int):
    return st.tuples(*[points] * count).map(np.array)


def proper(triangle: np.ndarray) -> bool:
    return bool(np.linalg.norm(np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) > 0.5)


def nearest_by_search(one: np.ndarray, other: np.ndarray) -> float:
    """The least distance of two simplices by a convex optimiser over their barycentric coordinates."""

    def gap(weights: np.ndarray) -> float:
        a, b = weights[: len(one)], weights[len(one) :]
        difference = a @ one - b @ other
        return float(difference @ difference)

    sums = [
        {"type": "eq", "fun": lambda w: w[: len(one)].sum() - 1},
        {"type": "eq", "fun": lambda w: w[len(one) :].sum() - 1},
    ]
    start = np.r_[np.full(len(one), 1 / len(one)), np.full(len(other), 1 / len(other))]
    found = minimize(
        gap,
        start,
        bounds=[(0, 1)] * len(start),
        constraints=sums,
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 300},
    )
    return float(np.sqrt(max(found.fun, 0)))


def in_hull(point: np.ndarray, simplex: np.ndarray) -> bool:
    rows = np.vstack([simplex.T, np.ones(len(simplex))])
    weights, *_ = np.linalg.lstsq(rows, np.r_[point, 1], rcond=None)
    return bool(np.allclose(rows @ weights, np.r_[point, 1], atol=1e-7) and (weights > -1e-7).all())


def thing(simplex: np.ndarray) -> np.ndarray:
    return simplex[0] if len(simplex) == 1 else simplex if len(simplex) == 2 else simplex[None]


@pytest.mark.parametrize(("m", "n"), list(itertools.combinations_with_replacement((1, 2, 3), 2)))
def test_simplices_against_an_optimiser(m, n):
    @given(corners(m), corners(n))
    def check(one, other):
        if (m == 3 and not proper(one)) or (n == 3 and not proper(other)):
            return
        found = distance(thing(one), thing(other))
        assert found.length == pytest.approx(np.linalg.norm(found.delta))
        assert in_hull(np.array(found.a), one) and in_hull(np.array(found.b), other)
        # The points are on both things, so that their distance cannot be too small; it must not be too large.
        assert found.length <= nearest_by_search(one, other) + 1e-4
        turned = distance(thing(other), thing(one))
        assert turned.length == pytest.approx(found.length, abs=1e-9)
        assert in_hull(np.array(turned.a), other)

    check()


def test_degenerate_edges_and_triangles_are_points_and_edges():
    point = np.array([1.0, 2, 3])
    edge = np.array([[0.0, 0, 0], [0, 0, 9]])
    assert distance(np.array([point, point]), edge).length == pytest.approx(np.sqrt(5))
    assert distance(np.array([[point, point, point]]), edge).length == pytest.approx(np.sqrt(5))
    line = np.array([[edge[0], edge[1], edge[1]]])
    assert distance(point, line).b == pytest.approx((0, 0, 3))
    assert distance(line, line).length == 0


@given(points, points, corners(2), corners(3))
def test_an_axis_has_no_ends(point, direction, edge, triangle):
    size = np.linalg.norm(direction)
    if size < 0.5 or not proper(triangle):
        return
    axis = Axis(tuple(point), tuple(direction / size))
    long = np.array([point - 1e4 * direction, point + 1e4 * direction])
    for other in (edge[0], edge, triangle[None]):
        found = distance(axis, other)
        assert found.length == pytest.approx(distance(long, other).length, abs=1e-6)
        assert np.linalg.norm(np.cross(np.array(found.a) - point, direction / size)) < 1e-6
        assert distance(other, axis).length == pytest.approx(found.length, abs=1e-12)


def test_axes():
    upright, leaning = Axis((0, 0, 0), (0, 0, 1)), Axis((3, 0, 5), (0, 1, 0))
    found = distance(upright, leaning)
    assert (found.a, found.b, found.length) == ((0, 0, 5), (3, 0, 5), 3)
    assert distance(upright, Axis((3, 4, 9), (0, 0, -1))).length == pytest.approx(5)
    assert distance(upright, Axis((3, 4, 9), (0, 0, -1))).delta == pytest.approx((3, 4, 0))


def test_faces_of_thousands_of_triangles_against_brute_force():
    one = trimesh.creation.icosphere(4, 5.0)
    other = trimesh.creation.icosphere(4, 3.0)
    other.apply_translation((9, 4, 2))
    assert len(one.faces) == 5120
    found = distance(one.triangles, other.triangles)
    # No corner of the one is nearer to a facet of the other.
    near = one.vertices[np.linalg.norm(one.vertices - found.a, axis=1) < 0.5]
    every = np.repeat(other.triangles, len(near), axis=0), np.tile(near, (len(other.faces), 1))
    corner = np.linalg.norm(trimesh.triangles.closest_point(*every) - every[1], axis=1).min()
    apart = np.sqrt(101) - 8
    assert apart <= found.length <= corner + 1e-12 and found.length == pytest.approx(apart, abs=0.03)
    for mesh, point in ((one, found.a), (other, found.b)):
        foot = trimesh.triangles.closest_point(mesh.triangles, np.tile(point, (len(mesh.faces), 1)))
        assert np.linalg.norm(foot - point, axis=1).min() < 1e-9


def test_many_triangles_give_what_all_pairs_give():
    chance = np.random.default_rng(3)
    for shift in (0.0, 3.0, 12.0):
        one = chance.random((14, 1, 3)) * 6 + chance.random((14, 3, 3))
        other = chance.random((11, 1, 3)) * 6 + chance.random((11, 3, 3)) + (shift, 0, 0)
        every = min(distance(a[None], b[None]).length for a in one for b in other)
        assert distance(one, other).length == pytest.approx(every, abs=1e-12)


def test_what_meets_is_nowhere_apart():
    floor = np.array([[(-5.0, -5, 0), (5, -5, 0), (0, 9, 0)]])
    through = np.array([(0.0, 0, -1), (0, 0, 4)])
    found = distance(through, floor)
    assert found.length == 0 and found.a == found.b == pytest.approx((0, 0, 0))
    assert distance(Axis((1, 0, 9), (0, 0, 1)), floor).length == 0
    assert distance(floor, floor + np.array([0, 0, 2])).delta == pytest.approx((0, 0, 2))


def test_angles_are_exact_near_their_ends():
    assert angle_between((1, 0, 0), (0, 5, 0)) == pytest.approx(90, abs=1e-13)
    assert angle_between((1, 0, 0), (-2, 0, 0)) == pytest.approx(180, abs=1e-13)
    small = np.radians(1e-7)
    assert angle_between((1, 0, 0), (np.cos(small), np.sin(small), 0)) == pytest.approx(1e-7, rel=1e-6)
    assert edge_angle((1, 0, 0), (-1, 1, 0)) == pytest.approx(45)
    assert edge_face_angle((1, 0, 1), (0, 0, -1)) == pytest.approx(45)
    assert edge_face_angle((0, 1, 0), (0, 0, 1)) == pytest.approx(0, abs=1e-13)


def test_other_shapes_are_refused():
    for wrong in (np.zeros((4, 3)), np.zeros((0, 3, 3)), np.zeros(2)):
        with pytest.raises(ValueError, match="are needed"):
            distance(wrong, np.zeros(3))
