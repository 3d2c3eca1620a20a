"""Segments of drawings in the plane: ends that nearly meet, segments that cross, and repairs of both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...document.errors import Refusal
from .nearness import Near, near_edges, near_vertices
from .report import FARTHEST, Finding, Progress, told
from .sides import Floats, Numbers, Sides, distinct_places
from .welding import joined
from .words import DRAWING_KINDS, many

ROUNDING = 1e-12
"""Within this share of a drawing's size lines are taken to meet, whatever the tolerance."""


@dataclass(frozen=True, slots=True, eq=False)
class DrawingFaults:
    """Counts of `segments`, and `findings` with places (2,), of each kind the largest first; the counts are true where
    those are capped.

    `open_ends` are places where one segment alone ends; `near_ends` pairs of places within the tolerance that no
    segment joins; `near_end_segment` ends beside or on a segment between its own ends; `crossings` pairs of segments
    that cross between their ends; `duplicates` segments with the ends of another before them; `short` ones within the
    tolerance.
    """

    segments: int
    open_ends: int
    near_ends: int
    near_end_segment: int
    crossings: int
    duplicates: int
    short: int
    tolerance: float
    findings: tuple[Finding, ...]

    @property
    def sound(self) -> bool:
        """Whether nothing was found."""
        return not told(self, DRAWING_KINDS)

    def __str__(self) -> str:
        """One line for the user."""
        return f"{many(self.segments, 'line')}: {', '.join(told(self, DRAWING_KINDS)) or 'nothing found'}"

    def table(self) -> dict[str, Any]:
        """Plain values, as JSON has them."""
        counts = {words.count: getattr(self, words.count) for words in DRAWING_KINDS.values()}
        findings = [finding.table(DRAWING_KINDS) for finding in self.findings]
        return {"segments": self.segments, **counts, "tolerance": self.tolerance, "findings": findings}


@dataclass(frozen=True, slots=True, eq=False)
class _Net:
    """Segments as a graph: `places` (n, 3), z 0, each once; `ends` (s, 2) of segments, the lower first, each pair once;
    `all_ends` (k, 2) of all segments as they run."""

    places: Floats
    ends: Numbers
    all_ends: Numbers

    def near(self, tolerance: float, progress: Progress | None = None) -> tuple[Near, Near, Near]:
        size = float(np.ptp(self.places, axis=0).max(initial=0.0)) if len(self.places) else 0.0
        none = np.zeros(0, np.int64)
        sides = Sides(none, none, none, self.ends, none, none, none)
        told = (lambda share: progress("segments", share)) if progress else None
        reach = max(tolerance, ROUNDING * size)
        beside, across = near_edges(self.places, np.zeros((0, 3), np.int64), sides, reach, told)
        return near_vertices(self.places, sides, tolerance), beside, across


def find_drawing_faults(
    segments: ArrayLike, tolerance: float = 1e-3, progress: Progress | None = None, limit: int = 200
) -> DrawingFaults:
    """What keeps segments (n, 2, 2) in mm from being closed outlines that do not cross, within a tolerance in mm.

    Ends are joined where they lie at the very same place. Up to `limit` findings of each kind have places. Raises
    Refusal for coordinates that are none, a tolerance that is no number from 0 up, and one that brings too many ends
    together.
    """
    net = _net(segments, tolerance)
    close, beside, across = net.near(tolerance, progress)
    lengths = np.linalg.norm(net.places[net.ends[:, 0]] - net.places[net.ends[:, 1]], axis=1)
    degree = np.bincount(net.all_ends.reshape(-1), minlength=len(net.places))
    alone = np.flatnonzero(degree == 1)
    every = np.sort(net.all_ends, axis=1)
    _, first = np.unique(every, axis=0, return_index=True)
    again = every[np.setdiff1d(np.arange(len(every)), first)]
    again = again[again[:, 0] != again[:, 1]]
    long = np.linalg.norm(net.places[every[:, 0]] - net.places[every[:, 1]], axis=1)
    short = long <= tolerance
    tiny, doubled = every[short], net.places[again]
    spans = np.linalg.norm(doubled[:, 0] - doubled[:, 1], axis=1)
    span_of = dict(zip(map(tuple, net.ends.tolist()), lengths.tolist(), strict=True))
    lesser = [min(span_of[_pair(*four[:2])], span_of[_pair(*four[2:])]) for four in across.vertices.tolist()]
    nothing = np.zeros(len(alone))
    listed = [
        *_listed("crossing", across.vertices, across.places, np.array(lesser), 0.0 * across.gaps, limit),
        *_listed("near end-segment", beside.vertices, beside.places, beside.gaps, beside.gaps, limit),
        *_listed("near ends", close.vertices, close.places, close.gaps, close.gaps, limit),
        *_listed("open end", alone[:, None], net.places[alone], nothing, nothing, limit),
        *_listed("duplicate", again, doubled.mean(axis=1), spans, 0.0 * spans, limit),
        *_listed("short", tiny, net.places[tiny].mean(axis=1), long[short], 0.0 * long[short], limit),
    ]
    return DrawingFaults(
        segments=len(net.all_ends),
        open_ends=len(alone),
        near_ends=len(close),
        near_end_segment=len(beside),
        crossings=len(across),
        duplicates=len(again),
        short=int(short.sum()),
        tolerance=tolerance,
        findings=tuple(listed),
    )


def weld_segments(segments: ArrayLike, tolerance: float) -> tuple[Floats, str]:
    """Ends of segments (n, 2, 2) within `tolerance` mm of each other as one; no end moves farther than that.

    Segments that lose their length by it, and those with the ends of another, are dropped. Returns the segments and
    words about what changed. Raises Refusal as `find_drawing_faults` does.
    """
    lines = _lines(segments, tolerance)
    flat = lines.reshape(-1, 2)
    target = joined(np.column_stack((flat, np.zeros(len(flat)))), tolerance)
    moved = int((flat[target] != flat).any(axis=1).sum())
    ends = target.reshape(-1, 2)
    kept = np.flatnonzero(ends[:, 0] != ends[:, 1])
    _, first = np.unique(np.sort(ends[kept], axis=1), axis=0, return_index=True)
    once = kept[np.sort(first)]
    words = [f"{many(moved, 'end')} welded"] if moved else []
    if len(kept) < len(lines):
        words.append(f"{many(len(lines) - len(kept), 'short segment')} dropped")
    if len(once) < len(kept):
        words.append(f"{many(len(kept) - len(once), 'repeated segment')} dropped")
    return flat[ends[once]].reshape(-1, 2, 2), ", ".join(words)


def cut_segments(segments: ArrayLike, tolerance: float) -> tuple[Floats, str]:
    """Segments (n, 2, 2) cut where they cross, and at ends of others within `tolerance` mm, which they are led to.

    Repeated segments are dropped. Returns the segments and words about what changed. Raises Refusal as
    `find_drawing_faults` does.
    """
    net = _net(segments, tolerance)
    _, beside, across = net.near(tolerance)
    count = len(net.places)
    known = net.ends @ (count, 1)
    order = np.argsort(known)
    pairs = np.concatenate((beside.vertices[:, 1:], across.vertices[:, :2], across.vertices[:, 2:]))
    row = order[np.searchsorted(known[order], np.sort(pairs, axis=1) @ (count, 1))] if len(pairs) else pairs[:, 0]
    at = np.concatenate((net.places[beside.vertices[:, 0]], across.places, across.places))
    a, b = net.places[net.ends[:, 0]], net.places[net.ends[:, 1]]
    share = np.einsum("ij,ij->i", at - a[row], b[row] - a[row])
    # All points of a segment in their order: its start, where it is cut, its end.
    lines = np.arange(len(net.ends))
    owner = np.concatenate((lines, row, lines))
    place = np.concatenate((a, at, b))
    along = np.concatenate((np.full(len(a), -np.inf), share, np.full(len(b), np.inf)))
    sequence = np.lexsort((along, owner))
    owner, place = owner[sequence], place[sequence, :2]
    inner = (np.diff(owner) == 0) & (np.diff(place, axis=0) != 0.0).any(axis=1)
    result = np.stack((place[:-1][inner], place[1:][inner]), axis=1)
    words = [f"{many(len(across), 'crossing')} cut"] if len(across) else []
    if len(beside):
        words.append(f"{many(len(beside), 'end')} joined to segments beside {'it' if len(beside) == 1 else 'them'}")
    return result, ", ".join(words)


def _lines(segments: ArrayLike, tolerance: float) -> Floats:
    lines = np.asarray(segments, np.float64).reshape(-1, 2, 2)
    if not np.isfinite(tolerance) or tolerance < 0.0:
        raise Refusal(f"a tolerance must be a number from 0 mm up, not {tolerance!r:.40}")
    if not np.isfinite(lines).all():
        bad = int(np.flatnonzero(~np.isfinite(lines).all(axis=(1, 2)))[0])
        raise Refusal(f"segment {bad + 1:,} has a coordinate that is no finite number")
    if (np.abs(lines) > FARTHEST).any():
        bad = int(np.flatnonzero((np.abs(lines) > FARTHEST).any(axis=(1, 2)))[0])
        raise Refusal(f"segment {bad + 1:,} lies more than {FARTHEST:g} mm away, too far to be looked at")
    return lines


def _net(segments: ArrayLike, tolerance: float) -> _Net:
    flat = _lines(segments, tolerance).reshape(-1, 2)
    where = distinct_places(flat)
    _, first = np.unique(where, return_index=True)
    ends = where.reshape(-1, 2)
    different = np.sort(ends[ends[:, 0] != ends[:, 1]], axis=1)
    places = np.column_stack((flat[first], np.zeros(len(first))))
    return _Net(places, np.unique(different, axis=0), ends)


def _pair(one: int, two: int) -> tuple[int, int]:
    return min(one, two), max(one, two)


def _listed(kind: str, vertices: Numbers, places: Floats, sizes: Floats, gaps: Floats, limit: int) -> list[Finding]:
    worst = np.argsort(-sizes, kind="stable")[:limit].tolist()
    return [Finding(kind, places[k, :2], float(sizes[k]), float(gaps[k]), vertices[k]) for k in worst]
