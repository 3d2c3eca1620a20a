"""Evaluation: volumes by formula, the memo by counting, failures as values."""

import math

import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.from_outlines import Extrude, Revolve
from solidtree.model.document.nodes import Broken, Instance, LinearArray, PolarArray, Union
from solidtree.model.document.outlines import Circle, Polygon, Rectangle
from solidtree.model.document.primitives import Box, Cone, Cylinder, Halfspace, Polyhedron, Sphere, Torus
from solidtree.model.script import (
    box,
    cylinder,
    difference,
    hull,
    intersection,
    linear_array,
    minkowski,
    mirror,
    polar_array,
    sphere,
    union,
)  # fmt: skip
from solidtree.model.solid.entry import Superseded
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import evaluate_document

CUBE_POINTS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
CUBE_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def volume(node, tolerance=0.05):
    entry = Evaluator().evaluate(node, tolerance)
    assert entry.solid is not None, entry.problems
    return entry.solid.volume()


def fault(node):
    """The one complaint about a node that fails, and the way to who is to blame."""
    entry = Evaluator().evaluate(node)
    assert entry.solid is None
    (problem,) = entry.problems
    return problem.place, problem.message


@pytest.mark.parametrize(
    ("node", "expected"),
    [
        (Box(size=(2, 3, 4)), 24),
        (Sphere(radius=10), 4 / 3 * math.pi * 1000),
        (Cylinder(radius=5, height=7), math.pi * 25 * 7),
        (Cone(radius=6, top_radius=2, height=9), math.pi * 9 / 3 * (36 + 12 + 4)),
        (Cone(radius=0, top_radius=4, height=6), math.pi * 16 * 6 / 3),
        (Torus(radius=12, tube_radius=3), 2 * math.pi**2 * 12 * 9),
        (Revolve(children=(Rectangle(width=2, height=3).at(4),)), math.pi * (36 - 16) * 3),
        (Revolve(children=(Circle(radius=2).at(9),), angle=90), 2 * math.pi**2 * 9 * 4 / 4),
        (Extrude(children=(Circle(radius=4),), height=5, top_scale=0), math.pi * 16 * 5 / 3),
    ],
)
def test_curved_volumes_converge_to_their_formula(node, expected):
    errors = [abs(volume(node, tolerance) - expected) / expected for tolerance in (0.2, 0.02, 0.002)]
    if errors[0] < 1e-12:
        return
    assert errors[2] < 2e-3
    assert errors[1] < errors[0] / 3 and errors[2] < errors[1] / 3


def test_polyhedra_of_flat_faces_convex_or_not():
    assert volume(Polyhedron(points=CUBE_POINTS, faces=CUBE_FACES)) == pytest.approx(1)
    inside_out = tuple(tuple(reversed(face)) for face in CUBE_FACES)
    assert volume(Polyhedron(points=CUBE_POINTS, faces=inside_out)) == pytest.approx(1)
    # An L-shaped prism: two concave hexagons and six walls.
    outline = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
    points = tuple((x, y, z) for z in (0, 2) for x, y in outline)
    walls = tuple((i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6))
    for turn in range(6):
        ring = tuple((i + turn) % 6 for i in range(6))
        faces = (tuple(reversed(ring)), tuple(i + 6 for i in ring), *walls)
        assert volume(Polyhedron(points=points, faces=faces).turned(40, 50, 60)) == pytest.approx(10)


def test_outlines_with_holes_are_filled_where_the_winding_is_odd():
    points = ((0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (3, 1), (3, 3), (1, 3))
    plate = Polygon(points=points, loops=((0, 1, 2, 3), (4, 5, 6, 7)))
    assert volume(Extrude(children=(plate,), height=2)) == pytest.approx(2 * (16 - 4))


def test_operations():
    assert volume(union(box(2), box(2).at(1))) == pytest.approx(12)
    assert volume(difference(box(4), box(1), box(1).at(3, 3, 3))) == pytest.approx(62)
    assert volume(intersection(box(4), box(4).at(1, 1, 1), box(4).at(2, 2, 2))) == pytest.approx(8)
    assert volume(hull(box(1), box(1).at(0, 0, 9))) == pytest.approx(10)
    assert volume(minkowski(box(1, 2, 3), box(1))) == pytest.approx(24)
    assert volume(linear_array(box(1), 4, (0, 3, 0))) == pytest.approx(4)
    assert volume(polar_array(box(1).at(3), 5)) == pytest.approx(5)
    assert volume(polar_array(box(1).at(3), 3, 90)) == pytest.approx(3)
    assert volume(mirror(box(1).at(1), (1, 0, 0), (2, 0, 0))) == pytest.approx(2)
    assert volume(mirror(box(1).at(1), keep=False)) == pytest.approx(1)


def test_a_part_turn_goes_from_the_first_copy_to_the_last():
    bounds = Evaluator().evaluate(PolarArray(children=(box(1).at(9),), count=2, angle=90)).solid.bounding_box()
    assert bounds == pytest.approx((-1, 0, 0, 10, 10, 1))


def test_placements_apply_in_order():
    placed = box(1).at(2).turned(z=90).scaled(2, 1, 1).mirrored((0, 1, 0))
    assert Evaluator().evaluate(placed).solid.bounding_box() == pytest.approx((-2, -3, 0, 0, -2, 1))
    inside = union(box(1).at(2).turned(z=90), box(1).at(5)).turned(z=-90)
    assert Evaluator().evaluate(inside).solid.bounding_box() == pytest.approx((0, -6, 0, 3, 1, 1))


def test_the_tolerance_is_divided_by_the_scale_above():
    plain = Evaluator().evaluate(sphere(10), 0.05).solid.num_tri()
    assert Evaluator().evaluate(sphere(1).scaled(10), 0.05).solid.num_tri() >= plain
    assert Evaluator().evaluate(union(sphere(1)).scaled(10), 0.05).solid.num_tri() >= plain


def test_equal_parts_are_evaluated_once():
    evaluator = Evaluator()
    evaluator.evaluate(union(*(sphere(3).at(10 * i) for i in range(40))))
    assert evaluator.evaluations == 2  # the sphere, the union
    evaluator.evaluate(union(*(sphere(3).at(10 * i).named(f"ball {i}").coloured("red") for i in range(40))))
    assert evaluator.evaluations == 2


def test_a_change_evaluates_the_way_to_the_root_and_no_more():
    parts = [union(sphere(2).at(5 * i), box(1).at(5 * i, 9)).at(0, 0, i) - box(1).at(i) for i in range(6)]
    evaluator = Evaluator()
    evaluator.evaluate(intersection(union(*parts), box(100).at(-50, -50, -50)))
    before = evaluator.evaluations
    parts[3] = parts[3].with_(children=(parts[3].children[0], box(2).at(3)))
    evaluator.evaluate(intersection(union(*parts), box(100).at(-50, -50, -50)))
    # The new box, its difference, the union, the intersection.
    assert evaluator.evaluations - before == 4


def test_undo_evaluates_nothing_even_incrementally():
    evaluator = Evaluator(incremental=True)
    before = box(100, 100, 4) - union(*(cylinder(1, 6).at(3 * i % 97, 7 * i % 91, -1) for i in range(80)))
    after = before.with_(children=(before.children[0], union(*before.children[1].children[1:])))
    evaluator.evaluate(before)
    evaluator.evaluate(after)
    count = evaluator.evaluations
    assert evaluator.evaluate(before).solid is evaluator.evaluate(before).solid
    assert evaluator.evaluations == count


def test_moving_one_of_many_holes_gives_the_solid_that_a_cold_start_gives():
    holes = [cylinder(1.5, 12, segments=24).at(4 + 5 * (i % 12), 4 + 5 * (i // 12), -1) for i in range(96)]
    evaluator = Evaluator(incremental=True)
    evaluator.evaluate(box(64, 44, 10) - union(*holes))
    # Free of the others; over a neighbour; out of the plate; away; back; two at once.
    places = [(40, (0.5, 0.2)), (40, (4.0, 0)), (40, (100, 0)), (17, (1, 1)), (40, (0, 0)), (3, (-2, -2))]
    for index, (x, y) in places:
        i = index
        holes[i] = cylinder(1.5, 12, segments=24).at(4 + 5 * (i % 12) + x, 4 + 5 * (i // 12) + y, -1)
        tree = box(64, 44, 10) - union(*holes)
        warm, cold = evaluator.evaluate(tree).solid, Evaluator().evaluate(tree).solid
        assert warm.volume() == pytest.approx(cold.volume(), rel=1e-12)
        assert warm.surface_area() == pytest.approx(cold.surface_area(), rel=1e-12)
        assert warm.genus() == cold.genus()


def test_a_memo_of_little_room_still_answers():
    evaluator = Evaluator(limit=10_000)
    tree = union(*(sphere(2 + i).at(30 * i) for i in range(9)))
    assert evaluator.evaluate(tree).solid.volume() == pytest.approx(Evaluator().evaluate(tree).solid.volume())


def test_failures_name_who_is_to_blame():
    assert fault(union(box(1), Box(size=(0, 1, 1)))) == ((1,), "Box: size must be above 0, not 0")
    assert fault(box(1) - (sphere(-2) + box(1)))[0] == (1, 0)
    assert "copies must be a whole number" in fault(LinearArray(children=(box(1),), count=2.5))[1]
    assert "copies must be at least 1" in fault(LinearArray(children=(box(1),), count=0))[1]
    assert "at most" in fault(LinearArray(children=(box(1),), count=1e9))[1]
    assert "flat" in fault(union(Rectangle()))[1]
    assert "solid" in fault(Extrude(children=(box(1),)))[1]
    assert fault(Extrude(children=(Circle(radius=-1),))) == ((0,), "Circle: radius must be above 0, not -1")
    assert "scale factor is 0" in fault(box(1).scaled(1, 0, 1))[1]
    assert "scale factor is 0" in fault(union(box(1).scaled(1, 0, 1), box(1)))[1]
    assert "both 0" in fault(Cone(radius=0, top_radius=0))[1]
    assert "x < 0" in fault(Revolve(children=(Circle(radius=1).at(-5),)))[1]
    assert fault(union(box(1), Broken(message="“w” has no value")))[1] == "“w” has no value"
    assert fault(Polyhedron(points=CUBE_POINTS, faces=CUBE_FACES[:5]))[1].endswith("not closed: 4 open edges")
    assert "0 to 7" in fault(Polyhedron(points=CUBE_POINTS, faces=(*CUBE_FACES, (0, 1, 99))))[1]


def test_one_failure_is_told_once_however_often_the_part_is_used():
    bad = sphere(0)
    entry = Evaluator().evaluate(union(bad, box(1), linear_array(bad, 3)))
    assert [problem.place for problem in entry.problems] == [(0,), (2, 0)]


def test_empty_results_are_told_and_are_no_failure():
    for tree in (box(1) & box(1).at(5), box(1) - box(3).at(-1, -1, -1), Union(), union(Union(), Union())):
        entry = Evaluator().evaluate(tree)
        assert entry.solid is not None and entry.solid.is_empty()
        assert entry.problems and not any(problem.error for problem in entry.problems)
    # And again when they come from the memo.
    evaluator = Evaluator()
    tree = (box(1) & box(1).at(5)).named("nothing in common")
    assert evaluator.evaluate(tree).problems == evaluator.evaluate(tree).problems != ()


def test_trees_hundreds_deep():
    tree = box(1)
    for i in range(700):
        tree = (union(tree, box(1).at(2 * i)) if i % 3 else difference(tree, box(1).at(-2 * i - 5))).at(0, 0, 0.001)
    assert Evaluator().evaluate(tree).solid.volume() > 100


def test_it_can_be_stopped():
    def stop(label):
        raise Superseded

    evaluator = Evaluator()
    with pytest.raises(Superseded):
        evaluator.evaluate(union(sphere(1), box(1)), progress=stop)
    assert evaluator.evaluate(union(sphere(1), box(1))).solid is not None


def test_a_half_space_cuts_what_it_meets():
    ball = sphere(10, segments=64)
    kept = volume(ball & Halfspace(point=(0, 0, 4)))
    gone = volume(ball - Halfspace(point=(0, 0, 4)))
    assert kept + gone == pytest.approx(volume(ball), rel=1e-12)
    assert kept == pytest.approx(math.pi * 36 * (30 - 6) / 3, rel=0.02)  # a cap of height 6


def test_trees_that_unfold_without_measure_are_refused_at_once():
    nested = box(1)
    for _ in range(5):
        nested = LinearArray(children=(nested,), count=1000)
    assert "1,000,000,000,000,000 parts" in fault(nested)[1]
    definitions = [box(1).with_(id="d0")]
    for i in range(60):
        twice = (Instance(id=f"a{i}", definition=f"d{i}"), Instance(id=f"b{i}", definition=f"d{i}").at(2.0**i))
        definitions.append(Union(id=f"d{i + 1}", children=twice))
    document = Document(solids=(Instance(id="i", definition="d60"),), definitions=tuple(definitions))
    (message,) = evaluate_document(document).messages
    assert message.node_id == "i" and "parts; at most" in message.message


def test_of_what_failed_the_rest_is_still_to_be_seen():
    bad = sphere(0)
    for tree, rest in (
        (union(box(1), bad), 1),
        (union(box(1), union(bad, box(1).at(5)).at(1)).scaled(2), 16),
        (box(2) - box(1) - bad, 7),
        (intersection(box(2), bad, Halfspace(point=(0, 0, 1))), 4),
        (linear_array(union(box(1), bad), 3), 3),
    ):
        entry = Evaluator().evaluate(tree)
        assert entry.solid is None and any(problem.error for problem in entry.problems)
        assert entry.rest.volume() == pytest.approx(rest)
    for tree in (bad, bad - box(1), union(bad) & bad, hull(union(box(1), bad), box(1))):
        entry = Evaluator().evaluate(tree)
        assert entry.solid is None and (entry.rest is None or entry.rest.is_empty())


def test_moving_a_dimple_on_a_face_leaves_nothing_behind():
    """A sphere centred on a face, put back and moved, once left a membrane of no volume where it had been."""
    holes = [cylinder(1, 12, segments=12).at(5 + 8 * i, 5 + 8 * j, -1) for i in range(12) for j in range(4)]
    evaluator = Evaluator(incremental=True)
    for x in (20, 40, 41, 20):
        tree = difference(box(100, 60, 10), *holes, sphere(5, segments=32).at(x, 50, 0))
        warm, cold = evaluator.evaluate(tree).solid, Evaluator().evaluate(tree).solid
        assert warm.surface_area() == pytest.approx(cold.surface_area(), rel=1e-9)
        assert warm.volume() == pytest.approx(cold.volume(), rel=1e-12)


@pytest.mark.parametrize("size", [1e-320, 1e-300, 1e-30, 1e15, 1e154, 1e300, 1.7e308])
def test_numbers_of_any_size_are_answered_in_words_or_with_a_solid(size):
    evaluator = Evaluator()
    for node in (
        sphere(size), Torus(radius=size, tube_radius=1), cylinder(size, 1), sphere(10).scaled(size),
        sphere(10).at(size), sphere(10).scaled(size, 1, 1), sphere(10, tolerance=max(size, 1e-3)),
        Extrude(children=(Circle(radius=size),)),
        Extrude(children=(Rectangle(),), twist=size, segments=8), box(size) & Halfspace(point=(size, 0, 0)),
        union(box(1).at(size, size).scaled(1e10)),
    ):  # fmt: skip
        for tree in (node, union(node, box(1))):
            entry = evaluator.evaluate(tree, 0.5)
            if entry.solid is None:
                assert any(problem.error for problem in entry.problems)
            else:
                assert math.isfinite(entry.solid.volume())


def test_what_is_kept_holds_no_name():
    evaluator = Evaluator()
    tree = box(1) - box(5)
    for name in ("part", "bracket"):
        (problem,) = evaluator.evaluate(tree.named(name)).problems
        assert problem.message == "nothing is left of the first operand"


def test_operands_that_change_all_the_time_are_not_kept_for_ever():
    evaluator = Evaluator(limit=1 << 20)
    for i in range(200):
        evaluator.evaluate(union(sphere(5 + i / 1000, segments=32), box(1)))
    kept = sum(operand.solid.num_tri() for operand in evaluator._operands.values())
    assert kept * 150 <= (1 << 20) / 4
