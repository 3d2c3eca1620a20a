"""Pictures of ids in the order of a BSP tree against those of the depth buffer: which pixels differ.

Ten models of the corpus, each from eight eyes, two of them inside. A pixel counts where no id changes within one pixel
of it. The corpus is found as in the tests: SOLIDTREE_CORPUS, else ../shared/corpus.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parent.parent
CORPUS = Path(os.environ.get("SOLIDTREE_CORPUS") or ROOT.parent / "shared" / "corpus")
SIZE = (700, 525)
WANTED = 0.0002
SOLIDS = (
    "Perturb3_nasty_gear", "Spiral_120_nested", "MultiCoplanar", "LazyCollider_r2", "BooleanVolumes_m1_or_m2_or_m4",
    "Subtract_thin_wedge",
)  # fmt: skip
MESHES = (
    "mesh/cork/ballA.off", "mesh/manifold/mengerSponge3.glb", "mesh/assimp/Wuson.off",
    "mesh/assimp/sphereWithHole.stl",
)  # fmt: skip


def models() -> Iterator[tuple[str, list]]:
    """Names, and the meshes that are shown."""
    from solidtree.model.document.document import Document
    from solidtree.model.exchange.meshes_in import read_any
    from solidtree.model.script import document_of
    from solidtree.model.solid.results import evaluate_document

    sys.path.insert(0, str(ROOT / "tests"))
    from csg_reader import read_csg

    def shown(document: Document) -> list:
        evaluation = evaluate_document(document, 0.05)
        return [mesh for result in evaluation.visible if (mesh := evaluation.display(result)) is not None]

    for name in SOLIDS:
        yield name, shown(document_of(part=read_csg((CORPUS / "boolean" / "csg" / f"{name}.csg").read_text())))
    for file in MESHES:
        yield Path(file).name, shown(read_any(CORPUS / file))


def eyes(bounds: np.ndarray) -> Iterator:
    """Six around the box, one of them parallel, and two inside."""
    from solidtree.render.camera import Camera

    rng = np.random.default_rng(12)
    middle, size = bounds.mean(axis=0), float(np.linalg.norm(np.ptp(bounds, axis=0)))
    for number in range(6):
        direction = rng.normal(size=3)
        eye = middle + 1.4 * size * direction / np.linalg.norm(direction)
        yield Camera(tuple(eye), tuple(middle), parallel=number == 5, view_angle=42.0, parallel_scale=0.55 * size)
    for _ in range(2):
        eye = bounds[0] + rng.uniform(0.2, 0.8, 3) * np.ptp(bounds, axis=0)
        yield Camera(tuple(eye), tuple(eye + rng.normal(size=3)), view_angle=80.0)


def bordering(numbers: np.ndarray) -> np.ndarray:
    edge = np.pad(numbers, 1, mode="edge")
    height, width = numbers.shape
    views = [edge[y : y + height, x : x + width] for y in range(3) for x in range(3)]
    return np.any([view != numbers for view in views], axis=0)


def main() -> int:
    from solidtree.render.picture import facet_numbers, ids_picture, numbers_of

    worst = 0.0
    print(f"{'model':32}{'triangles':>10}{'shown':>12}{'compared':>12}{'wrong':>8}{'s':>8}")
    for name, meshes in models():
        begin = time.perf_counter()
        bounds = np.array(
            [np.min([m.bounds[0] for m in meshes], axis=0), np.max([m.bounds[1] for m in meshes], axis=0)]
        )
        numbers = facet_numbers(meshes)
        shown = compared = wrong = 0
        for camera in eyes(bounds):
            depth, order = (
                numbers_of(ids_picture(meshes, SIZE, camera, numbers=numbers, hidden_surface=mode))
                for mode in ("zbuffer", "bsp")
            )
            inner = (depth > 0) & ~bordering(depth)
            shown += int((depth > 0).sum())
            compared += int(inner.sum())
            wrong += int((inner & (depth != order)).sum()) + int(((depth == 0) & (order > 0) & ~bordering(depth)).sum())
        worst = max(worst, wrong / max(compared, 1))
        count = sum(len(mesh.triangles) for mesh in meshes)
        print(f"{name:32}{count:10,}{shown:12,}{compared:12,}{wrong:8}{time.perf_counter() - begin:8.1f}")
    print(f"at worst {100 * worst:.4f} % of the pixels that are compared; wanted: at most {100 * WANTED:.2f} %")
    return int(worst > WANTED)


if __name__ == "__main__":
    sys.exit(main())
