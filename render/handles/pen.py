"""Lines, dots and letters over the picture, drawn in pixels: as wide at every distance."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkTextActor

from ..camera import Camera, frame, project
from ..look import Colour, Look, rgb
from ..polydata import cells_of, points_of, set_cell_colours

Floats = NDArray[np.float64]
LabelText = tuple[Floats, str, Colour]
"""The middle of a label (2,) in logical pixels, its words and their colour."""

HALO = 1.2  # logical pixels around a line, on both sides
ARROW, SPREAD = 11.0, 3.6  # length and half the width of an arrow's head
HEAD_LENGTH, HEAD_SPREAD = 15.0, 6.5  # the same of one that shows a direction on the way
SHORTEST = 30.0  # pixels that a line with arrows has at least
DASH, MOST_DASHES = 12.0, 400  # pixels from dash to dash
LETTERS = 9  # points
NEAREST = 1e-3  # of the camera's distance: lines are cut so far before the eye


def ink_of(look: Look) -> Colour:
    """What letters and lines are drawn in."""
    return rgb("#1f2a38" if look.background_top > "#8" else "#f2f5f8")


class Labels:
    """As many labels as are wanted, up to a number of them."""

    def __init__(self, most: int) -> None:
        self.props = tuple(vtkTextActor() for _ in range(most))
        for label in self.props:
            letters = label.GetTextProperty()
            letters.SetFontFamilyToArial()
            letters.SetFontSize(LETTERS)
            letters.SetJustificationToCentered()
            letters.SetVerticalJustificationToCentered()
            letters.SetBackgroundOpacity(0.92)
            label.PickableOff()

    def hide(self) -> None:
        for label in self.props:
            label.SetVisibility(False)

    def show(self, labels: Sequence[LabelText], ground: Colour, size: tuple[float, float], scale: float) -> None:
        """The last ones first, where there are too many; `ground` is behind the letters."""
        free = iter(self.props)
        for (place, text, colour), label in zip(reversed(labels), free, strict=False):
            letters = label.GetTextProperty()
            letters.SetColor(*colour)
            letters.SetBackgroundColor(*ground)
            label.SetInput(f" {text} ")
            label.SetPosition(round(place[0] * scale), round((size[1] - place[1]) * scale))
            label.SetVisibility(True)
        for label in free:
            label.SetVisibility(False)


class Pen:
    """Draws in pixels, on the plane through the camera's target, as triangles that the window smooths."""

    def __init__(self, camera: Camera, size: tuple[float, float]) -> None:
        self._camera, self._size = camera, size
        self._halo: list[Floats] = []
        self._core: list[Floats] = []
        self._colours: tuple[list[Colour], list[Colour]] = ([], [])

    def stroke(self, a: Floats, b: Floats, width: float, colour: Colour, halo: Colour | None) -> Floats | None:
        """A line between points of the world; its ends (2, 2) in pixels, None where it cannot be seen."""
        seen = self._before_the_eye(a, b)
        if seen is None:
            return None
        ends = project(self._camera, seen, self._size)[:, :2]
        self._line(ends, width, colour, halo)
        return ends

    def _line(self, ends: Floats, width: float, colour: Colour, halo: Colour | None) -> None:
        along = ends[1] - ends[0]
        length = float(np.linalg.norm(along))
        if length < 1e-6:
            return
        across = np.array([-along[1], along[0]]) / length
        for half, found, colours, tone in (
            (width / 2 + HALO, self._halo, self._colours[0], halo),
            (width / 2, self._core, self._colours[1], colour),
        ):
            if tone is None:
                continue
            one, other = across * half, -across * half
            found.append(np.array([ends[0] + one, ends[0] + other, ends[1] + other]))
            found.append(np.array([ends[0] + one, ends[1] + other, ends[1] + one]))
            colours += [tone, tone]

    def dashes(self, a: Floats, b: Floats, width: float, colour: Colour, halo: Colour | None) -> Floats | None:
        """A dashed line, as `stroke`."""
        seen = self._before_the_eye(a, b)
        if seen is None:
            return None
        ends = project(self._camera, seen, self._size)[:, :2]
        count = int(np.clip(np.linalg.norm(ends[1] - ends[0]) / DASH, 1, MOST_DASHES))
        # Equal steps in the picture: points of the plane through the target, as `fill` has them.
        places = ends[0] + np.linspace(0.0, 1.0, 2 * count)[:, None] * (ends[1] - ends[0])
        for one, other in places.reshape(-1, 2, 2):
            self._line(np.array([one, other]), width, colour, halo)
        return ends

    def polyline(self, points: Floats, width: float, colour: Colour, halo: Colour | None) -> None:
        """A line through many points (n, 3) of the world; what lies behind the eye is left out."""
        pixels = project(self._camera, points, self._size)[:, :2]
        ends = np.stack((pixels[:-1], pixels[1:]), axis=1)  # (n - 1, 2, 2)
        along = ends[:, 1] - ends[:, 0]
        length = np.linalg.norm(along, axis=1)
        seen = np.isfinite(length) & (length > 1e-6)
        ends, way = ends[seen], along[seen] / length[seen, None]
        across = np.column_stack((-way[:, 1], way[:, 0]))
        for half, found, colours, tone in (
            (width / 2 + HALO, self._halo, self._colours[0], halo),
            (width / 2, self._core, self._colours[1], colour),
        ):
            if tone is None or not len(ends):
                continue
            # A little longer than it is, so that there is no gap where it turns.
            begin, end = ends[:, 0] - 0.35 * half * way, ends[:, 1] + 0.35 * half * way
            side = half * across
            found += [*np.stack((begin + side, begin - side, end - side), axis=1)]
            found += [*np.stack((begin + side, end - side, end + side), axis=1)]
            colours += [tone] * (2 * len(ends))

    def square(self, point: Floats, side: float, colour: Colour, halo: Colour | None) -> None:
        """An upright one about a point of the world, `side` pixels wide."""
        seen = self._before_the_eye(point, point)
        if seen is None:
            return
        middle = project(self._camera, seen[:1], self._size)[0, :2]
        corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        for half, found, colours, tone in (
            (side / 2 + HALO, self._halo, self._colours[0], halo),
            (side / 2, self._core, self._colours[1], colour),
        ):
            if tone is not None:
                around = middle + half * corners
                found += [around[[0, 1, 2]], around[[0, 2, 3]]]
                colours += [tone] * 2

    def dot(self, point: Floats, radius: float, colour: Colour, halo: Colour | None) -> Floats | None:
        """A round spot at a point of the world; its middle (2,) in pixels, None where it cannot be seen."""
        seen = self._before_the_eye(point, point)
        if seen is None:
            return None
        middle = project(self._camera, seen[:1], self._size)[0, :2]
        turn = np.linspace(0.0, 2.0 * np.pi, 17)
        rim = np.column_stack((np.cos(turn), np.sin(turn)))
        for size, found, colours, tone in (
            (radius + HALO, self._halo, self._colours[0], halo),
            (radius, self._core, self._colours[1], colour),
        ):
            if tone is not None:
                found += [
                    np.array([middle, middle + size * one, middle + size * other]) for one, other in pairwise(rim)
                ]
                colours += [tone] * (len(rim) - 1)
        return middle

    def _before_the_eye(self, a: Floats, b: Floats) -> Floats | None:
        """The part (2, 3) of a line that can be projected."""
        ends = np.array([a, b])
        if self._camera.parallel:
            return ends
        depth = (np.asarray(self._camera.position) - ends) @ frame(self._camera)[2] - NEAREST * self._camera.distance
        if (depth < 0).all():
            return None
        for i in np.flatnonzero(depth < 0):
            ends[i] += (ends[1 - i] - ends[i]) * depth[i] / (depth[i] - depth[1 - i])
        return ends

    def arrows(self, ends: Floats, colour: Colour) -> None:
        along = ends[1] - ends[0]
        length = float(np.linalg.norm(along))
        if length < SHORTEST:
            return
        way = along / length
        across = np.array([-way[1], way[0]])
        for tip, back in ((ends[0], way), (ends[1], -way)):
            foot = tip + ARROW * back
            self._core.append(np.array([tip, foot + SPREAD * across, foot - SPREAD * across]))
            self._colours[1].append(colour)

    def head(self, ends: Floats, share: float, colour: Colour) -> None:
        """An arrow's head on a line between pixels (2, 2), with its point at a share of the way."""
        along = ends[1] - ends[0]
        length = float(np.linalg.norm(along))
        if length < 1e-6:
            return
        way = along / length
        across = np.array([-way[1], way[0]])
        tip = ends[0] + share * along + HEAD_LENGTH / 2 * way
        foot = tip - HEAD_LENGTH * way
        self._core.append(np.array([tip, foot + HEAD_SPREAD * across, foot - HEAD_SPREAD * across]))
        self._colours[1].append(colour)

    def fill(self, data: vtkPolyData) -> None:
        """All of it as triangles of the world; the halos a little behind the lines."""
        pixels = np.array([*self._halo, *self._core]).reshape(-1, 2)
        right, up, backward = frame(self._camera)
        half = self._camera.half_height
        width, height = self._size
        x = (2 * pixels[:, :1] - width) / height * half
        y = (1 - 2 * pixels[:, 1:] / height) * half
        points = np.asarray(self._camera.target) + x * right + y * up
        points[: 3 * len(self._halo)] -= 1e-4 * self._camera.distance * backward
        data.SetPoints(points_of(points))
        data.SetPolys(cells_of(np.arange(len(points), dtype=np.int32).reshape(-1, 3)))
        colours = np.array([*self._colours[0], *self._colours[1]]).reshape(-1, 3)
        set_cell_colours(data, np.round(255 * colours).astype(np.uint8))
        data.Modified()
