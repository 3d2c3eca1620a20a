"""Knots put in and taken out, curves cut, raised and decomposed: the curve stays, or the deviation is told."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_bspline import circle, inside, random_spline, splines

from solidtree.model.curve.bezier import evaluated
from solidtree.model.curve.degree import elevated
from solidtree.model.document.errors import Refusal
from solidtree.model.spline import bspline, decomposition, knots, spline_degree
from solidtree.model.spline.bspline import BSpline

EXACT = 1e-12


def off(one: BSpline, other: BSpline) -> float:
    t = inside(one, 201)
    return float(np.abs(bspline.evaluated(one, t) - bspline.evaluated(other, t)).max())


def within(spline: BSpline, share: float) -> float:
    start, end = spline.domain
    return start + share * (end - start)


shares = st.floats(0.01, 0.99)


@settings(deadline=None)
@given(splines(), shares)
def test_inserting_leaves_the_curve(spline, share):
    t = within(spline, share)
    more = knots.inserted(spline, t)
    assert len(more.points) == len(spline.points) + 1
    assert knots.multiplicity(more, t) == knots.multiplicity(spline, t) + 1
    assert more.periodic == spline.periodic
    assert off(spline, more) <= EXACT


@settings(deadline=None)
@given(splines())
def test_inserting_by_hand(spline):
    """Boehm's formula, point for point."""
    if spline.periodic or spline.weights is not None:
        return
    p, t = spline.degree, within(spline, 0.377)
    span = int(bspline.spans(spline.knots, p, t))
    wanted = []
    for i in range(len(spline.points) + 1):
        if i <= span - p:
            wanted.append(spline.points[i])
        elif i > span:
            wanted.append(spline.points[i - 1])
        else:
            a = (t - spline.knots[i]) / (spline.knots[i + p] - spline.knots[i])
            wanted.append((1 - a) * spline.points[i - 1] + a * spline.points[i])
    made = knots.inserted(spline, t).points
    assert np.abs(made - wanted).max() <= 1e-14
    assert (made[: span - p + 1] == spline.points[: span - p + 1]).all()
    assert (made[span + 1 :] == spline.points[span:]).all()


@settings(deadline=None)
@given(splines(), st.lists(shares, min_size=1, max_size=9, unique=True))
def test_refining_leaves_the_curve(spline, many):
    assert off(spline, knots.refined(spline, [within(spline, share) for share in many])) <= EXACT
    halved = knots.refined(spline)
    assert off(spline, halved) <= EXACT
    assert len(knots.breaks(halved)[0]) == 2 * len(knots.breaks(spline)[0]) - 1


@settings(deadline=None)
@given(splines(5), shares, st.integers(1, 3))
def test_removing_what_was_put_in_gives_the_curve_back(spline, share, times):
    t = within(spline, share)
    times = min(times, spline.degree - knots.multiplicity(spline, t))
    if times < 1:
        return
    back, deviation = knots.removed(knots.inserted(spline, t, times), t, times)
    assert back.knots == pytest.approx(spline.knots, abs=1e-12)
    assert deviation <= EXACT
    assert np.abs(back.points - spline.points).max() <= 1e-10


@settings(deadline=None)
@given(splines(5))
def test_the_deviation_of_removing_is_the_greatest_there_is(spline):
    inner = knots.breaks(spline)[0][1:-1]
    if not len(inner) or (spline.periodic and len(spline.points) - spline.degree <= spline.degree + 1):
        return
    try:
        less, deviation = knots.removed(spline, inner[len(inner) // 2])
    except Refusal as refused:
        assert "weight" in str(refused)
        return
    assert len(less.points) == len(spline.points) - 1
    assert less.periodic == spline.periodic
    t = inside(spline, 4001)
    seen = np.linalg.norm(bspline.evaluated(spline, t) - bspline.evaluated(less, t), axis=1).max()
    assert seen <= deviation * (1.0 + 1e-12) + 1e-13
    assert deviation <= seen + 0.01 * deviation + 1e-12
    assert not spline.clamped or np.abs(bspline.ends(less) - bspline.ends(spline)).max() <= EXACT


def test_removing_moves_less_than_leaving_the_control_point_out():
    spline = random_spline(8, 3, 9, "clamped", False)
    knot = knots.breaks(spline)[0][2]
    _, deviation = knots.removed(spline, knot)
    at = np.searchsorted(spline.knots, knot)
    crude = BSpline(np.delete(spline.points, at - 2, axis=0), 3, np.delete(spline.knots, at))
    assert 0.0 < deviation < decomposition.farthest(spline, crude)


@settings(deadline=None)
@given(splines(), shares)
def test_the_parts_are_the_curve(spline, share):
    t = within(spline, share)
    first, second = knots.split(spline, t)
    assert np.abs(first.points[-1] - second.points[0]).max() <= 1e-13
    for part in (first, second):
        assert part.clamped
        assert off(part, spline) <= EXACT
    assert first.domain == (spline.domain[0], second.domain[0])


@settings(deadline=None)
@given(splines(), shares, shares)
def test_extracting(spline, one, other):
    if abs(one - other) < 0.01:
        return
    start, end = within(spline, one), within(spline, other)
    part = knots.extracted(spline, start, end)
    t = np.linspace(0.0, 1.0, 50)
    low, high = sorted((start, end))
    along = bspline.evaluated(spline, start + t * (end - start))
    assert np.abs(bspline.evaluated(part, low + t * (high - low)) - along).max() <= EXACT


def test_beyond_the_domain_the_outermost_polynomials_go_on():
    spline = random_spline(5, 3, 8, "clamped", False)
    part = knots.extracted(spline, -0.2, 1.3)
    t = np.linspace(-0.2, 1.3, 99)
    assert np.abs(bspline.evaluated(part, t) - bspline.evaluated(spline, t)).max() <= EXACT * 10.0


@settings(deadline=None)
@given(splines())
def test_clamping_and_other_domains_leave_the_curve(spline):
    clamped = knots.clamped(spline)
    assert clamped.clamped
    assert off(spline, clamped) <= EXACT
    moved = knots.on_domain(spline, 5.0, 7.0)
    assert moved.domain == (5.0, 7.0)
    t = np.linspace(0.01, 0.99, 50)
    start, end = spline.domain
    assert (
        np.abs(bspline.evaluated(moved, 5 + 2 * t) - bspline.evaluated(spline, start + t * (end - start))).max()
        <= 1e-11
    )


@settings(deadline=None)
@given(splines(), st.integers(1, 3))
def test_raising_the_degree_leaves_the_curve_and_lowering_it_brings_it_back(spline, times):
    higher = spline_degree.elevated(spline, times)
    assert higher.degree == spline.degree + times
    assert off(spline, higher) <= EXACT
    assert knots.breaks(higher)[1][1:-1].tolist() == (knots.breaks(spline)[1][1:-1] + times).tolist()
    lower, deviation = spline_degree.reduced(higher, times)
    assert deviation <= EXACT
    assert off(spline, lower) <= EXACT
    assert lower.knots == pytest.approx(knots.clamped(spline).knots)


def test_lowering_the_degree_tells_the_deviation():
    spline = random_spline(6, 4, 12, "open", False)
    lower, deviation = spline_degree.reduced(spline)
    t = inside(spline, 5001)
    seen = np.linalg.norm(bspline.evaluated(lower, t) - bspline.evaluated(spline, t), axis=1)
    assert lower.degree == 3
    assert seen.max() <= deviation <= seen.max() * 1.001
    assert seen[0] <= 1e-13 and seen[-1] <= 1e-13
    with pytest.raises(Refusal, match="1 is the lowest"):
        spline_degree.reduced(spline, 4)
    with pytest.raises(Refusal, match="25 is the highest"):
        spline_degree.elevated(spline, 22)


def test_a_raised_circle_is_the_circle():
    points = bspline.evaluated(spline_degree.elevated(circle(), 3), np.linspace(0.0, 4.0, 500))
    assert np.abs(np.linalg.norm(points, axis=1) - 10.0).max() <= 1e-13


@settings(deadline=None)
@given(splines(5))
def test_bezier_pieces_are_the_curve_and_give_it_back(spline):
    pieces = decomposition.decomposed(spline)
    t = np.linspace(0.0, 1.0, 9)
    for i, controls in enumerate(pieces.controls):
        weights = None if pieces.weights is None else pieces.weights[i]
        along = decomposition.bezier.evaluated(controls, t, weights)
        start, end = pieces.breaks[i : i + 2]
        wanted = bspline.evaluated(spline, start + t[1:-1] * (end - start))
        assert np.abs(along[1:-1] - wanted).max() <= EXACT
    back = decomposition.composed(pieces.controls, pieces.weights, pieces.breaks)
    assert off(spline, back) <= EXACT
    assert len(back.points) <= len(knots.clamped(spline).points)
    free = decomposition.composed(pieces.controls, pieces.weights)
    assert np.abs(bspline.ends(free) - bspline.ends(spline)).max() <= EXACT


def test_cubics_with_one_tangent_are_joined_with_double_knots_and_corners_with_triple_ones():
    first = [[0, 0], [1, 2], [3, 4], [6, 5.0]]
    smooth = [[6, 5], [12, 7], [14, 3], [15, 0.0]]  # the handle goes on, twice as long
    corner = [[15, 0], [20, 0], [21, 3], [25, 5.0]]
    spline = decomposition.composed([first, smooth, corner])
    values, counts = knots.breaks(spline)
    assert counts.tolist() == [4, 2, 3, 4]
    assert np.diff(values)[1] / np.diff(values)[0] == pytest.approx(2.0)
    whole = decomposition.composed([first, *np.subtract([corner], [9, -5])])
    assert knots.breaks(whole)[1].tolist() == [4, 3, 4]
    with pytest.raises(Refusal, match="piece 1 does not begin where piece 0 ends: 1 mm"):
        decomposition.composed([first, np.add(smooth, [0, 1])])


def test_one_polynomial_in_pieces_is_one_piece_again():
    controls = np.array([[0, 0], [1, 2], [3, 4], [6, 5.0]])
    cut = decomposition.decomposed(knots.inserted(BSpline(controls, 3, knots.clamped_knots(4, 3)), 0.3, 3))
    assert len(cut.controls) == 2
    assert decomposition.composed(cut.controls).points == pytest.approx(controls, abs=1e-13)


def test_closed_curves_are_smooth_at_the_seam():
    spline = knots.closed([[0, 0], [4, 0], [4, 3], [0, 3], [-2, 1]], 3, [1, 2, 1, 3, 1])
    start, end = bspline.derivatives(spline, np.array(spline.domain), 2).transpose(1, 0, 2)
    assert spline.periodic
    assert start == pytest.approx(end, abs=1e-11)
    third = knots.closed(np.eye(2), 5)  # fewer points than the degree
    assert third.periodic and len(third.points) == 7
    assert off(third, knots.inserted(third, 0.2)) <= EXACT


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
@pytest.mark.parametrize("rational", [False, True])
def test_a_closed_curve_of_pieces_is_closed_as_smooth_as_they_are(degree, rational):
    rng = np.random.default_rng(degree)
    steps = rng.uniform(0.2, 1.0, 6)
    steps[2:4] = 0.0 if degree > 2 else steps[2:4]
    spline = knots.closed(rng.random((6, 2)), degree, steps, rng.uniform(0.5, 2.0, 6) if rational else None)
    pieces = decomposition.decomposed(spline)
    again = decomposition.ring(pieces.controls, pieces.weights, pieces.breaks)
    assert again.periodic and len(again.points) == len(spline.points)
    assert np.sort(np.diff(knots.breaks(again)[0])) == pytest.approx(np.sort(np.diff(pieces.breaks)), abs=1e-12)
    t = np.linspace(0.0, 1.0, 101)
    assert decomposition.nearest(again, bspline.evaluated(spline, t))[1].max() <= EXACT
    raised = decomposition.ring(elevated(pieces.lifted, 1), None, pieces.breaks) if not rational else again
    assert decomposition.nearest(raised, bspline.evaluated(spline, t))[1].max() <= EXACT
    if not rational:
        lower, deviation = spline_degree.reduced(raised)
        assert lower.periodic and lower.degree == degree and deviation <= 1e-9


def test_pieces_with_corners_and_an_open_rational_curve_are_closed_exactly():
    corners = np.array([[[0, 0], [4, 0]], [[4, 0], [4, 3]], [[4, 3], [0, 0]]], float)
    triangle = decomposition.ring(corners)
    assert triangle.degree == 1 and len(np.unique(triangle.points, axis=0)) == 3
    bow = np.array([[0, 0], [1, 4], [5, 4], [6, 0]], float)
    weights = np.array([[1.0, 2.0, 0.5, 3.0], [1.0, 1.0, 1.0, 1.0]])
    ring = decomposition.ring(np.stack((bow, elevated(bow[[3, 0]], 2))), weights)
    t = np.linspace(0.0, 1.0, 101)
    assert decomposition.nearest(ring, evaluated(bow, t, weights[0]))[1].max() <= EXACT
    assert ring.periodic and max(ring.points[:, 1]) == 4.0
    with pytest.raises(Refusal, match="not closed"):
        decomposition.ring(bow[None])


def test_even_knots():
    assert knots.clamped_knots(5, 2).tolist() == pytest.approx([0, 0, 0, 1 / 3, 2 / 3, 1, 1, 1])
    spline = BSpline(np.zeros((5, 2)), 2, knots.open_knots(5, 2))
    assert spline.domain == (0.0, 1.0) and not spline.clamped
    assert np.diff(spline.knots) == pytest.approx(np.full(7, 1 / 3))


def test_knots_that_cannot_be_are_refused_in_words():
    spline = random_spline(2, 3, 8, "open", False)
    start, end = spline.domain
    inner = spline.knots[4]
    for call, words in [
        (lambda: knots.inserted(spline, end + 1), "a knot goes between"),
        (lambda: knots.inserted(spline, float("nan")), "a knot goes between"),
        (lambda: knots.inserted(spline, inner, 3), "there would be 4 knots; a B-spline of degree 3"),
        (lambda: knots.removed(spline, 0.5 * (inner + spline.knots[5])), "no 1 inner knots at .* there are 0"),
        (lambda: knots.removed(spline, start), "no 1 inner knots"),
        (lambda: knots.split(spline, start), "is cut between"),
        (lambda: knots.extracted(spline, end, end), "has no length"),
        (lambda: knots.on_domain(spline, 1.0, 1.0), "rise"),
        (lambda: knots.closed([[0, 0], [1, 1], [2, 0]], 2, [1, -1, 1]), "interval of knots, not below 0"),
        (lambda: knots.closed([[0, 0], [1, 1], [2, 0]], 2, [0, 1, 1]), "one knot at its seam"),
        (lambda: knots.closed([[0, 0], [1, 1], [2, 0], [3, 1]], 1, [1, 0, 1, 1]), "break in two"),
    ]:
        with pytest.raises(Refusal, match=words):
            call()


def test_a_parameter_that_is_a_knot_but_for_rounding_is_the_knot():
    spline = BSpline(np.arange(10.0).reshape(5, 2), 3, [0, 0, 0, 0, 0.3, 1, 1, 1, 1])
    more = knots.inserted(spline, 0.1 + 0.2)
    assert more.knots[4:6].tolist() == [0.3, 0.3]
    fewer, deviation = knots.with_multiplicity(more, 0.3, 1)
    assert len(fewer.points) == 5 and deviation <= 1e-13


@pytest.mark.parametrize("times", [5, 10**9, 10**30])
def test_more_knots_than_hold_together_are_refused_however_many(times):
    spline = BSpline(np.array([[0.0, 0], [1, 2], [3, 2], [4, 0]]), 3, np.array([0.0, 0, 0, 0, 1, 1, 1, 1]))
    with pytest.raises(Refusal, match="holds together with 3 at most"):
        knots.inserted(spline, 0.5, times)
