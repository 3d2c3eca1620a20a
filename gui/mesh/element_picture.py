"""What of the chosen elements is drawn: the set, what is under the pointer, one edge with its wings and faces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...model.mesh.selecting import Kind
from ...model.mesh.winged import LEFT, RIGHT
from .choices import TABLE_OF

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.mesh.inspected import InspectedMesh
    from ...render.mesh.element_marks import ElementMarks
    from ...render.mesh.wing_marks import WingMarks
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport
    from .chosen import Chosen

OPACITIES = {"left": 0.3, "right": 0.3, "chosen": 0.55, "hover": 0.45}
"""Of the faces that are marked so."""


class ElementPicture:
    """Marks in the viewport, made when the first of them is shown."""

    def __init__(self, viewport: Viewport, chosen: Chosen) -> None:
        self._viewport, self._chosen = viewport, chosen
        self._marks: dict[str, ElementMarks] = {}
        self.wings: WingMarks | None = None

    def show(self, first: int) -> None:
        """Show what is chosen; `first` is what numbers count from."""
        viewer, chosen = self._viewport.viewer, self._chosen
        if viewer is None:
            return
        self._make(viewer)
        assert self.wings is not None
        mesh, edge, look = chosen.mesh, chosen.edge, viewer.scene.look
        self._put("chosen", mesh, look.selection, chosen.kind, chosen.numbers if edge < 0 else np.zeros(0, np.int64))
        self.wings.show(mesh, edge, first)
        from ...render.mesh.wing_marks import LEFT_INK, RIGHT_INK

        dark = int(look.background_top < "#8")
        left, right = (-1, -1) if mesh is None or edge < 0 else mesh.winged.table[edge, [LEFT, RIGHT]].tolist()
        for name, face, ink in (("left", left, LEFT_INK), ("right", right, RIGHT_INK)):
            self._put(name, mesh, ink[dark], "face", np.array([face] if face >= 0 else [], np.int64))
        viewer.needs_render = True
        self._viewport.refresh()

    def hover(self, kind: Kind | None, elements: NDArray[np.int64]) -> None:
        """Show what is under the pointer; None for nothing."""
        viewer = self._viewport.viewer
        if viewer is None or (not kind and not self._marks):
            return
        self._make(viewer)
        self._put("hover", self._chosen.mesh if kind else None, viewer.scene.look.hover, kind or "face", elements)
        self._viewport.refresh()

    def clear(self) -> None:
        """Show nothing."""
        for marks in self._marks.values():
            marks.show(None)
        if self.wings is not None:
            self.wings.show(None, -1)
        self._viewport.refresh()

    def follow_sections(self) -> None:
        for marks in self._marks.values():
            marks.follow_sections()

    def _make(self, viewer: Viewer) -> None:
        if self.wings is None:
            from ...render.mesh.element_marks import ElementMarks
            from ...render.mesh.wing_marks import WingMarks

            self._marks = {name: ElementMarks(viewer, opacity) for name, opacity in OPACITIES.items()}
            self.wings = WingMarks()
            viewer.overlay.add(self.wings)

    def _put(self, name: str, mesh: InspectedMesh | None, colour: str, kind: Kind, elements: NDArray[np.int64]) -> None:
        named = TABLE_OF[kind]
        self._marks[name].show(mesh if len(elements) else None, colour, **{named: elements})
