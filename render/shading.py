"""Flat, Gouraud and Phong shading of an actor.

VTK lights every fragment, so that its "Gouraud" is Phong. Here Gouraud's own method (1971) is a pair of shader
replacements: light is computed at the vertices and interpolated, the surface colour is multiplied in afterwards. The
eye is taken to be at infinity, as the fixed pipeline did.
"""

from typing import TYPE_CHECKING

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (without its factory an actor has no shader property)

from .look import LIGHTS, Look

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkActor

_VERTEX_DECLARATIONS = """//VTK::Normal::Dec
out vec4 gouraudFront;  // rgb: diffuse, a: specular
out vec4 gouraudBack;
vec4 gouraudLight(vec3 normal, float power)
{
  vec4 sum = vec4(0.0);
%s
  return sum;
}
"""
_VERTEX_LIGHT = """  {
    vec3 light = vec3(%.6f, %.6f, %.6f);
    float facing = max(0.0, dot(normal, light));
    float mirrored = facing > 0.0 ? max(0.0, reflect(-light, normal).z) : 0.0;
    sum += vec4(vec3(facing), pow(mirrored, power)) * %.6f;
  }"""
_VERTEX_LIGHTING = """//VTK::PositionVC::Impl
  vec3 gouraudNormal = normalize(normalMatrix * normalMC);
  gouraudFront = gouraudLight(gouraudNormal, %.6f);
  gouraudBack = gouraudLight(-gouraudNormal, %.6f);
"""
# A fragment's corner takes the light between those at the corners of the triangle that it is a piece of.
CORNER_NORMALS = ("cornerNormalA", "cornerNormalB", "cornerNormalC")
CORNER_WEIGHTS = "cornerWeights"
_PIECE_DECLARATIONS = "".join(f"in vec3 {name};\n" for name in (*CORNER_NORMALS, CORNER_WEIGHTS))
_PIECE_LIGHTING = """//VTK::PositionVC::Impl
  gouraudFront = vec4(0.0);
  gouraudBack = vec4(0.0);
""" + "".join(
    f"""  {{
    vec3 gouraudNormal = normalize(normalMatrix * {name});
    gouraudFront += {CORNER_WEIGHTS}.{weight} * gouraudLight(gouraudNormal, %.6f);
    gouraudBack += {CORNER_WEIGHTS}.{weight} * gouraudLight(-gouraudNormal, %.6f);
  }}
"""
    for name, weight in zip(CORNER_NORMALS, "xyz", strict=True)
)
_FRAGMENT_DECLARATIONS = """//VTK::Normal::Dec
in vec4 gouraudFront;
in vec4 gouraudBack;
"""
_FRAGMENT_LIGHTING = """
  vec4 gouraud = gl_FrontFacing ? gouraudFront : gouraudBack;
  fragOutput0 = vec4(ambientColor + gouraud.rgb * diffuseColor + gouraud.a * specularColor, opacity);
"""


def shade(actor: "vtkActor", shading: str, look: Look, pieces: bool = False) -> None:
    """Light an actor's faces: `shading` is "flat", "gouraud" or "phong", else ValueError.

    `pieces` of triangles have vertex attributes of the names above for Gouraud's light.
    """
    if shading not in ("flat", "gouraud", "phong"):
        raise ValueError(f"no shading is called {shading!r}: take flat, gouraud or phong")
    material = actor.GetProperty()
    material.LightingOn()
    material.SetAmbient(look.ambient)
    material.SetDiffuse(look.diffuse)
    material.SetSpecular(look.specular if shading != "flat" else 0.0)
    material.SetSpecularPower(look.specular_power)
    if shading == "flat":
        material.SetInterpolationToFlat()
    else:
        material.SetInterpolationToPhong()
    shader = actor.GetShaderProperty()
    shader.ClearAllShaderReplacements()
    if shading == "gouraud":
        lights = "\n".join(_VERTEX_LIGHT % (*_towards(light), strength) for light, strength in LIGHTS)
        power = look.specular_power
        declarations = (_PIECE_DECLARATIONS if pieces else "") + _VERTEX_DECLARATIONS % lights
        lighting = _PIECE_LIGHTING % ((power, power) * 3) if pieces else _VERTEX_LIGHTING % (power, power)
        shader.AddVertexShaderReplacement("//VTK::Normal::Dec", True, declarations, False)
        shader.AddVertexShaderReplacement("//VTK::PositionVC::Impl", True, lighting, False)
        shader.AddFragmentShaderReplacement("//VTK::Normal::Dec", True, _FRAGMENT_DECLARATIONS, False)
        shader.AddFragmentShaderReplacement("//VTK::Light::Impl", True, _FRAGMENT_LIGHTING, False)


def unlit(actor: "vtkActor") -> None:
    """Show an actor's colours as they are."""
    actor.GetShaderProperty().ClearAllShaderReplacements()
    material = actor.GetProperty()
    material.LightingOff()
    material.SetAmbient(0.0)
    material.SetDiffuse(1.0)
    material.SetSpecular(0.0)


def _towards(direction: tuple[float, float, float]) -> tuple[float, ...]:
    return tuple(np.asarray(direction) / np.linalg.norm(direction))
