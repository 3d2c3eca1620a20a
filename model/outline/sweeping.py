"""Frames that run along a path without turning about it, to draw an outline along it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..curve import bezier
from ..curve.differential import tangents
from ..document.errors import Refusal
from ..path.flatten import chord_counts
from ..path.path import Contour, Path
from ..path.pieces import pieces_of

Floats = NDArray[np.float64]

CORNER = 1.0
"""Degrees; where a path turns by more at once it has a corner."""
STEEPEST = 150.0
"""Degrees of a corner; a mitre of more would reach farther than four times the outline."""
UPRIGHT = 1e-6
"""A tangent whose sine against z is less runs along z."""
MOST = 100_000
"""Frames along a path; more are a tolerance that was mistyped."""
ROUNDS = 8
MOST_AT_ONCE = 64
FINE = 512


@dataclass(frozen=True, slots=True, eq=False)
class Frames:
    """Where an outline stands as it is drawn along a path; of a closed path the first place comes again at the end.

    A point (x, y) of the outline comes to lie at origins + x * axes[:, 0] + y * axes[:, 1].
    """

    origins: Floats  # (n, 3) on the path
    axes: Floats  # (n, 3, 3) rows x, y, tangent: orthonormal; in a mitre x and y are stretched across the bisector
    lengths: Floats  # (n,) mm along the path
    turns: Floats  # (n,) degrees by which the path turns at once
    closed: bool

    @property
    def corners(self) -> NDArray[np.bool_]:
        """(n,)"""
        return self.turns > CORNER

    @property
    def length(self) -> float:
        return float(self.lengths[-1])


@dataclass(frozen=True, slots=True, eq=False)
class _Samples:
    """A path at its samples; `arriving` and `leaving` are its tangents before and after each."""

    origins: Floats  # (n, 3)
    arriving: Floats  # (n, 3)
    leaving: Floats  # (n, 3)
    lengths: Floats  # (n,)


def path_frames(
    path: Path,
    tolerance: float,
    reach: float = 0.0,
    *,
    segments: int | None = None,
    step: float = np.inf,
    mitred: bool = True,
) -> Frames:
    """Rotation-minimising frames along the one contour of a path (double reflection: Wang, Jüttler, Zheng, Liu 2008).

    So close together that neither the path nor what is up to `reach` mm from it leaves its chords by more than
    `tolerance` mm, or by `segments` to a full turn; never farther apart than `step` mm. A closed path spreads the
    rotation that is left at its end evenly along its length. A corner has one frame, in the plane of its bisector; or,
    not `mitred`, two, across the path before it and after it. Raises Refusal for a path of no or several contours, for
    one that is a point, and for corners too sharp to be mitred.
    """
    contour = _contour(path)
    if not (np.isfinite(tolerance) and tolerance > 0.0):
        raise Refusal(f"the tolerance of a sweep must be above 0 mm, not {tolerance!r:.40}")
    found = _sampled(path, tolerance, reach, segments, step)
    origins, arriving, leaving = found.origins, found.arriving.copy(), found.leaving.copy()
    if contour.closed:
        arriving[0], leaving[-1] = arriving[-1], leaving[0]
    else:
        arriving[0], leaving[-1] = leaving[0], arriving[-1]
    turns = np.degrees(_angles(arriving, leaving))
    sharp = int(np.argmax(turns))
    if mitred and turns[sharp] > STEEPEST:
        raise Refusal(f"the path turns back by {turns[sharp]:.0f}° at {found.lengths[sharp]:.4g} mm of its length; "
                      f"at most {STEEPEST:g}° can be mitred: round the corner")  # fmt: skip
    first, begin, end = _transported(origins, arriving, leaving)
    spare = np.zeros(len(origins))
    if contour.closed:
        left = np.arctan2(np.cross(end, begin) @ leaving[0], end @ begin)
        spare = left * found.lengths / found.lengths[-1]
    before = _axes(first, arriving, spare)
    if mitred:
        middle = _units(arriving + leaving)
        axes = np.einsum("nij,nkj->nki", _least_turns(arriving, middle), before)
        across, cosine = _units(leaving - arriving), np.cos(np.radians(0.5 * turns))
        reaching = np.einsum("nki,ni->nk", axes[:, :2], across) * (1.0 / cosine - 1.0)[:, None]
        axes[:, :2] += reaching[..., None] * across[:, None]
        return Frames(origins, axes, found.lengths, turns, contour.closed)
    x = np.einsum("nij,nj->ni", _least_turns(arriving, leaving), before[:, 0])
    after = np.stack((x, np.cross(leaving, x), leaving), axis=1)
    before[0] = after[0]
    again = turns > CORNER
    again[[0, -1]] = False
    rows = np.repeat(np.arange(len(origins)), 1 + again)
    axes = before[rows]
    second = np.append(False, rows[1:] == rows[:-1])
    axes[second] = after[rows[second]]
    return Frames(origins[rows], axes, found.lengths[rows], turns[rows], contour.closed)


def start_frame(path: Path) -> Floats:
    """(3, 4) columns x, y, tangent, origin where a path begins: y as near to +z as it can be; x where it runs along z.

    Raises Refusal as `path_frames`.
    """
    _contour(path)
    for controls, weights in _curves(path):
        along = tangents(controls, np.zeros(1), weights)[0]
        if along.any():
            return np.column_stack((*_start_axes(along), along, controls[0]))
    raise Refusal("the path is a point; it has no direction to draw an outline along")


def _contour(path: Path) -> Contour:
    count = len(path.contours)
    if not count:
        raise Refusal("the path is empty; draw a line or a curve")
    if count > 1:
        raise Refusal(f"the path has {count} contours; an outline is drawn along one: join or delete some")
    return path.contours[0]


def _curves(path: Path) -> list[tuple[Floats, Floats | None]]:
    """Control points (n + 1, 3) and weights of the path's Bezier pieces in their order."""
    found = []
    for group in pieces_of(path.contours):
        flat = 3 - group.controls.shape[2]
        controls = np.concatenate([group.controls, np.zeros((*group.controls.shape[:2], flat))], axis=2)
        for row, place in enumerate(group.place.tolist()):
            found.append((place, controls[row], None if group.weights is None else group.weights[row]))
    found.sort(key=lambda piece: piece[0])
    return [(controls, weights) for _, controls, weights in found]


def _sampled(path: Path, tolerance: float, reach: float, segments: int | None, step: float) -> _Samples:
    curves = _curves(path)
    size = max(float(np.ptp(np.concatenate([controls for controls, _ in curves]), axis=0).max()), 1e-300)
    parts = []
    for controls, weights in curves:
        if np.ptp(controls, axis=0).max() <= 1e-12 * size:
            continue
        parts.append(_sampled_piece(controls, weights, tolerance, reach, segments, step))
        if sum(len(part[0]) for part in parts) > MOST:
            raise Refusal(f"a tolerance of {tolerance:g} mm makes more than {MOST:,} steps along the path; "
                          "take a coarser one")  # fmt: skip
    if not parts:
        raise Refusal("the path is a point; it has no direction to draw an outline along")
    origins = np.concatenate([parts[0][0][:1], *(points[1:] for points, _, _ in parts)])
    arriving = np.concatenate([parts[0][1][:1], *(along[1:] for _, along, _ in parts)])
    leaving = np.concatenate([*(along[:-1] for _, along, _ in parts), parts[-1][1][-1:]])
    lengths = np.concatenate([[0.0], np.cumsum(np.concatenate([steps for _, _, steps in parts]))])
    return _Samples(origins, arriving, leaving, lengths)


def _sampled_piece(
    controls: Floats, weights: Floats | None, tolerance: float, reach: float, segments: int | None, step: float
) -> tuple[Floats, Floats, Floats]:
    """Points (k, 3), unit tangents (k, 3) and the lengths (k - 1,) between them, along one Bezier curve."""
    if segments is None:
        count = min(int(chord_counts(controls[None], tolerance, None if weights is None else weights[None])[0]), MOST)
        t = np.arange(count + 1) / count
    else:
        t = _even_turns(controls, weights, segments)
    for last in range(ROUNDS, -1, -1):
        middles = 0.5 * (t[:-1] + t[1:])
        both = np.insert(middles, np.arange(len(t)), t) if len(t) > 1 else t
        points = bezier.evaluated(controls, both, weights)
        along = tangents(controls, both, weights)
        turn = _angles(along[:-1], along[1:])
        turn = turn[::2] + turn[1::2]
        chord = np.linalg.norm(np.diff(points[::2], axis=0), axis=1)
        wanted = chord / step
        if segments is None:
            # An arc of radius r and angle a is r a² / 8 away from its chord r a; farther out (r + reach) a² / 8.
            wanted = np.maximum(wanted, np.sqrt((chord * turn + reach * turn**2) / (8.0 * tolerance)))
        wanted = np.ceil(wanted - 1e-6)
        times = np.clip(wanted, 1, MOST_AT_ONCE).astype(np.intp)
        if not last or (times == 1).all() or times.sum() > MOST:
            return points[::2], along[::2], chord * (1.0 + turn**2 / 24.0)
        begin = np.repeat(t[:-1], times)
        share = (np.arange(times.sum()) - np.repeat(np.cumsum(times) - times, times)) / np.repeat(times, times)
        t = np.append(begin + share * np.repeat(np.diff(t), times), 1.0)
    raise AssertionError  # the last round returns


def _even_turns(controls: Floats, weights: Floats | None, segments: int) -> Floats:
    """Parameters (k + 1,) between which a Bezier curve turns evenly, `segments` times in a full turn."""
    if len(controls) == 2:
        return np.array([0.0, 1.0])
    t = np.linspace(0.0, 1.0, FINE + 1)
    along = tangents(controls, t, weights)
    turned = np.concatenate([[0.0], np.cumsum(_angles(along[:-1], along[1:]))])
    count = max(int(np.ceil(turned[-1] * segments / (2.0 * np.pi) - 1e-4)), 1)
    inner = np.interp(turned[-1] * np.arange(1, count) / count, turned, t)
    return np.concatenate([[0.0], inner, [1.0]])


def _transported(origins: Floats, arriving: Floats, leaving: Floats) -> tuple[Floats, Floats, Floats]:
    """The x axes (n, 3) before each sample; and those (3,) after the first, as the start frame has it, and the last."""
    chord = np.diff(origins, axis=0)
    mirrored = _reflections(chord)
    flipped = np.einsum("nij,nj->ni", mirrored, leaving[:-1])
    steps = _reflections(arriving[1:] - flipped) @ mirrored
    joints = _least_turns(arriving, leaving)
    axes = np.empty_like(origins)
    start = _start_axes(leaving[0])[0]
    axes[0] = joints[0].T @ start
    here = start
    for i, (matrix, joint) in enumerate(zip(steps, joints[1:], strict=True), 1):
        here = matrix @ here
        axes[i] = here
        here = joint @ here
    return axes, start, here


def _start_axes(along: Floats) -> tuple[Floats, Floats]:
    """x and y (3,) across a tangent (3,)."""
    if np.hypot(along[0], along[1]) > UPRIGHT:
        y = _across(np.array([0.0, 0.0, 1.0]), along)
        return np.cross(y, along), y
    x = _across(np.array([1.0, 0.0, 0.0]), along)
    return x, np.cross(along, x)


def _across(direction: Floats, along: Floats) -> Floats:
    """The unit vector (3,) across `along` that is nearest to a direction."""
    rest = direction - (direction @ along) * along
    return rest / np.linalg.norm(rest)


def _axes(first: Floats, along: Floats, spare: Floats) -> Floats:
    """(n, 3, 3) rows x, y, tangent of x axes turned about their tangents by `spare` (n,) radians."""
    x = _units(first - (first * along).sum(axis=1, keepdims=True) * along)
    y = np.cross(along, x)
    cosine, sine = np.cos(spare)[:, None], np.sin(spare)[:, None]
    return np.stack((cosine * x + sine * y, cosine * y - sine * x, along), axis=1)


def _least_turns(before: Floats, after: Floats) -> Floats:
    """(n, 3, 3) the least rotations that take unit vectors to others; the identity where they are opposite."""
    axis, cosine = np.cross(before, after), (before * after).sum(axis=1)
    matrices = np.broadcast_to(np.eye(3), (len(before), 3, 3)).copy()
    plain = 1.0 + cosine > 1e-9
    cross = np.zeros((len(before), 3, 3))
    cross[:, [2, 0, 1], [1, 2, 0]] = axis
    cross[:, [1, 2, 0], [2, 0, 1]] = -axis
    matrices[plain] += cross[plain] + cross[plain] @ cross[plain] / (1.0 + cosine[plain])[:, None, None]
    return matrices


def _reflections(normals: Floats) -> Floats:
    """(n, 3, 3) in planes across vectors (n, 3); the identity where one is 0."""
    units = _units(normals)
    return np.eye(3) - 2.0 * units[:, :, None] * units[:, None, :]


def _units(vectors: Floats) -> Floats:
    size = np.sqrt((vectors**2).sum(axis=1, keepdims=True))
    return np.divide(vectors, size, out=np.zeros_like(vectors), where=size > 0.0)


def _angles(before: Floats, after: Floats) -> Floats:
    """(n,) radians between unit vectors, exact for small ones."""
    return 2.0 * np.arcsin(np.minimum(0.5 * np.linalg.norm(after - before, axis=1), 1.0))
