"""Polygons as pixels: against a brute-force test of every pixel centre, and the counts against VTK's own pictures."""

import numpy as np
import pytest

from solidtree.model.pipeline.clipping import PLANES, Polygons, drawn
from solidtree.model.pipeline.counts import counted, joined
from solidtree.model.pipeline.matrices import Matrices, matrices_for
from solidtree.model.pipeline.raster import SUB, raster
from solidtree.model.pipeline.stages import viewport_matrix
from solidtree.model.script import box, cylinder, document_of, evaluate, sphere
from solidtree.render.camera import Camera
from solidtree.render.picture import ids_picture, numbers_of


def flat(pixels, depth, size):
    """Polygons (n, k, 4) in clip coordinates with their corners at pixels (n, k, 2)."""
    pixels = np.asarray(pixels, float)
    depth = np.broadcast_to(depth, pixels.shape[:2])
    device = np.stack((2 * pixels[..., 0] / size[0] - 1, 1 - 2 * pixels[..., 1] / size[1], depth), axis=-1)
    corners = np.concatenate((device, np.ones((*pixels.shape[:2], 1))), axis=-1)
    return Polygons(corners, np.full(len(corners), corners.shape[1]))


def twice_area(one, other):
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


def test_every_pixel_centre_within_a_triangle_is_covered():
    size = (40, 30)
    rng = np.random.default_rng(4)
    triangles = np.round(rng.uniform(-6, 46, (60, 3, 2)) * SUB) / SUB
    depths = rng.uniform(-1, 1, (60, 3))
    found = raster(flat(triangles, depths, size), viewport_matrix(*size), size)
    x, y = np.meshgrid(np.arange(40) + 0.5, np.arange(30) + 0.5)
    layers, best, front = np.zeros((30, 40), int), np.full((30, 40), np.inf), np.full((30, 40), -1)
    for number, ((a, b, c), depth) in enumerate(zip(triangles, depths, strict=True)):
        area = twice_area(b - a, c - a)
        shares = [twice_area(q - p, np.stack((x, y), -1) - p) / area for p, q in ((b, c), (c, a), (a, b))]
        inside = np.min(shares, axis=0) > 0
        z = (sum(share * d for share, d in zip(shares, depth, strict=True)) + 1) / 2
        layers += inside
        nearer = inside & (z < best)
        best[nearer], front[nearer] = z[nearer], number
    # Where the border of the picture has cut a triangle, its new corners are rounded.
    assert (found.layers != layers).mean() < 0.002 and (found.polygon != front).mean() < 0.002
    same = (found.polygon == front) & (front >= 0)
    np.testing.assert_allclose(found.depth[same], best[same], atol=2e-3)
    assert found.fragments == found.layers.sum() and found.pixels == (found.layers > 0).sum()


def test_what_shares_a_side_leaves_no_gap_and_covers_nothing_twice():
    """A fan about a pixel's centre, with its rim on centres as well: every centre on a line has one owner."""
    size = (32, 32)
    rim = np.array([(4.5, 4.5), (16.5, 4.5), (28.5, 4.5), (28.5, 28.5), (16.5, 28.5), (4.5, 28.5), (4.5, 16.5)])
    middle = np.array((16.5, 16.5))
    fan = [(middle, a, b) for a, b in zip(rim, np.roll(rim, -1, axis=0), strict=True)]
    found = raster(flat(fan, 0.0, size), viewport_matrix(*size), size)
    expected = np.zeros((32, 32), int)
    expected[4:28, 4:28] = 1  # the upper and left border belong to it, the lower and right one do not
    np.testing.assert_array_equal(found.layers, expected)


@pytest.mark.parametrize(
    "camera",
    [
        Camera((50.0, -60.0, 45.0), (5.0, 5.0, 5.0), view_angle=30.0),
        Camera((22.0, -14.0, 16.0), (5.0, 5.0, 5.0), view_angle=60.0),  # the picture's border cuts the solids
        Camera((50.0, -60.0, 45.0), (5.0, 5.0, 5.0), parallel=True, parallel_scale=14.0),
    ],
)
def test_our_pixels_are_those_of_vtks_numbered_picture(camera):
    size = (300, 200)
    evaluation = evaluate(document_of(box(10) - cylinder(3, 30).at(5, 5, -5), sphere(6, segments=24).at(12, 8, 3)))
    meshes = [evaluation.display(result) for result in evaluation.visible]
    ids = numbers_of(ids_picture(meshes, size, camera))
    points, triangles = joined([(mesh.vertices, mesh.corners) for mesh in meshes])
    matrices = matrices_for(camera.position, camera.target, perspective=None if camera.parallel else camera.view_angle,
                            half_height=camera.parallel_scale, size=size, near=1.0, far=500.0)  # fmt: skip
    result = counted(points, triangles, matrices, size)
    solid_of = np.repeat((1, 2), [len(mesh.corners) for mesh in meshes])
    ours = np.where(result.raster.polygon >= 0, solid_of[result.drawn.source[result.raster.polygon]], 0)
    differs = ours != ids
    assert differs.mean() < 0.002  # VTK rounds corners elsewhere, so a pixel of a border may differ
    near = np.zeros_like(differs)
    for axis in (0, 1):
        for by in (-1, 1):
            near |= np.roll(ids, by, axis) != ids
    assert not (differs & ~near).any()
    assert abs(result.counts.pixels - (ids > 0).sum()) <= 0.002 * ids.size
    uncut = counted(points, triangles, matrices, size, cull=False)
    assert uncut.counts.pixels == result.counts.pixels and uncut.counts.fragments > result.counts.fragments


def test_counts_of_a_box_seen_from_the_front():
    """A cube of 2 mm, 10 mm before the eye in a parallel picture of 20 by 20 mm and 100 by 100 pixels."""
    mesh = (evaluation := evaluate(box(2, centred=True))).display(evaluation.visible[0])
    matrices = matrices_for((0, -10, 0), perspective=None, half_height=10.0, size=(100, 100), near=5, far=15)
    told = counted(mesh.vertices, mesh.corners, matrices, (100, 100)).counts
    assert (told.vertices, told.triangles, told.outside, told.cut) == (8, 12, 0, 0)
    # The sides along the view have no area in the picture and do not face the eye.
    assert (told.away, told.polygons, told.pieces) == (10, 2, 2)
    assert (told.fragments, told.pixels, told.hidden, told.overdraw) == (100, 100, 0, 1.0)
    both = counted(mesh.vertices, mesh.corners, matrices, (100, 100), cull=False).counts
    assert (both.away, both.polygons, both.fragments, both.pixels, both.overdraw) == (0, 12, 200, 100, 2.0)
    # The far plane through the middle: the back is gone, the four sides are cut.
    near = matrices_for((0, -10, 0), perspective=None, half_height=10.0, size=(100, 100), near=5, far=10)
    halved = counted(mesh.vertices, mesh.corners, near, (100, 100), cull=False).counts
    assert (halved.outside, halved.cut, halved.polygons) == (2, 8, 10)
    # Without the far plane everything is there again.
    whole = counted(mesh.vertices, mesh.corners, near, (100, 100), False, np.delete(PLANES, 5, axis=0)).counts
    assert (whole.outside, whole.cut, whole.polygons) == (0, 0, 12)


def test_points_come_back_from_their_pixels():
    matrices = matrices_for((30, -40, 50), (1, 2, 3), perspective=40.0, size=(640, 360), near=10, far=200)
    points = np.random.default_rng(5).uniform(-8, 8, (1000, 3))
    np.testing.assert_allclose(matrices.unprojected(matrices.stages(points).pixel), points, atol=1e-9)


def test_nothing_gives_an_empty_picture_and_a_stop_gives_none():
    points, triangles = joined([])
    matrices = matrices_for((0, -10, 0), size=(20, 10))
    told = counted(points, triangles, matrices, (20, 10)).counts
    assert (told.vertices, told.polygons, told.fragments, told.pixels, told.overdraw) == (0, 0, 0, 0, 0.0)
    assert counted(points, triangles, matrices, (20, 10), stopped=lambda: True) is None
    behind = np.array([(0.0, -20.0, 0.0), (1.0, -20.0, 0.0), (0.0, -20.0, 1.0)])
    away = drawn(Matrices.clip(matrices, behind), np.array([(0, 1, 2)]))
    assert away.outside.tolist() == [True]
