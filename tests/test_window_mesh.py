"""The Mesh panel in the real window: tables and picture that follow each other, wings, walks, sets, edits."""

import csv
import io

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog

from solidtree.model.mesh.winged import END, LEFT, LEFT_AFTER, RIGHT, START
from solidtree.model.operations.placing import move
from solidtree.model.script import box, cylinder, document_of, sphere

pytest_plugins = ["window_driver"]

LEFT_BUTTON = Qt.MouseButton.LeftButton
SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
PART = box(20).named("block") - cylinder(6, 60, centred=True, segments=24).at(10, 10, 10).named("drill")


def opened(make_window, *solids):
    """The window with its panel, once the mesh is there."""
    driver = make_window(document_of(*(solids or (PART,))))
    driver.look_from("iso")
    driver.keys("Alt+W", driver.window.viewport)
    inspector = driver.window.mesh.inspector
    driver.qtbot.waitUntil(lambda: inspector.source.settled and inspector.mesh is not None, timeout=15000)
    return driver, inspector


def edge_between(mesh, a, b) -> int:
    """The number of the edge between two places."""
    ends = mesh.lists.vertices[mesh.winged.table[:, [START, END]]]
    wanted = np.sort(np.array([a, b], float), axis=0)
    (found,) = np.flatnonzero((np.abs(np.sort(ends, axis=1) - wanted) < 1e-6).all(axis=(1, 2)))
    return int(found)


def click_row(driver, page, element, modifiers=Qt.KeyboardModifier.NoModifier):
    row = int(page.view.elements.rows_of(np.array([element]))[0])
    index = page.view.elements.index(row, 1)
    page.view.scrollTo(index)
    driver.qtbot.mouseClick(page.view.viewport(), LEFT_BUTTON, modifiers, page.view.visualRect(index).center())


def rows_marked(page) -> set[int]:
    return {int(page.view.elements.listed[index.row()]) for index in page.view.selectionModel().selectedRows()}


def pixels(driver):
    viewer = driver.window.viewport.viewer
    viewer.render()
    return viewer.pixels().astype(int)


def test_tables_and_picture_follow_each_other(make_window):
    driver, inspector = opened(make_window)
    check_counts(driver, inspector)
    check_wings(driver, inspector)
    check_walks(driver, inspector)
    check_rows(driver, inspector)


def test_elements_are_listed_chosen_and_copied(make_window, tmp_path):
    driver, inspector = opened(make_window)
    check_lists(driver, inspector)
    check_copies(driver, inspector, tmp_path)
    check_sets(driver, inspector)


def test_costs_are_told_and_a_mesh_is_edited(make_window):
    driver, inspector = opened(make_window)
    check_costs(driver, inspector)
    check_edits(driver, inspector)


def check_counts(driver, inspector):
    page = inspector.page
    # 8 corners and two rims of 24; 12 edges, the rims and 24 down the hole; 6 sides, two with a hole, and 24 walls.
    assert "<b>56</b> vertices, <b>84</b> edges, <b>30</b> faces, <b>32</b> loops" in page.counts.text()
    assert "= 56 \u2212 84 + 30 \u2212 (32 \u2212 30) = 0" in page.euler.text() and "genus 1" in page.euler.text()
    assert page.pages.currentWidget() is page.tables["edges"] and page.tables["edges"].words.text() == "84 edges"
    for place, words in ((1, "<b>112</b> triangles"), (0, "<b>30</b> faces")):
        page.faces.setCurrentIndex(place)
        page.faces.activated.emit(place)
        assert words in page.counts.text() and inspector.mesh.topology.euler == 0


def check_wings(driver, inspector):
    mesh, page = inspector.mesh, inspector.page.tables["edges"]
    plain = pixels(driver)
    edge = edge_between(mesh, (20, 0, 20), (20, 20, 20))
    driver.click_at((20, 10, 20))
    assert inspector.chosen.edge == edge and rows_marked(page) == {edge}
    assert int(page.view.elements.listed[page.view.currentIndex().row()]) == edge
    assert f"<b>Edge {edge}</b>" in inspector.page.looked.text() and "90° convex" in inspector.page.looked.text()
    assert not driver.session.selection
    row = mesh.winged.table[edge]
    texts = [wing.text for wing in inspector.picture.wings.wings]
    assert texts == [f"left before {row[4]}", f"left after {row[5]}", f"right before {row[6]}", f"right after {row[7]}"]
    # The loops run with the wings' arrows: before ends where the edge's loop begins, after begins where it ends.
    points = mesh.lists.vertices
    left_before, left_after, right_before, right_after = inspector.picture.wings.wings
    near = 0.1 * mesh.length[edge]
    assert np.linalg.norm(left_before.end - points[row[START]]) < near
    assert np.linalg.norm(left_after.start - points[row[END]]) < near
    assert np.linalg.norm(right_before.end - points[row[END]]) < near
    assert np.linalg.norm(right_after.start - points[row[START]]) < near
    # Both faces are tinted, each in its own colour.
    drawn = pixels(driver)
    change = {}
    for name, place in (("top", (4.0, 17.0, 20.0)), ("side", (20.0, 10.0, 8.0))):
        spot = driver.pixel_of(place)
        change[name] = drawn[spot.y(), spot.x()] - plain[spot.y(), spot.x()]
        assert np.abs(change[name]).max() > 10
    assert np.abs(change["top"] - change["side"]).max() > 20
    driver.keys("Escape", driver.window.viewport)
    assert not inspector.chosen.count and inspector.picking
    assert np.abs(pixels(driver) - plain).max() <= 60 and (np.abs(pixels(driver) - plain).max(axis=2) > 2).mean() < 0.01


def check_rows(driver, inspector):
    mesh = inspector.mesh
    inspector.page.pages.setCurrentIndex(2)
    page = inspector.page.tables["faces"]
    top = int(np.flatnonzero(mesh.face_normals[:, 2] > 0.99)[0])
    plain = pixels(driver)
    click_row(driver, page, top)
    assert inspector.chosen.kind == "face" and set(inspector.chosen.numbers) == {top}
    spot = driver.pixel_of((4.0, 4.0, 20.0))
    assert np.abs(pixels(driver)[spot.y(), spot.x()] - plain[spot.y(), spot.x()]).max() > 20
    side = int(np.flatnonzero(mesh.face_normals[:, 0] > 0.99)[0])
    driver.keys("Ctrl+3", driver.window.viewport)
    driver.click_at((20, 10, 5), SHIFT)
    assert set(inspector.chosen.numbers) == {top, side} and rows_marked(page) == {top, side}
    driver.click_at((20, 10, 5), CTRL)
    assert set(inspector.chosen.numbers) == {top} == rows_marked(page)
    driver.window.actions_.run("mesh_select_node")
    assert [driver.node("block").id] == list(driver.session.selection)
    inspector.page.pages.setCurrentIndex(1)
    normals = inspector.page.tables["normals"]
    click_row(driver, normals, int(mesh.lists.face_normal[side]))
    assert set(inspector.chosen.numbers) == {side}


def check_walks(driver, inspector):
    mesh, viewport = inspector.mesh, driver.window.viewport
    edge = edge_between(mesh, (20, 0, 20), (20, 20, 20))
    driver.click_at((20, 10, 20))
    left, start = (int(mesh.winged.table[edge, column]) for column in (LEFT, START))
    walked = [edge]
    for _ in range(4):
        driver.keys("Period", viewport)
        walked.append(inspector.chosen.edge)
        assert left in mesh.winged.table[walked[-1], [LEFT, RIGHT]]
    loop = next(loop for loop in range(mesh.lists.loop_count) if edge in [e for e, _ in mesh.winged.loop(loop)]
                and mesh.lists.loop_faces()[loop] == left)  # fmt: skip
    assert walked[-1] == edge and walked[:4] == rotated([e for e, _ in mesh.winged.loop(loop)], edge)
    assert walked[1] == mesh.winged.table[edge, LEFT_AFTER]
    driver.keys("Comma", viewport)
    assert inspector.chosen.edge == walked[3]
    driver.keys("Period", viewport)
    star = mesh.winged.star(start)
    around = [edge]
    for _ in range(len(star)):
        driver.keys("BracketLeft", viewport)
        around.append(inspector.chosen.edge)
    assert around[-1] == edge and around[:-1] == rotated(star, edge)
    assert rows_marked(inspector.page.tables["edges"]) == {edge}


def rotated(ring, first):
    at = ring.index(first)
    return ring[at:] + ring[:at]


def check_lists(driver, inspector):
    mesh, page = inspector.mesh, inspector.page.tables["edges"]
    lengths = page.view.elements.table.titles.index("Length")
    page.view.sortByColumn(lengths, Qt.SortOrder.DescendingOrder)
    shown = [float(page.view.elements.index(row, lengths).data()) for row in range(page.view.elements.rowCount())]
    assert shown == sorted(shown, reverse=True) and len(shown) == 84
    page.set_filter("concave")
    hole = np.flatnonzero(mesh.bend < -1e-3)
    assert set(page.view.elements.listed) == set(hole) and page.words.text() == f"{len(hole)} of 84 edges"
    page.set_filter("short")
    page.limits["short"].setValue(19.0)
    assert set(page.view.elements.listed) == set(np.flatnonzero(mesh.length <= 19.0))
    long = int(np.argmax(mesh.length > 19.5))
    page.jump.setFocus()
    driver.write(str(long), page.jump)
    driver.keys("Return", page.jump)
    assert inspector.chosen.edge == long and rows_marked(page) == {long} and page.filter.currentData() == "all"
    inspector.page.first.click()
    assert page.view.elements.index(0, 0).data() == str(int(page.view.elements.listed[0]) + 1)
    assert f"<b>Edge {long + 1}</b>" in inspector.page.looked.text()
    page.jump.clear()
    driver.write("500", page.jump)
    driver.keys("Return", page.jump)
    assert "1 to 84" in driver.window.statusBar().currentMessage() and inspector.chosen.edge == long


def check_sets(driver, inspector):
    mesh, run = inspector.mesh, driver.window.actions_.run
    run("mesh_choose_sharp")
    assert set(inspector.chosen.numbers) == set(np.flatnonzero(np.abs(np.nan_to_num(mesh.bend)) >= 30))
    run("mesh_choose_naked")
    assert not inspector.chosen.count and "no such element" in driver.window.statusBar().currentMessage()
    driver.click_row(driver.node("drill"))
    driver.qtbot.waitUntil(lambda: inspector.source.settled)
    run("mesh_choose_of_nodes")
    walls = np.flatnonzero(mesh.area < 50)
    assert inspector.chosen.kind == "face" and set(inspector.chosen.numbers) == set(walls)
    assert rows_marked(inspector.page.tables["faces"]) == set(walls)
    run("mesh_choose_border")
    rims = inspector.chosen.numbers
    assert len(rims) == 48 and set(mesh.lists.vertices[mesh.winged.table[rims][:, :2]][..., 2].ravel()) == {0.0, 20.0}
    run("mesh_to_vertices")
    assert inspector.chosen.kind == "vertex" and inspector.chosen.count == 48
    angle = np.pi / 4 + np.pi / 24
    rim = (10 + 6 * np.cos(angle - np.pi / 24), 10 + 6 * np.sin(angle - np.pi / 24), 20)
    driver.keys("Ctrl+4", driver.window.viewport)
    driver.click_at((rim[0] + 0.3, rim[1] + 0.3, 20))
    assert inspector.chosen.count == 24
    driver.keys("Ctrl+5", driver.window.viewport)
    driver.click_at((20, 10, 20))
    assert inspector.chosen.count == 1
    driver.keys("Ctrl+1", driver.window.viewport)
    driver.click_at((20, 0, 20))
    assert mesh.lists.vertices[inspector.chosen.current].tolist() == [20, 0, 20]


def check_copies(driver, inspector, tmp_path):
    page = inspector.page.tables["edges"]
    click_row(driver, page, 3)
    click_row(driver, page, 5, CTRL)
    driver.session.select([driver.node("drill").id])
    driver.keys("Ctrl+C", page.view)
    lines = QGuiApplication.clipboard().text().split("\n")
    assert lines[0].split("\t") == page.view.elements.table.titles and len(lines) == 3
    assert [line.split("\t")[0] for line in lines[1:]] == ["4", "6"]  # they count from 1
    inspector.page.first.click()
    page.set_filter("concave")
    driver.window.actions_.run("mesh_save")
    dialog = driver.window.findChild(QFileDialog)
    path = tmp_path / "edges.csv"
    dialog.fileSelected.emit(str(path))
    dialog.reject()
    driver.qtbot.waitUntil(lambda: not driver.window.files.background.working)
    rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))
    assert [int(row["Edge"]) for row in rows] == page.view.elements.listed.tolist()
    assert all(row["Kind"] == "concave" and float(row["Angle"]) < 0 for row in rows)


def test_another_solid_is_taken_by_a_click_and_the_tools_give_way(make_window):
    driver, inspector = opened(make_window, PART, box(10).at(40, 0, 0).named("small"))
    assert inspector.source.solids[inspector.source.solid] == "Difference"
    driver.click_at((45, 5, 10))
    driver.qtbot.waitUntil(lambda: inspector.mesh.topology.edges == 12)
    assert inspector.page.solid.currentText() == "small" and not driver.session.selection
    driver.keys("Shift+M", driver.window.viewport)
    assert driver.window.measure.active and not inspector.picking
    driver.keys("Ctrl+2", driver.window.viewport)
    assert inspector.picking and not driver.window.measure.active
    driver.keys("Escape", driver.window.viewport)
    assert not inspector.picking
    driver.click_at((45, 5, 10))
    assert driver.session.selection and not inspector.chosen.count
    driver.keys("Alt+W", driver.window.viewport)
    assert not driver.window.mesh.in_front
    driver.keys("Alt+W", driver.window.viewport)
    inspector.source.choose(driver.document.solids[0].id)
    driver.keys("Ctrl+2", driver.window.viewport)
    check_changes(driver, inspector)


def check_changes(driver, inspector):
    driver.click_at((20, 10, 20))
    driver.session.do("insert", sphere(4).at(60), label="Add sphere")
    driver.settle()
    driver.qtbot.waitUntil(lambda: inspector.source.settled)
    assert inspector.page.solid.count() == 3 and inspector.chosen.edge >= 0
    # While something is dragged, what is chosen is no longer where it was; it is again when the drag is given up.
    driver.session.preview(move(driver.document, [driver.node("drill").id], 1, 0, 0))
    driver.settle()
    assert not inspector.picture.wings.wings
    driver.click_at((20, 10, 20))
    driver.session.cancel()
    driver.settle()
    driver.qtbot.waitUntil(lambda: inspector.source.settled)
    assert inspector.chosen.edge >= 0 and len(inspector.picture.wings.wings) == 4
    driver.session.do("move", [driver.node("drill").id], 3, 0, 0, label="Move")
    driver.settle()
    driver.qtbot.waitUntil(lambda: inspector.source.settled and inspector.mesh is not None)
    assert not inspector.chosen.count and inspector.mesh.lists.vertices[:, 0].max() == 20
    driver.session.do("delete", [root.id for root in driver.document.roots], label="Delete")
    driver.settle()
    driver.qtbot.waitUntil(lambda: inspector.source.settled and inspector.mesh is None)
    assert "Add a solid" in inspector.page.empty.text() and not inspector.page.pages.isVisible()


def check_costs(driver, inspector):
    inspector.page.pages.setCurrentWidget(inspector.page.costs)
    table = inspector.page.costs.table
    driver.qtbot.waitUntil(lambda: table.columnCount() == 4, timeout=15000)
    titles = [table.horizontalHeaderItem(column).text() for column in range(4)]
    assert titles == ["Triangle\nsoup", "Face\nlists", "+ edge\nlist", "Winged\nedge"] and table.rowCount() == 5
    assert table.item(0, 0).text() == "8.06 kB"  # 112 triangles of 72 bytes
    assert all(table.item(row, column).text().endswith(("µs", "ms")) for row in range(1, 5) for column in range(4))


def check_edits(driver, inspector):
    run, fault = driver.window.actions_.run, driver.window.actions_.fault
    driver.click_at((20, 10, 20))
    assert "is no mesh" in fault("mesh_split_edge")
    run("mesh_convert")
    follow(driver, inspector)
    assert driver.document.solids[0].kind == "ImportedMesh"
    inspector.page.faces.setCurrentIndex(1)
    inspector.page.faces.activated.emit(1)
    before = inspector.mesh.topology
    driver.click_at((20, 10, 20))
    assert fault("mesh_split_edge") is None
    run("mesh_split_edge")
    assert "split_mesh_edge(" in driver.session.log[-1]
    follow(driver, inspector)
    after = inspector.mesh.topology
    assert (after.vertices, after.edges, after.faces) == (before.vertices + 1, before.edges + 3, before.faces + 2)
    assert [20.0, 10.0, 20.0] in inspector.mesh.lists.vertices.tolist()
    driver.keys("Ctrl+3", driver.window.viewport)
    driver.click_at((20, 10, 5))
    run("mesh_delete_faces")
    follow(driver, inspector)
    assert inspector.mesh.naked.sum() == 3 and "naked" in inspector.page.euler.text()
    run("mesh_choose_naked")
    assert inspector.chosen.count == 3
    driver.keys("Ctrl+Z", driver.window.viewport)
    driver.keys("Ctrl+Z", driver.window.viewport)
    follow(driver, inspector)
    assert inspector.mesh.topology == before


def follow(driver, inspector):
    driver.settle()
    driver.qtbot.waitUntil(lambda: inspector.source.settled and inspector.mesh is not None)
