"""Engraving by the mouse: a face clicked, flat and round, raised and cut, and all taken back."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QPlainTextEdit, QSlider

from solidtree.gui.lettering.font_window import FontWindow
from solidtree.model.document.from_outlines import Extrude, Wrap
from solidtree.model.document.nodes import Difference, Union
from solidtree.model.document.tree import walk
from solidtree.model.script import box, cylinder, document_of, lettering
from solidtree.model.solid.information import information

pytest_plugins = ["window_driver"]


def volume(document):
    return information(document, 0.05)[0]["solids"][0]["volume"]


@pytest.fixture
def opened(make_window):
    def make(solid, eye="top"):
        driver = make_window(document_of(lettering("Ag", 8), solid=solid))
        driver.session.select([driver.document.profiles[0].id])
        driver.look_from(eye)
        driver.settle()
        return driver

    return make


def move_to(driver, point):
    QTest.mouseMove(driver.window.viewport, driver.pixel_of(point))
    QTest.qWait(1)


def test_a_click_on_a_flat_face_engraves_there(opened):
    driver = opened(box(30, 20, 4))
    start, before = driver.document, volume(driver.document)
    driver.keys("Ctrl+Alt+E", driver.window.viewport)
    assert "Click the face where “Lettering” should be engraved" in driver.window.status.currentMessage()
    move_to(driver, (8, 6, 4))
    assert driver.session.previewing, "the outline is shown where it would go"
    driver.click_at((8, 6, 4))
    assert isinstance(driver.document.solids[0], Difference) and not driver.document.profiles
    assert driver.session.undo_label == "Engrave"
    (extrusion,) = [node for node in walk(*driver.document.roots) if isinstance(node, Extrude)]
    assert driver.session.selection == (extrusion.id,)
    assert before - 60 < volume(driver.document) < before - 10
    x, y, z = extrusion.placement.matrix()[:, 3]
    np.testing.assert_allclose((x, y, z), (8, 6, 4), atol=0.3)
    driver.keys("Ctrl+Z", driver.window.viewport)
    assert driver.document is start


def test_near_the_middle_of_a_face_it_is_caught_there(opened):
    driver = opened(box(30, 20, 4))
    driver.keys("Alt+Shift+E", driver.window.viewport)
    driver.click_at((15.1, 10.1, 4))
    (extrusion,) = [node for node in walk(*driver.document.roots) if isinstance(node, Extrude)]
    np.testing.assert_allclose(extrusion.placement.matrix()[:, 3], (15, 10, 4), atol=1e-6)
    assert isinstance(driver.document.solids[0], Union) and extrusion.height == 1.0


def test_a_cylinder_is_engraved_round_its_side(opened):
    driver = opened(cylinder(12, 30), "front")
    driver.keys("Ctrl+Alt+E", driver.window.viewport)
    driver.click_at((0, -12, 15))
    (wrap,) = [node for node in walk(*driver.document.roots) if isinstance(node, Wrap)]
    assert wrap.radius == 12.0 and wrap.below == 1.0
    driver.settle()
    shown = driver.window.evaluation.latest.solids[driver.document.solids[0].id].mesh
    walls = [path for path in shown.owners if wrap.id in path]
    assert walls, "the letters' walls are the wrap's"


def test_escape_and_faces_that_are_neither_leave_all_as_it_was(opened):
    from solidtree.model.script import sphere

    driver = opened(sphere(12))
    start = driver.document
    driver.keys("Ctrl+Alt+E", driver.window.viewport)
    driver.click_at((0, 0, 12))
    assert driver.document is start and "neither flat nor" in driver.window.status.currentMessage()
    driver.keys("Escape", driver.window.viewport)
    assert not driver.window.engrave.active and not driver.session.previewing
    assert driver.window.viewport.cursor().shape() == Qt.CursorShape.ArrowCursor


def test_it_needs_an_outline_of_its_own(opened):
    driver = opened(box(30, 20, 4))
    actions = driver.window.actions_
    assert actions.fault("engrave") is None
    driver.session.select([driver.document.solids[0].id])
    assert "is no outline" in actions.fault("engrave")
    driver.session.select([])
    assert actions.fault("emboss") == "select an outline first"


def test_a_name_is_written_set_leaned_a_glyph_edited_engraved_and_all_undone(make_window):
    driver = make_window(document_of(plate=box(60, 20, 3)))
    driver.look_from("top")
    start = driver.document
    driver.keys("Alt+L", driver.window.viewport)
    lines = driver.child(QPlainTextEdit, "text")
    lines.setFocus()
    lines.selectAll()
    QTest.keyClicks(lines, "Ill")
    driver.keys("Ctrl+Return", lines)
    font = driver.child(QComboBox, "font")
    font.setFocus()
    font.lineEdit().selectAll()
    QTest.keyClicks(font.lineEdit(), "GFS Didot")
    driver.keys("Return", font.lineEdit())
    slider = driver.child(QSlider, "slant_slider")
    driver.window.properties.ensureWidgetVisible(slider)
    slider.setFocus()
    driver.keys("PageUp", slider)
    driver.qtbot.waitUntil(lambda: not driver.session.previewing and driver.document.profiles[0].slant > 0)
    (letters,) = driver.document.profiles
    assert (letters.text, letters.font) == ("Ill", "GFS Didot") and 1 <= letters.slant <= 30

    driver.keys("Alt+G", driver.window.viewport)
    fonts = driver.window.side_windows.of(FontWindow)
    driver.qtbot.waitUntil(fonts.isActiveWindow)
    assert (fonts.desk.font, fonts.desk.glyph) == ("GFS Didot", "I")
    contour = fonts.desk.drawn.outline.contours[0]
    low = int(np.argmin(contour.points[contour.starts[:-1], 1]))
    begin = fonts.canvas.to_screen(*contour.points[contour.starts[low]])
    QTest.mousePress(fonts.canvas, Qt.MouseButton.LeftButton, pos=begin.toPoint())
    for step in (10, 20):
        QTest.mouseMove(fonts.canvas, begin.toPoint() + QPoint(0, step))
        QTest.qWait(1)
    QTest.mouseRelease(fonts.canvas, Qt.MouseButton.LeftButton, pos=begin.toPoint() + QPoint(0, 20))
    assert fonts.desk.edited == {"I"}
    fonts.close()
    driver.window.activateWindow()
    driver.qtbot.waitUntil(driver.window.isActiveWindow)

    before = volume(driver.document)
    driver.keys("Ctrl+Alt+E", driver.window.viewport)
    driver.click_at((20, 8, 3))
    assert isinstance(driver.document.solids[0], Difference) and volume(driver.document) < before - 10
    steps = 0
    while driver.session.undo_label:
        driver.keys("Ctrl+Z", driver.window.viewport)
        steps += 1
    assert driver.document is start and steps == 6, "add, write, font, slant, glyph, engrave"


def test_a_click_on_a_letter_s_wall_selects_the_text_the_next_its_extrusion(make_window):
    from solidtree.model.script import extrude

    driver = make_window(document_of(sign=box(60, 30, 3) - extrude(lettering("I", 40), 2).at(20, 0, 2)))
    driver.look_from("top")
    driver.settle()
    cut = driver.document.solids[0].children[1]
    (letters,) = cut.children
    middle = (20 + 0.5 * 40 * 0.295, 10, 2)  # the stem of DejaVu's I: 604 of 2,048 units wide
    driver.click_at(middle)
    assert driver.session.selection == (letters.id,)
    driver.click_at(middle)
    assert driver.session.selection == (cut.id,)
    driver.click_at(middle)
    assert driver.session.selection == (driver.document.solids[0].id,)
    driver.click_at((5, 20, 3))
    assert driver.session.selection == (driver.document.solids[0].children[0].id,)
    before = driver.window.viewport.viewer.camera.distance
    driver.click_at(middle)
    driver.qtbot.mouseDClick(driver.window.viewport, Qt.MouseButton.LeftButton, pos=driver.pixel_of(middle))
    driver.qtbot.waitUntil(lambda: driver.window.viewport.viewer.camera.distance < before)
