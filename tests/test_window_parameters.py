"""The customizer in the window: editors by range and choice, sliders, definitions, sets."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QInputDialog

from solidtree.model.document.document import Document, Parameter, ParameterSet
from solidtree.model.document.primitives import Box, Sphere

pytest_plugins = ["window_driver"]
LEFT = Qt.MouseButton.LeftButton
DOCUMENT = Document(
    solids=(Sphere(id="s", name="ball", radius="r"), Box(id="b", name="block", size=("half", 1, 1))),
    parameters=(
        Parameter("r", 10, 5, 20, note="of the ball", group="Ball"),
        Parameter("half", "r / 2", group="Ball"),
        Parameter("teeth", 4, choices=(3, 4, 6)),
        Parameter("x", "y"),
        Parameter("y", "x"),
    ),
    sets=(ParameterSet("big", (("r", 18),)),),
)


@pytest.fixture
def panel(driver):
    driver.open(DOCUMENT)
    driver.keys("Ctrl+Shift+P")
    assert driver.window.parameters.isVisible()
    return driver.window.parameters


def value(driver, name):
    return driver.document.parameter(name).value


def test_a_slider_drag_shows_the_solid_and_is_one_step(driver, panel):
    slider, before = panel.rows["r"].slider, driver.document
    driver.qtbot.mousePress(slider, LEFT, pos=slider.handle_centre(slider.value()))
    places = [slider.handle_centre(place) for place in (60, 100, slider.maximum())]
    for place in places:
        driver.qtbot.mouseMove(slider, place)
    assert driver.session.previewing and value(driver, "r") == 20
    assert panel.rows["r"].field.text() == "20" and panel.rows["half"].note.text().startswith("= 10")
    driver.settle()
    bounds = driver.window.viewport.viewer.scene.visible_bounds()
    assert bounds[1][2] == pytest.approx(20, rel=0.01)  # the ball in the picture
    driver.qtbot.mouseRelease(slider, LEFT, pos=places[-1])
    assert not driver.session.previewing and driver.session.undo_label == "Change r"
    assert driver.session.log == ("set_parameter('r', 20)",)
    driver.session.undo()
    assert driver.document is before and panel.rows["r"].field.text() == "10"


def test_escape_takes_a_drag_back(driver, panel):
    slider, before = panel.rows["r"].slider, driver.document
    driver.qtbot.mousePress(slider, LEFT, pos=slider.handle_centre(120))
    assert driver.session.previewing
    driver.keys("Escape", slider)
    assert driver.document is before and slider.value() == 50
    driver.qtbot.mouseRelease(slider, LEFT, pos=QPoint(5, 5))
    assert driver.document is before and driver.session.undo_label is None


def test_keys_step_a_slider_once(driver, panel):
    slider = panel.rows["r"].slider
    slider.setFocus()
    driver.keys("Right", slider)
    driver.keys("Ctrl+Right", slider)
    assert value(driver, "r") == pytest.approx(11.1)
    driver.keys("End", slider)
    assert value(driver, "r") == 20 and len(driver.session.log) == 3


def test_undo_takes_back_a_run_that_is_under_way(driver, panel):
    driver.session.do("set_parameter", "teeth", 6)
    slider, before = panel.rows["r"].slider, driver.document
    slider.setFocus()
    driver.qtbot.keyPress(slider, Qt.Key.Key_Right)
    assert driver.session.previewing
    driver.keys("Ctrl+Z", slider)
    driver.qtbot.keyRelease(slider, Qt.Key.Key_Right)
    assert driver.document is before and driver.session.redo_label == "Change r"


def test_the_editor_follows_the_definition(driver, panel):
    r, half, teeth = (panel.rows[name] for name in ("r", "half", "teeth"))
    assert r.slider.isVisible() and not half.slider.isVisible() and not r.choice.isVisible()
    assert half.field.text() == "r / 2" and half.note.text() == "= 5"
    assert teeth.choice.isVisible() and not teeth.field.isVisible()
    teeth.choice.setFocus()
    driver.keys("Down", teeth.choice)
    assert value(driver, "teeth") == 6
    r.field.setFocus()
    r.field.selectAll()
    driver.write("99", r.field)
    driver.keys("Return", r.field)
    assert value(driver, "r") == 10 and r.fault.text() == "The parameter r must be at most 20, not 99"
    assert r.field.text() == "99"
    driver.keys("Escape", r.field)
    assert r.field.text() == "10" and not r.fault.isVisible()
    r.field.selectAll()
    driver.write("half", r.field)
    driver.keys("Return", r.field)
    assert "depends on itself" in r.fault.text() and value(driver, "r") == 10
    driver.keys("Escape", r.field)
    r.field.selectAll()
    driver.write("teeth * 2", r.field)
    driver.keys("Return", r.field)
    assert value(driver, "r").text == "teeth * 2" and not r.slider.isVisible() and r.field.hasFocus()


def test_what_is_wrong_stands_on_the_row_even_where_nothing_uses_it(driver, panel):
    assert panel.rows["x"].fault.text() == "The parameter x depends on itself: x, y go in a circle"
    driver.session.do("set_parameter", "y", 3.0)
    assert not panel.rows["x"].fault.isVisible() and panel.rows["x"].note.text() == "= 3"


def test_a_parameter_is_added_and_defined_by_keys(driver, panel):
    driver.qtbot.mouseClick(panel.add, LEFT)
    form = panel.definition
    assert form.fields["name"].hasFocus()
    driver.write("bore")
    for text in ("12", "2", "30", "", "of the hole", "Ball"):  # value, minimum, maximum, choices, note, group
        driver.keys("Tab")
        driver.write(text)
    driver.keys("Return")
    assert driver.document.parameters[-1] == Parameter("bore", 12, 2, 30, note="of the hole", group="Ball")
    row = panel.rows["bore"]
    assert row.slider.isVisible() and row.note.text() == "of the hole" and panel.definition is form
    assert row.parentWidget() is panel.rows["r"].parentWidget()
    assert form.up.isEnabled() and not form.down.isEnabled()
    driver.qtbot.mouseClick(form.up, LEFT)
    assert [p.name for p in driver.document.parameters if p.group == "Ball"] == ["r", "bore", "half"]
    form.fields["name"].setFocus()
    form.fields["name"].selectAll()
    driver.write("r")
    driver.keys("Return")
    assert "called r already" in form.fault.text()
    driver.qtbot.mouseClick(form.delete, LEFT)
    assert "bore" not in panel.rows and panel.definition is None


def test_a_rename_keeps_the_row_and_its_users_follow(driver, panel):
    row = panel.rows["r"]
    panel.define("r")
    name = panel.definition.fields["name"]
    name.selectAll()
    driver.write("radius", name)
    driver.keys("Return", name)
    assert panel.rows["radius"] is row and row.label.text() == "radius" and panel.definition.name == "radius"
    assert driver.document.solids[0].radius.text == "radius" and value(driver, "half").text == "radius / 2"
    driver.session.undo()
    assert panel.rows["r"] is row and panel.definition.fields["name"].text() == "r"


def test_users_are_selected(driver, panel):
    panel.select_users("r")
    assert driver.session.selection == ("s", "b")
    said = []
    panel.refused.connect(said.append)
    panel.select_users("teeth")
    assert said == ["Nothing uses teeth yet"] and driver.session.selection == ("s", "b")


def test_sets_are_applied_changed_saved_and_left(driver, panel):
    box = panel.sets.box
    assert box.currentText() == "As in the file"
    box.setFocus()
    driver.keys("Down", box)
    assert value(driver, "r") == 18 and driver.session.log == ("apply_set('big')",)
    assert box.currentText() == "big" and not panel.rows["r"].reset.isVisible()
    driver.session.do("set_parameter", "r", 15.0)
    assert box.currentText() == "big (changed)" and panel.rows["r"].reset.toolTip() == "Back to 18, as in “big”"
    driver.qtbot.mouseClick(panel.rows["r"].reset, LEFT)
    assert value(driver, "r") == 18 and box.currentText() == "big"
    driver.session.do("set_parameter", "r", 12.0)
    driver.window.actions_.run("update_set")
    assert dict(driver.document.sets[0].values)["r"] == 12 and box.currentText() == "big"
    driver.session.do("set_parameter", "r", 7.0)
    driver.window.actions_.run("save_set")
    dialog = panel.sets.findChild(QInputDialog)
    driver.qtbot.waitUntil(dialog.isVisible)
    dialog.setTextValue("small")
    dialog.accept()
    assert [one.name for one in driver.document.sets] == ["big", "small"] and box.currentText() == "small"
    driver.keys("Up", box)
    assert value(driver, "r") == 12
    driver.window.actions_.run("reset_parameters")
    driver.keys("Up", box)
    assert value(driver, "r") == 10 and box.currentText() == "As in the file"


def test_sets_go_to_a_file_and_come_back(driver, panel, tmp_path):
    from solidtree.gui.commands.parameters import export_sets, import_sets

    path = str(tmp_path / "sets.json")
    export_sets(driver.window, path)
    driver.qtbot.waitUntil(lambda: not driver.window.files.background.working)
    driver.session.do("delete_set", "big")
    assert panel.sets.box.count() == 1
    import_sets(driver.window, path)
    driver.qtbot.waitUntil(lambda: not driver.window.files.background.working)
    assert driver.document.sets == DOCUMENT.sets and driver.session.undo_label == "Import sets.json"


def test_many_parameters_are_found_by_name_and_note(driver):
    notes = ["of the lid" if i % 10 == 3 else "" for i in range(40)]
    many = tuple(Parameter(f"p{i}", i, note=notes[i], group="ABCD"[i // 10]) for i in range(40))
    driver.open(Document(parameters=many))
    driver.keys("Ctrl+Shift+P")
    panel = driver.window.parameters
    assert panel.search.isVisible()
    driver.write("lid", panel.search)
    assert [name for name, row in panel.rows.items() if not row.isHidden()] == ["p3", "p13", "p23", "p33"]
    panel.show_parameter("p25")
    assert panel.search.text() == "" and panel.rows["p25"].field.hasFocus()
    fold = panel._folds["C"]
    fold.heading.setFocus()
    driver.keys("Space", fold.heading)
    assert not panel.rows["p25"].isVisible()
    panel.show_parameter("p25")
    assert panel.rows["p25"].isVisible()
