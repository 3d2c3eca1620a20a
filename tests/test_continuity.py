"""How curves meet, by formulas and constructed joints; what the tools for joints make of them; combs of curvature."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from solidtree.model.curve import bezier
from solidtree.model.curve.degree import elevated
from solidtree.model.document.errors import Refusal
from solidtree.model.path.continuity import comb, joint, knot_joints, report
from solidtree.model.path.path import Contour
from solidtree.model.path.shapes import ellipse
from solidtree.model.path.smoothing import harmonised, same_curvature, smooth, symmetric
from solidtree.model.spline import knots
from solidtree.model.spline.bspline import BSpline

FIRST = np.array([[0, 0], [1, 2], [3, 4], [6, 5.0]])
SECOND = np.array([[6, 5], [8, 4.5], [9, 3], [10, 0.0]])
WHOLE = np.array([[0, 0], [1, 5], [6, 7], [9, 1], [12, 2.0]])
QUARTER = np.array([[10, 0], [10, 10], [0, 10.0]])
WEIGHTS = np.array([1.0, np.sqrt(0.5), 1.0])


def pairs(axes: int = 2) -> st.SearchStrategy[tuple[np.ndarray, np.ndarray]]:
    """Two segments of degree 2 to 5 that meet."""

    def made(seed: int, n: int, m: int) -> tuple[np.ndarray, np.ndarray]:
        rng = np.random.default_rng(seed)
        first, second = rng.uniform(-10.0, 10.0, (n + 1, axes)), rng.uniform(-10.0, 10.0, (m + 1, axes))
        second[0] = first[-1]
        return first, second

    return st.builds(made, st.integers(0, 10**6), st.integers(2, 5), st.integers(2, 5))


def test_a_gap_and_an_angle():
    found = joint(FIRST, SECOND + np.array([3, 4]))
    assert (found.gap, found.geometric, found.parametric) == (5.0, -1, -1)
    assert "gap of 5 mm" in str(found)
    right = joint([[0, 0], [1, 0], [2, 0]], [[2, 0], [2, 1], [3, 2]])
    assert right.angle == pytest.approx(90.0)
    assert (right.geometric, right.parametric) == (0, 0)
    back = joint([[0, 0], [1, 0], [2, 0]], [[2, 0], [1, 0], [0, 1]])
    assert back.angle == pytest.approx(180.0)
    assert joint([[0, 0], [1, 0]], [[1, 0], [2, 1e-7]]).angle == pytest.approx(np.degrees(1e-7), rel=1e-6)


@pytest.mark.parametrize("t", [0.2, 0.5, 0.9])
def test_the_halves_of_a_curve_are_of_one_curvature(t):
    first, second = bezier.split(WHOLE, t)
    found = joint(first, second)
    assert found.geometric == 2 and found.angle <= 1e-9
    assert found.curvatures[0] == pytest.approx(found.curvatures[1], rel=1e-11)
    # The derivatives by each half's own parameter agree where the halves are alike, else for the intervals.
    assert found.parametric == (2 if t == 0.5 else 0)
    assert joint(first, second, steps=(t, 1.0 - t)).parametric == 2
    assert joint(first, elevated(second, 3), steps=(t, 1.0 - t)).parametric == 2


def test_a_line_meets_an_arc_with_the_curvature_of_its_radius():
    found = joint([[10, -5], [10, 0]], QUARTER, None, WEIGHTS)
    assert (found.geometric, found.curvatures) == (1, (0.0, pytest.approx(0.1)))
    assert found.jump == pytest.approx(0.1)
    other = joint(QUARTER, [[0, 10], [-5, 10]], WEIGHTS)
    assert other.curvatures == (pytest.approx(0.1), 0.0)


def test_lines_in_one_direction_are_of_one_curvature():
    assert joint([[0, 0], [1, 2]], [[1, 2], [3, 6]]).geometric == 2
    assert joint([[0, 0], [1, 2]], [[1, 2], [3, 6]]).parametric == 0
    assert joint([[0, 0], [1, 2]], [[1, 2], [2, 4]]).parametric == 2


def test_in_space_one_curvature_needs_one_plane():
    first = np.array([[-2, 1, 0], [-1, 0, 0], [0, 0, 0.0]])
    flat, turned = [[0, 0, 0], [1, 0, 0], [2, 1, 0.0]], [[0, 0, 0], [1, 0, 0], [2, 0, 1.0]]
    assert joint(first, flat).geometric == 2
    found = joint(first, turned)
    assert found.geometric == 1
    assert found.curvatures[0] == pytest.approx(found.curvatures[1])
    assert found.jump == pytest.approx(found.curvatures[0] * np.sqrt(2.0))


def test_a_handle_without_length_has_the_direction_that_follows():
    found = joint(FIRST, [[6, 5], [6, 5], [9, 6], [10, 0.0]])
    assert found.geometric >= 1  # the next control point lies in the direction (3, 1), as FIRST ends


def test_report_of_a_contour():
    square = Contour.of_segments(
        [np.array(row, float) for row in ([[0, 0], [1, 0]], [[1, 0], [1, 1]], [[1, 1], [0, 0]])], True
    )
    assert [round(found.angle) for found in report(square)] == [90, 135, 135]
    open_ = Contour.of_segments([FIRST, SECOND])
    assert len(report(open_)) == 1 and report(open_)[0].geometric == 0
    for exact in (False, True):
        assert {
            found.geometric for found in report(ellipse((3.0, 4.0), (20.0, 10.0), 30.0, exact=exact).contours[0])
        } == {2}
    mixed = Contour.of_segments([SECOND[::-1], BSpline(FIRST[::-1], 3, knots.clamped_knots(4, 3))])
    assert report(mixed)[0].angle == pytest.approx(joint(FIRST, SECOND).angle)


def test_inner_knots_are_as_smooth_as_their_multiplicity_says():
    rng = np.random.default_rng(5)
    spline = BSpline(rng.uniform(size=(9, 2)), 3, np.array([0, 0, 0, 0, 0.1, 0.4, 0.4, 0.7, 0.7, 1, 1, 1, 1]))
    assert [found.parametric for found in knot_joints(spline)] == [2, 1, 1]
    corner = BSpline(rng.uniform(size=(7, 2)), 3, np.array([0, 0, 0, 0, 0.3, 0.3, 0.3, 1, 1, 1, 1]))
    assert [found.geometric for found in knot_joints(corner)] == [0]
    around = knots.closed(rng.uniform(size=(6, 2)), 3, [1, 2, 1, 1, 3, 1])
    assert [found.parametric for found in knot_joints(around)] == [2] * 6


@settings(deadline=None)
@given(pairs(2) | pairs(3), st.sampled_from([None, "first", "second"]))
def test_smooth_turns_the_handles_and_keeps_their_lengths(pair, keep):
    made = smooth(*pair, keep=keep)
    assert joint(*made).angle <= 1e-6
    for old, new, side in zip(pair, made, ("first", "second"), strict=True):
        handle = (-1, -2) if side == "first" else (0, 1)
        lengths = [np.linalg.norm(some[handle[1]] - some[handle[0]]) for some in (old, new)]
        assert lengths[0] == pytest.approx(lengths[1])
        moved = np.flatnonzero((old != new).any(1))
        assert set(moved) <= ({handle[1] % len(old)} if side != keep else set())


def test_smooth_beside_a_line_turns_the_curve_alone():
    line = np.array([[0, 5], [6, 5.0]])
    first, second = smooth(line, SECOND)
    assert (first == line).all()
    assert second[1] == pytest.approx([6 + np.hypot(2, 0.5), 5])
    with pytest.raises(Refusal, match="make one of the lines a curve"):
        smooth(line, [[6, 5], [7, 9]])


@settings(deadline=None)
@given(pairs(3))
def test_symmetric_handles_are_opposite_and_as_long(pair):
    first, second = symmetric(*pair)
    assert first[-1] - first[-2] == pytest.approx(second[1] - second[0], abs=1e-9)
    if len(first) == len(second):
        assert joint(first, second).parametric >= 1


@settings(deadline=None)
@given(pairs(2))
def test_harmonised_joints_are_of_one_curvature_and_nothing_else_moves(pair):
    first, second = smooth(*pair)
    before = joint(first, second)
    assume(min(np.abs(before.curvatures)) > 1e-3 and np.prod(before.curvatures) > 0.0)
    one, other = harmonised(first, second)
    after = joint(one, other)
    assert after.geometric == 2 and after.angle <= 1e-6
    assert (one[:-1] == first[:-1]).all() and (other[1:] == second[1:]).all()
    line = second[1] - first[-2]
    share = (one[-1] - first[-2]) @ line / (line @ line)
    assert 0.0 < share < 1.0
    assert one[-1] == pytest.approx(first[-2] + share * line, abs=1e-9)


@settings(deadline=None)
@given(pairs(2), st.sampled_from(["first", "second"]))
def test_same_curvature_changes_one_handle(pair, keep):
    first, second = smooth(*pair)
    before = joint(first, second)
    assume(min(np.abs(before.curvatures)) > 1e-3 and np.prod(before.curvatures) > 0.0)
    one, other = same_curvature(first, second, keep)
    after = joint(one, other)
    assert after.geometric == 2
    place = 0 if keep == "first" else 1
    assert after.curvatures[place] == pytest.approx(before.curvatures[place], rel=1e-9)
    assert ((one, other)[place] == (first, second)[place]).all()
    moved = np.flatnonzero(((one, other)[1 - place] != (first, second)[1 - place]).any(1))
    assert len(moved) <= 1


def test_weights_count_for_the_curvature():
    weights = np.array([1.0, 2.0, 0.7, 1.5])
    first, second = smooth(FIRST, SECOND)
    for other in (weights[::-1], None):
        for pair in (
            harmonised(first, second, weights, other),
            same_curvature(first, second, "first", weights, other),
            same_curvature(first, second, "second", weights, other),
        ):
            assert joint(*pair, weights, other).geometric == 2


def test_what_cannot_be_is_refused_in_words():
    first, second = smooth(FIRST, SECOND)
    mirrored = second.copy()
    way = (second[1] - second[0]) / np.linalg.norm(second[1] - second[0])
    mirrored[2:] = 2.0 * (second[0] + ((second[2:] - second[0]) @ way)[:, None] * way) - second[2:]
    straight = np.array([second[0], second[1], second[0] + 3.0 * (second[1] - second[0]), [20, 20]])
    space = [np.column_stack([first, np.zeros(4)]), np.column_stack([second, [0, 0, 3.0, 0]])]
    for call, words in [
        (lambda: smooth(FIRST, SECOND + 1.0), "do not meet: 1.41421 mm"),
        (lambda: smooth([[0, 0], [2, 0], [1, 0]], [[1, 0], [2, 0], [3, 3]]), "lie on each other"),
        (lambda: smooth([[0, 0], [1, 0], [1, 0]], [[1, 0], [2, 0], [3, 3]]), "has no length"),
        (lambda: symmetric([[0, 0], [6, 5]], SECOND), "make it a curve first"),
        (lambda: harmonised(FIRST, SECOND), "make it smooth first"),
        (lambda: harmonised(first, mirrored), "turns to the other side"),
        (lambda: harmonised(first, straight), "straight there"),
        (lambda: harmonised(*space), "in one plane"),
        (lambda: same_curvature(first, straight), "that changes is straight"),
        (lambda: same_curvature(first, straight, "second"), "that is kept is straight"),
        (lambda: same_curvature(first, second, "third"), "first or second, not “third”"),
        (lambda: same_curvature([[0, 0], [1, 1]], [[1, 1], [2, 2]]), "a line has no curvature"),
    ]:
        with pytest.raises(Refusal, match=words):
            call()


def test_the_comb_of_a_circle_is_a_circle_around_it():
    t = np.linspace(0.0, 1.0, 33)
    spline = ellipse((3.0, 4.0), 10.0, exact=True).contours[0].splines[0]
    for curve, weights, centre in ((spline, None, [3, 4]), (QUARTER, WEIGHTS, [0, 0])):
        points, tips = comb(curve, t, 50.0, weights)
        assert np.linalg.norm(points - centre, axis=1) == pytest.approx(np.full(33, 10.0))
        assert np.linalg.norm(tips - centre, axis=1) == pytest.approx(np.full(33, 15.0))
    lifted = BSpline(np.column_stack([spline.points, np.ones(9)]), 2, spline.knots, spline.weights)
    _, tips = comb(lifted, t, 50.0)
    assert np.linalg.norm(tips - [3, 4, 1], axis=1) == pytest.approx(np.full(33, 15.0))


def test_the_comb_is_as_long_as_it_may_be_at_a_cusp_and_flat_on_a_line():
    cusp = np.array([[0, 0], [10, 10], [0, 10], [10, 0.0]])  # at t = 1/2
    points, tips = comb(cusp, np.linspace(0.0, 1.0, 21), 1.0, longest=3.0)
    teeth = np.linalg.norm(tips - points, axis=1)
    assert np.isfinite(tips).all() and teeth.max() <= 3.0 + 1e-12
    points, tips = comb(np.array([[0, 0], [1, 1], [3, 3.0]]), [0.0, 0.5, 1.0], 1.0)
    assert np.abs(points - tips).max() <= 1e-14
