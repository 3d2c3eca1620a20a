"""The Faults panel in the real window: what comes in dirty is listed, shown, repaired in one step and checked again."""

import numpy as np
import pytest
from mesh_files import CORNERS, CUBE
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLineEdit
from replay import replayed

from solidtree.model.document.document import Document
from solidtree.model.document.primitives import ImportedMesh
from solidtree.model.document.table import same_document
from solidtree.model.outline.paths import path_of
from solidtree.model.script import box, cylinder, document_of, path

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton
SIDE, GAP = 20.0, 0.0004


def dirty_cube():
    """A cube of 20 mm with one face turned, one left out, a corner of one that is not joined, and a sliver."""
    points = [*(SIDE * CORNERS)]
    faces = [list(face) for face in CUBE]
    faces[3] = faces[3][::-1]  # of x = 20
    a, b, c = faces[11]  # of z = 20: joined at two corners
    points.append(points[c] + (0, 0, GAP))
    faces[11] = [a, b, len(points) - 1]
    d, e, f = faces[0]  # of x = 0: a vertex beside its edge from d to e
    way = np.mean([points[d], points[e]], axis=0)
    points.append(way + GAP / 2 * (points[f] - way) / np.linalg.norm(points[f] - way))
    p = len(points) - 1
    del faces[9]  # of z = 0
    faces[0:1] = [[d, p, f], [p, e, f], [d, e, p]]
    return np.array(points), faces


def write_obj(path, points, faces):
    lines = ["v {!r} {!r} {!r}".format(*point) for point in np.asarray(points).tolist()]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def imported(driver, path):
    """Import a file, wait for all that follows."""
    driver.window.files.import_file(path)
    driver.qtbot.waitUntil(lambda: bool(driver.document.roots) and not driver.window.files.background.working)
    driver.settle()
    driver.qtbot.waitUntil(lambda: driver.window.faults.checks.settled, timeout=20000)


def settled(driver):
    faults = driver.window.faults
    driver.qtbot.waitUntil(lambda: not faults.repairing.at_work and faults.checks.settled, timeout=20000)
    driver.settle()


def listed(driver):
    """How many rows the table has of each kind."""
    kinds = [row.finding.kind for row in driver.window.faults.page.table.findings.rows]
    return {kind: kinds.count(kind) for kind in kinds}


def click(driver, number):
    table = driver.window.faults.page.table
    index = table.model().index(number, 1)
    table.scrollTo(index)
    driver.qtbot.mouseClick(table.viewport(), LEFT, pos=table.visualRect(index).center())


@pytest.fixture
def dirty(driver, tmp_path):
    imported(driver, write_obj(tmp_path / "bracket.obj", *dirty_cube()))
    return driver


def test_a_dirty_import_opens_the_report_and_leaves_the_focus(make_window, tmp_path):
    driver = make_window(document_of(plate=box(40, 40, 2)))
    search = driver.window.findChild(QLineEdit, "search") or driver.window.tree
    search.setFocus()
    assert not driver.window.faults.in_front
    imported(driver, write_obj(tmp_path / "bracket.obj", *dirty_cube()))
    faults = driver.window.faults
    assert faults.in_front and driver.window.focusWidget() is search
    # What was left out leaves a border of three edges; the corner that is not joined opens two edges on both sides.
    assert listed(driver) == {"border": 2, "turned edge": 3, "near vertices": 1, "sliver": 1}
    assert f"{3 + 2 * 2} open edges" in faults.page.report.words.text()
    assert "bracket.obj has faults" in driver.window.statusBar().currentMessage()
    # Undone and done again, it does not come up by itself.
    driver.window.docks["Problems"].raise_()
    driver.qtbot.waitUntil(lambda: not faults.in_front)
    driver.keys("Ctrl+Z", driver.window.viewport)
    driver.window.actions_.run("redo")
    settled(driver)
    assert not faults.in_front and len(driver.document.solids) == 2


def test_a_clean_import_is_silent(driver, tmp_path):
    imported(driver, write_obj(tmp_path / "cube.obj", SIDE * CORNERS, CUBE))
    assert not driver.window.faults.in_front and driver.window.faults.page is None
    driver.keys("Ctrl+Alt+F", driver.window.viewport)
    settled(driver)
    page = driver.window.faults.page
    assert "Nothing found within 0.001 mm in “cube”" in page.report.words.text()
    assert page.table.isHidden() and not page.repair.isEnabled()


def test_a_row_brings_the_camera_to_its_place_and_escape_takes_the_marks_away(dirty):
    window, table = dirty.window, dirty.window.faults.page.table
    dirty.session.do("insert", box(10).at(60), label="Add box")
    settled(dirty)
    for number, row in ((0, table.findings.rows[0]), (len(table.findings.rows) - 1, table.findings.rows[-1])):
        click(dirty, number)
        dirty.qtbot.waitUntil(lambda row=row: np.allclose(window.viewport.viewer.camera.target, row.place, atol=1e-6))
        assert window.faults.picture.chosen is row
        spot = dirty.pixel_of(tuple(row.place))
        viewer = window.viewport.viewer
        viewer.render()
        marked = viewer.pixels().astype(int)
        dirty.keys("Escape", table)
        viewer.render()
        around = np.s_[spot.y() - 14 : spot.y() + 15, spot.x() - 14 : spot.x() + 15]
        assert np.abs(viewer.pixels().astype(int) - marked)[around].max() > 60
        assert window.faults.picture.chosen is None and not viewer.scene.faded
    click(dirty, 0)
    assert viewer.scene.faded == {dirty.document.solids[1].id}
    far = viewer.camera.distance
    dirty.keys("Down", table)
    assert table.current is table.findings.rows[1]
    table.selectRow(len(table.findings.rows) - 1)  # the sliver
    dirty.keys("Return", table)
    dirty.qtbot.waitUntil(lambda: viewer.camera.distance < far)
    window.docks["Problems"].raise_()
    dirty.qtbot.waitUntil(lambda: not viewer.scene.faded)


def test_a_repair_is_one_step_that_closes_the_solid_and_can_be_undone_and_replayed(dirty):
    window, session = dirty.window, dirty.session
    before, steps = session.document, len(session.log)
    window.faults.page.table.setFocus()
    window.actions_.run("repair_faults")
    settled(dirty)
    (solid,) = dirty.document.solids
    shown = window.evaluation.latest.solids[solid.id]
    assert shown.measures.volume == pytest.approx(SIDE**3, rel=1e-4)
    assert solid.id == before.solids[0].id and solid.name == "bracket"
    text = window.faults.page.report.words.text()
    assert window.faults.page.isAncestorOf(window.focusWidget())
    assert "not closed" in text and "Undo the repair" in text and "Nothing found within" in text
    assert len(session.log) == steps + 1 and same_document(replayed(session.log, Document()), session.document)
    window.faults.page.report.linked.emit("undo")
    assert session.document is before
    settled(dirty)
    assert "Undo the repair" not in window.faults.page.report.words.text() and listed(dirty)["sliver"] == 1


def test_a_single_repair_mends_its_kind_alone(dirty):
    page = dirty.window.faults.page
    page.kind.setCurrentIndex(next(i for i in range(page.kind.count()) if "turned" in page.kind.itemText(i)))
    assert set(listed(dirty)) == {"turned edge"}
    click(dirty, 0)
    dirty.keys("F", page.table)
    menu = page.repair.menu()
    assert menu.isVisible() and menu.actions()[0].text() == "Repair “bracket”"
    next(action for action in menu.actions() if action.text() == "Turn faces").trigger()
    menu.close()
    settled(dirty)
    rows = listed(dirty)
    assert "turned edge" not in rows and rows["border"] and rows["sliver"] == 1
    assert dirty.session.log[-1].endswith("['orient'], 0.001)")


def test_the_tolerance_is_kept_and_checked_with_at_once(dirty):
    page = dirty.window.faults.page
    page.tolerance.setFocus()
    page.tolerance.selectAll()
    dirty.write(str(GAP / 4), page.tolerance)
    dirty.keys("Return", page.tolerance)
    settled(dirty)
    rows = listed(dirty)
    assert "near vertices" not in rows and "sliver" not in rows and rows["border"]
    assert dirty.window.settings.tolerance("faults", 1.0) == GAP / 4
    page.tolerance.selectAll()
    dirty.write("-1", page.tolerance)
    dirty.keys("Return", page.tolerance)
    assert "The tolerance lies between" in dirty.window.statusBar().currentMessage()
    assert dirty.window.faults.checks.tolerance == GAP / 4


def test_findings_are_copied_as_text_and_csv(dirty):
    table = dirty.window.faults.page.table
    table.setFocus()
    dirty.keys("Ctrl+C", table)
    lines = QGuiApplication.clipboard().text().splitlines()
    assert lines[0].split("\t")[1] == "Fault" and len(lines) == 1 + len(table.findings.rows)
    table.copy(",")
    first = QGuiApplication.clipboard().text().splitlines()[1].split(",")
    assert first[0] == "bracket" and [float(number) for number in first[-3:]] == table.findings.rows[0].place.tolist()


def test_what_is_made_of_nodes_becomes_a_mesh_before_it_is_repaired(make_window):
    driver = make_window(document_of(pin=cylinder(8, 20, segments=90)))
    driver.window.settings.set_tolerance("faults", 0.3)
    driver.window.faults.checks.set_tolerance(0.3)
    driver.keys("Ctrl+Alt+F", driver.window.viewport)
    settled(driver)
    faults, before = driver.window.faults, driver.document
    assert "make a mesh of it" in faults.page.report.words.text()  # the fans of its ends are thin
    assert not faults.page.repair.isEnabled()
    faults.page.report.linked.emit(f"convert {before.solids[0].id}")
    settled(driver)
    (solid,) = driver.document.solids
    assert isinstance(solid, ImportedMesh) and solid.name == "pin"
    assert same_document(replayed(driver.session.log, before), driver.document)
    driver.keys("Ctrl+Z", driver.window.viewport)
    assert driver.document is before


def test_a_change_of_the_document_is_checked_while_the_panel_is_looked_at(dirty):
    dirty.session.do("delete", [dirty.document.solids[0].id])
    settled(dirty)
    page = dirty.window.faults.page
    assert not page.table.findings.rows and "nothing visible to check" in page.empty.text()
    assert dirty.window.faults.picture.chosen is None
    dirty.keys("Ctrl+Z", dirty.window.viewport)
    settled(dirty)
    assert listed(dirty)["sliver"] == 1


def test_one_hole_is_closed_by_itself(dirty):
    table, menu = dirty.window.faults.page.table, dirty.window.faults.page.repair.menu()
    next(action for action in menu.actions() if action.text() == "Turn faces").trigger()
    settled(dirty)
    before = dirty.document
    number = next(k for k, row in enumerate(table.findings.rows) if row.is_hole and row.place[2] < SIDE / 2)
    click(dirty, number)
    next(action for action in menu.actions() if action.text() == "Close this hole" and action.isVisible()).trigger()
    settled(dirty)
    assert listed(dirty) == {"border": 1, "near vertices": 1, "sliver": 1}
    assert "the hole is closed" in dirty.window.faults.page.report.words.text()
    assert dirty.session.log[-1].startswith("close_mesh_holes(")
    assert same_document(replayed(dirty.session.log, Document()), dirty.document)
    dirty.keys("Ctrl+Z", dirty.window.viewport)
    assert dirty.document is before


def test_a_drawing_is_welded_and_cut(make_window):
    loose = path("M 0 0 L 20 0 L 20 20 L 0 20 L 0 0.0004").named("frame")
    hatch = path("M 40 1 L 50 1 M 40 9 L 50 9 M 41 0 L 41 10 M 49 0 L 49 10").named("hatch")
    driver = make_window(document_of(loose, hatch))
    driver.keys("Ctrl+Alt+F", driver.window.viewport)
    settled(driver)
    page, before = driver.window.faults.page, driver.document
    assert listed(driver) == {"crossing": 4, "near ends": 1, "open end": 10}
    crossing = next(k for k, row in enumerate(page.table.findings.rows) if row.finding.kind == "crossing")
    click(driver, crossing)
    viewer = driver.window.viewport.viewer
    driver.qtbot.waitUntil(lambda: np.allclose(viewer.camera.target, page.table.current.place, atol=1e-6))
    assert np.allclose(np.sort(np.abs(page.table.current.place[:2] - (45, 5))), 4)
    next(action for action in page.repair.menu().actions() if action.text() == "Cut lines and weld").trigger()
    settled(driver)
    assert "crossing" not in listed(driver) and "lines cut where they cross" in page.report.words.text()
    assert sum(contour.closed for contour in path_of(driver.document.profiles[1]).contours) == 1
    driver.window.faults.leave()
    driver.window.actions_.run("repair_faults")
    settled(driver)
    assert "near ends" not in listed(driver) and path_of(driver.document.profiles[0]).contours[0].closed
    assert same_document(replayed(driver.session.log, before), driver.document)
    driver.keys("Ctrl+Z", driver.window.viewport)
    driver.keys("Ctrl+Z", driver.window.viewport)
    assert driver.document is before


def test_a_fault_in_the_picture_and_the_tools_give_way_to_each_other(dirty):
    window = dirty.window
    faults, handles = window.faults, window.handles
    click(dirty, 0)
    assert faults.picture.chosen is not None and handles.hidden
    window.actions_.run("measure")
    assert faults.picture.chosen is None and handles.hidden
    window.show_faults()  # the measurements have come before it
    dirty.qtbot.waitUntil(lambda: faults.in_front)
    click(dirty, 1)
    assert not window.measure.active and faults.picture.chosen is not None and handles.hidden
    window.docks["Mesh"].show()
    window.docks["Mesh"].raise_()
    dirty.qtbot.waitUntil(lambda: window.mesh.inspector is not None)
    tool = window.mesh.inspector.tool
    tool.start("edge")
    dirty.qtbot.waitUntil(lambda: faults.picture.chosen is None)
    assert tool.active and handles.hidden
    click(dirty, 0)
    assert not tool.active and faults.picture.chosen is not None and handles.hidden
    dirty.keys("Escape", faults.page.table)
    assert not handles.hidden
