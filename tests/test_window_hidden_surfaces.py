"""The switch between z-buffer and BSP tree in the real window: what is seen, what is built, and when."""

import numpy as np
import pytest
from handle_hand import LEFT, Hand
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QLabel, QToolBar

from solidtree.model.partition import native
from solidtree.model.script import box, cylinder, document_of, sphere

pytest_plugins = ["window_driver"]


def crossing(balls=0):
    """A plate, a pin through it, and balls: more of them than are sorted within a picture's time."""
    solids = [(box(20, 20, 2).at(-10, -10, -1) - cylinder(radius=2, height=9).at(5, 5, -4)).coloured("#c04040")]
    solids += [cylinder(radius=3, height=14).at(-2, 0, -7).coloured("#3060c0").named("pin")]
    colours = ("#e0c040", "#307040", "#e08060")
    solids += [sphere(4, segments=96).at(3 * i - 8, i - 5, 0).coloured(colours[i % 3]) for i in range(balls)]
    return document_of(*solids)


class Sorted:
    """A driver whose window is asked for trees."""

    def __init__(self, driver):
        self.driver, self.window = driver, driver.window
        self.hidden, self.viewer = driver.window.hidden_surfaces, driver.window.viewport.viewer
        self.viewer.set_style("shaded")

    def settle(self, tree=True):
        """Until nothing is outstanding; with a tree of all that is shown unless told otherwise."""
        self.driver.settle()
        self.driver.qtbot.waitUntil(lambda: self.hidden.at_rest, timeout=20000)
        assert (self.hidden.tree is not None) is tree and self.viewer.painting is tree
        if tree:
            assert self.hidden.tree.faces.count == self.triangles
            assert set(self.hidden.solid_ids) == set(self.viewer.scene.meshes)

    @property
    def triangles(self):
        return sum(len(mesh.triangles) for mesh in self.viewer.scene.meshes.values())

    def picture(self):
        self.viewer.render()
        return self.viewer.pixels().astype(int)

    def assert_as_by_depth(self):
        """The picture is that of the z-buffer, but for pixels beside a border."""
        assert self.viewer.painting
        painted = self.picture()
        self.viewer.set_hidden_surface("zbuffer")
        assert not self.viewer.painting
        plain = self.picture()
        self.viewer.set_hidden_surface("bsp")
        padded = np.pad(plain, ((2, 2), (2, 2), (0, 0)), mode="edge")
        around = [padded[i : i + plain.shape[0], j : j + plain.shape[1]] for i in range(5) for j in range(5)]
        border = (np.max(around, axis=0) - np.min(around, axis=0)).max(axis=2) > 16
        wrong = (np.abs(painted - plain).max(axis=2) > 8) & ~border
        assert wrong.mean() <= 0.0002, wrong.sum()
        assert len(np.unique(plain.reshape(-1, 3), axis=0)) > 100  # something is to be seen

    def colour_at(self, point):
        place = self.driver.pixel_of(point)
        return self.picture()[place.y(), place.x()]


@pytest.fixture
def scene(make_window):
    driver = make_window()
    driver.open(crossing())
    return Sorted(driver)


def words(widget):
    return [label.text() for label in widget.findChildren(QLabel)]


def entry(bar, *titles):
    """The action of a menu bar or menu by the titles on the way."""
    for title in titles:
        (action,) = [a for a in bar.actions() if a.text().replace("&", "") == title]
        bar = action.menu()
    return action


def test_key_menu_and_button_switch_and_keep_selection_and_colours(scene, make_window):
    driver, hidden = scene.driver, scene.hidden
    pin = driver.node("pin")
    driver.session.select([pin.id])
    driver.window.viewport.setFocus()
    assert hidden.mode == "zbuffer" and not scene.viewer.painting and not hidden.builds
    by_depth = scene.colour_at((-2, 0, 7))
    driver.keys("B")
    scene.settle()
    scene.assert_as_by_depth()
    assert np.abs(scene.colour_at((-2, 0, 7)) - by_depth).max() <= 2  # the tint of the selection
    assert driver.session.selection == (pin.id,) and scene.viewer.scene.selection
    assert driver.window.status.hidden_surface.isVisible() and driver.window.status.hidden_surface.text() == "BSP"

    (bar,) = [bar for bar in driver.window.findChildren(QToolBar) if bar.objectName() == "tools"]
    button = bar.widgetForAction(driver.window.actions_["hidden_surface"])
    assert button.isChecked()
    driver.qtbot.mouseClick(button, LEFT)
    assert hidden.mode == "zbuffer" and hidden.tree is None and not scene.viewer.painting and not button.isChecked()
    assert not driver.window.status.hidden_surface.isVisible()

    choice = ("View", "Hidden surfaces")
    assert entry(driver.window.menuBar(), *choice, "z-buffer").isChecked()
    builds = hidden.builds
    entry(driver.window.menuBar(), *choice, "BSP tree").trigger()
    assert button.isChecked() and scene.viewer.painting
    entry(driver.window.menuBar(), *choice, "BSP tree").trigger()  # a choice, not a switch
    assert hidden.mode == "bsp" and hidden.builds == builds, "the tree of the same picture had been kept"
    assert make_window().window.hidden_surfaces.mode == "bsp"


def test_translucent_faces_show_what_is_behind_in_both_modes(scene):
    driver = scene.driver
    driver.look_from("top")
    inside = (-2, 0, 0)
    opaque = scene.colour_at(inside)
    driver.window.viewport.setFocus()
    driver.keys("T")
    by_depth = scene.colour_at(inside)
    assert scene.viewer.scene.opacity == 0.5 and np.abs(by_depth - opaque).max() > 20
    driver.keys("B")
    scene.settle()
    assert np.abs(scene.colour_at(inside) - by_depth).max() <= 12
    driver.keys("T")
    assert scene.viewer.scene.opacity == 1.0
    assert np.abs(scene.colour_at(inside) - opaque).max() <= 2


def test_orbiting_builds_nothing(scene):
    scene.hidden.set_mode("bsp")
    scene.settle()
    builds, viewport, qtbot = scene.hidden.builds, scene.window.viewport, scene.driver.qtbot
    camera = scene.viewer.camera
    orders = set()
    qtbot.mousePress(viewport, LEFT, pos=QPoint(60, 300))
    for i in range(100):
        qtbot.mouseMove(viewport, QPoint(60 + 4 * i, 300 + i))
        scene.viewer.render()
        orders.add(scene.viewer.camera.position)
    qtbot.mouseRelease(viewport, LEFT, pos=QPoint(460, 400))
    scene.settle()
    assert len(orders) > 90 and scene.viewer.camera != camera
    assert scene.hidden.builds == builds
    scene.assert_as_by_depth()


def test_a_part_that_is_dragged_is_seen_where_it_is_and_the_drop_sorts_anew(scene):
    driver, hidden = scene.driver, scene.hidden
    driver.open(crossing(5))
    hidden.set_mode("bsp")
    pin = driver.node("pin")
    driver.session.select([pin.id])
    scene.settle()
    driver.window.viewport.setFocus()
    driver.keys("M")
    hand = Hand(driver)
    start = hand.at("move z")
    hand.press(start)
    for step in (4, 8):  # the first may make all solids coarser
        hand.move(start + QPoint(step, -2 * step))
        driver.settle()
    assert driver.session.previewing
    driver.qtbot.waitUntil(lambda: not driver.window.evaluation.jobs.at_work, timeout=20000)  # what stays is sorted
    for step in (12, 16, 20):
        hand.move(start + QPoint(step, -2 * step))
        driver.settle()
    if native.available():
        assert scene.viewer.painting and hidden.tree.faces.count == scene.triangles
        scene.assert_as_by_depth()
    else:
        assert not scene.viewer.painting and driver.window.status.hidden_surface.text() == "z-buffer"
    builds = hidden.builds
    hand.release(start + QPoint(20, -40))
    assert not driver.session.previewing
    scene.settle()
    assert hidden.builds > builds and hidden.solid_ids == tuple(root.id for root in driver.document.solids)
    scene.assert_as_by_depth()
    builds = hidden.builds
    driver.session.undo()
    driver.settle()
    assert scene.viewer.painting and hidden.tree.faces.count == scene.triangles


def test_a_large_model_is_sorted_by_the_worker_and_cancel_leaves_the_z_buffer(scene):
    driver, hidden, status = scene.driver, scene.hidden, scene.window.status
    driver.open(crossing(9))
    hidden.set_mode("bsp")
    assert hidden.sorting and hidden.tree is None and not scene.viewer.painting
    assert status.hidden_surface.text() == "z-buffer" and "sorted" in status.hidden_surface.toolTip()
    driver.qtbot.waitUntil(lambda: driver.window.evaluation.jobs.partitioning, timeout=5000)
    driver.window.actions_.run("cancel")
    scene.settle(tree=False)
    assert "cancelled" in status.currentMessage() and status.hidden_surface.text() == "z-buffer"
    assert hidden.mode == "bsp" and not hidden.builds
    entry(driver.window.menuBar(), "View", "Hidden surfaces", "BSP tree").trigger()
    scene.settle()
    assert hidden.builds == 1 and status.hidden_surface.text() == "BSP"
    scene.assert_as_by_depth()


@pytest.mark.skipif(not native.available(), reason="nothing is sorted ahead without the compiled builder")
def test_what_was_given_up_is_not_asked_for_again_by_itself(scene):
    driver, hidden, jobs = scene.driver, scene.hidden, scene.window.evaluation.jobs
    driver.open(crossing(9))
    driver.session.select([driver.node("pin").id])
    hidden.set_mode("bsp")
    driver.qtbot.waitUntil(lambda: jobs.partitioning, timeout=5000)
    jobs.cancel()
    scene.settle(tree=False)
    hidden.set_mode("bsp")
    driver.qtbot.waitUntil(lambda: hidden.builds == 1 and jobs.partitioning, timeout=20000)  # what stays when pin moves
    jobs.cancel()
    scene.settle()
    assert hidden.builds == 1


def test_a_long_sort_shows_what_is_going_on(scene):
    driver, hidden, status = scene.driver, scene.hidden, scene.window.status
    driver.open(document_of(*(sphere(9, segments=400).at(i, 0.7 * i, 0.3 * i) for i in range(4))))
    hidden.set_mode("bsp")
    with driver.qtbot.waitSignal(driver.window.evaluation.busy, timeout=5000) as told:
        pass
    assert told.args == [True] and status.busy.isVisible() and "Sorting faces" in words(status.busy)
    hidden.set_mode("zbuffer")  # nobody waits for it any more
    assert not status.busy.isVisible() and hidden.at_rest


def test_hidden_isolated_and_other_solids_get_trees_of_their_own_and_nothing_gets_none(scene):
    driver, hidden, session = scene.driver, scene.hidden, scene.driver.session
    hidden.set_mode("bsp")
    scene.settle()
    pin = driver.node("pin")
    session.do("set_visible", [pin.id], False)
    scene.settle()
    assert pin.id not in hidden.solid_ids
    session.undo()
    scene.settle()
    assert pin.id in hidden.solid_ids
    session.isolate([pin.id])
    scene.settle()
    assert hidden.solid_ids == (pin.id,)
    scene.assert_as_by_depth()
    session.isolate([])
    scene.settle()
    driver.open(document_of(sphere(3)))
    scene.settle()
    (ball,) = driver.document.solids
    assert hidden.solid_ids == (ball.id,) and hidden.tree.nodes == 1
    builds = hidden.builds
    session.do("delete", [ball.id])
    scene.settle(tree=False)
    assert hidden.builds == builds and hidden.at_rest
    session.undo()
    scene.settle()
    assert hidden.builds == builds
