"""Drawings that come into the window and go out of it, and outlines on the clipboard."""

import numpy as np
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QMessageBox

from solidtree.gui.dialogs import ExportDialog
from solidtree.gui.tolerances import Tolerances
from solidtree.model.exchange.meshes_in import read_any
from solidtree.model.outline.paths import path_of
from solidtree.model.script import box, circle, document_of, sphere

pytest_plugins = ["window_driver"]

SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50">
<rect id="plate" x="10" y="10" width="30" height="20"/><circle id="wheel" cx="70" cy="25" r="20"/>{}
</svg>"""


def test_a_dropped_drawing_adds_its_outlines_which_are_selected_seen_and_undone(make_window, tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(SVG.format(""))
    driver = make_window(document_of(part=box(5)))
    start = driver.document
    driver.window.files.drop([file])
    driver.qtbot.waitUntil(lambda: len(driver.document.profiles) == 2)
    assert [root.name for root in driver.document.profiles] == ["plate", "wheel"]
    driver.settle()
    assert set(driver.window.viewport.viewer.scene.meshes) == {root.id for root in driver.document.standing}
    np.testing.assert_allclose(path_of(driver.document.profiles[0]).bounds(), [[10, 20], [40, 40]])
    assert driver.session.undo_label == "Import logo.svg"
    driver.session.undo()
    assert driver.document is start


def test_what_of_a_drawing_is_left_out_is_told(make_window, tmp_path):
    file = tmp_path / "words.svg"
    file.write_text(SVG.format("<text>never</text>"))
    driver = make_window()
    driver.window.files.import_file(file)

    def told():
        return [box for box in QApplication.topLevelWidgets() if isinstance(box, QMessageBox) and box.isVisible()]

    driver.qtbot.waitUntil(lambda: bool(told()))
    assert "Text is left out" in told()[0].informativeText() and len(driver.document.profiles) == 2
    told()[0].close()
    driver.settle()


def test_path_text_on_the_clipboard_is_pasted_as_an_outline(make_window):
    driver = make_window()
    QGuiApplication.clipboard().setText("m 0,0 h 10 v 5 h -10 z")
    driver.keys("Ctrl+V", driver.window.viewport)
    (root,) = driver.document.profiles
    np.testing.assert_allclose(path_of(root).bounds(), [[0, -5], [10, 0]])
    assert driver.session.selection == (root.id,)
    QGuiApplication.clipboard().setText(SVG.format(""))
    driver.keys("Ctrl+V", driver.window.viewport)
    assert len(driver.document.profiles) == 3
    QGuiApplication.clipboard().setText("M 0 0 C")
    driver.keys("Ctrl+V", driver.window.viewport)
    assert len(driver.document.profiles) == 3
    driver.settle()


def test_a_document_of_outlines_is_exported_as_a_drawing(make_window, tmp_path):
    driver = make_window(document_of(wheel=circle(5), hub=circle(2)))
    driver.window.actions_.run("export")
    dialog = next(w for w in QApplication.topLevelWidgets() if isinstance(w, ExportDialog))
    assert dialog.format.currentData() == "svg"
    assert [dialog.solid.itemText(i) for i in range(dialog.solid.count())] == ["All visible outlines", "wheel", "hub"]
    target = tmp_path / "out.dxf"
    dialog.path.setText(str(target))
    dialog.solid.setCurrentIndex(1)
    dialog.accept()
    driver.qtbot.waitUntil(target.exists)
    assert [root.name for root in read_any(target).profiles] == ["wheel"]
    driver.settle()


def test_display_and_export_tolerance_are_two_settings(make_window, tmp_path):
    driver = make_window(document_of(ball=sphere(10)))
    window = driver.window

    def ask(display: str, export: str) -> Tolerances:
        window.actions_.run("tolerances")
        dialog = next(w for w in QApplication.topLevelWidgets() if isinstance(w, Tolerances) and w.isVisible())
        dialog.display.setText(display)
        dialog.export.setText(export)
        dialog.accept()
        return dialog

    def triangles() -> int:
        driver.settle()
        (mesh,) = window.viewport.viewer.scene.meshes.values()
        return len(mesh.triangles)

    usual = triangles()
    ask("0.5", "0.01")
    assert triangles() < usual / 2
    assert (window.settings.tolerance("display"), window.settings.tolerance("export")) == (0.5, 0.01)
    dialog = ask("0", "0.01")
    assert dialog.isVisible() and "lies between" in dialog.fault.text()
    dialog.reject()
    window.actions_.run("export")
    dialog = next(w for w in QApplication.topLevelWidgets() if isinstance(w, ExportDialog) and w.isVisible())
    assert dialog.tolerance.text() == "0.01"
    dialog.reject()
    assert not driver.session.modified
