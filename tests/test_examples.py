"""The examples: each file is what its script makes, and evaluates without a complaint."""

import runpy
import shutil
from pathlib import Path

import pytest

from solidtree.model.document.tree import walk
from solidtree.model.script import evaluate, open_document
from solidtree.model.solid.results import evaluate_document

EXAMPLES = Path(__file__).parent.parent / "resources" / "examples"
SCRIPTS = sorted(EXAMPLES.glob("*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_its_script_makes_the_very_file(script, tmp_path):
    shutil.copy(script, tmp_path)
    runpy.run_path(str(tmp_path / script.name), run_name="__main__")
    assert (tmp_path / f"{script.stem}.solidtree").read_bytes() == script.with_suffix(".solidtree").read_bytes()


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_it_evaluates_without_a_complaint_to_one_closed_body(script):
    evaluation = evaluate(open_document(script.with_suffix(".solidtree")))
    assert evaluation.messages == ()
    measures = [result.measures() for result in evaluation.solids]
    assert all(m.components == 1 and m.volume > 0 for m in measures)


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_parameters_may_be_turned_to_their_ends(script):
    document = open_document(script.with_suffix(".solidtree"))
    for parameter in document.parameters:
        for value in (parameter.minimum, parameter.maximum):
            changed = tuple(p.with_(value=value) if p is parameter else p for p in document.parameters)
            evaluation = evaluate_document(document.with_(parameters=changed), 0.5)
            assert not [m for m in evaluation.messages if m.error], (parameter.name, value)


def test_a_project_of_primitives_holds_no_vertices():
    for script in SCRIPTS:
        assert script.with_suffix(".solidtree").stat().st_size < 3000


def test_every_node_of_the_dumbbell_is_named_and_explained():
    document = open_document(EXAMPLES / "dumbbell.solidtree")
    assert all(node.name and (node.note or node.name == "bar") for node in walk(*document.solids))
