"""What the edit tool shows of an outline in the picture, what lies under the pointer, and where the pointer reaches."""

from __future__ import annotations

from dataclasses import dataclass
from math import log2
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from ....render.camera import frame as axes_of
from ....render.camera import project, vector_of
from ....render.curves.curve_marks import TURNED, Box, CurveMarks, knobs_of
from ....render.handles.label import Label
from ....render.handles.snap import Snap as Landmark
from ....render.handles.snap_mark import SnapMark
from ..active import Place
from ..drawing.draft_picture import SIGNS
from ..drawing.snapping import Snap, Snapper
from .edit_drags import Plane, Wish
from .edited import Edited, Sides

if TYPE_CHECKING:
    from ....model.editing.session import Session
    from ....render.viewer import Viewer
    from ...view.viewport import Viewport
    from ..active import ActiveCurve

Floats = NDArray[np.float64]
HitKind = Literal["knob", "node", "handle", "curve"]

REACH = 7.0
"""Logical pixels between the pointer and what it catches."""
SMOOTH = 0.1
"""Pixels that the chords may be off the curve."""
FLAT_VIEW = 0.15
"""Sine of the angle between the eye and a plane of which a space curve's nodes are not moved in it."""


@dataclass(frozen=True, slots=True)
class Hit:
    """What is under the pointer: `index` among the knobs, nodes, handles or segments; on a curve its parameter."""

    kind: HitKind
    index: int
    parameter: float = 0.0


class EditPicture:
    """The overlay's side of the edit tool, for as long as there is a viewer."""

    def __init__(self, viewport: Viewport, viewer: Viewer, session: Session, active: ActiveCurve) -> None:
        self.viewer, self._active = viewer, active
        self._marks, self._snap_mark, self._label = CurveMarks(), SnapMark(), Label()
        self._snapper = Snapper(viewport, session)
        self.edited: Edited | None = None
        self._sides: Sides | None = None
        self._fineness = 0
        self._seen: tuple[object, ...] = ()
        self._pixels: tuple[Floats, Floats, Floats] | None = None
        self._box_wanted = False
        for mark in (self._marks, self._snap_mark, self._label):
            viewer.overlay.add(mark)

    # What is shown.

    def show(self, shown: bool, box: bool) -> None:
        """Show the active curve as it is now, or nothing; with a box around chosen nodes where one is wanted."""
        active = self._active
        self._box_wanted = box
        if not shown or active.path is None or active.resolved is None:
            if self.edited is not None:
                self.edited = self._sides = None
                self._marks.show(None)
                self._marks.catch(None)
                self.viewer.needs_render = True
            return
        old = self.edited
        if old is None or old.path is not active.path or old.frame is not active.frame:
            self.edited = Edited(active.resolved, active.path, active.frame, active.places, active.rows)
            self._sides = None
        self._draw()

    def zoomed(self) -> None:
        """The camera is another: chords as fine as it asks for."""
        if self.edited is not None and self._wanted_fineness() != self._fineness:
            self._sides = None
            self._draw()

    def _draw(self) -> None:
        assert self.edited is not None
        chosen = self.edited.flags(self._active.chosen)
        self._marks.show(self.edited.picture(chosen, self.sides), self.box())
        self._seen = ()
        self.viewer.needs_render = True

    def _wanted_fineness(self) -> int:
        """The power of two, in millimetres of the outline's own axes, that chords may be off."""
        assert self.edited is not None
        stretch = max(float(np.linalg.norm(self.edited.frame[:, 0])), 1e-9)
        camera = self.viewer.camera
        near = camera.half_height
        if not camera.parallel and len(self.edited.nodes):
            # What is nearer to the eye is larger.
            depth = project(camera, self.edited.nodes, self.viewer.size)[:, 2]
            ahead = depth[depth > 1e-3 * camera.distance]
            near *= float(ahead.min()) / camera.distance if len(ahead) else 1.0
        return int(np.floor(log2(max(SMOOTH * 2.0 * near / self.viewer.size[1] / stretch, 1e-12))))

    @property
    def sides(self) -> Sides:
        """The curve as chords, fine enough for what is seen."""
        assert self.edited is not None
        if self._sides is None:
            self._fineness = self._wanted_fineness()
            self._sides = self.edited.sides(2.0**self._fineness)
        return self._sides

    def box(self) -> Box | None:
        """Around the chosen nodes, where there are two or more in a plane."""
        edited = self.edited
        if not self._box_wanted or edited is None or edited.dimension != 2 or len(self._active.chosen) < 2:
            return None
        places = edited.places[edited.flags(self._active.chosen)]
        return Box(np.array([places.min(axis=0), places.max(axis=0)]), edited.frame)

    def catch(self, hit: Hit | None) -> bool:
        """Brighten what is under the pointer; whether that changes the picture."""
        caught = None
        if hit is not None and hit.kind != "curve":
            index = hit.index
            if hit.kind == "handle" and self.edited is not None:
                shown, _, _ = self.edited.shown_handles(self.edited.flags(self._active.chosen))
                index = int(np.searchsorted(shown, hit.index))
            caught = hit.kind, index
        changed = self._marks.catch(caught)
        self.viewer.needs_render = self.viewer.needs_render or changed
        return changed

    def set_frame(self, corners: tuple[tuple[float, float], tuple[float, float]] | None) -> None:
        """The frame of a choice, by two corners in pixels."""
        self._marks.set_frame(corners)
        self.viewer.needs_render = True

    def say(self, words: str, pixel: tuple[float, float], fault: str = "") -> None:
        self._label.show(f"{words}\n {fault}" if fault else words, *pixel, fault=bool(fault))
        self.viewer.needs_render = True

    def end(self) -> None:
        """Nothing is dragged any more."""
        self._label.show("")
        self._snap_mark.show(None)
        self._marks.set_guides(np.zeros((0, 2, 3)))
        self._marks.set_frame(None)
        self.viewer.needs_render = True

    # What is under the pointer.

    def _project(self) -> tuple[Floats, Floats, Floats]:
        """Pixels of nodes (k, 2), handles (h, 2) and the ends of the sides (m, 2, 2)."""
        edited = self.edited
        assert edited is not None
        camera, size = self.viewer.camera, self.viewer.size
        key = (camera, size, id(edited), id(self.sides))
        if key != self._seen or self._pixels is None:
            self._seen = key
            nodes = project(camera, edited.nodes, size)[:, :2]
            handles = project(camera, edited.world(edited.handles), size)[:, :2]
            ends = project(camera, self.sides.world.reshape(-1, 3), size)[:, :2].reshape(-1, 2, 2)
            self._pixels = nodes, handles, ends
        return self._pixels

    def hit(self, x: float, y: float) -> Hit | None:
        """Knobs before nodes, these before handles, those of chosen nodes first, and handles before the curve."""
        edited = self.edited
        if edited is None or not len(edited.places) or self.viewer.cube_hit(x, y):
            return None
        pixel = np.array([x, y])
        box = self.box()
        if box is not None:
            knobs, _ = knobs_of(box, self.viewer.camera, self.viewer.size)
            knobs[4] = np.inf
            number = _nearest(knobs, pixel)
            if number is not None:
                return Hit("knob", number)
        nodes, handles, ends = self._project()
        number = _nearest(nodes, pixel)
        if number is not None:
            return Hit("node", number)
        shown, _, own = edited.shown_handles(edited.flags(self._active.chosen))
        for group in (shown[own], shown[~own]):
            number = _nearest(handles[group], pixel)
            if number is not None:
                return Hit("handle", int(group[number]))
        return self._on_curve(ends, pixel)

    def _on_curve(self, ends: Floats, pixel: Floats) -> Hit | None:
        if not len(ends):
            return None
        start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
        with np.errstate(invalid="ignore", divide="ignore"):
            square = np.maximum((along * along).sum(axis=1), 1e-12)
            share = np.clip(((pixel - start) * along).sum(axis=1) / square, 0.0, 1.0)
            away = np.hypot(*(start + share[:, None] * along - pixel).T)
        away[~np.isfinite(away)] = np.inf
        row = int(np.argmin(away))
        if away[row] > REACH:
            return None
        begin, end = self.sides.parameter[row]
        return Hit("curve", int(self.sides.segment[row]), float(begin + share[row] * (end - begin)))

    def place_on(self, hit: Hit) -> Floats:
        """(d,) the place on the curve that was hit, in the outline's own axes."""
        sides = self.sides
        begin, end = sides.parameter.T
        on = (sides.segment == hit.index) & (begin <= hit.parameter) & (hit.parameter <= end)
        row = int(np.argmax(on))
        share = (hit.parameter - begin[row]) / max(end[row] - begin[row], 1e-300)
        return sides.own[row, 0] + share * (sides.own[row, 1] - sides.own[row, 0])

    def within(self, first: tuple[float, float], second: tuple[float, float]) -> list[Place]:
        """The nodes in a frame between two pixels."""
        if self.edited is None:
            return []
        nodes, _, _ = self._project()
        low, high = np.minimum(first, second), np.maximum(first, second)
        with np.errstate(invalid="ignore"):
            inside = ((nodes >= low) & (nodes <= high)).all(axis=1)
        return [self.edited.rows[number] for number in np.flatnonzero(inside).tolist()]

    # Where the pointer reaches.

    def plane_at(self, place: Floats) -> Plane:
        """The plane in which what is at a place (d,) is dragged: the outline's own; of a curve in space the one of its
        axes' planes through the place that the eye looks at most squarely."""
        assert self.edited is not None
        frame = self.edited.frame
        if len(place) == 2:
            return Plane(place, (0, 1), frame)
        normals = np.cross(frame[:, [1, 2, 0]].T, frame[:, [2, 0, 1]].T)  # of the planes yz, zx, xy
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        squarely = np.abs(normals @ axes_of(self.viewer.camera)[2])
        third = 2 if squarely[2] > FLAT_VIEW else int(np.argmax(squarely))
        u, v = (third + 1) % 3, (third + 2) % 3
        origin = frame[:, 3] + place[third] * frame[:, third]
        matrix = np.column_stack((frame[:, u], frame[:, v], frame[:, third], origin))
        return Plane(place, (u, v), matrix)

    def along(self, way: tuple[float, float], length: float) -> tuple[float, ...]:
        """(d,) `length` mm along the one of the outline's own axes that leads most to where `way` points in the
        picture, x to the right and y up."""
        assert self.edited is not None
        right, up, _ = axes_of(self.viewer.camera)
        dimension = self.edited.dimension
        axes = self.edited.frame[:, :dimension].T
        axes = axes / np.maximum(np.linalg.norm(axes, axis=1, keepdims=True), 1e-300)
        shares = axes @ (way[0] * right + way[1] * up)
        found = np.zeros(dimension)
        best = int(np.argmax(np.abs(shares)))
        found[best] = length if shares[best] >= 0.0 else -length
        return tuple(found.tolist())

    def pixel_of(self, place: Floats) -> Floats:
        """(2,) where a place (d,) of the outline's own axes is seen."""
        assert self.edited is not None
        return project(self.viewer.camera, self.edited.world(place[None]), self.viewer.size)[0, :2]

    def reached(self, pixel: tuple[float, float], plane: Plane, wish: Wish, snapping: bool) -> Snap | None:
        """What a pixel means in a plane, marked; None where the plane is seen from its edge."""
        free = wish.free or not snapping
        snap = self._snapper.snap(
            pixel, plane.frame, wish.exclude, wish.origin, angles=wish.angles, free=free and not wish.angles
        )
        if snap is None:
            self._snap_mark.show(None)
            return None
        world = plane.frame
        guides = [line @ world[:, :2].T + world[:, 3] for line in snap.guides]
        self._marks.set_guides(np.array(guides).reshape(-1, 2, 3))
        sign = SIGNS.get(snap.kind)
        place = vector_of(snap.point @ world[:, :2].T + world[:, 3])
        self._snap_mark.show(None if sign is None or snap.kind == "grid" else Landmark(sign, place, None, ()))
        return snap

    def knob_corner(self, number: int) -> tuple[Floats, Floats]:
        """The step (2,) of a knob from the box's middle, and the place (2,) on the nodes' own bounds that it moves."""
        box = self.box()
        assert box is not None
        _, steps = knobs_of(box, self.viewer.camera, self.viewer.size)
        step = np.zeros(2) if number == TURNED else steps[number]
        middle, half = box.corners.mean(axis=0), 0.5 * (box.corners[1] - box.corners[0])
        return step, middle + step * half


def _nearest(places: Floats, pixel: Floats) -> int | None:
    """The row of places (n, 2) that is nearest to a pixel, within reach."""
    if not len(places):
        return None
    with np.errstate(invalid="ignore"):
        away = np.hypot(*(places - pixel).T)
    away[~np.isfinite(away)] = np.inf
    row = int(np.argmin(away))
    return row if away[row] <= REACH else None
