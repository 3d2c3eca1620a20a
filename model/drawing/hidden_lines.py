"""Which parts of edges are hidden: exactly, from every edge and every face whose boxes in the picture meet.

An edge is hidden where it is inside a triangle in the picture and behind its plane. All of that is linear along the
edge, in perspective too once the picture's depth is (see Projection.picture), so each pair yields one interval; what is
hidden is their union (after Appel 1967, without his counting along the edge).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from .edges import Edges, narrowed
from .polygons import ranges
from .surfaces import Surfaces

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

BEHIND = 1e-7
"""How far behind a face's plane an edge has to be for it to be hidden, as a part of the picture's size."""
SIDEWAYS = 1e-9
"""How far beyond its sides a triangle hides, so that nothing shows between neighbours; of the picture's size."""
A_CELL = 9
"""How many edges and triangles a cell is meant to have."""
MOST_CELLS = 256
"""In a row."""
MOST_HELD = 4_000_000
"""Triangles of all cells."""
BLOCK = 50_000
"""Pairs that are looked at together."""
FIRST = 4
"""How many triangles a piece of an edge is compared with at first; then twice as many."""


def hidden_intervals(
    edges: Edges, surfaces: Surfaces, progress: Callable[[float], None] | None = None
) -> tuple[Numbers, Floats]:
    """The hidden parts of the edges: the edge (k,) and the interval (k, 2) of its parameter 0 .. 1.

    They are sorted by edge and along it, and no two of one edge touch.
    """
    triangles, planes = surfaces.hiding()
    size = picture_size(edges)
    triangles, planes, lines = _outlined(triangles, planes, SIDEWAYS * size)
    if not edges.count or not len(triangles):
        return np.zeros(0, np.int64), np.zeros((0, 2))
    cells = _Cells(edges.ends, triangles)
    found_edge, found = [np.zeros(0, np.int64)], [np.zeros((0, 2))]
    pieces, before, width = np.flatnonzero(cells.count), 0, FIRST
    while len(pieces):
        # The nearest triangles first; what one of them hides as a whole need not be compared with the others.
        counts = np.minimum(cells.count[pieces] - before, width)
        covered = np.zeros(len(pieces), bool)
        for begin, end in _blocks(counts):
            if progress:
                progress(1.0 - len(pieces) / cells.pieces)
            item, step = ranges(counts[begin:end])
            piece = pieces[begin:end][item]
            triangle = cells.held[cells.first[piece] + before + step]
            edge = cells.edge[piece]
            foreign = np.flatnonzero((edges.planes[edge] != planes[triangle][:, None]).all(axis=1))
            item, piece, triangle, edge = item[foreign], piece[foreign], triangle[foreign], edge[foreign]
            low, high = cells.begin[piece], cells.end[piece]
            hiding, low, high = _behind(
                edges.ends[edge], low, high, lines, triangle, surfaces.planes[planes[triangle]], size
            )  # fmt: skip
            whole = (low <= cells.begin[piece[hiding]]) & (high >= cells.end[piece[hiding]])
            covered[begin + item[hiding[whole]]] = True
            found_edge.append(edge[hiding])
            found.append(np.column_stack((low, high)))
        before += width
        pieces = pieces[~covered & (cells.count[pieces] > before)]
        width *= 2
    return union_of_intervals(np.concatenate(found_edge), np.concatenate(found))


def _blocks(counts: Numbers) -> Iterator[tuple[int, int]]:
    """Ranges of items that together have about BLOCK pairs."""
    ends = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        done = int(ends[begin - 1]) if begin else 0
        end = max(int(np.searchsorted(ends, done + BLOCK, "right")), begin + 1)
        yield begin, end
        begin = end


def picture_size(edges: Edges) -> float:
    """The larger side of the box around all edges in the picture, mm."""
    flat = edges.ends[:, :, :2].reshape(-1, 2)
    return float(np.ptp(flat, axis=0).max()) if len(flat) else 0.0


def _outlined(triangles: Floats, planes: Numbers, reach: float) -> tuple[Floats, Numbers, Floats]:
    """Triangles that are wide enough to hide something, their planes, and the lines (n, 7, 3) that bound them.

    A point (x, y) is inside where a x + b y + c >= 0 for all of them: the three sides, and the box, without which the
    tip of a sliver would reach too far.
    """
    flat = triangles[:, :, :2]
    sides = flat[:, [1, 2, 0]] - flat
    turn = sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]
    lengths = np.hypot(sides[:, :, 0], sides[:, :, 1])
    kept = np.flatnonzero(np.abs(turn) > reach * lengths.max(axis=1))
    flat, sides = flat[kept], sides[kept] * np.sign(turn[kept])[:, None, None] / lengths[kept][:, :, None]
    lines = np.zeros((len(kept), 7, 3))
    lines[:, :3, 0], lines[:, :3, 1] = -sides[:, :, 1], sides[:, :, 0]
    lines[:, :3, 2] = reach - (lines[:, :3, 0] * flat[:, :, 0] + lines[:, :3, 1] * flat[:, :, 1])
    lines[:, 3, 0], lines[:, 4, 0], lines[:, 5, 1], lines[:, 6, 1] = 1.0, -1.0, 1.0, -1.0
    low, high = flat.min(axis=1), flat.max(axis=1)
    lines[:, 3, 2], lines[:, 5, 2] = reach - low[:, 0], reach - low[:, 1]
    lines[:, 4, 2], lines[:, 6, 2] = reach + high[:, 0], reach + high[:, 1]
    return triangles[kept], planes[kept], lines


def _behind(
    ends: Floats, low: Floats, high: Floats, lines: Floats, triangle: Numbers, planes: Floats, size: float
) -> tuple[Numbers, Floats, Floats]:
    """Which of the edges (n, 2, 3) are, in low .. high, somewhere inside their triangle's lines and behind the planes
    (n, 4), and from where to where."""
    away = -np.sign(planes[:, 2])  # towards what the eye does not see
    depth = [away * (np.einsum("ij,ij->i", planes[:, :3], ends[:, i]) - planes[:, 3]) - BEHIND * size for i in (0, 1)]
    low, high = narrowed(low, high, depth[0], depth[1])
    left = np.flatnonzero(high > low)
    low, high = low[left], high[left]
    x, y = ends[left, :, 0].T, ends[left, :, 1].T
    for number in range(lines.shape[1]):
        a, b, c = lines[triangle[left], number].T
        low, high = narrowed(low, high, a * x[0] + b * y[0] + c, a * x[1] + b * y[1] + c)
        if number in (0, 2):
            kept = np.flatnonzero(high > low)
            left, low, high, x, y = left[kept], low[kept], high[kept], x[:, kept], y[:, kept]
    kept = np.flatnonzero(high > low)
    return left[kept], low[kept], high[kept]


class _Cells:
    """A uniform grid over the picture: triangles by the cells that they meet, edges cut where they leave a cell.

    Piece i is of `edge[i]` from `begin[i]` to `end[i]`; of its cell's triangles, the nearest first, those that are not
    wholly behind it are `held[first[i] : first[i] + count[i]]`.
    """

    def __init__(self, ends: Floats, triangles: Floats) -> None:
        points = ends[:, :, :2].reshape(-1, 2)
        self._low = points.min(axis=0)
        size = np.maximum(np.ptp(points, axis=0), 1e-300)
        reach = np.ptp(triangles[:, :, :2], axis=1) / size
        self._cells = int(np.clip(np.sqrt((len(triangles) + len(ends)) / A_CELL), 1, MOST_CELLS))
        while self._cells > 1 and (np.minimum(reach * self._cells, self._cells) + 1.0).prod(axis=1).sum() > MOST_HELD:
            self._cells //= 2
        self._step = size * (1.0 + 1e-9) / self._cells
        held, held_cell = self._triangles(triangles[:, :, :2])
        self.edge, self.begin, self.end, cell = self._cut(ends[:, :, :2])
        self.pieces = len(self.edge)

        nearest = triangles[:, :, 2].max(axis=1)
        order = np.argsort(-nearest, kind="stable")
        rank = np.empty(len(order), np.int64)
        rank[order] = np.arange(len(order))
        key = np.sort(held_cell * len(order) + rank[held])
        self.held = order[key % len(order)]
        depth = ends[self.edge, :, 2]
        farthest = np.minimum(*(depth[:, 0] + s * (depth[:, 1] - depth[:, 0]) for s in (self.begin, self.end)))
        before = np.searchsorted(-nearest[order], -farthest)
        self.first = np.searchsorted(key, cell * len(order))
        self.count = np.searchsorted(key, cell * len(order) + before) - self.first

    def _triangles(self, triangles: Floats) -> tuple[Numbers, Numbers]:
        """Pairs of a triangle and a cell that it meets."""
        slack = 1e-6
        low = (triangles.min(axis=1) - self._low) / self._step - slack
        high = (triangles.max(axis=1) - self._low) / self._step + slack
        met = np.flatnonzero(((high >= 0.0) & (low < self._cells)).all(axis=1))
        low = np.clip(np.floor(low[met]), 0, self._cells - 1).astype(np.int64)
        high = np.clip(np.floor(high[met]), 0, self._cells - 1).astype(np.int64)
        wide, tall = (high - low + 1).T
        item, step = ranges(wide * tall)
        row, column = np.divmod(step, wide[item])
        x, y = low[item, 0] + column, low[item, 1] + row
        large = (wide * tall)[item] > 4  # of a small one, most cells of its box are met
        kept = ~large
        kept[large] = self._meets(triangles[met[item[large]]], x[large], y[large])
        return met[item[kept]], (y * self._cells + x)[kept]

    def _meets(self, triangles: Floats, x: Numbers, y: Numbers) -> NDArray[np.bool_]:
        """Whether triangles (n, 3, 2) meet cells: no side has the whole cell beyond it (separating axes)."""
        middle = self._low + (np.column_stack((x, y)) + 0.5) * self._step
        half = 0.5 * (1.0 + 1e-6) * self._step
        meets = np.ones(len(triangles), bool)
        a, b, c = (triangles[:, corner] for corner in range(3))
        turn = np.sign((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        for begin, end in ((a, b), (b, c), (c, a)):
            side = (end - begin) * turn[:, None]
            height = side[:, 0] * (middle - begin)[:, 1] - side[:, 1] * (middle - begin)[:, 0]
            meets &= height + np.abs(side[:, 0]) * half[1] + np.abs(side[:, 1]) * half[0] >= 0.0
        return meets

    def _cut(self, ends: Floats) -> tuple[Numbers, Floats, Floats, Numbers]:
        """The edges (e, 2, 2) cut at the lines of the grid: edge, begin, end and cell of each piece."""
        scaled = (ends - self._low) / self._step
        edges, shares = [np.repeat(np.arange(len(ends)), 2)], [np.tile([0.0, 1.0], len(ends))]
        for axis in (0, 1):
            begin, end = scaled[:, 0, axis], scaled[:, 1, axis]
            first, last = np.ceil(np.minimum(begin, end)), np.floor(np.maximum(begin, end))
            item, step = ranges(np.where(begin == end, 0, np.maximum(last - first + 1, 0)).astype(np.int64))
            edges.append(item)
            shares.append(np.clip((first[item] + step - begin[item]) / (end - begin)[item], 0.0, 1.0))
        edge, share = np.concatenate(edges), np.concatenate(shares)
        order = np.lexsort((share, edge))
        edge, share = edge[order], share[order]
        piece = np.flatnonzero((edge[1:] == edge[:-1]) & (share[1:] > share[:-1]))
        edge, begin, end = edge[piece], share[piece], share[piece + 1]
        middle = (0.5 * (begin + end))[:, None]
        at = scaled[edge, 0] * (1.0 - middle) + scaled[edge, 1] * middle
        at = np.clip(np.floor(at), 0, self._cells - 1).astype(np.int64)
        return edge, begin, end, at[:, 1] * self._cells + at[:, 0]


def union_of_intervals(item: Numbers, intervals: Floats) -> tuple[Numbers, Floats]:
    """Intervals (k, 2) of items (k,) joined where they touch: sorted by item and along it."""
    if not len(item):
        return item, intervals
    order = np.lexsort((intervals[:, 0], item))
    item, intervals = item[order], intervals[order]
    # The largest end so far within the item, by ranks, which no rounding can mix up between items.
    by_end = np.lexsort((intervals[:, 1], item))
    rank = np.empty(len(item), np.int64)
    rank[by_end] = np.arange(len(item))
    furthest = by_end[np.maximum.accumulate(rank)]
    reach = intervals[furthest, 1]
    new = np.append(True, (item[1:] != item[:-1]) | (intervals[1:, 0] > reach[:-1]))
    first = np.flatnonzero(new)
    last = np.append(first[1:], len(item)) - 1
    return item[first], np.column_stack((intervals[first, 0], reach[last]))


def parted(edges: Edges, item: Numbers, hidden: Floats) -> tuple[Floats, Numbers, NDArray[np.bool_]]:
    """The edges cut where they go behind something: the ends (n, 2, 2) of the parts in the picture, the edge (n,) of
    each, and whether it is hidden (n,). `item` and `hidden` are what `hidden_intervals` gives."""
    count = edges.count
    counts = np.bincount(item, minlength=count)
    # What is visible begins at 0 and after each hidden part, and ends before each and at 1.
    number = np.arange(len(item)) - np.repeat(np.cumsum(counts) - counts, counts)
    gaps, step = ranges(counts + 1)
    visible = np.empty((len(gaps), 2))
    first = np.flatnonzero(step == 0)
    visible[:, 0], visible[:, 1] = 0.0, 1.0
    visible[first[item] + number, 1] = hidden[:, 0]
    visible[first[item] + number + 1, 0] = hidden[:, 1]
    edge = np.concatenate((gaps, item))
    part = np.concatenate((visible, hidden))
    is_hidden = np.repeat([False, True], [len(gaps), len(item)])
    flat = edges.ends[edge, :, :2]
    along = flat[:, 1] - flat[:, 0]
    ends = np.stack([np.where((part[:, i] == i)[:, None], flat[:, i], flat[:, 0] + part[:, i, None] * along)
                     for i in (0, 1)], axis=1)  # fmt: skip
    longer = (part[:, 1] - part[:, 0]) * np.hypot(along[:, 0], along[:, 1]) > 2.0 * BEHIND * picture_size(edges)
    return ends[longer], edge[longer], is_hidden[longer]
