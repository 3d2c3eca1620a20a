"""Lettering: shaped as HarfBuzz shapes it, laid out, filled without holes where letters overlap, and told about."""

import re
from importlib.resources import files
from math import pi, radians, tan
from pathlib import Path

import numpy as np
import pytest
import uharfbuzz as hb

from solidtree.model.document.errors import Refusal
from solidtree.model.lettering.bidi import levels_of, visual_order
from solidtree.model.lettering.fonts.library import face_of, fallbacks, find, installed
from solidtree.model.lettering.fonts.opening import read_font
from solidtree.model.lettering.layout import Style, lay_out
from solidtree.model.lettering.shaping import set_line
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.path.path import Path as Curves
from solidtree.model.project.project_file import open_project, save_project
from solidtree.model.script import (
    circle,
    cylinder,
    document_of,
    extrude,
    lettering,
    measure,
    outlines,
    rectangle,
    save,
    wrap,
)
from solidtree.model.solid.information import information

BUNDLED = Path(str(files("solidtree.resources"))) / "fonts"
BAR = cylinder(radius=20, height=30)
DEJAVU, DIDOT = face_of("DejaVu Sans"), face_of("GFS Didot")


def outline_of(layout, faces):
    """All glyphs of a layout as one path."""
    drawn = (faces[one.face].outline(one.glyph).transformed(one.matrix) for one in layout.glyphs)
    return Curves(tuple(contour for path in drawn for contour in path.contours))


def shaped_by_harfbuzz(name, text, direction, script, features=None):
    """Names and places, font units, straight from HarfBuzz."""
    font = hb.Font(hb.Face((BUNDLED / name).read_bytes()))
    buffer = hb.Buffer()
    buffer.add_str(text)
    buffer.direction, buffer.script = direction, script
    hb.shape(font, buffer, features or {})
    x, found = 0, []
    for info, position in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True):
        found.append((info.codepoint, x + position.x_offset, position.y_offset))
        x += position.x_advance
    return found, x


@pytest.mark.parametrize(
    ("name", "text", "direction", "script"),
    [
        ("DejaVuSans.ttf", "AVTo", "ltr", "Latn"),
        ("GFSDidot.otf", "Ὦ ἄνδρες ᾄδετε", "ltr", "Grek"),
        ("DejaVuSans.ttf", "سلام", "rtl", "Arab"),
        ("DejaVuSans.ttf", "שָׁלוֹם", "rtl", "Hebr"),
        ("GFSDidot.otf", "office", "ltr", "Latn"),
    ],
)
@pytest.mark.parametrize("kern", [0, 1])
def test_a_run_is_as_harfbuzz_shapes_it(name, text, direction, script, kern):
    face = {"DejaVuSans.ttf": DEJAVU, "GFSDidot.otf": DIDOT}[name]
    wanted, length = shaped_by_harfbuzz(name, text, direction, script, {"kern": bool(kern)})
    glyphs, width = set_line(text, [face], features=[("kern", kern)])
    em = face.units_per_em
    assert width * em == pytest.approx(length)
    got = [(face.glyph_names.index(one.glyph), one.x * em, one.y * em) for one in glyphs]
    np.testing.assert_allclose(got, wanted, atol=1e-6)


def test_kerning_draws_letters_together():
    apart, together = (lay_out("AVTo", [DEJAVU], Style(features=(("kern", kern),))).widths[0] for kern in (0, 1))
    assert together < apart - 0.5


def test_lam_and_alef_become_one_glyph():
    names = [one.glyph for one in lay_out("سلام", [DEJAVU], Style()).glyphs]
    assert len(names) == 3 and "uniFEFC" in names  # the final form of the ligature


# Directions (the orders are those of UAX #9, section 3 and its examples)


@pytest.mark.parametrize(
    ("text", "direction", "levels"),
    [
        ("car", "auto", "000"),
        ("אבג", "auto", "111"),
        ("אב 12 ג", "auto", "1112211"),
        ("a (אב) 1", "auto", "00011002"),
        ("a אב", "rtl", "2111"),
        ("אב c", "ltr", "1100"),
    ],
)
def test_embedding_levels(text, direction, levels):
    assert "".join(map(str, levels_of(text, direction))) == levels


def test_visual_order_reverses_the_higher_levels_first():
    assert visual_order([1, 2, 1]) == [2, 1, 0]
    assert visual_order([0, 1, 1, 0]) == [0, 2, 1, 3]
    assert visual_order([1, 1, 2, 2, 1]) == [4, 2, 3, 1, 0]


def test_numbers_in_hebrew_run_from_left_to_right():
    glyphs = lay_out("שלום 123", [DEJAVU], Style()).glyphs
    assert [one.character for one in glyphs] == [5, 6, 7, 4, 3, 2, 1, 0]
    assert [one.glyph for one in glyphs[:3]] == ["one", "two", "three"]


# Layout


def test_letters_that_overlap_make_no_hole():
    apart = measure(extrude(lettering("T", 20), 1)).volume + measure(extrude(lettering("Y", 20), 1)).volume
    both = measure(extrude(lettering("TY", 20, letter_spacing=-2), 1))
    assert both.components == 1 and both.genus == 0
    assert 0.8 * apart < both.volume < apart


@pytest.mark.parametrize("font", ["DejaVu Sans", "GFS Didot"])
@pytest.mark.parametrize("text", ["Grid", "Ωμέγα", "Ὦ ἄνδρες", "AVTo 8&B%"])
def test_the_volume_is_the_area_times_the_height(font, text):
    letters = lettering(text, 10, font)
    solid = measure(extrude(letters, 3), tolerance=0.001)
    (row,) = information(document_of(a=letters), 0.05)[0]["profiles"]
    assert solid.closed and solid.volume == pytest.approx(3 * row["area"], rel=1e-3)


def test_lines_stand_below_each_other_and_are_aligned():
    metrics, em = DEJAVU.metrics, DEJAVU.units_per_em
    gap = 10 * (metrics.ascender - metrics.descender + metrics.line_gap) / em
    for alignment, share in (("left", 0.0), ("centre", 0.5), ("right", 1.0)):
        layout = lay_out("II\nI", [DEJAVU], Style(alignment=alignment, line_spacing=1.5))
        first, _, third = (one.matrix[:, 2] for one in layout.glyphs)
        assert first[1] - third[1] == pytest.approx(1.5 * gap)
        assert first[0] == pytest.approx(-share * layout.widths[0])
        assert third[0] == pytest.approx(-share * layout.widths[1])
    both = lay_out("a b\nxxxxxx", [DEJAVU], Style(alignment="justify"))
    last = both.glyphs[2]
    assert last.matrix[0, 2] + last.advance == pytest.approx(both.widths[1])


def test_anchors_and_fit_to_width():
    path = outline_of(lay_out("Hxg", [DEJAVU], Style(size=20)), [DEJAVU])
    assert path.bounds()[1, 1] == pytest.approx(20 * DEJAVU.outline("H").bounds()[1, 1] / 2048, rel=0.01)
    tops = [outline_of(lay_out("H", [DEJAVU], Style(anchor=a)), [DEJAVU]).bounds()[1, 1] for a in ("top", "bottom")]
    assert tops[0] < 0 < tops[1]
    fitted = lay_out("AV\nTo fit", [DEJAVU], Style(width=100))
    assert max(fitted.widths) == pytest.approx(100) and fitted.em != 10


def test_italics_are_an_affine_map_about_the_baseline():
    upright, leaning = (outline_of(lay_out("αβγ", [DIDOT], Style(slant=s)), [DIDOT]) for s in (0.0, 12.0))
    for one, other in zip(upright.contours, leaning.contours, strict=True):
        sheared = one.points + one.points[:, 1:] * (tan(radians(12)), 0.0)
        np.testing.assert_allclose(other.points, sheared, atol=1e-12)
        assert (one.kinds == other.kinds).all()


def test_weight_grows_every_outline():
    plain, bold = (
        information(document_of(lettering("O", 20, weight=weight)), 0.01)[0]["profiles"][0] for weight in (0, 0.4)
    )
    np.testing.assert_allclose(bold["bounds"][0], np.array(plain["bounds"][0]) - 0.4, atol=0.01)
    assert bold["area"] == pytest.approx(plain["area"] + 0.4 * plain["length"], rel=0.01)


def test_letters_are_cut_out_and_follow_the_tree():
    plate = rectangle(60, 20) - lettering("Cut", 12).at(5, 5)
    whole = measure(extrude(plate, 2)).volume
    assert whole == pytest.approx(2 * (1200 - measure(extrude(lettering("Cut", 12), 1)).volume), rel=1e-9)


# What is told


def area(*nodes):
    return sum(row["area"] for row in information(document_of(*nodes), 0.01)[0]["profiles"])


def messages(*nodes):
    return [row["message"] for row in information(document_of(*nodes), 0.05)[0]["warnings"]]


def test_a_character_that_another_font_lends_is_told():
    (told,) = messages(lettering("aש", font="GFS Didot"))
    assert "GFS Didot has no “ש” (U+05E9, hebrew letter shin): set in DejaVu Sans" in told
    assert messages(extrude(lettering("aש", font="GFS Didot"), 2)) == [told]
    assert messages(lettering("abc", font="GFS Didot")) == []


def test_a_character_that_no_font_has_is_a_box_and_is_told():
    letters = lettering("aन")
    assert any("U+0928" in told and "box" in told for told in messages(letters))
    assert information(document_of(letters), 0.05)[0]["profiles"][0]["contours"] > 2


@pytest.mark.parametrize(
    ("field", "words"),
    [
        ({"font": "Dejavu Sanz"}, r"no font “Dejavu Sanz” is installed; did you mean “DejaVu Sans"),
        ({"axes": "wght=700"}, "has no axis “wght”"),
        ({"axes": "wght"}, "wght has no value"),
        ({"features": "kern=x"}, "written as “kern=0 smcp”"),
        ({"slant": 85}, "at most 80 degrees"),
        ({"text": "x" * 20_001}, "characters are too many"),
    ],
)
def test_what_cannot_be_set_is_said_on_its_row(field, words):
    (told,) = messages(lettering(**{"text": "abc", **field}))
    assert re.search(words, told)


def test_a_wrong_choice_is_refused_where_it_is_written():
    with pytest.raises(Refusal, match="alignment is one of left, centre, right, justify"):
        lettering("a", alignment="middle")


def test_an_empty_text_encloses_nothing():
    assert information(document_of(lettering("")), 0.05)[0]["profiles"][0]["area"] == 0
    assert any("encloses nothing" in told for told in messages(extrude(lettering(" "), 2)))


# Fonts


def test_fonts_are_found_by_name_and_family():
    assert find("gfs didot").path.name == "GFSDidot.otf"
    assert find("DejaVu Sans").family == "DejaVu Sans"
    assert {"GFS Didot", "DejaVu Sans"} <= {face.name for face in installed()}
    assert [face.family for face in fallbacks()] == ["DejaVu Sans", "GFS Didot"]


def test_a_font_file_goes_with_the_project(tmp_path):
    font = tmp_path / "mine.otf"
    font.write_bytes((BUNDLED / "GFSDidot.otf").read_bytes())
    letters = lettering("αβγ", font=font)
    assert letters.font == "GFS Didot" and letters.asset
    font.unlink()
    file = tmp_path / "with_font.solidtree"
    save(file, a=letters)
    assert file.stat().st_size > 100_000
    assert open_project(file).profiles[0].digest == letters.digest
    save_project(open_project(file), tmp_path / "again.solidtree")
    again = open_project(tmp_path / "again.solidtree")
    assert area(*again.profiles) == pytest.approx(area(lettering("αβγ", font="GFS Didot")))


def test_a_damaged_font_file_is_refused(tmp_path):
    font = tmp_path / "bad.ttf"
    font.write_bytes((BUNDLED / "DejaVuSans.ttf").read_bytes()[:9000])
    with pytest.raises(Refusal, match=r"bad\.ttf: the font is damaged"):
        lettering("a", font=font)


def test_lettering_becomes_editable_curves():
    document = document_of(a=lettering("O", 10, "GFS Didot"), b=circle(3))
    after = OPERATIONS["convert_to_path"](document, document.profiles[0].id)
    path = after.profiles[0]
    assert path.kind == "Path" and set(path.segments) <= set("MLCmlc")
    assert area(path) == pytest.approx(area(document.profiles[0]), rel=1e-9)


def test_lettering_is_written_as_curves(tmp_path):
    save(tmp_path / "a.svg", a=lettering("Oq", 10, "GFS Didot"))
    back = outlines(tmp_path / "a.svg")
    assert area(*back) == pytest.approx(area(lettering("Oq", 10, "GFS Didot")), rel=1e-6)


# Round a cylinder


def test_a_wrapped_rectangle_is_a_part_of_a_tube():
    solid = wrap(rectangle(30, 8).at(-15), radius=20, height=2, below=1)
    ring = pi * (22**2 - 19**2) * 8 * 30 / (2 * pi * 20)
    errors = [abs(measure(solid, tolerance=fine).volume - ring) for fine in (0.2, 0.05, 0.0125)]
    assert errors[-1] < 1e-3 * ring and errors == sorted(errors, reverse=True)
    low, high = np.array(measure(solid, tolerance=0.001).bounds)
    np.testing.assert_allclose((low[1], low[2], high[2]), (-22, 0, 8), atol=2e-3)
    np.testing.assert_allclose((-low[0], high[0]), 22 * np.sin(15 / 20), atol=2e-3)


def test_letters_engraved_in_a_cylinder_are_as_deep_as_they_should_be():
    letters = lettering("Ada & Bob", 6).at(-16, 10)
    whole, cut = (measure(solid, tolerance=0.01) for solid in (BAR, BAR - wrap(letters, radius=20, height=1, below=1)))
    # Between the radii 19 and 20, of which the outline has its true size at 20.
    assert whole.volume - cut.volume == pytest.approx(area(letters) * (20**2 - 19**2) / (2 * 20), rel=0.01)
    assert cut.closed and cut.components == 1


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"radius": 4}, "more than once round"),
        ({"below": 20}, "through the axis"),
        ({"height": 0, "below": 0}, "no thickness"),
    ],
)
def test_what_cannot_be_wrapped_is_said(fields, words):
    (told,) = messages(wrap(rectangle(30, 8), **fields))
    assert words in told


def test_an_outline_that_is_wrapped_stays_where_it_touches():
    document = document_of(a=rectangle(10, 6).at(0, 3, 5))
    after = OPERATIONS["make_solid"](document, "wrap", document.profiles[0].id, radius=25)
    solid = measure(after.solids[0], tolerance=0.001)
    np.testing.assert_allclose(solid.bounds[0], (0, 3, 5 + 26 * np.cos(10 / 25) - 25 - 2 * np.cos(10 / 25)), atol=0.01)
    np.testing.assert_allclose(solid.bounds[1][1:], (9, 6), atol=0.01)


def test_devanagari_is_as_harfbuzz_shapes_it(corpus):
    """Reordered vowels, half forms and conjuncts, from a font that has them."""
    file = corpus / "fonts" / "good" / "FreeSerif.otf"
    face = read_font(file)
    for text in ("हिन्दी", "क्षत्रिय", "र्कि"):
        buffer = hb.Buffer()
        buffer.add_str(text)
        buffer.guess_segment_properties()
        hb.shape(hb.Font(hb.Face(file.read_bytes())), buffer)
        names = [face.glyph_names[info.codepoint] for info in buffer.glyph_infos]
        glyphs, _ = set_line(text, [face])
        assert [one.glyph for one in glyphs] == names and ".notdef" not in names
        made = measure(extrude(lettering(text, 20, file), 2, tolerance=0.01))
        assert made.closed and made.volume > 0
