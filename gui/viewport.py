"""The picture in the middle: a native widget that a Viewer draws into, once for each pass of the event loop at most."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QPaintEngine, QSize, Qt, QTimer, QVariantAnimation, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPaintEvent, QResizeEvent, QShowEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ..model.document.document import Document
from ..model.document.session import Session, State
from ..model.document.tree import walk

if TYPE_CHECKING:
    from ..render.camera import Camera
    from ..render.pick import Pick
    from ..render.viewer import Viewer
    from .navigation import Navigation

ANIMATION = 200  # milliseconds
Path = tuple[str | int, ...]


class Viewport(QWidget):
    """Shows meshes by root id. VTK is loaded by `attach`, when the window is already on the screen.

    `ready` comes once, after that; `hovered` carries words on what lies under the pointer, "" for nothing.
    """

    ready = Signal()
    hovered = Signal(str)
    view_changed = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("viewport")
        self.setAccessibleName("Viewport")
        self.setAttribute(Qt.WidgetAttribute.WA_NativeWindow)
        self.setAttribute(Qt.WidgetAttribute.WA_DontCreateNativeAncestors)
        self.setAttribute(Qt.WidgetAttribute.WA_PaintOnScreen)
        self.setAttribute(Qt.WidgetAttribute.WA_NoSystemBackground)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(200, 150)
        self.viewer: Viewer | None = None
        self.navigation: Navigation | None = None
        self._session = session
        self._meshes: dict[str, Any] = {}
        self._kept: dict[str, tuple[Any, Any, Any, Any]] = {}
        self._fit_pending = True
        self._pending: list[Callable[[Viewer], None]] = []
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._render)
        self._animation = QVariantAnimation(self)
        self._animation.setDuration(ANIMATION)
        self._animation.setStartValue(0.0)
        self._animation.setEndValue(1.0)
        self._animation.valueChanged.connect(self._animate)
        self._way: tuple[Camera, Camera] | None = None

    def attach(self, theme: str) -> None:
        """Load VTK and begin to draw."""
        from ..render.viewer import Viewer
        from .navigation import Navigation

        self.viewer = Viewer(int(self.winId()), theme)
        self.navigation = navigation = Navigation(self.viewer, self)
        navigation.clicked.connect(self._clicked)
        navigation.fit_asked.connect(self._fit_picked)
        navigation.view_asked.connect(self.look_from)
        navigation.hovered.connect(self._hovered)
        self._resized()
        self.viewer.fit()
        for change in self._pending:
            change(self.viewer)
        self._pending.clear()
        if self._meshes:
            self._show()
        self._render()
        self.ready.emit()

    def close_viewer(self) -> None:
        """Free the graphics card, before the native window goes."""
        self._timer.stop()
        self._animation.stop()
        if self.viewer is not None:
            self.viewer.close()

    def change(self, change: Callable[[Viewer], None]) -> None:
        """Do something to the viewer, now or when it is there, and draw."""
        if self.viewer is None:
            self._pending.append(change)
            return
        change(self.viewer)
        self.refresh()

    def refresh(self) -> None:
        """Draw soon; many calls in one pass of the event loop draw once."""
        if self.viewer is not None and self.viewer.needs_render and not self._timer.isActive():
            self._timer.start(0)

    # What is shown.

    def show_meshes(self, meshes: Mapping[str, Any]) -> None:
        """Show these meshes, by the id of their solid's root; the first ones are fitted into the picture."""
        self._meshes = dict(meshes)
        self._show()

    def session_changed(self, before: State, after: State) -> None:
        if before.document is not after.document:
            self._show()  # colours and visibility need no evaluation
        elif before.selection != after.selection:
            self._highlight()

    def fit_next(self) -> None:
        """Fit when meshes come next, as after opening a document."""
        self._fit_pending = True

    def _show(self) -> None:
        if self.viewer is None:
            return
        document = self._session.document
        shown = {}
        kept = {}
        for root in document.solids:
            mesh = self._meshes.get(root.id)
            if mesh is None or not root.visible or not len(mesh.triangles):
                continue
            old = self._kept.get(root.id)
            if old is None or old[0] is not root or old[1] is not document.definitions or old[2] is not mesh:
                old = (root, document.definitions, mesh, paint_of(document, root, mesh))
            kept[root.id] = old
            shown[root.id] = (mesh, old[3])
        self._kept = kept
        self.viewer.show(shown)
        self._highlight()
        if self._fit_pending and shown:
            self._fit_pending = False
            self.viewer.fit()
        self.refresh()

    def _highlight(self) -> None:
        if self.viewer is not None:
            owners = (mesh.owners for mesh, in ((entry[2],) for entry in self._kept.values()))
            self.viewer.set_selection(paths_through(self._session.selection, owners))
            self.refresh()

    # The camera.

    def look_from(self, name: str) -> None:
        """Turn to a standard view and fit."""
        from ..render.views import standard_view

        if self.viewer is not None:
            self.move_to(self.viewer.fitted(standard_view(self.viewer.camera, name)))

    def fit(self) -> None:
        if self.viewer is not None:
            self.move_to(self.viewer.fitted())

    def fit_selection(self) -> None:
        """Fit the faces of the selected nodes; all where none is seen."""
        if self.viewer is None:
            return
        bounds = selected_bounds(self._session.selection, [entry[2] for entry in self._kept.values()])
        self._fit_bounds(bounds)

    def _fit_bounds(self, bounds: Any) -> None:
        from ..render.camera import fit

        if self.viewer is not None:
            aspect = self.viewer.size[0] / self.viewer.size[1]
            self.move_to(self.viewer.fitted() if bounds is None else fit(self.viewer.camera, bounds, aspect, 1.3))

    def move_to(self, camera: Camera) -> None:
        """Move smoothly to another camera."""
        if self.viewer is None:
            return
        self._animation.stop()
        if camera.parallel != self.viewer.camera.parallel:
            camera = replace(camera, parallel=self.viewer.camera.parallel)
        self._way = (self.viewer.camera, camera)
        self._animation.start()

    def _animate(self, value: float) -> None:
        from ..render.views import interpolate

        if self._way is not None and self.viewer is not None:
            eased = value * value * (3.0 - 2.0 * value)
            self.viewer.set_camera(interpolate(*self._way, eased))
            self.refresh()

    # The pointer.

    def _owner(self, pick: Pick | None) -> str | None:
        """The deepest node of the picked face's path that stands in the document."""
        if pick is None:
            return None
        known = {node.id for node in walk(*self._session.document.roots)}
        return next((part for part in reversed(pick.path) if isinstance(part, str) and part in known), None)

    def _clicked(self, pick: Pick | None, adds: bool) -> None:
        owner, selection = self._owner(pick), self._session.selection
        if owner is None:
            if not adds:
                self._session.select(())
        elif not adds:
            self._session.select((owner,))
        elif owner in selection:
            self._session.select(i for i in selection if i != owner)
        else:
            self._session.select((*selection, owner))

    def _fit_picked(self, pick: Pick | None) -> None:
        owner = self._owner(pick)
        meshes = [entry[2] for entry in self._kept.values()]
        self._fit_bounds(None if owner is None else selected_bounds((owner,), meshes))

    def _hovered(self, pick: Pick | None) -> None:
        if self.viewer is None:
            return
        owner = self._owner(pick)
        if pick is None or owner is None:
            self.viewer.set_hover(None)
            self.hovered.emit("")
        else:
            path = pick.path[: len(pick.path) - pick.path[::-1].index(owner)]
            self.viewer.set_hover(path)
            names = {node.id: node.label for node in walk(*self._session.document.roots)}
            trail = " › ".join(names[part] for part in path if isinstance(part, str) and part in names)  # noqa: RUF001
            cut = ", left by a subtracted part" if pick.subtracted else ""
            self.hovered.emit(f"{trail} — facet {pick.facet}{cut}")
        self.refresh()

    def _still(self) -> None:
        self._animation.stop()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._still()
        if self.navigation is not None:
            self.navigation.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self.navigation is not None:
            self.navigation.move(event)
            self.refresh()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self.navigation is not None:
            self.navigation.release(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.navigation is not None:
            self.navigation.double_click(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._still()
        if self.navigation is not None:
            self.navigation.wheel(event)
            self.refresh()

    def leaveEvent(self, event: QEvent) -> None:
        if self.navigation is not None:
            self.navigation.leave()
            self.refresh()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        from .navigation import turned

        if event.key() == Qt.Key.Key_Escape:
            self._session.select(())
        elif self.viewer is not None and (camera := turned(self.viewer.camera, Qt.Key(event.key()))) is not None:
            self.move_to(camera)
        else:
            super().keyPressEvent(event)

    # The widget.

    def paintEngine(self) -> QPaintEngine:
        return None  # type: ignore[return-value]  # VTK paints

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.viewer is not None and not self._timer.isActive():
            self._timer.start(0)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._resized()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._resized()

    def sizeHint(self) -> QSize:
        return QSize(900, 640)

    def _resized(self) -> None:
        if self.viewer is not None:
            self.viewer.resize(self.width(), self.height(), self.devicePixelRatioF())
            self.refresh()

    def _render(self) -> None:
        if self.viewer is not None and self.isVisible():
            self.viewer.render()
            self.view_changed.emit()


def paths_through(ids: Iterable[str], owners: Iterable[Iterable[Path]]) -> set[Path]:
    """The parts of the owners' paths that end at one of the nodes."""
    wanted = set(ids)
    if not wanted:
        return set()
    return {path[: i + 1] for paths in owners for path in paths for i, part in enumerate(path) if part in wanted}


def selected_bounds(ids: Iterable[str], meshes: Iterable[Any]) -> Any:
    """The box (2, 3) around the faces that these nodes made, None where there are none."""
    import numpy as np

    wanted = set(ids)
    boxes = []
    for mesh in meshes:
        mine = np.array([bool(wanted.intersection(path)) for path in mesh.owners], bool)
        faces = mesh.triangles[mine[mesh.owner]] if len(mine) else mesh.triangles[:0]
        if len(faces):
            points = mesh.points[np.unique(faces)]
            boxes.append((points.min(axis=0), points.max(axis=0)))
    if not boxes:
        return None
    lower, upper = zip(*boxes, strict=True)
    return np.array([np.min(lower, axis=0), np.max(upper, axis=0)], float)


def paint_of(document: Document, root: Any, mesh: Any) -> Any:
    """Each owner's colour: that of the lowest coloured node on its path below the root, the root's by default."""
    from ..render.look import Paint

    colours = {node.id: node.colour for node in walk(root, *document.definitions) if node.colour is not None}
    if not colours:
        return Paint()
    owners = tuple(
        next((colours[part] for part in reversed(path) if isinstance(part, str) and part in colours), None)
        for path in mesh.owners
    )
    return Paint(root.colour, owners)
