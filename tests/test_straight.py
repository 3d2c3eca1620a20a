"""Bodies that are moved until they meet others: by formula, and by the volume that they share where they stopped."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold

from solidtree.model.partition import native as partition_native
from solidtree.model.proximity import native
from solidtree.model.proximity.bodies import Body, relation
from solidtree.model.proximity.straight import Sweep
from solidtree.model.solid.results import arrays_of

CUBE = Manifold.cube((10, 10, 10))


@pytest.fixture(params=["compiled", "numpy"], autouse=True)
def way(request, monkeypatch):
    """Both ways, where there are two."""
    if request.param == "compiled" and not partition_native.available():
        pytest.skip("the compiled extension is not here")
    if request.param == "numpy":
        monkeypatch.setattr(native, "available", lambda: False)
    return request.param


def body(solid: Manifold) -> Body:
    return Body("", *arrays_of(solid.to_mesh64()), solid)


def moved(solid: Manifold, by) -> Body:
    return body(solid.translate([float(c) for c in by]))


def test_a_ball_stops_at_another_one():
    ball = Manifold.sphere(2, 24)  # with a corner on the x axis
    stop = Sweep(body(ball), [moved(ball, (10, 0, 0))]).stop((0, 0, 0), (20, 0, 0))
    assert (stop.way, stop.other) == (pytest.approx(6, abs=1e-9), 0)
    assert stop.point == pytest.approx((8, 0, 0), abs=1e-9)
    assert Sweep(body(ball), [moved(ball, (10, 0, 0))]).stop((0, 0, 0), (5.9, 0, 0)) is None
    assert Sweep(body(ball), [moved(ball, (10, 0, 0))]).stop((1, 0, 0), (0, 20, 0)) is None


@pytest.mark.parametrize("offset", [(0, 0, 0), (3, -2, 0), (0, 4, 0), (9.5, 9.5, 0)])
def test_boxes_stop_face_to_face_however_they_are_aligned(offset):
    """Also where corners meet corners and sides lie upon sides."""
    sweep = Sweep(moved(CUBE, (*offset[:2], 25)), [body(CUBE)])
    stop = sweep.stop((0, 0, 0), (0, 0, -40))
    assert stop.way == pytest.approx(15, abs=1e-9) and stop.normal == pytest.approx((0, 0, 1))
    pushed = sweep.stop((0, 0, -15), (0, 0, -1))
    assert pushed.way == pytest.approx(0, abs=1e-9)


def test_what_is_flush_slides_and_lifts_freely():
    floor = Manifold.cube((100, 100, 5)).translate((-50, -50, -5))
    wall = CUBE.translate((-10, 0, 0))
    sweep = Sweep(body(CUBE), [body(floor), body(wall)])
    for free in ((20, 0, 0), (0, 20, 0), (0, -3, 0), (0, 0, 7), (5, 6, 0), (5, 6, 7)):
        assert sweep.stop((0, 0, 0), free) is None
    for blocked, other in (((0, 0, -1), 0), ((-1, 0, 0), 1), ((-1, 5, 3), 1), ((4, 0, -1e-3), 0)):
        stop = sweep.stop((0, 0, 0), blocked)
        assert (stop.way, stop.other) == (pytest.approx(0, abs=1e-9), other)


def test_passing_a_corner_that_only_touches_is_free():
    sweep = Sweep(moved(CUBE, (10, 10, 0)), [body(CUBE)])
    for free in ((-15, 0, 0), (0, -15, 0), (-15, 0, 3)):
        assert sweep.stop((0, 0, 0), free) is None
    assert sweep.stop((0, 0, 0), (-1, -1, 0)).way == pytest.approx(0, abs=1e-9)


def test_sides_that_cross_stop_each_other():
    roof = Manifold.cube((30, 4, 4), True).rotate((45, 0, 0))  # its ridges run along x
    other = Manifold.cube((4, 30, 4), True).rotate((0, 45, 0)).translate((0, 0, 20))
    stop = Sweep(body(other), [body(roof)]).stop((0, 0, 0), (0, 0, -30))
    assert stop.way == pytest.approx(20 - 4 * np.sqrt(2), abs=1e-9)
    assert stop.point == pytest.approx((0, 0, 2 * np.sqrt(2)), abs=1e-9) and stop.normal == pytest.approx((0, 0, 1))


def test_what_overlaps_at_first_may_be_taken_out():
    sweep = Sweep(moved(CUBE, (5, 0, 0)), [body(CUBE), moved(CUBE, (30, 0, 0))])
    assert sweep.stop((0, 0, 0), (-3, 0, 0)) is None
    assert sweep.stop((0, 0, 0), (40, 0, 0)).other == 1


def test_a_thin_wall_is_not_jumped_over():
    wall = Manifold.cube((1e-3, 50, 50), True).translate((500, 0, 0))
    assert Sweep(body(Manifold.cube((1, 1, 1), True)), [body(wall)]).stop((0, 0, 0), (1e4, 0, 0)).way == pytest.approx(
        500 - 0.5 - 5e-4, abs=1e-6
    )


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 10**6))
def test_at_the_stop_nothing_is_shared_and_a_little_farther_something_is(seed):
    rng = np.random.default_rng(seed)
    kinds = (Manifold.sphere(3, 12), Manifold.cylinder(6, 2, 1, 8, True), Manifold.cube((4, 4, 4), True)
             - Manifold.cube((2, 2, 5), True))  # fmt: skip
    one, other = (kinds[k].rotate(rng.uniform(0, 360, 3).tolist()) for k in rng.integers(0, 3, 2))
    start = 15 * rng.normal(size=3) / 2
    start *= 15 / np.linalg.norm(start)
    direction = rng.normal(size=3) - start
    stop = Sweep(moved(one, start), [body(other)]).stop((0, 0, 0), 2 * direction)
    if stop is None:
        for part in np.linspace(0, 2, 80):
            assert (one.translate((start + part * direction).tolist()) ^ other).volume() < 1e-6
        return
    along = direction / np.linalg.norm(direction)
    at = relation(moved(one, start + stop.way * along), body(other))
    assert at.kind == "touching" or (at.kind == "apart" and at.gap < 1e-7)
    assert along @ stop.normal < 0
    assert (one.translate((start + (stop.way + 0.05) * along).tolist()) ^ other).volume() > 0


def test_nothing_holds_back_nothing():
    empty = Body("", np.zeros((0, 3)), np.zeros((0, 3), int))
    assert Sweep(empty, [body(CUBE)]).stop((0, 0, 0), (1, 0, 0)) is None
    assert Sweep(body(CUBE), [empty]).stop((0, 0, 0), (1, 0, 0)) is None
    assert Sweep(body(CUBE), []).stop((0, 0, 0), (1, 0, 0)) is None
    assert Sweep(body(CUBE), [moved(CUBE, (10, 0, 0))]).stop((0, 0, 0), (0, 0, 0)) is None
