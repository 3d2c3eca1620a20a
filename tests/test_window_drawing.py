"""File, Export drawing: the preview follows the choices, and what is saved is what was shown."""

import xml.etree.ElementTree as ET

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import QApplication, QFileDialog

from solidtree.gui.drawing.drawing_dialog import DrawingDialog
from solidtree.model.drafting.page import items_of
from solidtree.model.script import box, cylinder, document_of, sphere

pytest_plugins = ["window_driver"]

PART = box(40, 40, 20).coloured("steelblue") - cylinder(8, 60, segments=32).at(20, 20, -5)


@pytest.fixture
def dialog(make_window):
    driver = make_window(document_of(part=PART))
    driver.keys("Ctrl+Shift+E", driver.window.viewport)
    dialog = driver.window.findChild(DrawingDialog)
    assert dialog is not None and dialog.isVisible()
    dialog.driver = driver
    settle(dialog)
    yield dialog
    if driver.window.findChild(DrawingDialog) is not None:
        dialog.reject()


def settle(dialog):
    dialog.driver.qtbot.waitUntil(dialog.save_button.isEnabled, timeout=20000)


def choose(dialog, box_, words):
    page = dialog.preview.page
    box_.setCurrentText(words)
    dialog.driver.qtbot.waitUntil(lambda: dialog.preview.page is not page, timeout=20000)
    settle(dialog)
    return dialog.preview.page


def test_the_preview_shows_the_window_s_own_view_and_follows_the_choices(dialog):
    titles = {item.words for item in items_of(dialog.preview.page, "title")}
    assert "Untitled" in titles and any("perspective" in words for words in titles)
    assert not dialog.choices.dimensions.isEnabled() and not dialog.choices.iso.isEnabled()
    page = choose(dialog, dialog.choices.view, "Three views, first angle")
    assert [group.name for group in page.groups] == ["Frame", "Front", "Top", "Left", "Iso"]
    assert {"40", "20"} <= {item.words for item in items_of(page, "dimension") if hasattr(item, "words")}
    page = choose(dialog, dialog.choices.page, "A3")
    assert {page.width, page.height} == {420, 297}
    page = choose(dialog, dialog.choices.orientation, "Portrait")
    assert (page.width, page.height) == (297, 420)
    assert choose(dialog, dialog.choices.scale, "1:2").scale == 0.5


def test_choices_that_are_not_there_lose_their_ticks_say_why_and_get_them_back(dialog):
    iso, dimensions = dialog.choices.iso, dialog.choices.dimensions
    assert not iso.isChecked() and "Three views" in iso.toolTip()
    assert not dimensions.isChecked() and "perspective" in dimensions.toolTip()
    choose(dialog, dialog.choices.view, "Three views, first angle")
    assert iso.isEnabled() and iso.isChecked() and dimensions.isEnabled() and dimensions.isChecked()
    assert "perspective" not in dimensions.toolTip()
    page = dialog.preview.page
    iso.click()
    dialog.driver.qtbot.waitUntil(lambda: dialog.preview.page is not page, timeout=20000)
    settle(dialog)
    assert "Iso" not in [group.name for group in dialog.preview.page.groups]
    choose(dialog, dialog.choices.view, "Top")
    choose(dialog, dialog.choices.view, "Three views, third angle")
    assert not iso.isChecked() and dimensions.isChecked()


def test_the_tolerance_follows_the_scale_until_one_is_written(dialog):
    assert dialog.choices.tolerance.currentText() == "Automatic" and dialog.choices.chosen_tolerance() is None
    dialog.choices.tolerance.setCurrentText("0")
    dialog.driver.qtbot.waitUntil(lambda: "above 0" in dialog.hint.text(), timeout=20000)
    dialog.choices.tolerance.setCurrentText("0.2")
    settle(dialog)
    assert dialog.choices.chosen_tolerance() == 0.2 and dialog.hint.text() == ""


def test_what_does_not_fit_is_said_beside_the_choices_and_cannot_be_saved(dialog):
    dialog.choices.scale.setCurrentText("100:1")
    dialog.driver.qtbot.waitUntil(lambda: "100:1" in dialog.hint.text(), timeout=20000)
    assert not dialog.save_button.isEnabled() and dialog.hint.property("fault")
    dialog.choices.scale.setCurrentText("1:x")
    dialog.driver.qtbot.waitUntil(lambda: "is no scale" in dialog.hint.text(), timeout=20000)
    dialog.choices.scale.setCurrentText("1:1")
    settle(dialog)
    assert dialog.hint.text() == ""


def test_enter_does_not_save_before_the_preview_has_followed(dialog):
    field = dialog.choices.scale.lineEdit()
    field.selectAll()
    dialog.driver.qtbot.keyClicks(field, "1:5")
    dialog.driver.keys("Return", field)
    assert dialog.findChild(QFileDialog) is None
    settle(dialog)
    assert dialog.preview.page.scale == 0.2


def test_the_page_is_drawn_in_its_colours_and_zooms_about_the_pointer(dialog):
    dialog.choices.faces.setChecked(True)
    page = choose(dialog, dialog.choices.view, "Top")
    preview = dialog.preview
    blue = QColor("steelblue")

    def colour(x, y):
        image = preview.grab().toImage()
        at = (preview._corner + QPointF(x, page.height - y) * preview.scale) * preview.devicePixelRatioF()
        return image.pixelColor(at.toPoint())

    face = next(item for item in items_of(page, "face"))
    low = face.contours[0].min(axis=0)
    found = colour(low[0] + 4.0, low[1] + 4.0)
    assert abs(found.hue() - blue.hue()) < 12 and found.saturation() > 40
    assert colour(3.0, 3.0) == QColor("white")
    scale, place = preview.scale, QPointF(100, 80)
    turned = QWheelEvent(
        place, preview.mapToGlobal(place), QPoint(), QPoint(0, 240), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(preview, turned)
    assert preview.scale == pytest.approx(1.44 * scale)
    dialog.driver.qtbot.mouseDClick(preview, Qt.MouseButton.LeftButton)
    assert preview.scale == pytest.approx(scale)


def test_saving_writes_what_is_shown(dialog, tmp_path):
    page = choose(dialog, dialog.choices.view, "Three views, third angle")
    driver, jobs = dialog.driver, dialog.driver.window.evaluation.jobs
    driver.qtbot.mouseClick(dialog.save_button, Qt.MouseButton.LeftButton)
    asking = dialog.findChild(QFileDialog)
    with driver.qtbot.waitSignal(jobs.exported, timeout=20000) as told:
        asking.fileSelected.emit(str(tmp_path / "part.svg"))
    assert told.args == [str(tmp_path / "part.svg"), ""]
    root = ET.parse(tmp_path / "part.svg").getroot()
    assert root.get("width") == f"{page.width:g}mm"
    labels = {e.get("{http://www.inkscape.org/namespaces/inkscape}label") for e in root.iter()}
    assert {"Front", "Top", "Right", "Iso", "part / Cylinder"} <= labels


def test_a_long_drawing_can_be_cancelled_and_the_window_lives_on(make_window):
    many = [sphere(10, segments=96).at(7 * i, 3 * (i % 5), 2 * (i % 3)) for i in range(30)]
    driver = make_window(document_of(*many))
    driver.window.actions_.run("export_drawing")
    dialog = driver.window.findChild(DrawingDialog)
    driver.qtbot.waitUntil(dialog.stop.isVisible, timeout=20000)
    driver.qtbot.mouseClick(dialog.stop, Qt.MouseButton.LeftButton)
    assert dialog.stop.isHidden() and "Cancelled" in dialog.hint.text() and not dialog.save_button.isEnabled()
    driver.keys("Escape", dialog)
    driver.qtbot.waitUntil(lambda: driver.window.findChild(DrawingDialog) is None)
    driver.window.activateWindow()
    driver.qtbot.waitUntil(driver.window.isActiveWindow)
    driver.keys("Shift+B", driver.window.viewport)
    driver.settle()
    assert len(driver.document.solids) == 31


def test_the_command_waits_for_a_visible_solid(driver):
    assert driver.window.actions_.fault("export_drawing") == "no solid is visible"
