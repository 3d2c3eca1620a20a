"""How deep solids are in each other, by formula; the move that is told does take them apart."""

import numpy as np
import pytest
from manifold3d import Manifold
from moving_bodies import block, body

from solidtree.model.document.errors import Refusal
from solidtree.model.proximity.penetration import penetration, separated


def shared_after(one, other, way, share):
    return (one.solid.translate(share * way.move) ^ other.solid).volume()


def test_boxes_leave_by_the_shortest_side():
    one, other = body(block(10, 10, 10)), body(block(10, 10, 10, (8, 1, 3)))
    way = penetration(one, other)
    assert way.exact and way.depth == pytest.approx(2, abs=1e-9) and way.direction == pytest.approx([-1, 0, 0])
    assert separated(one, other, way) and shared_after(one, other, way, 0.99) > 0
    back = penetration(other, one)
    assert back.depth == pytest.approx(2, abs=1e-9) and back.direction == pytest.approx([1, 0, 0])


def test_turned_boxes_leave_by_a_direction_of_two_edges_where_that_is_shortest():
    """Two long bars, crossed and turned on edge, meet edge to edge: the way out is across both."""
    bar = block(30, 2, 2, (-15, -1, -1)).rotate((45, 0, 0))
    one, other = body(bar), body(bar.rotate((0, 0, 90)).translate((0, 0, 2 * np.sqrt(2) - 0.3)))
    way = penetration(one, other)
    assert (
        way.exact and way.depth == pytest.approx(0.3, abs=1e-9) and way.direction == pytest.approx([0, 0, -1], abs=1e-9)
    )
    assert separated(one, other, way)


def test_balls_leave_along_the_line_of_their_centres():
    one, other = body(Manifold.sphere(10, 128)), body(Manifold.sphere(7, 128).translate((9, 8, 4)))
    way = penetration(one, other)
    centre = np.array([9.0, 8.0, 4.0])
    assert way.depth == pytest.approx(17 - np.linalg.norm(centre), abs=0.02)
    assert way.direction @ centre == pytest.approx(-np.linalg.norm(centre), rel=1e-3)
    assert separated(one, other, way)


def test_the_least_of_many_supports_is_found():
    """No direction of a dense set separates two convex solids by less."""
    rng = np.random.default_rng(4)
    hulls = [body(Manifold.hull_points(rng.normal(size=(30, 3)) * 5 + shift)) for shift in ([0, 0, 0], [3, 2, 1])]
    way = penetration(*hulls)
    directions = rng.normal(size=(20_000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    reach = (hulls[1].vertices @ directions.T).max(axis=0) - (hulls[0].vertices @ directions.T).min(axis=0)
    assert way.exact and way.depth <= reach.min() + 1e-9 and way.depth == pytest.approx(reach.min(), rel=0.02)
    assert separated(*hulls, way)


def test_a_pin_that_is_off_its_hole_goes_back_into_it():
    pin = body(Manifold.cylinder(20, 4, 4, 96).translate((1, 0, -10)))
    ring = body(Manifold.cylinder(5, 10, 10, 96) - Manifold.cylinder(6, 4.5, 4.5, 96).translate((0, 0, -0.5)))
    way = penetration(pin, ring)
    assert (
        not way.exact
        and way.depth == pytest.approx(0.5, abs=1e-3)
        and way.direction == pytest.approx([-1, 0, 0], abs=0.05)
    )
    assert separated(pin, ring, way) and shared_after(pin, ring, way, 0.98) > 0


def test_a_block_in_the_corner_of_a_pocket_leaves_both_walls():
    block_, tray = body(block(4, 4, 4, (4, 4, 8))), body(block(20, 20, 20) - block(10, 10, 21, (5, 5, -0.5)))
    way = penetration(block_, tray)
    assert way.depth <= np.sqrt(2) + 1e-3 and separated(block_, tray, way)


def test_what_shares_nothing_has_no_depth_and_what_is_open_is_refused():
    one = body(block(1, 1, 1))
    assert penetration(one, body(block(1, 1, 1, (1, 0, 0)))) is None
    assert penetration(one, body(block(1, 1, 1, (5, 0, 0)))) is None
    opened = body(block(1, 1, 1), "lid")
    opened.solid = None
    with pytest.raises(Refusal, match="“lid” is not closed"):
        penetration(one, opened)
