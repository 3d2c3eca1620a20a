"""Ghosts: operands that a result does not show as they are, drawn through it.

Every part of a ghost is drawn twice: strongly where nothing hides it, and weakly over everything, so that a drill deep
in a block is seen and yet looks deep. Ghosts are neither picked nor fitted.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ..look import Look, rgb
from ..shading import shade, unlit
from .placed_cells import IDENTITY, Cells, Matrix
from .plane_grid import plane_grid

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

    from ...model.solid.display import DisplayMesh

Plane = tuple[tuple[float, float, float], tuple[float, float, float]]  # unit normal and point

BEFORE_ALL = -70_000.0  # an offset by which VTK's shaders bring every depth to the near plane
NEARER = -3.0  # one by which a face wins over the same face of the result
STRIPES = 7.0  # logical pixels from one line of the hatch to the next
MANY = 8  # places from which on one surface holds all of them: drawing an actor costs a tenth of a millisecond
MOST_TRIANGLES = 500_000  # in one such surface; places beyond are left out


class Manner(Enum):
    """How a ghost is drawn."""

    HATCHED = auto()  # what is subtracted
    TINTED = auto()  # what is intersected, enclosed or hidden: outline and a light tint
    PLANE = auto()  # a half-space: a rectangle of its plane, as a grid


@dataclass(frozen=True, slots=True)
class Strength:
    """Opacities of one pass: of the faces, of what curves away from the eye, of the lines of the hatch, of edges."""

    face: float
    rim: float
    stripe: float
    edge: float

    @property
    def lit(self) -> bool:
        """Whether the faces are those of a solid."""
        return self.rim > 0.0


# Where nothing hides it, and everywhere.
STRENGTHS = {
    Manner.HATCHED: (Strength(0.20, 0.35, 0.34, 0.85), Strength(0.08, 0.14, 0.13, 0.30)),
    Manner.TINTED: (Strength(0.22, 0.45, 0.0, 0.85), Strength(0.09, 0.18, 0.0, 0.30)),
    Manner.PLANE: (Strength(0.12, 0.0, 0.0, 0.50), Strength(0.03, 0.0, 0.0, 0.22)),
}


@dataclass(frozen=True, slots=True, eq=False)
class Ghost:
    """One occurrence of a node. `mesh` lies in the node's own axes, and `matrix` (3, 4) maps them to the world's.

    With a `plane`, in the node's own axes, the mesh only tells how far it is worth drawing.
    """

    mesh: "DisplayMesh"
    matrix: Matrix
    manner: Manner
    plane: Plane | None = None


class Ghosts:
    """The ghosts of one renderer. Where only a matrix differs from what is shown, nothing is uploaded."""

    def __init__(self, renderer: "vtkRenderer", look: Look) -> None:
        self._renderer = renderer
        self._look = look
        self._scale = 1.0
        self._sheets: dict[tuple[object, ...], _Sheet] = {}

    def show(self, ghosts: Iterable[Ghost]) -> None:
        """Show exactly these."""
        wanted: dict[tuple[object, ...], list[Ghost]] = {}
        for ghost in ghosts:
            wanted.setdefault((id(ghost.mesh), ghost.manner, ghost.plane), []).append(ghost)
        for key in [key for key in self._sheets if key not in wanted]:
            self._sheets.pop(key).place((), self._renderer)
        for key, members in wanted.items():
            sheet = self._sheets.get(key)
            if sheet is None:
                sheet = self._sheets[key] = _Sheet(members[0])
                sheet.set_look(self._look, self._scale)
            sheet.place([ghost.matrix for ghost in members], self._renderer)

    @property
    def count(self) -> int:
        return sum(len(sheet.matrices) for sheet in self._sheets.values())

    @property
    def bounds(self) -> NDArray[np.float64] | None:
        """The box (2, 3) around all of them, None where there are none."""
        boxes = [box for sheet in self._sheets.values() for box in sheet.boxes()]
        if not boxes:
            return None
        return np.array([np.min(boxes, axis=(0, 1)), np.max(boxes, axis=(0, 1))])

    def set_look(self, look: Look) -> None:
        self._look = look
        for sheet in self._sheets.values():
            sheet.set_look(look, self._scale)

    def set_line_scale(self, scale: float) -> None:
        """Device pixels per logical pixel."""
        if scale != self._scale:
            self._scale = scale
            self.set_look(self._look)


class _Sheet:
    """A surface with its edges, in one manner, at any number of places."""

    def __init__(self, ghost: Ghost) -> None:
        self.mesh = ghost.mesh  # held, since its id names the sheet
        self.matrices: list[Matrix] = []
        if ghost.plane is None:
            self._faces = Cells(ghost.mesh.points, ghost.mesh.triangles, ghost.mesh.normals)
            self._lines = Cells(ghost.mesh.edge_points, ghost.mesh.edges)
            self._box = np.reshape(ghost.mesh.bounds, (2, 3))
        else:
            grid = plane_grid(*ghost.plane, np.reshape(ghost.mesh.bounds, (2, 3)))
            self._faces, self._lines, self._box = grid.faces, grid.lines, grid.bounds
        strong, weak = STRENGTHS[ghost.manner]
        width = 1.0 if ghost.manner is Manner.PLANE else 1.4
        self._passes = (_Pass(weak, width, BEFORE_ALL), _Pass(strong, width, NEARER))
        self._merged: bool | None = None

    def boxes(self) -> list[NDArray[np.float64]]:
        """The corners (8, 3) of each place's box, in the world's axes."""
        corners = np.stack(np.meshgrid(*self._box.T), axis=-1).reshape(-1, 3)
        return [corners @ matrix[:, :3].T + matrix[:, 3] for matrix in self.matrices]

    def place(self, matrices: Iterable[Matrix], renderer: "vtkRenderer") -> None:
        self.matrices = places = list(matrices)
        # VTK takes the front of a mirrored surface for its back.
        merge = len(places) > MANY or any(np.linalg.det(matrix[:, :3]) < 0.0 for matrix in places)
        if merge:
            places = places[: max(1, MOST_TRIANGLES // max(len(self._faces.cells), 1))]
            faces, lines = self._faces.at(places), self._lines.at(places)
            places = [IDENTITY]
        else:
            faces, lines = self._faces, self._lines
        if merge or merge != self._merged:
            self._merged = merge
            data = faces.polys(), lines.lines()
            for part in self._passes:
                part.set_data(*data)
        for part in self._passes:
            part.place(places, renderer)

    def set_look(self, look: Look, scale: float) -> None:
        for part in self._passes:
            part.set_look(look, scale)


class _Pass:
    """Faces and lines at one strength. All places share two mappers, and so what the graphics card holds."""

    def __init__(self, strength: Strength, width: float, offset: float) -> None:
        self._strength = strength
        self._width = width
        self._mappers = (_mapper(), _mapper())
        self._mappers[0].SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, offset)
        self._mappers[1].SetRelativeCoincidentTopologyLineOffsetParameters(0.0, offset - 2.0)
        self._actors: list[tuple[vtkActor, vtkActor]] = []
        self._look: tuple[Look, float] | None = None

    def set_data(self, faces: vtkPolyData, lines: vtkPolyData) -> None:
        for mapper, data in zip(self._mappers, (faces, lines), strict=True):
            mapper.SetInputData(data)

    def place(self, matrices: list[Matrix], renderer: "vtkRenderer") -> None:
        while len(self._actors) > len(matrices):
            for actor in self._actors.pop():
                renderer.RemoveActor(actor)
        while len(self._actors) < len(matrices):
            faces, lines = _actor(self._mappers[0]), _actor(self._mappers[1])
            self._dress(faces, lines)
            self._actors.append((faces, lines))
            renderer.AddActor(faces)
            renderer.AddActor(lines)
        for pair, matrix in zip(self._actors, matrices, strict=True):
            for actor in pair:
                placed = actor.GetUserMatrix()
                placed.DeepCopy((*matrix.reshape(-1).tolist(), 0.0, 0.0, 0.0, 1.0))

    def set_look(self, look: Look, scale: float) -> None:
        self._look = (look, scale)
        for faces, lines in self._actors:
            self._dress(faces, lines)

    def _dress(self, faces: vtkActor, lines: vtkActor) -> None:
        if self._look is None:
            return
        look, scale = self._look
        material = faces.GetProperty()
        material.SetColor(*rgb(look.ghost))
        if self._strength.lit:
            # Both sides would double the tint, and the far side of a drill lies in the wall of its hole.
            material.BackfaceCullingOn()
            shade(faces, look)
            material.SetSpecular(0.0)
            material.SetAmbient(0.45)
            material.SetDiffuse(0.6)
            material.SetOpacity(0.5)  # the shader says how much; this makes VTK blend it
            faces.GetShaderProperty().AddFragmentShaderReplacement(
                "//VTK::Light::Impl", True, _fragment(self._strength, rgb(look.ghost_line), scale), False
            )
        else:
            unlit(faces)
            material.SetOpacity(self._strength.face)
        unlit(lines)
        lines.GetProperty().SetColor(*rgb(look.ghost_line))
        lines.GetProperty().SetOpacity(self._strength.edge)
        lines.GetProperty().SetLineWidth(self._width * scale)


def _fragment(strength: Strength, line: tuple[float, float, float], scale: float) -> str:
    """Opacity by the angle to the eye, and a hatch at 45 degrees in the picture."""
    return f"""//VTK::Light::Impl
  vec3 ghostView = cameraParallel != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
  float ghostRim = pow(1.0 - abs(dot(normalVCVSOutput, ghostView)), 3.0);
  float ghostRow = fract((gl_FragCoord.x + gl_FragCoord.y) * {0.70710678 / (STRIPES * scale):.8f});
  float ghostStripe = 1.0 - smoothstep(0.09, 0.09 + {1.0 / (STRIPES * scale):.8f}, abs(ghostRow - 0.5));
  float ghostLine = {strength.stripe:.4f} * ghostStripe + {strength.rim:.4f} * ghostRim;
  float ghostFace = {strength.face:.4f};
  vec3 ghostInk = vec3({line[0]:.4f}, {line[1]:.4f}, {line[2]:.4f});
  fragOutput0.rgb = mix(fragOutput0.rgb, ghostInk, (ghostLine + 0.25 * ghostFace) / (ghostLine + ghostFace));
  fragOutput0.a = min(ghostFace + ghostLine, 0.9);
"""


def _mapper() -> vtkPolyDataMapper:
    mapper = vtkPolyDataMapper()
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    return mapper


def _actor(mapper: vtkPolyDataMapper) -> vtkActor:
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetUserMatrix(vtkMatrix4x4())
    actor.PickableOff()
    actor.UseBoundsOff()
    return actor
