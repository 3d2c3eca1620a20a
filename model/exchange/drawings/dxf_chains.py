"""Loose lines and curves joined, end to end, into closed contours and what stays open."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ...path.path import Command, Floats


@dataclass(slots=True, eq=False)
class Piece:
    """What begins at a point and goes on by commands, all but "move" and "close"; points are (2,), mm."""

    start: Floats
    commands: list[Command]
    closed: bool = False

    @property
    def end(self) -> Floats:
        return _end(self.commands[-1])

    @property
    def straight(self) -> bool:
        """Whether it is one line."""
        return len(self.commands) == 1 and self.commands[0][0] == "line"

    def points(self) -> Floats:
        """(k, 2) of its control polygon."""
        rows = [self.start[None]]
        for word, *given in self.commands:
            rows.append(given[0].points if word == "spline" else np.array(given))
        return np.concatenate(rows)

    def reversed(self) -> Piece:
        ends = [self.start, *(_end(command) for command in self.commands[:-1])]
        back: list[Command] = []
        for (word, *given), end in zip(reversed(self.commands), reversed(ends), strict=True):
            back.append((word, given[0].reversed()) if word == "spline" else (word, *given[-2::-1], end))
        return Piece(self.end, back, self.closed)

    def moved(self, start: Floats, end: Floats) -> Piece:
        """The same with its ends put where they should be, and the handles there with them."""
        off, over = start - self.start, end - self.end
        if not (off.any() or over.any()):
            return self
        commands = list(self.commands)
        for place, by, first in ((0, off, True), (-1, over, False)):
            word, *given = commands[place]
            if word == "spline":
                commands[place] = (word, _shifted(given[0], by, first))
                continue
            if first and len(given) > 1:
                given[0] = given[0] + by
            elif not first:
                given[-1] = end
                if len(given) == 3:
                    given[1] = given[1] + by
            commands[place] = (word, *given)
        return Piece(start, commands, self.closed)


def _end(command: Command) -> Floats:
    if command[0] != "spline":
        return command[-1]
    from ...spline.bspline import ends

    return ends(command[1])[1]


def _shifted(spline, by: Floats, first: bool):
    """A spline with one end moved where an end is a control point; else as it is, and a short line will lead there."""
    if not spline.clamped:
        return spline
    points = spline.points.copy()
    points[0 if first else -1] += by
    return replace(spline, points=points)


@dataclass(slots=True)
class Joined:
    """What became of the pieces."""

    closed: list[Piece]
    open: list[Piece]
    doubled: int = 0
    """lines that lay on others, end to end, and are left out"""
    dividing: int = 0
    """open ones that lead from one place of a closed contour to another"""


@dataclass(slots=True, eq=False)
class _Chain:
    pieces: list[Piece]
    first: int
    last: int

    def reversed(self) -> _Chain:
        return _Chain([piece.reversed() for piece in reversed(self.pieces)], self.last, self.first)

    def joined(self) -> Piece:
        return Piece(self.pieces[0].start, [command for piece in self.pieces for command in piece.commands])

    def length(self) -> float:
        return sum(float(np.linalg.norm(np.diff(piece.points(), axis=0), axis=1).sum()) for piece in self.pieces)


def join(pieces: Sequence[Piece], gap: float) -> Joined:
    """Ends that are nearer than `gap` mm become one node. What runs through nodes of two ends is one chain.

    Where more than two ends meet, chains that lead nowhere stay open, and the shortest that make an odd number of ends
    even (a line across an outline); of the rest closed contours are made that pass each node once. Under the even-odd
    rule they fill the same however they are parted. What is shorter than `gap` is left out.
    """
    found = Joined([piece for piece in pieces if piece.closed], [])
    loose = [piece for piece in pieces if not piece.closed]
    if not loose:
        return found
    ends = np.array([(piece.start, piece.end) for piece in loose])
    labels = clusters(ends.reshape(-1, 2), gap).reshape(-1, 2)
    flat = ends.reshape(-1, 2)
    edges: list[_Chain] = []
    lines: set[tuple[int, int]] = set()
    for piece, (a, b) in zip(loose, labels.tolist(), strict=True):
        if a == b and np.ptp(piece.points(), axis=0).max() <= gap:
            continue
        if piece.straight:
            key = (min(a, b), max(a, b))
            if key in lines:
                found.doubled += 1
                continue
            lines.add(key)
        edges.append(_Chain([piece.moved(flat[a], flat[b])], a, b))
    chains = []
    for chain in _chains(edges):
        if chain.first == chain.last and len(chain.pieces) and _alone(chain):
            found.closed.append(_closing(chain))
        else:
            chains.append(chain)
    _untangle(chains, found)
    return found


def clusters(points: Floats, gap: float) -> NDArray[np.intp]:
    """(n,) for each point (n, 2) the number of the first point of its cluster; nearer than `gap` is together.

    In four grids of cells of twice the gap, each shifted by half a cell, two near points share a cell of one of them.
    """
    label = np.arange(len(points))
    for shift in ((0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)):
        cells = np.floor(points / (2.0 * gap) + shift)
        order = np.lexsort((points[:, 1], points[:, 0], cells[:, 1], cells[:, 0]))
        same = (np.diff(cells[order], axis=0) == 0.0).all(axis=1)
        near = np.linalg.norm(np.diff(points[order], axis=0), axis=1) <= gap
        for here, there in zip(order[:-1][same & near].tolist(), order[1:][same & near].tolist(), strict=True):
            a, b = _root(label, here), _root(label, there)
            label[max(a, b)] = min(a, b)
    while (label[label] != label).any():
        label = label[label]
    return label


def _root(label: NDArray[np.intp], at: int) -> int:
    while label[at] != at:
        label[at] = label[label[at]]
        at = int(label[at])
    return at


def _ends_of(chains: Iterable[_Chain]) -> dict[int, list[_Chain]]:
    """The chains that end at each node; one that begins and ends there stands twice."""
    at: dict[int, list[_Chain]] = defaultdict(list)
    for chain in chains:
        at[chain.first].append(chain)
        at[chain.last].append(chain)
    return at


def _chains(edges: list[_Chain]) -> list[_Chain]:
    """Edges joined where exactly two ends meet."""
    at = _ends_of(edges)
    used: set[int] = set()
    found = []
    # From nodes where not two ends meet first: what is left then runs in circles.
    begins = [edge for edge in edges if len(at[edge.first]) != 2 or len(at[edge.last]) != 2]
    for edge in (*begins, *edges):
        if id(edge) in used:
            continue
        used.add(id(edge))
        chain = edge if len(at[edge.first]) != 2 or len(at[edge.last]) == 2 else edge.reversed()
        pieces, last = list(chain.pieces), chain.last
        while len(at[last]) == 2 and (rest := [other for other in at[last] if id(other) not in used]):
            used.add(id(rest[0]))
            step = rest[0] if rest[0].first == last else rest[0].reversed()
            pieces += step.pieces
            last = step.last
        found.append(_Chain(pieces, chain.first, last))
    return found


def _alone(chain: _Chain) -> bool:
    return len(chain.pieces) > 1 or not chain.pieces[0].straight


def _closing(chain: _Chain) -> Piece:
    piece = chain.joined()
    piece.closed = True
    return piece


def _untangle(chains: list[_Chain], found: Joined) -> None:
    """Parts chains that meet at nodes of one, three or more ends into closed contours and open ones."""
    at = _ends_of(chains)
    degree = {node: len(here) for node, here in at.items()}
    gone: set[int] = set()

    def remove(chain: _Chain) -> None:
        gone.add(id(chain))
        degree[chain.first] -= 1
        degree[chain.last] -= 1
        found.open.append(chain.joined())

    leaves = [node for node, count in degree.items() if count == 1]
    while leaves:
        node = leaves.pop()
        for chain in at[node]:
            if id(chain) not in gone and degree[node] == 1:
                remove(chain)
                leaves += [end for end in (chain.first, chain.last) if degree[end] == 1]
    rest = sorted((chain for chain in chains if id(chain) not in gone), key=_Chain.length)
    for chain in rest:
        if chain.first != chain.last and degree[chain.first] % 2 and degree[chain.last] % 2:
            remove(chain)
            found.dividing += 1
    for node in [node for node, count in degree.items() if count % 2]:
        stack = [node]
        while stack:
            for chain in at[stack.pop()]:
                if id(chain) not in gone:
                    remove(chain)
                    found.dividing += 1
                    stack += [chain.first, chain.last]
    for chain in rest:
        if id(chain) not in gone:
            found.closed += _loops(chain, at, gone)


def _loops(begin: _Chain, at: dict[int, list[_Chain]], gone: set[int]) -> list[Piece]:
    """Closed contours of chains that meet in even numbers, from a chain on; each passes a node once."""
    found: list[Piece] = []
    trail: list[_Chain] = []
    seen = {begin.first: 0}  # node -> how many chains of the trail lead to it
    step: _Chain | None = begin
    gone.add(id(begin))
    while step is not None:
        trail.append(step)
        node = step.last
        if node in seen:
            loop = trail[seen[node] :]
            del trail[seen[node] :]
            for chain in loop[:-1]:
                seen.pop(chain.last, None)
            seen[node] = len(trail)
            found.append(_closing(_Chain([piece for chain in loop for piece in chain.pieces], node, node)))
            if not trail:
                return found
        else:
            seen[node] = len(trail)
        step = next((chain for chain in at[node] if id(chain) not in gone), None)
        if step is not None:
            gone.add(id(step))
            step = step if step.first == node else step.reversed()
    return found
