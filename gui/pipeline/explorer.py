"""What the Pipeline panel shows and does: it follows the camera, the document, the vertex, and what is tried."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from ...model.document.errors import Refusal
from ...model.document.resolve import Resolver
from ...model.pipeline.clipping import NAMES as PLANES
from ...model.pipeline.counts import counted
from ...model.pipeline.explanation import way_of
from ...model.pipeline.matrices import Lens, Matrices, lens_of
from ..background import Background
from ..panels.property_edit import sentence
from .applying import apply_matrix
from .flow import Flow
from .geometry import Geometry, geometry_of
from .page import PipelinePage
from .subject import Subject, model_matrix, picked_subject, place_of, point_subject, vertex_subject
from .trial import Trial
from .vertex_tool import VertexTool

if TYPE_CHECKING:
    from ...model.pipeline.counts import Result
    from ...model.solid.display import DisplayMesh
    from ...model.solid.places import Place
    from ...render.viewer import Viewer
    from ..window import MainWindow

SOON, REST = 15, 250
"""Milliseconds after which the tables follow the picture, and after which its pixels are counted."""


class PipelineExplorer(QObject):
    """Works while it is active. `refused` carries why something cannot be, "" when it can."""

    refused = Signal(str)

    def __init__(self, window: MainWindow, page: PipelinePage, tool: VertexTool, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._viewport, self._page, self._tool = window, window.viewport, page, tool
        self.trial = Trial(self)
        self.subject: Subject | None = None
        self.flow: Flow | None = None
        self._resolver = Resolver()
        self._geometry: Geometry | None = None
        self._active = False
        self._seen: tuple[Any, ...] | None = None
        self._counting: Flow | None = None
        self._work = Background(self)
        self._soon, self._rest = QTimer(self), QTimer(self)
        for timer, act in ((self._soon, self._follow), (self._rest, self._count)):
            timer.setSingleShot(True)
            timer.timeout.connect(act)
        window.viewport.view_changed.connect(self._later)
        window.viewport.displayed.connect(lambda _: self._later())
        window.theme.changed.connect(self._retint)
        self.trial.changed.connect(self._follow)
        tool.picked.connect(self._picked)
        tool.began.connect(lambda: page.pick.setChecked(True))
        tool.ended.connect(lambda: page.pick.setChecked(False))
        page.pick_asked.connect(lambda wanted: tool.start() if wanted else tool.end())
        page.point_typed.connect(self.follow_point)
        page.pixels.clicked.connect(self.follow_point)
        page.vertex_chosen.connect(self._vertex_chosen)
        page.refused.connect(self.refused)
        page.reset_asked.connect(self.trial.reset)
        page.cull_asked.connect(window.looks.set_culling)
        page.frame.plane_switched.connect(self.trial.set_clips)
        page.frame.lens.tried.connect(self._try_lens)
        page.frame.automatic_asked.connect(lambda: window.looks.set_clipping(None))
        page.matrices.edited.connect(self._try_matrix)
        page.matrices.reset_asked.connect(self.trial.reset)
        page.matrices.apply_asked.connect(self._apply)

    def set_active(self, active: bool) -> None:
        if active == self._active:
            return
        self._active = active
        if active:
            self._seen = None
            self._later()
            return
        self._tool.end()
        self._tool.show_mark(None)
        self._soon.stop()
        self._rest.stop()

    def close(self) -> None:
        """Before the window goes."""
        self._counting = None
        self.set_active(False)
        self._work.close()

    def forget(self) -> None:
        """Follow nothing and try nothing."""
        self.follow_point(None)
        if self.trial.active:
            self.trial.reset()

    # The vertex.

    def follow_point(self, point: tuple[float, float, float] | None) -> None:
        """Follow a point of the world, or nothing."""
        self._take(None if point is None else point_subject(point))

    def _picked(self, path: tuple[str | int, ...], point: tuple[float, float, float]) -> None:
        viewer = self._viewport.viewer
        if viewer is not None:
            self._take(picked_subject(path, point, viewer.scene.solid_meshes, self._solids))

    def _vertex_chosen(self, place: int, vertex: int) -> None:
        meshes = self._meshes
        if vertex < 0 or not 0 <= place < len(meshes):
            self._take(None)
            return
        root_id = list(meshes)[place]
        try:
            self._take(vertex_subject(root_id, vertex, meshes[root_id], self._solids))
            self.refused.emit("")
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))

    def _take(self, subject: Subject | None) -> None:
        self.subject = subject
        self._seen = None
        self._follow()

    @property
    def _solids(self):
        return self._resolver.resolve(self._window.session.view).solids

    @property
    def _meshes(self) -> dict[str, DisplayMesh]:
        viewer = self._viewport.viewer
        return {} if viewer is None else viewer.scene.solid_meshes

    # What is shown.

    def _later(self) -> None:
        if self._active and not self._soon.isActive():
            self._soon.start(SOON)

    def _follow(self) -> None:
        viewer = self._viewport.viewer
        if not self._active or viewer is None:
            return
        live, place = self._live(viewer)
        meshes = tuple(self._meshes.values())
        looks, camera = self._window.looks, viewer.camera
        trial = (self.trial.words, *(matrix.tobytes() for matrix in self.trial.matrices.values()))
        seen = (camera, viewer.size, live.projection.tobytes(), live.model.tobytes(), meshes, looks.culling,
                looks.clipping, trial)  # fmt: skip
        if seen == self._seen:
            return
        self._seen = seen
        page, matrices = self._page, self.trial.of(live)
        self._show_vertex(live, matrices)
        page.show_trial(self.trial.words)
        page.matrices.show_matrices(matrices, frozenset(self.trial.matrices), self._appliable(place))
        page.frame.show_planes({plane: self.trial.clips(plane) for plane in PLANES})
        page.frame.show_clipping(looks.clipping)
        page.frame.lens.show_lens(_lens(matrices), camera.distance, "projection" in self.trial.matrices)
        page.cull.setChecked(looks.culling)
        self._show_flow(viewer, live, matrices)

    def _live(self, viewer: Viewer) -> tuple[Matrices, Place | None]:
        """The picture's own matrices, and where the vertex's node stands."""
        from ...render.pipeline import matrices_of, shown_clipping

        place = None if self.subject is None else place_of(self.subject, self._solids)
        if self.subject is not None and self.subject.path and place is None:
            self.subject = None  # its node is gone
        live = matrices_of(viewer.camera, viewer.size, shown_clipping(viewer))
        return replace(live, model=model_matrix(place)), place

    def _show_vertex(self, live: Matrices, matrices: Matrices) -> None:
        page, subject, meshes = self._page, self.subject, self._meshes
        labels = {root.id: root.label for root in self._window.session.document.solids}
        names = [labels.get(root_id, root_id) for root_id in meshes]
        root_id = subject.root_id if subject is not None else ""
        place = list(meshes).index(root_id) if root_id in meshes else 0 if meshes else -1
        most = len(list(meshes.values())[place].vertices) - 1 if place >= 0 else -1
        page.show_solids(names, place, most, subject.vertex if subject is not None and root_id in meshes else -1)
        if subject is None:
            page.stages.show_stages(())
            page.show_point(None)
            self._tool.show_mark(None)
        else:
            world = live.stages([subject.own]).world[0]
            page.stages.show_stages(way_of(matrices, subject.own))
            page.show_point(tuple(world.tolist()))
            self._tool.show_mark(world)
        page.explain()

    def _show_flow(self, viewer: Viewer, live: Matrices, matrices: Matrices) -> None:
        meshes = tuple(self._meshes.values())
        if self._geometry is None or self._geometry.meshes != meshes:
            self._geometry = geometry_of(meshes)
        geometry = self._geometry
        if not len(geometry.triangles):
            self._show(None)
            self._page.counts.show_counts(None)
            return
        point = None
        if self.subject is not None:
            point = matrices.stages([self.subject.own]).world[0]
            if "model" in self.trial.matrices and self.subject.path:
                geometry = geometry.moved(self.subject.path, matrices.model @ np.linalg.inv(live.model))
        size = max(round(viewer.size[0]), 1), max(round(viewer.size[1]), 1)
        flow = Flow(matrices, geometry, size, self.trial.planes, self._window.looks.culling, point)
        if self.flow is not None and self.flow.draws_as(flow):
            flow.result = self.flow.result
        self._show(flow)
        if flow.result is None:
            self._page.counts.show_counts(None)
            self._rest.start(REST)

    def _show(self, flow: Flow | None) -> None:
        self.flow = flow
        self._page.frame.view.show_flow(flow)
        self._page.pixels.show_flow(flow)

    def _retint(self) -> None:
        self._page.retint()
        self._seen = None
        self._later()

    # The counts, in a thread.

    def _count(self) -> None:
        flow = self.flow
        if flow is None or flow.result is not None:
            return
        if self._counting is not None:
            self._counting = flow  # what is at work sees that it is out of date
            return
        self._counting = flow

        def work() -> Result | None:
            return counted(flow.geometry.points, flow.geometry.triangles, flow.matrices, flow.size, flow.cull,
                           flow.planes, lambda: self._counting is not flow or self.flow is not flow)  # fmt: skip

        self._work.run("", work, lambda result: self._counted(flow, result), lambda _: None)

    def _counted(self, flow: Flow, result: Result | None) -> None:
        self._counting = None
        if flow is not self.flow:
            if self._active and not self._rest.isActive():
                self._count()
            return
        if result is not None:
            self._show(replace(flow, result=result))
            self._page.counts.show_counts(result.counts)

    # What is tried.

    def _try_matrix(self, name: str, matrix: np.ndarray) -> None:
        self._try(lambda: self.trial.set_matrix(name, matrix))

    def _try_lens(self, name: str, value: float) -> None:
        viewer = self._viewport.viewer
        if viewer is not None:
            live = self._live(viewer)[0]
            self._try(lambda: self.trial.set_lens(live, **{name: value}))

    def _try(self, act: Any) -> None:
        try:
            act()
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            self._seen = None
            self._follow()
        else:
            self.refused.emit("")

    def _appliable(self, place: Place | None) -> frozenset[str]:
        return frozenset({"view", "projection"} | ({"model"} if place is not None else set()))

    def _apply(self, name: str) -> None:
        viewer = self._viewport.viewer
        matrix = self.trial.matrices.get(name)
        if viewer is None or matrix is None:
            return
        live, place = self._live(viewer)
        try:
            apply_matrix(self._window, name, matrix, live, place)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            return
        self.refused.emit("")
        self.trial.reset(name)


def _lens(matrices: Matrices) -> Lens | None:
    try:
        return lens_of(matrices.projection)
    except Refusal:
        return None
