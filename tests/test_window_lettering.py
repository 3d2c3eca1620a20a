"""Lettering through the window: added, written, set in another font, leaned, engraved, taken back."""

from pathlib import Path

import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTCollection, TTFont
from fontTools.ttLib.tables.TupleVariation import TupleVariation
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QInputDialog,
    QLabel,
    QLineEdit,
    QMessageBox,
    QPlainTextEdit,
    QSlider,
    QToolButton,
)

from solidtree.model.document.document import Document
from solidtree.model.document.outlines import Lettering
from solidtree.model.script import box, document_of, lettering
from solidtree.model.solid.information import information

pytest_plugins = ["window_driver"]


def volume(document: Document) -> float:
    return information(document, 0.05)[0]["solids"][0]["volume"]


def problems(driver) -> list[str]:
    rows = driver.window.problems.list
    driver.qtbot.waitUntil(lambda: rows.count() > 0)
    return [rows.item(row).text() for row in range(rows.count())]


def write(driver, text: str) -> None:
    lines = driver.child(QPlainTextEdit, "text")
    lines.setFocus()
    lines.selectAll()
    QTest.keyClicks(lines, text)


def test_a_name_is_written_leaned_and_engraved_and_all_is_undone(make_window):
    driver = make_window(document_of(plate=box(60, 20, 3)))
    start, plate = driver.document, driver.document.solids[0]
    driver.keys("Alt+L", driver.window.viewport)
    (letters,) = driver.document.profiles
    assert isinstance(letters, Lettering) and driver.session.selection == (letters.id,)
    write(driver, "Ada")
    assert driver.session.previewing and driver.document.profiles[0].text == "Ada"
    driver.keys("Ctrl+Return", driver.child(QPlainTextEdit, "text"))
    assert not driver.session.previewing and driver.document.profiles[0].text == "Ada"

    font = driver.child(QComboBox, "font")
    font.setFocus()
    font.lineEdit().selectAll()
    QTest.keyClicks(font.lineEdit(), "GFS Didot")
    driver.keys("Return", font.lineEdit())
    assert driver.document.profiles[0].font == "GFS Didot"

    slant = driver.field("slant")
    slant.setFocus()
    slant.selectAll()
    driver.write("12", slant)
    driver.keys("Return", slant)
    assert driver.document.profiles[0].slant == 12.0
    place = driver.field("position_z")
    place.setFocus()
    place.selectAll()
    driver.write("2.5", place)
    driver.keys("Return", place)

    driver.keys("Shift+E", driver.window.viewport)
    (extruded,) = [root for root in driver.document.solids if root.id != plate.id]
    driver.session.select([plate.id, extruded.id])
    driver.keys("Ctrl+D", driver.window.viewport)
    driver.settle()
    assert volume(driver.document) == pytest.approx(3600 - 0.5 * letters_area(), rel=1e-4)
    while driver.document is not start:
        assert driver.session.undo()


def letters_area() -> float:
    document = document_of(lettering("Ada", font="GFS Didot", slant=12))
    return information(document, 0.05)[0]["profiles"][0]["area"]


def test_escape_takes_back_what_is_typed_and_a_wrong_font_is_said(make_window):
    driver = make_window(document_of(sign=lettering("Old")))
    before = driver.document
    driver.session.select([before.profiles[0].id])
    write(driver, "New")
    assert driver.document.profiles[0].text == "New"
    driver.keys("Escape", driver.child(QPlainTextEdit, "text"))
    assert driver.document is before and driver.child(QPlainTextEdit, "text").toPlainText() == "Old"

    font = driver.child(QComboBox, "font")
    font.setFocus()
    font.lineEdit().selectAll()
    QTest.keyClicks(font.lineEdit(), "Nosuch")
    driver.keys("Return", font.lineEdit())
    driver.settle()
    assert any("no font “Nosuch” is installed" in row for row in problems(driver))
    driver.window.actions_.run("undo")
    assert driver.document is before


def test_a_missing_character_is_in_the_problems_and_choices_are_steps(make_window):
    driver = make_window(document_of(sign=lettering("aन")))
    driver.session.select([driver.document.profiles[0].id])
    driver.settle()
    assert any("U+0928" in row for row in problems(driver))
    alignment = driver.child(QComboBox, "alignment")
    alignment.setFocus()
    QTest.keyClick(alignment, Qt.Key.Key_Down)
    assert driver.document.profiles[0].alignment == "centre"
    driver.window.actions_.run("undo")
    assert driver.document.profiles[0].alignment == "left" and alignment.currentText() == "Left"


def variable_font(path: Path, family: str = "Tiny") -> Path:
    """A font with the letter A, a box of 600 by 700 units that the axis wght from 100 to 900 makes 200 wider at 900."""
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder([".notdef", "A"])
    builder.setupCharacterMap({ord("A"): "A"})
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for point in ((0, 700), (600, 700), (600, 0)):
        pen.lineTo(point)
    pen.closePath()
    box_of_a = pen.glyph()
    builder.setupGlyf({".notdef": TTGlyphPen(None).glyph(), "A": box_of_a})
    builder.setupHorizontalMetrics({".notdef": (500, 0), "A": (700, 0)})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": family, "styleName": "Regular"})
    builder.setupOS2(fsType=0)
    builder.setupPost()
    builder.setupFvar([("wght", 100, 400, 900, "Weight")], [])
    wider = TupleVariation({"wght": (0.0, 1.0, 1.0)}, [(0, 0), (0, 0), (200, 0), (200, 0)] + [(0, 0)] * 4)
    builder.setupGvar({"A": [wider]})
    builder.save(path)
    return path


def open_font(driver, path: Path) -> None:
    button = driver.child(QToolButton, "open_font")
    driver.window.properties.ensureWidgetVisible(button)
    driver.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    dialog = driver.window.findChild(QFileDialog)
    dialog.fileSelected.emit(str(path))
    dialog.close()


def selected(make_window, text: str, **fields):
    driver = make_window(document_of(sign=lettering(text, **fields)))
    driver.session.select([driver.document.profiles[0].id])
    driver.settle()
    return driver


def test_a_font_file_is_opened_in_one_step_and_a_name_takes_its_place(make_window, tmp_path):
    driver = selected(make_window, "A")
    before, lines = driver.document, len(driver.session.log)
    open_font(driver, variable_font(tmp_path / "tiny.ttf"))
    sign = driver.document.profiles[0]
    assert (sign.font, sign.face) == ("Tiny", 0.0) and len(sign.asset) == 64
    assert len(driver.session.log) == lines + 1 and "set_fields" in driver.session.log[-1]
    font = driver.child(QComboBox, "font")
    driver.type_into(font.lineEdit(), "GFS Didot")
    sign = driver.document.profiles[0]
    assert (sign.font, sign.asset) == ("GFS Didot", "")
    driver.session.undo()
    driver.session.undo()
    assert driver.document is before


def test_a_file_that_is_no_font_is_refused_in_words(make_window, tmp_path):
    driver = selected(make_window, "A")
    before = driver.document
    (tmp_path / "bad.ttf").write_bytes(b"no font at all")
    open_font(driver, tmp_path / "bad.ttf")
    box = driver.window.findChild(QMessageBox)
    assert "bad.ttf" in box.text() and "not a font" in box.informativeText().lower()
    assert driver.document is before
    box.close()


def test_a_collection_asks_for_its_face(make_window, tmp_path):
    driver = selected(make_window, "A")
    collection = TTCollection()
    paths = [variable_font(tmp_path / f"{name}.ttf", name) for name in ("First", "Second")]
    collection.fonts = [TTFont(path) for path in paths]
    collection.save(str(tmp_path / "both.ttc"))
    open_font(driver, tmp_path / "both.ttc")
    asking = driver.window.findChild(QInputDialog)
    assert asking.comboBoxItems() == ["1  First", "2  Second"]
    asking.setTextValue("2  Second")
    asking.accept()
    sign = driver.document.profiles[0]
    assert (sign.font, sign.face) == ("Second", 1.0)


def test_an_axis_is_slid_in_one_step_and_a_double_click_takes_it_back(make_window, tmp_path):
    driver = selected(make_window, "A")
    open_font(driver, variable_font(tmp_path / "tiny.ttf"))
    driver.settle()
    lines = len(driver.session.log)
    slider = driver.child(QSlider, "axis_wght")
    driver.qtbot.waitUntil(slider.isVisible)
    driver.window.properties.ensureWidgetVisible(slider)
    assert slider.number == 400.0
    slider.setFocus()
    driver.keys("End", slider)
    assert driver.session.previewing and driver.document.profiles[0].axes == "wght=900"
    driver.qtbot.waitUntil(lambda: not driver.session.previewing)
    assert len(driver.session.log) == lines + 1
    area = information(driver.document, 0.05)[0]["profiles"][0]["area"]
    assert area == pytest.approx(800 * 700 * (10 / 1000) ** 2, rel=1e-6)
    driver.qtbot.mouseDClick(slider, Qt.MouseButton.LeftButton)
    assert driver.document.profiles[0].axes == "" and slider.number == 400.0
    assert driver.child(QLineEdit, "axes").isEnabled()


def test_a_font_without_axes_has_no_sliders_and_says_why(make_window):
    driver = selected(make_window, "A")
    words = driver.child(QLineEdit, "axes")
    assert not words.isEnabled() and "no variable axes" in words.toolTip()


def test_the_slant_is_slid_by_the_mouse_and_escape_takes_it_back(make_window):
    driver = selected(make_window, "A")
    before = driver.document
    slider = driver.child(QSlider, "slant_slider")
    driver.window.properties.ensureWidgetVisible(slider)
    middle = slider.rect().center()
    aside = QPoint(middle.x() + slider.width() // 4, middle.y())
    for end in ("escape", "release"):
        driver.qtbot.mousePress(slider, Qt.MouseButton.LeftButton, pos=middle)
        driver.qtbot.mouseMove(slider, aside)
        assert driver.session.previewing and driver.document.profiles[0].slant == pytest.approx(15, abs=3)
        if end == "escape":
            driver.keys("Escape", slider)
            assert driver.document is before
        driver.qtbot.mouseRelease(slider, Qt.MouseButton.LeftButton, pos=aside)
    assert not driver.session.previewing and driver.document.profiles[0].slant > 0
    driver.session.undo()
    assert driver.document is before


def test_features_are_ticked_in_a_menu(make_window):
    driver = selected(make_window, "fi")
    menu = driver.child(QToolButton, "font_features").menu()
    kern = next(action for action in menu.actions() if action.data() == "kern")
    assert kern.isChecked() and kern.text().startswith("Kerning")
    menu.popup(driver.window.mapToGlobal(QPoint(50, 50)))
    driver.qtbot.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(kern).center())
    assert driver.document.profiles[0].features == "kern=0" and menu.isVisible() and not kern.isChecked()
    driver.qtbot.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(kern).center())
    assert driver.document.profiles[0].features == ""
    menu.close()


def test_the_fonts_that_lend_characters_are_told_as_the_text_changes(make_window):
    driver = selected(make_window, "A", font="GFS Didot")
    line = driver.child(QLabel, "font_chain")
    assert line.text() == "then DejaVu Sans"
    lines = driver.child(QPlainTextEdit, "text")
    lines.setFocus()
    lines.insertPlainText("شन")  # QTest has no keys for them
    assert driver.session.previewing and "ش" in line.text() and "from DejaVu Sans" in line.text()
    assert "In no font, shown as a box: “न” (U+0928)" in line.text()
