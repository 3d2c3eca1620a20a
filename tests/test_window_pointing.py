"""What clicks in the picture select, what the pointer is told to be over, ghosts and colours by node."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QHelpEvent
from PySide6.QtWidgets import QApplication, QToolTip

from solidtree.model.document.distinct_colours import distinct_colour
from solidtree.model.document.document import Document
from solidtree.model.document.tree import numbered
from solidtree.model.script import box, cylinder, sphere, union
from solidtree.render.look import rgb

pytest_plugins = ["window_driver"]

ALT, SHIFT, CONTROL = (
    Qt.KeyboardModifier.AltModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
)


def plate() -> Document:
    holes = union(*(cylinder(5, 20).at(10 + 20 * i, 20, -6).named(f"hole {i + 1}") for i in range(3)))
    solid = (box(60, 40, 8).named("slab") - holes.named("holes") - sphere(4).at(15, 6, 4).named("void")).named("plate")
    return Document(solids=numbered([solid]))


@pytest.fixture
def plated(make_window):
    driver = make_window(plate())
    driver.look_from("top")
    return driver


def chosen(driver) -> list[str]:
    return [next(n for n in _nodes(driver) if n.id == i).label for i in driver.session.selection]


def _nodes(driver):
    from solidtree.model.document.tree import walk

    return walk(*driver.document.roots)


def wall(driver) -> QPoint:
    """A pixel on the wall of hole 1, of which the top view in perspective shows the left side, where no handles are."""
    viewer = driver.window.viewport.viewer
    assert viewer is not None
    middle, hole = driver.pixel_of((10.0, 20.0, 8.0)), driver.node("hole 1").id
    for x in range(middle.x(), 0, -1):
        picks = [viewer.pick(x + by, middle.y()) for by in (-1, 0, 1)]
        if all(pick is not None and hole in pick.path for pick in picks) and len({p.facet for p in picks if p}) == 1:
            return QPoint(x, middle.y())
    raise AssertionError("no wall is seen")


def test_clicks_climb_from_the_leaf_to_the_solid_and_begin_again(plated):
    at = wall(plated)
    click = lambda held=Qt.KeyboardModifier.NoModifier, by=0: plated.qtbot.mouseClick(  # noqa: E731
        plated.window.viewport, Qt.MouseButton.LeftButton, held, at + QPoint(by, 0)
    )
    hover = plated.window.status.hover
    click()
    assert chosen(plated) == ["hole 1"] and "plate › holes › [hole 1]" in hover.text()  # noqa: RUF001
    click(by=1)
    assert chosen(plated) == ["holes"] and "plate › [holes] › hole 1" in hover.text()  # noqa: RUF001
    click()
    assert chosen(plated) == ["plate"]
    click()
    assert chosen(plated) == ["hole 1"]
    click()
    plated.session.select((plated.node("slab").id,))  # elsewhere something else was chosen
    click()
    assert chosen(plated) == ["hole 1"]
    click(ALT)
    assert chosen(plated) == ["plate"]
    click(CONTROL)
    assert chosen(plated) == ["plate", "hole 1"]
    click(CONTROL)
    assert chosen(plated) == ["plate"]
    plated.click_at((1.0, 39.0, 8.0))
    assert chosen(plated) == ["slab"]
    plated.qtbot.mouseClick(plated.window.viewport, Qt.MouseButton.LeftButton, pos=QPoint(3, 300))
    assert chosen(plated) == []


def test_a_double_click_takes_back_what_its_first_click_climbed(plated):
    at, viewport = wall(plated), plated.window.viewport
    plated.qtbot.mouseClick(viewport, Qt.MouseButton.LeftButton, pos=at)
    assert chosen(plated) == ["hole 1"]
    before = viewport.viewer.camera
    plated.qtbot.mouseClick(viewport, Qt.MouseButton.LeftButton, pos=at)
    assert chosen(plated) == ["holes"]
    plated.qtbot.mouseDClick(viewport, Qt.MouseButton.LeftButton, pos=at)
    assert chosen(plated) == ["hole 1"]
    plated.qtbot.waitUntil(lambda: viewport.viewer.camera.distance < 0.8 * before.distance)


def test_alt_and_shift_go_through_to_what_lies_behind(plated):
    """Below the slab's top lies the ball of air, then the slab's bottom."""
    void = (12.8, 4.2, 4.0)
    plated.click_at(void)
    assert chosen(plated) == ["slab"]
    plated.click_at(void, ALT | SHIFT)
    assert chosen(plated) == ["void"]
    plated.click_at(void, ALT | SHIFT)
    assert chosen(plated) == ["slab"]


def test_the_menu_lists_what_lies_under_the_pointer(plated):
    viewport = plated.window.viewport
    pixel = plated.pixel_of((12.8, 4.2, 4.0))
    plated.qtbot.mouseClick(viewport, Qt.MouseButton.RightButton, pos=pixel)
    plated.qtbot.waitUntil(lambda: QApplication.activePopupWidget() is not None)
    menu = QApplication.activePopupWidget()
    assert menu is not None
    entries = menu.actions()
    assert [action.text() for action in entries[:2]] == ["slab", "void (subtracted)"]
    assert entries[2].isSeparator() and plated.window.actions_["delete"] in entries
    assert chosen(plated) == ["slab"]
    entries[1].hovered.emit()
    assert viewport.viewer.scene.hover[-1] == plated.node("void").id
    entries[1].trigger()
    menu.close()
    assert chosen(plated) == ["void"] and viewport.viewer.scene.hover is None

    camera = viewport.viewer.camera  # a drag pans, and asks for no menu
    plated.qtbot.mousePress(viewport, Qt.MouseButton.RightButton, pos=pixel)
    plated.qtbot.mouseMove(viewport, pixel + QPoint(30, 0))
    plated.qtbot.mouseRelease(viewport, Qt.MouseButton.RightButton, pos=pixel + QPoint(30, 0))
    assert viewport.viewer.camera != camera and QApplication.activePopupWidget() is None


def test_a_tip_names_the_face_under_the_resting_pointer(plated):
    at, viewport = wall(plated), plated.window.viewport
    plated.qtbot.mouseMove(viewport, at)
    plated.qtbot.waitUntil(lambda: "hole 1" in plated.window.status.hover.text())
    assert "subtracted, facet" in plated.window.status.hover.text() and "mm" not in QToolTip.text()
    QApplication.sendEvent(viewport, QHelpEvent(QEvent.Type.ToolTip, at, viewport.mapToGlobal(at)))
    assert "hole 1" in QToolTip.text() and "cylinder, subtracted" in QToolTip.text()
    QToolTip.hideText()


def ghosts(driver) -> int:
    return driver.window.viewport.viewer.ghosts.count


def test_ghosts_come_and_go_with_the_selection_and_follow_a_drag(plated):
    viewer = plated.window.viewport.viewer
    assert ghosts(plated) == 0
    plated.click_row(plated.node("hole 1"))
    plated.qtbot.waitUntil(lambda: ghosts(plated) == 1)
    assert viewer.ghosts.bounds == pytest.approx(np.array([[5, 15, -6], [15, 25, 14]]), abs=0.1)
    from solidtree.model.operations.operations import OPERATIONS

    node = plated.node("hole 1")
    moved = OPERATIONS["move"](plated.document, [node.id], 7, 0, 0)
    plated.session.preview(moved)  # at once: the shape need not be evaluated for it
    assert viewer.ghosts.bounds == pytest.approx(np.array([[12, 15, -6], [22, 25, 14]]), abs=0.1)
    plated.session.cancel()
    plated.window.actions_["ghosts"].trigger()
    assert ghosts(plated) == 0 and not plated.window.settings.flag("ghosts", True)
    plated.window.actions_["ghosts"].trigger()
    assert ghosts(plated) == 1
    plated.click_row(plated.node("slab"))  # shown as it is
    plated.qtbot.waitUntil(lambda: ghosts(plated) == 0)
    plated.click_row(plated.node("holes"))
    plated.qtbot.waitUntil(lambda: ghosts(plated) == 1)
    plated.session.do("set_visible", [plated.node("plate").id], False)
    plated.click_row(plated.node("slab"))
    plated.qtbot.waitUntil(lambda: ghosts(plated) == 1)


def test_colour_by_node(plated):
    viewport, slab = plated.window.viewport, plated.node("slab")
    plated.keys("C", viewport)
    assert plated.window.looks.colour_by_node
    viewport.viewer.render()
    at = plated.pixel_of((1.0, 39.0, 8.0)) + QPoint(4, 4)
    ratio = viewport.devicePixelRatioF()
    red, green, blue = viewport.viewer.pixels()[int(at.y() * ratio), int(at.x() * ratio)] / 255
    wanted = rgb(distinct_colour(slab.id))
    assert np.argsort((red, green, blue)).tolist() == np.argsort(wanted).tolist()
    image = plated.window.tree.nodes.index_of(slab.id).data(Qt.ItemDataRole.DecorationRole).pixmap(40, 40).toImage()
    assert image.pixelColor(20, 2).name() == distinct_colour(slab.id)
    plated.keys("C", viewport)
    assert not plated.window.settings.flag("colour_by_node", True)
