"""The script API: its own examples, documents made of solids, parameters collected, files written and read."""

import doctest

import pytest

from solidtree.model import script
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Node, Union
from solidtree.model.document.table import same_document
from solidtree.model.document.tree import walk
from solidtree.model.script import (
    box,
    cylinder,
    document_of,
    linear_array,
    measure,
    open_document,
    parameter,
    save,
    sphere,
    union,
)
from solidtree.model.scripting import (
    documents,
    faults,
    hidden_surfaces,
    joining,
    letters,
    motions,
    pipelines,
    proximity,
    shapes,
    sight,
    structures,
)

PARTS = (
    shapes, letters, joining, documents, hidden_surfaces, sight, faults, motions, pipelines, proximity, structures,
)  # fmt: skip


def test_the_examples_in_the_words_are_true():
    names = {name: getattr(script, name) for name in script.__all__}
    results = [doctest.testmod(part, extraglobs=names, optionflags=doctest.ELLIPSIS) for part in PARTS]
    assert sum(one.attempted for one in results) > 20 and not any(one.failed for one in results)


def test_all_that_is_offered_exists_and_is_explained():
    for name in script.__all__:
        assert getattr(script, name).__doc__, name


def test_a_keyword_is_a_solids_name_and_names_are_single():
    document = document_of(box(1), box(2), sphere(1).named("ball"), ball=box(3), lid=box(4).named("x"))
    assert [solid.name for solid in document.solids] == ["Box", "Box 2", "ball", "ball 2", "lid"]
    assert [node.id for node in walk(*document.roots)] == ["n1", "n2", "n3", "n4", "n5"]
    assert document_of(document) is document
    for wrong in ("box", None, [box(1)], (document, box(1))):
        with pytest.raises(Refusal, match="a document holds solids"):
            document_of(*wrong) if isinstance(wrong, tuple) else document_of(wrong)


def test_parameters_are_collected_from_every_number():
    width, height = parameter("width", 10, minimum=1), parameter("height", 4)
    gap = parameter("gap", width / 4 + height)
    part = union(box(width, 2, 3).at(z=height), linear_array(cylinder("height / 2"), 3, (gap, 0, 0)))
    document = document_of(part)
    assert {p.name: str(p.value) for p in document.parameters} == {
        "width": "10.0",
        "height": "4.0",
        "gap": "width / 4 + height",
    }
    assert measure(box(width, height, 2)).volume == 80


def test_parameters_that_disagree_or_are_missing_are_refused():
    with pytest.raises(Refusal, match="width is declared twice"):
        document_of(box(parameter("width", 1)), box(parameter("width", 2)))
    assert document_of(box(parameter("width", 1)), box(parameter("width", 1)))
    with pytest.raises(Refusal, match=r"no parameter called depth; declare it with parameter\('depth'"):
        document_of(box("depth"))
    with pytest.raises(Refusal, match="no parameter called depth"):
        document_of(box(parameter("width", "depth * 2")))
    with pytest.raises(Refusal, match="letters, digits"):
        parameter("a b", 1)


def test_a_project_comes_back_as_it_was_saved(tmp_path):
    width = parameter("width", 10, note="across")
    written = save(tmp_path / "part.solidtree", body=(box(width) - sphere(3).named("hole")).coloured("red"), pin=box(1))
    assert [solid.name for solid in written.solids] == ["body", "pin"]
    again = open_document(tmp_path / "part.solidtree")
    assert same_document(again, written)
    assert again.parameters == written.parameters


def test_a_mesh_file_holds_the_shape(tmp_path):
    save(tmp_path / "part.stl", box(2, 3, 4))
    assert measure(open_document(tmp_path / "part.stl").solids[0]).volume == pytest.approx(24)
    assert measure(script.mesh(tmp_path / "part.stl")).volume == pytest.approx(24)


def test_a_solid_that_has_no_measures_says_why():
    with pytest.raises(Refusal, match="size must be above 0"):
        measure(box(0))
    with pytest.raises(Refusal, match="divides by zero"):
        measure(box("1 / 0"))


def test_boxes_are_written_in_many_ways():
    assert box(1, 2, 3) == box((1, 2, 3)) == box([1, 2, 3]) == box(size=(1, 2, 3)) == box(iter((1, 2, 3)))
    assert box(5) == box(size=5) == box(x="5")


def test_joining_functions_take_one_by_one_or_in_lists():
    parts = [box(1), box(2), box(3)]
    assert union(*parts) == union(parts) == union(parts[0], (p for p in parts[1:]))
    assert script.difference(parts[0], parts[1:]) == parts[0] - parts[1] - parts[2]
    assert isinstance(union(), Union)


def test_placement_steps_are_those_of_the_methods():
    steps = script.at(1, z=2), script.turned(y=3), script.scaled(2), script.mirrored((1, 1, 0)), script.at(y="w")
    node = box(1).at(1, z=2).turned(y=3).scaled(2).mirrored((1, 1, 0)).at(y="w")
    assert box(1).placed(*steps) == node


def test_deep_trees_are_documents():
    node: Node = box(1)
    for _ in range(3000):
        node = Union(children=(node,))
    assert len(list(walk(*document_of(node).roots))) == 3001
