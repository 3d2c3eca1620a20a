"""Lettering through the window: added, written, set in another font, leaned, engraved, taken back."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QPlainTextEdit

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
