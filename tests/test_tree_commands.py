"""The tree's commands: each does what it says, and says why it cannot be used."""

import pytest

from solidtree.model.document.tree import find
from solidtree.model.editing.commands import DOCUMENT_COMMANDS
from solidtree.model.editing.session import Session
from solidtree.model.editing.tree_commands import TREE_COMMANDS
from solidtree.model.script import box, difference, document_of, extrude, linear_array, rectangle, sphere, union

COMMANDS = {command.name: command for command in TREE_COMMANDS}
# n1 (n2 box, n3 sphere, n4 box), n5 array (n6 box), n7 extrusion (n8), n9 box
DOCUMENT = document_of(
    difference(box(1), sphere(2), box(3)), linear_array(box(1)), extrude(rectangle()), box(9).named("last")
)


def used(name, *selected, document=DOCUMENT):
    session = Session(document)
    session.select(selected)
    assert COMMANDS[name].fault(session) is None
    COMMANDS[name].run(session)
    return session


def fault(name, *selected, document=DOCUMENT):
    session = Session(document)
    session.select(selected)
    return COMMANDS[name].fault(session)


def ids(nodes):
    return [node.id for node in nodes]


def test_names_and_shortcuts_are_single():
    both = (*DOCUMENT_COMMANDS, *TREE_COMMANDS)
    names = [command.name for command in both]
    shortcuts = [command.shortcut for command in both if command.shortcut]
    assert len(set(names)) == len(names) and len(set(shortcuts)) == len(shortcuts)
    assert all(command.title and command.menu and command.tip for command in TREE_COMMANDS)


def test_operands_move_up_down_out_and_in_with_one_line_each():
    session = used("move_up", "n3", "n4")
    assert ids(find(session.document, "n1").children) == ["n3", "n4", "n2"]
    assert session.selection == ("n3", "n4") and session.log == ("reorder(['n3', 'n4'], -1)",)
    assert ids(find(used("move_down", "n2").document, "n1").children) == ["n3", "n2", "n4"]
    out = used("move_out", "n4", "n3")
    assert ids(out.document.solids) == ["n1", "n3", "n4", "n5", "n7", "n9"] and len(out.log) == 1
    assert out.selection == ("n4", "n3")
    back = used("move_in", "n3", "n4", document=out.document)
    assert ids(back.document.solids) == ids(DOCUMENT.solids)
    assert ids(find(back.document, "n1").children) == ["n2", "n3", "n4"]


def test_make_base_and_swap():
    assert ids(find(used("promote", "n4").document, "n1").children) == ["n4", "n2", "n3"]
    assert ids(find(used("swap", "n4", "n2").document, "n1").children) == ["n4", "n3", "n2"]


def test_group_and_change_of_kind():
    session = used("group", "n3", "n4")
    (made,) = session.selection
    assert find(session.document, made).name == "Group" and ids(find(session.document, made).children) == ["n3", "n4"]
    changed = used("change_to_union", "n1")
    assert changed.document.solids[0].kind == "Union" and COMMANDS["change_to_union"].checked(changed)
    assert not COMMANDS["change_to_difference"].checked(changed)
    assert used("change_to_revolve", "n7").document.solids[2].kind == "Revolve"


def test_what_can_be_selected_from_what_is_selected():
    assert used("select_parent", "n3", "n4", "n6").selection == ("n1", "n5")
    assert used("select_children", "n1").selection == ("n2", "n3", "n4")
    assert used("select_same_kind", "n4").selection == ("n4", "n2", "n6", "n9")
    linked = Session(DOCUMENT)
    linked.do("link", "n9")
    linked.do("copy_to", ["n9"], "n1")
    one = linked.document.solids[-1].id
    chosen = used("select_definition", one, document=linked.document)
    assert chosen.selection == ("n9",)
    assert len(used("select_instances", "n9", document=linked.document).selection) == 2
    assert used("select_instances", one, document=linked.document).selection.count(one) == 1


def test_isolate_once_more_ends_it():
    session = used("isolate", "n3")
    assert session.isolated == ("n3",) and session.document is DOCUMENT
    COMMANDS["isolate"].run(session)
    assert session.isolated == ()
    COMMANDS["isolate"].run(session)
    assert COMMANDS["show_all"].fault(session) is None
    COMMANDS["show_all"].run(session)
    assert session.isolated == () and COMMANDS["show_all"].fault(session) == "nothing is isolated"


def test_all_that_is_hidden_is_shown_again():
    session = Session(DOCUMENT)
    session.do("set_visible", ["n1", "n6"], False)
    COMMANDS["show_hidden"].run(session)
    assert COMMANDS["show_hidden"].fault(session) == "nothing is hidden"
    assert find(session.document, "n6").visible


@pytest.mark.parametrize(
    ("name", "selected", "words"),
    [
        ("move_up", [], "select a node first"),
        ("move_up", ["n2"], "it is the first already"),
        ("move_up", ["n2", "n3"], "it is the first already"),
        ("move_down", ["n4"], "it is the last already"),
        ("move_up", ["n3", "n6"], "select operands of one operation"),
        ("move_out", ["n9"], "a solid stands in no operation"),
        ("move_in", ["n2"], "there is no operation above it"),
        ("move_in", ["n3"], "“Box”, which stands above it, takes no operands"),
        ("promote", ["n2"], "it is the first operand already"),
        ("promote", ["n9"], "a solid stands in no operation"),
        ("swap", ["n2"], "select two nodes"),
        ("change_to_union", ["n2"], "“Box” is no operation that can become one"),
        ("change_to_union", ["n7"], "“Extrusion” is no operation that can become one"),
        ("change_to_mirror", ["n1"], "“Difference” has 3 operands; it takes one"),
        ("select_parent", ["n1"], "a solid stands in no operation"),
        ("select_children", ["n2"], "it has no operands"),
        ("select_definition", ["n2"], "select an instance"),
        ("select_instances", ["n2"], "it has no instances"),
        ("isolate", [], "select a node first"),
        ("group", [], "select a node first"),
    ],
)
def test_a_command_says_why_it_cannot_be_used(name, selected, words):
    assert fault(name, *selected) == words


def test_asking_costs_one_walk_however_much_is_selected():
    many = document_of(union(*[box(1) for _ in range(5000)]))
    session = Session(many)
    session.select([node.id for node in many.solids[0].children])
    for command in TREE_COMMANDS:
        command.fault(session)  # a walk for each node would take minutes
    assert COMMANDS["move_out"].fault(session) is None
