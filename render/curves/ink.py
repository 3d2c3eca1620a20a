"""Many lines and small shapes in pixels over the picture, as one batch of triangles in the camera's plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ..camera import Camera, frame
from ..look import Colour
from ..polydata import cells_of, points_of, set_cell_colours
from ..shading import unlit

Floats = NDArray[np.float64]

DASH = 9.0  # logical pixels from the beginning of a dash to the next one
MOST_DASHES = 300  # in one line
LAYER = 1e-3  # of the camera's distance between two layers


def regular(corners: int, radius: float, turn: float = 0.0) -> Floats:
    """(corners, 2) of a regular polygon about the origin, the first one `turn` degrees from x."""
    angles = np.radians(turn) + np.linspace(0.0, 2.0 * np.pi, corners, endpoint=False)
    return radius * np.column_stack((np.cos(angles), np.sin(angles)))


def ink_actor() -> vtkActor:
    """An actor to `Ink.fill`: without light, and nothing that could be picked."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(vtkPolyData())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.PickableOff()
    actor.VisibilityOff()
    unlit(actor)
    return actor


class Ink:
    """All places are logical pixels, y downward; rows that are not finite, or far beside the picture, are left out.

    What is in a higher `layer` covers what is in a lower one, in whatever order they came.
    """

    def __init__(self, camera: Camera, size: tuple[float, float]) -> None:
        self._camera, self._size = camera, size
        self._points: list[Floats] = []
        self._layers: list[Floats] = []
        self._triangles: list[NDArray[np.int64]] = []
        self._colours: list[NDArray[np.uint8]] = []
        self._count = 0

    def seen(self, places: Floats, margin: float = 30.0) -> NDArray[np.bool_]:
        """(n,) which of places (n, 2) are in the picture or not far beside it."""
        with np.errstate(invalid="ignore"):
            return np.asarray(((places > -margin) & (places < np.array(self._size) + margin)).all(axis=1), bool)

    def shapes(
        self, places: Floats, outline: Floats, colours: Colour | Floats, layer: int, sizes: Floats | float = 1.0
    ) -> None:
        """A convex outline (t, 2) at each of places (n, 2), times `sizes`, in one colour or in rows of (n, 3)."""
        kept = self.seen(places)
        if not kept.any():
            return
        factors = np.broadcast_to(np.asarray(sizes, float), len(places))[kept]
        points = places[kept][:, None, :] + factors[:, None, None] * outline
        tones = np.broadcast_to(np.asarray(colours, float), (len(places), 3))[kept]
        self._fans(points, tones, layer)

    def polygons(self, corners: Floats, colours: Colour | Floats, layer: int) -> None:
        """Convex polygons of corners (n, t, 2)."""
        kept = np.isfinite(corners).all(axis=(1, 2))
        tones = np.broadcast_to(np.asarray(colours, float), (len(corners), 3))
        self._fans(corners[kept], tones[kept], layer)

    def lines(self, ends: Floats, width: float, colours: Colour | Floats, layer: int) -> None:
        """Lines (n, 2, 2)."""
        tones = np.broadcast_to(np.asarray(colours, float), (len(ends), 3))
        with np.errstate(invalid="ignore"):
            low, high = ends.min(axis=1), ends.max(axis=1)
            along = ends[:, 1] - ends[:, 0]
            length = np.hypot(along[:, 0], along[:, 1])
            kept = ((high > -width) & (low < np.array(self._size) + width)).all(axis=1) & (length > 1e-6)
        if not kept.any():
            return
        ends, along = ends[kept], along[kept] / length[kept][:, None]
        across = 0.5 * width * np.column_stack((-along[:, 1], along[:, 0]))
        corners = np.stack((ends[:, 0] + across, ends[:, 0] - across, ends[:, 1] - across, ends[:, 1] + across), axis=1)
        self._fans(corners, tones[kept], layer)

    def dashes(self, ends: Floats, width: float, colour: Colour, layer: int) -> None:
        """Lines (n, 2, 2) as dashes of equal length."""
        ends = ends[np.isfinite(ends).all(axis=(1, 2))]
        if not len(ends):
            return
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        counts = np.clip(np.round(length / DASH), 1, MOST_DASHES).astype(np.intp)
        number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        step = np.repeat(1.0 / counts, counts)
        first, way = np.repeat(ends[:, 0], counts, axis=0), np.repeat(ends[:, 1] - ends[:, 0], counts, axis=0)
        begin = (number * step)[:, None]
        stop = begin + 0.6 * step[:, None]
        self.lines(np.stack((first + begin * way, first + stop * way), axis=1), width, colour, layer)

    def _fans(self, corners: Floats, tones: Floats, layer: int) -> None:
        count, size = corners.shape[:2]
        if not count:
            return
        fan = np.column_stack((np.zeros(size - 2, np.int64), np.arange(1, size - 1), np.arange(2, size)))
        begin = self._count + size * np.arange(count)
        self._points.append(corners.reshape(-1, 2))
        self._layers.append(np.full(count * size, float(layer)))
        self._triangles.append((begin[:, None, None] + fan).reshape(-1, 3))
        self._colours.append(np.repeat(np.round(255.0 * tones).astype(np.uint8), size - 2, axis=0))
        self._count += count * size

    def fill(self, actor: vtkActor) -> None:
        """Make it what an actor shows; the actor is hidden where there is nothing."""
        actor.SetVisibility(bool(self._count))
        if not self._count:
            return
        camera, (width, height) = self._camera, self._size
        right, up, backward = frame(camera)
        pixels, layers = np.concatenate(self._points), np.concatenate(self._layers)[:, None]
        half = camera.half_height
        across = (2.0 * pixels[:, :1] - width) / height * half * right + (
            1.0 - 2.0 * pixels[:, 1:] / height
        ) * half * up
        nearer = LAYER * layers
        # Towards the eye, so that it stays the same pixel.
        shrink = 1.0 if camera.parallel else 1.0 - nearer
        points = shrink * across + nearer * camera.distance * backward
        actor.SetPosition(*camera.target)
        data = actor.GetMapper().GetInput()
        data.SetPoints(points_of(points))
        data.SetPolys(cells_of(np.concatenate(self._triangles).astype(np.int32)))
        set_cell_colours(data, np.concatenate(self._colours))
        data.Modified()
