"""A bitmap of 1,000 by 1,000 pixels as a closed relief, beside manifold3d's bare import of the same mesh."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from manifold3d import Manifold, Mesh64
from PIL import Image

from solidtree.model.document.primitives import Relief
from solidtree.model.scripting.surfaces import kept
from solidtree.model.solid.relief import heights_of, lightness_of, relief_mesh, solid_of_relief

SIDE, RUNS = 1000, 3


def best(run: Callable[[], Manifold]) -> tuple[float, Manifold]:
    """The least time of some runs, in seconds, and what came of the last one."""
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        solid = run()
        solid.num_tri()
        times.append(time.perf_counter() - start)
    return min(times), solid


def main() -> None:
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    grey = 127.5 + 60 * np.sin(20 * x) * np.cos(14 * y) + 60 * np.random.default_rng(1).random((SIDE, SIDE)) - 30
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "relief.png")
        Image.fromarray(grey.astype(np.uint8)).save(path)
        node = Relief(asset=kept(path), samples=SIDE)

    def whole() -> Manifold:
        lightness_of.cache_clear()
        return solid_of_relief(node)

    points, triangles = relief_mesh(heights_of(node), 100.0, 5.0, 2.0)
    ours, solid = best(whole)
    bare, same = best(lambda: Manifold(Mesh64(points, triangles)))
    print(f"{SIDE} x {SIDE} pixels, {solid.num_tri():,} triangles, {solid.status().name}, genus {solid.genus()}")
    print(f"bitmap to solid  {ours:7.3f} s")
    print(f"bare import      {bare:7.3f} s    ratio {ours / bare:.2f}")
    assert abs(solid.volume() - same.volume()) < 1e-6 * same.volume()


if __name__ == "__main__":
    main()
