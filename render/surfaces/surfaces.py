"""What the faces of a picture wear: a table of materials, the bitmaps in it, and the lights."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...model.document.errors import Refusal
from ...model.surface.bitmaps import texels_of
from ...model.surface.intensity import colour_of
from ...model.surface.light import MOST, PROGRAM, Light
from ...model.surface.mapping import KINDS
from ...model.surface.material import MOST_BITMAPS, SHADINGS, Material
from ..camera import frame
from . import shader as glsl
from .bitmaps import bitmap_texture, image_of, slopes_texture, texture_of
from .shadows import Shadows, casting

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkActor, vtkTexture

    from ...model.surface.appearance import Appearance
    from ..camera import Camera
    from ..look import Look

Key = tuple[Any, ...]


class Surfaces:
    """The looks of all faces of a picture by number. Nothing is drawn by any method here."""

    def __init__(self) -> None:
        self.lights: tuple[Light, ...] = PROGRAM
        self.shadows = Shadows()
        self._looks: dict[Appearance, int] = {}
        self._textures: dict[Key, vtkTexture] = {}
        self._slots: dict[Key, int] = {}
        self._table = texture_of(np.zeros((1, glsl.TEXELS, 4), np.float32))
        self._lights_corners = False
        self._made_for: tuple[object, ...] | None = None

    def numbers(self, looks: Iterable[Appearance]) -> NDArray[np.float32]:
        """(o,) the numbers of these looks; see `wear`."""
        return np.array([self._looks[look] for look in looks], np.float32)

    @property
    def frames(self) -> list[NDArray[np.float64]]:
        """(3, 4) of each number, from the world to the frame of the projection."""
        return [look.matrix for look in self._looks]

    @property
    def is_worn(self) -> bool:
        return any(look.material is not None for look in self._looks)

    def wear(self, looks: Iterable[Appearance], shading: str, look: Look) -> bool:
        """Put all looks of a picture into the table. Returns whether shaders have to be made anew."""
        wanted = dict.fromkeys(looks)
        made_for = (tuple(wanted), shading, look)
        if made_for == self._made_for:
            return False
        self._made_for = made_for
        self._looks = {one: number for number, one in enumerate(wanted)}
        before = self._slots, self._lights_corners
        self._choose_bitmaps()
        self._lights_corners = any(self._shading(one, shading).startswith("gouraud") for one in wanted)
        default = Material("default", ambient=look.ambient, diffuse=look.diffuse, specular=look.specular,
                           shininess=look.specular_power)  # fmt: skip
        rows = np.zeros((max(len(wanted), 1), glsl.TEXELS, 4), np.float32)
        for number, one in enumerate(wanted):
            rows[number] = self._row(one, one.material or default, shading)
        self._table.SetInputData(image_of(rows))
        return (self._slots, self._lights_corners) != before

    def translucent(self, looks: Iterable[Appearance]) -> bool:
        """Whether any of these looks lets light through."""
        return any(lets_light_through(look.material) for look in set(looks))

    def dress(self, actor: vtkActor, pieces: bool = False) -> None:
        """Light an actor's faces by the table; they have the vertex attributes POSITION and NUMBER, `pieces` of
        triangles those of whole triangles too."""
        _plain_material(actor)
        declarations = glsl.lights() + glsl.VERTEX_DECLARATIONS + glsl.DRESSED_VERTEX_DECLARATIONS
        vertex = glsl.DRESSED_VERTEX_PASSING + glsl.VERTEX_CLEAR
        if self._lights_corners:
            if pieces:
                declarations += glsl.PIECE_DECLARATIONS
                vertex += glsl.PIECE_LIGHTING % (("surfaceShininess",) * 3)
            else:
                vertex += glsl.VERTEX_LIGHTING % "surfaceShininess"
        fragment = glsl.lights(self.casting) + glsl.FRAGMENT_GOURAUD + glsl.dressed_declarations(len(self._slots))
        _replace(actor, declarations, vertex, fragment, glsl.FACE_NORMAL + glsl.DRESSED_LIGHTING)
        material = actor.GetProperty()
        material.SetTexture(glsl.TABLE, self._table)
        for key, slot in self._slots.items():
            material.SetTexture(f"{glsl.BITMAP}{slot}", self._textures[key])
        self._bind_shadows(actor)

    def shade(self, actor: vtkActor, shading: str, look: Look, pieces: bool = False) -> None:
        """Light an actor's faces, which wear no material, by one of SHADINGS, else ValueError. `pieces` of triangles
        have vertex attributes of the names CORNER_... for Gouraud's light."""
        check_shading(shading)
        _plain_material(actor)
        declarations = vertex = fragment = ""
        light = glsl.BY_FRAGMENT
        if shading == "flat":
            light = glsl.FACE_NORMAL + glsl.BY_FACE
        elif shading != "phong":
            declarations = glsl.lights() + glsl.VERTEX_DECLARATIONS + (glsl.PIECE_DECLARATIONS if pieces else "")
            power = f"{look.specular_power:.6f}"
            corner = glsl.PIECE_LIGHTING % ((power,) * 3) if pieces else glsl.VERTEX_LIGHTING % power
            vertex = glsl.VERTEX_CLEAR + corner
            fragment, light = glsl.FRAGMENT_GOURAUD, glsl.BY_VERTEX
        numbers = {
            "ambient": look.ambient,
            "diffuse": look.diffuse,
            "specular": 0.0 if shading == "gouraud-diffuse" else look.specular,
            "shininess": look.specular_power,
            "light": light,
        }
        _replace(actor, declarations, vertex, glsl.lights(self.casting) + fragment, glsl.PLAIN_LIGHTING % numbers)
        self._bind_shadows(actor)

    @property
    def casting(self) -> tuple[int, ...]:
        """See `shadows.casting`; shaders have to be made anew where it changes."""
        return casting(self.lights)

    def _bind_shadows(self, actor: vtkActor) -> None:
        for number in range(len(self.casting)):
            actor.GetProperty().SetTexture(f"{glsl.SHADOW}{number}", self.shadows.textures[number])

    def turn(self, actors: Iterable[vtkActor], camera: Camera) -> None:
        """Set the lights where they are for this camera."""
        # Rows of axes: the eye's x, y and z in the world.
        axes, eye = frame(camera), np.asarray(camera.position, float)
        around, lights = np.zeros(3), []
        for light in self.lights:
            if not light.active:
                continue
            if light.kind == "ambient":
                around += colour_of(light)
                continue
            point = light.kind == "point"
            vector = np.array(light.position) if point else -np.array(light.direction)
            if not light.with_camera:
                vector = axes @ (vector - eye if point else vector)
            lights.append(((*vector.tolist(), float(point)), colour_of(light).tolist()))
        unlit = [((0.0, 0.0, 1.0, 0.0), [0.0, 0.0, 0.0])] * (MOST - len(lights))
        for actor in actors:
            shader = actor.GetShaderProperty()
            for uniforms in (shader.GetVertexCustomUniforms(), shader.GetFragmentCustomUniforms()):
                uniforms.SetUniformi("surfaceLights", len(lights))
                uniforms.SetUniformi("surfaceParallel", int(camera.parallel))
                uniforms.SetUniform3f("surfaceAmbient", around.tolist())
                uniforms.SetUniform3f("surfaceEye", eye.tolist())
                uniforms.SetUniformMatrix3x3("surfaceToWorld", axes.reshape(-1).tolist())
                for number, (vector, glow) in enumerate(lights + unlit):
                    uniforms.SetUniform4f(f"surfaceLight{number}", vector)
                    uniforms.SetUniform3f(f"surfaceGlow{number}", glow)
            fragment = shader.GetFragmentCustomUniforms()
            for number in range(len(self.casting)):
                matrix = self.shadows.matrices[number].T  # GLSL reads it by columns
                fragment.SetUniformMatrix4x4(f"surfaceShadow{number}", matrix.reshape(-1).tolist())
                fragment.SetUniformf(f"surfaceOffset{number}", self.shadows.offsets[number])

    def _choose_bitmaps(self) -> None:
        """What cannot be shown is left out here; model/surface/faults.py tells of it."""
        textures: dict[Key, vtkTexture] = {}
        slots: dict[Key, int] = {}
        for key in (key for look in self._looks for key in _keys(look.material)):
            if key in slots or len(slots) == MOST_BITMAPS:
                continue
            try:
                textures[key] = self._textures.get(key) or _texture(key)
            except Refusal:
                continue
            slots[key] = len(slots)
        self._textures, self._slots = textures, slots

    @staticmethod
    def _shading(look: Appearance, shading: str) -> str:
        return (look.material.shading if look.material is not None else "") or shading

    def _row(self, look: Appearance, material: Material, shading: str) -> NDArray[np.float32]:
        slots = {key[0]: float(self._slots.get(key, -1)) for key in _keys(look.material)}
        affine = look.mapping.affine()
        mirrored = -1.0 if np.linalg.det(look.matrix[:, :3]) < 0.0 else 1.0
        return np.array([
            (material.ambient, material.diffuse, material.specular, material.shininess),
            (material.opacity, SHADINGS.index(self._shading(look, shading)), KINDS.index(look.kind), 0.0),
            (*(*look.extent, 1.0, 1.0, 1.0)[:3], mirrored),
            (*affine[0], slots.get("texture", -1.0)),
            (*affine[1], slots.get("bump", -1.0)),
            (float(material.bump_kind == "normals"), slots.get("reflection", -1.0), material.reflectivity,
             slots.get("light_map", -1.0)),
            (material.bump_height, 0.0, 0.0, 0.0),
            (0.0, 0.0, 0.0, 0.0),
        ], np.float32)  # fmt: skip


def check_shading(shading: str) -> None:
    """Raises ValueError for what is none of SHADINGS."""
    if shading not in SHADINGS:
        raise ValueError(f"no shading is called {shading!r}: take one of {', '.join(SHADINGS)}")


def lets_light_through(material: Material | None) -> bool:
    """Whether a material is translucent, by its opacity, or where its texture is."""
    if material is None:
        return False
    if material.opacity < 1.0:
        return True
    if not material.texture:
        return False
    try:
        return material.key is not None or bool((texels_of(material.texture)[..., 3] < 255).any())
    except Refusal:
        return False


def _plain_material(actor: vtkActor) -> None:
    material = actor.GetProperty()
    material.RemoveAllTextures()
    material.LightingOn()
    material.SetAmbient(0.0)
    material.SetDiffuse(1.0)  # so that the shader has the colour as it is
    material.SetSpecular(0.0)
    material.SetInterpolationToPhong()


def _replace(actor: vtkActor, declarations: str, vertex: str, fragment: str, lighting: str) -> None:
    shader = actor.GetShaderProperty()
    shader.ClearAllShaderReplacements()
    if declarations:
        shader.AddVertexShaderReplacement("//VTK::Normal::Dec", True, "//VTK::Normal::Dec\n" + declarations, False)
        shader.AddVertexShaderReplacement("//VTK::PositionVC::Impl", True, "//VTK::PositionVC::Impl\n" + vertex, False)
    shader.AddFragmentShaderReplacement("//VTK::Normal::Dec", True, "//VTK::Normal::Dec\n" + fragment, False)
    shader.AddFragmentShaderReplacement("//VTK::Light::Impl", True, lighting, False)
    for tag in ("TMap::Dec", "TCoord::Dec", "TCoord::Impl"):  # VTK would want coordinates for the textures
        shader.AddFragmentShaderReplacement(f"//VTK::{tag}", True, "", False)


def _keys(material: Material | None) -> Sequence[Key]:
    """What bitmaps a material wants: what for, of which asset, how."""
    if material is None:
        return ()
    found: list[Key] = []
    if material.texture:
        found.append(("texture", material.texture, material.wrap, material.key))
    if material.bump:
        found.append(("bump", material.bump, material.bump_kind, material.wrap))
    if material.reflection:
        found.append(("reflection", material.reflection, "repeat", None))
    if material.light_map:
        found.append(("light_map", material.light_map, material.wrap, None))
    return found


def _texture(key: Key) -> vtkTexture:
    what, *how = key
    return slopes_texture(*how) if what == "bump" else bitmap_texture(*how)
