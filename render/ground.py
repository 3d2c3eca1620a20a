"""The ground: a grid on z = 0 around what is looked at, and the axes."""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from .camera import Camera, frame
from .look import LIGHT, Look, rgb
from .polydata import lines_of, set_point_colours
from .shading import unlit

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

PIECES = 24  # a line fades out in so many pieces
LINES = 30  # minor lines on each side of the centre


def step_for(height: float) -> float:
    """The grid's step, 1, 2 or 5 times a power of ten, for a picture `height` millimetres high."""
    wanted = height / 40.0
    power = 10.0 ** math.floor(math.log10(max(wanted, 1e-9)))
    return power * next(factor for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= wanted * (1.0 - 1e-9))


def major_every(step: float) -> int:
    """How many steps lie between major lines, which are multiples of 10, 10 and 50 for steps of 1, 2 and 5."""
    leading = round(step / 10.0 ** math.floor(math.log10(step) + 1e-9))
    return 5 if leading == 2 else 10


class Ground:
    """Grid and axes of one renderer. They count neither for the bounds nor for picking."""

    def __init__(self, renderer: "vtkRenderer", look: Look = LIGHT) -> None:
        self._look = look
        self._drawn: object = None
        self._reach = 0.0
        self._centre = (0.0, 0.0)
        self._mapper = vtkPolyDataMapper()
        self._mapper.SetColorModeToDirectScalars()
        self.actor = vtkActor()
        self.actor.SetMapper(self._mapper)
        self.actor.UseBoundsOff()
        self.actor.PickableOff()
        unlit(self.actor)
        renderer.AddActor(self.actor)

    @property
    def visible(self) -> bool:
        return bool(self.actor.GetVisibility())

    def set_visible(self, visible: bool) -> None:
        self.actor.SetVisibility(visible)

    @property
    def height(self) -> float | None:
        """At which z the lines are drawn at the moment, None when hidden."""
        return float(self.actor.GetPosition()[2]) if self.visible else None

    def set_look(self, look: Look) -> None:
        self._look = look
        self._drawn = None

    def set_line_scale(self, scale: float) -> None:
        self.actor.GetProperty().SetLineWidth(scale)

    @property
    def bounds(self) -> NDArray[np.float64] | None:
        """The box (2, 3) of what is drawn, for the clipping planes; None when hidden."""
        if not self.visible or not self._reach:
            return None
        x, y = self._centre
        far = self._reach
        return np.array([[x - far, y - far, 0.0], [x + far, y + far, min(far, self._height)]])

    def update(self, camera: Camera) -> None:
        """Draw the grid that suits the camera; does nothing where that is the one drawn."""
        if not self.visible:
            return
        height = 2.0 * camera.half_height
        step = step_for(height)
        every = major_every(step)
        centre = tuple(step * every * round(value / (step * every)) for value in _looked_at(camera, step * LINES))
        wanted = (step, centre, self._look)
        if wanted != self._drawn:
            self._drawn = wanted
            self._centre = (centre[0], centre[1])
            self._reach = step * LINES
            self._height = step * every
            self._draw(step, every)
        # Seen along the ground its lines would add up to a bar.
        slope = abs(float(frame(camera)[2, 2]))
        self.actor.GetProperty().SetOpacity(min(4.0 * slope, 1.0))
        # Lines keep clear of faces that stand on the ground, on the side away from the eye.
        self.actor.SetPosition(0.0, 0.0, math.copysign(2e-4 * height, -frame(camera)[2, 2]))

    def _draw(self, step: float, every: int) -> None:
        look, (cx, cy) = self._look, self._centre
        first = np.round(np.array([cx, cy]) / step).astype(int) - LINES
        numbers = first[:, None] + np.arange(2 * LINES + 1)  # (2, lines), multiples of the step along x and y
        along = np.linspace(-self._reach, self._reach, PIECES + 1)
        starts, colours, alphas = [], [], []
        for axis, zero in ((0, look.axis_y), (1, look.axis_x)):  # lines at x = const run along y and the other way
            number = np.repeat(numbers[axis], PIECES + 1)
            line = np.zeros((len(number), 3), np.float32)
            line[:, axis] = number * step
            line[:, 1 - axis] = np.tile(along, 2 * LINES + 1) + (cx, cy)[1 - axis]
            colour = np.empty((len(number), 3))
            colour[:] = rgb(look.grid_minor)
            colour[number % every == 0] = rgb(look.grid_major)
            colour[number == 0] = rgb(zero)
            starts.append(line)
            colours.append(colour)
            alphas.append(look.grid_alpha * np.where(number % every == 0, np.where(number == 0, 3.0, 2.0), 1.0))
        rise = np.zeros((PIECES + 1, 3), np.float32)
        rise[:, 2] = np.linspace(0.0, self._height, PIECES + 1)
        upward = np.tile(rgb(look.axis_z), (PIECES + 1, 1))
        points, colour = np.concatenate([*starts, rise]), np.concatenate([*colours, upward])
        strength = np.minimum(np.concatenate([*alphas, np.full(len(rise), 3.0 * look.grid_alpha)]), 1.0)
        distance = np.hypot(points[:, 0] - cx, points[:, 1] - cy) / self._reach
        distance[len(points) - len(rise) :] = np.linspace(0.0, 1.0, len(rise))
        alpha = np.clip(1.15 - 1.15 * distance, 0.0, 1.0) * strength
        colour = np.column_stack([colour, alpha])
        index = np.arange(len(points), dtype=np.int32).reshape(-1, PIECES + 1)
        cells = np.stack([index[:, :-1], index[:, 1:]], axis=2).reshape(-1, 2)
        within = (distance[cells] < 1.0).any(axis=1)
        lines = lines_of(points, cells[within])
        set_point_colours(lines, np.round(255.0 * colour).astype(np.uint8))
        self._mapper.SetInputData(lines)


def _looked_at(camera: Camera, reach: float) -> tuple[float, float]:
    """The point of the ground in the middle of the picture, or the one below the target where that is far off."""
    target, backward = np.asarray(camera.target), frame(camera)[2]
    if abs(backward[2]) > 1e-6:
        hit = target - backward * (target[2] / backward[2])
        if np.linalg.norm(hit - target) < 0.5 * reach:
            return float(hit[0]), float(hit[1])
    return float(target[0]), float(target[1])
