"""Views by name, cameras for pictures, and the way between two cameras."""

import numpy as np
import pytest

from solidtree.render.camera import Camera, frame, orbit, project
from solidtree.render.views import STANDARD_VIEWS, camera_of, interpolate, standard_view, view_direction

START = Camera((1.0, -2.0, 3.0), (4.0, 5.0, 6.0))


@pytest.mark.parametrize("name", STANDARD_VIEWS)
def test_standard_views_keep_target_distance_and_z_up(name):
    camera = standard_view(START, name)
    axes = frame(camera)
    direction = np.array(STANDARD_VIEWS[name], float)
    assert np.allclose(axes[2], direction / np.linalg.norm(direction))
    assert camera.target == START.target
    assert camera.distance == pytest.approx(START.distance)
    assert axes[1, 2] > 0.5 or abs(axes[2, 2]) == pytest.approx(1.0)


@pytest.mark.parametrize(("name", "right", "up"), [("top", 0, 1), ("front", 0, 2), ("right", 1, 2)])
def test_what_is_right_and_up(name, right, up):
    axes = frame(standard_view(START, name))
    assert np.allclose(axes[0], np.eye(3)[right])
    assert np.allclose(axes[1], np.eye(3)[up])


def test_views_join_sides():
    assert view_direction("front-right-top") == STANDARD_VIEWS["iso"]
    assert view_direction("back-left") == (-1.0, 1.0, 0.0)
    for name in ("", "above", "front-back", "top-top", "iso-front"):
        with pytest.raises(ValueError, match="view"):
            view_direction(name)


@pytest.mark.parametrize("last", ["top", "back", "bottom", "iso"])
def test_interpolate_starts_ends_and_stays_upright(last):
    a, b = standard_view(START, "front"), orbit(standard_view(START, last), 20.0, 0.0)
    assert interpolate(a, b, 0.0) is a
    assert interpolate(a, b, 1.0) is b
    for t in np.linspace(0.0, 1.0, 21):
        camera = interpolate(a, b, float(t))
        assert abs(frame(camera)[0, 2]) < 1e-9
        assert camera.distance == pytest.approx(START.distance)
    assert np.allclose(interpolate(a, b, 1.0 - 1e-9).position, b.position, atol=1e-6)
    assert np.allclose(interpolate(a, b, 1e-9).position, a.position, atol=1e-6)


def test_interpolate_takes_the_shortest_turn_between_rolled_cameras():
    a = Camera((0.0, -10.0, 0.0), up=(0.3, 0.0, 1.0))
    b = Camera((10.0, 0.0, 0.0), up=(0.0, -0.5, 1.0))
    start, end = frame(a), frame(b)

    def angle(x, y):
        return np.arccos((np.trace(x.T @ y) - 1.0) / 2.0)

    middle = frame(interpolate(a, b, 0.5))
    assert angle(start, middle) == pytest.approx(angle(middle, end))
    assert angle(start, middle) == pytest.approx(angle(start, end) / 2.0)
    assert np.allclose(frame(interpolate(a, b, 1.0 - 1e-9)), end, atol=1e-6)


def test_camera_of_a_picture():
    bounds = np.array([[0.0, 0.0, 0.0], [10.0, 20.0, 30.0]])
    camera = camera_of(bounds, 1.5, eye=(50.0, 60.0, 70.0), perspective=40.0)
    assert camera.position == (50.0, 60.0, 70.0)
    assert camera.target == (5.0, 10.0, 15.0)
    assert (camera.view_angle, camera.parallel) == (40.0, False)
    flat = camera_of(bounds, 1.5, eye=(0.0, -50.0, 0.0), target=(0.0, 0.0, 0.0), perspective=None)
    corners = np.array([[x, y, z] for x in bounds[:, 0] for y in bounds[:, 1] for z in bounds[:, 2]])
    seen = project(flat, corners, (300.0, 200.0))
    assert ((seen[:, :2] >= 0.0) & (seen[:, :2] <= (300.0, 200.0))).all()
    with pytest.raises(ValueError, match="angle"):
        camera_of(bounds, 1.5, perspective=180.0)
    with pytest.raises(ValueError, match="same point"):
        camera_of(bounds, 1.5, eye=(1, 2, 3), target=(1, 2, 3))
    with pytest.raises(ValueError, match="view"):
        camera_of(bounds, 1.5, "above")
