"""How many pictures a drag shows, and how long an input event waits: against a bare VTK window in the same run.

One hole of a plate with 100 holes is dragged by its arrow in the real window, while a thread sends the pointer's moves
125 times a second. The peer is a window of VTK's alone, of the same size on the same display, with one actor: the mesh
that the drag ended with, and it does nothing but redraw.
"""

from __future__ import annotations

import tempfile
import time

import numpy as np
from pointer import opened, swing, until
from PySide6.QtCore import QCoreApplication, QEvent, QObject
from PySide6.QtGui import QMouseEvent

SECONDS = 4.0


class Ear(QObject):
    """How long each move of the pointer waited before the viewport had it."""

    def __init__(self) -> None:
        super().__init__()
        self.sent: dict[int, float] = {}
        self.waits: list[float] = []

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseMove:
            sent = self.sent.pop(event.timestamp(), None)
            if sent is not None:
                self.waits.append(time.perf_counter() - sent)
        return False


def plate():
    from solidtree.model.script import box, cylinder, difference, document_of

    holes = [cylinder(radius=2, height=12).at(10 * i, 10 * j, -1) for i in range(10) for j in range(10)]
    return document_of(plate=difference(box(100, 100, 10).at(-5, -5, 0), *holes))


def dragged(application: QCoreApplication) -> tuple[float, float, list[float], tuple[int, int], object, object]:
    """Pictures and fresh meshes a second, waits in seconds, and size, mesh and camera of the window at the end."""
    from solidtree.render.camera import project

    home = tempfile.TemporaryDirectory(prefix="solidtree-bench-")
    document = plate()
    window, viewer = opened(document, home.name)
    viewport = window.viewport
    (root,) = document.solids
    hole = root.children[56]
    window.session.select([hole.id])
    start = time.perf_counter()
    until(lambda: time.perf_counter() > start + 2.0)  # the worker gets ready, as while a user looks for the handle

    x, y, _ = project(viewer.camera, [hole.placement.matrix()[:, 3]], viewer.size)[0]
    ahead, sideways, _ = project(viewer.camera, [hole.placement.matrix()[:, 3] + (1.0, 0.0, 0.0)], viewer.size)[0]
    along = np.array([ahead - x, sideways - y])
    along /= np.linalg.norm(along)
    grip = np.array([x, y]) + 60.0 * along
    meshes: list[float] = []
    pictures: list[float] = []
    viewport.view_changed.connect(lambda: pictures.append(time.perf_counter()))
    window.evaluation.shown.connect(lambda *_: meshes.append(time.perf_counter()))
    ear = Ear()
    viewport.installEventFilter(ear)

    start = swing(window, grip, along, SECONDS, ear.sent)
    rates = [
        len([t for t in times if start + 0.5 < t < start + SECONDS]) / (SECONDS - 0.5) for times in (pictures, meshes)
    ]
    mesh, camera, size = viewer.scene.meshes[root.id], viewer.camera, viewer.window.GetSize()
    window.handles.cancel()
    window.session.mark_saved(window.session.document)
    window.close()
    return rates[0], rates[1], ear.waits, size, mesh, camera


def bare(size: tuple[int, int], mesh: object, camera: object, samples: int | None) -> float:
    """Pictures a second of a window of VTK's alone; `samples` a pixel, None as VTK has it by itself."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

    from solidtree.render.camera import apply
    from solidtree.render.polydata import surface_of

    window, renderer = vtkRenderWindow(), vtkRenderer()
    if samples is not None:
        window.SetMultiSamples(samples)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(surface_of(mesh))  # type: ignore[arg-type]
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    apply(camera, renderer.GetActiveCamera(), mesh.bounds)  # type: ignore[arg-type, attr-defined]
    window.Render()
    count, start = 0, time.perf_counter()
    while time.perf_counter() < start + SECONDS / 2:
        window.Render()
        count += 1
    rate = count / (time.perf_counter() - start)
    window.Finalize()
    return rate


def main() -> None:
    from solidtree.gui.application import make_application

    application = make_application()
    pictures, fresh, waits, size, mesh, camera = dragged(application)
    usual, plain = bare(size, mesh, camera, None), bare(size, mesh, camera, 0)
    print(f"dragging one of 100 holes, {size[0]} x {size[1]} pixels, {len(mesh.triangles):,} triangles")  # type: ignore[attr-defined]
    print(f"{'':44} {'a second':>9} {'of bare VTK':>12} {'not smoothed':>13}")
    print(f"{'bare VTK window, redrawing':44} {usual:9.1f} {1:12.2f} {'':>13}")
    print(f"{'bare VTK window, not smoothed':44} {plain:9.1f} {plain / usual:12.2f} {1:13.2f}")
    for title, rate in (("pictures of the drag", pictures), ("of them with another mesh", fresh)):
        print(f"{title:44} {rate:9.1f} {rate / usual:12.2f} {rate / plain:13.2f}")
    order = np.sort(waits) * 1000
    print(
        f"{len(order)} moves waited {np.median(order):.1f} ms (median), {order[int(0.99 * len(order))]:.1f} ms (99 %), "
        f"{order[-1]:.1f} ms (longest)"
    )


if __name__ == "__main__":
    main()
