"""The bitmap inspector, driven as a user does."""

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QToolButton

from solidtree.gui.bitmap.bitmap_window import BitmapWindow
from solidtree.gui.bitmap.tiles_page import formulas
from solidtree.model.document.document import Document
from solidtree.model.image.bitmap import of_samples
from solidtree.model.image.bmp_writing import bmp_of_bitmap
from solidtree.model.image.pictures import read_bitmap
from solidtree.model.scripting.surfaces import kept
from solidtree.model.surface.material import Material

pytest_plugins = ["window_driver"]


@pytest.fixture
def inspector(make_window, qtbot):
    driver = make_window(Document())
    driver.window.actions_.run("bitmap_inspector")
    window = driver.window.side_windows.of(BitmapWindow)
    qtbot.waitExposed(window)

    def open_(path):
        before = window.opened
        window.open_file(path)
        qtbot.waitUntil(lambda: window.opened is not before, timeout=10000)

    yield window, open_
    window.close()


def cells(table):
    return {table.item(row, 0).text(): [table.item(row, c).text() for c in range(1, table.columnCount())]
            for row in range(table.rowCount())}  # fmt: skip


def tab(window, page):
    window.tabs.setCurrentWidget(page)


def test_the_books_bitmap_is_told(inspector, tmp_path):
    window, open_ = inspector
    (tmp_path / "a.bmp").write_bytes(
        bmp_of_bitmap(of_samples(np.zeros((100, 100), np.uint8), 4, np.full((16, 4), 255, np.uint8)))
    )
    assert window.stack.currentIndex() == 0 and not window.tabs.isEnabled()
    open_(tmp_path / "a.bmp")
    assert cells(window.header.header)["Bits per pixel"] == ["4"] and cells(window.header.header)["Pitch"] == ["52"]
    memory = cells(window.header.memory)
    assert memory["Packed"][0] == "5,000" and memory["Stored"][0] == "5,200"
    assert memory["File"][0] == f"{(tmp_path / 'a.bmp').stat().st_size:,}"


def test_keys_and_mouse_reach_single_pixels(inspector, tmp_path, qtbot):
    window, open_ = inspector
    pixels = np.random.default_rng(1).integers(0, 256, (6, 9, 3)).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    open_(tmp_path / "a.png")
    view = window.view
    view.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Down):
        qtbot.keyClick(view, key)
    assert view.cursor_at == (2, 1)
    red, green, blue = pixels[1, 2]
    assert f"column 2, row 1: red {red}, green {green}, blue {blue}" in window.statusBar().currentMessage()
    scale = view.scale
    qtbot.keyClick(view, Qt.Key.Key_Minus)
    assert view.scale < scale
    tab(window, window.bytes)
    window.bytes.what.setCurrentIndex(1)
    window.bytes.what.activated.emit(1)
    view.point_at(3, 2)
    assert window.bytes.text.textCursor().selectedText() == f"{pixels[2, 3, 2]:02x}"  # blue comes first

    window.key.trigger()  # the cursor's colour shows nothing
    assert window.opened.rgba[2, 3, 3] == 0 and (window.opened.rgba[..., 3] == 255).sum() == 53
    window.key.trigger()
    assert (window.opened.rgba[..., 3] == 255).all()


def test_depth_channels_and_compression(inspector, tmp_path, qtbot):
    window, open_ = inspector
    ramp = np.tile(np.linspace(0, 255, 64).astype(np.uint8), (16, 1))
    Image.fromarray(np.dstack((ramp, ramp[:, ::-1], np.full_like(ramp, 90)))).save(tmp_path / "a.png")
    open_(tmp_path / "a.png")
    shown = []
    window.channels.shown.connect(shown.append)
    tab(window, window.channels)
    window.channels.names.setCurrentRow(1)
    np.testing.assert_array_equal(shown[-1][..., 2], ramp)

    tab(window, window.depths)
    window.depths.bits.setCurrentIndex(0)
    window.depths.bits.activated.emit(0)
    qtbot.waitUntil(lambda: window.depths.result is not None and window.depths.result.bits == 1, timeout=10000)
    window.save(window.depths.result, tmp_path / "one.bmp")
    qtbot.waitUntil(lambda: "is written" in window.statusBar().currentMessage(), timeout=10000)
    assert read_bitmap(tmp_path / "one.bmp").bits == 1

    tab(window, window.compression)
    window.compression.quality.setValue(10)
    facts = window.compression.facts
    qtbot.waitUntil(lambda: "JPEG" in cells(facts) and window.compression.comparison.sizes[1] < 2000, timeout=10000)
    with Image.open(tmp_path / "a.png") as picture:
        picture.convert("RGB").save(tmp_path / "peer.jpg", quality=10)
    assert int(cells(facts)["JPEG"][0].replace(",", "")) == pytest.approx(
        (tmp_path / "peer.jpg").stat().st_size, rel=0.1
    )


def test_what_cannot_be_read_is_told_and_loses_nothing(inspector, tmp_path, qtbot):
    window, open_ = inspector
    Image.fromarray(np.zeros((2, 2, 3), np.uint8)).save(tmp_path / "a.png")
    open_(tmp_path / "a.png")
    opened = window.opened
    (tmp_path / "bad.bmp").write_bytes(b"BM" + bytes(20))
    window.open_file(tmp_path / "bad.bmp")
    qtbot.waitUntil(lambda: window.statusBar().currentMessage().startswith("bad.bmp: "), timeout=10000)
    assert "cut short" in window.statusBar().currentMessage() and window.opened is opened


def test_tiles_of_the_book_and_of_the_open_picture(inspector, tmp_path, qtbot):
    window, open_ = inspector
    Image.fromarray(np.zeros((70, 100, 3), np.uint8)).save(tmp_path / "a.png")
    open_(tmp_path / "a.png")
    tab(window, window.tiles)
    matrix = window.tiles.matrix
    matrix.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Down):
        qtbot.keyClick(matrix, key)
    # Column 2 of row 1 of 3 by 3 in tiles of 2: tile 1, place 2, so 1 * 4 + 2.
    words = window.tiles.formulas.text()
    assert "<b>5</b>" in words and "<b>1</b>" in words and "<b>2</b>" in words and "<b>6</b>" in words
    image = QImage(matrix.size(), QImage.Format.Format_RGB888)
    matrix.render(image)
    cell = matrix._cell()
    lit = image.pixelColor((QPointF(4, 4) + QPointF(2.1, 1.1) * cell).toPoint())
    plain = image.pixelColor((QPointF(4, 4) + QPointF(0.1, 2.1) * cell).toPoint())
    assert lit != plain

    window.tiles.of_picture.setChecked(True)
    window.tiles.tile.setValue(32)
    window.view.point_at(70, 40)
    (mark,) = window.view.marks
    assert mark.getRect() == (64.0, 32.0, 32.0, 32.0)
    window.tiles.measure.click()
    qtbot.waitUntil(lambda: "ms" in window.tiles.costs.item(0, 3).text(), timeout=20000)


def test_formulas_put_the_numbers_in():
    words = formulas(5, 7, 10, 8, 3)
    assert "7 · 8 + 5 = <b>61</b>" in words
    assert "2 · 3 + 1 = <b>7</b>" in words  # the tile
    assert "1 · 3 + 2 = <b>5</b>" in words  # the place in it
    assert "7 · 9 + 5 = <b>68</b>" in words


def test_a_materials_bitmap_opens_from_its_row(make_window, tmp_path, qtbot):
    Image.fromarray(np.full((4, 5, 3), 200, np.uint8)).save(tmp_path / "a.png")
    worn = Material("wood", texture=kept(tmp_path / "a.png"))
    driver = make_window(Document(materials=(worn,)))
    driver.window.actions_.run("surfaces_panel")
    driver.window.surfaces.choose_material("wood")
    driver.window.surfaces.findChild(QToolButton, "texture_inspect").click()
    window = driver.window.side_windows.of(BitmapWindow)
    qtbot.waitUntil(lambda: window.opened is not None, timeout=10000)
    assert window.opened.bitmap.width == 5 and "wood: texture" in window.windowTitle()


def test_a_click_holds_the_cursor_for_the_tool_bar(inspector, tmp_path, qtbot):
    window, open_ = inspector
    pixels = np.random.default_rng(4).integers(0, 256, (4, 4, 3)).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    open_(tmp_path / "a.png")
    view = window.view
    at = (view._origin + QPointF(2.5, 1.5) * view.scale).toPoint()
    qtbot.mouseClick(view, Qt.MouseButton.LeftButton, pos=at)
    qtbot.mouseMove(view, (view._origin + QPointF(0.5, 0.5) * view.scale).toPoint())
    assert view.cursor_at == (2, 1)
    window.key.trigger()
    assert window.opened.bitmap.colour_key == tuple(pixels[1, 2].tolist())
    window.save(window.opened.bitmap, tmp_path / "b.bmp")
    qtbot.waitUntil(lambda: "is written" in window.statusBar().currentMessage(), timeout=10000)
    assert "without the colour key" in window.statusBar().currentMessage()


def test_pages_know_the_cursor_and_what_they_show_when_they_come_back(inspector, tmp_path, qtbot):
    window, open_ = inspector
    Image.fromarray(np.dstack([np.arange(64, dtype=np.uint8).reshape(8, 8) * k for k in (1, 2, 3)])).save(
        tmp_path / "a.png"
    )
    open_(tmp_path / "a.png")
    tab(window, window.channels)
    window.channels.names.setCurrentRow(1)
    tab(window, window.header)
    shown = []
    window.channels.shown.connect(shown.append)
    tab(window, window.channels)
    assert shown and (shown[-1][..., 0] == shown[-1][..., 1]).all()
    window.view.point_at(5, 3)
    window.tiles.of_picture.setChecked(True)
    tab(window, window.tiles)
    assert "Column x = 5 of row y = 3" in window.tiles.formulas.text()
    window.tiles.of_picture.setChecked(False)
    assert window.tiles.tile.value() == 2 and window.tiles.rows.value() == 3
