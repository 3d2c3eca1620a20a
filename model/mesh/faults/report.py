"""What is wrong with a mesh: counts, and places to look at."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...document.errors import Refusal
from ..pieces import pieces
from .crossings import crossings
from .nearness import near_edges, near_vertices
from .sides import Floats, Numbers, Sides, heights_of, normals_of, shells, sides_of, signed_volume
from .words import MESH_KINDS, KindWords, many

Progress = Callable[[str, float], None]
"""Told what is being done and which share of all is done, 0 to 1; may raise to stop."""

FARTHEST = 1e40
"""mm; with larger coordinates the squares of volumes are no numbers any more."""

COUNTS = ("vertices", "triangles", "components", "open_edges", "borders", "overused_edges", "turned_edges", "crossings",
          "duplicates", "degenerate", "near_vertex_edge", "near_edge_edge", "near_vertices", "slivers")  # fmt: skip
FAULTS = COUNTS[3:]
"""The counts of a MeshFaults that should be 0."""


@dataclass(frozen=True, slots=True, eq=False)
class Finding:
    """One fault: `place` (3,) in mm with the `size` of what is around it (a border, edge, face or crossing), and `gap`,
    how near things are or how high a sliver is, both in mm. `vertices` are those that have part in it."""

    kind: str
    place: Floats
    size: float
    gap: float
    vertices: Numbers

    def table(self, words: Mapping[str, KindWords]) -> dict[str, Any]:
        """Plain values, as JSON has them."""
        return {
            "kind": self.kind, "words": words[self.kind].one, "place": self.place.tolist(), "size": self.size,
            "gap": self.gap, "vertices": self.vertices.tolist(),
        }  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class MeshFaults:
    """Counts of a mesh, and `findings`, of each kind the worst ones first; the counts are true where those are capped.

    `vertices` are those that triangles have; `components` hang together by edges, `borders` are chains of open edges
    that hang together by vertices. `degenerate` faces have two corners at one place; where these are one vertex, the
    face has no part in the edges. `duplicates` have the corners of a face before them, in either direction. `slivers`
    have a height within the tolerance, degenerate ones not counted. `crossings` are pairs of faces. `volume` in mm³ is
    None where the surface is not closed, and negative where it faces inwards; `area` in mm².
    """

    vertices: int
    triangles: int
    open_edges: int
    borders: int
    overused_edges: int
    turned_edges: int
    components: int
    duplicates: int
    degenerate: int
    slivers: int
    near_vertices: int
    near_vertex_edge: int
    near_edge_edge: int
    crossings: int
    closed: bool
    volume: float | None
    area: float
    tolerance: float
    findings: tuple[Finding, ...]

    @property
    def sound(self) -> bool:
        """Whether nothing was found."""
        return self.closed and not self.inside_out and not any(getattr(self, name) for name in FAULTS)

    @property
    def inside_out(self) -> bool:
        """Whether a closed surface faces inwards, all in all."""
        return self.volume is not None and self.volume < 0.0

    def __str__(self) -> str:
        """One line for the user."""
        head = ", ".join((many(self.triangles, "triangle"), many(self.vertices, "vertex", "vertices"),
                          many(self.components, "piece")))  # fmt: skip
        found = told(self, MESH_KINDS)
        if self.open_edges:
            found[0] += f" ({many(self.open_edges, 'open edge')})"
        if self.inside_out:
            found.append("inside out")
        return f"{head}: {', '.join(found) or 'nothing found'}"

    def table(self) -> dict[str, Any]:
        """Plain values, as JSON has them."""
        counts = {name: getattr(self, name) for name in COUNTS}
        findings = [finding.table(MESH_KINDS) for finding in self.findings]
        return {**counts, "closed": self.closed, "volume": self.volume, "area": self.area,
                "tolerance": self.tolerance, "findings": findings}  # fmt: skip


def told(faults: object, kinds: Mapping[str, KindWords]) -> list[str]:
    """How many there are of each kind in a report, those of which there are some."""
    return [words.counted(getattr(faults, words.count)) for words in kinds.values() if getattr(faults, words.count)]


def find_faults(
    vertices: ArrayLike,
    triangles: ArrayLike,
    tolerance: float = 1e-3,
    progress: Progress | None = None,
    limit: int = 200,
) -> MeshFaults:
    """What is wrong with triangles (m, 3) over vertices (n, 3) in mm, counter-clockwise seen from outside.

    Vertices are joined where triangles have the same one by number; those at one place that are not are near vertices.
    Up to `limit` findings of each kind have places. Raises Refusal for coordinates or indices that are none, a
    tolerance that is no number from 0 up, and one that brings too many vertices together.
    """
    points, faces = arrays_of(vertices, triangles, tolerance)
    corners = points[faces]
    flat = (corners == np.roll(corners, 1, axis=1)).all(axis=2).any(axis=1)
    proper = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    sides = sides_of(proper, len(points))
    close = near_vertices(points, sides, tolerance)
    on_edges, across = near_edges(points, proper, sides, tolerance, _part(progress, "nearness", 0.0, 0.6))
    through = crossings(points, proper, _part(progress, "crossings", 0.6, 1.0))
    heights, lengths = heights_of(points, proper)
    slivers = np.flatnonzero((heights <= tolerance) & (lengths > 0.0).all(axis=1))
    repeated = np.flatnonzero(~_first_of_kind(proper))
    borders = _borders(points, sides)
    listed = [
        *borders[:limit],
        *_edges("overused edge", points, sides, sides.overused, limit),
        *_edges("turned edge", points, sides, sides.turned, limit),
        *_rows("crossing", proper[through.triangles].reshape(-1, 6), through.places, through.sizes, 0.0, limit),
        *_faces("duplicate", points, proper[repeated], limit),
        *_faces("degenerate", points, faces[flat], limit),
    ]
    for kind, near in (("near vertex-edge", on_edges), ("near edge-edge", across), ("near vertices", close)):
        listed += _rows(kind, near.vertices, near.places, near.gaps, near.gaps, limit)
    thin = proper[slivers]
    places = points[thin].mean(axis=1)
    listed += _rows("sliver", thin, places, lengths[slivers].max(axis=1, initial=0.0), heights[slivers], limit)
    return MeshFaults(
        vertices=int(np.count_nonzero(np.bincount(faces.reshape(-1), minlength=len(points)))),
        triangles=len(faces),
        open_edges=int(sides.open.sum()),
        borders=len(borders),
        overused_edges=int(sides.overused.sum()),
        turned_edges=int(sides.turned.sum()),
        components=int(shells(sides).max(initial=-1)) + 1,
        duplicates=len(repeated),
        degenerate=int(flat.sum()),
        slivers=len(slivers),
        near_vertices=len(close),
        near_vertex_edge=len(on_edges),
        near_edge_edge=len(across),
        crossings=len(through.sizes),
        closed=sides.closed,
        volume=float(signed_volume(points, proper).sum()) if sides.closed else None,
        area=float(np.linalg.norm(normals_of(points, faces), axis=1).sum()) / 2.0,
        tolerance=tolerance,
        findings=tuple(listed),
    )


def arrays_of(vertices: ArrayLike, triangles: ArrayLike, tolerance: float = 0.0) -> tuple[Floats, Numbers]:
    """Vertices (n, 3) and triangles (m, 3) as arrays. Raises Refusal as `find_faults` says."""
    points, faces = np.asarray(vertices, np.float64).reshape(-1, 3), np.asarray(triangles, np.int64).reshape(-1, 3)
    if not np.isfinite(tolerance) or tolerance < 0.0:
        raise Refusal(f"a tolerance must be a number from 0 mm up, not {tolerance!r:.40}")
    if not np.isfinite(points).all():
        bad = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise Refusal(f"vertex {bad + 1:,} has a coordinate that is no finite number")
    if (np.abs(points) > FARTHEST).any():
        bad = int(np.flatnonzero((np.abs(points) > FARTHEST).any(axis=1))[0])
        raise Refusal(f"vertex {bad + 1:,} lies more than {FARTHEST:g} mm away, too far to be looked at")
    if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
        bad = int(np.flatnonzero(((faces < 0) | (faces >= len(points))).any(axis=1))[0])
        raise Refusal(f"triangle {bad + 1:,} asks for a vertex that the {len(points):,} vertices do not have")
    return points, faces


def _first_of_kind(triangles: Numbers) -> NDArray[np.bool_]:
    """(m,) which triangles are the first with their corners."""
    found = np.zeros(len(triangles), bool)
    found[np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)[1]] = True
    return found


def _borders(points: Floats, sides: Sides) -> list[Finding]:
    ends = sides.ends[sides.open]
    if not len(ends):
        return []
    used, local = np.unique(ends, return_inverse=True)
    local = local.reshape(-1, 2)
    group = pieces(local[:, 0], local[:, 1], len(used))
    order = np.argsort(group, kind="stable")
    starts = np.flatnonzero(np.diff(group[order], prepend=-1))
    low = np.minimum.reduceat(points[used[order]], starts)
    high = np.maximum.reduceat(points[used[order]], starts)
    sizes = np.linalg.norm(high - low, axis=1)
    members = np.split(used[order], starts[1:])
    worst = np.argsort(-sizes, kind="stable").tolist()
    return [Finding("border", (low[k] + high[k]) / 2.0, float(sizes[k]), 0.0, members[k]) for k in worst]


def _edges(kind: str, points: Floats, sides: Sides, chosen: NDArray[np.bool_], limit: int) -> list[Finding]:
    ends = sides.ends[chosen]
    a, b = points[ends[:, 0]], points[ends[:, 1]]
    return _rows(kind, ends, (a + b) / 2.0, np.linalg.norm(b - a, axis=1), 0.0, limit)


def _faces(kind: str, points: Floats, faces: Numbers, limit: int) -> list[Finding]:
    _, lengths = heights_of(points, faces)
    return _rows(kind, faces, points[faces].mean(axis=1), lengths.max(axis=1, initial=0.0), 0.0, limit)


def _rows(
    kind: str, vertices: Numbers, places: Floats, sizes: Floats, gaps: Floats | float, limit: int
) -> list[Finding]:
    """The largest ones as findings."""
    every = np.broadcast_to(gaps, len(sizes))
    worst = np.argsort(-sizes, kind="stable")[:limit].tolist()
    return [Finding(kind, places[k], float(sizes[k]), float(every[k]), vertices[k]) for k in worst]


def _part(progress: Progress | None, label: str, begin: float, end: float) -> Callable[[float], None] | None:
    return None if progress is None else lambda share: progress(label, begin + share * (end - begin))
