"""The builder of trees: in NumPy, all nodes of a level at once; or the compiled one where it is there.

A node whose polygons bound one convex body, or are found to lie mutually behind (or before) one another's planes, is a
leaf; every other gets a plane, keeps what lies in it and hands the rest, cut where it crosses, to the next level. On
either side there are fewer polygons than in the node, so every way down ends.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from . import native
from .choice import choose
from .faces import Faces, Floats
from .polygons import Numbers, Polygons, Reach, spread
from .tree import CONCAVE, CONVEX, EPSILON, INNER, Tree, empty_tree

MUTUAL = 256
"""The most polygons of a node that are compared with one another to find out whether they are a leaf."""
SEED = 20
SLIM = 1e-12
"""A face narrower than this, as a part of the scene's size, tells nothing about the plane it lies in."""
MOST_A_FACE, MOST_MORE = 4, 3_000_000
"""A tree may have this many fragments for each face, and this many more."""

Progress = Callable[[int, int], None]


def build(faces: Faces, compiled: bool | None = None, progress: Progress | None = None) -> Tree:
    """The tree of the faces.

    `compiled` asks for the compiled builder or for NumPy's; None takes the better one that is there. `progress(done,
    total)` is called now and then with fragments that have found their place, and may raise to stop. Raises Refusal
    where the faces cross so often that the tree would not fit into memory, ValueError where a number is not finite.
    """
    most = MOST_A_FACE * faces.count + MOST_MORE

    def watch(done: int, total: int) -> None:
        if total > most:
            raise Refusal(
                f"The {faces.count:,} faces cross so often that the BSP tree would have more than {most:,} fragments. "
                "Use the z-buffer, or hide some of the solids."
            )
        if progress:
            progress(done, total)

    if compiled or (compiled is None and native.available()):
        return native.build(faces, watch)
    if not faces.count:
        return empty_tree(faces)
    if not (np.isfinite(faces.points).all() and np.isfinite(faces.planes).all()):
        raise ValueError("a face has a corner or a plane that is not a finite number")
    return _Levels(faces).built(watch)


class _Levels:
    """The tree as far as it is built."""

    def __init__(self, faces: Faces) -> None:
        self.faces = faces
        self.epsilon = EPSILON * faces.size
        self.polygons = Polygons(faces)
        self.rng = np.random.default_rng(SEED)
        self.planes: list[Floats] = []  # (l, 4) for each level
        self.kinds: list[NDArray[np.int8]] = []  # (l,)
        self.children: list[Numbers] = []  # (l, 2) back and front
        self.owned: list[Numbers] = []  # polygons that have found their place
        self.owners: list[Numbers] = []  # and their nodes
        self.nodes = 0

    @cached_property
    def areas(self) -> Floats:
        return plane_areas(self.faces)

    @cached_property
    def columns(self) -> Floats:
        """(4, p) the planes of the faces."""
        return np.ascontiguousarray(self.faces.planes.T)

    def built(self, progress: Progress) -> Tree:
        which = np.arange(self.faces.count)
        begins = np.array([0, len(which)])
        while len(which):
            progress(placed := sum(map(len, self.owned)), placed + len(which))
            which, begins = self._level(which, begins)
        progress(placed := sum(map(len, self.owned)), placed)
        return self._tree()

    def _level(self, which: Numbers, begins: Numbers) -> tuple[Numbers, Numbers]:
        """One level of nodes, whose polygons are `which`, node after node from `begins`; returns those of the next."""
        count = len(begins) - 1
        kind = self._known_leaves(which, begins)
        node = np.repeat(np.arange(count), np.diff(begins))
        planes, numbers = np.zeros((4, count)), np.full(count, -1)
        inner = np.flatnonzero(kind == INNER)
        some, starts = _of_nodes(which, begins, inner)
        reach = Reach(self.polygons, some)
        if len(inner):
            choice = choose(self.faces, self.polygons, some, starts, reach, self.areas, self.epsilon, self.rng)
            planes[:, inner], numbers[inner] = choice.planes, choice.number
            kind[inner] = self._found_leaves(some, starts, choice.behind, choice.before)
        leaf = kind != INNER
        planes[:, leaf] = 0.0
        placed = leaf[node]
        self._own(which[placed], node[placed])
        node = np.repeat(inner, np.diff(starts))
        if leaf[inner].any():
            still = np.flatnonzero(~leaf[node])
            some, node, reach = some[still], node[still], reach.taken(still)
        found, side = self._parted(some, node, reach, planes, numbers)

        # The next level: the back child of each node, then its front child, where anything went there.
        order = np.argsort(side, kind="stable")
        found, side = found[order], side[order]
        firsts = np.flatnonzero(np.diff(side, prepend=-1))
        children = np.full(2 * count, -1)
        children[side[firsts]] = self.nodes + count + np.arange(len(firsts))
        self.planes.append(planes.T)
        self.kinds.append(kind)
        self.children.append(children.reshape(-1, 2))
        self.nodes += count
        return found, np.append(firsts, len(found))

    def _parted(
        self, which: Numbers, node: Numbers, reach: Reach, planes: Floats, numbers: Numbers
    ) -> tuple[Numbers, Numbers]:
        """The parts of polygons (f,) on the sides of their node's plane, and on which side: 2 * node, + 1 before it.

        `planes` (4, l) and their `numbers` (l,) among those of the faces. What lies in the plane is the node's own.
        """
        low, high = reach.across(planes.take(node, axis=1))
        own = self.faces.plane_of[self.polygons.source.rows[which]] == numbers[node]
        back, front = (low < -self.epsilon) & ~own, (high > self.epsilon) & ~own
        both, neither = back & front, ~(back | front)
        self._own(which[neither], node[neither])
        pieces = self.polygons.cut(which[both], planes[:, node[both]], self.epsilon)
        back &= ~both
        front &= ~both
        found = np.concatenate((which[back], pieces[0], which[front], pieces[1]))
        side = np.concatenate((2 * node[back], 2 * node[both], 2 * node[front] + 1, 2 * node[both] + 1))
        return found, side

    def _own(self, which: Numbers, node: Numbers) -> None:
        self.owned.append(which)
        self.owners.append(self.nodes + node)

    def _known_leaves(self, which: Numbers, begins: Numbers) -> NDArray[np.int8]:
        """(l,) the kinds of nodes by what is known of their faces."""
        source = self.polygons.source.rows[which]
        group, starts = self.faces.group[source], begins[:-1]
        least, most = np.minimum.reduceat(group, starts), np.maximum.reduceat(group, starts)
        one = (least == most) & (least >= 0)
        kind = np.where(self.faces.side[source[starts]] < 0, CONCAVE, CONVEX).astype(np.int8)
        if not one.all():
            areas = self.areas[self.faces.plane_of[source]]
            alone = (np.diff(begins) == 1) | (np.maximum.reduceat(areas, starts) == 0.0)
            kind[~one] = np.where(alone[~one], CONVEX, INNER)
        return kind

    def _found_leaves(
        self, which: Numbers, begins: Numbers, behind: NDArray[np.bool_], before: NDArray[np.bool_]
    ) -> NDArray[np.int8]:
        """(l,) the kinds of nodes by comparing their polygons with one another's planes, where there is hope.

        In turn k every polygon meets the plane of the one k places further round its node.
        """
        sizes = np.diff(begins)
        behind, before = behind & (sizes <= MUTUAL), before & (sizes <= MUTUAL)
        hopeful = np.flatnonzero(behind | before)
        some, starts = _of_nodes(which, begins, hopeful)
        plane_of = self.faces.plane_of[self.polygons.source.rows[some]]
        node = np.repeat(hopeful, np.diff(starts))
        first = np.repeat(starts[:-1], np.diff(starts))
        turn, around = 1, np.arange(len(some)) - first
        reach = Reach(self.polygons, some)
        alive = np.arange(len(some))
        while len(alive):
            other = plane_of[first[alive] + (around[alive] + turn) % sizes[node[alive]]]
            low, high = reach.across(self.columns.take(other, axis=1))
            counts = (other != plane_of[alive]) & (self.areas[other] > 0.0)
            # Two that face each other in one plane are neither: the order of their sources counts.
            flat = np.flatnonzero(counts & (high <= self.epsilon) & (low >= -self.epsilon))
            pair = self.faces.planes[other[flat], :3], self.faces.planes[plane_of[alive[flat]], :3]
            opposed = node[alive[flat[np.einsum("ij,ij->i", *pair) < 0.0]]]
            behind[opposed] = before[opposed] = False
            behind[node[alive[counts & (high > self.epsilon)]]] = False
            before[node[alive[counts & (low < -self.epsilon)]]] = False
            turn += 1
            keep = np.flatnonzero((behind | before)[node[alive]] & (turn < sizes[node[alive]]))
            if len(keep) < len(alive):
                alive, reach = alive[keep], reach.taken(keep)
        return np.where(behind, CONVEX, np.where(before, CONCAVE, INNER)).astype(np.int8)

    def _tree(self) -> Tree:
        owned, owners = np.concatenate(self.owned), np.concatenate(self.owners)
        order = np.lexsort((self.polygons.source.rows[owned], owners))
        owned, owners = owned[order], owners[order]
        sizes = self.polygons.sizes.rows[owned]
        children = np.concatenate(self.children).astype(np.int32)
        counts = np.bincount(owners, minlength=self.nodes)
        return Tree(
            faces=self.faces,
            epsilon=self.epsilon,
            points=self.polygons.points.rows.copy(),
            corners=self.polygons.corners.rows[spread(self.polygons.starts.rows[owned], sizes)].astype(np.int32),
            starts=np.concatenate(([0], np.cumsum(sizes))).astype(np.int32),
            source=self.polygons.source.rows[owned].astype(np.int32),
            plane=np.concatenate(self.planes),
            front=children[:, 1].copy(),
            back=children[:, 0].copy(),
            first=(np.cumsum(counts) - counts).astype(np.int32),
            count=counts.astype(np.int32),
            kind=np.concatenate(self.kinds),
            root=0,
        )


def plane_areas(faces: Faces) -> Floats:
    """(p,) twice the area of the faces in each plane, of those that are wide enough to have a plane at all."""
    sizes = np.diff(faces.starts).astype(np.int64)
    begin = faces.starts[:-1].astype(np.int64)
    ring = np.ascontiguousarray(faces.points.take(faces.corners, axis=0).T)  # (3, c)
    after = np.arange(1, ring.shape[1] + 1)
    after[begin + sizes - 1] = begin
    ahead = ring[:, after]
    around = np.add.reduceat(np.sqrt(((ahead - ring) ** 2).sum(axis=0)), begin)
    origin = np.repeat(ring[:, begin], sizes, axis=1)
    (x, y, z), (u, v, w) = ring - origin, ahead - origin
    across = np.array([y * w - z * v, z * u - x * w, x * v - y * u])
    area = np.sqrt((np.add.reduceat(across, begin, axis=1) ** 2).sum(axis=0))
    wide = area > SLIM * faces.size * around
    return np.bincount(faces.plane_of[wide], area[wide], len(faces.planes)).astype(np.float64)


def _of_nodes(which: Numbers, begins: Numbers, nodes: Numbers) -> tuple[Numbers, Numbers]:
    """The polygons of some of the nodes, and where each one's begin."""
    if len(nodes) == len(begins) - 1:
        return which, begins
    sizes = np.diff(begins)[nodes]
    return which[spread(begins[:-1][nodes], sizes)], np.concatenate(([0], np.cumsum(sizes)))
