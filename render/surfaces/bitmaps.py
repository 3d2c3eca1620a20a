"""Bitmaps as textures of the graphics card."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTexture

from ...model.surface.bitmaps import keyed, slopes_of, texels_of

WRAP = {"repeat": vtkTexture.Repeat, "mirror": vtkTexture.MirroredRepeat, "clamp": vtkTexture.ClampToEdge}


def bitmap_texture(sha: str, wrap: str = "repeat", key: str | None = None) -> vtkTexture:
    """The colours and alpha of an asset. Raises Refusal where it is missing or no bitmap."""
    return _smooth(texture_of(keyed(texels_of(sha), key)[::-1]), wrap)


def slopes_texture(sha: str, kind: str, wrap: str) -> vtkTexture:
    """The slopes of a bump map of height 1, see slopes_of. Raises Refusal."""
    slopes = slopes_of(texels_of(sha), kind, 1.0, wrap != "clamp")[::-1]
    return _smooth(texture_of(np.concatenate([slopes, np.zeros_like(slopes)], axis=2)), wrap)


def texture_of(texels: NDArray[Any]) -> vtkTexture:
    """Texels (height, width, channels), rows from the bottom up, bytes or single precision: not interpolated."""
    texture = vtkTexture()
    texture.SetInputData(image_of(texels))
    texture.SetColorModeToDirectScalars()
    texture.InterpolateOff()
    texture.MipmapOff()
    texture.SetWrap(vtkTexture.ClampToEdge)
    return texture


def image_of(texels: NDArray[Any]) -> vtkImageData:
    """Texels (height, width, channels), rows from the bottom up."""
    image = vtkImageData()
    image.SetDimensions(texels.shape[1], texels.shape[0], 1)
    flat = np.ascontiguousarray(texels).reshape(-1, texels.shape[2])
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    return image


def _smooth(texture: vtkTexture, wrap: str) -> vtkTexture:
    texture.InterpolateOn()
    texture.MipmapOn()
    texture.SetMaximumAnisotropicFiltering(1.0)  # llvmpipe's would ignore the gradients at seams
    texture.SetWrap(WRAP[wrap])
    return texture
