"""B-splines through and near points: scipy as the peer, the end conditions, the tolerance, and large systems."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline, make_interp_spline, make_lsq_spline

from solidtree.model.document.errors import Refusal
from solidtree.model.spline import banded, bspline, knots
from solidtree.model.spline.spline_fitting import approximated, fitted, interpolated, spaced

SAMPLES = np.linspace(0.0, 1.0, 501)
TANGENTS = np.array([[1.0, 0.5], [0.0, -1.0]])


def walk(seed: int, count: int, axes: int = 2) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(0.2, 1.0, (count, axes)) * rng.choice([-1.0, 1.0], (count, axes)), axis=0)


def flower(count: int) -> np.ndarray:
    a = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    return np.stack([30.0 * np.cos(a) + 3.0 * np.cos(7.0 * a), 20.0 * np.sin(a)], 1)


@settings(deadline=None)
@given(
    st.integers(0, 10**6),
    st.integers(1, 6),
    st.integers(0, 30),
    st.sampled_from(["free", "natural", "clamped", "closed"]),
    st.sampled_from(["chord", "centripetal", "uniform"]),
)
def test_the_curve_goes_through_the_points_at_their_parameters(seed, degree, more, ends, spacing):
    if (ends == "natural" and degree % 2 == 0) or (ends == "clamped" and degree == 1):
        return
    points = walk(seed, degree + 2 + more, 2 + seed % 2)
    tangents = np.ones((2, points.shape[1])) if ends == "clamped" else None
    spline = interpolated(points, degree, ends, spacing, tangents)
    t = spaced(points, spacing, ends == "closed")
    if ends == "closed":
        assert spline.periodic
        t = t[:-1] if degree % 2 else t[:-1] + 0.5 * (t[-1] - t[-2])
    assert spline.domain == (0.0, 1.0)
    assert np.abs(bspline.evaluated(spline, t) - points).max() <= 1e-11 * np.abs(points).max()


@pytest.mark.parametrize("seed", range(5))
def test_cubics_are_those_of_scipy(seed):
    points = walk(seed, 12)
    t, around = spaced(points), spaced(points, closed=True)
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    ends = ((1, TANGENTS[0] * length), (1, TANGENTS[1] * length))
    for made, peer in [
        (interpolated(points, 3, "natural"), CubicSpline(t, points, bc_type="natural")),
        (interpolated(points, 3, "clamped", tangents=TANGENTS), CubicSpline(t, points, bc_type=ends)),
        (interpolated(points, 3, "closed"), CubicSpline(around, np.vstack([points, points[:1]]), bc_type="periodic")),
    ]:
        wanted = peer(SAMPLES)
        assert np.abs(bspline.evaluated(made, SAMPLES) - wanted).max() <= 1e-13 * max(np.abs(wanted).max(), 10.0)


@pytest.mark.parametrize("count", [2, 3, 4, 6])
def test_as_many_points_as_control_points_of_a_bezier_curve_make_one(count):
    points = walk(count, count)
    spline = interpolated(points, count - 1, "free")
    assert len(spline.points) == count
    assert bspline.evaluated(spline, spaced(points)) == pytest.approx(points, abs=1e-12)


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
def test_free_ends_are_those_of_scipy_on_the_same_knots(degree):
    points = walk(3, 20)
    made = interpolated(points, degree)
    peer = make_interp_spline(spaced(points), points, degree, t=made.knots)
    assert np.abs(made.points - peer.c).max() <= 1e-11


def test_natural_ends_have_no_curvature_and_clamped_ones_the_tangents():
    points = walk(7, 9)
    for degree, orders in ((3, [2]), (5, [3, 4])):
        made = bspline.derivatives(interpolated(points, degree, "natural"), SAMPLES, degree)
        for k in orders:
            assert np.abs(made[k, [0, -1]]).max() <= 1e-10 * np.abs(made[k]).max()
    for degree in (2, 3, 4, 5):
        spline = interpolated(points, degree, "clamped", "centripetal", TANGENTS)
        along = bspline.derivatives(spline, [0.0, 1.0], 1)[1]
        length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        assert along == pytest.approx(TANGENTS * length, abs=1e-10 * length)


def test_closed_curves_are_smooth_at_the_seam_and_take_the_first_point_twice_or_once():
    points = flower(11)
    for degree in (2, 3, 4, 5):
        spline = interpolated(points, degree, "closed")
        start, end = bspline.derivatives(spline, [0.0, 1.0], degree - 1).transpose(1, 0, 2)
        scale = np.abs(start).max(1, keepdims=True)
        assert (np.abs(start - end) <= 1e-9 * scale).all()
        again = interpolated(np.vstack([points, points[:1]]), degree, "closed")
        assert again.points == pytest.approx(spline.points, abs=1e-12)


def test_a_circle_through_its_points():
    """The error of cubic interpolation falls with the fourth power of the step."""
    errors = []
    for count in (16, 32, 64):
        a = 2.0 * np.pi * np.arange(count) / count
        spline = interpolated(np.stack([np.cos(a), np.sin(a)], 1), 3, "closed")
        errors.append(np.abs(np.linalg.norm(bspline.evaluated(spline, SAMPLES), axis=1) - 1.0).max())
    assert errors[0] < 1e-3
    assert 14.0 < errors[0] / errors[1] < 18.0 and 14.0 < errors[1] / errors[2] < 18.0


def test_least_squares_is_that_of_scipy_but_for_its_ends():
    points = flower(300)
    found = approximated(points, 20)
    t = spaced(points)
    # scipy leaves the ends free: great weights pull them to the points.
    weights = np.ones(len(t))
    weights[[0, -1]] = 1e7
    peer = make_lsq_spline(t, points, found.spline.knots, 3, w=weights)
    assert np.abs(found.spline.points - peer.c).max() <= 1e-6
    assert found.deviation == pytest.approx(np.linalg.norm(peer(t) - points, axis=1).max(), rel=1e-5)
    assert (bspline.ends(found.spline) == points[[0, -1]]).all()


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("count", [24, 90])
def test_nothing_near_the_least_squares_is_better(closed, count):
    """Both ways to solve: for few control points and for many."""
    points = flower(400) + np.random.default_rng(1).normal(0.0, 0.1, (400, 2))
    found = approximated(points, count, closed=closed)
    t = found.parameters
    best = ((bspline.evaluated(found.spline, t) - points) ** 2).sum()
    rng = np.random.default_rng(2)
    for size in (1e-3, 1e-2):
        shift = rng.normal(0.0, size, found.spline.points.shape)
        if closed:
            shift[-3:] = shift[:3]
        else:
            shift[[0, -1]] = 0.0
        other = bspline.BSpline(found.spline.points + shift, 3, found.spline.knots)
        assert ((bspline.evaluated(other, t) - points) ** 2).sum() > best


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("tolerance", [1.0, 1e-2, 1e-4])
def test_the_fit_keeps_the_tolerance_with_few_knots(tolerance, closed):
    points = flower(1000)
    found = fitted(points, tolerance, closed=closed)
    off = np.linalg.norm(bspline.evaluated(found.spline, found.parameters) - points, axis=1)
    assert off.max() == pytest.approx(found.deviation, abs=1e-15)
    assert found.deviation <= tolerance
    assert found.spline.periodic == closed
    # The error of cubics falls with the fourth power of the number of pieces; 21 of them are within 1 mm.
    assert len(found.spline.points) <= 26.0 * tolerance**-0.25 + 8
    truth = flower(20000)
    beside = np.linalg.norm(truth[None] - bspline.evaluated(found.spline, SAMPLES[:-1])[:, None], axis=-1).min(1)
    assert beside[5:-5].max() <= 1.5 * tolerance + 0.01  # nor does it swing between the points


def test_what_is_a_curve_of_few_knots_is_found_as_such():
    a = np.linspace(0.0, 1.0, 50)
    points = np.stack([a, a**2 - a**3, 2.0 * a], 1)
    found = fitted(points, 1e-12, spacing=a)
    assert found.spline.points[:, 1] == pytest.approx([0, 0, 1 / 3, 0], abs=1e-12)
    line = fitted(np.outer(np.linspace(0.0, 1.0, 30), [3.0, 4.0]), 1e-9)
    assert len(line.spline.points) == 4 and line.deviation <= 1e-14


def test_a_tolerance_below_what_knots_can_do_gives_the_curve_through_the_points():
    points = walk(5, 40)
    found = fitted(points, 1e-9)
    assert found.deviation <= 1e-11
    assert len(found.spline.points) <= 40
    for degree in (2, 3, 4):
        found = fitted(points, 1e-9, degree, closed=True)
        off = np.linalg.norm(bspline.evaluated(found.spline, found.parameters) - points, axis=1)
        assert found.deviation == off.max() <= 1e-9


@pytest.mark.parametrize("cyclic", [False, True])
def test_large_bands_are_solved_as_dense_ones(cyclic):
    rng = np.random.default_rng(3)
    for count, width in ((700, 4), (193, 7), (1000, 9)):
        entries = rng.uniform(-1.0, 1.0, (count, width))
        entries[:, width // 2] += width
        first = np.arange(count) - width // 2
        if not cyclic:
            outside = (first[:, None] + np.arange(width) < 0) | (first[:, None] + np.arange(width) >= count)
            entries[outside] = 0.0
        dense = np.zeros((count, count))
        np.add.at(dense, (np.arange(count)[:, None], (first[:, None] + np.arange(width)) % count), entries)
        right = rng.normal(size=(count, 3))
        assert np.abs(banded.solved(entries, first, right) - np.linalg.solve(dense, right)).max() <= 1e-13


@pytest.mark.parametrize("ends", ["free", "natural", "clamped", "closed"])
def test_thousands_of_points(ends):
    points = walk(11, 5000)
    spline = interpolated(points, 3, ends, tangents=TANGENTS if ends == "clamped" else None)
    t = spaced(points, closed=ends == "closed")[: len(points)]
    assert np.abs(bspline.evaluated(spline, t) - points).max() <= 1e-12 * np.abs(points).max()


def test_what_cannot_be_fitted_is_refused_in_words():
    points = walk(1, 8)
    doubled = np.insert(points, 3, points[3], axis=0)
    for call, words in [
        (lambda: interpolated(doubled), "points 3 and 4 are at one place"),
        (lambda: interpolated(points, 4, "natural"), "odd degree, not 4"),
        (lambda: interpolated(points, 3, "clamped"), "need two tangents"),
        (lambda: interpolated(points, 1, "clamped", tangents=TANGENTS), "degree 2 or more"),
        (lambda: interpolated(points[:3], 3), "needs 4 points or more; there are 3"),
        (lambda: interpolated(points, 3, "loose"), "free, natural, clamped or closed, not “loose”"),
        (lambda: interpolated(points, 3, spacing="even"), "chord, centripetal or uniform, not “even”"),
        (lambda: interpolated(points, 3, spacing=[0, 1]), "8 points are 8 numbers that rise"),
        (lambda: interpolated([[0, 0], [1, np.inf]]), "finite"),
        (lambda: interpolated(points[:2], 3, "closed"), "three points or more"),
        (lambda: fitted(points, 0.0), "above 0 mm, not 0.0"),
        (lambda: fitted(points[:3], 1.0), "fitted to 4 points or more; there are 3"),
        (lambda: approximated(points, 9), "4 to 8 control points, not 9"),
        (lambda: fitted(points, 1.0, degree=0), "from 1 to 25, not 0"),
    ]:
        with pytest.raises(Refusal, match=words):
            call()


def test_the_spacing_is_that_of_its_name():
    points = np.array([[0, 0], [4, 0], [4, 9.0]])
    assert spaced(points).tolist() == pytest.approx([0, 4 / 13, 1])
    assert spaced(points, "centripetal").tolist() == pytest.approx([0, 2 / 5, 1])
    assert spaced(points, "uniform").tolist() == pytest.approx([0, 1 / 2, 1])
    assert len(knots.breaks(interpolated(points, 1))[0]) == 3
