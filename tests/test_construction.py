"""Constructions of points: the levels, strings, polynomials, basis and chords of segments, by formula."""

import numpy as np
import pytest

from solidtree.model.curve import bezier
from solidtree.model.document.errors import Refusal
from solidtree.model.outline.construction import construct, kind_of, points_at, segment_at, steps, strings
from solidtree.model.outline.paths import path_of
from solidtree.model.script import bezier as bezier_node
from solidtree.model.script import bspline, circle, construction, path, rectangle
from solidtree.model.spline.bspline import BSpline, derivatives

CUBIC = np.array([(0.0, 0.0), (10.0, 30.0), (40.0, 30.0), (50.0, -5.0)])
SPACE = np.array([(0.0, 0.0, 1.0), (10.0, 30.0, 4.0), (40.0, 30.0, -9.0)])
FIFTH = path_of(bezier_node([(0, 0), (5, 20), (15, -8), (30, 22), (44, 3), (50, 10)])).contours[0].segment(0)
RATIONAL = path_of(bezier_node([(0, 0), (5, 20), (15, -8)], weights=[1, 3, 0.5])).contours[0].segment(0)
UNEVEN = BSpline(CUBIC[[0, 1, 2, 3, 1, 0]], 3, np.array([0, 0, 0, 0, 1, 4, 5, 5, 5, 5.0]))
LOOSE = BSpline(CUBIC[[0, 1, 2, 3, 1, 0]], 2, np.arange(9.0), np.array([1, 2, 1, 0.5, 1, 3.0]))
ROUND = path_of(circle(5)).contours[0].segment(0)
SEGMENTS = {"line": CUBIC[:2], "quadratic": SPACE, "cubic": CUBIC, "fifth": FIFTH, "rational": RATIONAL,
            "uneven": UNEVEN, "loose": LOOSE, "round": ROUND}  # fmt: skip
PLACES = (0.0, 0.21, 0.5, 0.8, 1.0)


@pytest.fixture(params=SEGMENTS)
def segment(request):
    return SEGMENTS[request.param]


@pytest.mark.parametrize("t", PLACES)
def test_levels_lose_a_point_each_and_end_in_the_point_of_the_curve(segment, t):
    made = construct(segment, t)
    assert [len(level) for level in made.levels] == list(range(made.degree + 1, 0, -1))
    np.testing.assert_allclose(made.point, points_at(segment, np.array([t]))[0], atol=1e-12)
    controls = segment if isinstance(segment, np.ndarray) else segment.points
    np.testing.assert_array_equal(made.levels[0], controls[made.first : made.first + made.degree + 1])


@pytest.mark.parametrize("t", PLACES)
def test_the_basis_sums_to_one_and_weighs_the_control_points_to_the_point(segment, t):
    made = construct(segment, t)
    assert made.basis.sum() == pytest.approx(1.0, abs=1e-14)
    assert (made.basis >= 0.0).all()
    np.testing.assert_allclose(made.basis @ made.levels[0], made.point, atol=1e-12)


@pytest.mark.parametrize("t", PLACES)
def test_the_polynomial_has_the_value_of_the_point(segment, t):
    made = construct(segment, t)
    powers = made.u ** np.arange(made.degree + 1)
    bottom = 1.0 if made.denominator is None else powers @ made.denominator
    np.testing.assert_allclose(powers @ made.polynomial / bottom, made.point, atol=1e-11)


@pytest.mark.parametrize("t", PLACES)
def test_the_tangent_goes_along_the_derivative(segment, t):
    made = construct(segment, t)
    if isinstance(segment, np.ndarray):
        slope = bezier.derivatives(segment, t, 1)[1]
    else:
        slope = derivatives(segment, np.array([made.parameter]), 1)[1, 0]
    np.testing.assert_allclose(made.tangent, slope / np.linalg.norm(slope), atol=1e-12)


def test_strings_touch_the_curve_where_they_are_made(segment):
    lines = strings(segment, 11)
    if kind_of(segment) == "line":
        assert lines.shape == (0, 2, 2)
        return
    assert lines.shape == (11, 2, segment.shape[1] if isinstance(segment, np.ndarray) else segment.dimension)
    for t, (begin, end) in zip(np.linspace(0, 1, 11), lines, strict=True):
        made = construct(segment, float(t))
        along = (end - begin) / np.linalg.norm(end - begin)
        assert abs(along @ made.tangent) == pytest.approx(1.0, abs=1e-12)
        share = (made.point - begin) @ along
        np.testing.assert_allclose(begin + share * along, made.point, atol=1e-12)
        assert -1e-12 <= share <= np.linalg.norm(end - begin) + 1e-12


def test_no_strings_are_no_strings():
    assert strings(CUBIC, 0).shape == (0, 2, 2)


@pytest.mark.parametrize("count", [1, 2, 7])
def test_a_parabola_leaves_its_chords_by_an_eighth_of_the_second_derivative(count):
    # y = x² over x from -1 to 1: a chord of width w stays w² / 4 above it, measured upright.
    parabola = np.array([(-1.0, 1.0), (0.0, -1.0), (1.0, 1.0)])
    points, deviation = steps(parabola, count)
    x = np.linspace(-1, 1, count + 1)
    np.testing.assert_allclose(points, np.column_stack((x, x * x)), atol=1e-14)
    slopes = x[:-1] + x[1:]
    upright = (2 / count) ** 2 / 4
    assert deviation == pytest.approx((upright / np.sqrt(1 + slopes**2)).max(), rel=1e-9)


def test_the_steps_of_a_circle_stay_inside_it_by_the_formula_of_the_arc():
    points, deviation = steps(ROUND, 4)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 5, atol=1e-12)
    assert deviation == pytest.approx(5 * (1 - np.cos(np.pi / 4)), rel=1e-9)


def test_a_point_cuts_a_bezier_curve_into_its_halves():
    before, after = construct(CUBIC, 0.3).halves
    expected = bezier.split(CUBIC, 0.3)
    np.testing.assert_allclose(before, expected[0], atol=1e-14)
    np.testing.assert_allclose(after, expected[1], atol=1e-14)


def test_in_a_b_spline_the_control_points_and_the_interval_are_those_about_t():
    made = construct(UNEVEN, 0.5)
    assert (made.first, made.interval, made.parameter) == (1, (1.0, 4.0), 2.5)
    assert made.u == 0.5
    assert construct(UNEVEN, 1.0).interval == (4.0, 5.0)
    assert not made.plain
    assert construct(FIFTH, 0.5).plain
    assert not construct(RATIONAL, 0.5).plain


def test_segments_are_named():
    names = {name: kind_of(segment) for name, segment in SEGMENTS.items()}
    assert names == {
        "line": "line",
        "quadratic": "quadratic",
        "cubic": "cubic",
        "fifth": "Bezier curve of degree 5",
        "rational": "rational Bezier curve of degree 2",
        "uneven": "B-spline of degree 3",
        "loose": "rational B-spline of degree 2",
        "round": "rational B-spline of degree 2",
    }


def test_scripts_construct_on_the_outline_where_it_is_placed():
    shape = path([("move", (0, 0)), ("line", (10, 0)), ("quad", (20, 0), (20, 10)), ("close",)]).at(100)
    made = construction(shape, 0.5, segment=1)
    np.testing.assert_allclose(made.point, (117.5, 2.5))
    assert construction(bspline([(0, 0), (10, 10), (20, 0), (30, 10)]), 0.25).degree == 3


def test_what_is_not_there_is_refused_in_words():
    shape = path_of(rectangle(4, 3))
    with pytest.raises(Refusal, match="no contour 1: the outline has 1 contour"):
        segment_at(shape, 1, 0)
    with pytest.raises(Refusal, match="no segment 4: contour 0 has 4 segments"):
        segment_at(shape, 0, 4)
    with pytest.raises(Refusal, match="t is from 0 to 1"):
        construct(CUBIC, 1.5)
