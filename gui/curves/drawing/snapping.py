"""What the pointer snaps to in a plane: outlines, corners of solids, lines through nodes, directions, the grid."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....model.document.errors import Refusal
from ....model.document.nodes import Node
from ....model.document.outlines import is_outline
from ....model.document.placement import IDENTITY, inverse
from ....model.document.resolve import Resolver
from ....model.document.tree import walk
from ....model.outline.paths import own_path, path_of
from ....render.handles.snap import Snapper as Landmarks
from .near_pointer import Kind, Near, Plane, Snap
from .snap_targets import Flat, Target

if TYPE_CHECKING:
    from ....model.editing.session import Session
    from ....render.viewer import Viewer
    from ...view.viewport import Viewport

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

NOTHING = np.zeros((0, 2))
LANDMARKS: dict[str, tuple[Kind, str]] = {
    "vertex": ("corner", "corner"),
    "midpoint": ("midpoint", "middle of an edge"),
    "centre": ("centre", "centre"),
    "edge": ("edge", "on edge"),
}


class Snapper:
    """Knows what the session shows. While that is a preview, what stood there before is what counts.

    Made when the viewport has its viewer; of outlines it keeps the points by identity.
    """

    def __init__(self, viewport: Viewport, session: Session) -> None:
        self._viewport, self._session = viewport, session
        self._resolver = Resolver()
        self._landmarks: tuple[Viewer, Landmarks] | None = None
        self._known: dict[int, tuple[Node, Target]] = {}
        self._targets: dict[str, Target] = {}
        self._followed: object = None

    def snap(
        self,
        pixel: tuple[float, float],
        frame: Floats,
        exclude: Collection[object] = frozenset(),
        origin: ArrayLike | None = None,
        *,
        own: ArrayLike = NOTHING,
        angles: bool = False,
        free: bool = False,
        exact: bool = False,
    ) -> Snap | None:
        """What logical pixel (x, y) means in the plane of `frame` (3, 4), plane to world; None where it is not seen.

        `exclude` has nodes (contour, node) of the selected outline, and ids of outlines that do not count at all.
        `origin` (2,) is a point to be in line with, and the one that directions are taken from with `angles`. `own`
        (k, 2) are more points to snap to, which are not in the document. `free`: to nothing, but a tidy number;
        `exact`: not even that.
        """
        viewer = self._viewport.viewer
        if viewer is None:
            return None
        plane = Plane(np.asarray(frame, float), viewer.camera, viewer.size)
        point = plane.at(pixel)
        if point is None:
            return None
        near = Near(plane, np.array(pixel, float), point)
        begin = None if origin is None else np.asarray(origin, float)
        if exact:
            return Snap(point, "", "free")
        if free:
            return Snap(near.tidy(point), "", "free")
        flats = self._within(plane.frame, exclude)
        nodes = [np.asarray(own, float).reshape(-1, 2), *(flat.nodes[keep] for flat, keep, _ in flats)]
        places = np.concatenate(nodes)
        if angles and begin is not None:
            return near.on_angle(begin, places)
        found = near.nearest(places)
        if found is not None:
            return Snap(found, "on node", "node")
        landmark = self._landmark(viewer, plane, pixel)
        if landmark is not None and landmark.kind != "edge":
            return landmark
        middles = [flat.middles[0][moving[flat.middles[1]]] for flat, _, moving in flats]
        found = near.nearest(np.concatenate([NOTHING, *middles]))
        if found is not None:
            return Snap(found, "middle of a segment", "midpoint")
        lines = near.in_line(places if begin is None else np.vstack((places, begin)))
        curve = near.on_curve(flats, lines)
        return curve or landmark or near.on_lines(lines)

    # What there is.

    def _within(self, frame: Floats, exclude: Collection[object]) -> list[tuple[Flat, Flags, Flags]]:
        """What lies in the plane: for each outline also which of its nodes (k,) and of its segments (s,) count."""
        self._follow()
        selection = self._session.selection
        moved = np.array([entry for entry in exclude if isinstance(entry, tuple)], np.intp).reshape(-1, 2)
        found = []
        for outline_id, target in self._targets.items():
            if outline_id in exclude:
                continue
            flat = target.within(frame)
            if len(moved) and (outline_id,) == selection:
                gone = _codes(moved)
                keep = ~np.isin(_codes(flat.rows), gone)
                ends = flat.segment_ends
                still = ~(np.isin(_codes(ends[:, [0, 1]]), gone) | np.isin(_codes(ends[:, [0, 2]]), gone))
            else:
                keep, still = np.ones(len(flat.rows), bool), np.ones(len(flat.segment_ends), bool)
            found.append((flat, keep, still))
        return found

    def _follow(self) -> None:
        """Look at the visible outlines that stand by themselves, and the selected one inside a solid."""
        document, selection = self._session.view, self._session.selection
        if self._session.previewing or self._followed == (document, selection):
            return
        self._followed = (document, selection)
        resolved = self._resolver.resolve(document)
        known, self._known, self._targets = self._known, {}, {}
        for root in resolved.profiles:
            if not root.visible:
                continue
            kept = known.get(id(root))
            if kept is None or kept[0] is not root:
                try:
                    kept = (root, Target(path_of(root), IDENTITY))
                except Refusal:  # its row says why
                    continue
            self._known[id(root)] = kept
            self._targets[root.id] = kept[1]
        for solid in resolved.solids:
            for node in walk(solid):
                if node.id in selection and is_outline(node):
                    self._inside(node)

    def _inside(self, node: Node) -> None:
        from ....model.outline.frames import frame_of

        try:
            self._targets[node.id] = Target(own_path(node), frame_of(self._session.document, node.id))
        except Refusal:  # its row says why
            return

    def _landmark(self, viewer: Viewer, plane: Plane, pixel: tuple[float, float]) -> Snap | None:
        """A corner, a middle, a centre or an edge of the solids, where it lies in the plane."""
        if not viewer.scene.meshes:
            return None
        if self._landmarks is None or self._landmarks[0] is not viewer:
            self._landmarks = (viewer, Landmarks(viewer))
        found = self._landmarks[1].find(*pixel)
        if found is None or found.kind not in LANDMARKS:
            return None
        into = inverse(plane.frame)
        place = into[:, :3] @ np.array(found.point) + into[:, 3]
        size = max(float(np.abs(np.array(found.point)).max()), 1.0)
        if abs(place[2]) > 1e-5 * size:
            return None
        kind, words = LANDMARKS[found.kind]
        # The pictures' points are of single precision.
        return Snap(np.round(place[:2], max(5 - int(np.ceil(np.log10(size))), 0)) + 0.0, words, kind)


def _codes(rows: NDArray[np.intp]) -> NDArray[np.intp]:
    """(k,) one number for each pair of a contour and a node."""
    return rows[:, 0] * (1 << 32) + rows[:, 1]
