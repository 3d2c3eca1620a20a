"""The window driven by keys and mouse: building, editing, undo, files, commands."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QLineEdit, QMessageBox, QToolButton

from solidtree.gui.commands.menus import ORDER, example_names, open_example
from solidtree.gui.dialogs import ExportDialog
from solidtree.gui.panels.measures import MeasuresView
from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Difference, Intersection, Union
from solidtree.model.document.primitives import Box, Cylinder, Halfspace, Sphere
from solidtree.model.editing.commands import DOCUMENT_COMMANDS
from solidtree.model.script import save

pytest_plugins = ["window_driver"]
CTRL = Qt.KeyboardModifier.ControlModifier


def kinds(document: Document) -> list[str]:
    return [root.kind for root in document.solids]


def test_every_command_of_a_menu_has_its_place_there(driver):
    for top in driver.window.menuBar().actions():
        title, entries = top.text().strip("&"), top.menu().actions()
        wanted = ORDER[title].split()
        assert len(entries) == len(wanted), title
        assert [action.isSeparator() for action in entries] == [name == "-" for name in wanted]


def test_primitives_come_by_their_shortcuts_and_are_shown(driver):
    for keys in ("Shift+B", "Shift+S", "Shift+C", "Shift+O", "Shift+T"):
        driver.keys(keys)
    assert kinds(driver.document) == ["Box", "Sphere", "Cylinder", "Cone", "Torus"]
    driver.settle()
    assert len(driver.window.viewport.viewer.scene.meshes) == 5
    assert "triangles" in driver.window.status.measures.text()


def test_combine_undo_redo_by_keys(driver):
    driver.keys("Shift+B")
    driver.keys("Shift+S")
    before = driver.document
    driver.keys("Ctrl+A")
    driver.keys("Ctrl+D")
    (root,) = driver.document.solids
    assert isinstance(root, Difference) and [child.kind for child in root.children] == ["Box", "Sphere"]
    combined = driver.document
    driver.keys("Ctrl+Z")
    assert driver.document is before
    driver.keys("Ctrl+Shift+Z")
    assert driver.document is combined
    assert driver.window.actions_["undo"].text() == "Undo difference"


def test_the_dumbbell_is_built_by_hand(driver):
    window = driver.window
    for x in ("-20", "20"):
        driver.keys("Escape", window.viewport)
        driver.keys("Shift+S")
        driver.type_into(driver.field("radius"), "10")
        driver.type_into(driver.field("position_x"), x)
    driver.keys("Escape", window.viewport)
    window.viewport.setFocus()
    driver.keys("Shift+C")
    driver.type_into(driver.field("radius"), "4")
    driver.type_into(driver.field("height"), "40")
    add = driver.child(QToolButton, "add_step")
    add.menu().actions()[0].trigger()
    driver.type_into(driver.field("step_0_1"), "90")
    driver.type_into(driver.field("position_x"), "-20")
    window.viewport.setFocus()
    driver.keys("Ctrl+A")
    driver.keys("Ctrl+U")
    driver.keys("Escape", window.viewport)
    driver.keys("Shift+H")
    driver.type_into(driver.field("point_z"), "-7")
    window.viewport.setFocus()
    driver.keys("Ctrl+A")
    driver.keys("Ctrl+I")
    (root,) = driver.document.solids
    assert isinstance(root, Intersection) and isinstance(root.children[0], Union)
    driver.settle()
    measures = window.evaluation.latest.solids[root.id].measures
    assert measures.bounds[0][2] == pytest.approx(-7) and measures.genus == 0
    assert len(window.session.log) > 10 and window.script.toPlainText().count("\n") == len(window.session.log) - 1


def test_an_expression_is_typed_and_its_value_stands_beside_it(driver):
    driver.keys("Shift+S")
    driver.session.do("set_parameter", "width", 30.0)
    field = driver.field("radius")
    driver.type_into(field, "width / 2 + 3 mm")
    assert driver.node("Sphere").radius.text == "width / 2 + 3 mm"
    assert field.parentWidget().unit.text() == "= 18 mm"
    driver.session.do("set_parameter", "width", 10.0)
    assert field.parentWidget().unit.text() == "= 8 mm"


@pytest.mark.parametrize(
    ("typed", "words"),
    [("-1", "above 0"), ("1 /", "cannot be read"), ("nan", "finite"), ("1 / 0", "zero"), ("wide", "no parameter")],
)
def test_a_bad_value_is_refused_in_words_and_the_document_stays(driver, typed, words):
    driver.keys("Shift+S")
    before = driver.document
    field = driver.field("radius")
    driver.type_into(field, typed)
    assert driver.document is before
    assert words in field.parentWidget().fault.text() and field.property("fault")
    driver.keys("Escape", field)
    assert field.text() == "10" and not field.parentWidget().fault.isVisible()
    assert driver.document is before


def test_keys_step_a_field_and_one_press_is_one_step_of_the_history(driver):
    driver.keys("Shift+S")
    field = driver.field("radius")
    driver.qtbot.mouseClick(field, Qt.MouseButton.LeftButton)
    before = driver.document
    driver.keys("Up", field)
    driver.keys("Shift+Up", field)
    assert driver.node("Sphere").radius == 11.1
    driver.keys("Ctrl+Z", field)
    driver.keys("Ctrl+Z", field)
    assert driver.document is before and field.text() == "10"


def test_a_label_is_dragged_with_one_step_and_escape_takes_it_back(driver):
    driver.keys("Shift+S")
    before = driver.document
    label = driver.field("radius").parentWidget().label
    press, move, release = driver.qtbot.mousePress, driver.qtbot.mouseMove, driver.qtbot.mouseRelease
    press(label, Qt.MouseButton.LeftButton, pos=QPoint(10, 5))
    for x in (18, 30, 50):
        move(label, QPoint(x, 5))
    assert driver.session.previewing and driver.document.solids[0].radius == 20
    driver.keys("Escape", label)
    assert driver.document is before and not driver.session.previewing
    press(label, Qt.MouseButton.LeftButton, pos=QPoint(10, 5))
    move(label, QPoint(18, 5))
    release(label, Qt.MouseButton.LeftButton, pos=QPoint(18, 5))
    assert driver.node("Sphere").radius == 12 and driver.session.undo_label == "Change radius"
    driver.keys("Ctrl+Z")
    assert driver.document is before


def test_letters_typed_into_fields_are_no_shortcuts(driver):
    driver.keys("Shift+B")
    name = driver.child(QLineEdit, "name")
    driver.type_into(name, "BH 0 Shaft")
    assert driver.document.solids[0].name == "BH 0 Shaft" and kinds(driver.document) == ["Box"]
    assert driver.document.solids[0].visible


def test_visibility_colour_and_note_of_several(driver):
    driver.keys("Shift+B")
    driver.keys("Shift+S")
    driver.keys("Ctrl+A")
    colour = driver.child(QLineEdit, "colour")
    driver.type_into(colour, "steelblue")
    assert {root.colour for root in driver.document.solids} == {"#4682b4"}
    before = driver.document
    driver.type_into(colour, "greenish")
    assert driver.document is before and colour.property("fault")
    driver.window.viewport.setFocus()
    driver.keys("H")
    assert not any(root.visible for root in driver.document.solids)
    driver.settle()
    assert not driver.window.viewport.viewer.scene.meshes


def test_greyed_commands_say_why(driver):
    action = driver.window.actions_["union"]
    assert not action.isEnabled() and "select a node first" in action.toolTip()
    driver.keys("Shift+B")
    assert action.isEnabled() and "Ctrl+U" in action.toolTip() and "Not now" not in action.toolTip()
    assert {command.name for command in DOCUMENT_COMMANDS} <= {c.name for c in driver.window.actions_.commands()}
    for command in driver.window.actions_.commands():
        assert command.tip or command.name in driver.window.actions_["palette"].text(), command.name


def test_the_palette_finds_and_runs(driver):
    driver.keys("Ctrl+K")
    palette = driver.window.palette_
    driver.qtbot.waitUntil(palette.isVisible)
    driver.write("torus", palette.field)
    driver.keys("Return", palette.field)
    assert kinds(driver.document) == ["Torus"] and not palette.isVisible()
    driver.keys("Ctrl+K")
    driver.write("unlink", palette.field)
    driver.keys("Return", palette.field)
    assert palette.isVisible() and kinds(driver.document) == ["Torus"]
    driver.keys("Escape", palette.field)
    assert not palette.isVisible()


def test_styles_and_projection_are_switches(driver):
    driver.keys("Shift+B")
    driver.keys("Alt+4")
    viewer = driver.window.viewport.viewer
    assert viewer.scene.style == "hidden-line"
    assert driver.window.actions_["style_hidden-line"].isChecked()
    assert not driver.window.actions_["style_edges"].isChecked()
    driver.keys("P")
    assert viewer.camera.parallel and not driver.window.actions_["perspective"].isChecked()
    driver.keys("G")
    assert not driver.window.actions_["grid"].isChecked()


def test_themes(driver):
    for name in ("dark", "light", "system"):
        driver.window.actions_.run(f"theme_{name}")
        assert driver.window.theme.choice == name
        assert driver.window.actions_[f"theme_{name}"].isChecked()
        assert driver.window.viewport.viewer.scene.look.name == driver.window.theme.name


def test_problems_are_listed_and_select_their_node(driver):
    driver.open(Document(solids=(Box(id="a", name="a"), Halfspace(id="b", name="b"))))
    problems = driver.window.problems
    driver.qtbot.waitUntil(lambda: problems.list.count() == 1)
    assert driver.window.docks["Problems"].windowTitle() == "Problems (1)"
    assert "a" in driver.window.viewport.viewer.scene.meshes
    driver.window.docks["Problems"].raise_()
    driver.qtbot.waitUntil(problems.list.isVisible)
    place = problems.list.visualItemRect(problems.list.item(0)).center()
    driver.qtbot.mouseClick(problems.list.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert driver.session.selection == ("b",)
    driver.window.tree.setFocus()
    driver.keys("Delete", driver.window.tree)
    driver.settle()
    driver.qtbot.waitUntil(lambda: driver.window.docks["Problems"].windowTitle() == "Problems")


def test_save_open_and_the_title(driver, tmp_path):
    driver.keys("Shift+B")
    assert driver.window.isWindowModified() and driver.window.windowTitle().startswith("Untitled[*]")
    path = tmp_path / "part.solidtree"
    driver.window.files.write(path)
    driver.qtbot.waitUntil(path.exists)
    driver.qtbot.waitUntil(lambda: not driver.window.isWindowModified())
    assert driver.window.windowTitle().startswith("part[*]") and driver.window.settings.recent == [str(path)]
    driver.keys("Shift+S")
    driver.keys("Ctrl+S")
    driver.qtbot.waitUntil(lambda: not driver.window.isWindowModified())
    driver.keys("Ctrl+N")
    assert not driver.document.solids and driver.window.welcome.isVisible()
    driver.window.files.open(path)
    driver.qtbot.waitUntil(lambda: len(driver.document.solids) == 2)
    assert not driver.window.isWindowModified()
    driver.settle()


def message(driver) -> QMessageBox:
    driver.qtbot.waitUntil(lambda: any(isinstance(w, QMessageBox) for w in QApplication.topLevelWidgets()))
    return next(w for w in QApplication.topLevelWidgets() if isinstance(w, QMessageBox))


def test_a_bad_file_is_a_calm_message_and_the_document_stays(driver, tmp_path):
    driver.keys("Shift+B")
    driver.session.mark_saved(driver.document)
    before = driver.document
    path = tmp_path / "broken.solidtree"
    path.write_bytes(b"not a zip")
    driver.window.files.open(path)
    box = message(driver)
    assert "broken.solidtree" in box.text() and box.informativeText()
    driver.qtbot.keyClick(box, Qt.Key.Key_Escape)
    assert driver.document is before


def test_closing_with_changes_asks(driver):
    driver.keys("Shift+B")
    driver.window.close()
    box = message(driver)
    assert driver.window.isVisible()
    driver.qtbot.mouseClick(box.button(QMessageBox.StandardButton.Cancel), Qt.MouseButton.LeftButton)
    assert driver.window.isVisible()
    driver.window.close()
    box = message(driver)
    driver.qtbot.mouseClick(box.button(QMessageBox.StandardButton.Discard), Qt.MouseButton.LeftButton)
    driver.qtbot.waitUntil(lambda: not driver.window.isVisible())


def test_export_by_the_dialog(driver, tmp_path):
    driver.keys("Shift+B")
    driver.keys("Ctrl+E")
    dialog = next(w for w in QApplication.topLevelWidgets() if isinstance(w, ExportDialog))
    dialog.tolerance.setText("0")
    dialog.accept()
    assert "above 0" in dialog.fault.text() and dialog.isVisible()
    dialog.tolerance.setText("0.1 mm")
    dialog.path.setText(str(tmp_path / "box.stl"))
    dialog.path.textEdited.emit(dialog.path.text())
    assert dialog.format.currentData() == "stl"
    with driver.qtbot.waitSignal(driver.window.evaluation.jobs.exported, timeout=20000) as told:
        dialog.accept()
    assert told.args[1] == "" and (tmp_path / "box.stl").stat().st_size == 84 + 12 * 50


def test_import_adds_and_can_be_undone(driver, tmp_path):
    path = tmp_path / "tetra.off"
    path.write_text("OFF\n4 4 6\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    driver.keys("Shift+B")
    before = driver.document
    driver.window.files.drop([path])
    driver.qtbot.waitUntil(lambda: len(driver.document.solids) == 2)
    driver.settle()
    assert driver.window.evaluation.latest.solids[driver.document.solids[1].id].measures.volume == pytest.approx(121.5)
    driver.window.viewport.setFocus()
    driver.keys("Ctrl+Z")
    assert driver.document is before


def test_every_example_opens_without_problems(driver):
    assert "dumbbell" in example_names()
    for name in example_names():
        with driver.qtbot.waitSignal(driver.window.files.opened):
            open_example(driver.window, name)
        driver.settle(60000)
        assert not [p for p in driver.window.evaluation.latest.problems if p.error], name
        assert driver.window.files.path is None


def test_measures_are_copied(driver):
    driver.keys("Shift+B")
    driver.settle()
    view = driver.child(MeasuresView, "measures_of_solid")
    driver.qtbot.mouseClick(view.copy_button, Qt.MouseButton.LeftButton)
    assert "Volume\t8000\tmm³" in QGuiApplication.clipboard().text()


def test_the_layout_is_kept(make_window):
    first = make_window()
    first.window.resize(1100, 700)
    first.window.findChild(type(first.window.docks["Problems"]), "dock_script").hide()
    first.window.close()
    second = make_window()
    assert second.window.size().width() == 1100
    assert second.window.findChild(type(first.window.docks["Problems"]), "dock_script").isHidden()


def test_a_field_that_was_left_commits_before_the_next_command(driver):
    driver.keys("Shift+S")
    field = driver.field("radius")
    driver.qtbot.mouseClick(field, Qt.MouseButton.LeftButton)
    driver.keys("Ctrl+A", field)
    driver.write("7", field)
    driver.keys("Ctrl+U", field)
    (root,) = driver.document.solids
    assert isinstance(root, Union) and root.children[0].radius == 7


def test_fields_of_every_kind_have_a_form(driver):
    from solidtree.model.document.nodes import KINDS, Broken, Instance, Node

    ball = Sphere(radius=3)
    for kind in KINDS.values():
        if kind in (Node, Broken, Instance):
            continue
        few = kind.operands[0]
        node = kind(id="x", name="x", children=tuple(ball.with_(id=f"ball{i}") for i in range(few)))
        driver.session.open(Document(solids=(node,)))
        driver.session.select(["x"])
        assert driver.window.properties.widget().findChild(QLineEdit, "name").text() == "x"


def test_half_spaces_and_cylinders_have_their_icons():
    from solidtree.gui.icons import kind_icon
    from solidtree.model.document.nodes import KINDS, Broken, Node

    missing = [kind.__name__ for kind in KINDS.values() if kind not in (Node, Broken) and kind_icon(kind).isNull()]
    assert not missing
    assert not kind_icon(Cylinder).isNull()


def heavy() -> Document:
    """A rounded sieve that takes seconds."""
    from solidtree.model.document.nodes import Minkowski

    holes = tuple(Cylinder(radius=3, height=50).at(6 + 8 * i, 6 + 8 * j, -10) for i in range(7) for j in range(4))
    sieve = Difference(children=(Box(size=(60, 40, 20)), *holes))
    return Document(solids=(Minkowski(id="m", name="slow", children=(sieve, Sphere(radius=2, segments=48))),))


def test_a_long_evaluation_is_told_and_cancelled(driver):
    driver.keys("Shift+B")
    driver.settle()
    shown = driver.window.evaluation.latest
    driver.session.commit("slow", heavy())
    status = driver.window.status
    driver.qtbot.waitUntil(status.busy.isVisible)
    assert driver.window.actions_["cancel"].isEnabled()
    driver.qtbot.mouseClick(status.cancel, Qt.MouseButton.LeftButton)
    assert not status.busy.isVisible() and not driver.window.evaluation.waiting
    assert driver.window.evaluation.latest is shown and status.time.text() == "out of date"
    driver.keys("Ctrl+Z", driver.window.viewport)
    driver.settle()
    assert "ms" in status.time.text() and driver.window.viewport.viewer.scene.meshes


def test_previewed_colours_are_painted_and_not_evaluated(driver):
    from solidtree.model.operations.operations import OPERATIONS

    driver.keys("Shift+B")
    driver.settle()
    driver.session.preview(OPERATIONS["set_colour"](driver.document, ["n1"], "#ff0000"))
    assert not driver.window.evaluation.waiting
    driver.session.cancel()


def test_an_unexpected_error_is_told_calmly(driver, capsys, monkeypatch):
    import sys

    from solidtree.gui.application import install_hook

    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    install_hook(driver.window)
    try:
        raise KeyError("planted")
    except KeyError as error:
        sys.excepthook(KeyError, error, error.__traceback__)
    (dialog,) = [w for w in QApplication.topLevelWidgets() if w.objectName() == "report"]
    assert "planted" in capsys.readouterr().err and driver.window.isVisible()
    dialog.close()


def test_what_is_edited_while_a_file_opens_is_asked_about(driver, tmp_path):
    save(tmp_path / "other.solidtree", saved=Box())
    driver.window.files.read(tmp_path / "other.solidtree")
    driver.session.do("insert", Sphere())  # before the answer of the reading thread can come
    box = message(driver)
    driver.qtbot.mouseClick(box.button(QMessageBox.StandardButton.Cancel), Qt.MouseButton.LeftButton)
    assert [root.kind for root in driver.document.solids] == ["Sphere"] and driver.session.modified


def test_what_is_edited_while_a_file_is_saved_is_asked_about(driver, tmp_path):
    files = driver.window.files
    driver.session.do("insert", Box())
    files.write(tmp_path / "first.solidtree", then=lambda: files._show(Document(), None))
    driver.session.do("insert", Sphere())
    box = message(driver)
    driver.qtbot.mouseClick(box.button(QMessageBox.StandardButton.Cancel), Qt.MouseButton.LeftButton)
    assert len(driver.document.solids) == 2 and driver.session.modified


def test_a_slow_save_does_not_give_its_path_to_the_next_document(driver, tmp_path):
    files = driver.window.files
    driver.session.do("insert", Box())
    files.write(tmp_path / "first.solidtree")
    files._show(Document(), None)
    driver.qtbot.waitUntil(lambda: (tmp_path / "first.solidtree").exists() and not files.background.working)
    assert files.path is None
