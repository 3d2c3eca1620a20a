"""What Apply does with a matrix of the Pipeline panel: the camera moves, or the node is placed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.pipeline.matrices import CLOSE, eye_of, lens_of
from .subject import placed_by

if TYPE_CHECKING:
    from ...model.pipeline.matrices import Matrices
    from ...model.pipeline.stages import Floats
    from ...model.solid.places import Place
    from ..window import MainWindow


def apply_matrix(window: MainWindow, name: str, matrix: Floats, live: Matrices, place: Place | None) -> None:
    """Make it so: `live` are the picture's matrices, `place` is the vertex's node's. Raises Refusal."""
    if name == "model" and place is not None:
        _place(window, matrix, place)
    elif name == "view":
        _move_eye(window, matrix)
    elif name == "projection":
        _set_lens(window, matrix, live)


def _place(window: MainWindow, matrix: Floats, place: Place) -> None:
    node = find(window.session.document, place.node.id)
    steps = placed_by(place, node.placement, matrix).steps
    window.session.do("place", node.id, *steps, label=f"Place {node.label} by a matrix")


def _move_eye(window: MainWindow, matrix: Floats) -> None:
    from ...render.pipeline import camera_like

    viewer = window.viewport.viewer
    position, axes = eye_of(matrix)
    if viewer is not None:
        window.viewport.move_to(camera_like(viewer.camera, position, axes))


def _set_lens(window: MainWindow, matrix: Floats, live: Matrices) -> None:
    from dataclasses import replace

    lens, old = lens_of(matrix), lens_of(live.projection)
    if abs(lens.aspect / old.aspect - 1.0) > CLOSE:
        raise Refusal("the picture is as wide and as high as its window is: change entries 1, 1 and 2, 2 by one factor")
    window.looks.set_parallel(lens.angle is None)
    moved = not np.allclose((lens.near, lens.far), (old.near, old.far), rtol=CLOSE)

    def turn(viewer) -> None:
        changes = {"parallel_scale": lens.half_height} if lens.angle is None else {"view_angle": lens.angle}
        viewer.set_camera(replace(viewer.camera, **changes))

    window.viewport.change(turn)
    if moved:
        window.looks.set_clipping((lens.near, lens.far))
