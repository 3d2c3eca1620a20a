"""`solidtree check`: pairs that overlap or are too near, as JSON, with its status."""

import json

import pytest

from solidtree.gui.command_line import main
from solidtree.model.script import box, halfspace, save, sphere


@pytest.fixture
def assembly(tmp_path):
    path = tmp_path / "assembly.solidtree"
    save(path, left=box(10), right=box(10).at(10.25), ball=sphere(2).at(5, 5, 11), far=box(1).at(90),
         ghost=box(30).hidden())  # fmt: skip
    return str(path)


def test_pairs_come_nearest_first(assembly, capsys):
    assert main(["check", assembly, "--clearance", "0.5"]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert answer["clearance"] == 0.5
    assert [(p["a"], p["b"], p["relation"]) for p in answer["pairs"]] == [
        ("left", "ball", "overlapping"), ("left", "right", "apart")]  # fmt: skip
    first, second = answer["pairs"]
    assert first["gap"] == 0 and first["points"] is None and first["overlap_volume"] > 0
    assert second["gap"] == 0.25 and second["overlap_volume"] == 0
    assert [point[0] for point in second["points"]] == [10, 10.25]


def test_nothing_too_near_is_status_0(tmp_path, capsys):
    path = tmp_path / "two.solidtree"
    save(path, box(10), box(10).at(10))
    assert main(["check", str(path)]) == 0  # touching
    assert json.loads(capsys.readouterr().out)["pairs"] == []
    assert main(["check", str(path), "--clearance", "0.1"]) == 1
    assert json.loads(capsys.readouterr().out)["pairs"][0]["relation"] == "touching"


def test_a_solid_that_failed_is_told_and_the_rest_is_checked(tmp_path, capsys):
    path = tmp_path / "endless.solidtree"
    save(path, box(10), box(10).at(5), halfspace())
    assert main(["check", str(path)]) == 1
    told = capsys.readouterr()
    assert len(json.loads(told.out)["pairs"]) == 1 and "goes on without end" in told.err


def test_bad_clearances_and_empty_documents_are_refused_in_a_line(tmp_path, assembly, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["check", assembly, "--clearance", "-1"])
    assert stopped.value.code == 2 and "clearance" in capsys.readouterr().err
    path = tmp_path / "none.solidtree"
    save(path)
    assert main(["check", str(path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
