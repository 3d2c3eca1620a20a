"""The Pipeline panel in the real window: a clicked corner's stages, what is tried and applied, culling, counts."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication
from replay import replayed

from solidtree.gui.pipeline.trial import PLANE_NAMES
from solidtree.model.document.table import same_document
from solidtree.model.document.tree import find
from solidtree.model.pipeline.explanation import number
from solidtree.model.script import box, document_of, halfspace, linear_array, sphere, union
from solidtree.render.camera import orbit, project
from solidtree.render.picture import ids_picture, numbers_of

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton
CORNER = (20.0, 0.0, 20.0)  # of the box, nearest to the eye in the isometric view


def opened(make_window, *solids):
    driver = make_window(document_of(*(solids or (box(20).named("Block"),))))
    driver.look_from("iso")
    driver.keys("Alt+Shift+V", driver.window.viewport)
    panel = driver.window.pipeline
    driver.qtbot.waitUntil(lambda: panel.in_front and panel.page is not None)
    driver.qtbot.waitUntil(lambda: panel.explorer.flow is not None)
    return driver, panel, panel.page


def click_corner(driver, panel, corner=CORNER):
    driver.qtbot.mouseClick(panel.page.pick, LEFT)
    assert panel.tool.active and panel.page.pick.isChecked()
    driver.click_at(corner)
    driver.keys("Escape", driver.window.viewport)
    assert not panel.tool.active and not driver.session.selection


def stage(page, name):
    return np.array(next(stage.coordinates for stage in page.stages.stages if stage.name == name))


def counted(driver, panel):
    driver.qtbot.waitUntil(lambda: panel.explorer.flow.result is not None, timeout=10000)
    return panel.explorer.flow.result.counts


def write(driver, field, text):
    field.setFocus()
    field.selectAll()
    driver.write(text, field)
    driver.keys("Return", field)


def type_entry(driver, grid, row, column, text):
    grid.setCurrentCell(row, column)
    grid.editItem(grid.item(row, column))
    editor = QApplication.focusWidget()
    editor.selectAll()
    driver.write(text, editor)
    driver.keys("Return", editor)
    driver.qtbot.waitUntil(lambda: grid.state() != grid.State.EditingState)
    QApplication.processEvents()


def test_a_clicked_corner_is_followed_to_the_pixel_that_was_clicked(make_window):
    driver, panel, page = opened(make_window, box(20).at(5, 0, 0).turned(z=90).named("Block"))
    viewer = driver.window.viewport.viewer
    assert "Pick a vertex" in page.words.text() and not page.stages.isVisible()
    corner = (0.0, 5.0, 20.0)  # (5, 0, 20) turned
    click_corner(driver, panel, corner)
    clicked = driver.pixel_of(corner)
    np.testing.assert_allclose(stage(page, "Model"), (0, 0, 20), atol=1e-9)
    np.testing.assert_allclose(stage(page, "World"), corner, atol=1e-9)
    assert page.point.text() == "0, 5, 20" and page.vertex.text().isdecimal()
    x, y, depth = stage(page, "Pixel")
    assert abs(x - clicked.x()) <= 1 and abs(y - clicked.y()) <= 1 and 0 < depth < 1
    np.testing.assert_allclose((x, y), project(viewer.camera, [corner], viewer.size)[0, :2], atol=1e-6)
    driver.qtbot.waitUntil(lambda: panel.tool.mark.pixel == pytest.approx((x, y)))
    clip = stage(page, "Clip")
    np.testing.assert_allclose(stage(page, "Device"), clip[:3] / clip[3])
    page.stages.selectRow(3)
    assert "inside all six planes" in page.words.text() and f"= {number(clip[3])}" in page.words.text()
    # The mark stands in the picture, with its own colour.
    viewer.render()
    pixels = viewer.pixels().astype(int)[int(y) - 12 : int(y) + 13, int(x) - 12 : int(x) + 13]
    assert (np.abs(pixels - (0xC2, 0x18, 0x5B)).max(axis=2) < 40).sum() > 20


def test_the_numbers_follow_the_camera_and_the_node(make_window):
    driver, panel, page = opened(make_window)
    click_corner(driver, panel)
    before = stage(page, "Pixel")
    driver.window.viewport.change(lambda viewer: viewer.set_camera(orbit(viewer.camera, 20.0, 5.0)))
    driver.qtbot.waitUntil(lambda: abs(stage(page, "Pixel") - before).max() > 5)
    viewer = driver.window.viewport.viewer
    expected = project(viewer.camera, [CORNER], viewer.size)[0, :2]
    np.testing.assert_allclose(stage(page, "Pixel")[:2], expected, atol=1e-6)
    driver.session.do("move", [driver.node("Block").id], 0, 0, 7)
    driver.qtbot.waitUntil(lambda: stage(page, "World")[2] == 27)
    assert stage(page, "Model")[2] == 20
    panel.page.pick.click()
    driver.window.actions_.run("measure")
    assert not panel.tool.active and driver.window.measure.active  # one tool has the clicks
    panel.page.pick.click()
    assert panel.tool.active and not driver.window.measure.active and not driver.window.actions_["measure"].isChecked()
    driver.session.do("delete", [driver.node("Block").id])
    driver.settle()
    driver.qtbot.waitUntil(lambda: panel.explorer.flow is None and not page.stages.stages)
    driver.session.undo()
    driver.settle()
    driver.keys("Alt+Shift+V", driver.window.viewport)
    driver.qtbot.waitUntil(lambda: not panel.in_front)
    assert not panel.tool.active
    assert panel.tool.mark.point is None


def test_points_are_typed_and_vertices_have_numbers(make_window):
    driver, panel, page = opened(make_window, box(20).named("Block"), sphere(5, segments=16).at(60).named("Ball"))
    write(driver, page.point, "1, 2 + 3, 500")
    np.testing.assert_allclose(stage(page, "World"), (1, 5, 500))
    page.stages.selectRow(3)
    assert "outside the" in page.words.text() and "it is clipped" in page.words.text()
    write(driver, page.point, "1, 2")
    assert "is no point" in driver.window.statusBar().currentMessage()
    assert page.solid.isVisible() and page.solid.count() == 2
    page.solid.setCurrentIndex(1)
    page.solid.activated.emit(1)
    mesh = driver.window.viewport.viewer.scene.solid_meshes[driver.node("Ball").id]
    np.testing.assert_allclose(stage(page, "World"), mesh.vertices[0], atol=1e-9)
    write(driver, page.vertex, "3")
    np.testing.assert_allclose(stage(page, "World"), mesh.vertices[3], atol=1e-9)
    np.testing.assert_allclose(stage(page, "Model"), mesh.vertices[3] - (60, 0, 0), atol=1e-9)
    driver.keys("Up", page.vertex)
    np.testing.assert_allclose(stage(page, "World"), mesh.vertices[4], atol=1e-9)
    write(driver, page.vertex, "99999")
    assert "there is no vertex 99999" in driver.window.statusBar().currentMessage().lower()
    write(driver, page.vertex, "x")
    assert "is no number of a vertex" in driver.window.statusBar().currentMessage()
    page.point.selectAll()
    driver.keys("Delete", page.point)
    driver.keys("Return", page.point)
    assert panel.explorer.subject is None and panel.tool.mark.point is None


def test_what_is_tried_is_marked_and_leaves_the_picture_alone(make_window):
    driver, panel, page = opened(make_window)
    click_corner(driver, panel)
    camera, pixel = driver.window.viewport.viewer.camera, stage(page, "Pixel")
    page.tabs.setCurrentIndex(1)
    grid = page.matrices.grids["projection"]
    first = grid.matrix[0, 0]
    type_entry(driver, grid, 0, 0, str(2 * first))
    assert (
        page.state.isVisible()
        and "projection" in page.changed.text()
        and page.matrices.resets["projection"].isVisible()
    )
    middle = driver.window.viewport.viewer.size[0] / 2
    assert stage(page, "Pixel")[0] - middle == pytest.approx(2 * (pixel[0] - middle))
    assert grid.item(0, 0).font().bold() and driver.window.viewport.viewer.camera is camera
    assert panel.tool.mark.pixel == pytest.approx(tuple(pixel[:2]))
    page.matrices.grids["projection"].pointed.emit(1, 1)
    assert "cot 15" in page.matrices.words.text() or "how much of" in page.matrices.words.text()
    driver.qtbot.mouseClick(page.matrices.applies["projection"], LEFT)
    assert "as wide and as high as its window" in driver.window.statusBar().currentMessage()
    for text, words in (("0", "would flatten space"), ("nan", "the entry"), ("x", "no parameter called x")):
        type_entry(driver, grid, 1, 1, text)
        assert words in driver.window.statusBar().currentMessage(), text
    type_entry(driver, page.matrices.grids["view"], 3, 0, "1")
    assert "only the projection changes w" in driver.window.statusBar().currentMessage()
    driver.qtbot.mouseClick(page.reset, LEFT)
    assert not page.state.isVisible() and not grid.item(0, 0).font().bold() and grid.matrix[0, 0] == first
    np.testing.assert_allclose(stage(page, "Pixel"), pixel)


def test_a_model_matrix_is_applied_as_one_step_that_echoes(make_window):
    driver, panel, page = opened(make_window, union(box(20).at(1, 2, 3).named("Block"), box(2)).turned(z=30))
    cos, sin = np.cos(np.radians(30)), np.sin(np.radians(30))
    click_corner(driver, panel, (21 * cos - 2 * sin, 21 * sin + 2 * cos, 23))
    own = stage(page, "Model")
    grid = page.matrices.grids["model"]
    page.tabs.setCurrentIndex(1)
    wanted = grid.matrix.copy()
    wanted[2, 3] += 9.0
    wanted[0, 2] += 0.25  # a shear
    panel.explorer.trial.set_matrix("model", wanted)
    node, before = panel.explorer.subject.path[-1], driver.document
    driver.qtbot.mouseClick(page.matrices.applies["model"], LEFT)
    driver.settle()
    assert not page.state.isVisible() and driver.session.undo_label.startswith("Place ")
    assert driver.window.script.toPlainText().startswith(f"place('{node}', at(1, 2, 3), transformed((")
    driver.qtbot.waitUntil(lambda: np.allclose(page.matrices.grids["model"].matrix, wanted, atol=1e-9))
    np.testing.assert_allclose(stage(page, "Model"), own, atol=1e-9)
    np.testing.assert_allclose(stage(page, "World"), (wanted @ (*own, 1))[:3], atol=1e-9)
    placed = find(driver.document, node)
    assert same_document(replayed([driver.window.script.toPlainText()], before), driver.document)
    driver.session.undo()
    assert find(driver.document, node).placement != placed.placement and not driver.session.undo_label


def test_a_view_and_a_lens_are_applied_to_the_camera(make_window):
    driver, panel, page = opened(make_window)
    page.tabs.setCurrentIndex(1)
    viewer = driver.window.viewport.viewer
    view = page.matrices.grids["view"].matrix.copy()
    view[0, 3] += 4.0  # to the right in the eye's axes
    panel.explorer.trial.set_matrix("view", view)
    place = np.array(viewer.camera.position)
    driver.qtbot.mouseClick(page.matrices.applies["view"], LEFT)
    driver.qtbot.waitUntil(lambda: np.allclose(page.matrices.grids["view"].matrix, view, atol=1e-6))
    assert np.linalg.norm(viewer.camera.position - place) == pytest.approx(4.0)
    leaning = view.copy()
    leaning[0, 0] *= 1.5
    panel.explorer.trial.set_matrix("view", leaning)
    driver.qtbot.mouseClick(page.matrices.applies["view"], LEFT)
    assert "a camera only turns and moves" in driver.window.statusBar().currentMessage().lower()
    panel.explorer.trial.reset()
    page.tabs.setCurrentIndex(0)
    distance = viewer.camera.distance
    write(driver, page.frame.lens.fields["angle"], "50")
    write(driver, page.frame.lens.fields["near"], f"{distance:.3f}")
    assert "projection" in page.changed.text() and viewer.camera.view_angle == 30
    write(driver, page.frame.lens.fields["near"], f"{1e6}")
    assert "far plane must lie behind" in driver.window.statusBar().currentMessage()
    page.tabs.setCurrentIndex(1)
    viewer.render()
    plain = viewer.pixels().astype(int)
    driver.qtbot.mouseClick(page.matrices.applies["projection"], LEFT)
    assert viewer.camera.view_angle == pytest.approx(50) and viewer.clipping[0] == pytest.approx(distance, abs=0.01)
    viewer.render()
    assert np.abs(viewer.pixels().astype(int) - plain).max() > 30
    page.tabs.setCurrentIndex(0)
    driver.qtbot.waitUntil(page.frame.automatic.isVisible)
    driver.qtbot.mouseClick(page.frame.automatic, LEFT)
    driver.qtbot.waitUntil(lambda: not page.frame.automatic.isVisible())
    assert viewer.clipping is None and driver.window.looks.clipping is None
    driver.window.looks.set_clipping((10.0, 2000.0))
    page.frame.lens.tried.emit("angle", 70.0)
    write(driver, page.point, "1, 2, 3")
    driver.open(document_of(sphere(5, segments=16)))
    assert viewer.clipping is None and not panel.explorer.trial.active and panel.explorer.subject is None


def test_counts_are_those_of_the_picture_and_planes_can_be_switched_off(make_window):
    solids = (box(20).named("Block"), linear_array(sphere(4, segments=16), 3, (12, 0, 0)).at(0, 40, 0))
    driver, panel, page = opened(make_window, *solids)
    told = counted(driver, panel)
    viewer = driver.window.viewport.viewer
    meshes = list(viewer.scene.solid_meshes.values())
    assert told.triangles == sum(len(mesh.triangles) for mesh in meshes) and told.outside == told.cut == told.away == 0
    size = tuple(round(side) for side in viewer.size)
    seen = (numbers_of(ids_picture(meshes, size, viewer.camera)) > 0).sum()
    assert abs(told.pixels - seen) <= 0.002 * size[0] * size[1]
    page.tabs.setCurrentIndex(3)
    rows = {page.counts.table.item(row, 0).text(): page.counts.table.item(row, 1).text() for row in range(12)}
    assert rows["Triangles in"].replace("\u202f", "") == str(told.triangles)
    assert rows["Pixels covered"].replace("\u202f", "") == str(told.pixels)
    page.tabs.setCurrentIndex(0)
    write(driver, page.frame.lens.fields["near"], f"{viewer.camera.distance}")
    near = counted(driver, panel)
    assert near.cut > 0 and near.outside > 0 and panel.explorer.flow.cut
    brute = panel.explorer.flow
    heights = brute.matrices.clip(brute.geometry.points)[brute.geometry.triangles] @ (0, 0, 1, 1)
    assert near.outside == (heights < 0).all(axis=1).sum()
    assert near.cut == ((heights < 0).any(axis=1) & (heights >= 0).any(axis=1)).sum()
    driver.qtbot.mouseClick(page.frame.planes["near"], LEFT, pos=QPoint(8, page.frame.planes["near"].height() // 2))
    assert "near plane off" in page.changed.text()
    assert counted(driver, panel).outside == 0
    driver.qtbot.mouseClick(page.reset, LEFT)
    assert all(page.frame.planes[plane].isChecked() for plane in PLANE_NAMES) and counted(driver, panel) == told


def test_culling_is_a_switch_of_the_view(make_window):
    driver, panel, page = opened(make_window, box(20) & halfspace((0, 0, -1), (0, 0, 12)))
    whole = counted(driver, panel)
    page.tabs.setCurrentIndex(2)
    viewer = driver.window.viewport.viewer
    driver.qtbot.mouseClick(page.cull, LEFT, pos=QPoint(8, page.cull.height() // 2))
    assert viewer.scene.culling and driver.window.actions_["cull_back_faces"].isChecked()
    driver.qtbot.waitUntil(lambda: panel.explorer.flow.cull and panel.explorer.flow.result is not None)
    culled = panel.explorer.flow.result.counts
    driver.qtbot.mouseClick(page.floating, LEFT)
    assert driver.window.docks["Pipeline"].isFloating() and page.isVisible()
    driver.qtbot.mouseClick(page.floating, LEFT)
    assert not driver.window.docks["Pipeline"].isFloating() and not page.floating.isChecked()
    # Three faces of a box are turned towards the eye, in the isometric view.
    assert (culled.away, culled.polygons, culled.overdraw) == (6, 6, 1.0) and culled.pixels == whole.pixels
    driver.window.looks.set_translucent(True)
    viewer.render()
    without = viewer.pixels().astype(int)
    driver.window.actions_.run("cull_back_faces")
    driver.qtbot.waitUntil(lambda: not viewer.scene.culling and not page.cull.isChecked())
    viewer.render()
    assert np.abs(viewer.pixels().astype(int) - without).max() > 15


def test_the_second_view_turns_zooms_and_shows_the_cube(make_window):
    driver, panel, page = opened(make_window)
    click_corner(driver, panel)
    view = page.frame.view
    first = view.grab().toImage()
    camera = view.camera
    driver.keys("Left", view)
    driver.keys("Plus", view)
    assert view.camera.parallel_scale < camera.parallel_scale and view.camera.position != camera.position
    assert view.grab().toImage() != first
    driver.keys("F", view)
    eye = view.to_widget(panel.explorer.flow.eye[None])[0]
    np.testing.assert_allclose(panel.explorer.flow.eye, driver.window.viewport.viewer.camera.position, rtol=1e-6)
    assert 0 < eye[0] < view.width() and 0 < eye[1] < view.height()
    page.frame.space.setCurrentIndex(1)
    driver.keys("Down", view)
    assert view.device and view.grab().toImage() != first
    page.tabs.setCurrentIndex(2)
    counted(driver, panel)
    wires = page.pixels.grab().toImage()
    for mode in (1, 2):
        page.mode.setCurrentIndex(mode)
        assert page.pixels.grab().toImage() != wires
    frame, told = page.pixels.frame, []
    page.pixels.pointed.connect(told.append)
    driver.qtbot.mouseMove(page.pixels, frame.center().toPoint())
    driver.qtbot.mouseMove(page.pixels, frame.topLeft().toPoint() + QPoint(3, 3))
    driver.qtbot.waitUntil(lambda: len(told) > 1)
    assert re.search(r"[12] fragments?, the nearest at depth 0\.\d+$", told[0]) and told[-1].endswith(": background")
    driver.qtbot.mouseClick(page.pixels, LEFT, pos=frame.center().toPoint())
    front = driver.window.viewport.viewer.pick(*(side / 2 for side in driver.window.viewport.viewer.size)).point
    np.testing.assert_allclose(stage(page, "World"), front, atol=0.2)  # within a pixel of the middle
