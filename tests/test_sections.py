"""Operations on the document's sections: what they change, what they share, what they refuse, and their echo."""

from functools import partial

import pytest

from solidtree.model.document.document import Document, Section
from solidtree.model.document.errors import Refusal
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.operations.sections import (
    MOST_ACTIVE,
    add_section,
    delete_section,
    moved_to,
    position,
    rename_section,
    set_section,
)
from solidtree.model.script import box, document_of


def opened(*names):
    document = document_of(box(1))
    for name in names:
        document = add_section(document, name)
    return document


def test_a_section_is_added_with_a_name_and_a_unit_normal():
    document = add_section(add_section(document_of(box(1))), point=(1, 2, 3), normal=(0, 3, 4))
    assert document.sections == (Section("Section"), Section("Section 2", (1, 2, 3), (0, 0.6, 0.8)))


def test_a_change_leaves_the_others_and_the_solids_as_they_are():
    before = opened("a", "b", "c")
    after = set_section(before, "b", point=(0, 0, 7), active=False)
    assert after.sections[1] == Section("b", (0, 0, 7), active=False)
    assert after.sections[0] is before.sections[0] and after.sections[2] is before.sections[2]
    assert after.solids is before.solids
    assert set_section(after, "b", point=(0, 0, 7)) is after
    assert [s.name for s in rename_section(after, "b", " the  lid ").sections] == ["a", "the lid", "c"]
    assert rename_section(after, "b", "b") is after
    assert [s.name for s in delete_section(after, "b").sections] == ["a", "c"]


@pytest.mark.parametrize(
    ("do", "words"),
    [
        (lambda d: add_section(d, "a"), "there is a section called “a” already"),
        (lambda d: add_section(d, " "), "needs a name"),
        (lambda d: add_section(d, normal=(0, 0, 0)), "must be a direction"),
        (lambda d: add_section(d, point=(0, "x", 0)), "plain number"),
        (lambda d: set_section(d, "z", active=False), "there is no section called “z”"),
        (lambda d: set_section(d, "a", colour="red"), "a section has no colour"),
        (lambda d: set_section(d, "a", active=1), "true or false"),
        (lambda d: rename_section(d, "a", "b"), "there is a section called “b” already"),
        (lambda d: delete_section(d, "z"), "there is no section called “z”"),
    ],
)
def test_what_makes_no_sense_is_refused_in_words(do, words):
    with pytest.raises(Refusal, match=words):
        do(opened("a", "b"))


def test_no_more_are_open_at_once_than_a_picture_can_show():
    document = opened(*"abcdef"[:MOST_ACTIVE])
    with pytest.raises(Refusal, match="switch one off first"):
        add_section(document)
    document = add_section(document, "spare", active=False)
    with pytest.raises(Refusal, match="switch one off first"):
        set_section(document, "spare", active=True)
    assert set_section(set_section(document, "a", active=False), "spare", active=True).sections[-1].active


def test_the_position_counts_along_the_axis_and_the_point_follows_it():
    below, above = Section("s", (1, 2, 3), (0, 0, -1)), Section("s", (1, 2, 3), (0, 0, 1))
    assert position(below) == position(above) == 3.0
    assert moved_to(below, 5) == moved_to(above, 5) == (1.0, 2.0, 5.0)
    sloped = Section("s", (0, 0, 0), (0, 3, 4))
    assert position(sloped.with_(point=moved_to(sloped, 10))) == pytest.approx(10.0)


def test_what_was_done_is_undone_and_its_echo_does_it_again():
    session = Session(document_of(box(1)))
    first = session.document
    session.do("add_section", "cut", (1, 2, 3), (0, -1, 0))
    session.do("add_section")
    session.do("set_section", "cut", point=(1, 2.5, 3), normal=(1, 1, 0))
    session.do("rename_section", "Section", "lid")
    session.do("set_section", "lid", active=False)
    last = session.document
    replayed = Document(solids=first.solids)
    for line in session.log:
        at_hand = {name: partial(operation, replayed) for name, operation in OPERATIONS.items()}
        replayed = eval(line, at_hand)
    assert replayed.sections == last.sections
    while session.undo():
        pass
    assert session.document is first
