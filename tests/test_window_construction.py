"""The Construction page in the real window: t by slider, field and playing; segments; what is told."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from solidtree.model.document.document import Document
from solidtree.model.document.outlines import Bezier, Path
from solidtree.render.look import DARK, LIGHT, rgb

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton
SHAPE = Path(
    id="n1",
    points=((0.0, 0.0), (0.0, 40.0), (50.0, 40.0), (60.0, 0.0), (40.0, -20.0)),
    segments="MCLl",
)


@pytest.fixture
def opened(make_window):
    driver = make_window(Document(profiles=(SHAPE, Bezier(id="n2", points=((0.0, 0.0), (0.0, 8.0), (8.0, 8.0))))))
    driver.session.select(["n1"])
    driver.window.actions_["construction"].trigger()
    return driver


@pytest.fixture
def page(opened):
    return opened.window.curve_panel.pages["Construction"]


def cubic(t: float) -> np.ndarray:
    p = np.array(SHAPE.points[:4])
    return (1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t * t * (1 - t) * p[2] + t**3 * p[3]


def test_the_command_brings_the_page_to_the_front_and_hides_the_construction_again(opened, page):
    assert page.isVisible()
    assert page.switch.isChecked()
    assert opened.window.actions_["construction"].isChecked()
    assert page.where.text() == "Contour 0, segment 0 of 3, cubic"
    opened.window.actions_["construction"].trigger()
    assert opened.window.construction.made is None
    assert not page.switch.isChecked()
    assert not page.slider.isVisible()
    opened.keys("Space", page.switch)
    assert opened.window.construction.made is not None
    assert opened.window.actions_["construction"].isChecked()


def test_without_an_outline_the_command_is_refused_in_words(opened):
    driver = opened
    driver.window.actions_["construction"].trigger()
    driver.session.select([])
    assert not driver.window.actions_["construction"].isEnabled()


def test_the_slider_moves_the_point_in_the_picture(opened, page):
    driver, view = opened, opened.window.construction
    driver.look_from("top")
    viewer = driver.window.viewport.viewer
    accent = 255 * np.array(rgb((DARK if driver.window.theme.name == "dark" else LIGHT).selection))

    def orange_at(t: float) -> bool:
        viewer.render()
        pixel = driver.pixel_of((*cubic(t).tolist(), 0.0))
        ratio = viewer.pixels().shape[1] / viewer.size[0]
        found = viewer.pixels()[int(pixel.y() * ratio), int(pixel.x() * ratio)]
        return bool(np.abs(found - accent).max() < 25)

    page.slider.setFocus()
    driver.keys("Home", page.slider)
    driver.keys("Right", page.slider)
    assert view.t == pytest.approx(0.01)
    np.testing.assert_allclose(view.made.point, cubic(0.01))
    page.slider.setValue(300)
    np.testing.assert_allclose(view.made.point, cubic(0.3))
    assert orange_at(0.3)
    assert not orange_at(0.7)
    page.slider.setValue(700)
    assert orange_at(0.7)
    assert page.field.text() == "0.7"


def test_t_can_be_typed_and_what_it_cannot_be_is_told(opened, page):
    driver, view, said = opened, opened.window.construction, []
    opened.window.curve.refused.connect(said.append)
    for text, t in (("1/3", 1 / 3), ("0.25", 0.25)):
        driver.qtbot.mouseClick(page.field, LEFT)
        driver.keys("Ctrl+A", page.field)
        driver.write(text, page.field)
        driver.keys("Return", page.field)
        assert view.t == pytest.approx(t)
    driver.keys("Ctrl+A", page.field)
    driver.write("2", page.field)
    driver.keys("Return", page.field)
    assert view.t == 0.25
    assert said == ["t is from 0 to 1 on a segment, not 2"]


def test_it_plays_there_and_back_until_it_is_stopped_or_not_seen(opened, page):
    driver, view, seen = opened, opened.window.construction, []
    page.slider.setValue(985)
    view.changed.connect(lambda: seen.append(view.t))
    driver.qtbot.mouseClick(page.play, LEFT)
    driver.qtbot.waitUntil(lambda: 1.0 in seen and seen[-1] < 0.98, timeout=5000)
    driver.keys("Space", page.slider)
    assert not page.playing
    driver.keys("Space", page.slider)
    assert page.playing
    driver.window.curve_panel.show_page("Nodes")
    assert not page.playing


def test_the_basis_the_deviation_and_the_polynomial_are_told(opened, page):
    page.slider.setValue(500)
    assert page.bars.values == (0.125, 0.375, 0.375, 0.125)
    assert page.sum.text().startswith("Sum 1.000")
    assert page.polynomials.text() == "x(t) = −90 t³ + 150 t²\ny(t) = −120 t² + 120 t"
    assert page.value.text().startswith("(26.25; 30) mm")
    page.steps.setValue(1)
    # One chord from (0, 0) to (60, 0): the curve is 120 t (1 - t) above it.
    assert opened.window.construction.deviation == pytest.approx(30.0)
    assert page.deviation.text() == "off by 30 mm"


def test_segments_are_gone_through_and_follow_the_chosen_node(opened, page):
    driver, view = opened, opened.window.construction
    driver.qtbot.mouseClick(page.back, LEFT)
    assert view.at == (0, 2)
    assert page.where.text() == "Contour 0, segment 2 of 3, line"
    driver.qtbot.mouseClick(page.forward, LEFT)
    assert view.at == (0, 0)
    driver.window.curve.choose([(0, 1)])
    assert view.at == (0, 1)
    np.testing.assert_allclose(view.made.levels[0], [(60, 0), (40, -20)])
    driver.session.select(["n2"])
    assert view.at == (0, 0)
    assert page.where.text() == "Contour 0, segment 0 of 1, quadratic"


def test_it_follows_the_outline_while_it_is_edited(opened, page):
    driver, view = opened, opened.window.construction
    page.slider.setValue(1000)
    driver.window.curve.preview("place_nodes", [(0, 1)], [(70.0, 10.0)])
    np.testing.assert_allclose(view.made.point, (70, 10))
    driver.window.curve.cancel()
    np.testing.assert_allclose(view.made.point, (60, 0))
