"""What a camera's picture can show, as a convex set of points for pruning (see model.partition.cone)."""

import numpy as np
from numpy.typing import NDArray

from ..model.partition.cone import Cone
from .camera import Camera, frame, project, ray


def camera_cone(camera: Camera, size: tuple[float, float], box: NDArray[np.float64] | None = None) -> Cone:
    """The pyramid of a perspective view, or the prism of a parallel one; `size` in pixels.

    It is endless, the prism both ways, unless a box (2, 3) is given: then it ends where the box does.
    """
    width, height = size
    corners = [ray(camera, x, y, size) for x, y in ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))]
    origins, directions = (np.array(part) for part in zip(*corners, strict=True))
    if box is None:
        if camera.parallel:
            return Cone(origins, np.array([directions[0], -directions[0]]))
        return Cone(origins[:1], directions)
    places = np.stack(np.meshgrid(*np.reshape(box, (2, 3)).T), axis=-1).reshape(-1, 3)
    depths = project(camera, places, size)[:, 2]
    per_depth = directions / (directions @ -frame(camera)[2])[:, None]
    near = float(depths.min()) if camera.parallel else 0.0
    far = max(float(depths.max()), near)
    return Cone(np.concatenate((origins + near * per_depth, origins + far * per_depth)), np.zeros((0, 3)))
