"""The picture in the middle: a canvas that a Viewer draws into, and who gets its events: tools, then navigation."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, QSize, Qt, Signal
from PySide6.QtGui import QHelpEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QToolTip, QWidget

from ...model.editing.session import Session, State
from ...model.surface.light import lights_of
from .canvas import Canvas
from .flight import Flight
from .occurrences import Path, paths_through, selected_bounds
from .painted import Painted
from .pointing import Pointing

if TYPE_CHECKING:
    from ...render.camera import Camera
    from ...render.pick import Pick
    from ...render.viewer import Viewer
    from ..tools.tool import Tool
    from .navigation import Navigation


class Viewport(Canvas):
    """Shows meshes by root id. VTK is loaded by `attach`, when the window is already on the screen.

    `ready` comes once, after `attach`; `displayed` carries the solids' meshes in the picture by id, whenever they
    may be others and before they are drawn; `hovered` carries words on what lies under the pointer, "" for nothing;
    `menu_asked` is Pointing's.
    """

    ready = Signal()
    displayed = Signal(dict)
    hovered = Signal(str)
    menu_asked = Signal(list, QPoint)
    view_changed = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("viewport")
        self.setAccessibleName("Viewport")
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)  # a right drag pans: a click alone asks
        self.setMinimumSize(200, 150)
        self.viewer: Viewer | None = None
        self.navigation: Navigation | None = None
        self.tools: list[Tool] = []
        self._holder: Tool | None = None
        self._session = session
        self._meshes: dict[str, Any] = {}
        self._painted = Painted()
        self.pointing: Pointing | None = None
        self._fit_pending = True
        self._pending: list[Callable[[Viewer], None]] = []
        self.flight = Flight(self)
        self.flight.moved.connect(self._flown)

    def attach(self, theme: str) -> None:
        """Load VTK and begin to draw."""
        from ...render.viewer import Viewer
        from .navigation import Navigation

        self.viewer = Viewer(int(self.winId()), theme)
        self.navigation = navigation = Navigation(self.viewer, self)
        self.pointing = pointing = Pointing(self._session, self.viewer, self)
        pointing.said.connect(self.hovered)
        pointing.menu_asked.connect(self.menu_asked)
        navigation.clicked.connect(pointing.click)
        navigation.menu_asked.connect(self._ask_menu)
        navigation.fit_asked.connect(self._fit_picked)
        navigation.view_asked.connect(self.look_from)
        navigation.hovered.connect(self._hovered)
        self.resized()
        self.viewer.fit()
        for change in self._pending:
            change(self.viewer)
        self._pending.clear()
        for tool in self.tools:
            tool.attached(self.viewer)
        if self._meshes:
            self._show()
        self.draw()
        self.ready.emit()

    def close_viewer(self) -> None:
        """Free the graphics card, before the native window goes."""
        self.stop_drawing()
        self.flight.stop()
        if self.viewer is not None:
            for tool in self.tools:
                tool.closing()
            viewer, self.viewer, self.navigation, self.pointing = self.viewer, None, None, None
            viewer.close()

    def add_tool(self, tool: Tool) -> None:
        """Let a tool have the events before the tools added earlier, and before the navigation."""
        self.tools.insert(0, tool)
        if self.viewer is not None:
            tool.attached(self.viewer)

    def change(self, change: Callable[[Viewer], None]) -> None:
        """Do something to the viewer, now or when it is there, and draw."""
        if self.viewer is None:
            self._pending.append(change)
            return
        change(self.viewer)
        self.refresh()

    def refresh(self) -> None:
        """Draw soon; many calls in one pass of the event loop draw once."""
        if self.viewer is None:
            return
        dragging = self.navigation is not None and self.navigation.dragging
        dragging = dragging or (self._holder is not None and self._holder.dragging)
        self.viewer.set_moving(dragging or self._session.previewing)
        if self.viewer.needs_render:
            self.draw_soon()

    # What is shown.

    def show_meshes(self, meshes: Mapping[str, Any]) -> None:
        """Show these meshes, by the id of their solid's root; the first ones are fitted into the picture."""
        self._meshes = dict(meshes)
        self._show()
        for tool in self.tools:
            tool.shown()

    def session_changed(self, before: State, after: State) -> None:
        if before.document is not after.document or before.isolated != after.isolated:
            self._show()  # colours and visibility need no evaluation
        elif before.selection != after.selection:
            self.show_selection()
        for tool in self.tools:
            tool.session_changed(before, after)

    def fit_next(self) -> None:
        """Fit when meshes come next, as after opening a document."""
        self._fit_pending = True

    def _show(self) -> None:
        if self.viewer is None:
            return
        document = self._session.view
        shown = self._painted.of(document, self._meshes)
        self.viewer.set_shading(document.shading or "phong")
        self.viewer.set_lights(lights_of(document.lights))
        self.viewer.show(shown)
        self.displayed.emit({root_id: mesh for root_id, (mesh, _) in shown.items() if not mesh.sheet})
        self.show_selection()
        if self._fit_pending and shown:
            self._fit_pending = False
            self.viewer.fit()
        self.refresh()

    def set_colour_by_node(self, by_node: bool) -> None:
        """Colour each face by the node that made it, or as the nodes are coloured."""
        if self._painted.set_by_node(by_node):
            self._show()

    def show_selection(self) -> None:
        """Tint what is selected."""
        if self.viewer is not None:
            owners = (mesh.owners for mesh in self._painted.meshes)
            self.viewer.set_selection(paths_through(self._session.selection, owners))
            self.refresh()

    # The camera.

    def look_from(self, name: str) -> None:
        """Turn to a standard view and fit."""
        from ...render.views import standard_view

        if self.viewer is not None:
            self.move_to(self.viewer.fitted(standard_view(self.viewer.camera, name)))

    def fit(self) -> None:
        if self.viewer is not None:
            self.move_to(self.viewer.fitted())

    def fit_selection(self) -> None:
        """Fit the faces and the ghosts of the selected nodes; all where there are none."""
        if self.viewer is None:
            return
        from ...render.picture import union

        bounds = selected_bounds(self._session.selection, self._painted.meshes)
        self._fit_bounds(union(bounds, self.viewer.ghosts.bounds))

    def _fit_bounds(self, bounds: Any) -> None:
        from ...render.camera import fit

        if self.viewer is not None:
            aspect = self.viewer.size[0] / self.viewer.size[1]
            self.move_to(self.viewer.fitted() if bounds is None else fit(self.viewer.camera, bounds, aspect, 1.3))

    def move_to(self, camera: Camera) -> None:
        """Move smoothly to another camera."""
        if self.viewer is not None:
            now = self.viewer.camera
            self.flight.go(now, camera if camera.parallel == now.parallel else replace(camera, parallel=now.parallel))

    def _flown(self, camera: Camera) -> None:
        if self.viewer is not None:
            self.viewer.set_camera(camera)
            self.refresh()

    # The pointer.

    def _fit_picked(self, pick: Pick | None) -> None:
        if self.pointing is not None:
            ids = self.pointing.double_click(pick)
            self._fit_bounds(selected_bounds(ids, self._painted.meshes) if ids else None)

    def _hovered(self, pick: Pick | None) -> None:
        if self.pointing is not None:
            self.pointing.hover(pick)
            self.refresh()

    def tint(self, path: Path | None) -> None:
        """Tint what stands at or below the path as what is under the pointer; None ends it."""
        if self.viewer is not None:
            self.viewer.set_hover(path)
            self.refresh()

    def _ask_menu(self, position: QPointF) -> None:
        if self.pointing is not None:
            self.pointing.menu(position, self.mapToGlobal(position.toPoint()))

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            tip = "" if self.pointing is None else self.pointing.tip()
            QToolTip.showText(event.globalPos(), tip, self, QRect(event.pos() - QPoint(2, 2), QSize(5, 5)))
            return True
        return super().event(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.flight.stop()
        if self.navigation is None:
            return
        if self._holder is None and not self.navigation.dragging:
            self._holder = next((tool for tool in self.tools if tool.press(event)), None)
        elif self._holder is not None:
            self._holder.press(event)
        if self._holder is None:
            self.navigation.press(event)
        self.refresh()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self.navigation is None:
            return
        if self._holder is not None:
            self._holder.move(event)
        elif self.navigation.dragging or not any(tool.move(event) for tool in self.tools):
            self.navigation.move(event)
        else:
            self.navigation.leave()
        self.refresh()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self.navigation is None:
            return
        if self._holder is not None:
            self._holder.release(event)
            if not event.buttons():
                self._holder = None
        else:
            self.navigation.release(event)
        self.refresh()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.navigation is None:
            return
        if not any(tool.double_click(event) for tool in self.tools):
            self.navigation.double_click(event)
        self.refresh()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.flight.stop()
        if self.navigation is not None:
            self.navigation.wheel(event)
            self.refresh()

    def leaveEvent(self, event: QEvent) -> None:
        if self.navigation is not None:
            self.navigation.leave()
            for tool in self.tools:
                tool.leave()
            self.refresh()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        from .navigation import turned

        if any(tool.key(event) for tool in self.tools):
            self.refresh()
        elif event.key() == Qt.Key.Key_Escape:
            self._session.select(())
        elif event.key() == Qt.Key.Key_Menu:
            pointer = self.mapFromGlobal(self.cursor().pos())
            self._ask_menu(QPointF(pointer if self.rect().contains(pointer) else self.rect().center()))
        elif self.viewer is not None and (camera := turned(self.viewer.camera, Qt.Key(event.key()))) is not None:
            self.move_to(camera)
        else:
            super().keyPressEvent(event)

    # The widget.

    def resized(self) -> None:
        if self.viewer is not None:
            self.viewer.resize(self.width(), self.height(), self.devicePixelRatioF())
            self.refresh()

    def draw(self) -> None:
        if self.viewer is not None and self.isVisible():
            self.viewer.render()
            self.view_changed.emit()
