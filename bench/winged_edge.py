"""The winged edge of a million triangles beside trimesh's edges and adjacency, and all stars beside a half-edge in
plain Python dictionaries."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np
import trimesh
from numpy.typing import NDArray

from solidtree.model.mesh.lists import of_triangles
from solidtree.model.mesh.walks import stars
from solidtree.model.mesh.winged import winged_edge

SIDE, SMALL, RUNS = 707, 300, 3
T = TypeVar("T")


def best(run: Callable[[], T]) -> tuple[float, T]:
    """The least time of some runs, in seconds, and what came of the last one."""
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        result = run()
        times.append(time.perf_counter() - start)
    return min(times), result


def torus(side: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """2 side² triangles, in an order that is not that of the surface."""
    u, v = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    a, b = (2 * np.pi * n.reshape(-1) / side for n in (u, v))
    points = np.column_stack(((3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)))
    near, right = (u * side + v).reshape(-1), ((u + 1) % side * side + v).reshape(-1)
    up, far = (u * side + (v + 1) % side).reshape(-1), ((u + 1) % side * side + (v + 1) % side).reshape(-1)
    triangles = np.concatenate((np.column_stack((near, right, far)), np.column_stack((near, far, up))))
    return points, np.random.default_rng(1).permutation(triangles)


def peer(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> int:
    mesh = trimesh.Trimesh(points, triangles, process=False)
    return len(mesh.edges_unique) + len(mesh.face_adjacency)


def half_edges(triangles: list[list[int]]) -> tuple[dict[tuple[int, int], int], dict[int, int]]:
    """The third vertex of the face on the left of each side, and a neighbour of each vertex."""
    third = {}
    for a, b, c in triangles:
        third[a, b], third[b, c], third[c, a] = c, a, b
    return third, {a: b for a, b in third}


def dictionary_stars(third: dict[tuple[int, int], int], first: dict[int, int]) -> list[list[int]]:
    """The neighbours of each vertex in their order."""
    found = []
    for vertex, start in first.items():
        star, at = [start], third[vertex, start]
        while at != start:
            star.append(at)
            at = third[vertex, at]
        found.append(star)
    return found


def main() -> None:
    points, triangles = torus(SIDE)
    theirs, _ = best(lambda: peer(points, triangles))
    ours, mesh = best(lambda: winged_edge(of_triangles(points, triangles)))
    print(f"{len(triangles):,} triangles, {len(mesh):,} edges, {mesh.nbytes / 2**20:.0f} MiB")
    print(f"winged edge {ours:6.2f} s   trimesh's edges and adjacency {theirs:6.2f} s   ratio {ours / theirs:.2f}")
    points, triangles = torus(SMALL)
    tables = half_edges(triangles.tolist())
    plain, found = best(lambda: dictionary_stars(*tables))
    small = winged_edge(of_triangles(points, triangles))
    walk, (starts, _, _) = best(lambda: stars(small))
    assert sorted(map(len, found)) == sorted(np.diff(starts).tolist())
    print(f"all stars of {len(points):,} vertices: {1e3 * walk:.1f} ms, by dictionary {1e3 * plain:.1f} ms: "
          f"{plain / walk:.0f} times")  # fmt: skip


if __name__ == "__main__":
    main()
