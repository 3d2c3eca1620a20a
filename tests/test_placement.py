"""Placements: their matrices by formula, how steps join, and how they are taken back."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solidtree.model.document.errors import Refusal
from solidtree.model.document.expression import Expression
from solidtree.model.document.placement import (
    IDENTITY,
    Affine,
    Move,
    Placement,
    Reflect,
    Scale,
    Turn,
    affine,
    inverse,
    product,
    turn_about,
)

numbers = st.floats(-100, 100).map(lambda x: round(x, 3))
triples = st.tuples(numbers, numbers, numbers)
factors = st.tuples(*[st.sampled_from([-3.0, -1.0, 0.25, 1.0, 2.0])] * 3)
steps = st.one_of(
    triples.map(Move),
    triples.map(Turn),
    factors.map(Scale),
    triples.filter(lambda t: np.linalg.norm(t) > 0.1).map(Reflect),
    st.just(Affine((1, 0.5, 0, 3, 0, 1, 0, -2, 0, 0.25, 2, 1))),
)


def at(placement, *point):
    return placement.matrix() @ (*point, 1)


def test_steps_apply_in_order():
    placement = Placement((Move((10, 0, 0)), Turn((0, 0, 90)), Scale((1, 2, 1)), Reflect((0, 1, 0))))
    assert at(placement, 1, 0, 5).tolist() == [0, -22, 5]


def test_a_turn_goes_about_x_then_y_then_z():
    placement = Placement((Turn((90, 90, 0)),))
    assert at(placement, 0, 1, 0).tolist() == [1, 0, 0]  # y goes to z, which goes to x


@pytest.mark.parametrize("angle", [90, -90, 180, 450, 3600090])
def test_right_angles_are_exact(angle):
    matrix = Placement((Turn((0, 0, angle)),)).matrix()
    assert set(np.abs(matrix).ravel()) == {0, 1}


def test_a_turn_about_any_axis_keeps_the_axis_and_the_distances():
    axis, point = (1.0, 2.0, -0.5), (3.0, 0.0, 1.0)
    matrix = turn_about(axis, 37.0, point)
    on_axis = np.add(point, np.multiply(axis, 2.5))
    assert matrix @ (*on_axis, 1) == pytest.approx(on_axis)
    assert matrix[:, :3] @ matrix[:, :3].T == pytest.approx(np.eye(3))
    assert np.trace(matrix[:, :3]) == pytest.approx(1 + 2 * math.cos(math.radians(37)))


@given(st.lists(steps, max_size=5))
def test_steps_taken_back_lead_back(chosen):
    back = [undo for step in reversed(chosen) for undo in step.inverse()]
    matrix = Placement((*chosen, *back)).matrix()
    assert matrix == pytest.approx(IDENTITY, abs=1e-7)
    assert product(inverse(Placement(tuple(chosen)).matrix()), Placement(tuple(chosen)).matrix()) == pytest.approx(
        IDENTITY, abs=1e-7
    )


def test_symbolic_steps_are_taken_back_symbolically():
    width = Expression("width")
    chosen = (Move((width, 1, 2)), Turn((width, 20, 30)), Scale((2, width, 1)))
    back = tuple(undo for step in reversed(chosen) for undo in step.inverse())
    both = Placement((*chosen, *back))
    assert both.symbolic()
    assert both.resolve({"width": 7.0}).matrix() == pytest.approx(IDENTITY)


@given(st.lists(steps, max_size=4), triples, triples)
def test_moves_in_a_row_are_one_and_a_move_by_nothing_is_none(before, first, second):
    start = Placement(tuple(before))
    once = start.then(Move(first))
    twice = once.then(Move(second))
    assert len(twice.steps) <= len(start.steps) + 1
    assert start.then(Move((0, 0, 0))) is start
    both = Placement((*before, Move(first), Move(second)))
    assert twice.matrix() == pytest.approx(both.matrix(), abs=1e-6)


def test_moves_with_expressions_stay_apart():
    placement = Placement().then(Move(("width", 0, 0))).then(Move((1, 0, 0)))
    assert len(placement.steps) == 2
    assert placement.resolve({"width": 2.0}).matrix()[:, 3].tolist() == [3, 0, 0]


def test_the_position_is_the_move_that_comes_last():
    placement = Placement((Turn((0, 0, 45)), Move((1, 2, 3))))
    assert placement.position == (1, 2, 3)
    assert placement.moved_to((4.0, 5.0, 6.0)).steps == (Turn((0, 0, 45)), Move((4, 5, 6)))
    assert placement.moved_to((0.0, 0.0, 0.0)).steps == (Turn((0, 0, 45)),)
    assert Placement((Turn((0, 0, 45)),)).position == (0, 0, 0)


@pytest.mark.parametrize("kind", [Move, Turn, Scale, Reflect])
@pytest.mark.parametrize("value", [(1, 2), (1, 2, math.nan), (1, 2, math.inf), (1, 2, None), 5, "abc", (1, 2, "1 +")])
def test_steps_refuse_what_is_no_three_finite_numbers(kind, value):
    with pytest.raises(Refusal, match=kind.word):
        kind(value)


def test_what_flattens_is_refused():
    with pytest.raises(Refusal, match="0, 0, 0"):
        Reflect((0, 0, 0)).matrix()
    with pytest.raises(Refusal, match="flat"):
        Scale((1, 0, 1)).inverse()
    with pytest.raises(Refusal, match="flat"):
        inverse(np.zeros((3, 4)))


def test_an_unresolved_placement_has_no_matrix():
    with pytest.raises(Refusal, match="no value before"):
        Placement((Move(("width", 0, 0)),)).matrix()


def test_matrices_are_read_only_and_shared():
    one, two = Placement((Move((1, 2, 3)),)), Placement((Move((1.0, 2, 3)),))
    assert one.matrix() is two.matrix()
    with pytest.raises(ValueError, match="read-only"):
        one.matrix()[0, 0] = 5


def test_affine_takes_three_or_four_rows():
    rows = [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7]]
    assert affine(rows) == affine([*rows, [0, 0, 0, 1]]) == affine(np.array(rows))
    for wrong in (
        [*rows, [0, 0, 1, 1]],
        rows[:2],
        [row[:3] for row in rows],
        5,
        [1, 2, 3],
        [[*rows[0][:3], math.nan], *rows[1:]],
    ):
        with pytest.raises(Refusal):
            affine(wrong)


@pytest.mark.parametrize("wrong", [[Move((1, 2, 3))], (1, 2), None, (Move((1, 2, 3)), "turn")])
def test_a_placement_is_a_tuple_of_steps(wrong):
    with pytest.raises(Refusal):
        Placement(wrong)
