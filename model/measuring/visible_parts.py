"""What is seen of a part or of a face from a point, what hides the rest, and how that is said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..partition.rays import Rays
from ..solid.provenance import Path
from .visibility import HIDDEN, SEEN, TEXELS, TURNED, Eye, Visibility, visibility

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

Indices = NDArray[np.integer]

NAMED = 3
"""Parts that are named in a sentence."""
LEAST = 0.0005
"""Shares below this are not told."""


@dataclass(frozen=True, slots=True, eq=False)
class PartView:
    """What is seen of some faces of a solid, and the `hiders`: ids of solids with the share each of them hides of the
    area that is turned to the eye, the largest first. The solid itself may be among them."""

    solid_id: str
    visibility: Visibility
    hiders: tuple[tuple[str, float], ...]

    @property
    def share(self) -> float:
        """How much is seen of the area that is turned to the eye, 0 to 1."""
        return self.visibility.share


def part_view(
    rays: Rays, meshes: Sequence[DisplayMesh], solid_id: str, triangles: Indices, eye: Eye, texels: int = TEXELS
) -> PartView:
    """What an eye sees of triangles (places) of the solid, where the tree's faces are those of the meshes in a row.

    Raises ValueError as `visibility`.
    """
    ids = [solid_of(mesh) for mesh in meshes]
    mesh = meshes[ids.index(solid_id)]
    found = visibility(rays, mesh.vertices[mesh.corners[triangles]], eye, texels)
    of_face = np.repeat(np.arange(len(meshes)), [len(mesh.triangles) for mesh in meshes])
    shares = found.hidden_by(of_face)
    order = [int(k) for k in np.argsort(-shares, kind="stable") if shares[k] > 0.0]
    return PartView(solid_id, found, tuple((ids[k], float(shares[k])) for k in order))


def solid_of(mesh: DisplayMesh) -> str:
    """The id of the solid whose mesh this is, "" for one that nobody made."""
    return str(mesh.owners[0][0]) if mesh.owners else ""


def part_triangles(mesh: DisplayMesh, path: Path) -> Indices:
    """The triangles that an occurrence or what is below it has made: all of them for the solid's own path."""
    made = np.array([owner[: len(path)] == path for owner in mesh.owners], bool)
    if len(path) == 1:
        return np.arange(len(mesh.triangles))
    return np.flatnonzero(made[mesh.owner] & (mesh.owner >= 0))


def face_triangles(mesh: DisplayMesh, triangle: int) -> Indices:
    """The smooth face that a triangle is of: all that its owner has made and that hangs together without a crease."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    same = (mesh.owner == mesh.owner[triangle]) & (mesh.subtracted == mesh.subtracted[triangle])
    some = np.flatnonzero(same)
    used, corners = np.unique(mesh.triangles[some], return_inverse=True)
    corners = corners.reshape(-1, 3)
    # At a crease a vertex has several normals, elsewhere the facets around it share one.
    alike = np.unique(np.column_stack((mesh.points[used], mesh.normals[used])), axis=0, return_inverse=True)[1]
    corners = alike.reshape(-1)[corners]
    ends = np.concatenate((corners[:, :2], corners[:, 1:]))
    links = coo_array((np.ones(len(ends), np.int8), (ends[:, 0], ends[:, 1])), (len(used),) * 2)
    _, label = connected_components(links, directed=False)
    label = label[corners[:, 0]]
    return some[label == label[np.searchsorted(some, triangle)]]


def words_of(view: PartView, part: str, names: Mapping[str, str], place: str = "here") -> str:
    """One sentence: how much of `part` is seen from a place, what hides the rest, and how exact that is."""
    found = view.visibility
    facing = found.part(SEEN) + found.part(HIDDEN)
    if not len(found.areas):
        return f"{part} has no surface to look at"
    if facing <= 0.0:
        return f"All of {part} is turned away from {place}"
    if found.share <= 0.0:
        start = f"Nothing of {part} is seen from {place}"
    elif not view.hiders:
        return f"All of {part} that is turned this way is seen from {place}"
    else:
        error = f" (± {_percent(max(found.error, 0.001))})"
        away = " that is turned this way" if found.part(TURNED) > 0.0 else ""
        start = f"{_percent(found.share)}{error} of {part}{away} is seen from {place}"
    told = [hider for hider in view.hiders if hider[1] >= LEAST]
    parts = [
        f"it hides {_percent(share)} itself" if solid_id == view.solid_id else
        f"“{names.get(solid_id, solid_id)}” hides {_percent(share)}"
        for solid_id, share in told[:NAMED]
    ]  # fmt: skip
    if len(told) > NAMED:
        parts.append(f"{len(told) - NAMED} more hide {_percent(sum(share for _, share in told[NAMED:]))}")
    return "; ".join((start, ", ".join(parts))) if parts else start


def _percent(share: float) -> str:
    value = 100.0 * share
    return f"{value:.1f} %" if value < 9.95 else f"{value:.0f} %"
