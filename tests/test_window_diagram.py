"""The diagram panel: it follows the session, and clicks and drops in it go to the session."""

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QDragEnterEvent, QDragMoveEvent, QDropEvent
from PySide6.QtWidgets import QApplication

from solidtree.gui.tree.drops import dragged
from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Difference, Union
from solidtree.model.document.primitives import Box, Cylinder, Sphere
from solidtree.model.document.tree import find

pytest_plugins = ["window_driver"]
LEFT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton
MOVE, COPY = Qt.DropAction.MoveAction, Qt.DropAction.CopyAction


def model() -> Document:
    part = Difference(id="part", name="part", children=(Box(id="cube", name="cube"), Cylinder(id="hole", name="hole")))
    return Document(solids=(part, Sphere(id="ball", name="ball")))


def opened(driver, document: Document):
    driver.open(document)
    driver.keys("Ctrl+T")
    diagram = driver.window.diagram
    driver.qtbot.waitUntil(lambda: diagram.in_front and bool(diagram.shown.items))
    return diagram


def leaves(diagram) -> list[str]:
    return [item.node_id for item in diagram.shown.items if item.role == "leaf"]


def test_it_follows_the_session_and_lays_out_only_what_changed(driver):
    diagram = opened(driver, model())
    assert leaves(diagram) == ["cube", "hole", "ball"]
    kept = {root: part[4] for root, part in diagram._parts.items()}
    driver.session.do("insert", Sphere(name="new"), "part", 1)
    assert leaves(diagram) == ["cube", driver.node("new").id, "hole", "ball"]
    assert diagram._parts["ball"][4] is kept["ball"] and diagram._parts["part"][4] is not kept["part"]
    driver.keys("Ctrl+T", diagram)
    driver.qtbot.waitUntil(lambda: not diagram.in_front)
    driver.session.undo()
    assert len(leaves(diagram)) == 4  # nobody looks at it
    driver.keys("Ctrl+T", driver.window.tree)
    driver.qtbot.waitUntil(lambda: diagram.in_front)
    assert leaves(diagram) == ["cube", "hole", "ball"]


def test_clicks_and_keys_select(driver):
    diagram = opened(driver, model())
    driver.qtbot.mouseClick(diagram, LEFT, pos=diagram.place_of("hole"))
    assert driver.session.selection == ("hole",)
    driver.qtbot.mouseClick(diagram, LEFT, Qt.KeyboardModifier.ControlModifier, diagram.place_of("cube"))
    assert driver.session.selection == ("hole", "cube")
    driver.keys("Up", diagram)
    assert driver.session.selection == ("part",)
    driver.keys("Down", diagram)
    driver.keys("Right", diagram)
    assert driver.session.selection == ("hole",)
    picture = diagram.grab().toImage()
    plain = picture.pixelColor(diagram.place_of("cube") + QPoint(-25, 0)).name()
    assert picture.pixelColor(diagram.place_of("hole") + QPoint(-25, 0)).name() != plain
    driver.qtbot.mouseClick(diagram, LEFT, pos=QPoint(3, diagram.height() - 3))
    assert driver.session.selection == ()


def test_wheel_and_drag_move_the_sheet_and_a_double_click_fits_it(driver):
    diagram = opened(driver, model())
    before = diagram.place_of("hole")
    gap = before - diagram.place_of("cube")
    diagram.zoom(2.0, QPointF(before))
    before = diagram.place_of("hole")
    assert (before - diagram.place_of("cube") - 2 * gap).manhattanLength() <= 3
    start = QPoint(4, diagram.height() - 30)
    driver.qtbot.mousePress(diagram, MIDDLE, pos=start)
    driver.qtbot.mouseMove(diagram, start + QPoint(30, -20))
    driver.qtbot.mouseRelease(diagram, MIDDLE, pos=start + QPoint(30, -20))
    assert diagram.place_of("hole") == before + QPoint(30, -20)
    driver.qtbot.mouseDClick(diagram, LEFT, pos=QPoint(3, diagram.height() - 3))
    assert (diagram.place_of("hole") - diagram.place_of("cube") - gap).manhattanLength() <= 2


def test_a_wide_operation_opens_with_a_click(driver):
    many = Union(id="many", name="many", children=tuple(Box(id=f"b{i}") for i in range(40)))
    diagram = opened(driver, Document(solids=(many,)))
    (fold,) = (item for item in diagram.shown.items if item.role == "fold")
    middle = QPointF(fold.x, fold.y + fold.height / 2) * diagram._scale + diagram._corner
    driver.qtbot.mouseClick(diagram, LEFT, pos=middle.toPoint())
    assert len(leaves(diagram)) == 40 and driver.session.selection == ()


def test_nodes_are_dropped_onto_operations_and_beside_leaves(driver):
    diagram = opened(driver, model())
    data = dragged(driver.session, ["ball"])

    def drop(point: QPoint) -> None:
        for event in (
            QDragEnterEvent(point, MOVE | COPY, data, LEFT, Qt.KeyboardModifier.NoModifier),
            QDragMoveEvent(point, MOVE | COPY, data, LEFT, Qt.KeyboardModifier.NoModifier),
            QDropEvent(QPointF(point), MOVE | COPY, data, LEFT, Qt.KeyboardModifier.NoModifier),
        ):
            QApplication.sendEvent(diagram, event)

    drop(diagram.place_of("part"))
    assert [child.id for child in find(driver.document, "part").children] == ["cube", "hole", "ball"]
    drop(diagram.place_of("cube") + QPoint(-6, 0))
    assert [child.id for child in find(driver.document, "part").children] == ["ball", "cube", "hole"]
