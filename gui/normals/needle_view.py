"""The normals in the picture: of the selected solids and nodes, of all where nothing is selected."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Signal

from ...model.editing.session import Session, State
from ..tools.tool import Tool
from ..view.occurrences import paths_through

if TYPE_CHECKING:
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport

KINDS = ("face", "vertex")


class NeedleView(Tool):
    """Takes no events; follows meshes, drags included, and the selection. `said` tells where a part alone is drawn."""

    said = Signal(str)

    def __init__(self, viewport: Viewport, session: Session) -> None:
        super().__init__(viewport)
        self._viewport, self._session = viewport, session
        self._viewer: Viewer | None = None
        self._kinds: frozenset[str] = frozenset()
        self._shown: tuple[Any, ...] = ()
        self._words = ""

    def is_on(self, kind: str) -> bool:
        return kind in self._kinds

    def toggle(self, kind: str) -> None:
        """Show normals of a kind, one of KINDS, or hide them again."""
        self._kinds ^= {kind}
        self.refresh()

    def attached(self, viewer: Viewer) -> None:
        self._viewer = viewer
        self.refresh()

    def closing(self) -> None:
        self._viewer = None

    def session_changed(self, before: State, after: State) -> None:
        if self._kinds:
            self.refresh()

    def shown(self) -> None:
        if self._kinds:
            self.refresh()

    def refresh(self) -> None:
        if self._viewer is None:
            return
        meshes = self._viewer.scene.solid_meshes if self._kinds else {}
        wanted = (self._kinds, self._session.selection, tuple(meshes.values()))
        if wanted == self._shown:
            return
        self._shown = wanted
        self._show(list(meshes.values()))
        self._viewport.refresh()

    def _show(self, meshes: list[Any]) -> None:
        import numpy as np

        from ...model.mesh.needles import MOST, face_needles, needle_length, vertex_needles

        assert self._viewer is not None
        paths = paths_through(self._session.selection, (mesh.owners for mesh in meshes))
        lengths = sorted({len(path) for path in paths})
        makers = {"face": face_needles, "vertex": vertex_needles}
        drawn: list[tuple[Any, Any]] = []
        for mesh in meshes:
            chosen = None
            if paths:
                of_owner = np.array([any(owner[:n] in paths for n in lengths) for owner in mesh.owners], bool)
                chosen = np.append(of_owner, False)[mesh.owner]
                if not chosen.any():
                    continue
            drawn.append((mesh, chosen))
        bounds = [mesh.bounds for mesh, _ in drawn]
        diagonal = float(np.linalg.norm(np.max(bounds, axis=0)[1] - np.min(bounds, axis=0)[0])) if bounds else 0.0
        triangles = max(sum(len(mesh.corners) for mesh, _ in drawn), 1)
        lines, words = {}, []
        for kind in (kind for kind in KINDS if kind in self._kinds):
            made = [(makers[kind](mesh, chosen, max(MOST * len(mesh.corners) // triangles, 1)), mesh)
                    for mesh, chosen in drawn]  # fmt: skip
            parts = [needles.lines(needle_length(mesh, diagonal)) for needles, mesh in made]
            lines[kind] = np.concatenate([np.zeros((0, 2, 3)), *parts])
            total = sum(needles.total for needles, _ in made)
            if len(lines[kind]) < total:
                words.append(f"{len(lines[kind]):,} of {total:,} {kind} normals are drawn")
        self._viewer.show_needles(lines)
        if "; ".join(words) != self._words:
            self._words = "; ".join(words)
            self.said.emit(self._words)
