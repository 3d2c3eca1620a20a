"""Sweeps and pipes: volumes by formula, mitres, rings, paths too tight or crossing themselves, refusals."""

import math

import numpy as np
import pytest
from scipy.spatial import KDTree

from solidtree.model.document.from_outlines import Sweep
from solidtree.model.document.outlines import Bezier
from solidtree.model.outline.paths import path_of
from solidtree.model.outline.sweeping import path_frames, start_frame
from solidtree.model.path.shapes import arc
from solidtree.model.script import circle, difference, path, pipe, rectangle, sweep
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.failure import NoSolid
from solidtree.model.solid.outlines import sweeps
from solidtree.model.solid.outlines.sweeps import solid_of_pipe, solid_of_sweep


def line(*places, close=False):
    return path([("move", places[0]), *(("line", place) for place in places[1:]), *([("close",)] if close else [])])


def quarter(radius):
    """From the origin along x, then left."""
    return path(arc((0, radius), radius, -90, 90).commands())


UP = line((0, 0, 0), (0, 0, 10))
BEND = line((0, 0), (30, 0), (30, 40))
FRAME = line((0, 0), (30, 0), (30, 40), (0, 40), close=True)


def made(node, tolerance=0.05):
    solid = (solid_of_sweep if isinstance(node, Sweep) else solid_of_pipe)(node, tolerance)
    entry = Evaluator().evaluate(node, tolerance)
    assert entry.solid is not None, entry.problems
    assert entry.solid.volume() == pytest.approx(solid.volume())
    return solid


def fault(node):
    entry = Evaluator().evaluate(node)
    assert entry.solid is None
    (problem,) = entry.problems
    return problem.message


def square(size):
    return rectangle(size, size, centred=True)


# A prism and what is made like one


@pytest.mark.parametrize("end", [(10, 0, 0), (0, 10, 0), (0, 0, 10), (0, 0, -10), (-6, 0, 8), (2, 3, 6)])
def test_along_a_line_it_is_a_prism(end):
    length = float(np.linalg.norm(end))
    solid = made(sweep(rectangle(4, 3), line((0, 0, 0), end)))
    assert solid.volume() == pytest.approx(12 * length)
    assert solid.surface_area() == pytest.approx(24 + 14 * length)
    assert solid.genus() == 0


def test_along_z_the_outline_stands_as_it_lies():
    assert made(sweep(rectangle(4, 3), UP)).bounding_box() == pytest.approx((0, 0, 0, 4, 3, 10))


def test_along_x_the_outline_stands_upright():
    """y up, x to the left hand of who goes along the path."""
    assert made(sweep(rectangle(4, 3), line((0, 0), (10, 0)))).bounding_box() == pytest.approx((0, 0, 0, 10, 4, 3))


def test_holes_go_through():
    solid = made(sweep(difference(square(6), square(2), rectangle(1, 1).at(1.5, 1.5)), UP))
    assert solid.volume() == pytest.approx((36 - 4 - 1) * 10)
    assert solid.genus() == 2


def test_an_outline_of_several_islands_makes_several_bars():
    solid = made(sweep(square(2).at(-5) + square(2).at(5), BEND))
    assert len(solid.decompose()) == 2


@pytest.mark.parametrize("scale", [0.5, 2])
def test_an_end_scale_makes_a_frustum(scale):
    solid = made(sweep(square(4), UP, end_scale=scale))
    assert solid.volume() == pytest.approx(16 * 10 * (1 + scale + scale**2) / 3)


def test_an_end_scale_of_nothing_makes_a_tip():
    solid = made(sweep(square(4), UP, end_scale=0))
    assert solid.volume() == pytest.approx(16 * 10 / 3)
    assert solid.num_vert() == 5
    assert made(sweep(square(4) - square(2), UP, end_scale=0)).volume() == pytest.approx(12 * 10 / 3)


def test_a_twist_keeps_the_area_within_the_tolerance():
    errors = [abs(made(sweep(square(4), UP, twist=90), fine).volume() - 160) for fine in (0.5, 0.05, 0.005)]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 0.005 * 160
    low, high = np.reshape(made(sweep(rectangle(8, 2, centred=True), UP, twist=90)).slice(9.999).bounds(), (2, 2))
    np.testing.assert_allclose(high - low, (2, 8), atol=0.01)


# Along curves


def test_along_an_arc_it_is_as_pappus_says_within_the_tolerance():
    expected = math.pi * 9 * 20 * math.pi / 2
    errors = []
    for tolerance in (0.2, 0.02, 0.002):
        solid = made(sweep(circle(3), quarter(20)), tolerance)
        errors.append(expected - solid.volume())
        assert 0 < errors[-1] < tolerance * 6 * math.pi * 20 * math.pi / 2  # what the tolerance allows on all sides
    assert errors[0] > 5 * errors[1] > 25 * errors[2]


def test_no_point_of_it_is_further_from_the_torus_than_the_tolerance():
    tolerance = 0.02
    solid = made(sweep(circle(3), quarter(20)), tolerance)
    vertices = solid.to_mesh64().vert_properties[:, :3]
    triangles = solid.to_mesh64().tri_verts
    middles = vertices[triangles].mean(axis=1)
    inner = (middles[:, 0] > 0.1) & (middles[:, 1] < 19.9)
    from_axis = np.hypot(middles[inner, 0], middles[inner, 1] - 20) - 20
    assert (3 - np.hypot(from_axis, middles[inner, 2])).max() < tolerance


def test_a_closed_path_makes_a_ring():
    solid = made(sweep(square(2), circle(20)), 0.005)
    assert solid.genus() == 1
    assert solid.volume() == pytest.approx(4 * 2 * math.pi * 20, rel=1e-3)


def test_segments_say_how_many_steps_a_turn_has():
    solid = made(sweep(square(2), circle(20), segments=24))
    assert solid.num_tri() == 24 * 8


def test_in_a_mitre_the_outline_meets_itself():
    solid = made(sweep(square(4), BEND))
    assert solid.volume() == pytest.approx(16 * 70)
    assert solid.bounding_box() == pytest.approx((0, -2, -2, 32, 40, 2))
    assert solid.num_tri() == 2 * 2 + 8 * 2


def test_a_closed_path_with_corners_is_a_frame():
    solid = made(sweep(square(4), FRAME))
    assert solid.volume() == pytest.approx(34 * 44 * 4 - 26 * 36 * 4)
    assert solid.genus() == 1


@pytest.mark.parametrize("twist", [90, 180, 360, -90])
def test_a_closed_sweep_may_be_twisted_until_it_fits_again(twist):
    solid = made(sweep(square(4), circle(20), twist=twist), 0.01)
    assert solid.genus() == 1
    assert solid.volume() == pytest.approx(16 * 40 * math.pi, rel=5e-3)


# Where the bar meets itself


def test_where_the_bend_is_tighter_than_the_outline_is_wide_the_inside_is_filled():
    bend = path(arc((0, 2), 2, -90, 200).commands())
    solid = made(sweep(square(8), bend), 0.01)
    # Its outer side covers 200 degrees up to 2 + 4 from the axis of the bend; its inner side the rest, up to 4 - 2.
    assert solid.volume() == pytest.approx(8 * math.pi * (200 * 6**2 + 160 * 2**2) / 360, rel=2e-3)
    assert solid.genus() == 0


def test_an_outline_that_touches_the_axis_of_the_bend_makes_a_cylinder():
    solid = made(sweep(rectangle(8, 5).at(-3), path(arc((0, 5), 5, -90, 90).commands())), 0.005)
    assert solid.volume() == pytest.approx(5 * math.pi / 4 * 8**2, rel=2e-3)


def test_a_path_that_crosses_itself_is_joined_there():
    cross = line((0, 0), (40, 0), (40, 20), (20, 20), (20, -20))
    solid = made(sweep(square(4), cross))
    assert solid.volume() == pytest.approx(16 * (40 + 20 + 20 + 40) - 4**3)
    assert solid.genus() == 1


def test_a_mitre_that_has_no_room_says_where():
    hook = line((0, 0), (30, 0), (30, 3), (0, 3))
    assert "at 30 mm of its length the path bends too tightly" in fault(sweep(square(20), hook))


# Pipes


def test_a_straight_pipe_is_a_cylinder():
    solid = made(pipe(UP, 3), 0.001)
    assert solid.volume() == pytest.approx(math.pi * 9 * 10, rel=1e-3)


def test_segments_of_a_pipe_are_those_of_its_circle():
    solid = made(pipe(UP, 3, segments=6))
    assert solid.volume() == pytest.approx(1.5 * math.sqrt(3) * 9 * 10)
    assert solid.num_vert() == 12


def test_a_bore_makes_a_tube():
    solid = made(pipe(UP, 3, bore=2), 0.001)
    assert solid.volume() == pytest.approx(math.pi * (9 - 4) * 10, rel=1e-3)
    assert solid.genus() == 1
    assert made(pipe(BEND, 3, bore=2)).genus() == 1


def test_rounded_ends_are_half_balls():
    solid = made(pipe(UP, 3, rounded=True), 0.001)
    assert solid.volume() == pytest.approx(math.pi * 9 * 10 + 4 / 3 * math.pi * 27, rel=1e-3)
    assert solid.bounding_box()[2] == pytest.approx(-3)
    assert made(pipe(UP, 3, bore=1, rounded=True)).genus() == 1


def test_corners_of_a_pipe_are_round():
    solid = made(pipe(BEND, 3), 0.001)
    wedge = 2 / 3 * 3**3  # of a cylinder between its end and a plane at 45 degrees through the middle of that
    lune = math.pi * 3**3 / 3  # a quarter of a ball
    assert solid.volume() == pytest.approx(math.pi * 9 * 70 - 2 * wedge + lune, rel=1e-3)
    assert solid.bounding_box()[3] == pytest.approx(33)
    assert solid.genus() == 0


def test_a_closed_pipe_is_a_ring_and_with_corners_too():
    torus = made(pipe(circle(20), 3), 0.002)
    assert torus.volume() == pytest.approx(2 * math.pi**2 * 20 * 9, rel=2e-3)
    assert torus.genus() == 1
    assert made(pipe(FRAME, 3)).genus() == 1
    assert made(pipe(FRAME, 3, bore=1), 0.01).volume() < made(pipe(FRAME, 3), 0.01).volume() - math.pi * 120


def test_a_pipe_in_space_has_the_volume_of_its_length():
    curve = Bezier(points=((0, 0, 0), (0, 0, 40), (40, 0, 40), (40, 40, 80)))
    solid = made(pipe(curve, 2, bore=1), 0.002)
    assert solid.volume() == pytest.approx(math.pi * 3 * path_of(curve).length(), rel=2e-3)


def test_a_pipe_goes_back_the_way_it_came():
    solid = made(pipe(line((0, 0), (20, 0), (10, 0)), 3), 0.005)
    assert solid.volume() == pytest.approx(math.pi * 9 * 20 + 2 / 3 * math.pi * 27, rel=2e-3)


@pytest.mark.parametrize(
    "along",
    [
        Bezier(points=((0, 0, 0), (30, 0, 0), (-15, 4, 0), (12, 12, 6))),  # bends tighter than the pipe is wide
        line((0, 0, 0), (20, 0, 0), (3, 5, 0), (14, -6, 2)),  # crosses itself, with corners of 150 degrees and more
    ],
)
def test_a_rounded_pipe_is_all_that_is_within_its_radius_of_the_path(along):
    solid = made(pipe(along, 3, rounded=True), 0.02)
    points = np.random.default_rng(5).uniform((-8, -12, -6), (26, 18, 12), (40_000, 3))
    spine = path_frames(path_of(along), 1e-3, 1.0, step=0.1, mitred=False).origins
    distance = KDTree(spine).query(points)[0]
    assert solid.volume() == pytest.approx((distance < 3).mean() * 34 * 30 * 18, rel=0.03)
    away = np.abs(distance - 3) > 0.05
    chosen = np.concatenate((points[away & (distance < 3)][:300], points[away & (distance > 3)][:300]))
    hits = [len(solid.ray_cast(tuple(p), tuple(p + np.array((1.0, 2.0, 200.0))))) % 2 for p in chosen]
    np.testing.assert_array_equal(hits, [1] * 300 + [0] * 300)


def test_the_outline_stands_where_the_start_frame_says():
    along = line((3, 4, 5), (9, 7, 7))
    frame = start_frame(path_of(along))
    low = made(sweep(rectangle(4, 3), along)).to_mesh64().vert_properties[:, :3]
    corners = np.array([(0, 0), (4, 0), (4, 3), (0, 3)]) @ frame[:, :2].T + frame[:, 3]
    assert (KDTree(low).query(corners)[0] < 1e-12).all()


# Refusals


@pytest.mark.parametrize(
    ("node", "words"),
    [
        (sweep(BEND, UP), "open"),
        (sweep(square(2), path([])), "empty"),
        (sweep(square(2) - square(3), UP), "encloses nothing"),
        (sweep(square(2), square(9) - circle(2)), "contours"),
        (sweep(square(2), circle(20), twist=45), "turned by 45°"),
        (sweep(square(2), circle(20), end_scale=2), "end scale of 1"),
        (sweep(square(2), line((0, 0), (10, 0), (0, 0.5))), "turns back by 177° at 10 mm"),
        (sweep(circle(10), circle(1000), tolerance=1e-7), "coarser"),
        (pipe(UP, 2, bore=2), "smaller than the radius"),
        (pipe(line((1, 1), (1, 1)), 2), "point"),
    ],
)
def test_what_cannot_be_made_is_told_in_words(node, words):
    assert words in fault(node)


def test_too_many_points_are_refused_before_they_are_made(monkeypatch):
    monkeypatch.setattr(sweeps, "_placed", None)
    for node in (sweep(circle(1e4, segments=4096), quarter(1e9)), pipe(quarter(1e9), 1e4, tolerance=1e-3)):
        (problem,) = Evaluator().evaluate(node, 0.05).problems
        assert "take a coarser" in problem.message
    with pytest.raises(NoSolid, match=r"^Sweep: it would have [\d,]+ points; take a coarser tolerance"):
        solid_of_sweep(sweep(circle(1e4, segments=4096), quarter(1e6)), 0.05)
    with pytest.raises(NoSolid, match=r"^Pipe: it would have [\d,]+ points; take a coarser tolerance"):
        solid_of_pipe(pipe(quarter(1e5), 1e4), 0.001)
