"""A whole path as chords within a tolerance, all segments of one degree together."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..curve.bernstein import basis
from ..document.errors import Refusal
from .path import Floats, Numbers, Path
from .pieces import Pieces, pieces_of

MOST = 20_000_000
"""Points a path may become; more are a tolerance that was mistyped."""


@dataclass(frozen=True, slots=True, eq=False)
class Chords:
    """Polylines that follow the contours of a path, and where on it each point lies."""

    points: Floats  # (n, d) contour after contour, the first point of each included
    starts: Numbers  # (c + 1,) of each contour in `points`
    segment: Numbers  # (n,) of the path, on which a point lies: before a node, but after the first
    parameter: Floats  # (n,) on that segment


def flatten(path: Path, tolerance: float, most: int = MOST) -> list[Floats]:
    """(k, d) points a contour, in order, none further than `tolerance` mm from the curve between them.

    Nodes are hit exactly. A closed contour does not repeat its first point, as CrossSection wants them. Raises
    Refusal for a tolerance that is not above 0, or so fine that there would be more than `most` points.
    """
    points, starts, _ = _chords(path, tolerance, None, most)
    ends = starts[1:] - np.array([contour.closed for contour in path.contours], np.intp)
    return [points[begin:end] for begin, end in zip(starts[:-1].tolist(), ends.tolist(), strict=True)]


def chords(path: Path, tolerance: float) -> Chords:
    """As `flatten`, with the segment and the parameter of every point; a closed contour repeats its first point."""
    where: list[Floats] = []
    points, starts, segment = _chords(path, tolerance, where)
    return Chords(points, starts, segment, where[0] if where else np.zeros(0))


def _chords(
    path: Path, tolerance: float, where: list[Floats] | None, most: int = MOST
) -> tuple[Floats, Numbers, Numbers]:
    if not (np.isfinite(tolerance) and tolerance > 0.0):
        raise Refusal(f"the tolerance of a curve must be above 0 mm, not {tolerance!r:.40}")
    if not path.contours:
        return np.zeros((0, 2)), np.zeros(1, np.intp), np.zeros(0, np.intp)
    groups = pieces_of(path.contours)
    counts = np.zeros(sum(len(group.place) for group in groups), np.intp)
    owner = np.zeros_like(counts)
    for group in groups:
        counts[group.place] = chord_counts(group.controls, tolerance, group.weights)
        owner[group.place] = group.segment
    total = int(counts.sum())
    if total > most:
        raise Refusal(f"a tolerance of {tolerance:g} mm makes {total:,} points of the curve; take a coarser one")
    # Before the points of a contour's pieces stands its first point.
    segments = np.cumsum([0, *(len(contour) for contour in path.contours)])
    contour = np.searchsorted(segments, owner, "right") - 1
    begins = np.cumsum(counts) - counts + contour + 1
    starts = np.concatenate((begins[np.searchsorted(contour, np.arange(len(path.contours)))] - 1, [0]))
    starts[-1] = total + len(path.contours)
    points = np.empty((starts[-1], path.contours[0].dimension))
    points[starts[:-1]] = [one.points[0] for one in path.contours]
    for group in groups:
        _fill(points, group, begins[group.place], counts[group.place])
    nodes = np.concatenate([one.points[one.starts[1:]] for one in path.contours])
    last = np.append(owner[1:] != owner[:-1], True)
    points[(begins + counts - 1)[last]] = nodes
    if where is None:
        return points, starts, owner
    segment = np.empty(len(points), np.intp)
    segment[starts[:-1]] = segments[:-1]
    parameter = np.zeros(len(points))
    fresh = np.ones(len(points), bool)
    fresh[starts[:-1]] = False
    segment[fresh] = np.repeat(owner, counts)
    low, high = np.empty(len(counts)), np.empty(len(counts))
    for group in groups:
        low[group.place], high[group.place] = group.begin, group.end
    step = (np.arange(total) - np.repeat(np.cumsum(counts) - counts, counts) + 1) / np.repeat(counts, counts)
    parameter[fresh] = np.repeat(low, counts) * (1.0 - step) + np.repeat(high, counts) * step
    where.append(parameter)
    return points, starts, segment


def chord_counts(controls: Floats, tolerance: float, weights: Floats | None = None) -> Numbers:
    """(m,) chords of even steps that keep Bezier curves (m, n + 1, d) within `tolerance` (Wang 1984).

    Rational ones by the bound of Zheng and Sederberg (2000) about the middle of their control points.
    """
    degree = controls.shape[1] - 1
    if degree < 2:
        return np.ones(len(controls), np.intp)
    if weights is None:
        bend = np.diff(controls, 2, axis=1)
        most = np.sqrt(np.einsum("mkd,mkd->mk", bend, bend).max(axis=1))
    else:
        about = controls - 0.5 * (controls.min(axis=1, keepdims=True) + controls.max(axis=1, keepdims=True))
        reach = np.sqrt((about**2).sum(axis=2)).max(axis=1)
        bend = np.diff(about * weights[..., None], 2, axis=1)
        drift = np.abs(np.diff(weights, 2, axis=1))
        most = np.sqrt((bend**2).sum(axis=2)) + np.maximum(reach - tolerance, 0.0)[:, None] * drift
        most = most.max(axis=1) / weights.min(axis=1)
    steps = np.sqrt(degree * (degree - 1) / 8.0 * most / tolerance)
    return np.maximum(np.ceil(np.minimum(steps, 2.0 * MOST)), 1.0).astype(np.intp)


@lru_cache(maxsize=512)
def _basis(degree: int, count: int) -> Floats:
    """(count, n + 1) Bernstein values after 1, 2, ... of `count` even steps."""
    return basis(degree, np.arange(1, count + 1) / count)


def _fill(points: Floats, group: Pieces, begins: Numbers, counts: Numbers) -> None:
    """Curves of the same count are one product of matrices."""
    if group.degree == 1:
        points[begins] = group.controls[:, 1]
        return
    curves, rational = group.lifted, group.weights is not None
    order = np.argsort(counts, kind="stable")
    sizes, first = np.unique(counts[order], return_index=True)
    for count, rows in zip(sizes.tolist(), np.split(order, first[1:]), strict=True):
        found = (_basis if count < 1000 else _basis.__wrapped__)(group.degree, count) @ curves[rows]
        if rational:
            found = found[..., :-1] / found[..., -1:]
        points[begins[rows][:, None] + np.arange(count)] = found
