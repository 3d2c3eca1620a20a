"""The model tree and the picture: selection in step, inline rename, eyes, drag and drop, deep trees, picking."""

import pytest
from PySide6.QtCore import QAbstractItemModel, QModelIndex, QPoint, Qt
from PySide6.QtTest import QAbstractItemModelTester
from PySide6.QtWidgets import QLineEdit

from solidtree.gui.tree.tree_model import EYE, TreeModel
from solidtree.gui.tree.tree_rows import longest_rising, runs
from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Difference, Node, Union
from solidtree.model.document.primitives import Box, Cylinder, Sphere
from solidtree.model.document.tree import find, trail, walk
from solidtree.model.editing.operations import combine, delete, duplicate, relocate, rename
from solidtree.model.editing.session import Session

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


def test_drops_relocate_copy_and_refuse_before_the_mouse_is_released(driver):
    loose = Sphere(id="loose", name="loose")
    driver.open(Document(solids=(*drilled().solids, loose)))
    nodes, said = driver.window.tree.nodes, []
    driver.window.tree.refused.connect(said.append)

    def dragged(*ids: str):
        return nodes.mimeData([nodes.index_of(i) for i in ids])

    part = nodes.index_of("part")
    assert not nodes.canDropMimeData(dragged("part"), MOVE, -1, 0, part) and "into itself" in said[-1]
    assert not nodes.canDropMimeData(dragged("loose"), MOVE, -1, 0, nodes.index_of("cube"))
    before = driver.document
    assert nodes.canDropMimeData(dragged("loose"), MOVE, 1, 0, part) and driver.document is before
    assert nodes.dropMimeData(dragged("loose"), MOVE, 1, 0, part)
    assert [child.id for child in driver.document.solids[0].children] == ["cube", "loose", "hole"]
    assert find(driver.document, "cube") is find(before, "cube")
    assert nodes.dropMimeData(dragged("hole"), COPY, -1, 0, QModelIndex())
    assert [root.kind for root in driver.document.solids] == ["Difference", "Cylinder"]
    driver.session.undo()
    driver.session.undo()
    assert driver.document is before


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
