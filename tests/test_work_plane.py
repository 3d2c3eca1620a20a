"""The plane that is drawn on: standard planes, planes of faces, planes of outlines."""

import numpy as np
import pytest

from solidtree.gui.curves.drawing.work_plane import STANDARD, plane_of, rigid
from solidtree.model.document.errors import Refusal
from solidtree.model.document.placement import turn_about


@pytest.mark.parametrize(
    ("name", "x", "y"),
    [("xy", (1, 0, 0), (0, 1, 0)), ("xz", (1, 0, 0), (0, 0, 1)), ("yz", (0, 1, 0), (0, 0, 1))],
)
def test_standard_planes_have_their_axes(name, x, y):
    assert STANDARD[name].matrix()[:, :2].T.tolist() == [list(x), list(y)]


def test_a_plane_through_a_point_across_any_normal():
    rng = np.random.default_rng(3)
    for normal in [*np.eye(3), *-np.eye(3), *rng.normal(size=(50, 3))]:
        normal = normal / np.linalg.norm(normal)
        point = rng.uniform(-50, 50, 3)
        frame = plane_of(tuple(point), tuple(normal)).matrix()
        assert frame[:, 2] == pytest.approx(normal, abs=1e-9) and frame[2, 0] == pytest.approx(0, abs=1e-9)
        assert (point - frame[:, 3]) @ normal == pytest.approx(0, abs=1e-6)
        assert np.cross(frame[:, 3], normal) == pytest.approx(np.zeros(3), abs=1e-6)  # the world's origin, dropped


def test_the_top_of_a_box_is_the_ground_lifted():
    (move,) = plane_of((30.0, 20.0, 12.0), (0.0, 0.0, 1.0)).steps
    assert move.numbers == (0.0, 0.0, 12.0)


def test_a_frame_becomes_a_placement_without_its_scale():
    rng = np.random.default_rng(5)
    turns = [turn_about(tuple(rng.normal(size=3)), float(rng.uniform(0, 360))) for _ in range(50)]
    turns += [turn_about((0, 1, 0), 90), turn_about((0, 1, 0), -90), turn_about((1, 0, 0), 180)]
    for turn in turns:
        frame = np.column_stack((turn[:, :3] * 2.5, rng.uniform(-9, 9, 3)))
        made = rigid(frame).matrix()
        assert made[:, :3] == pytest.approx(turn[:, :3], abs=1e-8) and made[:, 3] == pytest.approx(frame[:, 3])
    with pytest.raises(Refusal, match="scaled to nothing"):
        rigid(np.zeros((3, 4)))
