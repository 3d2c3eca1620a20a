"""What the pipeline's matrices are made of, and what is said of their entries and of a vertex."""

import re

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.pipeline.explanation import MINUS, entry_words, outside, way_of
from solidtree.model.pipeline.matrices import NAMES, Lens, checked, eye_of, lens_of, matrices_for

MATRICES = matrices_for((30, -40, 50), (1, 2, 3), perspective=40.0, size=(640, 360), near=10, far=200)


def value_of(text):
    """What a formula's products sum to."""
    return sum(np.prod([float(n.strip("()").replace(MINUS, "-")) for n in term.split("\u00b7")]) for term in text)


@pytest.mark.parametrize("lens", [Lens(40.0, 0.0, 1.6, 2.5, 80.0), Lens(None, 33.0, 0.7, -5.0, 80.0)])
def test_a_projection_tells_its_lens(lens):
    found = lens_of(lens.matrix())
    told = [(value, getattr(lens, name)) for name in Lens.__slots__ if (value := getattr(found, name)) is not None]
    assert (found.angle is None) == (lens.angle is None) and len(told) >= 4
    np.testing.assert_allclose(*zip(*told, strict=True), rtol=1e-9)
    oblique = lens.matrix()
    oblique[0, 2] += 0.1
    with pytest.raises(Refusal, match="projection of no camera"):
        lens_of(oblique)


def test_a_view_tells_its_eye_and_a_leaning_one_none():
    position, axes = eye_of(MATRICES.view)
    np.testing.assert_allclose(position, (30, -40, 50))
    np.testing.assert_allclose(axes, MATRICES.view[:3, :3])
    for change in (np.diag([2.0, 1, 1, 1]), np.diag([-1.0, 1, 1, 1])):
        with pytest.raises(Refusal, match="only turns and moves"):
            eye_of(change @ MATRICES.view)


def test_matrices_that_cannot_be_are_refused():
    flat, endless, leaning = np.eye(4), np.eye(4), np.eye(4)
    flat[1] = flat[0]
    endless[0, 0] = np.inf
    leaning[3, 0] = 1.0
    for matrix, words in ((flat, "flatten"), (endless, "infinite"), (leaning, "only the projection changes w")):
        with pytest.raises(Refusal, match=words):
            checked(matrix, "view")
    assert checked(leaning, "projection") is leaning
    assert checked(1e-6 * np.eye(4), "projection") is not None  # small is not flat


def test_every_entry_has_words_with_its_number():
    for name in NAMES:
        matrix = getattr(MATRICES, name)
        for row in range(4):
            for column in range(4):
                number, _, words = entry_words(name, MATRICES, row, column).partition(": ")
                assert float(number.replace(MINUS, "-")) == pytest.approx(matrix[row, column], rel=1e-4, abs=1e-12)
                assert len(words) > 8
    assert entry_words("projection", MATRICES, 1, 1).startswith("2.7475: cot 20\u00b0")
    assert "n = 10 and f = 200" in entry_words("projection", MATRICES, 2, 2)
    assert "(30, \u221240, 50)" in entry_words("view", MATRICES, 0, 3)


def test_formulas_give_the_numbers_of_their_stage():
    way = way_of(MATRICES, np.array((3.0, -4.0, 5.0)))
    assert [stage.name for stage in way] == ["Model", "World", "Eye", "Clip", "Device", "Pixel"]
    for stage in way[1:]:
        for formula, value in zip(stage.formulas, stage.coordinates, strict=True):
            parts = formula.split(" = ")
            assert float(parts[-1].replace(MINUS, "-")) == pytest.approx(value, rel=1e-4, abs=1e-12)
            if stage.name != "Device":
                assert value_of(re.split(r" \+ ", parts[1])) == pytest.approx(value, rel=2e-3, abs=2e-2)
    assert "inside all six planes" in way[3].words


def test_planes_beyond_which_a_point_lies_are_named():
    names = ("left", "right", "bottom", "top", "near", "far")
    ways = [(-2, 0, 0), (2, 0, 0), (0, -2, 0), (0, 2, 0), (0, 0, -2), (0, 0, 2)]
    for name, place in zip(names, ways, strict=True):
        assert outside(np.array((*place, 1.0))) == (name,)
    assert outside(np.array((1.0, -1, 1, 1))) == ()
    behind = way_of(MATRICES, np.array((60.0, -84.0, 100.0)))[3]
    assert "the eye has it behind itself" in behind.words
