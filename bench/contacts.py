"""How long the contacts of a part that is dragged among 100 take: against a bare redraw of the same scene, same run.

A part is dragged through 99 others by its arrow in the real window, in each way of it: contacts are only shown, or the
part stops or slides. Timed is all that contacts add to a move of the pointer, marks and words included. The peer is a
window of VTK's alone, of the same size on the same display, with the meshes of these parts, which does nothing but
redraw. The last row is the answer alone for many places on a way through all of them.
"""

from __future__ import annotations

import tempfile
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from pointer import opened, swing, until

if TYPE_CHECKING:
    from solidtree.gui.tools.drag_contacts import Mode
    from solidtree.model.document.document import Document
    from solidtree.model.solid.display import DisplayMesh
    from solidtree.render.camera import Camera

SECONDS = 6.0
SIDE, STEP = 10, 16.0
PLACES = 400


def parts() -> Document:
    """100 parts side by side, each of some thousand triangles, that nearly touch."""
    from solidtree.model.script import box, cylinder, document_of, sphere

    kinds = (
        lambda: sphere(7.9, segments=48),
        lambda: box(15.6, centred=True) - cylinder(radius=5, height=40, segments=256).at(0, 0, -20),
        lambda: cylinder(radius=7.8, height=12, segments=256).at(0, 0, -6) + sphere(6, segments=32).at(0, 0, 5),
    )
    return document_of(
        **{
            f"part {i} {j}": kinds[(i + j) % 3]().at(STEP * i, STEP * j, 3.0 * ((i * j) % 3))
            for i in range(SIDE)
            for j in range(SIDE)
        }
    )


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """What the window showed at the end, and its size in pixels."""

    meshes: dict[str, DisplayMesh]
    camera: Camera
    size: tuple[int, int]


def dragged(document: Document, mode: Mode) -> tuple[list[float], list[int], View]:
    """Seconds that contacts took at each move and how many there were."""
    from solidtree.render.camera import project

    home = tempfile.TemporaryDirectory(prefix="solidtree-bench-")
    window, viewer = opened(document, home.name)
    contacts = window.handles.contacts
    contacts.set_mode(mode)
    root = document.solids[5 * SIDE + 5]
    window.session.select([root.id])
    start = time.perf_counter()
    until(lambda: time.perf_counter() > start + 2.0)
    taken: list[float] = []
    counts: list[int] = []
    hold, follow = contacts.hold, contacts.follow

    def timed_hold() -> None:
        begin = time.perf_counter()
        hold()
        taken.append(time.perf_counter() - begin)

    def timed_follow() -> None:
        begin = time.perf_counter()
        follow()
        contacts.words()
        if taken:
            taken[-1] += time.perf_counter() - begin
            counts.append(len(contacts.found))

    contacts.hold, contacts.follow = timed_hold, timed_follow  # type: ignore[method-assign]
    place = root.placement.matrix()[:, 3]
    ends = project(viewer.camera, [place, place + (1.0, 0.0, 0.0)], viewer.size)[:, :2]  # noqa: RUF005
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    swing(window, ends[0] + 60.0 * along, along, SECONDS)
    view = View(viewer.scene.solid_meshes, viewer.camera, viewer.window.GetSize())
    window.handles.cancel()
    window.session.mark_saved(window.session.document)
    window.close()
    return taken, counts, view


def alone(document: Document, meshes: dict[str, DisplayMesh]) -> tuple[list[float], list[int]]:
    """Seconds of the contacts of one place after the other, and how many there were."""
    from solidtree.model.proximity.live import LiveContacts
    from solidtree.model.proximity.parts import Part

    key = document.solids[5 * SIDE + 5].id
    made = {one: Part(one, mesh.vertices, mesh.corners) for one, mesh in meshes.items()}
    live = LiveContacts([part for one, part in made.items() if one != key], [made[key]], reach=2.0)
    taken, counts = [], []
    for share in np.linspace(-1.0, 1.0, PLACES):
        pose = np.eye(4)
        pose[:2, 3] = 4.5 * STEP * np.array([share, np.sin(3.0 * share)])
        start = time.perf_counter()
        counts.append(len(live.contacts(pose)))
        taken.append(time.perf_counter() - start)
    return taken, counts


def bare(view: View) -> list[float]:
    """Seconds of each redraw of a window of VTK's alone, without the smoothing that it has by itself."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

    from solidtree.render.camera import apply
    from solidtree.render.polydata import surface_of

    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetMultiSamples(0)
    window.SetSize(*view.size)
    window.AddRenderer(renderer)
    for mesh in view.meshes.values():
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputData(surface_of(mesh))
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
    boxes = np.array([mesh.bounds for mesh in view.meshes.values()])
    bounds = np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
    apply(view.camera, renderer.GetActiveCamera(), bounds)
    window.Render()
    found: list[float] = []
    end = time.perf_counter() + SECONDS / 2
    while time.perf_counter() < end:
        start = time.perf_counter()
        window.Render()
        found.append(time.perf_counter() - start)
    window.Finalize()
    return found


def row(title: str, taken: list[float], counts: list[int], redraw: float) -> None:
    median, high = np.median(taken), np.quantile(taken, 0.95)
    print(
        f"{title:8} {len(taken):6} {np.mean(counts):9.1f} {1000 * redraw:6.1f} ms {1000 * median:6.2f} ms "
        f"{1000 * high:6.2f} ms   {median / redraw:.3f} {high / redraw:.3f}"
    )


def main() -> None:
    from solidtree.gui.application import make_application

    application = make_application()
    document = parts()
    print(f"{'':8} {'moves':>6} {'contacts':>9} {'redraw':>9} {'median':>9} {'95 %':>9}   of the redraw")
    for mode in ("show", "stop", "slide"):
        taken, counts, view = dragged(document, mode)
        row(mode, taken, counts, float(np.median(bare(view))))
    redraw = float(np.median(bare(view)))
    row("alone", *alone(document, view.meshes), redraw)
    triangles = sum(len(mesh.triangles) for mesh in view.meshes.values())
    print(f"{len(view.meshes)} parts of {triangles:,} triangles, {view.size[0]} x {view.size[1]} pixels")
    del application


if __name__ == "__main__":
    main()
