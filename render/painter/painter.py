"""The faces of all solids as one list of triangles, put into painter's order for each eye."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkPolyData

from ...model.partition.order import Sorter, heights
from ..actors import faces_actor
from ..camera import frame
from ..polydata import cells_of, places_in, points_of, set_point_colours, vtk_array
from ..surfaces.shader import CORNER_NORMALS, CORNER_POINTS, CORNER_WEIGHTS, NUMBER, POSITION
from .closed import is_closed
from .corners import Corners, corners_of
from .depth import DepthAlways

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

    from ...model.partition.tree import Tree
    from ...model.solid.display import DisplayMesh
    from ..camera import Camera

MOST_PLANES = 6
"""What VTK's shaders clip by."""


class Painter:
    """One actor of a renderer, and a second one for what is drawn after the lines of the ground.

    Opaque faces are drawn without a depth test and leave the depths of the nearest, with which all other actors are
    compared as ever. Translucent ones are blended in order: they are compared with the depths of opaque lines and cuts,
    and leave none. No method draws.
    """

    def __init__(self, renderer: vtkRenderer) -> None:
        self.count: int | None = None
        """Only so many fragments of the order are drawn, None for all."""
        self._renderer = renderer
        self._data = vtkPolyData()
        self.actor, self.late = faces_actor(self._data), faces_actor(self._data)
        for actor in self.actors:
            actor.PickableOff()
        self._depth = DepthAlways(renderer, self.actor)
        self._plane, self._other_plane = vtkPlane(), vtkPlane()
        self._corners: Corners | None = None
        self._sorter: Sorter | None = None
        self._fans = np.zeros((0, 3), np.int32)
        self._planes = np.zeros(0, np.int64)
        self._closed: dict[DisplayMesh, bool] = {}
        self._heights = [0.0, 0.0]
        self._lit_at_corners = False
        self._order = np.zeros(0, np.int64)
        self._ordered: tuple[object, ...] | None = None
        self.hide()

    @property
    def actors(self) -> tuple[vtkActor, vtkActor]:
        return self.actor, self.late

    @property
    def tree(self) -> Tree | None:
        return None if self._corners is None else self._corners.tree

    @property
    def meshes(self) -> tuple[DisplayMesh, ...]:
        return () if self._corners is None else self._corners.meshes

    def over_ground(self) -> None:
        """Call it once the actor of the ground has been added to the renderer."""
        self._renderer.AddActor(self.late)

    def show(self, tree: Tree, meshes: Sequence[DisplayMesh]) -> None:
        """Draw the faces of a tree over the triangles of the meshes, one mesh after the other.

        What it shares with the tree before, at their beginnings, is kept. Raises ValueError where tree and meshes do
        not fit each other. Colours have to be set afterwards.
        """
        self._corners = corners_of(tree, meshes, self._corners)
        self._sorter = Sorter(tree)
        self._fans = self._sorter.fans.astype(np.int32)
        self._planes = tree.faces.plane_of[tree.source][self._sorter.fragment_of]
        self._closed = {mesh: self._closed[mesh] if mesh in self._closed else is_closed(mesh) for mesh in meshes}
        self._ordered = None
        self._order = np.zeros(0, np.int64)
        data = vtkPolyData()
        data.SetPoints(points_of(self._corners.points))
        data.GetPointData().SetNormals(vtk_array(self._corners.normals, np.float32, "normals"))
        self._data = data
        for actor in self.actors:
            _mapper(actor).SetInputData(data)
        boxes = [np.reshape(mesh.bounds, (2, 3)) for mesh in meshes if len(mesh.triangles)] or [np.zeros((2, 3))]
        bounds = np.array([np.min(boxes, axis=(0, 1)), np.max(boxes, axis=(0, 1))], float)
        self._heights = bounds[:, 2].tolist()
        self._depth.set_bounds(bounds)

    def clear(self) -> None:
        """Let go of tree and meshes."""
        self.hide()
        self._corners = self._sorter = self._ordered = None
        self._closed = {}
        self._data = vtkPolyData()
        for actor in self.actors:
            _mapper(actor).SetInputData(self._data)

    def colour(self, colours: NDArray[np.uint8]) -> None:
        """The colours (m, 3) of the faces."""
        if self._corners is not None:
            set_point_colours(self._data, colours.take(self._corners.face, axis=0))

    def light_at_corners(self, wanted: bool) -> None:
        """Hand the normals of whole triangles to the shader, which Gouraud's light between their corners needs."""
        data, corners = self._data.GetPointData(), self._corners
        if corners is None or wanted == bool(data.HasArray(CORNER_WEIGHTS)) == self._lit_at_corners:
            return
        self._lit_at_corners = wanted
        names = (*CORNER_NORMALS, *CORNER_POINTS, CORNER_WEIGHTS)
        values = (*corners.corner_normals(), *corners.corner_points(), corners.weights) if wanted else ()
        self._set_attributes(names, values)

    def wear(self, numbers: NDArray[np.float32] | None, frames: Sequence[NDArray[np.float64]] = ()) -> None:
        """Hand the shader the numbers (m,) of the faces' looks, and the places in the frames (3, 4) of these numbers;
        None takes them away."""
        corners = self._corners
        if corners is None or (numbers is None and not self._data.GetPointData().HasArray(NUMBER)):
            return
        values: tuple[NDArray[np.float32], ...] = ()
        if numbers is not None:
            number = numbers[corners.face]
            values = (number, places_in(corners.points, number, frames))
        self._set_attributes((NUMBER, POSITION), values)

    def _set_attributes(self, names: Sequence[str], values: Sequence[NDArray[np.float32]]) -> None:
        """Vertex attributes for the shader, or none of these names."""
        data = self._data.GetPointData()
        for name in names:
            data.RemoveArray(name)
        for name, array in zip(names, values, strict=False):
            data.AddArray(vtk_array(array, np.float32, name))
        for actor in self.actors:
            for name in names:
                _mapper(actor).RemoveVertexAttributeMapping(name)
            for name in names[: len(values)]:
                _mapper(actor).MapDataArrayToVertexAttribute(name, name, 0, -1)

    def hide(self) -> None:
        for actor in (*self.actors, self._depth.restorer):
            actor.VisibilityOff()

    def turn(self, camera: Camera, opaque: bool, cull: bool, ground: float | None = None) -> None:
        """Show the faces in the order for this camera.

        With `cull` those that are turned away are left out where nobody can see them. Translucent faces are blended
        below and above lines of the ground at the height z = `ground`, each as it lies.
        """
        if self._corners is None or self._sorter is None:
            return
        self._sort(camera, opaque and cull and self.count is None)
        self._depth.on = opaque
        self._depth.restorer.SetVisibility(opaque)
        self._part(camera, None if opaque else ground)

    def _sort(self, camera: Camera, cull: bool) -> None:
        assert self._corners is not None and self._sorter is not None
        eye = np.asarray(camera.position, float)
        towards = eye - camera.target if camera.parallel else eye
        wanted = (camera.parallel, cull, self.count, *towards.tolist())
        if wanted == self._ordered:
            return
        self._ordered = wanted
        order = self._sorter.triangles(towards, camera.parallel)
        if self.count is not None:
            fragment = self._sorter.fragment_of[order]
            begins = np.flatnonzero(np.diff(fragment, prepend=-1))
            order = order[: begins[self.count]] if 0 <= self.count < len(begins) else order
        if cull and (closed := self._seen_from_outside(eye, camera.parallel)) is not None:
            seen = (heights(self._corners.tree.faces.planes, towards, camera.parallel) > 0.0)[self._planes]
            order = order[(seen | ~closed)[order]]
        if not np.array_equal(order, self._order):
            self._order = order
            self._data.SetPolys(cells_of(self._fans[order]))

    def _seen_from_outside(self, eye: NDArray[np.float64], parallel: bool) -> NDArray[np.bool_] | None:
        """(t,) which triangles belong to closed meshes that the eye is outside of; None where no one does."""
        assert self._corners is not None and self._sorter is not None
        outside = []
        for mesh in self._corners.meshes:
            low, high = np.reshape(mesh.bounds, (2, 3))
            outside.append(self._closed[mesh] and (parallel or bool(((eye < low) | (eye > high)).any())))
        if not any(outside):
            return None
        faces = np.repeat(outside, [len(mesh.triangles) for mesh in self._corners.meshes])
        return faces[self._corners.tree.source][self._sorter.fragment_of]

    def _part(self, camera: Camera, ground: float | None) -> None:
        """Draw what lies beyond a height before its lines and what lies on the eye's side after them."""
        early, late = True, False
        planes = self.actor.GetMapper().GetClippingPlanes()
        planes = 0 if planes is None else planes.GetNumberOfItems() - self._is_split
        split = False
        if ground is not None and self._renderer.HasViewProp(self.late):
            above = (frame(camera)[2, 2] if camera.parallel else camera.position[2] - ground) > 0.0
            low, high = self._heights
            early, late = (low < ground, high > ground) if above else (high > ground, low < ground)
            split = early and late and planes < MOST_PLANES
            late = late or not early
            early = early and (split or not late)
            sign = 1.0 if above else -1.0
            for plane, side in ((self._plane, -sign), (self._other_plane, sign)):
                plane.SetOrigin(0.0, 0.0, ground)
                plane.SetNormal(0.0, 0.0, side)
        if split != self._is_split:
            for actor, plane in ((self.actor, self._plane), (self.late, self._other_plane)):
                mapper = actor.GetMapper()
                (mapper.AddClippingPlane if split else mapper.RemoveClippingPlane)(plane)
        self.actor.SetVisibility(early)
        self.late.SetVisibility(late)

    @property
    def _is_split(self) -> bool:
        planes = self.actor.GetMapper().GetClippingPlanes()
        return planes is not None and bool(planes.IsItemPresent(self._plane))


def _mapper(actor: vtkActor) -> Any:
    return actor.GetMapper()
