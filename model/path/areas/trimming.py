"""Curves cut where they cross, those along the boundary of a region kept, and chained to closed contours."""

from __future__ import annotations

import numpy as np

from ...curve.bezier import derivatives, evaluated, extracted
from ..flatten import chord_counts
from ..nodes import inferred
from ..path import Contour, Floats, Numbers


def cut(curves: list[Floats], fine: float) -> list[Floats]:
    """The curves, cut where they cross each other."""
    counts = np.array([int(chord_counts(curve[None], fine)[0]) for curve in curves])
    rows = [evaluated(curve, np.arange(count + 1) / count) for curve, count in zip(curves, counts, strict=True)]
    begin, end = np.vstack([row[:-1] for row in rows]), np.vstack([row[1:] for row in rows])
    owner = np.repeat(np.arange(len(curves)), counts)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    first, second, t, s = crossings(begin, end, fine)
    apart = (owner[first] != owner[second]) | (np.abs(step[first] - step[second]) > 1)
    first, second, t, s = first[apart], second[apart], t[apart], s[apart]
    t = (step[first] + t) / counts[owner[first]]
    s = (step[second] + s) / counts[owner[second]]
    a, b = owner[first], owner[second]
    cubic = np.array([curve if len(curve) == 4 else _raised(curve) for curve in curves])
    for _ in range(6):  # Newton's method for both parameters at once
        (p, u), (q, v) = (
            derivatives(cubic[a], t[:, None], 1)[..., 0, :],
            derivatives(cubic[b], s[:, None], 1)[..., 0, :],
        )
        gap = q - p
        area = u[:, 1] * v[:, 0] - u[:, 0] * v[:, 1]
        safe = np.where(np.abs(area) > 1e-12 * np.abs(u * v).max(axis=1, initial=0.0), area, np.inf)
        t = np.clip(t + (gap[:, 1] * v[:, 0] - gap[:, 0] * v[:, 1]) / safe, 0.0, 1.0)
        s = np.clip(s + (gap[:, 1] * u[:, 0] - gap[:, 0] * u[:, 1]) / safe, 0.0, 1.0)
    which, at = np.concatenate((a, b)), np.concatenate((t, s))
    inside = (at > 1e-9) & (at < 1.0 - 1e-9)
    order = np.lexsort((at[inside], which[inside]))
    which, at = which[inside][order], at[inside][order]
    borders = np.searchsorted(which, np.arange(len(curves) + 1))
    found = []
    for number, curve in enumerate(curves):
        cuts = np.unique(np.concatenate(([0.0], at[borders[number] : borders[number + 1]], [1.0])))
        found += [curve] if len(cuts) == 2 else list(extracted(curve, cuts[:-1], cuts[1:]))
    return found


def _raised(line: Floats) -> Floats:
    return line[0] + np.arange(4)[:, None] / 3.0 * (line[1] - line[0])


def crossings(begin: Floats, end: Floats, slack: float) -> tuple[Numbers, Numbers, Floats, Floats]:
    """Pairs of chords (n, 2) that cross, and the parameters on both, those beyond their ends by `slack` mm included."""
    low, high = np.minimum(begin, end) - slack, np.maximum(begin, end) + slack
    order = np.argsort(low[:, 0], kind="stable")
    reach = np.searchsorted(low[order, 0], high[order, 0], "right")
    found: list[tuple[Numbers, Numbers, Floats, Floats]] = []
    sizes = reach - np.arange(len(order)) - 1
    blocks = np.searchsorted(np.cumsum(sizes), np.arange(0, sizes.sum() + 1, 2_000_000)[1:])
    for rows in np.split(np.arange(len(order)), blocks):
        one = np.repeat(rows, sizes[rows])
        two = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(sizes[rows]) - sizes[rows], sizes[rows])
        i, j = order[one], order[two]
        near = (low[i, 1] <= high[j, 1]) & (low[j, 1] <= high[i, 1])
        i, j = i[near], j[near]
        u, v, gap = end[i] - begin[i], end[j] - begin[j], begin[j] - begin[i]
        area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        safe = np.where(area != 0.0, area, np.inf)
        t = (gap[:, 0] * v[:, 1] - gap[:, 1] * v[:, 0]) / safe
        s = (gap[:, 0] * u[:, 1] - gap[:, 1] * u[:, 0]) / safe
        over_t = slack / np.maximum(np.linalg.norm(u, axis=1), slack)
        over_s = slack / np.maximum(np.linalg.norm(v, axis=1), slack)
        meet = (area != 0.0) & (t >= -over_t) & (t <= 1.0 + over_t) & (s >= -over_s) & (s <= 1.0 + over_s)
        found.append((i[meet], j[meet], np.clip(t[meet], 0.0, 1.0), np.clip(s[meet], 0.0, 1.0)))
    i, j, t, s = (np.concatenate(column) for column in zip(*found, strict=True))
    return i, j, t, s


def kept(curves: list[Floats], polygons: list[Floats], tolerance: float) -> list[Floats]:
    """Those that run along the boundary of the polygons."""
    begin = np.vstack(polygons)
    along = np.vstack([np.diff(p, axis=0, append=p[:1]) for p in polygons])
    sizes = np.maximum((along**2).sum(axis=1), 1e-300)
    parameters = np.linspace(0.0, 1.0, 9)[1:-1]
    samples = np.array([evaluated(curve, parameters) for curve in curves]).reshape(-1, 2)
    apart = np.empty(len(samples))
    block = max(2_000_000 // len(begin), 1)
    for start in range(0, len(samples), block):
        way = samples[start : start + block, None] - begin
        share = np.clip((way * along).sum(axis=-1) / sizes, 0.0, 1.0)
        apart[start : start + block] = ((way - share[..., None] * along) ** 2).sum(axis=-1).min(axis=1)
    on = np.flatnonzero((apart.reshape(len(curves), -1) <= tolerance**2).all(axis=1))
    found = [curves[number] for number in on.tolist()]
    return [curve for curve in found if np.linalg.norm(np.diff(curve, axis=0), axis=1).sum() > 0.5 * tolerance]


def chained(curves: list[Floats], tolerance: float) -> list[Contour] | None:
    """Closed contours of the curves, each used once; None where they do not close."""
    if not curves:
        return None
    starts, ends = np.array([curve[0] for curve in curves]), np.array([curve[-1] for curve in curves])
    following = np.empty(len(curves), np.intp)
    block = max(4_000_000 // len(curves), 1)
    for row in range(0, len(curves), block):
        gaps = ((ends[row : row + block, None] - starts) ** 2).sum(axis=-1)
        following[row : row + block] = gaps.argmin(axis=1)
        if (gaps.min(axis=1) > tolerance**2).any():
            return None
    if len(np.unique(following)) < len(following):
        return None
    contours, used = [], np.zeros(len(curves), bool)
    for number in range(len(curves)):
        loop = []
        while not used[number]:
            used[number] = True
            loop.append(curves[number])
            number = int(following[number])
        if len(loop) > 1:
            contours.append(inferred(Contour.of_segments(loop, True)))
    return contours
