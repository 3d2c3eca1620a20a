"""The view of texture coordinates and the light probe, in the real window."""

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from solidtree.gui.shading.light_window import LightWindow
from solidtree.gui.shading.uv_window import UvWindow
from solidtree.model.script import box, document_of, light, material, sphere
from solidtree.render.camera import project

pytest_plugins = ["window_driver"]

LEFT, SHIFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def worn(tmp_path):
    Image.fromarray(np.random.default_rng(2).integers(0, 256, (64, 64, 3)).astype(np.uint8)).save(tmp_path / "a.png")
    return material("wood", texture=tmp_path / "a.png")


@pytest.fixture
def unwrapped(make_window, qtbot, worn):
    """A ball without the pole in a box; its window of texture coordinates is open."""
    driver = make_window(document_of(sphere(10, segments=16).named("ball").dressed(worn) - box(30).at(0, 0, 5)))
    ball = driver.node("ball")
    driver.session.select([ball.id])
    driver.window.actions_.run("texture_coordinates")
    window = driver.window.side_windows.of(UvWindow)
    qtbot.waitUntil(lambda: window.sheet is not None, timeout=10000)
    return driver, window, ball


def place(view, u, v):
    return view.to_screen(u, v).toPoint()


def test_triangles_lie_where_their_coordinates_are(unwrapped, qtbot):
    driver, window, ball = unwrapped
    assert (
        window.sheet.name == "wood" and f"{len(window.sheet.coordinates):,} triangles on 64 × 64" in window.facts.text()
    )
    assert "texels a mm" in window.facts.text()
    shown = []
    window.view.pointed.connect(shown.append)
    driver.session.select([])
    # The longitude of the -y side is three quarters of a turn, the equator half way up.
    QTest.mouseMove(window.view, place(window.view, 0.5, 0.5))
    QApplication.processEvents()
    QTest.mouseMove(window.view, place(window.view, 0.75, 0.48))
    qtbot.waitUntil(lambda: bool(shown) and shown[-1] >= 0, timeout=5000)
    corners = window.sheet.coordinates[shown[-1]]
    assert (corners.min(axis=0) <= (0.75, 0.48)).all() and (corners.max(axis=0) >= (0.75, 0.48)).all()
    qtbot.mouseClick(window.view, LEFT, pos=place(window.view, 0.75, 0.48))
    assert driver.session.selection == (ball.id,)


def test_a_shift_drag_moves_the_bitmap_as_one_step(unwrapped, qtbot):
    driver, window, _ = unwrapped
    before, document = window.sheet.coordinates, driver.document
    view = window.view
    start = place(view, 0.5, 0.4)
    far = QPoint(round(0.25 * view._scale), 0)
    qtbot.mousePress(view, LEFT, SHIFT, start)
    QTest.mouseMove(view, start + QPoint(10, 0))
    QApplication.processEvents()
    QTest.mouseMove(view, start + far)
    QApplication.processEvents()
    qtbot.mouseRelease(view, LEFT, SHIFT, start + far)
    assert driver.node("ball").mapping.offset[0] == pytest.approx(-0.25, abs=0.01)
    assert "set_mapping" in driver.session.log[-1] and len(driver.session.log) == 1
    qtbot.waitUntil(lambda: window.sheet.coordinates is not before, timeout=10000)
    np.testing.assert_allclose(window.sheet.coordinates - before, np.broadcast_to((0.25, 0), before.shape), atol=0.01)
    driver.session.undo()
    assert driver.document is document
    at, control = QPointF(start), Qt.KeyboardModifier.ControlModifier
    wheel = QWheelEvent(at, view.mapToGlobal(at), QPoint(), QPoint(0, 120), Qt.MouseButton.NoButton, control,
                        Qt.ScrollPhase.NoScrollPhase, False)  # fmt: skip
    QApplication.sendEvent(view, wheel)
    assert driver.node("ball").mapping.scale == pytest.approx((1.2, 1.2))


def test_nothing_to_unwrap_is_said(make_window):
    driver = make_window(document_of(box(5)).with_(solids=()))
    driver.window.actions_.run("texture_coordinates")
    window = driver.window.side_windows.of(UvWindow)
    assert window.stack.currentWidget() is window.empty


def rows(window):
    table = window.rows
    return {
        table.item(i, 0).text(): [float(table.item(i, j).text()) for j in (1, 2, 3)] for i in range(table.rowCount())
    }


def test_the_probes_equation_is_the_pixel(make_window, qtbot):
    sun = light("sun", direction=(0.3, 1, -0.4), intensity=0.8, shadows=True)
    ground, ball = box(40, 40, 2).at(-20, -20, -12).coloured("#8090a0"), sphere(6, segments=24).coloured("#c06040")
    driver = make_window(document_of(ground, ball.named("ball"), sun, light("Ambient", "ambient")))
    driver.look_from("front")
    driver.session.select([driver.node("ball").id])  # whose tint must not count
    driver.window.actions_.run("light_probe")
    window = driver.window.side_windows.of(LightWindow)
    viewport = driver.window.viewport
    assert window.tool.active and window.isVisible()

    def click(point):
        x, y = project(viewport.viewer.camera, np.array([point], float), viewport.viewer.size)[0, :2]
        qtbot.mouseClick(viewport, LEFT, NONE, QPoint(round(x), round(y)))

    click((1.3, -5.8, 0.6))
    found = rows(window)
    assert max(map(abs, found["Difference"])) <= 2 and found["sun: diffuse"][0] > 0.1
    total = np.sum([found[name] for name in ("Ambient", "sun: diffuse", "sun: highlight")], axis=0)
    np.testing.assert_allclose(total, found["Sum"], atol=2e-4)
    assert "“ball”" in window.title.text() and window.tool._marks.arrows
    assert driver.session.selection == (driver.node("ball").id,)

    driver.session.do("set_shading", "flat", label="Flat")
    assert not window.tool._marks.arrows and window.rows.rowCount() == 0  # out of date
    driver.settle()
    click((1.3, -5.8, 0.6))
    assert max(map(abs, rows(window)["Difference"])) <= 2

    qtbot.keyClick(viewport, Qt.Key.Key_Escape)
    assert not window.tool.active and not window.isVisible()
