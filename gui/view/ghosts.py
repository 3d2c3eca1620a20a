"""Selected operands that the result does not show as they are, as ghosts in the picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.document.nodes import Node
from ...model.document.primitives import Halfspace
from ...model.document.resolve import Resolver
from ...model.editing.session import Session, State
from ..tools.tool import Tool

if TYPE_CHECKING:
    from ...model.worker.shown import Part
    from ...render.ghosts.ghosts import Ghost
    from ...render.viewer import Viewer
    from ..evaluation import Evaluation
    from .viewport import Viewport


class OperandGhosts(Tool):
    """Takes no events; follows the session, drags included, and what the evaluation knows of the selected nodes."""

    def __init__(self, viewport: Viewport, session: Session, evaluation: Evaluation, visible: bool) -> None:
        super().__init__(viewport)
        self._viewport = viewport
        self._session = session
        self._evaluation = evaluation
        self._resolver = Resolver()
        self._viewer: Viewer | None = None
        self._visible = visible
        evaluation.examined.connect(self.refresh)

    def attached(self, viewer: Viewer) -> None:
        self._viewer = viewer
        self.refresh()

    def closing(self) -> None:
        self._viewer = None

    def session_changed(self, before: State, after: State) -> None:
        isolated = before.isolated != after.isolated
        if isolated or before.document is not after.document or before.selection != after.selection:
            self.refresh()

    def set_visible(self, visible: bool) -> None:
        self._visible = visible
        self.refresh()

    def refresh(self) -> None:
        if self._viewer is None:
            return
        ghosts = self._ghosts() if self._visible else []
        if ghosts or self._viewer.ghosts.count:
            self._viewer.show_ghosts(ghosts)
            self._viewport.refresh()

    def _ghosts(self) -> list[Ghost]:
        parts = self._evaluation.parts
        ids = [node_id for node_id in self._session.selection if node_id in parts]
        if not ids:
            return []
        from ...model.solid.places import places_of
        from ...model.solid.roles import Role, role_of
        from ...render.ghosts.ghosts import Ghost, Manner

        solids = self._resolver.resolve(self._session.view).solids
        hidden = {root.id for root in solids if not root.visible}
        found: list[Ghost] = []
        for node_id, places in places_of(solids, ids).items():
            part: Part = parts[node_id]
            if part.mesh is None or not len(part.mesh.triangles):
                continue
            for place in places:
                role = role_of(solids, place.path)
                if role is Role.SHOWN and place.path[0] not in hidden and not isinstance(place.node, Halfspace):
                    continue
                plane = _plane(place.node)
                manner = Manner.HATCHED if role is Role.SUBTRACTED else Manner.TINTED
                found.append(Ghost(part.mesh, place.matrix, manner if plane is None else Manner.PLANE, plane))
        return found


def _plane(node: Node) -> tuple[tuple[float, float, float], tuple[float, float, float]] | None:
    if not isinstance(node, Halfspace) or not any(node.normal):
        return None
    normal, point = (tuple(float(number) for number in vector) for vector in (node.normal, node.point))  # type: ignore[arg-type]
    return normal, point  # type: ignore[return-value]
