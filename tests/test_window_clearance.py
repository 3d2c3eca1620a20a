"""The Clearance panel in the real window: pairs are listed, shown, told what is asked of them, and looked at again."""

import csv
import io

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QInputDialog, QMenu
from replay import replayed

from solidtree.model.document.table import same_document
from solidtree.model.script import box, document_of, sphere

pytest_plugins = ["window_driver"]

LEFT = Qt.MouseButton.LeftButton


def assembly():
    """A base with a lid 0.3 mm above it, a pin 2 mm deep in it, a foot that touches it, and a ball far away."""
    return document_of(
        base=box(40, 40, 10),
        lid=box(40, 40, 3).at(0, 0, 10.3),
        pin=box(4, 4, 4).at(10, 10, -2),
        foot=box(6, 6, 5).at(30, 30, -5),
        ball=sphere(5).at(90),
    )


def settled(driver):
    driver.qtbot.waitUntil(lambda: driver.window.clearance.checks.settled, timeout=20000)
    driver.settle()


@pytest.fixture
def checked(make_window):
    driver = make_window(assembly())
    driver.keys("Ctrl+Alt+K", driver.window.viewport)
    settled(driver)
    return driver


def listed(driver):
    return [(row.names, row.fault) for row in driver.window.clearance.page.table.listed.rows]


def click(driver, number):
    table = driver.window.clearance.page.table
    index = table.model().index(number, 0)
    table.scrollTo(index)
    driver.qtbot.mouseClick(table.viewport(), LEFT, pos=table.visualRect(index).center())


def ask(driver, text):
    field = driver.window.clearance.page.clearance
    field.setFocus()
    field.selectAll()
    driver.qtbot.keyClicks(field, text)
    driver.qtbot.keyClick(field, Qt.Key.Key_Return)
    settled(driver)


def test_pairs_come_worst_first_and_follow_the_clearance(checked):
    page = checked.window.clearance.page
    assert listed(checked) == [(("base", "pin"), "overlap")]
    assert page.table.listed.rows[0].overlap == pytest.approx(4 * 4 * 2)
    ask(checked, "0.5")
    assert checked.document.checks.clearance == 0.5
    assert listed(checked) == [
        (("base", "pin"), "overlap"), (("base", "foot"), "near"), (("base", "lid"), "near"),
    ]  # fmt: skip
    assert "10 pairs of 5 solids" in page.told.text() and "2 are too near" in page.told.text()
    checked.keys("Ctrl+Z", checked.window.viewport)
    settled(checked)
    assert checked.document.checks.clearance == 0 and len(listed(checked)) == 1 and page.clearance.text() == "0"


def test_a_row_flies_there_with_the_others_faint_and_escape_takes_it_away(checked):
    ask(checked, "0.5")
    window, panel = checked.window, checked.window.clearance
    click(checked, 2)
    finding = panel.page.table.current
    assert finding.names == ("base", "lid")
    middle = finding.bounds.mean(axis=0)
    viewer = window.viewport.viewer
    checked.qtbot.waitUntil(lambda: np.allclose(viewer.camera.target, middle, atol=1e-6))
    ids = {root.name: root.id for root in checked.document.solids}
    assert viewer.scene.faded == {ids["pin"], ids["foot"], ids["ball"]}
    assert panel.picture.chosen is finding and np.ptp(finding.points[:, 2]) == pytest.approx(0.3)
    checked.qtbot.keyClick(panel.page.table, Qt.Key.Key_Escape)
    assert panel.picture.chosen is None and not viewer.scene.faded
    click(checked, 0)
    body = panel.picture.chosen.body
    assert np.ptp(body.vertices, axis=0) == pytest.approx((4, 4, 2))
    window.docks["Problems"].raise_()
    checked.qtbot.waitUntil(lambda: not panel.in_front)
    assert panel.picture.chosen is None and not viewer.scene.faded


def test_what_is_meant_to_touch_is_no_fault_until_it_is_apart(checked):
    ask(checked, "0.5")
    panel, start = checked.window.clearance, checked.document
    click(checked, 1)
    checked.qtbot.keyClick(panel.page.table, Qt.Key.Key_T)
    settled(checked)
    ids = {root.name: root.id for root in checked.document.solids}
    assert [pair.touching for pair in checked.document.checks.pairs] == [True]
    assert (("base", "foot"), "near") not in listed(checked)
    assert panel.page.rules.topLevelItem(0).text(0) == "base and foot"
    checked.session.do("move", [ids["foot"]], 0, 0, -1)
    settled(checked)
    assert (("base", "foot"), "parted") in listed(checked)
    checked.window.actions_.run("undo")
    checked.window.actions_.run("undo")
    settled(checked)
    assert checked.document is start and (("base", "foot"), "near") in listed(checked)
    assert panel.page.rules.isHidden()


def test_a_pair_gets_a_clearance_of_its_own_and_loses_it(checked):
    ask(checked, "0.5")
    panel = checked.window.clearance
    click(checked, 2)
    checked.qtbot.keyClick(panel.page.table, Qt.Key.Key_C)
    dialog = checked.window.findChild(QInputDialog)
    assert "“base” and “lid”" in dialog.labelText()
    dialog.setTextValue("0.2")
    dialog.accept()
    settled(checked)
    assert (("base", "lid"), "near") not in listed(checked)
    rules = panel.page.rules
    rules.setCurrentItem(rules.topLevelItem(0))
    checked.qtbot.keyClick(rules, Qt.Key.Key_Delete)
    settled(checked)
    assert (("base", "lid"), "near") in listed(checked) and not checked.document.checks.pairs


def test_the_list_follows_a_part_that_is_moved_and_keeps_the_chosen_pair(checked):
    ask(checked, "0.5")
    click(checked, 2)
    ids = {root.name: root.id for root in checked.document.solids}
    checked.session.do("move", [ids["pin"]], 0, 0, -20)
    checked.session.do("insert", box(2).at(50).named("late"), label="Add box")
    settled(checked)
    late = checked.node("late").id
    assert checked.window.viewport.viewer.scene.faded == {ids["pin"], ids["foot"], ids["ball"], late}
    checked.session.do("delete", [late])
    settled(checked)
    assert listed(checked) == [(("base", "foot"), "near"), (("base", "lid"), "near")]
    assert checked.window.clearance.page.table.current.names == ("base", "lid")
    checked.session.do("move", [ids["foot"]], 0, 0, -20)
    checked.session.do("move", [ids["lid"]], 0, 0, 20)
    settled(checked)
    page = checked.window.clearance.page
    assert "all in order" in page.told.text() and page.table.isHidden()


def test_the_command_of_two_selected_solids_and_the_echo_replay(checked):
    window = checked.window
    ids = {root.name: root.id for root in checked.document.solids}
    before, steps = checked.document, len(checked.session.log)
    checked.session.select([ids["base"], ids["foot"]])
    window.actions_.run("meant_to_touch")
    ask(checked, "0.4")
    assert window.actions_["meant_to_touch"].isChecked()
    assert same_document(replayed(checked.session.log[steps:], before), checked.document)
    window.actions_.run("meant_to_touch")
    assert not checked.document.checks.pairs
    checked.session.select([ids["base"]])
    assert not window.actions_["meant_to_touch"].isEnabled()


def chosen_from_menu(driver, number, words):
    """Choose from the menu of a row, as a right click opens it."""
    table = driver.window.clearance.page.table
    table.customContextMenuRequested.emit(table.visualRect(table.model().index(number, 0)).center())
    menu = next(menu for menu in table.findChildren(QMenu) if menu.isVisible())
    action = next(action for action in menu.actions() if action.text().startswith(words))
    driver.qtbot.mouseClick(menu, LEFT, pos=menu.actionGeometry(action).center())


def test_the_menu_of_a_row_and_its_keys_reach_both_solids(checked):
    ask(checked, "0.5")
    session, panel = checked.session, checked.window.clearance
    ids = {root.name: root.id for root in checked.document.solids}
    click(checked, 0)
    checked.qtbot.keyClick(panel.page.table, Qt.Key.Key_S)
    assert set(session.selection) == {ids["base"], ids["pin"]}
    chosen_from_menu(checked, 2, "Show these two alone")
    assert set(session.isolated) == {ids["base"], ids["lid"]}
    checked.qtbot.keyClick(panel.page.table, Qt.Key.Key_I)
    assert set(session.isolated) == {ids["base"], ids["pin"]}
    checked.qtbot.keyClick(panel.page.table, Qt.Key.Key_I)
    assert not session.isolated
    session.do("check_pair", ids["base"], ids["lid"], clearance=0.4)
    settled(checked)
    chosen_from_menu(checked, 2, "As all others")
    assert not checked.document.checks.pairs
    chosen_from_menu(checked, 1, "Meant to touch")
    settled(checked)
    assert (("base", "foot"), "near") not in listed(checked)


def test_rows_are_sorted_by_a_click_on_a_title(checked):
    ask(checked, "0.5")
    header = checked.window.clearance.page.table.horizontalHeader()
    at = QPoint(header.sectionViewportPosition(1) + 20, header.height() // 2)
    checked.qtbot.mouseClick(header.viewport(), LEFT, pos=at)
    assert [names[1] for names, _ in listed(checked)] == ["foot", "lid", "pin"]
    checked.qtbot.mouseClick(header.viewport(), LEFT, pos=at)
    assert [names[1] for names, _ in listed(checked)] == ["pin", "lid", "foot"]


def test_a_check_that_is_given_up_leaves_the_last_list_and_the_document(checked):
    page, checks, document = checked.window.clearance.page, checked.window.clearance.checks, checked.document
    before = listed(checked)
    checked.qtbot.mouseClick(page.check, LEFT)
    assert checks.at_work and page.working.cancel.isVisible()
    checked.qtbot.mouseClick(page.working.cancel, LEFT)
    assert not checks.at_work and not page.working.cancel.isVisible()
    assert checked.document is document and listed(checked) == before
    checked.qtbot.mouseClick(page.check, LEFT)
    settled(checked)
    assert listed(checked) == before and not page.working.cancel.isVisible()


def test_nothing_to_check_is_said(make_window):
    driver = make_window(document_of(alone=box(3)))
    driver.keys("Ctrl+Alt+K", driver.window.viewport)
    settled(driver)
    page = driver.window.clearance.page
    assert page.told.text() == "A check takes two visible solids, and there is one." and not page.out.isEnabled()


def test_what_is_no_clearance_is_refused(checked):
    ask(checked, "-3")
    assert checked.document.checks.clearance == 0
    assert "0 mm or more" in checked.window.statusBar().currentMessage()


def test_the_list_is_copied_and_the_report_written(checked, tmp_path):
    checked.window.clearance.page.table.copy(",")
    rows = list(csv.reader(io.StringIO(QGuiApplication.clipboard().text())))
    assert rows[1][:3] == ["base", "pin", "Overlap"]
    out = tmp_path / "report.html"
    checked.window.clearance.write_report(str(out))
    checked.qtbot.waitUntil(lambda: not checked.window.clearance.reporting.at_work, timeout=60000)
    assert "overlap by 32 mm³" in out.read_text()
    checked.window.clearance.write_report(str(tmp_path / "no" / "report.html"))
    checked.qtbot.waitUntil(lambda: not checked.window.clearance.reporting.at_work, timeout=60000)
    assert "was not written" in checked.window.statusBar().currentMessage()


def test_what_was_typed_and_refused_gives_way_to_another_document(checked):
    ask(checked, "abc")
    field = checked.window.clearance.page.clearance
    assert field.text() == "abc"
    checked.open(document_of(one=box(1), two=box(1).at(5)))
    settled(checked)
    assert field.text() == "0"
    ask(checked, "abc")
    checked.session.do("set_clearance", 0.5)
    assert field.text() == "0.5"


def test_a_window_closes_while_a_report_is_written(checked, tmp_path):
    out = tmp_path / "report.html"
    checked.window.clearance.write_report(str(out))
    assert checked.window.clearance.page.writing.isVisible()
    checked.window.close()
    assert not checked.window.clearance.reporting.at_work and not out.exists()
