"""Rays through the tree: the first face on a ray, all of them, and whether two points see each other.

The ray's interval is cut at the plane of each node; what lies on the side of its origin comes first, then the fragments
in the plane, then the other side (Sung and Shirley 1992, after Fuchs, Kedem and Naylor 1980). A face is met on its
border, too, and from either side; a face that a ray lies in is not met, but those that it ends at are.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import native
from .casting import Caster
from .clusters import Clusters, Floats, Numbers
from .lines import Borders, Lines, Scene
from .polygons import spread
from .tree import INNER, Tree

Vector = tuple[float, float, float]

WALK = 4.0
"""How many times the tree's epsilon cells are widened for rays, so that none slips through between two of them."""
MOST = 8192
"""Rays that go down the tree together."""
FEW = 16
"""Rays for which the borders of all fragments are not worth reckoning."""
END = 1e-6
"""How far from its ends a line of sight may meet faces, as a part of the scene's size, where nothing else is said."""


@dataclass(frozen=True, slots=True)
class Hit:
    """`distance` in millimetres along the ray, `face` a place in the tree's faces, `normal` its outward unit normal.

    `front`: the ray came from where the normal points to.
    """

    distance: float
    point: Vector
    face: int
    normal: Vector
    front: bool


@dataclass(frozen=True, slots=True, eq=False)
class Hits:
    """Hits of many rays, as arrays: those of a ray in a row, the nearest first."""

    ray: Numbers  # (k,) which of the rays
    distance: Floats  # (k,) millimetres
    face: Numbers  # (k,) places in the tree's faces
    front: NDArray[np.bool_]  # (k,)


def first_hit(
    tree: Tree, origin: ArrayLike, direction: ArrayLike, near: float = 0.0, far: float = np.inf
) -> Hit | None:
    """The first face on a ray from `origin` (3,) along `direction` (3,), of any length but 0; None where there is none.

    Counted is what lies `near` to `far` millimetres away, both included: a ray that begins on a face meets it at 0.
    Raises ValueError where the direction is zero or something is not finite.
    """
    return Rays(tree).hit(origin, direction, near, far)


def hits(
    tree: Tree, origin: ArrayLike, direction: ArrayLike, near: float = 0.0, far: float = np.inf
) -> tuple[Hit, ...]:
    """All faces on a ray, the nearest first; see `first_hit`. An edge gives a hit of each face beside it."""
    rays = Rays(tree)
    found = rays.all(origin, direction, near, far)
    return tuple(
        rays.hit_at(origin, direction, float(distance), int(face))
        for distance, face in zip(found.distance, found.face, strict=True)
    )


def sees(tree: Tree, a: ArrayLike, b: ArrayLike, tolerance: float | None = None) -> bool:
    """Whether the line from a (3,) to b (3,) meets no face.

    Faces within `tolerance` millimetres of its ends do not count, so that points on faces see; nor do those that all of
    it comes as near to. By default that is END of the scene's size. Raises ValueError where something is not finite.
    """
    return bool(Rays(tree).see(a, b, tolerance)[0])


class Rays:
    """Rays through one tree: one at a time, or many at once, all levels in NumPy. Keeps what no ray changes."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self._scene = Scene(tree)
        self._borders = Borders(tree)

    @property
    def size(self) -> float:
        """The diagonal of the box around the scene."""
        return self._scene.size

    @cached_property
    def _clusters(self) -> Clusters:
        return Clusters(self.tree)

    @cached_property
    def _caster(self) -> Caster:
        return Caster(self.tree, self._clusters, self._borders.all, self.size)

    def hit(self, origin: ArrayLike, direction: ArrayLike, near: float = 0.0, far: float = np.inf) -> Hit | None:
        """The first face on a ray; see `first_hit`."""
        line = self._scene.lines(origin, direction, near, far)
        found = self._walk(line)
        return None if found is None else self.hit_at(origin, direction, *found)

    def hit_at(self, origin: ArrayLike, direction: ArrayLike, distance: float, face: int) -> Hit:
        """What there is to tell about a face that a ray meets."""
        along = np.asarray(direction, float)
        along = along / np.linalg.norm(along)
        normal = self.tree.faces.planes[self.tree.faces.plane_of[face], :3]
        point = np.asarray(origin, float) + distance * along
        return Hit(distance, _three(point), face, _three(normal), bool(normal @ along < 0.0))

    def see(self, a: ArrayLike, b: ArrayLike, tolerance: float | None = None) -> NDArray[np.bool_]:
        """(n,) whether the lines from a (n, 3) to b (n, 3) meet no face; see `sees`."""
        starts, ends = np.asarray(a, float).reshape(-1, 3), np.asarray(b, float).reshape(-1, 3)
        if not (np.isfinite(starts).all() and np.isfinite(ends).all()):
            raise ValueError("a line of sight needs points whose coordinates are numbers")
        slack = max(END * self._scene.size if tolerance is None else float(tolerance), self.tree.epsilon)
        away = ends - starts
        length = np.linalg.norm(away, axis=1)
        free = np.ones(len(starts), bool)
        far = np.flatnonzero(length > 2.0 * slack)
        found = self.all(starts[far], away[far], slack, length[far] - slack, grazing=slack)
        free[far[found.ray]] = False
        return free

    def first(
        self, origins: ArrayLike, directions: ArrayLike, near: ArrayLike = 0.0, far: ArrayLike = np.inf
    ) -> tuple[Floats, Numbers]:
        """Of rays (n, 3), (n, 3) the distance (n,) to the first face, inf where there is none, and the face (n,) or -1.

        `near` and `far` are one for all or (n,). Raises ValueError as `first_hit` does.
        """
        if native.available():
            return self._caster.first(self._scene.lines(origins, directions, near, far), WALK * self.tree.epsilon)
        found = self.all(origins, directions, near, far)
        count = len(np.asarray(origins, float).reshape(-1, 3))
        distance, face = np.full(count, np.inf), np.full(count, -1)
        foremost = np.flatnonzero(np.diff(found.ray, prepend=-1))
        distance[found.ray[foremost]] = found.distance[foremost]
        face[found.ray[foremost]] = found.face[foremost]
        return distance, face

    def all(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        near: ArrayLike = 0.0,
        far: ArrayLike = np.inf,
        grazing: float = 0.0,
    ) -> Hits:
        """All faces on rays (n, 3), (n, 3); a face that all of a ray is within `grazing` millimetres of is not met."""
        lines = self._scene.lines(origins, directions, near, far)
        if len(lines.origin) > FEW:
            self._borders.prepare()
        parts = [(np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.int64))]
        for first in range(0, len(lines.origin), MOST):
            line = lines.block(slice(first, first + MOST))
            ray, distance, face = self._met(line, *self._candidates(line, WALK * self.tree.epsilon))
            parts.append((ray + first, distance, face))
        ray, distance, face = (np.concatenate(some) for some in zip(*parts, strict=True))
        once = np.unique(ray * max(self.tree.faces.count, 1) + face, return_index=True)[1]  # a face is cut in pieces
        once = once[np.lexsort((face[once], distance[once], ray[once]))]
        ray, distance, face = ray[once], distance[once], face[once]
        planes = self.tree.faces.planes[self.tree.faces.plane_of[face]]
        rise = np.einsum("ij,ij->i", planes[:, :3], lines.direction[ray])
        if grazing > 0.0:
            base = np.einsum("ij,ij->i", planes[:, :3], lines.origin[ray]) - planes[:, 3]
            begins, ends = (np.broadcast_to(np.asarray(x, float), lines.begin.shape)[ray] for x in (near, far))
            begins, ends = base + rise * (begins - lines.before[ray]), base + rise * (ends - lines.before[ray])
            across = np.maximum(np.abs(begins), np.abs(ends)) > grazing
            ray, distance, face, rise = ray[across], distance[across], face[across], rise[across]
        return Hits(ray, distance, face, rise < 0.0)

    def at(self, points: ArrayLike, tolerance: float) -> tuple[Numbers, Numbers]:
        """The faces within `tolerance` millimetres of points (n, 3): pairs (k,), (k,) of a point and a face."""
        here = np.asarray(points, float).reshape(-1, 3)
        none = np.zeros(len(here))
        lines = Lines(here, np.zeros_like(here), none, none, none)
        row, fragment, _, _ = self._candidates(lines, tolerance)
        face = self.tree.source[fragment].astype(np.int64)
        planes = self.tree.faces.planes[self.tree.faces.plane_of[face]]
        near = np.flatnonzero(np.abs(np.einsum("ij,ij->i", planes[:, :3], here[row]) - planes[:, 3]) <= tolerance)
        near = near[self._borders.cover(fragment[near], here[row[near]], tolerance)]
        return row[near], face[near]

    def _candidates(self, lines: Lines, slack: float) -> tuple[Numbers, Numbers, Floats, Floats]:
        """Lines and fragments that may meet, and where: pairs (k,) from all cells that the lines pass through."""
        tree = self.tree
        row = np.flatnonzero(lines.begin <= lines.end)
        node = np.full(len(row) if tree.root >= 0 else 0, tree.root, np.int64)
        begin, end = lines.begin[row], lines.end[row]
        pairs = [(row[:0], node[:0], begin[:0], end[:0])]
        while len(node):
            plane = tree.plane[node]
            rise = np.einsum("ij,ij->i", plane[:, :3], lines.direction[row])
            base = np.einsum("ij,ij->i", plane[:, :3], lines.origin[row]) - plane[:, 3]
            leaf = tree.kind[node] != INNER
            before, behind = (_part(sign * base, sign * rise, begin, end, slack) for sign in (1.0, -1.0))
            into = np.where(leaf, begin, np.maximum(before[0], behind[0]))
            out = np.where(leaf, end, np.minimum(before[1], behind[1]))
            own = np.flatnonzero((into <= out) & (tree.count[node] > 0))
            pairs += self._own(lines, row[own], node[own], into[own], out[own], slack)
            following = []
            for child, (first, last) in ((tree.front, before), (tree.back, behind)):
                go = np.flatnonzero(~leaf & (first <= last) & (child[node] >= 0))
                following.append((row[go], child[node[go]].astype(np.int64), first[go], last[go]))
            row, node, begin, end = (np.concatenate(some) for some in zip(*following, strict=True))
        row, fragment, begin, end = (np.concatenate(some) for some in zip(*pairs, strict=True))
        return row, fragment, begin, end

    def _own(
        self, lines: Lines, row: Numbers, node: Numbers, begin: Floats, end: Floats, slack: float
    ) -> list[tuple[Numbers, Numbers, Floats, Floats]]:
        """Pairs of lines and the nodes' own fragments near them."""
        boxed = self._clusters.holds(node)
        some = np.flatnonzero(boxed)
        at = row[some]
        which, fragment = self._clusters.near(
            lines.origin[at], lines.direction[at], node[some], begin[some], end[some], slack
        )
        found = [(at[which], fragment, begin[some][which], end[some][which])]
        some = np.flatnonzero(~boxed)
        counts = self.tree.count[node[some]].astype(np.int64)
        which = np.repeat(some, counts)
        fragment = spread(self.tree.first[node[some]].astype(np.int64), counts)
        return [*found, (row[which], fragment, begin[which], end[which])]

    def _walk(self, lines: Lines) -> tuple[float, int] | None:
        """Distance and face of the first hit of a single line: the textbook's walk from front to back."""
        tree, slack = self.tree, WALK * self.tree.epsilon
        if tree.root < 0 or lines.begin[0] > lines.end[0]:
            return None
        origin, direction, before = lines.origin[0], lines.direction[0], float(lines.before[0])
        best = (np.inf, -1)
        # A node with the part of the line in its cell; `own`: its fragments are meant, and what lies below was pushed.
        waiting = [(tree.root, float(lines.begin[0]), float(lines.end[0]), False)]
        while waiting:
            node, begin, end, own = waiting.pop()
            if begin + before > best[0] + slack:
                continue
            if own or tree.kind[node] != INNER:
                best = min(best, self._nearest(lines, node))
                continue
            plane = tree.plane[node]
            rise, base = float(plane[:3] @ direction), float(plane[:3] @ origin) - float(plane[3])
            one, two = base + rise * begin, base + rise * end
            sides = []
            for side, child in ((1.0, int(tree.front[node])), (-1.0, int(tree.back[node]))):
                if child >= 0 and max(side * one, side * two) >= -slack:
                    a = begin if side * one >= -slack else (-side * slack - base) / rise
                    b = end if side * two >= -slack else (-side * slack - base) / rise
                    sides.append((child, a, b, False))
            if one >= 0.0:
                sides.reverse()
            if tree.count[node] and min(one, two) <= slack and max(one, two) >= -slack:
                arrives = begin if abs(one) <= slack else begin + (abs(one) - slack) / abs(rise)
                sides.append((node, arrives, end, True))
                sides.sort(key=lambda entry: entry[1], reverse=True)
            waiting += sides
        return None if best[1] < 0 else best

    def _nearest(self, lines: Lines, node: int) -> tuple[float, int]:
        """Distance and face of the first hit of a single line among a node's own fragments; (inf, -1) for a miss."""
        first = int(self.tree.first[node])
        fragment = np.arange(first, first + int(self.tree.count[node]))
        line = np.zeros(len(fragment), np.int64)
        _, distance, face = self._met(lines, line, fragment, lines.begin[line], lines.end[line])
        if not len(face):
            return np.inf, -1
        nearest = int(np.lexsort((face, distance))[0])
        return float(distance[nearest]), int(face[nearest])

    def _met(
        self, lines: Lines, row: Numbers, fragment: Numbers, begin: Floats, end: Floats
    ) -> tuple[Numbers, Floats, Numbers]:
        """Of lines and fragments that may meet from `begin` to `end` those that do: line, distance, face."""
        tree, slack = self.tree, self.tree.epsilon
        planes = tree.faces.planes[tree.faces.plane_of[tree.source[fragment]]]
        rise = np.einsum("ij,ij->i", planes[:, :3], lines.direction[row])
        base = np.einsum("ij,ij->i", planes[:, :3], lines.origin[row]) - planes[:, 3]
        one, two = base + rise * begin, base + rise * end
        crosses = (np.minimum(one, two) <= slack) & (np.maximum(one, two) >= -slack)
        kept = np.flatnonzero(crosses & (np.abs(rise) * self.size > 2.0 * slack))
        row, fragment = row[kept], fragment[kept]
        distance = np.clip(-base[kept] / rise[kept], lines.begin[row], lines.end[row])
        points = lines.origin[row] + distance[:, None] * lines.direction[row]
        covered = self._borders.cover(fragment, points, slack)
        row, fragment = row[covered], fragment[covered]
        return row, distance[covered] + lines.before[row], tree.source[fragment].astype(np.int64)


def _part(base: Floats, rise: Floats, begin: Floats, end: Floats, slack: float) -> tuple[Floats, Floats]:
    """From where to where lines are before a plane, or at most `slack` behind it; first > last for nowhere."""
    one, two = base + rise * begin, base + rise * end
    with np.errstate(divide="ignore", invalid="ignore"):
        cut = (-slack - base) / rise
    first, last = np.where(one < -slack, cut, begin), np.where(two < -slack, cut, end)
    nowhere = (one < -slack) & (two < -slack)
    return np.where(nowhere, np.inf, first), np.where(nowhere, -np.inf, last)


def _three(values: Floats) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])
