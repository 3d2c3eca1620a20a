"""`solidtree draw` and `draw` of scripts: files, statuses, and what is refused in one line."""

import xml.etree.ElementTree as ET

import ezdxf
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.script import box, cylinder, document_of, draw, halfspace, parameter, save

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def file(tmp_path):
    plate = box(parameter("width", 40), 20, 5) - cylinder(4, 9, segments=48).at(10, 12, -2)
    save(tmp_path / "part.solidtree", document_of(plate=plate, block=box(10).at(0, 0, 20)))
    return tmp_path / "part.solidtree"


def texts(path):
    return [element.text for element in ET.parse(path).iter(SVG + "text")]


def test_every_format_is_written_without_a_word(solidtree, file, tmp_path):
    for name, words in (
        ("a.svg", ()),
        ("b.pdf", ("--sheet", "first", "--page", "A3", "--faces", "fill")),
        ("c.dxf", ("--eye", "100,-80,60", "--perspective", "40", "--hidden", "omit")),
        ("d.SVG", ("--view", "top", "--parallel", "--scale", "1:2", "--dimensions")),
    ):
        status, out, err = solidtree("draw", file, tmp_path / name, *words)
        assert (status, out, err) == (0, "", ""), name
        assert (tmp_path / name).stat().st_size > 1000
    assert ET.parse(tmp_path / "d.SVG").getroot().get("data-scale") == "1:2"
    assert {"40", "20", "part", "1:2", "Top"} <= set(texts(tmp_path / "d.SVG"))


def test_parameters_and_the_choice_of_a_solid_change_what_is_measured(solidtree, file, tmp_path):
    out = tmp_path / "a.svg"
    assert solidtree("draw", file, out, "--sheet", "third", "--parameter", "width=60")[0] == 0
    assert {"60", "20", "30"} <= set(texts(out))
    assert solidtree("draw", file, out, "--sheet", "third", "--solid", "block", "--no-iso")[0] == 0
    assert texts(out).count("10") == 3
    assert solidtree("draw", file, out, "--sheet", "third", "--no-dimensions")[0] == 0
    assert "20" not in texts(out)


def test_nothing_to_draw_is_status_1_and_writes_nothing(solidtree, tmp_path):
    save(tmp_path / "none.solidtree", document_of(gone=box(10) - box(20).at(-5, -5, -5)))
    status, out, err = solidtree("draw", tmp_path / "none.solidtree", tmp_path / "a.svg")
    assert (status, out) == (1, "") and err.endswith("nothing was written\n") and err.count("\n") == 1
    assert not (tmp_path / "a.svg").exists()


def test_what_failed_is_told_and_the_rest_is_drawn(solidtree, tmp_path):
    save(tmp_path / "half.solidtree", document_of(good=box(10), endless=halfspace()))
    status, _, err = solidtree("draw", tmp_path / "half.solidtree", tmp_path / "a.svg", "--view", "top")
    assert status == 1 and "“endless”" in err and (tmp_path / "a.svg").exists()


def test_every_command_takes_an_open_surface_as_it_is_and_says_so(solidtree, tmp_path):
    tent = "OFF\n5 4 0\n0 0 0\n10 0 0\n10 10 0\n0 10 0\n5 5 8\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
    (tmp_path / "tent.off").write_text(tent)
    told = set()
    for command, *words in (
        ("draw", tmp_path / "a.svg"),
        ("render", tmp_path / "a.png"),
        ("bsp",),
        ("ray", "--origin=5,4,20", "--direction=0,0,-1"),
    ):
        status, _, err = solidtree(command, tmp_path / "tent.off", *words)
        assert status == 0 and err.count("\n") == 1, command
        told.add(err)
    assert len(told) == 1


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["out.png"], "out.png: cannot be written"),
        (["out.svg", "--view", "up"], "invalid choice"),
        (["out.svg", "--page", "B7"], "is no page"),
        (["out.svg", "--scale", "2:0"], "is no scale"),
        (["out.svg", "--scale", "50:1"], "at 50:1 the drawing takes"),
        (["out.svg", "--target", "0,0,0"], "need --eye"),
        (["out.svg", "--eye", "1,2,3", "--view", "top"], "exclude each other"),
        (["out.svg", "--sheet", "first", "--view", "top"], "views of its own"),
        (["out.svg", "--no-iso"], "--no-iso needs --sheet"),
        (["out.svg", "--sheet", "first", "--perspective", "30"], "parallel projection"),
        (["out.svg", "--eye", "0,0,0", "--target", "0,0,0"], "the same point"),
        (["out.svg", "--solid", "lid"], "there is no solid called “lid”"),
        (["nowhere/out.svg"], "no such file or folder"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_status_2(solidtree, file, tmp_path, words, reason):
    status, out, err = solidtree("draw", file, tmp_path / words[0], *words[1:])
    assert status == 2 and out == "" and reason in err and err.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["part.solidtree"]


def test_scripts_draw_as_the_command_line_does(solidtree, tmp_path):
    plate = box(40, 20, 5).named("plate")
    page = draw(tmp_path / "plate.svg", plate, sheet="first", faces="fill", scale="1:1")
    save(tmp_path / "plate.solidtree", plate)
    words = ("--sheet", "first", "--faces", "fill", "--scale", "1")
    assert solidtree("draw", tmp_path / "plate.solidtree", tmp_path / "other.svg", *words)[0] == 0
    assert (tmp_path / "plate.svg").read_bytes() == (tmp_path / "other.svg").read_bytes() and page.scale == 1
    draw(tmp_path / "plate.dxf", plate, eye=(0, 0, 50), target=(20, 10, 0), up=(0, 1, 0))
    assert ezdxf.readfile(tmp_path / "plate.dxf").modelspace()
    for wrong in ({"view": "up"}, {"eye": (1, 2)}, {"scale": "x"}, {"page": "B1"}):
        with pytest.raises(Refusal):
            draw(tmp_path / "no.svg", plate, **wrong)
    with pytest.raises(Refusal, match="is no drawing"):
        draw(tmp_path / "no.png", plate)
    assert not (tmp_path / "no.svg").exists()
