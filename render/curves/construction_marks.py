"""The construction of a point of a curve over the picture: its levels, the strings, the steps and the tangent."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkProp

from ..camera import Camera, project
from ..handles.pen import Labels, LabelText
from ..look import LIGHT, Colour, Look, mixed, rgb
from .construction_colours import DARK_LEVELS, LIGHT_LEVELS, colour_of_point
from .ink import Ink, ink_actor, regular

Floats = NDArray[np.float64]

STRING, CHORD, LEVEL, HALF, TANGENT = 1.1, 1.5, 1.8, 2.4, 2.0  # widths in logical pixels
CONTROL, DOT, STEP, POINT, RIM = 7.2, 3.2, 2.4, 6.0, 1.5  # radii, and of the ground around them
REACH = 64.0  # pixels from the point to the tip of its tangent
ARROW = np.array([[0.0, 0.0], [-11.0, 4.5], [-11.0, -4.5]])
ASIDE = 18.0  # pixels from a control point to the middle of its label
MOST_LABELS = 26  # control points of the highest degree
DISC = regular(18, 1.0)


def _no_lines() -> Floats:
    return np.zeros((0, 2, 3))


@dataclass(frozen=True, eq=False)
class ConstructionPicture:
    """What is shown, in the world. `levels` as of a `Construction`, the last the point; `first` is the number of the
    first control point."""

    levels: Sequence[Floats]  # of (n + 1 - k, 3)
    first: int = 0
    tangent: Floats = field(default_factory=lambda: np.zeros(3))  # (3,) of any length, zero for none
    strings: Floats = field(default_factory=_no_lines)  # (s, 2, 3)
    chords: Floats = field(default_factory=lambda: np.zeros((0, 3)))  # (c + 1, 3) corners of the stepped curve
    halves: Sequence[Floats] = ()  # of (n + 1, 3) control polygons on both sides of the point


class ConstructionMarks:
    """A `Mark`, drawn anew only where it, the camera, the picture's size or its scale is another."""

    def __init__(self) -> None:
        self._picture: ConstructionPicture | None = None
        self._look = LIGHT
        self._actor = ink_actor()
        self._labels = Labels(MOST_LABELS)
        self._labels.hide()
        self._drawn: tuple[object, ...] = ()

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._actor, *self._labels.props)

    def set_look(self, look: Look) -> None:
        self._look = look
        self._drawn = ()

    def show(self, picture: ConstructionPicture | None) -> None:
        """Nothing where none is given."""
        self._picture = picture
        self._drawn = ()
        if picture is None:
            self._labels.hide()

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        drawn = (camera, size, scale)
        if drawn == self._drawn:
            return
        self._drawn = drawn
        ink = Ink(camera, size)
        if self._picture is not None:
            labels = _Drawing(self._picture, self._look, ink, camera, size).draw()
            self._labels.show(labels, rgb(self._look.plain_background), size, scale)
        ink.fill(self._actor)


class _Drawing:
    """One construction, put to ink."""

    def __init__(
        self, picture: ConstructionPicture, look: Look, ink: Ink, camera: Camera, size: tuple[float, float]
    ) -> None:
        self._picture, self._ink, self._camera, self._size = picture, ink, camera, size
        self._light = look.name == "light"
        self._paper: Colour = rgb("#ffffff" if self._light else "#14171b")
        ink_colour = rgb(look.line)
        self._polygon = mixed(ink_colour, rgb(look.background_top), 0.3)
        self._string = rgb("#7f9fd8" if self._light else "#5f86cc")
        self._chord = mixed(rgb(look.axis_x), rgb("#000000" if self._light else "#ffffff"), 0.15)
        self._accent = rgb(look.selection)
        self._mark = mixed(ink_colour, self._accent, 0.15)

    def draw(self) -> list[LabelText]:
        """The labels of the control points."""
        picture, ink = self._picture, self._ink
        ink.lines(self._pixels(picture.strings.reshape(-1, 3)).reshape(-1, 2, 2), STRING, self._string, 0)
        if len(picture.chords) > 1:
            corners = self._pixels(picture.chords)
            ink.lines(_between(corners), CHORD, self._chord, 4)
            ink.shapes(corners, DISC, self._chord, 5, STEP)
        levels = [self._pixels(level) for level in picture.levels]
        for number, level in enumerate(levels[:-1]):
            tone = self._tone(number, len(levels) - 2)
            if number == 0:
                ink.dashes(_between(level), LEVEL, tone, 6)
                continue
            ink.lines(_between(level), LEVEL, tone, 7)
            ink.shapes(level, DISC, self._paper, 9, DOT + RIM)
            ink.shapes(level, DISC, tone, 10, DOT)
        for half, tone in zip(picture.halves, (self._accent, self._mark), strict=False):
            ink.lines(_between(self._pixels(half)), HALF, tone, 8)
        self._point(levels[-1][:1])
        return self._controls(levels[0])

    def _tone(self, number: int, last: int) -> Colour:
        if number == 0:
            return self._polygon
        first, end = (rgb(colour) for colour in (LIGHT_LEVELS if self._light else DARK_LEVELS))
        return mixed(first, end, (number - 1) / max(last - 1, 1))

    def _point(self, place: Floats) -> None:
        picture, ink = self._picture, self._ink
        size = float(np.linalg.norm(picture.tangent))
        if size > 0.0:
            step = 1e-3 * self._camera.half_height / size * picture.tangent
            along = (self._pixels(picture.levels[-1][:1] + step) - place)[0]
            length = float(np.hypot(*along))
            if length > 1e-6:  # else it points to the eye
                way = along / length
                tip, back = place[0] + REACH * way, place[0] + (REACH - 9.0) * way
                turn = np.array([way, [-way[1], way[0]]])
                ink.lines(np.array([[place[0], back]]), TANGENT + 2.0 * RIM, self._paper, 14)
                ink.lines(np.array([[place[0], back]]), TANGENT, self._accent, 15)
                ink.polygons((tip + ARROW @ turn)[None], self._accent, 15)
        ink.shapes(place, DISC, self._paper, 17, POINT + RIM)
        ink.shapes(place, DISC, self._accent, 18, POINT)

    def _controls(self, places: Floats) -> list[LabelText]:
        """Control points, and where their names stand: beside each, away from the middle of all."""
        middle = places.mean(axis=0)
        labels: list[LabelText] = []
        for number, place in enumerate(places, self._picture.first):
            tone = rgb(colour_of_point(number, self._light))
            self._ink.shapes(place[None], DISC, tone, 10, CONTROL)  # seen around its node, where there is one
            away = place - middle
            length = float(np.hypot(*away))
            if np.isfinite(length):
                way = away / length if length > 1.0 else np.array([0.0, -1.0])
                labels.append((place + ASIDE * way, f"P{number}", tone))
        return labels

    def _pixels(self, points: Floats) -> Floats:
        return project(self._camera, points, self._size)[:, :2]


def _between(points: Floats) -> Floats:
    """(n - 1, 2, 2) the sides of a polygon (n, 2) that is not closed."""
    return np.stack((points[:-1], points[1:]), axis=1)
