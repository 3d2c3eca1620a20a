"""One drag of an outline's nodes, handles or curve: from the pointer or typed numbers to previews, and to one step."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from ....model.document.document import parameter_values
from ....model.document.errors import Refusal
from ....model.document.expression import resolved
from ...tools.entry import Entry

if TYPE_CHECKING:
    from ....model.editing.session import Session
    from ..active import ActiveCurve
    from .edit_drags import Drag, Held
    from .edit_picture import EditPicture, Hit

SHIFT, CONTROL, ALT = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
)
ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
EDGE_ON = "the outline is seen from its edge: turn the view"


class LiveDrag(QObject):
    """Every preview is made from the document at the beginning. `ended` comes when the drag is over, either way."""

    ended = Signal()

    def __init__(
        self, session: Session, active: ActiveCurve, snapping: Callable[[], bool], parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._active, self._snapping = session, active, snapping
        self._picture: EditPicture | None = None
        self._drag: Drag | None = None
        self._entry: Entry | None = None
        self._offset = (0.0, 0.0)
        self._pointer: tuple[QPointF, Qt.KeyboardModifier] | None = None
        self._own = False
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._follow)

    @property
    def running(self) -> bool:
        return self._drag is not None

    def begin(self, picture: EditPicture, hit: Hit, pressed: tuple[float, float]) -> bool:
        """Take what was hit at a pixel; false where it cannot be dragged, which is told."""
        from .grips import grip

        found = grip(picture, self._active.chosen, hit, pressed)
        if found is None:
            self._active.refused.emit(f"Nothing can be dragged here: {EDGE_ON}")
            return False
        self._picture = picture
        self._drag, self._offset = found
        values = parameter_values(self._active.document.parameters)[0]
        self._drag.resolve = lambda value: float(resolved(value, values))
        self._entry = Entry(self._drag.names, self._drag.first)
        return True

    def point(self, event: QMouseEvent) -> None:
        """The pointer is elsewhere; what that means comes once for each pass of the event loop."""
        if self._drag is not None:
            self._pointer = event.position(), event.modifiers()
            if not self._soon.isActive():
                self._soon.start(0)

    def finish(self, event: QMouseEvent) -> None:
        """The button was released."""
        if self._soon.isActive():
            self._soon.stop()
            self._follow()
        self.commit()

    def key(self, event: QKeyEvent) -> None:
        if self._entry is None:
            return
        if event.key() == Qt.Key.Key_Escape:
            self.cancel()
        elif event.key() in ENTER:
            self.commit()
        elif self._entry.takes(event, True):
            self._entry.key(event)
            self._typed()

    def session_changed(self) -> None:
        """Where somebody else went on, what was dragged is no more what it was."""
        if self._drag is not None and not self._own:
            self.stop()
            QTimer.singleShot(0, self, self._session.cancel)
            self.ended.emit()

    def commit(self) -> None:
        """Make it one step of the history."""
        drag = self._drag
        if drag is None:
            return
        calls = drag.calls()
        self.stop()
        if calls:
            self._as_own(lambda: self._active.do_all(calls, drag.label))
        else:
            self._as_own(self._session.cancel)
        self.ended.emit()

    def cancel(self) -> None:
        """Give it up; the document is the one before."""
        if self._drag is not None:
            self.stop()
            self._as_own(self._session.cancel)
            self.ended.emit()

    def stop(self) -> None:
        """Forget the drag; what is previewed stays."""
        self._soon.stop()
        if self._picture is not None:
            self._picture.end()
        self._drag = self._entry = self._picture = self._pointer = None

    def _held(self) -> Held:
        from .edit_drags import Held

        held = Qt.KeyboardModifier.NoModifier if self._pointer is None else self._pointer[1]
        return Held(bool(held & SHIFT), bool(held & CONTROL), bool(held & ALT))

    def _follow(self) -> None:
        if self._drag is None or self._entry is None or self._pointer is None or self._picture is None:
            return
        if self._entry.typing:
            self._label()
            return
        held, position = self._held(), self._pointer[0]
        pixel = (position.x() - self._offset[0], position.y() - self._offset[1])
        snap = self._picture.reached(pixel, self._drag.plane, self._drag.wish(held), self._snapping())
        if snap is None:
            self._label(EDGE_ON)
            return
        self._drag.follow(snap.point, held)
        self._attempt(snap.words)

    def _typed(self) -> None:
        assert self._drag is not None and self._entry is not None
        try:
            if self._entry.typing:
                self._drag.take(self._entry.numbers())
        except Refusal as refusal:
            self._label(str(refusal))
            return
        self._attempt()

    def _attempt(self, note: str = "") -> None:
        """Preview what the numbers say; where they are refused the last preview stays."""
        assert self._drag is not None
        calls = self._drag.calls()
        try:
            self._as_own(lambda: self._active.preview_all(calls))
        except Refusal as refusal:
            self._label(str(refusal))
            return
        self._label(note=note)

    def _label(self, fault: str = "", note: str = "") -> None:
        if self._picture is None or self._drag is None or self._entry is None or self._pointer is None:
            return
        words = self._entry.words(self._drag.shown()) if self._entry.typing else self._drag.words()
        position = self._pointer[0]
        self._picture.say(f"{words}   {note}" if note else words, (position.x(), position.y()), fault)

    def _as_own(self, change: Callable[[], object]) -> None:
        self._own = True
        try:
            change()
        finally:
            self._own = False
