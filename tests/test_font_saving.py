"""Changed fonts saved as TrueType, OpenType and Type 1, and read back here, by FreeType and by HarfBuzz."""

import json
import re
from io import BytesIO
from math import radians, tan

import freetype
import numpy as np
import pytest
import uharfbuzz as hb
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont

from solidtree.model.document.errors import Refusal
from solidtree.model.lettering.fonts.changing import changed_glyphs, characters_in, font_data
from solidtree.model.lettering.fonts.drawn_glyph import DrawnGlyph
from solidtree.model.lettering.fonts.opening import open_face
from solidtree.model.lettering.saving.naming import check_family, proposed_family, reserved_names
from solidtree.model.lettering.saving.saving import saved_font
from solidtree.model.path.flatten import flatten
from solidtree.model.path.path import Path
from solidtree.model.path.shapes import rectangle
from solidtree.model.project.disk import replace_file
from solidtree.model.script import document_of, lettering, save_font

GREEK = [*range(0x391, 0x3AA), *range(0x3B1, 0x3CA)]
GREEK.remove(0x3A2)  # which is no letter
FORMS = ("ttf", "otf", "pfb")
SHEAR = tan(radians(12))


def distance(one: Path, two: Path) -> float:
    """How far the farthest point of either outline is from the other, font units (Hausdorff, on chords)."""

    def sides(path: Path) -> np.ndarray:
        rings = flatten(path, 0.08)
        return np.concatenate([np.stack((ring, np.roll(ring, -1, axis=0)), axis=1) for ring in rings])

    def off(points: np.ndarray, others: np.ndarray) -> float:
        begin, way = others[:, 0], others[:, 1] - others[:, 0]
        size = np.maximum((way * way).sum(axis=1), 1e-300)
        share = np.clip(((points[:, None] - begin) * way).sum(axis=2) / size, 0.0, 1.0)
        return float(np.linalg.norm(points[:, None] - begin - share[..., None] * way, axis=2).min(axis=1).max())

    a, b = sides(one), sides(two)
    return max(off(a.mean(axis=1), b), off(a[:, 0], b), off(b.mean(axis=1), a), off(b[:, 0], a))


def by_freetype(data: bytes, code: int) -> tuple[Path, float]:
    face = freetype.Face(BytesIO(data))
    face.load_char(code, freetype.FT_LOAD_NO_SCALE | freetype.FT_LOAD_NO_HINTING)
    outline, commands = face.glyph.outline, []

    def move(a, _):
        commands.append(("close",)) if commands else None
        commands.append(("move", (a.x, a.y)))

    outline.decompose(
        None,
        move,
        lambda a, _: commands.append(("line", (a.x, a.y))),
        lambda a, b, _: commands.append(("quad", (a.x, a.y), (b.x, b.y))),
        lambda a, b, c, _: commands.append(("cubic", (a.x, a.y), (b.x, b.y), (c.x, c.y))),
    )
    return Path.of_commands([*commands, ("close",)]), float(face.glyph.metrics.horiAdvance)


CASES = [("GFS Didot", "ttf"), ("GFS Didot", "otf"), ("GFS Didot", "pfb"), ("DejaVu Sans", "ttf")]
"""Every form, and TrueType kept as it is; DejaVu's 6,253 glyphs take their time in the others."""


@pytest.mark.parametrize(("name", "form"), CASES)
def test_greek_letters_leaned_by_twelve_degrees_come_back_within_a_unit(name, form):
    data, number = font_data(name)
    face = open_face(data, number)
    glyphs = changed_glyphs(face, "Α-Ωα-ω", slant=12)  # noqa: RUF001
    assert {face.characters[code] for code in GREEK} <= glyphs.keys()
    saved = saved_font(data, number, glyphs, "Leaned", form)
    again = open_face(saved.data)
    assert again.family == "Leaned" and again.units_per_em == face.units_per_em
    assert again.kind == {"ttf": "TrueType", "otf": "CFF", "pfb": "Type 1"}[form]
    for code in GREEK:
        wanted = face.outline(face.characters[code]).transformed(((1, SHEAR, 0), (0, 1, 0)))
        advance = face.advance(face.characters[code])
        ours = again.outline(again.characters[code])
        theirs, width = by_freetype(saved.data, code)
        assert distance(ours, wanted) <= 1.0 and distance(theirs, wanted) <= 1.0
        assert again.advance(again.characters[code]) == width == advance
    for code in map(ord, "AHQag&ß5"):
        assert distance(again.outline(again.characters[code]), face.outline(face.characters[code])) <= 1.0


def shaped(data: bytes, text: str, features=None):
    buffer = hb.Buffer()
    buffer.add_str(text)
    buffer.guess_segment_properties()
    hb.shape(hb.Font(hb.Face(data)), buffer, features or {})
    return [(info.codepoint, place.x_advance) for info, place in
            zip(buffer.glyph_infos, buffer.glyph_positions, strict=True)]  # fmt: skip


@pytest.mark.parametrize(("name", "form"), [case for case in CASES if case[1] != "pfb"])
def test_kerning_ligatures_and_licence_stay(name, form):
    data, number = font_data(name)
    face = open_face(data, number)
    saved = saved_font(data, number, changed_glyphs(face, "α", slant=5), "Leaned", form)
    for text in ("AVTo", "office", "Ὦ ἄνδρες"):
        assert shaped(saved.data, text) == shaped(data, text)
    before, after = TTFont(BytesIO(data)), TTFont(BytesIO(saved.data))
    for kept in (0, 13, 14):
        assert before["name"].getDebugName(kept) == after["name"].getDebugName(kept)
    assert after["name"].getDebugName(4) == "Leaned" and after["name"].getDebugName(6).startswith("Leaned")
    assert name not in {record.toUnicode() for record in after["name"].names if record.nameID in (1, 4, 16)}
    assert after["head"].modified == before["head"].modified, "equal edits make equal files"


def test_type_1_says_what_it_loses_and_names_greek_letters_as_readers_find_them():
    data, number = font_data("GFS Didot")
    saved = saved_font(data, number, {}, "Plain", "pfb")
    assert any("kerning" in remark for remark in saved.remarks)
    face = freetype.Face(BytesIO(saved.data))
    assert face.get_char_index(0x3B1) and face.get_char_index(ord("ß")) and face.postscript_name == b"Plain-Regular"
    from_type_1 = saved_font(saved.data, 0, changed_glyphs(open_face(saved.data), "o", weight=10), "Bolder", "otf")
    again = open_face(from_type_1.data)
    o, plain = again.outline(again.characters[ord("o")]), open_face(data).outline("o")
    assert abs(o.area()) > abs(plain.area()) + 5 * plain.length()
    assert open_face(saved_font(saved.data, 0, {}, "Again", "ttf").data).characters[0x3B1]


def test_a_composite_follows_its_part_and_one_that_is_drawn_is_what_was_drawn():
    data, number = font_data("DejaVu Sans")
    brick = DrawnGlyph(Path(rectangle(700, 1400).contours).reversed(), 900.0)
    saved = saved_font(data, number, {"I": brick}, "Bricks", "ttf")
    again, plain = open_face(saved.data), open_face(data)
    accent = plain.outline("Iacute").area() - plain.outline("I").area()
    assert again.outline("Iacute").area() == pytest.approx(accent - 700 * 1400)
    both = open_face(saved_font(data, number, {"Iacute": brick}, "Bricks", "ttf").data)
    assert both.outline("Iacute").area() == -700 * 1400
    assert both.outline("I").area() == plain.outline("I").area()


def variable_font() -> bytes:
    """Two squares, of which the second grows from 200 to 400 units with the axis of weight."""
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder([".notdef", "A", "B"])
    builder.setupCharacterMap({65: "A", 66: "B"})

    def square(size):
        pen = TTGlyphPen(None)
        for place, call in (((0, 0), pen.moveTo), ((0, size), pen.lineTo), ((size, size), pen.lineTo),
                            ((size, 0), pen.lineTo)):  # fmt: skip
            call(place)
        pen.closePath()
        return pen.glyph()

    builder.setupGlyf({".notdef": square(10), "A": square(300), "B": square(200)})
    builder.setupHorizontalMetrics({".notdef": (500, 0), "A": (500, 0), "B": (500, 0)})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Squares", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    builder.setupFvar([("wght", 100, 100, 900, "Weight")], [])
    from fontTools.ttLib.tables.TupleVariation import TupleVariation

    grown = [(0, 0), (0, 200), (200, 200), (200, 0), (0, 0), (0, 0), (0, 0), (0, 0)]
    builder.setupGvar({".notdef": [], "A": [], "B": [TupleVariation({"wght": (0.0, 1.0, 1.0)}, grown)]})
    out = BytesIO()
    builder.save(out)
    return out.getvalue()


@pytest.mark.parametrize("form", FORMS)
def test_a_variable_font_is_saved_as_one_design(form):
    data = variable_font()
    drawn = {"A": DrawnGlyph(Path(rectangle(50, 60).contours), 100.0)}
    saved = saved_font(data, 0, drawn, "Fixed", form, {"wght": 500.0})
    again = open_face(saved.data)
    assert not again.axes and any("variable" in remark for remark in saved.remarks)
    assert abs(again.outline(again.characters[66]).area()) == pytest.approx(300 * 300)
    assert abs(again.outline(again.characters[65]).area()) == 50 * 60 and again.advance(again.characters[65]) == 100


def test_reserved_names():
    didot, dejavu = font_data("GFS Didot"), font_data("DejaVu Sans")
    assert reserved_names(*didot) == ("GFS Didot",)
    assert {"Bitstream", "Vera"} <= set(reserved_names(*dejavu))
    for data in (didot, dejavu):
        assert check_family(*data, proposed_family(*data))
    for family, words in (
        ("My GFS didot", "reserves the name “GFS Didot”"),
        ("", "1 to 63 characters"),
        ("x" * 64, "1 to 63 characters"),
        ("Γράμματα", "Latin letters"),
        ("a\nb\x00", "Latin letters"),
    ):
        with pytest.raises(Refusal, match=words):
            check_family(*didot, family)
    with pytest.raises(Refusal, match="another name than “DejaVu Sans”"):
        check_family(*dejavu, "dejavu  SANS")


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ('with Reserved Font Name "Foo".', ("Foo",)),
        ("with Reserved Font Names 'Foo Bar' and 'Baz'.", ("Foo Bar", "Baz")),
        ("Copyright 2020 X (x.org), with Reserved Font Name Source.", ("Source",)),
        ("Copyright 2020. “Foo” is a Reserved Font Name for this Font Software.", ("Foo",)),
        ('"Reserved Font Name" refers to any names specified as such', ()),
        ("All rights reserved.", ()),
    ],
)
def test_reserved_names_as_licences_write_them(text, names):
    font = TTFont(BytesIO(variable_font()))
    font["name"].setName(text, 0, 3, 1, 0x409)
    out = BytesIO()
    font.save(out)
    assert reserved_names(out.getvalue()) == names


def test_characters_and_ranges():
    assert characters_in("a-cx") == set(map(ord, "abcx")) and characters_in("-a") == {45, 97} == characters_in("a-")
    with pytest.raises(Refusal, match="runs backwards"):
        characters_in("z-a")


def test_scripts_save_fonts_and_the_edited_ones_of_a_document(tmp_path):
    from solidtree.model.operations.operations import OPERATIONS

    remarks = save_font(tmp_path / "leaned.ttf", "GFS Didot", characters="α", slant=12, family="Leaned")
    assert any("quadratic" in remark for remark in remarks)
    brick = {"advance": 900, "points": ((0, 0), (700, 0), (700, 700), (0, 700)), "segments": "MLLLl"}
    document = OPERATIONS["edit_glyphs"](document_of(lettering("I", font="GFS Didot")), "GFS Didot", {"I": brick})
    save_font(tmp_path / "bricks.otf", "GFS Didot", document=document, family="Bricks")
    again = open_face((tmp_path / "bricks.otf").read_bytes())
    assert again.outline("I").area() == 700 * 700 and again.advance("I") == 900
    for name, words in (("x.woff", "saved as .ttf, .otf, .pfb"), ("x", "saved as")):
        with pytest.raises(Refusal, match=words):
            save_font(tmp_path / name, "GFS Didot", family="Leaned")
    replace_file(tmp_path / "old.otf", lambda stream: None)
    with pytest.raises(Refusal, match="none of the characters"):
        save_font(tmp_path / "old.otf", "GFS Didot", characters="न", slant=1, family="Leaned")
    assert (tmp_path / "old.otf").read_bytes() == b""


def test_the_command_line_saves_fonts(solidtree, tmp_path):
    data, _ = font_data("GFS Didot")
    file = tmp_path / "didot.otf"
    file.write_bytes(data)
    status, out, err = solidtree("font", file, "--save", tmp_path / "leaned.pfb", "--slant", "12", "--characters", "α")
    assert status == 0 and out == "" and "kerning" in err
    status, out, _ = solidtree("font", tmp_path / "leaned.pfb")
    assert status == 0 and json.loads(out)["family"] == "Edited Letters"
    status, _, err = solidtree("font", file, "--save", tmp_path / "x.otf", "--family", "GFS Didot")
    assert status == 2 and "another name" in err and err.count("\n") == 1
    assert not (tmp_path / "x.otf").exists()


SMALL = 100_000


def test_fonts_of_the_corpus_are_saved_in_every_form(corpus):
    """The small ones, each tenth glyph leaned: written and read back, whatever they are like."""
    files = sorted(path for path in (corpus / "fonts").rglob("*") if path.suffix in (".ttf", ".otf", ".pfb", ".pfa"))
    done = 0
    for path in files:
        data = path.read_bytes()
        try:
            if len(data) > SMALL or "malformed" in str(path):
                continue
            face = open_face(data)
            glyphs = {
                name: DrawnGlyph(face.outline(name).transformed(((1, 0.2, 0), (0, 1, 0))), face.advance(name))
                for name in face.glyph_names[::10]
            }
        except Refusal:
            continue
        for form in FORMS:
            try:
                saved = saved_font(data, 0, glyphs, "Other Name", form)
            except Refusal as refusal:
                assert re.search(r"VARC|\.notdef|cannot be read", str(refusal)), path
                continue
            assert open_face(saved.data).family.startswith("Other Name"), path
            done += 1
    assert done > 30
