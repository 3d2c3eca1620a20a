"""The way of vertices to the screen: VTK's own display coordinates, and clipping against half-planes."""

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection
from vtkmodules.vtkRenderingCore import vtkRenderer

from solidtree.model.pipeline.clipping import PLANES, Polygons, clipped, clipped_lines, drawn, front_facing
from solidtree.model.pipeline.stages import (
    divided,
    homogeneous,
    parallel_matrix,
    perspective_matrix,
    stages,
    view_matrix,
    viewport_matrix,
)
from solidtree.render.camera import Camera, apply, frame, project
from solidtree.render.window import close, offscreen_window

SIZE = (640, 360)


def matrices(camera, near=20.0, far=300.0):
    aspect = SIZE[0] / SIZE[1]
    view = view_matrix(camera.position, frame(camera))
    if camera.parallel:
        return view, parallel_matrix(camera.parallel_scale, aspect, near, far)
    return view, perspective_matrix(np.radians(camera.view_angle), aspect, near, far)


@pytest.mark.parametrize("parallel", [False, True])
def test_our_pixels_are_vtks_display_coordinates(parallel):
    camera = Camera((60.0, -90.0, 70.0), (3.0, 4.0, 5.0), view_angle=35.0, parallel=parallel, parallel_scale=40.0)
    points = np.random.default_rng(1).uniform(-25, 25, (100_000, 3))
    view, projection = matrices(camera)
    found = stages(points, np.eye(4), view, projection, viewport_matrix(*SIZE))
    window = offscreen_window(SIZE)
    try:
        renderer = vtkRenderer()
        window.AddRenderer(renderer)
        apply(camera, renderer.GetActiveCamera(), np.array([[-25.0] * 3, [25.0] * 3]))
        display = np.empty((len(points), 2))
        for row, (x, y, z) in enumerate(points.tolist()):
            renderer.SetWorldPoint(x, y, z, 1.0)
            renderer.WorldToDisplay()
            display[row] = renderer.GetDisplayPoint()[:2]
    finally:
        close(window)
    # VTK counts from the lower left corner.
    np.testing.assert_allclose(found.pixel[:, 0], display[:, 0], atol=1e-3)
    np.testing.assert_allclose(SIZE[1] - found.pixel[:, 1], display[:, 1], atol=1e-3)
    np.testing.assert_allclose(found.pixel[:, :2], project(camera, points, SIZE)[:, :2], atol=1e-6)


def test_depths_and_the_models_matrix():
    view = view_matrix((0, 0, 10), np.eye(3))
    moved = np.array([[2.0, 0, 0, 1], [0, 2, 0, 0], [0, 0, 2, 0]])
    for projection in (perspective_matrix(1.0, 1.5, 4.0, 16.0), parallel_matrix(5.0, 1.5, 4.0, 16.0)):
        found = stages([(0, 0, 3), (0, 0, -3), (0, 0, 1)], moved, view, projection, viewport_matrix(300, 200))
        np.testing.assert_allclose(found.world, [(1, 0, 6), (1, 0, -6), (1, 0, 2)])
        np.testing.assert_allclose(found.eye[:, 2], (-4, -16, -8))
        np.testing.assert_allclose(found.pixel[:2, 2], (0.0, 1.0), atol=1e-12)


def half_plane_area(heights):
    """The area of the part of a triangle, in its first two barycentric coordinates, where affine functions with these
    values (3, p) at its corners are not negative; by qhull."""
    a, b, c = heights[0], heights[1], heights[2]
    rows = [(*(-(b - a)[k : k + 1]), -(c - a)[k], -a[k]) for k in range(heights.shape[1])]
    rows += [(-1, 0, 0), (0, -1, 0), (1, 1, -1)]
    rows = np.array(rows, float)
    size = np.linalg.norm(rows[:, :2], axis=1, keepdims=True)
    best = linprog((0, 0, -1), np.hstack((rows[:, :2], size)), -rows[:, 2], bounds=[(None, None)] * 2 + [(0, None)])
    if not best.success or best.x[2] < 1e-9:
        return 0.0
    return ConvexHull(HalfspaceIntersection(rows, best.x[:2]).intersections).volume


def barycentric_area(triangle, polygon):
    """Of a clipped polygon in the first two barycentric coordinates of its triangle."""
    if len(polygon) < 3:
        return 0.0
    shares = np.linalg.lstsq(triangle.T, polygon.T, rcond=None)[0].T[:, 1:]
    x, y = shares.T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0


def test_polygons_are_cut_as_half_planes_cut_them():
    """Triangles all around the eye, many of them through the plane of the eye itself."""
    camera = Camera((0.0, 0.0, 0.0), (0.0, 0.0, -50.0), up=(0.0, 1.0, 0.0), view_angle=60.0)
    view, projection = matrices(camera, 5.0, 60.0)
    points = np.random.default_rng(2).uniform(-50, 50, (600, 3))
    clip = homogeneous(points) @ (projection @ view).T
    triangles = clip.reshape(-1, 3, 4)
    found = clipped(triangles)
    cut = 0
    for number, triangle in enumerate(triangles):
        polygon = found.polygon(number)
        expected = half_plane_area(triangle @ PLANES.T)
        assert barycentric_area(triangle, polygon) == pytest.approx(expected, abs=1e-9)
        cut += 0.0 < expected < 0.499
        if len(polygon):
            assert (polygon @ PLANES.T).min() > -1e-9 * np.abs(polygon).max()
    assert cut > 30
    assert np.abs(divided(found.corners[found.counts > 0][:, 0])).max() <= 1.0 + 1e-9


def test_lines_are_cut_at_the_same_places():
    lines = np.random.default_rng(3).uniform(-2, 2, (500, 2, 4))
    found, visible = clipped_lines(lines)
    steps = np.linspace(0, 1, 4001)
    for line, cut, seen in zip(lines, found, visible, strict=True):
        inside = ((line[0] + steps[:, None] * (line[1] - line[0])) @ PLANES.T >= 0).all(axis=1)
        if not seen:
            assert inside.sum() <= 1
            continue
        way = line[1] - line[0]
        shares = (cut - line[0]) @ way / (way @ way)
        if inside.any():
            assert shares[0] == pytest.approx(steps[inside][0], abs=3e-4)
            assert shares[1] == pytest.approx(steps[inside][-1], abs=3e-4)
        else:
            assert np.ptp(shares) < 3e-4


def test_what_faces_away_or_lies_outside_is_counted():
    square = np.array([(-0.5, -0.5, 0, 1), (0.5, -0.5, 0, 1), (0.5, 0.5, 0, 1), (-0.5, 0.5, 0, 1)])
    far, half = square + np.array((5, 0, 0, 0)), square + np.array((0.8, 0, 0, 0))
    clip = np.concatenate((square, far, half))
    rows = np.array([(0, 1, 2), (0, 2, 1), (4, 5, 6), (8, 9, 11)])
    left = drawn(clip, rows)
    assert left.away.tolist() == [False, True, False, False] and left.outside.tolist() == [False, False, True, False]
    assert left.source.tolist() == [0, 3] and left.cut.tolist() == [False, True]
    assert left.polygons.counts.tolist() == [3, 4] and drawn(clip, rows, cull=False).source.tolist() == [0, 1, 3]
    assert front_facing(Polygons(square[None], np.array([4]))).tolist() == [True]
