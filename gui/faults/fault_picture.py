"""Faults in the picture: spots, the chosen one with its edges and faces, other solids faded, and the flight there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...model.document.tree import homes
from ..tools.tool import Tool

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.checking.document_faults import NodeFaults
    from ...model.document.errors import Refusal
    from ...render.handles.fault_marks import FaultMarks
    from ...render.viewer import Viewer
    from ..window import MainWindow
    from .finding_rows import FindingRow

AROUND, CLOSE = 0.75, 0.55  # times the size of a fault: what is seen on either side of it, chosen and zoomed to
FAR, NEAR = 0.06, 1e-5  # of the picture's solids: the least that is seen then
GAPS = 4.0  # times the gap between things, likewise
Arrays = tuple["NDArray[np.float64]", "NDArray[np.integer]"]


class FaultPicture(Tool):
    """`left` tells that Escape was pressed in the picture while a fault was shown; `began` and `ended` that one is
    shown and that none is any more."""

    left = Signal()
    began = Signal()
    ended = Signal()

    def __init__(self, window: MainWindow, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._viewport = window, window.viewport
        self._marks: FaultMarks | None = None
        self._viewer: Viewer | None = None
        self._rows: Sequence[FindingRow] = ()
        self._arrays: dict[str, tuple[NodeFaults, Arrays | None]] = {}
        """Of meshes as they came, by the node's id, with the report that they are of; None while they are fetched."""
        self.chosen: FindingRow | None = None
        window.viewport.add_tool(self)

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.fault_marks import FaultMarks

        self._viewer = viewer
        self._marks = FaultMarks()
        viewer.overlay.add(self._marks)

    def closing(self) -> None:
        self._viewer = self._marks = None

    def key(self, event: QKeyEvent) -> bool:
        if self.chosen is None or event.key() != Qt.Key.Key_Escape:
            return False
        self.left.emit()
        return True

    def show(self, rows: Sequence[FindingRow], chosen: FindingRow | None = None) -> None:
        """Spots for all rows, and the chosen one as it is."""
        before, self.chosen, self._rows = self.chosen, chosen, rows
        self._draw()
        if (before is None) != (chosen is None):
            (self.ended if chosen is None else self.began).emit()

    def fly(self, close: bool = False) -> None:
        """Bring the chosen one into the middle of the picture; `close`: as near as it is large."""
        from ...render.camera import fit

        row, viewer = self.chosen, self._viewer
        if row is None or viewer is None:
            return
        bounds = viewer.scene.visible_bounds()
        scene = 100.0 if bounds is None else float(np.linalg.norm(np.ptp(bounds, axis=0)))
        share, least = (CLOSE, NEAR) if close else (AROUND, FAR)
        half = max(share * row.finding.size, GAPS * row.finding.gap, least * scene)
        box = np.array([row.place - half, row.place + half])
        self._viewport.move_to(fit(viewer.camera, box, viewer.size[0] / viewer.size[1], 1.0))

    def _draw(self) -> None:
        marks, viewer, row = self._marks, self._viewer, self.chosen
        if marks is None or viewer is None:
            return
        from ...render.handles.fault_marks import MarkedFault

        places = np.array([one.place for one in self._rows]).reshape(-1, 3)
        if row is None:
            marks.show(places)
            viewer.set_faded(())
        else:
            lines, faces = self._shape(row)
            marks.show(places, MarkedFault(row.place, row.finding.size, row.words, lines, faces))
            home = homes(self._window.session.document, [row.report.id])
            viewer.set_faded(key for key in viewer.scene.meshes if home and key not in home)
        viewer.needs_render = True
        self._viewport.refresh()

    def _shape(self, row: FindingRow) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The edges (k, 2, 3) and faces (m, 3, 3) that a finding is about, as far as they are known already."""
        from ...model.mesh.faults.drawn import drawn

        arrays = None
        if row.report.kind == "mesh":
            arrays = self._mesh_of(row.report)
        elif row.report.kind == "solid" and self._viewer is not None:
            mesh = self._viewer.scene.meshes.get(row.report.id)
            arrays = None if mesh is None else (mesh.vertices, mesh.corners)
        return drawn(*(arrays or (np.zeros((0, 3)), np.zeros((0, 3), int))), row.finding)

    def _mesh_of(self, report: NodeFaults) -> Arrays | None:
        """The mesh that a report is of; where it is not at hand, it comes later and is drawn then."""
        known, arrays = self._arrays.get(report.id, (None, None))
        if known is report:
            return arrays
        document = self._window.session.document
        self._arrays[report.id] = report, None

        def work() -> Arrays:
            from ...model.operations.meshes.mesh_nodes import mesh_of_node

            return mesh_of_node(document, report.id).in_world()

        def done(found: Arrays) -> None:
            self._arrays[report.id] = report, found
            if self.chosen is not None and self.chosen.report is report:
                self._draw()

        def refused(refusal: Refusal) -> None:
            """Then the place alone is marked."""

        self._window.files.background.run("Reading the mesh", work, done, refused)
        return None

    def forget(self) -> None:
        """Nothing is shown any more, and no mesh is kept."""
        self._arrays.clear()
        self.show(())
