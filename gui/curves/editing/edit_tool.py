"""Editing an outline in the picture: its nodes are chosen, dragged, added and taken away by mouse and keys."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtGui import QCursor, QKeyEvent, QMouseEvent

from ....model.document.outlines import CURVES
from ...tools.tool import Tool
from .edit_keys import EditKeys
from .live_drag import LiveDrag
from .node_edits import insert_at, next_kind

if TYPE_CHECKING:
    from ....model.editing.session import Session, State
    from ....render.viewer import Viewer
    from ...settings import Settings
    from ...tools.handles import Handles
    from ...view.viewport import Viewport
    from ..active import ActiveCurve, Place
    from .edit_picture import EditPicture, Hit

SLACK = 4  # pixels the pointer may move in a click
SHIFT, CONTROL, ALT = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
)
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
TAB = (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)

IDLE = "Drag nodes, handles or the curve; double click: new node; Shift+drag: choose a box; right click: more"
HINTS = {
    "node": "Drag: move, double click: next kind; Shift: add to the choice",
    "handle": "Drag: pull the handle; Shift: 15° steps, Alt: break the node, Ctrl: no snapping",
    "curve": "Click: choose the segment; drag: bend it; double click: new node here",
    "knob": "Drag: scale or turn; Shift: in proportion, 15° steps; Ctrl: about the middle",
}
POINT_HINTS = HINTS | {
    "node": "Drag: move the control point; Shift: add to the choice",
    "curve": "Click: choose the point that acts most here; drag: bend; double click: one more control point",
}
CURSORS = {
    "node": Qt.CursorShape.SizeAllCursor,
    "handle": Qt.CursorShape.CrossCursor,
    "curve": Qt.CursorShape.PointingHandCursor,
    "knob": Qt.CursorShape.PointingHandCursor,
}


class EditTool(Tool):
    """Has the clicks while one outline of points is selected, no handles of a mode are shown and no tool is in use.

    `said` tells what the mouse would do, "" at the end; `menu_asked` where on the screen a menu on nodes is wanted.
    """

    said = Signal(str)
    menu_asked = Signal(QPoint)
    box_changed = Signal()

    def __init__(
        self, session: Session, viewport: Viewport, active: ActiveCurve, handles: Handles, settings: Settings
    ) -> None:
        super().__init__(viewport)
        self._session, self._viewport, self._active, self._handles = session, viewport, active, handles
        self._settings = settings
        self.box = settings.flag("transform_box", False)
        self._keys = EditKeys(active)
        self._picture: EditPicture | None = None
        self._pressed: QMouseEvent | None = None
        self._hit: Hit | None = None
        self._click: Callable[[], None] | None = None
        """What a release without a drag does."""
        self._live = LiveDrag(session, active, lambda: handles.snapping, self)
        self._frame_from: tuple[float, float] | None = None
        self._orbiting = False
        self._hint = ""
        self._hovered: Hit | None = None
        viewport.installEventFilter(self)
        viewport.view_changed.connect(self._zoomed)
        active.changed.connect(self.refresh)
        handles.mode_changed.connect(self.refresh)
        self._live.ended.connect(self.refresh)

    @property
    def active(self) -> bool:
        """Whether there is an outline to edit, and the clicks are this tool's."""
        free = not self._handles.mode and not self._handles.hidden
        return self._picture is not None and self._editable and free

    @property
    def _editable(self) -> bool:
        return isinstance(self._active.node, CURVES) and self._active.path is not None

    @property
    def dragging(self) -> bool:
        return self._live.running or self._orbiting

    @property
    def chosen(self) -> bool:
        """Whether keys mean the chosen nodes."""
        return self.active and bool(self._active.chosen)

    def set_box(self, box: bool) -> None:
        """Show a box with knobs around two or more chosen nodes, or none."""
        self.box = box
        self._settings.set_flag("transform_box", box)
        self.refresh()
        self.box_changed.emit()

    def refresh(self) -> None:
        """The outline, the choice or the tools in use are others now."""
        self._handles.set_aside(self._editable)
        if self._picture is None:
            return
        self._picture.show(self.active, self.box and not self._live.running)
        if not self.active:
            self._hover(None)
            self._drop()
        self._say()
        self._viewport.refresh()

    # The viewport's side.

    def attached(self, viewer: Viewer) -> None:
        from .edit_picture import EditPicture

        self._picture = EditPicture(self._viewport, viewer, self._session, self._active)
        self.refresh()

    def closing(self) -> None:
        self._live.stop()
        self._picture = None

    def session_changed(self, before: State, after: State) -> None:
        self._live.session_changed()

    def _zoomed(self) -> None:
        if self._picture is not None and self.active:
            self._picture.zoomed()

    def press(self, event: QMouseEvent) -> bool:
        if self._pressed is not None:
            return True
        if not self.active or self._picture is None or event.button() not in (LEFT, RIGHT):
            return False
        held = event.modifiers()
        x, y = event.position().x(), event.position().y()
        hit = self._picture.hit(x, y)
        self._click = None
        if event.button() == RIGHT:
            if hit is None or hit.kind == "knob":
                return False
            self._click = lambda: self._ask_menu(hit)
        elif hit is not None:
            self._click = self._catch(hit, bool(held & SHIFT))
        elif held & SHIFT and not held & ALT and not self._picture.viewer.cube_hit(x, y):
            self._frame_from = (x, y)
        elif not held and self._active.chosen and self._nothing_at(x, y):
            self._click = lambda: self._active.choose(())
        else:
            return False
        self._hit = hit if event.button() == LEFT else None
        self._pressed = event.clone()
        return True

    def _nothing_at(self, x: float, y: float) -> bool:
        assert self._picture is not None
        viewer = self._picture.viewer
        return not viewer.cube_hit(x, y) and viewer.pick(x, y) is None

    def _catch(self, hit: Hit, more: bool) -> Callable[[], None] | None:
        """Choose what a press means at once; what it means if no drag follows is the answer."""
        active = self._active
        if hit.kind == "curve":
            places = self._segment(hit)
            return lambda: active.choose(places, "add" if more else "replace")
        if hit.kind != "node":
            return None
        place = active.rows[hit.index]
        if place not in active.chosen:
            active.choose([place], "add" if more else "replace")
            return None
        return lambda: active.choose([place], "toggle" if more else "replace")

    def _segment(self, hit: Hit) -> list[Place]:
        """The nodes of a segment, or the control point that acts most."""
        assert self._picture is not None and self._picture.edited is not None
        edited = self._picture.edited
        if not edited.by_points:
            return [edited.rows[number] for number in edited.segment_nodes[hit.index].tolist()]
        from .edit_drags import shares

        share = shares(edited, hit.index, hit.parameter)
        return [] if share is None else [edited.rows[int(share.argmax())]]

    def move(self, event: QMouseEvent) -> bool:
        x, y = event.position().x(), event.position().y()
        if self._pressed is None:
            if not self.active or self._picture is None:
                return False
            hit = None if event.buttons() else self._picture.hit(x, y)
            self._hover(hit)
            return hit is not None
        if not self._live.running and self._frame_from is None and not self._orbiting:
            if (event.position() - self._pressed.position()).manhattanLength() <= SLACK:
                return True
            self._begin()
        if self._orbiting and self._viewport.navigation is not None:
            self._viewport.navigation.move(event)
        elif self._frame_from is not None and self._picture is not None:
            self._picture.set_frame((self._frame_from, (x, y)))
        else:
            self._live.point(event)
        return True

    def release(self, event: QMouseEvent) -> bool:
        pressed = self._pressed
        if pressed is None:
            return False
        if event.button() != pressed.button():
            return True
        moved = (event.position() - pressed.position()).manhattanLength() > SLACK
        self._pressed, click, self._click = None, self._click, None
        if self._orbiting:
            self._orbiting = False
            if self._viewport.navigation is not None:
                self._viewport.navigation.release(event)
        elif self._frame_from is not None:
            self._choose_frame(event, moved)
        elif self._live.running:
            self._live.finish(event)
        elif click is not None and not moved:
            click()
        self._hit = None
        if self._picture is not None and self.active:
            self._hover(self._picture.hit(event.position().x(), event.position().y()))
        return True

    def double_click(self, event: QMouseEvent) -> bool:
        """On a node its next kind, on the curve a new node, which leaves the shape."""
        if not self.active or self._picture is None or event.button() != LEFT:
            return False
        hit = self._picture.hit(event.position().x(), event.position().y())
        if hit is None or event.modifiers():
            return self.press(event)
        if hit.kind == "node":
            next_kind(self._active, self._active.rows[hit.index])
        elif hit.kind == "curve" and self._picture.edited is not None:
            insert_at(self._active, self._picture.edited, hit)
        return True

    def leave(self) -> None:
        if self._pressed is None:
            self._hover(None)

    def key(self, event: QKeyEvent) -> bool:
        if self._frame_from is not None and event.key() == Qt.Key.Key_Escape:
            self._drop()
            return True
        if self._live.running:
            self._live.key(event)
            return True
        return self.active and self._picture is not None and self._keys.press(event, self._picture)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """What is typed in a drag, or means the chosen nodes, is no shortcut; and Tab does not leave the picture."""
        if isinstance(event, QKeyEvent) and (self._live.running or self.active):
            wanted = self._live.running or self._keys.takes(event)
            if event.type() == QEvent.Type.ShortcutOverride and wanted:
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyPress and event.key() in TAB and wanted:
                self.key(event)
                self._viewport.refresh()
                return True
        return super().eventFilter(watched, event)

    # What a press leads to.

    def _begin(self) -> None:
        """The pointer has moved with the button held: what was pressed is dragged, or else the view is."""
        assert self._pressed is not None
        if self._hit is not None and self._picture is not None:
            place = self._pressed.position()
            if not self._live.begin(self._picture, self._hit, (place.x(), place.y())):
                self._hit = None
            self._picture.catch(None)
            self._picture.show(True, False)
        elif self._viewport.navigation is not None and self._hit is None:
            self._orbiting = True
            self._viewport.navigation.press(self._pressed)

    def _choose_frame(self, event: QMouseEvent, moved: bool) -> None:
        begin, self._frame_from = self._frame_from, None
        if self._picture is None or begin is None:
            return
        self._picture.set_frame(None)
        if moved:
            found = self._picture.within(begin, (event.position().x(), event.position().y()))
            self._active.choose(found, "toggle" if event.modifiers() & CONTROL else "add")

    def _ask_menu(self, hit: Hit) -> None:
        """For a node or a segment, which is chosen then unless it is already."""
        if hit.kind == "handle":
            return
        places = [self._active.rows[hit.index]] if hit.kind == "node" else self._segment(hit)
        if not set(places) <= self._active.chosen:
            self._active.choose(places)
        self.menu_asked.emit(QCursor.pos())

    def _drop(self) -> None:
        """Forget what is pressed, as when the tool ends."""
        self._live.cancel()
        if self._frame_from is not None and self._picture is not None:
            self._picture.set_frame(None)
        self._frame_from = self._hit = self._click = None

    # What is told.

    def _hover(self, hit: Hit | None) -> None:
        if self._picture is None or hit == self._hovered:
            return
        before, self._hovered = self._hovered, hit
        self._picture.catch(hit)
        kind = None if hit is None else hit.kind
        if kind != (None if before is None else before.kind):
            shape = Qt.CursorShape.ArrowCursor if kind is None else CURSORS[kind]
            self._viewport.setCursor(shape)
            self._say()

    def _say(self) -> None:
        """What the mouse would do; only where that is something else than was said."""
        hint = ""
        if self.active:
            hints = POINT_HINTS if self._active.by_points else HINTS
            hint = IDLE if self._hovered is None else hints[self._hovered.kind]
        if hint != self._hint:
            self._hint = hint
            self.said.emit(hint)
