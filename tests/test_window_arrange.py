"""Aligning, distributing and laying on faces in the real window."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt

from solidtree.model.script import box, document_of, measure, union

pytest_plugins = ["window_driver"]
LEFT = Qt.MouseButton.LeftButton


def chosen(driver, *names):
    """Select nodes by name and wait until they have been looked at by themselves."""
    ids = [driver.node(name).id for name in names]
    driver.session.select(ids)
    driver.settle()
    driver.qtbot.waitUntil(lambda: not driver.window.evaluation.examining)
    assert set(ids) <= driver.window.evaluation.parts.keys()
    return ids


def run(driver, name):
    action = driver.window.actions_[name]
    driver.qtbot.waitUntil(lambda: not driver.window.evaluation.examining)
    assert action.isEnabled(), action.statusTip()
    action.trigger()
    driver.settle()


def bounds(driver, name):
    return measure(driver.node(name).with_(id="n1")).bounds


def hover(driver, point, off=(0, 0)):
    driver.qtbot.mouseMove(driver.window.viewport, driver.pixel_of(point) + QPoint(*off))


def test_align_distribute_and_drop_are_steps_of_the_history(make_window):
    driver = make_window(document_of(a=box(10).at(0, 0, 5), b=box(4).at(13, 9, 0), c=box(6).at(50, 1, 30)))
    first = driver.document
    actions = driver.window.actions_
    assert "select a node first" in actions.fault("align_x_min")
    chosen(driver, "a", "b")
    assert "3 nodes or more" in actions.fault("distribute_x_gaps")
    run(driver, "align_z_max")
    assert bounds(driver, "b")[1][2] == pytest.approx(15) and driver.session.undo_label == "Align top"
    assert driver.session.log[-1] == "shift({'n2': (0, 0, 11)})"
    assert driver.session.selection == ("n1", "n2")
    chosen(driver, "a", "b", "c")
    run(driver, "distribute_x_gaps")
    assert [bounds(driver, n)[0][0] for n in "abc"] == pytest.approx([0, 28, 50])
    run(driver, "drop_to_ground")
    assert [bounds(driver, n)[0][2] for n in "abc"] == pytest.approx([0, 0, 0])
    run(driver, "drop_to_ground")
    assert "it is so already" in driver.window.status.currentMessage()
    for _ in range(3):
        driver.keys("Ctrl+Z", driver.window)
    assert driver.document is first


def test_nodes_in_a_turned_operation_are_aligned_in_the_world(make_window):
    inner = union(box(2, 2, 2).named("small"), box(10).at(30).named("big")).turned(x=90, z=45).scaled(2)
    driver = make_window(document_of(inner.named("part")))
    chosen(driver, "big", "small")
    before = driver.window.evaluation.parts[driver.node("big").id].measures.bounds
    run(driver, "align_x_max")
    chosen(driver, "big", "small")
    node = driver.node("small").id
    driver.qtbot.waitUntil(
        lambda: abs(driver.window.evaluation.parts[node].measures.bounds[1][0] - before[1][0]) < 1e-6
    )


def placing(make_window):
    driver = make_window(document_of(table=box(60, 60, 10), part=box(10, 20, 30).at(100, 0, 0)))
    driver.look_from("iso")
    chosen(driver, "part")
    run(driver, "place_on_face")
    tool = driver.window.place_on_face
    assert tool.active and "“part” should stand on" in driver.window.status.currentMessage()
    return driver, tool


def test_a_node_is_laid_on_the_face_that_is_clicked(make_window):
    driver, tool = placing(make_window)
    first = driver.document
    hover(driver, (60, 20, 5))  # the table's side, which faces +x
    assert driver.session.previewing and driver.session.log == ()
    found = bounds(driver, "part")
    assert found[0][0] == pytest.approx(60) and found[1][0] == pytest.approx(90)  # upright on it: 30 mm away from it
    hover(driver, (20, 30, 10))
    driver.qtbot.mouseClick(driver.window.viewport, LEFT, pos=driver.pixel_of((20, 30, 10)))
    assert not tool.active and not driver.session.previewing and driver.window.status.currentMessage() == ""
    low, high = np.array(bounds(driver, "part"))
    assert low[2] == pytest.approx(10) and high[2] == pytest.approx(40)
    assert np.allclose((low + high)[:2] / 2, (20, 30), atol=0.5)
    assert driver.session.undo_label == "Place on face" and len(driver.session.log) == 1
    assert driver.session.log[0].startswith("place('n2', at(") and driver.session.selection == ("n2",)
    driver.keys("Ctrl+Z", driver.window)
    assert driver.document is first


def test_its_own_face_can_be_chosen_and_the_middle_of_an_edge_is_met(make_window):
    driver, tool = placing(make_window)
    side = (105, 0, 15)
    driver.qtbot.mouseMove(driver.window.viewport, driver.pixel_of(side))
    assert not driver.session.previewing
    driver.qtbot.mouseClick(driver.window.viewport, LEFT, pos=driver.pixel_of(side))
    assert tool.active and "should lie on" in driver.window.status.currentMessage()
    driver.qtbot.mouseClick(driver.window.viewport, LEFT, pos=driver.pixel_of((30, 0, 10)) + QPoint(2, -3))
    assert not tool.active
    low, high = np.array(bounds(driver, "part"))
    assert low[2] == pytest.approx(10) and high[2] == pytest.approx(30)  # on the side of 10 by 30, 20 mm high
    assert np.allclose((low + high)[:2] / 2, (30, 0), atol=1e-4)


def test_escape_takes_it_back_and_a_drag_turns_the_view(make_window):
    driver, tool = placing(make_window)
    first, camera = driver.document, driver.window.viewport.viewer.camera
    viewport = driver.window.viewport
    start = driver.pixel_of((30, 30, 10))
    driver.qtbot.mousePress(viewport, LEFT, pos=start)
    driver.qtbot.mouseMove(viewport, start + QPoint(20, 0))
    driver.qtbot.mouseMove(viewport, start + QPoint(60, 5))
    driver.qtbot.mouseRelease(viewport, LEFT, pos=start + QPoint(60, 5))
    assert tool.active and viewport.viewer.camera != camera and driver.session.log == ()
    hover(driver, (30, 30, 10))
    assert driver.session.previewing
    driver.keys("Escape", viewport)
    assert not tool.active and not driver.session.previewing and driver.document is first
    assert driver.window.status.currentMessage() == ""
    run(driver, "place_on_face")
    hover(driver, (30, 30, 10))
    driver.session.select(["n1"])
    assert not tool.active and not driver.session.previewing


def test_every_command_has_an_icon_and_a_place_in_the_menu(driver):
    from solidtree.gui.commands.arrange import ARRANGE_COMMANDS

    assert len(ARRANGE_COMMANDS) == 18
    for command in ARRANGE_COMMANDS:
        action = driver.window.actions_[command.name]
        assert not action.icon().isNull() and not action.isEnabled() and command.tip


def test_of_the_tools_that_take_clicks_one_is_active(make_window):
    driver = make_window(document_of(a=box(10), b=box(4).at(20)))
    window = driver.window
    chosen(driver, "b")
    driver.keys("Shift+M", window.viewport)
    assert window.measure.active
    run(driver, "place_on_face")
    assert window.place_on_face.active and not window.measure.active
    driver.keys("Shift+M", window.viewport)
    assert window.measure.active and not window.place_on_face.active
    run(driver, "section_face")
    assert not window.measure.active
