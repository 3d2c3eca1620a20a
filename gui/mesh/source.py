"""Which mesh the panel shows: that of a solid in the picture, its structures made in the background."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from ...model.document.tree import homes, walk

if TYPE_CHECKING:
    from ...model.document.errors import Refusal
    from ...model.mesh.inspected import InspectedMesh
    from ...model.solid.display import DisplayMesh
    from ..window import MainWindow

AT_ONCE = 3_000  # triangles of a mesh whose structures are made while the window waits
REST = 120  # milliseconds without a change before a mesh is looked at


class MeshSource(QObject):
    """`changed` tells of another mesh, or of other `words` on why there is none; `outdated` that the picture shows
    another one than `mesh`; `changed` follows."""

    changed = Signal()
    outdated = Signal()

    def __init__(self, window: MainWindow, parent: QObject) -> None:
        super().__init__(parent)
        self._window = window
        self.solid = ""
        """The root's id, "" for none."""
        self.mesh: InspectedMesh | None = None
        self.labels: tuple[str, ...] = ()
        self.words = ""
        self.polygons = True
        self._active = False
        self._made: tuple[DisplayMesh, bool] | None = None
        self._working = False
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(REST)
        self._soon.timeout.connect(self._follow)
        window.viewport.displayed.connect(self._later)

    @property
    def settled(self) -> bool:
        """Whether what is shown is the last word on the present picture."""
        return not self._soon.isActive() and not self._working

    @property
    def solids(self) -> dict[str, str]:
        """The names of the solids and of the outlines that fill something in the picture, by their ids."""
        meshes = self._meshes
        return {root.id: root.label for root in self._window.session.document.standing if root.id in meshes}

    @property
    def _meshes(self) -> dict[str, DisplayMesh]:
        viewer = self._window.viewport.viewer
        shown = {} if viewer is None else viewer.scene.meshes
        return {root: mesh for root, mesh in shown.items() if len(mesh.corners) > mesh.sheet}

    @property
    def up_to_date(self) -> bool:
        """Whether `mesh` is what the picture shows."""
        return self._made is not None and self._meshes.get(self.solid) is self._made[0]

    def set_active(self, active: bool) -> None:
        """Whether somebody looks; at rest it does no work."""
        self._active = active
        if active:
            self.follow_selection()
            self._follow()
        else:
            self._soon.stop()

    def choose(self, solid: str) -> None:
        """Show a solid by its id."""
        if solid != self.solid:
            self.solid = solid
            self._follow()

    def set_polygons(self, polygons: bool) -> None:
        if polygons != self.polygons:
            self.polygons = polygons
            self._follow()

    def follow_selection(self) -> None:
        """The solid that the selected node is part of."""
        document = self._window.session.document
        wanted = [root for root in homes(document, self._window.session.selection) if root in self._meshes]
        if wanted and self.solid not in wanted:
            self.choose(wanted[0])

    def _later(self) -> None:
        if self._active:
            if self.mesh is not None and not self.up_to_date:
                self.outdated.emit()
            self._soon.start()

    def _follow(self) -> None:
        if not self._active:
            return
        if self._window.session.previewing:
            self._soon.start()
            return
        meshes = self._meshes
        if self.solid not in meshes:
            self.solid = next(iter(meshes), "")
        mesh = meshes.get(self.solid)
        if mesh is None:
            self._set(
                None,
                "Nothing is in the picture. Add a solid or a closed outline: its vertices, edges and faces stand here.",
            )
            return
        if self._made is not None and self._made[0] is mesh and self._made[1] == self.polygons:
            self.labels = self._names(mesh)
            self.changed.emit()  # solids may have come, gone or changed their names
            return
        self._make(mesh, self.polygons)

    def _make(self, mesh: DisplayMesh, polygons: bool) -> None:
        from ...model.mesh.inspected import inspect_mesh

        if len(mesh.corners) <= AT_ONCE:
            self._take(mesh, polygons, inspect_mesh(mesh, polygons))
            return
        self._set(None, f"The edges of {len(mesh.corners):,} triangles are being put together …")
        if self._working:
            return
        self._working = True

        def done(found: InspectedMesh) -> None:
            self._working = False
            if self._active and self._meshes.get(self.solid) is mesh and self.polygons == polygons:
                self._take(mesh, polygons, found)
            else:
                self._follow()

        def refused(refusal: Refusal) -> None:
            self._working = False
            self._set(None, str(refusal))

        self._window.files.background.run("Looking into the mesh", lambda: inspect_mesh(mesh, polygons), done, refused)

    def _take(self, mesh: DisplayMesh, polygons: bool, found: InspectedMesh) -> None:
        self._made = mesh, polygons
        self.labels = self._names(mesh)
        self._set(found, "")

    def _names(self, mesh: DisplayMesh) -> tuple[str, ...]:
        from ..view.occurrences import maker_of

        known = {node.id: node.label for node in walk(*self._window.session.document.roots)}
        return tuple(known.get(maker_of(path), "") for path in mesh.owners)

    def _set(self, mesh: InspectedMesh | None, words: str) -> None:
        if mesh is None:
            self._made = None
        self.mesh, self.words = mesh, words
        self.changed.emit()
