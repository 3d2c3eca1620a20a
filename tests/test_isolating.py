"""Nodes shown alone: where they stand, and that the document and its history know nothing of it."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.editing.isolating import isolated
from solidtree.model.editing.session import Session
from solidtree.model.script import box, document_of, evaluate, sphere, union

# n1 (n2 box, n3 (n4 sphere)), n5 box
DOCUMENT = document_of(union(box(1), union(sphere(1).at(3)).turned(z=90)).at(10).coloured("red"), box(5).hidden())


def test_an_operand_stands_alone_where_it_is():
    (alone,) = isolated(DOCUMENT, ["n4"]).solids
    measures = evaluate(document_of(alone)).solids[0].measures()
    assert alone.id == "n4" and alone.colour == "#ff0000"
    assert np.mean(measures.bounds, axis=0) == pytest.approx([10, 3, 0])


def test_whole_solids_stay_what_they_are_and_hidden_ones_are_seen():
    assert isolated(DOCUMENT, ["n1", "n2"]).solids == (DOCUMENT.solids[0],)
    assert isolated(DOCUMENT, ["n1"]).solids[0] is DOCUMENT.solids[0]
    assert isolated(DOCUMENT, ["n5"]).solids[0].visible
    with pytest.raises(Refusal, match="no node n9"):
        isolated(DOCUMENT, ["n9"])


def test_isolation_is_no_step_and_ends_with_its_nodes():
    session = Session(DOCUMENT)
    told = []
    session.on_change(lambda before, after: told.append((before.isolated, after.isolated)))
    session.isolate(["n4", "n99"])
    assert session.isolated == ("n4",) and told == [((), ("n4",))]
    assert session.document is DOCUMENT and not session.modified and session.undo_label is None
    view = session.view
    assert session.view is view and view.solids[0].id == "n4"
    session.do("set_field", "n4", "radius", 2)
    assert session.view is not view and session.view.solids[0].radius == 2
    session.do("delete", ["n4"])
    assert session.isolated == () and session.view is session.document
    session.undo()
    assert session.isolated == ()


def test_a_definition_is_not_isolated():
    session = Session(DOCUMENT)
    session.do("link", "n3")
    with pytest.raises(Refusal, match="isolate one of its instances"):
        session.isolate(["n4"])
    assert session.isolated == ()
    session.isolate(["n2"])
    session.do("link", "n2")
    assert session.isolated == ()  # it has become a definition
