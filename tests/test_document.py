"""The document: parameters and their values, and what resolving makes of expressions and instances."""

import math
import time

import pytest

from solidtree.model.document.document import Document, Parameter, parameter_values
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Broken, Instance, Union
from solidtree.model.document.resolve import Resolver, resolve
from solidtree.model.document.tree import walk
from solidtree.model.script import box, cylinder, instance, sphere, union

A, B = Parameter("a", 2), Parameter("b", "a * 3")


def one(document):
    (solid,) = resolve(document).solids
    return solid


@pytest.mark.parametrize(
    "name", ["", "2a", "a b", "a-b", "x²", "if", "lambda", "True", "sqrt", "mm", "in", "pi", None, 5]
)
def test_what_expressions_cannot_write_is_no_name(name):
    with pytest.raises(Refusal):
        Parameter(name, 1)


def test_a_name_is_kept_as_expressions_read_it():
    assert Parameter("ﬁx", 1).name == "fix"
    assert Parameter("höhe", 1).name == "höhe"


@pytest.mark.parametrize("arguments", [dict(value=math.nan), dict(value="inf"), dict(value=1, minimum=math.nan),
                                       dict(value=1, maximum="w"), dict(value=1, minimum=2), dict(value=3, maximum=2),
                                       dict(value=1, minimum=3, maximum=2), dict(value=1, choices=(2, 3)),
                                       dict(value=1, choices=("w",)), dict(value=1, choices=5), dict(value=1, note=5),
                                       dict(value="1 +")])  # fmt: skip
def test_a_parameter_refuses_by_name_what_it_cannot_be(arguments):
    with pytest.raises(Refusal, match="width"):
        Parameter("width", **arguments)


def test_two_parameters_of_one_name_are_refused():
    with pytest.raises(Refusal, match="two parameters called a"):
        Document(parameters=(A, Parameter("a", 3)))


def test_parameters_are_reckoned_from_one_another_in_any_order():
    values, faults = parameter_values([Parameter("c", "b + a"), B, A])
    assert values == {"c": 8, "b": 6, "a": 2} and list(values) == ["c", "b", "a"] and not faults


def test_a_circle_is_told_to_those_in_it_and_those_who_wait_for_it():
    parameters = [Parameter("x", "y + 1"), Parameter("y", "x"), Parameter("z", "2 * x"), Parameter("self", "self"), A]
    values, faults = parameter_values(parameters)
    assert values == {"a": 2}
    assert faults["x"] == "the parameter x depends on itself: x, y go in a circle"
    assert faults["self"] == "the parameter self depends on itself: self go in a circle"
    assert faults["z"].startswith("the parameter z needs x, which has no value")


def test_what_is_wrong_with_a_parameter_is_told_to_its_users():
    values, faults = parameter_values([Parameter("x", "1 / 0"), Parameter("y", "x"), Parameter("w", "nope"),
                                       Parameter("most", "a", maximum=1), A])  # fmt: skip
    assert values == {"a": 2}
    assert "divides by zero" in faults["x"] and "divides by zero" in faults["y"]
    assert "no parameter called nope" in faults["w"]
    assert faults["most"] == "the parameter most must be at most 1, not 2"


def test_many_parameters_take_no_time():
    chain = [Parameter("p0", 1), *(Parameter(f"p{i}", f"p{i - 1} + 1") for i in range(1, 3000))]
    started = time.perf_counter()
    values, _ = parameter_values(Document(parameters=tuple(reversed(chain))).parameters)
    assert values["p2999"] == 3000
    assert time.perf_counter() - started < 2


def test_expressions_become_numbers_and_the_rest_is_shared():
    plain = sphere(3).at(1)
    root = union(box("b", "a", 1).at("a / 2"), plain)
    solid = one(Document(solids=(root,), parameters=(A, B)))
    assert solid.children[0] == box(6, 2, 1).at(1) and solid.children[0].id == root.children[0].id
    assert solid.children[1] is plain
    assert not solid.symbolic


def test_a_tree_without_expressions_is_itself():
    root = union(box(1), sphere(2))
    assert one(Document(solids=(root,))) is root


def test_a_node_without_a_value_stands_broken_in_its_place():
    root = union(box("nope").named("lid"), box("1 / (a - 2)"), box("a"))
    solid = one(Document(solids=(root,), parameters=(A,)))
    first, second, third = solid.children
    assert isinstance(first, Broken) and first.id == root.children[0].id and first.name == "lid"
    assert "no parameter called nope" in first.message
    assert "divides by zero" in second.message
    assert third == box(2)


def test_the_fault_of_a_parameter_is_told_by_those_who_ask_for_it_only():
    circular = Parameter("a", "a")
    root = union(box("a + 1"), box("sqrt(0 - 1)"), box("(0 - 8) ** 0.5"))
    broken = one(Document(solids=(root,), parameters=(circular,))).children
    assert "go in a circle" in broken[0].message
    assert not any("circle" in node.message for node in broken[1:])


def test_instances_hold_their_definition_and_share_it():
    bolt = union(cylinder("a", 10)).with_(id="bolt").named("bolt")
    root = union(instance("bolt").at(5), instance("bolt").turned(z=90))
    document = Document(solids=(root,), definitions=(bolt,), parameters=(A,))
    left, right = one(document).children
    assert isinstance(left, Instance) and left.children[0] is right.children[0]
    assert left.children[0].children[0] == cylinder(2, 10)
    assert left.shape_digest == right.shape_digest
    assert [n.id for n in (left, right)] == [n.id for n in root.children]


def test_an_instance_of_nothing_is_broken():
    solid = one(Document(solids=(union(instance("gone")),)))
    assert "gone" in solid.children[0].message


def test_a_definition_that_holds_itself_is_told_and_nothing_hangs():
    first = union(box(1), instance("second")).with_(id="first").named("one")
    second = union(instance("first")).with_(id="second").named("two")
    alone = union(instance("alone")).with_(id="alone").named("me")
    document = Document(
        solids=(instance("first"), instance("second"), instance("alone")), definitions=(first, second, alone)
    )
    for solid in resolve(document).solids:
        messages = [node.message for node in walk(solid) if isinstance(node, Broken)]
        assert messages and all("holds itself" in message for message in messages)


def test_definitions_of_definitions_are_shared_and_not_multiplied():
    definitions = [box(1).with_(id="d0")]
    for i in range(1, 60):
        definitions.append(union(instance(f"d{i - 1}"), instance(f"d{i - 1}").at(1)).with_(id=f"d{i}"))
    started = time.perf_counter()
    solid = one(Document(solids=(instance("d59"),), definitions=tuple(definitions)))
    assert solid.children[0].children[0].children[0] is solid.children[0].children[1].children[0]
    assert time.perf_counter() - started < 1


def test_a_resolver_gives_the_same_nodes_for_the_same_input():
    resolver = Resolver()
    document = Document(solids=(union(box("a"), sphere(1)),), parameters=(A,))
    first = resolver.resolve(document).solids[0]
    assert resolver.resolve(document).solids[0] is first
    other = document.with_(solids=(*document.solids, box(1)))
    assert resolver.resolve(other).solids[0] is first


def test_a_parameters_change_changes_the_nodes_that_use_it_and_no_others():
    resolver = Resolver()
    root = union(union(box("a")), union(box("b")), sphere(1))
    document = Document(solids=(root,), parameters=(A, Parameter("b", 5)))
    first = resolver.resolve(document).solids[0]
    second = resolver.resolve(document.with_(parameters=(Parameter("a", 3), Parameter("b", 5)))).solids[0]
    assert second.children[0].children[0] == box(3)
    assert second.children[1] is first.children[1] and second.children[2] is first.children[2]


def test_a_changed_definition_reaches_its_instances():
    resolver = Resolver()
    bolt = box(1).with_(id="bolt")
    document = Document(solids=(instance("bolt"),), definitions=(bolt,))
    assert resolver.resolve(document).solids[0].children[0] is bolt
    changed = document.with_(definitions=(bolt.with_(size=(2, 2, 2)),))
    assert resolver.resolve(changed).solids[0].children[0] == box(2)


def test_deep_trees_are_resolved():
    node = box("a")
    for _ in range(3000):
        node = Union(children=(node, box(1)))
    solid = one(Document(solids=(node,), parameters=(A,)))
    assert sum(1 for _ in walk(solid)) == 6001 and not solid.symbolic
