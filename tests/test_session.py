"""The session: history, selection, previews, the signal, the log."""

import pytest
from replay import replayed

from solidtree.model import script
from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.table import same_document
from solidtree.model.document.tree import find
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, cylinder, document_of, parameter, sphere, union

DOCUMENT = document_of(union(box(1), sphere(2)), box(3))  # n1 (n2, n3), n4


class Listener:
    def __init__(self, session):
        self.heard = []
        self.session = session
        self.stop = session.on_change(self)

    def __call__(self, before, after):
        if self.heard:
            last = self.heard[-1][1]
            assert before.document is last.document and before.selection == last.selection, "a change was not told"
        assert after.document is self.session.document and after.selection == self.session.selection
        self.heard.append((before, after))


def test_undo_and_redo_give_the_very_documents():
    session = Session(DOCUMENT)
    after = session.do("move", ["n2"], 5)
    assert session.undo() and session.document is DOCUMENT
    assert session.redo() and session.document is after
    assert not session.redo() and session.document is after


def test_the_selection_comes_back_with_the_step():
    session = Session(DOCUMENT)
    session.select(["n2", "n3"])
    session.do("combine", "union", ["n2", "n3"])
    made = session.selection
    assert [find(session.document, i).kind for i in made] == ["Union"]
    session.select(["n4"])
    session.undo()
    assert session.selection == ("n2", "n3")
    session.redo()
    assert session.selection == made


@pytest.mark.parametrize(
    ("step", "selected"),
    [
        (("insert", box(1)), ("n5",)),
        (("insert", union(box(1), box(2)), "n1"), ("n5",)),
        (("duplicate", ["n2", "n4"]), ("n5", "n6")),
        (("move", ["n3"], 1), ("n2", "n4")),
        (("delete", ["n2"]), ("n4",)),
        (("dissolve", "n1"), ("n2", "n4")),
        (("link", "n2"), ("n5",)),
    ],
)
def test_what_is_new_is_selected_or_what_remains(step, selected):
    session = Session(DOCUMENT)
    session.select(["n2", "n4"])
    session.do(*step)
    assert set(session.selection) == set(selected)


def test_an_unlinked_instance_stays_selected():
    session = Session(DOCUMENT)
    session.do("link", "n1")
    assert session.selection == ("n5",)
    session.do("unlink", "n5")
    assert session.selection == ("n5",)


def test_a_selection_can_be_asked_for_and_holds_only_what_exists():
    session = Session(DOCUMENT)
    session.do("move", ["n2"], 1, select=["n4", "gone", "n4"])
    assert session.selection == ("n4",)
    session.select(["n9", "n2", "n3", "n2"])
    assert session.selection == ("n2", "n3")
    session.select([])
    assert session.selection == ()


def test_a_step_that_changes_nothing_is_none():
    session = Session(DOCUMENT)
    listener = Listener(session)
    session.do("move", ["n2"], 0)
    session.do("set_field", "n2", "size", (1, 1, 1))
    session.do("rename", "n2", "")
    session.commit("Nothing")
    assert session.undo_label is None and session.log == () and listener.heard == [] and not session.modified


def test_a_refused_step_changes_nothing():
    session = Session(DOCUMENT)
    session.do("move", ["n2"], 5)
    session.undo()
    listener = Listener(session)
    for wrong in (("delete", ["n99"]), ("nonsense",), ("set_field", "n2", "size", "nan"), ("link", None)):
        with pytest.raises(Refusal):
            session.do(*wrong)
    assert session.document is DOCUMENT and session.redo_label == "Move" and listener.heard == []


def test_a_preview_is_shown_and_is_no_step():
    session = Session(DOCUMENT)
    listener = Listener(session)
    shown = [OPERATIONS["move"](DOCUMENT, ["n2"], x) for x in (1, 2)]
    for document in shown:
        session.preview(document)
        assert session.document is document and session.previewing
    session.cancel()
    assert session.document is DOCUMENT and not session.previewing and session.undo_label is None
    assert [(b.document, a.document) for b, a in listener.heard] == [
        (DOCUMENT, shown[0]), (shown[0], shown[1]), (shown[1], DOCUMENT)]  # fmt: skip
    session.cancel()
    assert len(listener.heard) == 3


def test_a_preview_is_committed_as_one_step():
    session = Session(DOCUMENT)
    session.select(["n2"])
    listener = Listener(session)
    for x in (1, 2, 3):
        session.preview(OPERATIONS["move"](DOCUMENT, ["n2"], x))
    last = session.document
    session.commit("Move")
    assert session.document is last and session.undo_label == "Move" and not session.previewing
    assert listener.heard[-1][1].document is last
    session.undo()
    assert session.document is DOCUMENT and session.undo_label is None and session.selection == ("n2",)


def test_a_drag_that_ends_where_it_began_is_told_once_and_is_no_step():
    session = Session(DOCUMENT)
    listener = Listener(session)
    shown = OPERATIONS["move"](DOCUMENT, ["n2"], 1)
    session.preview(shown)
    session.commit("Move", DOCUMENT, select=["n3"])
    assert len(listener.heard) == 2
    before, after = listener.heard[-1]
    assert before.document is shown and after.document is DOCUMENT and after.selection == ("n3",)
    assert session.undo_label is None


def test_a_step_or_an_undo_during_a_preview_ends_it():
    session = Session(DOCUMENT)
    listener = Listener(session)
    session.preview(OPERATIONS["move"](DOCUMENT, ["n2"], 1))
    session.do("move", ["n3"], 1)
    assert find(session.document, "n2").placement.steps == () and not session.previewing
    session.preview(DOCUMENT)
    session.undo()
    assert session.document is DOCUMENT and len(listener.heard) >= 4


def test_a_listener_hears_until_it_stops():
    session = Session(DOCUMENT)
    listener = Listener(session)
    session.do("move", ["n2"], 1)
    listener.stop()
    session.undo()
    assert len(listener.heard) == 1


def test_the_saved_document_is_known_by_identity():
    session = Session(DOCUMENT)
    session.do("move", ["n2"], 1)
    assert session.modified
    session.mark_saved(session.document)
    assert not session.modified
    session.undo()
    assert session.modified
    session.redo()
    assert not session.modified


def test_opening_starts_over():
    session = Session(DOCUMENT)
    session.do("move", ["n2"], 1)
    session.select(["n2"])
    listener = Listener(session)
    other = Document()
    session.open(other)
    assert (session.document, session.selection, session.log, session.undo_label, session.redo_label) == (
        other, (), (), None, None)  # fmt: skip
    assert not session.modified and len(listener.heard) == 1 and not session.undo()


def test_labels_are_those_of_the_steps():
    session = Session(DOCUMENT)
    session.do("set_field", "n2", "size", 2 * (3,) + (4,), label="Change size")
    session.do("move", ["n2"], 1)
    assert session.undo_label == "Move"
    session.undo()
    assert (session.undo_label, session.redo_label) == ("Change size", "Move")
    session.do("delete", ["n2"])
    assert session.redo_label is None


def test_the_oldest_step_goes_first_when_there_are_too_many():
    session = Session(DOCUMENT, depth=3)
    documents = [session.do("move", ["n2"], 1) for _ in range(5)]
    assert [session.undo() for _ in range(4)] == [True, True, True, False]
    assert session.document is documents[1]
    assert len(session.log) == 2  # what led here is still told
    with pytest.raises(ValueError, match="one step or more"):
        Session(depth=0)


def test_the_log_follows_undo_and_redo():
    session = Session(DOCUMENT)
    session.do("move", ["n2"], 1)
    session.do("move", ["n2"], 0, 1)
    session.undo()
    assert session.log == ("move(['n2'], 1)",)
    session.redo()
    assert session.log == ("move(['n2'], 1)", "move(['n2'], 0, 1)")
    session.undo()
    session.do("rename", "n2", "it's “x”")
    session.commit("By hand", DOCUMENT)
    assert session.log[1:] == ("rename('n2', \"it's “x”\")", "# By hand")


def test_the_log_replayed_makes_the_same_document():
    session = Session()
    width = parameter("width", 10, minimum=1, maximum=50, note="of all", group="size")
    session.do("insert", (box(width, width / 2, 3) - cylinder(2).turned(x=90).at(1)).named("a").coloured("red"))
    session.do("insert", sphere(parameter("deep", width * 2)).noted("x\n“y”").mirrored((1, 1, 0)), "n1", 0)
    session.do("set_parameter", "width", 12)
    session.do(
        "place", "n2", script.at(1), script.at(2), script.transformed([[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0]])
    )
    session.do("link", "n3")
    session.do("duplicate", ["n5"])
    session.do("set_visible", ["n5"], False)
    session.do("insert_document", document_of(sphere(parameter("r", 3)), box(1)))
    session.do("combine", "hull", [session.document.solids[-1].id])
    session.do("rename_parameter", "r", "radius")
    assert same_document(replayed(session.log, Document()), session.document)
