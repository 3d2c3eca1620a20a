"""Measuring in the real window: figures of nodes, their use, and the tool in the picture."""

import numpy as np
import pytest
from handle_hand import Hand
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMenu, QToolButton

from solidtree.gui.panels.figures import FigureLabel
from solidtree.gui.panels.measures import MeasuresView
from solidtree.model.script import box, cylinder, document_of, sphere

pytest_plugins = ["window_driver"]
PLATE = box(40, 30, 12) - cylinder(4.3, 40, centred=True).at(10, 10) - cylinder(3, 40, centred=True).at(30, 18)


@pytest.fixture
def plate(make_window):
    driver = make_window(document_of(plate=PLATE))
    driver.look_from("iso")
    return driver


def view(driver, name: str) -> MeasuresView:
    return driver.child(MeasuresView, name)


def click_value(driver, label: FigureLabel, offset: int = 6) -> None:
    """Click where the first value of a label stands."""
    driver.window.properties.ensureWidgetVisible(label)
    driver.qtbot.mouseClick(label, Qt.MouseButton.LeftButton, pos=QPoint(offset, 8))


def figures(driver, number: int = -1) -> dict[str, tuple[float, ...]]:
    return {figure.name: figure.values for figure in driver.window.measure.taken[number].measurement.figures}


def test_a_node_has_measures_of_its_own_beside_those_of_its_solid(plate):
    plate.click_row(next(node for node in plate.document.solids[0].children if node.kind == "Cylinder"))
    plate.qtbot.waitUntil(lambda: bool(view(plate, "measures_of_node").text()))
    own, whole = view(plate, "measures_of_node"), view(plate, "measures_of_solid")
    assert own.row("Size").figures[0].values == pytest.approx((8.6, 8.6, 40))
    assert whole.row("Size").figures[0].values == pytest.approx((40, 30, 12))
    plate.click_row(plate.document.solids[0])
    assert plate.window.properties.widget().findChild(MeasuresView, "measures_of_node") is None
    assert view(plate, "measures_of_solid").row("Inertia").figures[0].values[2] > 0


def test_several_nodes_are_summed(make_window):
    driver = make_window(document_of(a=box(2), b=box(4).at(10)))
    driver.keys("Ctrl+A")
    driver.qtbot.waitUntil(lambda: bool(view(driver, "measures_of_node").text()))
    assert view(driver, "measures_of_node").row("Volume").value("Volume") == "72"


def test_a_click_copies_and_goes_into_the_field_that_is_edited(plate):
    plate.click_row(plate.document.solids[0].children[0])
    plate.qtbot.waitUntil(lambda: bool(view(plate, "measures_of_node").text()))
    volume = view(plate, "measures_of_node").row("Volume")
    click_value(plate, volume)
    assert QGuiApplication.clipboard().text() == "14400"
    field = plate.field("position_x")
    plate.window.properties.ensureWidgetVisible(field)
    plate.qtbot.mouseClick(field, Qt.MouseButton.LeftButton)
    click_value(plate, volume)
    assert field.text() == "14400" and field.hasFocus()
    plate.write(" / 100 + ", field)
    click_value(plate, volume)
    plate.keys("Return", field)
    assert field.text() == "14400 / 100 + 14400"
    button = plate.child(MeasuresView, "measures_of_solid").copy_button
    plate.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert "Volume\t" in QGuiApplication.clipboard().text() and "Principal\t" in QGuiApplication.clipboard().text()


def test_a_figure_becomes_a_parameter(plate):
    plate.click_row(plate.document.solids[0])
    plate.settle()
    volume = view(plate, "measures_of_solid").row("Volume")
    use = plate.window.figure_use
    menu = use.menu(volume.figures[0], 0, volume.subject, volume.every, QPoint(100, 100))
    assert isinstance(menu, QMenu)
    actions = {action.text().split(" 1")[0]: action for action in menu.actions()}
    assert not actions["Use in field"].isEnabled()
    actions["Make a parameter of it"].trigger()
    menu.close()
    (parameter,) = plate.document.parameters
    expected = plate.window.evaluation.latest.solids[plate.document.solids[0].id].measures.volume
    assert parameter.name == "plate_volume" and parameter.value == pytest.approx(expected, rel=1e-14)
    assert "measured" in parameter.note
    plate.keys("Ctrl+Z", plate.window.viewport)
    assert not plate.document.parameters


def test_two_clicks_measure_a_distance_and_the_picture_shows_it(plate):
    before = plate.window.viewport.viewer.pixels()
    plate.keys("Shift+M", plate.window.viewport)
    plate.click_at((14.3, 10, 12))
    assert figures(plate)["Radius"] == (4.3,) and len(plate.window.measure.taken) == 1
    plate.click_at((33, 18, 12))
    assert len(plate.window.measure.taken) == 1
    assert figures(plate)["Centres"] == pytest.approx((np.hypot(20, 8),))
    row = plate.window.measurements.row(0)
    assert row.title.text() == "Circle \u2013 Circle" and "21.5407" in row.figures.text()
    plate.qtbot.wait(50)
    after = plate.window.viewport.viewer.pixels()
    middle = plate.pixel_of((20, 14, 12))
    around = np.s_[middle.y() - 6 : middle.y() + 7, middle.x() - 20 : middle.x() + 20]
    assert (before[around] != after[around]).any(axis=2).mean() > 0.5


def test_escape_keeps_the_first_then_ends_and_a_drag_still_orbits(plate):
    window = plate.window
    plate.keys("Shift+M", window.viewport)
    plate.click_at((40, 10, 12))
    plate.keys("Escape", window.viewport)
    assert window.measure.active
    plate.click_at((0, 0, 0))
    assert [taken.measurement.title for taken in window.measure.taken] == ["Edge", "Corner"]
    camera, start = window.viewport.viewer.camera, plate.pixel_of((20, 5, 12))
    plate.qtbot.mousePress(window.viewport, Qt.MouseButton.LeftButton, pos=start)
    for step in (10, 30, 60):
        plate.qtbot.mouseMove(window.viewport, start + QPoint(step, 0))
    plate.qtbot.mouseRelease(window.viewport, Qt.MouseButton.LeftButton, pos=start + QPoint(60, 0))
    assert window.viewport.viewer.camera != camera and len(window.measure.taken) == 2
    plate.keys("Escape", window.viewport)
    plate.keys("Escape", window.viewport)
    assert not window.measure.active and len(window.measure.taken) == 2 and plate.session.selection == ()


def test_a_key_of_the_handles_ends_measuring_so_that_they_can_be_dragged(plate):
    plate.click_row(plate.document.solids[0])
    plate.keys("Shift+M", plate.window.viewport)
    assert plate.window.measure.active
    plate.keys("S", plate.window.viewport)
    assert not plate.window.measure.active and plate.window.handles.mode == "scale"
    plate.keys("Escape", plate.window.viewport)


def test_what_changes_under_a_measurement_greys_it_and_undo_brings_it_back(make_window):
    driver = make_window(document_of(plate=PLATE, ball=sphere(8).at(20, 15, 40)))
    driver.look_from("iso")
    window = driver.window
    driver.keys("Shift+M", window.viewport)
    driver.click_at((40, 10, 12))
    driver.keys("Escape", window.viewport)
    driver.keys("Escape", window.viewport)
    ball = driver.node("ball")
    driver.session.do("set_field", ball.id, "radius", 9)
    driver.settle()
    assert not window.measure.taken[0].stale
    driver.session.do("set_field", driver.document.solids[0].children[1].id, "radius", 5)
    driver.settle()
    assert window.measure.taken[0].stale and not window.measurements.row(0).title.isEnabled()
    driver.session.undo()
    driver.settle()
    assert not window.measure.taken[0].stale
    remove = window.measurements.row(0).findChildren(QToolButton)[1]
    window.docks["Measure"].raise_()
    driver.qtbot.mouseClick(remove, Qt.MouseButton.LeftButton)
    assert not window.measure.taken and window.measurements.empty.isVisibleTo(window.measurements)


def test_an_isolated_operand_is_measured(plate):
    plate.session.select([plate.document.solids[0].children[0].id])
    plate.keys("I", plate.window.viewport)
    plate.settle()
    assert plate.session.isolated
    plate.keys("Shift+M", plate.window.viewport)
    plate.click_at((33, 26, 12))
    assert plate.window.measure.taken[0].measurement.title == "Face"


def test_another_document_has_no_measurements_yet(plate):
    plate.keys("Shift+M", plate.window.viewport)
    plate.click_at((40, 15, 12))
    assert plate.window.measure.taken
    plate.open(document_of(box(10)))
    assert not plate.window.measure.taken


def test_handles_are_out_of_the_way_while_measuring(plate):
    plate.session.select([plate.document.solids[0].id])
    plate.settle()
    hand = Hand(plate)
    assert "move x" in hand.names
    plate.keys("Shift+M", plate.window.viewport)
    assert plate.window.measure.active and not hand.names
    plate.window.files.opened.emit()  # another document does not go on being measured
    assert not plate.window.measure.active and "move x" in hand.names
