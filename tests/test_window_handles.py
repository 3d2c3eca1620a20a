"""Handles in the real window, by mouse and keys: drags, typed numbers, Escape, undo, nested nodes, expressions."""

import numpy as np
import pytest
from handle_hand import Hand
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication

from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Node
from solidtree.model.document.placement import Move, Scale, Turn
from solidtree.model.document.resolve import resolve
from solidtree.model.document.tree import find
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, cylinder, document_of, halfspace, mirror, parameter, sphere, union
from solidtree.model.solid.places import places_of

pytest_plugins = ["window_driver"]
LEFT, CTRL = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def opened(make_window):
    def make(document: Document, *chosen: Node) -> Hand:
        driver = make_window(document)
        driver.window.handles.set_snapping(False)
        driver.session.select([node.id for node in chosen])
        driver.settle()
        return Hand(driver)

    return make


def undone(hand: Hand, before: Document, label: str, lines: int = 1) -> None:
    """One step with one echoed line, and undo is the very document before."""
    session = hand.driver.session
    assert session.undo_label == label and len(session.log) == lines
    after = session.document
    assert after is not before
    hand.driver.keys("Ctrl+Z", hand.viewport)
    assert session.document is before
    hand.driver.keys("Ctrl+Shift+Z", hand.viewport)
    assert session.document is after


def test_an_arrow_moves_along_its_axis_in_one_step(opened):
    document = document_of(sphere(10))
    (ball,) = document.solids
    hand = opened(document, ball)
    assert {"move x", "move xy", "move", "size 0"} <= hand.names
    hand.drag_along("move y", (0, 1, 0))
    (step,) = find(hand.driver.document, ball.id).placement.steps
    assert isinstance(step, Move) and step.numbers[1] > 1 and step.numbers[0] == step.numbers[2] == 0
    undone(hand, document, "Move")
    hand.driver.settle()
    assert hand.driver.window.evaluation.latest.solids[ball.id].measures.centroid[1] == pytest.approx(step.numbers[1])


def test_a_plane_s_square_moves_along_two_axes(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    hand.drag("move xy", 30, 5)
    (step,) = hand.driver.document.solids[0].placement.steps
    assert step.numbers[0] != 0 and step.numbers[1] != 0 and step.numbers[2] == 0


def test_a_ring_turns_and_the_position_stays(opened):
    document = document_of(box(10, 20, 30, centred=True).at(5, 0, 0))
    hand = opened(document, *document.solids)
    hand.driver.keys("R", hand.viewport)
    assert hand.names == {"turn x", "turn y", "turn z"}
    hand.drag("turn z", 25, 25)
    turn, move = hand.driver.document.solids[0].placement.steps
    assert isinstance(turn, Turn) and turn.numbers[2] != 0 and turn.numbers[:2] == (0, 0) and move.numbers == (5, 0, 0)
    assert turn.numbers[2] == round(turn.numbers[2])
    undone(hand, document, "Turn")


def test_a_ring_of_a_node_s_own_axes_follows_the_pointer_in_a_mirrored_parent_too(opened):
    part = box(10, 20, 30, centred=True)
    angles = []
    start = None
    for solid in (union(part), mirror(part, normal=(0, 1, 0), keep=False)):
        document = document_of(solid)
        hand = opened(document, document.solids[0].children[0])
        hand.driver.window.handles.set_local(True)
        hand.driver.keys("R", hand.viewport)
        start = start or hand.at("turn z")
        hand.press(start)
        hand.move(start + QPoint(25, 25))
        assert hand.driver.window.handles._name == "turn z"
        hand.release(start + QPoint(25, 25))
        (place,) = places_of(resolve(hand.driver.document).solids, [document.solids[0].children[0].id]).values()
        x, y, _ = place[0].matrix[:, 0]
        angles.append(np.degrees(np.arctan2(y, x)))
    assert abs(angles[0]) > 1 and angles[0] == pytest.approx(angles[1])


def test_a_box_scales_along_its_axis_and_the_middle_one_along_all(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    hand.driver.keys("S", hand.viewport)
    hand.drag_along("scale z", (0, 0, 1), 30)
    (scale,) = hand.driver.document.solids[0].placement.steps
    assert isinstance(scale, Scale) and scale.numbers[2] > 1 and scale.numbers[:2] == (1, 1)
    hand.driver.keys("Ctrl+Z", hand.viewport)
    hand.drag("scale", 50, 0)
    assert hand.driver.document.solids[0].placement.steps == (Scale((1.5, 1.5, 1.5)),)


def test_a_sphere_s_radius(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    hand.drag_along("size 0", (-1, 0, 0))
    assert hand.driver.document.solids[0].radius > 11
    assert hand.driver.session.log[0].startswith("set_fields('n1', radius=")
    undone(hand, document, "Change radius")


def test_the_low_face_of_a_box_moves_and_the_other_stays(opened):
    document = document_of(box(20, 20, 20).turned(z=90).at(5))
    hand = opened(document, *document.solids)
    hand.drag_along("size 1", (0, -1, 0))  # the box's own low x
    node = hand.driver.document.solids[0]
    grown = node.size[0] - 20
    assert grown > 1 and node.size[1:] == (20, 20)
    assert node.placement.steps == (Turn((0, 0, 90)), Move((5, -grown, 0)))
    undone(hand, document, "Change size x")


def test_a_half_space_is_shifted_and_tilted(opened):
    document = document_of(sphere(20) & halfspace((0, 0, 1), (0, 0, -5)))
    plane = document.solids[0].children[1]
    hand = opened(document, plane)
    assert hand.names == {"plane", "plane tilt u", "plane tilt v"}
    hand.driver.window.looks.set_ghosts(False)  # which show the plane themselves
    assert hand.names == {"plane", "plane square", "plane tilt u", "plane tilt v"}
    hand.drag_along("plane", (0, 0, 1))
    changed = find(hand.driver.document, plane.id)
    assert changed.normal == (0, 0, 1) and changed.point[2] > -4 and changed.point[:2] == (0, 0)
    hand.driver.keys("Ctrl+Z", hand.viewport)
    hand.driver.settle()
    hand.drag("plane tilt u", 0, 30)
    changed = find(hand.driver.document, plane.id)
    assert changed.normal[2] < 0.999 and np.linalg.norm(changed.normal) == pytest.approx(1.0)
    undone(hand, document, "Tilt plane")


def test_escape_gives_the_very_document_back(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    start = hand.at("move x")
    hand.press(start)
    hand.move(start + QPoint(40, 20))
    assert hand.driver.session.previewing
    hand.driver.keys("Escape", hand.viewport)
    assert hand.driver.document is document and not hand.driver.session.previewing
    hand.move(start + QPoint(60, 20))
    hand.release(start + QPoint(60, 20))
    assert hand.driver.document is document and hand.driver.session.selection == (document.solids[0].id,)
    assert hand.driver.session.undo_label is None
    hand.driver.keys("Escape", hand.viewport)
    assert hand.driver.session.selection == ()


def test_a_typed_number_replaces_the_pointer_s(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    start = hand.at("move x")
    hand.press(start)
    hand.move(start + QPoint(40, 20))
    hand.driver.write("12.55", hand.viewport)
    hand.driver.keys("Backspace", hand.viewport)
    hand.driver.keys("Tab", hand.viewport)
    hand.driver.write("-3", hand.viewport)
    hand.move(start + QPoint(80, 20))
    assert hand.driver.session.previewing
    assert hand.driver.document.solids[0].placement.steps == (Move((12.5, -3, 0)),)
    hand.driver.keys("Return", hand.viewport)
    hand.release(start + QPoint(80, 20))
    assert hand.driver.session.log == ("move(['n1'], 12.5, -3, 0)",)
    assert hand.driver.document.solids[0].placement.steps == (Move((12.5, -3, 0)),)


def test_keys_alone_move_turn_and_scale(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    view = hand.viewport.viewer.camera
    hand.driver.keys("M", hand.viewport)
    hand.driver.write("10", hand.viewport)
    hand.driver.keys("Tab", hand.viewport)
    hand.driver.write("0", hand.viewport)
    hand.driver.keys("Tab", hand.viewport)
    hand.driver.write("5", hand.viewport)
    assert hand.driver.session.previewing
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log[-1] == "move(['n1'], 10, 0, 5)"
    hand.driver.keys("R", hand.viewport)
    hand.driver.write("30", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log[-1] == "turn(['n1'], 'z', 30)"
    hand.driver.keys("S", hand.viewport)
    hand.driver.write("2", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log[-1] == "scale(['n1'], 2, local=True)"
    assert hand.viewport.viewer.camera == view  # no digit was a shortcut
    hand.driver.keys("M", hand.viewport)
    hand.driver.write("=", hand.viewport)
    hand.driver.write("wide", hand.viewport)
    before = hand.driver.document
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.document is before and "wide" in hand.driver.window.status.currentMessage()
    for _ in range(5):  # it stays to be corrected
        hand.driver.keys("Backspace", hand.viewport)
    hand.driver.write("7", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log[-1] == "move(['n1'], 7, 0, 0)"


def test_a_turn_about_two_axes_is_refused_until_one_of_them_is_nought(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    hand.driver.keys("R", hand.viewport)
    hand.driver.write("90", hand.viewport)
    hand.driver.keys("Tab", hand.viewport)
    hand.driver.write("45", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log == () and "about one axis" in hand.driver.window.status.currentMessage()
    hand.driver.keys("Backspace", hand.viewport)
    hand.driver.keys("Backspace", hand.viewport)
    hand.driver.write("0", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log == ("turn(['n1'], 'z', 90)",)


def test_an_expression_may_be_typed_and_is_kept(opened):
    document = document_of(sphere(parameter("width", 8)), box(5))
    hand = opened(document, document.solids[1])
    hand.driver.keys("M", hand.viewport)
    hand.driver.write("=width/2", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert hand.driver.session.log == ("move(['n2'], 'width/2', 0, 0)",)
    hand.driver.session.select([document.solids[0].id])
    hand.driver.settle()
    hand.driver.keys("M", hand.viewport)
    hand.driver.keys("M", hand.viewport)
    before = hand.driver.document
    place = hand.at("size 0")
    hand.press(place)
    assert hand.driver.window.status.currentMessage() == "radius is `width`: change it in the properties"
    hand.move(place + QPoint(30, 0))
    hand.release(place + QPoint(30, 0))
    assert hand.driver.document is before


def test_a_nested_node_goes_where_the_pointer_goes(opened):
    document = document_of(union(box(10), cylinder(3, 8).at(20)).turned(z=90).scaled(2).at(0, 0, 5))
    inner = document.solids[0].children[1]
    hand = opened(document, inner)
    hand.drag_along("move x", (1, 0, 0))
    line = hand.driver.session.log[0]
    assert line.startswith(f"move(['{inner.id}'], ") and line.endswith(", 0, 0, world=True)")
    places = [
        places_of(resolve(d).solids, [inner.id])[inner.id][0].matrix[:, 3] for d in (document, hand.driver.document)
    ]
    moved = places[1] - places[0]
    assert moved[0] > 1 and moved[1:] == pytest.approx((0, 0), abs=1e-9)
    undone(hand, document, "Move")


def test_local_axes_are_the_node_s_own(opened):
    document = document_of(box(10).turned(z=90))
    hand = opened(document, *document.solids)
    hand.driver.keys("X", hand.viewport)
    assert hand.driver.window.actions_["local_axes"].isChecked()
    hand.drag_along("move x", (0, 1, 0))
    x, y, z = hand.driver.document.solids[0].placement.position
    assert (x, z) == (0, 0) and y > 1


def test_several_nodes_turn_about_their_middle(opened):
    document = document_of(a=sphere(5).at(-20), b=sphere(5).at(20))
    hand = opened(document, *document.solids)
    hand.driver.keys("R", hand.viewport)
    hand.driver.write("90", hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    assert [root.placement.position for root in hand.driver.document.solids] == [(0, -20, 0), (0, 20, 0)]
    undone(hand, document, "Turn")


def test_a_drag_ends_when_the_document_becomes_another(opened):
    document = document_of(sphere(10))
    hand = opened(OPERATIONS["move"](document, ["n1"], 1), *document.solids)
    start = hand.at("move x")
    hand.press(start)
    hand.move(start + QPoint(40, 20))
    hand.driver.session.do("delete", ["n1"])
    QApplication.processEvents()
    hand.move(start + QPoint(60, 20))
    hand.release(start + QPoint(60, 20))
    assert hand.driver.document.solids == () and not hand.driver.session.previewing
    assert hand.names == set()


def test_a_corner_is_snapped_to(make_window):
    document = document_of(ball=sphere(2).at(0, 0, 30), block=box(20))
    driver = make_window(document)
    ball = document.solids[0]
    driver.session.select([ball.id])
    driver.settle()
    hand = Hand(driver)
    place, corner = hand.at("move"), driver.pixel_of((20, 0, 20))
    hand.press(place)
    hand.move((place + corner) / 2)
    hand.move(corner + QPoint(2, 1))
    hand.release(corner + QPoint(2, 1))
    assert driver.document.solids[0].placement.position == pytest.approx((20, 0, 20), abs=1e-4)


def test_modes_are_switches_of_the_tools_menu(opened):
    document = document_of(sphere(10))
    hand = opened(document, *document.solids)
    actions = hand.driver.window.actions_
    hand.driver.keys("D", hand.viewport)
    assert actions["handles_size"].isChecked() and hand.names == {"size 0", "size 1", "size 2"}
    hand.driver.keys("D", hand.viewport)
    assert not actions["handles_size"].isChecked() and "move x" in hand.names
    hand.driver.session.select(())
    assert hand.names == set() and not actions["handles_move"].isEnabled()
