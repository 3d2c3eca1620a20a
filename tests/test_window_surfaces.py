"""Materials, textures and lights in the real window: the panel, the properties, the handles in the picture."""

import math

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QMouseEvent
from PySide6.QtWidgets import QApplication, QCheckBox, QComboBox, QListWidget, QPushButton, QToolButton

from solidtree.gui.panels.number_field import NumberField
from solidtree.gui.surfaces.handles.mapping_tool import turned_of
from solidtree.gui.surfaces.steps import checker
from solidtree.gui.surfaces.swatch import sphere_pixels
from solidtree.model.script import box, document_of, sphere, texture
from solidtree.model.surface.bitmaps import texels_of
from solidtree.model.surface.light import PROGRAM, Light
from solidtree.model.surface.mapping import TextureMapping, rotation_of
from solidtree.model.surface.material import Material
from solidtree.render.camera import frame, project

pytest_plugins = ["window_driver"]

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
BRASS = Material("Brass", colour="#c9a544", specular=0.5)
PLAIN_LIGHT = Light("Sun", direction=(0, 1, -1))
LAMP = Light("Lamp", "point", position=(20, -30, 60))


def document(**changes):
    made = document_of(box(40, 40, 40).named("part"), sphere(10).at(70, 0, 10).named("ball"))
    return made.with_(**changes)


@pytest.fixture
def opened(make_window):
    def make(page="surfaces_panel", **changes):
        driver = make_window(document(**changes))
        driver.look_from("iso")
        if page:
            driver.window.actions_.run(page)
        return driver

    return make


def found(driver, kind, name):
    widget = driver.window.surfaces.findChild(kind, name)
    assert widget is not None, name
    return widget


def typed(driver, field, text):
    field.setFocus()
    driver.keys("Ctrl+A", field)
    driver.write(text, field)
    driver.keys("Return", field)


def moved(driver, place, button=LEFT):
    viewport = driver.window.viewport
    event = QMouseEvent(QEvent.Type.MouseMove, QPointF(place), QPointF(viewport.mapToGlobal(place)), NONE, button,
                        Qt.KeyboardModifier.NoModifier)  # fmt: skip
    QApplication.sendEvent(viewport, event)


def end_of(driver, tool, name):
    """The pixel of the far end of a handle's path."""
    viewer = driver.window.viewport.viewer
    handle = next(handle for handle in tool._marks.handles if handle.name == name)
    point = handle.world(handle.path, handle.length(viewer.camera, viewer.size))[-1]
    x, y, _ = project(viewer.camera, [point], viewer.size)[0]
    return QPoint(round(x), round(y))


def drag(driver, start, by, let_go=True):
    viewport, end = driver.window.viewport, start + by
    moved(driver, start, NONE)
    driver.qtbot.mousePress(viewport, LEFT, pos=start)
    moved(driver, start + by / 2)
    moved(driver, end)
    assert driver.session.previewing
    if let_go:
        driver.qtbot.mouseRelease(viewport, LEFT, pos=end)
    return end


def test_a_preset_is_added_changed_by_one_drag_of_a_slider_and_put_on_what_is_selected(opened):
    driver = opened(page="")
    window = driver.window
    assert window.surfaces.pages is None and window.docks["Surfaces"].isHidden()  # nothing is made before it is seen
    driver.keys("Alt+M", window.viewport)
    assert window.surfaces.in_front
    window.surfaces.materials.add("Brass")
    assert [one.name for one in driver.document.materials] == ["Brass"]
    added = driver.document
    slider = found(driver, object, "specular_slider")
    slider.setSliderDown(True)
    for value in (60, 70, 80):
        slider.setValue(value)
        assert driver.session.previewing and driver.document.materials[0].specular == value / 100
    slider.setSliderDown(False)
    assert not driver.session.previewing and driver.document.materials[0].specular == 0.8
    typed(driver, found(driver, NumberField, "shininess"), "2 * 30")
    assert driver.document.materials[0].shininess == 60.0
    changed = driver.document
    typed(driver, found(driver, NumberField, "opacity"), "1.5")
    assert driver.document is changed and found(driver, NumberField, "opacity").property("fault")
    driver.keys("Escape", found(driver, NumberField, "opacity"))
    driver.click_row(driver.node("part"))
    window.actions_.run("use_material")
    assert driver.node("part").material == "Brass" and driver.node("ball").material == ""
    assert driver.session.log[-1] == f"use_material([{driver.node('part').id!r}], 'Brass')"
    driver.keys("Delete", found(driver, QListWidget, "materials"))  # the material, not the node that is selected
    assert not driver.document.materials and driver.node("part").material == ""
    for _ in range(4):
        driver.session.undo()
    assert driver.document is added


def test_bitmaps_come_from_files_dropped_on_the_panel_and_a_bad_one_changes_nothing(opened, tmp_path):
    driver = opened()
    Image.new("RGB", (6, 4), (200, 40, 40)).save(tmp_path / "red.png")
    (tmp_path / "bad.png").write_bytes(b"no picture at all")

    def drop(widget, name):
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(str(tmp_path / name))])
        for event in (
            QDragEnterEvent(QPoint(5, 5), Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier),
            QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier),
        ):
            QApplication.sendEvent(widget, event)
            assert event.isAccepted()
        driver.qtbot.waitUntil(lambda: not driver.window.files.background.working)

    page = driver.window.surfaces.materials
    drop(page, "red.png")
    material = driver.document.materials[0]
    assert material.name == "red" and texels_of(material.texture).shape == (4, 6, 4)
    before = driver.document
    drop(page.form.bitmaps["bump"], "bad.png")
    assert driver.document is before and "bad.png" in driver.window.status.currentMessage()
    drop(page.form.bitmaps["bump"], "red.png")
    assert driver.document.materials[0].bump == material.texture and driver.session.undo_label == "Change bump"
    driver.qtbot.mouseClick(found(driver, QToolButton, "texture_clear"), LEFT)
    assert driver.document.materials[0].texture == "" and driver.document.materials[0].bump


def test_the_properties_put_a_material_on_and_say_how_its_bitmap_lies(opened):
    driver = opened(page="", materials=(BRASS,))
    driver.click_row(driver.node("part"))
    combo = driver.child(QComboBox, "material")
    assert not driver.child(QPushButton, "checker").isVisible()
    combo.activated.emit(combo.setCurrentIndex(combo.findData("Brass")) or 0)
    assert driver.node("part").material == "Brass"
    combo.setCurrentIndex(combo.findText("New glass"))
    combo.activated.emit(combo.currentIndex())
    assert driver.node("part").material == "Glass" and len(driver.document.materials) == 2
    driver.session.undo()
    assert driver.node("part").material == "Brass" and len(driver.document.materials) == 1
    driver.window.actions_.run("checker_board")
    worn = next(one for one in driver.document.materials if one.name == driver.node("part").material)
    assert worn.name == "Checker" and texels_of(worn.texture).shape == (512, 512, 4)
    assert driver.child(QPushButton, "checker").isVisible()  # a texture unfolds its rows
    projection = driver.child(QComboBox, "projection")
    projection.setCurrentIndex(projection.findData("box"))
    projection.activated.emit(projection.currentIndex())
    driver.type_into(driver.field("texture_size_u"), "10")
    driver.type_into(driver.field("texture_turn"), "30")
    assert driver.node("part").mapping == TextureMapping("box", size=(10, 20), turn=30)
    before = driver.document
    driver.type_into(driver.field("texture_scale_u"), "0", end="Tab")
    assert driver.document is before
    projection.setCurrentIndex(0)
    projection.activated.emit(0)
    assert driver.node("part").mapping is None


def test_steps_in_a_number_of_a_texture_keep_what_the_node_had_from_above(make_window):
    part = (box(40, 40, 40) - sphere(10).named("ball")).dressed(texture(projection="box", size=(5, 6))).named("part")
    driver = make_window(document_of(part))
    driver.click_row(driver.node("ball"))
    driver.qtbot.mouseClick(driver.child(QToolButton, "fold_texture"), LEFT)
    field = driver.field("texture_turn")
    field.setFocus()
    driver.qtbot.keyPress(field, Qt.Key.Key_Up)
    driver.qtbot.keyPress(field, Qt.Key.Key_Up)
    assert driver.session.previewing
    driver.qtbot.keyRelease(field, Qt.Key.Key_Up)
    assert driver.node("ball").mapping == TextureMapping("box", size=(5, 6), turn=10)
    assert driver.node("part").mapping == TextureMapping("box", size=(5, 6))
    driver.session.undo()
    assert driver.node("ball").mapping is None


def test_lights_of_the_program_become_the_documents_and_are_switched_and_changed(opened):
    driver = opened(page="lights_panel")
    driver.qtbot.mouseClick(found(driver, QPushButton, "own_lights"), LEFT)
    lights = driver.document.lights
    assert [light.name for light in lights] == [light.name for light in PROGRAM]
    for made, meant in zip(lights, PROGRAM, strict=True):
        assert made.intensity == meant.intensity and made.with_camera == meant.with_camera
        assert math.dist(made.direction, meant.direction) < 1e-5
    assert driver.session.undo_label == "Make lights of the document" and not driver.session.previewing
    listed = found(driver, QListWidget, "lights")
    listed.item(1).setCheckState(Qt.CheckState.Unchecked)
    assert [light.active for light in driver.document.lights] == [True, False, True, True]
    listed.item(2).setText("Window")
    assert driver.document.lights[2].name == "Window" and driver.window.surfaces.light == "Window"
    typed(driver, found(driver, NumberField, "direction_x"), "0")
    assert driver.document.lights[2].direction[0] == 0.0
    shading = found(driver, QComboBox, "document_shading")
    shading.setCurrentIndex(shading.findData("flat"))
    shading.activated.emit(shading.currentIndex())
    assert driver.document.shading == "flat"
    driver.window.actions_.run("delete_light")
    assert len(driver.document.lights) == 3


def test_a_light_that_begins_to_go_with_the_camera_shines_as_before(opened):
    driver = opened(page="lights_panel", lights=(LAMP,))
    box = found(driver, QCheckBox, "with_camera")
    driver.qtbot.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))
    lamp, camera = driver.document.lights[0], driver.window.viewport.viewer.camera
    assert lamp.with_camera
    assert np.allclose(np.array(camera.position) + lamp.position @ frame(camera), LAMP.position, atol=2e-3)


def test_the_arrow_turns_a_light_and_the_marker_moves_one_each_in_one_step(opened):
    driver = opened(page="lights_panel", lights=(PLAIN_LIGHT, LAMP))
    window, tool = driver.window, driver.window.light_tool
    before = driver.document
    driver.keys("Escape", window.viewport)
    start = end_of(driver, tool, "light turn")
    end = drag(driver, start, QPoint(-60, 10), let_go=False)
    driver.keys("Escape", window.viewport)
    driver.qtbot.mouseRelease(window.viewport, LEFT, pos=end)
    assert driver.document is before and not driver.session.previewing
    end = drag(driver, start, QPoint(10, 40))
    turned = driver.document.lights[0].direction
    assert driver.session.undo_label == "Turn Sun" and 0.3 < np.dot(turned, PLAIN_LIGHT.direction) < 0.99
    knob = end_of(driver, tool, "light turn")
    assert math.hypot(knob.x() - end.x(), knob.y() - end.y()) < 4  # it went where the pointer went
    driver.qtbot.mouseClick(window.viewport, LEFT, pos=end_of(driver, tool, "light of Lamp"))
    assert window.surfaces.light == "Lamp" and driver.document.lights[0].direction == turned
    drag(driver, end_of(driver, tool, "move z"), QPoint(0, -40))
    x, y, z = driver.document.lights[1].position
    assert (x, y) == (20, -30) and z > 61 and driver.session.undo_label == "Move Lamp"
    window.docks["Properties"].raise_()
    driver.qtbot.waitUntil(lambda: not tool._marks.handles)


def test_the_gizmo_shifts_and_turns_a_texture(opened):
    mapping = TextureMapping("planar", size=(7, 7))
    driver = opened(page="", materials=(BRASS,))
    driver.click_row(driver.node("part"))
    driver.session.do("set_mapping", [driver.node("part").id], "planar", size=(7, 7))
    driver.window.actions_.run("texture_placement")
    tool = driver.window.mapping_tool
    assert tool.active and driver.window.handles.hidden
    drag(driver, end_of(driver, tool, "move x"), QPoint(40, 20))
    x, y, z = driver.node("part").mapping.origin
    assert x > 1 and (y, z) == (0, 0) and driver.node("part").mapping.size == mapping.size
    ring = next(handle for handle in tool._marks.handles if handle.name == "turn z")
    viewer = driver.window.viewport.viewer
    points = ring.world(ring.path, ring.length(viewer.camera, viewer.size))
    near = points[np.argmax((points - ring.origin) @ (np.array(viewer.camera.position) - ring.origin))]
    px, py, _ = project(viewer.camera, [near], viewer.size)[0]
    drag(driver, QPoint(round(px), round(py)), QPoint(30, 0))
    turned = driver.node("part").mapping.turned
    assert turned[:2] == (0, 0) and turned[2] > 5  # to the right at the near side is counter-clockwise from above
    driver.window.actions_.run("measure")
    assert not tool.active and driver.window.handles.hidden
    driver.window.actions_.run("texture_placement")
    assert tool.active and not driver.window.measure.active
    driver.keys("Escape", driver.window.viewport)
    assert not tool.active and not driver.window.handles.hidden


@pytest.mark.parametrize("degrees", [(10, 20, 30), (-170, 60, 100), (25, 90, 40), (0, -90, 12), (180, 0, 0)])
def test_the_angles_of_a_rotation_make_it_again(degrees):
    rotation = rotation_of(degrees)
    assert np.allclose(rotation_of(turned_of(rotation)), rotation, atol=1e-9)


def test_the_checker_board_begins_with_a1_at_the_lower_left(qapp):
    texels = texels_of(checker())
    rows, columns = np.indices((8, 8))
    corners = texels[::-1][rows * 64 + 4, columns * 64 + 4, :3]  # from the bottom up, beside the letters
    assert (corners[(rows + columns) % 2 == 0] == corners[0, 0]).all()
    assert (corners[(rows + columns) % 2 == 1] == corners[0, 1]).all()
    assert corners[0, 0].sum() < corners[0, 1].sum()


def test_a_swatch_is_lit_from_the_upper_left_and_shows_what_is_translucent():
    matt = Material("matt", colour="#808080", specular=0.0)
    lit = sphere_pixels(matt, 32)[..., :3].sum(axis=2)
    assert lit[9, 9] > lit[22, 22] and sphere_pixels(matt, 32)[0, 0, 3] == 0
    assert len(np.unique(sphere_pixels(matt.with_(opacity=0.0), 32)[14:18, 8:24, 0])) > 1  # the squares behind it


def test_a_missing_bitmap_is_a_problem_until_the_material_has_another(opened):
    driver = opened(None, materials=(Material("lost", texture="ab" * 32),))
    part = driver.node("part")
    driver.session.do("use_material", [part.id], "lost", label="Put on")
    driver.settle()
    problems = driver.window.problems.list
    assert problems.count() == 1 and "its bitmap is missing" in problems.item(0).text()
    driver.session.do("set_material", "lost", texture="", label="Without")
    driver.settle()
    assert problems.count() == 0
