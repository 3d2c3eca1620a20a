"""Operations: what they do to the tree, that nothing moves in space by accident, and what they refuse."""

import numpy as np
import pytest

from solidtree.model.document.document import Document, Parameter, ParameterSet, Section
from solidtree.model.document.errors import Refusal
from solidtree.model.document.from_outlines import Extrude, Revolve
from solidtree.model.document.nodes import Broken, Difference, Instance, LinearArray, Mirror, PolarArray, Union
from solidtree.model.document.placement import Move, Scale, product
from solidtree.model.document.primitives import Box
from solidtree.model.document.resolve import resolve
from solidtree.model.document.table import from_table, to_table
from solidtree.model.document.tree import find, trail, walk
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import (
    at,
    box,
    circle,
    document_of,
    evaluate,
    extrude,
    hull,
    instance,
    linear_array,
    mirror,
    parameter,
    polar_array,
    rectangle,
    sphere,
    turned,
    union,
)


def do(document, name, *arguments, **keywords):
    """An operation, whose result is checked for being a document that can be written and read."""
    after = OPERATIONS[name](document, *arguments, **keywords)
    names = [root.name for root in after.standing]
    assert len(set(names)) == len(names) and all(names)
    table = to_table(after)  # refuses doubled ids
    assert to_table(from_table(table)) == table
    return after


def refused(document, words, name, *arguments, **keywords):
    with pytest.raises(Refusal, match=words):
        OPERATIONS[name](document, *arguments, **keywords)


def ids(*nodes):
    return [node.id for node in nodes]


def in_space(document, node_id, parameters=()):
    """(3, 4): where a node stands in the world, the first copy of arrays taken."""
    matrix = np.eye(3, 4)
    root = resolve(document.with_(solids=(trail(document, node_id)[0],))).solids[0]
    for node in reversed(trail(Document(solids=(root,)), node_id)):
        if isinstance(node, Mirror) and not node.keep and node.id != node_id:
            normal, point = np.array(node.normal), np.array(node.point)
            normal = normal / np.linalg.norm(normal)
            image = np.column_stack((np.eye(3) - 2 * np.outer(normal, normal), 2 * normal * (normal @ point)))
            matrix = product(image, matrix)
        matrix = product(node.placement.matrix(), matrix)
    return matrix


# n1 (n2 box, n3 sphere), n4 box, n5 array (n6 box), n7 extrusion (n8 outline)
BODY = union(box(1), sphere(2)).at(10).turned(0, 0, 30).scaled(2, 1, 1).named("body")
DOCUMENT = document_of(BODY, box(3).named("lid"), linear_array(box(1)), extrude(rectangle()))


def test_the_list_holds_every_operation_by_its_name():
    assert {"insert", "combine", "link", "set_parameter"} <= OPERATIONS.keys()
    for name, function in OPERATIONS.items():
        assert function.__name__ == name and function.__doc__


# What is put in.


def test_a_solid_is_inserted_with_a_name_and_a_number_of_its_own():
    after = do(DOCUMENT, "insert", box(7))
    assert after.solids[-1].name == "Box" and after.solids[-1].id == "n9"
    again = do(do(after, "insert", box(7)), "insert", box(7).named("lid"))
    assert [solid.name for solid in again.solids[-3:]] == ["Box", "Box 2", "lid 2"]
    assert all(a is b for a, b in zip(after.solids, DOCUMENT.solids, strict=False))


def test_an_operand_is_inserted_at_its_place():
    after = do(DOCUMENT, "insert", box(7), "n1", 1)
    assert ids(*find(after, "n1").children) == ["n2", "n9", "n3"] and find(after, "n9").name == ""
    assert find(after, "n1").children[0] is find(DOCUMENT, "n2")


@pytest.mark.parametrize(
    ("node", "parent_id", "words"),
    [
        (box(1), "n2", "holds no operands"),
        (box(1), "n5", "takes only 1 operand"),
        (circle(1), "n7", "takes only 1 operand"),
        (circle(1), "n1", "is an outline, which is flat"),
        (union(circle(1)), "n1", "is an outline, which is flat"),
        (union(box(1), circle(1)), None, "is an outline, which is flat"),
        (union(circle(1), box(1)), None, "takes outlines, and “Box” is none"),
        (union(union(), circle(1)), None, "is an outline, which is flat"),
        (hull(circle(1)), None, "is an outline, which is flat"),
        (extrude(box(1)), None, "takes an outline"),
        (extrude(union()), None, "takes an outline"),
        (instance("n1"), None, "no definition n1"),
        (union(instance("gone")), None, "no definition gone"),
        (Broken(), None, "resolved trees only"),
        (Instance(definition="n1", children=(box(1),)), None, "resolved trees only"),
        (box(1), "n99", "no node n99"),
        ("box", None, "a solid is needed"),
        (None, None, "a solid is needed"),
        (box("depth"), None, "no parameter called depth"),
    ],
)
def test_what_fits_nowhere_is_not_inserted(node, parent_id, words):
    refused(DOCUMENT, words, "insert", node, parent_id)


def test_parameters_come_with_the_node_that_declares_them():
    width = parameter("width", 10, minimum=1)
    half = parameter("half", width / 2)
    after = do(DOCUMENT, "insert", box(half))
    assert [(p.name, p.minimum) for p in after.parameters] == [("width", 1), ("half", None)]
    changed = do(after, "set_parameter", "width", 20)
    assert do(changed, "move", ["n4"], half).parameters == changed.parameters  # the document's own value stays
    refused(DOCUMENT, "declared twice", "insert", box(width, parameter("width", 11), 1))


def test_another_document_is_put_in_whole():
    bolt = box("w").with_(id="bolt").named("bolt")
    other = Document(solids=(union(instance("bolt"), instance("lost")).named("lid"), sphere(1).with_(id="bolt2")),
                     definitions=(bolt,), parameters=(Parameter("w", 4),))  # fmt: skip
    after = do(DOCUMENT, "insert_document", other)
    assert [solid.name for solid in after.solids[-2:]] == ["lid 2", "Sphere"]
    assert after.solids[:4] == DOCUMENT.solids and after.definitions[0].name == "bolt"
    held, lost = after.solids[-2].children
    assert held.definition == after.definitions[0].id and lost.definition == ""
    twice = do(after, "insert_document", other)
    assert len(twice.parameters) == 1 and len(twice.definitions) == 2
    assert twice.solids[-2].children[0].definition == twice.definitions[1].id
    refused(do(DOCUMENT, "set_parameter", "w", 5), "both documents have a parameter w", "insert_document", other)
    refused(DOCUMENT, "a document is needed", "insert_document", box(1))


def test_a_node_is_replaced_where_another_cannot_stand_beside_it():
    after = do(DOCUMENT, "replace", "n8", circle(4))
    assert find(after, "n7").children[0] == circle(4)
    assert do(DOCUMENT, "replace", "n4", sphere(1)).solids[1].name == "lid"
    refused(DOCUMENT, "takes an outline", "replace", "n8", box(1))
    refused(DOCUMENT, "is an outline, which is flat", "replace", "n2", circle(1))


# What is taken out.


def test_nodes_are_deleted_with_what_is_below():
    after = do(DOCUMENT, "delete", ["n1", "n2", "n5"])
    assert ids(*after.solids) == ["n4", "n7"] and after.solids[0] is DOCUMENT.solids[1]
    assert do(DOCUMENT, "delete", []) is DOCUMENT
    assert find(do(DOCUMENT, "delete", ["n2", "n3"]), "n1").children == ()
    refused(DOCUMENT, "cannot be without", "delete", ["n6"])
    refused(DOCUMENT, "cannot be without", "delete", ["n4", "n8"])
    refused(DOCUMENT, "no node n99", "delete", ["n1", "n99"])


LINKED = do(do(DOCUMENT, "link", "n4"), "insert", instance("n4").at(50))


def test_a_definition_in_use_stays():
    refused(LINKED, "“lid” is still used by “lid”", "delete", ["n4"])
    after = do(LINKED, "delete", ["n4", "n9", "n10"])
    assert after.definitions == () and ids(*after.solids) == ["n1", "n5", "n7"]
    unused = do(LINKED, "delete", ["n9", "n10"])
    assert do(unused, "delete", ["n4"]).definitions == ()


# Dress and size.


def test_solids_have_names_of_their_own():
    assert do(DOCUMENT, "rename", "n1", "  big   body ").solids[0].name == "big body"
    assert find(do(DOCUMENT, "rename", "n2", "lid"), "n2").name == "lid"
    assert do(DOCUMENT, "rename", "n1", "body") is DOCUMENT
    refused(DOCUMENT, "called “lid” already", "rename", "n1", "lid ")
    refused(DOCUMENT, "needs a name", "rename", "n1", " ")
    assert DOCUMENT.solids[0].digest == do(DOCUMENT, "rename", "n2", "x").solids[0].digest


def test_a_field_is_set():
    after = do(DOCUMENT, "set_field", "n3", "radius", "2 in")
    assert find(after, "n3").radius.text == "2 in"
    assert do(after, "set_field", "n3", "radius", "2 in") is after
    assert do(DOCUMENT, "set_field", "n3", "radius", 2) is DOCUMENT
    refused(DOCUMENT, "no field 'height'", "set_field", "n3", "height", 2)
    refused(DOCUMENT, "Sphere: radius must be a finite number", "set_field", "n3", "radius", "nan")
    refused(DOCUMENT, "no parameter called w", "set_field", "n3", "radius", "w")
    refused(LINKED, "no definition gone", "set_field", "n10", "definition", "gone")


def test_placements_are_set_and_moved():
    after = do(DOCUMENT, "place", "n2", at(1), turned(z=90))
    assert find(after, "n2").placement.steps == (at(1), turned(z=90))
    assert do(after, "place", "n2", at(1), turned(z=90)) is after
    assert find(do(after, "move", ["n2", "n1"], 5), "n2") is find(after, "n2")  # it goes with what it stands in
    assert do(DOCUMENT, "move", ["n2"]) is DOCUMENT
    refused(DOCUMENT, "no parameter called w", "move", ["n2"], "w")
    refused(DOCUMENT, "no parameter called w", "place", "n2", at("w"))
    refused(DOCUMENT, "moves, turns", "place", "n2", (1, 2, 3))
    refused(DOCUMENT, "finite", "move", ["n2"], float("inf"))


def test_dress_is_set_on_many():
    after = do(DOCUMENT, "set_colour", ["n1", "n2"], "red")
    assert find(after, "n1").colour == find(after, "n2").colour == "#ff0000"
    assert do(after, "set_colour", ["n1", "n2"], "#F00") is after
    assert find(do(after, "set_colour", ["n1"], None), "n1").colour is None
    assert do(DOCUMENT, "set_visible", "n1", 1) is DOCUMENT
    assert not find(do(DOCUMENT, "set_visible", ["n1"], False), "n1").visible
    assert find(do(DOCUMENT, "set_note", "n1", "words"), "n1").note == "words"
    assert do(DOCUMENT, "set_note", "n1", "") is DOCUMENT
    refused(DOCUMENT, "no colour", "set_colour", ["n1"], "reddish")
    refused(DOCUMENT, "told by their ids", "set_colour", None, "red")


# What stands where.


def test_roots_are_combined_in_the_order_given():
    after = do(DOCUMENT, "combine", "difference", ["n5", "n1"])
    assert [solid.name for solid in after.solids] == ["lid", "Difference", "Extrusion"]
    assert after.solids[1].children == (DOCUMENT.solids[2], DOCUMENT.solids[0])
    assert after.solids[1].children[1] is DOCUMENT.solids[0]


def test_an_operand_is_combined_in_its_place():
    after = do(DOCUMENT, "combine", "hull", ["n2"])
    hulled, ball = after.solids[0].children
    assert hulled == hull(box(1)) and hulled.children[0] is find(DOCUMENT, "n2") and ball is find(DOCUMENT, "n3")


@pytest.mark.parametrize("wrap", [linear_array, polar_array, mirror])
def test_the_operand_of_an_array_or_a_mirror_is_combined(wrap):
    document = document_of(wrap(box(1)), sphere(1))
    after = do(document, "combine", "union", ["n2", "n3"])
    assert len(after.solids) == 1 and after.solids[0].children[0] == union(box(1), sphere(1))


def test_many_under_an_array_are_joined_first():
    after = do(DOCUMENT, "combine", "linear_array", ["n1", "n4"])
    assert isinstance(after.solids[0], LinearArray) and isinstance(after.solids[0].children[0], Union)
    assert after.solids[0].children[0].children[1] is DOCUMENT.solids[1]


def test_nodes_from_elsewhere_keep_their_place_in_space_when_combined():
    after = do(DOCUMENT, "combine", "union", ["n4", "n2"])
    assert in_space(after, "n2") == pytest.approx(in_space(DOCUMENT, "n2"))
    inner = do(DOCUMENT, "combine", "union", ["n2", "n4"])
    assert in_space(inner, "n4") == pytest.approx(in_space(DOCUMENT, "n4"))
    assert find(inner, "n2") is find(DOCUMENT, "n2")


@pytest.mark.parametrize(
    ("kind", "chosen", "words"),
    [
        ("box", ["n1"], "does not join solids"),
        ("instance", ["n1", "n4"], "does not join solids"),
        ("extrude", ["n1"], "does not join solids"),
        ("nonsense", ["n1"], "no operation called"),
        ("union", [], "select what"),
        ("hull", ["n8"], "outline"),
        ("union", ["n1", "n8"], "some of these are solids"),
        ("union", ["n1", "n6"], "cannot be without"),
        ("union", ["n99"], "no node n99"),
    ],
)
def test_what_cannot_be_combined(kind, chosen, words):
    refused(DOCUMENT, words, "combine", kind, chosen)


def test_an_operation_is_dissolved_and_nothing_moves():
    document = do(do(DOCUMENT, "set_colour", ["n1"], "red"), "set_colour", ["n3"], "blue")
    after = do(document, "dissolve", "n1")
    assert [solid.name for solid in after.solids] == ["Box", "Sphere", "lid", "Linear array", "Extrusion"]
    for node_id in ("n2", "n3"):
        assert in_space(after, node_id) == pytest.approx(in_space(document, node_id))
    assert [solid.colour for solid in after.solids[:2]] == ["#ff0000", "#0000ff"]
    hidden = do(do(DOCUMENT, "set_visible", ["n1"], False), "dissolve", "n1")
    assert not hidden.solids[0].visible


@pytest.mark.parametrize("keep", [True, False])
def test_the_operand_of_a_mirror_stays_where_it_was_seen(keep):
    width = parameter("width", 3)
    document = document_of(
        union(mirror(box(1).at(5), (1, 1, 0), (width, 0, 0), keep=keep).scaled(1, 2, 1).turned(z=20))
    )
    after = do(document, "dissolve", "n2")
    assert find(after, "n1").children[0] == find(after, "n3")
    assert in_space(after, "n3") == pytest.approx(in_space(document, "n3"))


def test_what_cannot_be_dissolved():
    refused(DOCUMENT, "no operands to set free", "dissolve", "n2")
    document = document_of(mirror(union(box(1), box(2))))
    refused(document, "takes only 1 operand", "dissolve", "n2")
    assert len(do(document, "dissolve", "n1").solids) == 1


def test_an_operation_changes_its_kind_and_keeps_what_both_have():
    after = do(DOCUMENT, "change_kind", "n1", "difference")
    assert isinstance(after.solids[0], Difference) and after.solids[0].children is DOCUMENT.solids[0].children
    assert after.solids[0].placement is DOCUMENT.solids[0].placement and after.solids[0].name == "body"
    assert do(DOCUMENT, "change_kind", "n1", "union") is DOCUMENT
    many = do(do(DOCUMENT, "set_field", "n5", "count", 9), "change_kind", "n5", "polar_array")
    assert isinstance(many.solids[2], PolarArray) and many.solids[2].count == 9
    assert many.solids[2].name == "Polar array"  # it was named after its kind
    high = do(DOCUMENT, "change_kind", "n7", "revolve")
    assert isinstance(high.solids[3], Revolve)
    assert isinstance(do(high, "change_kind", "n7", "extrude").solids[3], Extrude)
    refused(DOCUMENT, "takes only 1 operand", "change_kind", "n1", "mirror")
    for node_id, kind in (("n2", "union"), ("n7", "union"), ("n5", "extrude"), ("n1", "instance"), ("n5", "box")):
        refused(DOCUMENT, "cannot become", "change_kind", node_id, kind)
    refused(do(DOCUMENT, "delete", ["n2", "n3"]), "needs an operand", "change_kind", "n1", "mirror")


def test_nodes_are_relocated_and_nothing_moves():
    after = do(DOCUMENT, "relocate", ["n4", "n2"], "n1", 2)
    assert ids(*find(after, "n1").children) == ["n3", "n4", "n2"]
    assert in_space(after, "n4") == pytest.approx(in_space(DOCUMENT, "n4"))
    assert find(after, "n2") is find(DOCUMENT, "n2")
    out = do(DOCUMENT, "relocate", ["n3"], None, 0)
    assert [solid.name for solid in out.solids] == ["Sphere", "body", "lid", "Linear array", "Extrusion"]
    assert in_space(out, "n3") == pytest.approx(in_space(DOCUMENT, "n3"))
    back = do(out, "relocate", ["n3"], "n1")
    assert in_space(back, "n3") == pytest.approx(in_space(DOCUMENT, "n3"))


def test_siblings_change_their_order():
    assert ids(*do(DOCUMENT, "relocate", ["n7"], None, 0).solids) == ["n7", "n1", "n4", "n5"]
    assert ids(*do(DOCUMENT, "relocate", ["n1"], None, 2).solids) == ["n4", "n1", "n5", "n7"]
    assert ids(*do(DOCUMENT, "relocate", ["n1"], None).solids) == ["n4", "n5", "n7", "n1"]
    assert do(DOCUMENT, "relocate", ["n4"], None, 1) is DOCUMENT
    assert do(DOCUMENT, "relocate", ["n4"], None, 2) is DOCUMENT
    assert do(DOCUMENT, "relocate", ["n6"], "n5") is DOCUMENT


@pytest.mark.parametrize(
    ("chosen", "parent_id", "index", "words"),
    [
        (["n1"], "n1", None, "into itself"),
        (["n1"], "n2", None, "into itself"),
        (["n4"], "n5", None, "takes only 1 operand"),
        (["n4"], "n2", None, "holds no operands"),
        (["n4"], "n7", None, "takes an outline"),
        (["n8"], None, None, "cannot be without"),
        (["n8"], "n1", None, "is an outline, which is flat"),
        (["n6"], None, None, "cannot be without"),
        (["n4"], "n1", 3, "places go from 0 to 2"),
        (["n4"], None, -1, "places go from 0 to 4"),
        (["n4"], "n99", None, "no node"),
        (["n99"], None, None, "no node"),
    ],
)
def test_what_cannot_be_relocated(chosen, parent_id, index, words):
    refused(DOCUMENT, words, "relocate", chosen, parent_id, index)


def test_an_expression_in_a_placement_is_taken_back_too():
    width = parameter("width", 4)
    document = document_of(union(box(1)).at(width).turned(z=width).scaled(2), sphere(1))
    after = do(document, "relocate", ["n3"], "n1")
    assert find(after, "n3").placement.symbolic()
    assert in_space(after, "n3") == pytest.approx(np.eye(3, 4))


def test_flattened_parents_take_nothing_from_outside():
    document = do(DOCUMENT, "place", "n1", Scale((1, 0, 1)))
    refused(document, "flat", "relocate", ["n4"], "n1")


def test_copies_stand_beside_their_originals():
    after = do(DOCUMENT, "duplicate", ["n1", "n3", "n4"])
    assert [solid.name for solid in after.solids] == ["body", "body 2", "lid", "lid 2", "Linear array", "Extrusion"]
    assert after.solids[1] == after.solids[0] and after.solids[0] is DOCUMENT.solids[0]
    inner = do(DOCUMENT, "duplicate", ["n2"])
    assert ids(*find(inner, "n1").children) == ["n2", "n9", "n3"]
    refused(DOCUMENT, "takes only 1 operand", "duplicate", ["n6"])
    refused(DOCUMENT, "takes only 1 operand", "duplicate", ["n8"])


# Definitions.


def test_a_linked_node_looks_the_same_and_can_be_used_again():
    document = do(DOCUMENT, "set_colour", ["n1"], "red")
    after = do(document, "link", "n1")
    (definition,) = after.definitions
    assert (
        definition.id == "n1"
        and definition.placement.steps == ()
        and definition.children is document.solids[0].children
    )
    held = after.solids[0]
    assert (held.name, held.colour, held.placement) == ("body", "#ff0000", document.solids[0].placement)
    measured = [evaluate(d).total().volume() for d in (document, after)]
    assert measured[0] == pytest.approx(measured[1])
    back = do(after, "unlink", held.id)
    assert back.definitions == () and back.solids[0] == document.solids[0] and back.solids[0].id == held.id
    assert back.solids[0].colour == "#ff0000"


def test_a_definition_lives_as_long_as_an_instance():
    after = do(LINKED, "unlink", "n10")
    assert len(after.definitions) == 1 and find(after, "n10") == box(3).at(50)
    assert do(after, "unlink", "n9").definitions == ()


def test_an_instance_inside_an_array_is_linked_and_unlinked():
    document = do(DOCUMENT, "link", "n6")
    assert isinstance(find(document, "n5").children[0], Instance)
    assert do(document, "unlink", "n9").solids == DOCUMENT.solids


def test_what_cannot_be_linked():
    refused(LINKED, "an instance already", "link", "n9")
    refused(LINKED, "a definition already", "link", "n4")
    refused(DOCUMENT, "not an instance", "unlink", "n1")
    lost = Document(solids=(instance("gone").named("x").with_(id="n1"),))
    refused(lost, "gone.* is not in the document", "unlink", "n1")


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("combine", ("union", ["n4"])),
        ("combine", ("union", ["n1", "n4"])),
        ("relocate", (["n4"], "n1")),
        ("relocate", (["n4"], None, 0)),
        ("duplicate", (["n4"],)),
        ("dissolve", ("n4",)),
        ("replace", ("n4", sphere(1))),
    ],
)
def test_the_root_of_a_definition_stays_in_its_place(name, arguments):
    document = do(do(DOCUMENT, "combine", "union", ["n4"]), "link", "n9")
    assert document.definitions[0].id == "n9"
    swapped = tuple("n9" if a == "n4" else [x if x != "n4" else "n9" for x in a] if isinstance(a, list) else a
                    for a in arguments)  # fmt: skip
    refused(document, "is a definition", name, *swapped)


def test_a_definition_cannot_come_to_hold_itself():
    document = do(DOCUMENT, "link", "n1")  # n9 is its instance
    refused(document, "would hold itself", "relocate", ["n9"], "n1")
    refused(document, "would hold itself", "insert", instance("n1"), "n1")
    refused(document, "would hold itself", "combine", "union", ["n2", "n9"])
    outer = do(do(document, "combine", "union", ["n9", "n4"]), "link", "n10")
    refused(outer, "would hold itself", "insert", instance("n10"), "n1")
    assert do(outer, "insert", instance("n1"), "n10")


def test_the_inside_of_a_definition_is_edited_like_the_rest():
    document = do(DOCUMENT, "link", "n1")
    assert find(do(document, "set_field", "n2", "size", (5, 5, 5)), "n2").size == (5, 5, 5)
    after = do(document, "combine", "hull", ["n2", "n3"])
    assert after.definitions[0].children[0].children[0] is find(document, "n2")
    assert ids(*do(document, "relocate", ["n4"], "n1").definitions[0].children) == ["n2", "n3", "n4"]


# Parameters.


def test_parameters_are_set_declared_and_kept_in_order():
    document = do(do(DOCUMENT, "set_parameter", "a", 2, minimum=1, note="x"), "set_parameter", "b", "a * 2")
    after = do(document, "set_parameter", "a", 5)
    first = after.parameters[0]
    assert (first.name, first.value, first.minimum) == ("a", 5, 1)
    assert after.parameters[1] is document.parameters[1] and after.solids is document.solids
    assert do(document, "set_parameter", "a", 2) is document
    refused(document, "at least 1", "set_parameter", "a", 0)
    refused(document, "no parameter called c", "set_parameter", "a", "c")
    refused(document, "a parameter has no colour", "set_parameter", "a", 3, colour="red")
    refused(document, "name of a function", "set_parameter", "sin", 3)
    refused(document, "finite", "set_parameter", "a", float("nan"))


def test_a_parameter_in_use_stays():
    document = do(do(DOCUMENT, "set_parameter", "a", 2), "set_parameter", "b", "a * 2")
    document = do(do(document, "set_field", "n4", "size", ("b", 1, 1)), "move", ["n2"], "b")
    refused(document, "used by the parameter b", "delete_parameter", "a")
    refused(document, "used by “Box”", "delete_parameter", "b")
    refused(document, "no parameter called c", "delete_parameter", "c")
    free = do(do(document, "place", "n2"), "set_field", "n4", "size", (1, 1, 1))
    assert do(do(free, "delete_parameter", "b"), "delete_parameter", "a").parameters == ()


def test_a_parameter_is_renamed_wherever_it_stands():
    document = do(do(DOCUMENT, "set_parameter", "a", 2), "set_parameter", "b", "a * 2 + max(a, 1)")
    document = do(do(document, "set_field", "n4", "size", ("b", "a", 1)), "move", ["n2"], "a")
    after = do(document, "rename_parameter", "a", "width")
    assert [(p.name, str(p.value)) for p in after.parameters] == [("width", "2.0"), ("b", "width * 2 + max(width, 1)")]
    assert [str(n) for n in find(after, "n4").size] == ["b", "width", "1.0"]
    assert find(after, "n2").placement.steps[0] == Move(("width", 0, 0)) and find(after, "n3") is find(document, "n3")
    assert resolve(after).solids == resolve(document).solids
    refused(document, "parameter called b already", "rename_parameter", "a", "b")
    refused(document, "no name", "rename_parameter", "a", "2a")
    assert do(document, "rename_parameter", "a", "a") is document


# Size.


def test_deep_trees_pass_through_every_operation():
    node = box(1)
    for _ in range(3000):
        node = Union(children=(node,))
    document = do(Document(), "insert", node)
    deep = "n3001"
    document = do(document, "set_parameter", "w", 2)
    document = do(document, "set_field", deep, "size", ("w", 1, 1))
    document = do(document, "place", deep, at(1))
    for name, arguments in [
        ("insert", (box(2), "n3000")),
        ("replace", (deep, box(2))),
        ("insert_document", (document,)),
        ("rename", (deep, "x")),
        ("move", ([deep], 1)),
        ("set_colour", ([deep, "n1"], "red")),
        ("set_visible", ([deep], False)),
        ("set_note", (deep, "x")),
        ("combine", ("union", [deep])),
        ("combine", ("union", ["n1"])),
        ("dissolve", ("n3000",)),
        ("change_kind", ("n2000", "difference")),
        ("relocate", ([deep], None)),
        ("duplicate", (["n1"],)),
        ("link", ("n2",)),
        ("rename_parameter", ("w", "v")),
        ("delete", (["n2"],)),
    ]:
        assert do(document, name, *arguments) is not document
    linked = do(document, "link", "n2")
    assert do(linked, "unlink", find(linked, "n1").children[0].id).definitions == ()
    refused(document, "is used by", "delete_parameter", "w")
    assert sum(1 for _ in walk(*resolve(linked).solids)) == 3002


def test_one_of_a_thousand_shares_the_others():
    plate = document_of(union(*[Box() for _ in range(1000)]))
    after = do(plate, "move", ["n500"], 1)
    same = [a is b for a, b in zip(plate.solids[0].children, after.solids[0].children, strict=True)]
    assert same.count(False) == 1 and not same[498]


def test_a_document_put_into_another_brings_its_sets_and_closed_sections():
    width = (Parameter("width", 3),)
    here = Document(parameters=width, sets=(ParameterSet("wide", (("width", 9),)),), sections=(Section("cut"),))
    there = Document(parameters=width, sets=(ParameterSet("wide", (("width", 7),)),), sections=(Section("cut"),))
    after = OPERATIONS["insert_document"](here, there)
    assert [(one.name, one.values) for one in after.sets] == [
        ("wide", (("width", 9.0),)),
        ("wide 2", (("width", 7.0),)),
    ]
    assert [(one.name, one.active) for one in after.sections] == [("cut", True), ("cut 2", False)]
