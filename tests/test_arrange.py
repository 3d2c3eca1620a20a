"""Lining up, spreading and laying down, by formula."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.measuring.arrange import aligned, centred, grounded, laid, spread

BOXES = np.array([[[0, 0, 0], [10, 4, 2]], [[30, -5, 1], [36, 5, 9]], [[12, 8, -4], [16, 20, -2]]], float)
RANDOM = np.random.default_rng(7)


def moved(boxes, moves):
    return boxes + moves[:, None, :]


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("side", ["min", "middle", "max"])
def test_aligned_boxes_share_a_side_and_move_along_one_axis(axis, side):
    number = "xyz".index(axis)
    place = {"min": lambda b: b[:, 0], "middle": lambda b: b.mean(axis=1), "max": lambda b: b[:, 1]}[side]
    moves = aligned(BOXES, axis, side)
    after = place(moved(BOXES, moves))[:, number]
    assert np.allclose(after, place(BOXES)[0, number]) and not moves[0].any()
    assert not np.delete(moves, number, axis=1).any()
    assert np.allclose(place(moved(BOXES, aligned(BOXES, axis, side, to=7.5)))[:, number], 7.5)


def test_gaps_become_equal_and_the_outermost_stay():
    moves = spread(BOXES, "x")
    after = moved(BOXES, moves)
    assert not moves[[0, 1]].any() and not moves[:, 1:].any()
    # from left to right: box 0, box 2, box 1
    gaps = [after[2, 0, 0] - after[0, 1, 0], after[1, 0, 0] - after[2, 1, 0]]
    assert gaps == pytest.approx([(36 - 0 - 10 - 4 - 6) / 2] * 2)


def test_gaps_may_be_negative():
    boxes = np.array([[[0, 0, 0], [10, 1, 1]], [[1, 0, 0], [12, 1, 1]], [[4, 0, 0], [14, 1, 1]]], float)
    after = moved(boxes, spread(boxes, "x"))
    assert after[1, 0, 0] - after[0, 1, 0] == pytest.approx((14 - 31) / 2)
    assert after[2, 0, 0] - after[1, 1, 0] == pytest.approx((14 - 31) / 2)


def test_centres_become_equally_spaced():
    moves = spread(BOXES, "x", "centres")
    middles = moved(BOXES, moves).mean(axis=1)[:, 0]
    assert middles == pytest.approx([5, 33, 19])
    many = np.sort(RANDOM.uniform(-50, 50, (9, 2, 3)), axis=1)
    steps = np.diff(np.sort(moved(many, spread(many, "z", "centres")).mean(axis=1)[:, 2]))
    assert np.allclose(steps, steps[0])


def test_the_ground():
    assert np.allclose(moved(BOXES, grounded(BOXES))[:, 0, 2], 0)
    assert np.allclose(moved(BOXES, grounded(BOXES, 3))[:, 0, 2], 3)
    moves = centred(BOXES)
    assert (moves == moves[0]).all()  # together: they keep their places to each other
    after = moved(BOXES, moves)
    assert np.allclose((after[:, 0].min(axis=0) + after[:, 1].max(axis=0))[:2], 0) and after[:, 0, 2].min() == 0


def test_a_face_is_laid_on_another_one():
    for _ in range(200):
        point, normal, on, facing = RANDOM.normal(size=(4, 3))
        matrix = laid(point, normal, on, facing)
        turn = matrix[:, :3]
        assert np.allclose(turn @ turn.T, np.eye(3)) and np.linalg.det(turn) > 0
        assert np.allclose(turn @ point + matrix[:, 3], on)
        assert np.allclose(turn @ normal / np.linalg.norm(normal), -facing / np.linalg.norm(facing))
        # the least turn: by the very angle between the two normals
        angle = np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))
        cosine = -normal @ facing / np.linalg.norm(normal) / np.linalg.norm(facing)
        assert angle == pytest.approx(np.arccos(np.clip(cosine, -1, 1)), abs=1e-6)


@pytest.mark.parametrize("normal", [(0, 0, 1), (1, 0, 0), (0, -1, 0), (1, 2, 3)])
def test_the_two_special_turns(normal):
    assert np.allclose(
        laid((0, 0, 0), normal, (1, 2, 3), np.negative(normal)), [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]
    )
    half = laid((0, 0, 0), normal, (0, 0, 0), normal)[:, :3]
    assert np.allclose(half @ normal, np.negative(normal)) and np.trace(half) == pytest.approx(-1)
    near = laid((0, 0, 0), normal, (0, 0, 0), np.add(normal, (1e-7, -1e-7, 2e-7)))[:, :3]
    assert np.allclose(near @ near.T, np.eye(3), atol=1e-9)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: aligned(BOXES, "w"), "an axis is x, y or z"),
        (lambda: aligned(BOXES, "x", "left"), "min, middle or max"),
        (lambda: spread(BOXES[:2], "x"), "three solids or more"),
        (lambda: spread(BOXES, "x", "sizes"), "gaps or centres"),
        (lambda: grounded([]), "nothing to arrange"),
        (lambda: laid((0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 1)), "without a normal"),
    ],
)
def test_what_cannot_be_is_refused_in_words(call, words):
    with pytest.raises(Refusal, match=words):
        call()
