"""Lofts: volumes by formula, corners that meet corners, holes, smooth and closed ones, refusals."""

import math

import numpy as np
import pytest

from solidtree.model.script import circle, difference, loft, path, polygon, rectangle
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.outlines.lofts import solid_of_loft


def made(node, tolerance=0.05):
    solid = solid_of_loft(node, tolerance)
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


def frustum(low, high, height):
    return height * (low + high + math.sqrt(low * high)) / 3


@pytest.mark.parametrize("turn", [(0, 0, 0), (90, 0, 0), (20, 30, 40)])
def test_from_a_square_to_a_smaller_one_it_is_a_frustum(turn):
    solid = made(loft(square(8), square(4).at(0, 0, 10)).turned(*turn))
    assert solid.volume() == pytest.approx(frustum(64, 16, 10))
    assert (solid.num_vert(), solid.num_tri(), solid.genus()) == (8, 12, 0)


def test_downwards_and_with_an_outline_turned_over_it_is_the_same():
    expected = frustum(64, 16, 10)
    assert made(loft(square(8), square(4).at(0, 0, -10))).volume() == pytest.approx(expected)
    assert made(loft(square(8), square(4).turned(x=180).at(0, 0, 10))).volume() == pytest.approx(expected)
    assert made(loft(square(8).turned(y=180), square(4).at(0, 0, 10))).volume() == pytest.approx(expected)
    corner = polygon([(0, 0), (4, 0), (0, 2)])
    prism = loft(corner, polygon([(0, 0), (4, 0), (0, -2)]).turned(x=180).at(0, 0, 10))
    assert made(prism).volume() == pytest.approx(40)


def test_aslant_it_is_a_prism_of_the_height():
    assert made(loft(square(4), square(4).at(7, 3, 10))).volume() == pytest.approx(160)


def test_between_circles_it_is_a_cone_within_the_tolerance():
    errors = [math.pi * frustum(36, 9, 10) - made(loft(circle(6), circle(3).at(0, 0, 10)), fine).volume()
              for fine in (0.5, 0.05, 0.005)]  # fmt: skip
    assert errors[0] > 3 * errors[1] > 9 * errors[2] > 0
    assert errors[2] < 0.005 * 2 * math.pi * 6 * 11


def test_from_a_square_to_a_circle_every_height_lies_between_them():
    solid = made(loft(square(10), circle(5).at(0, 0, 10)), 0.01)
    areas = [solid.slice(height).area() for height in (0.001, 5, 9.999)]
    assert areas[0] == pytest.approx(100, rel=1e-3)
    assert areas[2] == pytest.approx(25 * math.pi, rel=5e-3)
    assert areas[2] < areas[1] < areas[0]
    # Symmetric as both are: the corners of the square run to the circle's diagonals.
    x, y = np.array(solid.slice(5).to_polygons()[0]).T
    assert x.max() == pytest.approx(-x.min(), abs=0.02)
    assert (x * y).max() == pytest.approx(-(x * y).min(), abs=0.1)


def test_holes_meet_holes():
    solid = made(loft(difference(square(8), square(4)), difference(square(8), square(2)).at(0, 0, 10)))
    assert solid.volume() == pytest.approx(640 - frustum(16, 4, 10))
    assert solid.genus() == 1


def test_of_several_holes_each_meets_the_one_nearest_to_it():
    plate = difference(rectangle(20, 8, centred=True), square(2).at(-6), square(2.2).at(6))
    other = difference(rectangle(20, 8, centred=True), square(2.2).at(-6), square(2).at(6))
    solid = made(loft(plate, other.at(0, 0, 10)))
    assert solid.genus() == 2
    assert solid.volume() == pytest.approx(1600 - 2 * frustum(4, 4.84, 10))


@pytest.mark.parametrize("start", range(4))
def test_where_the_points_of_an_outline_begin_makes_no_difference(start):
    corners = [(-4, -4), (4, -4), (4, 4), (-4, 4)]
    other = polygon(corners[start:] + corners[:start])
    solid = made(loft(square(8), other.at(0, 0, 10)))
    assert solid.volume() == pytest.approx(640)
    assert solid.num_vert() == 8


def test_a_turned_outline_meets_the_nearest_corners():
    """By 90 degrees a square is what it was; by 30 the sides are ruled, hyperbolic paraboloids."""
    assert made(loft(square(8), square(8).turned(z=90).at(0, 0, 10))).volume() == pytest.approx(640)
    heights = np.linspace(0, 1, 20001)
    corner = 4 * np.sqrt(2) * np.abs(1 - heights + heights * np.exp(1j * np.pi / 6))
    expected = 10 * np.trapezoid(2 * corner**2, heights)  # every level is a square
    errors = [abs(made(loft(square(8), square(8).turned(z=30).at(0, 0, 10)), fine).volume() - expected)
              for fine in (0.5, 0.05, 0.005)]  # fmt: skip
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 0.005 * 320


def test_through_three_outlines_it_is_straight_or_smooth():
    outlines = (circle(4), circle(8).at(0, 0, 10), circle(4).at(0, 0, 20))
    straight, smooth = made(loft(*outlines), 0.005), made(loft(*outlines, smooth=True), 0.005)
    assert straight.volume() == pytest.approx(2 * math.pi * frustum(16, 64, 10), rel=2e-3)
    # The natural cubic through 4, 8, 4 at even steps: 4 + 6 t - 2 t³ over the first half.
    t = np.linspace(0, 1, 2001)
    assert smooth.volume() == pytest.approx(2 * 10 * math.pi * np.trapezoid((4 + 6 * t - 2 * t**3) ** 2, t), rel=2e-3)
    middle = smooth.slice(10).area()
    assert middle == pytest.approx(64 * math.pi, rel=5e-3)


def test_a_smooth_loft_of_two_is_a_straight_one():
    straight, smooth = (made(loft(square(8), square(4).at(0, 0, 10), smooth=s)).volume() for s in (False, True))
    assert smooth == pytest.approx(straight)


def around(count, smooth):
    places = [square(4).turned(x=90).at(20).turned(z=360 * i / count) for i in range(count)]
    return loft(*places, closed=True, smooth=smooth)


def test_a_closed_one_is_a_ring():
    solid = made(around(6, False))
    assert solid.genus() == 1
    # A hexagon's ring, whose corners are 18 and 22 from the axis: the areas of hexagons times the height.
    assert solid.volume() == pytest.approx(4 * 1.5 * math.sqrt(3) * (22**2 - 18**2))
    smooth = made(around(6, True), 0.005)
    assert smooth.genus() == 1
    assert smooth.volume() == pytest.approx(16 * 2 * math.pi * 20, rel=0.01)


def test_outlines_that_turn_round_a_bend_face_the_way_it_goes():
    bend = [square(4).at(10).turned(y=-angle) for angle in (0, 45, 90, 135, 180)]
    solid = made(loft(*bend))
    chord = 20 * math.sin(math.radians(22.5))
    assert solid.volume() == pytest.approx(4 * chord * math.cos(math.radians(22.5)) * 16, rel=1e-6)
    assert solid.genus() == 0


@pytest.mark.parametrize(
    ("node", "words"),
    [
        (loft(square(4), difference(square(4), square(2)).at(0, 0, 5)), "outline 2 has 1 border and 1 hole"),
        (loft(square(4), path([("move", (0, 0)), ("line", (1, 0)), ("line", (1, 1))]).at(0, 0, 5)), "open"),
        (loft(square(4), (square(2) - square(3)).at(0, 0, 5)), "outline 2 encloses nothing"),
        (loft(square(4), square(4).at(9)), "nothing lies between"),
        (loft(square(4), square(4)), "nothing lies between"),
        (loft(square(4), square(4).turned(y=60).at(0, 0, 1)), "outlines 1 and 2 cross each other"),
        (loft(square(4), square(4).at(0, 0, 5), closed=True), "three outlines"),
        (loft(square(4), square(4), square(4).at(0, 0, 5), smooth=True), "outlines 1 and 2 lie on one another"),
    ],
)
def test_what_cannot_be_made_is_told_in_words(node, words):
    assert words in fault(node)
