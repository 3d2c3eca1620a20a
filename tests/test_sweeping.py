"""Frames along a path: orthonormal, across it, without turning about it, close enough together, closed where it is."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.outline.sweeping import path_frames, start_frame
from solidtree.model.path import shapes
from solidtree.model.path.path import Path
from solidtree.model.spline.spline_fitting import interpolated


def path(*commands):
    return Path.of_commands(commands)


ARC = path(("move", (0, 0)), ("cubic", (40, 0), (60, 30), (60, 60)))
SPACE = path(("move", (0, 0, 0)), ("cubic", (0, 0, 30), (30, 0, 30), (30, 30, 60)))
SQUARE = path(("move", (0, 0)), ("line", (20, 0)), ("line", (20, 20)), ("line", (0, 20)), ("close",))


def helix(radius=10.0, pitch=8.0, turns=2.0):
    angle = np.linspace(0, 2 * np.pi * turns, 400)
    points = np.column_stack((radius * np.cos(angle), radius * np.sin(angle), pitch * angle / (2 * np.pi)))
    return Path.of_commands([("move", points[0]), ("spline", interpolated(points))])


@pytest.mark.parametrize("along", [ARC, SPACE, helix()])
def test_frames_are_orthonormal_and_across_the_path(along):
    frames = path_frames(along, 0.01, 5)
    square = frames.axes @ frames.axes.transpose(0, 2, 1)
    np.testing.assert_allclose(square, np.broadcast_to(np.eye(3), square.shape), atol=1e-12)
    assert (np.linalg.det(frames.axes) > 0).all()
    chord = np.diff(frames.origins, axis=0)
    chord /= np.linalg.norm(chord, axis=1)[:, None]
    middle = frames.axes[1:, 2] + frames.axes[:-1, 2]
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    np.testing.assert_allclose((chord * middle).sum(axis=1), 1, atol=1e-4)


@pytest.mark.parametrize("along", [ARC, SPACE, helix()])
def test_the_lengths_are_those_of_the_path(along):
    assert path_frames(along, 0.001, 5).length == pytest.approx(along.length(), rel=1e-6)


def test_along_a_helix_the_frame_turns_against_the_normal_as_its_torsion_says():
    radius, pitch, turns = 10.0, 8.0, 2.0
    frames = path_frames(helix(radius, pitch, turns), 1e-4, 5)
    rise = pitch / (2 * np.pi)
    torsion = rise / (radius**2 + rise**2)
    inwards = -frames.origins * (1, 1, 0) / radius
    x, y = frames.axes[:, 0], frames.axes[:, 1]
    angle = np.unwrap(np.arctan2((y * inwards).sum(axis=1), (x * inwards).sum(axis=1)))
    np.testing.assert_allclose(angle - angle[0], torsion * frames.lengths, atol=2e-3)


def test_a_finer_tolerance_follows_the_path_and_what_reaches_out_from_it():
    """Between neighbouring frames the true place is no further from the chord than the tolerance."""
    reach = 20.0
    fine = path_frames(SPACE, 1e-5, reach)
    for tolerance in (1.0, 0.1, 0.01):
        coarse = path_frames(SPACE, tolerance, reach)
        for offset in ((0, 0), (reach, 0), (-reach, 0), (0, reach), (0, -reach)):
            near, true = (f.origins + (np.array(offset)[None, :, None] * f.axes[:, :2]).sum(axis=1)
                          for f in (coarse, fine))  # fmt: skip
            line = np.diff(near, axis=0)
            share = np.einsum("nmj,mj->nm", true[:, None] - near[:-1], line) / (line**2).sum(axis=1)
            foot = near[:-1] + np.clip(share, 0, 1)[..., None] * line
            assert np.linalg.norm(true[:, None] - foot, axis=2).min(axis=1).max() < 1.1 * tolerance
    assert len(path_frames(SPACE, 0.01, reach).lengths) < 10 * len(path_frames(SPACE, 1.0, reach).lengths) + 10


def test_segments_say_how_many_frames_make_a_full_turn():
    circle = shapes.ellipse((0, 0), 10, exact=True)
    assert len(path_frames(circle, 1.0, 100, segments=32).origins) == 33
    assert len(path_frames(SQUARE, 1.0, 100, segments=32).origins) == 5


@pytest.mark.parametrize(
    ("along", "x", "y"),
    [
        (path(("move", (1, 2)), ("line", (5, 2))), (0, 1, 0), (0, 0, 1)),
        (path(("move", (1, 2, 3)), ("line", (1, 2, 9))), (1, 0, 0), (0, 1, 0)),
        (path(("move", (1, 2, 3)), ("line", (1, 2, -9))), (1, 0, 0), (0, -1, 0)),
        (path(("move", (0, 0, 0)), ("line", (3, 0, 4))), (0, 1, 0), (-0.8, 0, 0.6)),
    ],
)
def test_at_the_start_y_is_as_near_to_z_as_it_can_be(along, x, y):
    frame = start_frame(along)
    np.testing.assert_allclose(frame[:, 0], x, atol=1e-15)
    np.testing.assert_allclose(frame[:, 1], y, atol=1e-15)
    np.testing.assert_allclose(np.cross(x, y), frame[:, 2], atol=1e-15)
    np.testing.assert_allclose(path_frames(along, 0.1).axes[0], frame[:, :3].T, atol=1e-15)


def test_a_direction_is_found_where_the_path_begins_with_a_doubled_point():
    along = path(("move", (0, 0)), ("line", (0, 0)), ("cubic", (0, 0), (10, 0), (20, 20)))
    np.testing.assert_allclose(start_frame(along)[:, 2], (1, 0, 0), atol=1e-12)


@pytest.mark.parametrize("mitred", [True, False])
@pytest.mark.parametrize("closed", [SQUARE, shapes.ellipse((0, 0), 10, exact=True)])
def test_a_closed_path_ends_as_it_began(closed, mitred):
    frames = path_frames(closed, 0.01, 3, mitred=mitred)
    assert frames.closed
    np.testing.assert_allclose(frames.origins[-1], frames.origins[0], atol=1e-12)
    np.testing.assert_allclose(frames.axes[:, 1, 2], 1, atol=1e-12)
    if mitred or closed is not SQUARE:
        np.testing.assert_allclose(frames.axes[-1], frames.axes[0], atol=1e-9)


def test_a_closed_path_in_space_spreads_what_it_turned_by():
    angle = np.linspace(0, 2 * np.pi, 49)[:-1]
    waves = (np.sin(angle) + 2 * np.sin(2 * angle), np.cos(angle) - 2 * np.cos(2 * angle), -np.sin(3 * angle))
    points = 10 * np.column_stack(waves)  # a trefoil knot
    knot = Path.of_commands([("move", points[0]), ("spline", interpolated(points, ends="closed")), ("close",)])
    frames = path_frames(knot, 1e-4, 5)
    np.testing.assert_allclose(frames.axes[-1], frames.axes[0], atol=1e-9)
    across = 0.5 * (frames.axes[1:, 1] + frames.axes[:-1, 1])
    spin = (np.diff(frames.axes[:, 0], axis=0) * across).sum(axis=1)
    speed = spin.sum() / frames.length
    assert abs(spin.sum()) > 0.1
    np.testing.assert_allclose(spin / np.diff(frames.lengths), speed, rtol=0.02)


def test_a_corner_is_mitred_in_its_bisector_plane():
    bend = path(("move", (0, 0)), ("line", (10, 0)), ("line", (10, 10)))
    frames = path_frames(bend, 0.1)
    assert frames.corners.tolist() == [False, True, False]
    assert frames.turns[1] == pytest.approx(90)
    np.testing.assert_allclose(frames.axes[1], [(-1, 1, 0), (0, 0, 1), (np.sqrt(0.5), np.sqrt(0.5), 0)], atol=1e-12)
    np.testing.assert_allclose(frames.axes[2], [(-1, 0, 0), (0, 0, 1), (0, 1, 0)], atol=1e-12)


def test_a_corner_that_is_not_mitred_has_the_frames_before_and_after_it():
    bend = path(("move", (0, 0)), ("line", (10, 0)), ("line", (10, 10)))
    frames = path_frames(bend, 0.1, mitred=False)
    np.testing.assert_allclose(frames.lengths, [0, 10, 10, 20])
    np.testing.assert_allclose(frames.axes[:, 2], [(1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 1, 0)], atol=1e-12)
    assert frames.corners.tolist() == [False, True, True, False]


def test_steps_can_be_limited():
    straight = path(("move", (0, 0)), ("line", (10, 0)))
    np.testing.assert_allclose(path_frames(straight, 1.0, step=2.5).lengths, [0, 2.5, 5, 7.5, 10])


@pytest.mark.parametrize(
    ("along", "words"),
    [
        (Path(()), "empty"),
        (path(("move", (0, 0)), ("line", (1, 0)), ("move", (5, 5)), ("line", (6, 5))), "2 contours"),
        (path(("move", (1, 1)), ("line", (1, 1))), "point"),
        (path(("move", (0, 0)), ("line", (10, 0)), ("line", (0, 1))), "turns back by 174° at 10 mm"),
    ],
)
def test_what_nothing_can_be_drawn_along_is_refused(along, words):
    with pytest.raises(Refusal, match=words):
        path_frames(along, 0.1)


def test_a_cusp_within_a_curve_makes_no_endless_steps():
    cusp = path(("move", (0, 0)), ("cubic", (20, 20), (0, 20), (20, 0)))
    assert len(path_frames(cusp, 0.01, 5).origins) < 5000
