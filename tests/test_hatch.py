"""Hatching: how much is drawn, where it ends, and that it stays where it is."""

import numpy as np
import pytest
from manifold3d import Manifold

from solidtree.model.section.hatch import MOST_LINES, hatch
from solidtree.model.section.section import SectionOutline, plane_through, section
from solidtree.model.solid.results import arrays_of


def cut(solid, height=5.0):
    return section(*arrays_of(solid.to_mesh64()), (0, 0, height), (0, 0, 1))


FRAME = cut(Manifold.cube([10, 10, 10]) - Manifold.cube([4, 4, 20]).translate([3, 3, -5]))


@pytest.mark.parametrize("angle", [0.0, 22.5, 45.0, 90.0, 135.0])
def test_lines_times_their_distance_are_the_area_and_all_lie_inside(angle):
    pieces = hatch(FRAME, 0.01, angle, shift=0.5)
    length = np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1).sum()
    assert 0.01 * length == pytest.approx(84.0, rel=2e-3)
    assert FRAME.holds(pieces[::20].mean(axis=1)).all()
    along = (pieces[:, 1] - pieces[:, 0]) @ [np.cos(np.radians(angle)), np.sin(np.radians(angle))]
    assert np.allclose(along, np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1))


def test_lines_through_corners_and_along_sides_are_no_case_of_their_own():
    pieces = hatch(cut(Manifold.cube([4, 4, 10])), 1.0, 0.0)  # one of them along the lower side, one along the upper
    assert pieces[:, 0, 1].tolist() == [0, 1, 2, 3] or pieces[:, 0, 1].tolist() == [1, 2, 3, 4]
    assert np.allclose(pieces[:, 1, 0] - pieces[:, 0, 0], 4.0)
    diagonal = hatch(cut(Manifold.cube([4, 4, 10])), np.sqrt(0.5), 45.0)
    assert sorted(np.round(diagonal[:, 0, 1] - diagonal[:, 0, 0], 9))[-1] == 3.0


def test_lines_do_not_move_when_the_outline_does():
    one = hatch(cut(Manifold.cube([4, 4, 10])), 1.0, 45.0)
    other = hatch(cut(Manifold.cube([4, 4, 10]).translate([0.3, 0.1, 0])), 1.0, 45.0)
    for pieces in (one, other):
        heights = (pieces @ [-np.sqrt(0.5), np.sqrt(0.5)]).ravel()
        assert np.allclose(heights, np.round(heights), atol=1e-9)
    shifted = hatch(cut(Manifold.cube([4, 4, 10])), 1.0, 45.0, shift=0.5)
    heights = (shifted @ [-np.sqrt(0.5), np.sqrt(0.5)]).ravel() - 0.5
    assert np.allclose(heights, np.round(heights), atol=1e-9)


def test_nothing_has_no_lines_and_a_tiny_distance_is_bounded():
    assert hatch(SectionOutline(plane_through((0, 0, 0), (0, 0, 1))), 1.0).shape == (0, 2, 2)
    assert len(hatch(FRAME, 1e-9)) <= 2 * (MOST_LINES + 1)
    with pytest.raises(ValueError, match="above 0"):
        hatch(FRAME, 0.0)
