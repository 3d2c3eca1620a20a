"""What is asked of the solids of a document: set, undone, echoed, and kept with those that it is asked of."""

import pytest
from replay import replayed

from solidtree.model.document.errors import Refusal
from solidtree.model.document.table import from_table, same_document, to_table
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import check_pair, delete, duplicate, insert, link, replace, set_clearance
from solidtree.model.operations.pasting import clip, paste
from solidtree.model.operations.structure import combine, dissolve
from solidtree.model.proximity.checks import Checks, PairCheck
from solidtree.model.script import box, document_of, rectangle, sphere


@pytest.fixture
def document():
    """A box with its lid, meant to touch, and a pin that keeps half a millimetre from the box."""
    made = document_of(box=box(10), lid=box(10, 10, 1).at(0, 0, 10), pin=sphere(2).at(20), sheet=rectangle())
    return check_pair(check_pair(made, "n1", "n2", touching=True), "n3", "n1", 0.5)


def ends(document):
    return [pair.ends for pair in document.checks.pairs]


def test_what_is_asked_is_one_step_each_and_replays():
    start = document_of(box=box(10), lid=box(4))
    session = Session(start)
    session.do("set_clearance", 0.4)
    session.do("check_pair", "n2", "n1", touching=True)
    asked = session.document
    assert asked.checks == Checks(0.4, (PairCheck("n1", "n2", touching=True),))
    assert same_document(replayed(session.log, start), asked)
    session.do("check_pair", "n1", "n2")
    assert session.document.checks == Checks(0.4)
    session.undo()
    assert session.document is asked
    session.redo()
    assert session.document.checks == Checks(0.4)


def test_only_solids_that_stand_by_themselves_are_checked(document):
    with pytest.raises(Refusal, match="“sheet” is no solid"):
        check_pair(document, "n1", "n4", 1)
    with pytest.raises(Refusal, match="meant to touch have no clearance"):
        check_pair(document, "n1", "n2", 1, touching=True)
    with pytest.raises(Refusal, match="0 mm or more"):
        set_clearance(document, -1)
    assert set_clearance(document, 0) is document and check_pair(document, "n2", "n3") is document


def test_copies_of_both_are_asked_the_same(document):
    after = duplicate(document, ["n1", "n2"])
    one, other = (next(root.id for root in after.solids if root.name == name) for name in ("box 2", "lid 2"))
    assert after.checks.pair(one, other) == PairCheck(one, other, touching=True)
    assert len(after.checks.pairs) == 3
    pasted = paste(document, clip(document, ["n3", "n1"]))
    one, other = (root.id for root in pasted.solids[3:])
    assert pasted.checks.pair(one, other) == PairCheck(one, other, 0.5) and len(pasted.checks.pairs) == 3


def test_what_takes_the_place_of_a_solid_is_asked_the_same(document):
    linked = link(document, ["n1"])
    (instance, *_) = linked.solids
    assert linked.checks.pair(instance.id, "n2") == PairCheck(instance.id, "n2", touching=True)
    replaced = replace(document, "n2", sphere(3))
    assert replaced.checks.pair("n1", replaced.solids[1].id) is not None
    joined = combine(document, "difference", ["n1", "n3"])
    assert joined.checks.pair(joined.solids[0].id, "n2") == PairCheck(joined.solids[0].id, "n2", touching=True)
    assert ends(from_table(to_table(joined))) == [("n2", joined.solids[0].id)]
    assert dissolve(joined, [joined.solids[0].id]).checks == document.checks


def test_a_new_solid_is_not_asked_what_one_that_is_gone_was(document):
    without = delete(document, ["n3"])
    after = insert(delete(without, ["n4"]), sphere(2))
    assert after.checks.pair("n1", after.solids[-1].id) is None
    assert ends(from_table(to_table(without))) == [("n1", "n2")]
