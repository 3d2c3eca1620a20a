"""Outlines edited by mouse and keys in the real window."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from solidtree.model.curve.bezier import evaluated
from solidtree.model.curve.nearest import nearest
from solidtree.model.document.document import Document
from solidtree.model.document.from_outlines import Revolve
from solidtree.model.document.outlines import BSpline, Path
from solidtree.model.path.path import Node
from solidtree.model.spline.bspline import evaluated as on_spline
from solidtree.render.camera import Camera, project
from solidtree.render.curves.curve_marks import Box, knobs_of

pytest_plugins = ["window_driver"]

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE, SHIFT, ALT, CONTROL = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
    Qt.KeyboardModifier.ControlModifier,
)
HILL = Path(
    name="Hill",
    points=((-40, 0), (-40, 20), (-20, 30), (0, 30), (20, 30), (40, 20), (40, 0), (40, -30), (0, -30)),
    segments="MCCLLl",
    joints="cyccc",
)
"""A closed path of five nodes, with a symmetric one at (0, 30)."""
WAVE = BSpline(name="Wave", points=tuple((20.0 * i - 50, 20.0 * (i % 2)) for i in range(6)))


class Hand:
    """The mouse over places of an outline's own axes."""

    def __init__(self, driver) -> None:
        self.driver, self.window = driver, driver.window
        self.curve, self.session = driver.window.curve, driver.session

    def show(self, node, view: Camera | None = None) -> None:
        """An outline alone, selected, seen from above."""
        self.session.open(Document())
        self.session.do("insert", node)
        self.driver.settle()  # the first picture of a window is fitted
        QApplication.processEvents()
        above = Camera(position=(0, 0, 300), target=(0, 0, 0), up=(0, 1, 0), parallel=True, parallel_scale=70)
        self.window.viewport.change(lambda viewer: viewer.set_camera(view or above))
        self.window.viewport.setFocus()
        QApplication.processEvents()

    def pixel(self, place) -> QPoint:
        viewer = self.window.viewport.viewer
        point = np.array([*place, 0.0][:3])
        world = self.curve.frame[:, :3] @ point + self.curve.frame[:, 3]
        x, y, _ = project(viewer.camera, [world], viewer.size)[0]
        return QPoint(round(x), round(y))

    def click(self, place, keys=NONE) -> None:
        QTest.mouseClick(self.window.viewport, LEFT, keys, self.pixel(place))
        QApplication.processEvents()

    def double_click(self, place) -> None:
        self.click(place)
        QTest.mouseDClick(self.window.viewport, LEFT, NONE, self.pixel(place))
        QApplication.processEvents()

    def take(self, place, to, keys=NONE) -> None:
        """Press and drag, the button still held."""
        viewport, begin, end = self.window.viewport, self.pixel(place), self.pixel(to)
        QTest.mousePress(viewport, LEFT, keys, begin)
        for share in (0.4, 0.8, 1.0):
            self._move(begin + (end - begin) * share, keys)

    def _move(self, pixel: QPoint, keys) -> None:
        viewport, place = self.window.viewport, QPointF(pixel)
        nothing = Qt.MouseButton.NoButton
        event = QMouseEvent(QEvent.Type.MouseMove, place, viewport.mapToGlobal(place), nothing, LEFT, keys)
        QApplication.sendEvent(viewport, event)
        QApplication.processEvents()

    def drag(self, place, to, keys=NONE) -> None:
        self.take(place, to, keys)
        QTest.mouseRelease(self.window.viewport, LEFT, keys, self.pixel(to))
        QApplication.processEvents()

    def keys(self, keys: str) -> None:
        self.driver.keys(keys, self.window.viewport)
        QApplication.processEvents()

    @property
    def places(self) -> np.ndarray:
        return self.curve.places

    @property
    def contour(self):
        return self.curve.path.contours[0]


@pytest.fixture
def hand(driver) -> Hand:
    return Hand(driver)


def test_node_is_chosen_and_dragged_by_what_the_pointer_goes(hand: Hand) -> None:
    hand.show(HILL)
    before, steps = hand.session.document, len(hand.session.log)
    hand.click((40, 0))
    assert hand.curve.chosen == {(0, 2)} and hand.session.document is before
    hand.drag((40, 0), (50, 10))
    assert np.allclose(hand.places, [(-40, 0), (0, 30), (50, 10), (40, -30), (0, -30)], atol=1e-9)
    assert np.allclose(hand.contour.points[5], (50, 30))  # its handle went along
    assert hand.curve.chosen == {(0, 2)} and len(hand.session.log) == steps + 1
    assert "move_nodes(" in hand.session.log[-1]
    hand.keys("Ctrl+Z")
    assert hand.session.document is before


def test_several_nodes_move_together_and_keys_go_on(hand: Hand) -> None:
    hand.show(HILL)
    hand.click((40, -30))
    hand.click((0, -30), SHIFT)
    assert hand.curve.chosen == {(0, 3), (0, 4)}
    hand.drag((0, -30), (0, -40))
    assert np.allclose(hand.places[3:], [(40, -40), (0, -40)])
    hand.click((0, -40), SHIFT)
    assert hand.curve.chosen == {(0, 3)}
    hand.keys("Ctrl+A")
    assert len(hand.curve.chosen) == 5
    hand.keys("Escape")
    assert not hand.curve.chosen and hand.session.selection
    hand.keys("Escape")
    assert not hand.session.selection and hand.curve.node is None

    hand.show(HILL)
    hand.click((40, 0))
    for keys in ("Right", "Shift+Up", "Alt+Left"):
        hand.keys(keys)
    assert np.allclose(hand.places[2], (40.9, 10))
    hand.keys("Tab")
    assert hand.curve.chosen == {(0, 3)}
    hand.keys("Shift+Tab")
    assert hand.curve.chosen == {(0, 2)}
    assert hand.window.viewport.hasFocus()


def test_handle_keeps_its_symmetric_partner_and_alt_breaks_it(hand: Hand) -> None:
    hand.show(HILL)
    hand.click((0, 30))
    hand.drag((20, 30), (20, 45))
    assert np.allclose(hand.contour.points[4], (20, 45)) and np.allclose(hand.contour.points[2], (-20, 15))
    hand.drag((20, 45), (10, 55), ALT)
    assert np.allclose(hand.contour.points[4], (10, 55)) and np.allclose(hand.contour.points[2], (-20, 15))
    assert hand.contour.nodes[1] == Node.CUSP
    steps = len(hand.session.log)
    hand.keys("Ctrl+Z")
    assert hand.contour.nodes[1] == Node.SYMMETRIC and len(hand.session.log) == steps - 1


def test_double_click_on_the_curve_inserts_a_node_and_leaves_the_shape(hand: Hand) -> None:
    hand.show(HILL)
    middle = hand.contour.segment(1)
    place = (middle[0] + 3 * middle[1] + 3 * middle[2] + middle[3]) / 8
    old = hand.curve.path
    hand.double_click(place)
    assert len(hand.places) == 6 and hand.curve.chosen == {(0, 2)}
    new = hand.curve.path
    assert new.area() == pytest.approx(old.area(), rel=1e-12) and new.length() == pytest.approx(old.length(), rel=1e-11)
    # Every point of the old segment lies on one of the new ones.
    parameters = np.linspace(0.0, 1.0, 50)
    points = evaluated(old.contours[0].segment(1), parameters)
    away = [min(nearest(new.contours[0].segment(i), point)[1] for i in (1, 2)) for point in points]
    assert max(away) < 1e-9


def test_delete_takes_nodes_out_and_then_the_outline(hand: Hand) -> None:
    hand.show(HILL)
    hand.click((0, 30))
    hand.keys("Delete")
    assert len(hand.places) == 4 and not hand.curve.chosen
    top = hand.curve.path.bounds()[1, 1]
    assert top > 20  # the new curve still goes where the old ones went
    hand.keys("Ctrl+Z")
    hand.click((0, 30))
    hand.keys("Ctrl+Delete")
    assert len(hand.places) == 4
    assert np.allclose(hand.contour.points[[1, 2]], [(-40, 20), (40, 20)])
    assert not hand.curve.chosen
    hand.keys("Delete")
    assert not hand.session.document.profiles


def test_drag_is_given_up_or_ended_by_keys(hand: Hand) -> None:
    hand.show(HILL)
    before = hand.session.document
    hand.take((40, 0), (60, 0))
    assert hand.session.previewing and hand.places[2, 0] == pytest.approx(60)
    hand.keys("Escape")
    assert hand.session.document is before and not hand.session.previewing
    QTest.mouseRelease(hand.window.viewport, LEFT, NONE, hand.pixel((60, 0)))
    assert hand.session.document is before and hand.curve.chosen == {(0, 2)}

    hand.show(HILL)
    hand.take((40, 0), (60, 0))
    hand.driver.write("1.25", hand.window.viewport)
    hand.keys("Tab")
    hand.driver.write("-2", hand.window.viewport)
    hand.keys("Return")
    QTest.mouseRelease(hand.window.viewport, LEFT, NONE, hand.pixel((60, 0)))
    assert hand.places[2].tolist() == [41.25, -2]


def test_empty_ground_chooses_a_frame_turns_the_view_or_drops_the_choice(hand: Hand) -> None:
    hand.show(HILL)
    hand.drag((-55, -45), (55, -10), SHIFT)
    assert hand.curve.chosen == {(0, 3), (0, 4)}
    hand.drag((20, 40), (60, -50), SHIFT | CONTROL)
    assert hand.curve.chosen == {(0, 2), (0, 4)}
    camera, document = hand.window.viewport.viewer.camera, hand.session.document
    hand.drag((-55, -45), (-45, 0))
    assert hand.window.viewport.viewer.camera != camera and hand.session.document is document
    assert hand.curve.chosen == {(0, 2), (0, 4)}

    hand.show(HILL)
    hand.click((40, 0))
    hand.click((-60, 55))
    assert not hand.curve.chosen and hand.session.selection
    hand.click((-60, 55))
    assert not hand.session.selection


def test_curve_is_bent_where_it_is_dragged(hand: Hand) -> None:
    hand.show(HILL)
    hand.drag((20, -30), (20, -40))
    bent = hand.contour.segment(3)
    assert len(bent) == 4
    t = 0.5
    point = bent[0] * (1 - t) ** 3 + 3 * bent[1] * t * (1 - t) ** 2 + 3 * bent[2] * t**2 * (1 - t) + bent[3] * t**3
    assert np.allclose(point, (20, -40), atol=0.2)
    assert np.allclose(hand.places[[3, 4]], [(40, -30), (0, -30)])


def test_box_scales_what_is_chosen(hand: Hand) -> None:
    hand.show(HILL)
    hand.keys("Ctrl+Alt+T")
    assert hand.window.edit_tool.box
    hand.click((40, -30))
    hand.click((0, -30), SHIFT)
    hand.click((40, 0), SHIFT)
    viewer = hand.window.viewport.viewer
    box = Box(np.array([[0.0, -30.0], [40.0, 0.0]]), hand.curve.frame)
    knobs, steps = knobs_of(box, viewer.camera, viewer.size)
    assert steps[2].tolist() == [1, -1]
    corner, wanted = hand.pixel((40, -30)), hand.pixel((60, -60))
    begin = QPoint(round(knobs[2, 0]), round(knobs[2, 1]))
    QTest.mousePress(hand.window.viewport, LEFT, NONE, begin)
    for share in (0.5, 1.0):
        hand._move(begin + (wanted - corner) * share, NONE)
    QTest.mouseRelease(hand.window.viewport, LEFT, NONE, begin + (wanted - corner))
    assert np.allclose(hand.places[[2, 3, 4]], [(60, 0), (60, -60), (0, -60)], atol=1e-4)
    assert np.allclose(hand.places[:2], [(-40, 0), (0, 30)])


def test_control_points_of_a_spline_are_dragged(hand: Hand) -> None:
    hand.show(WAVE)
    hand.drag((-10, 0), (0, -30))
    assert np.allclose(hand.places[2], (0, -30)) and hand.curve.chosen == {(0, 2)}
    knots = len(hand.curve.path.contours[0].splines[0].knots)
    spline = hand.curve.path.contours[0].splines[0]
    area = hand.curve.path.area()
    hand.double_click(on_spline(spline, 0.4))
    assert len(hand.curve.path.contours[0].splines[0].knots) == knots + 1
    assert hand.curve.path.area() == pytest.approx(area, rel=1e-12)


def test_outline_inside_a_solid_is_edited_where_it_stands(hand: Hand) -> None:
    front = Camera(position=(0, -300, 0), target=(0, 0, 0), up=(0, 0, 1), parallel=True, parallel_scale=70)
    hand.show(Revolve(name="Vase", children=(HILL.at(60),)), front)
    inner = hand.session.document.solids[0].children[0]
    hand.session.select([inner.id])
    hand.driver.settle()
    QApplication.processEvents()
    hand.drag((40, 0), (45, 10))
    assert np.allclose(hand.places[2], (45, 10))
    assert hand.session.document.solids[0].children[0].id == inner.id


def test_handles_of_a_mode_take_over_and_give_back(hand: Hand) -> None:
    hand.show(HILL)
    assert hand.window.edit_tool.active
    hand.keys("M")
    hand.keys("Escape")
    assert not hand.window.edit_tool.active
    hand.keys("M")
    hand.keys("M")
    assert hand.window.edit_tool.active
    hand.window.actions_.run("draw_rectangle")
    assert not hand.window.edit_tool.active
    hand.keys("Escape")
    assert hand.window.edit_tool.active


def test_right_click_on_a_node_asks_what_to_do(hand: Hand) -> None:
    hand.show(HILL)
    QTest.mouseClick(hand.window.viewport, RIGHT, NONE, hand.pixel((0, -30)))
    menu = hand.window.findChild(QMenu, "node_menu")
    assert menu is not None and hand.curve.chosen == {(0, 4)}
    next(action for action in menu.actions() if action.objectName() == "break_path").trigger()
    menu.close()
    assert not hand.contour.closed


def test_ends_are_joined_and_kinds_set(hand: Hand) -> None:
    hand.show(HILL)
    hand.click((40, -30))
    hand.keys("Ctrl+Shift+B")
    assert not hand.contour.closed
    hand.curve.choose([])
    hand.keys("Ctrl+Shift+K")
    assert hand.contour.closed
    hand.click((0, 30))
    hand.keys("Ctrl+Alt+1")
    assert hand.curve.chosen and hand.contour.nodes[sorted(hand.curve.chosen)[0][1]] == Node.CUSP

    hand.show(HILL)
    hand.double_click((0, 30))
    assert hand.contour.nodes[1] == Node.AUTO
    hand.double_click((0, 30))
    assert hand.contour.nodes[1] == Node.CUSP


def test_the_ends_of_a_break_are_chosen_and_stay_so_when_they_are_joined(hand: Hand) -> None:
    hand.show(HILL)
    hand.click((40, -30))
    hand.keys("Ctrl+Shift+B")
    assert not hand.contour.closed
    assert hand.curve.chosen == {(0, 0), (0, len(hand.contour.nodes) - 1)}
    hand.window.actions_.run("join_nodes")
    assert hand.contour.closed
    places = [tuple(place) for row, place in zip(hand.curve.rows, hand.places, strict=True) if row in hand.curve.chosen]
    assert places and set(places) == {(40, -30)}
