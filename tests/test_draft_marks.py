"""The marks of a draft in the picture: its lines, nodes and handles in their colours, and the grid of its plane."""

import numpy as np
import pytest

from solidtree.render.camera import Camera
from solidtree.render.curves.draft_marks import DraftMarks, DraftPicture, PlaneMark
from solidtree.render.look import look_of, rgb
from solidtree.render.viewer import Viewer

TOP = Camera((0.0, 0.0, 300.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))


@pytest.fixture(params=["light", "dark"])
def viewer(request):
    made = Viewer(theme=request.param)
    made.resize(400, 400)
    made.set_camera(TOP)
    made.set_ground(False)
    made.set_cube(False)
    yield made
    made.close()


def pixels(viewer) -> np.ndarray:
    viewer.render()
    return viewer.pixels().astype(int)


def near(pixels: np.ndarray, colour, row: slice, column: slice) -> int:
    wanted = np.round(255 * np.array(colour))
    return int((np.abs(pixels[row, column] - wanted).max(axis=2) < 40).sum())


def test_nodes_are_where_they_are_and_nothing_is_left(viewer):
    empty = pixels(viewer)
    marks = DraftMarks()
    viewer.overlay.add(marks)
    places = np.array([(-40.0, 0.0, 0.0), (40.0, 0.0, 0.0)])
    marks.show(DraftPicture([places], nodes=places))
    drawn = pixels(viewer)
    accent = rgb(look_of(viewer.scene.look.name).selection)
    step = 400 / (2 * TOP.half_height)
    column = round(200 - 40 * step)
    assert near(drawn, accent, slice(190, 210), slice(column - 8, column + 8)) > 30  # the first node is filled
    assert (np.abs(drawn[199:202, 180:220] - empty[199:202, 180:220]).max(axis=2) > 60).any(axis=0).all()  # the line
    assert (drawn[:150] == empty[:150]).all()
    marks.show(None)
    assert (pixels(viewer) == empty).all()


def test_a_plane_shows_its_grid_where_it_stands(viewer):
    empty = pixels(viewer)
    mark = PlaneMark(viewer.overlay.renderer)
    viewer.overlay.add(mark)
    mark.show(np.eye(3, 4))
    assert (pixels(viewer) != empty).any(axis=2).mean() > 0.05
    mark.show(np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]]))  # seen from its edge
    assert (pixels(viewer) != empty).any(axis=2).mean() < 0.02
    mark.show(None)
    assert (pixels(viewer) == empty).all()
