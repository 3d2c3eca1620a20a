"""Outlines joined, offset and stroked by the real window: menu, keys, dialog."""

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

from solidtree.gui.curves.outline_dialog import OutlineDialog
from solidtree.model.document.document import Document
from solidtree.model.document.outlines import Circle, Path, Rectangle
from solidtree.model.operations.curves.outline_areas import own_axes_path

pytest_plugins = ["window_driver"]


def area(driver, node_id="n1"):
    return own_axes_path(driver.document, node_id).area()


@pytest.fixture
def opened(make_window):
    driver = make_window(
        Document(
            profiles=(
                Rectangle(id="n1", name="Plate", width=30.0, height=20.0),
                Circle(id="n2", name="Disc", radius=5.0).at(30, 10, 0),
            )
        )
    )
    return driver


def dialog(driver):
    driver.qtbot.waitUntil(lambda: isinstance(QApplication.activeModalWidget(), OutlineDialog), timeout=5000)
    return QApplication.activeModalWidget()


def test_selected_outlines_become_one_path_by_a_key_and_undo_brings_them_back(opened):
    driver, before = opened, opened.document
    driver.session.select(["n1", "n2"])
    driver.window.actions_["unite_outlines"].trigger()
    driver.qtbot.waitUntil(lambda: driver.document is not before, timeout=5000)
    (plate,) = driver.document.profiles
    assert isinstance(plate, Path) and plate.name == "Plate"
    assert area(driver) == pytest.approx(600 + np.pi * 25 / 2, rel=1e-9)
    driver.window.actions_["undo"].trigger()
    assert driver.document is before


def test_what_is_typed_into_the_offset_shows_at_once_and_is_one_step(opened):
    driver, before = opened, opened.document
    driver.session.select(["n1"])
    driver.window.actions_["offset_outline"].trigger()
    asked = dialog(driver)
    driver.qtbot.waitUntil(lambda: driver.session.previewing, timeout=5000)
    driver.keys("Ctrl+A", asked.size_field)
    driver.write("-3", asked.size_field)
    driver.qtbot.waitUntil(lambda: driver.session.previewing and area(driver) < 600, timeout=5000)
    assert area(driver) == pytest.approx(24 * 14, rel=1e-6)
    driver.keys("Ctrl+A", asked.size_field)
    driver.write("-30", asked.size_field)
    driver.qtbot.waitUntil(lambda: not driver.session.previewing, timeout=5000)
    assert asked.hint.text().startswith("Nothing is left of “Plate”")
    driver.keys("Ctrl+A", asked.size_field)
    driver.write("1", asked.size_field)
    driver.keys("Return", asked.size_field)  # before the picture has followed
    driver.qtbot.waitUntil(lambda: driver.session.undo_label == "Offset", timeout=5000)
    assert area(driver) == pytest.approx(600 + 100 + np.pi, abs=0.5)
    assert driver.session.log == ("offset_outline(['n1'], 1, 'round')",)
    driver.window.actions_["undo"].trigger()
    assert driver.document is before


def test_escape_leaves_the_outline_as_it_was(opened):
    driver, before = opened, opened.document
    driver.session.select(["n2"])
    driver.window.actions_["stroke_outline"].trigger()
    asked = dialog(driver)
    driver.qtbot.waitUntil(lambda: driver.session.previewing, timeout=5000)
    driver.keys("Escape", asked)
    driver.qtbot.waitUntil(lambda: not driver.session.previewing, timeout=5000)
    assert driver.document is before and not driver.session.undo_label


def test_solids_are_told_to_be_no_outlines(driver):
    driver.window.actions_["add_box"].trigger()
    fault = driver.window.actions_.fault("unite_outlines")
    assert fault == "“Box” is no outline"
