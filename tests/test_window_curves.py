"""From an empty document to a solid and back: a curve drawn, smoothed, extruded, cut out of a box, and all undone."""

import numpy as np
import pytest
from drawing_hand import Drawer
from PySide6.QtCore import Qt

from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.nodes import Difference
from solidtree.model.document.primitives import Box
from solidtree.model.outline.joints import joints_of
from solidtree.model.outline.paths import path_of
from solidtree.model.script import measure

pytest_plugins = ["window_driver"]


@pytest.fixture
def drawer(make_window):
    driver = make_window()
    driver.look_from("top")
    return Drawer(driver)


def press(page, title: str, qtbot) -> None:
    qtbot.mouseClick(page.buttons[title], Qt.MouseButton.LeftButton)


def test_a_curve_is_drawn_made_smooth_extruded_cut_from_a_box_and_undone(drawer):
    driver = drawer.driver
    window, qtbot, start = driver.window, driver.qtbot, driver.document

    # Drawn with the pen: two corners and two nodes with handles, closed by a click on the first node.
    driver.keys("Shift+P", drawer.viewport)
    drawer.click(-20, -10)
    drawer.drag((20, -10), (26, -4))
    drawer.drag((20, 10), (12, 14))
    drawer.click(-20, 10)
    drawer.click(-20, -10)
    (outline,) = driver.document.profiles
    assert path_of(outline).contours[0].closed
    assert driver.session.selection == (outline.id,)  # and the tool has ended

    # Two joints become G2 by the panel.
    driver.keys("V", drawer.viewport)
    window.curve_panel.show_page("Joints")
    page = window.joints_page
    before = {(one.contour, one.node): one.grade for one in joints_of(path_of(outline))}
    wanted = [place for place, grade in before.items() if grade == 1]
    assert len(wanted) == 2
    qtbot.waitUntil(lambda: window.curve_panel.in_front)
    for place in wanted:
        window.curve.choose([place])
        press(page, "Harmonise", qtbot)
    outline = driver.document.profiles[0]
    after = {(one.contour, one.node): one.grade for one in joints_of(path_of(outline))}
    assert [after[place] for place in wanted] == [2, 2]
    assert sorted(row[1] for row in table_of(page)) == ["G0", "G0", "G2", "G2"]

    # Extruded, with a box beside it that it is cut from.
    area = abs(path_of(outline).area())
    driver.keys("Shift+E", drawer.viewport)
    (solid,) = driver.document.solids
    assert isinstance(solid, Extrude) and not driver.document.profiles
    driver.session.select([])
    driver.keys("Shift+B", drawer.viewport)
    box = driver.document.solids[-1]
    driver.session.do("set_fields", box.id, size=(100.0, 100.0, 10.0))
    driver.session.do("move", [box.id], -50.0, -50.0, 0.0)
    driver.session.select([box.id, solid.id])
    driver.keys("Ctrl+D", drawer.viewport)
    (cut,) = driver.document.solids
    assert isinstance(cut, Difference) and isinstance(cut.children[0], Box)
    driver.settle()
    assert measure(cut, 0.001).volume == pytest.approx(100 * 100 * 10 - 10 * area, rel=1e-4)
    shown = window.evaluation.latest.solids[cut.id].measures.volume
    assert shown == pytest.approx(100 * 100 * 10 - 10 * area, rel=1e-3)

    # All of it undone, step by step, down to the very document of the start.
    steps = 0
    while window.session.undo_label:
        driver.keys("Ctrl+Z", drawer.viewport)
        steps += 1
    assert driver.document is start and steps >= 7
    driver.settle()


def table_of(page) -> list[list[str]]:
    table = page.table
    return [
        [table.item(row, column).text() for column in range(table.columnCount())] for row in range(table.rowCount())
    ]


def test_the_numbers_of_the_panel_move_nodes_and_handles_exactly(make_window):
    from solidtree.model.script import document_of, path

    curve = path([("move", (0, 0)), ("cubic", (0, 10), (10, 20), (20, 20)), ("cubic", (30, 20), (40, 10), (40, 0))])
    driver = make_window(document_of(curve=curve))
    window, start = driver.window, driver.document
    (node,) = start.profiles
    window.session.select([node.id])
    driver.keys("V", window.viewport)
    page = window.curve_panel.pages["Nodes"]
    window.curve.choose([(0, 1)])

    def write(field, text: str) -> None:
        driver.qtbot.mouseClick(field, Qt.MouseButton.LeftButton)
        driver.keys("Ctrl+A", field)
        driver.write(text, field)
        driver.keys("Return", field)

    def contour():
        return path_of(driver.document.profiles[0]).contours[0]

    write(page.places[0], "2.5 cm")
    np.testing.assert_allclose(contour().places[1], (25, 20))
    np.testing.assert_allclose(contour().points[2], (15, 20))  # its handle went along
    write(page.lengths[1], "5")
    np.testing.assert_allclose(contour().points[4], (30, 20))
    write(page.angles[1], "-90")
    np.testing.assert_allclose(contour().points[4], (25, 15), atol=1e-12)
    window.curve.choose([(0, 0), (0, 2)])
    assert page.places[0].text() == "" and page.places[0].placeholderText() == "mixed"
    assert page.places[1].text() == "0"
    write(page.places[1], "-3")
    np.testing.assert_allclose(contour().places[[0, 2], 1], (-3, -3))
    write(page.places[1], "nonsense(")
    assert page.places[1].property("fault")
    for _ in range(4):
        window.session.undo()
    assert driver.document is start
    driver.settle()


def test_every_joint_is_brought_to_a_grade_in_one_step_and_the_comb_is_seen(make_window):
    from solidtree.model.script import document_of, path

    curve = path(
        [("move", (0, 0)), ("cubic", (0, 10), (10, 20), (20, 20)), ("cubic", (31, 22), (40, 10), (40, 0)),
         ("cubic", (41, -9), (4, -12), (0, 0)), ("close",)]
    )  # fmt: skip
    driver = make_window(document_of(curve=curve))
    window = driver.window
    window.session.select([driver.document.profiles[0].id])
    driver.keys("V", window.viewport)
    window.curve_panel.show_page("Joints")
    page, start = window.joints_page, driver.document
    assert min(one.grade for one in joints_of(path_of(start.profiles[0]))) == 0
    press(page, "Fix all to G1", driver.qtbot)
    assert min(one.grade for one in joints_of(path_of(driver.document.profiles[0]))) >= 1
    window.session.undo()
    assert driver.document is start

    driver.settle()
    bare = window.viewport.viewer.pixels()
    driver.keys("Alt+K", window.viewport)
    window.viewport.draw()
    assert page.comb.isChecked() and "Smallest radius" in page.sharpest.text()
    changed = (np.abs(window.viewport.viewer.pixels().astype(int) - bare.astype(int)).max(axis=2) > 20).sum()
    assert changed > 500
    driver.keys("Alt+K", window.viewport)
    window.viewport.draw()
    assert (
        np.abs(window.viewport.viewer.pixels().astype(int) - bare.astype(int)).max(axis=2) > 20
    ).sum() < changed / 20
