"""The dumbbell from nothing by mouse and keys in the real window, and its echoed lines done again."""

import numpy as np
import pytest
from handle_hand import Hand
from PySide6.QtCore import QPoint, Qt
from replay import replayed

from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Intersection, Union
from solidtree.model.document.table import same_document
from solidtree.model.operations.sizing import size_handles

pytest_plugins = ["window_driver"]
CTRL = Qt.KeyboardModifier.ControlModifier


def volume() -> float:
    """Two balls of radius 10 at x = -20 and 20 without the caps below z = -7, and a bar of radius 4 between them."""
    ball = 4 / 3 * np.pi * 10**3 - np.pi * 3**2 * (3 * 10 - 3) / 3
    bar_in_ball = 2 / 3 * np.pi * (10**3 - (10**2 - 4**2) ** 1.5)
    return 2 * (ball - bar_in_ball) + np.pi * 4**2 * 40


def typed_on_the_way(hand: Hand, name: str, direction, text: str) -> None:
    """Drag a handle, and say the number while it is dragged."""
    start = hand.at(name)
    hand.press(start)
    hand.move(start + QPoint(*direction))
    assert hand.driver.session.previewing
    hand.driver.write(text, hand.viewport)
    hand.driver.keys("Return", hand.viewport)
    hand.release(start + QPoint(*direction))
    hand.driver.settle()


def test_the_dumbbell_is_built_by_mouse_and_keys_and_its_lines_make_it_again(driver):
    session, window = driver.session, driver.window
    driver.keys("Shift+S", window.viewport)  # a ball of radius 10
    driver.settle()
    hand = Hand(driver)
    typed_on_the_way(hand, "move x", (-40, 0), "-20")
    (left,) = driver.document.solids
    assert left.placement.position == (-20, 0, 0)

    driver.keys("Ctrl+Shift+D", window.viewport)
    driver.keys("M", window.viewport)
    driver.write("40", window.viewport)
    driver.keys("Return", window.viewport)
    assert [ball.placement.position for ball in driver.document.solids] == [(-20, 0, 0), (20, 0, 0)]

    driver.keys("Escape", window.viewport)
    driver.keys("Shift+C", window.viewport)
    driver.keys("D", window.viewport)
    driver.settle()
    names = {handle.name: f"size {i}" for i, handle in enumerate(size_handles(driver.document.solids[2]))}
    typed_on_the_way(hand, names["radius"], (10, 0), "4")
    typed_on_the_way(hand, names["height"], (0, -10), "40")
    driver.keys("R", window.viewport)
    driver.keys("Escape", window.viewport)  # the rings stay, the numbers come with the drag
    typed_on_the_way(hand, "turn y", (20, 20), "90")
    driver.keys("M", window.viewport)
    driver.write("-20", window.viewport)
    driver.keys("Return", window.viewport)
    bar = driver.document.solids[2]
    assert (bar.radius, bar.height, bar.placement.position) == (4, 40, (-20, 0, 0))

    first, second, bar = driver.document.solids
    driver.click_row(first)
    driver.click_row(second, CTRL)
    driver.click_row(bar, CTRL)
    driver.keys("Ctrl+U", window.viewport)
    driver.keys("Escape", window.viewport)
    driver.keys("Shift+H", window.viewport)
    driver.settle()
    driver.keys("M", window.viewport)
    driver.keys("Tab", window.viewport)
    driver.keys("Tab", window.viewport)
    driver.write("-7", window.viewport)
    driver.keys("Return", window.viewport)
    driver.click_row(driver.document.solids[0])
    driver.click_row(driver.document.solids[1], CTRL)
    driver.keys("Ctrl+I", window.viewport)

    (root,) = driver.document.solids
    assert isinstance(root, Intersection) and isinstance(root.children[0], Union)
    driver.settle()
    measures = window.evaluation.latest.solids[root.id].measures
    assert measures.volume == pytest.approx(volume(), rel=0.01)
    assert measures.bounds[0] == pytest.approx((-30, -10, -7), abs=0.1) and measures.genus == 0
    assert measures.bounds[1] == pytest.approx((30, 10, 10), abs=0.1)

    assert same_document(replayed(session.log, Document()), driver.document)
    assert window.script.toPlainText().splitlines() == list(session.log)
    while session.undo():
        pass
    assert driver.document.solids == () and session.log == ()
