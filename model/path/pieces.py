"""All segments of a path as Bezier curves, those of one degree together: for bounds, areas, lengths and chords."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..curve import bezier, lengths
from ..spline.bspline import BSpline
from ..spline.decomposition import decomposed
from .path import Contour, Floats, Kind, Numbers


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Bezier curves of one degree, rational where `weights` are there."""

    controls: Floats  # (m, n + 1, d)
    weights: Floats | None  # (m, n + 1) above 0
    place: Numbers  # (m,) number of each among all pieces of the path, from its beginning
    segment: Numbers  # (m,) number of the segment among all of the path
    begin: Floats  # (m,) parameters of the segment where the piece begins and ends
    end: Floats  # (m,)

    @property
    def degree(self) -> int:
        return self.controls.shape[1] - 1

    @property
    def lifted(self) -> Floats:
        """(m, n + 1, d) or, of rational ones, (m, n + 1, d + 1) homogeneous coordinates."""
        return self.controls if self.weights is None else bezier.homogeneous(self.controls, self.weights)


def pieces_of(contours: Sequence[Contour]) -> list[Pieces]:
    """The segments of contours, those of one degree together. Splines come as their Bezier pieces (Boehm 1980)."""
    points = np.concatenate([contour.points for contour in contours])
    kinds = np.concatenate([contour.kinds for contour in contours])
    sizes = np.array([len(contour.points) for contour in contours])
    counts = np.array([len(contour) for contour in contours])
    shift = np.repeat(np.cumsum(sizes) - sizes, counts)
    starts = np.concatenate([contour.starts[:-1] for contour in contours]) + shift
    several = np.ones(len(kinds), np.intp)
    parts = []
    if (kinds == Kind.SPLINE).any():
        splines = [spline for contour in contours for spline in contour.splines]
        where = np.flatnonzero(kinds == Kind.SPLINE)
        parts = [(number, *_of_spline(spline)) for number, spline in zip(where.tolist(), splines, strict=True)]
        several[where] = [len(controls) for _, controls, _, _ in parts]
    first = np.cumsum(several) - several
    found = []
    for kind in (Kind.LINE, Kind.QUADRATIC, Kind.CUBIC):
        rows = np.flatnonzero(kinds == kind)
        if len(rows):
            controls = points[starts[rows][:, None] + np.arange(kind + 1)]
            zeros = np.zeros(len(rows))
            found.append(Pieces(controls, None, first[rows], rows, zeros, zeros + 1.0))
    for number, controls, weights, borders in parts:
        place = first[number] + np.arange(len(controls))
        found.append(Pieces(controls, weights, place, np.full(len(place), number), borders[:-1], borders[1:]))
    return found


def _of_spline(spline: BSpline) -> tuple[Floats, Floats | None, Floats]:
    """Control points (k, p + 1, d), weights and borders (k + 1,), from 0 to 1, of a spline's polynomial pieces."""
    found = decomposed(spline)
    start, end = spline.domain
    return found.controls, found.weights, (found.breaks - start) / (end - start)


def bounds(groups: Sequence[Pieces]) -> Floats:
    """(2, d) lowest and highest coordinates reached."""
    found = np.concatenate([bezier.bounds(group.controls, group.weights) for group in groups])
    return np.array([found[:, 0].min(axis=0), found[:, 1].max(axis=0)])


def area(groups: Sequence[Pieces], middle: Floats) -> float:
    """½ ∮ x dy - y dx about `middle` (2,) along all pieces, mm²."""
    return float(sum(lengths.area(group.controls - middle, group.weights).sum() for group in groups))


def length(groups: Sequence[Pieces]) -> float:
    """mm."""
    return float(sum(lengths.length(group.controls, weights=group.weights).sum() for group in groups))
