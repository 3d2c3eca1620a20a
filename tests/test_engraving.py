"""Outlines engraved into faces and raised from them: volumes by formula, and whose wall is whose."""

from math import pi, radians, tan

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.from_outlines import Extrude, Wrap
from solidtree.model.document.nodes import Difference, Union
from solidtree.model.document.table import same_document
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import at, box, cylinder, document_of, lettering, rectangle, turned
from solidtree.model.solid.information import information
from solidtree.model.solid.results import evaluate_document

engrave = OPERATIONS["engrave"]


def start(outline, solid):
    document = document_of(solid, outline)
    return document, document.profiles[0].id, document.solids[0].id


def volume(document, tolerance=0.05):
    (solid,) = information(document, tolerance)[0]["solids"]
    assert solid["closed"]
    return solid["volume"]


def test_a_rectangle_is_engraved_and_raised():
    document, outline, solid = start(rectangle(4, 3, centred=True), box(20, 20, 5))
    cut = engrave(document, outline, solid, at(10, 10, 5), depth=2)
    assert volume(cut) == pytest.approx(20 * 20 * 5 - 4 * 3 * 2)
    up = engrave(document, outline, solid, at(10, 10, 5), depth=2, raised=True)
    assert volume(up) == pytest.approx(20 * 20 * 5 + 4 * 3 * 2)
    assert isinstance(cut.solids[0], Difference) and isinstance(up.solids[0], Union)
    assert cut.solids[0].name == document.solids[0].name and not cut.profiles
    assert cut.solids[0].children[0].children == document.solids[0].children


def test_draft_narrows_an_engraving_with_depth_and_what_is_raised_to_its_top():
    document, outline, solid = start(rectangle(4, 4, centred=True), box(20, 20, 5))
    lean = 2 * tan(radians(10))  # over a depth of 2 mm; the given outline is that on the face
    narrow = 4 - 2 * lean
    frustum = 2 / 3 * (16 + narrow**2 + 4 * narrow)
    assert volume(engrave(document, outline, solid, at(10, 10, 5), depth=2, draft=10)) == pytest.approx(2000 - frustum)
    raised = engrave(document, outline, solid, at(10, 10, 5), depth=2, draft=10, raised=True)
    assert volume(raised) == pytest.approx(2000 + frustum)


def test_a_turned_face_is_engraved_square_to_it():
    document, outline, solid = start(rectangle(4, 3, centred=True), box(20, 20, 5))
    cut = engrave(document, outline, solid, turned(90, 0, 0), at(10, 0, 2.5), depth=1)
    assert volume(cut) == pytest.approx(2000 - 12)
    np.testing.assert_allclose(information(cut, 0.05)[0]["solids"][0]["bounds"], [[0, 0, 0], [20, 20, 5]], atol=1e-9)


def test_round_a_cylinder_the_depth_is_that_of_the_surface():
    document, outline, solid = start(rectangle(8, 5, centred=True), cylinder(10, 30))
    # In front, at -y: the outline's z looks to -y there.
    cut = engrave(document, outline, solid, turned(90, 0, 0), at(0, -10, 15), depth=1, radius=10)
    angle = 8 / 10  # radians that 8 mm are on the surface
    ring = 0.5 * angle * (10**2 - 9**2) * 5
    assert volume(cut, 0.001) == pytest.approx(pi * 100 * 30 - ring, rel=2e-4)
    assert isinstance(cut.solids[0].children[1], Wrap)


def test_more_engravings_join_the_operation_that_is_there():
    document, outline, solid = start(rectangle(4, 3, centred=True), box(20, 20, 5))
    cut = engrave(document, outline, solid, at(5, 5, 5), depth=1)
    more = OPERATIONS["insert"](cut, rectangle(2, 2))
    more = engrave(more, more.profiles[0].id, cut.solids[0].id, at(12, 12, 5), depth=1)
    assert [type(child) for child in more.solids[0].children[1:]] == [Extrude, Extrude]
    assert volume(more) == pytest.approx(2000 - 12 - 4)


def test_walls_of_letters_are_the_lettering_s_and_caps_too():
    document, outline, solid = start(lettering("Ag", 8), box(20, 12, 3))
    cut = engrave(document, outline, solid, at(2, 4, 3), depth=1)
    evaluation = evaluate_document(cut)
    mesh = evaluation.display(evaluation.solids[0])
    middle = mesh.points[mesh.triangles].mean(axis=1)
    within = ((middle[:, :2] > 0.1) & (middle[:, :2] < (19.9, 11.9))).all(axis=1)
    inside = within & (middle[:, 2] > 2 - 1e-6) & (middle[:, 2] < 3 - 1e-6)
    box_id, extrusion = (child.id for child in cut.solids[0].children)
    assert inside.sum() > 50
    for triangle in np.flatnonzero(inside):
        assert mesh.owners[mesh.owner[triangle]][-1] == extrusion
    for triangle in np.flatnonzero(middle[:, 2] < 1e-6):
        assert mesh.owners[mesh.owner[triangle]][-1] == box_id


def test_it_is_one_step_whose_line_does_the_same():
    from replay import replayed

    document, outline, solid = start(rectangle(4, 3), box(20, 20, 5))
    session = Session(document)
    session.do("engrave", outline, solid, at(3, 3, 5), depth=1.5, draft=5)
    assert same_document(replayed(session.log, document), session.document)
    session.undo()
    assert session.document is document


def test_what_makes_no_sense_is_refused():
    document, outline, solid = start(rectangle(4, 3), box(20, 20, 5))
    for arguments, keywords, words in (
        ((solid, solid), {}, "is no outline that stands by itself"),
        ((outline, outline), {}, "is no solid that stands by itself"),
        ((outline, solid), {"depth": 0}, "the depth must be above 0 mm"),
        ((outline, solid), {"radius": 5, "draft": 3}, "has no draft"),
        ((outline, "gone"), {}, "gone"),
    ):
        with pytest.raises(Refusal, match=words):
            engrave(document, *arguments, **keywords)
