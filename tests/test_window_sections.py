"""Sections in the real window: added by a key, dragged by their handle, edited in the panel, exported."""

import ezdxf
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from solidtree.gui.panels.sections import normal_from, normal_text
from solidtree.model.document.document import Section
from solidtree.model.document.errors import Refusal
from solidtree.model.operations.sections import add_section
from solidtree.model.script import box, cylinder, document_of
from solidtree.render.camera import project

pytest_plugins = ["window_driver"]

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
PART = (box(40, 40, 40) - cylinder(8, 90, segments=32).at(20, 20, -5)).named("part")


def pixel_on(driver, name, share):
    """Where a handle stands in the picture; `share` of the way along it."""
    viewer, marks = driver.window.viewport.viewer, driver.window.section_tool._marks
    handle = next(handle for handle in marks.handles if handle.name == name)
    path = handle.world(handle.path, handle.length(viewer.camera, viewer.size))
    place = share * (len(path) - 1)
    low = min(int(place), len(path) - 2)
    point = path[low] + (place - low) * (path[low + 1] - path[low])
    x, y, _ = project(viewer.camera, [point], viewer.size)[0]
    return QPoint(round(x), round(y))


def moved(driver, place, button=LEFT):
    viewport = driver.window.viewport
    event = QMouseEvent(QEvent.Type.MouseMove, QPointF(place), QPointF(viewport.mapToGlobal(place)), NONE, button,
                        Qt.KeyboardModifier.NoModifier)  # fmt: skip
    QApplication.sendEvent(viewport, event)


def cell(driver, row, column):
    return driver.window.sections.table.item(row, column)


@pytest.fixture
def opened(make_window):
    driver = make_window(document_of(PART))
    driver.look_from("iso")
    return driver


def test_a_key_adds_a_section_that_is_dragged_with_one_step_and_taken_back_by_escape(opened):
    driver, viewport = opened, opened.window.viewport
    driver.keys("Alt+Z", viewport)
    assert driver.document.sections == (Section("Section", (20, 20, 20), (0, 0, -1)),)
    assert driver.window.docks["Sections"].isVisible() and driver.window.section_tool.name == "Section"
    added = driver.document

    def drag(typed=""):
        tip, foot = pixel_on(driver, "section", 0.8), pixel_on(driver, "section", 0.2)
        moved(driver, tip, NONE)
        driver.qtbot.mousePress(viewport, LEFT, pos=tip)
        moved(driver, foot)
        assert driver.session.previewing and driver.document.solids is added.solids
        driver.write(typed, viewport)
        moved(driver, tip if typed else foot)
        return foot

    driver.qtbot.mouseRelease(viewport, LEFT, pos=drag())
    dragged = driver.document
    assert driver.session.undo_label == "Shift Section" and driver.session.log[-1].startswith("set_section(")
    x, y, z = dragged.sections[0].point
    assert (x, y) == (20, 20) and 5 < z < 19 and dragged.sections[0].normal == (0, 0, -1)
    foot = drag()
    driver.keys("Escape", viewport)
    assert driver.document is dragged
    driver.qtbot.mouseRelease(viewport, LEFT, pos=foot)
    assert driver.document is dragged
    driver.qtbot.mouseRelease(viewport, LEFT, pos=drag(typed="7.5"))
    assert driver.document.sections[0].point == (20, 20, 7.5)  # and the pointer has no say any more
    driver.keys("Ctrl+Z", viewport)
    assert driver.document is dragged
    driver.keys("Ctrl+Z", viewport)
    assert driver.document is added


def test_an_arc_tilts_the_plane_about_its_middle(opened):
    driver, viewport = opened, opened.window.viewport
    driver.keys("Alt+X", viewport)
    before = driver.document.sections[0]
    start, end = pixel_on(driver, "section tilt v", 1.0), pixel_on(driver, "section tilt v", 0.8)
    driver.qtbot.mousePress(viewport, LEFT, pos=start)
    moved(driver, end)
    driver.qtbot.mouseRelease(viewport, LEFT, pos=end)
    after = driver.document.sections[0]
    assert driver.session.undo_label == "Tilt Section" and after.point == before.point
    assert 0.5 < sum(a * b for a, b in zip(before.normal, after.normal, strict=True)) < 0.999


def test_a_click_on_a_face_makes_a_section_in_its_plane(opened):
    driver = opened
    driver.window.actions_.run("section_face")
    driver.click_at((40, 20, 25))
    assert driver.document.sections == (Section("Section", driver.document.sections[0].point, (-1, 0, 0)),)
    assert driver.document.sections[0].point[0] == pytest.approx(40, abs=1e-5) and not driver.session.selection


def test_the_panel_shows_and_changes_what_there_is(opened):
    driver, sections = opened, lambda: opened.document.sections
    driver.keys("Alt+Z", driver.window.viewport)
    driver.settle()
    hole = 0.5 * 32 * 64 * 0.19509032201612825  # sin(2 pi / 32)
    driver.qtbot.waitUntil(lambda: cell(driver, 0, 3).text().startswith(f"{1600 - hole:,.2f}".replace(",", "\u202f")))
    assert (cell(driver, 0, 1).text(), cell(driver, 0, 2).text()) == ("-z", "20")
    cell(driver, 0, 2).setText("30 + 5")
    assert sections()[0].point == (20, 20, 35) and driver.session.undo_label == "Shift Section"
    cell(driver, 0, 1).setText("x")
    assert sections()[0].normal == (1, 0, 0)
    cell(driver, 0, 0).setText("Lid")
    assert sections()[0].name == "Lid" == driver.window.section_tool.name
    cell(driver, 0, 1).setText("up")
    assert cell(driver, 0, 1).text() == "x" and "no direction" in driver.window.statusBar().currentMessage()
    cell(driver, 0, 0).setCheckState(Qt.CheckState.Unchecked)
    assert not sections()[0].active and not driver.window.viewport.viewer.scene.sections.planes
    driver.window.actions_.run("flip_section")
    assert sections()[0].normal == (-1, 0, 0)
    driver.window.actions_.run("delete_section")
    assert sections() == () and driver.window.sections.table.isHidden()
    assert driver.window.actions_.fault("delete_section") == "the document has no section"


def test_sections_of_a_document_open_its_picture_and_a_key_shows_it_whole(make_window):
    driver = make_window(add_section(document_of(PART), point=(0, 20, 0), normal=(0, 1, 0)))
    viewer = driver.window.viewport.viewer
    driver.look_from("front")
    pick = viewer.pick(*[float(value) for value in (driver.pixel_of((5, 0, 5)).x(), driver.pixel_of((5, 0, 5)).y())])
    assert pick is not None and pick.section == "Section" and pick.point[1] == pytest.approx(20)
    driver.keys("Shift+X", driver.window.viewport)
    assert not viewer.scene.sections.planes and not driver.window.actions_["sections"].isChecked()
    driver.keys("Shift+X", driver.window.viewport)
    assert len(viewer.scene.sections.planes) == 1 and driver.session.undo_label is None


def test_outlines_are_written_by_the_worker(make_window, tmp_path):
    driver = make_window(add_section(document_of(PART), point=(0, 0, 10)))
    file = tmp_path / "cut.dxf"
    with driver.qtbot.waitSignal(driver.window.evaluation.jobs.exported, timeout=30000) as told:
        driver.window.files.export(file, section=driver.document.sections[0])
    assert told.args[1] == "" and len(list(ezdxf.readfile(file).modelspace())) == 2


def test_directions_are_read_as_they_are_written():
    for normal in ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0)):
        assert normal_from(normal_text(normal)) == normal
    assert normal_from("\u2212Y") == (0, -1, 0) and normal_from("1, 2 0.5") == (1, 2, 0.5)
    for wrong in ("", "w", "1 2", "1 2 3 4", "--x z"):
        with pytest.raises(Refusal):
            normal_from(wrong)


def test_a_drag_ends_where_another_document_is_opened(opened):
    driver, viewport = opened, opened.window.viewport
    driver.keys("Alt+Z", viewport)
    tip, foot = pixel_on(driver, "section", 0.8), pixel_on(driver, "section", 0.2)
    driver.qtbot.mousePress(viewport, LEFT, pos=tip)
    moved(driver, foot)
    assert driver.session.previewing
    other = add_section(document_of(box(10)), "Section")
    driver.open(other)
    moved(driver, tip + (tip - foot))
    assert driver.document is other
    driver.qtbot.mouseRelease(viewport, LEFT, pos=foot)
    assert driver.document is other and not driver.session.modified
