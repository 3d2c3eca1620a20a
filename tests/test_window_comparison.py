"""The window that compares shadings, driven as a user does."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton

from solidtree.gui.comparison.comparison_window import ComparisonWindow
from solidtree.model.script import document_of, material, sphere

pytest_plugins = ["window_driver"]


def test_turning_segments_and_taking_a_shading(make_window, qtbot):
    driver = make_window(document_of(sphere(10, segments=10).dressed(material("clay", colour="#c06040"))))
    driver.window.actions_.run("compare_shadings")
    window = driver.window.side_windows.of(ComparisonWindow)
    qtbot.waitUntil(lambda: len(window.differences.differences) == 3, timeout=20000)
    before, eye = window.differences.differences[1], window.board.camera
    assert before.greatest > 5

    start = window.board.column(1).center()
    qtbot.mousePress(window.board, Qt.MouseButton.LeftButton, pos=start)
    QApplication.processEvents()
    QTest.mouseMove(window.board, start + QPoint(60, 0))
    qtbot.mouseRelease(window.board, Qt.MouseButton.LeftButton, pos=start + QPoint(60, 0))
    qtbot.keyClick(window.board, Qt.Key.Key_Right)
    qtbot.waitUntil(lambda: window.board.camera != eye, timeout=5000)

    window.segments.setValue(96)
    qtbot.waitUntil(lambda: window.differences.differences[1].greatest < before.greatest, timeout=20000)
    assert driver.session.undo_label is None

    window.use.setCurrentIndex(1)
    window.findChild(QPushButton).click()
    assert driver.document.shading == "gouraud"
    assert "set_shading" in driver.session.log[-1]
    driver.session.undo()
    assert driver.document.shading == ""
    window.close()
    window.show_model()  # made anew
    qtbot.waitUntil(lambda: window.board.isVisible() and len(window.board.pictures) == 4, timeout=20000)
    window.close()


def test_without_a_solid_there_is_the_sphere_alone(make_window, qtbot):
    driver = make_window(document_of(sphere(10)))
    driver.window.actions_.run("compare_shadings")
    window = driver.window.side_windows.of(ComparisonWindow)
    window.model.setCurrentIndex(1)
    window.model.activated.emit(1)
    assert not window.segments.isEnabled()
    driver.session.select([driver.document.solids[0].id])
    driver.session.do("delete", [driver.document.solids[0].id])
    driver.settle()
    assert window.model.currentIndex() == 0 and not window.model.model().item(1).isEnabled()
    assert window.segments.isEnabled()
    window.close()


def test_a_materials_numbers_stand_at_the_sliders_and_in_words(make_window, qtbot):
    dull = material("dull", specular=0, shininess=9)
    driver = make_window(document_of(sphere(10, segments=12).dressed(dull)))
    driver.window.actions_.run("compare_shadings")
    window = driver.window.side_windows.of(ComparisonWindow)
    window.material.setCurrentIndex(1)
    window.material.activated.emit(1)
    assert window.specular.number == 0 and window._numbers[window.specular].text() == "0"
    assert window._numbers[window.shininess].text() == "9"
    window.close()
