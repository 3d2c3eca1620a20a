"""Drawing outlines in the real window: by mouse, by numbers, on faces, and giving up."""

import numpy as np
import pytest
from drawing_hand import Drawer
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from solidtree.model.document.outlines import BSpline
from solidtree.model.document.placement import product
from solidtree.model.outline.paths import own_path, path_of
from solidtree.model.script import box, document_of, path

pytest_plugins = ["window_driver"]
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def drawer(make_window):
    driver = make_window()
    driver.look_from("top")
    return Drawer(driver)


def test_the_pen_draws_corners_and_a_curve_closes_and_is_one_step(drawer):
    driver, empty = drawer.driver, drawer.driver.document
    driver.keys("Shift+P", drawer.viewport)
    assert drawer.tool.kind == "pen"
    drawer.click(0.2, 0.1)
    drawer.drag((30, 0), (30, 5), (30, 10))
    drawer.click(0, 20)
    drawer.click(0.1, -0.1)
    assert not drawer.tool.active and driver.session.undo_label == "Draw path"
    (contour,) = path_of(drawer.drawn).contours
    assert contour.closed and contour.kinds.tolist() == [3, 3, 1]
    assert contour.points.tolist() == [[0, 0], [0, 0], [30, -10], [30, 0], [30, 10], [0, 20], [0, 20], [0, 0]]
    assert contour.nodes.tolist() == [0, 2, 0]
    driver.session.undo()
    assert driver.document is empty


def test_the_welcome_card_makes_room_for_what_is_drawn(drawer):
    welcome = drawer.driver.window.welcome
    assert welcome.isVisible()
    drawer.start("pen")
    assert not welcome.isVisible()
    drawer.driver.keys("Escape", drawer.viewport)
    assert not drawer.tool.active and welcome.isVisible()
    drawer.start("pen")
    for corner in ((0, 0), (20, 0), (20, 15), (0, 0)):
        drawer.click(*corner)
    drawer.driver.keys("Escape", drawer.viewport)
    assert not welcome.isVisible()


def test_enter_ends_an_open_path_and_backspace_takes_nodes_back(drawer):
    drawer.start("pen")
    drawer.click(0, 0)
    drawer.click(20, 0)
    drawer.click(20, 10)
    drawer.driver.keys("Backspace", drawer.viewport)
    drawer.click(30, 10)
    drawer.driver.keys("Return", drawer.viewport)
    (contour,) = path_of(drawer.drawn).contours
    assert not contour.closed and contour.points.tolist() == [[0, 0], [20, 0], [30, 10]]


def test_numbers_set_nodes_exactly(drawer):
    drawer.start("pen")
    drawer.move(3, 3)
    drawer.type("1.25\t-2.5")
    drawer.type("10<90")
    drawer.type("4, 7.5")
    drawer.driver.keys("C", drawer.viewport)
    (contour,) = path_of(drawer.drawn).contours
    assert contour.closed and contour.places.tolist() == [[1.25, -2.5], [1.25, 7.5], [4, 7.5]]


def test_shift_holds_directions_at_steps_of_15_degrees(drawer):
    drawer.start("pen")
    drawer.click(0, 0)
    drawer.move(20, 6)
    drawer.driver.qtbot.mouseClick(drawer.viewport, LEFT, Qt.KeyboardModifier.ShiftModifier, drawer.pixel(20, 6))
    drawer.driver.keys("Return", drawer.viewport)
    x, y = path_of(drawer.drawn).contours[0].points[1]
    assert np.degrees(np.arctan2(y, x)) == pytest.approx(15, abs=1e-6) and 18 < np.hypot(x, y) < 24


def test_a_rectangle_by_typed_numbers_is_exact(drawer):
    drawer.start("rectangle")
    drawer.click(10, 10)
    drawer.move(25, 5)
    drawer.type("20\t12.5")
    assert path_of(drawer.drawn).bounds().tolist() == [[10, -2.5], [30, 10]]
    assert path_of(drawer.drawn).area() == pytest.approx(250)


def test_shapes_by_a_drag_and_by_clicks(drawer):
    drawer.start("rectangle")
    drawer.drag((0, 0), (10, 5), (20, 10), modifiers=Qt.KeyboardModifier.NoModifier)
    assert path_of(drawer.drawn).bounds().tolist() == [[0, 0], [20, 10]]
    drawer.start("ellipse")
    drawer.click(0, 0)
    drawer.move(8, 8)
    drawer.type("15")
    assert path_of(drawer.drawn).area() == pytest.approx(np.pi * 225, rel=1e-3)
    drawer.start("polygon")
    drawer.click(0, 0)
    drawer.move(10, 0)
    drawer.driver.keys("Up", drawer.viewport)
    drawer.click(10, 0)
    assert len(path_of(drawer.drawn).contours[0]) == 7


def test_splines_through_points_and_by_control_points(drawer):
    places = [(0, 0), (10, 20), (30, 20), (40, 0)]
    for kind in ("control_points", "through_points"):
        drawer.start(kind)
        for place in places:
            drawer.click(*place)
        drawer.driver.keys("Return", drawer.viewport)
        assert isinstance(drawer.drawn, BSpline)
    (contour,) = path_of(drawer.drawn).contours
    from solidtree.model.path.flatten import flatten

    (line,) = flatten(own_path(drawer.drawn), 1e-3)
    assert all(np.linalg.norm(line - place, axis=1).min() < 0.1 for place in places)
    assert contour.places.tolist() == [[0, 0], [40, 0]]


def test_a_freehand_circle_becomes_a_few_smooth_cubics(drawer):
    drawer.start("freehand")
    turn = np.radians(np.linspace(0, 357, 90))
    drawer.drag(*zip((20 * np.cos(turn)).tolist(), (20 * np.sin(turn)).tolist(), strict=True))
    (contour,) = path_of(drawer.drawn).contours
    assert contour.closed and len(contour) <= 12 and set(contour.nodes.tolist()) == {1}
    assert path_of(drawer.drawn).area() == pytest.approx(np.pi * 400, rel=0.02)


def test_escape_leaves_the_document_as_it_was(drawer):
    document = drawer.driver.document
    for kind in ("pen", "rectangle", "arc", "through_points"):
        drawer.start(kind)
        drawer.click(0, 0)
        assert drawer.tool.begun
        drawer.driver.keys("Escape", drawer.viewport)
        assert drawer.tool.active and not drawer.tool.begun
        drawer.driver.keys("Escape", drawer.viewport)
        assert not drawer.tool.active
    assert drawer.driver.document is document and drawer.driver.session.undo_label is None


def test_the_right_button_ends_a_path_and_pans_when_it_is_dragged(drawer):
    drawer.start("pen")
    drawer.click(0, 0)
    drawer.click(20, 0)
    viewer = drawer.viewport.viewer
    before, right = viewer.camera, Qt.MouseButton.RightButton
    QTest.mousePress(drawer.viewport, right, Qt.KeyboardModifier.NoModifier, drawer.pixel(10, 10))
    drawer.send(drawer.pixel(10, 10) + QPoint(30, 0), right)
    drawer.send(drawer.pixel(10, 10) + QPoint(60, 0), right)
    QTest.mouseRelease(drawer.viewport, right, Qt.KeyboardModifier.NoModifier, drawer.pixel(10, 10) + QPoint(60, 0))
    assert viewer.camera != before and drawer.tool.begun
    drawer.driver.qtbot.mouseClick(drawer.viewport, right, pos=drawer.pixel(10, 10))
    assert not drawer.tool.active and len(path_of(drawer.drawn).contours[0]) == 1


def test_what_is_drawn_on_a_face_lies_on_it(make_window):
    driver = make_window(document_of(block=box(40, 30, 12)))
    driver.look_from("top")
    drawer = Drawer(driver, 12.0)
    driver.window.actions_.run("work_plane_face")
    driver.click_at((30, 20, 12))
    assert driver.window.work_plane.name == "face"
    drawer.start("rectangle")
    drawer.drag((0.1, 0.1), (5, 5), (40, 30))  # a corner of the block, and the one across
    matrix = drawer.drawn.placement.matrix()
    low, high = own_path(drawer.drawn).bounds()
    corners = product(matrix, np.column_stack((np.eye(3)[:, :2], np.zeros(3), np.append(low, 0.0))))[:, 3]
    assert corners == pytest.approx([0, 0, 12], abs=1e-6) and (high - low).tolist() == pytest.approx([40, 30])


def test_the_pen_goes_on_from_an_open_end_of_the_selected_path(make_window):
    line = path([("move", (0, 0)), ("line", (20, 0))])
    driver = make_window()
    driver.session.do("insert", line)
    driver.look_from("top")
    drawer = Drawer(driver)
    drawer.start("pen")
    drawer.click(0.1, 0.1)
    drawer.click(0, 20)
    drawer.click(20, 0)  # its other end
    (contour,) = path_of(drawer.drawn).contours
    assert contour.closed and len(driver.document.roots) == 1
    assert sorted(contour.places.tolist()) == [[0, 0], [0, 20], [20, 0]]
