"""What the handles that move, turn and scale do in a drag: from the pointer to numbers, from these to one operation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...model.document.errors import Refusal
from ...model.document.expression import Number, symbolic
from ...model.document.placement import turn_about
from ...model.operations.steps import combined, tidy
from .entry import number_text

if TYPE_CHECKING:
    from ...render.viewer import Viewer

Floats = NDArray[np.float64]
Call = tuple[str, tuple[Any, ...], dict[str, Any]]

UNIFORM = 100.0  # pixels that double the size, by the box in the middle
SMALLEST = 0.01  # a factor that the pointer can reach


@dataclass(frozen=True, slots=True)
class Pointer:
    """Where the pointer is, in logical pixels; `free` without steps, `fine` with smaller ones.

    `target` (3,) is what it has snapped to, in the world.
    """

    x: float
    y: float
    free: bool = False
    fine: bool = False
    target: Floats | None = None


@dataclass(frozen=True, slots=True)
class Frame:
    """What the gizmo stands on: nodes, its `origin` (3,) and unit `axes` (rows, (3, 3)) in the world.

    `plain` says that the parent's axes are the world's, `local` that the axes are the node's own, `alone` that it is
    one node, about whose own origin is turned and scaled. In a `mirrored` parent, turns go the other way round as seen
    in the world.
    """

    ids: tuple[str, ...]
    origin: Floats
    axes: Floats
    plain: bool
    local: bool
    alone: bool
    mirrored: bool = False

    @property
    def world(self) -> dict[str, Any]:
        return {} if self.plain else {"world": True}


class Drag:
    """One drag. `numbers` are what it has come to; None where nothing has been given yet."""

    names: tuple[str, ...] = ()
    label = ""
    first = 0
    """The number that is typed first."""

    def __init__(self, viewer: Viewer) -> None:
        self.viewer = viewer
        self.numbers: list[Number] = []
        self.resolve: Callable[[Number], float] = float
        """What an expression is now."""

    def begin(self, x: float, y: float) -> None:
        """The pointer catches the handle."""

    def follow(self, pointer: Pointer) -> None:
        """The pointer is elsewhere now."""

    def take(self, typed: Sequence[Number | None]) -> None:
        """Numbers were typed; None where the text is empty."""
        for i, value in enumerate(typed):
            if value is not None:
                self.numbers[i] = value

    def pose(self) -> Floats | None:
        """The rigid motion (4, 4) of what is dragged, in the world; None where its shape changes."""
        return None

    def call(self) -> Call | None:
        """The operation's name and arguments; None where nothing would change. Raises Refusal."""
        raise AssertionError(type(self).__name__)

    def shown(self) -> list[str]:
        """Each number as text."""
        return [number_text(value) for value in self.numbers]

    def words(self) -> str:
        """What stands beside the pointer."""
        return ", ".join(self.shown())

    def _ray(self, x: float, y: float) -> tuple[Floats, Floats]:
        from ...render.camera import ray

        return ray(self.viewer.camera, x, y, self.viewer.size)

    def _along(self, x: float, y: float, point: Floats, axis: Floats) -> float | None:
        from ...render.handles.drag import along_axis

        return along_axis(*self._ray(x, y), point, axis)

    def _step(self, pointer: Pointer, point: Floats, per_unit: float = 1.0) -> float:
        """The step of numbers of which one is `per_unit` millimetres; 0 for none."""
        from ...render.handles.drag import pixel_length, step_for

        if pointer.free:
            return 0.0
        step = step_for(pixel_length(self.viewer.camera, point, self.viewer.size) / per_unit)
        return step / 10 if pointer.fine else step


def steps_of(value: float, step: float) -> float:
    """A multiple of the step; rounded to what a pixel can tell where there is none."""
    from ...render.handles.drag import stepped

    return stepped(value, step) if step else round(value, 4) + 0.0


class MoveDrag(Drag):
    """Along some of the frame's axes (by number), or in the plane of the picture where all are given."""

    names = ("x", "y", "z")
    label = "Move"

    def __init__(self, viewer: Viewer, frame: Frame, axes: Sequence[int]) -> None:
        super().__init__(viewer)
        self._frame, self._axes = frame, tuple(axes)
        self.numbers = [0.0, 0.0, 0.0]
        self.first = self._axes[0]
        self._start: Any = None
        self._exact = False
        """Whether the numbers are those of a place that is held, which rounding would leave."""

    @property
    def span(self) -> Floats:
        """(k, 3) unit vectors, at right angles, along which things are moved."""
        return self._frame.axes[list(self._axes)]

    def way(self) -> Floats:
        """(3,) how far things are moved, in the world."""
        return np.array([self.resolve(value) for value in self.numbers]) @ self._frame.axes

    def hold(self, way: Floats) -> None:
        """Go so far (3,) instead."""
        self.numbers = [tidy(value) for value in self._frame.axes @ way]
        self._exact = True

    def pose(self) -> Floats:
        return np.block([[np.eye(3), self.way()[:, None]], [np.zeros(3), 1.0]])

    def begin(self, x: float, y: float) -> None:
        self._start = self._place(x, y)

    def _place(self, x: float, y: float) -> Floats | None:
        from ...render.camera import frame
        from ...render.handles.drag import on_plane

        origin, rows = self._frame.origin, self._frame.axes
        if len(self._axes) == 1:
            distance = self._along(x, y, origin, rows[self._axes[0]])
            return None if distance is None else origin + distance * rows[self._axes[0]]
        if len(self._axes) == 2:
            normal = np.cross(rows[self._axes[0]], rows[self._axes[1]])
        else:
            normal = frame(self.viewer.camera)[2]
        return on_plane(*self._ray(x, y), origin, normal)

    def follow(self, pointer: Pointer) -> None:
        origin, rows = self._frame.origin, self._frame.axes
        self._exact = False
        if pointer.target is not None:
            by, step = rows @ (pointer.target - origin), None
        else:
            place = self._place(pointer.x, pointer.y)
            if place is None or self._start is None:
                return
            by, step = rows @ (place - self._start), self._step(pointer, origin)
        for i in self._axes:
            self.numbers[i] = tidy(round(float(by[i]), 9)) if step is None else steps_of(float(by[i]), step)

    def take(self, typed: Sequence[Number | None]) -> None:
        """What is not typed stays where it was before the drag."""
        self._exact = False
        self.numbers = [0.0 if value is None else value for value in typed]

    def call(self) -> Call | None:
        if not any(self.numbers):
            return None
        rows = self._frame.axes
        by = tuple(self.numbers) if np.array_equal(rows, np.eye(3)) else combined(rows.T, self.numbers)
        if not symbolic(by) and not self._exact:
            by = tuple(round(float(c), 9) + 0.0 for c in by)  # type: ignore[arg-type]
        return "move", (list(self._frame.ids), *by), self._frame.world

    def words(self) -> str:
        if len(self._axes) == 1 and not any(n for i, n in enumerate(self.numbers) if i not in self._axes):
            return f"{number_text(self.numbers[self._axes[0]])} mm"
        return "Δ " + ", ".join(self.shown())


class TurnDrag(Drag):
    """About one of the frame's axes; by keys Tab goes to another axis."""

    names = ("x", "y", "z")
    label = "Turn"

    def __init__(self, viewer: Viewer, frame: Frame, axis: int) -> None:
        super().__init__(viewer)
        self._frame, self.axis = frame, axis
        self.numbers = [0.0, 0.0, 0.0]
        self.first = axis
        self.origin = frame.origin
        self._grabbed: Floats | None = None
        self._last = 0.0

    def angle(self) -> float:
        """Degrees."""
        return self.resolve(self.numbers[self.axis])

    def hold(self, angle: float, before: float) -> None:
        """Turn by so many degrees instead, rounded towards those of before."""
        rounded = np.floor if angle > before else np.ceil
        self.numbers[self.axis] = float(rounded(angle * 1e6) / 1e6) + 0.0

    def turned(self, angle: float) -> Floats:
        """The pose at an angle."""
        return np.vstack((turn_about(tuple(self._frame.axes[self.axis]), angle, tuple(self.origin)), [0, 0, 0, 1]))

    def pose(self) -> Floats | None:
        frame = self._frame
        own = frame.local and (not frame.alone or np.linalg.det(frame.axes) < 0.0)
        return None if own or frame.mirrored else self.turned(self.angle())

    def begin(self, x: float, y: float) -> None:
        from ...render.handles.drag import grabbed_on_ring

        origin, axis = self._frame.origin, self._frame.axes[self.axis]
        self._grabbed = grabbed_on_ring(self.viewer.camera, *self._ray(x, y), origin, axis)

    def follow(self, pointer: Pointer) -> None:
        from ...render.handles.drag import ring_angle, stepped_angle, unwrapped

        if self._grabbed is None:
            return
        origin, axis = self._frame.origin, self._frame.axes[self.axis]
        pixel = (pointer.x, pointer.y)
        angle = ring_angle(self.viewer.camera, self.viewer.size, pixel, origin, axis, self._grabbed)
        if angle is None:
            return
        self._last = unwrapped(angle, self._last)
        new = round(self._last, 3) if pointer.free else stepped_angle(self._last, pointer.fine)
        backwards = self._frame.local and self._frame.mirrored
        self.numbers[self.axis] = (-new if backwards else new) + 0.0

    def take(self, typed: Sequence[Number | None]) -> None:
        self.numbers = [0.0 if value is None else value for value in typed]
        given = [i for i, value in enumerate(self.numbers) if value != 0.0]
        if len(given) > 1:
            raise Refusal("one turn goes about one axis; finish this one first")
        if given:
            self.axis = given[0]

    def call(self) -> Call | None:
        angle = self.numbers[self.axis]
        if angle == 0.0:
            return None
        frame = self._frame
        more: dict[str, Any] = {}
        if not frame.alone and not frame.local:
            more["point"] = tuple(tidy(round(float(c), 9)) for c in frame.origin)
        more |= {"local": True} if frame.local else frame.world
        return "turn", (list(frame.ids), "xyz"[self.axis], angle), more

    def words(self) -> str:
        return f"{number_text(self.numbers[self.axis])}{'' if symbolic(self.numbers[self.axis]) else '°'}"


class ScaleDrag(Drag):
    """Along one axis of the frame, or with None along all of them alike."""

    names = ("x", "y", "z")
    label = "Scale"

    def __init__(self, viewer: Viewer, frame: Frame, axis: int | None) -> None:
        super().__init__(viewer)
        self._frame, self._axis = frame, axis
        self.numbers = [1.0, 1.0, 1.0]
        self.first = axis or 0
        self._start: float | None = None
        self._pressed = (0.0, 0.0)

    def begin(self, x: float, y: float) -> None:
        self._pressed = (x, y)
        if self._axis is not None:
            self._start = self._along(x, y, self._frame.origin, self._frame.axes[self._axis])

    def follow(self, pointer: Pointer) -> None:
        from ...render.handles.drag import pixel_length

        if self._axis is None:
            moved = pointer.x - self._pressed[0] - (pointer.y - self._pressed[1])
            factor = 1.0 + moved / UNIFORM
        else:
            now = self._along(pointer.x, pointer.y, self._frame.origin, self._frame.axes[self._axis])
            least = pixel_length(self.viewer.camera, self._frame.origin, self.viewer.size)
            if now is None or self._start is None or abs(self._start) < least:
                return
            factor = now / self._start
        step = 0.0 if pointer.free else 0.01 if pointer.fine else 0.1
        factor = max(steps_of(factor, step), step or SMALLEST)
        self.numbers = [factor if self._axis in (None, i) else 1.0 for i in range(3)]

    def take(self, typed: Sequence[Number | None]) -> None:
        """One factor alone is for all axes, unless the handle has an axis of its own."""
        given = [value for value in typed if value is not None]
        alike = self._axis is None and len(given) == 1 and typed[0] is not None
        self.numbers = [given[0]] * 3 if alike else [1.0 if value is None else value for value in typed]

    def call(self) -> Call | None:
        frame, numbers = self._frame, tuple(self.numbers)
        if numbers == (1.0, 1.0, 1.0):
            return None
        more: dict[str, Any] = {}
        if not frame.alone and not frame.local:
            more["point"] = tuple(tidy(round(float(c), 9)) for c in frame.origin)
        more |= {"local": True} if frame.local else frame.world
        factors = numbers[:1] if numbers[0] == numbers[1] == numbers[2] else numbers
        return "scale", (list(frame.ids), *factors), more

    def words(self) -> str:
        given = self.numbers if self._axis is None and len(set(self.numbers)) > 1 else [self.numbers[self._axis or 0]]
        return "× " + ", ".join(map(number_text, given))
