"""The B-spline page of the Curve panel, with mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QHelpEvent, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit

from solidtree.model.document.document import Parameter
from solidtree.model.document.outlines import Bezier, BSpline, Path
from solidtree.model.operations.curves.addressing import plain_values
from solidtree.model.operations.curves.deviations import deviation
from solidtree.model.outline.paths import path_of
from solidtree.model.script import bezier, bspline, document_of

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton
PLAIN, ALT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.AltModifier
WAVE = [(0, 0), (5, 20), (15, 25), (25, 0), (40, -5), (45, 20), (60, 18), (70, 0)]
KNOTS = (0, 0, 0, 0, 0.15, 0.3, 0.3, 0.8, 1, 1, 1, 1)


class Page:
    def __init__(self, driver) -> None:
        self.driver, self.window, self.qtbot = driver, driver.window, driver.qtbot
        self.start = driver.document
        driver.session.select([self.node.id])
        driver.keys("V", self.window.viewport)
        self.window.curve_panel.show_page("B-spline")
        self.page = self.window.spline_page
        self.line = self.page.knots.line
        assert self.line.isVisible() == isinstance(self.node, BSpline)

    @property
    def node(self):
        return self.driver.document.profiles[0]

    @property
    def steps(self) -> int:
        """Of the history since the beginning: undone, counted and done again."""
        count = 0
        while self.driver.document is not self.start:
            self.driver.session.undo()
            count += 1
        for _ in range(count):
            self.driver.session.redo()
        return count

    def place(self, number: int) -> QPoint:
        return self.line.place_of(number).toPoint()

    def across(self, parameter: float, weight: float = 0.0) -> QPoint:
        return QPoint(round(self.line.room.x(parameter)), round(self.line.room.y(weight)))

    def move(self, place: QPoint, modifiers=PLAIN) -> None:
        where = QPointF(place)
        event = QMouseEvent(QEvent.Type.MouseMove, where, self.line.mapToGlobal(where), Qt.MouseButton.NoButton, LEFT,
                            modifiers)  # fmt: skip
        QApplication.sendEvent(self.line, event)

    def drag(self, number: int, parameters: list[float], modifiers=PLAIN, release: bool = True) -> None:
        begin = self.place(number)
        QTest.mousePress(self.line, LEFT, modifiers, begin)
        for parameter in parameters:
            place = QPoint(self.across(parameter).x(), begin.y())
            self.move(place, modifiers)
        if release:
            QTest.mouseRelease(self.line, LEFT, modifiers, place)

    def moved(self) -> float:
        return deviation(self.start.profiles[0], plain_values(self.driver.document, self.node))


@pytest.fixture
def page(make_window):
    made = Page(make_window(document_of(wave=bspline(WAVE, knots=KNOTS))))
    yield made
    made.driver.settle()


@pytest.fixture
def pixel(page) -> float:
    return page.line.room.step


def test_a_knot_follows_the_pointer_and_is_one_step(page, pixel):
    page.drag(7, [0.7, 0.55, 0.6], release=False)
    assert page.window.session.previewing and page.node.knots[7] == pytest.approx(0.6, abs=pixel)
    assert page.line.basis.knots[7] == page.node.knots[7]
    QTest.mouseRelease(page.line, LEFT, PLAIN, page.across(0.6))
    assert not page.window.session.previewing
    assert page.node.knots[:7] == KNOTS[:7] and page.node.knots[8:] == KNOTS[8:]
    assert page.steps == 1 and page.moved() > 0.01
    page.window.session.undo()
    assert page.driver.document is page.start


def test_all_knots_of_a_value_go_together_one_alone_with_alt_and_escape_takes_it_back(page, pixel):
    page.drag(5, [0.4, 0.5])
    assert page.node.knots[5] == page.node.knots[6] == pytest.approx(0.5, abs=pixel)
    page.window.session.undo()
    page.drag(5, [0.4, 0.5], ALT)
    assert page.node.knots[5] == 0.3 and page.node.knots[6] == pytest.approx(0.5, abs=pixel)
    page.window.session.undo()
    page.drag(5, [0.2, 0.22], ALT)
    assert page.node.knots[6] == 0.3 and page.node.knots[5] == pytest.approx(0.22, abs=pixel)
    page.window.session.undo()
    page.drag(7, [0.6], release=False)
    assert page.driver.document is not page.start
    page.driver.keys("Escape", page.line)
    assert page.driver.document is page.start
    QTest.mouseRelease(page.line, LEFT, PLAIN, page.across(0.6))
    assert page.driver.document is page.start


def test_a_knot_snaps_to_its_neighbours_and_stops_where_the_curve_would_break(page, pixel):
    page.drag(4, [0.2, 0.3 - 4 * pixel])
    assert page.node.knots[4] == 0.3  # three of them: a corner
    assert page.page.knots.table.item(page.line.basis.stack_of(4), 2).text() == "C0, corner"
    page.drag(7, [0.5, 0.2])  # beside these there is no room for a fourth
    assert 0.3 < page.node.knots[7] < 0.3 + 3 * pixel
    page.window.session.undo()
    page.drag(7, [0.9, 1 - 2 * pixel], Qt.KeyboardModifier.ControlModifier)
    assert page.node.knots[7] == pytest.approx(1 - 2 * pixel, abs=pixel) and page.node.knots[7] < 1
    assert page.steps == 2


def test_a_double_click_inserts_a_knot_and_keys_move_and_remove_it(page):
    QTest.mouseDClick(page.line, LEFT, PLAIN, page.across(0.5, 0.95))
    assert len(page.node.knots) == 13 and page.node.knots[7] == pytest.approx(0.5, abs=page.line.room.step)
    assert page.moved() < 1e-9 and page.steps == 1
    new = page.driver.document
    page.line.setFocus()
    page.driver.keys("Home", page.line)
    for _ in range(3):
        page.driver.keys("Tab", page.line)
    assert page.line.focused == 7
    page.driver.keys("Right", page.line)
    assert page.node.knots[7] == pytest.approx(new.profiles[0].knots[7] + 0.01, abs=1e-9) and page.steps == 2
    page.window.session.undo()
    assert page.driver.document is new
    page.driver.keys("Delete", page.line)
    assert page.node.knots == pytest.approx(KNOTS) and page.moved() < 1e-9
    assert "the curve is the same" in page.window.status.currentMessage()
    page.driver.keys("Insert", page.line)
    assert page.node.knots[7:9] == pytest.approx((0.8, 0.9))  # the knot after the removed one has the focus


def test_degree_up_leaves_the_curve_and_down_tells_how_far_it_moves(page):
    tip = QHelpEvent(QEvent.Type.ToolTip, QPoint(3, 3), page.page.less.mapToGlobal(QPoint(3, 3)))
    page.qtbot.mouseClick(page.page.more, LEFT)
    assert page.node.degree == 4 and page.moved() < 1e-9
    assert page.page.facts.text().startswith("Quartic") and page.page.degree.text() == "4"
    QApplication.sendEvent(page.page.less, tip)
    assert page.page.less.toolTip().endswith("the curve stays as it is")
    page.window.session.undo()
    QApplication.sendEvent(page.page.less, tip)
    page.window.actions_.run("reduce_degree")
    assert page.node.degree == 2
    off = f"{page.moved():.3g} mm"
    assert off in page.window.status.currentMessage() and off in page.page.less.toolTip() and page.moved() > 0.01


def test_a_clicked_function_chooses_its_control_point_and_the_slider_weighs_it(page):
    page.qtbot.mouseClick(page.line, LEFT, PLAIN, page.across(0.0, 1.0) + QPoint(0, 2))
    assert page.window.curve.chosen == {(0, 0)}
    peak = page.line.basis.values[:, 3].argmax()
    place = page.across(page.line.basis.at[peak], page.line.basis.values[peak, 3])
    page.qtbot.mouseClick(page.line, LEFT, Qt.KeyboardModifier.ShiftModifier, place)
    assert page.window.curve.chosen == {(0, 0), (0, 3)}
    page.window.curve.choose([(0, 3)])
    slider = page.page.weight.slider
    slider.setSliderDown(True)
    slider.setValue(slider.maximum())
    assert page.window.session.previewing and page.node.weights[3] == 10.0
    slider.setSliderDown(False)
    assert page.steps == 1 and page.page.weight.field.text() == "10"
    page.qtbot.mouseClick(page.page.weight.plain, LEFT)
    assert page.node.weights == () and page.moved() == 0.0


def test_a_written_knot_moves_and_takes_an_expression_that_then_holds_it(page):
    table = page.page.knots.table

    def write(row: int, text: str) -> None:
        table.setCurrentCell(row, 0)
        table.editItem(table.item(row, 0))
        editor = table.findChild(QLineEdit)
        editor.setText(text)
        page.driver.keys("Return", editor)
        page.qtbot.waitUntil(lambda: table.findChild(QLineEdit) is None)

    write(2, "0.4")
    assert page.node.knots[5:7] == (0.4, 0.4) and page.steps == 1
    before = page.driver.document
    write(2, "5")
    assert page.driver.document is before and table.item(2, 0).text() == "0.4"
    page.driver.session.do("set_parameter", "u", "0.35")
    write(2, "u + 0.1")
    assert [str(one) for one in page.node.knots[5:7]] == ["u + 0.1"] * 2 and table.item(2, 0).text() == "u + 0.1"
    assert isinstance(page.driver.document.parameters[0], Parameter)
    held = page.driver.document
    page.drag(5, [0.6, 0.7])
    assert page.driver.document is held


def test_closed_uniform_and_refined(page):
    page.qtbot.mouseClick(page.page.closed, LEFT, PLAIN, QPoint(8, page.page.closed.height() // 2))
    assert page.node.closed and page.node.knots == () and path_of(page.node).contours[0].closed
    assert page.page.facts.text() == "Cubic, 8 control points, 9 knots, closed"
    page.window.session.undo()
    page.qtbot.mouseClick(page.page.knots.buttons["Refine"], LEFT)
    assert len(page.node.points) == 8 + 4 and page.moved() < 1e-9
    page.qtbot.mouseClick(page.page.knots.buttons["Uniform knots"], LEFT)
    np.testing.assert_allclose(np.unique(page.line.basis.knots), np.linspace(0, 1, 10))
    assert page.steps == 2


def test_convert_to_path_gives_bezier_segments_of_the_same_curve(page):
    page.qtbot.mouseClick(page.page.to_path, LEFT)
    assert isinstance(page.node, Path) and set(page.node.segments) == {"M", "C"}
    assert page.node.segments.count("C") == 4  # between 0, 0.15, 0.3, 0.8 and 1
    assert page.moved() < 1e-9 and page.steps == 1
    assert not page.window.curve_panel.tabs.isTabVisible(3)


def test_a_bezier_curve_gets_degrees_and_becomes_a_bspline(make_window):
    page = Page(make_window(document_of(arch=bezier([(0, 0), (10, 30), (30, 20), (40, 0)]))))
    page.qtbot.mouseClick(page.page.more, LEFT)
    assert isinstance(page.node, Bezier) and len(page.node.points) == 5 and page.moved() < 1e-9
    assert page.page.to_bspline.isVisible()
    page.window.actions_.run("convert_to_bspline")
    assert isinstance(page.node, BSpline) and page.node.degree == 4 and page.moved() < 1e-9
    assert page.line.isVisible() and not page.page.to_bspline.isVisible()
    page.window.actions_.run("refine_knots")
    assert len(page.line.basis.knots) == 11 and page.moved() < 1e-9
    page.driver.settle()
