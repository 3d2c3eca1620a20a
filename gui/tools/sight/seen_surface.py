"""What is seen of a part from the eye, or of a face from a point: reckoned off the window's thread, painted, told."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from ....model.editing.session import Session
from ...background import Background
from ...view.viewport import Viewport

if TYPE_CHECKING:
    from ....model.document.errors import Refusal
    from ....model.measuring.sight import SolidRays
    from ....model.measuring.visibility import Eye
    from ....model.measuring.visible_parts import PartView
    from ....render.handles.visibility_mark import VisibilityMark
    from ....render.viewer import Viewer

    Vector = tuple[float, float, float]
    Question = tuple[SolidRays, str, Vector | None, Eye]

REST = 200  # milliseconds that the camera has stood still before it is asked what is seen
LOOKING = "Looking …"
GONE = "What was clicked is no longer there; click again"


class SeenSurface(QObject):
    """`said` tells what is seen. `rested` comes when the camera, which is looked from, has come to rest elsewhere."""

    said = Signal(str)
    rested = Signal()

    def __init__(self, session: Session, viewport: Viewport, parent: QObject) -> None:
        super().__init__(parent)
        self._session, self._viewport = session, viewport
        self._background = Background(self)
        self._mark: VisibilityMark | None = None
        self._viewer: Viewer | None = None
        self._asked: Question | None = None
        self._running = False
        self._seen_from: tuple[object, ...] = ()
        self.view: PartView | None = None
        """The answer to the last question; None as long as there is none."""
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST)
        self._rest.timeout.connect(self._rested)
        viewport.view_changed.connect(self._moved)

    def attached(self, viewer: Viewer) -> None:
        from ....render.handles.visibility_mark import VisibilityMark

        self._viewer, self._mark = viewer, VisibilityMark(viewer)
        viewer.overlay.add(self._mark)

    def closing(self) -> None:
        self.forget()
        self._background.close()
        self._viewer = self._mark = None

    def eye(self) -> Eye | None:
        """The camera's."""
        from ....model.measuring.visibility import Eye

        if self._viewer is None:
            return None
        camera = self._viewer.camera
        if not camera.parallel:
            return Eye(camera.position)
        x, y, z = (a - b for a, b in zip(camera.position, camera.target, strict=True))
        return Eye((x, y, z), True)

    def ask(self, rays: SolidRays, solid_id: str, point: Vector | None, eye: Eye) -> None:
        """What the eye sees of a solid, or of its smooth face at a point; an older question is dropped."""
        self._asked = (rays, solid_id, point, eye)
        self.view = None
        self._seen_from = self._camera()
        self.said.emit(LOOKING)
        self._next()

    def forget(self) -> None:
        """Show nothing and drop what was asked."""
        self._asked = self.view = None
        self._rest.stop()
        if self._mark is not None:
            self._mark.show(None)

    def _next(self) -> None:
        if self._asked is None or self._running:
            return
        self._running = True
        asked = self._asked
        self._background.run(LOOKING, _work(asked), lambda view: self._done(asked, view), self._refused)

    def _done(self, asked: Question, view: PartView | None) -> None:
        self._running = False
        if asked is not self._asked:
            self._next()
            return
        self.view = view
        _, solid_id, point, _ = asked
        if self._mark is not None:
            self._mark.show(None if view is None else view.visibility, through=point is None)
        self.said.emit(GONE if view is None else self._words(view, solid_id, point))
        if self._viewer is not None:
            self._viewport.refresh()

    def _refused(self, refusal: Refusal) -> None:
        self._running = False
        self.said.emit(str(refusal))

    def _words(self, view: PartView, solid_id: str, point: Vector | None) -> str:
        from ....model.measuring.visible_parts import words_of

        names = {root.id: root.label for root in self._session.view.roots}
        name = f"“{names.get(solid_id, solid_id)}”"
        if point is None:
            return words_of(view, name, names)
        return words_of(view, f"the face of {name}", names, "the point")

    def _camera(self) -> tuple[object, ...]:
        if self._viewer is None:
            return ()
        camera = self._viewer.camera
        return camera.position, camera.target, camera.parallel

    def _moved(self) -> None:
        if self._asked is not None and self._asked[2] is None and self._camera() != self._seen_from:
            self._rest.start()

    def _rested(self) -> None:
        if self._asked is not None:
            self.rested.emit()


def _work(asked: Question) -> Callable[[], PartView | None]:
    from ....model.measuring.visible_parts import part_triangles

    rays, solid_id, point, eye = asked

    def work() -> PartView | None:
        mesh = rays.mesh(solid_id)
        if mesh is None:
            return None
        if point is None:
            return rays.seen(solid_id, part_triangles(mesh, (solid_id,)), eye)
        face = rays.face_at(point, solid_id)
        return None if face is None else rays.seen(*face, eye)

    return work
