"""The feature edges of a mesh as people see them: corners, straight edges and circles, however finely they are cut."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from .measure import component_labels

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

CORNER = np.cos(np.radians(25))
"""A line of edges that turns by more than this has a corner there."""
STRAIGHT = np.cos(np.radians(0.5))
ROUND = 6e-3
"""How far the points of a circle may lie beside it, as a share of its radius: curved faces are cut as facets."""
FEWEST = 5
"""Points that a circle has at least."""
LONG, SHARE = 2.5, 0.1
"""In a line that is neither straight nor round, edges so many times the middle length, and such a share of the line,
are straight parts of it: the sides of a slot between its rounded ends."""


@dataclass(frozen=True, slots=True)
class Circles:
    """Circles and arcs: `centres` (c, 3), `radii` (c,), unit `normals` (c, 3), and `chains` (c,), their lines."""

    centres: Floats
    radii: Floats
    normals: Floats
    chains: Indices


class Features:
    """The feature edges of a DisplayMesh, put together to lines.

    points   (q, 3)  the mesh's edge points, in double precision
    edges    (e, 2)  indices into points
    chain    (e,)    which line each edge belongs to; lines end at corners and where straight parts meet round ones
    corners  (v,)    indices into points: where lines end or meet
    straight (m, 2)  indices into points: the ends of the straight lines, pieces in line being one
    straight_chains (m,)  their lines
    circles          lines that are circles or arcs
    """

    def __init__(self, mesh: DisplayMesh) -> None:
        self.points: Floats = mesh.edge_points.astype(np.float64)
        self.edges: Indices = mesh.edges.astype(np.int64).reshape(-1, 2)
        self._bits = bits_of(mesh.edge_points)
        ends = self.points[self.edges]
        along = ends[:, 1] - ends[:, 0]
        self._lengths = np.linalg.norm(along, axis=1)
        self._directions = along / np.maximum(self._lengths, 1e-300)[:, None]
        pairs, nodes, cosine = self._joints()
        through = cosine > CORNER
        pairs, nodes, cosine = pairs[through], nodes[through], cosine[through]
        self.chain = _numbered(component_labels(len(self.edges), pairs))
        is_straight, circles = self._classified()
        known = is_straight.copy()
        known[circles.chains] = True
        long = self._long(known)
        if long.any():
            apart = (long[pairs[:, 0]] != long[pairs[:, 1]]) | (long[pairs].all(axis=1) & (cosine < STRAIGHT))
            pairs, nodes = pairs[~apart], nodes[~apart]
            self.chain = _numbered(component_labels(len(self.edges), pairs))
            is_straight, circles = self._classified()
        self.circles = circles
        inner = np.zeros(len(self.points), bool)
        inner[nodes] = True
        used = np.zeros(len(self.points), bool)
        used[self.edges] = True
        self.corners: Indices = np.flatnonzero(used & ~inner)
        # A line's two ends are those of its edges' ends that are corners.
        chain_of_end = np.repeat(self.chain, 2)
        at_end = np.flatnonzero(~inner[self.edges.ravel()] & is_straight[chain_of_end])
        at_end = at_end[np.argsort(chain_of_end[at_end], kind="stable")]
        self.straight: Indices = self.edges.ravel()[at_end].reshape(-1, 2)
        self.straight_chains: Indices = chain_of_end[at_end][::2]

    @property
    def midpoints(self) -> Floats:
        """(m, 3) the middles of the straight lines."""
        return self.points[self.straight].mean(axis=1)

    @cached_property
    def _sorted_bits(self) -> tuple[NDArray[np.uint64], Indices]:
        order = np.argsort(self._bits, kind="stable")
        return self._bits[order], order

    @cached_property
    def _sorted_edges(self) -> tuple[Indices, Indices]:
        both = np.sort(self.edges, axis=1)
        keys = both[:, 0] * (len(self.points) + 1) + both[:, 1]
        order = np.argsort(keys, kind="stable")
        return keys[order], order

    def among(self, ends: NDArray[np.float32]) -> Indices:
        """(n,) which feature edge each of the segments (n, 2, 3), with the mesh's very points, is; -1 for none."""
        if not len(self.edges) or not len(ends):
            return np.full(len(ends), -1, np.int64)
        bits, order = self._sorted_bits
        wanted = bits_of(ends.reshape(-1, 3))
        place = np.minimum(np.searchsorted(bits, wanted), len(bits) - 1)
        node = np.where(bits[place] == wanted, order[place], len(self.points)).reshape(-1, 2)
        node.sort(axis=1)
        keys, edges = self._sorted_edges
        key = node[:, 0] * (len(self.points) + 1) + node[:, 1]
        place = np.minimum(np.searchsorted(keys, key), len(keys) - 1)
        return np.where(keys[place] == key, edges[place], -1)

    def _joints(self) -> tuple[Indices, Indices, Floats]:
        """Where just two edges meet: the edges (n, 2), the point (n,), the cosine (n,) of the turn from one to the
        other."""
        ends = self.edges.ravel()
        count = np.bincount(ends, minlength=len(self.points))
        order = np.argsort(ends, kind="stable")
        first = np.cumsum(count) - count
        nodes = np.flatnonzero(count == 2)
        pairs = (
            np.stack([order[first[nodes]], order[first[nodes] + 1]], axis=1) if len(nodes) else np.empty((0, 2), int)
        )
        edge, side = np.divmod(pairs, 2)
        outward = self._directions[edge] * np.where(side == 0, 1.0, -1.0)[..., None]
        return edge, nodes, -np.einsum("ij,ij->i", outward[:, 0], outward[:, 1])

    def _classified(self) -> tuple[NDArray[np.bool_], Circles]:
        """Which lines are straight (chains,), and the round ones."""
        chains = int(self.chain.max()) + 1 if len(self.chain) else 0
        first = np.full(chains, len(self.chain), np.int64)
        np.minimum.at(first, self.chain, np.arange(len(self.chain)))
        across = np.abs(np.einsum("ij,ij->i", self._directions, self._directions[first[self.chain]]))
        straight = np.ones(chains, bool)
        straight[self.chain[across < STRAIGHT]] = False
        return straight, self._circles(~straight)

    def _circles(self, wanted: NDArray[np.bool_]) -> Circles:
        """Circles through the points of the wanted lines, where they are round: a plane by least squares, and Kåsa's
        fit (1976) in it, for all lines at once."""
        size = len(self.points)
        edges = np.flatnonzero(wanted[self.chain])
        keys = np.unique(np.repeat(self.chain[edges], 2) * size + self.edges[edges].ravel())
        chain, node = np.divmod(keys, size) if size else (keys, keys)
        numbers, group, count = np.unique(chain, return_inverse=True, return_counts=True)
        group = group.reshape(-1)
        points = self.points[node]
        total = len(numbers)
        mean = _sums(group, points, total) / count[:, None]
        offset = points - mean[group]
        scatter = _sums(group, (offset[:, :, None] * offset[:, None, :]).reshape(-1, 9), total).reshape(-1, 3, 3)
        spread, axes = np.linalg.eigh(scatter)  # ascending: the normal comes first
        x, y, z = (np.einsum("ij,ij->i", offset, axes[group, :, i]) for i in (2, 1, 0))
        square = x * x + y * y
        with np.errstate(divide="ignore", invalid="ignore"):
            a = _sums(group, (x * square)[:, None], total)[:, 0] / (2 * spread[:, 2])
            b = _sums(group, (y * square)[:, None], total)[:, 0] / (2 * spread[:, 1])
            radius = np.sqrt(a * a + b * b + (spread[:, 1] + spread[:, 2]) / count)
            beside = np.abs(np.hypot(x - a[group], y - b[group]) - radius[group]) + np.abs(z)
            worst = np.zeros(total)
            np.maximum.at(worst, group, np.nan_to_num(beside, nan=np.inf))
            bent = spread[:, 1] > 1e-3 * spread[:, 2]
            good = (count >= FEWEST) & bent & (worst <= ROUND * radius)
        centre = mean + a[:, None] * axes[:, :, 2] + b[:, None] * axes[:, :, 1]
        return Circles(centre[good], radius[good], axes[good][:, :, 0], numbers[good])

    def _long(self, known: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """(e,) the straight parts of lines that are neither straight nor round."""
        rest = np.flatnonzero(~known[self.chain])
        long = np.zeros(len(self.edges), bool)
        if len(rest):
            order = rest[np.lexsort((self._lengths[rest], self.chain[rest]))]
            numbers, first, count = np.unique(self.chain[order], return_index=True, return_counts=True)
            middle = self._lengths[order[first + (count - 1) // 2]]
            whole = np.bincount(self.chain[rest], self._lengths[rest], len(known))[numbers]
            bound = np.full(len(known), np.inf)
            bound[numbers] = np.maximum(LONG * middle, SHARE * whole)
            long[rest] = self._lengths[rest] > bound[self.chain[rest]]
        return long


def features(mesh: DisplayMesh) -> Features:
    """The features of a mesh, kept as long as the mesh is."""
    kept = _kept.get(mesh)
    if kept is None:
        kept = _kept[mesh] = Features(mesh)
    return kept


def share_features(mesh: DisplayMesh, other: DisplayMesh) -> Features:
    """The features of `mesh`, kept for another mesh with the very same edges too."""
    kept = _kept[other] = features(mesh)
    return kept


def bits_of(points: NDArray[np.float32]) -> NDArray[np.uint64]:
    """(n,) a number for the very bits of points (n, 3): equal points have equal ones, others the same by chance of
    1 : 2^64 alone."""
    x, y, z = np.ascontiguousarray(points, np.float32).view(np.uint32).reshape(-1, 3).astype(np.uint64).T
    mixed = x | (y << np.uint64(32))
    mixed ^= mixed >> np.uint64(29)
    mixed *= np.uint64(0xBF58476D1CE4E5B9)
    mixed ^= (z + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    mixed ^= mixed >> np.uint64(32)
    mixed *= np.uint64(0x94D049BB133111EB)
    return mixed ^ (mixed >> np.uint64(29))


def _numbered(labels: Indices) -> Indices:
    return np.unique(labels, return_inverse=True)[1].reshape(-1).astype(np.int64)


def _sums(group: Indices, rows: Floats, count: int) -> Floats:
    """(count, k) the sum of the rows (n, k) of each group."""
    return np.column_stack([np.bincount(group, rows[:, i], count) for i in range(rows.shape[1])]).astype(np.float64)


_kept: WeakKeyDictionary[DisplayMesh, Features] = WeakKeyDictionary()
