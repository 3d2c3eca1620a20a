"""The Motion panel in the real window: made without an expression, scrubbed, played by the clock, contacts listed."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from solidtree.model.script import box, cylinder, document_of, motion, parameter

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton


def pushing(steps=20):
    """An arm that goes 40 mm in 4 s, and meets a base after 20 mm."""
    t = parameter("t", 0)
    arm, base = box(10).at(t * 40).named("arm"), box(10).at(30).named("base")
    return motion(document_of(arm, base, box(2).at(0, 30).named("far")), "push", steps=steps)


def opened(make_window, document):
    driver = make_window(document)
    driver.keys("Ctrl+Alt+M", driver.window.viewport)
    panel = driver.window.motion
    driver.qtbot.waitUntil(lambda: panel.in_front and panel.page is not None)
    if document.motions:
        driver.qtbot.waitUntil(lambda: panel.played is not None, timeout=20000)
    return driver, panel


def rows(panel):
    table = panel.page.table
    return [tuple(table.item(row, column).text() for column in range(4)) for row in range(table.rowCount())]


def moves(driver):
    return driver.window.viewport.viewer.scene.moves


def test_the_slider_shows_each_step_with_its_contacts_and_changes_nothing(make_window):
    driver, panel = opened(make_window, pushing())
    page, document = panel.page, driver.document
    arm, base, _ = (root.id for root in document.solids)
    assert page.words.text() == "First contact at t = 2.00 s: “arm” meets “base”"
    page.bar.slider.setFocus()
    driver.keys("Right", page.bar.slider)
    assert page.bar.step == 1 and rows(panel) == [] and moves(driver)[arm][:3, 3] == pytest.approx([2, 0, 0])
    page.bar.slider.setValue(10)
    assert rows(panel) == [("arm", "base", "Touch", "")]
    scene = driver.window.viewport.viewer.scene
    assert scene.touched == {arm, base} and page.time.text() == "2.00 s, t = 0.5"
    driver.keys("End", page.bar.slider)
    assert page.bar.step == 20 and rows(panel) == [("arm", "base", "Touch", "")]  # it has gone through
    page.bar.slider.setValue(14)
    assert rows(panel)[0][:3] == ("arm", "base", "Overlap") and rows(panel)[0][3].endswith("800 mm³")
    page.table.selectRow(0)
    assert scene.faded and base not in scene.faded and arm not in scene.faded
    driver.keys("Escape", driver.window.viewport)
    assert not scene.faded and panel.picture.away
    driver.keys("Escape", driver.window.viewport)
    assert not moves(driver) and not scene.touched
    assert driver.document is document and not driver.session.modified
    page.bar.go(0)
    driver.qtbot.mouseClick(page.bar.on, LEFT)
    assert page.bar.step == 10
    driver.qtbot.mouseClick(page.bar.on, LEFT)
    assert page.bar.step == 10 and "no further contact" in driver.window.statusBar().currentMessage()
    page.bar.go(3)
    driver.qtbot.mouseClick(page.first, LEFT)
    assert panel.player.share == pytest.approx(0.5, abs=1e-5) and rows(panel)[0][:3] == ("arm", "base", "Touch")


def test_playing_keeps_the_time_of_the_clock(make_window):
    driver, panel = opened(make_window, pushing())
    player, now = panel.player, [100.0]
    player.clock = lambda: now[0]
    player.pause()
    arm = driver.document.solids[0].id
    driver.window.actions_.run("play_motion")
    assert player.playing
    for seconds, way in ((0.5, 5), (1.75, 17.5), (3.3, 33)):  # pictures between were left out
        now[0] = 100.0 + seconds
        player.tick()
        assert moves(driver)[arm][0, 3] == pytest.approx(way)
    now[0] = 109.0
    player.tick()
    assert not player.playing and player.share == 1.0
    driver.qtbot.mouseClick(panel.page.bar.loop, LEFT)
    driver.keys("Space", panel.page.bar.slider)
    now[0] += 5.0  # a second into the next round
    player.tick()
    assert player.playing and player.share == pytest.approx(0.25)
    driver.keys("Space", panel.page.bar.slider)
    assert not player.playing


def test_what_is_selected_is_set_in_motion_by_typing_millimetres(make_window):
    driver, panel = opened(make_window, document_of(box(10).named("arm"), box(10).at(30).named("base")))
    page, form, document = panel.page, panel.page.form, driver.document
    driver.qtbot.waitUntil(page.empty.isVisible)
    assert not page.right.isVisible() and not form.set_in.isEnabled()
    driver.session.select([document.solids[0].id])
    form.by[0].setFocus()
    driver.write("40", form.by[0])
    driver.qtbot.mouseClick(form.set_in, LEFT)
    driver.qtbot.waitUntil(lambda: panel.played is not None, timeout=20000)
    assert page.right.isVisible() and [one.name for one in driver.document.motions] == ["Motion"]
    assert page.words.text() == "First contact at t = 2.00 s: “arm” meets “base”"
    form.fields["seconds"].setFocus()
    driver.keys("Ctrl+A", form.fields["seconds"])
    driver.write("8", form.fields["seconds"])
    driver.keys("Return", form.fields["seconds"])
    assert driver.document.motions[0].seconds == 8
    driver.qtbot.waitUntil(lambda: panel.played is not None and "4.00 s" in page.words.text(), timeout=20000)
    driver.session.undo()
    driver.session.undo()
    assert driver.document is document and page.empty.isVisible()


def test_parts_that_change_their_shape_are_cut_on_the_way_and_left_as_they_were(make_window):
    t = parameter("t", 5)
    grown = motion(document_of(cylinder(3, t).named("rod"), box(20).at(-10, -10, 20).named("lid")), "grow", start=5,
                   end=25, steps=10)  # fmt: skip
    driver, panel = opened(make_window, grown)
    document = driver.document
    panel.page.bar.slider.setValue(10)
    assert driver.session.previewing and rows(panel)[0][2] == "Overlap"
    driver.settle()
    rod = document.solids[0].id
    height = driver.window.viewport.viewer.scene.meshes[rod].bounds[1][2]
    assert height == pytest.approx(25)
    driver.keys("Ctrl+Alt+M", driver.window.viewport)
    assert not panel.in_front and not driver.session.previewing and driver.document is document
    driver.settle()
    assert driver.window.viewport.viewer.scene.meshes[rod].bounds[1][2] == pytest.approx(5)


def test_a_changed_document_is_looked_at_again_and_the_picture_is_at_rest(make_window):
    driver, panel = opened(make_window, pushing())
    panel.page.bar.slider.setValue(6)
    assert moves(driver)
    base = driver.document.solids[1].id
    driver.session.do("move", [base], 10)
    assert not moves(driver) and panel.played is None
    driver.qtbot.waitUntil(lambda: panel.played is not None, timeout=20000)
    assert panel.page.words.text().startswith("First contact at t = 3.00 s")
    viewer = driver.window.viewport.viewer
    driver.look_from("iso")
    viewer.render()
    plain = viewer.pixels().astype(int)
    panel.page.bar.slider.setValue(20)
    viewer.render()
    assert np.abs(viewer.pixels().astype(int) - plain).max() > 40
    panel.rest()
    viewer.render()
    assert np.abs(viewer.pixels().astype(int) - plain).max() <= 2


def test_a_drag_takes_the_motion_out_of_the_picture(make_window):
    """What is typed meanwhile goes from the document's place, and is shown there."""
    driver, panel = opened(make_window, pushing())
    arm = driver.document.solids[0].id
    panel.page.bar.slider.setValue(14)
    panel.page.table.selectRow(0)
    assert moves(driver)
    driver.session.select([arm])
    driver.keys("M", driver.window.viewport)
    driver.keys("7", driver.window.viewport)
    assert not moves(driver) and not panel.picture.away and panel.page.table.current is None
    driver.keys("Return", driver.window.viewport)
    driver.settle()
    assert panel.page.form.set_in.isEnabled()
    assert "7" in str(driver.document.solids[0].placement.steps[-1].numbers[0])


def test_a_drag_in_a_motion_that_cuts_anew_begins_with_the_document(make_window):
    t = parameter("t", 0)
    scene = motion(document_of(box(5 + t * 9).named("grows"), box(2).at(30).named("stands")), "growth", steps=4)
    driver, panel = opened(make_window, scene)
    stands = driver.document.solids[1].id
    panel.page.bar.slider.setValue(2)
    assert driver.session.previewing
    driver.session.select([stands])
    driver.keys("M", driver.window.viewport)
    assert not driver.session.previewing and not panel.picture.away
    driver.keys("7", driver.window.viewport)
    driver.keys("Return", driver.window.viewport)
    driver.settle()
    assert driver.document.parameters == scene.parameters
    assert driver.document.solids[1].placement.matrix()[0, 3] == pytest.approx(37)
