"""The drawing tools as modes of the picture: presses, moves and keys become an outline on the work plane."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from ....model.document.errors import Refusal
from ....model.editing.session import Session, State
from ...tools.tool import Tool
from ...view.viewport import Viewport
from .work_plane import WorkPlane

if TYPE_CHECKING:
    from ....render.viewer import Viewer
    from .draft import Draft, Floats, Held, Options
    from .draft_picture import DraftView
    from .drawing import Drawing
    from .snapping import Snapper

SLACK = 4  # pixels the pointer may move in a click
EDGE_ON = "The work plane is seen from its edge: turn the view, or look at it (Curve, Look at the work plane)"
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
UP_DOWN = (Qt.Key.Key_Up, Qt.Key.Key_Down)


class DrawTool(Tool):
    """Does nothing until `start`. `said` tells what to do next, "" at the end; `changed` that the kind is another, or
    its options.

    One outline is drawn, inserted as one step and selected; then the tool ends. `snapping` tells whether points go to
    what is near.
    """

    said = Signal(str)
    refused = Signal(str)
    began = Signal()
    ended = Signal()
    changed = Signal()

    def __init__(
        self,
        session: Session,
        viewport: Viewport,
        plane: WorkPlane,
        snapping: Callable[[], bool],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._viewport, self.plane = session, viewport, plane
        self._snapping = snapping
        self.kind = ""
        self._viewer: Viewer | None = None
        self._view: DraftView | None = None
        self._snapper: Snapper | None = None
        self._options: Options | None = None
        self._drawing: Drawing | None = None
        self._pressed: QMouseEvent | None = None
        self._moved = False
        plane.changed.connect(self._replaned)
        viewport.installEventFilter(self)

    @property
    def active(self) -> bool:
        return bool(self.kind)

    @property
    def dragging(self) -> bool:
        return self._pressed is not None and self._pressed.button() == LEFT

    @property
    def draft(self) -> Draft | None:
        return None if self._drawing is None else self._drawing.draft

    @property
    def begun(self) -> bool:
        return self._drawing is not None and self._drawing.draft.begun

    @property
    def options(self) -> Options:
        """What the bar shows and sets."""
        if self._options is None:
            from .draft import Options

            self._options = Options()
        return self._options

    def start(self, kind: str) -> None:
        """Begin with a kind of DRAFTS of drawing.py; what another one has begun is given up. Raises Refusal."""
        from .draft_picture import DraftView
        from .drawing import Drawing
        from .snapping import Snapper

        if self._viewer is None:
            raise Refusal("the picture is not there yet")
        if self._view is None:
            self._view = DraftView(self._viewer)
        fresh, self.kind = not self.active, kind
        if self._snapper is None:
            self._snapper = Snapper(self._viewport, self._session)
        self._pressed = None
        self._drawing = Drawing(kind, self.options, self._session, self._viewport, self.plane, self._snapper)
        if fresh:
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
        self._viewport.setFocus()
        self._show()
        self.changed.emit()

    def end(self) -> None:
        """Give up what is being drawn, and stop."""
        if not self.active:
            return
        self.kind = ""
        self._drawing = self._pressed = None
        if self._view is not None:
            self._view.hide()
            self._redraw(self._view.viewer)
        self._viewport.unsetCursor()
        self.said.emit("")
        self.ended.emit()
        self.changed.emit()

    def refresh(self) -> None:
        """The options are others."""
        self._show()
        self._viewport.setFocus()

    def _anew(self) -> None:
        self._pressed = None
        if self._drawing is not None:
            self._drawing.anew()
            self._show()

    def _replaned(self) -> None:
        """The draft was meant for the plane that was."""
        self._anew()

    # The viewport's side.

    def attached(self, viewer: Viewer) -> None:
        self._viewer = viewer

    def closing(self) -> None:
        self.end()
        self._viewer = self._view = self._snapper = None

    def session_changed(self, before: State, after: State) -> None:
        if self._drawing is not None and not self._drawing.stands():
            self._anew()

    def press(self, event: QMouseEvent) -> bool:
        drawing, view = self._drawing, self._view
        if drawing is None or view is None:
            return False
        if self._pressed is not None:
            return True
        x, y = event.position().x(), event.position().y()
        if event.button() not in (LEFT, RIGHT) or (event.button() == LEFT and view.viewer.cube_hit(x, y)):
            return False
        self._pressed, self._moved = event.clone(), False
        if event.button() == RIGHT:
            return True
        drawing.begin_at((x, y))
        point = self._look(event)
        if point is None:
            self.refused.emit(EDGE_ON)
        else:
            self._do(lambda: drawing.draft.press(point, _held(event)))
        return True

    def move(self, event: QMouseEvent) -> bool:
        drawing, view, pressed = self._drawing, self._view, self._pressed
        if drawing is None or view is None:
            return False
        position = event.position()
        if pressed is not None and not self._moved:
            self._moved = (position - pressed.position()).manhattanLength() > SLACK
            if self._moved and pressed.button() == RIGHT and self._viewport.navigation is not None:
                self._viewport.navigation.press(pressed)
        if pressed is not None and pressed.button() == RIGHT:
            if self._moved and self._viewport.navigation is not None:
                self._viewport.navigation.move(event)
            return True
        if pressed is None and (event.buttons() or view.viewer.cube_hit(position.x(), position.y())):
            self.leave()
            return False
        point = self._look(event)
        if point is not None and pressed is None:
            drawing.draft.hover(point, _held(event))
            drawing.follow_typed()
        elif point is not None and self._moved:
            drawing.draft.drag(point, _held(event))
        self._show()
        return True

    def release(self, event: QMouseEvent) -> bool:
        drawing, pressed = self._drawing, self._pressed
        if pressed is None or event.button() != pressed.button():
            return pressed is not None
        self._pressed = None
        if pressed.button() == RIGHT:
            if not self._moved:
                self._finish(closed=False)
            elif self._viewport.navigation is not None:
                self._viewport.navigation.release(event)
            return True
        point = self._look(event)
        if drawing is not None and point is not None:
            self._do(lambda: drawing.draft.release(point, _held(event), self._moved))
        return True

    def double_click(self, event: QMouseEvent) -> bool:
        """The first of both clicks has set a point; the second one ends what has any number of them."""
        draft = self.draft
        if draft is None or not draft.many or event.button() != LEFT:
            return self.press(event)
        if draft.begun:
            self._finish(closed=False)
        return True

    def leave(self) -> None:
        if self._drawing is not None:
            self._drawing.leave()
            self._show()

    # Keys.

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """What is typed here is no shortcut, and Tab does not leave the picture."""
        if self.active and isinstance(event, QKeyEvent) and self._takes(event):
            if event.type() == QEvent.Type.ShortcutOverride:
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyPress and event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
                self.key(event)
                return True
        return super().eventFilter(watched, event)

    def _takes(self, event: QKeyEvent) -> bool:
        drawing, key = self._drawing, event.key()
        if drawing is None:
            return False
        if key == Qt.Key.Key_Escape or key in ENTER or drawing.typed.takes(event):
            return True
        draft = drawing.draft
        undo = key == Qt.Key.Key_Z and event.modifiers() == Qt.KeyboardModifier.ControlModifier
        if not draft.begun or key == Qt.Key.Key_Backspace or undo:
            return draft.begun
        plain = event.modifiers() in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier)
        return plain and ((key == Qt.Key.Key_C and draft.many) or (key in UP_DOWN and draft.counts))

    def key(self, event: QKeyEvent) -> bool:
        drawing, key = self._drawing, event.key()
        if drawing is None or not self._takes(event):
            return False
        draft, typed = drawing.draft, drawing.typed
        if key == Qt.Key.Key_Escape:
            if typed.typing:
                typed.clear()
            elif draft.begun:
                self._anew()
            else:
                self.end()
        elif key in ENTER:
            if typed.typing:
                self._do(drawing.enter)
            else:
                self._finish(closed=bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif typed.takes(event):
            typed.key(event)
        elif key == Qt.Key.Key_C:
            self._finish(closed=True)
        elif key in UP_DOWN:
            draft.step(1 if key == Qt.Key.Key_Up else -1)
            self.changed.emit()
        else:
            draft.back()
        drawing.follow_typed()
        self._show()
        return True

    # The drawing.

    def _look(self, event: QMouseEvent) -> Floats | None:
        """(2,) what the pointer means on the plane."""
        assert self._drawing is not None and self._view is not None
        self.options.pixel = self._view.pixel
        held, place = event.modifiers(), event.position()
        free = bool(held & Qt.KeyboardModifier.ControlModifier) or not self._snapping()
        return self._drawing.look((place.x(), place.y()), bool(held & Qt.KeyboardModifier.ShiftModifier), free)

    def _do(self, change: Callable[[], object]) -> None:
        """Let a press, a release or a key count. What is refused is told, and changes nothing."""
        drawing = self._drawing
        assert drawing is not None
        try:
            if drawing.settle(change):
                self.end()
                return
            if not self.dragging:
                drawing.typed.clear()
        except Refusal as refusal:
            self.refused.emit(str(refusal))
        self._show()

    def _finish(self, closed: bool) -> None:
        """Let the draft be all, or end the tool where there is none."""
        drawing = self._drawing
        if drawing is None or not drawing.draft.begun:
            self.end()
        else:
            self._do(lambda: drawing.draft.finish(closed))

    def _show(self) -> None:
        if self._drawing is not None and self._view is not None:
            self.said.emit(self._drawing.show(self._view))
            self._redraw(self._view.viewer)

    def _redraw(self, viewer: Viewer) -> None:
        viewer.needs_render = True
        self._viewport.refresh()


def _held(event: QMouseEvent) -> Held:
    from .draft import Held

    modifiers: Qt.KeyboardModifier = event.modifiers()
    return Held(bool(modifiers & Qt.KeyboardModifier.ShiftModifier), bool(modifiers & Qt.KeyboardModifier.AltModifier))
