"""How many pictures a second a revolved vase shows while a control point of its profile is dragged: against bare VTK.

The point is dragged in the real window, while a thread sends the pointer's moves 125 times a second. The peer is a
window of VTK's alone, of the same size on the same display, with one actor: the vase that the drag ended with, and it
does nothing but redraw.
"""

from __future__ import annotations

import tempfile
import time

import numpy as np
from dragging import SECONDS, bare
from pointer import opened, swing, until

PROFILE = [(0, 0), (14, 0), (18, 10), (6, 24), (10, 40), (11, 44), (9, 44), (8, 40), (4, 24), (15, 10), (10, 3), (0, 3)]
POINT = 2  # the belly


def dragged() -> tuple[float, float, tuple[int, int], object, object]:
    """Pictures and fresh meshes a second, and size, mesh and camera of the window at the end."""
    from solidtree.model.outline.frames import frame_of
    from solidtree.model.script import bspline, document_of, revolve
    from solidtree.render.camera import project

    home = tempfile.TemporaryDirectory(prefix="solidtree-bench-")
    document = document_of(vase=revolve(bspline(PROFILE)))
    window, viewer = opened(document, home.name)
    viewport = window.viewport
    (root,) = document.solids
    (profile,) = root.children
    window.session.select([profile.id])
    viewport.look_from("front")
    start = time.perf_counter()
    until(lambda: time.perf_counter() > start + 2.0)  # the view turns, and the worker gets ready

    frame = frame_of(document, profile.id)
    point = frame[:, :2] @ PROFILE[POINT] + frame[:, 3]
    grip = project(viewer.camera, [point], viewer.size)[0, :2]
    meshes: list[float] = []
    pictures: list[float] = []
    viewport.view_changed.connect(lambda: pictures.append(time.perf_counter()))
    window.evaluation.shown.connect(lambda *_: meshes.append(time.perf_counter()))
    start = swing(window, grip, np.array([1.0, 0.0]), SECONDS)
    rates = [
        len([t for t in times if start + 0.5 < t < start + SECONDS]) / (SECONDS - 0.5) for times in (pictures, meshes)
    ]
    mesh, camera, size = viewer.scene.meshes[root.id], viewer.camera, viewer.window.GetSize()
    window.session.cancel()
    window.session.mark_saved(window.session.document)
    window.close()
    return rates[0], rates[1], size, mesh, camera


def main() -> None:
    from solidtree.gui.application import make_application

    application = make_application()
    assert application
    pictures, fresh, size, mesh, camera = dragged()
    usual, plain = bare(size, mesh, camera, None), bare(size, mesh, camera, 0)
    print(f"dragging a control point of a vase, {size[0]} x {size[1]} pixels, {len(mesh.triangles):,} triangles")  # type: ignore[attr-defined]
    print(f"{'':44} {'a second':>9} {'of bare VTK':>12} {'not smoothed':>13}")
    print(f"{'bare VTK window, redrawing':44} {usual:9.1f} {1:12.2f} {'':>13}")
    print(f"{'bare VTK window, not smoothed':44} {plain:9.1f} {plain / usual:12.2f} {1:13.2f}")
    for title, rate in (("pictures of the drag", pictures), ("of them with another vase", fresh)):
        print(f"{title:44} {rate:9.1f} {rate / usual:12.2f} {rate / plain:13.2f}")


if __name__ == "__main__":
    main()
