"""Fonts on the command line: facts, texts and glyphs as JSON, and what is no font."""

import json
from importlib.resources import files
from math import radians, tan
from pathlib import Path

import pytest

BUNDLED = Path(str(files("solidtree.resources"))) / "fonts"
DIDOT, DEJAVU = BUNDLED / "GFSDidot.otf", BUNDLED / "DejaVuSans.ttf"


def answer(solidtree, *words, status=0):
    got, out, _ = solidtree("font", *words)
    assert got == status
    return json.loads(out)


def test_facts(solidtree):
    facts = answer(solidtree, DIDOT)
    assert (facts["name"], facts["kind"], facts["units_per_em"], facts["faces"]) == ("GFS Didot", "CFF", 1000, 1)
    assert facts["glyphs"] == 1145 and "kern" in facts["features"] and facts["axes"] == []


def test_a_text_in_font_units(solidtree):
    told = answer(solidtree, DEJAVU, "--text", "AVTo", "--feature", "kern=0")
    assert [glyph["name"] for glyph in told["glyphs"]] == ["A", "V", "T", "o"]
    assert [glyph["x"] for glyph in told["glyphs"]] == [0, 1401, 2802, 4053]  # sums of the widths in hmtx
    kerned = answer(solidtree, DEJAVU, "--text", "AVTo")
    assert kerned["glyphs"][1]["x"] < 1401
    kinds = {command[0] for glyph in told["glyphs"] for contour in glyph["contours"] for command in contour}
    assert kinds == {"move", "line", "quad"}
    for glyph in told["glyphs"]:
        for contour in glyph["contours"]:
            assert contour[0][1] == contour[-1][-1]


def test_size_and_slant(solidtree):
    (upright,) = answer(solidtree, DIDOT, "--text", "l")["glyphs"]
    (leaning,) = answer(solidtree, DIDOT, "--text", "l", "--size", "10", "--slant", "12")["glyphs"]
    assert leaning["advance"] == pytest.approx(upright["advance"] / 100)
    for one, other in zip(upright["contours"][0], leaning["contours"][0], strict=True):
        x, y = one[-1]
        assert other[-1] == pytest.approx([(x + y * tan(radians(12))) / 100, y / 100])


def test_right_to_left_and_a_glyph_by_name_or_character(solidtree):
    told = answer(solidtree, DEJAVU, "--text", "אב")
    assert [glyph["name"] for glyph in told["glyphs"]] == ["uni05D1", "uni05D0"]
    by_name, by_character = (answer(solidtree, DIDOT, "--glyph", glyph) for glyph in ("alpha", "α"))
    assert by_name == by_character and by_name["glyphs"][0]["advance"] == 627


def test_missing_characters_are_listed_and_the_status_tells(solidtree):
    told = answer(solidtree, DIDOT, "--text", "aनa", status=1)
    assert told["missing"] == [0x928]
    assert told["glyphs"][1]["name"] == ".notdef"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([DIDOT, "--axis", "wght=700", "--text", "a"], "has no axis “wght”"),
        ([DIDOT, "--glyph", "nope"], "no glyph “nope”"),
        ([DIDOT, "--face", "3"], "no face 3"),
        ([DIDOT, "--text", "a", "--feature", "kern=x"], "kern=0"),
        (["nothing.ttf"], "nothing.ttf: there is no such file"),
        ([__file__], "not a font"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(solidtree, words, said):
    status, out, err = solidtree("font", *words)
    assert status == 2 and out == "" and said in err and err.count("\n") == 1
