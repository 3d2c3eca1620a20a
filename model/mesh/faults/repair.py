"""Several repairs one after another, and what they made better and worse."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...document.errors import Refusal
from .holes import close_holes
from .orienting import drop_duplicates, orient
from .report import FAULTS, MeshFaults, Progress, arrays_of, find_faults
from .sides import Floats, Numbers
from .thinning import drop_slivers
from .welding import split_edges, weld
from .words import MESH_KINDS, REPAIRS

NAMES = {"open_edges": "open edges"} | {words.count: words.several for words in MESH_KINDS.values()}
"""The counts of a MeshFaults that should be 0, in words."""

SAME_VOLUME = 1e-9
"""The share by which a volume may differ before it is said to."""


@dataclass(frozen=True, slots=True, eq=False)
class Repaired:
    """`vertices` (n, 3) and `triangles` (m, 3) after repairs, `words` about each change, the reports `before` and
    `after`, and in `worse` what is now worse than before, one line each."""

    vertices: Floats
    triangles: Numbers
    words: tuple[str, ...]
    before: MeshFaults
    after: MeshFaults
    worse: tuple[str, ...]


def repaired(
    vertices: ArrayLike,
    triangles: ArrayLike,
    tolerance: float = 1e-3,
    repairs: Collection[str] | str = tuple(REPAIRS),
    longest: float | None = None,
    progress: Progress | None = None,
) -> Repaired:
    """Triangles (m, 3) over vertices (n, 3) after `mended`, with reports before and after. Raises as that does."""
    points, faces = arrays_of(vertices, triangles, tolerance)
    before = find_faults(points, faces, tolerance, _part(progress, 0.0, 0.45))
    points, faces, words = mended(points, faces, tolerance, repairs, longest, _part(progress, 0.45, 0.55))
    after = find_faults(points, faces, tolerance, _part(progress, 0.55, 1.0))
    return Repaired(points, faces, words, before, after, worsened(before, after))


def mended(
    vertices: ArrayLike,
    triangles: ArrayLike,
    tolerance: float = 1e-3,
    repairs: Collection[str] | str = tuple(REPAIRS),
    longest: float | None = None,
    progress: Progress | None = None,
) -> tuple[Floats, Numbers, tuple[str, ...]]:
    """Those of REPAIRS that are asked for, in their order, on triangles (m, 3) over vertices (n, 3), within a tolerance
    in mm; `longest` is the longest border in mm that is filled.

    Returns vertices, triangles and words about each change. Raises Refusal as `find_faults` does, for repairs that
    there are not, and for a longest border that is no length.
    """
    wanted = [repairs] if isinstance(repairs, str) else list(repairs)
    unknown = [name for name in wanted if name not in REPAIRS]
    if unknown:
        raise Refusal(f"{unknown[0]!r:.40} is no repair; there are {', '.join(REPAIRS)}")
    if longest is not None and not longest >= 0.0:
        raise Refusal(f"the longest border to be filled must be a length in mm, not {longest!r:.40}")
    points, faces = arrays_of(vertices, triangles, tolerance)
    words: list[str] = []

    def take(result: tuple[Floats, Numbers, str]) -> None:
        nonlocal points, faces
        points, faces, said = result
        if said:
            words.append(said)

    steps = [name for name in REPAIRS if name in wanted]
    for place, name in enumerate(steps):
        if progress:
            progress(REPAIRS[name], place / len(steps))
        if name == "weld":
            take(weld(points, faces, 0.0))
            take(split_edges(points, faces, tolerance))
            take(weld(points, faces, tolerance))
        elif name == "duplicates":
            take(drop_duplicates(points, faces))
        elif name == "slivers":
            take(drop_slivers(points, faces, tolerance))
        elif name == "orient":
            take(orient(points, faces))
        else:
            take(close_holes(points, faces, longest))
            if "orient" in steps:  # what is closed only now has an outside only now
                take(orient(points, faces))
    return points, faces, tuple(words)


def worsened(before: MeshFaults, after: MeshFaults) -> tuple[str, ...]:
    """What a later report has worse than an earlier one: counts of faults that rose, a surface no longer closed, more
    pieces, and fewer of them or another volume where it was closed."""
    found = []
    for name in FAULTS:
        one, two = getattr(before, name), getattr(after, name)
        if two > one:
            found.append(f"{NAMES[name]}: {one:,} before, {two:,} now")
    if before.closed and not after.closed:
        found.append("the surface was closed and is no longer")
    if after.components > before.components or (before.closed and after.components < before.components):
        found.append(f"pieces: {before.components:,} before, {after.components:,} now")
    if before.volume is not None and after.volume is not None:
        one, two = abs(before.volume), abs(after.volume)
        if not np.isclose(one, two, rtol=SAME_VOLUME, atol=0.0):
            share = f" ({(two - one) / one:+.2g} of it)" if one else ""
            found.append(f"volume: {one:,.9g} mm³ before, {two:,.9g} mm³ now{share}")
    return tuple(found)


def _part(progress: Progress | None, begin: float, end: float) -> Progress | None:
    return (lambda label, share: progress(label, begin + share * (end - begin))) if progress else None
