"""The solids of a document while a parameter goes: which shape each has, and where it stands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...document.document import Document
from ...document.errors import Refusal
from ...document.nodes import Node
from ...document.placement import inverse, product
from ...document.resolve import Resolver
from ...mesh.faults.box_pairs import meeting
from ...solid.evaluate import Evaluator
from ...solid.results import result_of
from ...worker.shown import Message
from ..bodies import Body
from ..memo import body_of
from ..motion import Motion
from .moved import corners_of
from .screws import RIGID

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """Of n parts at one moment: the numbers of their `shapes` (n,), and the `poses` (n, 4, 4) that take the bodies of
    these to where the parts are."""

    shapes: Numbers
    poses: Floats


class MovingParts:
    """The visible solids of a document at any value of a motion's parameter.

    What is only turned and moved is cut once, and so is what stands in several places: its body keeps its trees.
    `bodies` are those by number of shape. Raises Refusal where the document has no such parameter.
    """

    def __init__(
        self,
        document: Document,
        motion: Motion,
        tolerance: float,
        progress: Callable[[str], None] | None = None,
    ) -> None:
        if not any(parameter.name == motion.parameter for parameter in document.parameters):
            raise Refusal(f"the motion “{motion.name}” drives {motion.parameter}, and there is no such parameter")
        self.document, self.motion, self.tolerance = document, motion, tolerance
        self.roots = tuple(root for root in document.solids if root.visible)
        self.bodies: list[Body] = []
        self.messages: dict[Message, None] = {}
        self._progress = progress
        self._evaluator, self._resolver = Evaluator(), Resolver()
        self._known: dict[bytes, list[tuple[Floats, int]]] = {}
        """By a digest without placement: the inverses (3, 4) of the placements that were cut, with the shapes."""
        self._last: dict[str, tuple[Node, tuple[int, Floats]]] = {}
        """By a root's id: as it was looked at last, and its shape."""

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(root.name for root in self.roots)

    def at_rest(self) -> Standing:
        """As the document has them."""
        return self._standing(self.document)

    def at(self, share: float) -> Standing:
        """At a share of the motion, 0 to 1."""
        return self._standing(document_at(self.document, self.motion, share))

    def _standing(self, document: Document) -> Standing:
        resolved = {root.id: root for root in self._resolver.resolve(document).solids}
        found = [self._shape(resolved[root.id]) for root in self.roots]
        shapes = np.array([number for number, _ in found], np.int64)
        poses = np.tile(np.eye(4), (len(found), 1, 1))
        if found:
            poses[:, :3] = [pose for _, pose in found]
        return Standing(shapes, poses)

    def _shape(self, root: Node) -> tuple[int, Floats]:
        """The shape of a resolved root, and where its body goes (3, 4)."""
        last = self._last.get(root.id)
        if last is None or last[0] is not root:
            last = self._last[root.id] = root, self._placed(root)
        return last[1]

    def _placed(self, root: Node) -> tuple[int, Floats]:
        matrix = root.placement.matrix()
        known = self._known.setdefault(root.shape_digest, [])
        for before, number in known:
            pose = product(matrix, before)
            turn = pose[:, :3]
            if np.abs(turn @ turn.T - np.eye(3)).max() <= RIGID and np.linalg.det(turn) > 0.0:
                return number, pose
        result = result_of(root, self._evaluator.evaluate(root, self.tolerance, self._progress))
        self.messages |= dict.fromkeys(result.messages)
        self.bodies.append(body_of(result))
        known.append((inverse(matrix), len(self.bodies) - 1))
        return len(self.bodies) - 1, np.eye(3, 4)


def boxes_of(bodies: list[Body], standing: Standing) -> Floats:
    """(n, 2, 3) around parts; infinitely far away where there is nothing."""
    own = np.array([np.full((8, 3), np.nan) if body.empty else corners_of(body.bounds) for body in bodies])
    corners = own.reshape(-1, 8, 3)[standing.shapes] @ standing.poses[:, :3, :3].transpose(0, 2, 1)
    corners += standing.poses[:, None, :3, 3]
    return np.stack((corners.min(axis=1), corners.max(axis=1)), axis=1)


def pairs_near(boxes: Floats, reach: float) -> list[tuple[int, int]]:
    """The pairs of boxes (n, 2, 3) that are nearer than twice the reach in mm; those that are nowhere have none."""
    there = np.flatnonzero(np.isfinite(boxes).all(axis=(1, 2)))
    if len(there) < 2:
        return []
    found: list[tuple[int, int]] = []
    for left, right in meeting(boxes[there, 0] - reach, boxes[there, 1] + reach):
        found += map(tuple, np.sort(there[np.column_stack((left, right))], axis=1).tolist())
    return sorted(found)


def document_at(document: Document, motion: Motion, share: float) -> Document:
    """The document with the motion's parameter at a share of its way, 0 to 1. Raises Refusal where that is a value
    which the parameter cannot have."""
    value = motion.value(share)
    return document.with_(
        parameters=tuple(
            parameter.with_(value=value) if parameter.name == motion.parameter else parameter
            for parameter in document.parameters
        )
    )


def motion_called(document: Document, name: str | None = None) -> Motion:
    """The motion of this name, or the only one. Raises Refusal."""
    motions = document.motions
    if not motions:
        raise Refusal("the document holds no motion: add one with add_motion, or in the Motion panel")
    found = [motion for motion in motions if name in (None, motion.name)]
    names = ", ".join(motion.name for motion in motions)
    if not found:
        raise Refusal(f"there is no motion called “{name}”, but {names}")
    if len(found) > 1:
        raise Refusal(f"name one of the motions: {names}")
    return found[0]
