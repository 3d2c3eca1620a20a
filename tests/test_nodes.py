"""Nodes: digests, equality, what is refused when they are made, operators, and trees of any depth."""

import copy
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.expression import Expression
from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.nodes import KINDS, Difference, Instance, Node, Union, field_specs, fresh_id, range_fault
from solidtree.model.document.outlines import Rectangle
from solidtree.model.document.placement import Move, Placement
from solidtree.model.document.primitives import Box, Cylinder, Polyhedron, Sphere
from solidtree.model.script import box, cylinder, difference, halfspace, intersection, linear_array, sphere, union

OUTLINE = Rectangle()


def made(kind: type[Node]) -> Node:
    return kind(children=(OUTLINE,) * kind.operands[0])


def test_dress_is_not_in_the_digest():
    plain = sphere(10) - box(5)
    dressed = plain.named("ball").coloured("red").noted("words").hidden().with_(id="n7")
    assert dressed.digest == plain.digest and dressed == plain and hash(dressed) == hash(plain)
    assert dressed is not plain


def test_a_placement_is_in_the_digest_and_not_in_that_of_the_shape():
    plain = box(3)
    for placed in (plain.at(1), plain.turned(z=1), plain.scaled(2), plain.mirrored()):
        assert placed != plain and placed.shape_digest == plain.shape_digest
    assert plain.shape_digest == plain.digest


def test_a_childs_placement_is_in_its_parents_shape():
    assert union(box(1).at(1)).shape_digest != union(box(1)).shape_digest


def test_equal_values_built_differently_are_equal():
    assert box(2) == box((2, 2, 2)) == box(size="2") == Box(size=np.array([2, 2.0, 2]))
    assert box(1).at(1).at(2, -0.0) == box(1).at(3)
    assert linear_array(box(1), 3) == linear_array(box(1), np.int64(3))
    assert box(1) + box(2) + box(3) == union(box(1), [box(2), box(3)])
    assert box(1).transformed(np.eye(4)) == box(1).transformed(np.eye(3, 4).tolist())


def test_different_things_are_different():
    trees = [union(), difference(), intersection(), union(box(1)), union(box(1), box(1)), union(union(box(1))), box(1),
             box(1, centred=True), box("w"), box("w ").at(1), sphere(1), cylinder(1, 1), sphere(1, segments=8),
             Instance(definition="a"), Instance(definition="b"), box(1).at(1).turned(1), box(1).turned(1).at(1),
             union(box(1).at(2)), union(box(1)).at(2)]  # fmt: skip
    assert len({tree.digest for tree in trees}) == len(trees)


def test_the_digest_is_the_same_in_another_process():
    code = ("from solidtree.model.script import *\n"
            "part = sphere('w / 3') - polyhedron([(0.1,0,0)], [(0,0,0)]).turned(0.1)\n"
            "print(part.at(1e-7).digest.hex())")  # fmt: skip
    there = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()
    here = (sphere("w / 3") - Polyhedron(points=((0.1, 0, 0),), faces=((0, 0, 0),)).turned(0.1)).at(1e-7)
    assert here.digest.hex() == there


@pytest.mark.parametrize("kind", [k for name, k in sorted(KINDS.items()) if name != "Broken"])
def test_every_number_of_every_kind_refuses_what_is_not_finite(kind):
    node = made(kind)
    for spec in field_specs(kind):
        if spec.dimension == 0 and spec.type != "points":
            continue
        good = getattr(node, spec.name)
        for bad in (math.nan, math.inf, "nan", "1e999", object()):
            value = ((0.0, bad, 0.0),) if spec.type == "points" else (bad, *good[1:]) if spec.dimension == 3 else bad
            with pytest.raises(Refusal, match=kind.title):
                node.with_(**{spec.name: value})


@pytest.mark.parametrize("method", ["at", "turned", "scaled"])
def test_methods_refuse_what_is_not_finite(method):
    with pytest.raises(Refusal):
        getattr(box(1), method)(math.nan)
    with pytest.raises(Refusal):
        getattr(box(1), method)(y="inf")


@pytest.mark.parametrize(
    "make",
    [
        lambda: Extrude(),
        lambda: Extrude(children=(OUTLINE, OUTLINE)),
        lambda: Box(children=(box(1),)),
        lambda: Union(children=("box",)),
        lambda: Union(children=5),
        lambda: Box(placement=(1, 2, 3)),
        lambda: Box(colour="reddish"),
        lambda: Box(name=5),
        lambda: Box(note=None),
        lambda: Box(visible="no"),
        lambda: Box(centred="yes"),
        lambda: Box(centred=5),
        lambda: Box(size=5),
        lambda: Polyhedron(points=5),
        lambda: Polyhedron(points=[(1, 2)]),
        lambda: Polyhedron(faces=[1]),
        lambda: Polyhedron(faces=[(0, 1.5, 2)]),
        lambda: Polyhedron(faces=[(0, True, 2)]),
        lambda: Instance(definition=5),
    ],
)
def test_what_a_node_cannot_hold_is_refused(make):
    with pytest.raises(Refusal):
        make()


def test_arrays_make_polyhedra():
    points, faces = np.eye(4, 3), np.array([[0, 1, 2], [0, 2, 3]])
    node = Polyhedron(points=points, faces=faces)
    assert node.points[1] == (0, 1, 0) and node.faces == ((0, 1, 2), (0, 2, 3))


def test_a_change_keeps_the_id_and_shares_the_rest():
    node = box(1) - sphere(2)
    changed = node.at(5)
    assert changed.id == node.id and changed.children is node.children
    assert node.at(0, 0, 0) is node


def test_sums_and_intersections_of_many_are_flat_as_documented():
    a, b, c, d = box(1), box(2), box(3), box(4)
    assert [x is y for x, y in zip((a + b + (c + d)).children, (a, b, c, d), strict=True)] == [True] * 4
    assert len((a & b & c).children) == 3
    assert [type(n) for n in (a - b - c).children] == [Box] * 3
    assert len((a - (b - c)).children) == 2


@pytest.mark.parametrize("dress", [lambda n: n.named("x"), lambda n: n.at(1), lambda n: n.coloured("red"),
                                   lambda n: n.noted("x"), lambda n: n.hidden()])  # fmt: skip
def test_an_operation_that_somebody_dressed_stays_whole(dress):
    inner = dress(box(1) + box(2))
    assert (inner + box(3)).children[0] is inner
    assert (box(3) + inner).children[1] is inner


def test_operators_know_only_solids():
    for wrong in (3, "box", None):
        with pytest.raises(TypeError):
            box(1) + wrong
        with pytest.raises(TypeError):
            box(1) - wrong
        with pytest.raises(TypeError):
            box(1) & wrong


def test_scaled_takes_one_factor_or_three():
    assert box(1).scaled(2) == box(1).scaled(2, 2, 2)
    assert box(1).scaled(y=2) == box(1).scaled(1, 2, 1)
    assert box(1).scaled(2, 3).placement.steps[0].numbers == (2, 3, 1)


def test_expressions_mark_the_way_to_the_root():
    assert not (box(1) + sphere(2)).symbolic
    assert (box("w") + sphere(2)).symbolic and box(1).at("w").symbolic and union(Instance(definition="n1")).symbolic
    assert [e.text for e in box(1, "w", 2).at("h").expressions()] == ["w", "h"]
    assert union(box("w")).expressions() == []


def test_bounds_are_told_in_words():
    assert range_fault(box(1)) is None
    assert range_fault(box(1, 0, 1)) == "Box: size must be above 0, not 0"
    assert range_fault(sphere(1, segments=2)) == "Sphere: segments must be at least 3, not 2"
    assert range_fault(Cylinder(radius=-1)) == "Cylinder: radius must be above 0, not -1"


def test_nodes_do_not_travel_as_pickles():
    for travel in (pickle.dumps, copy.deepcopy):
        with pytest.raises(TypeError, match="table"):
            travel(box(1))


def test_repr_is_short():
    tree = union(*[box(1)] * 1000).named("many")
    assert len(repr(tree)) < 60 and "many" in repr(tree) and "1000 operands" in repr(tree)


def test_ids_are_new_each_time_and_letters_first():
    ids = {fresh_id() for _ in range(1000)}
    assert len(ids) == 1000 and all(i[0] == "n" and len(i) == 11 for i in ids)
    assert box(1).id != box(1).id


def test_deep_trees_have_equality_hash_and_repr():
    def tower():
        node = box(1)
        for i in range(3000):
            node = Difference(children=(node, halfspace((0, 0, 1), (0, 0, i))))
        return node

    one, two = tower(), tower()
    assert one == two and hash(one) == hash(two) and repr(one)
    assert one.with_(placement=Placement((Move((1, 0, 0)),))) != two
    assert Expression("a") not in [one]
    assert isinstance(one, Node) and Sphere() != one
