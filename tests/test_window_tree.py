"""The model tree and the picture: selection in step, inline rename, eyes, drag and drop, deep trees, picking."""

import pytest
from PySide6.QtCore import QAbstractItemModel, QPoint, QPointF, Qt
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent
from PySide6.QtTest import QAbstractItemModelTester
from PySide6.QtWidgets import QApplication, QLineEdit, QPushButton

from solidtree.gui.tree.drops import dragged
from solidtree.gui.tree.tree_model import EYE, TreeModel
from solidtree.gui.tree.tree_rows import longest_rising, runs
from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Difference, Node, Union
from solidtree.model.document.primitives import Box, Cylinder, Sphere
from solidtree.model.document.tree import find, trail, walk
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import combine, delete, duplicate, relocate, rename

pytest_plugins = ["window_driver"]
CTRL = Qt.KeyboardModifier.ControlModifier
MOVE, COPY = Qt.DropAction.MoveAction, Qt.DropAction.CopyAction


def drilled() -> Document:
    """A cube from 0 to 20 with a hole of radius 5 along z through its middle."""
    cube = Box(id="cube", name="cube", size=(20, 20, 20))
    hole = Cylinder(id="hole", name="hole", radius=5, height=40).at(10, 10, -10)
    return Document(solids=(Difference(id="part", name="part", children=(cube, hole)),))


def test_clicking_the_wall_of_a_hole_selects_the_drill(driver):
    driver.open(drilled())
    driver.look_from("top")
    driver.window.viewport.viewer.set_projection(False)
    driver.click_at((5, 10, 15))  # seen from above, the wall is inside the rim
    assert driver.session.selection == ("hole",)
    tree = driver.window.tree
    assert [tree.nodes.node(i).id for i in tree.selectionModel().selectedRows()] == ["hole"]
    driver.click_at((2, 2, 20))
    assert driver.session.selection == ("cube",)
    driver.click_at((5, 10, 15), CTRL)
    assert driver.session.selection == ("cube", "hole")
    driver.qtbot.mouseClick(driver.window.viewport, Qt.MouseButton.LeftButton, pos=QPoint(5, 5))
    assert driver.session.selection == () and not tree.selectionModel().hasSelection()


def test_rows_select_in_the_order_of_the_clicks_and_the_picture_follows(driver):
    driver.open(drilled())
    driver.click_row(find(driver.document, "hole"))
    assert driver.session.selection == ("hole",)
    assert driver.window.viewport.viewer.scene.selection == {("part", "hole")}
    driver.click_row(find(driver.document, "cube"), CTRL)
    assert driver.session.selection == ("hole", "cube")
    driver.keys("Escape", driver.window.tree)
    assert driver.session.selection == () and not driver.window.viewport.viewer.scene.selection


def test_names_are_edited_in_place(driver):
    driver.open(drilled())
    tree = driver.window.tree
    driver.click_row(find(driver.document, "cube"))
    driver.keys("F2", tree)
    editor = tree.viewport().findChild(QLineEdit)
    driver.write("Block H", editor)
    driver.keys("Return", editor)
    driver.qtbot.waitUntil(lambda: find(driver.document, "cube").name == "Block H")
    assert find(driver.document, "hole") is trail(driver.document, "hole")[-1]
    driver.keys("Ctrl+Z", tree)
    assert find(driver.document, "cube").name == "cube"


def test_eyes_hide_and_show(driver):
    driver.open(drilled())
    driver.click_row(find(driver.document, "part"), column=EYE)
    assert not driver.document.solids[0].visible and driver.session.selection == ()
    driver.settle()
    assert not driver.window.viewport.viewer.scene.meshes
    driver.click_row(find(driver.document, "part"), column=EYE)
    driver.settle()
    assert driver.document.solids[0].visible and driver.window.viewport.viewer.scene.meshes


def test_delete_by_key_and_the_welcome_comes_back(driver):
    driver.keys("Shift+B")
    assert not driver.window.welcome.isVisible()
    driver.window.tree.setFocus()
    driver.keys("Delete", driver.window.tree)
    assert driver.document.solids == () and driver.window.welcome.isVisible()
    driver.settle()
    assert not driver.window.viewport.viewer.scene.meshes


def test_hover_tells_the_node_and_its_facet(driver):
    driver.open(drilled())
    driver.look_from("top")
    driver.qtbot.mouseMove(driver.window.viewport, driver.pixel_of((2, 2, 20)))
    driver.qtbot.waitUntil(lambda: "cube" in driver.window.status.hover.text())
    assert "facet" in driver.window.status.hover.text()
    assert driver.window.viewport.viewer.scene.hover == ("part", "cube")


def test_dragging_in_the_picture_turns_pans_and_zooms_without_selecting(driver):
    driver.open(drilled())
    viewport, viewer, qtbot = driver.window.viewport, driver.window.viewport.viewer, driver.qtbot
    for button in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton):
        before = viewer.camera
        qtbot.mousePress(viewport, button, pos=QPoint(300, 200))
        qtbot.mouseMove(viewport, QPoint(330, 220))
        qtbot.mouseMove(viewport, QPoint(360, 240))
        qtbot.mouseRelease(viewport, button, pos=QPoint(360, 240))
        assert viewer.camera != before
        assert (viewer.camera.distance == pytest.approx(before.distance)) and driver.session.selection == ()
    before = viewer.camera
    driver.keys("1", viewport)
    qtbot.waitUntil(lambda: viewer.camera.position[0] == pytest.approx(viewer.camera.target[0]))
    assert viewer.camera != before


def test_badges_follow_the_problems(driver):
    from solidtree.model.document.primitives import Halfspace

    driver.open(Document(solids=(Halfspace(id="h", name="h"), Box(id="b", name="b"))))
    nodes = driver.window.tree.nodes
    badge = nodes.index_of("h").siblingAtColumn(1)
    driver.qtbot.waitUntil(lambda: nodes.data(badge, Qt.ItemDataRole.DecorationRole) is not None)
    assert "without end" in nodes.data(badge, Qt.ItemDataRole.ToolTipRole)


class Drag:
    """Nodes of the tree on their way over a widget, as the events of a drag; real ones need a window manager."""

    def __init__(self, driver, *ids: str) -> None:
        self.driver, self.data = driver, dragged(driver.session, ids)

    def over(self, point: QPoint, modifiers=Qt.KeyboardModifier.NoModifier, widget=None):
        """What the cursor says: MoveAction, CopyAction, or IgnoreAction for a forbidden place."""
        widget = widget or self.driver.window.tree.viewport()
        for kind in (QDragEnterEvent, QDragMoveEvent):
            event = kind(point, MOVE | COPY, self.data, Qt.MouseButton.LeftButton, modifiers)
            QApplication.sendEvent(widget, event)
        return event.dropAction() if event.isAccepted() else Qt.DropAction.IgnoreAction

    def drop(self, point: QPoint, modifiers=Qt.KeyboardModifier.NoModifier, widget=None) -> None:
        self.over(point, modifiers, widget)
        event = QDropEvent(QPointF(point), MOVE | COPY, self.data, Qt.MouseButton.LeftButton, modifiers)
        QApplication.sendEvent(widget or self.driver.window.tree.viewport(), event)

    def leave(self) -> None:
        QApplication.sendEvent(self.driver.window.tree.viewport(), QDragLeaveEvent())


def edge_of(driver, node_id: str, below: bool = False) -> QPoint:
    rect = driver.window.tree.visualRect(driver.window.tree.nodes.index_of(node_id))
    return QPoint(rect.left() + 30, rect.bottom() - 1 if below else rect.top() + 1)


def test_nodes_are_dropped_between_onto_out_of_and_beside_operations(driver):
    loose = Sphere(id="loose", name="loose")
    driver.open(Document(solids=(*drilled().solids, loose)))
    before = driver.document
    Drag(driver, "loose").drop(edge_of(driver, "hole"))
    assert [child.id for child in driver.document.solids[0].children] == ["cube", "loose", "hole"]
    assert find(driver.document, "cube") is find(before, "cube") and driver.session.selection == ("loose",)
    Drag(driver, "cube", "loose").drop(driver.row(find(driver.document, "part")))
    assert [child.id for child in driver.document.solids[0].children] == ["hole", "cube", "loose"]
    viewport = driver.window.tree.viewport()
    Drag(driver, "loose", "hole").drop(QPoint(60, viewport.height() - 10), CTRL)
    assert [root.kind for root in driver.document.solids] == ["Difference", "Sphere", "Cylinder"]
    assert len(driver.session.log) == 3 and driver.session.log[-1] == "copy_to(['loose', 'hole'], None)"
    last = driver.window.tree.visualRect(driver.window.tree.nodes.index_of("loose"))
    Drag(driver, "hole").drop(QPoint(4, last.bottom() - 1))  # below the last operand, pointing further out
    assert [root.id for root in driver.document.solids][:2] == ["part", "hole"]
    for _ in range(4):
        driver.session.undo()
    assert driver.document is before


def test_an_impossible_drop_is_refused_before_the_release_and_says_why(driver):
    driver.open(Document(solids=(*drilled().solids, Sphere(id="loose", name="loose"))))
    before, status = driver.document, driver.window.status
    tree, loose = driver.window.tree, Drag(driver, "loose")
    assert loose.over(driver.row(find(before, "part"))) == MOVE
    driver.qtbot.wait(100)  # near the upper edge, where the tree would scroll if it could
    assert tree._mark is not None
    assert loose.over(driver.row(find(before, "part")), CTRL) == COPY
    assert loose.over(driver.row(find(before, "cube"))) == Qt.DropAction.IgnoreAction
    assert "“cube” is a box, which takes no operands" in status.currentMessage() and tree._mark is None
    loose.drop(driver.row(find(before, "cube")))
    assert driver.document is before
    part = Drag(driver, "part")
    assert part.over(edge_of(driver, "hole")) == Qt.DropAction.IgnoreAction
    assert "into itself" in status.currentMessage()
    part.leave()
    assert status.currentMessage() == ""


def test_nodes_dragged_in_another_window_are_pasted(driver, make_window):
    driver.open(drilled())
    other = make_window(Document(solids=(Union(id="n1", name="pair", children=(Box(id="n2"),)),)))
    foreign = Drag(driver, "hole")
    foreign.driver = other
    foreign.drop(other.row(other.document.solids[0]))
    assert [child.kind for child in other.document.solids[0].children] == ["Box", "Cylinder"]
    assert find(other.document, "n3").placement == find(driver.document, "hole").placement


def test_cut_copy_and_paste_by_keys(driver):
    driver.open(drilled())
    driver.window.tree.setFocus()
    driver.session.select(["hole"])
    driver.keys("Ctrl+C", driver.window.tree)
    driver.session.select(["part"])
    driver.keys("Ctrl+V", driver.window.tree)
    _, hole, copy = driver.document.solids[0].children
    assert copy == hole and copy.name == "hole" and driver.session.selection == (copy.id,)
    driver.keys("Ctrl+X", driver.window.tree)
    assert len(driver.document.solids[0].children) == 2 and driver.session.undo_label == "Cut"
    driver.session.select([])
    driver.keys("Ctrl+V", driver.window.tree)
    assert [root.kind for root in driver.document.solids] == ["Difference", "Cylinder"]
    QApplication.clipboard().setText("not a node")
    driver.keys("Ctrl+V", driver.window.tree)
    assert "no nodes on the clipboard" in driver.window.status.currentMessage()


def test_keys_move_operands_and_rename_many(driver):
    driver.open(drilled())
    tree = driver.window.tree
    tree.setFocus()
    driver.session.select(["hole"])
    driver.keys("Alt+Up", tree)
    assert [child.id for child in driver.document.solids[0].children] == ["hole", "cube"]
    driver.keys("Ctrl+Up", tree)
    assert driver.session.selection == ("part",)
    driver.keys("Ctrl+Down", tree)
    assert driver.session.selection == ("hole", "cube")
    driver.keys("Return", tree)
    editor = tree.viewport().findChild(QLineEdit)
    driver.keys("Ctrl+A", editor)
    driver.write("no", editor)
    driver.keys("Return", editor)
    driver.qtbot.waitUntil(lambda: [child.name for child in driver.document.solids[0].children] == ["no 1", "no 2"])
    assert driver.session.undo_label == "Rename 2 nodes"


def test_the_search_keeps_matches_and_what_they_stand_in(driver):
    other = Union(id="other", name="other", children=(Box(id="c", name="crate"),))
    driver.open(Document(solids=(*drilled().solids, other)))
    tree, panel = driver.window.tree, driver.window.model_panel
    tree.collapse(tree.nodes.index_of("part"))
    driver.keys("Ctrl+F")
    driver.write("kind:box", panel.field)
    driver.qtbot.waitUntil(lambda: tree.filter.active)

    def hidden(node_id: str) -> bool:
        index = tree.nodes.index_of(node_id)
        return tree.isRowHidden(index.row(), index.parent())

    assert [hidden(i) for i in ("part", "cube", "hole", "other", "c")] == [False, False, True, False, False]
    assert tree.isExpanded(tree.nodes.index_of("part")) and panel.count.text() == "2"
    assert tree.nodes.index_of("cube").data(Qt.ItemDataRole.FontRole).bold()
    driver.keys("Return", panel.field)
    assert driver.session.selection == ("cube",) and panel.count.text() == "1 of 2"
    driver.keys("Return", panel.field)
    driver.keys("Return", panel.field)
    assert driver.session.selection == ("cube",)
    driver.keys("Ctrl+Return", panel.field)
    assert driver.session.selection == ("cube", "c")
    driver.session.do("rename", "hole", "kind:box hole")
    driver.session.do("insert", Box(name="new"), "part")
    assert panel.count.text() == "2 of 3"  # the new one is selected
    driver.session.select([])
    driver.keys("Escape", panel.field)
    assert panel.field.text() == "" and not hidden("hole") and not tree.filter.matches
    assert not tree.isExpanded(tree.nodes.index_of("part"))  # as it was


def test_isolated_nodes_are_all_that_is_seen(driver):
    driver.open(drilled())
    driver.session.select(["hole"])
    driver.keys("I", driver.window.viewport)
    driver.settle()
    scene, card = driver.window.viewport.viewer.scene, driver.window.isolation
    assert set(scene.meshes) == {"hole"} and card.isVisible() and "hole" in card.words.text()
    assert driver.document.solids == drilled().solids and not driver.session.modified
    driver.session.do("set_field", "hole", "radius", 3)
    driver.settle()
    assert set(scene.meshes) == {"hole"}
    driver.qtbot.mouseClick(card.findChild(QPushButton), Qt.MouseButton.LeftButton)
    driver.settle()
    assert set(scene.meshes) == {"part"} and not card.isVisible()


def test_unchanged_rows_stay_expanded_and_collapsed(driver):
    inner = Union(id="inner", name="inner", children=(Box(id="a", name="a"), Box(id="b", name="b")))
    other = Union(id="other", name="other", children=(Box(id="c", name="c"),))
    driver.open(Document(solids=(Union(id="top", name="top", children=(inner, other)),)))
    tree, nodes = driver.window.tree, driver.window.tree.nodes
    tree.collapse(nodes.index_of("inner"))
    driver.session.do("combine", "difference", ["inner", "other"])
    assert not tree.isExpanded(nodes.index_of("inner")) and tree.isExpanded(nodes.index_of("other"))
    driver.session.undo()
    assert not tree.isExpanded(nodes.index_of("inner")) and tree.isExpanded(nodes.index_of("top"))


def deep(levels: int) -> Document:
    node: Node = Box(id="leaf", name="leaf")
    for level in range(levels):
        node = Union(id=f"u{level}", children=(node,))
    return Document(solids=(node.with_(name="deep"),))


def test_a_tree_482_levels_deep_is_shown_and_edited(driver):
    driver.open(deep(482))
    assert len(list(walk(*driver.document.roots))) == 483
    driver.session.select(["leaf"])
    tree = driver.window.tree
    assert tree.isExpanded(tree.nodes.index_of("u0")) and tree.visualRect(tree.nodes.index_of("leaf")).isValid()
    assert tree.viewport().rect().intersects(tree.visualRect(tree.nodes.index_of("leaf")))
    driver.session.do("set_field", "leaf", "size", (1, 2, 3))
    driver.settle()
    assert tree.nodes.node(tree.nodes.index_of("leaf")).size == (1.0, 2.0, 3.0)


def rows_of(model: QAbstractItemModel) -> list[tuple[int, str]]:
    found, stack = [], [(0, model.index(row, 0)) for row in reversed(range(model.rowCount()))]
    while stack:
        depth, index = stack.pop()
        found.append((depth, model.node(index).id))  # type: ignore[attr-defined]
        stack += [(depth + 1, model.index(row, 0, index)) for row in reversed(range(model.rowCount(index)))]
    return found


def nodes_of(document: Document) -> list[tuple[int, str]]:
    return [(len(trail(document, node.id)) - 1, node.id) for node in walk(*document.roots)]


def test_the_model_keeps_up_with_any_change(qtbot):
    document = Document(solids=tuple(Box(id=f"n{i}", name=f"box {i}") for i in range(1, 7)))
    session = Session(document)
    model = TreeModel(session)
    tester = QAbstractItemModelTester(model, QAbstractItemModelTester.FailureReportingMode.Fatal)
    steps = [
        lambda d: combine(d, "union", ["n2", "n4", "n5"]),
        lambda d: combine(d, "difference", ["n4", "n6"]),
        lambda d: relocate(d, ["n1", "n3"], "n7", 1),
        lambda d: rename(d, "n5", "five"),
        lambda d: duplicate(d, ["n7"]),
        lambda d: relocate(d, ["n5"], None, 0),
        lambda d: delete(d, ["n7"]),
        lambda d: document,
    ]
    for step in steps:
        document_now = step(session.document)
        session.commit("step", document_now)
        model.update(document_now)
        assert rows_of(model) == nodes_of(document_now)
    assert tester is not None


def test_a_change_touches_no_other_row(qtbot):
    session = Session(drilled())
    model = TreeModel(session)
    touched = []
    model.dataChanged.connect(lambda first, last, roles: touched.append(model.node(first).id))
    model.rowsInserted.connect(lambda *place: touched.append(place))
    session.do("rename", "hole", "drill")
    model.update(session.document)
    assert sorted(touched) == ["hole", "part"]


def test_runs_and_longest_rising():
    assert list(runs([1, 2, 3, 7, 9, 10])) == [(1, 3), (7, 7), (9, 10)]
    assert sorted(longest_rising([3, 0, 1, -1, 2])) == [1, 2, 4]
    assert longest_rising([]) == []
