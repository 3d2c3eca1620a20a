"""What a tool of the viewport is: it is asked for every event before the navigation is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtGui import QKeyEvent, QMouseEvent

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ...render.viewer import Viewer


class Tool(QObject):
    """Every method that answers says whether the event is the tool's own: then nobody else gets it.

    A tool that takes a press gets all moves and the release up to the end of the drag.
    """

    @property
    def dragging(self) -> bool:
        """Whether something is on its way with the pointer, so that pictures should come quickly."""
        return False

    def attached(self, viewer: Viewer) -> None:
        """The viewer is there; marks can be added to its overlay. Comes once."""

    def closing(self) -> None:
        """The viewer is about to go."""

    def press(self, event: QMouseEvent) -> bool:
        return False

    def move(self, event: QMouseEvent) -> bool:
        """With a button held or without."""
        return False

    def release(self, event: QMouseEvent) -> bool:
        return False

    def double_click(self, event: QMouseEvent) -> bool:
        return False

    def key(self, event: QKeyEvent) -> bool:
        return False

    def leave(self) -> None:
        """The pointer left the viewport."""

    def session_changed(self, before: State, after: State) -> None:
        """After the viewport has followed the session."""

    def shown(self) -> None:
        """The meshes in the picture are others now."""
