"""Camera moves by formula: what must stay where it is in the picture stays there."""

import math

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkCamera

from solidtree.render.camera import (
    Camera,
    apply,
    fit,
    frame,
    on_target_plane,
    orbit,
    pan,
    project,
    ray,
    with_projection,
    zoom,
)

SIZE = (640.0, 480.0)
BOUNDS = np.array([[-5.0, 2.0, 1.0], [30.0, 9.0, 4.0]])
CAMERAS = [
    Camera((40.0, -70.0, 55.0), (3.0, 4.0, 5.0), (0.0, 0.0, 1.0), 35.0, parallel, 21.0) for parallel in (False, True)
]


@pytest.fixture(params=CAMERAS, ids=["perspective", "parallel"])
def camera(request) -> Camera:
    return request.param


def test_frame_is_right_handed_and_orthonormal(camera):
    axes = frame(camera)
    assert np.allclose(axes @ axes.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert axes[1, 2] > 0.0


def test_frame_where_up_is_the_view_direction():
    axes = frame(Camera((0.0, 0.0, 10.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    assert np.allclose(axes, np.eye(3), atol=1e-12)


def test_project_inverts_ray(camera):
    rng = np.random.default_rng(0)
    for x, y in rng.uniform((0.0, 0.0), SIZE, (20, 2)):
        origin, direction = ray(camera, x, y, SIZE)
        assert np.linalg.norm(direction) == pytest.approx(1.0)
        seen = project(camera, origin + np.outer([30.0, 90.0], direction), SIZE)
        assert np.allclose(seen[:, :2], (x, y), atol=1e-8)


def test_ray_through_the_corners_has_the_view_angle():
    camera = CAMERAS[0]
    above, below = (ray(camera, 320.0, y, SIZE)[1] for y in (0.0, 480.0))
    assert math.degrees(math.acos(above @ below)) == pytest.approx(35.0)
    assert above @ frame(camera)[1] > 0.0  # y is measured downward


def test_project_marks_points_behind_the_eye():
    camera = CAMERAS[0]
    behind = np.asarray(camera.position) + frame(camera)[2]
    assert np.isnan(project(camera, behind, SIZE)[0, :2]).all()


def test_orbit_keeps_distance_and_horizon(camera):
    rng = np.random.default_rng(1)
    for dx, dy in rng.uniform(-200.0, 200.0, (50, 2)):
        before, camera = camera, orbit(camera, dx, dy)
        assert camera.distance == pytest.approx(before.distance)
        assert np.allclose(camera.target, before.target)
        axes = frame(camera)
        assert abs(axes[0, 2]) < 1e-9  # the picture's right is level
        assert axes[1, 2] > -1e-9  # z never points down


def test_orbit_turns_about_z_and_moves_the_near_side_with_the_pointer():
    camera = orbit(Camera((0.0, -10.0, 0.0), (0.0, 0.0, 0.0)), 90.0, 0.0)
    assert np.allclose(camera.position, (-10.0, 0.0, 0.0))
    assert np.allclose(orbit(Camera((0.0, -10.0, 0.0)), 0.0, 30.0).position, (0.0, -8.660254, 5.0))


def test_orbit_over_the_pole_stops_there_and_comes_back():
    start = Camera((3.0, -10.0, 4.0))
    top = orbit(start, 0.0, 500.0)
    assert np.allclose(frame(top)[2], (0.0, 0.0, 1.0))
    back = orbit(top, 0.0, -90.0 + math.degrees(math.asin(4.0 / start.distance)))
    assert np.allclose(back.position, start.position)


def test_orbit_about_a_pivot_keeps_it_in_place(camera):
    camera = orbit(camera, 0.0, 0.0)
    pivot = np.array([7.0, -2.0, 3.0])
    turned = orbit(camera, 25.0, -10.0, pivot)
    assert np.allclose(project(camera, pivot, SIZE), project(turned, pivot, SIZE))


def test_pan_moves_the_target_by_the_pixels(camera):
    moved = pan(camera, 33.0, -12.0, SIZE)
    assert np.allclose(project(moved, camera.target, SIZE)[0, :2], (320.0 + 33.0, 240.0 - 12.0))
    assert moved.distance == pytest.approx(camera.distance)


def test_pan_takes_the_grabbed_point_along(camera):
    point = np.array([10.0, 20.0, -5.0])
    moved = pan(camera, -40.0, 25.0, SIZE, point)
    shift = project(moved, point, SIZE) - project(camera, point, SIZE)
    assert np.allclose(shift, [[-40.0, 25.0, 0.0]])


@pytest.mark.parametrize("factor", [0.3, 1.7])
def test_zoom_keeps_what_is_under_the_pointer(camera, factor):
    rng = np.random.default_rng(2)
    for x, y in rng.uniform((0.0, 0.0), SIZE, (20, 2)):
        under = on_target_plane(camera, x, y, SIZE)
        zoomed = zoom(camera, factor, (x, y), SIZE)
        assert np.allclose(project(zoomed, under, SIZE)[0, :2], (x, y))
        assert zoomed.half_height == pytest.approx(camera.half_height / factor)
        origin, direction = ray(camera, x, y, SIZE)
        point = origin + 50.0 * direction
        assert np.allclose(project(zoom(camera, factor, point=point), point, SIZE)[0, :2], (x, y))


def test_zoom_refuses_nonsense(camera):
    for factor in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(ValueError, match="zoom factor"):
            zoom(camera, factor)
    with pytest.raises(ValueError, match="size"):
        zoom(camera, 2.0, (1.0, 2.0))


def test_zoom_ends_somewhere(camera):
    for _ in range(200):
        camera = zoom(camera, 10.0)
    assert camera.half_height > 0.0
    for _ in range(200):
        camera = zoom(camera, 0.1)
    assert np.isfinite(camera.position).all() and math.isfinite(camera.half_height)


@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.2])
def test_fit_shows_all_corners_and_wastes_no_room(camera, aspect):
    fitted = fit(camera, BOUNDS, aspect, margin=1.0)
    corners = np.array([[x, y, z] for x in BOUNDS[:, 0] for y in BOUNDS[:, 1] for z in BOUNDS[:, 2]])
    size = (480.0 * aspect, 480.0)
    reach = np.abs(project(fitted, corners, size)[:, :2] / size - 0.5).max()
    assert reach == pytest.approx(0.5, abs=1e-9)
    assert np.allclose(frame(fitted), frame(camera))
    assert np.allclose(fitted.target, BOUNDS.mean(axis=0))


@pytest.mark.parametrize(
    "bounds", [None, [[1, 1, 1], [0, 0, 0]], [[np.nan] * 3] * 2, [[4.0] * 3] * 2, [[0, 0, 0], [5, 0, 0]]]
)
def test_fit_of_nothing_is_something(camera, bounds):
    fitted = fit(camera, bounds, 1.5)
    assert np.isfinite(fitted.position).all()
    assert fitted.half_height > 0.1


def test_projections_agree_at_the_target(camera):
    other = with_projection(camera, not camera.parallel)
    point = np.asarray(camera.target) + frame(camera)[0] * 5.0 + frame(camera)[1] * 3.0
    assert np.allclose(project(camera, point, SIZE)[0, :2], project(other, point, SIZE)[0, :2])
    again = with_projection(other, camera.parallel)
    assert again.half_height == pytest.approx(camera.half_height)


@pytest.mark.parametrize("bounds", [BOUNDS, None, [[-500.0] * 3, [500.0] * 3], [[0.0] * 3, [1e-3] * 3]])
def test_apply_agrees_with_vtk(camera, bounds):
    target = vtkCamera()
    apply(camera, target, bounds)
    near, far = target.GetClippingRange()
    assert 0.0 < near < far
    matrix = target.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1.0, 1.0)
    full = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    points = np.random.default_rng(3).uniform(-10.0, 10.0, (50, 3))
    clip = np.c_[points, np.ones(50)] @ full.T
    x, y = (clip[:, :2] / clip[:, 3:]).T
    seen = project(camera, points, SIZE)
    assert np.allclose(seen[:, 0], (x + 1.0) / 2.0 * SIZE[0])
    assert np.allclose(seen[:, 1], (1.0 - y) / 2.0 * SIZE[1])


def test_apply_clips_no_corner(camera):
    target = vtkCamera()
    fitted = fit(camera, BOUNDS, 1.3)
    apply(fitted, target, BOUNDS)
    near, far = target.GetClippingRange()
    corners = np.array([[x, y, z] for x in BOUNDS[:, 0] for y in BOUNDS[:, 1] for z in BOUNDS[:, 2]])
    depth = (np.asarray(target.GetPosition()) - corners) @ frame(fitted)[2]
    assert near < depth.min() and depth.max() < far
