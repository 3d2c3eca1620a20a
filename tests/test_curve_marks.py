from collections.abc import Iterator

import numpy as np
import pytest

from solidtree.render.camera import Camera, project
from solidtree.render.curves.curve_marks import Box, CurveMarks, CurvePicture, Shape, knobs_of
from solidtree.render.look import LIGHT, rgb
from solidtree.render.viewer import Viewer

ACCENT = np.array(rgb(LIGHT.selection)) * 255
ABOVE = Camera(position=(0, 0, 100), target=(0, 0, 0), up=(0, 1, 0), parallel=True, parallel_scale=50)
PLANE = np.eye(3, 4)


@pytest.fixture
def viewer() -> Iterator[Viewer]:
    viewer = Viewer(theme=LIGHT)
    viewer.resize(400, 300)
    viewer.set_camera(ABOVE)
    viewer.set_ground(False)
    viewer.set_cube(False)
    yield viewer
    viewer.close()


def picture(shapes: list[Shape], chosen: list[bool], bright: bool = False) -> CurvePicture:
    """Nodes 40 mm apart on the x axis, with lines between them."""
    count = len(shapes)
    nodes = np.column_stack((40.0 * np.arange(count) - 20.0 * (count - 1), np.zeros((count, 2))))
    sides = np.stack((nodes[:-1], nodes[1:]), axis=1)
    return CurvePicture(
        sides,
        np.full(len(sides), bright),
        nodes,
        np.array(shapes, np.uint8),
        np.array(chosen),
        np.ones(count),
        np.zeros(0, np.intp),
    )


def shown(viewer: Viewer, marks: CurveMarks) -> np.ndarray:
    if marks not in viewer.overlay.marks:
        viewer.overlay.add(marks)
    viewer.render()
    return viewer.pixels().astype(float)


def at(pixels: np.ndarray, place: tuple[float, float, float], dx: int = 0, dy: int = 0) -> np.ndarray:
    x, y = project(ABOVE, [place], (400.0, 300.0))[0, :2]
    return pixels[int(y) + dy, int(x) + dx]


def test_chosen_nodes_and_segments_have_the_accent(viewer: Viewer) -> None:
    marks = CurveMarks()
    marks.show(picture([Shape.SQUARE, Shape.SQUARE], [True, False]))
    pixels = shown(viewer, marks)
    assert np.abs(at(pixels, (-20, 0, 0)) - ACCENT).max() < 12
    assert at(pixels, (20, 0, 0)).min() > 230
    assert np.abs(at(pixels, (0, 0, 0)) - ACCENT).max() > 60
    marks.show(picture([Shape.SQUARE, Shape.SQUARE], [True, True], bright=True))
    assert np.abs(at(shown(viewer, marks), (0, 0, 0)) - ACCENT).max() < 40


def test_kinds_of_nodes_have_shapes_of_their_own(viewer: Viewer) -> None:
    marks = CurveMarks()
    seen = []
    for shape in Shape:
        marks.show(picture([shape], [False]))
        pixels = shown(viewer, marks)
        x, y = project(ABOVE, [(0, 0, 0)], (400.0, 300.0))[0, :2].astype(int)
        seen.append(pixels[y - 8 : y + 9, x - 8 : x + 9])
    for i, one in enumerate(seen):
        for other in seen[:i]:
            assert (np.abs(one - other).max(axis=2) > 60).sum() >= 4


def test_marks_are_as_large_at_every_distance_and_over_everything(viewer: Viewer) -> None:
    marks = CurveMarks()
    marks.show(picture([Shape.SQUARE], [True]))
    counts = []
    for scale in (50.0, 5.0, 500.0):
        viewer.set_camera(Camera(**{**{f: getattr(ABOVE, f) for f in ABOVE.__slots__}, "parallel_scale": scale}))
        counts.append(int((np.abs(shown(viewer, marks) - ACCENT).max(axis=2) < 12).sum()))
    assert min(counts) >= 30 and max(counts) - min(counts) <= 6


def test_what_is_caught_is_larger_and_nothing_shows_nothing(viewer: Viewer) -> None:
    marks = CurveMarks()
    marks.show(picture([Shape.DISC], [True]))
    plain = int((np.abs(shown(viewer, marks) - ACCENT).max(axis=2) < 12).sum())
    assert marks.catch(("node", 0)) and not marks.catch(("node", 0))
    assert int((np.abs(shown(viewer, marks) - ACCENT).max(axis=2) < 12).sum()) > 1.3 * plain
    marks.show(None)
    empty = shown(viewer, marks)
    assert (np.abs(empty - ACCENT).max(axis=2) < 60).sum() == 0


def test_control_points_of_greater_weight_are_larger(viewer: Viewer) -> None:
    marks = CurveMarks()
    counts = []
    for size in (0.6, 1.0, 2.0):
        base = picture([Shape.POINT], [True])
        marks.show(
            CurvePicture(base.sides, base.bright, base.nodes, base.shapes, base.chosen, np.array([size]), base.ends)
        )
        counts.append(int((np.abs(shown(viewer, marks) - ACCENT).max(axis=2) < 12).sum()))
    assert counts[0] < counts[1] < counts[2]


def test_knobs_stand_around_the_nodes() -> None:
    box = Box(np.array([[-20.0, -5.0], [20.0, 15.0]]), PLANE)
    pixels, steps = knobs_of(box, ABOVE, (400.0, 300.0))
    low, high = project(ABOVE, [[-20, -5, 0], [20, 15, 0]], (400.0, 300.0))[:, :2]
    assert pixels.shape == (10, 2) and np.allclose(steps[4], 0)
    corners = pixels[[0, 2, 6, 8]]
    assert corners[:, 0].min() < low[0] - 8 and corners[:, 0].max() > high[0] + 8
    assert np.allclose(pixels[4], (low + high) / 2)
    assert pixels[9, 1] < pixels[7, 1] < high[1]
