"""What can be said of a tree and its nodes: counts, sub-trees, and the way down of a point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .tree import INNER, Tree

Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Counts:
    """The size of a tree."""

    faces: int  # with at least one fragment in the tree
    fragments: int
    splits: int  # how often a face was cut in two
    nodes: int
    depth: int
    leaves: int  # nodes without a plane

    @property
    def fragments_per_face(self) -> float:
        return self.fragments / self.faces if self.faces else 0.0


def counts(tree: Tree) -> Counts:
    levels = tree.levels()
    reached = np.concatenate(levels) if levels else np.zeros(0, np.int64)
    fragments = owned(tree, reached)
    faces = len(np.unique(tree.source[fragments]))
    return Counts(
        faces=faces,
        fragments=len(fragments),
        splits=len(fragments) - faces,
        nodes=len(reached),
        depth=len(levels),
        leaves=int((tree.kind[reached] != INNER).sum()),
    )


def owned(tree: Tree, nodes: Numbers) -> Numbers:
    """The fragments that these nodes own, node after node."""
    many = tree.count[nodes].astype(np.int64)
    return np.repeat(tree.first[nodes] - np.cumsum(many) + many, many) + np.arange(int(many.sum()))


def below(tree: Tree, node: int) -> Numbers:
    """A node and all that hang from it, level by level; nothing for -1."""
    level = np.array([node] if node >= 0 else [], np.int64)
    found = [level]
    while len(level):
        both = np.concatenate((tree.front[level], tree.back[level])).astype(np.int64)
        level = both[both >= 0]
        found.append(level)
    return np.concatenate(found)


def parents(tree: Tree) -> Numbers:
    """(k,) the node above each reachable one; -1 for the root and for what cannot be reached."""
    result = np.full(len(tree.kind), -1, np.int64)
    for level in tree.levels():
        for children in (tree.front[level], tree.back[level]):
            there = children >= 0
            result[children[there]] = level[there]
    return result


def sizes(tree: Tree) -> Numbers:
    """(k,) how many nodes each reachable node's sub-tree has, itself included; 0 for the others."""
    result = np.zeros(len(tree.kind) + 1, np.int64)  # the last one stands for "nothing there"
    for level in reversed(tree.levels()):
        result[level] = 1 + result[tree.front[level]] + result[tree.back[level]]
    return result[:-1]


def node_of_fragments(tree: Tree) -> Numbers:
    """(f,) the node that owns each fragment, -1 where no reachable one does."""
    result = np.full(len(tree.source), -1, np.int64)
    levels = tree.levels()
    if levels:
        reached = np.concatenate(levels)
        result[owned(tree, reached)] = np.repeat(reached, tree.count[reached])
    return result


def cut_fragments(tree: Tree) -> NDArray[np.bool_]:
    """(f,) which fragments are pieces of faces that were cut."""
    pieces = np.bincount(tree.source[node_of_fragments(tree) >= 0], minlength=tree.faces.count)
    return np.asarray(pieces[tree.source] > 1)


@dataclass(frozen=True, slots=True)
class Step:
    """One node on the way of a point p down a tree."""

    node: int
    height: float  # f(p) = normal · p - offset, in mm; above 0 in front; nan in a leaf
    side: str  # "front", "back" or "in" the plane (then the way goes on in front); "" in a leaf


def way_down(tree: Tree, point: ArrayLike) -> tuple[Step, ...]:
    """The nodes from the root to the cell that a point (3,) lies in."""
    place = np.asarray(point, float)
    found: list[Step] = []
    node = tree.root
    while node >= 0:
        if tree.kind[node] != INNER:
            found.append(Step(node, float("nan"), ""))
            break
        height = float(tree.plane[node, :3] @ place - tree.plane[node, 3])
        side = "in" if abs(height) <= tree.epsilon else "front" if height > 0.0 else "back"
        found.append(Step(node, height, side))
        node = int(tree.back[node] if side == "back" else tree.front[node])
    return tuple(found)
