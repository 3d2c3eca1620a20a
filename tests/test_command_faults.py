"""`solidtree faults`: reports as JSON, mended files, and the status."""

import json

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.script import box, drawing_faults, measure, mesh_faults, open_document, path, repaired, save

POINTS = [(x, y, z) for z in (0, 2) for x, y in ((0, 0), (4, 0), (4, 3), (0, 3))]
FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
LIDLESS = f"OFF\n{len(POINTS)} {len(FACES)} 0\n" + "".join(
    " ".join(map(str, row)) + "\n" for row in [*POINTS, *((4, *face) for face in FACES)]
)


@pytest.fixture
def lidless(tmp_path):
    file = tmp_path / "lidless.off"
    file.write_text(LIDLESS)
    return file


def test_a_sound_solid_has_status_0_and_an_open_one_1(solidtree, tmp_path, lidless):
    save(tmp_path / "box.solidtree", box(10))
    status, out, err = solidtree("faults", tmp_path / "box.solidtree")
    (report,) = json.loads(out)["nodes"]
    assert (status, err, report["kind"], report["findings"]) == (0, "", "solid", [])
    status, out, _ = solidtree("faults", lidless)
    (report,) = json.loads(out)["nodes"]
    assert status == 1 and report["open_edges"] == 4 and report["closed"] is False and report["volume"] is None
    assert report["words"] == "10 triangles, 8 vertices, 1 piece: 1 border (4 open edges)"
    assert report["findings"][0]["place"] == [2, 1.5, 2]


@pytest.mark.parametrize("ending", ["stl", "ply", "solidtree"])
def test_a_mended_file_is_written_and_told_about(solidtree, tmp_path, lidless, ending):
    out_file = tmp_path / f"mended.{ending}"
    status, out, _ = solidtree("faults", lidless, "--repair", out_file)
    (told,) = json.loads(out)["nodes"]
    assert status == 0 and told["changes"] == ["1 hole closed with 2 triangles"] and told["worse"] == []
    assert (told["before"]["borders"], told["after"]["borders"], told["after"]["volume"]) == (1, 0, pytest.approx(24))
    assert measure(open_document(out_file).solids[0]).volume == pytest.approx(24)


def test_only_what_is_asked_for_is_mended_and_what_is_left_has_status_1(solidtree, tmp_path, lidless):
    out_file = tmp_path / "left.off"
    status, out, _ = solidtree("faults", lidless, "--repair", out_file, "--repairs", "weld, orient")
    assert status == 1 and json.loads(out)["nodes"][0]["after"]["open_edges"] == 4
    assert solidtree("faults", lidless, "--repair", out_file, "--longest", "3")[0] == 1


def test_a_drawing_is_looked_at_and_mended(solidtree, tmp_path):
    drawing = tmp_path / "loose.svg"
    drawing.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">'
        '<path fill="none" stroke="black" d="M 0 0 L 10 0 M 10.001 0 L 10 10 L 0 0"/></svg>'
    )
    status, out, _ = solidtree("faults", drawing, "--tolerance", "0.01")
    report = json.loads(out)["nodes"][0]
    assert status == 1 and report["kind"] == "outline" and report["near_ends"] == 1 and report["open_ends"] == 2
    status, _, _ = solidtree("faults", drawing, "--tolerance", "0.01", "--repair", tmp_path / "tight.svg")
    assert status == 0
    assert drawing_faults(tmp_path / "tight.svg").sound


def test_what_cannot_be_done_is_one_line(solidtree, tmp_path, lidless):
    for words, message in (
        (("faults", lidless, "--solid", "nut"), "no solid or outline called “nut”; there is “lidless”"),
        (("faults", lidless, "--repair", tmp_path / "x.abc"), "names no mesh format"),
        (("faults", lidless, "--repair", tmp_path / "x.stl", "--repairs", "glue"), "'glue' is no repair"),
        (("faults", lidless, "--tolerance", "-1"), "is not a number above 0"),
    ):
        status, out, err = solidtree(*words)
        assert (status, out) == (2, "") and message in err and err.count("\n") == 1, err


def test_scripts_look_and_mend(lidless):
    assert mesh_faults(lidless).open_edges == 4 and mesh_faults(box(3)).sound
    assert mesh_faults(repaired(open_document(lidless).solids[0], "holes")).volume == pytest.approx(24)
    mended = repaired(path("M 0 0 L 4 0 M 4.0001 0 L 4 4 L 0 0"))
    assert drawing_faults(mended).sound and not drawing_faults(path("M 0 0 L 4 0")).sound
    assert np.isclose(measure(repaired(box(2) + box(2).at(1, 1, 1))).volume, 15)
    with pytest.raises(Refusal, match="one outline is needed here, and there are 0"):
        drawing_faults(lidless)
