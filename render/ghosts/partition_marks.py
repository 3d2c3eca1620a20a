"""What is shown of a BSP tree in the picture: a node's plane, what lies before and behind it, single fragments."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ..look import rgb
from ..polydata import cells_of, lines_of, points_of
from ..shading import unlit
from .ghosts import BEFORE_ALL
from .plane_grid import plane_grid

if TYPE_CHECKING:
    from ...model.partition.tree import Tree
    from ..viewer import Viewer

Numbers = NDArray[np.int64]

MOST_OUTLINED = 20_000
"""Fragments whose borders are drawn; of more, one could not be told from the next."""
SPREAD = 0.04
"""How much farther than the scene a plane is drawn, as a part of its size."""


@dataclass(frozen=True, slots=True)
class Tints:
    """Colours as #rrggbb."""

    front: str
    back: str
    own: str
    step: str


class PartitionMarks:
    """Marks among the solids of a viewer's picture, hidden by what lies before them as far as is good for them.

    They follow `scene.sections`: what a section takes away is not tinted either.
    """

    def __init__(self, viewer: Viewer) -> None:
        self._viewer = viewer
        self._widths: dict[vtkActor, float] = {}
        # Opacity, how much nearer than the faces, width of lines in logical pixels.
        self._front, self._back = self._made(0.5, -1.0), self._made(0.5, -1.0)
        self._own, self._rims = self._made(0.55, -2.0), self._made(1.0, -4.0, 1.6)
        self._plane, self._grid = self._made(0.16, -3.0), self._made(0.55, -3.0, 1.0)
        self._far_plane, self._far_grid = self._made(0.04, BEFORE_ALL), self._made(0.22, BEFORE_ALL, 1.0)
        self._step, self._step_rim = self._made(0.6, BEFORE_ALL), self._made(1.0, BEFORE_ALL - 2.0, 2.4)
        self._point = self._made(1.0, BEFORE_ALL - 4.0)
        self._point.GetProperty().SetRepresentationToPoints()
        self._point.GetProperty().RenderPointsAsSpheresOn()
        self._planes = viewer.scene.sections.planes
        self._tree: Tree | None = None
        self._fans = np.zeros((0, 3), np.int32)
        self._fragment_of: Numbers = np.zeros(0, np.int64)

    def set_tree(self, tree: Tree | None) -> None:
        """The tree whose nodes and fragments are meant from now on; nothing of it is marked yet."""
        if tree is self._tree:
            return
        self._tree = tree
        self.show_node(None)
        self.show_step(None)
        if tree is not None:
            sizes = np.diff(tree.starts).astype(np.int64) - 2
            self._fragment_of = np.repeat(np.arange(len(sizes)), sizes)
            begin = tree.starts[:-1].astype(np.int64)[self._fragment_of]
            step = np.arange(len(begin)) - (np.cumsum(sizes) - sizes)[self._fragment_of] + 1
            self._fans = tree.corners[np.column_stack((begin, begin + step, begin + step + 1))]

    def show_node(
        self,
        plane: NDArray[np.float64] | None,
        own: Numbers | None = None,
        front: Numbers | None = None,
        back: Numbers | None = None,
        tints: Tints | None = None,
    ) -> None:
        """Show a plane (4,) unless it is None, and tint fragments: those in it, before it and behind it."""
        self._viewer.needs_render = True
        parts = ((self._front, front, "front"), (self._back, back, "back"), (self._own, own, "own"))
        for actor, fragments, name in parts:
            self._fill(actor, fragments, "" if tints is None else getattr(tints, name))
        rims = own if own is not None and len(own) <= MOST_OUTLINED else None
        self._outline(self._rims, rims, "" if tints is None else tints.own)
        grids = (self._plane, self._grid, self._far_plane, self._far_grid)
        for actor in grids:
            actor.SetVisibility(plane is not None)
        if plane is None or self._tree is None or tints is None:
            return
        points = self._tree.faces.points
        box = np.array([points.min(axis=0), points.max(axis=0)])
        spread = SPREAD * self._tree.faces.size
        found = plane_grid(plane[:3], plane[:3] * plane[3], box + spread * np.array([[-1.0], [1.0]]))
        for actor in grids:
            filled = actor in (self._plane, self._far_plane)
            _take(actor, found.faces.polys() if filled else found.lines.lines())
            self._dress(actor, tints.own)

    def show_step(self, fragment: int | None, tints: Tints | None = None) -> None:
        """Show one fragment through everything, as the one that is drawn last."""
        self._viewer.needs_render = True
        one = None if fragment is None else np.array([fragment])
        colour = "" if tints is None else tints.step
        self._fill(self._step, one, colour)
        self._outline(self._step_rim, one, colour)

    def show_point(self, point: NDArray[np.float64] | None, tints: Tints | None = None) -> None:
        """Mark a point (3,), unless it is farther away than a picture's numbers reach."""
        self._viewer.needs_render = True
        within = point is not None and bool(np.abs(point).max() < np.finfo(np.float32).max)
        self._point.SetVisibility(within)
        if point is not None and within and tints is not None:
            data = vtkPolyData()
            data.SetPoints(points_of(point))
            data.SetVerts(cells_of(np.zeros((1, 1), np.int32)))
            _take(self._point, data)
            self._dress(self._point, tints.step)
            self._point.GetProperty().SetPointSize(9.0 * self._viewer.scale)

    def follow_sections(self) -> None:
        """Let the sections that are open now clip what is tinted."""
        planes = self._viewer.scene.sections.planes
        if planes != self._planes:
            self._planes = planes
            self._viewer.scene.sections.clip((self._front, self._back, self._own, self._rims))
            self._viewer.needs_render = True

    def clear(self) -> None:
        """Show nothing, and let go of the tree."""
        self.set_tree(None)
        self.show_node(None)
        self.show_step(None)
        self.show_point(None)

    def _made(self, opacity: float, nearer: float, width: float = 0.0) -> vtkActor:
        mapper = vtkPolyDataMapper()
        mapper.ScalarVisibilityOff()
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, nearer)
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, nearer)
        mapper.SetRelativeCoincidentTopologyPointOffsetParameter(nearer)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.PickableOff()
        actor.UseBoundsOff()
        actor.VisibilityOff()
        unlit(actor)
        actor.GetProperty().SetOpacity(opacity)
        self._widths[actor] = max(width, 1.0)
        self._viewer.renderer.AddActor(actor)
        return actor

    def _dress(self, actor: vtkActor, colour: str) -> None:
        actor.GetProperty().SetColor(*rgb(colour))
        actor.GetProperty().SetLineWidth(self._widths[actor] * self._viewer.scale)

    def _fill(self, actor: vtkActor, fragments: Numbers | None, colour: str) -> None:
        tree = self._tree
        shown = tree is not None and fragments is not None and len(fragments) > 0
        actor.SetVisibility(shown)
        if tree is None or fragments is None or not shown:
            return
        wanted = np.zeros(len(tree.source), bool)
        wanted[fragments] = True
        data = vtkPolyData()
        data.SetPoints(points_of(tree.points))
        data.SetPolys(cells_of(self._fans[wanted[self._fragment_of]]))
        _take(actor, data)
        self._clip(actor)
        self._dress(actor, colour)

    def _outline(self, actor: vtkActor, fragments: Numbers | None, colour: str) -> None:
        tree = self._tree
        shown = tree is not None and fragments is not None and len(fragments) > 0
        actor.SetVisibility(shown)
        if tree is None or fragments is None or not shown:
            return
        _take(actor, lines_of(tree.points, borders(tree, fragments)))
        self._clip(actor)
        self._dress(actor, colour)

    def _clip(self, actor: vtkActor) -> None:
        if actor not in (self._step, self._step_rim):
            self._viewer.scene.sections.clip((actor,))


def borders(tree: Tree, fragments: Numbers) -> NDArray[np.int32]:
    """(e, 2) the sides of fragments, as places in the tree's points."""
    first, last = tree.starts[fragments].astype(np.int64), tree.starts[fragments + 1].astype(np.int64)
    sizes = last - first
    begins = np.repeat(first - np.cumsum(sizes) + sizes, sizes) + np.arange(int(sizes.sum()))
    ends = np.where(begins + 1 == np.repeat(last, sizes), np.repeat(first, sizes), begins + 1)
    return np.column_stack((tree.corners[begins], tree.corners[ends])).astype(np.int32)


def _take(actor: vtkActor, data: vtkPolyData) -> None:
    actor.GetMapper().SetInputDataObject(data)
