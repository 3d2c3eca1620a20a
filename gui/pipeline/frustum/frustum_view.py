"""The second view: the eye, the frustum and the model from beside, or the same after the division."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ....render.camera import Camera, frame, orbit, pan, project, vector_of, zoom
from ....render.views import standard_view
from ..flow import CUBE, Flow
from .frustum_paint import FrustumPainter

Floats = NDArray[np.float64]
TURN = 0.5  # degrees a pixel
NOTCH = 1.25  # by one notch of the wheel
MARGIN = 1.2
ZOOMS = (Qt.Key.Key_Plus, Qt.Key.Key_Equal, Qt.Key.Key_Minus)
ARROWS = {
    Qt.Key.Key_Left: (-8.0, 0.0),
    Qt.Key.Key_Right: (8.0, 0.0),
    Qt.Key.Key_Up: (0.0, -8.0),
    Qt.Key.Key_Down: (0.0, 8.0),
}


class FrustumView(QWidget):
    """Drawn with a parallel camera of its own. With `device` it shows the cube that the frustum becomes."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("The frustum from outside")
        self.setToolTip("Drag to turn, Shift+drag to shift, the wheel zooms, double click or F shows all")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(180, 150)
        self.flow: Flow | None = None
        self.device = False
        self._cameras = {
            False: Camera(parallel=True),
            True: orbit(standard_view(Camera(parallel=True), "front"), -32.0, 22.0),
        }
        self._fitted = {False: False, True: False}
        self._held: QPointF | None = None

    @property
    def camera(self) -> Camera:
        """What the view itself is seen with."""
        return self._cameras[self.device]

    def show_flow(self, flow: Flow | None) -> None:
        self.flow = flow
        if not self._fitted[self.device]:
            self.fit()
        self.update()

    def set_device(self, device: bool) -> None:
        """Show device space, or the world."""
        self.device = device
        if not self._fitted[device]:
            self.fit()
        self.update()

    def fit(self) -> None:
        """Show the whole of it."""
        points = self._points()
        if points is None or self.width() < 20 or self.height() < 20:
            return
        camera = self.camera
        if not self.device and not self._fitted[False] and self.flow is not None:
            camera = self._beside(self.flow)
        axes = frame(camera)
        local = points @ axes.T
        low, high = local.min(axis=0), local.max(axis=0)
        x, y, _ = (high - low) / 2.0 * MARGIN
        target = (low + high) / 2.0 @ axes
        scale = max(float(x) * self.height() / self.width(), float(y), 1e-6)
        self._cameras[self.device] = replace(
            camera,
            position=vector_of(target + axes[2] * camera.distance),
            target=vector_of(target),
            parallel_scale=scale,
        )
        self._fitted[self.device] = True
        self.update()

    def to_widget(self, points: Floats) -> Floats:
        """(n, 2) pixels of points (n, 3) of what is shown."""
        return project(self.camera, points, (self.width(), self.height()))[:, :2]

    def _points(self) -> Floats | None:
        """(n, 3) what is to be seen of it."""
        if self.flow is None:
            return None
        if self.device:
            return 1.1 * CUBE
        found, eye, box = self.flow.frustum, self.flow.eye, self.flow.geometry.bounds
        corners = np.zeros((0, 3)) if box is None else np.array(list(product(*box.T)))
        if eye is not None and len(corners):
            # A far plane that is very far would leave nothing to see of the rest.
            reach = 1.1 * float(np.linalg.norm(corners - eye, axis=1).max())
            length = np.linalg.norm(found - eye, axis=1, keepdims=True)
            found = eye + (found - eye) * np.minimum(1.0, reach / np.maximum(length, 1e-12))
        points = np.concatenate((found, corners, np.zeros((0, 3)) if eye is None else eye[None]))
        points = points[np.isfinite(points).all(axis=1)]
        return points if len(points) else None

    @staticmethod
    def _beside(flow: Flow) -> Camera:
        """A camera that sees the frustum from its side and a little from above."""
        middle = flow.frustum.reshape(2, 4, 3).mean(axis=1)
        way = middle[1] - middle[0]
        side = np.cross(way, (0.0, 0.0, 1.0))
        if np.linalg.norm(side) < 1e-9 * max(float(np.linalg.norm(way)), 1e-12):
            side = np.array([0.0, -1.0, 0.0])
        side /= np.linalg.norm(side)
        position = middle[0] + side + 0.35 * np.array([0.0, 0.0, 1.0])
        return replace(Camera(parallel=True), position=vector_of(position), target=vector_of(middle[0]))

    # Mouse and keys.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._held = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._held is None or not event.buttons():
            return
        way, self._held = event.position() - self._held, event.position()
        shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        if shift or not event.buttons() & Qt.MouseButton.LeftButton:
            self._turn_to(pan(self.camera, way.x(), way.y(), (self.width(), self.height())))
        else:
            self._turn_to(orbit(self.camera, TURN * way.x(), TURN * way.y()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._held = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.fit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        place = event.position()
        size = (float(self.width()), float(self.height()))
        self._turn_to(zoom(self.camera, NOTCH ** (event.angleDelta().y() / 120), (place.x(), place.y()), size))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = Qt.Key(event.key())
        if key in ARROWS:
            self._turn_to(orbit(self.camera, *ARROWS[key]))
        elif key in ZOOMS:
            self._turn_to(zoom(self.camera, 1 / NOTCH if key == Qt.Key.Key_Minus else NOTCH))
        elif key == Qt.Key.Key_F and not event.modifiers():
            self.fit()
        else:
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            own = event.key() in (*ARROWS, *ZOOMS, Qt.Key.Key_F)
            if own and not event.modifiers() & (Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.ControlModifier):
                event.accept()  # and not the window's
                return True
        return super().event(event)

    def _turn_to(self, camera: Camera) -> None:
        self._cameras[self.device] = camera
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if not self._fitted[self.device]:
            self.fit()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        FrustumPainter(self, painter).paint()
        painter.end()
