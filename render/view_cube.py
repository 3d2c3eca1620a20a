"""The view cube: a small labelled cube in the upper right corner that shows the view, and turns it when clicked."""

import itertools
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkTextProperty,
    vtkTextRenderer,
    vtkTexture,
)

from .camera import Camera, apply, frame, ray
from .look import LIGHT, Look, light_up, mixed, rgb
from .polydata import cells_of, lines_of, points_of, set_cell_colours, vtk_array
from .shading import shade, unlit
from .views import standard_view

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

SIZE, MARGIN = 118, 6  # logical pixels: the side of the square that the cube turns in, and what is left at the border
RIM = 0.7  # beyond this part of a face's half side lie the edges and corners
TILE, LETTERS = 64, 44  # pixels of a label, 4 times as wide as high, and the points of its letters
SIDES = ("front", "back", "left", "right", "top", "bottom")
BOUNDS = np.array([[-1.3] * 3, [1.3] * 3])
DISTANCE = 10.6


class ViewCube:
    """A renderer in a layer of its own above the picture. Pixel coordinates as in `camera`, of the whole viewport."""

    def __init__(self, window: "vtkRenderWindow", look: Look = LIGHT, layer: int = 1) -> None:
        self.renderer = vtkRenderer()
        self.renderer.SetLayer(layer)
        self.renderer.InteractiveOff()
        self.renderer.SetUseOIT(False)
        window.SetNumberOfLayers(max(window.GetNumberOfLayers(), layer + 1))
        window.AddRenderer(self.renderer)
        light_up(self.renderer)
        self._look = look
        self._hover: str | None = None
        self._size = (1.0, 1.0)
        self._camera = Camera(view_angle=20.0)
        points, quads, self._regions = _patches()
        self._cube = vtkPolyData()
        self._cube.SetPoints(points_of(points))
        self._cube.SetPolys(cells_of(quads))
        self._faces = _actor(self._cube)
        labels, texture = _labels()
        self._labels = _actor(labels)
        self._labels.SetTexture(texture)
        self._rims = _actor(_rims())
        self._axes = _actor(_axes())
        for actor in (self._faces, self._labels, self._rims, self._axes):
            self.renderer.AddActor(actor)
        self.set_look(look)

    def set_look(self, look: Look) -> None:
        self._look = look
        shade(self._faces, look, flat=True)
        self._faces.GetProperty().SetAmbient(0.55)
        self._faces.GetProperty().SetDiffuse(0.5)
        for actor in (self._labels, self._rims, self._axes):
            unlit(actor)
        self._labels.GetMapper().ScalarVisibilityOff()
        self._labels.GetProperty().SetColor(*rgb(look.cube_text))
        self._rims.GetMapper().ScalarVisibilityOff()
        self._rims.GetProperty().SetColor(*mixed(rgb(look.cube_face), rgb(look.cube_text), 0.45))
        axes = np.array([rgb(look.axis_x), rgb(look.axis_y), rgb(look.axis_z)])
        set_cell_colours(self._axes.GetMapper().GetInput(), np.round(255.0 * axes).astype(np.uint8))
        self._paint()

    def set_visible(self, visible: bool) -> None:
        self.renderer.SetDraw(visible)

    def resize(self, width: float, height: float, scale: float = 1.0) -> None:
        """Tell the viewport's size in logical pixels and the device pixels per logical one (for line widths)."""
        self._size = (max(width, 1.0), max(height, 1.0))
        x0, y0, side = self._square()
        width, height = self._size
        self.renderer.SetViewport(
            max(x0 / width, 0.0),
            max(1.0 - (y0 + side) / height, 0.0),
            min((x0 + side) / width, 1.0),
            min(1.0 - y0 / height, 1.0),
        )
        self._rims.GetProperty().SetLineWidth(scale)
        self._axes.GetProperty().SetLineWidth(1.6 * scale)

    def turn(self, camera: Camera) -> None:
        """Show the cube as the main camera sees the world."""
        axes = frame(camera)
        position = DISTANCE * axes[2]
        up = axes[1]
        self._camera = replace(self._camera, position=tuple(position.tolist()), up=tuple(up.tolist()))
        apply(self._camera, self.renderer.GetActiveCamera(), BOUNDS)

    def hit(self, x: float, y: float) -> str | None:
        """The view under pixel (x, y), a name for `views.standard_view` such as "front" or "front-right-top"."""
        x0, y0, side = self._square()
        if not self.renderer.GetDraw() or not (x0 <= x < x0 + side and y0 <= y < y0 + side):
            return None
        origin, direction = ray(self._camera, x - x0, y - y0, (side, side))
        with np.errstate(divide="ignore"):
            planes = np.stack([(-1.0 - origin) / direction, (1.0 - origin) / direction])
        entry, leave = planes.min(axis=0).max(), planes.max(axis=0).min()
        return None if entry > leave else _name(origin + entry * direction)

    def set_hover(self, name: str | None) -> bool:
        """Highlight a region by the name that `hit` gave; whether that changes the picture."""
        if name == self._hover:
            return False
        self._hover = name
        self._paint()
        return True

    def _square(self) -> tuple[float, float, float]:
        """Left, top and side of the cube's square in logical pixels."""
        side = min(SIZE, *self._size)
        return max(self._size[0] - side - MARGIN, 0.0), min(MARGIN, self._size[1] - side), side

    def _paint(self) -> None:
        colours = np.empty((len(self._regions), 3))
        colours[:] = rgb(self._look.cube_face)
        colours[[name == self._hover for name in self._regions]] = rgb(self._look.cube_hover)
        set_cell_colours(self._cube, np.round(255.0 * colours).astype(np.uint8))


def _name(point: NDArray[np.float64]) -> str:
    """The region of the cube's surface that a point (3,) on it lies in, as the name of a view."""
    sides = np.where(np.abs(point) > RIM, np.sign(point), 0.0)
    names = (("left", "right")[int(sides[0] > 0)] if sides[0] else "",)
    names = (("front", "back")[int(sides[1] > 0)] if sides[1] else "", *names)
    names = (*names, ("bottom", "top")[int(sides[2] > 0)] if sides[2] else "")
    return "-".join(name for name in names if name)


def _patches() -> tuple[NDArray[np.float32], NDArray[np.int32], list[str]]:
    """The cube's faces in 3 by 3 patches: points (n, 3), quads (54, 4), and the region's name of each quad."""
    cuts = (-1.0, -RIM, RIM, 1.0)
    points, names = [], []
    for side in SIDES:
        right, up, out = frame(standard_view(Camera(position=(1.0, 0.0, 0.0)), side))
        for i, j in itertools.product(range(3), range(3)):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            points += [out + cuts[a] * right + cuts[b] * up for a, b in corners]
            names.append(_name(np.mean(points[-4:], axis=0)))
    array = np.array(points, np.float32)
    return array, np.arange(len(array), dtype=np.int32).reshape(-1, 4), names


def _labels() -> tuple[vtkPolyData, vtkTexture]:
    """Six squares just above the faces, upright in their standard views, and the names on them, white on nothing."""
    points, places = [], []
    tiles = np.zeros((len(SIDES) * TILE, 4 * TILE, 4), np.uint8)
    letters = vtkTextProperty()
    letters.SetFontFamilyToArial()
    letters.BoldOn()
    letters.SetFontSize(LETTERS)
    letters.SetColor(1.0, 1.0, 1.0)
    for row, side in enumerate(SIDES):
        right, up, out = frame(standard_view(Camera(position=(1.0, 0.0, 0.0)), side))
        image = vtkImageData()
        vtkTextRenderer.GetInstance().RenderString(letters, side.upper(), image, [0, 0], 96)
        width, height, _ = image.GetDimensions()
        text = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 4)
        rows, columns = (np.flatnonzero(text[..., 3].any(axis=axis)) for axis in (1, 0))
        text = text[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1][:TILE, : 4 * TILE]
        top, left = (TILE - text.shape[0]) // 2, (4 * TILE - text.shape[1]) // 2
        tiles[row * TILE : (row + 1) * TILE, :, :3] = 255
        tiles[row * TILE + top : row * TILE + top + text.shape[0], left : left + text.shape[1]] = text
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            points.append(1.01 * out + 0.97 * x * right + 0.2425 * y * up)
            places.append(((x + 1) / 2, (row + (y + 1) / 2) / len(SIDES)))
    labels = vtkPolyData()
    labels.SetPoints(points_of(np.array(points, np.float32)))
    labels.SetPolys(cells_of(np.arange(4 * len(SIDES), dtype=np.int32).reshape(-1, 4)))
    labels.GetPointData().SetTCoords(vtk_array(np.array(places), np.float32, "places"))
    atlas = vtkImageData()
    atlas.SetDimensions(tiles.shape[1], tiles.shape[0], 1)
    atlas.GetPointData().SetScalars(vtk_array(tiles.reshape(-1, 4), np.uint8, "names"))
    texture = vtkTexture()
    texture.SetInputDataObject(atlas)
    texture.InterpolateOn()
    texture.MipmapOn()
    return labels, texture


def _rims() -> vtkPolyData:
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=3)), np.float32)
    pairs = [(a, b) for a in range(8) for b in range(a) if (corners[a] != corners[b]).sum() == 1]
    return lines_of(1.004 * corners, np.array(pairs, np.int32))


def _axes() -> vtkPolyData:
    """Three lines along x, y and z, a little outside the lower left front corner."""
    corner = np.full(3, -1.16)
    points = np.array([corner, *(corner + 2.32 * np.eye(3))], np.float32)
    return lines_of(points, np.array([(0, 1), (0, 2), (0, 3)], np.int32))


def _actor(data: vtkPolyData) -> vtkActor:
    mapper: Any = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.PickableOff()
    return actor
