"""Half-spaces: what they bound is evaluated, what has no end says so."""

import itertools

import numpy as np
import pytest

from solidtree.model.document.nodes import Hull, Intersection, Minkowski
from solidtree.model.script import box, difference, halfspace, intersection, linear_array, mirror, sphere, union
from solidtree.model.solid.evaluate import Evaluator


def evaluated(node):
    return Evaluator().evaluate(node)


def six(size, middle=(0, 0, 0)):
    """The half-spaces of a cube."""
    sides = []
    for axis, sign in itertools.product(range(3), (1, -1)):
        normal = tuple(sign if i == axis else 0 for i in range(3))
        point = tuple(m - sign * size / 2 if i == axis else m for i, m in enumerate(middle))
        sides.append(halfspace(normal, point))
    return sides


def test_six_half_spaces_bound_a_cube():
    solid = evaluated(intersection(*six(10))).solid
    assert solid.volume() == pytest.approx(1000) and solid.bounding_box() == pytest.approx((-5, -5, -5, 5, 5, 5))
    far = evaluated(intersection(*six(2, (1e5, -3e4, 7)))).solid
    assert far.volume() == pytest.approx(8, rel=1e-6)
    turned = evaluated(intersection(*six(10)).turned(30, 40, 50).at(7)).solid
    assert turned.volume() == pytest.approx(1000)
    within = evaluated(union(intersection(*six(10)).turned(z=45), box(1).at(50))).solid
    assert within.volume() == pytest.approx(1001)


def test_a_difference_of_half_spaces_can_bound_too():
    first, *others = six(4)
    outside = [halfspace(tuple(-x for x in h.normal), h.point) for h in others]
    assert evaluated(difference(first, *outside)).solid.volume() == pytest.approx(64)


def test_a_tetrahedron_and_a_sliver():
    tetrahedron = intersection(
        halfspace((1, 0, 0)), halfspace((0, 1, 0)), halfspace((0, 0, 1)), halfspace((-1, -1, -1), (1, 0, 0))
    )
    assert evaluated(tetrahedron).solid.volume() == pytest.approx(1 / 6)
    # Two nearly parallel planes meet 10 m away.
    wedge = intersection(
        halfspace((0, 0, 1)), halfspace((0.0001, 0, -1), (0, 0, 1)), halfspace((-1, 0, 0), (5, 0, 0)),
        halfspace((1, 0, 0), (0, 0, 0)), halfspace((0, 1, 0)), halfspace((0, -1, 0), (0, 3, 0)),
    )  # fmt: skip
    assert evaluated(wedge).solid.volume() == pytest.approx(3 * (5 + 0.0001 * 25 / 2), rel=1e-9)


@pytest.mark.parametrize(
    "node",
    [
        halfspace(),
        halfspace().turned(10, 20, 30).at(5),
        union(box(1), halfspace()),
        difference(halfspace(), box(1)),
        Intersection(children=tuple(six(10)[:5])),
        intersection(halfspace((0, 0, 1)), halfspace((0, 0, -1), (0, 0, 5))),
        linear_array(halfspace(), 3),
        mirror(halfspace()),
        Hull(children=(box(1), halfspace())),
        Minkowski(children=(box(1), halfspace())),
        union(*(halfspace((1, i / 7, 0)) for i in range(130))),
    ],
)
def test_what_has_no_end_says_so(node):
    entry = evaluated(node)
    assert entry.solid is None
    assert any("without end" in problem.message or "half-spaces" in problem.message for problem in entry.problems)


def test_of_a_union_the_rest_is_seen_and_the_half_space_is_blamed():
    entry = evaluated(union(box(2), halfspace(), sphere(1).at(9)).at(5))
    assert entry.solid is None and [problem.place for problem in entry.problems] == [(1,)]
    assert entry.rest.bounding_box() == pytest.approx((5, -1, -1, 15, 2, 2), abs=0.02)


def test_two_half_spaces_that_exclude_each_other_are_empty():
    entry = evaluated(intersection(halfspace((0, 0, 1), (0, 0, 5)), halfspace((0, 0, -1))))
    assert entry.solid is not None and entry.solid.is_empty()


def test_nested_and_placed_in_every_way_it_cuts_alike():
    rng = np.random.default_rng(3)
    for _ in range(30):
        normal, point = rng.normal(size=3), rng.normal(size=3) * 3
        body = box(8, 9, 10).at(-4, -4.5, -5)
        plane = halfspace(tuple(normal), tuple(point))
        whole = evaluated(body).solid.volume()
        kept = evaluated(body & plane).solid.volume()
        assert evaluated(body - plane).solid.volume() == pytest.approx(whole - kept, abs=1e-9)
        assert evaluated(body & union(plane, sphere(0.1).at(100))).solid.volume() == pytest.approx(kept, abs=1e-9)
        # Counted on points of a grid: the share that the plane keeps.
        turned = (body & plane).turned(*rng.uniform(0, 360, 3)).scaled(2).at(*rng.normal(size=3) * 50)
        assert evaluated(turned).solid.volume() == pytest.approx(8 * kept, abs=1e-7)
        grid = (np.stack(np.meshgrid(*[np.arange(40) + 0.5] * 3), -1).reshape(-1, 3) / 40 - 0.5) * (8, 9, 10)
        share = float(((grid - point) @ normal > 0).mean())
        assert kept / whole == pytest.approx(share, abs=0.02)


def test_the_cut_face_belongs_to_the_half_space_however_it_is_hit():
    for depth in np.linspace(-4.9, 4.9, 7):
        solid = evaluated(box(10).at(-5, -5, -5) & halfspace((0, 0, 1), (0, 0, depth))).solid
        assert solid.volume() == pytest.approx(100 * (5 - depth), rel=1e-12)
        assert solid.bounding_box()[2] == depth
