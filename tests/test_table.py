"""The table of a document: there and back, what is refused, and what stays the very same."""

import json
import math

import pytest

from solidtree.model.document.document import Document, Parameter
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Instance, Union
from solidtree.model.document.table import from_table, same_document, to_table
from solidtree.model.document.tree import walk
from solidtree.model.script import (
    box,
    circle,
    cylinder,
    document_of,
    extrude,
    imported_mesh,
    instance,
    parameter,
    polyhedron,
    sphere,
    union,
)

WIDTH = parameter("width", 10, minimum=1, maximum=20, choices=(10, 12), note="across", group="size")
BOLT = cylinder(WIDTH / 4, 10.5).with_(id="bolt").named("bolt")
DOCUMENT = Document(
    solids=(
        (union(box(WIDTH, "2 in", 3), sphere(2).at(1).turned(0, 0, 30)) - extrude(circle(1e-7)))
        .named("body").coloured("red").noted("words\n“x”").hidden(),
        instance("bolt").at(1e300).named("one"),
    ),
    definitions=(BOLT,),
    profiles=(circle(3),),
    parameters=(Parameter("width", 10, 1, 20, (10, 12), "across", "size"), Parameter("half", "width / 2")),
    notes="of the whole",
)  # fmt: skip


def through_json(document):
    return from_table(json.loads(json.dumps(to_table(document), allow_nan=False)))


def test_a_document_comes_back_the_same():
    again = through_json(DOCUMENT)
    assert same_document(again, DOCUMENT)
    assert again.solids == DOCUMENT.solids and again.definitions == DOCUMENT.definitions
    assert [n.id for n in walk(*again.roots)] == [n.id for n in walk(*DOCUMENT.roots)]
    assert again.parameters == DOCUMENT.parameters and again.notes == DOCUMENT.notes
    assert to_table(again) == to_table(DOCUMENT)


def test_fields_that_begin_like_an_expression_and_are_text_stay_text():
    document = Document(solids=(imported_mesh("=abc", "=stl"), Instance(definition="=x")))
    assert same_document(through_json(document), document)


def test_defaults_are_left_out():
    row = to_table(Document(solids=(box().with_(id="n1"),)))["nodes"]["n1"]
    assert row == {"kind": "Box"}


def test_numbers_keep_every_bit():
    numbers = (0.1, 1 / 3, 1e-300)
    assert through_json(Document(solids=(box(numbers),))).solids[0].size == numbers
    points = [(0.1, 2, 3), (1e17, 5, 6), (7, 8, "width")]
    again = through_json(Document(solids=(polyhedron(points, [(0, 1, 2)]),))).solids[0]
    assert again == polyhedron(points, [(0, 1, 2)])


def table(**nodes):
    return {"nodes": nodes, "solids": [next(iter(nodes))]}


def boxes(**fields):
    return table(n1={"kind": "Box", **fields})


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (boxes(kind="Ball"), "n1 is of an unknown kind, 'Ball'"),
        (boxes(kind="Node"), "unknown kind"),
        (boxes(kind="Broken"), "unknown kind"),
        (boxes(kind=["Box"]), "unknown kind"),
        (boxes(sise=[1, 2, 3]), "n1: Box has no field 'sise'"),
        (boxes(size=[1, 2]), "n1: Box: size must be 3 numbers"),
        (boxes(size=[1, 2, math.nan]), "n1: Box: size must be a finite number"),
        (boxes(size=[1, 2, math.inf]), "n1: Box: size must be a finite number"),
        (boxes(size=[1, 2, "=1 +"]), "n1: .*cannot be read"),
        (boxes(size=[1, 2, [3]]), "n1: Box: size must be a number"),
        (boxes(size=[1, 2, True]), "n1: Box: size must be a number"),
        (boxes(size=None), "n1: Box: size"),
        (boxes(size={"x": 1}), "n1: Box: size"),
        (boxes(size=[[[[1]]]]), "n1: .*too deep"),
        (boxes(centred="yes"), "n1: Box: centred must be true or false"),
        (boxes(name=5), "n1: “name” must be text"),
        (boxes(visible=1), "n1: “visible” must be true or false"),
        (boxes(colour="nope"), "n1: 'nope' is no colour"),
        (boxes(colour=5), "n1: 5 is no colour"),
        (boxes(placement=5), "n1: “placement” must be a list"),
        (boxes(placement=[["fly", 1]]), "n1: .* is no step of a placement; known are move"),
        (boxes(placement=[["move", 1, 2]]), "n1: move must be 3 numbers"),
        (boxes(placement=[["move", 1, 2, math.nan]]), "n1: move must be a finite number"),
        (boxes(placement=[[]]), "n1: .* no step"),
        (boxes(children=["n1"]), "n1 has two places"),
        (boxes(children=["n2"]), "node n2, asked for by node n1, is missing"),
        (boxes(children=[5]), "an id in node n1: “children” must be text"),
        (boxes(children="n2"), "node n1: “children” must be a list"),
        (table(n1={"kind": "Box", "children": ["n2"]}, n2={"kind": "Box"}), "n1: Box takes 0 operands, not 1"),
        (table(n1={"kind": "Mirror"}), "n1: Mirror takes 1 operand, not 0"),
        (table(n1={"kind": "Instance", "children": ["n2"]}, n2={"kind": "Box"}), "n1: an instance holds no operands"),
        (table(n1={"kind": "Union", "children": ["n2", "n2"]}, n2={"kind": "Box"}), "n2 has two places"),
        (
            table(n1={"kind": "Union", "children": ["n2"]}, n2={"kind": "Union", "children": ["n1"]}),
            "n1 has two places",
        ),
        (table(n1=5), "n1, asked for by “solids”, is missing"),
        ({"nodes": 5}, "“nodes” must be an object"),
        ({"nodes": {}, "solids": 5}, "“solids” must be a list"),
        ({"nodes": {}, "solids": ["n1"]}, "n1, asked for by “solids”, is missing"),
        ({"nodes": {}, "solids": ["n" * 101]}, "more than 100 characters"),
        ({"nodes": {"n1": {"kind": "Box"}}, "solids": ["n1"], "definitions": ["n1"]}, "n1 has two places"),
        ({"notes": 5}, "“notes” must be text"),
        ({"parameters": 5}, "“parameters” must be a list"),
        ({"parameters": [5]}, "a parameter must be an object"),
        ({"parameters": [{"name": "a"}]}, "'a' has no value"),
        ({"parameters": [{"name": "a", "value": 1, "colour": 2}]}, "'a' has no field colour"),
        ({"parameters": [{"name": "a", "value": math.nan}]}, "the parameter a must be a finite number"),
        ({"parameters": [{"name": "a", "value": 1, "choices": ["x"]}]}, "the parameter a: a choice must be a plain"),
        ({"parameters": [{"name": "a", "value": 1}] * 2}, "two parameters called a"),
        ({"parameters": [{"name": 5, "value": 1}]}, "a parameter's name must be text"),
    ],
)
def test_wrong_rows_are_refused_by_name(wrong, words):
    with pytest.raises(Refusal, match=words) as refusal:
        from_table(wrong)
    assert len(str(refusal.value)) < 300


def test_lists_in_lists_do_not_overflow():
    deep = []
    for _ in range(100_000):
        deep = [deep]
    with pytest.raises(Refusal, match="too deep"):
        from_table(boxes(size=deep))


def test_two_nodes_of_one_id_are_not_written():
    with pytest.raises(Refusal, match="two nodes have the id n1"):
        to_table(Document(solids=(box(1).with_(id="n1"), box(2).with_(id="n1"))))


def test_rows_that_are_as_they_were_give_the_very_nodes():
    reuse = {}
    document = document_of(union(box(1), sphere(2)), box(3))
    first = from_table(to_table(document), reuse)
    again = from_table(to_table(document), reuse)
    assert all(a is b for a, b in zip(first.solids, again.solids, strict=True))
    changed = document.with_(solids=(document.solids[0].at(1), document.solids[1]))
    third = from_table(to_table(changed), reuse)
    assert third.solids[0] is not first.solids[0] and third.solids[1] is first.solids[1]
    assert all(a is b for a, b in zip(third.solids[0].children, first.solids[0].children, strict=True))


def test_what_is_gone_is_not_kept_for_reuse():
    reuse = {}
    from_table(to_table(document_of(union(box(1), sphere(2)))), reuse)
    from_table(to_table(document_of(box(1))), reuse)
    assert len(reuse) == 1


def test_documents_are_the_same_whatever_their_ids():
    other = from_table(to_table(document_of(*DOCUMENT.solids[:0], box(1).named("a").coloured("red"))))
    renumbered = Document(solids=(box(1).named("a").coloured("red"),))
    assert same_document(other, renumbered)
    for different in (box(1).named("b").coloured("red"), box(1).named("a"), box(1).named("a").coloured("red").hidden(),
                      box(2).named("a").coloured("red")):  # fmt: skip
        assert not same_document(other, Document(solids=(different,)))
    one, two = (Document(solids=(instance(name),), definitions=(box(1).with_(id=name),)) for name in ("d", "e"))
    assert same_document(one, two) and not same_document(one, two.with_(notes="x"))


def test_deep_trees_come_back():
    node = box(1)
    for _ in range(3000):
        node = Union(children=(node, box(1)))
    document = Document(solids=(node,))
    assert same_document(through_json(document), document)
