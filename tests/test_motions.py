"""Motions of a document: made, changed, renamed, kept in step with their parameters; nodes are set in motion."""

import json

import pytest
from replay import replayed

from solidtree.model.document.errors import Refusal
from solidtree.model.document.resolve import resolve
from solidtree.model.document.table import same_document
from solidtree.model.editing.session import Session
from solidtree.model.operations.motions import add_motion, set_in_motion, set_motion
from solidtree.model.operations.parameters import set_parameter
from solidtree.model.project.project_file import save_project
from solidtree.model.script import box, document_of, parameter


def place_at(document, value, number=0):
    """Where a root's own origin and x axis end are, at a value of the parameter t."""
    matrix = resolve(set_parameter(document, "t", value)).solids[number].placement.matrix()
    return matrix[:, 3], matrix[:, 0]


def test_nodes_are_set_in_motion_without_a_word_of_an_expression():
    document = document_of(box(10).at(5).named("arm"), box(5).at(20).named("base"))
    session = Session(document)
    arm, base = (root.id for root in document.solids)
    session.do("set_in_motion", [arm], "swing", by=(0, 30, 0), turn=("z", 90))
    session.do("set_in_motion", [base], "swing", by=(0, 0, -3))
    (motion,) = session.document.motions
    assert (motion.name, motion.parameter, motion.start, motion.end) == ("swing", "t", 0, 1)
    for value in (0, 0.5, 1):
        origin, axis = place_at(session.document, value)
        assert origin == pytest.approx([5, 30 * value, 0])
        assert axis == pytest.approx([2**-0.5 if value == 0.5 else 1 - value, {0: 0, 0.5: 2**-0.5, 1: 1}[value], 0])
        assert place_at(session.document, value, 1)[0] == pytest.approx([20, 0, -3 * value])
    assert same_document(replayed(session.log, document), session.document)
    session.undo()
    session.undo()
    assert session.document is document


def test_a_motion_from_two_values_is_all_gone_at_its_end():
    document = add_motion(document_of(box(1)), "go", "t", start=2, end=5)
    document = set_in_motion(document, [document.solids[0].id], "go", by=(6, 0, 0))
    assert [place_at(document, value)[0][0] for value in (2, 3, 5)] == pytest.approx([0, 2, 6])


def test_motions_are_changed_renamed_and_taken_out_and_each_step_is_undone():
    session = Session(document_of(box(1)))
    start = session.document
    session.do("add_motion", "open", "angle", end=90, seconds=2)
    session.do("set_motion", "open", steps=9, start=-5)
    session.do("rename_motion", "open", "shut")
    (motion,) = session.document.motions
    assert (motion.name, motion.start, motion.end, motion.seconds, motion.steps) == ("shut", -5, 90, 2, 9)
    assert [parameter.name for parameter in session.document.parameters] == ["angle"]
    assert same_document(replayed(session.log, start), session.document)
    session.do("delete_motion", "shut")
    assert session.document.motions == () and session.document.parameters
    for _ in range(4):
        session.undo()
    assert session.document is start


def test_parameters_take_their_motions_along():
    session = Session(add_motion(document_of(box(1)), "go", "t"))
    session.do("rename_parameter", "t", "time")
    assert session.document.motions[0].parameter == "time"
    with pytest.raises(Refusal, match="time is driven by the motion “go”"):
        session.do("delete_parameter", "time")
    session.do("delete_motion", "go")
    session.do("delete_parameter", "time")
    assert session.document.parameters == ()


@pytest.mark.parametrize(
    "act, words",
    [
        (lambda d: add_motion(d, "go", "t"), "a motion called “go” already"),
        (lambda d: add_motion(d, "up", "t", speed=3), "a motion has no speed"),
        (lambda d: set_motion(d, "up", steps=3), "no motion called “up”"),
        (lambda d: set_motion(d, "go", end=0), "starts and ends at 0: nothing moves"),
        (lambda d: set_motion(d, "go", parameter="narrow", end=9), "narrow must be at most 2"),
        (lambda d: set_in_motion(d, [d.solids[0].id], "go"), "say by how many millimetres"),
        (lambda d: set_in_motion(d, [d.solids[0].id], "go", turn=("w", 3)), "an axis is x, y or z"),
    ],
)
def test_what_cannot_be_is_refused(act, words):
    narrow = parameter("narrow", 1, minimum=0, maximum=2)
    document = add_motion(document_of(box(narrow)), "go", "t")
    with pytest.raises(Refusal, match=words):
        act(document)


def test_the_command_line_tells_of_a_motion(solidtree, tmp_path):
    document = document_of(box(10).named("arm"), box(10).at(25).named("base"))
    document = set_in_motion(document, [document.solids[0].id], "push", by=(30, 0, 0))
    path = tmp_path / "push.solidtree"
    save_project(document, path)
    status, out, err = solidtree("motion", path)
    told = json.loads(out)
    assert status == 0 and err == "" and "steps" not in told and told["moving"] == ["arm"]
    assert told["first"]["time"] == pytest.approx(2, abs=1e-4)
    assert told["first"]["value"] == pytest.approx(0.5, abs=1e-4)
    status, out, _ = solidtree("motion", path, "--contacts", "--name", "push", "--between")
    steps = json.loads(out)["steps"]
    assert status == 0 and len(steps) == 51 and not steps[24]["contacts"] and steps[30]["contacts"]
    status, out, err = solidtree("motion", path, "--name", "pull")
    assert status == 2 and out == "" and "no motion called “pull”, but push" in err
