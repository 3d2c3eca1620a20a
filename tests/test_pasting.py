"""Nodes through the clipboard: into the same document and into others, at another place of the tree, in the same
place in space."""

import numpy as np
import pytest

from solidtree.gui.tree.clipboard import read, script_text, text_of
from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Instance
from solidtree.model.document.placement import product
from solidtree.model.document.resolve import resolve
from solidtree.model.document.table import from_table, to_table
from solidtree.model.document.tree import find, trail, walk
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.operations.pasting import clip
from solidtree.model.script import box, circle, document_of, extrude, instance, parameter, sphere, union

WIDTH = parameter("width", parameter("base", 2) * 2)
# n1 (n2 box, n3 (n4 sphere)), n5 box
DOCUMENT = document_of(
    union(box(WIDTH, 1, 1).at(WIDTH), union(sphere(1).at(3)).turned(z=20)).at(10).turned(y=40).scaled(2).named("body"),
    box(5).named("lid"),
)


def do(document, name, *arguments):
    after = OPERATIONS[name](document, *arguments)
    assert to_table(from_table(to_table(after))) == to_table(after)
    return after


def in_space(document, node_id):
    matrix = np.eye(3, 4)
    for node in reversed(trail(Document(solids=resolve(document).solids), node_id)):
        matrix = product(node.placement.matrix(), matrix)
    return matrix


def test_pasted_beside_its_original_a_node_is_the_same():
    after = do(DOCUMENT, "paste", clip(DOCUMENT, ["n4"]), "n3")
    assert find(after, "n3").children == (sphere(1).at(3), sphere(1).at(3))  # no steps there and back


@pytest.mark.parametrize("node_id", ["n2", "n3", "n4", "n5"])
@pytest.mark.parametrize("parent_id", [None, "n1", "n3"])
def test_pasted_anywhere_a_node_keeps_its_place_in_space(node_id, parent_id):
    after = do(DOCUMENT, "paste", read(text_of(DOCUMENT, [node_id])), parent_id, 0)
    family = after.solids if parent_id is None else find(after, parent_id).children
    assert in_space(after, family[0].id) == pytest.approx(in_space(DOCUMENT, node_id))
    assert len(list(walk(*after.roots))) == len(list(walk(*DOCUMENT.roots))) + len(list(walk(find(DOCUMENT, node_id))))


def test_parameters_come_along_and_give_way_to_those_that_are_there():
    clipped = clip(DOCUMENT, ["n2"])
    assert [p.name for p in clipped.parameters] == ["base", "width"] and not clip(DOCUMENT, ["n5"]).parameters
    fresh = do(Document(), "paste", clipped)
    assert [p.name for p in fresh.parameters] == ["base", "width"] and resolve(fresh).solids[0].size[0] == 4
    changed = do(DOCUMENT, "set_parameter", "width", 9)
    after = do(changed, "paste", clipped)
    assert after.parameters == changed.parameters and resolve(after).solids[-1].size[0] == 9


def test_definitions_are_shared_within_a_document_and_come_along_into_others():
    linked = do(do(DOCUMENT, "link", ["n5"]), "insert", union(instance("n5").at(7)).named("pair"))
    pair = linked.solids[-1].id
    clipped = read(text_of(linked, [pair]))
    within = do(linked, "paste", clipped)
    assert within.definitions == linked.definitions and within.solids[-1] == linked.solids[-1]
    other = do(document_of(box(1), sphere(2)), "paste", clipped, None, 0)
    (definition,) = other.definitions
    assert definition == box(5) and other.solids[0].children[0].definition == definition.id
    alone = do(linked, "paste", clip(linked, ["n5"]))
    assert isinstance(alone.solids[-1], Instance) and alone.solids[-1].definition == "n5"


def test_what_cannot_be_pasted():
    outline = clip(document_of(extrude(circle(1))), ["n2"])
    tube = clip(DOCUMENT, ["n5"])
    for arguments, words in (((outline, "n1"), "is an outline, which is flat"), ((tube, "n2"), "no operands")):
        with pytest.raises(Refusal, match=words):
            OPERATIONS["paste"](DOCUMENT, *arguments)
    lost = clip(Document(solids=(instance("gone").named("x").with_(id="n1"),)), ["n1"])
    with pytest.raises(Refusal, match="no definition"):
        OPERATIONS["paste"](DOCUMENT, lost)


@pytest.mark.parametrize("text", ["", "hello", "[1, 2]", '{"format": "other"}', "[" * 100000, '{"format": 1'])
def test_other_texts_are_no_nodes(text):
    with pytest.raises(Refusal, match="no nodes on the clipboard"):
        read(text)


def test_a_later_version_is_told():
    with pytest.raises(Refusal, match="another version"):
        read(text_of(DOCUMENT, ["n5"]).replace('"version": 1', '"version": 2'))


def test_nodes_as_python():
    assert script_text(DOCUMENT, ["n4", "n5"]).splitlines() == [
        "sphere(radius=1).at(3, 0, 0)",
        "box(size=(5, 5, 5)).named('lid')",
    ]
    deep = box(1)
    for _ in range(100):
        deep = union(deep)
    with pytest.raises(Refusal, match="levels deep"):
        script_text(document_of(deep), ["n1"])


def test_an_equal_definition_of_an_instance_of_another_comes_along():
    def made(size):
        document = do(Document(), "insert", box(size))
        document = do(do(document, "link", "n1"), "combine", "union", ["n2"])
        return do(document, "link", "n3")

    small, large = made(1), made(2)
    after = do(large, "paste", clip(small, [small.solids[0].id]))
    sizes = [root.children[0].children[0].children[0].size[0] for root in resolve(after).solids]
    assert sizes == [2, 1] and len(after.definitions) == 4
    assert do(small, "paste", clip(small, [small.solids[0].id])).definitions == small.definitions
