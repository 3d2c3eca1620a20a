"""The window while the worker is busy: it answers, Cancel works, and a worker's death loses nothing."""

import os
import signal
import time

import numpy as np
import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QAbstractButton, QLineEdit

from solidtree.model.document.tree import walk
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, cylinder, document_of, sphere, union

pytest_plugins = ["window_driver"]


def long_boolean():
    """About ten seconds in one operation of the kernel, which nothing but the end of its process can stop."""
    ball = sphere(10, segments=1000)
    return document_of(long=ball - ball.at(1, 0, 0.7) - ball.at(2, 0.3, 0.7) - ball.at(3, 0.6, 0.7) - ball.at(4, 1, 0))


class Heartbeat:
    """A timer in the window's thread; the gaps between its beats are how long an input event may wait."""

    def __init__(self, qtbot):
        self._qtbot = qtbot
        self._timer = QTimer()
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(5)
        self._timer.timeout.connect(lambda: self.beats.append(time.perf_counter()))
        self.beats = []

    def gaps(self, milliseconds):
        """(n,) milliseconds between beats while the event loop runs this long."""
        self.beats = []
        self._timer.start()
        self._qtbot.wait(milliseconds)
        self._timer.stop()
        return 1e3 * np.diff(self.beats)


@pytest.fixture
def busy(driver):
    """A window with a box on the screen, and a boolean of ten seconds under way."""
    driver.keys("Shift+B")
    driver.settle()
    driver.session.select([])
    quiet = Heartbeat(driver.qtbot).gaps(700)
    small = driver.document
    with driver.qtbot.waitSignal(driver.window.evaluation.busy, timeout=5000):
        driver.session.do("insert", long_boolean().solids[0])
    return driver, quiet, small


def cancel_button(driver):
    (button,) = [b for b in driver.window.status.findChildren(QAbstractButton) if "Cancel" in (b.text() or b.toolTip())]
    return button


def test_input_is_answered_while_a_long_boolean_runs_and_cancel_ends_it(busy):
    driver, quiet, _ = busy
    evaluation = driver.window.evaluation
    assert evaluation.waiting and cancel_button(driver).isVisible()
    shown = evaluation.latest
    gaps = Heartbeat(driver.qtbot).gaps(3000)
    assert evaluation.waiting, "the boolean was over too soon to tell anything"
    # Fifty milliseconds, or what this machine makes an idle window wait.
    assert gaps.max() <= max(50, 1.5 * quiet.max()), (gaps.max(), quiet.max())
    # The tree and the keys work on: a rename, and the selection.
    driver.click_row(driver.document.solids[0])
    driver.keys("F2")
    editor = driver.window.tree.findChild(QLineEdit)
    editor.selectAll()
    driver.write("renamed", editor)
    driver.keys("Return", editor)
    driver.qtbot.waitUntil(lambda: driver.document.solids[0].name == "renamed", timeout=1000)
    with driver.qtbot.waitSignal(evaluation.busy, timeout=1000):
        driver.qtbot.mouseClick(cancel_button(driver), Qt.MouseButton.LeftButton)
    assert not evaluation.waiting and evaluation.latest is shown
    driver.session.undo()
    driver.session.undo()
    driver.settle()
    assert set(evaluation.latest.solids) == {driver.document.solids[0].id}


def test_killing_the_worker_from_outside_loses_nothing(busy):
    driver, _, small = busy
    evaluation = driver.window.evaluation
    mesh = evaluation.latest.solids[small.solids[0].id].mesh
    os.kill(evaluation.lane.pid, signal.SIGKILL)
    with driver.qtbot.waitSignal(evaluation.notice, timeout=5000) as told:
        pass
    assert "nothing is lost" in told.args[0]
    driver.session.undo()
    driver.settle()
    assert driver.document is small
    assert evaluation.latest.solids[small.solids[0].id].mesh is mesh
    driver.keys("Shift+S")
    driver.settle()
    assert len(evaluation.latest.solids) == 2


def test_a_newer_document_is_shown_though_the_old_one_was_heavy(driver):
    driver.session.do("insert", sphere(10) - box(3))
    driver.session.do("insert", box(2))
    driver.settle()
    assert set(driver.window.evaluation.latest.solids) == {root.id for root in driver.document.solids}


def test_previews_are_as_fine_as_the_solid_where_that_is_quick_and_coarser_where_it_is_not(make_window):
    def triangles(driver, document) -> tuple[int, int]:
        """Of the first solid at rest, and while its first leaf is on its way."""
        driver.open(document)
        leaf = next(node for node in walk(*document.solids) if not node.children)
        counts = []
        for now in (document, OPERATIONS["move"](document, [leaf.id], 0.1)):
            driver.session.preview(now)
            driver.settle()
            counts.append(len(driver.window.evaluation.latest.solids[document.solids[0].id].mesh.triangles))
        driver.session.cancel()
        driver.settle()
        return counts[0], counts[1]

    driver = make_window()
    driver.open(document_of(box(1)))  # the worker has started
    at_rest, moving = triangles(driver, document_of(cylinder(5, 10)))
    assert moving == at_rest
    drills = [cylinder(2, 12).at(5 * (i % 20), 5 * (i // 20), -1) for i in range(400)]
    at_rest, moving = triangles(driver, document_of(box(100, 100, 10) - union(*drills)))
    assert moving < 0.8 * at_rest
