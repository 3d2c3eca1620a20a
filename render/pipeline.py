"""The pipeline of a picture as matrices: what VTK does with its camera, as values."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..model.pipeline.matrices import Lens, Matrices
from ..model.pipeline.stages import view_matrix, viewport_matrix
from .camera import Camera, apply, frame, vector_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .viewer import Viewer


def matrices_of(camera: Camera, size: tuple[float, float], clipping: tuple[float, float]) -> Matrices:
    """Those of a camera in a picture of `size`, with the model's own left as it is; `clipping` are the distances of
    near and far plane before the eye, in mm."""
    angle = None if camera.parallel else camera.view_angle
    lens = Lens(angle, camera.half_height, size[0] / size[1], *clipping)
    return Matrices(np.eye(4), view_matrix(camera.position, frame(camera)), lens.matrix(), viewport_matrix(*size))


def shown_clipping(viewer: Viewer) -> tuple[float, float]:
    """Where the near and the far plane of the picture stood that was rendered last, in mm before the eye."""
    vtk_camera = viewer.renderer.GetActiveCamera()
    near, far = vtk_camera.GetClippingRange()
    shift = vtk_camera.GetDistance() - viewer.camera.distance  # in parallel projection VTK's eye stands farther back
    return near - shift, far - shift


def clipping_about(camera: Camera, bounds: NDArray[np.float64] | None) -> tuple[float, float]:
    """Where `camera.apply` puts near and far plane about a box (2, 3), in mm before the eye."""
    from vtkmodules.vtkRenderingCore import vtkCamera

    vtk_camera = vtkCamera()
    apply(camera, vtk_camera, bounds)
    shift = vtk_camera.GetDistance() - camera.distance
    near, far = vtk_camera.GetClippingRange()
    return near - shift, far - shift


def camera_like(camera: Camera, position: NDArray[np.float64], axes: NDArray[np.float64]) -> Camera:
    """The camera at another place, with other axes (3, 3) as rows, that looks as far as this one does."""
    target = position - axes[2] * camera.distance
    return replace(camera, position=vector_of(position), target=vector_of(target), up=vector_of(axes[1]))
