"""What a drawing costs beside its BSP tree: faces really removed, hidden lines found, ratios within one run."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np
from manifold3d import CrossSection, FillRule

from solidtree.model.document.nodes import Node
from solidtree.model.drawing.drawing import Drawing, draw
from solidtree.model.drawing.projection import Projection, looking, standard
from solidtree.model.drawing.scene import Scene, scene_of
from solidtree.model.partition.build import build
from solidtree.model.script import box, cylinder, document_of, evaluate, sphere, union

MOST = 10.0
"""Times the build by NumPy that the menger sponge may take, and areas may differ by so much of the silhouette's."""
CLOSE = 1e-6


def menger(level: int) -> Node:
    """The sponge of Menger (1926), of side 3^level, drilled direction after direction."""
    side = 3.0**level
    bars = []
    for depth in range(level):
        step = side / 3 ** (depth + 1)
        starts = [(3 * i + 1) * step for i in range(3**depth)]
        bars += [box(step, step, side + 2).at(x, y, -1) for x in starts for y in starts]
    bar = union(*bars)
    return box(side) - bar - bar.turned(x=90).at(0, side, 0) - bar.turned(y=90).at(0, 0, side)


def plate(holes: int) -> Node:
    drills = [cylinder(2, 9, segments=64).at(5 + 6 * i, 5 + 6 * j, -2) for i in range(holes) for j in range(holes)]
    return box(6 * holes + 4, 6 * holes + 4, 5) - union(*drills)


def least(function: Callable[[], object], rounds: int = 3) -> float:
    found = []
    for _ in range(rounds):
        start = time.perf_counter()
        function()
        found.append(time.perf_counter() - start)
    return min(found)


def drawn_anew(scene: Scene, view: Projection, **options: bool) -> Drawing:
    """With its tree, which a scene otherwise keeps."""
    anew = Scene(scene.meshes, scene.closed, scene.layer_of, scene.solid_of, scene.layers)
    return draw(anew, view, **options)


def silhouette(scene: Scene, view: Projection) -> float:
    faces = scene.faces()
    flat = view.picture(faces.points)[:, :2]
    low, scale = flat.min(axis=0), 100.0 / np.ptp(flat, axis=0).max()
    corners = ((flat - low) * scale)[faces.corners.reshape(-1, 3)]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    turn = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    corners = np.where((turn < 0.0)[:, None, None], corners[:, ::-1], corners)[np.abs(turn) > 1e-12]
    return CrossSection(list(corners), FillRule.NonZero).area() / scale**2


def main() -> int:
    kept = True
    models = {
        "menger sponge, level 3": menger(3),
        "plate of 100 holes": plate(10),
        "two crossing spheres": union(sphere(10, segments=120), sphere(10, segments=120).at(7, 3, 2)),
    }
    print(f"{'':42} {'triangles':>9} {'build':>8} {'faces':>8} {'lines':>8} {'all':>8}   ratio    area off by")
    for name, solid in models.items():
        scene = scene_of(evaluate(document_of(solid)))
        faces, extent = scene.faces(), scene.extent
        middle, size = extent.mean(axis=0), np.linalg.norm(np.ptp(extent, axis=0))
        views = {
            "iso": standard("iso", extent),
            "perspective": looking(middle + size * np.array([0.5, -0.9, 0.6]), middle, perspective=50, aspect=None),
        }
        for word, view in views.items():
            building = least(lambda f=faces: build(f, compiled=False))
            scene.tree()
            areas = least(lambda s=scene, v=view: draw(s, v, hidden=False))
            lines = least(lambda s=scene, v=view: draw(s, v, faces=False))
            whole = least(lambda s=scene, v=view: drawn_anew(s, v))
            seen = sum(area.size for area in draw(scene, view).areas)
            off = abs(seen / silhouette(scene, view) - 1.0)
            print(
                f"{f'{name}, {word}':42} {faces.count:9,} {1e3 * building:6.0f}ms {1e3 * (areas - lines):6.0f}ms"
                f" {1e3 * lines:6.0f}ms {1e3 * whole:6.0f}ms {whole / building:7.1f}   {off:.1e}"
            )
            kept &= off < CLOSE and (whole / building <= MOST or not name.startswith("menger"))
    print(f"the sponge at most {MOST:g} times its build, areas within {CLOSE:g}: {'kept' if kept else 'BROKEN'}")
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
