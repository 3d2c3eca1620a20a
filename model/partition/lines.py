"""Lines in the box around a scene, and whether their points lie on fragments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .clusters import Floats, Numbers
from .tree import Tree


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """Parts of lines, from `begin` to `end` millimetres after an origin that was moved `before` along its line.

    The origin is where the line comes into the scene: far away the last digits are lost.
    """

    origin: Floats  # (n, 3)
    direction: Floats  # (n, 3) unit
    begin: Floats  # (n,) greater than `end` where nothing is left
    end: Floats  # (n,)
    before: Floats  # (n,)

    def block(self, rows: slice) -> Lines:
        return Lines(self.origin[rows], self.direction[rows], self.begin[rows], self.end[rows], self.before[rows])


class Scene:
    """The box around a tree's faces."""

    def __init__(self, tree: Tree) -> None:
        points = tree.faces.points
        self._empty = not len(points)
        self._slack = 4.0 * tree.epsilon
        self._low, self._high = (np.zeros(3),) * 2 if self._empty else (points.min(axis=0), points.max(axis=0))
        self.size = float(np.linalg.norm(self._high - self._low))

    def lines(self, origins: ArrayLike, directions: ArrayLike, near: ArrayLike, far: ArrayLike) -> Lines:
        """What of rays (n, 3), (n, 3) lies in the box, from `near` to `far`. Raises ValueError for what is no ray."""
        origin = np.asarray(origins, float).reshape(-1, 3)
        along = np.asarray(directions, float).reshape(-1, 3)
        length = np.linalg.norm(along, axis=1)
        begins = np.broadcast_to(np.asarray(near, float), (len(origin),))
        ends = np.broadcast_to(np.asarray(far, float), (len(origin),))
        if len(origin) != len(along) or not (np.isfinite(origin).all() and np.isfinite(length).all()):
            raise ValueError("a ray needs an origin and a direction whose coordinates are numbers")
        if not length.all():
            raise ValueError("a ray needs a direction that is not zero")
        if not (begins <= ends).all():
            raise ValueError("a ray must not end before it begins")
        along = along / length[:, None]
        inverse = 1.0 / np.where(np.abs(along) < 1e-200, 1e-200, along)
        one, two = (self._low - self._slack - origin) * inverse, (self._high + self._slack - origin) * inverse
        enters = np.maximum(np.minimum(one, two).max(axis=1), begins)
        leaves = np.minimum(np.maximum(one, two).min(axis=1), ends)
        meets = (enters <= leaves) & (not self._empty)
        before = np.where(meets, enters, 0.0)
        return Lines(
            origin + before[:, None] * along,
            along,
            np.where(meets, 0.0, 1.0),
            np.where(meets, leaves - before, 0.0),
            before,
        )


class Borders:
    """The sides of fragments as planes (c, 4) across them that look inwards, one a corner."""

    def __init__(self, tree: Tree) -> None:
        self._tree = tree
        self._all: Floats | None = None

    def prepare(self) -> None:
        """Reckon all of them once, for many rays."""
        if self._all is None:
            sizes = np.diff(self._tree.starts).astype(np.int64)
            fragment = np.repeat(np.arange(len(sizes)), sizes)
            self._all = self._sides(fragment, np.arange(len(fragment)))

    @property
    def all(self) -> Floats:
        """(c, 4) of all fragments, after each other."""
        self.prepare()
        assert self._all is not None
        return self._all

    def cover(self, fragment: Numbers, points: Floats, slack: float) -> NDArray[np.bool_]:
        """(k,) whether points (k, 3) in the planes of fragments (k,) lie on them, or at most `slack` beside."""
        starts = self._tree.starts
        first, corners = starts[fragment].astype(np.int64), np.diff(starts)[fragment]
        inside = np.ones(len(fragment), bool)
        left = np.arange(len(fragment))
        number = 0
        while len(left):  # the first side drops half of them, the second half of the rest
            corner = first[left] + number
            side = self._sides(fragment[left], corner) if self._all is None else self._all[corner]
            beside = np.einsum("ij,ij->i", side[:, :3], points[left]) - side[:, 3] < -slack
            inside[left[beside]] = False
            number += 1
            left = left[~beside & (corners[left] > number)]
        return inside

    def _sides(self, fragment: Numbers, corner: Numbers) -> Floats:
        tree = self._tree
        after = np.where(corner + 1 == tree.starts[fragment + 1], tree.starts[fragment], corner + 1)
        here = tree.points[tree.corners[corner]]
        along = tree.points[tree.corners[after]] - here
        normals = tree.faces.planes[tree.faces.plane_of[tree.source[fragment]], :3]
        inwards = np.cross(normals, along)
        length = np.linalg.norm(along, axis=1)  # 0: two corners in one place, between which there is no side
        inwards /= np.where(length > 0.0, length, 1.0)[:, None]
        return np.column_stack((inwards, np.einsum("ij,ij->i", inwards, here)))
