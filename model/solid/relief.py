"""Bitmaps as relief: a plate with the heights of a bitmap, and the faces of a solid raised by one."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import Manifold, Mesh64
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.nodes import Displace
from ..document.primitives import Relief
from ..surface.mapping import projected
from .failure import NoSolid

if TYPE_CHECKING:
    Floats = NDArray[np.float64]

MOST_SAMPLES = 4_000_000
MOST_MOVED = 3_000_000


@lru_cache(maxsize=4)
def lightness_of(asset: str) -> Floats:
    """(height, width) 0 to 1 of an asset, rows from the top down; read-only. Raises NoSolid."""
    from ..image.pictures import lightness
    from ..project.assets import default_store

    store = default_store()
    if not asset:
        raise NoSolid("no bitmap is chosen")
    if not store.has(asset):
        raise NoSolid("its bitmap is missing from the project")
    try:
        found = lightness(store.path(asset))
    except Refusal as refusal:
        raise NoSolid(f"its bitmap: {refusal}") from None
    found.setflags(write=False)
    return found


def heights_of(node: Relief) -> Floats:
    """(rows, columns) 0 to 1 of a relief's samples, from the bottom row up. Raises NoSolid."""
    light = lightness_of(node.asset)
    longest = max(light.shape)
    count = int(float(node.samples))  # type: ignore[arg-type]
    rows, columns = (max(round(side * min(count / longest, 1.0)), 1) for side in light.shape)
    if rows * columns > MOST_SAMPLES:
        raise NoSolid(f"{columns:,} x {rows:,} samples are more than {MOST_SAMPLES:,}: ask for fewer")
    if (rows, columns) != light.shape:
        from PIL import Image

        small = Image.fromarray(light.astype(np.float32)).resize((columns, rows), Image.Resampling.BOX)
        light = np.asarray(small, np.float64)
    smoothing = float(node.smoothing)  # type: ignore[arg-type]
    if smoothing > 0.0:
        from scipy.ndimage import gaussian_filter

        light = gaussian_filter(light, smoothing, mode="nearest")
    return (1.0 - light if node.invert else light)[::-1]


def relief_mesh(heights: Floats, width: float, height: float, base: float) -> tuple[Floats, NDArray[np.uint64]]:
    """Points (p, 3) and triangles (t, 3) of a plate `width` mm wide whose top has the `heights` (rows, columns), 0 to
    1, at the middles of its cells, and at its border those of the cells there."""
    rows, columns = heights.shape
    cell = width / columns
    tops = np.pad(heights, 1, mode="edge") * height + base
    x, y = (cell * np.concatenate(([0.0], np.arange(n) + 0.5, [float(n)])) for n in (columns, rows))
    across, up = columns + 2, rows + 2
    # The bottom has a vertex below each of the border, in the order in which the border goes round.
    grid = np.arange(up * across).reshape(up, across)
    border = np.concatenate((grid[0, :-1], grid[:-1, -1], grid[-1, :0:-1], grid[:0:-1, 0]))
    points = np.empty((up * across + len(border), 3))
    top = points[: up * across].reshape(up, across, 3)
    top[..., 0], top[..., 1], top[..., 2] = x, y[:, None], tops
    points[up * across :, :2], points[up * across :, 2] = points[border, :2], 0.0
    foot = up * across + np.arange(len(border))

    quads = (up - 1) * (across - 1)
    a, b, c, d = (part.reshape(-1) for part in (grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]))
    bottom = _bottom(foot, across, up)
    triangles = np.empty((2 * quads + 2 * len(border) + len(bottom), 3), np.uint64)
    triangles[:quads] = np.column_stack((a, b, c))
    triangles[quads : 2 * quads] = np.column_stack((a, c, d))
    after, foot_after = np.roll(border, -1), np.roll(foot, -1)
    walls = triangles[2 * quads : 2 * quads + 2 * len(border)]
    walls[: len(border)] = np.column_stack((foot, foot_after, after))
    walls[len(border) :] = np.column_stack((foot, after, border))
    triangles[2 * quads + 2 * len(border) :] = bottom
    return points, triangles


def _bottom(foot: NDArray[np.int64], across: int, up: int) -> NDArray[np.int64]:
    """(t, 3) triangles, seen from below, over a rectangle whose border has the vertices `foot`: `across` along x and
    `up` along y, from the lowest corner round."""
    low = foot[:across]
    right = foot[across - 1 : across + up - 1]
    high = foot[across + up - 2 : 2 * across + up - 2][::-1]
    left = np.concatenate((foot[:1], foot[2 * across + up - 3 :][::-1]))
    # Strips between the inner vertices of the two long sides; the first and the last are fans to the short sides.
    a, b, c, d = low[1:-2], low[2:-1], high[2:-1], high[1:-2]
    strips = np.concatenate((np.column_stack((a, c, b)), np.column_stack((a, d, c))))
    first = np.column_stack((np.full(up - 1, low[1]), left[:-1], left[1:]))
    last = np.column_stack((np.full(up - 1, low[-2]), right[1:], right[:-1]))
    corners = [(low[1], left[-1], high[1]), (low[-2], high[-2], right[-1])]
    return np.concatenate((strips, first, last, corners))


def solid_of_relief(node: Relief) -> Manifold:
    """Raises NoSolid."""
    width, height, base = float(node.width), float(node.height), float(node.base)  # type: ignore[arg-type]
    points, triangles = relief_mesh(heights_of(node), width, height, base)
    return Manifold(Mesh64(points, triangles))


def displaced(node: Displace, solid: Manifold) -> Manifold:
    """The operand's solid with its faces moved. Raises NoSolid."""
    light = lightness_of(node.asset)
    edge = float(node.edge)  # type: ignore[arg-type]
    expected = solid.num_tri() + 4.0 * solid.surface_area() / (edge * edge * np.sqrt(3.0))
    if expected > MOST_MOVED:
        raise NoSolid(f"some {expected:,.0f} triangles would be moved; {MOST_MOVED:,} are: let the edge be longer")
    mesh = solid.refine_to_length(edge).to_mesh64()
    points = np.asarray(mesh.vert_properties)[:, :3]
    triangles = np.asarray(mesh.tri_verts).astype(np.int64)
    normals = _vertex_normals(points, triangles)
    extent = (float(node.copy_width), float(node.copy_height))  # type: ignore[arg-type]
    uv = projected(node.projection, extent, points, normals)
    moved = points + float(node.height) * sampled(light, uv)[:, None] * normals  # type: ignore[operator]
    return Manifold(Mesh64(moved, triangles.astype(np.uint64)))


def sampled(light: Floats, uv: Floats) -> Floats:
    """(n,) a repeating bitmap (height, width), rows from the top down, between its texels at (n, 2) coordinates."""
    rows, columns = light.shape
    x, y = uv[:, 0] * columns - 0.5, (1.0 - uv[:, 1]) * rows - 0.5
    left, top = np.floor(x), np.floor(y)
    across, down = x - left, y - top
    i, j = left.astype(np.int64), top.astype(np.int64)
    above = light[j % rows, i % columns] * (1 - across) + light[j % rows, (i + 1) % columns] * across
    below = light[(j + 1) % rows, i % columns] * (1 - across) + light[(j + 1) % rows, (i + 1) % columns] * across
    return above * (1 - down) + below * down


def _vertex_normals(points: Floats, triangles: NDArray[np.int64]) -> Floats:
    """(p, 3) unit: the mean of the faces around a vertex, weighed by their areas."""
    corners = points[triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    total = np.column_stack(
        [np.bincount(triangles.reshape(-1), np.repeat(areas[:, i], 3), len(points)) for i in range(3)]
    )
    size = np.linalg.norm(total, axis=1, keepdims=True)
    return total / np.where(size > 0.0, size, 1.0)
