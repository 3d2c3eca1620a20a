"""Dimension lines in the picture, by pixels."""

import numpy as np
import pytest

from solidtree.model.measuring.elements import Line
from solidtree.render.camera import project
from solidtree.render.handles.dimension import Dimension, DimensionMarks
from solidtree.render.viewer import Viewer

NONE = np.empty((0, 2, 3))
LINE = Line((-20.0, 0.0, 0.0), (20.0, 0.0, 30.0), "50 mm")


@pytest.fixture(params=["light", "dark"])
def viewer(request):
    made = Viewer(theme=request.param)
    made.resize(400, 300)
    made.set_ground(False)
    made.set_cube(False)
    yield made
    made.close()


def drawn(viewer: Viewer, *dimensions: Dimension) -> np.ndarray:
    """(height, width) whether a pixel is another one with the dimensions than without."""
    viewer.render()
    before = viewer.pixels().astype(int)
    marks = DimensionMarks()
    viewer.overlay.add(marks)
    marks.show(dimensions)
    viewer.render()
    after = viewer.pixels().astype(int)
    viewer.overlay.remove(marks)
    return np.abs(after - before).max(axis=2) > 40


def near(viewer: Viewer, picture: np.ndarray, point, reach: int = 3) -> float:
    """The share of changed pixels around a point of the world."""
    x, y, _ = project(viewer.camera, [point], viewer.size)[0] * viewer.scale
    return float(picture[int(y) - reach : int(y) + reach + 1, int(x) - reach : int(x) + reach + 1].mean())


def test_the_line_its_ends_and_its_label_are_seen(viewer):
    picture = drawn(viewer, Dimension(LINE, False, NONE))
    for share, least in ((0.02, 0.2), (0.1, 0.3), (0.5, 0.05), (0.9, 0.3), (0.98, 0.2)):
        point = np.array(LINE.start) + share * np.subtract(LINE.end, LINE.start)
        assert near(viewer, picture, point) > least
    assert near(viewer, picture, (20, 0, 0)) == 0


def test_legs_run_along_the_axes_and_the_outline_is_drawn(viewer):
    outline = np.array([[(-20.0, 0, 40), (20.0, 0, 40)]])
    picture = drawn(viewer, Dimension(LINE, True, outline))
    for point in ((-10, 0, 0), (20, 0, 8), (0, 0, 40)):
        assert near(viewer, picture, point) > 0.2
    faint = drawn(viewer, Dimension(LINE, True, outline, strong=False))
    assert near(viewer, faint, (-10, 0, 0)) == 0 and near(viewer, faint, (0, 0, 40)) == 0
    stale = drawn(viewer, Dimension(LINE, True, outline, stale=True))
    assert 0 < stale.sum() < picture.sum()


def test_lines_are_as_wide_from_afar_and_follow_the_scale(viewer):
    viewer.set_camera(viewer.camera)
    once = drawn(viewer, Dimension(LINE, False, NONE)).sum()
    viewer.resize(400, 300, 2.0)
    twice = drawn(viewer, Dimension(LINE, False, NONE)).sum()
    assert 3 < twice / once < 5


def test_what_lies_behind_the_eye_is_left_out(viewer):
    eye = np.array(viewer.camera.position)
    behind = eye + (eye - viewer.camera.target)
    aside = behind + 10.0
    hidden = Line(tuple(behind.tolist()), tuple(aside.tolist()), "far")
    assert not drawn(viewer, Dimension(hidden, False, NONE)).any()
    across = Line(tuple((behind + np.array([0, 0, 30])).tolist()), (0.0, 0.0, 0.0), "far")
    assert drawn(viewer, Dimension(across, False, NONE)).sum() > 100


def test_nothing_is_drawn_for_nothing(viewer):
    assert not drawn(viewer).any()
