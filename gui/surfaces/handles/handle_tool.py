"""What the handles of lights and of textures have in common: hover, drag as a preview, drop as a step, Escape."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent

from ....model.document.errors import Refusal
from ....model.operations.operations import OPERATIONS
from ...panels.property_edit import sentence
from ...tools.drag_tool import DragTool

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


class HandleTool(DragTool[Drag]):
    """What is shown comes from `handles`, a drag from `begin`."""

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(session, viewport, parent)
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

    def attached(self, viewer: Viewer) -> None:
        self._viewer, self._marks = viewer, self.make_marks()
        viewer.overlay.add(self._marks)
        self.show_handles()

    def session_changed(self, before: State, after: State) -> None:
        self._drop_outdated(after)
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

    def key(self, event: QKeyEvent) -> bool:
        if self._drag is None:
            return False
        if event.key() == Qt.Key.Key_Escape:
            self._end()
            self._session.cancel()
        return True

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
