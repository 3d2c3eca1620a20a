"""The form of an outline, profiles in the tree, and the commands that make solids of them."""

from PySide6.QtWidgets import QCheckBox, QLabel

from solidtree.model.document.document import Document
from solidtree.model.document.outlines import Path, Rectangle
from solidtree.model.script import bezier, box, bspline, document_of, path, rectangle

pytest_plugins = ["window_driver"]
KEYHOLE = path("M0 0H10V10H0Z M2 2H8V8H2Z").named("keyhole")


def texts(driver):
    return [label.text() for label in driver.window.properties.findChildren(QLabel)]


def words(driver, name):
    return driver.child(QLabel, f"outline_{name}").text()


def test_a_form_tells_figures_instead_of_letters(driver):
    driver.open(document_of(box(1), KEYHOLE, bezier([(0, 0), (5, 10), (10, 0)], weights=[1, 2, 1])))
    driver.click_row(driver.node("keyhole"))
    assert words(driver, "length") == "64 mm" and words(driver, "area") == "100 mm²"
    assert "8 in 2 contours" in texts(driver) and not any("ML" in text for text in texts(driver))
    driver.child(QCheckBox, "even_odd").click()
    assert words(driver, "area") == "64 mm²"
    driver.click_row(driver.node("Bezier curve"))
    assert "3, 1 to 2" in texts(driver) and words(driver, "area") == "\u2013"
    assert "Measures of the node" not in texts(driver)


def test_outlines_stand_in_the_tree_after_the_solids_and_become_solids_by_a_key(driver):
    driver.open(document_of(rectangle(4, 5).named("plate"), bspline([(0, 0)]).named("broken"), box(1).named("block")))
    assert [row.node.name for row in driver.window.tree.nodes.top_rows()] == ["block", "plate", "broken"]
    assert [problem.name for problem in driver.window.evaluation.latest.problems] == ["broken"]
    before = driver.document
    driver.click_row(driver.node("plate"))
    driver.keys("Shift+E")
    driver.settle()
    assert [row.node.label for row in driver.window.tree.nodes.top_rows()] == ["block", "Extrusion", "broken"]
    solid = driver.document.solids[1]
    assert driver.window.session.selection == (solid.id,)
    assert abs(driver.window.evaluation.latest.solids[solid.id].measures.volume - 200) < 1e-9
    driver.keys("Ctrl+Z")
    assert driver.document is before
    driver.click_row(driver.node("block"))
    assert not driver.window.actions_["extrude"].isEnabled()
    driver.click_row(driver.node("plate"))
    driver.keys("Ctrl+R")
    assert driver.document.solids[-1].kind == "Revolve"


def test_hover_tells_an_outline_without_facets(driver):
    driver.open(Document(profiles=(Rectangle(id="n1", name="Plate", width=30.0, height=20.0),)))
    driver.look_from("top")
    driver.qtbot.mouseMove(driver.window.viewport, driver.pixel_of((2, 2, 0)))
    hover = driver.window.status.hover
    driver.qtbot.waitUntil(lambda: "Plate" in hover.text())
    assert "facet" not in hover.text() and "e-" not in hover.text()


def test_the_curve_panel_says_why_an_outline_cannot_be_edited(driver):
    words = driver.window.curve_panel.words
    wrong = Path(id="n1", name="Wrong", points=((0, 0), (5, 0), (5, 5)), segments="MXL", joints="ccc")
    driver.open(Document(profiles=(wrong,)))
    assert words.text().startswith("Select an outline")
    driver.session.select(["n1"])
    assert "X” is no segment" in words.text()
    driver.session.select([])
    assert words.text().startswith("Select an outline")
