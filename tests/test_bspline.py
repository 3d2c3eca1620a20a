"""B-splines: points, derivatives and basis against scipy, the published values, exact circles, and what is refused."""

import json
from pathlib import Path

import numpy as np
import pytest
import scipy.interpolate
from hypothesis import given, settings
from hypothesis import strategies as st

from solidtree.model.document.errors import Refusal
from solidtree.model.path.path import Contour
from solidtree.model.spline import bspline, decomposition, knots
from solidtree.model.spline.bspline import BSpline


def random_spline(seed: int, degree: int, count: int, kind: str, rational: bool) -> BSpline:
    """Clamped with repeated knots, open with uneven ones, or periodic."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1.0, 1.0, (count, 2 + seed % 2))
    weights = rng.uniform(0.5, 2.0, count) if rational else None
    if kind == "periodic":
        return knots.closed(points, degree, rng.uniform(0.2, 1.0, count), weights)
    if kind == "open":
        return BSpline(points, degree, np.cumsum(rng.uniform(0.1, 1.0, count + degree + 1)), weights)
    inner = np.repeat(np.sort(rng.uniform(0.05, 0.95, count)), rng.integers(1, degree + 1, count))[: count - degree - 1]
    return BSpline(points, degree, np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)]), weights)


@st.composite
def splines(draw: st.DrawFn, highest: int = 7) -> BSpline:
    degree = draw(st.integers(1, highest))
    count = draw(st.integers(degree + 1, degree + 12))
    kind = draw(st.sampled_from(["clamped", "open", "periodic"]))
    return random_spline(draw(st.integers(0, 10**6)), degree, count, kind, draw(st.booleans()))


def inside(spline: BSpline, count: int = 101) -> np.ndarray:
    start, end = spline.domain
    return start + (end - start) * np.linspace(0.0, 1.0, count)


@settings(deadline=None)
@given(splines())
def test_points_and_derivatives_are_those_of_scipy(spline):
    t = inside(spline)
    if spline.weights is None:
        peer = scipy.interpolate.BSpline(spline.knots, spline.points, spline.degree)
        made = bspline.derivatives(spline, t, 3)
        for k in range(min(3, spline.degree) + 1):
            wanted = peer(t[:-1], nu=k)  # at its end scipy takes what comes after where a knot ends there
            assert np.abs(made[k, :-1] - wanted).max() <= 1e-13 * max(1.0, np.abs(wanted).max())
        assert not made[spline.degree + 1 :].any()
    else:
        above = scipy.interpolate.BSpline(spline.knots, spline.lifted, spline.degree)(t)
        assert np.abs(bspline.evaluated(spline, t) - above[:, :-1] / above[:, -1:]).max() <= 1e-13


@settings(deadline=None)
@given(splines())
def test_rational_derivatives_are_the_slope_of_the_points(spline):
    start, end = spline.domain
    middles = np.convolve(knots.breaks(spline)[0], [0.5, 0.5], "valid")
    step = 1e-5 * (end - start) * np.diff(knots.breaks(spline)[0]).min() / (end - start)
    slope = (bspline.evaluated(spline, middles + step) - bspline.evaluated(spline, middles - step)) / (2 * step)
    made = bspline.derivatives(spline, middles, 1)[1]
    assert np.abs(made - slope).max() <= 1e-6 * np.abs(made).max() + 1e-9 / step


@settings(deadline=None)
@given(splines())
def test_basis_sums_to_one_and_gives_the_points(spline):
    t = inside(spline)
    values = bspline.basis(spline, t)
    assert values.min() >= 0.0
    assert np.abs(values.sum(1) - 1.0).max() <= 1e-14
    assert np.abs(values @ spline.points - bspline.evaluated(spline, t)).max() <= 1e-13


@settings(deadline=None)
@given(splines())
def test_construction_ends_at_the_point(spline):
    t = inside(spline, 21)
    rows = bspline.levels(spline, t)
    assert [row.shape[1] for row in rows] == list(range(spline.degree + 1, 0, -1))
    assert np.abs(rows[-1][:, 0] - bspline.evaluated(spline, t)).max() <= 1e-13


@settings(deadline=None)
@given(splines())
def test_reversed_is_the_same_curve(spline):
    start, end = spline.domain
    t = inside(spline, 50)[1:-1]
    back = spline.reversed()
    assert back.domain == spline.domain
    assert np.abs(bspline.evaluated(back, start + end - t) - bspline.evaluated(spline, t)).max() <= 1e-12


def test_many_parameters_are_evaluated_in_blocks_alike():
    spline = random_spline(3, 3, 12, "clamped", True)
    t = np.linspace(0.0, 1.0, 3 * bspline.BLOCK + 5)
    assert (bspline.evaluated(spline, t)[-7:] == bspline.evaluated(spline, t[-7:])).all()
    assert bspline.evaluated(spline, t.reshape(-1, 1)).shape == (len(t), 1, spline.dimension)
    assert bspline.evaluated(spline, 0.5).shape == (spline.dimension,)


def test_corpus(corpus: Path):
    cases = json.loads((corpus / "curves" / "nurbs.json").read_text())
    checked = 0
    for case in cases:
        at = np.array(case["knots"], float)
        if "basis_published" in case:
            shape = BSpline(np.eye(len(at) - case["degree"] - 1), case["degree"], at)
            values, slopes = bspline.derivatives(shape, case["u"], 1)
            here = slice(case["span"] - case["degree"], case["span"] + 1)
            assert np.abs(values[here] - case["basis_published"]).max() <= 1e-15
            assert np.abs(slopes[here] - case["derivative_published"]).max() <= 1e-15
            assert bspline.spans(at, case["degree"], case["u"]) == case["span"]
            checked += 1
            continue
        spline = BSpline(np.array(case["points"], float), case["degree"], at, case["weights"])
        for row in case["eval"]:
            made = bspline.derivatives(spline, row["u"], 3)
            for k, name in enumerate(("scipy", "scipy_d1", "scipy_d2", "scipy_d3")):
                if name in row:
                    largest = max(np.abs(other[name]).max() for other in case["eval"] if name in other)
                    assert np.abs(made[k] - row[name]).max() <= 1e-13 * largest
            assert np.abs(made[0] - row["published"]).max() <= row["published_diff"] + 1e-12
            checked += 1
    assert checked >= 10


def circle() -> BSpline:
    square = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    weights = np.where(np.arange(9) % 2, np.sqrt(0.5), 1.0)
    return BSpline(np.array(square, float) * 10.0, 2, np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]), weights)


def test_circle_of_rational_quadratics_is_exact():
    spline = circle()
    t = np.linspace(0.0, 4.0, 1001)
    points, along, _ = bspline.derivatives(spline, t, 2)
    assert np.abs(np.linalg.norm(points, axis=1) - 10.0).max() <= 1e-14 * 10.0
    assert np.abs((points * along).sum(1)).max() <= 1e-12
    assert decomposition.length(spline) == pytest.approx(20.0 * np.pi, rel=1e-14)
    assert np.abs(decomposition.bounds(spline) - [[-10, -10], [10, 10]]).max() <= 1e-14
    assert np.abs(decomposition.parameters_at(spline, 5.0 * np.pi * np.arange(5)) - np.arange(5)).max() <= 1e-13
    outside = 25.0 * np.stack([np.cos([0.3, 2.0, 5.0]), np.sin([0.3, 2.0, 5.0])], 1)
    t, away = decomposition.nearest(spline, outside)
    assert np.abs(away - 15.0).max() <= 1e-13
    assert np.abs(bspline.evaluated(spline, t) * 2.5 - outside).max() <= 1e-12


@settings(deadline=None)
@given(splines(4))
def test_nearest_is_no_farther_than_any_sample(spline):
    points = np.random.default_rng(4).uniform(-1.5, 1.5, (20, spline.dimension))
    samples = bspline.evaluated(spline, inside(spline, 2001))
    t, away = decomposition.nearest(spline, points)
    assert np.abs(np.linalg.norm(bspline.evaluated(spline, t) - points, axis=1) - away).max() <= 1e-12
    brute = np.linalg.norm(points[:, None] - samples, axis=-1).min(1)
    assert (away <= brute + 1e-12).all()


@settings(deadline=None)
@given(splines(4))
def test_bounds_are_those_of_the_samples_and_reached(spline):
    values, _ = knots.breaks(spline)
    t = (values[:-1, None] + np.diff(values)[:, None] * np.linspace(0.0, 1.0, 401)).ravel()
    samples = bspline.evaluated(spline, t)
    low, high = decomposition.bounds(spline)
    assert (samples >= low - 1e-13).all() and (samples <= high + 1e-13).all()
    assert np.abs(low - samples.min(0)).max() < 1e-3 and np.abs(high - samples.max(0)).max() < 1e-3


def test_values_are_read_only_and_ends_exact():
    given = np.array([[0.1, 0.2], [1, 2], [3, 3.0]])
    spline = BSpline(given, 2, knots.clamped_knots(3, 2))
    given[:] = 0.0
    assert (bspline.ends(spline) == [[0.1, 0.2], [3, 3]]).all()
    with pytest.raises(ValueError, match="read-only"):
        spline.points[0, 0] = 1.0


def test_a_spline_is_a_segment_of_a_contour():
    contour = Contour.of_segments([circle()], closed=True)
    assert contour.area() == pytest.approx(100.0 * np.pi, rel=1e-13)
    assert contour.length() == pytest.approx(20.0 * np.pi, rel=1e-13)


POINTS = np.arange(8.0).reshape(4, 2)
STEPS = [0, 0, 0, 0.5, 1, 1, 1]


@pytest.mark.parametrize(
    ("points", "degree", "at", "weights", "words"),
    [
        (POINTS, 2, [0, 0, 0.6, 0.5, 1, 1, 1], None, "must not fall, but knot 2 is 0.6 and knot 3 0.5"),
        (POINTS, 2, [0, 0, 0, 1, 1, 1], None, "needs 7 knots; there are 6"),
        (POINTS, 2, STEPS, [1, 1, 0, 1], "control point 2 is 0"),
        (POINTS, 2, STEPS, [1, 1, 1], "as many weights; there are 3"),
        (POINTS, 2, STEPS, [1, 1, np.nan, 1], "finite"),
        (POINTS, 0, [0, 1, 2, 3, 4], None, "from 1 to 25, not 0"),
        (POINTS, 26, STEPS, None, "from 1 to 25, not 26"),
        (POINTS, 2.5, STEPS, None, "not 2.5"),
        (POINTS, 4, np.arange(9), None, "needs 5 control points or more; there are 4"),
        (POINTS, 2, [0, 0, 0, 0, 1, 1, 1], None, "too many knots of a B-spline of degree 2 are 0 at its start"),
        (POINTS, 2, [0, 0, 0, 1, 1, 1, 1], None, "are 1 at its end"),
        (np.zeros((7, 2)), 2, [0, 0, 0, 1, 1, 1, 2, 3, 3, 3], None, "break in two"),
        (POINTS, 2, [0, 0, 0, np.inf, 1, 1, 1], None, "finite"),
        ([[0, 1], [np.nan, 2], [3, 4]], 2, [0, 0, 0, 1, 1, 1], None, "finite"),
        ([["a", "b"]], 1, STEPS, None, "finite"),
        ([], 1, STEPS, None, "finite"),
    ],
)
def test_what_is_no_curve_is_refused_in_words(points, degree, at, weights, words):
    with pytest.raises(Refusal, match=words):
        BSpline(points, degree, at, weights)
