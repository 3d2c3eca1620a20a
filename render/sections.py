"""Planes that open the picture: all actors are clipped on the graphics card, and the cuts are capped and hatched."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ..model.document.errors import Refusal
from ..model.section.hatch import ANGLES, hatch
from ..model.section.section import SectionOutline, plane_through, section
from .look import Colour, Look, mixed, palette, rgb
from .pick import Pick
from .polydata import cells_of, points_of, set_cell_colours
from .shading import unlit

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

    from ..model.document.document import Section
    from ..model.solid.display import DisplayMesh

Path = tuple[str | int, ...]
Floats = NDArray[np.float64]
Solids = Mapping[str, tuple["DisplayMesh", Any]]

MOST = 6
"""Planes at once: what VTK's shaders clip by."""
HATCH = 9.0
"""Logical pixels between the lines of a hatch, give or take a fifth."""
SLACK = 1e-6
"""Of a plane's distance from the origin, and of a millimetre at least: what still counts as on its kept side."""
MOST_FILLED = 8_000
"""Corners of an outline in a plane that is being dragged; a larger one is filled when it comes to rest."""


@dataclass(frozen=True, slots=True)
class Dress:
    """How the scene looks at the moment."""

    style: str
    look: Look
    ground: Any
    """The background's colour, which faces take in hidden-line pictures."""
    selection: frozenset[Path]
    hover: Path | None
    line_width: float
    spacing: float
    """Of the hatch, in mm."""
    paint: int
    """Another number for other colours of the solids."""


class Cap:
    """What one plane cuts: an outline for each solid, and three actors for all of them."""

    def __init__(self) -> None:
        self.plane: Section | None = None
        self.outlines: dict[str, SectionOutline] = {}
        """By the solid's id; owners count twice, odd ones are subtracted operands."""
        self._meshes: dict[str, DisplayMesh] = {}
        self._drawn: tuple[Any, ...] | None = None
        self._coloured: Dress | None = None
        self.fill, self.hatch, self.contour = (_actor(vtkPolyData(), offset=i == 0) for i in range(3))

    @property
    def actors(self) -> tuple[vtkActor, ...]:
        return self.fill, self.hatch, self.contour

    def cut(self, plane: Section, solids: Solids) -> bool:
        """Cut anew what is another mesh, or all where the plane is another; whether anything was."""
        moved = self.plane is None or (plane.point, plane.normal) != (self.plane.point, self.plane.normal)
        self.plane = plane
        outlines: dict[str, SectionOutline] = {}
        for solid_id, (mesh, _) in solids.items():
            if not moved and self._meshes.get(solid_id) is mesh:
                outlines[solid_id] = self.outlines[solid_id]
                continue
            towards = tuple(-n for n in plane.normal)
            try:
                made = 2 * mesh.owner + mesh.subtracted
                outlines[solid_id] = section(mesh.points, mesh.triangles, plane.point, towards, made)
            except Refusal:  # an open surface has no inside to be capped
                outlines[solid_id] = SectionOutline(plane_through(plane.point, towards))
        same = not moved and outlines.keys() == self.outlines.keys()
        changed = not same or any(outlines[key] is not self.outlines[key] for key in outlines)
        self._meshes = {solid_id: mesh for solid_id, (mesh, _) in solids.items()}
        if changed:
            self.outlines = outlines
        return changed

    def draw(self, solids: Solids, dress: Dress, changed: bool, dragged: bool) -> None:
        """Bring the actors up to date."""
        shown = [(number, key) for number, key in enumerate(self.outlines) if len(self.outlines[key].points)]
        filled = dress.style != "wireframe" and not (
            dragged and sum(len(self.outlines[key].points) for _, key in shown) > MOST_FILLED
        )
        drawn = (dress.spacing, filled)
        if changed or drawn != self._drawn:
            self._drawn = drawn
            self._coloured = None
            self._shape(shown, dress.spacing, filled)
        if dress != self._coloured:
            self._coloured = dress
            self._colour(shown, solids, dress)

    def _shape(self, shown: Sequence[tuple[int, str]], spacing: float, filled: bool) -> None:
        outlines = [self.outlines[key] for _, key in shown]
        places = [outline.plane.world(outline.points) for outline in outlines]
        first = np.cumsum([0, *(len(place) for place in places)])
        lines = [
            np.column_stack([np.arange(len(outline.points)), outline.following]) + start
            for outline, start in zip(outlines, first, strict=False)
        ]
        triangles = [outline.triangles + start for outline, start in zip(outlines, first, strict=False) if filled]
        pieces = [
            outline.plane.world(hatch(outline, spacing, ANGLES[number % len(ANGLES)]).reshape(-1, 2))
            for (number, _), outline in zip(shown, outlines, strict=True)
        ]
        points = points_of(np.concatenate([*places, np.zeros((0, 3))]))
        _put(self.contour, points, _joined(lines, 2))
        _put(self.fill, points, _joined(triangles, 3), polygons=True)
        ends = np.concatenate([*pieces, np.zeros((0, 3))])
        _put(self.hatch, points_of(ends), np.arange(len(ends), dtype=np.int32).reshape(-1, 2))
        self._counts = (
            [len(cells) for cells in triangles] if filled else [0] * len(shown),
            [len(piece) // 2 for piece in pieces],
        )

    def _colour(self, shown: Sequence[tuple[int, str]], solids: Solids, dress: Dress) -> None:
        look, plain = dress.look, dress.style in ("hidden-line", "wireframe")
        fills, lines = [], []
        for _, key in shown:
            solid = _colour_of(self.outlines[key], *solids[key], look)
            fill = rgb(dress.ground) if plain else mixed(solid, rgb(look.cut), 0.5)
            for marked, colour, share in (
                ((key,) in dress.selection, look.selection, 0.42),
                (dress.hover == (key,), look.hover, 0.28),
            ):
                fill = mixed(fill, rgb(colour), share) if marked else fill
            fills.append(fill)
            lines.append(mixed(rgb(look.line), solid, 0.25 if plain else 0.5))
        for actor, colours, counts in ((self.fill, fills, self._counts[0]), (self.hatch, lines, self._counts[1])):
            values = np.round(255.0 * np.reshape(colours, (-1, 3))).astype(np.uint8)
            set_cell_colours(actor.GetMapper().GetInput(), np.repeat(values, counts, axis=0))
        self.contour.GetProperty().SetColor(*rgb(look.line))
        self.contour.GetProperty().SetLineWidth(1.9 * dress.line_width)
        self.hatch.GetProperty().SetLineWidth(0.8 * dress.line_width)


class Sections:
    """The active planes of one scene. Their cuts are made when they are drawn or asked for, and only those anew that
    must be."""

    def __init__(self, renderer: vtkRenderer) -> None:
        self._renderer = renderer
        self.planes: tuple[Section, ...] = ()
        self.dragged = False
        self._solids: Solids = {}
        self._clips: list[vtkPlane] = []
        self._caps: list[Cap] = []
        self._stale = False
        self._paint = 0
        self._changed: set[int] = set()

    def set_planes(self, sections: Iterable[Section], dragged: bool = False) -> bool:
        """Be opened by those of the sections that are active, six at most; whether actors must be clipped anew."""
        planes = tuple(plane for plane in sections if plane.active)[:MOST]
        self.dragged = dragged
        self._stale = self._stale or planes != self.planes
        other = len(planes) != len(self.planes)
        self.planes = planes
        if other:
            for cap in self._caps[len(planes) :]:
                for actor in cap.actors:
                    self._renderer.RemoveActor(actor)
            del self._caps[len(planes) :], self._clips[len(planes) :]
            while len(self._caps) < len(planes):
                self._clips.append(vtkPlane())
                self._caps.append(Cap())
                for actor in self._caps[-1].actors:
                    self._renderer.AddActor(actor)
            for place, cap in enumerate(self._caps):
                self.clip(cap.actors, but=place)
        for clip, plane in zip(self._clips, planes, strict=True):
            clip.SetOrigin(*plane.point)
            clip.SetNormal(*plane.normal)
        return other

    def set_solids(self, solids: Solids) -> None:
        self._solids = solids
        self._paint += 1
        self._stale = True

    def clip(self, actors: Iterable[vtkActor], but: int = -1) -> None:
        """Let the planes clip these actors; a cap not by its own."""
        for actor in actors:
            mapper = actor.GetMapper()
            mapper.RemoveAllClippingPlanes()
            for place, clip in enumerate(self._clips):
                if place != but:
                    mapper.AddClippingPlane(clip)

    def outlines(self, name: str) -> dict[str, SectionOutline]:
        """What the active section of this name cuts, whole, by the solid's id, as precise as the picture."""
        self._cut()
        return next((cap.outlines for cap in self._caps if cap.plane is not None and cap.plane.name == name), {})

    def before_render(
        self, style: str, look: Look, ground: Any, selection: frozenset[Path], hover: Path | None,
        line_width: float, pixel: float,
    ) -> None:  # fmt: skip
        """Draw what has changed; `pixel` is the size of a logical pixel in mm."""
        if not self._caps:
            return
        self._cut()
        spacing = 2.0 ** (round(2.0 * math.log2(HATCH * pixel)) / 2.0)
        dress = Dress(style, look, ground, selection, hover, line_width, spacing, self._paint)
        for place, cap in enumerate(self._caps):
            cap.draw(self._solids, dress, place in self._changed, self.dragged)
        self._changed.clear()

    def span(self, origin: ArrayLike, direction: ArrayLike) -> tuple[float, float]:
        """Between which distances a ray is on the kept side of all planes; the second is less where nowhere."""
        near, far = 0.0, math.inf
        start, along = np.asarray(origin, float), np.asarray(direction, float)
        for plane in self.planes:
            normal = np.asarray(plane.normal)
            height = float(normal @ (start - plane.point))
            slope = float(normal @ along)
            slack = SLACK * max(1.0, math.hypot(*plane.point))
            if abs(slope) < 1e-12:
                if height < -slack:
                    return math.inf, -math.inf
            elif slope > 0.0:
                near = max(near, (-height - slack) / slope)
            else:
                far = min(far, (-height - slack) / slope)
        return near, far

    def pick(self, origin: ArrayLike, direction: ArrayLike) -> Pick | None:
        """The nearest cut face on a ray; its path is the solid's root alone."""
        self._cut()
        start, along = np.asarray(origin, float), np.asarray(direction, float)
        near, far = self.span(start, along)
        best: Pick | None = None
        for cap in self._caps:
            plane = cap.plane
            assert plane is not None
            slope = float(np.dot(plane.normal, along))
            if abs(slope) < 1e-12:
                continue
            distance = float(np.dot(plane.normal, plane.point - start)) / slope
            if not near <= distance <= far or (best is not None and best.distance <= distance):
                continue
            point = start + distance * along
            for solid_id, outline in cap.outlines.items():
                if len(outline.points) and outline.holds(outline.plane.flat(point))[0]:
                    best = Pick(
                        solid_id, -1, _three(point), _three(-np.asarray(plane.normal)), distance, (solid_id,), -1,
                        False, plane.name,
                    )  # fmt: skip
                    break
        return best

    def _cut(self) -> None:
        if self._stale:
            self._stale = False
            for place, (cap, plane) in enumerate(zip(self._caps, self.planes, strict=True)):
                if cap.cut(plane, self._solids):
                    self._changed.add(place)


def _colour_of(outline: SectionOutline, mesh: DisplayMesh, colours: Any, look: Look) -> Colour:
    """The colour of the operand that has the most of the rim, those left out that were subtracted."""
    sides = np.linalg.norm(outline.points[outline.following] - outline.points, axis=1)
    kept = (outline.owners >= 0) & (outline.owners % 2 == 0)
    share = np.bincount(outline.owners[kept] // 2, sides[kept])
    return rgb(palette(mesh, colours, look)[int(np.argmax(share)) if len(share) else 0, 0])


def _joined(cells: Sequence[NDArray[Any]], size: int) -> NDArray[np.int32]:
    return np.concatenate([*cells, np.zeros((0, size), np.int32)]).astype(np.int32)


def _put(actor: vtkActor, points: Any, cells: NDArray[np.int32], polygons: bool = False) -> None:
    data = vtkPolyData()
    data.SetPoints(points)
    (data.SetPolys if polygons else data.SetLines)(cells_of(cells))
    mapper: Any = actor.GetMapper()
    mapper.SetInputData(data)
    actor.SetVisibility(len(cells) > 0)


def _actor(data: vtkPolyData, offset: bool) -> vtkActor:
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    if offset:
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(1.0, 1.0)
    else:
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -4.0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.PickableOff()
    unlit(actor)
    return actor


def _three(values: Floats) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])
