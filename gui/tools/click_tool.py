"""A tool whose clicks count: a drag turns the view, as it does without the tool."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt
from PySide6.QtGui import QMouseEvent

from .tool import Tool

if TYPE_CHECKING:
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport

SLACK = 4  # pixels the pointer may move in a click


class ClickTool(Tool):
    """Sub-classes say when they are `active`, and what a click and the pointer mean.

    Clicks with other `modifiers` held are left to the navigation; `held` is what the last press came with.
    """

    modifiers: tuple[Qt.KeyboardModifier, ...] = (Qt.KeyboardModifier.NoModifier,)
    held = Qt.KeyboardModifier.NoModifier

    def __init__(self, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._viewport = viewport
        self._viewer: Viewer | None = None
        self._pressed: QMouseEvent | None = None
        self._orbiting = False

    def takes_clicks(self) -> bool:
        """Whether the tool is in use."""
        raise AssertionError(type(self).__name__)

    def clicked(self, position: QPointF) -> None:
        """A click that was no drag."""

    def pointed(self, position: QPointF | None) -> None:
        """Where the pointer is, with no button held; None when it is elsewhere."""

    def drop_press(self) -> None:
        """Forget a button that is held, as when the tool ends."""
        if self._orbiting and self._viewport.navigation is not None:
            self._viewport.navigation.stop()
        self._pressed, self._orbiting = None, False

    def attached(self, viewer: Viewer) -> None:
        self._viewer = viewer

    def closing(self) -> None:
        self._viewer = None

    def press(self, event: QMouseEvent) -> bool:
        if not self.takes_clicks() or self._viewer is None:
            return False
        if event.button() != Qt.MouseButton.LeftButton or event.modifiers() not in self.modifiers:
            return self._pressed is not None
        if self._viewer.cube_hit(event.position().x(), event.position().y()):
            return False
        self._pressed, self.held = event.clone(), event.modifiers()
        return True

    def move(self, event: QMouseEvent) -> bool:
        if not self.takes_clicks() or self._viewer is None:
            return False
        navigation, position = self._viewport.navigation, event.position()
        if self._pressed is None:
            if event.buttons() or self._viewer.cube_hit(position.x(), position.y()):
                self.pointed(None)
                return False
            self.pointed(position)
            return True
        if not self._orbiting and (position - self._pressed.position()).manhattanLength() > SLACK:
            self._orbiting = True
            self.pointed(None)
            if navigation is not None:
                navigation.press(self._pressed)
        if self._orbiting and navigation is not None:
            navigation.move(event)
        return True

    def release(self, event: QMouseEvent) -> bool:
        if self._pressed is None:
            return False
        if event.button() == Qt.MouseButton.LeftButton:
            orbited, self._orbiting, self._pressed = self._orbiting, False, None
            if not orbited:
                self.clicked(event.position())
            elif self._viewport.navigation is not None:
                self._viewport.navigation.release(event)
        return True

    def double_click(self, event: QMouseEvent) -> bool:
        return self.press(event)

    def leave(self) -> None:
        if self.takes_clicks():
            self.pointed(None)
