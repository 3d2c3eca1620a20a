"""The freehand stroke: what is drawn becomes cubics within a tolerance, smooth but at its corners."""

from __future__ import annotations

import numpy as np

from ....model.document.errors import Refusal
from ....model.document.nodes import Node
from ....model.path.fitting import stroke
from ....model.path.path import Path
from .draft import Draft, Floats, Held, Sketch, path_node, polyline

CLOSING = 12.0
"""Pixels between the end of a stroke and its start that close it."""


class Freehand(Draft):
    kind = "freehand path"
    hint = "Drag to draw; where it ends near its start it is closed; Escape ends this"
    snaps = False
    turns = False

    @property
    def places(self) -> Floats:
        return np.zeros((0, 2))

    def press(self, point: Floats, held: Held) -> None:
        self.points = [point]
        self.pointer = point

    def drag(self, point: Floats, held: Held) -> None:
        self.pointer = point
        if self.points and (point != self.points[-1]).any():
            self.points.append(point)

    def release(self, point: Floats, held: Held, dragged: bool) -> None:
        self.drag(point, held)
        if len(self.points) < 3:
            self.points = []
        else:
            self.complete = True

    def finish(self, closed: bool = False) -> None:
        raise Refusal("drag to draw a stroke")

    def names(self, polar: bool) -> tuple[str, ...]:
        return ()

    @property
    def closes(self) -> bool:
        """Whether the stroke has come back to where it began."""
        points, reach = np.array(self.points), CLOSING * self.options.pixel
        far = np.linalg.norm(points - points[0], axis=1)
        return bool(far[-1] <= reach and far.max() > 2.0 * reach)

    def path(self) -> Path:
        return stroke(np.array(self.points), self.options.tolerance * self.options.pixel, closed=self.closes)

    def node(self) -> Node:
        return path_node(self.path())

    def sketch(self) -> Sketch:
        marked = self.points[:1] if len(self.points) > 1 else []
        return Sketch(polyline(self.points), None, np.array(marked).reshape(-1, 2))
