"""Clearance of 200 parts beside manifold3d's min_gap and python-fcl; points inside a solid beside trimesh.

What is not installed is left out: `.venv/bin/pip install python-fcl rtree` brings both.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np
import trimesh
from manifold3d import Manifold

from solidtree.model.mesh.faults.box_pairs import meeting
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import faces_of_polygons
from solidtree.model.partition.rays import Rays
from solidtree.model.partition.sight import inside as within
from solidtree.model.proximity.bodies import OVERLAPPING, Body, Relation, overlap_of, relations
from solidtree.model.proximity.boxes import BoxTree
from solidtree.model.solid.results import arrays_of

PARTS, CLEARANCE, RUNS = 200, 0.5, 7
POINTS, THEIRS = 1_000_000, 10_000
T = TypeVar("T")


def best(run: Callable[[], T]) -> tuple[float, T]:
    """The least time of some runs, in seconds, and what came of the last one."""
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        result = run()
        times.append(time.perf_counter() - start)
    return min(times), result


KINDS = (
    Manifold.sphere(5, 32),
    Manifold.cylinder(9, 4, 4, 96, True) - Manifold.cylinder(10, 2, 2, 64, True),
    Manifold.cube((7, 7, 7), True) - Manifold.sphere(4, 48),
    Manifold.revolve(Manifold.cylinder(1, 1.4, 1.4, 24).slice(0.5).translate((3.6, 0)), 32),
)


def assembly() -> list[Manifold]:
    """Parts of 500 to 2,000 triangles in a lattice, turned, the near ones some tenths of a millimetre apart."""
    rng = np.random.default_rng(7)
    places = np.stack(np.meshgrid(*3 * (np.arange(6),), indexing="ij"), axis=-1).reshape(-1, 3)[:PARTS]
    return [
        KINDS[k % 4].rotate(rng.uniform(0, 360, 3).tolist()).translate((11.4 * place).tolist())
        for k, place in enumerate(places)
    ]


def body(solid: Manifold) -> Body:
    return Body("", *arrays_of(solid.to_mesh64()), solid)


def near_pairs(bodies: list[Body]) -> list[tuple[int, int]]:
    boxes = np.array([one.bounds for one in bodies])
    found = [np.column_stack(pair) for pair in meeting(boxes[:, 0] - CLEARANCE / 2, boxes[:, 1] + CLEARANCE / 2)]
    return sorted(map(tuple, np.sort(np.concatenate(found), axis=1).tolist()))


def checked(bodies: list[Body]) -> dict[tuple[int, int], Relation]:
    """The pairs that overlap or come nearer than the clearance."""
    pairs = near_pairs(bodies)
    known = relations(bodies, pairs, [CLEARANCE] * len(pairs))
    return {pair: relation for pair, relation in zip(pairs, known, strict=True) if relation is not None}


def by_fcl(bodies: list[Body], pairs: list[tuple[int, int]]) -> dict[tuple[int, int], float] | None:
    try:
        import fcl
    except ImportError:
        return None
    models = []
    for one in bodies:
        model = fcl.BVHModel()
        model.beginModel(len(one.vertices), len(one.triangles))
        model.addSubModel(one.vertices, one.triangles)
        model.endModel()
        models.append(fcl.CollisionObject(model, fcl.Transform()))
    return {(i, j): fcl.distance(models[i], models[j], fcl.DistanceRequest(), fcl.DistanceResult()) for i, j in pairs}


def by_boxes(bodies: list[Body], pairs: list[tuple[int, int]]) -> dict[tuple[int, int], float]:
    trees = [BoxTree(one.vertices[one.triangles]) for one in bodies]
    return {(i, j): trees[i].gap(trees[j]).length for i, j in pairs}


def main() -> None:
    solids = assembly()
    for solid in solids:
        solid.num_tri()  # manifold3d works when it is asked
    bodies = [body(solid) for solid in solids]
    pairs = near_pairs(bodies)
    arrays = [(one.vertices, one.triangles) for one in bodies]
    ours, near = best(lambda: checked([Body("", *some, solid) for some, solid in zip(arrays, solids, strict=True)]))
    again, _ = best(lambda: checked(bodies))
    overlapping = [pair for pair, relation in near.items() if relation.kind == OVERLAPPING]
    volumes, _ = best(lambda: [overlap_of(bodies[i], bodies[j]).volume() for i, j in overlapping])
    gap_time, theirs = best(lambda: {(i, j): solids[i].min_gap(solids[j], CLEARANCE) for i, j in pairs})
    same = sum((gap < CLEARANCE) == (pair in near) for pair, gap in theirs.items())
    worst = max(abs(theirs[pair] - relation.gap) for pair, relation in near.items())
    triangles = sum(len(one.triangles) for one in bodies)
    print(
        f"{PARTS} parts, {triangles:,} triangles, {len(pairs)} pairs of near boxes, {len(near)} within {CLEARANCE} mm"
    )
    print(f"all of it {1e3 * ours:.1f} ms, with parts known from before {1e3 * again:.1f} ms, of which "
          f"{1e3 * volumes:.1f} ms are the volumes of {len(overlapping)} overlaps; min_gap on those pairs, which "
          f"tells no volume, {1e3 * gap_time:.1f} ms: {gap_time / ours:.1f}, {gap_time / again:.1f} and without "
          f"volumes {gap_time / (again - volumes):.1f} times; the same answer for {same} of {len(pairs)}, "
          f"farthest apart {worst:.1e} mm")  # fmt: skip
    fcl_time, fcl_gaps = best(lambda: by_fcl(bodies, pairs))
    if fcl_gaps is None:
        print("python-fcl is not installed")
    else:
        gaps_time, gaps = best(lambda: by_boxes(bodies, pairs))
        worst = max(abs(max(fcl_gaps[pair], 0.0) - gaps[pair]) for pair in pairs)
        print(f"exact distances of those pairs {1e3 * gaps_time:.0f} ms, python-fcl {1e3 * fcl_time:.0f} ms: "
              f"{fcl_time / gaps_time:.1f} times; farthest apart {worst:.1e} mm")  # fmt: skip
    tube = Body("", *arrays_of(KINDS[1].to_mesh64()), KINDS[1])
    points = np.random.default_rng(1).uniform(-6, 6, (POINTS, 3))
    tube.tree.windings(points[:1])
    ours, inside = best(lambda: tube.holds(points))
    rays = Rays(build(faces_of_polygons(list(tube.vertices[tube.triangles]))))
    batches = [slice(k, k + 50_000) for k in range(0, POINTS, 50_000)]
    askew = sum(int((within(rays, points[batch], 0.0) != inside[batch]).sum()) for batch in batches)
    across, sag = np.hypot(*points.T[:2]), 1.0 - np.cos(np.pi / 64)  # of the coarser one
    clear = ~(((across > 4 * (1 - sag)) & (across < 4)) | ((across > 2 * (1 - sag)) & (across < 2)))
    formula = (across < 4) & (across > 2) & (np.abs(points[:, 2]) < 4.5)
    wrong = int((inside != formula)[clear].sum())
    print(f"{POINTS:,} points in a tube of {len(tube.triangles)} triangles: {ours:.2f} s; {askew} differ from the "
          f"parity of askew rays through a BSP tree, {wrong} of the {clear.sum():,} that are not beside its chords "
          f"from the formula")  # fmt: skip
    try:
        start = time.perf_counter()
        told = trimesh.Trimesh(tube.vertices, tube.triangles, process=False).contains(points[:THEIRS])
        theirs_time = time.perf_counter() - start
    except ImportError:
        print("rtree, which trimesh.contains needs, is not installed")
        return
    differ = int((told != inside[:THEIRS]).sum())
    print(f"trimesh.contains, {THEIRS:,} of them: {theirs_time:.2f} s, per point "
          f"{theirs_time / THEIRS / (ours / POINTS):.0f} times as long; {differ} differ")  # fmt: skip


if __name__ == "__main__":
    main()
