"""The mouse on the handles of a window, for tests."""

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication

from solidtree.render.camera import project

LEFT = Qt.MouseButton.LeftButton


class Hand:
    """Drags the handles of a driver's window."""

    def __init__(self, driver) -> None:
        self.driver = driver
        self.viewport = driver.window.viewport
        self.marks = driver.window.handles._picture._marks

    @property
    def names(self) -> set[str]:
        return {handle.name for handle in self.marks.handles}

    def at(self, name: str) -> QPoint:
        viewer = self.viewport.viewer
        (handle,) = (handle for handle in self.marks.handles if handle.name == name)
        path = handle.world(handle.path, handle.length(viewer.camera, viewer.size))
        if handle.front:
            path = path[handle.before(path, viewer.camera)]
            path = path[len(path) // 4 : len(path) // 4 + 1]
        x, y = project(viewer.camera, path, viewer.size)[:, :2].mean(axis=0) if handle.area else project(
            viewer.camera, path[-1:], viewer.size
        )[0, :2]  # fmt: skip
        return QPoint(round(x), round(y))

    def press(self, place: QPoint) -> None:
        self.driver.qtbot.mousePress(self.viewport, LEFT, pos=place)

    def move(self, place: QPoint) -> None:
        self.driver.qtbot.mouseMove(self.viewport, place)
        QApplication.processEvents()

    def release(self, place: QPoint) -> None:
        self.driver.qtbot.mouseRelease(self.viewport, LEFT, pos=place)

    def drag(self, name: str, x: int, y: int) -> None:
        start = self.at(name)
        self.press(start)
        self.move(start + QPoint(x // 2, y // 2))
        self.move(start + QPoint(x, y))
        assert self.driver.session.previewing
        self.release(start + QPoint(x, y))

    def drag_along(self, name: str, direction, pixels: float = 40.0) -> None:
        """So many pixels to where a direction of the world goes in the picture."""
        viewer = self.viewport.viewer
        (handle,) = (handle for handle in self.marks.handles if handle.name == name)
        a, b = project(viewer.camera, [handle.origin, handle.origin + np.asarray(direction, float)], viewer.size)[:, :2]
        x, y = pixels * (b - a) / np.linalg.norm(b - a)
        self.drag(name, round(x), round(y))
