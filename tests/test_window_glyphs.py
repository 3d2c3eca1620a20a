"""The font window: glyphs found, edited at their control points, transformed, compared, and all of it taken back."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox, QFileDialog, QWidget

from solidtree.gui.lettering.font_window import FontWindow
from solidtree.gui.lettering.glyph_model import EDITED, NAME
from solidtree.gui.lettering.save_font import SaveFont
from solidtree.model.document.table import same_document
from solidtree.model.lettering.fonts.edited_face import touched
from solidtree.model.lettering.fonts.in_document import face_in
from solidtree.model.lettering.fonts.opening import read_font
from solidtree.model.script import document_of, extrude, lettering

pytest_plugins = ["window_driver"]
LEFT = Qt.MouseButton.LeftButton
DIDOT = "GFS Didot"


@pytest.fixture
def opened(make_window):
    """A window on lettering in GFS Didot, and its font window on the first letter."""

    def make(text="Ill"):
        driver = make_window(document_of(extrude(lettering(text, 20, DIDOT), 2)))
        driver.session.select([driver.document.solids[0].children[0].id])
        driver.keys("Alt+G", driver.window.viewport)
        window = driver.window.side_windows.of(FontWindow)
        driver.qtbot.waitExposed(window)
        driver.qtbot.waitUntil(window.isActiveWindow)
        return driver, window

    return make


def drag(canvas, start: QPointF, end: QPointF, modifiers=Qt.KeyboardModifier.NoModifier) -> None:
    middle = (start + end) / 2
    QTest.mousePress(canvas, LEFT, modifiers, start.toPoint())
    for place in (middle, end):
        QTest.mouseMove(canvas, place.toPoint())
        QTest.qWait(1)
    QTest.mouseRelease(canvas, LEFT, modifiers, end.toPoint())


def node(window, contour: int, number: int) -> np.ndarray:
    drawn = window.desk.drawn.outline.contours[contour]
    return drawn.points[drawn.starts[number]]


def ink(widget: QWidget) -> np.ndarray:
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : image.width()].astype(float)


def names(window) -> list[str]:
    model = window.glyphs.grid.model()
    return [str(model.index(row, 0).data(NAME)) for row in range(model.rowCount())]


def test_a_dragged_node_moves_the_glyph_the_text_and_the_solid_and_undo_takes_it_back(opened):
    driver, window = opened()
    assert window.desk.font == DIDOT and window.desk.glyph == "I"
    start, before = driver.document, node(window, 0, 0).copy()
    solid = driver.window.evaluation.latest.solids[start.solids[0].id].mesh
    text = ink(window.text.picture)
    here = window.canvas.to_screen(*before)
    there = window.canvas.to_screen(before[0] - 60, before[1] - 40)
    drag(window.canvas, here, there)
    after = node(window, 0, 0)
    step = 1.5 / window.canvas._scale
    np.testing.assert_allclose(after, before - np.array((60, 40)), atol=step)
    assert (after == np.round(after)).all(), "whole font units"
    assert driver.session.undo_label == "Move nodes"
    assert np.abs(ink(window.text.picture) - text).max() > 50, "the running text shows it"
    driver.settle()
    assert driver.window.evaluation.latest.solids[start.solids[0].id].mesh is not solid
    assert "1 glyph edited" in window.state.text()
    driver.keys("Ctrl+Z", window.canvas)
    assert driver.document is start
    np.testing.assert_array_equal(node(window, 0, 0), before)


def test_escape_ends_a_drag_without_a_step(opened):
    driver, window = opened()
    start, before = driver.document, node(window, 0, 0).copy()
    here = window.canvas.to_screen(*before).toPoint()
    QTest.mousePress(window.canvas, LEFT, Qt.KeyboardModifier.NoModifier, here)
    QTest.mouseMove(window.canvas, here + QPoint(30, 30))
    QTest.qWait(1)
    assert window.desk.live is not None
    QTest.keyClick(window.canvas, Qt.Key.Key_Escape)
    QTest.mouseRelease(window.canvas, LEFT, Qt.KeyboardModifier.NoModifier, here + QPoint(30, 30))
    assert driver.document is start and window.desk.live is None


def test_nodes_go_in_out_and_by_keys(opened):
    driver, window = opened()
    count = len(window.desk.drawn.outline.contours[0].nodes)
    one, two = node(window, 0, 0), node(window, 0, 1)
    middle = window.canvas.to_screen(*(0.5 * (one + two)))
    QTest.mouseDClick(window.canvas, LEFT, Qt.KeyboardModifier.NoModifier, middle.toPoint())
    assert len(window.desk.drawn.outline.contours[0].nodes) == count + 1
    assert window.canvas.chosen == {(0, 1)}
    place = node(window, 0, 1).copy()
    driver.keys("Shift+Right", window.canvas)
    np.testing.assert_allclose(node(window, 0, 1), place + np.array((10, 0)))
    driver.keys("Delete", window.canvas)
    assert len(window.desk.drawn.outline.contours[0].nodes) == count
    driver.keys("Ctrl+A", window.canvas)
    assert len(window.canvas.chosen) == sum(len(c.nodes) for c in window.desk.drawn.outline.contours)


def test_a_handle_turns_the_one_across_a_smooth_node(opened):
    driver, window = opened("o")
    contour = window.desk.drawn.outline.contours[0]
    number = int(np.flatnonzero((contour.kinds == 3) & (contour.nodes[: len(contour.kinds)] == 1))[0])
    row = int(contour.starts[number]) + 1
    here = contour.points[row]
    drag(window.canvas, window.canvas.to_screen(*here), window.canvas.to_screen(*(here + np.array((25, 25)))))
    drawn = window.desk.drawn.outline.contours[0]
    at, handle, across = (drawn.points[i] for i in (row - 1, row, row - 2 if row > 1 else -2))
    arm, other = handle - at, at - across
    assert abs(arm[0] * other[1] - arm[1] * other[0]) < 1e-6 * np.linalg.norm(arm) * np.linalg.norm(other)
    assert driver.session.undo_label == "Move handle"


def test_width_and_bearings_are_dragged_and_typed(opened):
    driver, window = opened()
    wide = window.desk.drawn.advance
    line = window.canvas.to_screen(wide, window.desk.face.metrics.ascender + 60)
    drag(window.canvas, line, window.canvas.to_screen(wide + 100, 0))
    assert window.desk.drawn.advance == pytest.approx(wide + 100, abs=1.5 / window.canvas._scale)
    left = window.side.left
    bounds = window.desk.drawn.outline.bounds()
    right = window.desk.drawn.advance - bounds[1, 0]
    left.setFocus()
    left.selectAll()
    driver.write("77", left)
    driver.keys("Return", left)
    moved = window.desk.drawn
    assert moved.outline.bounds()[0, 0] == pytest.approx(77)
    assert moved.advance - moved.outline.bounds()[1, 0] == pytest.approx(right), "the right bearing stays"
    left.selectAll()
    driver.write("wide", left)
    driver.keys("Return", left)
    assert left.property("fault") and window.statusBar().currentMessage()


def test_glyphs_are_found_by_name_character_code_and_block(opened):
    _, window = opened()
    face, search = window.desk.face, window.glyphs.search
    assert set(names(window)) == set(face.glyph_names)
    alpha = face.characters[0x3B1]
    for words, wanted in (("α", alpha), ("U+03B1", alpha), ("alphatonos", "alphatonos")):
        search.setText(words)
        assert wanted in names(window)
    search.setText("α")
    assert names(window) == [face.characters[0x3B1]]
    search.setText("no such glyph")
    assert names(window) == [] and window.glyphs.count.text() == "No glyph is like that"
    search.setText("")
    window.glyphs.block.setCurrentText("Greek and Coptic")
    assert set(names(window)) == {name for code, name in face.characters.items() if 0x370 <= code <= 0x3FF}


def test_all_greek_letters_lean_in_one_step(opened):
    driver, window = opened()
    start = driver.document
    window.glyphs.block.setCurrentText("Greek and Coptic")
    driver.keys("Ctrl+A", window.glyphs.grid)
    chosen = window.glyphs.chosen_glyphs()
    assert len(chosen) > 70 and window.side.of.text() == f"The {len(chosen)} chosen glyphs"
    slant = window.side.slant
    slant.setFocus()
    slant.selectAll()
    driver.write("12", slant)
    QTest.mouseClick(window.side.apply, LEFT)
    assert driver.session.undo_label == "Transform glyphs" and window.desk.edited == set(chosen)
    before, after = (face_in(one, DIDOT).outline("alpha").contours[0].points for one in (start, driver.document))
    np.testing.assert_allclose(after, before @ np.array([[1, 0], [np.tan(np.radians(12)), 1]]), atol=1e-9)
    window.glyphs.block.setCurrentText(EDITED)
    assert set(names(window)) == set(chosen)
    driver.keys("Ctrl+Z", window.canvas)
    assert driver.document is start


def test_fonts_stand_side_by_side(opened):
    driver, window = opened()
    window.tabs.setCurrentIndex(1)
    rows = window.comparison.rows
    assert {"DejaVu Sans", DIDOT} <= set(rows.names)
    window.comparison.character.setText("Ω")
    assert "greek capital letter omega" in window.comparison.meaning.text()
    one = ink(rows)
    window.comparison.character.setText("ש")  # which GFS Didot lacks
    assert np.abs(ink(rows) - one).max() > 50
    item = next(window.comparison.fonts.item(i) for i in range(window.comparison.fonts.count())
                if window.comparison.fonts.item(i).text() == DIDOT)  # fmt: skip
    item.setCheckState(Qt.CheckState.Unchecked)
    assert DIDOT not in rows.names
    driver.settle()


def test_the_font_stays_with_the_project(opened, tmp_path):
    driver, window = opened()
    drag(window.canvas, window.canvas.to_screen(*node(window, 0, 0)), window.canvas.to_screen(0, -50))
    edited = driver.document
    from solidtree.model.script import open_document, save

    save(tmp_path / "one.solidtree", edited)
    again = open_document(tmp_path / "one.solidtree")
    assert same_document(again, edited)
    driver.open(again)
    assert window.desk.edited == {"I"} == touched(window.desk.face, ["I"]) & window.desk.edited


def test_a_font_that_is_gone_is_told(opened):
    driver, window = opened()
    driver.session.do("set_field", driver.document.solids[0].children[0].id, "font", "Gone Sans")
    window.show_font("Gone Sans")
    assert "no font “Gone Sans” is installed" in window.desk.fault
    assert window.side.title.text() == "No glyph" and not window.side.apply.isEnabled()
    assert window.glyphs.count.text() == "0 glyphs"
    window.show_font(DIDOT)
    assert window.desk.drawn is not None


def test_the_edited_font_is_saved_under_another_name(opened, tmp_path):
    driver, window = opened()
    drag(window.canvas, window.canvas.to_screen(*node(window, 0, 0)), window.canvas.to_screen(10, -50))
    edited = window.desk.drawn
    driver.keys("Ctrl+S", window.canvas)
    dialog = window.findChild(SaveFont)
    assert dialog.family.text() == "Edited Letters" and dialog.form.currentData() == "otf"
    save = dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Save)
    dialog.family.setText("GFS Didot Bold")
    QTest.mouseClick(save, LEFT)
    assert dialog.findChild(QFileDialog) is None and "reserves the name “GFS Didot”" in dialog.fault.text()
    dialog.family.setText("Sculpted")
    QTest.mouseClick(save, LEFT)
    asking = dialog.findChild(QFileDialog)
    asking.fileSelected.emit(str(tmp_path / "sculpted.otf"))
    driver.qtbot.waitUntil(lambda: "is written and read back" in window.statusBar().currentMessage(), timeout=20000)
    face = read_font(tmp_path / "sculpted.otf")
    assert face.family == "Sculpted" and face.advance("I") == edited.advance
    assert abs(face.outline("I").area() - edited.outline.area()) < edited.outline.length()


def test_a_glyph_becomes_a_path_of_the_document(opened):
    driver, window = opened()
    window.actions_.run("glyph_to_path")
    (path,) = driver.document.profiles
    assert path.name == "I" and len(path.points) == sum(
        len(contour.points) - 1 for contour in window.desk.drawn.outline.contours
    )
    assert max(y for _, y in path.points) == pytest.approx(0.01 * window.desk.drawn.outline.bounds()[1, 1])


def test_a_font_is_carried_and_released_by_the_menu(make_window):
    driver = make_window(document_of(lettering("Ill", 20, DIDOT)))
    actions, start = driver.window.actions_, driver.document
    assert actions.fault("carry_font") == "select lettering in one font first"
    driver.session.select([driver.document.profiles[0].id])
    assert actions.fault("release_font") == f"the project carries no “{DIDOT}”"
    actions.run("carry_font")
    assert driver.document.fonts[0].asset and actions.fault("carry_font")
    actions.run("release_font")
    assert driver.document.fonts == () and actions.fault("carry_font") is None
    driver.keys("Ctrl+Z", driver.window.viewport)
    driver.keys("Ctrl+Z", driver.window.viewport)
    assert driver.document is start
