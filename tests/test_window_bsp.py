"""The BSP panel in the real window: the tree, its nodes in the picture, the painter's order, a probe, the figure."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt

from solidtree.gui.partition.makers import equation
from solidtree.gui.partition.model_page import point_from
from solidtree.model.document.errors import Refusal
from solidtree.model.partition.descent import way_down
from solidtree.model.partition.order import Sorter
from solidtree.model.partition.tree import INNER
from solidtree.model.script import box, document_of, sphere

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton
TWO = (box(20).named("left box"), box(20).at(40).named("right box"))


def opened(make_window, *solids):
    """The window with its panel, once the tree is there."""
    driver = make_window(document_of(*(solids or TWO)))
    driver.look_from("iso")
    driver.window.actions_.run("hidden_surface_bsp")
    driver.keys("Alt+B", driver.window.viewport)
    explorer = driver.window.bsp.explorer
    page = driver.window.bsp.page
    driver.qtbot.waitUntil(lambda: explorer.source.tree is not None and explorer.source.settled, timeout=15000)
    driver.qtbot.waitUntil(page.order.isVisible)
    return driver, explorer, page


def pixels(driver):
    viewer = driver.window.viewport.viewer
    viewer.render()
    return viewer.pixels().astype(int)


def click_node(driver, page, node):
    driver.qtbot.mouseClick(page.picture, LEFT, pos=page.picture.place_of(node).toPoint())


def test_a_node_is_shown_in_words_and_tints_both_half_spaces(make_window):
    driver, explorer, page = opened(make_window)
    tree = explorer.source.tree
    assert "<b>3</b> nodes (2 leaves), <b>2</b> deep; <b>24</b> fragments of 24 faces" in page.counts.text()
    plain = pixels(driver)
    click_node(driver, page, tree.root)
    assert page.picture.node == tree.root
    words = page.node.text()
    assert equation(tree.plane[tree.root]) in words
    for node in (tree.front[tree.root], tree.back[tree.root]):
        assert f"1 node, {tree.count[node]} fragments." in words
    assert f"In the plane:</span> {tree.count[tree.root] or 'no'} fragment" in words
    tinted = pixels(driver)
    change = {}
    for name, child in (("front", tree.front), ("back", tree.back)):
        corners = tree.corners[tree.starts[tree.first[child[tree.root]]] :][:3]
        box_middle = 10.0 if tree.points[corners, 0].max() < 30 else 50.0
        spot = driver.pixel_of((box_middle, 10.0, 20.0))
        change[name] = tinted[spot.y(), spot.x()] - plain[spot.y(), spot.x()]
        assert np.abs(change[name]).max() > 10
    # Green in front, purple behind.
    assert change["front"][1] > change["back"][1] and change["front"][0] < change["back"][0]
    leaf = int(tree.front[tree.root])
    click_node(driver, page, leaf)
    assert f"<b>A leaf</b>: {tree.count[leaf]} fragments of one convex body" in page.node.text()
    driver.keys("Up", page.picture)
    driver.keys("Down", page.picture)
    assert page.picture.node == tree.back[tree.root]
    driver.keys("Escape", page.picture)
    assert page.picture.node == -1 and np.abs(pixels(driver) - plain).max() <= 2


def test_the_slider_draws_the_first_fragments_and_leaving_draws_all(make_window):
    driver, explorer, page = opened(make_window)
    viewer = driver.window.viewport.viewer
    plain = pixels(driver)
    page.order.slider.setFocus()
    driver.keys("Home", page.order.slider)
    assert viewer.scene.painter.count == 0 and page.order.words.text() == "0 of 24"
    spot = driver.pixel_of((10.0, 10.0, 20.0))
    assert np.abs(pixels(driver)[spot.y(), spot.x()] - plain[spot.y(), spot.x()]).max() > 20
    order = Sorter(explorer.source.tree).fragments(np.array(viewer.camera.position), viewer.camera.parallel)
    for count in (1, 2):
        driver.keys("Right", page.order.slider)
        name = explorer._makers.words(int(order[count - 1]))
        assert page.order.words.text().startswith(f"{count} of 24: {name}") and "box”" in name
        assert viewer.scene.painter.count == count
    driver.window.actions_.run("bsp_play")
    assert page.order.playing
    driver.qtbot.waitUntil(lambda: page.order.count > 2)
    driver.window.actions_.run("bsp_play")
    assert not page.order.playing and viewer.scene.painter.count == page.order.count
    driver.keys("Alt+B", driver.window.viewport)
    assert driver.window.bsp.in_front is False and viewer.scene.painter.count is None
    assert np.abs(pixels(driver) - plain).max() <= 2


def test_a_probe_is_typed_or_clicked_and_f_is_told_at_each_plane(make_window):
    driver, explorer, page = opened(make_window, sphere(10, segments=24) - box(30).at(0, 0, 0), box(5).at(30))
    tree = explorer.source.tree

    def write(text):
        page.point.setFocus()
        page.point.clear()
        driver.write(text, page.point)
        driver.keys("Return", page.point)

    write("1, 2 + 3, -4")
    way = way_down(tree, (1.0, 5.0, -4.0))
    assert page.table.rowCount() == len(way) and page.picture.way == {step.node for step in way}
    for row, step in enumerate(way):
        told = page.table.item(row, 1).text().replace("\u2212", "-").replace("\u202f", "")
        if tree.kind[step.node] == INNER:
            assert float(told.removesuffix(" mm")) == pytest.approx(step.height, rel=1e-4)
    write("1, 2")
    assert "is no point" in driver.window.statusBar().currentMessage() and page.table.rowCount() == len(way)
    write("1, 5, -4")
    assert driver.window.statusBar().currentMessage() == "" and page.table.rowCount() == len(way)
    page.pick.click()
    assert driver.window.bsp.probe.active
    driver.click_at((32.5, 2.5, 5.0))
    x, y, z = point_from(page.point.text())
    assert (x, y, z) == pytest.approx((32.5, 2.5, 5.0), abs=0.5) and not driver.session.selection
    driver.keys("Escape", driver.window.viewport)
    assert not driver.window.bsp.probe.active and not page.pick.isChecked()


def test_the_textbooks_builder_makes_its_own_tree_and_says_where_it_would_not(make_window):
    driver, explorer, page = opened(make_window)
    good = explorer.source.tree
    page.builder.setCurrentIndex(1)
    page.builder.activated.emit(1)
    driver.qtbot.waitUntil(lambda: explorer.source.settled and explorer.source.tree is not None)
    assert explorer.source.report.builder == "textbook" and explorer.source.tree is not good
    assert driver.window.viewport.viewer.scene._tree is explorer.source.tree and "(textbook)" in page.counts.text()
    driver.open(document_of(sphere(20, segments=64)))
    driver.qtbot.waitUntil(lambda: explorer.source.settled and "up to 1,500 faces" in page.empty.text())
    page.builder.activated.emit(0)
    driver.qtbot.waitUntil(lambda: explorer.source.settled and explorer.source.tree is not None)
    assert explorer.source.report.counts.depth == 1


def test_what_the_textbooks_builder_refuses_is_said_and_the_good_tree_comes_back(make_window, monkeypatch):
    from solidtree.model.partition import textbook

    monkeypatch.setattr(textbook, "MOST_CUTS", -1)
    driver, explorer, page = opened(make_window)
    page.builder.setCurrentIndex(1)
    page.builder.activated.emit(1)
    driver.qtbot.waitUntil(lambda: explorer.source.settled and page.empty.text().startswith("The textbook's builder"))
    page.builder.activated.emit(0)
    driver.qtbot.waitUntil(lambda: explorer.source.settled and explorer.source.tree is not None)
    # A refusal that comes when the good builder has been chosen again is no longer of interest.
    page.builder.activated.emit(1)
    page.builder.activated.emit(0)
    driver.qtbot.waitUntil(lambda: explorer.source.settled and explorer.source.tree is not None)
    assert explorer.source.words == "" and explorer.source.report.builder != "textbook"


def test_without_a_sorted_picture_the_panel_offers_to_sort(make_window):
    driver = make_window(document_of(*TWO))
    driver.keys("Alt+B", driver.window.viewport)
    page = driver.window.bsp.page
    driver.qtbot.waitUntil(page.sort.isVisible)
    assert "z-buffer" in page.empty.text() and not page.picture.isVisible()
    driver.qtbot.mouseClick(page.sort, LEFT)
    driver.qtbot.waitUntil(lambda: page.picture.isVisible() and len(page.picture.items) == 3)
    assert driver.window.hidden_surfaces.mode == "bsp" and not page.sort.isVisible()


def test_a_change_of_the_document_brings_its_own_tree(make_window):
    driver, explorer, page = opened(make_window)
    click_node(driver, page, explorer.source.tree.root)
    first = explorer.source.tree
    page.order.go(3)
    driver.session.do("insert", box(5).at(0, 60, 0), label="Add box")
    driver.settle()
    driver.qtbot.waitUntil(lambda: explorer.source.settled and explorer.source.tree not in (None, first))
    assert explorer.source.report.counts.faces == 36 and page.picture.node == -1
    assert driver.window.viewport.viewer.scene.painter.count is None and page.order.total == 36


def test_the_figure_says_what_the_text_says_and_follows_the_eye(make_window):
    driver = make_window()
    driver.window.actions_.run("bsp_figure")
    figure = driver.window.bsp.figure
    driver.qtbot.waitUntil(figure.isVisible)
    assert figure.picture.pruned == {"B", "C"} and set(figure.picture.order) == set("ADE")
    assert "B (behind h1); C (in front of h2)" in figure.words.text()
    rows = figure.table.rowCount()
    start = figure.picture.to_widget(figure.picture.probe)
    driver.qtbot.mousePress(figure.picture, LEFT, pos=start.toPoint())
    goal = figure.picture.to_widget((11.0, 34.0)).toPoint()  # in B
    driver.qtbot.mouseMove(figure.picture, goal)
    drag(figure.picture, goal)
    driver.qtbot.mouseRelease(figure.picture, LEFT, pos=goal)
    assert figure.table.rowCount() == 2 < rows and figure.table.item(0, 2).text() == "behind (< 0)"
    assert figure.table.item(1, 0).text() == "B"
    for _ in range(12):
        driver.keys("Ctrl+Left", figure.picture)  # the view turns to the left, over h1
    assert "B" not in figure.picture.pruned
    driver.qtbot.mouseClick(figure.reset, LEFT)
    assert figure.picture.pruned == {"B", "C"}
    on_h1 = figure.picture.to_widget((24.0, 34.0)).toPoint()
    driver.qtbot.mouseClick(figure.picture, LEFT, pos=on_h1)
    assert figure.picture.line == "h1" and figure.tree.node == 0


def drag(widget, place: QPoint):
    from PySide6.QtCore import QEvent, QPointF
    from PySide6.QtGui import QMouseEvent
    from PySide6.QtWidgets import QApplication

    event = QMouseEvent(QEvent.Type.MouseMove, QPointF(place), QPointF(widget.mapToGlobal(place)),
                        Qt.MouseButton.NoButton, LEFT, Qt.KeyboardModifier.NoModifier)  # fmt: skip
    QApplication.sendEvent(widget, event)


def test_points_and_planes_are_written_as_people_do():
    assert point_from("1, 2+3, \u22124") == (1, 5, -4) and point_from("1 2 3") == (1, 2, 3)
    for wrong in ("", "1 2", "1, 2, x"):
        with pytest.raises(Refusal):
            point_from(wrong)
    assert equation(np.array([0.0, 0.0, -1.0, -7.0])) == "\u2212z = \u22127 mm"
    assert equation(np.array([0.6, 0.0, 0.8, 12.5])) == "0.6\u202fx + 0.8\u202fz = 12.5 mm"
