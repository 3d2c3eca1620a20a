"""Constructions over the picture, by its pixels."""

from collections.abc import Iterator

import numpy as np
import pytest

from solidtree.render.camera import Camera, project
from solidtree.render.curves.construction_colours import colour_of_point
from solidtree.render.curves.construction_marks import ConstructionMarks, ConstructionPicture
from solidtree.render.look import DARK, LIGHT, Look, rgb
from solidtree.render.viewer import Viewer

ABOVE = Camera(position=(0, 0, 100), target=(0, 0, 0), up=(0, 1, 0), parallel=True, parallel_scale=50)
SIZE = (400.0, 300.0)
LEVELS = [
    np.array([(-40.0, -20.0, 0.0), (0.0, 40.0, 0.0), (40.0, -20.0, 0.0)]),
    np.array([(-20.0, 10.0, 0.0), (20.0, 10.0, 0.0)]),
    np.array([(0.0, 10.0, 0.0)]),
]


@pytest.fixture(params=[LIGHT, DARK], ids=["light", "dark"])
def viewer(request) -> Iterator[Viewer]:
    viewer = Viewer(theme=request.param)
    viewer.resize(*map(int, SIZE))
    viewer.set_camera(ABOVE)
    viewer.set_ground(False)
    viewer.set_cube(False)
    yield viewer
    viewer.close()


def look_of(request) -> Look:
    return request.node.callspec.params["viewer"]


def shown(viewer: Viewer, marks: ConstructionMarks) -> np.ndarray:
    if marks not in viewer.overlay.marks:
        viewer.overlay.add(marks)
    viewer.render()
    return viewer.pixels().astype(float)


def at(pixels: np.ndarray, place: tuple[float, float, float]) -> np.ndarray:
    x, y = project(ABOVE, [place], SIZE)[0, :2]
    return pixels[int(y), int(x)]


def is_like(pixel: np.ndarray, colour: str) -> bool:
    return bool(np.abs(pixel - 255 * np.array(rgb(colour))).max() < 20)


def test_the_point_has_the_accent_and_control_points_their_own_colours(viewer, request):
    look, marks = look_of(request), ConstructionMarks()
    marks.show(ConstructionPicture(LEVELS, first=2))
    pixels = shown(viewer, marks)
    assert is_like(at(pixels, (0, 10, 0)), look.selection)
    for number, (x, y, z) in enumerate(LEVELS[0].tolist(), 2):
        assert is_like(at(pixels, (x, y, z)), colour_of_point(number, look.name == "light"))


def test_lines_of_a_level_are_drawn_and_go_with_what_is_shown(viewer, request):
    marks = ConstructionMarks()
    bare = shown(viewer, marks)
    marks.show(ConstructionPicture(LEVELS))
    pixels = shown(viewer, marks)
    assert np.abs(at(pixels, (-10, 10, 0)) - at(bare, (-10, 10, 0))).max() > 60
    marks.show(None)
    np.testing.assert_array_equal(shown(viewer, marks), bare)


def test_strings_chords_and_halves_are_seen_where_they_are(viewer, request):
    marks, plain = ConstructionMarks(), ConstructionPicture(LEVELS)
    marks.show(plain)
    before = shown(viewer, marks)
    line = np.array([(-30.0, -30.0, 0.0), (30.0, -30.0, 0.0)])
    for more in (ConstructionPicture(LEVELS, strings=line[None]), ConstructionPicture(LEVELS, chords=line),
                 ConstructionPicture(LEVELS, halves=(line, line))):  # fmt: skip
        marks.show(more)
        change = np.abs(shown(viewer, marks) - before).max(axis=2)
        x, y = project(ABOVE, [(0, -30, 0)], SIZE)[0, :2].astype(int)
        assert change[y - 2 : y + 3, x].max() > 40
        assert change[y + 20, x] == 0


def test_the_tangent_is_as_long_at_every_distance(viewer, request):
    look, marks = look_of(request), ConstructionMarks()
    marks.show(ConstructionPicture(LEVELS[2:], tangent=np.array([0.0, 1e-3, 0.0])))
    for scale in (50.0, 5000.0):
        camera = Camera(position=(0, 10, 100), target=(0, 10, 0), up=(0, 1, 0), parallel=True, parallel_scale=scale)
        viewer.set_camera(camera)
        pixels = shown(viewer, marks)
        column = np.array([is_like(pixels[row, 200], look.selection) for row in range(300)])
        rows = np.flatnonzero(column)
        assert rows.min() == pytest.approx(150 - 64, abs=3)
        assert rows.max() < 160  # one way only


def test_labels_stand_beside_control_points(viewer, request):
    marks = ConstructionMarks()
    marks.show(ConstructionPicture(LEVELS, first=4))
    shown(viewer, marks)
    labels = [prop for prop in marks.props[1:] if prop.GetVisibility()]
    assert sorted(label.GetInput().strip() for label in labels) == ["P4", "P5", "P6"]
    marks.show(None)
    assert not any(prop.GetVisibility() for prop in marks.props[1:])
