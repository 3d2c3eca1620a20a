"""A node being laid on a face: where it goes for what the pointer is on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...model.document.placement import IDENTITY, Placement
from ...model.measuring.arrange import laid
from ...model.measuring.landmarks import Face, curved, face_at
from ...model.measuring.resting import clean_direction, digits_of, mapped_face, resting_face
from ...model.operations.arranging import followed_in_world
from .snap import Snap, Snapper

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh
    from ...model.solid.places import Place
    from ..pick import Pick
    from ..viewer import Viewer

Floats = NDArray[np.float64]
GROUND = np.array([0.0, 0.0, 1.0])
OVERLAP = 0.01  # millimetres that what cuts stands out of the face, so that rounding leaves no skin over the hole


@dataclass(frozen=True, slots=True, eq=False)
class Laid:
    """Where the node goes, what the pointer has snapped to, and the flat face there, if any, with its mesh."""

    placement: Placement
    snap: Snap
    mesh: DisplayMesh | None = None
    face: Face | None = None


class Laying:
    """All pointing is at the picture that it began with: what is laid down does not come between.

    The node's own face is the one that it rests on, until `choose` takes another one.
    """

    def __init__(
        self,
        viewer: Viewer,
        place: Place,
        placement: Placement,
        mesh: DisplayMesh,
        values: Mapping[str, float],
        cuts: bool = False,
    ) -> None:
        """`place` is where the resolved node stands, `placement` its own, which may hold expressions; `mesh` is its
        surface in its own axes. What `cuts` goes into the faces that it is laid on, as a drill does."""
        self._viewer = viewer
        self._whole, self._others = Snapper(viewer), Snapper(viewer)  # each keeps the meshes of its own last call
        self._place, self._placement, self._values = place, placement, values
        self._cuts = cuts
        self._digits = digits_of(mesh)
        self._face = resting_face(mesh, place.matrix)
        self.meshes: Mapping[str, DisplayMesh] = viewer.scene.solid_meshes
        self.chosen = False

    @property
    def _id(self) -> str:
        return self._place.node.id

    def own(self, x: float, y: float) -> Pick | None:
        """A face of the node's own under the pixel, as long as none has been chosen."""
        if self.chosen:
            return None
        pick = self._whole.pick(x, y, (), self.meshes)
        return pick if pick is not None and pick.triangle >= 0 and self._id in pick.path else None

    def choose(self, pick: Pick) -> None:
        """Let this face of the node's own be the one that comes to lie on another one."""
        centre, normal = _centre_and_normal(pick, self._whole.mesh(pick.solid_id))
        self._face, self.chosen = (centre, -normal if pick.subtracted else normal), True

    def own_face(self, pick: Pick) -> tuple[DisplayMesh, Face | None]:
        """The flat face that `own` gave, and its mesh; no face where it is curved."""
        mesh = self._whole.mesh(pick.solid_id)
        return mesh, _flat_face(pick, mesh)

    def at(self, x: float, y: float) -> Laid | None:
        """Where the node goes for the face under the pixel, the rim of the hole, or the crossing of the ground's grid.

        None where there is none of them.
        """
        where = (x, y, (self._id,), self.meshes)
        snap, pick = self._others.find(*where), self._others.pick(*where)
        if pick is None:
            if snap is None or snap.kind not in ("grid", "centre"):
                return None
            return self._over_hole(snap, x, y) if snap.kind == "centre" else Laid(self._on(snap.point, GROUND), snap)
        mesh = None if pick.triangle < 0 else self._others.mesh(pick.solid_id)
        centre, normal = _centre_and_normal(pick, mesh)
        if snap is None or abs(float((np.array(snap.point) - centre) @ normal)) > 10.0 ** (1 - self._digits):
            if snap is not None and snap.kind == "centre":
                return self._over_hole(snap, x, y)
            snap = Snap(
                "face", pick.point, pick.normal, pick.path
            )  # what lies beside the face is none of its landmarks
        on = np.array(snap.point)
        on -= normal * float((on - centre) @ normal)
        return Laid(self._on(on, normal), snap, mesh, _flat_face(pick, mesh))

    def _over_hole(self, snap: Snap, x: float, y: float) -> Laid:
        """On the plane of a circle, about its centre, on the side of the eye."""
        normal = clean_direction(np.array(snap.direction))
        away = float(normal @ self._viewer.ray(x, y)[1]) > 0.0
        return Laid(self._on(snap.point, -normal if away else normal), snap)

    def _on(self, point: ArrayLike, normal: Floats) -> Placement:
        if self._cuts:
            point, normal = np.asarray(point, float) + OVERLAP * normal, -normal
        matrix = laid(*self._face, point, normal)
        return followed_in_world(self._placement, self._place.outer, matrix, self._values, self._digits)


def _flat_face(pick: Pick, mesh: DisplayMesh | None) -> Face | None:
    """None for curved faces, and for the cut face of a section, which no mesh has."""
    return None if mesh is None or curved(mesh, pick.triangle) else face_at(mesh, pick.triangle)


def _centre_and_normal(pick: Pick, mesh: DisplayMesh | None) -> tuple[Floats, Floats]:
    """Of a picked flat face, in the world; of another one the point, and the normal there."""
    if mesh is None or _flat_face(pick, mesh) is None:
        return np.array(pick.point), clean_direction(np.array(pick.normal))
    return mapped_face(mesh, pick.triangle, IDENTITY)
