"""Bezier curves: affine invariance, formulas, mpmath's figures from the corpus, scipy's Bernstein polynomials."""

import json
from itertools import pairwise
from math import comb

import numpy as np
import pytest
from scipy.interpolate import BPoly

from solidtree.model.curve.affine import barycentric, combined, interpolated
from solidtree.model.curve.bernstein import basis, product, roots, value
from solidtree.model.curve.bezier import (
    BLOCK,
    basis_values,
    bounds,
    derivatives,
    evaluated,
    extracted,
    hodograph,
    homogeneous,
    levels,
    of_polynomial,
    polynomial,
    projected,
    split,
)
from solidtree.model.curve.degree import elevated, farthest, reduced
from solidtree.model.curve.differential import curvatures, inflections, normals, tangents
from solidtree.model.document.errors import Refusal

T = np.linspace(-0.25, 1.25, 61)
INSIDE = np.linspace(0.0, 1.0, 41)
QUARTER = np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
QUARTER_WEIGHTS = np.array([1.0, np.sqrt(0.5), 1.0])


def curve(degree: int, axes: int = 2, seed: int = 0) -> np.ndarray:
    return np.random.default_rng([seed, degree, axes]).normal(size=(degree + 1, axes)) * 10.0


def test_collinear_points_stay_collinear_in_the_same_ratio_under_any_affine_map():
    rng = np.random.default_rng(1)
    start, end, shares = rng.normal(size=3), rng.normal(size=3), rng.normal(size=20)
    for _ in range(10):
        matrix, shift = rng.normal(size=(3, 3)), rng.normal(size=3)
        mapped = interpolated(start, end, shares[:, None]) @ matrix.T + shift
        expected = interpolated(start @ matrix.T + shift, end @ matrix.T + shift, shares[:, None])
        assert np.allclose(mapped, expected, rtol=0.0, atol=1e-13)


def test_interpolation_meets_its_ends_exactly():
    assert interpolated(0.1, 0.7, 1.0) == 0.7
    assert interpolated(0.1, 0.7, 0.0) == 0.1


def test_barycentric_coordinates_make_the_point_again():
    corners = np.array([[0.0, 0.0], [4.0, 1.0], [1.0, 3.0]])
    points = np.array([[1.0, 1.0], [-3.0, 7.0], [4.0, 1.0]])
    weights = barycentric(points, corners)
    assert np.allclose(weights[2], [0.0, 1.0, 0.0])
    assert np.allclose(combined(corners, weights), points, rtol=0.0, atol=1e-13)


def test_weights_that_do_not_add_up_to_one_are_refused():
    with pytest.raises(Refusal, match="add up to 1"):
        combined([[0.0, 0.0], [1.0, 0.0]], [0.5, 0.6])
    with pytest.raises(Refusal, match="do not lie on one"):
        barycentric([1.0, 1.0], [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]])


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 9, 20])
@pytest.mark.parametrize("axes", [2, 3])
def test_points_are_scipys_and_de_casteljaus(degree, axes):
    controls = curve(degree, axes)
    peer = BPoly(controls[:, None], [0.0, 1.0])
    size = np.abs(controls).max()
    assert np.abs(evaluated(controls, INSIDE) - peer(INSIDE)).max() <= 1e-14 * size
    assert np.abs(evaluated(controls, INSIDE) - levels(controls, INSIDE)[-1][:, 0]).max() <= 1e-14 * size
    assert (evaluated(controls, [0.0, 1.0]) == controls[[0, -1]]).all()


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_derivatives_are_scipys(degree):
    controls = curve(degree)
    found = derivatives(controls, INSIDE, degree + 1)
    for order in range(degree + 1):
        peer = BPoly(controls[:, None], [0.0, 1.0]).derivative(order) if order else BPoly(controls[:, None], [0, 1])
        assert np.abs(found[order] - peer(INSIDE)).max() <= 1e-12 * np.abs(peer(INSIDE)).max()
    assert not found[degree + 1].any()


def test_a_curve_maps_as_its_control_points_do():
    controls, matrix, shift = curve(4, 3), np.random.default_rng(2).normal(size=(3, 3)), np.array([5.0, -2.0, 1.0])
    mapped = evaluated(controls @ matrix.T + shift, T)
    assert np.allclose(mapped, evaluated(controls, T) @ matrix.T + shift, rtol=0.0, atol=1e-11)


def test_many_curves_and_many_parameters_are_broadcast():
    controls = np.stack([curve(3, 2, seed) for seed in range(5)])
    own = np.random.default_rng(3).random((5, 7))
    each = evaluated(controls, own)
    assert each.shape == (5, 7, 2)
    assert np.array_equal(evaluated(controls, 0.3).shape, (5, 2))
    for i in range(5):
        assert np.allclose(each[i], evaluated(controls[i], own[i]), rtol=0.0, atol=1e-14)
        assert np.allclose(evaluated(controls, own[0])[i], evaluated(controls[i], own[0]), rtol=0.0, atol=1e-14)


def test_more_parameters_than_a_block_make_the_same_points():
    t = np.random.default_rng(4).random(2 * BLOCK + 17)
    controls = curve(3)
    assert np.abs(evaluated(controls, t) - basis(3, t) @ controls).max() <= 1e-14 * np.abs(controls).max()


def test_all_levels_of_de_casteljau_lie_on_the_lines_of_the_level_before():
    controls, t = curve(4), 0.3
    rows = levels(controls, t)
    assert [len(row) for row in rows] == [5, 4, 3, 2, 1]
    for before, row in pairwise(rows):
        assert np.allclose(row, 0.7 * before[:-1] + 0.3 * before[1:])
    assert levels(controls, [0.1, 0.2, 0.3])[2].shape == (3, 3, 2)
    assert np.allclose(levels(controls, [0.1, t])[2][1], rows[2])


def test_the_values_of_the_basis_are_binomial_probabilities():
    values = basis(5, 0.3)
    assert np.allclose(values, [comb(5, i) * 0.3**i * 0.7 ** (5 - i) for i in range(6)], rtol=1e-14)
    weighted = basis_values(2, INSIDE, QUARTER_WEIGHTS)
    assert np.allclose(weighted.sum(-1), 1.0, rtol=0.0, atol=1e-15)
    assert np.allclose(weighted @ QUARTER, evaluated(QUARTER, INSIDE, QUARTER_WEIGHTS), rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 8])
def test_splitting_and_extracting_leave_the_curve(degree):
    controls = curve(degree, 3)
    size = np.abs(controls).max()
    left, right = split(controls, 0.3)
    assert np.array_equal(left[-1], right[0])
    assert np.abs(evaluated(left, INSIDE) - evaluated(controls, 0.3 * INSIDE)).max() <= 1e-14 * size
    assert np.abs(evaluated(right, INSIDE) - evaluated(controls, 0.3 + 0.7 * INSIDE)).max() <= 1e-14 * size
    for start, end in ((0.2, 0.9), (0.9, 0.2), (-0.25, 1.25), (1.0, 0.0), (0.5, 0.5)):
        part = evaluated(extracted(controls, start, end), INSIDE)
        expected = evaluated(controls, start + (end - start) * INSIDE)
        assert np.abs(part - expected).max() <= 1e-13 * np.abs(expected).max()
    assert np.array_equal(extracted(controls, 0.0, 1.0), controls)
    assert np.array_equal(extracted(controls, 1.0, 0.0), controls[::-1])


def test_each_of_many_curves_has_its_own_part():
    controls = np.stack([curve(3, 2, seed) for seed in range(3)])
    start, end = np.array([0.0, 0.1, 0.5]), np.array([0.4, 1.0, 0.2])
    parts = extracted(controls, start, end)
    for i in range(3):
        assert np.allclose(parts[i], extracted(controls[i], start[i], end[i]), rtol=0.0, atol=1e-14)
    assert extracted(controls[0], start, end).shape == (3, 4, 2)


@pytest.mark.parametrize("degree", [0, 1, 3, 7])
def test_power_form_and_back(degree):
    controls = curve(degree)
    powers = polynomial(controls)
    assert np.allclose(T[:, None] ** np.arange(degree + 1) @ powers, evaluated(controls, T), rtol=1e-11, atol=1e-11)
    assert np.allclose(of_polynomial(powers), controls, rtol=0.0, atol=1e-11)


def test_elevation_leaves_the_curve_and_reduction_takes_it_back():
    controls = curve(3, 3)
    higher = elevated(controls, 4)
    size = np.abs(controls).max()
    assert len(higher) == 8
    assert np.abs(evaluated(higher, INSIDE) - evaluated(controls, INSIDE)).max() <= 1e-14 * size
    lower, deviation = reduced(higher, 4)
    assert np.abs(lower - controls).max() <= 1e-12 * size
    assert deviation <= 1e-13 * size
    assert elevated(np.stack([controls, controls])).shape == (2, 5, 3)


@pytest.mark.parametrize(("degree", "times"), [(2, 1), (3, 1), (3, 2), (5, 2), (25, 3)])
def test_reduction_keeps_the_ends_is_the_best_and_tells_the_greatest_deviation(degree, times):
    controls = curve(degree)
    lower, deviation = reduced(controls, times)
    assert np.array_equal(lower[[0, -1]], controls[[0, -1]])
    t = np.linspace(0.0, 1.0, 20001)
    away = np.linalg.norm(evaluated(lower, t) - evaluated(controls, t), axis=-1)
    assert away.max() <= deviation * (1.0 + 1e-12)
    assert deviation <= away.max() * (1.0 + 1e-5)
    rng = np.random.default_rng(5)
    for _ in range(5 if len(lower) > 2 else 0):
        other = lower.copy()
        other[1:-1] += 1e-3 * rng.normal(size=other[1:-1].shape)
        assert (np.linalg.norm(evaluated(other, t) - evaluated(controls, t), axis=-1) ** 2).mean() > (away**2).mean()


def test_degree_one_is_not_reduced():
    with pytest.raises(Refusal, match="degree 1 is the least"):
        reduced([[0.0, 0.0], [1.0, 1.0]])


def test_the_greatest_distance_of_a_curve_from_itself_is_zero():
    assert farthest(curve(3), curve(3)) == 0.0


def test_bounds_are_those_of_the_corpus(corpus):
    cases = list(json.loads((corpus / "curves/bezier_dhermes.json").read_text())["curves"].values())
    assert len(cases) == 34
    kurbo = json.loads((corpus / "curves/bezier_kurbo.json").read_text())["cases"]
    for case in [*cases, *({**case, "bbox": case["mp_bbox"]} for case in kurbo)]:
        controls = np.array(case["points"])
        assert np.abs(bounds(controls).ravel() - case["bbox"]).max() <= 1e-15 * np.abs(controls).max()


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 6])
def test_bounds_hold_all_points_and_no_more(degree):
    controls = np.stack([curve(degree, 3, seed) for seed in range(20)])
    box = bounds(controls)
    dense = evaluated(controls, np.linspace(0.0, 1.0, 20001))
    size = np.abs(controls).max()
    assert box.shape == (20, 2, 3)
    assert (dense.min(1) >= box[:, 0] - 1e-13 * size).all()
    assert (dense.max(1) <= box[:, 1] + 1e-13 * size).all()
    assert np.abs(np.stack([dense.min(1), dense.max(1)], 1) - box).max() <= 1e-6 * size


def test_bounds_of_a_rational_arc_are_those_of_the_circle():
    third = np.array([[np.cos(np.pi / 6), 0.5], [0.0, 2.0], [-np.cos(np.pi / 6), 0.5]])
    box = bounds(third, [1.0, 0.5, 1.0])
    assert np.abs(box - [[-np.cos(np.pi / 6), 0.5], [np.cos(np.pi / 6), 1.0]]).max() <= 1e-15


def test_a_rational_quadratic_is_the_circle():
    points = evaluated(QUARTER, INSIDE, QUARTER_WEIGHTS)
    assert np.abs(np.linalg.norm(points, axis=-1) - 1.0).max() <= 4e-16
    assert np.abs(curvatures(QUARTER, INSIDE, QUARTER_WEIGHTS) - 1.0).max() <= 1e-13
    assert np.abs(normals(QUARTER, INSIDE, QUARTER_WEIGHTS) + points).max() <= 1e-14
    left, weights = projected(split(homogeneous(QUARTER, QUARTER_WEIGHTS), 0.3)[0])
    assert np.abs(np.linalg.norm(evaluated(left, INSIDE, weights), axis=-1) - 1.0).max() <= 4e-16


def test_rational_derivatives_are_difference_quotients():
    controls, weights = curve(3, 3), np.array([1.0, 2.5, 0.4, 1.2])
    step = 1e-4
    found = derivatives(controls, 0.4, 3, weights)
    stencil = derivatives(controls, 0.4 + step * np.array([-1.0, 1.0]), 2, weights)
    for order in range(3):
        slope = (stencil[order, 1] - stencil[order, 0]) / (2.0 * step)
        assert np.allclose(found[order + 1], slope, rtol=1e-5)


@pytest.mark.parametrize("weights", [[1.0, 0.0, 1.0], [1.0, -1.0, 1.0], [1.0, np.nan, 1.0], [1.0, 1.0]])
def test_weights_are_above_zero_and_one_for_each_point(weights):
    with pytest.raises(Refusal, match="weight"):
        evaluated(QUARTER, 0.5, weights)


def test_curvature_of_the_parabola_by_formula():
    parabola = np.array([[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0]])  # y = x^2
    x = evaluated(parabola, INSIDE)[:, 0]
    assert np.allclose(curvatures(parabola, INSIDE), 2.0 / (1.0 + 4.0 * x**2) ** 1.5, rtol=1e-13)
    in_space = np.column_stack([parabola, 2.0 * parabola[:, 0]])
    assert (curvatures(in_space[::-1], INSIDE) > 0.0).all()
    assert np.allclose(curvatures(parabola[::-1], INSIDE), -curvatures(parabola, INSIDE)[::-1], rtol=1e-13)


def test_tangents_go_on_where_the_derivative_is_zero():
    handle_in = np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 2.0], [3.0, 2.0]])
    assert np.allclose(tangents(handle_in, 0.0), np.array([1.0, 2.0]) / np.sqrt(5.0))
    assert np.allclose(tangents(handle_in[::-1], 1.0), -np.array([1.0, 2.0]) / np.sqrt(5.0))
    assert np.allclose(tangents(handle_in[::-1], [0.0, 1.0])[0], [-1.0, 0.0])
    cusp = np.array([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]])
    assert np.allclose(tangents(cusp, 0.5), [0.0, -1.0])
    assert not tangents(np.ones((3, 2)), INSIDE).any()


def test_curvature_where_the_derivative_is_zero_is_the_limit():
    assert curvatures([[0.0, 0.0], [0.0, 0.0], [1.0, 2.0], [3.0, 2.0]], 0.0) == -np.inf
    assert curvatures([[3.0, 2.0], [1.0, 2.0], [0.0, 0.0], [0.0, 0.0]], 1.0) == np.inf
    assert curvatures([[0.0, 0.0], [0.0, 0.0], [1.0, 2.0], [2.0, 4.0]], 0.0) == 0.0
    # (t^2, t^4) is the parabola again, run with a start at rest: curvature 2 at its vertex.
    at_rest = of_polynomial([[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]])
    assert curvatures(at_rest, 0.0) == pytest.approx(2.0, rel=1e-12)
    assert curvatures(at_rest[::-1], 1.0) == pytest.approx(-2.0, rel=1e-12)
    assert np.array_equal(curvatures([[0.0, 0.0], [1.0, 3.0]], INSIDE), np.zeros(len(INSIDE)))


def test_the_principal_normal_in_space_points_to_the_centre():
    points = np.column_stack([QUARTER, np.zeros(3)])
    found = normals(points, INSIDE, QUARTER_WEIGHTS)
    assert np.abs(found + evaluated(points, INSIDE, QUARTER_WEIGHTS)).max() <= 1e-14
    assert not normals([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]], INSIDE).any()


def test_inflections_are_where_the_curvature_changes_its_sign():
    assert np.allclose(inflections([[0.0, 0.0], [1.0, 1.0], [2.0, -1.0], [3.0, 0.0]]), [0.5], rtol=0.0, atol=1e-15)
    assert len(inflections([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]])) == 0  # a cusp
    assert len(inflections([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [5.0, 5.0]])) == 0
    for seed in range(30):
        controls = curve(5, 2, seed)
        t = np.linspace(0.0, 1.0, 4001)
        for weights in (None, np.array([1.0, 3.0, 0.5, 1.0, 2.0, 1.0])):
            signs = np.sign(curvatures(controls, t, weights))
            seen = t[1:][signs[1:] != signs[:-1]]
            found = inflections(controls, weights)
            assert len(found) == len(seen)
            assert np.abs(found - seen).max(initial=0.0) <= 1.0 / 4000


def test_inflections_of_a_rational_curve_with_equal_weights_are_those_without():
    controls = curve(5, 2, 7)
    assert np.allclose(inflections(controls, np.full(6, 2.0)), inflections(controls), rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("count", range(1, 9))
def test_roots_are_those_that_the_polynomial_was_made_of(count):
    rng = np.random.default_rng(count)
    for _ in range(20):
        wanted = np.sort((np.arange(count) + 0.1 + 0.8 * rng.random(count)) / count)
        coefficients = np.ones(1)
        for root in wanted:
            coefficients = product(coefficients, [-root, 1.0 - root])
        rows, t = roots(np.stack([coefficients, -coefficients, np.zeros_like(coefficients)]))
        assert np.array_equal(rows, np.repeat([0, 1], count))
        assert np.abs(t - np.tile(wanted, 2)).max() <= 1e-9


def test_double_and_triple_roots_and_those_at_the_ends_come_once():
    for root, times in ((0.3, 2), (1.0 / 3.0, 3), (0.0, 1), (1.0, 2), (0.0, 3)):
        coefficients = np.array([0.2, 1.0])
        for _ in range(times):
            coefficients = product(coefficients, [-root, 1.0 - root])
        _, t = roots(coefficients[None])
        assert len(t) == 1
        assert abs(t[0] - root) <= 1e-11


def test_values_and_products_of_polynomials():
    rng = np.random.default_rng(6)
    first, second = rng.normal(size=(4, 3)), rng.normal(size=(4, 5))
    t = rng.random(4)
    assert np.allclose(value(product(first, second), t), value(first, t) * value(second, t), rtol=0.0, atol=1e-14)


def test_the_hodograph_above_the_degree_is_zero():
    assert not hodograph(curve(2), 3).any()
    assert hodograph(curve(2), 3).shape == (1, 2)
