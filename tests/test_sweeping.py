"""First contacts of bodies on paths, by formula."""

import numpy as np
import pytest
from manifold3d import Manifold
from moving_bodies import block, body, pose

from solidtree.model.document.errors import Refusal
from solidtree.model.proximity.moving.screws import Path
from solidtree.model.proximity.moving.sweeping import first_contact


def test_two_spheres_meet_when_their_centres_are_two_radii_apart():
    one, other = body(Manifold.sphere(1, 128)), body(Manifold.sphere(1, 128).translate((10, 0, 0)))
    found = first_contact(one, [other], [pose(), pose(20)], [0, 10])
    assert found is not None and found.kind == "touching" and found.other == 0
    assert found.time == pytest.approx((10 - 2) / 2, abs=1e-5)
    assert found.place == pytest.approx([9, 0, 0], abs=1e-4)


def test_the_nearest_of_several_is_met_and_what_is_beside_the_way_never():
    ball = body(Manifold.sphere(1, 64))
    walls = [body(block(1, 9, 9, (x, -4, -4))) for x in (30, 10, 20)]
    found = first_contact(ball, walls, [pose(), pose(100)], [2, 4])
    assert found is not None and found.other == 1 and found.time == pytest.approx(2 + 2 * 9 / 100, abs=1e-5)
    assert first_contact(ball, walls, [pose(0, 50), pose(100, 50)], [2, 4]) is None


def test_a_thin_wall_is_not_jumped_over_in_one_leg():
    found = first_contact(
        body(Manifold.sphere(1, 64)), [body(block(1e-3, 9, 9, (500, -4, -4)))], [pose(), pose(1e6)], [0, 1]
    )
    assert found is not None and found.time == pytest.approx(499e-6, rel=1e-6)


@pytest.mark.parametrize("legs", [2, 6, 40])
def test_a_turning_bar_hits_a_post_at_the_angle_however_many_poses_there_are(legs):
    bar, post = body(block(10, 1, 1, (0, -0.5, 0))), body(block(1, 1, 4, (-0.5, 8, -2)))
    angles = np.linspace(0, 170, legs + 1)
    found = first_contact(bar, [post], [pose(turn=angle) for angle in angles], angles)
    corner = np.array([0.5, 8.0])  # of the post, half a millimetre above the bar's middle
    expected = np.degrees(np.arctan2(corner[1], corner[0]) - np.arcsin(0.5 / np.linalg.norm(corner)))
    assert found is not None and found.time == pytest.approx(expected, abs=1e-3)
    assert found.place is not None and found.place[:2] == pytest.approx(corner, abs=1e-3)


def test_a_turn_about_an_axis_far_away_is_an_arc_between_the_poses():
    """A ball on an arm goes round (0, 0) with radius 10: a chord would pass the pin at radius 10."""
    ball, pin = body(Manifold.sphere(0.5, 64).translate((10, 0, 0))), body(Manifold.cylinder(2, 0.25, 0.25, 64, True))
    at = 10 * np.array([np.cos(np.radians(45)), np.sin(np.radians(45)), 0])
    found = first_contact(ball, [body(pin.solid.translate(at))], [pose(), pose(turn=90)], [0, 90])
    expected = 45 - 2 * np.degrees(np.arcsin(0.75 / 2 / 10))
    assert found is not None and found.time == pytest.approx(expected, abs=0.02)


def test_a_screw_turns_and_goes_along_its_axis():
    path = Path([pose(3, 0, 0), pose(3, 0, 5, turn=0) @ pose(turn=120)], [0, 1])
    (screw,) = path.screws
    assert screw.angle == pytest.approx(np.radians(120)) and screw.shift == pytest.approx([0, 0, 5])
    assert screw.centre[:2] == pytest.approx([3, 0])
    half = path.pose(0.5)
    assert half[:3, :3] == pytest.approx(pose(turn=60)[:3, :3]) and half[:3, 3] == pytest.approx([3, 0, 2.5])
    assert path.speeds(np.array([[2.0, 0, 0]]))[0] == pytest.approx(np.hypot(5, 2 * np.radians(120)))
    # A nut with a rib goes up a screw, and its rib meets a stop at its height.
    rib = body(block(1, 1, 1, (5, -0.5, 0)))
    stop = body(block(20, 20, 1, (-10, -10, 4)))
    found = first_contact(rib, [stop], [pose(turn=120 * k) + pose(0, 0, 2.0 * k) - pose() for k in range(4)], range(4))
    assert found is not None and found.time == pytest.approx(3 / 2, abs=1e-4)


def test_what_overlaps_or_is_inside_at_the_beginning_is_told():
    ball, room = body(Manifold.sphere(1, 32)), body(block(10, 10, 10, (-5, -5, -5)))
    found = first_contact(ball, [room], [pose(), pose(9)], [1, 2])
    assert found is not None and (found.time, found.kind, found.place) == (1, "around", None)
    shell = body(room.solid - block(8, 8, 8, (-4, -4, -4)))
    found = first_contact(ball, [shell], [pose(), pose(9)], [0, 9])
    assert found is not None and found.kind == "touching" and found.time == pytest.approx(3, abs=1e-4)


@pytest.mark.parametrize(
    "poses, times, words",
    [
        ([pose(), 2 * pose()], [0, 1], "pose 1 does more than turn and move"),
        ([pose(), pose(1)], [0, 0], "each larger than the one before"),
        ([pose()], [0, 1], "a time for each of its 1 poses"),
        ([1, 2], [0, 1], "a path is a list of poses"),
    ],
)
def test_what_is_no_path_is_refused(poses, times, words):
    with pytest.raises(Refusal, match=words):
        first_contact(body(Manifold.sphere(1)), [], poses, times)
