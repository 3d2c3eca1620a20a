"""Pictures off screen: solids as pixels, as numbered pixels, and as a PNG file."""

from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from ..model.surface.light import PROGRAM
from .camera import Camera, apply
from .ground import Ground
from .look import Look, check_hidden_surface, look_of
from .painter.painter import Painter
from .polydata import set_cell_colours, surface_of
from .scene import Scene
from .shading import unlit
from .surfaces.surfaces import lets_light_through
from .views import camera_of
from .window import close, offscreen_window, pixels

if TYPE_CHECKING:
    from ..model.document.document import Section
    from ..model.partition.tree import Tree
    from ..model.solid.display import DisplayMesh
    from ..model.surface.light import Light

SAMPLES = 8
LAST_NUMBER = 2**24 - 1


def picture(
    solids: Sequence[tuple["DisplayMesh", Any]],
    size: tuple[int, int] = (1200, 800),
    view: "Camera | str" = "iso",
    *,
    style: str = "shaded",
    shading: str = "phong",
    opacity: float = 1.0,
    background: Any = None,
    perspective: float | None = 30.0,
    look: Look | str = "light",
    ground: bool = False,
    sections: "Sequence[Section]" = (),
    hidden_surface: str = "zbuffer",
    lights: "Sequence[Light]" = PROGRAM,
) -> NDArray[np.uint8]:
    """Solids as (mesh, colours) pairs, see `Scene.show`, in one picture (height, width, 3) of sRGB bytes.

    `view` is a camera, taken as it is, or the name of a view, fitted to the solids with the full vertical angle
    `perspective` in degrees, or in parallel projection for None. `background` is a colour, None for the look's
    gradient, or "transparent", which gives a fourth channel with alpha (colours not multiplied by it). The active
    ones of `sections` open the solids. `hidden_surface` is one of look.HIDDEN_SURFACES; with "bsp" a tree is built.
    `lights` see `lights_of`.
    Raises ValueError for a size, style, shading, opacity, hidden surface or view that does not exist, Refusal for such
    a colour.
    """
    clear = background == "transparent"
    looks = {look for _, colours in solids for look in getattr(colours, "looks", ())}
    translucent = opacity < 1.0 or any(lets_light_through(look.material) for look in looks)
    # VTK peels no multi-sampled depths: then 2 by 2 pixels make one.
    fine = 2 if translucent and hidden_surface != "bsp" else 1
    window = offscreen_window((fine * size[0], fine * size[1]), SAMPLES if fine == 1 else 0)
    try:
        renderer = vtkRenderer()
        window.AddRenderer(renderer)
        scene = Scene(renderer, look_of(look) if isinstance(look, str) else look)
        scene.set_style(style)
        scene.set_shading(shading)
        scene.set_opacity(opacity)
        scene.set_line_scale(fine)
        scene.set_background((0.0, 0.0, 0.0) if clear else background)
        renderer.SetBackgroundAlpha(0.0 if clear else 1.0)
        scene.set_sections(sections)
        scene.set_lights(lights)
        scene.show({str(number): solid for number, solid in enumerate(solids)})
        scene.set_hidden_surface(hidden_surface)
        if hidden_surface == "bsp":
            meshes = scene.solid_meshes
            scene.show_tree(_tree(list(meshes.values())), tuple(meshes))
        bounds = scene.visible_bounds()
        camera = _camera(view, bounds, size, perspective)
        height = None
        if ground:
            plane = Ground(renderer, scene.look)
            scene.painter.over_ground()
            plane.set_line_scale(fine)
            plane.update(camera)
            bounds = union(bounds, plane.bounds)
            height = plane.height
        scene.before_render(camera, height)
        apply(camera, renderer.GetActiveCamera(), bounds)
        window.Render()
        result = _averaged(pixels(window), fine)
    finally:
        close(window)
    return _unmultiplied(result) if clear else np.ascontiguousarray(result[..., :3])


def ids_picture(
    meshes: Sequence["DisplayMesh"],
    size: tuple[int, int] = (1200, 800),
    view: "Camera | str" = "iso",
    *,
    numbers: Sequence[NDArray[Any]] | None = None,
    perspective: float | None = 30.0,
    hidden_surface: str = "zbuffer",
) -> NDArray[np.uint8]:
    """Which solid each pixel shows: (height, width, 3) bytes that spell its number as 0xRRGGBB, background 0.

    Without light, smoothing and anti-aliasing. The first mesh has number 1; `numbers` gives instead a number from 0 to
    2**24 - 1 for each triangle (t,) of each mesh. `view`, `perspective` and `hidden_surface` as in `picture`. Raises
    ValueError as there, and for numbers that do not fit.
    """
    window = offscreen_window(size)
    try:
        renderer = vtkRenderer()
        window.AddRenderer(renderer)
        window.SetUseSRGBColorSpace(False)
        renderer.SetBackground(0.0, 0.0, 0.0)
        if numbers is None:
            numbers = [np.full(len(mesh.triangles), index, np.int64) for index, mesh in enumerate(meshes, 1)]
        colours = [_number_colours(mesh, np.asarray(values)) for mesh, values in zip(meshes, numbers, strict=True)]
        bounds = None
        for mesh in meshes:
            if len(mesh.triangles):
                bounds = union(bounds, np.reshape(mesh.bounds, (2, 3)))
        camera = _camera(view, bounds, size, perspective)
        check_hidden_surface(hidden_surface)
        if hidden_surface == "bsp":
            painter = Painter(renderer)
            painter.show(_tree(meshes), meshes)
            painter.colour(np.concatenate([*colours, np.zeros((0, 3), np.uint8)]))
            painter.turn(camera, opaque=True, cull=True)
            _dress_numbered(painter.actor)
        else:
            for mesh, values in zip(meshes, colours, strict=True):
                if len(mesh.triangles):
                    renderer.AddActor(_numbered(mesh, values))
        apply(camera, renderer.GetActiveCamera(), bounds)
        window.Render()
        return np.ascontiguousarray(pixels(window)[..., :3])
    finally:
        close(window)


def facet_numbers(meshes: Sequence["DisplayMesh"]) -> list[NDArray[np.int64]]:
    """Numbers for `ids_picture` that count the planar facets through all meshes, from 1."""
    result, last = [], 0
    for mesh in meshes:
        _, numbers = np.unique(mesh.facet, return_inverse=True)
        result.append(numbers.reshape(-1).astype(np.int64) + 1 + last)
        last = int(result[-1].max(initial=last))
    return result


def numbers_of(ids: NDArray[np.uint8]) -> NDArray[np.int64]:
    """The numbers (height, width) that an ids picture (height, width, 3) spells."""
    return ids.astype(np.int64) @ np.array([65536, 256, 1])


def write_png(path: str | PathLike[str], array: NDArray[np.uint8]) -> None:
    """Write (height, width, 1, 3 or 4) bytes, first row on top. Raises ValueError for another shape, else OSError."""
    from vtkmodules.vtkIOImage import vtkPNGWriter

    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or array.dtype != np.uint8:
        raise ValueError(f"a picture is (height, width, 1, 3 or 4) bytes, not {array.shape} {array.dtype}")
    height, width, channels = array.shape
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.flipud(array).reshape(-1, channels), deep=True))
    writer = vtkPNGWriter()
    writer.SetWriteToMemory(True)
    writer.SetInputData(image)
    writer.Write()
    with open(path, "wb") as file:
        file.write(vtk_to_numpy(writer.GetResult()).tobytes())


def union(a: NDArray[Any] | None, b: NDArray[Any] | None) -> NDArray[np.float64] | None:
    """The box (2, 3) around two boxes, of which either may be None."""
    if a is None or b is None:
        return b if a is None else a
    return np.array([np.minimum(a[0], b[0]), np.maximum(a[1], b[1])], float)


def _camera(view: "Camera | str", bounds: Any, size: tuple[int, int], perspective: float | None) -> Camera:
    if isinstance(view, Camera):
        return view
    return camera_of(bounds, size[0] / size[1], view, perspective=perspective)


def _tree(meshes: Sequence["DisplayMesh"]) -> "Tree":
    from ..model.partition.build import build
    from ..model.partition.faces import faces_of_meshes

    return build(faces_of_meshes(meshes))


def _number_colours(mesh: "DisplayMesh", values: NDArray[Any]) -> NDArray[np.uint8]:
    if values.shape != (len(mesh.triangles),):
        raise ValueError(f"{len(mesh.triangles)} triangles need as many numbers, not {values.shape}")
    if len(values) and not 0 <= values.min() <= values.max() <= LAST_NUMBER:
        raise ValueError(f"numbers in pictures lie between 0 and {LAST_NUMBER}")
    whole = values.astype(np.int64)
    return np.column_stack([whole >> 16, whole >> 8 & 255, whole & 255]).astype(np.uint8)


def _numbered(mesh: "DisplayMesh", colours: NDArray[np.uint8]) -> vtkActor:
    surface = surface_of(mesh)
    surface.GetPointData().SetNormals(None)
    set_cell_colours(surface, colours)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    actor = vtkActor()
    actor.SetMapper(mapper)
    _dress_numbered(actor)
    return actor


def _dress_numbered(actor: vtkActor) -> None:
    """Colours as they are, depths as well."""
    actor.GetMapper().SetResolveCoincidentTopologyToOff()
    unlit(actor)
    actor.GetProperty().SetInterpolationToFlat()


def _averaged(colours: NDArray[np.uint8], fine: int) -> NDArray[np.uint8]:
    if fine == 1:
        return colours
    height, width, channels = colours.shape
    blocks = colours.reshape(height // fine, fine, width // fine, fine, channels)
    return np.round(blocks.mean(axis=(1, 3))).astype(np.uint8)


def _unmultiplied(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Samples without a surface are black and clear: divide what is left by its share."""
    alpha = colours[..., 3:].astype(float)
    plain = np.divide(255.0 * colours[..., :3], alpha, out=np.zeros(colours[..., :3].shape), where=alpha > 0.0)
    return np.concatenate([np.clip(np.round(plain), 0, 255).astype(np.uint8), colours[..., 3:]], axis=2)
