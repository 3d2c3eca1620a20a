"""Combs of curvature over the picture, and marks at joints that are less smooth than they should be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkProp

from ..camera import Camera, project
from ..look import LIGHT, Look, mixed, rgb
from .ink import Ink, ink_actor, regular

Floats = NDArray[np.float64]

TEETH, ENVELOPE = 1.0, 1.6  # widths in logical pixels
BADGE, BADGE_RIM = 5.5, 1.6
BADGE_AT = np.array([11.0, -11.0])  # pixels from the joint, so that its node is seen
WHITE, BLACK = (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)
BADGES = {-1: regular(3, 1.35, -90.0), 0: regular(3, 1.35, -90.0), 1: regular(4, 1.2)}
"""By grade: a triangle where the tangent jumps or the ends are apart, a diamond where the curvature jumps."""


@dataclass(frozen=True, eq=False)
class CombPicture:
    """What is shown, in the world."""

    teeth: Floats  # (n, 2, 3) from the curve to the tips
    envelope: Floats  # (m, 2, 3) the line along the tips
    joints: Floats  # (j, 3)
    grades: NDArray[np.int8]  # (j,) of continuity, -1 to 1
    sharpest: Floats  # (k, 3), none or one: where the curve bends most


class CombMarks:
    """A `Mark`, drawn anew only where it, the camera or the picture's size is another."""

    def __init__(self) -> None:
        self._picture: CombPicture | None = None
        self._look = LIGHT
        self._actor = ink_actor()
        self._drawn: tuple[object, ...] = ()

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._actor,)

    def set_look(self, look: Look) -> None:
        self._look = look
        self._drawn = ()

    def show(self, picture: CombPicture | None) -> None:
        self._picture = picture
        self._drawn = ()

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        drawn = (camera, size)
        if drawn == self._drawn:
            return
        self._drawn = drawn
        ink, picture, look = Ink(camera, size), self._picture, self._look
        if picture is not None:
            light = look.name == "light"
            tone = mixed(rgb(look.axis_z), BLACK, 0.15) if light else mixed(rgb(look.axis_z), WHITE, 0.35)
            paper = rgb(look.background_bottom)
            ink.lines(_pixels(picture.teeth, camera, size), TEETH, mixed(tone, paper, 0.45), 0)
            ink.lines(_pixels(picture.envelope, camera, size), ENVELOPE, tone, 1)
            places = project(camera, picture.sharpest, size)[:, :2]
            ink.shapes(places, regular(16, 1.0), tone, 1, BADGE)
            ink.shapes(places, regular(16, 1.0), paper, 2, BADGE - BADGE_RIM)
            self._badges(ink, picture, camera, size)
        ink.fill(self._actor)

    def _badges(self, ink: Ink, picture: CombPicture, camera: Camera, size: tuple[float, float]) -> None:
        places = project(camera, picture.joints, size)[:, :2] + BADGE_AT
        paper = WHITE if self._look.name == "light" else rgb("#14171b")
        for grade, outline in BADGES.items():
            here = places[picture.grades == grade]
            tone = rgb(self._look.axis_x) if grade < 1 else rgb(self._look.selection)
            ink.shapes(here, outline, paper, 15, BADGE + BADGE_RIM)
            ink.shapes(here, outline, tone, 16, BADGE)


def _pixels(ends: Floats, camera: Camera, size: tuple[float, float]) -> Floats:
    """(n, 2, 2) of lines (n, 2, 3) in the world."""
    return project(camera, ends.reshape(-1, 3), size)[:, :2].reshape(-1, 2, 2)
