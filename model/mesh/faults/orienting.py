"""Triangles turned so that they agree about the outside, and doubled ones dropped."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..pieces import pieces
from .report import arrays_of
from .sides import Flags, Floats, Numbers, shells, sides_of, signed_volume
from .welding import proper
from .words import many

BLOCK = 1 << 20
"""Triangles whose solid angles are summed at once."""


def orient(vertices: ArrayLike, triangles: ArrayLike) -> tuple[Floats, Numbers, str]:
    """Triangles turned so that neighbours agree, as few as will do, and closed surfaces so that they face outwards.

    Neighbours are those at edges of two triangles. A closed surface that faces inwards is turned together with all that
    lies within it, so that cavities stay cavities; of open ones only the neighbours are made to agree. What has one
    side only, as Möbius's band, is left as it is. Returns vertices (n, 3), triangles (m, 3) and words about what
    changed. Raises Refusal as `find_faults` does.
    """
    points, faces = arrays_of(vertices, triangles)
    faces = proper(faces)
    turn, one_sided = _disagreeing(faces, len(points))
    result = np.where(turn[:, None], faces[:, ::-1], faces)
    inward = _inward(points, result)
    result = np.where(inward[:, None], result[:, ::-1], result)
    turned = turn ^ inward
    words = [f"{many(int(turned.sum()), 'triangle')} turned"] if turned.any() else []
    if one_sided:
        words.append(
            f"{many(one_sided, 'surface')} with one side only left as {'it is' if one_sided == 1 else 'they are'}"
        )
    return points, np.where(turned[:, None], faces[:, ::-1], faces), ", ".join(words)


def drop_duplicates(vertices: ArrayLike, triangles: ArrayLike) -> tuple[Floats, Numbers, str]:
    """Of triangles with the same corners one kept, the first; of those back to back the one that edges lack, or none.

    Two faces back to back enclose nothing: without both a closed surface stays closed. Returns as `orient` does.
    """
    points, faces = arrays_of(vertices, triangles)
    faces = proper(faces)
    lowest = np.argmin(faces, axis=1) if len(faces) else np.zeros(0, np.int64)
    rolled = np.take_along_axis(faces, (lowest[:, None] + np.arange(3)) % 3, axis=1)
    forth = rolled[:, 1] < rolled[:, 2]
    _, which = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True)
    which = which.reshape(-1)
    there = np.bincount(which, forth, int(which.max(initial=-1)) + 1)
    back = np.bincount(which, ~forth, len(there))
    balance = there - back
    even = (balance == 0)[which]
    balance = np.where(even, _lacking(faces, len(points)) * np.where(forth, 1, -1), balance[which])
    rows = np.flatnonzero(np.where(forth, balance > 0, balance < 0))
    kept = np.zeros(len(faces), bool)
    kept[rows[np.unique(which[rows], return_index=True)[1]]] = True
    gone = np.bincount(which, minlength=len(there)) - np.bincount(which, kept, len(there)).astype(np.int64)
    pairs = int((there[gone == there + back] > 0).sum())
    again = len(faces) - int(kept.sum()) - int(gone[gone == there + back].sum())
    words = [f"{many(again, 'repeated triangle')} dropped"] if again else []
    if pairs:
        words.append(f"{many(pairs, 'pair')} of triangles back to back dropped")
    return points, faces[kept], ", ".join(words)


def _lacking(faces: Numbers, count: int) -> Numbers:
    """(m,) 1 where the edges of a triangle that stands back to back with another would run more evenly forth and back
    with it alone, -1 with the other alone, 0 without both."""
    sides = sides_of(faces, count)
    net = (2 * sides.forward - sides.uses)[sides.edge].reshape(-1, 3)
    way = np.where(sides.start < sides.end, 1, -1).reshape(-1, 3)
    none, mine, other = (np.abs(net + k * way).sum(axis=1) for k in (0, 1, -1))
    return np.where(mine < np.minimum(none, other), 1, np.where(other < np.minimum(none, mine), -1, 0))


def _disagreeing(faces: Numbers, count: int) -> tuple[Flags, int]:
    """(m,) the triangles to turn, and the number of one-sided surfaces.

    Each triangle stands twice, as it is and turned, joined to the copies of its neighbours that agree with it. The
    copies of a two-sided surface hang together in two halves, of which one is taken.
    """
    sides = sides_of(faces, count)
    order = np.argsort(sides.edge, kind="stable")
    order = order[(sides.uses == 2)[sides.edge[order]]].reshape(-1, 2)
    one, two = order[:, 0] // 3, order[:, 1] // 3
    against = sides.turned[sides.edge[order[:, 0]]]
    number = len(faces)
    copy = np.where(against, number, 0)
    label = pieces(
        np.concatenate((one, one + number)),
        np.concatenate((two + copy, two + number - copy)),
        2 * number,
    )
    as_is, turned = label[:number], label[number:]
    fixed = as_is == turned
    surface = np.minimum(as_is, turned)
    flipped = as_is != surface  # the triangles that must be turned where the half of the first triangle is taken
    share = np.bincount(surface, flipped, 2 * number) > np.bincount(surface, minlength=2 * number) / 2.0
    return ~fixed & (flipped ^ share[surface]), len(np.unique(surface[fixed]))


def _inward(points: Floats, faces: Numbers) -> Flags:
    """(m,) triangles of closed surfaces that face inwards, and of what lies within those."""
    sides = sides_of(faces, len(points))
    shell = shells(sides)
    count = int(shell.max(initial=-1)) + 1
    odd = 2 * sides.forward != sides.uses
    broken = np.zeros(count, bool)
    broken[shell[sides.first[odd] // 3]] = True
    volume = np.bincount(shell, signed_volume(points, faces), count)
    if not (volume[~broken] < 0.0).any():
        return np.zeros(len(faces), bool)
    closed = np.flatnonzero(~broken)
    order = np.argsort(shell, kind="stable")
    starts = np.searchsorted(shell[order], np.arange(count + 1))
    corners = points[faces[order]]
    low = np.minimum.reduceat(corners.min(axis=1), starts[:-1])
    high = np.maximum.reduceat(corners.max(axis=1), starts[:-1])
    outer = np.argsort(-np.prod(high[closed] - low[closed], axis=1), kind="stable")
    turned = np.zeros(count, bool)
    settled = broken.copy()
    for k in closed[outer].tolist():  # from the largest box to the smallest: nothing lies in a smaller one
        if settled[k]:
            continue
        settled[k] = True
        within = ~settled & (low >= low[k]).all(axis=1) & (high <= high[k]).all(axis=1)
        inside = np.flatnonzero(within)
        first = corners[starts[inside], 0]
        inside = inside[np.abs(windings(first, corners[starts[k] : starts[k + 1]])) > 0.5]
        settled[inside] = True
        turned[k] = turned[inside] = volume[k] < 0.0
    return turned[shell]


def windings(points: Floats, corners: Floats) -> Floats:
    """How often triangles (m, 3, 3) wind round points (n, 3): the sum of the solid angles over a full one (Van Oosterom
    and Strackee 1983)."""
    found = np.zeros(len(points))
    for row, point in enumerate(points):
        for begin in range(0, len(corners), BLOCK):
            a, b, c = np.moveaxis(corners[begin : begin + BLOCK] - point, 1, 0)
            la, lb, lc = (np.linalg.norm(part, axis=1) for part in (a, b, c))
            ab, bc, ca = (np.einsum("ij,ij->i", one, two) for one, two in ((a, b), (b, c), (c, a)))
            triple = np.einsum("ij,ij->i", a, np.cross(b, c))
            found[row] += np.arctan2(triple, la * lb * lc + ab * lc + bc * la + ca * lb).sum() / (2.0 * np.pi)
    return found
