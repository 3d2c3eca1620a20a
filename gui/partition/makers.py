"""Which solids and nodes the faces of a tree come from, and what is said of a node of the tree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...model.document.document import Document
from ...model.document.tree import walk
from ...model.partition.descent import below, cut_fragments, node_of_fragments, owned
from ...model.partition.tree import CONVEX, INNER, Tree
from ..status import figure
from ..view.occurrences import Path, maker_of
from .inks import inks_now

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh

Numbers = NDArray[np.int64]
MOST_NAMED = 4


class Makers:
    """The makers of a tree's faces, which are the triangles of meshes, one mesh after the other."""

    def __init__(
        self, tree: Tree, document: Document, meshes: Mapping[str, DisplayMesh], solid_ids: Sequence[str]
    ) -> None:
        self.tree = tree
        self.cut = cut_fragments(tree)
        self.node_of = node_of_fragments(tree)
        self.paths: list[Path] = []
        numbers: list[NDArray[np.int64]] = []
        for solid_id in solid_ids:
            mesh = meshes[solid_id]
            # The last one stands for faces without an owner: the solid's own.
            table = np.append(np.arange(len(mesh.owners)), len(mesh.owners))
            numbers.append(len(self.paths) + table[mesh.owner])
            self.paths += [*mesh.owners, (solid_id,)]
        self.maker_of_face = np.concatenate(numbers) if numbers else np.zeros(0, np.int64)
        self._labels = {node.id: node.label for node in walk(*document.roots)}

    def label(self, node_id: str) -> str:
        return self._labels.get(node_id, node_id)

    def path(self, fragment: int) -> Path:
        """The occurrence that made a fragment."""
        return self.paths[int(self.maker_of_face[self.tree.source[fragment]])]

    def words(self, fragment: int) -> str:
        """The node that made a fragment, and the solid that it stands in."""
        path = self.path(fragment)
        maker, solid = self.label(maker_of(path)), self.label(str(path[0]))
        whole = "a piece of a cut face" if self.cut[fragment] else "a whole face"
        return f"{whole} of “{maker}”" + (f" in “{solid}”" if maker != solid else "")

    def names(self, fragments: Numbers) -> str:
        """The nodes that made most of the fragments, and how many they made."""
        found = np.bincount(self.maker_of_face[self.tree.source[fragments]], minlength=len(self.paths))
        sums: dict[str, int] = {}
        for place in np.flatnonzero(found):
            node_id = maker_of(self.paths[place])
            sums[node_id] = sums.get(node_id, 0) + int(found[place])
        ordered = sorted(sums.items(), key=lambda entry: -entry[1])
        told = [f"“{escape(self.label(node_id))}” {count:,}" for node_id, count in ordered[:MOST_NAMED]]
        if len(ordered) > MOST_NAMED:
            told.append(f"{len(ordered) - MOST_NAMED:,} more nodes")
        return ", ".join(told)


def equation(plane: NDArray[np.float64]) -> str:
    """a x + b y + c z = d with the plane's numbers, in mm; d is the distance of the plane from the origin."""
    words = ""
    for value, axis in zip(plane[:3].tolist(), "xyz", strict=True):
        if abs(value) < 5e-7:
            continue
        size = "" if abs(abs(value) - 1.0) < 5e-7 else f"{figure(abs(value), 5)}\u202f"
        sign = "\u2212" if value < 0 else "+" if words else ""
        words += f" {sign} {size}{axis}" if words else f"{sign}{size}{axis}"
    offset = round(float(plane[3]), 9) + 0.0
    return f"{words} = {figure(offset, 6).replace('-', chr(0x2212))} mm"


def node_words(makers: Makers, names: Sequence[str], node: int) -> str:
    """What the panel says of a node, as rich text."""
    tree, inks = makers.tree, inks_now()
    own = owned(tree, np.array([node]))
    made = f"<br>From {makers.names(own)}." if len(own) else ""
    cut = int(makers.cut[own].sum())
    if tree.kind[node] != INNER:
        way = "outside" if tree.kind[node] == CONVEX else "inside"
        return (
            f"<b>A leaf</b>: {_pieces(len(own), cut)} of one convex body, seen from its {way}. "
            f"They need no planes and no order, but for which of them face the eye.{made}"
        )
    sides = []
    for child, word, sign, ink in (
        (int(tree.front[node]), "In front", "&gt;", inks.front),
        (int(tree.back[node]), "Behind", "&lt;", inks.back),
    ):
        nodes = below(tree, child)
        held = owned(tree, nodes)
        what = f"{_nodes(len(nodes))}, {_pieces(len(held), int(makers.cut[held].sum()))}" if len(nodes) else "nothing"
        sides.append(f'<br><span style="color:{ink}">{word}, f(p) {sign} 0:</span> {what}.')
    inside = f"{_pieces(len(own), cut)}" if len(own) else "no fragment"
    return (
        f"<b>{names[node]}</b>: f(p) = 0 where {equation(tree.plane[node])}<br>"
        f'<span style="color:{inks.own}">In the plane:</span> {inside}.{made}{"".join(sides)}'
    )


def _nodes(count: int) -> str:
    return f"{count:,} node{'' if count == 1 else 's'}"


def _pieces(count: int, cut: int) -> str:
    of_these = f", {cut:,} of them {'a piece' if cut == 1 else 'pieces'} of cut faces" if cut else ""
    return f"{count:,} fragment{'' if count == 1 else 's'}{of_these}"
