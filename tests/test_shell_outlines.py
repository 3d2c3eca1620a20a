"""Outlines on the command line: what `info` tells of drawings, and `export` and `convert` to SVG and DXF."""

import json
from math import pi

import pytest

SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50">
<rect id="plate" x="10" y="10" width="30" height="20"/>
<path id="wire" d="M 0 0 L 30 40" fill="none" stroke="blue"/>
<text>never</text>
</svg>"""


@pytest.fixture
def drawing(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(SVG)
    return file


def test_info_tells_area_bounds_contours_and_length_of_each_outline(solidtree, drawing):
    status, out, err = solidtree("info", drawing)
    assert status == 0
    answer = json.loads(out)
    plate, wire = answer["profiles"]
    assert plate["name"] == "plate" and plate["contours"] == 1
    assert plate["area"] == pytest.approx(600) and plate["length"] == pytest.approx(100)
    assert plate["bounds"] == [pytest.approx([10, 20]), pytest.approx([40, 40])]
    assert wire["area"] is None and wire["length"] == pytest.approx(50)
    assert "text" in err


def test_a_drawing_is_converted_into_another_one(solidtree, drawing, tmp_path):
    for ending in ("dxf", "svg"):
        out = tmp_path / f"out.{ending}"
        assert solidtree("convert", drawing, out)[0] == 0
        plate, wire = json.loads(solidtree("info", out)[1])["profiles"]
        assert (plate["area"], wire["length"]) == (pytest.approx(600), pytest.approx(50))


def test_one_outline_of_a_project_is_exported_by_its_name(solidtree, tmp_path):
    script, project = tmp_path / "make.py", tmp_path / "two.solidtree"
    script.write_text(
        "from solidtree.model.script import *\n"
        f"save({str(project)!r}, wheel=circle(5), plate=rectangle(3, 4), part=box(3))\n"
    )
    assert solidtree("run", script)[0] == 0
    out = tmp_path / "wheel.dxf"
    assert solidtree("export", project, out, "--solid", "wheel")[0] == 0
    (row,) = json.loads(solidtree("info", out)[1])["profiles"]
    assert row["area"] == pytest.approx(25 * pi, rel=1e-3)
    status, _, err = solidtree("export", project, tmp_path / "x.svg", "--solid", "part")
    assert status == 2 and "there is no outline called “part”; there is “wheel”, “plate”" in err


def test_solids_alone_are_no_drawing_of_outlines(solidtree, tmp_path):
    script, project = tmp_path / "make.py", tmp_path / "one.solidtree"
    script.write_text(f"from solidtree.model.script import *\nsave({str(project)!r}, part=box(3))\n")
    assert solidtree("run", script)[0] == 0
    status, out, err = solidtree("export", project, tmp_path / "x.svg")
    assert (status, out) == (2, "") and err.count("\n") == 1 and "a section or a drawing" in err


def test_every_drawing_of_the_corpus_is_measured_or_refused_in_one_line(solidtree, corpus):
    files = sorted((corpus / "svg").rglob("*.svg"))[::9] + sorted((corpus / "dxf").rglob("*.dxf"))[::5]
    assert len(files) > 20
    for file in files:
        status, out, err = solidtree("info", file)
        if status == 2:
            assert out == "" and err.count("\n") == 1, file
        else:
            answer = json.loads(out)
            assert answer["profiles"], file
            assert status == (0 if not answer["warnings"] else 1), file
