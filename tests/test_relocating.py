"""Copies, order and exchange in the tree; the place in space stays."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Instance
from solidtree.model.document.placement import product
from solidtree.model.document.table import from_table, to_table
from solidtree.model.document.tree import find, trail
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, circle, difference, document_of, extrude, linear_array, sphere, union

# n1 (n2 box, n3 sphere, n4 box), n5 box, n6 array (n7 box), n8 extrusion (n9 outline)
DOCUMENT = document_of(
    difference(box(1), sphere(2), box(3).named("c")).at(10).turned(z=30).named("body"),
    box(3).named("lid"),
    linear_array(box(1)),
    extrude(circle(1)),
)


def do(document, name, *arguments):
    after = OPERATIONS[name](document, *arguments)
    names = [root.name for root in after.solids]
    assert len(set(names)) == len(names) and all(names)
    assert to_table(from_table(to_table(after))) == to_table(after)
    return after


def refused(document, words, name, *arguments):
    with pytest.raises(Refusal, match=words):
        OPERATIONS[name](document, *arguments)


def ids(nodes):
    return [node.id for node in nodes]


def in_space(document, node_id):
    matrix = np.eye(3, 4)
    for node in reversed(trail(document, node_id)):
        matrix = product(node.placement.matrix(), matrix)
    return matrix


def test_copies_come_at_their_place_in_one_step_and_stand_where_the_originals_stand():
    after = do(DOCUMENT, "copy_to", ["n5", "n2"], "n1", 1)
    assert ids(find(after, "n1").children) == ["n2", "n10", "n11", "n3", "n4"]
    assert in_space(after, "n10") == pytest.approx(in_space(DOCUMENT, "n5"))
    assert find(after, "n11") == find(DOCUMENT, "n2") and find(after, "n5") is find(DOCUMENT, "n5")
    out = do(DOCUMENT, "copy_to", ["n3"], None)
    assert out.solids[-1].name == "Sphere" and in_space(out, "n10") == pytest.approx(in_space(DOCUMENT, "n3"))
    assert out.solids[0] is DOCUMENT.solids[0]


def test_a_copy_of_a_definition_is_an_instance_of_it():
    linked = do(DOCUMENT, "link", ["n5"])
    after = do(linked, "copy_to", ["n5"], "n1")
    made = find(after, "n1").children[-1]
    assert isinstance(made, Instance) and made.definition == "n5" and after.definitions is linked.definitions
    inside = do(DOCUMENT, "link", ["n1"])
    refused(inside, "would hold itself", "copy_to", ["n1"], "n1")


@pytest.mark.parametrize(
    ("chosen", "parent_id", "index", "words"),
    [
        (["n5"], "n2", None, "holds no operands"),
        (["n5"], "n6", None, "takes only 1 operand"),
        (["n9"], "n1", None, "is an outline, which is flat"),
        (["n5"], "n8", None, "takes an outline"),
        (["n5"], "n1", 9, "places go from 0 to 3"),
    ],
)
def test_what_cannot_be_copied_there(chosen, parent_id, index, words):
    refused(DOCUMENT, words, "copy_to", chosen, parent_id, index)


@pytest.mark.parametrize(
    ("chosen", "by", "order"),
    [
        (["n3"], -1, ["n3", "n2", "n4"]),
        (["n3"], 1, ["n2", "n4", "n3"]),
        (["n3", "n4"], -1, ["n3", "n4", "n2"]),
        (["n2", "n4"], 1, ["n3", "n2", "n4"]),
        (["n4"], -5, ["n4", "n2", "n3"]),
    ],
)
def test_operands_move_among_their_siblings(chosen, by, order):
    after = do(DOCUMENT, "reorder", chosen, by)
    assert ids(find(after, "n1").children) == order
    assert all(find(after, i) is find(DOCUMENT, i) for i in order)


def test_at_an_end_they_stay_and_solids_have_an_order_too():
    assert do(DOCUMENT, "reorder", ["n2", "n3"], -1) is DOCUMENT
    assert do(DOCUMENT, "reorder", ["n4"], 3) is DOCUMENT
    assert ids(do(DOCUMENT, "reorder", ["n5", "n6"], -1).solids) == ["n5", "n6", "n1", "n8"]
    both = do(DOCUMENT, "reorder", ["n5", "n3"], -1)
    assert ids(both.solids) == ["n5", "n1", "n6", "n8"] and ids(find(both, "n1").children) == ["n3", "n2", "n4"]
    refused(DOCUMENT, "whole numbers", "reorder", ["n5"], 1.5)


def test_an_operand_becomes_the_base():
    after = do(DOCUMENT, "promote", "n4")
    assert ids(find(after, "n1").children) == ["n4", "n2", "n3"] and after.solids[1] is DOCUMENT.solids[1]
    assert do(DOCUMENT, "promote", "n2") is DOCUMENT
    refused(DOCUMENT, "“lid” is no operand", "promote", "n5")


def test_two_nodes_change_places_and_stay_in_space():
    after = do(DOCUMENT, "swap", "n3", "n5")
    assert ids(find(after, "n1").children) == ["n2", "n5", "n4"] and after.solids[1].id == "n3"
    for node_id in ("n3", "n5"):
        assert in_space(after, node_id) == pytest.approx(in_space(DOCUMENT, node_id))
    siblings = do(DOCUMENT, "swap", "n2", "n4")
    assert ids(find(siblings, "n1").children) == ["n4", "n3", "n2"] and find(siblings, "n2") is find(DOCUMENT, "n2")
    refused(DOCUMENT, "neither may stand in the other", "swap", "n1", "n3")
    refused(DOCUMENT, "an outline and a solid", "swap", "n9", "n5")


def test_several_are_dissolved_inner_ones_first():
    document = document_of(union(union(box(1), box(2)), box(3)), union(sphere(1)))
    after = do(document, "dissolve", ["n1", "n2", "n6"])
    assert ids(after.solids) == ["n3", "n4", "n5", "n7"]


def test_several_change_their_kind():
    document = document_of(union(box(1), box(2)), difference(box(3), box(4)))
    after = do(document, "change_kind", ["n1", "n4"], "intersection")
    assert [root.kind for root in after.solids] == ["Intersection", "Intersection"]


def test_equal_nodes_come_to_share_a_definition_when_linked_together():
    document = document_of(box(1).at(5).named("a"), box(1).named("b").coloured("red"), box(2).named("c"))
    after = do(document, "link", ["n1", "n2", "n3"])
    assert ids(after.definitions) == ["n1", "n3"]
    assert [root.definition for root in after.solids] == ["n1", "n1", "n3"]
    assert [root.colour for root in after.solids] == [None, "#ff0000", None]
    assert in_space(after, after.solids[0].id) == pytest.approx(in_space(document, "n1"))
    apart = do(after, "unlink", ids(after.solids))
    assert apart.definitions == () and apart.solids == document.solids


def test_many_are_named_with_their_numbers():
    assert [n.name for n in find(do(DOCUMENT, "rename_each", ["n2", "n4"], "tooth"), "n1").children] == [
        "tooth 1",
        "",
        "tooth 2",
    ]
    after = do(DOCUMENT, "rename_each", ["n5", "n6"], "no # of two")
    assert [root.name for root in after.solids[1:3]] == ["no 1 of two", "no 2 of two"]
    twice = do(after, "rename_each", ["n6", "n5"], "no # of two")  # each takes the other's name
    assert [root.name for root in twice.solids[1:3]] == ["no 2 of two", "no 1 of two"]
    assert find(do(after, "rename_each", ["n2"], "one"), "n2").name == "one"
    refused(DOCUMENT, "called “lid” already", "rename_each", ["n6"], "lid")
    refused(DOCUMENT, "needs a name", "rename_each", ["n5", "n6"], " ")


def test_a_group_has_its_name():
    after = do(DOCUMENT, "combine", "union", ["n2", "n3"], "Group")
    assert find(after, "n1").children[0].name == "Group"
    assert do(DOCUMENT, "combine", "union", ["n5"], "body").solids[1].name == "body 2"
