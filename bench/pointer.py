"""A pointer that drags in the real window: a thread sends its moves while the window's events run."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop, QPointF, QSettings, Qt, QTimer
from PySide6.QtGui import QMouseEvent

if TYPE_CHECKING:
    from solidtree.gui.window import MainWindow
    from solidtree.model.document.document import Document
    from solidtree.render.viewer import Viewer

RATE = 125.0  # moves a second, as a mouse reports them
NONE, LEFT = Qt.MouseButton.NoButton, Qt.MouseButton.LeftButton


def until(done: Callable[[], bool], seconds: float = 60.0) -> None:
    """Let events run until something is so."""
    end = time.perf_counter() + seconds
    while not done() and time.perf_counter() < end:
        loop = QEventLoop()  # which sleeps between events, as the program's own does
        QTimer.singleShot(50, loop.quit)
        loop.exec()


def opened(document: Document, home: str) -> tuple[MainWindow, Viewer]:
    """The program's window with a document, shown and evaluated; its settings are kept in the folder `home`."""
    from solidtree.gui.application import spare_collections
    from solidtree.gui.settings import Settings
    from solidtree.gui.window import MainWindow
    from solidtree.model.editing.session import Session

    settings = Settings(QSettings(str(Path(home, "settings.ini")), QSettings.Format.IniFormat))
    window = MainWindow(Session(document), settings)
    window.resize(1280, 820)
    window.show()
    window.start()
    viewport = window.viewport
    until(lambda: viewport.viewer is not None and bool(viewport.viewer.scene.meshes) and not window.evaluation.waiting)
    assert viewport.viewer is not None
    spare_collections()
    return window, viewport.viewer


def swing(
    window: MainWindow, grip: np.ndarray, along: np.ndarray, seconds: float, sent: dict[int, float] | None = None
) -> float:
    """Press at pixel `grip` (2,) and swing along a direction (2,) for so long; the button stays down.

    The result is when it began; `sent` takes when each event was sent, by its time stamp. Ends the program where
    nothing was caught.
    """
    viewport = window.viewport

    def send(kind: QEvent.Type, place: np.ndarray, button: Qt.MouseButton, held: Qt.MouseButton, stamp: int) -> None:
        if sent is not None:
            sent[stamp] = time.perf_counter()
        keys = Qt.KeyboardModifier.ControlModifier  # no steps: every move is another value
        event = QMouseEvent(kind, QPointF(*place), QPointF(*place), button, held, keys)
        event.setTimestamp(stamp)
        QCoreApplication.postEvent(viewport, event)

    stop = threading.Event()

    def hand() -> None:
        send(QEvent.Type.MouseMove, grip, NONE, NONE, 1)
        send(QEvent.Type.MouseButtonPress, grip, LEFT, LEFT, 2)
        begin, number = time.perf_counter(), 3
        while not stop.wait(1.0 / RATE):
            turn = 40.0 * np.sin(2.0 * (time.perf_counter() - begin))
            send(QEvent.Type.MouseMove, grip + turn * along, NONE, LEFT, number)
            number += 1

    thread = threading.Thread(target=hand)
    thread.start()
    start = time.perf_counter()
    until(lambda: time.perf_counter() > start + seconds)
    stop.set()
    thread.join()
    if not window.session.previewing:
        raise SystemExit("the arrow was not caught: nothing was dragged")
    return start
