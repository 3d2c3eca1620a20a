"""A tool whose handles are dragged: which one the pointer is on, the drag under way, and its end."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QMouseEvent

from .tool import Tool

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.editing.session import Session, State
    from ...render.handles.handle import Handle
    from ...render.handles.handle_marks import HandleMarks
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport


class Dragged(Protocol):
    """What a drag began on, and what it shows now."""

    document: Document | None
    shown: Document | None


D = TypeVar("D", bound=Dragged)


class DragTool(Tool, Generic[D]):
    """Sub-classes show handles in `_marks`, set `_drag` and `_held` where a press begins a drag, and say what following
    and committing it mean. `said` carries words on a drag, "" at its end."""

    said = Signal(str)
    refused = Signal(str)

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._viewport = session, viewport
        viewport.installEventFilter(self)
        self._viewer: Viewer | None = None
        self._marks: HandleMarks | None = None
        self._drag: D | None = None
        self._held = False

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    def closing(self) -> None:
        self._viewer = self._marks = None

    def move(self, event: QMouseEvent) -> bool:
        x, y = event.position().x(), event.position().y()
        if self._held:
            if self._drag is not None:
                self._follow(self._drag, x, y, bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
            return True
        handle = None if event.buttons() else self._caught(x, y)
        self._hover(handle)
        return handle is not None

    def release(self, event: QMouseEvent) -> bool:
        if not self._held:
            return False
        if not event.buttons():
            self._held = False
            self._commit()
        return True

    def leave(self) -> None:
        if not self._held:
            self._hover(None)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """What is typed in a drag is no shortcut."""
        if self._drag is not None and event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def _follow(self, drag: D, x: float, y: float, fine: bool) -> None:
        """The pointer of a drag is at (x, y)."""
        raise AssertionError(type(self).__name__)

    def _commit(self) -> None:
        """The drag's last picture becomes a step, if there is a drag."""
        raise AssertionError(type(self).__name__)

    def _drop_outdated(self, after: State) -> None:
        """End a drag that somebody else's change has overtaken: what was dragged is no more what it was."""
        drag = self._drag
        if drag is not None and after.document is not drag.document and after.document is not drag.shown:
            self._end()

    def _caught(self, x: float, y: float) -> Handle | None:
        if self._viewer is None or self._marks is None:
            return None
        return self._marks.caught(self._viewer.camera, self._viewer.size, x, y)

    def _hover(self, handle: Handle | None) -> None:
        name = None if handle is None else handle.name
        if self._marks is not None and self._viewer is not None and name != self._marks.hover:
            self._marks.hover = name
            self._viewer.needs_render = True
            self._viewport.refresh()

    def _end(self) -> D | None:
        """Forget the drag; what it was."""
        drag, self._drag = self._drag, None
        if drag is not None and self._marks is not None:
            self._marks.active = None
            self.said.emit("")
            if self._viewer is not None:
                self._viewer.needs_render = True
        return drag
