"""What the handles of lights and of textures have in common: hover, drag as a preview, drop as a step, Escape."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from ....model.document.errors import Refusal
from ....model.operations.operations import OPERATIONS
from ...panels.property_edit import sentence
from ...tools.tool import Tool

if TYPE_CHECKING:
    from ....model.document.document import Document
    from ....model.editing.session import Session, State
    from ....render.handles.handle import Handle
    from ....render.handles.handle_marks import HandleMarks
    from ....render.viewer import Viewer
    from ...view.viewport import Viewport


@dataclass(slots=True)
class Drag:
    """`follow` takes the pointer's place and whether it is to be followed finely, and tells the fields that `operation`
    changes and what they are in words; None where the pointer says nothing."""

    label: str
    operation: str
    arguments: tuple[Any, ...]
    follow: Callable[[float, float, bool], tuple[dict[str, Any], str] | None]
    name: str = ""
    document: Document | None = None
    changes: dict[str, Any] | None = None
    shown: Document | None = None


class HandleTool(Tool):
    """`said` carries words on a drag, "" at its end. What is shown comes from `handles`, a drag from `begin`."""

    said = Signal(str)
    refused = Signal(str)

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._viewport = session, viewport
        viewport.installEventFilter(self)
        self._viewer: Viewer | None = None
        self._marks: HandleMarks | None = None
        self._drag: Drag | None = None
        self._held = False
        self.aside = False

    def set_aside(self, aside: bool) -> None:
        """Show no handles while another tool has the clicks."""
        self.aside = aside
        self.show_handles()

    def handles(self, viewer: Viewer) -> tuple[Handle, ...]:
        """What is to be shown now."""
        raise NotImplementedError

    def begin(self, viewer: Viewer, handle: Handle, x: float, y: float) -> Drag | None:
        """What a press on a handle begins; None where it was only a click."""
        raise NotImplementedError

    def make_marks(self) -> HandleMarks:
        from ....render.handles.handle_marks import HandleMarks

        return HandleMarks()

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    def attached(self, viewer: Viewer) -> None:
        self._viewer, self._marks = viewer, self.make_marks()
        viewer.overlay.add(self._marks)
        self.show_handles()

    def closing(self) -> None:
        self._viewer = self._marks = None

    def session_changed(self, before: State, after: State) -> None:
        drag = self._drag
        if drag is not None and after.document is not drag.document and after.document is not drag.shown:
            self._end()  # somebody else went on: what was dragged is no more what it was
        if before.document is not after.document or before.selection != after.selection:
            self.show_handles()

    def shown(self) -> None:
        self.show_handles()

    def show_handles(self) -> None:
        """Bring the handles up to date."""
        if self._viewer is None or self._marks is None:
            return
        handles = () if self.aside else self.handles(self._viewer)
        if self._marks.handles or handles:
            self._marks.show(handles)
            self._viewer.needs_render = True
            self._viewport.refresh()

    def press(self, event: QMouseEvent) -> bool:
        if self._held:
            return True
        if event.button() != Qt.MouseButton.LeftButton or self._viewer is None or self._marks is None:
            return False
        x, y = event.position().x(), event.position().y()
        handle = self._caught(x, y)
        if handle is None:
            return False
        self._held = True
        drag = self.begin(self._viewer, handle, x, y)
        if drag is not None:
            drag.name, drag.document = handle.name, self._session.document
            self._drag = drag
            self._marks.active = handle.name
            self._viewer.needs_render = True
        return True

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

    def key(self, event: QKeyEvent) -> bool:
        if self._drag is None:
            return False
        if event.key() == Qt.Key.Key_Escape:
            self._end()
            self._session.cancel()
        return True

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keys in a drag are no shortcuts."""
        if self._drag is not None and event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        return super().eventFilter(watched, event)

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

    def _follow(self, drag: Drag, x: float, y: float, fine: bool) -> None:
        found = drag.follow(x, y, fine)
        if found is None or drag.document is None:
            return
        drag.changes, words = found
        self.said.emit(words)
        try:
            drag.shown = OPERATIONS[drag.operation](drag.document, *drag.arguments, **drag.changes)
            self._session.preview(drag.shown)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))

    def _commit(self) -> None:
        drag = self._end()
        if drag is None:
            return
        if drag.changes is None:
            self._session.cancel()
            return
        try:
            self._session.do(drag.operation, *drag.arguments, label=drag.label, **drag.changes)
        except Refusal as refusal:
            self._session.cancel()
            self.refused.emit(sentence(refusal))

    def _end(self) -> Drag | None:
        drag, self._drag = self._drag, None
        if drag is not None and self._marks is not None:
            self._marks.active = None
            self.said.emit("")
            if self._viewer is not None:
                self._viewer.needs_render = True
        return drag
