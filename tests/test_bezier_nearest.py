"""The nearest points of curves against dense sampling, formulas and scipy's minimiser."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from solidtree.model.curve.bezier import derivatives, evaluated
from solidtree.model.curve.nearest import BLOCK, feet, nearest

QUARTER = np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
QUARTER_WEIGHTS = np.array([1.0, np.sqrt(0.5), 1.0])
DENSE = np.linspace(0.0, 1.0, 4001)


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
def test_no_point_of_a_dense_sampling_is_nearer(degree, axes):
    rng = np.random.default_rng([degree, axes])
    for weights in (None, 0.2 + 3.0 * rng.random(degree + 1)):
        controls, points = rng.normal(size=(degree + 1, axes)), 2.0 * rng.normal(size=(60, axes))
        t, distance = nearest(controls, points, weights)
        dense = np.linalg.norm(evaluated(controls, DENSE, weights) - points[:, None], axis=-1)
        assert (distance <= dense.min(-1) * (1.0 + 1e-14)).all()
        assert (distance >= dense.min(-1) - 1e-2).all()
        away = evaluated(controls, t, weights) - points
        assert np.allclose(np.linalg.norm(away, axis=-1), distance, rtol=1e-14)
        inside = (t > 0.0) & (t < 1.0)
        along = derivatives(controls, t, 1, weights)[1]
        assert np.abs((away * along).sum(-1))[inside].max(initial=0.0) <= 1e-13 * np.abs(along).max() * 10.0


def test_the_parameter_is_scipys():
    controls, point = np.array([[0.0, 0.0], [1.0, 3.0], [2.0, -2.0], [4.0, 1.0]]), np.array([1.0, 0.2])
    t, distance = nearest(controls, point)
    peer = minimize_scalar(
        lambda u: float(np.linalg.norm(evaluated(controls, u) - point)),
        bounds=(t - 0.1, t + 0.1),
        method="bounded",
        options={"xatol": 1e-12},
    )
    assert t == pytest.approx(peer.x, abs=1e-7)
    assert distance <= peer.fun * (1.0 + 1e-15)


def test_points_of_the_curve_are_found_on_it():
    controls = np.random.default_rng(5).random((4, 2))
    t = np.linspace(0.0, 1.0, 101)
    _, distance = nearest(controls, evaluated(controls, t))
    assert distance.max() <= 2e-15


def test_all_stationary_distances_to_a_parabola_by_formula():
    parabola = np.array([[-2.0, 4.0], [0.0, -4.0], [2.0, 4.0]])  # y = x^2 for |x| <= 2
    at, t = feet(parabola, [[0.0, 2.5], [0.0, -1.0]])
    assert np.array_equal(at, [0, 0, 0, 1])
    x = np.array([-np.sqrt(2.0), 0.0, np.sqrt(2.0)])  # 2 x^2 = 2 h - 1
    assert np.allclose(t[:3], (x + 2.0) / 4.0, rtol=0.0, atol=1e-14)
    assert t[3] == pytest.approx(0.5, abs=1e-14)


def test_on_the_evolute_where_feet_merge():
    parabola = np.array([[-2.0, 4.0], [0.0, -4.0], [2.0, 4.0]])
    t, distance = nearest(parabola, [0.0, 0.5])  # the centre of curvature of the vertex
    assert distance == pytest.approx(0.5, rel=1e-15)
    assert t == pytest.approx(0.5, abs=1e-6)


def test_the_arc_of_a_circle_and_its_centre():
    directions = np.linspace(0.1, 1.4, 9)
    points = 3.0 * np.column_stack([np.cos(directions), np.sin(directions)])
    t, distance = nearest(QUARTER, points, QUARTER_WEIGHTS)
    assert np.allclose(distance, 2.0, rtol=1e-14)
    assert np.abs(evaluated(QUARTER, t, QUARTER_WEIGHTS) - points / 3.0).max() <= 1e-14
    assert nearest(QUARTER, [0.0, 0.0], QUARTER_WEIGHTS)[1] == pytest.approx(1.0, rel=1e-15)


def test_beyond_the_ends_and_of_what_is_a_point():
    line = np.array([[0.0, 0.0], [1.0, 0.0]])
    t, distance = nearest(line, [[-3.0, 4.0], [9.0, 0.0], [0.25, 2.0]])
    assert np.array_equal(t, [0.0, 1.0, 0.25])
    assert np.array_equal(distance, [5.0, 8.0, 2.0])
    assert nearest(np.ones((4, 2)), [1.0, 3.0])[1] == 2.0


def test_any_number_and_shape_of_points():
    controls = np.random.default_rng(6).random((4, 2))
    points = np.random.default_rng(7).random((BLOCK + 5, 2))
    t, distance = nearest(controls, points)
    for i in (0, BLOCK - 1, BLOCK, BLOCK + 4):
        assert np.allclose(nearest(controls, points[i]), (t[i], distance[i]), rtol=0.0, atol=1e-14)
    assert nearest(controls, points[:6].reshape(2, 3, 2))[0].shape == (2, 3)
    assert len(nearest(controls, points[:0])[0]) == 0
