"""Finding and changing nodes: what is not touched stays the very same, at any depth."""

import time

import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Union
from solidtree.model.document.primitives import Box
from solidtree.model.document.tree import (
    change,
    change_each,
    find,
    homes,
    index_of,
    insert,
    next_number,
    numbered,
    outermost,
    parent,
    trail,
    unique_name,
    walk,
)
from solidtree.model.script import box, document_of, extrude, linear_array, rectangle, sphere, union

# n1 union: n2 union (n3 box, n4 sphere), n5 box; n6 sphere
DOCUMENT = document_of(union(union(box(1), sphere(1)), box(2)), sphere(3))


def tower(levels=3000):
    node = box(1)
    for _ in range(levels):
        node = Union(children=(box(1), node))
    return document_of(node)


def test_nodes_are_walked_in_the_order_of_the_tree():
    assert [node.id for node in walk(*DOCUMENT.roots)] == ["n1", "n2", "n3", "n4", "n5", "n6"]


def test_places_are_found():
    assert [node.id for node in trail(DOCUMENT, "n4")] == ["n1", "n2", "n4"]
    assert parent(DOCUMENT, "n4").id == "n2" and parent(DOCUMENT, "n6") is None
    assert [index_of(DOCUMENT, i) for i in ("n1", "n6", "n4", "n5")] == [0, 1, 1, 1]
    with pytest.raises(Refusal, match="no node n9"):
        find(DOCUMENT, "n9")


def test_a_change_shares_all_it_did_not_touch():
    after = change(DOCUMENT, "n4", lambda node: node.at(1))
    before, root = DOCUMENT.solids[0], after.solids[0]
    assert find(after, "n4").placement.position == (1, 0, 0)
    assert root.children[1] is before.children[1] and root.children[0].children[0] is before.children[0].children[0]
    assert after.solids[1] is DOCUMENT.solids[1]
    assert root.id == "n1" and root is not before


def test_a_change_of_nothing_is_the_same_document():
    assert change(DOCUMENT, "n4", lambda node: node) is DOCUMENT
    assert change_each(DOCUMENT, ["n1", "n4"], lambda node: node) is DOCUMENT
    assert change_each(DOCUMENT, [], lambda node: None) is DOCUMENT


def test_many_are_changed_in_one_go_operands_first():
    order = []

    def dressed(node):
        order.append(node.id)
        return node.named(node.id)

    after = change_each(DOCUMENT, ["n1", "n4", "n2", "n6"], dressed)
    assert [find(after, i).name for i in ("n1", "n2", "n3", "n4", "n6")] == ["n1", "n2", "", "n4", "n6"]
    assert order.index("n4") < order.index("n2") < order.index("n1")
    assert find(after, "n3") is find(DOCUMENT, "n3") and find(after, "n5") is find(DOCUMENT, "n5")


def test_nodes_are_taken_out():
    after = change_each(DOCUMENT, ["n3", "n6", "n5"], lambda node: None)
    assert [node.id for node in walk(*after.roots)] == ["n1", "n2", "n4"]
    with pytest.raises(Refusal, match="“Linear array” cannot be without “Box”"):
        change_each(document_of(linear_array(box(1)).named("Linear array")), ["n2"], lambda node: None)
    with pytest.raises(Refusal, match="no node n9"):
        change_each(DOCUMENT, ["n1", "n9"], lambda node: None)


def test_the_outermost_keep_their_order():
    assert outermost(DOCUMENT, ["n6", "n4", "n2", "n6", "n5"]) == ["n6", "n2", "n5"]
    assert outermost(DOCUMENT, "n4") == ["n4"]
    for wrong in (["n9"], [None], None, 5, [["n1"]]):
        with pytest.raises(Refusal):
            outermost(DOCUMENT, wrong)


def test_a_node_is_put_where_it_is_wanted():
    new = box(9).with_(id="new")
    assert [n.id for n in find(insert(DOCUMENT, new, "n2", 1), "n2").children] == ["n3", "new", "n4"]
    assert [n.id for n in insert(DOCUMENT, new).solids] == ["n1", "n6", "new"]
    for place in (-1, 3, 1.5, True, "0"):
        with pytest.raises(Refusal, match="places go from 0 to 2"):
            insert(DOCUMENT, new, "n2", place)


def test_what_is_full_takes_no_more():
    document = document_of(extrude(rectangle()), linear_array(box(1)), box(1))
    full = {"n1": "takes only 1 operand", "n3": "takes only 1 operand", "n5": "holds no operands"}
    for parent_id, words in full.items():
        with pytest.raises(Refusal, match=words):
            insert(document, box(2).with_(id="new"), parent_id)


def test_numbers_are_given_in_reading_order_and_shared_nodes_become_many():
    shared = box(1)
    (root,) = numbered([union(shared, union(shared), shared)])
    assert [node.id for node in walk(root)] == ["n1", "n2", "n3", "n4", "n5"]
    assert numbered([root])[0] is root
    assert [n.id for n in walk(*numbered([shared, shared], 7))] == ["n7", "n8"]


def test_a_tree_that_grows_like_a_bomb_is_refused_at_once():
    node = box(1)
    for _ in range(64):
        node = union(node, node)
    started = time.perf_counter()
    with pytest.raises(Refusal, match="more than 1,000,000 nodes"):
        numbered([node])
    assert time.perf_counter() - started < 0.5


def test_the_next_number_is_above_all():
    assert next_number(DOCUMENT) == 7
    assert (
        next_number(Document(solids=(box(1).with_(id="n41"), box(1).with_(id="nx99"), box(1).with_(id="nabc")))) == 42
    )
    assert next_number(Document(solids=(box(1).with_(id="n" + "9" * 5000),))) == 1


@pytest.mark.parametrize(
    ("wanted", "taken", "name"),
    [
        ("Box", [], "Box"),
        ("Box", ["Box"], "Box 2"),
        ("Box 2", ["Box", "Box 2"], "Box 3"),
        ("bolt M8", ["bolt M8"], "bolt M8 2"),
        ("7", ["7"], "7 2"),
    ],
)
def test_names_are_counted_on(wanted, taken, name):
    assert unique_name(wanted, taken) == name


def test_deep_trees_are_found_and_changed():
    document = tower()
    lowest = next(node.id for node in walk(*document.roots) if node.id == "n6001")
    assert len(trail(document, lowest)) == 3001
    after = change(document, lowest, lambda node: node.at(1))
    also = change_each(document, [lowest, "n1"], lambda node: node.named("x"))
    assert find(after, lowest).placement.position == (1, 0, 0) and find(also, lowest).name == "x"
    assert outermost(document, [lowest, "n3"]) == ["n3"] and index_of(document, lowest) == 1
    assert find(insert(document, box(1).with_(id="new"), trail(document, lowest)[-2].id), "new")


def test_the_homes_of_nodes_come_in_the_order_asked_for():
    one, other = Union(id="one", children=(Box(id="a"), Box(id="b"))), Box(id="other")
    document = Document(solids=(one, other))
    assert homes(document, ["other", "b", "gone", "a"]) == {"other": other, "one": one}
    assert list(homes(document, ["other", "b"])) == ["other", "one"] and homes(document, []) == {}
