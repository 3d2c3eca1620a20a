"""Curves parallel to a contour, with what joins them at its corners: not yet trimmed where they cross."""

from __future__ import annotations

import numpy as np

from ...curve.bezier import derivatives
from ..fitting import fitted
from ..path import Contour, Floats
from ..pieces import Pieces, pieces_of
from ..shapes import arc_pieces, unit_arc

JOINS = ("round", "miter", "bevel")
CAPS = ("butt", "round", "square")
SAMPLES = 17
"""Points of a parallel through which its cubic is laid."""
HALVINGS = 14
STRAIGHT = 1e-9
"""Radians by which a smooth curve may turn at a node."""


def parallel(contour: Contour, distance: float, tolerance: float, join: str, limit: float) -> list[Floats]:
    """Lines (2, 2) and cubics (4, 2) that run `distance` mm to the right of a contour, in its order.

    Cubics of least squares through the exact parallel, halved until they follow it within `tolerance` mm; parts where
    the curve is bent more sharply than its parallel can be, which never bound anything, are left out. On the outer
    side of corners stands an arc, a miter (up to `limit` times the distance from the node, else as a bevel) or a bevel.
    """
    groups = pieces_of([contour])
    keys, curves = [], []
    for group in groups:
        places, found = _straight(group, distance) if group.degree == 1 else _bent(group, distance, tolerance)
        keys.append(places)
        curves += found
    corners, joins = _joins(groups, contour.closed, distance, tolerance, join, limit)
    keys.append(corners)
    curves += joins
    order = np.argsort(np.concatenate(keys), kind="stable")
    return [curves[number] for number in order.tolist()]


def end_tangents(groups: list[Pieces]) -> tuple[Floats, Floats, Floats, Floats]:
    """Unit tangents (m, 2) where the pieces of a contour begin and end, and these points, in the contour's order."""
    count = sum(len(group.place) for group in groups)
    found = np.zeros((4, count, 2))
    for group in groups:
        points, tangents, _ = _frames(group.controls, group.weights, np.tile([0.0, 1.0], (len(group.place), 1)))
        found[0, group.place], found[1, group.place] = tangents[:, 0], tangents[:, 1]
        found[2, group.place], found[3, group.place] = points[:, 0], points[:, 1]
    return found[0], found[1], found[2], found[3]


def right(tangents: Floats) -> Floats:
    return np.stack((tangents[..., 1], -tangents[..., 0]), axis=-1)


def _frames(controls: Floats, weights: Floats | None, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Points (k, s, 2), unit tangents and curvatures (k, s) at parameters (k, s)."""
    points, speed, bend = derivatives(controls, t, 2, weights)
    size = np.linalg.norm(speed, axis=-1)
    still = size <= 1e-7 * np.abs(np.diff(controls, axis=1)).max(axis=(1, 2))[:, None]
    if still.any():  # a handle on its node: the direction a little further on
        aside = t + np.where(t < 0.5, 1e-6, -1e-6)
        _, near, turn = derivatives(controls, aside, 2, weights)
        speed, bend = np.where(still[..., None], near, speed), np.where(still[..., None], turn, bend)
        size = np.linalg.norm(speed, axis=-1)
    size = np.where(size > 0.0, size, 1.0)
    curvature = (speed[..., 0] * bend[..., 1] - speed[..., 1] * bend[..., 0]) / size**3
    return points, speed / size[..., None], curvature


def _straight(group: Pieces, distance: float) -> tuple[Floats, list[Floats]]:
    along = group.controls[:, 1] - group.controls[:, 0]
    size = np.linalg.norm(along, axis=1)
    real = size > 0.0
    shift = distance * right(along[real] / size[real, None])
    return group.place[real].astype(float), list(group.controls[real] + shift[:, None])


def _bent(group: Pieces, distance: float, tolerance: float) -> tuple[Floats, list[Floats]]:
    """Where each cubic belongs in the contour, and the cubics."""
    row = np.arange(len(group.place))
    low, high = np.zeros(len(row)), np.ones(len(row))
    keys: list[Floats] = []
    curves: list[Floats] = []
    steps = np.linspace(0.0, 1.0, SAMPLES)
    for depth in range(HALVINGS + 1):
        weights = None if group.weights is None else group.weights[row]
        points, tangents, curvature = _frames(
            group.controls[row], weights, low[:, None] + (high - low)[:, None] * steps
        )
        beside = points + distance * right(tangents)
        stretch = 1.0 + distance * curvature
        ahead, real = (stretch > 0.0).all(axis=1), np.ptp(beside, axis=1).max(axis=1) > 1e-3 * tolerance
        tried = np.flatnonzero(ahead & real)
        cubics, off, _ = fitted(beside[tried], tangents[tried, 0], -tangents[tried, -1], 0.1 * tolerance)
        good = np.zeros(len(row), bool)
        good[tried] = (off <= tolerance) | (depth == HALVINGS)
        keys.append(group.place[row[good]] + 0.5 * low[good])
        curves += list(cubics[good[tried]])
        again = ~good & real & (stretch > 0.0).any(axis=1)
        if depth == HALVINGS or not again.any():
            break
        middle = 0.5 * (low + high)[again]
        row = np.tile(row[again], 2)
        low, high = np.concatenate((low[again], middle)), np.concatenate((middle, high[again]))
    return np.concatenate(keys), curves


def _joins(
    groups: list[Pieces], closed: bool, distance: float, tolerance: float, join: str, limit: float
) -> tuple[Floats, list[Floats]]:
    first, last, _, ends = end_tangents(groups)
    count = len(first)
    before = np.arange(count if closed else count - 1)
    after = (before + 1) % count
    a, b = last[before], first[after]
    turn = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1))
    turn = np.where(np.abs(turn) > np.pi - STRAIGHT, np.copysign(np.pi, distance), turn)
    keys: list[float] = []
    curves: list[Floats] = []
    for number in np.flatnonzero((turn * distance > 0.0) & (np.abs(turn) > STRAIGHT)).tolist():
        for curve in corner(ends[before[number]], a[number], float(turn[number]), distance, tolerance, join, limit):
            keys.append(before[number] + 0.75)
            curves.append(curve)
    return np.array(keys), curves


def corner(
    node: Floats, tangent: Floats, turn: float, distance: float, tolerance: float, join: str, limit: float
) -> list[Floats]:
    """What leads around the outer side of a node (2,) where the direction turns by `turn` radians."""
    c, s = np.cos(turn), np.sin(turn)
    normal = right(tangent)
    begin = node + distance * normal
    end = node + distance * np.array([c * normal[0] - s * normal[1], s * normal[0] + c * normal[1]])
    if join == "round":
        start = np.degrees(np.arctan2(*(begin - node)[::-1]))
        pieces = arc_pieces(abs(distance), np.degrees(turn), tolerance)
        return list(node + abs(distance) * unit_arc(start, np.degrees(turn), pieces))
    half = np.cos(0.5 * turn)
    if join == "miter" and half * limit >= 1.0:
        tip = node + (0.5 * (begin + end) - node) / half**2
        return [np.stack((begin, tip)), np.stack((tip, end))]
    return [np.stack((begin, end))]


def cap(node: Floats, tangent: Floats, half: float, tolerance: float, kind: str) -> list[Floats]:
    """From the right side of the end (2,) of a stroke that runs along `tangent` to its left side."""
    side, ahead = half * right(tangent), half * tangent
    begin, end = node + side, node - side
    if kind == "round":
        return corner(node, tangent, np.pi, half, tolerance, "round", 1.0)
    if kind == "square":
        tips = begin + ahead, end + ahead
        return [np.stack((begin, tips[0])), np.stack(tips), np.stack((tips[1], end))]
    return [np.stack((begin, end))]
