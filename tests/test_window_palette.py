"""Finding commands, nodes and parameters; changing shortcuts; the menu of the space bar."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from solidtree.gui.palette.cheat_sheet import CheatSheet
from solidtree.gui.palette.shortcuts import Shortcuts
from solidtree.gui.tools.tool_menu import ToolMenu, letters_for
from solidtree.model.document.document import Document, Parameter
from solidtree.model.script import box, cylinder, document_of

pytest_plugins = ["window_driver"]


def rows(palette):
    return [palette.rows.entry(row) for row in range(palette.rows.rowCount())]


@pytest.fixture
def palette(driver):
    driver.keys("Ctrl+K")
    driver.qtbot.waitUntil(driver.window.palette_.isVisible)
    yield driver.window.palette_
    driver.window.palette_.close()


def test_every_command_stands_in_the_palette_with_its_keys_and_why_it_is_greyed(driver, palette):
    found = {entry.command: entry for entry in rows(palette) if entry.command}
    actions = driver.window.actions_
    assert found.keys() == {command.name for command in actions.commands()} - {"palette"}
    assert found["union"].fault == "select a node first" and found["union"].keys == "Ctrl+U"
    faults = [bool(entry.fault) for entry in rows(palette)]
    assert faults == sorted(faults)  # what can be used comes first
    driver.write("uni", palette.field)
    assert palette.current.command == "union" and palette.current.places == (0, 1, 2)
    driver.keys("Return", palette.field)
    assert palette.isVisible()  # greyed


def test_the_keyboard_goes_over_headings_and_round(driver, palette):
    driver.window.settings.add_recent_command("grid")
    palette.open()
    first = rows(palette)
    assert first[0].run is None and first[1].command == "grid" and palette.current is first[1]
    driver.keys("Down", palette.field)
    assert palette.current is first[3]  # past the next heading
    driver.keys("Up", palette.field)
    driver.keys("Up", palette.field)
    assert palette.current is first[-1]
    driver.keys("Home", palette.field)
    driver.keys("PageDown", palette.field)
    assert palette.list.currentIndex().row() > 8
    driver.keys("PageUp", palette.field)
    assert palette.current is first[1]
    driver.keys("End", palette.field)
    driver.keys("Down", palette.field)
    assert palette.current is first[1]


def test_what_was_run_comes_first_the_next_time(driver, palette):
    driver.write("torus", palette.field)
    driver.keys("Return", palette.field)
    assert len(driver.document.solids) == 1 and driver.window.settings.recent_commands == ["add_torus"]
    palette.open()
    assert rows(palette)[0].title == "Recently used" and palette.current.command == "add_torus"


def test_nodes_parameters_and_examples_are_found(driver):
    document = document_of(plate=box(9) - cylinder(1, 20).named("drill"))
    driver.open(document.with_(parameters=(Parameter("depth", 3, note="of the pocket"),)))
    palette = driver.window.palette_
    palette.open("@dri")
    assert [entry.title for entry in rows(palette)] == ["Nodes", "drill"]
    driver.keys("Return", palette.field)
    assert driver.session.selection == (driver.node("drill").id,) and not palette.isVisible()
    palette.open("pocket")
    assert palette.current.title == "depth"
    driver.keys("Return", palette.field)
    assert driver.window.parameters.rows["depth"].field.hasFocus()
    palette.open("dumbbell")
    assert palette.current.detail == "Example"
    palette.close()


def test_five_thousand_nodes_are_listed_in_part(driver):
    from solidtree.model.script import union

    one = union(*(box(1).named(f"peg {i}") for i in range(5000)))
    driver.window.evaluation.close()
    driver.session.open(Document(solids=document_of(pegs=one).solids))
    palette = driver.window.palette_
    palette.open("@peg 49")
    assert 10 < palette.rows.rowCount() < 60 and palette.current.title == "peg 49"
    palette.close()


# Shortcuts.


@pytest.fixture
def dialog(driver):
    driver.window.actions_.run("shortcuts")
    found = driver.window.findChild(Shortcuts)
    driver.qtbot.waitUntil(found.isVisible)
    yield found
    for one in driver.window.findChildren(Shortcuts):
        one.close()


def press(driver, dialog, keys):
    dialog.field.setFocus()
    driver.keys(keys, dialog.field)


def test_a_shortcut_is_recorded_and_holds_at_once(driver, dialog):
    actions = driver.window.actions_
    dialog.choose("add_box")
    press(driver, dialog, "Ctrl+B")
    assert actions.keys("add_box") == "Ctrl+B" and "Ctrl+B" in actions["add_box"].toolTip()
    assert driver.window.settings.shortcuts == {"add_box": "Ctrl+B"}
    dialog.close()
    driver.window.activateWindow()
    driver.qtbot.waitUntil(driver.window.isActiveWindow)
    driver.window.viewport.setFocus()
    driver.keys("Shift+B")
    assert not driver.document.solids
    driver.keys("Ctrl+B")
    assert len(driver.document.solids) == 1


def test_a_conflict_is_told_before_it_is_taken(driver, dialog):
    actions = driver.window.actions_
    dialog.choose("fit")
    press(driver, dialog, "H")
    assert dialog.told.text() == "H is “Show or hide”: take it away there?"
    assert actions.keys("fit") == "Home" and actions.keys("toggle_visible") == "H"
    driver.qtbot.mouseClick(dialog.leave, Qt.MouseButton.LeftButton)
    assert not dialog.take.isVisible() and actions.keys("toggle_visible") == "H"
    press(driver, dialog, "H")
    driver.qtbot.mouseClick(dialog.take, Qt.MouseButton.LeftButton)
    assert actions.keys("fit") == "H" and actions.keys("toggle_visible") == ""
    assert driver.window.settings.shortcuts == {"fit": "H", "toggle_visible": ""}
    dialog.choose("toggle_visible")
    driver.qtbot.mouseClick(dialog.reset, Qt.MouseButton.LeftButton)
    assert "take it away there first" in dialog.told.text() and actions.keys("toggle_visible") == ""
    driver.qtbot.mouseClick(dialog.reset_all, Qt.MouseButton.LeftButton)
    assert (actions.keys("fit"), actions.keys("toggle_visible")) == ("Home", "H")
    assert driver.window.settings.shortcuts == {}


def test_keys_of_the_picture_stay_what_they_are(driver, dialog):
    dialog.choose("fit")
    press(driver, dialog, "Space")
    assert "opens the tools at the pointer" in dialog.told.text() and driver.window.actions_.keys("fit") == "Home"


def test_commands_are_found_by_name_and_by_pressing_their_keys(driver, dialog):
    shown = lambda: [item.text(0) for item in dialog._items() if not item.isHidden()]  # noqa: E731
    driver.write("half", dialog.search)
    assert shown() == ["Half-space"]
    dialog.search.clear()
    dialog.pressed.setFocus()
    driver.keys("Ctrl+U", dialog.pressed)
    assert shown() == ["Union"] and dialog.name == "union"
    dialog.pressed.clear()
    dialog.pressed.setFocus()
    driver.keys("Ctrl+F12", dialog.pressed)
    assert shown() == [] and "No command has Ctrl+F12" in dialog.told.text()


def test_own_shortcuts_are_there_the_next_time(driver, make_window):
    driver.window.actions_.set_keys("fit", "Ctrl+Shift+F")
    driver.window.actions_.set_keys("grid", "")
    actions = make_window().window.actions_
    assert actions.keys("fit") == "Ctrl+Shift+F" and actions.keys("grid") == "" and actions.keys("union") == "Ctrl+U"


def test_no_two_commands_have_one_shortcut(driver):
    actions = driver.window.actions_
    keys = [one for command in actions.commands() for one in actions.default_keys(command.name).split("; ") if one]
    assert len(keys) == len(set(keys)), sorted(one for one in keys if keys.count(one) > 1)


def test_the_sheet_of_keys_shows_own_shortcuts(driver):
    from PySide6.QtWidgets import QLabel

    driver.window.actions_.set_keys("fit", "Ctrl+Shift+F")
    driver.keys("F1")
    sheet = driver.window.findChild(CheatSheet)
    driver.qtbot.waitUntil(sheet.isVisible)
    words = {label.text() for label in sheet.findChildren(QLabel)}
    assert {"Ctrl+Shift+F", "Fit all", "Ctrl+U", "Orbit", "Wheel"} <= words and "Home" not in words
    sheet.close()


# The menu of the space bar.


def open_menu(driver) -> ToolMenu:
    driver.window.viewport.setFocus()
    driver.keys("Space")
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, ToolMenu)
    return menu


def titles(menu):
    return [button.text().replace("&", "") for button in menu.buttons]


def test_the_space_bar_offers_what_makes_sense_now(driver):
    menu = open_menu(driver)
    assert "Box" in titles(menu) and "Union" not in titles(menu)
    driver.keys("B", menu)
    assert len(driver.document.solids) == 1 and not menu.isVisible()
    driver.keys("Shift+S")
    driver.keys("Ctrl+A")
    menu = open_menu(driver)
    assert titles(menu)[:3] == ["Union", "Difference", "Intersection"]
    driver.keys("Right", menu)
    driver.keys("Right", menu)
    driver.keys("Return", menu.focusWidget())
    assert [root.kind for root in driver.document.solids] == ["Difference"]
    driver.click_row(driver.document.solids[0])  # the tree has the keys now
    driver.keys("Space")
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, ToolMenu) and "Dissolve" in titles(menu)
    driver.keys("Escape", menu)


def test_what_lies_under_the_pointer_is_meant_where_nothing_is_selected(driver):
    driver.open(document_of(a=box(9, centred=True), b=box(5).at(30)))
    a, b = driver.document.solids
    driver.look_from("top")
    driver.qtbot.mouseMove(driver.window.viewport, driver.pixel_of((0, 0, 4.5)))
    menu = open_menu(driver)
    assert driver.session.selection == (a.id,)
    menu.close()
    driver.session.select([b.id])
    menu = open_menu(driver)
    assert driver.session.selection == (b.id,) and titles(menu)[0] == "Select “a”"
    menu.buttons[0].click()
    assert driver.session.selection == (a.id,)


def test_typing_goes_on_into_the_palette(driver):
    menu = open_menu(driver)
    driver.keys("Space", menu)
    palette = driver.window.palette_
    assert palette.isVisible() and palette.field.text() == "" and not menu.isVisible()
    palette.close()
    menu = open_menu(driver)
    driver.qtbot.keyClick(menu, Qt.Key.Key_At, Qt.KeyboardModifier.ShiftModifier)
    assert palette.isVisible() and palette.field.text() == "@"
    palette.close()


def test_letters_are_given_once_initials_first():
    titles = ["Union", "Undo", "Fit selection", "Size", "Fit"]
    places = letters_for(titles)
    letters = [title[place].lower() for title, place in zip(titles, places, strict=True)]
    assert letters == ["u", "n", "f", "s", "i"] and letters_for(["A", "A"]) == [0, -1]
