"""Drawings as documents, and the outlines in text that was copied."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange.drawings.outlines_in import document_of_text
from solidtree.model.exchange.meshes_in import read_any
from solidtree.model.outline.paths import path_of
from solidtree.model.script import document_of, extrude, measure, outlines
from solidtree.model.solid.outlines.sections import section_of

SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50">
<rect id="plate" x="10" y="10" width="30" height="20" fill="#ff0000"/>
<path id="wire" d="M 0 0 C 10 0 10 10 20 10" fill="none" stroke="blue"/>
<path d="M 50 10 L 60 10 L 60 20" fill="black"/>
<path d="M 50 10 L 60 10 L 60 20" fill="black"/>
</svg>"""


@pytest.fixture
def drawing(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(SVG)
    return file


def test_each_shape_is_an_outline_with_its_name_and_colour_and_y_up(drawing):
    document = read_any(drawing)
    assert [root.name for root in document.profiles] == ["plate", "wire", "logo", "logo 2"]
    assert not document.solids
    plate = document.profiles[0]
    assert plate.colour == "#ff0000"
    np.testing.assert_allclose(path_of(plate).bounds(), [[10, 20], [40, 40]])


def test_what_is_filled_is_closed_and_a_stroke_stays_open(drawing):
    _, wire, triangle, _ = read_any(drawing).profiles
    assert not path_of(wire).contours[0].closed
    assert section_of(triangle, 0.01).area() == pytest.approx(50)


def test_a_script_takes_the_outlines_of_a_file_and_makes_solids_of_them(drawing):
    plate = outlines(drawing)[0]
    assert measure(extrude(plate, 5)).volume == pytest.approx(3000)
    assert document_of(plate).profiles[0].name == "plate"


def test_the_text_of_a_path_is_turned_over_and_its_smooth_nodes_are_known():
    (root,) = document_of_text(" m 0,0 c 0,5 5,10 10,10 c 5,0 10,-5 10,-10 z\n").profiles
    path = path_of(root)
    assert path.bounds()[0, 1] == pytest.approx(-10)
    assert root.segments == "MCCl" and root.joints[1] == "y"


def test_the_text_of_a_drawing_gives_its_shapes():
    assert [root.name for root in document_of_text(SVG, "Clip").profiles] == ["plate", "wire", "Clip", "Clip 2"]


@pytest.mark.parametrize("text, words", [("M 0 0 L x", "cannot be read"), ("M 5 5", "no segment"), ("", "no segment")])
def test_text_that_is_no_outline_is_refused(text, words):
    with pytest.raises(Refusal, match=words):
        document_of_text(text)


def test_entities_and_files_elsewhere_are_never_fetched(tmp_path):
    secret = tmp_path / "secret.txt"
    secret.write_text("M 0 0 H 10 V 10 Z")
    file = tmp_path / "evil.svg"
    file.write_text(
        f'<!DOCTYPE svg [<!ENTITY x SYSTEM "{secret.as_uri()}"><!ENTITY y "M0 0H9V9Z">]>'
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="&x;"/><path d="&y;"/></svg>'
    )
    with pytest.raises(Refusal):
        read_any(file)
