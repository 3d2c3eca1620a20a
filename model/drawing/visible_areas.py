"""Faces with what is hidden of them really removed.

Fragments of the BSP tree come from front to back and are cut to the tiles of a grid over the picture. In a tile, what
is still uncovered of it is kept: a fragment is seen where it meets that, and then takes its place away. Pieces of one
flat face are joined again at the end.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from manifold3d import CrossSection, FillRule
from numpy.typing import NDArray

from ..partition.order import Sorter
from ..partition.tree import Tree
from .polygons import Ragged, corners_of, ranges
from .surfaces import Surfaces

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

SIZE = 100.0
"""The picture's larger side as CrossSection sees it, which keeps eight decimals of whatever it is given."""
TINY = 1e-9
"""The least area of a piece, in the same unit squared: less is rounding."""
STRAIGHT = 1e-7
"""A corner nearer than this to the line between its neighbours is none, in the same unit."""
ALIKE = 1e-7
"""Planes are one whose normals, and offsets as parts of the scene's size, differ by less."""
A_TILE = 12
"""How many fragments a tile is meant to meet."""
MOST_TILES = 96
"""In a row."""
MOST_PIECES = 2_000_000
A_BATCH = 64
"""Pieces that are joined at a time; in one go, a face of thousands takes much longer."""


def visible_areas(
    tree: Tree, surfaces: Surfaces, progress: Callable[[float], None] | None = None
) -> list[tuple[int, list[Floats]]]:
    """What is seen of each flat face of each owner: a triangle of it, and its contours.

    The contours (k, 2) are in the picture's mm; outer ones go counter-clockwise, holes clockwise.
    """
    pieces, triangle = _fragments(tree, surfaces)
    if not pieces.count:
        return []
    low = pieces.points.min(axis=0)
    scale = SIZE / max(float(np.ptp(pieces.points, axis=0).max()), 1e-300)
    pieces = Ragged((pieces.points - low) * scale, pieces.starts)
    face, first = _flat_faces(surfaces, triangle)
    tiled, source, tile, square = _tiled(pieces)
    seen, seen_face = _uncovered(tiled, face[source], tile, square, progress)
    found = []
    for number, contours in _joined(seen, seen_face, progress):
        found.append((int(triangle[first[number]]), [contour / scale + low for contour in contours]))
    return found


def _fragments(tree: Tree, surfaces: Surfaces) -> tuple[Ragged, Numbers]:
    """The fragments that may be seen, in the picture, counter-clockwise, front to back, and their triangles."""
    projection = surfaces.projection
    order = Sorter(tree).fragments(projection.eye, projection.parallel, front_first=True)
    order = order[surfaces.shown[tree.source[order]]]
    corners, starts = corners_of(tree.starts.astype(np.int64), order)
    pieces, kept = surfaces.clipped(Ragged(tree.points[tree.corners[corners]], starts))
    pieces = Ragged(pieces.points[:, :2], pieces.starts)
    triangle = tree.source[order[kept]].astype(np.int64)
    away = surfaces.facing[surfaces.faces.plane_of[triangle]] < 0
    if away.any():
        pieces = _turned(pieces, away)
    return pieces, triangle


def _turned(polygons: Ragged, which: NDArray[np.bool_]) -> Ragged:
    """Some of the polygons with their corners in reverse order."""
    polygon, place = polygons.polygon_of, np.arange(len(polygons.points))
    mirrored = polygons.starts[polygon] + polygons.starts[polygon + 1] - 1 - place
    return Ragged(polygons.points[np.where(which[polygon], mirrored, place)], polygons.starts)


def _flat_faces(surfaces: Surfaces, triangle: Numbers) -> tuple[Numbers, Numbers]:
    """(n,) a number that triangles (n,) share which lie in one plane and are of one owner, and for each one of its
    places."""
    faces = surfaces.faces
    steps = faces.planes / (ALIKE * np.array([1.0, 1.0, 1.0, max(faces.size, 1e-300)]))
    steps = np.round(steps + 0.3).astype(np.int64)  # odd, so that plain numbers are far from where rounding changes
    _, plane = np.unique(steps, axis=0, return_inverse=True)
    key = surfaces.owner[triangle] * len(faces.planes) + plane.reshape(-1)[faces.plane_of[triangle]]
    _, first, number = np.unique(key, return_index=True, return_inverse=True)
    return number.reshape(-1), first


def _tiled(polygons: Ragged) -> tuple[Ragged, Numbers, Numbers, Callable[[int], list[Floats]]]:
    """The polygons cut to tiles: the pieces by tile, front to back, the polygon and the tile of each, and a tile's
    square."""
    sizes = (polygons.high() - polygons.low()) / SIZE
    tiles = int(np.clip(np.ceil(np.sqrt(polygons.count / A_TILE)), 1, MOST_TILES))
    while tiles > 1 and (sizes * tiles + 1.0).prod(axis=1).sum() > MOST_PIECES:
        tiles //= 2
    lines = np.linspace(0.0, SIZE, tiles + 1)
    source = np.arange(polygons.count)
    places: list[Numbers] = []
    for axis in (1, 0):
        low = np.clip(np.searchsorted(lines, polygons.low()[:, axis], "right") - 1, 0, tiles - 1)
        high = np.clip(np.searchsorted(lines, polygons.high()[:, axis], "left") - 1, low, tiles - 1)
        item, step = ranges(high - low + 1)
        polygons, place = polygons.taken(item), low[item] + step
        source = source[item]
        places = [kept[item] for kept in places]
        for side in (0, 1):
            beyond = (polygons.points[:, axis] - lines[place + side][polygons.polygon_of]) * (1 - 2 * side)
            polygons, left = polygons.cut(beyond)
            source, place = source[left], place[left]
            places = [kept[left] for kept in places]
        places.append(place)
    row, column = places
    tile = row * tiles + column
    order = np.lexsort((source, tile))

    def square(number: int) -> list[Floats]:
        bottom, left = divmod(number, tiles)
        x0, x1, y0, y1 = lines[left], lines[left + 1], lines[bottom], lines[bottom + 1]
        return [np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])]

    return polygons.taken(order), source[order], tile[order], square


def _uncovered(
    polygons: Ragged,
    face: Numbers,
    tile: Numbers,
    square: Callable[[int], list[Floats]],
    progress: Callable[[float], None] | None,
) -> tuple[list[list[Floats]], list[int]]:
    """The visible pieces as contours, and the face of each. The polygons come tile by tile, front to back."""
    seen: list[list[Floats]] = []
    seen_face: list[int] = []
    points, starts = polygons.points, polygons.starts.tolist()
    # Neighbours in the order that are of one face are cut as one.
    begins = np.flatnonzero(np.diff(face, prepend=-1) | np.diff(tile, prepend=-1))
    ends = np.append(begins[1:], len(face)).tolist()
    sums = np.concatenate(([0.0], np.cumsum(polygons.areas())))
    area = (sums[ends] - sums[begins]).tolist()
    tiles, faces = tile[begins].tolist(), face[begins].tolist()
    current, rest, untouched = -1, CrossSection(), True
    for run, (begin, end) in enumerate(zip(begins.tolist(), ends, strict=True)):
        if tiles[run] != current:
            if progress and run % 64 == 0:
                progress(0.8 * run / len(tiles))
            current, untouched = tiles[run], True
            rest = CrossSection(square(current))
        elif rest.is_empty():
            continue
        if area[run] <= TINY:
            continue
        contours = [points[starts[i] : starts[i + 1]] for i in range(begin, end)]
        shape = CrossSection(contours, FillRule.NonZero)
        if untouched:
            visible, untouched = contours if len(contours) == 1 else shape.to_polygons(), False
        else:
            part = shape ^ rest
            visible = part.to_polygons() if part.area() > TINY else []
        if visible:
            seen.append(visible)
            seen_face.append(faces[run])
            rest -= shape
            if rest.area() <= TINY:
                rest = CrossSection()
    return seen, seen_face


def _joined(
    pieces: list[list[Floats]], face: list[int], progress: Callable[[float], None] | None
) -> list[tuple[int, list[Floats]]]:
    """The pieces of each face as one, in the order in which the faces are seen first."""
    together: dict[int, list[list[Floats]]] = {}
    for number, contours in zip(face, pieces, strict=True):
        together.setdefault(number, []).append(contours)
    found = []
    for number, parts in together.items():
        if progress and len(found) % 64 == 0:
            progress(0.8 + 0.2 * len(found) / len(together))
        while len(parts) > 1:  # neighbours in the list are neighbours in the picture
            parts = [_union(parts[first : first + A_BATCH]) for first in range(0, len(parts), A_BATCH)]
        if parts[0]:
            found.append((number, parts[0]))
    return found


def _union(parts: list[list[Floats]]) -> list[Floats]:
    """Shapes as one; those of each face do not overlap."""
    if len(parts) == 1:
        return parts[0]
    contours = [contour for part in parts for contour in part]
    return CrossSection(contours, FillRule.Positive).simplify(STRAIGHT).to_polygons()
