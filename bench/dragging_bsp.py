"""How many pictures a drag shows with a BSP tree, against the z-buffer in the same run and window.

One of twenty parts that cross one another is dragged by its arrow, by turns in both modes, while a thread sends the
pointer's moves as in `dragging`. Exits with 1 where the BSP tree shows less than half of the pictures; what is drawn
with the z-buffer, because there is no tree in time, does not count.
"""

from __future__ import annotations

import sys
import tempfile
import time

import numpy as np
from pointer import opened, swing, until

SECONDS, WARM = 6.0, 2.0  # of a drag, and those at its beginning that do not count: what stays is being sorted
ROUNDS = 2
BOUND = 0.5
PARTS = 20


def parts():
    """Blocks with a hole, a knob and a bar; the same triangles at any tolerance."""
    from solidtree.model.script import box, cylinder, document_of, sphere

    rng = np.random.default_rng(20)

    def part():
        block = box(10, 8, 6).at(-5, -4, -3) - cylinder(radius=2, height=20, segments=64).at(0, 0, -10)
        knob, bar = sphere(3.2, segments=56).at(4, 2, 2), cylinder(radius=1, height=16, segments=48).at(-3, -2, -8)
        x, y, z = rng.uniform(0, 360, 3)
        return (block + knob + bar).turned(x=x).turned(y=y).turned(z=z).at(*rng.uniform(-12, 12, 3))

    return document_of(*(part() for _ in range(PARTS)))


class Drags:
    """One window, and the drags in it."""

    def __init__(self, home: str) -> None:
        self.window, _ = opened(parts(), home)
        window = self.window
        self.root = window.session.document.solids[0]
        window.handles.set_snapping(False)
        window.session.select([self.root.id])

    @property
    def triangles(self) -> int:
        assert self.window.viewport.viewer is not None
        return sum(len(mesh.triangles) for mesh in self.window.viewport.viewer.scene.meshes.values())

    def rate(self, mode: str) -> tuple[float, float, float]:
        """Pictures a second, of them with another mesh, and of those the share that was drawn in the tree's order."""
        from solidtree.render.camera import project

        window, hidden = self.window, self.window.hidden_surfaces
        viewport, viewer = window.viewport, window.viewport.viewer
        assert viewer is not None
        hidden.set_mode(mode)
        start = time.perf_counter()
        until(lambda: time.perf_counter() > start + 2.0 and hidden.at_rest and not window.evaluation.waiting)
        middle = self.root.placement.matrix()[:, 3]
        ends = project(viewer.camera, [middle, middle + np.array((1.0, 0.0, 0.0))], viewer.size)[:, :2]
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        grip = ends[0] + 60.0 * along
        pictures: list[float] = []
        fresh: list[tuple[float, bool]] = []
        seen = viewport.view_changed.connect(lambda: pictures.append(time.perf_counter()))
        shown = window.evaluation.shown.connect(lambda *_: fresh.append((time.perf_counter(), viewer.painting)))
        start = swing(window, grip, along, SECONDS)
        window.handles.cancel()
        viewport.view_changed.disconnect(seen)
        window.evaluation.shown.disconnect(shown)
        begin, end, span = start + WARM, start + SECONDS, SECONDS - WARM
        counted = len([at for at in pictures if begin < at < end])
        painted = [painting for at, painting in fresh if begin < at < end]
        return counted / span, len(painted) / span, sum(painted) / max(len(painted), 1)

    def close(self) -> None:
        self.window.session.mark_saved(self.window.session.document)
        self.window.close()


def main() -> int:
    from solidtree.gui.application import make_application
    from solidtree.model.partition import native

    application = make_application()
    home = tempfile.TemporaryDirectory(prefix="solidtree-bench-")
    drags = Drags(home.name)
    rates: dict[str, list[tuple[float, float, float]]] = {"zbuffer": [], "bsp": []}
    for _ in range(ROUNDS):
        for mode, seen in rates.items():
            seen.append(drags.rate(mode))
    print(f"dragging one of {PARTS} crossing parts, {drags.triangles:,} triangles, {native.describe()}")
    print(f"{'':12} {'pictures a second':>18} {'with another mesh':>18} {'in order of the tree':>20}")
    means = {mode: np.mean(seen, axis=0) for mode, seen in rates.items()}
    for mode, (pictures, meshes, painting) in means.items():
        print(f"{mode:12} {pictures:18.1f} {meshes:18.1f} {painting:20.0%}")
    ratio = float(means["bsp"][1] * means["bsp"][2] / means["zbuffer"][1])
    print(f"those in order of the tree against z-buffer: {ratio:.2f} (at least {BOUND})")
    drags.close()
    del application
    return 0 if ratio >= BOUND else 1


if __name__ == "__main__":
    sys.exit(main())
