"""How a point of a segment is constructed: de Casteljau's and de Boor's levels, the basis, the polynomial, chords."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..curve import bezier
from ..curve.differential import tangents
from ..document.errors import Refusal
from ..path.path import Path, Segment
from ..spline import bspline
from ..spline.decomposition import decomposed

Floats = NDArray[np.float64]

SAMPLES = 33
"""Places on each part between two steps at which its distance from the chord is first looked for."""
ROUNDS = 6
"""How often the place of the largest distance is then looked for more closely, 16 times closer each."""
DEGREES = {1: "line", 2: "quadratic", 3: "cubic"}


@dataclass(frozen=True, slots=True, eq=False)
class Construction:
    """A point of a segment and all that leads to it, in the axes of the segment.

    `levels[k]` (n + 1 - k, d) are the points of level k at degree n: level 0 are control points, from number `first`
    on, those of one knot interval in a B-spline; the last level is the point. `basis` (n + 1,) has what each of them
    weighs in the point, with weights of rational curves; the sum is 1. `tangent` (d,) is a unit vector, zero where the
    segment is a point.

    On the `interval` of the segment's parameters, which for a Bezier curve is 0 to 1, the curve is `polynomial`
    (n + 1, d), rows the coefficients of 1, u, u², ..., over `denominator` (n + 1,) where it is rational. There
    `parameter` is t on the segment's own knots and u = (parameter - start) / (end - start).
    """

    levels: tuple[Floats, ...]
    first: int
    basis: Floats
    tangent: Floats
    polynomial: Floats
    denominator: Floats | None
    interval: tuple[float, float]
    parameter: float
    plain: bool
    """Whether each point of a level is (1 - t) of one before and t of the next: of Bezier curves without weights."""

    @property
    def point(self) -> Floats:
        """(d,) where the segment is at t."""
        return self.levels[-1][0]

    @property
    def degree(self) -> int:
        return len(self.levels) - 1

    @property
    def u(self) -> float:
        start, end = self.interval
        return (self.parameter - start) / (end - start)

    @property
    def halves(self) -> tuple[Floats, Floats]:
        """(n + 1, d) each: the control points of the two curves into which the point cuts the interval's."""
        before = np.array([level[0] for level in self.levels])
        return before, np.array([level[-1] for level in reversed(self.levels)])


def segment_at(path: Path, contour: int, segment: int) -> Segment:
    """Raises Refusal where a path has no such segment."""
    if not 0 <= contour < len(path.contours):
        raise Refusal(f"there is no contour {contour}: the outline has {_counted(len(path.contours), 'contour')}")
    found = path.contours[contour]
    if not 0 <= segment < len(found):
        raise Refusal(f"there is no segment {segment}: contour {contour} has {_counted(len(found), 'segment')}")
    return found.segment(segment)


def construct(segment: Segment, t: float) -> Construction:
    """The construction at t from 0 to 1, over the whole domain of a B-spline. Raises Refusal for t beyond.

    De Casteljau 1959, de Boor 1972; the polynomial of a B-spline's interval by Boehm's knot insertion (1980).
    """
    if not 0.0 <= t <= 1.0:
        raise Refusal(f"t is from 0 to 1 on a segment, not {t:g}")
    if isinstance(segment, np.ndarray):
        levels = tuple(bezier.levels(segment, t))
        return Construction(levels, 0, bezier.basis_values(len(segment) - 1, t), tangents(segment, t),
                            bezier.polynomial(segment), None, (0.0, 1.0), t, True)  # fmt: skip
    start, end = segment.domain
    parameter = end if t == 1.0 else start + t * (end - start)
    span = int(bspline.spans(segment.knots, segment.degree, parameter))
    first = span - segment.degree
    interval = float(segment.knots[span]), float(segment.knots[span + 1])
    pieces = decomposed(segment)
    number = int(np.searchsorted(pieces.breaks, interval[0]))
    weights = None if pieces.weights is None else pieces.weights[number]
    controls = pieces.controls[number]
    above = bezier.polynomial(pieces.lifted[number])
    return Construction(
        tuple(bspline.levels(segment, parameter)),
        first,
        bspline.basis(segment, parameter)[first : span + 1],
        tangents(controls, (parameter - interval[0]) / (interval[1] - interval[0]), weights),
        above if weights is None else above[:, :-1],
        None if weights is None else above[:, -1],
        interval,
        parameter,
        weights is None and is_bezier(segment),
    )


def strings(segment: Segment, count: int) -> Floats:
    """(count, 2, d) the lines between the two points of the last level but one, at even t from 0 to 1.

    Each of them touches the curve at its t, so that the curve is the envelope of all: string art. A line has none.
    """
    t = np.linspace(0.0, 1.0, count)
    if isinstance(segment, np.ndarray):
        return bezier.levels(segment, t)[-2] if len(segment) > 2 else np.zeros((0, 2, segment.shape[1]))
    if segment.degree < 2:
        return np.zeros((0, 2, segment.dimension))
    return bspline.levels(segment, _on_domain(segment, t))[-2]


def steps(segment: Segment, count: int) -> tuple[Floats, float]:
    """Points (count + 1, d) at even t, and the largest distance in mm of the curve from the chords between them.

    The distance is sampled, then looked for more closely about the largest sample.
    """
    even = np.linspace(0.0, 1.0, count + 1)
    points = points_at(segment, even)
    t = even[:-1, None] + np.linspace(0.0, 1.0 / count, SAMPLES)
    away = _distances(points_at(segment, t.ravel()).reshape(count, SAMPLES, -1), points[:-1], points[1:])
    part, place = np.unravel_index(int(np.argmax(away)), away.shape)
    middle, half = float(t[part, place]), 1.0 / (count * (SAMPLES - 1))
    low, high = even[part], even[part + 1]
    deviation = float(away[part, place])
    for _ in range(ROUNDS):
        near = np.clip(np.linspace(middle - half, middle + half, SAMPLES), low, high)
        row = _distances(points_at(segment, near)[None], points[part, None], points[part + 1, None])[0]
        middle, half = float(near[int(np.argmax(row))]), half / 16.0
        deviation = max(deviation, float(row.max()))
    return points, deviation


def points_at(segment: Segment, t: Floats) -> Floats:
    """(m, d) at t (m,) from 0 to 1."""
    if isinstance(segment, np.ndarray):
        return bezier.evaluated(segment, t)
    return bspline.evaluated(segment, _on_domain(segment, t))


def is_bezier(segment: Segment) -> bool:
    """Whether it is one Bezier curve: a B-spline without inner knots, clamped at both ends, is."""
    return isinstance(segment, np.ndarray) or (len(segment.points) == segment.degree + 1 and segment.clamped)


def kind_of(segment: Segment) -> str:
    """In words: "cubic", "Bezier curve of degree 5", "rational B-spline of degree 2"."""
    if isinstance(segment, np.ndarray):
        return DEGREES[len(segment) - 1]
    rational = "" if segment.weights is None else "rational "
    return f"{rational}{'Bezier curve' if is_bezier(segment) else 'B-spline'} of degree {segment.degree}"


def _on_domain(spline: bspline.BSpline, t: Floats) -> Floats:
    start, end = spline.domain
    return np.where(t == 1.0, end, start + t * (end - start))


def _distances(points: Floats, begins: Floats, ends: Floats) -> Floats:
    """(k, m) of points (k, m, d) from the chords between `begins` and `ends` (k, d)."""
    along = (ends - begins)[:, None]
    square = np.maximum((along * along).sum(-1), np.finfo(float).tiny)
    share = np.clip(((points - begins[:, None]) * along).sum(-1) / square, 0.0, 1.0)
    return np.linalg.norm(points - begins[:, None] - share[..., None] * along, axis=-1)


def _counted(count: int, word: str) -> str:
    return f"{count} {word}{'s' * (count != 1)}"
