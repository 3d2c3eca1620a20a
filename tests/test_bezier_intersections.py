"""Intersections: the thirty of the corpus, parts of one curve, loops, lines, and random curves of all degrees."""

import json

import numpy as np
import pytest

from solidtree.model.curve.bezier import derivatives, evaluated, extracted, of_polynomial
from solidtree.model.curve.degree import elevated
from solidtree.model.curve.intersections import intersections, self_intersections, with_line

QUARTER = np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
QUARTER_WEIGHTS = np.array([1.0, np.sqrt(0.5), 1.0])
LOOP = np.array([[0.0, 0.0], [3.0, 2.0], [-2.0, 2.0], [1.0, 0.0]])


def crossings_of_polylines(first: np.ndarray, second: np.ndarray) -> int:
    """How many pairs of segments of two polylines (k, 2) cross properly."""

    def sides(points: np.ndarray, line: np.ndarray) -> np.ndarray:
        along, away = np.diff(line, axis=0), points[:, None] - line[:-1]
        return np.sign(away[..., 0] * along[:, 1] - away[..., 1] * along[:, 0])

    one, two = sides(first, second), sides(second, first).T
    crossed = (one[:-1] != one[1:]) & (two[:, :-1] != two[:, 1:])
    return int(np.count_nonzero(np.triu(crossed, 2) if first is second else crossed))


def test_the_intersections_of_the_corpus(corpus):
    cases = json.loads((corpus / "curves/bezier_dhermes.json").read_text())["intersections"]
    assert len(cases) == 30
    for case in cases:
        first, second = np.array(case["curve1_points"]), np.array(case["curve2_points"])
        size = max(np.abs(first).max(), np.abs(second).max())
        found = intersections(first, second)
        wanted = np.column_stack([case.get("curve1_params", []), case.get("curve2_params", [])])
        order = np.lexsort(wanted.T[::-1])
        got = np.column_stack([found.first, found.second])
        # The coincident case shares no part: one curve goes on where the other ends, and they cross once more.
        assert not len(found.shared), case["id"]
        assert got.shape == wanted.shape, case["id"]
        tangent = case["type"] == "tangent"
        assert np.abs(got - wanted[order]).max(initial=0.0) <= (1e-7 if tangent else 1e-12), case["id"]
        if len(wanted):
            assert np.abs(found.points - np.array(case["intersections"])[order]).max() <= 1e-12 * size, case["id"]
            assert found.tangent.any() == (tangent or case["type"] == "coincident"), case["id"]


def test_the_line_intersections_of_the_corpus(corpus):
    cases = json.loads((corpus / "curves/bezier_kurbo.json").read_text())["line_intersections"]
    assert len(cases) == 3
    for case in cases:
        t, along = with_line(case["points"], *case["line"])
        inside = (along >= 0.0) & (along <= 1.0)
        if "expected_count" in case:
            assert np.count_nonzero(inside) == case["expected_count"]
            continue
        wanted = np.array([[one["segment_t"], one["line_t"]] for one in case["expected"]])
        assert np.abs(np.column_stack([t, along])[inside] - wanted).max() <= 1e-12


@pytest.mark.parametrize(("m", "n"), [(1, 3), (2, 3), (3, 3), (3, 5), (5, 5)])
def test_random_curves_meet_as_often_as_their_polylines_do(m, n):
    rng = np.random.default_rng([m, n])
    t = np.linspace(0.0, 1.0, 901)
    for _ in range(4):
        first, second = rng.random((m + 1, 2)), rng.random((n + 1, 2))
        weights = (0.5 + rng.random(m + 1), None)
        for ratios in (weights, (None, None)):
            found = intersections(first, second, ratios)
            one, two = evaluated(first, t, ratios[0]), evaluated(second, t, ratios[1])
            assert len(found.first) == crossings_of_polylines(one, two)
            gap = evaluated(first, found.first, ratios[0]) - evaluated(second, found.second, ratios[1])
            assert np.abs(gap).max(initial=0.0) <= 1e-14
            assert not found.tangent.any()
        swapped = intersections(second, first)
        assert np.allclose(np.sort(swapped.second), found.first, rtol=0.0, atol=1e-12)


def test_a_circle_and_a_line_by_formula():
    found = intersections(QUARTER, [[0.0, 0.0], [3.0, 4.0]], (QUARTER_WEIGHTS, None))
    assert np.abs(found.points - [0.6, 0.8]).max() <= 1e-15
    assert found.second == pytest.approx([0.2], abs=1e-15)
    touching = intersections(QUARTER, [[2.0, 0.0], [0.0, 2.0]] / np.sqrt(2.0), (QUARTER_WEIGHTS, None))
    assert np.abs(touching.points - np.sqrt(0.5)).max() <= 1e-12
    assert touching.tangent.tolist() == [True]


@pytest.mark.parametrize("contact", [2, 3, 4, 5])
def test_contact_of_any_order_is_one_point(contact):
    # y = x^2 and y = x^2 + x^contact, scaled, turned and cut so that the contact is at no round number.
    angle = np.exp(0.7j)
    turn = 3.0 * np.array([[angle.real, angle.imag], [-angle.imag, angle.real]])
    line = np.zeros((6, 2))
    line[1, 0] = line[2, 1] = 1.0
    other = line.copy()
    other[contact, 1] += 1.0
    first, second = (
        extracted(of_polynomial(c) @ turn + [1.0, 2.0], *s) for c, s in ((line, (-0.3, 0.6)), (other, (-0.2, 0.45)))
    )
    found = intersections(first, second)
    assert len(found.first) == 1
    assert found.tangent[0]
    # Where even the curvatures' change agrees, rounding alone hides more than it shows.
    assert np.abs(found.points - [1.0, 2.0]).max() <= {2: 1e-12, 3: 1e-12, 4: 1e-6, 5: 1e-3}[contact]
    if contact <= 3:
        assert abs(found.first[0] - 1.0 / 3.0) <= 1e-7
        assert abs(found.second[0] - 0.2 / 0.65) <= 1e-7


@pytest.mark.parametrize("gap", [1e-4, 1e-8, 1e-11])
def test_just_beside_a_contact_there_are_two_crossings_or_none(gap):
    parabola = np.array([[0.0, 1.0], [0.5, -1.0], [1.0, 1.0]])  # y = (2 x - 1)^2
    for lift, count in ((gap, 2), (-gap, 0)):
        found = intersections(parabola, [[0.0, lift], [1.0, lift]])
        assert len(found.first) == count
        assert np.allclose(np.abs(2.0 * found.first - 1.0), np.sqrt(gap), rtol=1e-4, atol=0.0)


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_parts_of_one_curve_share_what_both_have(degree, axes):
    rng = np.random.default_rng([degree, axes])
    for backwards in (False, True):
        controls = rng.random((degree + 1, axes)) + np.linspace(0.0, 3.0, degree + 1)[:, None]
        first, second = extracted(controls, 0.0, 0.7), elevated(extracted(controls, 0.3, 1.0), 1)
        ends = np.array([[3.0 / 7.0, 0.0], [1.0, 4.0 / 7.0]])
        if backwards:
            second, ends[:, 1] = second[::-1], 1.0 - ends[:, 1]
        found = intersections(first, second)
        assert found.shared.shape == (1, 2, 2)
        assert np.abs(found.shared[0] - ends).max() <= 1e-9
        assert not len(found.first)


def test_a_line_inside_of_another_one_run_with_another_speed():
    found = intersections([[0.0, 0.0], [3.0, 0.0]], [[1.0, 0.0], [2.0, 0.0], [5.0, 0.0]])
    # The second's x is 1 + 2 u + 2 u^2, which is 3 at u = (sqrt(5) - 1) / 2.
    assert np.abs(found.shared[0] - [[1.0 / 3.0, 0.0], [1.0, 0.5 * (np.sqrt(5.0) - 1.0)]]).max() <= 1e-9


def test_parts_of_a_circle_with_other_weights():
    other = extracted(np.column_stack([QUARTER * QUARTER_WEIGHTS[:, None], QUARTER_WEIGHTS]), 0.2, 1.3)
    found = intersections(QUARTER, other[:, :2] / other[:, 2:], (QUARTER_WEIGHTS, other[:, 2]))
    assert np.abs(found.shared[0] - [[0.2, 0.0], [1.0, 0.8 / 1.1]]).max() <= 1e-9


def test_lines_that_only_lie_in_one_line_share_nothing():
    found = intersections([[0.0, 0.0], [1.0, 1.0]], [[2.0, 2.0], [3.0, 3.0]])
    assert not len(found.first)
    assert not len(found.shared)
    end = intersections([[0.0, 0.0], [1.0, 1.0]], [[1.0, 1.0], [3.0, 3.0]])
    assert end.points.tolist() == [[1.0, 1.0]]
    assert not len(end.shared)


def test_constructed_contacts_of_any_size_and_place():
    rng = np.random.default_rng(11)
    for scale in 10.0 ** np.arange(-6, 7, 2):
        first, second, (s, t) = rng.random((4, 2)), rng.random((4, 2)), 0.1 + 0.8 * rng.random(2)
        place, along = derivatives(first, s, 1)
        other, across = derivatives(second, t, 1)
        turn = (along @ [1, 1j]) / (across @ [1, 1j])
        turn /= abs(turn)
        second = (second - other) @ np.array([[turn.real, turn.imag], [-turn.imag, turn.real]]) + place
        shift = 10.0 * rng.normal(size=2)
        found = intersections(scale * (first + shift), scale * (second + shift))
        near = np.abs(found.first - s) < 1e-3
        assert np.count_nonzero(near) == 1
        assert found.tangent[near].all()
        assert max(np.abs(found.first[near] - s), np.abs(found.second[near] - t)) <= 1e-7
        expected = scale * (place + shift)
        assert np.abs(found.points[near] - expected).max() <= 1e-12 * np.abs(expected).max()


def test_a_loop_shared_by_both_curves_is_crossed_by_them_too():
    t = np.array([0.5 - np.sqrt(3.0) / 4.0, 0.5 + np.sqrt(3.0) / 4.0])
    for second, expected in ((LOOP, t[::-1]), (LOOP[::-1], 1.0 - t[::-1])):
        found = intersections(LOOP, second)
        assert len(found.shared) == 1
        assert np.abs(found.first - t).max() <= 1e-12
        assert np.abs(found.second - expected).max() <= 1e-9


def test_the_loop_of_a_cubic_by_formula():
    # x = 9 t - 24 t^2 + 16 t^3 and y = 6 t - 6 t^2: y is even about 1/2, x - 1/2 is odd and 0 there and at t below.
    t, points = self_intersections(LOOP)
    assert np.abs(t - [[0.5 - np.sqrt(3.0) / 4.0, 0.5 + np.sqrt(3.0) / 4.0]]).max() <= 1e-12
    assert np.abs(points - [[0.5, 0.375]]).max() <= 1e-15


def test_what_does_not_meet_itself_and_what_is_closed():
    cusp = np.array([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]])
    assert not len(self_intersections(cusp)[0])
    assert not len(self_intersections(np.add(cusp, [0.0, 1e3]))[0])
    assert not len(self_intersections(QUARTER, QUARTER_WEIGHTS)[0])
    assert not len(self_intersections([[0.0, 0.0], [1.0, 2.0], [2.0, -2.0], [3.0, 0.0]])[0])
    closed, points = self_intersections([[0.0, 0.0], [1.0, 2.0], [-1.0, 2.0], [0.0, 0.0]])
    assert np.abs(closed - [[0.0, 1.0]]).max() <= 1e-12
    assert np.abs(points).max() <= 1e-15


def test_random_curves_meet_themselves_as_often_as_their_polylines_do():
    rng = np.random.default_rng(8)
    seen = 0
    for _ in range(12):
        controls = rng.random((6, 2))
        t, points = self_intersections(controls)
        line = evaluated(controls, np.linspace(0.0, 1.0, 701))
        count = crossings_of_polylines(line, line)
        assert len(t) == count
        assert np.abs(evaluated(controls, t) - points[:, None]).max(initial=0.0) <= 1e-14
        seen += len(t)
    assert seen >= 3


def test_in_space_curves_meet_only_where_they_do():
    first = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 1.0], [2.0, 0.0, 3.0], [4.0, 1.0, 1.0]])
    shared = evaluated(first, 0.37)
    second = np.array([[-1.0, 3.0, 0.5], [0.5, 1.0, 2.0], [3.0, -1.0, 1.0]])
    second[1] += 2.0 * (shared - evaluated(second, 0.5))
    found = intersections(first, second)
    assert np.abs([found.first - 0.37, found.second - 0.5]).max() <= 1e-12
    assert not len(intersections(first, np.add(second, [0.0, 0.0, 1e-3])).first)


def test_a_cusp_on_a_curve_and_two_points():
    cusp = np.array([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]])
    found = intersections(cusp, [[0.0, 0.75], [1.0, 0.75]])
    assert len(found.first) == 1
    assert np.abs(found.points - [0.5, 0.75]).max() <= 1e-12
    assert intersections(np.ones((2, 2)), np.ones((3, 2))).points.tolist() == [[1.0, 1.0]]
    assert intersections(np.ones((2, 2)), [[0.0, 0.0], [4.0, 4.0]]).second == pytest.approx([0.25], abs=1e-15)


def test_lines_that_touch_and_lines_that_hold_the_curve():
    cubic = of_polynomial([[0.0, 0.09], [1.0, -0.6], [0.0, 1.0], [0.0, 0.0]])  # y = (x - 0.3)^2
    t, along = with_line(cubic, [-1.0, 0.0], [1.0, 0.0])
    assert t == pytest.approx([0.3], abs=1e-12)
    assert along == pytest.approx([0.65], abs=1e-12)
    assert len(with_line([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]], [0.0, 0.0], [1.0, 1.0])[0]) == 0
    t, _ = with_line(QUARTER, [0.0, 0.0], [1.0, 1.0], QUARTER_WEIGHTS)
    assert t == pytest.approx([0.5], abs=1e-15)
    with pytest.raises(ValueError, match="two points"):
        with_line(cubic, [1.0, 1.0], [1.0, 1.0])
