"""The table of commands: every entry can be used, says why it cannot, and does what its title says."""

import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.tree import find
from solidtree.model.editing.commands import DOCUMENT_COMMANDS
from solidtree.model.editing.session import Session
from solidtree.model.script import box, document_of, evaluate, extrude, linear_array, rectangle, sphere, union

COMMANDS = {command.name: command for command in DOCUMENT_COMMANDS}
DOCUMENT = document_of(
    union(box(1), sphere(2)), linear_array(box(1)), extrude(rectangle())
)  # n1 (n2, n3), n4 (n5), n6 (n7)


def used(name, *selected, document=DOCUMENT):
    session = Session(document)
    session.select(selected)
    assert COMMANDS[name].fault(session) is None
    COMMANDS[name].run(session)
    return session


def fault(name, *selected):
    session = Session(DOCUMENT)
    session.select(selected)
    return COMMANDS[name].fault(session)


def test_names_and_shortcuts_are_single():
    names = [command.name for command in DOCUMENT_COMMANDS]
    shortcuts = [command.shortcut for command in DOCUMENT_COMMANDS if command.shortcut]
    assert len(set(names)) == len(names) and len(set(shortcuts)) == len(shortcuts)
    assert all(command.title and command.menu and command.tip for command in DOCUMENT_COMMANDS)


@pytest.mark.parametrize("name", [name for name in COMMANDS if name.startswith("add_")])
def test_what_is_added_is_a_solid_that_can_be_seen(name):
    session = used(name, document=document_of())
    (root,) = session.document.solids
    assert session.selection == (root.id,) and session.undo_label.startswith("Add ")
    if name != "add_halfspace":
        assert evaluate(session.document).solids[0].measures().volume > 0


def test_a_half_space_goes_only_where_it_cuts_something():
    balls = document_of(sphere(10) + sphere(4))
    for selected in ([], ["n1"], ["n2"]):
        root = used("add_halfspace", *selected, document=balls).document.solids
        assert [node.kind for node in root] == ["Union", "Halfspace"]
    (cut,) = used("add_halfspace", "n1", document=document_of((sphere(10) + sphere(4)) & box(9))).document.solids
    assert [child.kind for child in cut.children] == ["Union", "Box", "Halfspace"]
    (cut,) = used("add_halfspace", "n2", document=document_of((sphere(10) + sphere(4)) & box(9))).document.solids
    assert [child.kind for child in cut.children] == ["Union", "Halfspace", "Box"]


@pytest.mark.parametrize(
    ("selected", "family"),
    [
        ([], None),
        (["n1"], "n1"),
        (["n2"], "n1"),
        (["n4"], None),
        (["n5"], None),
        (["n7"], None),
        (["n1", "n4"], None),
    ],
)
def test_a_primitive_goes_where_there_is_room(selected, family):
    session = used("add_box", *selected)
    if family is None:
        assert len(session.document.solids) == 4
    else:
        assert len(find(session.document, family).children) == 3
    if selected == ["n2"]:
        assert find(session.document, "n1").children[1].id == session.selection[0]


@pytest.mark.parametrize("name", ["union", "difference", "intersection", "hull", "minkowski", "linear_array",
                                  "polar_array", "mirror"])  # fmt: skip
def test_the_selected_are_combined(name):
    session = used(name, "n4", "n1")
    made = find(session.document, session.selection[0])
    assert made.kind.lower() == name.replace("_", "") and session.undo_label == COMMANDS[name].title
    session.undo()
    assert session.document is DOCUMENT and session.selection == ("n4", "n1")


def test_editing_commands_do_what_they_say():
    assert [n.id for n in used("delete", "n1", "n2").document.solids] == ["n4", "n6"]
    assert len(used("duplicate", "n1").document.solids) == 4
    assert [n.id for n in used("dissolve", "n1").document.solids] == ["n2", "n3", "n4", "n6"]
    linked = used("link", "n1")
    assert linked.document.definitions[0].id == "n1" and COMMANDS["unlink"].fault(linked) is None
    COMMANDS["unlink"].run(linked)
    assert linked.document.definitions == ()


def test_hiding_and_showing_alternate():
    session = used("toggle_visible", "n2", "n3")
    assert session.undo_label == "Hide" and not find(session.document, "n2").visible
    session.do("set_visible", ["n2"], True)
    COMMANDS["toggle_visible"].run(session)  # some hidden: all are shown
    assert find(session.document, "n3").visible and session.undo_label == "Show"


def test_undo_and_redo_are_commands():
    session = used("delete", "n1")
    assert COMMANDS["redo"].fault(session) == "there is nothing to redo"
    COMMANDS["undo"].run(session)
    assert session.document is DOCUMENT and COMMANDS["undo"].fault(session) == "there is nothing to undo"
    COMMANDS["redo"].run(session)
    assert len(session.document.solids) == 2


@pytest.mark.parametrize(
    ("name", "selected", "words"),
    [
        ("union", [], "select a node first"),
        ("delete", [], "select a node first"),
        ("dissolve", [], "select a node first"),
        ("dissolve", ["n1", "n2"], "“Box” has no operands to set free"),
        ("link", [], "select a node first"),
        ("unlink", ["n1"], "select an instance"),
        ("unlink", [], "select a node first"),
        ("toggle_visible", [], "select a node first"),
    ],
)
def test_a_command_says_why_it_cannot_be_used(name, selected, words):
    assert fault(name, *selected) == words


def test_what_the_document_refuses_comes_as_a_refusal():
    session = Session(DOCUMENT)
    session.select(["n5"])
    with pytest.raises(Refusal, match="cannot be without"):
        COMMANDS["delete"].run(session)
    assert session.document is DOCUMENT
