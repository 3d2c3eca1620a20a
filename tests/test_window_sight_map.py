"""What is seen from here, and visibility maps, in the real window."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint
from test_window_sight import PLATE, POST, ROOF, said

from solidtree.model.measuring.visibility import HIDDEN, SEEN
from solidtree.model.script import box, document_of

pytest_plugins = ["window_driver"]


@pytest.fixture
def scene(make_window):
    driver = make_window(document_of(plate=PLATE, post=POST, roof=ROOF))
    driver.look_from("iso")
    return driver


def answered(driver) -> None:
    driver.qtbot.waitUntil(lambda: driver.window.sight.seen.view is not None, timeout=15000)


def greenness(window) -> float:
    """The share of the picture that is painted green."""
    pixels = window.viewport.viewer.pixels().astype(int)
    return float((pixels[..., 1] - pixels[..., 0] > 40).mean())


def test_a_click_tells_how_much_of_a_part_is_seen_and_a_turn_of_the_view_asks_anew(scene):
    window, seen = scene.window, scene.window.sight.seen
    scene.keys("Shift+V", window.viewport)
    assert window.sight.mode == "part" and "Click a part" in said(scene)
    scene.click_at((36, 4, 12))
    answered(scene)
    assert "of “plate” that is turned this way is seen from here; “post” hides" in said(scene)
    assert seen.view.hiders[0][0] == scene.node("post").id and 0.5 < seen.view.share < 0.95
    before = seen.view.share
    scene.look_from("bottom")
    scene.qtbot.waitUntil(lambda: seen.view is not None and seen.view.share != before, timeout=15000)
    assert "“post”" not in said(scene)  # it stands on the other side
    scene.keys("Escape", window.viewport)
    assert seen.view is None and window.sight.active
    scene.keys("Escape", window.viewport)
    assert not window.sight.active and said(scene) == ""


def test_a_point_and_a_face_give_a_map_that_is_painted_and_follows_the_model(scene):
    window, seen = scene.window, scene.window.sight.seen
    window.actions_.run("visibility_map")
    assert "Click the point to look from" in said(scene)
    scene.click_at((-3, 16, 37))
    assert "Click the face" in said(scene)
    scene.click_at((36, 4, 12))
    answered(scene)
    found = seen.view.visibility
    assert found.part(SEEN) + found.part(HIDDEN) == pytest.approx(40 * 30 - np.pi * 16, rel=0.01)
    assert "“roof” hides" in said(scene) and "“post” hides" in said(scene)
    with_post = seen.view.share
    scene.session.do("delete", [scene.node("post").id])
    scene.settle()
    answered(scene)
    assert seen.view.share > with_post and "“post”" not in said(scene)
    scene.session.undo()
    scene.settle()
    answered(scene)
    assert seen.view.share == pytest.approx(with_post)
    scene.keys("Escape", window.viewport)
    scene.keys("Escape", window.viewport)
    assert not window.sight.active


def test_the_map_is_gone_from_the_picture_when_the_tool_ends(scene):
    window = scene.window
    window.viewport.viewer.render()
    before = window.viewport.viewer.pixels()
    window.actions_.run("visibility_map")
    scene.keys("Return", window.viewport)  # from here
    scene.click_at((36, 4, 12))
    answered(scene)
    scene.qtbot.wait(50)
    assert greenness(window) > 0.02
    window.actions_.run("visibility_map")
    assert not window.sight.active
    scene.qtbot.mouseMove(window.viewport, QPoint(3, 3))
    scene.qtbot.wait(50)
    assert (window.viewport.viewer.pixels() == before).all()


def test_a_part_with_nothing_before_it_is_seen_as_a_whole(make_window):
    driver = make_window(document_of(block=box(10)))
    driver.look_from("iso")
    driver.keys("Shift+V", driver.window.viewport)
    driver.click_at((5, 5, 10))
    answered(driver)
    assert said(driver).startswith("All of “block” that is turned this way is seen from here")
