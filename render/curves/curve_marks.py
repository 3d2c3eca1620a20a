"""The outline that is being edited, over everything: its curve, nodes by kind, handles, control polygon."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkProp

from ..camera import Camera, project
from ..look import LIGHT, Colour, Look, mixed, rgb
from .ink import Ink, ink_actor, regular

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]
Flags = NDArray[np.bool_]

WHITE, BLACK = (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)
LINE, ARM, SIDE = 1.8, 1.3, 1.3  # widths in logical pixels: curve, arms of handles, control polygon
HALO = 0.9  # around the curve, so that it is seen on every ground
NODE, HANDLE, RIM = 3.7, 3.0, 1.3  # half of a node, radius of a handle, and how much darker rim is around them
CAUGHT, CHOSEN = 1.35, 1.15  # how much larger what is under the pointer is, and what is chosen
MANY = 3000
"""Nodes, or lines of the curve, in the picture of which more are drawn plainly, without rims."""
SMALL = 2.4  # half of such a node
KNOB = 4.0
ARROW = np.array([[7.0, 0.0], [-3.0, 4.5], [-3.0, -4.5]])
AHEAD = 16.0  # pixels from the first node to the arrow that tells the direction
TURNED = 9  # the number of the knob that turns
ROOM = 16.0  # pixels between the nodes and the box around them
STEM = 22.0  # from the box to the knob that turns


class Shape(IntEnum):
    """What a node is drawn as: the numbers of path.Node, and one for control points."""

    DIAMOND = 0  # a cusp
    SQUARE = 1  # smooth
    DISC = 2  # symmetric
    RING = 3  # automatic
    POINT = 4  # a control point


OUTLINES: dict[int, Floats] = {
    Shape.DIAMOND: regular(4, 1.42),
    Shape.SQUARE: regular(4, 1.42, 45.0),
    Shape.DISC: regular(14, 1.12),
    Shape.RING: regular(14, 1.2),
    Shape.POINT: regular(10, 1.0),
}


def _none() -> Floats:
    return np.zeros((0, 3))


@dataclass(frozen=True, eq=False)
class CurvePicture:
    """What is shown of an outline, in the world (n, 3)."""

    sides: Floats  # (m, 2, 3) the curve as short lines
    bright: Flags  # (m,) which of them belong to chosen segments
    nodes: Floats  # (k, 3)
    shapes: NDArray[np.uint8]  # (k,) of Shape
    chosen: Flags  # (k,)
    sizes: Floats  # (k,) 1 for an ordinary one
    ends: Numbers  # (e,) the nodes where open contours end
    handles: Floats = field(default_factory=_none)  # (h, 3)
    roots: Floats = field(default_factory=_none)  # (a, 3) arms lead from here
    tips: Floats = field(default_factory=_none)  # (a, 3) to there
    polygon: Floats = field(default_factory=lambda: np.zeros((0, 2, 3)))  # (s, 2, 3) sides of a control polygon
    starts: Floats = field(default_factory=lambda: np.zeros((0, 2, 3)))  # (c, 2, 3) first nodes, and places after them


@dataclass(frozen=True, eq=False)
class Box:
    """A box around chosen nodes: two corners (2, 2) in a plane that `frame` (3, 4) takes to the world."""

    corners: Floats
    frame: Floats

    def world(self, places: Floats) -> Floats:
        return places @ self.frame[:, :2].T + self.frame[:, 3]


def knobs_of(box: Box, camera: Camera, size: tuple[float, float]) -> tuple[Floats, Floats]:
    """Pixels (10, 2) of a box's knobs and the unit steps (10, 2) they stand for: eight around, row by row, -1 to 1
    each, the middle (4), and the one that turns (9).

    A box has some room around it, so that its knobs do not lie on nodes.
    """
    steps = np.array([(x, y) for y in (-1.0, 0.0, 1.0) for x in (-1.0, 0.0, 1.0)])
    middle, half = box.corners.mean(axis=0), 0.5 * (box.corners[1] - box.corners[0])
    scale = scales_at(box, middle, camera, size)
    wide = half + ROOM / scale
    places = middle + steps * wide
    top = middle + np.array([0.0, wide[1] + STEM / scale[1]])
    pixels = project(camera, box.world(np.vstack((places, top))), size)[:, :2]
    return pixels, np.vstack((steps, [[0.0, 0.0]]))


def scales_at(box: Box, place: Floats, camera: Camera, size: tuple[float, float]) -> Floats:
    """(2,) pixels that a millimetre along x and y of the box's plane has about a place (2,)."""
    step = 1e-3 * camera.half_height
    seen = project(camera, box.world(place + step * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])), size)[:, :2]
    found = np.linalg.norm(seen[1:] - seen[0], axis=1) / step
    return np.maximum(np.nan_to_num(found), 1e-9)


class CurveMarks:
    """A `Mark`. `show` takes what there is; `caught` and the others below what is under the pointer.

    It is drawn anew only where it, the camera or the picture's size is another.
    """

    def __init__(self) -> None:
        self._picture: CurvePicture | None = None
        self._look = LIGHT
        self._actor = ink_actor()
        self._drawn: tuple[object, ...] = ()
        self._caught: tuple[str, int] | None = None
        self._box: Box | None = None
        self._frame: tuple[tuple[float, float], tuple[float, float]] | None = None
        self._guides = np.zeros((0, 2, 3))
        self._changes = 0

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._actor,)

    def set_look(self, look: Look) -> None:
        self._look = look
        self._changes += 1

    def show(self, picture: CurvePicture | None, box: Box | None = None) -> None:
        self._picture, self._box = picture, box
        self._changes += 1

    def catch(self, caught: tuple[str, int] | None) -> bool:
        """Make a "node", a "handle" or a "knob" by its number larger; whether that changes the picture."""
        changed = caught != self._caught
        self._caught = caught
        self._changes += changed
        return changed

    def set_frame(self, corners: tuple[tuple[float, float], tuple[float, float]] | None) -> None:
        """The frame that is drawn around what is to be chosen, by two of its corners in pixels."""
        self._frame = corners
        self._changes += 1

    def set_guides(self, guides: Floats) -> None:
        """Thin lines (g, 2, 3) to what the pointer has snapped to."""
        self._guides = guides
        self._changes += 1

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        drawn = (camera, size, self._changes)
        if drawn == self._drawn:
            return
        self._drawn = drawn
        ink = Ink(camera, size)
        if self._picture is not None:
            _Drawing(self._picture, self._look, ink, camera, size, self._caught).draw()
        tones = _Tones(self._look)
        if len(self._guides):
            seen = project(camera, self._guides.reshape(-1, 3), size)[:, :2].reshape(-1, 2, 2)
            ink.dashes(seen, 1.0, tones.guide, 3)
        if self._box is not None:
            _draw_box(ink, self._box, tones, camera, size, self._caught)
        if self._frame is not None:
            (left, top), (right, bottom) = self._frame
            corners = np.array([[left, top], [right, top], [right, bottom], [left, bottom]])
            ink.dashes(np.stack((corners, np.roll(corners, -1, axis=0)), axis=1), 1.2, tones.line, 14)
        ink.fill(self._actor)


class _Tones:
    """Colours that a theme gives to the marks."""

    def __init__(self, look: Look) -> None:
        light = look.name == "light"
        blue = rgb(look.hover)
        self.line: Colour = mixed(blue, BLACK, 0.45) if light else mixed(blue, WHITE, 0.3)
        self.rim: Colour = mixed(blue, BLACK, 0.62) if light else mixed(blue, WHITE, 0.72)
        self.paper: Colour = WHITE if light else rgb("#14171b")
        self.accent: Colour = rgb(look.selection)
        self.arm: Colour = mixed(blue, BLACK, 0.3) if light else mixed(blue, WHITE, 0.1)
        self.side: Colour = mixed(rgb(look.line), rgb(look.background_top), 0.35)
        self.end: Colour = rgb(look.axis_x)
        self.guide: Colour = mixed(rgb(look.selection), rgb(look.axis_x), 0.5)


class _Drawing:
    """One outline, put to ink."""

    def __init__(
        self,
        picture: CurvePicture,
        look: Look,
        ink: Ink,
        camera: Camera,
        size: tuple[float, float],
        caught: tuple[str, int] | None,
    ) -> None:
        self._picture, self._ink, self._camera, self._size, self._caught = picture, ink, camera, size, caught
        self._tones = _Tones(look)

    def draw(self) -> None:
        picture, ink, tones = self._picture, self._ink, self._tones
        if len(picture.sides):
            colours = np.where(picture.bright[:, None], tones.accent, tones.line)
            sides = self._pairs(picture.sides)
            if len(sides) <= 4 * MANY:
                ink.lines(sides, LINE + 2.0 * HALO, tones.paper, 1)
            ink.lines(sides, LINE, colours, 3)
        ink.dashes(self._pairs(picture.polygon), SIDE, tones.side, 2)
        self._directions()
        arms = np.stack((self._pixels(picture.roots), self._pixels(picture.tips)), axis=1)
        ink.lines(arms, ARM, tones.arm, 5)
        self._handles()
        self._nodes()

    def _pixels(self, points: Floats) -> Floats:
        return project(self._camera, points, self._size)[:, :2]

    def _pairs(self, ends: Floats) -> Floats:
        return self._pixels(ends.reshape(-1, 3)).reshape(-1, 2, 2)

    def _factor(self, kind: str, count: int) -> Floats:
        factors = np.ones(count)
        if self._caught is not None and self._caught[0] == kind and self._caught[1] < count:
            factors[self._caught[1]] = CAUGHT
        return factors

    def _directions(self) -> None:
        """An arrow a little after the first node of each contour, so that it does not lie on the node."""
        ends = self._pairs(self._picture.starts)
        ends = ends[np.isfinite(ends).all(axis=(1, 2))]
        along = ends[:, 1] - ends[:, 0]
        length = np.linalg.norm(along, axis=1)
        ends, along = ends[length > 1e-3], along[length > 1e-3] / length[length > 1e-3][:, None]
        turn = np.stack((along, np.column_stack((-along[:, 1], along[:, 0]))), axis=1)  # rows: along, across
        self._ink.polygons(ends[:, :1] + AHEAD * along[:, None] + ARROW @ turn, self._tones.line, 4)

    def _handles(self) -> None:
        places, tones = self._pixels(self._picture.handles), self._tones
        factors = self._factor("handle", len(places))
        disc = regular(12, 1.0)
        self._ink.shapes(places, disc, tones.rim, 6, factors * (HANDLE + RIM))
        self._ink.shapes(places, disc, tones.paper, 7, factors * HANDLE)
        self._ink.shapes(places, disc, tones.line, 8, factors * (HANDLE - 1.2))

    def _nodes(self) -> None:
        picture, ink, tones = self._picture, self._ink, self._tones
        places = self._pixels(picture.nodes)
        shapes = picture.shapes
        if np.count_nonzero(ink.seen(places)) > MANY:
            tone = np.where(picture.chosen[:, None], tones.accent, tones.rim)
            ink.shapes(places, OUTLINES[Shape.SQUARE], tone, 11, SMALL * self._factor("node", len(places)))
            return
        factors = self._factor("node", len(places)) * picture.sizes * np.where(picture.chosen, CHOSEN, 1.0)
        ink.shapes(places[picture.ends], regular(16, 1.0), tones.end, 9, NODE + RIM + 3.0)
        ink.shapes(places[picture.ends], regular(16, 1.0), tones.paper, 10, NODE + RIM + 1.6)
        for shape, outline in OUTLINES.items():
            rows = shapes == shape
            if not rows.any():
                continue
            here, factor, on = places[rows], factors[rows], picture.chosen[rows]
            fill = np.where(on[:, None], tones.accent, tones.paper)
            ink.shapes(here, outline, tones.rim, 11, factor * (NODE + RIM))
            ink.shapes(here, outline, fill, 12, factor * NODE)
            if shape == Shape.RING:
                ink.shapes(here, outline, tones.rim, 13, factor * 1.4)


def _draw_box(
    ink: Ink, box: Box, tones: _Tones, camera: Camera, size: tuple[float, float], caught: tuple[str, int] | None
) -> None:
    places, _ = knobs_of(box, camera, size)
    ring = places[[0, 2, 8, 6]]
    ink.dashes(np.stack((ring, np.roll(ring, -1, axis=0)), axis=1), 1.2, tones.side, 3)
    ink.lines(places[None, [7, TURNED]], 1.2, tones.side, 3)
    for number in range(len(places)):
        if number == 4:
            continue
        factor = CAUGHT if caught == ("knob", number) else 1.0
        outline = regular(14, 1.1) if number == TURNED else regular(4, 1.42, 45.0)
        ink.shapes(places[number : number + 1], outline, tones.rim, 12, factor * (KNOB + RIM))
        ink.shapes(places[number : number + 1], outline, tones.paper, 13, factor * KNOB)
