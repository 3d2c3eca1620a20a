"""The tool that asks why a place of the picture has its colour: a click takes it, arrows show what counts there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...model.document.errors import Refusal
from ...model.document.resolve import Resolver
from ...model.document.tree import walk
from ...model.surface.light import lights_of
from ...model.surface.material import Material
from ..tools.click_tool import ClickTool

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...model.editing.session import Session, State
    from ...model.surface.light import Light
    from ...model.surface.probe import Probe
    from ...render.handles.arrow_marks import ArrowMarks
    from ...render.pick import Pick
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport

HINT = "Click a face to see the light of that place, term by term; Escape ends this"
LENGTH = 0.32  # of half the picture's height: arrows
NORMAL, TO_LIGHT, HALFWAY, TO_EYE = (
    ("#1f5bb8", "#7fb2f2"), ("#a96a00", "#f3c14b"), ("#8a3fb0", "#d79bf0"), ("#14803c", "#5fd38d"),
)  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class Taken:
    """The light of one place; `pixel` is the picture's there, (3,) bytes."""

    probe: Probe
    ambient: tuple[Light, ...]
    name: str
    pixel: NDArray[np.uint8]


class LightProbe(ClickTool):
    """Does nothing until `start`. `taken` carries a Taken, or None when there is none any more."""

    taken = Signal(object)
    said = Signal(str)
    refused = Signal(str)
    began = Signal()
    ended = Signal()

    active = False

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self._session = session
        self._resolver = Resolver()
        self._marks: ArrowMarks | None = None
        self._at: QPointF | None = None

    def takes_clicks(self) -> bool:
        return self.active

    def start(self) -> None:
        if not self.active:
            self.active = True
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
            self._viewport.setFocus()
        self.said.emit(HINT)

    def end(self) -> None:
        if self.active:
            self.active = False
            self.drop_press()
            self.forget()
            self._viewport.unsetCursor()
            self.said.emit("")
            self.ended.emit()

    def forget(self) -> None:
        if self._marks is not None and self._marks.arrows:
            self._marks.show(())
            self._draw()
        self.taken.emit(None)

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.arrow_marks import ArrowMarks

        super().attached(viewer)
        self._marks = ArrowMarks()
        viewer.overlay.add(self._marks)

    def closing(self) -> None:
        self.end()
        super().closing()
        self._marks = None

    def session_changed(self, before: State, after: State) -> None:
        if self.active and before.document is not after.document:
            self.forget()

    def key(self, event: QKeyEvent) -> bool:
        if not self.active or event.key() != Qt.Key.Key_Escape:
            return False
        self.end()
        return True

    def clicked(self, position: QPointF) -> None:
        viewer = self._viewer
        pick = None if viewer is None else viewer.pick(position.x(), position.y())
        if viewer is None or pick is None or pick.triangle < 0 or pick.solid_id not in viewer.scene.solid_meshes:
            self.said.emit("A click on a face of a solid tells its light")
            return
        pixel = self._pixel(viewer, position)
        try:
            self._take(viewer, pick, pixel)
        except Refusal as refusal:
            self.refused.emit(str(refusal))

    def _pixel(self, viewer: Viewer, position: QPointF) -> NDArray[np.uint8]:
        """(3,) of the picture without marks, and without the tint of what is selected or pointed at."""
        if self._marks is not None:
            self._marks.show(())
        viewer.set_selection(())
        viewer.set_hover(None)
        viewer.render()
        pixels = viewer.pixels()
        row, column = int(position.y() * viewer.scale), int(position.x() * viewer.scale)
        found = pixels[min(row, pixels.shape[0] - 1), min(column, pixels.shape[1] - 1)].copy()
        self._viewport.show_selection()
        return found

    def _take(self, viewer: Viewer, pick: Pick, pixel: NDArray[np.uint8]) -> None:
        import numpy as np

        from ...model.surface.appearance import appearances
        from ...model.surface.intensity import Eye
        from ...model.surface.probe import arriving, probe
        from ...render.camera import frame
        from ...render.look import Paint, palette

        document, scene = self._session.view, viewer.scene
        mesh = scene.solid_meshes[pick.solid_id]
        root = next(root for root in self._resolver.resolve(document).solids if root.id == pick.solid_id)
        looks = appearances(document, root, mesh.owners)
        owner = int(mesh.owner[pick.triangle])
        paint = Paint(root.colour, tuple(look.colour for look in looks))
        base = palette(mesh, paint, scene.look)[owner, int(pick.subtracted)]
        camera, look = viewer.camera, scene.look
        eye = Eye(np.asarray(camera.position, float), frame(camera), camera.parallel)
        lights = lights_of(document.lights)
        plain = Material("the program's own", ambient=look.ambient, diffuse=look.diffuse, specular=look.specular,
                         shininess=look.specular_power)  # fmt: skip
        corners = np.concatenate([one.points[one.triangles] for one in scene.solid_meshes.values()]).astype(float)
        size = float(np.linalg.norm(np.ptp(corners.reshape(-1, 3), axis=0)))
        point, normal = np.asarray(pick.point, float), np.asarray(pick.normal, float)
        shares = arriving(point, normal, lights, eye, corners, size)
        found = probe(
            mesh, pick.triangle, point, looks[owner], base, document.shading or "phong", lights, eye, shares, plain
        )
        ambient = tuple(light for light in lights if light.active and light.kind == "ambient")
        self._show(found, LENGTH * viewer.camera.half_height)
        self.taken.emit(Taken(found, ambient, self._name(pick), pixel))

    def _show(self, found: Probe, length: float) -> None:
        from ...render.handles.arrow_marks import Arrow

        start, terms = found.point, found.terms
        arrows = [Arrow(start, start + length * terms.to_eye[0], "v", TO_EYE)]
        several = len(found.lights) > 1
        for i in range(len(found.lights)):
            number = str(i + 1) if several else ""
            lit = found.arriving[i] > 0.0
            arrows.append(Arrow(start, start + length * terms.to_light[0, i], f"s{number}", TO_LIGHT, not lit))
            arrows.append(Arrow(start, start + 0.8 * length * terms.halfway[0, i], f"h{number}", HALFWAY, not lit))
        arrows.append(Arrow(start, start + length * terms.normal[0], "m", NORMAL))
        if self._marks is not None:
            self._marks.show(arrows)
        self._draw()

    def _name(self, pick: Pick) -> str:
        node_id = next((step for step in reversed(pick.path) if isinstance(step, str)), pick.solid_id)
        document = self._session.view
        return next((node.label for node in walk(*document.roots) if node.id == node_id), node_id)

    def _draw(self) -> None:
        if self._viewer is not None:
            self._viewer.needs_render = True
            self._viewport.refresh()
