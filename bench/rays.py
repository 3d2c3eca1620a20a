"""100,000 rays through a BSP tree in one batch beside VTK's vtkModifiedBSPTree and vtkOBBTree, a call a ray.

All answer the same question, the first face on the ray; VTK's on 4,000 of the rays, per ray. A mismatch is a ray that
does not pass nearer to an edge than a millionth of the scene and has another first hit than one caster has.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonCore import reference, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersFlowPaths import vtkModifiedBSPTree
from vtkmodules.vtkFiltersGeneral import vtkOBBTree

from solidtree.model.document.nodes import Node
from solidtree.model.measuring.visibility import Eye, visibility
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import faces_of_meshes
from solidtree.model.partition.rays import Rays
from solidtree.model.script import box, cylinder, evaluate, linear_array, sphere, torus
from solidtree.model.solid.display import DisplayMesh
from solidtree.render.polydata import cells_of, vtk_array

RAYS, THEIRS, RUNS = 100_000, 4_000, 2
Floats = NDArray[np.float64]
T = TypeVar("T")


def scenes() -> dict[str, tuple[Node, ...]]:
    rng = np.random.default_rng(3)
    kinds = (sphere(5, segments=32), cylinder(4, 9, centred=True, segments=96) - cylinder(2, 12, centred=True),
             box(7, centred=True) - sphere(4, segments=48), torus(3.6, 1.4))  # fmt: skip
    return {
        "plate with a hole": (box(40, 30, 12) - cylinder(4, 40, centred=True).at(10, 10),),
        "plate with 60 holes": (
            box(120, 60, 8)
            - linear_array(
                linear_array(cylinder(3, 40, centred=True, segments=32).at(8, 8), 10, (11.5, 0, 0)), 6, (0, 9, 0)
            ),
        ),
        "ball": (sphere(10, segments=128),),
        "27 parts": tuple(
            kinds[k % 4].turned(*rng.uniform(0, 360, 3)).at(*(11.4 * np.array((k // 9, k // 3 % 3, k % 3))))
            for k in range(27)
        ),
    }


def best(run: Callable[[], T]) -> tuple[float, T]:
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        result = run()
        times.append(time.perf_counter() - start)
    return min(times), result


def surface_of(meshes: list[DisplayMesh]) -> vtkPolyData:
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(vtk_array(np.concatenate([mesh.vertices for mesh in meshes]), np.float64, "points"))
    data.SetPoints(points)
    data.SetPolys(cells_of(np.concatenate([m.corners + k for m, k in zip(meshes, starts[:-1], strict=True)])))
    return data


def by_bsp_of_vtk(data: vtkPolyData, start: Floats, end: Floats) -> tuple[float, Floats]:
    tree = vtkModifiedBSPTree()
    tree.SetDataSet(data)
    tree.BuildLocator()
    lines = list(zip(start.tolist(), end.tolist(), strict=True))
    part, where, local = reference(0.0), [0.0] * 3, [0.0] * 3
    sub, cell = reference(0), reference(0)

    def run() -> list[float]:
        return [float(part) if tree.IntersectWithLine(a, b, 1e-9, part, where, local, sub, cell) else np.inf
                for a, b in lines]  # fmt: skip

    seconds, found = best(run)
    return seconds, np.array(found) * np.linalg.norm(end - start, axis=1)


def by_obb(data: vtkPolyData, start: Floats, end: Floats) -> tuple[float, Floats]:
    tree = vtkOBBTree()
    tree.SetDataSet(data)
    tree.BuildLocator()
    lines = list(zip(start.tolist(), end.tolist(), strict=True))
    points, cells = vtkPoints(), vtkIdList()

    def run() -> list[tuple[float, float, float] | None]:
        return [points.GetPoint(0) if tree.IntersectWithLine(a, b, points, cells) else None for a, b in lines]

    seconds, found = best(run)
    places = np.array([(np.inf,) * 3 if place is None else place for place in found])
    return seconds, np.linalg.norm(places - start, axis=1)


def away_from_edges(rays: Rays, start: Floats, along: Floats, distance: Floats, face: NDArray[np.int64]) -> Floats:
    """(n,) how near each hit is to the border of its triangle, inf for a miss."""
    faces = rays.tree.faces
    corners = faces.points[faces.corners.reshape(-1, 3)[face]]
    here = start + np.where(np.isfinite(distance), distance, 0.0)[:, None] * along
    sides = np.roll(corners, -1, axis=1) - corners
    off = np.linalg.norm(np.cross(sides, here[:, None] - corners), axis=2) / np.linalg.norm(sides, axis=2)
    return np.where(face >= 0, off.min(axis=1), np.inf)


def main() -> None:
    print(f"{'scene':22}{'faces':>8}{'ours':>10}{'MBSP':>10}{'OBB':>10}   ratio   differ")
    for name, solids in scenes().items():
        evaluation = evaluate(*solids)
        meshes = [mesh for result in evaluation.solids if (mesh := evaluation.display(result)) is not None]
        rays = Rays(build(faces_of_meshes(meshes)))
        rng = np.random.default_rng(11)
        points = rays.tree.faces.points
        low, high = points.min(axis=0), points.max(axis=0)
        middle, reach = 0.5 * (low + high), rays.size
        start = rng.normal(size=(RAYS, 3))
        start = middle + reach * start / np.linalg.norm(start, axis=1, keepdims=True)
        along = rng.uniform(low, high, (RAYS, 3)) - start
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        end = start + 3.0 * reach * along
        rays.first(start[:20], along[:20])
        ours, (distance, face) = best(lambda: rays.first(start, along))  # noqa: B023
        data = surface_of(meshes)
        theirs = [caster(data, start[:THEIRS], end[:THEIRS]) for caster in (by_bsp_of_vtk, by_obb)]
        clear = away_from_edges(rays, start, along, distance, face)[:THEIRS] > 1e-6 * reach
        differ = [int(np.count_nonzero(clear & ~np.isclose(found, distance[:THEIRS], rtol=0, atol=1e-5 * reach)))
                  for _, found in theirs]  # fmt: skip
        mine = ours / RAYS * 1e6
        each = [seconds / THEIRS * 1e6 for seconds, _ in theirs]
        print(f"{name:22}{rays.tree.faces.count:8,}{mine:7.2f} µs{each[0]:7.2f} µs{each[1]:7.2f} µs"
              f"{min(each) / mine:7.2f}x   {differ[0]}, {differ[1]}", flush=True)  # fmt: skip
        seconds, found = best(lambda: visibility(rays, points[rays.tree.faces.corners.reshape(-1, 3)],  # noqa: B023
                                                 Eye((1.0, -0.7, 0.5), True)))  # fmt: skip
        print(f"{'':22}seen of all: {found.share:.1%} ± {found.error:.2%}, {found.rays:,} rays, {seconds * 1e3:.0f} ms")


if __name__ == "__main__":
    main()
