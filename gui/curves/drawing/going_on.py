"""Going on with a path from one of its open ends."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ....model.document.document import Document, parameter_values
from ....model.document.errors import Refusal
from ....model.document.nodes import Node, resolve_fields
from ....model.document.outlines import Path as PathNode
from ....model.document.tree import find
from ....model.outline.frames import frame_of
from ....model.outline.paths import fields_of, own_path
from ....model.path.editing import join
from ....model.path.path import Contour, Path
from ....render.camera import project
from .draft import same
from .near_pointer import REACH
from .pen_tool import Pen

if TYPE_CHECKING:
    from ....model.editing.session import Session
    from ....render.viewer import Viewer
    from .draft import Draft

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class GoingOn:
    """A path, one of its contours turned so that it ends where the pen begins, and the ends (k, 2) of the others."""

    node: Node
    path: Path
    number: int
    contour: Contour
    ends: Floats
    frame: Floats  # (3, 4) from the path's own axes to the world

    def stands(self, document: Document) -> bool:
        """Whether the document still has the path as it was."""
        try:
            return find(document, self.node.id) is self.node
        except Refusal:
            return False

    def commit(self, session: Session, draft: Draft) -> None:
        """Put what the pen has drawn behind the contour, and join the one that it has reached. Raises Refusal."""
        if self.node.expressions():
            raise Refusal(f"“{self.node.label}” has expressions in its points, which drawing on would lose: give them "
                          "plain numbers first, or draw an outline of its own")  # fmt: skip
        assert isinstance(draft, Pen)
        drawn = draft.whole()
        contours = list(self.path.contours)
        reached = None
        for number, other in enumerate(contours):
            if drawn.closed or other.closed or number == self.number:
                continue
            for turned in (other, other.reversed()):
                if reached is None and same(turned.points[0], drawn.points[-1]):
                    reached, drawn = number, join(drawn, turned, merge=True)
        contours[self.number] = drawn
        if reached is not None:
            del contours[reached]
        fields = fields_of(replace(self.path, contours=tuple(contours)))
        session.do("set_fields", self.node.id, label="Draw on", **fields)


def going_on(session: Session, viewer: Viewer, pixel: tuple[float, float]) -> GoingOn | None:
    """What the selected path has at a pixel: None where no open end of it is within reach."""
    if len(session.selection) != 1:
        return None
    document = session.document
    node = find(document, session.selection[0])
    if not isinstance(node, PathNode):
        return None
    try:
        plain = resolve_fields(node, parameter_values(document.parameters)[0], ())
        path, frame = own_path(plain), frame_of(document, node.id)
    except Refusal:  # its row says why
        return None
    open_ends = [
        (number, end, contour.points[end])
        for number, contour in enumerate(path.contours)
        if not contour.closed and contour.dimension == 2
        for end in (0, -1)
    ]
    if not open_ends:
        return None
    places = np.array([place for _, _, place in open_ends])
    seen = project(viewer.camera, places @ frame[:, :2].T + frame[:, 3], viewer.size)[:, :2]
    away = np.linalg.norm(seen - pixel, axis=1)
    away[np.isnan(away)] = np.inf
    best = int(np.argmin(away))
    if away[best] > REACH:
        return None
    number, end, _ = open_ends[best]
    contour = path.contours[number]
    others = [place for other, _, place in open_ends if other != number]
    return GoingOn(node, path, number, contour if end else contour.reversed(), np.array(others).reshape(-1, 2), frame)
