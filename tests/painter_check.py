"""A software rasteriser in double precision that sees whether a painter's order is right, at every layer of a pixel.

Each pixel is a ray. Wherever one meets several fragments, the one painted later must not be farther away: what is seen
in the end then is the nearest, and what shines through translucent faces is in order as well. The rasteriser needs no
near plane, so eyes may stand inside the scene: a triangle covers a ray when the ray's direction is a sum of the arms to
its corners with positive weights (Olano and Greer 1997).
"""

from dataclasses import dataclass

import numpy as np

from solidtree.model.partition.tree import Tree

PAIRS = 1_000_000
"""Pixels and triangles that are looked at together."""


@dataclass(frozen=True)
class Eye:
    """Where the picture is taken from, and how."""

    place: np.ndarray  # (3,)
    axes: np.ndarray  # (3, 3) rows: right, up, forward
    half: float  # of the picture's height: a tangent, or millimetres when parallel
    parallel: bool = False
    pixels: int = 120

    @property
    def towards(self) -> np.ndarray:
        """What Sorter wants to know: the point, or the direction towards the eye."""
        return -self.axes[2] if self.parallel else self.place


@dataclass(frozen=True)
class Verdict:
    covered: int  # pixels
    layers: int  # pairs of a pixel and a fragment
    wrong: int  # pixels where what is painted last is not the nearest
    disordered: int  # neighbouring layers of which the later one is farther
    lost: int  # pairs of a pixel and a face of which no fragment is there, or several, or one too many

    @property
    def flawless(self) -> bool:
        return self.covered > 0 and not (self.wrong or self.disordered or self.lost)

    def __add__(self, other: "Verdict") -> "Verdict":
        return Verdict(*(getattr(self, name) + getattr(other, name) for name in self.__dataclass_fields__))


def eyes_around(points: np.ndarray, count: int, seed: int = 1, pixels: int = 120) -> list[Eye]:
    """Eyes looking at a scene: every fourth inside it, every fourth parallel."""
    rng = np.random.default_rng(seed)
    low, high = points.min(axis=0), points.max(axis=0)
    middle, size = (low + high) / 2, float(np.linalg.norm(high - low))
    found = []
    for number in range(count):
        direction = unit(rng.normal(size=3))
        inside, parallel = number % 4 == 3, number % 4 == 2
        place = low + rng.uniform(0.15, 0.85, 3) * (high - low) if inside else middle + size * 1.1 * direction
        aim = unit(rng.normal(size=3)) if inside else unit(middle + 0.1 * size * rng.normal(size=3) - place)
        right = unit(np.cross(aim, unit(rng.normal(size=3))))
        half = 0.45 * size if parallel else 0.9 if inside else 0.45
        found.append(Eye(place, np.array([right, np.cross(right, aim), aim]), half, parallel, pixels))
    return found


def unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector)


def judge(tree: Tree, order: np.ndarray, eye: Eye, tolerance: float = 1e-6) -> Verdict:
    """What is wrong with fragments painted in `order`; `tolerance` is a part of the scene's size."""
    faces = tree.faces
    fragments, pixel, depth = _layers(tree.points, tree.corners, tree.starts, order, eye)
    # Fragment after fragment comes out of `_layers`, so a stable sort by pixel leaves each pixel's painter's order.
    by_pixel = np.argsort(pixel, kind="stable")
    pixel_, depth_ = pixel[by_pixel], depth[by_pixel]
    same = pixel_[1:] == pixel_[:-1]
    near = tolerance * faces.size
    disordered = int((same & (depth_[1:] > depth_[:-1] + near)).sum())
    covered, firsts = np.unique(pixel_, return_index=True)
    nearest = np.minimum.reduceat(depth_, firsts) if len(firsts) else depth_
    last = depth_[np.append(firsts[1:], len(pixel_)) - 1] if len(firsts) else depth_
    expected_face, expected_pixel, _ = _layers(faces.points, faces.corners, faces.starts, np.arange(faces.count), eye)
    return Verdict(
        covered=len(covered),
        layers=len(pixel),
        wrong=int((last > nearest + near).sum()),
        disordered=disordered,
        lost=_difference(pixel * faces.count + tree.source[fragments], expected_pixel * faces.count + expected_face),
    )


def centroid_order(tree: Tree, eye: Eye) -> np.ndarray:
    """The fragments sorted by the distance of their middles: what is done without a tree, and wrong."""
    sizes = np.diff(tree.starts)
    sums = np.add.reduceat(tree.points[tree.corners], tree.starts[:-1])
    arms = sums / sizes[:, None] - eye.place
    return np.argsort(-(arms @ eye.axes[2] if eye.parallel else np.linalg.norm(arms, axis=1)), kind="stable")


def judged(tree: Tree, order_of, eyes: list[Eye]) -> Verdict:
    """The sum over some eyes; `order_of(eye)` gives the fragments."""
    total = Verdict(0, 0, 0, 0, 0)
    for eye in eyes:
        total += judge(tree, order_of(eye), eye)
    return total


def _layers(points, corners, starts, order, eye: Eye) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Which polygon covers which pixel at what depth, polygon after polygon in `order`."""
    sizes = np.diff(starts)[order].astype(np.int64) - 2
    owner = np.repeat(order, sizes)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(sizes) - sizes, sizes) + 1
    begin = starts[:-1].astype(np.int64)[owner]
    arms = (points - eye.place) @ eye.axes.T  # (n, 3) right, up, forward
    triangles = arms[corners[np.stack((begin, begin + step, begin + step + 1), axis=1)]]  # (t, 3, 3)
    box = _boxes(triangles, eye)
    counts = np.maximum(box[:, 1] - box[:, 0], 0) * np.maximum(box[:, 3] - box[:, 2], 0)
    blocks = np.searchsorted(np.cumsum(counts), np.arange(0, int(counts.sum()) + PAIRS, PAIRS))
    found = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)], [np.zeros(0)]
    for first, last in zip(blocks, np.append(blocks[1:], len(counts)), strict=True):
        triangle, pixel, depth = _covered(triangles[first:last], box[first:last], counts[first:last], eye)
        for column, part in zip(found, (owner[first + triangle], pixel, depth), strict=True):
            column.append(part)
    return tuple(np.concatenate(column) for column in found)


def _boxes(triangles: np.ndarray, eye: Eye) -> np.ndarray:
    """(t, 4) first and last column, first and last row (each last one excluded) that a triangle may reach."""
    ahead = triangles[:, :, 2]
    safe = np.ones(len(triangles), bool) if eye.parallel else (ahead > 1e-3 * np.abs(triangles).max()).all(axis=1)
    scale = np.where(safe[:, None], 1.0 if eye.parallel else ahead, 1.0) * eye.half
    flat = (triangles[:, :, :2] / scale[:, :, None] + 1) * eye.pixels / 2
    low, high = np.floor(flat.min(axis=1)) - 1, np.ceil(flat.max(axis=1)) + 1
    low, high = (np.clip(edge, 0, eye.pixels).astype(np.int64) for edge in (low, high))
    box = np.stack((low[:, 0], high[:, 0], low[:, 1], high[:, 1]), axis=1)
    box[~safe] = 0, eye.pixels, 0, eye.pixels
    if not eye.parallel:
        box[(ahead <= 0).all(axis=1)] = 0
    return box


def _covered(triangles, box, counts, eye: Eye) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangle, pixel and depth of all rays of the boxes that meet their triangle."""
    which = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    width = (box[:, 1] - box[:, 0])[which]
    row, column = box[which, 2] + place // np.maximum(width, 1), box[which, 0] + place % np.maximum(width, 1)
    # Off the middles of pixels by odd parts, so that no ray runs along an edge of a model made of round numbers.
    x = ((column + 0.4871) * 2 / eye.pixels - 1) * eye.half
    y = ((row + 0.5213) * 2 / eye.pixels - 1) * eye.half
    arms = triangles.copy()
    if eye.parallel:
        arms[:, :, 2] = 1.0
    sides = np.stack([np.cross(arms[:, (i + 1) % 3], arms[:, (i + 2) % 3]) for i in range(3)], axis=1)
    volume = np.einsum("ti,ti->t", arms[:, 0], sides[:, 0])
    weights = [side[which, 0] * x + side[which, 1] * y + side[which, 2] for side in sides.transpose(1, 0, 2)]
    sign = np.sign(volume)[which]
    inside = np.flatnonzero(
        (sign != 0) & (weights[0] * sign >= 0) & (weights[1] * sign >= 0) & (weights[2] * sign >= 0)
    )
    which = which[inside]
    shares = np.stack([weight[inside] for weight in weights], axis=1) / volume[which, None]
    depth = np.einsum("ti,ti->t", shares, triangles[which, :, 2]) if eye.parallel else 1 / shares.sum(axis=1)
    return which, row[inside] * eye.pixels + column[inside], depth


def _difference(one: np.ndarray, other: np.ndarray) -> int:
    """How many numbers are not in both as often."""
    numbers, back = np.unique(np.concatenate((one, other)), return_inverse=True)
    counts = np.bincount(back[: len(one)], minlength=len(numbers)) - np.bincount(
        back[len(one) :], minlength=len(numbers)
    )
    return int(np.abs(counts).sum())
