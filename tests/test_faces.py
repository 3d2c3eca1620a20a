"""Font faces: outlines, widths and characters against FreeType, published outlines, and damaged files."""

import json
import struct
import zlib
from importlib.resources import files
from pathlib import Path

import freetype
import numpy as np
import pytest
from fontTools.svgLib.path import parse_path
from fontTools.ttLib import TTFont
from fontTools.varLib import instancer

from solidtree.model.document.errors import Refusal
from solidtree.model.lettering.fonts.opening import LARGEST, open_face, read_font
from solidtree.model.lettering.fonts.outline_pen import OutlinePen
from solidtree.model.lettering.shaping import set_line

BUNDLED = Path(str(files("solidtree.resources"))) / "fonts"
OPENS = "6627871858622464-heap-buffer-overflow"  # a sound font all the same: FreeType and fontTools draw all of it


def area_of_freetype(outline) -> tuple[float, int]:
    """By Green's theorem from FreeType's points and tags, and how many contours."""
    total, begin, count = 0.0, 0, 0
    for end in outline.contours:
        points = np.array(outline.points[begin : end + 1], float)
        tags = [tag & 3 for tag in outline.tags[begin : end + 1]]
        begin = end + 1
        count += len(points) > 1  # a lone point is an anchor for accents
        if 1 in tags:
            turn = -tags.index(1)
            points, tags = np.roll(points, turn, axis=0), [*tags[-turn:], *tags[:-turn]]
        else:  # begins between two controls
            points = np.concatenate([[(points[0] + points[-1]) / 2], points])
            tags = [1, *tags]
        run = [points[0]]
        for point, tag in zip([*points[1:], points[0]], [*tags[1:], 1], strict=True):
            if tag == 0 and len(run) == 2:
                total += green(np.array([*run, (run[1] + point) / 2]))
                run = [(run[1] + point) / 2]
            run.append(point)
            if tag == 1:
                total += green(np.array(run))
                run = [point]
    return total, count


def green(control) -> float:
    degree = len(control) - 1
    at, weight = np.polynomial.legendre.leggauss(4)
    at = (at + 1) / 2
    values, slopes = de_casteljau(control, at), degree * de_casteljau(np.diff(control, axis=0), at)
    return 0.5 * float((weight / 2 * (values[:, 0] * slopes[:, 1] - values[:, 1] * slopes[:, 0])).sum())


def de_casteljau(control, at):
    rows = np.repeat(control[None], len(at), axis=0)
    while rows.shape[1] > 1:
        rows = rows[:, :-1] * (1 - at)[:, None, None] + rows[:, 1:] * at[:, None, None]
    return rows[:, 0]


@pytest.mark.parametrize("name", ["DejaVuSans.ttf", "GFSDidot.otf"])
def test_every_letter_of_the_bundled_fonts_is_as_freetype_draws_it(name):
    face, peer = read_font(BUNDLED / name), freetype.Face(str(BUNDLED / name))
    letters = [*range(0x21, 0x7F), *range(0x391, 0x3CA), *range(0x1F00, 0x1F16)]
    for code in letters:
        if code not in face.characters:
            assert not peer.get_char_index(code)
            continue
        peer.load_char(chr(code), freetype.FT_LOAD_NO_SCALE)
        path = face.outline(face.characters[code])
        area, contours = area_of_freetype(peer.glyph.outline)
        assert path.area() == pytest.approx(area, rel=1e-9, abs=1e-6), chr(code)
        assert len(path.contours) == contours
        assert face.advance(face.characters[code]) == peer.glyph.advance.x


def test_a_face_tells_what_it_is():
    didot = read_font(BUNDLED / "GFSDidot.otf")
    assert (didot.name, didot.kind, didot.units_per_em) == ("GFS Didot", "CFF", 1000)
    assert "kern" in didot.features and didot.axes == ()
    assert didot.metrics.x_height == pytest.approx(didot.outline("x").bounds()[1, 1], abs=15)
    dejavu = read_font(BUNDLED / "DejaVuSans.ttf")
    assert (dejavu.family, dejavu.kind, dejavu.units_per_em) == ("DejaVu Sans", "TrueType", 2048)
    assert {ord("ש"), ord("س"), ord("Ω")} <= dejavu.characters.keys()


def test_corpus_outlines(corpus):
    for key, expected in json.loads((corpus / "fonts/expected_outlines.json").read_text())["fonts"].items():
        face = read_font(corpus / "fonts" / expected["stored"])
        location = {"wght": expected["design_coords"][0]} if "design_coords" in expected else {}
        exact = {"CFF": 1e-9, "Type 1": 1e-9}.get(face.kind, 1e-6 if not location else 4e-3)
        assert len(face.glyph_names) == expected["num_glyphs"] and face.units_per_em == expected["units_per_em"]
        known = {text: glyph for text, glyph in expected["glyphs"].items() if ord(text) in face.characters}
        assert len(known) >= expected["crosscheck_fontTools"]["glyphs"], key
        for text, glyph in known.items():
            name = face.characters[ord(text)]
            path = face.outline(name, location)
            assert face.advance(name, location) == pytest.approx(glyph["advance"], abs=1.0 if location else 1e-9)
            assert len(path.contours) == glyph["contours"], (key, text)
            if path.contours:
                assert path.area() == pytest.approx(glyph["signed_area_sum"], rel=exact, abs=1e-6), (key, text)
                # FreeType rounds what it reckons the box of a cubic from.
                np.testing.assert_allclose(path.bounds().ravel(), glyph["bbox_exact"], atol=1.2)


@pytest.mark.parametrize("weight", [100, 237, 900])
def test_a_variable_font_is_drawn_as_its_instance(corpus, weight):
    file = corpus / "fonts" / "good" / "Inter-roman.var.ttf"
    face = read_font(file)
    peer = instancer.instantiateVariableFont(TTFont(file), {"wght": weight}).getGlyphSet()
    for glyph in face.glyph_names[:300]:
        pen = OutlinePen(peer)
        peer[glyph].draw(pen)
        for one, other in zip(face.outline(glyph, {"wght": weight}).contours, pen.path().contours, strict=True):
            np.testing.assert_allclose(one.points, other.points, atol=1e-3)


def test_strings_are_as_published(corpus):
    folder = corpus / "fonts" / "unicode-trt"
    for case in json.loads((folder / "expected.json").read_text()):
        face = read_font(folder / "fonts" / case["font"])
        axes = [part.split(":") for part in (case["var"] or "").replace(";", ",").split(",") if part]
        location = {tag.strip(): float(value) for tag, value in axes}
        glyphs, _ = set_line(case["text"], [face], location)
        scale = 1000 / face.units_per_em
        drawn = [
            face.outline(one.glyph, location).transformed([[scale, 0, 1000 * one.x], [0, scale, 1000 * one.y]])
            for one in glyphs
        ]
        wanted = []
        for glyph in case["glyphs"]:
            pen = OutlinePen()
            if glyph["d"]:
                parse_path(glyph["d"], pen)
            wanted.append(pen.path().transformed([[1, 0, glyph["x"]], [0, 1, glyph["y"]]]))
        drawn, wanted = ([path for path in paths if path.contours] for paths in (drawn, wanted))
        for one, other in zip(drawn, wanted, strict=True):
            assert one.area() == pytest.approx(other.area(), rel=0.01), case["id"]
            np.testing.assert_allclose(one.bounds(), other.bounds(), atol=1.01)  # published in whole units


# Bad input


def test_damaged_fonts_are_refused_in_a_line(corpus):
    for path in sorted((corpus / "fonts" / "malformed-freetype").glob("*/*")):
        if path.name == OPENS:
            face = read_font(path)
            assert all(face.outline(glyph) is not None for glyph in face.glyph_names)
            continue
        with pytest.raises(Refusal) as refused:
            read_font(path)
        assert str(refused.value).startswith(path.name) and "\n" not in str(refused.value)


@pytest.mark.parametrize("name", ["DejaVuSans.ttf", "GFSDidot.otf"])
def test_a_font_cut_short_is_refused(name):
    data = (BUNDLED / name).read_bytes()
    for length in (0, 3, 11, 40, 300, 2000, len(data) // 2):
        with pytest.raises(Refusal):
            open_face(data[:length])


@pytest.mark.parametrize("name", ["DejaVuSans.ttf", "GFSDidot.otf"])
def test_flipped_bytes_give_a_refusal_or_a_font(name):
    data = (BUNDLED / name).read_bytes()
    random = np.random.default_rng(7)
    for _ in range(12):
        changed = np.frombuffer(data, np.uint8).copy()
        changed[random.integers(0, 4096, 12)] = random.integers(0, 256, 12)
        try:
            face = open_face(changed.tobytes())
            for glyph in face.glyph_names[:20]:
                face.outline(glyph)
        except Refusal as refusal:
            assert "\n" not in str(refusal)


def woff(packed: bytes, length: int) -> bytes:
    header = struct.pack(">4sIIHHIHHIIIII", b"wOFF", 0x10000, 64 + len(packed), 1, 0, length, 1, 0, 0, 0, 0, 0, 0)
    return header + struct.pack(">4sIIII", b"glyf", 64, len(packed), length, 0) + packed


def test_packed_tables_are_unpacked_no_further_than_they_say():
    bomb = zlib.compress(bytes(2**24), 9)
    with pytest.raises(Refusal, match="is longer than it says"):
        open_face(woff(bomb, len(bomb) + 1))
    with pytest.raises(Refusal, match="take more than"):
        open_face(woff(bomb, LARGEST + 1))
    with pytest.raises(Refusal, match="cannot be unpacked"):
        open_face(woff(b"nonsense", 100))


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "not a font"),
        (b"wOF2" + bytes(100), "convert it"),
        (b"%!PS-TrueTypeFont-1.0\n", "Type 42"),
        (b"ttcf\0\1\0\0\0\0\0\0", "no face 0"),
        (b"\x89PNG\r\n\x1a\n", "not a font"),
    ],
)
def test_what_is_no_font_is_called_by_its_name(data, words):
    with pytest.raises(Refusal, match=words):
        open_face(data)


def test_unknown_glyphs_axes_and_faces_are_named():
    didot = read_font(BUNDLED / "GFSDidot.otf")
    with pytest.raises(Refusal, match="no glyph “nope”"):
        didot.outline("nope")
    with pytest.raises(Refusal, match="has no axis “wght”"):
        didot.outline("A", {"wght": 700})
    with pytest.raises(Refusal, match="no face 1"):
        read_font(BUNDLED / "GFSDidot.otf", 1)
    with pytest.raises(Refusal, match=r"nothing\.ttf: "):
        read_font("nothing.ttf")
