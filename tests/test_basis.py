import numpy as np
import pytest
from curve_session import CLOSED, OPEN, OWN_TURN, RATIONAL, SPLINES

from solidtree.model.document.errors import Refusal
from solidtree.model.outline.basis import basis_of, in_order, reach
from solidtree.model.outline.paths import spline_of
from solidtree.model.spline.bspline import evaluated


@pytest.mark.parametrize("node", SPLINES)
def test_what_the_control_points_weigh_makes_the_curve(node):
    found = basis_of(node)
    assert found.values.shape == (len(found.at), len(node.points)) and (found.values >= 0).all()
    np.testing.assert_allclose(found.values.sum(axis=1), 1.0, atol=1e-14)
    points = found.values @ np.array(node.points, float)
    np.testing.assert_allclose(points, evaluated(spline_of(node), found.at), atol=1e-12)


def test_stacks_tell_how_often_knots_stand_and_how_smooth_the_curve_is_there():
    stacks = basis_of(RATIONAL).stacks
    assert [(one.value, one.numbers, one.smoothness) for one in stacks] == [
        (0.0, (0, 1, 2, 3), None), (0.3, (4, 5), 1), (1.0, (6, 7, 8, 9), None)]  # fmt: skip
    assert basis_of(RATIONAL).clamped and basis_of(RATIONAL).stack_of(5) == 1
    turn = basis_of(CLOSED)
    assert len(turn.knots) == 7 and [one.smoothness for one in turn.stacks] == [2] * 7 and not turn.clamped
    loose = basis_of(OPEN.with_(knots=tuple(range(10))))
    assert not loose.clamped and loose.domain == (3, 6)
    assert [one.smoothness for one in loose.stacks] == [None] * 4 + [2, 2] + [None] * 4


@pytest.mark.parametrize("node", [*SPLINES, OPEN.with_(knots=tuple(range(10))), OPEN.with_(degree=1)])
def test_reach_says_what_can_be_done(node):
    """Just inside, and on the neighbours where it says so, there is a curve; else there is none."""
    found = basis_of(node)
    for stack in found.stacks:
        for numbers in {stack.numbers, stack.numbers[:1], stack.numbers[-1:]}:
            low, high, on_low, on_high = reach(node, found, numbers)
            own = stack.value
            tries = [(low, on_low), (high, on_high), *((own + 0.9 * (side - own), True) for side in (low, high))]
            for value, holds in tries:
                if not np.isfinite(value):
                    continue
                knots = found.knots.copy()
                knots[list(numbers)] = value
                moved = node.with_(knots=tuple(knots.tolist()))
                if holds:
                    assert len(basis_of(moved).knots) == len(knots)
                else:
                    with pytest.raises(Refusal):
                        basis_of(moved)


def test_knots_that_move_together_are_told_so_that_none_passes_another():
    knots = basis_of(OWN_TURN).knots  # 2, 3, 3.5, 5, 7, 8, 10
    for targets in ({1: 4.0, 2: 4.0}, {3: 3.6, 4: 3.6}, {1: 3.4, 2: 4.9, 3: 4.95, 4: 6.0}, {2: 4.0, 3: 4.0}):
        moving = knots.copy()
        for number in in_order(knots, targets):
            moving[number] = targets[number]
            assert (np.diff(moving) >= 0).all()
        assert {number: moving[number] for number in targets} == targets
