"""The handles of the selected nodes: what stands in the picture, and the drag or the typing that is under way."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from ...model.document.document import Document, parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import resolved
from ...model.editing.session import State
from ...model.operations.operations import OPERATIONS
from .drag_contacts import DragContacts
from .entry import Entry
from .tool import Tool

if TYPE_CHECKING:
    from ...model.editing.session import Session
    from ...render.viewer import Viewer
    from ..background import Background
    from ..settings import Settings
    from ..view.viewport import Viewport
    from .handle_drags import Drag
    from .handle_picture import HandlePicture

KEYS = "type a value, Enter; Tab: next number; Ctrl: no steps, Shift: finer; Escape cancels"


class Handles(Tool):
    """`hint` says what can be done now, "" for nothing any more; `refused` why something cannot be.

    Without a mode there are the arrows that move and the handles of the primitive's sizes.
    """

    hint = Signal(str)
    refused = Signal(str)
    mode_changed = Signal()
    """The mode is another, or other tools have the clicks now, or no more."""

    def __init__(
        self,
        viewport: Viewport,
        session: Session,
        settings: Settings,
        half_spaces_seen: Callable[[], bool],
        background: Background,
        settled: Callable[[], bool],
    ) -> None:
        super().__init__(viewport)
        self.contacts = DragContacts(settings, background, settled, self)
        self.contacts.ready.connect(self._meet)
        self._half_spaces_seen = half_spaces_seen
        self._viewport, self._session, self._settings = viewport, session, settings
        self.mode = ""
        self.local = settings.flag("local_axes", False)
        self.snapping = settings.flag("snapping", True)
        self._picture: HandlePicture | None = None
        self._drag: Drag | None = None
        self._entry: Entry | None = None
        self._start: Document | None = None
        self._held = False
        """Whether the mouse drags; else the numbers are typed alone."""
        self._name = ""
        self._own = False
        self._hidden = False
        self._aside = False
        self._pointer: tuple[float, float, Qt.KeyboardModifier] | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._follow)
        viewport.installEventFilter(self)

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    # What is chosen.

    def choose(self, mode: str) -> None:
        """Take another mode, and numbers by keys; a second time in a row go back to the arrows and sizes."""
        again = mode == self.mode and (mode == "size" or (self._drag is not None and not self._held))
        self.cancel()
        self.mode = "" if again else mode
        self._show()
        if self.mode in ("move", "turn", "scale"):
            self._begin_typing()
        self._viewport.setFocus()
        self.mode_changed.emit()

    def set_local(self, local: bool) -> None:
        self.local = local
        self._settings.set_flag("local_axes", local)
        self._again()

    def refresh(self) -> None:
        """Something else is in the picture now."""
        self._show()

    def set_hidden(self, hidden: bool) -> None:
        """Take the handles out of the picture, while another tool has the clicks."""
        self._hidden = hidden
        if hidden:
            self.cancel()
        self._show()
        self.mode_changed.emit()

    @property
    def hidden(self) -> bool:
        """Whether another tool has the clicks."""
        return self._hidden

    def set_aside(self, aside: bool) -> None:
        """Leave out the handles of no mode, where the nodes of an outline take their place."""
        if aside != self._aside:
            self._aside = aside
            self._show()

    def set_snapping(self, snapping: bool) -> None:
        self.snapping = snapping
        self._settings.set_flag("snapping", snapping)

    # The viewport's side.

    def attached(self, viewer: Viewer) -> None:
        from .handle_picture import HandlePicture

        self.contacts.attached(viewer)
        self._picture = HandlePicture(viewer, self._half_spaces_seen)
        self._show()

    def closing(self) -> None:
        self._soon.stop()
        self.contacts.closing()
        self._drag = self._entry = self._picture = None

    def session_changed(self, before: State, after: State) -> None:
        if self._own:
            self._show()
            return
        if self._drag is not None and (before.selection != after.selection or before.document is not after.document):
            self._end()  # somebody else went on: what was dragged is no more what it was
            QTimer.singleShot(0, self, self._session.cancel)
        self._show()

    def shown(self) -> None:
        if self._drag is None:
            self.contacts.rest(self._session.view)
            self._show()
        else:
            self.contacts.shown()
            self._say("")

    def press(self, event: QMouseEvent) -> bool:
        if self._drag is not None and self._held:
            return True
        self.cancel()
        if event.button() != Qt.MouseButton.LeftButton or self._picture is None:
            return False
        x, y = event.position().x(), event.position().y()
        name = self._picture.caught(x, y)
        if name is None:
            return False
        try:
            drag = self._picture.gizmos.drag(name)
        except Refusal as refusal:
            self.refused.emit(str(refusal))
            return True
        drag.begin(x, y)
        self._begin(drag, name, True, x, y)
        return True

    def move(self, event: QMouseEvent) -> bool:
        x, y = event.position().x(), event.position().y()
        if self._drag is not None and self._held:
            self._pointer = (x, y, event.modifiers())
            if not self._soon.isActive():
                self._soon.start(0)
            return True
        return self._hover(x, y)

    def release(self, event: QMouseEvent) -> bool:
        if event.button() == Qt.MouseButton.LeftButton and self._drag is not None and self._held:
            if self._soon.isActive():
                self._soon.stop()
                self._follow()
            self.commit()
            self._hover(event.position().x(), event.position().y())
        return True

    def double_click(self, event: QMouseEvent) -> bool:
        return self.press(event)

    def leave(self) -> None:
        if self._drag is None:
            self._hover(-1e6, -1e6)

    def key(self, event: QKeyEvent) -> bool:
        if self._drag is None or self._entry is None:
            return False
        match event.key():
            case Qt.Key.Key_Escape:
                self.cancel()
            case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                if self._readable():
                    self.commit()
            case _ if self._entry.takes(event, self._held):
                self._entry.key(event)
                self._typed()
            case _:
                return self._held
        return True

    def _readable(self) -> bool:
        """Whether what is typed can be done as it stands; else it says why, and stays to be corrected."""
        assert self._drag is not None and self._entry is not None and self._start is not None
        if not self._entry.typing:
            return True
        try:
            self._drag.take(self._entry.numbers())
            call = self._drag.call()
            if call is not None:
                OPERATIONS[call[0]](self._start, *call[1], **call[2])
        except Refusal as refusal:
            self._say(str(refusal))
            self.refused.emit(str(refusal))
            return False
        return True

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """What is typed is no shortcut, and Tab does not leave the picture."""
        if self._drag is not None and self._entry is not None and isinstance(event, QKeyEvent):
            takes = self._entry.takes(event, self._held)
            ends = event.key() in (Qt.Key.Key_Escape, Qt.Key.Key_Return, Qt.Key.Key_Enter)
            if event.type() == QEvent.Type.ShortcutOverride and (takes or ends):
                event.accept()
                return True
            tab = event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
            if event.type() == QEvent.Type.KeyPress and takes and tab:
                self.key(event)
                self._viewport.refresh()
                return True
        if event.type() == QEvent.Type.FocusOut and self._drag is not None and not self._held:
            self.cancel()
        return super().eventFilter(watched, event)

    # One drag.

    def cancel(self) -> None:
        """Give up what is being dragged or typed; the document is the one before."""
        if self._drag is not None:
            self._end()
            self._preview(self._session.cancel)
            self._show()

    def commit(self) -> None:
        """Make it one step of the history."""
        drag = self._drag
        if drag is None:
            return
        try:
            call = drag.call()
        except Refusal as refusal:
            self.cancel()
            self.refused.emit(str(refusal))
            return
        self._end()
        if call is None:
            self._preview(self._session.cancel)
        else:
            name, arguments, more = call
            try:
                self._preview(lambda: self._session.do(name, *arguments, label=drag.label, **more))
            except Refusal as refusal:
                self._preview(self._session.cancel)
                self.refused.emit(str(refusal))
        self._show()

    def _begin(self, drag: Drag, name: str, held: bool, x: float, y: float) -> None:
        assert self._picture is not None
        if self._session.previewing:  # somebody else's: a drag goes on from the document itself
            self._session.cancel()
        self._drag, self._name, self._held = drag, name, held
        self._start = self._session.document
        values = parameter_values(self._start.parameters)[0]
        drag.resolve = lambda value: float(resolved(value, values))
        self._entry = Entry(drag.names, drag.first)
        self.contacts.begin(self._session.view, self._picture.gizmos.ids, drag)
        self._picture.begin(name if held else None)
        self._picture.go(x, y)
        self.hint.emit(f"{drag.label}: {KEYS}")
        self._say("")

    def _begin_typing(self) -> None:
        """Numbers may come by keys, without the mouse."""
        drag = None if self._picture is None else self._picture.gizmos.typed_drag(self.mode)
        if drag is not None and self._picture is not None:
            self._begin(drag, "", False, *self._picture.gizmos.pixel())

    def _again(self) -> None:
        """The axes are others now: what is typed begins anew."""
        typing = self._drag is not None and not self._held
        self.cancel()
        self._show()
        if typing:
            self._begin_typing()

    def _end(self) -> None:
        self._soon.stop()
        self._drag = self._entry = self._start = self._pointer = None
        self._held = False
        self.contacts.end()
        if self._picture is not None:
            self._picture.end()
        self.hint.emit("")
        self._changed()

    def _follow(self) -> None:
        """The newest place of the pointer, once for each pass of the event loop."""
        if self._drag is None or self._pointer is None or self._entry is None or self._picture is None:
            return
        import numpy as np

        from .handle_drags import Pointer

        x, y, held = self._pointer
        free = bool(held & Qt.KeyboardModifier.ControlModifier)
        fine = bool(held & Qt.KeyboardModifier.ShiftModifier)
        self._picture.go(x, y)
        if self._entry.typing:
            self._say("")
            return
        snap = self._picture.snap(self._name, x, y, self.snapping and not free)
        self._drag.follow(Pointer(x, y, free, fine, None if snap is None else np.array(snap.point)))
        self.contacts.hold()
        self._attempt()

    def _typed(self) -> None:
        assert self._drag is not None and self._entry is not None
        try:
            if self._entry.typing:
                self._drag.take(self._entry.numbers())
            self._attempt()
        except Refusal as refusal:
            self._say(str(refusal))

    def _attempt(self) -> None:
        """Preview what the numbers say; where they are refused the last preview stays."""
        assert self._drag is not None and self._start is not None
        start = self._start
        try:
            call = self._drag.call()
            document = start if call is None else OPERATIONS[call[0]](start, *call[1], **call[2])
        except Refusal as refusal:
            self._say(str(refusal))
            return
        self._preview(lambda: self._session.preview(document))
        self._meet()

    def _meet(self) -> None:
        """Show what the dragged parts meet."""
        self.contacts.follow()
        self._say("")

    def _preview(self, change: Callable[[], object]) -> None:
        self._own = True
        try:
            change()
        finally:
            self._own = False

    # What is drawn.

    def _show(self) -> None:
        if self._picture is not None:
            hidden = self._hidden or (self._aside and not self.mode)
            state = State(self._session.document, () if hidden else self._session.selection)
            self._picture.show(state, self.mode, self.local, self._drag is not None)
            self._changed()

    def _hover(self, x: float, y: float) -> bool:
        if self._picture is None:
            return False
        name = self._picture.caught(x, y)
        if name != self._picture.hovered:
            self._picture.hover(name, x, y, self._drag is None)
            self._viewport.setCursor(Qt.CursorShape.ArrowCursor if name is None else Qt.CursorShape.PointingHandCursor)
            self._changed()
        return name is not None

    def _say(self, fault: str) -> None:
        """The numbers beside the pointer, and what is wrong with them."""
        if self._picture is not None and self._drag is not None and self._entry is not None:
            typing = self._entry.typing or not self._held
            words = self._entry.words(self._drag.shown()) if typing else self._drag.words()
            met = self.contacts.words()
            self._picture.say(f"{words}\n {met}" if met else words, fault)
            self._changed()

    def _changed(self) -> None:
        if self._picture is not None:
            self._picture.viewer.needs_render = True
            self._viewport.refresh()
