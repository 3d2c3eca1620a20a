"""What pictures look like: colours of the light and the dark theme, lights, styles."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..model.document.colours import rgb as colour_bytes
from ..model.surface.light import PROGRAM

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

    from ..model.solid.display import DisplayMesh
    from ..model.surface.appearance import Appearance

Colour = tuple[float, float, float]  # sRGB, 0 to 1

STYLES = ("shaded", "edges", "wireframe", "hidden-line")
HIDDEN_SURFACES = ("zbuffer", "bsp")
THEMES = ("light", "dark")

# Directions to the program's lights as seen from the camera (x right, y up, z towards the eye), and their strengths.
LIGHTS = tuple(
    (tuple(-part for part in light.direction), light.intensity) for light in PROGRAM if light.kind == "directional"
)


@dataclass(frozen=True, slots=True)
class Look:
    """Colours are "#rrggbb" in sRGB; `tint` multiplies a solid's colour where subtracted operands left the face."""

    name: str
    background_top: str
    background_bottom: str
    plain_background: str  # where faces must melt into it: hidden-line pictures
    solid: str
    tint: Colour
    selection: str
    hover: str
    edge: str  # on shaded faces
    line: str  # edges on the background: wireframe and hidden-line
    faint_edge: str  # triangle sides in wireframe
    grid_minor: str
    grid_major: str
    axis_x: str
    axis_y: str
    axis_z: str
    cube_face: str
    cube_text: str
    cube_hover: str
    ghost: str  # faces of operands that the result does not show
    ghost_line: str  # their edges and hatch
    cut: str  # half of the colour of cut faces
    grid_alpha: float = 0.30  # of minor lines; of major ones twice that
    ambient: float = 0.22
    diffuse: float = 0.9
    specular: float = 0.16
    specular_power: float = 24.0


LIGHT = Look(
    name="light",
    background_top="#dfe6ee",
    background_bottom="#f8f9fb",
    plain_background="#f5f7f9",
    solid="#a9b8c9",
    tint=(0.82, 0.88, 0.95),
    selection="#f08a24",
    hover="#6fb1f2",
    edge="#2b333d",
    line="#2b333d",
    faint_edge="#c5cdd6",
    grid_minor="#8fa0b4",
    grid_major="#71839a",
    axis_x="#cf6a62",
    axis_y="#69a867",
    axis_z="#5f86cc",
    cube_face="#eef1f5",
    cube_text="#4a5563",
    cube_hover="#8fc1f5",
    ghost="#86a0c2",
    ghost_line="#2d5487",
    cut="#ffffff",
)
DARK = Look(
    name="dark",
    background_top="#2b3038",
    background_bottom="#1c1f24",
    plain_background="#22262c",
    solid="#8d9db0",
    tint=(0.78, 0.85, 0.95),
    selection="#ff9f3f",
    hover="#5b9fe6",
    edge="#101317",
    line="#c9d2dc",
    faint_edge="#3d444e",
    grid_minor="#8894a3",
    grid_major="#a5b1c0",
    axis_x="#b0544e",
    axis_y="#548f55",
    axis_z="#4f74b5",
    cube_face="#3a424d",
    cube_text="#d5dce4",
    cube_hover="#3f78b5",
    ghost="#7d9cc4",
    ghost_line="#b9d2f2",
    cut="#1c1f24",
    grid_alpha=0.16,
)

# One colour per owner of a mesh (None: the solid's), as a sequence, an (owners, 3) array or a function of the index.
OwnerColours = Sequence["str | Colour | None"] | NDArray[Any] | Callable[[int], "str | Colour | None"] | None


@dataclass(frozen=True, slots=True)
class Paint:
    """The colours of one solid: its own (None: the look's) and those of its owners, by index (None: the solid's); and
    how the owners look, where any wears a material."""

    solid: str | Colour | None = None
    owners: tuple[str | Colour | None, ...] = ()
    looks: "tuple[Appearance, ...]" = ()


def check_hidden_surface(mode: str) -> None:
    """Raises ValueError for what is none of HIDDEN_SURFACES."""
    if mode not in HIDDEN_SURFACES:
        raise ValueError(f"hidden surfaces are removed by {' or '.join(HIDDEN_SURFACES)}, not by {mode!r}")


def look_of(theme: str) -> Look:
    """Raises ValueError for a theme that is neither light nor dark."""
    if theme not in THEMES:
        raise ValueError(f"no theme is called {theme!r}: take light or dark")
    return DARK if theme == "dark" else LIGHT


def rgb(colour: "str | Sequence[float] | NDArray[Any]") -> Colour:
    """A colour as three numbers from 0 to 1: a name or "#rrggbb" (raises Refusal), or three numbers, integers meaning
    0 to 255 (raises ValueError where they are not three)."""
    values = np.asarray(colour_bytes(colour) if isinstance(colour, str) else colour)
    if values.shape != (3,):
        raise ValueError(f"{colour!r} is no colour: three numbers are needed")
    red, green, blue = (float(value) / (255.0 if values.dtype.kind in "iu" else 1.0) for value in values)
    return red, green, blue


def mixed(colour: Colour, other: Colour, share: float) -> Colour:
    """`colour` with `share` (0 to 1) of `other` in it."""
    red, green, blue = (a + share * (b - a) for a, b in zip(colour, other, strict=True))
    return red, green, blue


def palette(mesh: "DisplayMesh", colours: "Paint | OwnerColours", look: Look) -> NDArray[np.float64]:
    """Colours (owners, 2, 3) from 0 to 1 by owner and by `subtracted`: a triangle's is palette[owner, subtracted].

    A face left by a subtracted owner without a colour of its own takes the solid's, tinted.
    """
    paint = colours if isinstance(colours, Paint) else Paint(None, _by_owner(mesh, colours))
    solid = rgb(look.solid if paint.solid is None else paint.solid)
    result = np.empty((max(len(mesh.owners), 1), 2, 3))
    result[:, 0] = solid
    result[:, 1] = np.multiply(solid, look.tint)
    for index, colour in enumerate(paint.owners[: len(mesh.owners)]):
        if colour is not None:
            result[index] = rgb(colour)
    return result


def _by_owner(mesh: "DisplayMesh", colours: OwnerColours) -> tuple[Any, ...]:
    if colours is None:
        return ()
    if callable(colours):
        return tuple(colours(index) for index in range(len(mesh.owners)))
    return tuple(colours)


def light_up(renderer: "vtkRenderer") -> None:
    """Replace the renderer's lights by LIGHTS, which follow the camera."""
    from vtkmodules.vtkRenderingCore import vtkLight

    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    for direction, strength in LIGHTS:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*direction)
        light.SetFocalPoint(0.0, 0.0, 0.0)
        light.SetIntensity(strength)
        renderer.AddLight(light)


def set_background(renderer: "vtkRenderer", look: Look, plain: bool = False, colour: Any = None) -> None:
    """The look's gradient or its plain colour; `colour` (see rgb) takes the place of both."""
    renderer.SetGradientBackground(colour is None and not plain)
    below = look.plain_background if plain else look.background_bottom
    renderer.SetBackground(*rgb(below if colour is None else colour))
    renderer.SetBackground2(*rgb(look.background_top))
