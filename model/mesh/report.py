"""What is wrong with a mesh of triangles: borders, branches, turned and doubled faces, slivers, what nearly touches."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .lists import Floats, Numbers, of_triangles
from .topology import component_of_faces
from .winged import winged_edge

KINDS = {
    "open edge": "has a face on one side only",
    "branching edge": "has more than two faces",
    "turned edge": "has two faces that run the same way: one of them is inside out",
    "doubled face": "has the same corners as another face",
    "degenerate face": "has no area",
    "sliver": "is thinner than the tolerance",
    "near vertices": "are two places nearer than the tolerance, and not joined",
    "vertex near edge": "lies at an open edge nearer than the tolerance, and is not one of its ends",
}
MOST = 1000
"""Findings of one kind that are kept; all are counted."""


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong at a place (mm); `size` in mm is what findings are sorted by: lengths of edges, sides of faces,
    widths of gaps. `items` are the vertices of an edge or of a pair, or the number of a face."""

    kind: str
    place: tuple[float, float, float]
    size: float
    items: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Report:
    """`counts` of all findings by kind, and `findings` the largest of each kind first, at most MOST of each.

    `edges` are pairs of vertices with faces; `components` hang together by edges.
    """

    vertices: int
    triangles: int
    edges: int
    components: int
    counts: dict[str, int]
    findings: tuple[Finding, ...]

    @property
    def clean(self) -> bool:
        return not any(self.counts.values())

    def __str__(self) -> str:
        head = f"{self.triangles:,} triangles, {self.vertices:,} vertices, {self.components:,} "
        head += f"piece{'s' * (self.components != 1)}"
        words = [f"{count:,} {_plural(kind, count)}" for kind, count in self.counts.items() if count]
        return head + (": " + ", ".join(words) if words else ": nothing found")


def _plural(kind: str, count: int) -> str:
    return kind if count == 1 or kind.endswith("s") else f"{kind}s"


def check(vertices: ArrayLike, triangles: ArrayLike, tolerance: float = 0.01) -> Report:
    """Of triangles (t, 3) over vertices (n, 3) in mm. Vertices at the very same place count as one."""
    raw = np.asarray(vertices, float).reshape(-1, 3)
    points, which = np.unique(raw, axis=0, return_inverse=True)
    faces = which.reshape(-1)[np.asarray(triangles, np.int64).reshape(-1, 3)]
    lengths = np.linalg.norm(points[faces] - points[np.roll(faces, 1, axis=1)], axis=2)
    area = np.linalg.norm(np.cross(points[faces[:, 1]] - points[faces[:, 0]],
                                   points[faces[:, 2]] - points[faces[:, 0]]), axis=1)  # twice  # fmt: skip
    longest = lengths.max(axis=1, initial=0.0)
    same = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    degenerate = same | (area <= 1e-12 * longest**2)
    thin = ~degenerate & (area < tolerance * longest)
    found = [
        *_of_faces("degenerate face", np.flatnonzero(degenerate), points, faces, longest),
        *_of_faces("sliver", np.flatnonzero(thin), points, faces, longest),
    ]
    counts = dict.fromkeys(KINDS, 0) | {"degenerate face": int(degenerate.sum()), "sliver": int(thin.sum())}
    kept = np.flatnonzero(~same)
    faces = faces[kept]
    doubled = _doubled(faces)
    counts["doubled face"] = len(doubled)
    found += [
        Finding("doubled face", one.place, one.size, (int(kept[one.items[0]]),))
        for one in _of_faces("doubled face", doubled, points, faces, longest[kept])
    ]
    ends, forward, backward = _sides(faces, len(points))
    total = forward + backward
    length = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    for kind, rows in (
        ("open edge", total == 1),
        ("branching edge", total > 2),
        ("turned edge", (total == 2) & (forward != 1)),
    ):
        counts[kind] = int(rows.sum())
        found += _of_pairs(kind, ends[rows], length[rows], points)
    near = _near_vertices(points, faces, ends, tolerance)
    gaps = np.linalg.norm(points[near[:, 0]] - points[near[:, 1]], axis=1)
    counts["near vertices"] = len(near)
    found += _of_pairs("near vertices", near, gaps, points)
    beside, far = _near_edges(points, ends[total == 1], tolerance)
    counts["vertex near edge"] = len(beside)
    order = np.argsort(-far, kind="stable")[:MOST]
    found += [
        Finding("vertex near edge", _place(points[beside[row, 0]]), float(far[row]), tuple(beside[row].tolist()))
        for row in order
    ]
    mesh = winged_edge(of_triangles(points, faces))
    components = int(component_of_faces(mesh).max(initial=-1)) + 1
    return Report(len(points), len(degenerate), len(ends), components, counts, tuple(found))


def _sides(faces: Numbers, count: int) -> tuple[Numbers, Numbers, Numbers]:
    """(e, 2) the pairs of vertices that sides join, the lesser first, and (e,) how many run to the greater and back."""
    start, end = faces.reshape(-1), faces[:, [1, 2, 0]].reshape(-1)
    key, which = np.unique(np.minimum(start, end) * count + np.maximum(start, end), return_inverse=True)
    up = np.bincount(which.reshape(-1), start < end, len(key)).astype(np.int64)
    down = np.bincount(which.reshape(-1), start > end, len(key)).astype(np.int64)
    return np.column_stack((key // max(count, 1), key % max(count, 1))), up, down


def _doubled(faces: Numbers) -> Numbers:
    """The faces that have the corners of an earlier one."""
    if not len(faces):
        return np.zeros(0, np.int64)
    _, first, which = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_inverse=True)
    return np.flatnonzero(first[which.reshape(-1)] != np.arange(len(faces)))


def _near_vertices(points: Floats, faces: Numbers, ends: Numbers, tolerance: float) -> Numbers:
    """(k, 2) pairs of used vertices nearer than the tolerance that no edge joins."""
    from scipy.spatial import KDTree

    used = np.unique(faces)
    if len(used) < 2:
        return np.zeros((0, 2), np.int64)
    pairs = used[KDTree(points[used]).query_pairs(tolerance, output_type="ndarray")].reshape(-1, 2)
    pairs = np.sort(pairs, axis=1).astype(np.int64)
    joined = np.isin(pairs[:, 0] * len(points) + pairs[:, 1], ends[:, 0] * len(points) + ends[:, 1])
    return pairs[~joined]


def _near_edges(points: Floats, edges: Numbers, tolerance: float) -> tuple[Numbers, Floats]:
    """(k, 3) vertices of open edges with the ends of another open edge that they are nearer to than the tolerance, but
    not at either end; and (k,) how far in mm."""
    from scipy.spatial import KDTree

    rim = np.unique(edges)
    if not len(rim):
        return np.zeros((0, 3), np.int64), np.zeros(0)
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    half = np.linalg.norm(b - a, axis=1) / 2.0
    around = KDTree(points[rim]).query_ball_point((a + b) / 2.0, half + tolerance)
    row = np.repeat(np.arange(len(edges)), [len(near) for near in around])
    vertex = rim[np.concatenate([np.asarray(near, np.int64) for near in around])]
    apart = (vertex[:, None] != edges[row]).all(axis=1)
    row, vertex = row[apart], vertex[apart]
    way, from_a = b[row] - a[row], points[vertex] - a[row]
    share = np.einsum("ij,ij->i", from_a, way) / np.maximum(np.einsum("ij,ij->i", way, way), 1e-300)
    far = np.linalg.norm(from_a - share[:, None] * way, axis=1)
    margin = tolerance / np.maximum(2.0 * half[row], 1e-300)
    near = (far <= tolerance) & (share > margin) & (share < 1.0 - margin)
    return np.column_stack((vertex[near], edges[row[near]])), far[near]


def _of_faces(kind: str, rows: Numbers, points: Floats, faces: Numbers, size: Floats) -> list[Finding]:
    order = rows[np.argsort(-size[rows], kind="stable")][:MOST]
    return [Finding(kind, _place(points[faces[row]].mean(axis=0)), float(size[row]), (int(row),)) for row in order]


def _of_pairs(kind: str, pairs: Numbers, size: Floats, points: Floats) -> list[Finding]:
    order = np.argsort(-size, kind="stable")[:MOST]
    return [
        Finding(kind, _place(points[pairs[row]].mean(axis=0)), float(size[row]), tuple(pairs[row].tolist()))
        for row in order
    ]


def _place(point: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z
