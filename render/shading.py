"""How the things of the window's own are lit: by VTK under the program's lights, or not at all.

The faces of solids are lit by surfaces/.
"""

from typing import TYPE_CHECKING

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (without its factory an actor has no shader property)

from .look import Look

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkActor


def shade(actor: "vtkActor", look: Look, flat: bool = False) -> None:
    """Light an actor's faces smoothly, or each by its own normal and without a highlight."""
    actor.GetShaderProperty().ClearAllShaderReplacements()
    material = actor.GetProperty()
    material.LightingOn()
    material.SetAmbient(look.ambient)
    material.SetDiffuse(look.diffuse)
    material.SetSpecular(0.0 if flat else look.specular)
    material.SetSpecularPower(look.specular_power)
    if flat:
        material.SetInterpolationToFlat()
    else:
        material.SetInterpolationToPhong()


def unlit(actor: "vtkActor") -> None:
    """Show an actor's colours as they are."""
    actor.GetShaderProperty().ClearAllShaderReplacements()
    material = actor.GetProperty()
    material.RemoveAllTextures()
    material.LightingOff()
    material.SetAmbient(0.0)
    material.SetDiffuse(1.0)
    material.SetSpecular(0.0)
