"""Outlines made larger or smaller, and strokes as outlines, as curves within a tolerance.

Polygons decide what is left of the parallel curves: what a pen of the width sweeps along the flattened path, joined to
or cut from what the path fills by manifold3d. The parallels are cut where they meet, the parts along the polygons'
boundary are kept and chained. Should that fail to close, or differ in area, cubics are fitted to the polygons.
"""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, FillRule
from numpy.typing import NDArray

from ...curve.bezier import evaluated
from ...document.errors import Refusal
from ..fitting import fit
from ..flatten import chord_counts, flatten
from ..nodes import inferred
from ..path import Contour, Floats, Path
from ..pieces import pieces_of
from .parallel import CAPS, JOINS, cap, corner, end_tangents, parallel, right
from .trimming import chained, cut, kept

FILL = {"nonzero": FillRule.NonZero, "evenodd": FillRule.EvenOdd}
SHARE = 0.25
"""Of the tolerance for the polygons and for the parallels each; the rest is for telling what lies on the boundary."""
SHORTENED = 12
"""Halvings of a chord towards the end of a curve."""
FARTHEST = 1e9
"""mm from the origin; polygons are reckoned in whole multiples of 1e-8 mm, which 64 bits hold up to 2e10 mm."""
MOST_POINTS = 50_000
"""Of the polygons along a path; with more, which extreme weights ask for, it would take minutes."""
MITER = 4.0
"""As SVG has it: how far from the node a miter may reach, in halves of the stroke's width."""


def offset(path: Path, distance: float, tolerance: float, join: str = "round", limit: float = MITER) -> Path:
    """The outline of what a path in the plane fills, grown by `distance` mm, or shrunk where that is below 0.

    `join` tells what stands at corners: "round", "miter" up to `limit` times the distance, or "bevel". The result
    fills by "nonzero", outer contours counter-clockwise; it has no contours where nothing is left. Raises Refusal for
    open contours and for numbers that make no sense.
    """
    _check(path, distance, tolerance, join, limit)
    if not all(contour.closed for contour in path.contours):
        raise Refusal("only a closed outline can be made larger or smaller: close it, or make a stroke of it")
    filled = CrossSection(
        [np.ascontiguousarray(p) for p in flatten(path, SHARE * tolerance, MOST_POINTS)], FILL[path.rule]
    )
    half = abs(distance)
    if not half:
        return path
    swept = _swept(path, half, tolerance, join, limit, "butt")
    region = filled + swept if distance > 0.0 else filled - swept
    curves = [
        curve
        for contour in path.contours
        for side in (contour, contour.reversed())
        for curve in parallel(side, half, SHARE * tolerance, join, limit)
    ]
    if distance < 0.0:
        curves = [curve[::-1] for curve in curves[::-1]]
    return _bounding(region, curves, tolerance)


def outline(
    path: Path, width: float, tolerance: float, join: str = "round", ends: str = "butt", limit: float = MITER
) -> Path:
    """What a pen `width` mm wide draws along a path in the plane, as closed contours that fill by "nonzero".

    `join` as for `offset`, `limit` as SVG's stroke-miterlimit; open contours end "butt", "round" or "square".
    """
    _check(path, width, tolerance, join, limit)
    if not width > 0.0:
        raise Refusal(f"a stroke needs a width above 0 mm, not {width:g}")
    if ends not in CAPS:
        raise Refusal(f"a stroke ends {', '.join(CAPS)}, not “{ends!s:.40}”")
    half = 0.5 * width
    flatten(path, SHARE * tolerance, MOST_POINTS)  # refuses what has too many
    region = _swept(path, half, tolerance, join, limit, ends)
    curves: list[Floats] = []
    for contour in path.contours:
        for side in (contour, contour.reversed()):
            curves += parallel(side, half, SHARE * tolerance, join, limit)
            if not contour.closed:
                _, tangents, _, places = end_tangents(pieces_of([side]))
                curves += cap(places[-1], tangents[-1], half, SHARE * tolerance, ends)
    return _bounding(region, curves, tolerance)


def _check(path: Path, distance: float, tolerance: float, join: str, limit: float) -> None:
    if any(contour.dimension == 3 for contour in path.contours):
        raise ValueError("only paths in the plane have parallels")
    if not np.isfinite(distance):
        raise Refusal("the distance of an offset and the width of a stroke are finite numbers")
    if not (np.isfinite(tolerance) and tolerance > 0.0):
        raise Refusal(f"the tolerance of a curve must be above 0 mm, not {tolerance!r:.40}")
    if join not in JOINS:
        raise Refusal(f"corners are joined {', '.join(JOINS)}, not “{join!s:.40}”")
    if not limit >= 1.0:
        raise Refusal(f"the limit of miters is 1 or more, not {limit:g}")
    check_near([path], limit * abs(distance))


def check_near(paths: list[Path], more: float = 0.0) -> None:
    """Raises Refusal for paths that reach too far, `more` mm farther than they are, for polygons to be made of them."""
    parts = [part for path in paths for contour in path.contours for part in (contour, *contour.splines)]
    if parts and not max(np.abs(part.points).max() for part in parts) + more <= FARTHEST:
        raise Refusal(f"it would reach farther than {FARTHEST:g} mm from the origin; that is too large to be exact")


def _swept(path: Path, half: float, tolerance: float, join: str, limit: float, ends: str) -> CrossSection:
    """What the pen sweeps along the flattened path: a rectangle for each chord, what stands at its corners and ends."""
    fine = SHARE * tolerance
    polygons: list[Floats] = []
    for contour in path.contours:
        line, joints = _followed(contour, fine)
        along = np.diff(line, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        side = half * right(along)
        polygons += list(np.stack((line[:-1] + side, line[1:] + side, line[1:] - side, line[:-1] - side), axis=1))
        polygons += _turns(contour.closed, line, joints, along, half, fine, join, limit)
        if not contour.closed:
            for place, way in ((line[-1], along[-1]), (line[0], -along[0])):
                polygons.append(_polygon(cap(place, way, half, fine, ends), fine))
    return CrossSection([np.ascontiguousarray(polygon) for polygon in polygons], FillRule.NonZero)


def _followed(contour: Contour, fine: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Points (n, 2) along a contour, none twice in a row, and at which of them pieces end.

    Towards the ends of a piece the chords get short, so that the last has the direction of the curve: what stands at
    corners and ends hangs on that.
    """
    groups = pieces_of([contour])
    pieces = [(place, group, row) for group in groups for row, place in enumerate(group.place.tolist())]
    short = 0.5 ** np.arange(1, SHORTENED + 1)
    rows, joints = [contour.points[:1]], [np.ones(1, bool)]
    for _, group, row in sorted(pieces, key=lambda piece: piece[0]):
        weights = None if group.weights is None else group.weights[row]
        count = int(chord_counts(group.controls[row : row + 1], fine, None if weights is None else weights[None])[0])
        t = np.array([1.0])
        if group.degree > 1:
            t = np.concatenate((short / count, np.arange(1, count + 1) / count, 1.0 - short / count))
            t = np.unique(t)
        rows.append(evaluated(group.controls[row], t, weights))
        joints.append(t == 1.0)
    line, ends = np.vstack(rows), np.concatenate(joints)
    line[-1] = contour.points[-1]
    fresh = np.append(True, (np.diff(line, axis=0) != 0.0).any(axis=1))
    return line[fresh], ends[fresh]


def _turns(
    closed: bool,
    line: Floats,
    joints: NDArray[np.bool_],
    along: Floats,
    half: float,
    fine: float,
    join: str,
    limit: float,
) -> list[Floats]:
    """Polygons (k, 2), counter-clockwise, on the outer side where the chords turn: joined at nodes, else round."""
    before = np.arange(len(along) - (not closed))
    after = (before + 1) % len(along)
    a, b = along[before], along[after]
    turn = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1))
    found = []
    for number in np.flatnonzero(turn).tolist():
        place = line[before[number] + 1]
        kind = join if joints[before[number] + 1] else "round"
        bends = corner(place, a[number], float(turn[number]), np.copysign(half, turn[number]), fine, kind, limit)
        # It reaches a little into both rectangles: what only touches is not always joined.
        outward = 0.5 * (bends[0][0] + bends[-1][-1]) - place
        polygon = np.vstack((place - 0.1 * outward, _polygon(bends, fine)))
        found.append(polygon if turn[number] > 0.0 else polygon[::-1])
    return found


def _polygon(curves: list[Floats], fine: float) -> Floats:
    """(k, 2) points along lines and cubics that hang together."""
    rows = [curves[0][:1]]
    for curve in curves:
        count = int(chord_counts(curve[None], fine)[0])
        rows.append(evaluated(curve, np.arange(1, count + 1) / count))
    return np.vstack(rows)


def _bounding(region: CrossSection, curves: list[Floats], tolerance: float) -> Path:
    """The boundary of a region from curves of which some lie along it, in the direction that has it on their left."""
    polygons = [np.asarray(polygon, float) for polygon in region.to_polygons()]
    polygons = [polygon for polygon in polygons if _is_wide(polygon, SHARE * tolerance)]
    if not polygons:
        return Path(())
    contours = chained(kept(cut(curves, SHARE * tolerance), polygons, tolerance), tolerance)
    edge = sum(np.linalg.norm(np.diff(p, axis=0, append=p[:1]), axis=1).sum() for p in polygons)
    if contours is not None:
        path = Path(tuple(contours))
        if abs(path.area() - region.area()) <= tolerance * edge:
            return path
    return through(region, tolerance)


def through(region: CrossSection, tolerance: float) -> Path:
    """The boundary of a region as lines and cubics fitted to it; slivers narrower than the tolerance are left out."""
    found = []
    for polygon in (np.asarray(polygon, float) for polygon in region.to_polygons()):
        if _is_wide(polygon, SHARE * tolerance):
            controls = fit(_denser(polygon), SHARE * tolerance, closed=True).controls
            found.append(inferred(Contour.of_segments([_plain(curve, tolerance) for curve in controls], True)))
    return Path(tuple(found))


def _is_wide(polygon: Floats, width: float) -> bool:
    """Slivers come of chords of one curve that are not those of the other."""
    x, y = (polygon - polygon[0]).T
    area = 0.5 * abs(x[:-1] @ y[1:] - x[1:] @ y[:-1])
    return bool(area > width * np.linalg.norm(np.diff(polygon, axis=0, append=polygon[:1]), axis=1).sum())


def _denser(polygon: Floats) -> Floats:
    """With points along its sides, too, that a cubic is held to."""
    along = np.diff(polygon, axis=0, append=polygon[:1])
    sizes = np.linalg.norm(along, axis=1)
    counts = np.clip(np.ceil(sizes / np.median(sizes)), 4, 400).astype(np.intp)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    share = (step / np.repeat(counts, counts))[:, None]
    return np.repeat(polygon, counts, axis=0) + share * np.repeat(along, counts, axis=0)


def _plain(curve: Floats, tolerance: float) -> Floats:
    """A cubic, or a line where it is one."""
    chord = curve[3] - curve[0]
    across = np.abs(chord[0] * (curve[1:3] - curve[0])[:, 1] - chord[1] * (curve[1:3] - curve[0])[:, 0])
    return curve[[0, 3]] if across.max() <= 0.01 * tolerance * np.linalg.norm(chord) else curve
