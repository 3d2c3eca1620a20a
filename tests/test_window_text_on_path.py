"""Bevels, text on a path and stencils by the real window: menu, key, form, undo."""

import pytest
from PySide6.QtWidgets import QCheckBox

from solidtree.model.document.outlines import Stencil, TextOnPath
from solidtree.model.script import circle, document_of, extrude, lettering, measure, rectangle
from solidtree.model.solid.information import information

pytest_plugins = ["window_driver"]


def in_menu(driver, menu, title):
    """The entry of a menu of the bar, as it stands there."""
    bar = next(action.menu() for action in driver.window.menuBar().actions() if action.text().replace("&", "") == menu)
    return next(action for action in bar.actions() if action.text().replace("&", "") == title)


def test_a_lettering_is_set_on_a_circle_turned_over_and_taken_back(make_window):
    driver = make_window(document_of(sign=lettering("Rim"), rim=circle(15)))
    before = driver.document
    entry = in_menu(driver, "Curve", "Text on path")
    driver.session.select([before.profiles[0].id])
    driver.settle()
    assert not entry.isEnabled()
    driver.session.select([root.id for root in before.profiles])
    driver.settle()
    entry.trigger()
    (made,) = driver.document.profiles
    assert isinstance(made, TextOnPath) and [child.name for child in made.children] == ["sign", "rim"]
    driver.child(QCheckBox, "flip").click()
    driver.type_into(driver.field("start"), "5")
    driver.settle()
    made = driver.document.profiles[0]
    assert made.flip and made.start == 5.0
    while driver.document is not before:
        assert driver.session.undo()
    driver.session.select([root.id for root in before.profiles])
    driver.keys("Alt+P", driver.window.viewport)
    assert isinstance(driver.document.profiles[0], TextOnPath)


def test_letters_without_room_are_in_the_problems(make_window):
    driver = make_window(document_of(sign=lettering("far too long"), rim=circle(4)))
    driver.session.select([root.id for root in driver.document.profiles])
    driver.window.actions_.run("text_on_path")
    driver.settle()
    rows = driver.window.problems.list
    driver.qtbot.waitUntil(lambda: rows.count() > 0)
    assert "no room on the curve" in rows.item(0).text()


def test_counters_are_bridged_by_the_menu(make_window):
    driver = make_window(document_of(letters=lettering("BO8", 12)))
    driver.session.select([driver.document.profiles[0].id])
    driver.settle()
    in_menu(driver, "Curve", "Stencil").trigger()
    (made,) = driver.document.profiles
    assert isinstance(made, Stencil)
    driver.type_into(driver.field("bridges"), "2")
    driver.settle()
    (row,) = information(driver.document, 0.05)[0]["profiles"]
    assert driver.document.profiles[0].bridges == 2 and row["contours"] == 3 * 2  # each letter in two halves


def test_a_bevel_is_typed_into_the_form(make_window):
    driver = make_window(document_of(plate=extrude(rectangle(10, 10), 5)))
    driver.session.select([driver.document.solids[0].id])
    driver.settle()
    driver.type_into(driver.field("bevel"), "1")
    driver.settle()
    assert measure(driver.document.solids[0]).volume == pytest.approx(400 + (100 + 64 + 80) / 3)
