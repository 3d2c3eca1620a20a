"""Fonts of a project: carried, edited, undone, saved with it, and told where they are not what they were."""

import json
import re
import zipfile
from math import radians, tan

import numpy as np
import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.project_font import ProjectFont
from solidtree.model.document.resolve import Resolver, resolve
from solidtree.model.document.table import from_table, same_document, to_table
from solidtree.model.editing.session import Session
from solidtree.model.lettering.fonts.drawn_glyph import DrawnGlyph
from solidtree.model.lettering.fonts.edited_face import glyph_fields, glyphs_as_bytes, touched
from solidtree.model.lettering.fonts.face import Run
from solidtree.model.lettering.fonts.in_document import face_in
from solidtree.model.lettering.fonts.library import face_of, find, version_of
from solidtree.model.lettering.lettering import path_of_lettering, remarks_on
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.path.shapes import rectangle as rectangle_path
from solidtree.model.project.assets import AssetStore, assets_of, default_store
from solidtree.model.project.project_file import open_project, save_project
from solidtree.model.script import box, document_of, extrude, lettering
from solidtree.model.solid.information import information
from solidtree.model.solid.results import evaluate_document

DEJAVU, DIDOT = "DejaVu Sans", "GFS Didot"
BRICK = {"advance": 1000.0, "points": ((100, 0), (900, 0), (900, 1400), (100, 1400)), "segments": "MLLLl", "joints": ""}


def do(document: Document, name: str, *arguments) -> Document:
    return OPERATIONS[name](document, *arguments)


def volume(document: Document) -> float:
    return information(document, 0.01)[0]["solids"][0]["volume"]


def text(words: str, **more) -> Document:
    return document_of(extrude(lettering(words, 20.48, **more), 2))


def test_a_glyph_drawn_anew_is_what_lettering_shows_and_its_width_moves_the_next():
    before = text("II")
    after = do(before, "edit_glyphs", DEJAVU, {"I": BRICK})
    # 2,048 units are 20.48 mm: a brick of 8 by 14 mm, and the next one 10 mm on.
    assert volume(after) == pytest.approx(2 * 8 * 14 * 2, rel=1e-9)
    bounds = information(after, 0.01)[0]["solids"][0]["bounds"]
    np.testing.assert_allclose(np.array(bounds)[:, 0], [1, 19])
    assert volume(before) == volume(text("II")), "the document before keeps the font's own"
    assert before.solids == after.solids, "the lettering itself is as it was"


def test_what_is_put_together_from_an_edited_glyph_follows():
    after = do(text("Í"), "edit_glyphs", DEJAVU, {"I": BRICK})
    plain, edited = face_of(DEJAVU), face_in(after, DEJAVU)
    assert "Iacute" in touched(plain, ["I"]) and "A" not in touched(plain, ["I"])
    accent = plain.outline("Iacute").area() - plain.outline("I").area()
    assert edited.outline("Iacute").area() == pytest.approx(accent + 800 * 1400)
    assert edited.source("A") is edited.base and edited.source("Iacute") is edited


def test_glyphs_leaned_and_grown_keep_their_side_bearings():
    plain = face_of(DIDOT)
    shear = tan(radians(12))
    leaned = do(text("α"), "transform_glyphs", DIDOT, ["alpha"], [(1, shear, 0), (0, 1, 0)])
    grown = do(text("α"), "transform_glyphs", DIDOT, "alpha", [(1, 0, 0), (0, 1, 0)], 10)
    own = plain.outline("alpha")
    there = face_in(leaned, DIDOT)
    assert there.advance("alpha") == plain.advance("alpha")
    for contour, wanted in zip(there.outline("alpha").contours, own.contours, strict=True):
        x, y = wanted.points.T
        np.testing.assert_allclose(contour.points, np.column_stack((x + shear * y, y)), atol=1e-9)
    bold = face_in(grown, DIDOT)
    assert bold.advance("alpha") == plain.advance("alpha") + 20
    before, after = own.bounds(), bold.outline("alpha").bounds()
    assert after[0, 0] == pytest.approx(before[0, 0], abs=1)
    assert bold.advance("alpha") - after[1, 0] == pytest.approx(plain.advance("alpha") - before[1, 0], abs=1)
    # Steiner: grown by r, an outline's area rises by about r times its length.
    assert bold.outline("alpha").area() == pytest.approx(own.area() + 10 * own.length(), rel=0.05)


def test_glyphs_are_reset_one_by_one_and_all():
    document = text("IO")
    edited = do(document, "edit_glyphs", DEJAVU, {"I": BRICK, "O": BRICK})
    half = do(edited, "reset_glyphs", DEJAVU, "O")
    assert face_in(half, DEJAVU).outline("O").area() == face_of(DEJAVU).outline("O").area()
    assert abs(face_in(half, DEJAVU).outline("I").area()) == 800 * 1400
    none = do(half, "reset_glyphs", DEJAVU)
    assert not none.fonts[0].edited and volume(none) == volume(document)
    assert do(none, "reset_glyphs", DEJAVU) is none


def test_kerning_and_ligatures_stay_where_glyphs_are_edited():
    plain = face_of(DEJAVU)
    after = do(text("AVAfi"), "edit_glyphs", DEJAVU, {"A": {**BRICK, "advance": plain.advance("A") + 100}})
    one, two = (face.shape(Run("AVAfi")) for face in (plain, face_in(after, DEJAVU)))
    assert [glyph.glyph for glyph in one] == [glyph.glyph for glyph in two]
    wider = [b.advance[0] - a.advance[0] for a, b in zip(one, two, strict=True)]
    assert wider == [100 if glyph.glyph == "A" else 0 for glyph in one]


def test_a_copy_is_edited_by_itself():
    document = do(text("I"), "copy_font", DEJAVU, "Brick")
    document = do(document, "edit_glyphs", "brick", {"I": BRICK})
    assert volume(document) == volume(text("I"))
    letters = document.solids[0].children[0].id
    document = do(document, "set_field", letters, "font", "Brick")
    assert volume(document) == pytest.approx(8 * 14 * 2)
    with pytest.raises(Refusal, match="there is a font called “GFS Didot” already"):
        do(document, "copy_font", DEJAVU, "GFS Didot")
    with pytest.raises(Refusal, match="“Brick” is not installed here"):
        do(document, "release_font", "Brick")


def test_the_project_file_carries_the_font_and_its_edited_glyphs(tmp_path):
    document = do(text("I", font=DIDOT), "edit_glyphs", DIDOT, {"I": BRICK})
    file, store = tmp_path / "text.solidtree", AssetStore(tmp_path / "elsewhere")
    save_project(document, file)
    again = open_project(file, store)
    assert same_document(again, document) and again.fonts == document.fonts
    assert assets_of(again) == {document.fonts[0].base, document.fonts[0].asset}
    assert all(store.has(sha) for sha in assets_of(again))


def test_an_installed_font_is_noted_with_its_version_and_another_version_is_told(tmp_path):
    document = text("I")
    file = tmp_path / "text.solidtree"
    save_project(document, file)
    again = open_project(file)
    base, face = version_of(DEJAVU)
    assert again.fonts == (ProjectFont(DEJAVU, base, face),) and not assets_of(again)
    assert same_document(again, document)
    (root,) = resolve(again).solids
    assert not remarks_on(root.children[0])
    other = again.with_(fonts=(ProjectFont(DEJAVU, "0" * 64),))
    (root,) = resolve(other).solids
    assert "not the version here that the project was made with" in remarks_on(root.children[0])[0]
    save_project(other, file)
    assert open_project(file).fonts == other.fonts, "what was noted first stays until the font is carried"
    carried = do(other, "carry_font", DEJAVU)
    assert carried.fonts[0].asset == base and default_store().has(base)


def test_only_what_changed_is_resolved_again():
    document = document_of(extrude(lettering("I"), 2), extrude(lettering("I", font=DIDOT), 2))
    resolver = Resolver()
    before = resolver.resolve(document).solids
    assert resolver.resolve(do(document, "carry_font", DIDOT)).solids[0] is before[0]
    after = resolver.resolve(do(document, "edit_glyphs", DIDOT, {"I": BRICK})).solids
    assert after[0] is before[0] and after[1].digest != before[1].digest


def test_edits_are_undone_and_their_lines_do_the_same(tmp_path):
    from replay import replayed

    start = text("I")
    session = Session(start)
    session.do("edit_glyphs", DEJAVU, {"I": BRICK})
    session.do("transform_glyphs", DEJAVU, ["I"], [(1, 0.25, 0), (0, 1, 0)], 20.0)
    assert same_document(replayed(session.log, start), session.document)
    session.undo(), session.undo()
    assert session.document is start


def test_letters_turned_to_a_path_and_pasted_projects_keep_the_edited_shapes():
    outline = document_of(lettering("I", 20.48))
    edited = do(outline, "edit_glyphs", DEJAVU, {"I": BRICK})
    path = do(edited, "convert_to_path", [edited.profiles[0].id]).profiles[0]
    assert sorted(path.points) == [(1, 0), (1, 14), (9, 0), (9, 14)]
    both = do(text("I"), "insert_document", edited)
    assert both.profiles[0].font == DEJAVU and both.fonts == edited.fonts
    other = do(outline, "edit_glyphs", DEJAVU, {"I": {**BRICK, "advance": 700}})
    both = do(edited, "insert_document", other)
    assert [font.asset for font in both.fonts] == [edited.fonts[0].asset, other.fonts[0].asset]
    assert both.profiles[1].font == both.fonts[1].name != DEJAVU


@pytest.mark.parametrize(
    ("glyphs", "words"),
    [
        ({"gone": BRICK}, "DejaVu Sans has no glyph “gone”"),
        ({"I": {**BRICK, "advance": "wide"}}, "“I” needs an advance, points and segments"),
        ({"I": {**BRICK, "advance": 1e6}}, "cannot be 1e\\+06 units wide"),
        ({"I": {**BRICK, "segments": "MLLL"}}, "open contour"),
        ({"I": {**BRICK, "points": ((1e5, 0), (9, 0), (9, 9), (0, 9))}}, "farther than 32767 units"),
        ({"I": {**BRICK, "weight": 1}}, "no field 'weight'"),
        ({"I": {**BRICK, "points": ((0, 0, 1), (9, 0, 1), (9, 9, 1), (0, 9, 1))}}, "in space"),
    ],
)
def test_what_no_glyph_can_be_is_refused(glyphs, words):
    with pytest.raises(Refusal, match=words):
        do(text("I"), "edit_glyphs", DEJAVU, glyphs)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (("carry_font", "Gone"), "no font “Gone” is installed"),
        (("transform_glyphs", DEJAVU, ["I"], [(1, 1, 0), (1, 1, 0)]), "flatten the glyphs"),
        (("transform_glyphs", DEJAVU, ["I"], [(1, 1)]), "two rows of three numbers"),
        (("transform_glyphs", DEJAVU, ["I"], [(40, 0, 0), (0, 40, 0)]), "farther than 32767 units"),
        (("reset_glyphs", DEJAVU), "carries no font called “DejaVu Sans”"),
        (("copy_font", DEJAVU, " "), "needs a name"),
    ],
)
def test_what_makes_no_sense_is_refused(call, words):
    with pytest.raises(Refusal, match=words):
        do(text("I"), *call)


def restricted(tmp_path):
    """A font file whose licence bits forbid embedding."""
    from fontTools.ttLib import TTFont

    font = TTFont(find(DIDOT).path)
    font["OS/2"].fsType = 2
    font["name"].setName("Locked", 1, 3, 1, 0x409)
    font["name"].setName("Locked", 1, 1, 0, 0)
    font.save(tmp_path / "locked.otf")
    return tmp_path / "locked.otf"


def test_a_font_whose_licence_forbids_it_is_not_carried(tmp_path):
    with pytest.raises(Refusal, match=r"locked\.otf: its licence bits forbid that documents carry it"):
        lettering("I", font=restricted(tmp_path))


def test_damaged_glyphs_fail_in_words_on_the_row(tmp_path):
    store = default_store()
    base = store.put(find(DIDOT).path.read_bytes())
    good = glyphs_as_bytes(base, 0, {"I": DrawnGlyph(rectangle_path(800, 1400), 1000.0)})
    bad = [b'{"solidtree_font":1}', good.replace(b'"MLLLl"', b'"MZ"'), good[:-9], good.replace(b":1,", b":2,", 1),
           json.dumps({"solidtree_font": 1, "base": store.put(good), "face": 0, "glyphs": {}},
                      separators=(",", ":")).encode()]  # fmt: skip
    for data in bad:
        document = text("I", font=DIDOT).with_(fonts=(ProjectFont(DIDOT, base, 0, store.put(data)),))
        (result,) = evaluate_document(document).solids
        assert result.solid is None
        assert re.search(
            "the edited glyphs of the font are damaged|by a newer Solidtree|no segment", str(result.messages)
        )


def test_fonts_of_a_file_are_checked(tmp_path):
    table = to_table(do(text("I"), "carry_font", DEJAVU))
    row = table["fonts"][0]
    for change, words in (
        ({"base": "../x"}, "64 hexadecimal digits"),
        ({"face": -1}, "whole number"),
        ({"name": ""}, "needs a name"),
        ({"more": 1}, "unknown field 'more'"),
    ):
        with pytest.raises(Refusal, match=words):
            from_table({**table, "fonts": [{**row, **change}]})
    with pytest.raises(Refusal, match="two fonts of one name"):
        from_table({**table, "fonts": [row, {**row, "name": "dejavu  sans"}]})
    file = tmp_path / "lacking.solidtree"
    with zipfile.ZipFile(file, "w") as archive:
        rows = [{**row, "base": "ab" * 32, "asset": "ab" * 32}]
        archive.writestr("document.json", json.dumps({**table, "fonts": rows, "format": 4}))
    with pytest.raises(Refusal, match="the font “DejaVu Sans”: its file assets/abab"):
        open_project(file)


def test_glyph_fields_make_the_glyph_again():
    face = face_of(DIDOT)
    drawn = DrawnGlyph(face.outline("g"), face.advance("g"))
    again = face_in(do(text("g", font=DIDOT), "edit_glyphs", DIDOT, {"g": glyph_fields(drawn)}), DIDOT)
    assert glyph_fields(DrawnGlyph(again.outline("g"), again.advance("g"))) == glyph_fields(drawn)
    assert path_of_lettering(lettering("g", font=DIDOT)).contours


def test_a_font_that_lettering_brings_itself_may_be_released(tmp_path):
    from shutil import copy

    file = copy(find(DIDOT).path, tmp_path / "own.otf")
    document = text("I", font=file).with_(fonts=())
    letters = document.solids[0].children[0]
    own = letters.with_(font="Only Here")
    document = document.with_(solids=(document.solids[0].with_(children=(own,)),))
    edited = do(document, "edit_glyphs", "Only Here", {"I": BRICK})
    assert do(edited, "release_font", "Only Here").fonts == ()


def test_a_box_knows_nothing_of_fonts():
    assert not box(1).symbolic and not document_of(box(1)).fonts
