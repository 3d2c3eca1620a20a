"""`solidtree mesh`."""

import csv
import io
import json

import pytest

from solidtree.model.script import box, cylinder, save


@pytest.fixture
def part(tmp_path):
    path = tmp_path / "part.solidtree"
    save(str(path), plate=box(20) - cylinder(4, 60, centred=True, segments=12).at(10, 10, 10).named("drill"))
    return path


def test_figures_as_json(solidtree, part):
    status, out, _ = solidtree("mesh", part)
    (solid,) = json.loads(out)["solids"]
    assert status == 0 and solid["name"] == "plate"
    # A box with 8 corners, 12 edges, 6 faces, and a drill of 12 sides, whose rims are one more loop of two faces.
    counts = [
        solid[name] for name in ("vertices", "edges", "faces", "loops", "euler", "genus", "components", "borders")
    ]
    assert counts == [8 + 24, 12 + 36, 6 + 12, 6 + 12 + 2, 0, 1, 1, 0]
    assert solid["naked_edges"] == solid["non_manifold_edges"] == 0 and solid["closed"] is True
    assert set(solid["bytes"]) == {"triangle soup", "face lists", "face lists and edge list", "winged edge"}
    _, out, _ = solidtree("mesh", part, "--triangles", "--costs")
    (solid,) = json.loads(out)["solids"]
    assert solid["faces"] == solid["loops"] == 2 * (32 - 2 + 2) and solid["euler"] == 0
    assert all(len(times) == 4 for times in solid["seconds"].values())


def test_a_table_as_csv(solidtree, part, tmp_path):
    status, out, _ = solidtree("mesh", part, "--table", "faces", "--from-1")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert status == 0 and len(rows) == 18 and [row["Face"] for row in rows] == [str(i + 1) for i in range(18)]
    assert sum(row["Made by"] == "drill" for row in rows) == 12 and sum("|" in row["Vertices"] for row in rows) == 2
    path = tmp_path / "edges.csv"
    status, out, _ = solidtree("mesh", part, path, "--table", "edges")
    assert (status, out) == (0, "") and len(path.read_text().splitlines()) == 1 + 48


def test_an_open_mesh_has_no_genus_and_status_1(solidtree, tmp_path):
    path = tmp_path / "lidless.off"
    path.write_text("OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")
    status, out, _ = solidtree("mesh", path)
    (solid,) = json.loads(out)["solids"]
    assert status == 1 and solid["genus"] is None and solid["borders"] == 1 and solid["naked_edges"] == 4
    assert solid["closed"] is False


def test_what_cannot_be_done_is_said(solidtree, part, tmp_path):
    status, _, err = solidtree("mesh", part, tmp_path / "x.csv")
    assert status == 2 and "--table" in err
    save(str(tmp_path / "two.solidtree"), box(1), box(1).at(3))
    status, _, err = solidtree("mesh", tmp_path / "two.solidtree", "--table", "edges")
    assert status == 2 and "--solid" in err
