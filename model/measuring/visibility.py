"""What is seen of a surface from a point: its area in texels, each of them seen, hidden or turned away, and by what.

Triangles are halved across their longest side (Rivara 1984) into texels; the line from a texel to the eye is looked at
in four places, and texels where these differ are halved on, so that the borders of shadows are finer than the rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..partition.rays import END, Rays

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

SEEN, HIDDEN, TURNED = 0, 1, 2
"""States of a texel; TURNED is its back that the eye would see, were nothing else there."""
TEXELS = 1500
"""Texels before those at the borders are halved."""
ROUNDS = 5
"""Times that texels at a border are halved."""
MOST = 20_000
"""Triangles that are looked at one by one; of more so many are taken, evenly by area."""
INWARDS = 0.1
"""How far from a texel's corners towards its middle is looked, so that texels side by side do not share places."""
EDGE_ON = 1e-9
"""Sine of the angle of a line and a plane, below which the plane is seen edge-on: as nothing."""


@dataclass(frozen=True, slots=True)
class Eye:
    """A point (3,) that is looked from or, where `parallel`, the direction (3,) towards the eye, of any length."""

    place: tuple[float, float, float]
    parallel: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Visibility:
    """The texels of a surface and what is seen of them.

    `obstacle` is the face of the tree that the eye sees in the place of a hidden texel, -1 elsewhere. `error` is the
    half-width of the shares of area: half the area of the texels that a border goes through, and, where not all of the
    surface was looked at, 95 % of the chance in the choice.
    """

    texels: Floats  # (n, 3, 3)
    areas: Floats  # (n,) mm²
    state: NDArray[np.int8]  # (n,) SEEN, HIDDEN or TURNED
    obstacle: Numbers  # (n,)
    rays: int
    error: float

    @property
    def points(self) -> Floats:
        """(n, 3) the middles of the texels."""
        return self.texels.mean(axis=1)

    @property
    def area(self) -> float:
        """Of the whole surface, in mm²."""
        return float(self.areas.sum())

    def part(self, state: int) -> float:
        """The area in one state, in mm²."""
        return float(self.areas[self.state == state].sum())

    @property
    def share(self) -> float:
        """How much is seen of what is turned to the eye, 0 to 1; 0 where nothing is."""
        facing = self.part(SEEN) + self.part(HIDDEN)
        return self.part(SEEN) / facing if facing > 0.0 else 0.0

    def hidden_by(self, of_face: NDArray[np.integer]) -> Floats:
        """The share that each of some bodies hides of what is turned to the eye; `of_face` (f,) numbers the bodies of
        the tree's faces from 0."""
        count = int(of_face.max(initial=-1)) + 1
        hidden = np.flatnonzero(self.obstacle >= 0)
        sums = np.bincount(of_face[self.obstacle[hidden]], self.areas[hidden], count)
        facing = self.part(SEEN) + self.part(HIDDEN)
        return sums / facing if facing > 0.0 else np.zeros(count)


def visibility(
    rays: Rays, triangles: ArrayLike, eye: Eye, texels: int = TEXELS, rounds: int = ROUNDS, most: int = MOST
) -> Visibility:
    """What an eye sees of triangles (n, 3, 3), counter-clockwise from outside, past the faces of a tree.

    The triangles may be faces of the tree. Raises ValueError where something is not finite or a direction is zero.
    """
    asked = np.asarray(triangles, float).reshape(-1, 3, 3)
    place = np.asarray(eye.place, float).reshape(-1)
    if place.shape != (3,) or not (np.isfinite(place).all() and np.isfinite(asked).all()):
        raise ValueError("what is seen needs an eye and faces whose coordinates are numbers")
    if eye.parallel and not place.any():
        raise ValueError("the direction to the eye is zero")
    areas = areas_of(asked)
    asked, areas = asked[areas > 0.0], areas[areas > 0.0]
    back = ~_facing(asked, eye)
    turned, chosen = asked[back], asked[~back]
    weights, total = areas[~back], float(areas[~back].sum())
    sampled = len(chosen) > most
    if sampled:
        chosen = chosen[evenly(weights, most)]
        weights = np.full(len(chosen), total / len(chosen))
    else:
        chosen = _halved(chosen, total / max(texels, 1))
        weights = areas_of(chosen)
    found = _looked_at(rays, chosen, weights, eye, 0 if sampled else rounds)
    seen, weight, obstacle, asked_rays, unsure = found[1:]
    error = 0.5 * unsure / total if total > 0.0 else 0.0
    if sampled:
        part = (np.count_nonzero(seen) + 2.0) / (len(seen) + 4.0)  # Agresti and Coull 1998
        error += 1.96 * float(np.sqrt(part * (1.0 - part) / (len(seen) + 4.0)))
    state = np.full(len(seen) + len(turned), TURNED, np.int8)
    state[: len(seen)] = np.where(seen, SEEN, HIDDEN)
    return Visibility(
        np.concatenate((found[0], turned)),
        np.concatenate((weight, areas[back])),
        state,
        np.concatenate((obstacle, np.full(len(turned), -1))),
        asked_rays,
        min(error, 1.0),
    )


def areas_of(triangles: Floats) -> Floats:
    """(n,) mm² of triangles (n, 3, 3)."""
    sides = triangles[:, 1:] - triangles[:, :1]
    return 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)


def evenly(weights: Floats, count: int) -> Numbers:
    """`count` places in weights (n,), as often as they weigh: systematic sampling, from half a step on."""
    ends = np.cumsum(weights)
    return np.searchsorted(ends, (np.arange(count) + 0.5) * (ends[-1] / count)).clip(max=len(weights) - 1)


def _facing(triangles: Floats, eye: Eye) -> NDArray[np.bool_]:
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    away = np.broadcast_to(eye.place, normals.shape) if eye.parallel else np.asarray(eye.place) - triangles[:, 0]
    size = np.linalg.norm(normals, axis=1) * np.linalg.norm(away, axis=1)
    return np.einsum("ij,ij->i", normals, away) > EDGE_ON * size


def _halved(triangles: Floats, area: float) -> Floats:
    """Until none is larger than `area` mm²."""
    done = [triangles[:0]]
    while len(triangles):
        large = areas_of(triangles) > area
        done.append(triangles[~large])
        triangles = _halves(triangles[large])
    return np.concatenate(done)


def _halves(triangles: Floats) -> Floats:
    """(2 n, 3, 3), the halves of a triangle in a row."""
    sides = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2)
    turn = (np.argmax(sides, axis=1)[:, None] + np.arange(3)) % 3
    a, b, c = np.swapaxes(np.take_along_axis(triangles, turn[:, :, None], axis=1), 0, 1)
    middle = 0.5 * (a + b)
    return np.stack((np.stack((a, middle, c), axis=1), np.stack((middle, b, c), axis=1)), axis=1).reshape(-1, 3, 3)


def _looked_at(
    rays: Rays, texels: Floats, weights: Floats, eye: Eye, rounds: int
) -> tuple[Floats, NDArray[np.bool_], Floats, Numbers, int, float]:
    """Texels, which are seen, weights, obstacles, how many rays that took, and the weight of those with a border."""
    parts: list[tuple[Floats, NDArray[np.bool_], Floats, Numbers]] = []
    asked, unsure, step = 0, 0.0, 0
    while True:
        middles = texels.mean(axis=1)
        corners = texels + INWARDS * (middles[:, None] - texels)
        places = np.concatenate((middles[:, None], corners), axis=1)
        obstacle = obstacles(rays, places.reshape(-1, 3), eye).reshape(-1, 4)
        asked += obstacle.size
        seen = obstacle < 0
        mixed = (seen != seen[:, :1]).any(axis=1)
        keep = ~mixed if step < rounds else np.ones(len(texels), bool)
        parts.append((texels[keep], seen[keep, 0], weights[keep], obstacle[keep, 0]))
        if step == rounds or not mixed.any():
            unsure = float(weights[mixed].sum())
            break
        texels, weights, step = _halves(texels[mixed]), np.repeat(0.5 * weights[mixed], 2), step + 1
    found, seen, weights, obstacle = (np.concatenate(column) for column in zip(*parts, strict=True))
    return found, seen, weights, obstacle, asked, unsure


def obstacles(rays: Rays, points: Floats, eye: Eye) -> Numbers:
    """(n,) the face that the eye meets first on its way to points (n, 3) on faces turned to it; -1 where there is none.

    Looked at from the points. An eye on a face of a body sees what is before that face, and nothing through the body.
    """
    slack = max(END * rays.size, rays.tree.epsilon)
    away = np.broadcast_to(eye.place, points.shape) if eye.parallel else np.asarray(eye.place, float) - points
    length = np.full(len(points), np.inf) if eye.parallel else np.linalg.norm(away, axis=1)
    found = np.full(len(points), -1)
    far = np.flatnonzero(length > 2.0 * slack)
    met = rays.all(points[far], away[far], slack, length[far] + slack, grazing=0.0 if eye.parallel else slack)
    at_eye = met.distance > length[far[met.ray]] - slack
    reached = np.zeros(len(far), bool)
    reached[met.ray[at_eye & met.front]] = True
    counts = ~at_eye | (~met.front & ~reached[met.ray])
    found[far[met.ray[counts]]] = met.face[counts]  # a ray's in a row, the farthest last, which the eye meets first
    return found
