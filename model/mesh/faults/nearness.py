"""Vertices and edges that come nearer to each other than a tolerance and are not joined."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...document.errors import Refusal
from .box_pairs import near_segments
from .sides import Flags, Floats, Numbers, Sides

MAX_PAIRS = 20_000_000
"""Pairs of vertices that a tolerance may bring together before it is refused: some 1 GB."""


@dataclass(frozen=True, slots=True, eq=False)
class Near:
    """What is near: `vertices` (k, c) of each pair, the `places` (k, 3) between its two, and the `gaps` (k,) in mm.

    The vertices are those of both: two of two vertices; a vertex and the two ends of an edge; four ends of two edges.
    """

    vertices: Numbers
    places: Floats
    gaps: Floats

    def __len__(self) -> int:
        return len(self.gaps)


def near_vertices(vertices: Floats, sides: Sides, tolerance: float) -> Near:
    """Vertices of edges within `tolerance` of each other that no edge joins. Raises Refusal for too many of them."""
    used = np.flatnonzero(np.bincount(sides.ends.reshape(-1), minlength=len(vertices)))
    pairs = used[close_pairs(vertices[used], tolerance)]
    pairs = pairs[~_listed(pairs, sides.ends, len(vertices))]
    one, two = vertices[pairs[:, 0]], vertices[pairs[:, 1]]
    return Near(pairs, (one + two) / 2.0, np.linalg.norm(one - two, axis=1))


def close_pairs(points: Floats, tolerance: float) -> Numbers:
    """(k, 2) which of points (n, d) lie within `tolerance` of each other, the lower number first. Raises Refusal."""
    from scipy.spatial import KDTree

    if len(points) < 2:
        return np.zeros((0, 2), np.int64)
    tree = KDTree(points)
    found = (int(tree.count_neighbors(tree, tolerance)) - len(points)) // 2
    if found > MAX_PAIRS:
        raise Refusal(
            f"within {tolerance:g} mm of each other lie {found:,} pairs of vertices, more than are looked at; "
            "take a smaller tolerance"
        )
    return tree.query_pairs(tolerance, output_type="ndarray").astype(np.int64).reshape(-1, 2)


def near_edges(
    vertices: Floats, triangles: Numbers, sides: Sides, tolerance: float, told: Callable[[float], None] | None = None
) -> tuple[Near, Near]:
    """Vertices within `tolerance` of an edge, and edges within it of each other, where no vertex is as near.

    A vertex counts where it is farther than the tolerance from both ends of the edge, and no corner of a triangle with
    that edge: such triangles are slivers. Edges with a common vertex are joined.
    """
    a, b = vertices[sides.ends[:, 0]], vertices[sides.ends[:, 1]]
    meets: list[Numbers] = [np.zeros((0, 2), np.int64)]
    crosses: list[Numbers] = [np.zeros((0, 2), np.int64)]
    for one, two in near_segments(a, b, tolerance * (0.5 + 1e-9), told):
        one, two = _lines_near(a, b, sides.ends, one, two, tolerance)
        near_one, ends_one = _ends_at(vertices, sides.ends[one], sides.ends[two], tolerance)
        near_two, ends_two = _ends_at(vertices, sides.ends[two], sides.ends[one], tolerance)
        for k in range(2):
            meets.append(np.column_stack((sides.ends[one[near_one[:, k]], k], two[near_one[:, k]])))
            meets.append(np.column_stack((sides.ends[two[near_two[:, k]], k], one[near_two[:, k]])))
        bare = ~(near_one.any(axis=1) | near_two.any(axis=1) | ends_one | ends_two)
        one, two = one[bare], two[bare]
        _, gaps, inner = _between(a[one], b[one], a[two], b[two])
        crosses.append(np.column_stack((one, two))[inner & (gaps <= tolerance)])
    return _vertices_on(vertices, triangles, sides, np.concatenate(meets)), _crossing(
        vertices, sides, np.concatenate(crosses)
    )


def _lines_near(
    a: Floats, b: Floats, ends: Numbers, one: Numbers, two: Numbers, tolerance: float
) -> tuple[Numbers, Numbers]:
    """The pairs of edges whose lines come near each other, and those with a common vertex: few of very many."""
    # One coordinate after the other: arrays (k, 3) would take several times as long.
    along = [b[one, axis] - a[one, axis] for axis in range(3)]
    across = [b[two, axis] - a[two, axis] for axis in range(3)]
    apart = [a[two, axis] - a[one, axis] for axis in range(3)]
    x, y, z = (along[k - 2] * across[k - 1] - along[k - 1] * across[k - 2] for k in range(3))
    away = apart[0] * x + apart[1] * y + apart[2] * z
    kept = away * away <= (1.0 + 1e-9) * tolerance**2 * (x * x + y * y + z * z)
    for i in range(2):
        for j in range(2):
            kept |= ends[one, i] == ends[two, j]
    return one[kept], two[kept]


def _vertices_on(vertices: Floats, triangles: Numbers, sides: Sides, meets: Numbers) -> Near:
    """Each pair of a vertex and an edge once, without those of one triangle."""
    count = max(len(sides.ends), 1)
    opposite = triangles[:, [2, 0, 1]].reshape(-1)
    here = sides.edge >= 0
    near = np.zeros(len(vertices), bool)
    near[meets[:, 0]] = True
    here &= near[opposite]
    own = np.unique(opposite[here] * count + sides.edge[here])
    keys = np.setdiff1d(meets[:, 0] * count + meets[:, 1], own).astype(np.int64)
    vertex, ends = keys // count, sides.ends[keys % count]
    feet, gaps, _ = feet_on(vertices[vertex], vertices[ends[:, 0]], vertices[ends[:, 1]])
    return Near(np.column_stack((vertex, ends)), (feet + vertices[vertex]) / 2.0, gaps)


def _crossing(vertices: Floats, sides: Sides, crosses: Numbers) -> Near:
    four = np.hstack((sides.ends[crosses[:, 0]], sides.ends[crosses[:, 1]]))
    places, gaps, _ = _between(*(vertices[four[:, k]] for k in range(4)))
    return Near(four, places, gaps)


def _ends_at(vertices: Floats, ends: Numbers, onto: Numbers, tolerance: float) -> tuple[Flags, Flags]:
    """(k, 2) which ends of edges lie near the inside of other edges; (k,) where one lies near an end, or is one."""
    a, b = vertices[onto[:, 0]], vertices[onto[:, 1]]
    near = np.zeros((len(ends), 2), bool)
    at_end = np.zeros(len(ends), bool)
    for k in range(2):
        point = vertices[ends[:, k]]
        _, gaps, inner = feet_on(point, a, b)
        there = (np.linalg.norm(point - a, axis=1) <= tolerance) | (np.linalg.norm(point - b, axis=1) <= tolerance)
        there |= (ends[:, k, None] == onto).any(axis=1)
        near[:, k] = inner & (gaps <= tolerance) & ~there
        at_end |= there
    return near, at_end


def feet_on(points: Floats, a: Floats, b: Floats) -> tuple[Floats, Floats, Flags]:
    """The nearest points (k, d) on segments a b to points, how far they are (k,), and whether they lie inside (k,)."""
    way = b - a
    squared = np.einsum("ij,ij->i", way, way)
    share = np.einsum("ij,ij->i", points - a, way) / np.where(squared > 0.0, squared, 1.0)
    feet = a + np.clip(share, 0.0, 1.0)[:, None] * way
    return feet, np.linalg.norm(points - feet, axis=1), (share > 0.0) & (share < 1.0)


def _between(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats, Flags]:
    """Half-way between the lines a b and c d (k, 3) where they are nearest, their distance (k,), and whether both
    nearest points lie inside the segments; parallel ones have none."""
    along, across, apart = b - a, d - c, c - a
    normal = np.cross(along, across)
    squared = np.einsum("ij,ij->i", normal, normal)
    sizes = np.einsum("ij,ij->i", along, along) * np.einsum("ij,ij->i", across, across)
    askew = squared > 1e-24 * sizes
    safe = np.where(askew, squared, 1.0)
    with np.errstate(over="ignore"):  # of nearly parallel ones, whose places are far outside
        s = np.clip(np.einsum("ij,ij->i", np.cross(apart, across), normal) / safe, -1.0, 2.0)
        t = np.clip(np.einsum("ij,ij->i", np.cross(apart, along), normal) / safe, -1.0, 2.0)
    one, two = a + s[:, None] * along, c + t[:, None] * across
    inner = askew & (s > 0.0) & (s < 1.0) & (t > 0.0) & (t < 1.0)
    return (one + two) / 2.0, np.linalg.norm(one - two, axis=1), inner


def _listed(pairs: Numbers, ends: Numbers, count: int) -> Flags:
    """(k,) which pairs (k, 2) are among the edges' ends (e, 2)."""
    return np.isin(
        pairs.min(axis=1, initial=count) * count + pairs.max(axis=1, initial=0), ends[:, 0] * count + ends[:, 1]
    )
