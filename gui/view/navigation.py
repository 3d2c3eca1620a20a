"""What the mouse does in the viewport: orbit, pan, zoom, click, hover. Turns Qt's events into cameras and picks."""

from __future__ import annotations

from enum import Enum, auto

from PySide6.QtCore import QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QMouseEvent, QWheelEvent

from ...render.camera import Camera, orbit, pan, zoom
from ...render.viewer import Viewer

DEGREES_A_PIXEL = 0.4
STEP = 1.2  # zoom factor of one notch of the wheel
SLACK = 4  # pixels the pointer may move in a click
REST = 30  # milliseconds the pointer must rest before what lies under it is looked for


class Drag(Enum):
    NONE = auto()
    WAIT = auto()  # pressed, and not moved yet
    ORBIT = auto()
    PAN = auto()
    MENU = auto()  # the right button pressed, and not moved yet
    CUBE = auto()


class Navigation(QObject):
    """State of the mouse in one viewport.

    `clicked` tells where and which keys were held, `menu_asked` where the right button was, `fit_asked` and `hovered` a
    pick or None, `view_asked` the name of a view.
    """

    clicked = Signal(QPointF, object)
    menu_asked = Signal(QPointF)
    fit_asked = Signal(object)
    view_asked = Signal(str)
    hovered = Signal(object)

    def __init__(self, viewer: Viewer, parent: QObject) -> None:
        super().__init__(parent)
        self._viewer = viewer
        self._drag = Drag.NONE
        self._last = QPointF()
        self._pressed = QPointF()
        self._button = Qt.MouseButton.NoButton
        self._pivot: tuple[float, float, float] | None = None
        self._pointer: QPointF | None = None
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST)
        self._rest.timeout.connect(self._look)

    @property
    def dragging(self) -> bool:
        return self._drag is not Drag.NONE

    def press(self, event: QMouseEvent) -> None:
        if self._drag is not Drag.NONE:
            return
        self._rest.stop()
        self._button = event.button()
        self._pressed = self._last = event.position()
        x, y = self._last.x(), self._last.y()
        held = event.modifiers()
        shift = bool(held & Qt.KeyboardModifier.ShiftModifier) and not held & Qt.KeyboardModifier.AltModifier
        if self._button == Qt.MouseButton.LeftButton and self._viewer.cube_hit(x, y):
            self._drag = Drag.CUBE
        elif self._button == Qt.MouseButton.RightButton:
            self._drag = Drag.MENU
        elif shift and self._button != Qt.MouseButton.NoButton:
            self._drag = Drag.PAN
        elif self._button == Qt.MouseButton.MiddleButton:
            self._drag = Drag.ORBIT
        elif self._button == Qt.MouseButton.LeftButton:
            self._drag = Drag.WAIT
        bounds = self._viewer.scene.visible_bounds()
        self._pivot = None if bounds is None else tuple(bounds.mean(axis=0).tolist())

    def move(self, event: QMouseEvent) -> None:
        position = event.position()
        self._pointer = position
        if self._drag is Drag.NONE:
            cube = self._viewer.cube_hit(position.x(), position.y())
            self._viewer.set_cube_hover(cube)
            self._rest.start()
            return
        if self._drag in (Drag.WAIT, Drag.CUBE, Drag.MENU):
            if (position - self._pressed).manhattanLength() <= SLACK:
                return
            self._drag = Drag.PAN if self._drag is Drag.MENU else Drag.ORBIT
        step = position - self._last
        self._last = position
        camera = self._viewer.camera
        if self._drag is Drag.ORBIT:
            camera = orbit(camera, step.x() * DEGREES_A_PIXEL, step.y() * DEGREES_A_PIXEL, self._pivot)
        elif self._drag is Drag.PAN:
            camera = pan(camera, step.x(), step.y(), self._viewer.size)
        self._viewer.set_camera(camera)

    def stop(self) -> None:
        """End a drag where it is."""
        self._drag, self._button = Drag.NONE, Qt.MouseButton.NoButton

    def release(self, event: QMouseEvent) -> None:
        if event.button() != self._button:
            return
        drag, self._drag = self._drag, Drag.NONE
        self._button = Qt.MouseButton.NoButton
        x, y = event.position().x(), event.position().y()
        if drag is Drag.CUBE:
            name = self._viewer.cube_hit(x, y)
            if name:
                self.view_asked.emit(name)
        elif drag is Drag.WAIT:
            self.clicked.emit(event.position(), event.modifiers())
        elif drag is Drag.MENU:
            self.menu_asked.emit(event.position())

    def double_click(self, event: QMouseEvent) -> None:
        x, y = event.position().x(), event.position().y()
        if event.button() != Qt.MouseButton.LeftButton:
            self.press(event)
        elif self._viewer.cube_hit(x, y):
            self._button, self._drag = event.button(), Drag.CUBE
            self._pressed = event.position()
        else:
            self.fit_asked.emit(self._viewer.pick(x, y))

    def wheel(self, event: QWheelEvent) -> None:
        notches = event.angleDelta().y() / 120.0
        if not notches:
            return
        position = event.position()
        pixel = (position.x(), position.y())
        self._viewer.set_camera(zoom(self._viewer.camera, STEP**notches, pixel, self._viewer.size))

    def leave(self) -> None:
        self._pointer = None
        self._rest.stop()
        self._viewer.set_cube_hover(None)
        self.hovered.emit(None)

    def _look(self) -> None:
        if self._pointer is None or self._drag is not Drag.NONE:
            return
        x, y = self._pointer.x(), self._pointer.y()
        self.hovered.emit(None if self._viewer.cube_hit(x, y) else self._viewer.pick(x, y))


def turned(camera: Camera, key: Qt.Key) -> Camera | None:
    """The camera after an arrow key; None for other keys."""
    steps = {
        Qt.Key.Key_Left: (15.0, 0.0),
        Qt.Key.Key_Right: (-15.0, 0.0),
        Qt.Key.Key_Up: (0.0, 15.0),
        Qt.Key.Key_Down: (0.0, -15.0),
    }
    return orbit(camera, *steps[key]) if key in steps else None
