"""One model under several shadings side by side: flat, Gouraud, Phong, and Phong with bumps."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkRenderer

from ...model.surface.appearance import Appearance, appearances
from ...model.surface.light import PROGRAM, Light
from ...model.surface.material import Material
from ..camera import Camera, apply
from ..look import Look, Paint
from ..scene import Scene
from ..window import close, offscreen_window, pixels

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.document.nodes import Node
    from ...model.solid.display import DisplayMesh

Solids = list[tuple["DisplayMesh", Paint]]

SHADINGS = ("flat", "gouraud", "phong", "bumps")
"""The columns of a comparison; "bumps" is Phong's shading of perturbed normals."""
SAMPLES = 4
DIMPLES = (12, 6)  # on the bitmap that gives bumps to what has none, to the right and upwards
SIDE = 24  # texels along one of them
FAINT = 16  # levels: less than that is not stretched to white
DEPTH = 0.02  # of those, as a share of the model's diagonal


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """One picture: solids as `Scene.show` takes them, and the shading that counts where a material has none."""

    name: str
    solids: Solids
    shading: str


def columns_of(
    document: Document,
    solids: Sequence[tuple[Node, DisplayMesh]],
    shadings: Iterable[str] = SHADINGS,
    change: Callable[[Material], Material] = lambda material: material,
) -> list[Column]:
    """The same solids, as resolved roots with their meshes, under each of the shadings.

    The shadings of the materials themselves do not count here. In the last column what has no bump map gets dimples;
    in the others no bump map counts. `change` is applied to each material, also to the one of what wears none.
    """
    dressed = [(mesh, root.colour, appearances(document, root, mesh.owners)) for root, mesh in solids]
    found = []
    for name in shadings:
        column: Solids = []
        for mesh, colour, looks in dressed:
            wears = {look.material: change(_worn(look.material, name, mesh)) for look in looks}
            mine = tuple(_redressed(look, wears[look.material]) for look in looks)
            column.append((mesh, Paint(colour, tuple(look.colour for look in mine), mine)))
        found.append(Column(name, column, "phong" if name == "bumps" else name))
    return found


def _redressed(look: Appearance, material: Material) -> Appearance:
    before = None if look.material is None else look.material.colour
    return replace(look, material=material, colour=look.colour if material.colour == before else material.colour)


def _worn(material: Material | None, column: str, mesh: DisplayMesh) -> Material:
    material = (material or Material("plain")).with_(shading="")
    if column != "bumps":
        return material.with_(bump="")
    if material.bump:
        return material
    diagonal = float(np.linalg.norm(np.ptp(mesh.bounds, axis=0))) if len(mesh.triangles) else 1.0
    return material.with_(bump=dimples(), bump_kind="heights", bump_height=DEPTH * diagonal)


@lru_cache(maxsize=1)
def dimples() -> str:
    """The asset of a bitmap of round dimples."""
    from io import BytesIO

    from PIL import Image

    from ...model.project.assets import default_store

    width, height = SIDE * DIMPLES[0], SIDE * DIMPLES[1]
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    off = np.hypot((x % SIDE) / SIDE - 0.5, (y % SIDE) / SIDE - 0.5) / 0.42  # from a dimple's middle, 1 at its rim
    depth = np.clip(1.0 - off**2, 0.0, 1.0) ** 2
    out = BytesIO()
    Image.fromarray(np.rint(255.0 * (1.0 - depth)).astype(np.uint8)).save(out, "PNG")
    return default_store().put(out.getvalue())


class Comparison:
    """Pictures of columns from one eye, drawn off screen. `close` it when done."""

    def __init__(self, look: Look) -> None:
        self._look = look
        self._window = offscreen_window((8, 8), SAMPLES)
        self._scenes: list[Scene] = []
        self._renderers: list[vtkRenderer] = []

    def set_look(self, look: Look) -> None:
        self._look = look
        for scene in self._scenes:
            scene.set_look(look)

    def show(self, columns: Sequence[Column], lights: Sequence[Light] = PROGRAM) -> None:
        """Take these columns instead of the last ones."""
        while len(self._scenes) > len(columns):
            self._scenes.pop().show({})
            self._window.RemoveRenderer(self._renderers.pop())
        while len(self._scenes) < len(columns):
            renderer = vtkRenderer()
            self._window.AddRenderer(renderer)
            self._renderers.append(renderer)
            self._scenes.append(Scene(renderer, self._look))
        for place, (scene, renderer, column) in enumerate(zip(self._scenes, self._renderers, columns, strict=True)):
            renderer.SetViewport(place / len(columns), 0.0, (place + 1) / len(columns), 1.0)
            scene.set_shading(column.shading)
            scene.set_lights(lights)
            scene.set_background(None)
            scene.show({str(number): solid for number, solid in enumerate(column.solids)})

    def bounds(self) -> NDArray[np.float64] | None:
        """The box (2, 3) around what is shown."""
        return self._scenes[0].visible_bounds() if self._scenes else None

    def draw(self, camera: Camera, size: tuple[int, int]) -> list[NDArray[np.uint8]]:
        """A picture (height, width, 3) of this size for each column."""
        width, height = size
        self._window.SetSize(width * max(len(self._scenes), 1), height)
        bounds = self.bounds()
        for scene, renderer in zip(self._scenes, self._renderers, strict=True):
            scene.before_render(camera)
            apply(camera, renderer.GetActiveCamera(), bounds)
        self._window.Render()
        whole = pixels(self._window)[..., :3]
        return [np.ascontiguousarray(whole[:, i * width : (i + 1) * width]) for i in range(len(self._scenes))]

    def close(self) -> None:
        for scene in self._scenes:
            scene.show({})
        close(self._window)


@dataclass(frozen=True, slots=True, eq=False)
class Difference:
    """Of two pictures: their distances (height, width) in grey levels, of the channel that differs most."""

    levels: NDArray[np.uint8]

    @property
    def greatest(self) -> int:
        return int(self.levels.max(initial=0))

    def share(self, over: int = 2) -> float:
        """The share of the pixels, 0 to 1, that differ by more."""
        return float((self.levels > over).mean()) if self.levels.size else 0.0

    def picture(self) -> NDArray[np.uint8]:
        """(height, width, 3) black where both are the same, white where they differ most, by FAINT levels at least."""
        scaled = self.levels.astype(float) * (255.0 / max(self.greatest, FAINT))
        return np.repeat(np.rint(scaled).astype(np.uint8)[..., None], 3, axis=2)


def difference(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> Difference:
    """Of two pictures (height, width, 3) of one size."""
    return Difference(np.abs(one.astype(np.int16) - other).max(axis=2).astype(np.uint8))
