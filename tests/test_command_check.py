"""`solidtree check`: pairs that overlap or are too near, as JSON, with its status."""

import base64
import io
import json
import re

import numpy as np
import pytest
from PIL import Image

from solidtree.gui.command_line import main
from solidtree.model.script import box, document_of, halfspace, meant_to_touch, save, sphere, with_clearance


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
    assert main(["check", str(path), "--clearance", "0.00"]) == 0  # touching
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


def test_pairs_are_asked_by_name_and_the_project_has_its_own(tmp_path, capsys):
    path = str(tmp_path / "case.solidtree")
    save(path, with_clearance(document_of(box=box(10), lid=box(10).at(0, 0, 10.3), pin=box(1).at(11)), 0.5))
    assert main(["check", path]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert answer["clearance"] == 0.5 and [pair["b"] for pair in answer["pairs"]] == ["lid"]
    assert main(["check", path, "--clearance", "0.2"]) == 0
    capsys.readouterr()
    assert main(["check", path, "--touching", "lid", "box", "--pair", "pin", "box", "2"]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert [(pair["b"], pair["asked"]) for pair in answer["pairs"]] == [("pin", 2)]
    assert [pair["words"] for pair in answer["parted"]] == ["“box” and “lid” are meant to touch, and are 0.3 mm apart."]
    assert main(["check", path, "--touching", "lid", "bocks"]) == 2
    assert "no solid called “bocks”" in capsys.readouterr().err
    assert main(["check", path, "--pair", "lid", "box", "wide"]) == 2
    assert "'wide' is no clearance" in capsys.readouterr().err


def test_a_report_holds_findings_remarks_and_pictures_in_one_file(tmp_path, capsys):
    path, out = str(tmp_path / "case.solidtree"), tmp_path / "report.html"
    save(path, meant_to_touch(document_of(box(10).named("A & B"), lid=box(10).at(0, 0, 10.25), peg=box(2).at(9, 9, 9),
                                          endless=halfspace()), "lid", "A & B"))  # fmt: skip
    with pytest.raises(SystemExit) as stopped:
        main(["check", path, "--report", str(tmp_path / "report.txt")])
    assert stopped.value.code == 2 and "let the name end in .html" in capsys.readouterr().err
    assert main(["check", path, "--report", str(out)]) == 1
    page = out.read_text("utf-8")
    assert "“A &amp; B” and “peg” overlap by 1 mm³." in page
    assert "“A &amp; B” and “lid” are meant to touch, and are 0.25 mm apart." in page
    assert "“endless” is not checked" in page and "src=" not in page
    pictures = re.findall(r"data:image/png;base64,([^\"]*)", page)
    assert len(pictures) >= 2
    overlap = np.array(Image.open(io.BytesIO(base64.b64decode(pictures[0]))).convert("RGB")).astype(int)
    red = (overlap[..., 0] > 120) & (overlap[..., 1] < 70) & (overlap[..., 2] < 70)
    assert red.any()  # what they share is drawn over both


def test_a_report_of_what_is_in_order_says_so(tmp_path, capsys):
    path, out = str(tmp_path / "two.solidtree"), tmp_path / "report.html"
    save(path, box(10), box(10).at(20))
    assert main(["check", path, "--report", str(out)]) == 0
    assert "all in order" in out.read_text("utf-8") and "Findings" not in out.read_text("utf-8")
