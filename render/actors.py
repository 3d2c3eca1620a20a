"""The actors of one solid: faces, feature edges, silhouette, and the outline of what is selected."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from .curves.contour_lines import CurveLines, has_curves
from .look import Look, mixed, palette, rgb
from .outline import Adjacency
from .polydata import cells_of, lines_of, places_in, set_cell_colours, surface_of, vtk_array
from .shading import unlit
from .surfaces.shader import NUMBER, POSITION
from .surfaces.surfaces import Surfaces

if TYPE_CHECKING:
    from ..model.solid.display import DisplayMesh
    from ..model.surface.appearance import Appearance
    from .camera import Camera

Path = tuple[str | int, ...]

SHEET = 0.22  # opacity of what an outline fills
SHEET_OFFSET = (0.0, 0.0)  # slope and steps of depth behind lines; faces of solids stand at (2, 2)
FADED = 0.7  # how much of the ground is mixed into the lines of what is faded
SELECTED, HOVERED, TOUCHED = 0.42, 0.28, 0.55  # how much of the highlight's colour is mixed into a face
TOUCH = "#d6336c"  # what touches something, unlike what is selected or pointed at


class SolidActors:
    """What one DisplayMesh looks like; the mesh never changes, the rest does."""

    def __init__(self, mesh: "DisplayMesh", colours: Any) -> None:
        self.mesh = mesh
        self.colours = colours
        self.faded = False
        """Whether only faint lines are drawn of it."""
        self.touched = False
        """Whether all of it is coloured as something that touches another."""
        self.surface = surface_of(mesh)
        self.features = lines_of(mesh.edge_points, mesh.edges)
        self._outline = lines_of(mesh.edge_points, mesh.edges[:0])
        self._silhouette = vtkPolyData()
        self._silhouette.SetPoints(self.surface.GetPoints())
        self.faces = faces_actor(self.surface)
        if mesh.sheet:  # in front of the face of a solid that it lies on
            self.faces.GetMapper().SetRelativeCoincidentTopologyPolygonOffsetParameters(*SHEET_OFFSET)
        self.edges = _actor(self.features)
        self.silhouette = _actor(self._silhouette)
        self.outline = _actor(self._outline)
        for lines in (self.edges, self.silhouette, self.outline):
            unlit(lines)
            lines.GetMapper().ScalarVisibilityOff()
            lines.PickableOff()
        self._adjacency: Adjacency | None = None
        self._curves: CurveLines | None = None
        self._shows_curves = False
        self._outlined: NDArray[np.bool_] = np.zeros(len(mesh.owners), bool)
        self._palette: NDArray[np.uint8] | None = None
        self._worn: object = None

    @property
    def actors(self) -> tuple[vtkActor, ...]:
        return self.faces, self.edges, self.silhouette, self.outline

    @property
    def face_colours(self) -> NDArray[np.uint8]:
        """Colours (o, 2, 3) of triangles by owner and by `subtracted`, once painted; another array where others."""
        return np.zeros((1, 2, 3), np.uint8) if self._palette is None else self._palette

    @property
    def adjacency(self) -> Adjacency:
        if self._adjacency is None:
            self._adjacency = Adjacency(self.mesh)
        return self._adjacency

    def under(self, paths: Iterable[Path]) -> NDArray[np.bool_]:
        """Which owners (o,) stand at or below one of the paths in the tree."""
        wanted = set(paths)
        lengths = sorted({len(path) for path in wanted})
        return np.array([any(owner[:n] in wanted for n in lengths) for owner in self.mesh.owners], bool)

    @property
    def looks(self) -> "tuple[Appearance, ...]":
        """How the owners look; none where no one wears a material."""
        return getattr(self.colours, "looks", ())

    def wear(self, numbers: NDArray[np.float32], frames: Sequence[NDArray[np.float64]]) -> None:
        """Hand the shader the numbers (o,) of the owners' looks, and the places in the frames (3, 4) of these."""
        worn = (numbers.tobytes(), tuple(frames[i].tobytes() for i in np.unique(numbers).astype(int).tolist()))
        if worn == self._worn:
            return
        self._worn = worn
        number = np.zeros(len(self.mesh.points), np.float32)
        number[self.mesh.triangles] = numbers[self.mesh.owner][:, None]  # a point belongs to faces of one owner
        data = self.surface.GetPointData()
        mapper: Any = self.faces.GetMapper()
        for name, values in ((NUMBER, number), (POSITION, places_in(self.mesh.points, number, frames))):
            data.RemoveArray(name)
            data.AddArray(vtk_array(values, np.float32, name))
            mapper.MapDataArrayToVertexAttribute(name, name, 0, -1)

    def set_move(self, move: NDArray[np.float64] | None) -> None:
        """Draw it moved by a matrix (4, 4), None: where it is."""
        matrix = None
        if move is not None:
            matrix = vtkMatrix4x4()
            matrix.DeepCopy(np.asarray(move, np.float64).ravel().tolist())
        for actor in self.actors:
            actor.SetUserMatrix(matrix)

    def set_style(
        self, style: str, shading: str, look: Look, opacity: float, line_width: float, surfaces: Surfaces
    ) -> None:
        dress_faces(self.faces, style, shading, look, opacity, surfaces, dressed=bool(self.looks))
        self.faces.SetForceTranslucent(bool(self.looks) and surfaces.translucent(self.looks))
        self.faces.GetProperty().SetLineWidth(max(1.0, 0.5 * line_width))
        if self.mesh.sheet:
            unlit(self.faces)
            self.faces.GetProperty().SetRepresentationToSurface()
            self.faces.GetProperty().SetOpacity(SHEET if style in ("shaded", "edges") else 0.0)
        self._show_curves(style == "wireframe" and has_curves(self.mesh))
        self.edges.SetVisibility(self.faded or style != "shaded" or self.mesh.sheet)
        self.silhouette.SetVisibility((self.faded or style in ("wireframe", "hidden-line")) and not self.mesh.sheet)
        # VTK offsets lines by 4 units, enough to shine through thin walls; in wireframe they lie over all triangles.
        nearer = 2000.0 if style == "wireframe" else -3.0
        line = rgb(look.edge if style == "edges" and not self.mesh.sheet else look.line)
        if self.faded:
            line = mixed(rgb(look.line), rgb(look.plain_background), FADED)
        for lines, colour, width in (
            (self.edges, line, line_width),
            (self.silhouette, line, line_width),
            (self.outline, rgb(look.selection), 1.6 * line_width),
        ):
            lines.GetProperty().SetColor(*colour)
            lines.GetProperty().SetLineWidth(width)
            lines.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -nearer)
        self.outline.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -nearer - 1.0)

    def paint(self, style: str, look: Look, selection: Iterable[Path], hover: Path | None, ground: Any) -> None:
        """Colour the triangles; `ground` is the background's colour, which the faces of hidden-line pictures take."""
        colours = palette(self.mesh, self.colours, look)
        strength = 1.0
        if style == "wireframe":
            colours[:] = rgb(look.faint_edge)
        elif style == "hidden-line":
            colours[:] = rgb(ground)
            strength = 0.35
        if self.touched:
            colours += strength * TOUCHED * (np.array(rgb(TOUCH)) - colours)
        selected = self.under(selection)
        for owners, colour, share in (
            (selected, look.selection, SELECTED),
            (self.under(() if hover is None else (hover,)), look.hover, HOVERED),
        ):
            colours[: len(owners)][owners] += (
                strength * share * (np.array(rgb(colour)) - colours[: len(owners)][owners])
            )
        bytes_ = np.round(255.0 * colours).astype(np.uint8)
        if self._palette is None or not np.array_equal(bytes_, self._palette):
            self._palette = bytes_
            set_cell_colours(self.surface, bytes_[self.mesh.owner, self.mesh.subtracted.astype(np.intp)])
        if not np.array_equal(selected, self._outlined):
            self._outlined = selected
            self._outline.SetLines(cells_of(self.mesh.edges[self._features_of(selected)]))

    def turn_silhouette(self, camera: "Camera", pixel: float) -> None:
        """Find the silhouette anew; costs about as much as drawing the lines. Curves are as fine as `pixel` mm asks."""
        if self.mesh.sheet:
            return
        eye = np.asarray(camera.position)
        towards = eye - camera.target if camera.parallel else eye
        if self._shows_curves:
            assert self._curves is not None
            self._curves.turn(towards, camera.parallel, pixel)
            return
        self._silhouette.SetLines(cells_of(self.adjacency.silhouette(towards, camera.parallel)))

    def _show_curves(self, shown: bool) -> None:
        """Draw edges and silhouette as the curves that they stand for, or as the mesh has them."""
        if shown == self._shows_curves:
            return
        self._shows_curves = shown
        if shown and self._curves is None:
            self._curves = CurveLines(self.mesh)
        edges, silhouette = (self.features, self._silhouette) if self._curves is None or not shown else (
            self._curves.edges, self._curves.silhouette)  # fmt: skip
        for actor, data in ((self.edges, edges), (self.silhouette, silhouette)):
            actor.GetMapper().SetInputDataObject(data)

    def _features_of(self, owners: NDArray[np.bool_]) -> NDArray[np.bool_]:
        if not owners.any():
            return np.zeros(len(self.mesh.edges), bool)
        beside = owners[self.mesh.owner[self.mesh.edge_sides]]
        return beside[:, 0] | beside[:, 1]


def faces_actor(data: vtkPolyData) -> vtkActor:
    """An actor whose faces stand back behind lines in the same place."""
    actor = _actor(data)
    actor.GetMapper().SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0)
    return actor


def dress_faces(
    actor: vtkActor,
    style: str,
    shading: str,
    look: Look,
    opacity: float,
    surfaces: Surfaces,
    dressed: bool = False,
    pieces: bool = False,
) -> None:
    """Show faces in a style, `dressed` ones in their materials; `pieces` of triangles as in `Surfaces.shade`."""
    material = actor.GetProperty()
    if style == "wireframe":
        material.SetRepresentationToWireframe()
    else:
        material.SetRepresentationToSurface()
    if style in ("shaded", "edges"):
        if dressed:
            surfaces.dress(actor, pieces)
        else:
            surfaces.shade(actor, shading, look, pieces)
        material.SetOpacity(opacity)
    else:
        unlit(actor)
        material.SetOpacity(1.0)


def _actor(data: vtkPolyData) -> vtkActor:
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor
