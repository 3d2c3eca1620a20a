"""Projections: axes, the plane that keeps its size, straight lines and depth in perspective."""

import itertools
import math

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.drawing.projection import DIRECTIONS, NEAREST, looking, standard
from solidtree.render.camera import Camera, frame
from solidtree.render.views import STANDARD_VIEWS, standard_view

RNG = np.random.default_rng(3)
CORNERS = np.array(list(itertools.product((0.0, 10.0), repeat=3)))


@pytest.mark.parametrize("name", DIRECTIONS)
def test_views_by_name_are_those_of_the_window(name):
    assert tuple(np.array(STANDARD_VIEWS[name], float)) == DIRECTIONS[name]
    assert np.allclose(standard(name).axes, frame(standard_view(Camera(), name)), atol=1e-12)


def test_front_view_shows_x_and_z_in_their_size_and_minus_y_as_depth():
    points = RNG.normal(size=(20, 3)) * 10
    picture = standard("front", [[-1, -2, -3], [5, 4, 3]]).picture(points)
    assert np.allclose(picture, np.column_stack((points[:, 0] - 2, points[:, 2], -(points[:, 1] - 1))))


def test_an_isometric_cube_is_a_hexagon():
    picture = standard("iso", [[0, 0, 0], [10, 10, 10]]).picture(CORNERS)[:, :2]
    radius = np.hypot(*picture.T)
    assert np.sort(radius).tolist() == pytest.approx([0, 0] + 6 * [10 * math.sqrt(2 / 3)], abs=1e-12)


def test_perspective_keeps_the_size_at_the_target_and_halves_it_at_twice_the_distance():
    view = looking((0, -100, 0), (0, 0, 0), perspective=60)
    assert view.picture([(3, 0, 4)]).tolist() == [pytest.approx([3, 4, 0])]
    assert view.picture([(3, 100, 4)])[0, :2].tolist() == pytest.approx([1.5, 2])
    assert view.picture([(3, -50, 4)])[0, :2].tolist() == pytest.approx([6, 8])


def test_depth_in_perspective_is_nearer_when_larger_and_linear_along_straight_lines():
    view = looking((30, -80, 40), (1, 2, 3), perspective=50)
    a, b = view.target + RNG.uniform(-9, 9, (2, 3))
    line = view.picture(a + np.linspace(0, 1, 9)[:, None] * (b - a))
    way = line[-1] - line[0]
    share = (line - line[0]) @ way / (way @ way)
    assert np.allclose(line, line[0] + share[:, None] * way, atol=1e-10)
    ray = view.picture(view.eye + np.array([[0.5], [0.9], [1.5]]) * (a - view.eye))
    assert np.allclose(ray[:, :2], ray[0, :2]) and (np.diff(ray[:, 2]) < 0).all()


def test_a_standard_perspective_holds_the_whole_box():
    box = np.array([[0, 0, 0], [10, 10, 10]])
    for name in DIRECTIONS:
        view = standard(name, box, perspective=40)
        picture = view.picture(CORNERS)
        assert np.abs(picture[:, :2]).max() <= view.focal * math.tan(math.radians(20)) * (1 + 1e-12)


def test_limits_are_the_frame_and_what_is_just_before_the_eye():
    view = looking((0, -10, 0), (0, 0, 0), perspective=90, aspect=2.0)
    assert view.frame == pytest.approx((20, 10))
    inside = lambda point: bool((view.limits() @ np.append(view.viewed([point])[0], 1.0) >= -1e-9).all())  # noqa: E731
    assert inside((20, 0, 0)) and not inside((20.01, 0, 0))
    assert inside((0, 0, 10)) and not inside((0, 0, 10.01))
    assert inside((0, -10 + 20 * NEAREST, 0)) and not inside((0, -10 + 5 * NEAREST, 0)) and not inside((0, -11, 0))


def test_looking_along_up_still_has_axes():
    for eye, up in (((0, 0, 5), (0, 0, 1)), ((0, 5, 0), (0, 1, 0)), ((0, -5, 0), (0, -2, 0))):
        axes = looking(eye, up=up).axes
        assert np.allclose(axes @ axes.T, np.eye(3)) and np.linalg.det(axes) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: standard("behind"), "no view is called 'behind'"),
        (lambda: standard("iso", perspective=180), "between 0 and 180"),
        (lambda: looking((1, 2, 3), (1, 2, 3)), "the same point"),
        (lambda: looking((1, 2, math.nan)), "finite"),
        (lambda: looking((1, 2, 3), perspective=30, aspect=0), "above 0"),
    ],
)
def test_what_is_no_view_is_refused_in_words(make, words):
    with pytest.raises(Refusal, match=words):
        make()
