"""The handle of the chosen section: an arrow that shifts its plane, arcs that tilt it; and picking a face to cut at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from ...model.document.document import Section
from ...model.document.errors import Refusal
from ...model.document.expression import Expression
from ...model.editing.session import Session, State
from ...model.operations.operations import OPERATIONS
from ...model.operations.sections import moved_to, position
from .drag_tool import DragTool
from .entry import Entry

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...render.handles.handle import Handle
    from ...render.pick import Pick
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport

NAME = "section"  # of the arrow; the arcs are "section tilt u" and "section tilt v"
ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
SPREAD = 1.15  # the border's side over the extent of what is shown


@dataclass(slots=True)
class _Drag:
    handle: Handle
    section: Section
    document: Document | None
    start: float
    """Where the pointer was: mm along the arrow, or degrees on the arc."""
    unit: str
    entry: Entry
    """What is typed instead: the plane's position, or by how much it is tilted."""
    last: float = 0.0
    changes: dict[str, Any] | None = None
    shown: Document | None = None
    """What is previewed."""


class SectionTool(DragTool[_Drag]):
    """`chosen` tells the section whose handle is shown, "" for none."""

    chosen = Signal(str)

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(session, viewport, parent)
        self._take_face: Callable[[Pick], None] | None = None
        self.name = ""
        self.open = True
        """Whether sections open the picture at all."""

    @property
    def section(self) -> Section | None:
        """The chosen section."""
        return next((one for one in self._session.document.sections if one.name == self.name), None)

    def choose(self, name: str) -> None:
        """Show the handle of this section; "" for none."""
        if name != self.name:
            self.name = name
            self.chosen.emit(name)
        self._show()

    def set_open(self, shown: bool) -> None:
        """Let the sections open the picture, or show the solids whole."""
        self.open = shown
        self._open_picture()
        self._show()

    def figures(self, name: str) -> tuple[float, float] | None:
        """Area (mm²) and perimeter (mm) of what an open section cuts in the picture; None where it opens none."""
        if self._viewer is None or not self.open:
            return None
        outlines = self._viewer.scene.sections.outlines(name).values()
        return sum(outline.area for outline in outlines), sum(outline.perimeter for outline in outlines)

    def _open_picture(self) -> None:
        if self._viewer is not None:
            sections = self._session.document.sections if self.open else ()
            self._viewer.set_sections(sections, self._session.previewing)
            self._viewport.refresh()

    def ask_face(self, take: Callable[[Pick], None]) -> None:
        """The next click on a face is handed to `take`; Escape or a click beside all faces ends that."""
        self._take_face = take
        self.said.emit("Click the face to cut at; Escape ends this")

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.handle_marks import HandleMarks

        self._viewer, self._marks = viewer, HandleMarks()
        viewer.overlay.add(self._marks)
        self._open_picture()
        self._show()

    def session_changed(self, before: State, after: State) -> None:
        self._drop_outdated(after)
        if before.document is not after.document:
            self._open_picture()
        if before.document.sections is not after.document.sections:
            if self.name and self.section is None:
                self.choose("")
            self._show()

    def shown(self) -> None:
        self._show()

    # The pointer.

    def press(self, event: QMouseEvent) -> bool:
        if self._held:
            return True
        if event.button() != Qt.MouseButton.LeftButton or self._viewer is None:
            return False
        x, y = event.position().x(), event.position().y()
        if self._take_face is not None:
            take, self._take_face = self._take_face, None
            self.said.emit("")
            pick = self._viewer.pick(x, y)
            if pick is None:
                self.refused.emit("There is no face under the pointer")
            else:
                try:
                    take(pick)
                except Refusal as refusal:
                    self.refused.emit(str(refusal))
            self._held = True
            return True
        handle, section = self._caught(x, y), self.section
        if handle is None or section is None or self._marks is None:
            return False
        start = self._reached(handle, x, y)
        if start is None:
            return False
        unit = " mm" if handle.name == NAME else "°"
        self._drag = _Drag(handle, section, self._session.document, start, unit, Entry((unit.strip(),)))
        self._held = True
        self._marks.active = handle.name
        self._viewer.needs_render = True
        return True

    def key(self, event: QKeyEvent) -> bool:
        drag = self._drag
        if drag is not None:
            if event.key() == Qt.Key.Key_Escape:
                self._end()
                self._session.cancel()
            elif event.key() in ENTER:
                self._commit()
            elif drag.entry.takes(event, True):
                drag.entry.key(event)
                self._typed(drag)
            return True
        if event.key() != Qt.Key.Key_Escape:
            return False
        if self._take_face is not None:
            self._take_face = None
            self.said.emit("")
        elif self.name and not self._session.selection:
            self.choose("")
        else:
            return False
        return True

    # The plane.

    def _reached(self, handle: Handle, x: float, y: float) -> float | None:
        """Millimetres along the handle's arrow, or degrees on its arc."""
        from ...render.handles.drag import along_axis, ring_angle

        assert self._viewer is not None
        if handle.name == NAME:
            return along_axis(*self._viewer.ray(x, y), handle.origin, handle.axes[2])
        axis = handle.axes[0 if handle.name.endswith("u") else 1]
        grabbed = handle.origin + handle.length(self._viewer.camera, self._viewer.size) * 62.0 * handle.axes[2]
        return ring_angle(self._viewer.camera, self._viewer.size, (x, y), handle.origin, axis, grabbed)

    def _follow(self, drag: _Drag, x: float, y: float, fine: bool) -> None:
        from ...render.handles.drag import pixel_length, step_for, stepped, stepped_angle, unwrapped

        assert self._viewer is not None
        reached = None if drag.entry.typing else self._reached(drag.handle, x, y)
        if reached is None:
            return
        if drag.handle.name == NAME:
            length = pixel_length(self._viewer.camera, drag.handle.origin, self._viewer.size)
            step = step_for(length, 4.0) * (0.1 if fine else 1.0)
            forward = -1.0 if -1.0 in drag.section.normal else 1.0  # see `position`
            self._apply(drag, stepped(position(drag.section) - forward * (reached - drag.start), step))
        else:
            drag.last = unwrapped(reached - drag.start, drag.last)
            self._apply(drag, stepped_angle(drag.last, fine))

    def _apply(self, drag: _Drag, value: float) -> None:
        """Show the plane at this position, or tilted by these degrees."""
        import numpy as np

        if drag.handle.name == NAME:
            drag.changes = {"point": moved_to(drag.section, value)}
        else:
            axis, outward = drag.handle.axes[0 if drag.handle.name.endswith("u") else 1], drag.handle.axes[2]
            turn = np.radians(value)
            normal = -(np.cos(turn) * outward + np.sin(turn) * np.cross(axis, outward))
            drag.changes = {"point": _plain(drag.handle.origin), "normal": _plain(normal)}
        self._tell(drag, f"{value:g}")
        try:
            drag.shown = OPERATIONS["set_section"](drag.document, drag.section.name, **drag.changes)
            self._session.preview(drag.shown)
        except Refusal as refusal:
            self.refused.emit(str(refusal))

    def _typed(self, drag: _Drag) -> None:
        try:
            (value,) = drag.entry.numbers()
            if value is None:
                self._tell(drag, "")
            else:
                self._apply(drag, value.evaluate({}) if isinstance(value, Expression) else value)
        except Refusal as refusal:
            self._tell(drag, "")
            self.refused.emit(str(refusal))

    def _tell(self, drag: _Drag, value: str) -> None:
        self.said.emit(f"{drag.section.name}: {drag.entry.words([value]) if drag.entry.typing else value + drag.unit}")

    def _commit(self) -> None:
        drag = self._end()
        if drag is None:
            return
        if drag.changes is None:
            self._session.cancel()
            return
        label = f"{'Shift' if drag.handle.name == NAME else 'Tilt'} {drag.section.name}"
        try:
            self._session.do("set_section", drag.section.name, label=label, **drag.changes)
        except Refusal as refusal:
            self._session.cancel()
            self.refused.emit(str(refusal))

    def _show(self) -> None:
        if self._viewer is None or self._marks is None:
            return
        from ...render.handles.gizmo import border_handle, plane_axes, plane_handles

        handles: tuple[Handle, ...] = ()
        section, bounds = self.section, self._viewer.scene.visible_bounds()
        if section is not None and section.active and self.open and bounds is not None:
            import numpy as np

            normal, middle = np.asarray(section.normal), bounds.mean(axis=0)
            centre = middle + normal * float(normal @ (section.point - middle))
            reach = np.abs(plane_axes(-normal)[:2]) @ np.ptp(bounds, axis=0)
            border = border_handle(f"{NAME} square", centre, -normal, SPREAD * float(reach.max()))
            handles = (border, *plane_handles(NAME, centre, -normal, None))
        if self._marks.handles or handles:
            self._marks.show(handles)
            self._viewer.needs_render = True
            self._viewport.refresh()


def _plain(values: Any) -> tuple[float, ...]:
    """Without the last bits, which say nothing and would stand in the script."""
    return tuple(round(float(value), 9) + 0.0 for value in values)
