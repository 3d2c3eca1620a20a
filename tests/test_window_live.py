"""Contacts while a part is dragged, in the real window: lit up, stopping, sliding, one step, replayed."""

import numpy as np
import pytest
from handle_hand import Hand
from PySide6.QtCore import QPoint
from replay import replayed

from solidtree.model.document.table import same_document
from solidtree.model.proximity.bodies import relation
from solidtree.model.proximity.checks import Checks
from solidtree.model.proximity.memo import body_of
from solidtree.model.script import box, document_of, sphere
from solidtree.model.solid.results import evaluate_document
from solidtree.render.camera import project

pytest_plugins = ["window_driver"]

PART = "part"


@pytest.fixture
def opened(make_window):
    """The window with a part on a floor before a wall, 20 mm away, which is chosen."""

    def make(**more):
        solids = {
            "floor": box(120, 120, 8).at(-60, -60, -8),
            "wall": box(10, 80, 40).at(30, -40, 0),
            PART: box(20).at(-10, -10, 0),
        }
        driver = make_window(document_of(**(solids | more)))
        driver.window.handles.set_snapping(False)
        driver.look_from("iso")
        choose(driver, PART)
        return driver

    return make


def choose(driver, name):
    driver.session.select([driver.node(name).id])
    driver.settle()


def hold(driver, handle, by):
    """Catch a handle and drag it by (3,) mm of the world, in some moves; the button stays down."""
    hand = Hand(driver)
    start = hand.at(handle)
    viewer = driver.window.viewport.viewer
    (found,) = (one for one in hand.marks.handles if one.name == handle)
    a, b = project(viewer.camera, [found.origin, found.origin + np.asarray(by, float)], viewer.size)[:, :2]
    hand.press(start)
    for share in (0.3, 0.7, 1.0):
        place = start + QPoint(*(round(c) for c in share * (b - a)))
        hand.move(place)
    return hand, place


def label(driver):
    return driver.window.handles._picture._label.text


def lit(driver):
    return driver.window.handles.contacts._marks.lit


def between(driver, one, other):
    """How two solids of the document stand to each other, cut anew."""
    results = {result.root.name: result for result in evaluate_document(driver.document).solids}
    return relation(body_of(results[one]), body_of(results[other]), 1000.0)


def pixels(driver):
    driver.window.viewport.viewer.render()
    return driver.window.viewport.viewer.pixels().astype(int)


def test_what_is_met_lights_up_and_is_named_beside_the_pointer(opened):
    driver = opened()
    before = driver.document
    spot = driver.pixel_of((35.0, 0.0, 40.0))  # on top of the wall
    plain = pixels(driver)[spot.y(), spot.x()]
    hand, place = hold(driver, "move x", (26.0, 0.0, 0.0))
    assert "overlaps “wall”" in label(driver) and "touches “floor”" in label(driver)
    assert lit(driver) == {"overlaps": 1, "touches": 1}
    red, green, _ = pixels(driver)[spot.y(), spot.x()] - plain
    assert red - green > 20
    hand.move(hand.at("move x") + QPoint(-200, -60))
    assert "overlaps" not in label(driver) and lit(driver) == {"touches": 1}
    driver.keys("Escape", driver.window.viewport)
    assert driver.document is before and lit(driver) == {} and not driver.window.handles.contacts.found
    hand.release(place)

    # The document's clearance says what is too near.
    for clearance, expected in ((0.0, {"touches": 1}), (50.0, {"touches": 1, "close": 1})):
        driver.session.commit("Clearance", driver.document.with_(checks=Checks(clearance)))
        driver.settle()
        hand, place = hold(driver, "move x", (6.0, 0.0, 0.0))
        assert lit(driver) == expected
        assert (" mm to “wall”" in label(driver)) or not clearance
        driver.keys("Escape", driver.window.viewport)
        hand.release(place)
    driver.window.actions_.run("contacts_off")
    hand, place = hold(driver, "move x", (26.0, 0.0, 0.0))
    assert "“" not in label(driver) and lit(driver) == {}
    hand.release(place)


def test_a_drag_stops_at_the_wall_in_one_step_that_replays(opened):
    driver = opened()
    driver.window.actions_.run("contacts_stop")
    before = driver.document
    hand, place = hold(driver, "move x", (60.0, 0.0, 0.0))
    assert "touches “wall”" in label(driver) and label(driver).startswith("20 mm")
    hand.release(place)
    assert driver.session.undo_label == "Move" and len(driver.session.log) == 1
    assert driver.node(PART).placement.matrix()[:, 3].tolist() == [10.0, -10.0, 0.0]
    assert between(driver, PART, "wall").kind == "touching" and between(driver, PART, "floor").kind == "touching"
    same_document(replayed(driver.session.log, before), driver.document)
    driver.keys("Ctrl+Z", driver.window.viewport)
    assert driver.document is before
    assert driver.window.settings.choice("contacts", ("show", "stop")) == "stop"
    # At once again, before the picture has followed: what it shows of the part is where that was.
    hand, place = hold(driver, "move x", (60.0, 0.0, 0.0))
    hand.release(place)
    assert driver.node(PART).placement.matrix()[:, 3].tolist() == [10.0, -10.0, 0.0]
    hand, place = hold(driver, "move x", (30.0, 0.0, 0.0))
    hand.release(place)
    assert driver.node(PART).placement.matrix()[:, 3].tolist() == [10.0, -10.0, 0.0]


def test_a_part_slides_along_floor_and_wall(opened):
    driver = opened()
    driver.keys("Shift+K", driver.window.viewport)
    assert driver.window.actions_["contacts_slide"].isChecked()
    hand, place = hold(driver, "move xy", (60.0, 25.0, 0.0))
    hand.release(place)
    x, y, z = driver.node(PART).placement.matrix()[:, 3]
    assert x == 10.0 and z == 0.0 and y == pytest.approx(15.0, abs=3.0)
    assert between(driver, PART, "wall").kind == between(driver, PART, "floor").kind == "touching"


def test_a_ball_that_stops_at_a_ball_touches_without_overlap(opened):
    driver = opened(one=sphere(12, segments=48).at(-40, -40, 30), two=sphere(12, segments=48).at(-36, 20, 33))
    choose(driver, "two")
    driver.window.actions_.run("contacts_stop")
    hand, place = hold(driver, "move y", (0.0, -50.0, 0.0))
    hand.release(place)
    found = between(driver, "one", "two")
    assert found.gap == pytest.approx(0.0, abs=1e-8) and found.kind != "overlapping"
    apart = np.linalg.norm(driver.node("two").placement.matrix()[:, 3] - [-40.0, -40.0, 30.0])
    assert apart == pytest.approx(24.0, abs=0.1)


def test_typed_numbers_are_what_they_are_and_a_turn_stops(opened):
    posts = {"left": box(4, 4, 30).at(-15, 55, 10), "right": box(4, 4, 30).at(-15, 37, 10)}
    driver = opened(bar=box(40, 6, 10).at(-20, 45, 20), **posts)
    driver.window.actions_.run("contacts_stop")
    driver.keys("M", driver.window.viewport)
    driver.write("30", driver.window.viewport)
    assert "overlaps “wall”" in label(driver)
    driver.keys("Return", driver.window.viewport)
    assert driver.node(PART).placement.matrix()[0, 3] == 20.0
    choose(driver, "bar")
    driver.keys("R", driver.window.viewport)
    hand = Hand(driver)
    start = hand.at("turn z")
    hand.press(start)
    for x in range(20, 161, 20):
        hand.move(start + QPoint(x, x))
    turned = driver.window.handles._drag.angle()
    hand.release(start + QPoint(160, 160))
    assert 5.0 < abs(turned) < 60.0 and turned != round(turned)
    for post in posts:
        assert between(driver, "bar", post).kind in ("apart", "touching")
    assert min(between(driver, "bar", post).gap for post in posts) < 1e-5


def test_a_node_inside_a_part_tells_what_the_part_meets(opened):
    driver = opened(
        frame=box(10).at(-50, -50, 20) + box(5).named("arm").at(-45, -40, 20), pole=box(5, 5, 60).at(-20, -40, 0)
    )
    choose(driver, "arm")
    hand, place = hold(driver, "move x", (25.0, 0.0, 0.0))
    driver.qtbot.waitUntil(lambda: "overlaps “pole”" in label(driver))
    driver.keys("Escape", driver.window.viewport)
    hand.release(place)
