"""The table of commands: every entry can be used, says why it cannot, and does what its title says."""

import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.tree import find
from solidtree.model.editing.commands import DOCUMENT_COMMANDS
from solidtree.model.editing.session import Session
from solidtree.model.script import box, circle, document_of, evaluate, extrude, linear_array, rectangle, sphere, union
from solidtree.model.solid.information import information

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
def test_what_is_added_is_there_and_has_a_size(name):
    session = used(name, document=document_of())
    (root,) = session.document.standing
    assert session.selection == (root.id,) and session.undo_label.startswith("Add ")
    if root in session.document.profiles:
        assert information(session.document, 0.05)[0]["profiles"][0]["area"] > 0
    elif name != "add_halfspace":
        assert evaluate(session.document).solids[0].measures().volume > 0


@pytest.mark.parametrize("name", ["extrude", "revolve", "pipe"])
def test_solids_are_made_of_the_selected_outlines(name):
    document = document_of(box(1), rectangle(4, 5).named("a"), circle(3).named("b"))
    session = used(name, "n2", "n3", document=document)
    assert [root.kind.lower() for root in session.document.solids] == ["box", name, name]
    assert session.document.profiles == ()
    assert session.selection == tuple(root.id for root in session.document.solids[1:])
    assert "no outline" in fault(name, "n1", "n7") and "select an outline" in fault(name)


def test_what_a_sweep_and_a_loft_want_selected():
    assert "select two" in fault("sweep", "n7") and "select two" in fault("loft", "n7")
    assert "no outline" in fault("sweep", "n1", "n7")


def test_what_is_added_stands_beside_its_like():
    document = document_of(union(box(1), sphere(2)), union(circle(1), circle(2).at(5)))
    flat = document.profiles[0]
    for selected in (flat.id, flat.children[1].id):
        assert len(used("add_circle", selected, document=document).document.profiles[0].children) == 3
        assert len(used("add_box", selected, document=document).document.solids) == 2
    assert len(used("add_circle", "n1", document=document).document.profiles) == 2
    assert len(used("add_box", "n1", document=document).document.solids[0].children) == 3


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
