"""Nodes as Python: what is written makes an equal node again, dress included."""

import numpy as np
import pytest

from solidtree.model import script
from solidtree.model.document.document import Document
from solidtree.model.document.expression import Expression
from solidtree.model.document.kind_names import function_name
from solidtree.model.document.nodes import KINDS, Union
from solidtree.model.document.outlines import Rectangle
from solidtree.model.document.placement import Affine, Move, Placement, Reflect, Scale, Turn
from solidtree.model.document.primitives import Polyhedron
from solidtree.model.document.table import same_document
from solidtree.model.document.tree import numbered
from solidtree.model.editing.echo import call, script_of
from solidtree.model.script import (
    box,
    circle,
    cylinder,
    difference,
    extrude,
    instance,
    material,
    parameter,
    polar_array,
    sphere,
    texture,
)

NAMES = {name: getattr(script, name) for name in script.__all__}
WIDTH = parameter("width", 3)


def same(one, other):
    return same_document(*(Document(solids=numbered([node])) for node in (one, other)))


def made(text):
    return eval(text, dict(NAMES))


@pytest.mark.parametrize("kind", [kind for name, kind in sorted(KINDS.items()) if name != "Broken"])
def test_every_kind_is_made_by_its_function(kind):
    assert function_name(kind) in script.__all__
    node = kind(children=(Rectangle(),) * kind.operands[0])
    again = made(script_of(node))
    assert again == node and type(again) is kind


@pytest.mark.parametrize(
    "node",
    [
        box(1, 2.5, "width / 3", centred=True),
        box(0.1 + 0.2).at(1e-20, 1e20, -3),
        cylinder(WIDTH * 2, 5, segments=7, tolerance=0.01)
        .turned(x=90)
        .at(y="2 in")
        .scaled(2, 1, 1)
        .mirrored((1, 1, 0)),
        sphere().transformed(np.arange(12).reshape(3, 4) / 7),
        sphere().named("it's “x”\n\\").coloured("steelblue").noted('a "note"\n').hidden(),
        (sphere().named("a") - box(1) - box(2)).at(1).at("w").at(2),
        extrude(circle(WIDTH).at(3), 5, twist=30, top_scale=0.5),
        polar_array(instance("n7").at(5), 5, 90, (0, 1, 0), (1, 2, 3)),
        Polyhedron(points=((0, 0, 0), (1, 0, "w"), (0, 1, 0), (0, 0, 1)), faces=((0, 2, 1), (0, 1, 3))),
        difference(),
        box(1).with_(placement=Placement((Move((1, 0, 0)), Move((2, 0, 0)), Turn((0, 0, 0))))),
        box(1).with_(placement=Placement((Move((0, 0, 0)), Scale((1, 2, 3)), Reflect((1, 0, 0))))),
        box(1).with_(placement=Placement((Move((1, 1, 1)), Move((-1, -1, -1)), Affine(tuple(range(12)))))),
        box(Expression("5")),
        box(1).dressed(material("red", "Plastic", bump="ab" * 32, key="white")),
        (box(1).dressed("red") + box(2)).dressed(texture(projection="box", size=(5, 5), mirror=(True, False), turn=30)),
    ],
)
def test_what_is_written_makes_the_same_node(node):
    again = made(script_of(node))
    assert again == node and same(again, node)
    assert script_of(again) == script_of(node)


def test_defaults_are_left_out_and_numbers_are_plain():
    assert script_of(box(1, 2, 3).at(0.5)) == "box(size=(1, 2, 3)).at(0.5, 0, 0)"
    assert script_of(box() + sphere(WIDTH / 2)) == "union(box(), sphere(radius='width / 2'))"


def test_calls_are_written_with_what_they_were_called_with():
    assert call("delete", ["n1", "n2"]) == "delete(['n1', 'n2'])"
    assert call("set_field", "n1", "size", (1.0, np.float64(2.5), "w")) == "set_field('n1', 'size', (1, 2.5, 'w'))"
    assert call("set_field", "n1", "size", np.array([1.0, 2.5, 3])) == "set_field('n1', 'size', [1.0, 2.5, 3.0])"
    assert call("place", "n1", Move((1, 2, 3)), Reflect((1, 0, 0))) == "place('n1', at(1, 2, 3), mirrored((1, 0, 0)))"
    assert call("set_parameter", "w", Expression("2 in"), minimum=1.0) == "set_parameter('w', '2 in', minimum=1)"
    assert call("combine", Union, ["n1"]) == "combine('union', ['n1'])"
    assert call("move", ["n1"], np.int64(3)) == "move(['n1'], 3)"
    assert call("set_colour", ["n1"], None) == "set_colour(['n1'], None)"


def test_a_document_is_written_whole():
    document = Document(solids=numbered([box(WIDTH).named("a")]), definitions=(box(2).with_(id="d"),), notes="x")
    text = call("insert_document", document)
    again = eval(text.removeprefix("insert_document"), dict(NAMES))
    assert same_document(again, document)


def test_trees_too_deep_for_python_are_written_as_tables():
    node = box(1)
    for _ in range(3000):
        node = Union(children=(node,))
    assert script_of(node).count("union(") == 3000
    again = made(call("insert", node).removeprefix("insert"))
    assert again == node
