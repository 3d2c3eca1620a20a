"""Lines of sight in the real window: two clicks, gap and wall of a face, and what happens when the model changes."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint

from solidtree.model.script import box, cylinder, document_of, sphere

pytest_plugins = ["window_driver"]
PLATE = box(40, 30, 12) - cylinder(4, 40, centred=True).at(10, 10)
POST = cylinder(3, 30).named("post").at(20, 6, 12)
ROOF = box(46, 8, 3).named("roof").at(-3, 16, 34)


@pytest.fixture
def scene(make_window):
    driver = make_window(document_of(plate=PLATE, post=POST, roof=ROOF))
    driver.look_from("iso")
    return driver


def said(driver) -> str:
    return driver.window.status.currentMessage()


def shows(driver, *colours: str) -> list[bool]:
    """Whether the picture has pixels of these colours, more or less."""
    driver.qtbot.wait(50)
    pixels = driver.window.viewport.viewer.pixels()[..., :3].astype(int)
    wanted = [np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) for colour in colours]
    return [bool(((np.abs(pixels - one).max(axis=2)) < 12).sum() > 40) for one in wanted]


GREEN, RED = "#14803c", "#c62f25"


@pytest.mark.parametrize("mode", ["zbuffer", "bsp"])
def test_two_clicks_tell_what_is_in_the_way_in_both_modes(scene, mode):
    window = scene.window
    window.hidden_surfaces.set_mode(mode)
    scene.keys("Shift+L", window.viewport)
    assert window.sight.active and "Click a point" in said(scene)
    scene.click_at((0, 0, 12))
    scene.click_at((40, 12, 12))
    sight = window.sight.sight
    assert sight is not None and sight.obstacle is not None
    assert 14 < sight.obstacle.distance < 20 and "“post” is in the way" in said(scene)
    assert shows(scene, GREEN, RED) == [True, True]
    scene.click_at((0, 0, 12))
    scene.click_at((40, 0, 12))
    assert window.sight.sight is not None and window.sight.sight.clear and said(scene).startswith("Clear: 40 mm")
    assert shows(scene, GREEN, RED) == [True, False]


def test_gap_and_wall_of_a_face(scene):
    window = scene.window
    scene.keys("Shift+R", window.viewport)
    scene.click_at((36, 20, 12))
    gap, wall = window.sight.about
    assert gap.distance == pytest.approx(22) and wall.distance == pytest.approx(12)
    assert "“roof” is 22 mm before this face; the wall is 12 mm thick" in said(scene)
    scene.click_at((40, 15, 6))
    gap, wall = window.sight.about
    assert gap is None and wall.distance == pytest.approx(40) and "Nothing stands before" in said(scene)


def test_what_changes_is_judged_anew_and_the_points_stay(scene):
    window = scene.window
    scene.keys("Shift+L", window.viewport)
    scene.click_at((0, 0, 12))
    scene.click_at((40, 12, 12))
    points = window.sight.points
    assert not window.sight.sight.clear
    scene.session.do("delete", [scene.node("post").id])
    scene.settle()
    assert window.sight.points == points and window.sight.sight.clear
    scene.session.undo()
    scene.settle()
    assert not window.sight.sight.clear
    scene.look_from("top")
    assert window.sight.points == points and not window.sight.sight.clear


def test_escape_takes_the_first_point_back_then_ends_and_nothing_is_left(scene):
    window = scene.window
    window.viewport.viewer.render()
    before = window.viewport.viewer.pixels()
    scene.keys("Shift+L", window.viewport)
    scene.click_at((0, 0, 12))
    assert len(window.sight.points) == 1
    scene.keys("Escape", window.viewport)
    assert window.sight.active and not window.sight.points
    scene.keys("Escape", window.viewport)
    assert not window.sight.active and said(scene) == "" and scene.session.selection == ()
    scene.qtbot.mouseMove(window.viewport, QPoint(3, 3))
    scene.qtbot.wait(50)
    assert (window.viewport.viewer.pixels() == before).all()


def test_other_tools_end_it_and_it_ends_them(scene):
    window = scene.window
    scene.keys("Shift+M", window.viewport)
    scene.keys("Shift+L", window.viewport)
    assert window.sight.active and not window.measure.active
    scene.keys("Shift+R", window.viewport)
    assert window.sight.mode == "ray"
    scene.keys("Shift+M", window.viewport)
    assert window.measure.active and not window.sight.active
    scene.keys("Shift+L", window.viewport)
    scene.open(document_of(box(10)))
    assert not window.sight.active


def test_a_large_model_is_sorted_by_the_worker_while_the_window_goes_on(make_window):
    ball = sphere(8, segments=256).at(20, 6, 30)
    driver = make_window(document_of(plate=PLATE, post=POST, ball=ball))  # too much for a picture to wait for its tree
    driver.look_from("iso")
    window = driver.window
    driver.keys("Shift+L", window.viewport)
    driver.click_at((0, 0, 12))
    driver.click_at((40, 12, 12))
    assert window.sight.sight is None and "being sorted" in said(driver)
    driver.qtbot.waitUntil(lambda: window.sight.sight is not None, timeout=15000)
    assert not window.sight.sight.clear and "“post”" in said(driver)
    assert window.hidden_surfaces.tree is None  # the picture is still drawn with the z-buffer
