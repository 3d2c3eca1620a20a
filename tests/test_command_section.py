"""`solidtree section` and the sections of `solidtree render`: figures, files, and what is refused."""

import json
import math

import ezdxf
import numpy as np
import pytest

from solidtree.model.operations.sections import add_section
from solidtree.model.script import box, cylinder, document_of, save


@pytest.fixture
def file(tmp_path):
    document = document_of(plate=box(40, 20, 5) - cylinder(4, 9, segments=48).at(10, 12, -2), block=box(10).at(60))
    document = add_section(document, "lid", (0, 0, 2), (0, 0, -1))
    save(tmp_path / "part.solidtree", document)
    return tmp_path / "part.solidtree"


HOLE = 0.5 * 48 * 16 * math.sin(2 * math.pi / 48)


def test_figures_are_by_formula_and_dxf_has_a_layer_for_each_solid(solidtree, file, tmp_path):
    status, out, err = solidtree("section", file, tmp_path / "cut.dxf", "--plane", "z=2")
    answer = json.loads(out)
    assert status == 0 and err == ""
    plate, block = answer["solids"]
    assert plate["name"] == "plate" and plate["area"] == pytest.approx(800 - HOLE) and plate["contours"] == 2
    assert block["bounds"] == [[60, 0], [70, 10]] and block["centroid"] == pytest.approx([65, 5])
    assert answer["total"]["area"] == pytest.approx(900 - HOLE)
    layers = {line.dxf.layer for line in ezdxf.readfile(tmp_path / "cut.dxf").modelspace()}
    assert layers == {"plate", "block"}


def test_every_way_to_name_the_same_plane_gives_the_same(solidtree, file, tmp_path):
    found = []
    for words in (["--plane", "z=2"], ["--point", "1,2,2", "--normal", "0,0,3"], ["--name", "lid"]):
        status, _, _ = solidtree("section", file, tmp_path / "cut.svg", *words, "--solid", "plate")
        assert status == 0
        found.append((tmp_path / "cut.svg").read_bytes())
    assert len(set(found)) == 1  # the document's section is seen from its open side
    front = json.loads(solidtree("section", file, "--plane", "y=12", "--solid", "plate")[1])["solids"]
    assert front[0]["area"] == pytest.approx(5 * 32) and front[0]["bounds"] == [[0, 0], [40, 5]]


def test_a_plane_that_meets_nothing_is_status_1_and_writes_nothing(solidtree, file, tmp_path):
    status, out, err = solidtree("section", file, tmp_path / "cut.svg", "--plane", "z=500")
    assert status == 1 and json.loads(out)["total"] == {"area": 0, "perimeter": 0, "contours": 0}
    assert err.endswith("the plane meets no solid; nothing was written\n") and not (tmp_path / "cut.svg").exists()


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ([], "one of the arguments"),
        (["--plane", "w=3"], "no plane such as z=5"),
        (["--plane", "z=nan"], "no plane such as z=5"),
        (["--point", "1,2,3"], "need each other"),
        (["--plane", "z=1", "--normal", "0,0,1"], "need each other"),
        (["--point", "1,2,3", "--normal", "0,0,0"], "a point and a direction"),
        (["--name", "no"], "there is no section called “no”"),
        (["--plane", "z=2", "--solid", "no"], "there is no solid called “no”"),
        (["cut.pdf", "--plane", "z=2"], "cut.pdf: cannot be written"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_status_2(solidtree, file, words, reason):
    status, out, err = solidtree("section", file, *words)
    assert status == 2 and out == "" and reason in err and err.count("\n") == 1


def test_render_opens_the_solids_by_its_own_and_the_documents_sections(solidtree, file, tmp_path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    def rendered(*words):
        out = tmp_path / "out.png"
        status, _, err = solidtree("render", file, out, "--size", "120x80", "--view", "front", *words)
        assert status == 0, err
        reader = vtkPNGReader()
        reader.SetFileName(str(out))
        reader.Update()
        return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(80, 120, 3).astype(int)

    whole, own, named = rendered(), rendered("--sections"), rendered("--section", "0,0,2:0,0,-1")
    assert np.array_equal(own, named) and (np.abs(whole - own).max(axis=2) > 30).sum() > 100
    assert np.array_equal(rendered("--section=-1,0,0:1,0,0"), whole)  # nothing of it is cut away
    for words, reason in (
        (("--section", "1,2"), "no point with a direction"),
        (("--section", "0,0,0:0,0,0"), "no point with a direction"),
        (("--sections", "--ids"), "leave the sections out"),
        (["--section=0,0,1:0,0,1"] * 7, "at most 6 sections"),
    ):
        status, _, err = solidtree("render", file, tmp_path / "no.png", *words)
        assert status == 2 and reason in err and not (tmp_path / "no.png").exists()


def test_render_says_when_a_section_leaves_nothing(solidtree, file, tmp_path):
    status, _, err = solidtree("render", file, tmp_path / "out.png", "--size", "60x40", "--section", "0,0,9:0,0,1")
    assert status == 0  # the block is higher
    status, _, err = solidtree("render", file, tmp_path / "out.png", "--size", "60x40", "--section", "0,0,10:0,0,1")
    assert status == 1 and err.endswith("the section at 0,0,10:0,0,1 leaves nothing\n")
