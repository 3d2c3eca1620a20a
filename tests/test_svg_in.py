"""SVG in: what the corpus fills, units, nesting, styles, uses; and files that are wrong or hostile."""

import json
import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from manifold3d import CrossSection, FillRule

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange.drawings.drawings_in import read_drawing
from solidtree.model.exchange.drawings.svg_in import read_svg
from solidtree.model.exchange.drawings.svg_units import PIXEL, transform
from solidtree.model.path.flatten import flatten

RULES = {"nonzero": FillRule.NonZero, "evenodd": FillRule.EvenOdd}
FULL_CIRCLE = np.pi * 80.0**2


def svg(content, head='width="100mm" height="50mm" viewBox="0 0 100 50"'):
    """An SVG of 100 mm by 50 mm, a unit a millimetre, unless told otherwise."""
    return f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{content}</svg>'.encode()


def only(content, **given):
    (shape,) = read_svg(svg(content, **given)).shapes
    return shape


def box(shape):
    """x, y of the lower left and of the upper right corner."""
    return shape.path().bounds().ravel()


def filled(shape, tolerance=1e-3):
    return CrossSection(flatten(shape.path(), tolerance), RULES[shape.rule])


# What this reader does otherwise than resvg, which is taken where two renderers differ; the area that is expected then.
OTHERWISE = {
    # Thin: both renderers' areas are 0.54 % too large; that of expected_paths.json is this.
    "shapes/path/M-A-trimmed.svg": (2643.57, [10.0, 14.4, 190.2, 40.0]),
    # 44 mm and a radius of 6 mm at 96 px per inch; this resvg knows no mm, CairoSVG and the author's picture do.
    "shapes/rect/mm-values.svg": ((44.0**2 - (4.0 - np.pi) * 6.0**2) * (96.0 / 25.4) ** 2, [18.9, 18.9, 185.2, 185.2]),
    # A nested svg does not cut here (the drawing's notes say so): whole circles, less what the page cuts.
    "structure/use/nested-xlink-to-svg-element-with-rect-and-size.svg": (None, [20.0, 20.0, 200.0, 200.0]),
    "structure/use/xlink-to-svg-element-with-rect-only-width.svg": (None, [20.0, 20.0, 200.0, 200.0]),
    "structure/use/xlink-to-svg-element-with-width-height-on-use.svg": (FULL_CIRCLE, [20.0, 20.0, 180.0, 180.0]),
    # Not rendered by the corpus for its style sheet; it is a plain square.
    "structure/use/cSS-rules.svg": (25600.0, [20.0, 20.0, 180.0, 180.0]),
}


def test_what_the_corpus_fills(corpus):
    folder = corpus / "svg"
    cases = json.loads((folder / "expected_resvg.json").read_text(encoding="utf-8"))["files"]
    assert len(cases) == 127
    wrong = []
    for name, case in cases.items():
        drawing = read_svg((folder / "resvg" / name).read_bytes())
        width, height = case.get("resvg", {"size": (200.0, 200.0)})["size"]
        assert drawing.size == pytest.approx((width * PIXEL, height * PIXEL))
        page = CrossSection.square((width, height))
        # The frame is the author's; all others count as filled, as they do in the corpus.
        parts = [filled(shape).scale((1 / PIXEL, 1 / PIXEL)) for shape in drawing.shapes if shape.name != "frame"]
        total = CrossSection()
        for part in parts:
            total += part
        total ^= page
        area, expected_box = OTHERWISE.get(
            name, (case.get("resvg", {}).get("fill_area"), case.get("resvg", {}).get("bbox"))
        )
        bounds = np.array(total.bounds())[[0, 3, 2, 1]] * (1, -1, 1, -1) + (0, height, 0, height)
        if area is not None and abs(total.area() - area) > max(0.005 * area, 2.0):
            wrong.append((name, "area", total.area(), area))
        if expected_box is not None and np.abs(bounds - expected_box).max() > 0.3:
            wrong.append((name, "bounds", bounds, expected_box))
        if "nested" in str(drawing.notes):
            assert name in OTHERWISE
    assert not wrong, wrong


def test_millimetres_and_y_up():
    assert box(only('<rect x="10" y="5" width="20" height="10"/>')) == pytest.approx([10, 35, 30, 45])
    assert read_svg(svg('<rect width="1" height="1"/>')).size == pytest.approx((100, 50))


def test_an_arc_keeps_its_kind_and_a_line_too():
    shape = only('<path d="M0 0h9q1 0 1 1c0 1 0 2-1 2a5 5 0 0 1-5 5z"/>')
    assert [command[0] for command in shape.commands] == ["move", "line", "quad", "cubic", "cubic", "close"]
    assert [command[0] for command in only('<circle r="5"/>').commands] == ["move", *["cubic"] * 4, "close"]
    assert [c[0] for c in only('<line x2="5"/>').commands] == ["move", "line"]


@pytest.mark.parametrize("tolerance", [None, 1e-2, 1e-5])
def test_a_circle_is_round_within_the_tolerance_in_millimetres(tolerance):
    data = svg('<g transform="scale(10)"><circle cx="5" cy="2.5" r="2"/></g>')
    (shape,) = read_svg(data, tolerance).shapes
    off = np.abs(np.linalg.norm(flatten(shape.path(), 1e-6)[0] - (50, 25), axis=1) - 20.0).max()
    assert off <= (2.73e-4 * 20.0 if tolerance is None else tolerance + 1e-6)
    assert len(shape.commands) == 6 or tolerance is not None


@pytest.mark.parametrize(
    ("text", "mm"),
    [
        ("10mm", 10), ("1cm", 10), ("1in", 25.4), ("72pt", 25.4), ("6pc", 25.4), ("96px", 25.4), ("96", 25.4),
        ("10%", 10), ("2em", 2 * 16 * PIXEL), ("4ex", 2 * 16 * PIXEL), ("1E1mm", 10), (" +.5CM ", 5),
    ],
)  # fmt: skip
def test_units(text, mm):
    shape = only(f'<rect width="{text}" height="1mm"/>', head='width="100mm" height="50mm"')
    assert box(shape)[2] == pytest.approx(mm)


def test_percentages_of_what_has_no_direction_are_of_the_mean_diagonal():
    assert box(only('<circle r="10%"/>'))[2] == pytest.approx(0.1 * np.sqrt((100**2 + 50**2) / 2))


@pytest.mark.parametrize("wrong", ["5cap", "1e", "abc", "1 2", "", "nan", "inf", "1e999", "0x10"])
def test_a_wrong_length_is_as_if_it_were_not_there(wrong):
    drawing = read_svg(svg(f'<rect width="{wrong}" height="5"/><rect width="3" height="3" x="{wrong}"/>'))
    assert [box(shape)[0] for shape in drawing.shapes] == [0.0]
    assert bool(drawing.notes) == bool(wrong)


@pytest.mark.parametrize(
    ("head", "corners"),
    [
        ('width="100mm" height="100mm" viewBox="0 0 10 20"', [25, 0, 75, 100]),
        ('width="100mm" height="100mm" viewBox="0 0 10 20" preserveAspectRatio="xMinYMid"', [0, 0, 50, 100]),
        ('width="100mm" height="100mm" viewBox="0 0 10 20" preserveAspectRatio="xMaxYMid meet"', [50, 0, 100, 100]),
        ('width="100mm" height="100mm" viewBox="0 0 10 20" preserveAspectRatio="none"', [0, 0, 100, 100]),
        ('width="100mm" height="100mm" viewBox="0 0 10 20" preserveAspectRatio="xMidYMin slice"', [0, -100, 100, 100]),
        ('width="100mm" height="100mm" viewBox="-10 0 20 20"', [50, 0, 100, 100]),
        ('width="100mm" viewBox="0 0 10 20"', [0, 0, 100, 200]),
        ('height="100mm" viewBox="0 0 10 20"', [0, 0, 50, 100]),
        ('width="100%" height="100%" viewBox="0 0 10 20"', [0, 0, 10 * PIXEL, 20 * PIXEL]),
        ('viewBox="0 0 10 20"', [0, 0, 10 * PIXEL, 20 * PIXEL]),
        ('viewBox="0 0 10"', [0, -20 * PIXEL, 10 * PIXEL, 0]),  # no page: the file's origin
    ],
)
def test_pages(head, corners):
    assert box(only('<rect width="10" height="20"/>', head=head)) == pytest.approx(corners)


@pytest.mark.parametrize(
    ("text", "point"),
    [
        ("translate(3)", (4, 2)), ("translate(3,4)", (4, 6)), ("scale(2)", (2, 4)), ("scale(2 3)", (2, 6)),
        ("rotate(90)", (-2, 1)), ("rotate(90 1 1)", (0, 1)), ("skewX(45)", (3, 2)), ("skewY(45)", (1, 3)),
        ("matrix(1 2 3 4 5 6)", (12, 16)), ("translate(1,0) scale(2)", (3, 4)), ("scale(2),translate(1,0)", (4, 4)),
        ("", (1, 2)), ("  rotate ( 180 ) ", (-1, -2)), ("translate(3)scale(2)", (5, 4)),
    ],
)  # fmt: skip
def test_transforms(text, point):
    a, b, c, d, e, f = transform(text)
    assert (a + 2 * c + e, b + 2 * d + f) == pytest.approx(point)


@pytest.mark.parametrize("text", ["translate(1", "scale()", "rotate(1 2)", "turn(5)", "translate(1) x", "scale(1e400)"])
def test_a_wrong_transform_is_left_out_with_a_note(text):
    drawing = read_svg(svg(f'<rect id="r" transform="{text}" width="2" height="2"/>'))
    assert box(drawing.shapes[0]) == pytest.approx([0, 48, 2, 50])
    assert "“r”" in drawing.notes[0] and text[:5] in drawing.notes[0]


def test_transforms_nest():
    shape = only('<g transform="translate(10 10)"><g transform="scale(2)"><rect width="3" height="4"/></g></g>')
    assert box(shape) == pytest.approx([10, 32, 16, 40])
    assert not read_svg(svg('<g transform="scale(0 1)"><rect width="3" height="4"/></g>')).shapes


@pytest.mark.parametrize(
    ("rect", "area"),
    [
        ('rx="2"', 200 - (4 - np.pi) * 4), ('ry="2"', 200 - (4 - np.pi) * 4), ('rx="2" ry="4"', 200 - (4 - np.pi) * 8),
        ('rx="50" ry="5"', np.pi * 50), ('rx="0" ry="4"', 200), ('rx="-1"', 200),
        ('rx="2" ry="-1"', 200 - (4 - np.pi) * 4),
        ('rx="auto" ry="2"', 200 - (4 - np.pi) * 4), ('rx="10%"', 200 - (4 - np.pi) * 50),
    ],
)  # fmt: skip
def test_round_corners(rect, area):
    (shape,) = read_svg(svg(f'<rect width="20" height="10" {rect}/>'), 1e-6).shapes
    assert abs(shape.path().area()) == pytest.approx(area, abs=1e-3)


def test_strokes_fills_and_colours():
    shapes = read_svg(
        svg(
            '<g fill="none" stroke="#f00" stroke-width="2"><path id="a" d="M0 0h5v5"/>'
            '<path id="b" d="M0 0h5v5" transform="scale(2 8)" style="fill: rgb(0,50%, 255)"/>'
            '<path id="c" d="M0 0h5v5" stroke="none"/><path id="d" d="M0 0h5v5" stroke-width="0"/></g>'
            '<path id="e" d="M0 0h5v5" fill="url(#x) blue" fill-rule="evenodd"/>'
            '<g color="lime"><path id="f" d="M0 0h5v5" fill="currentColor"/></g>'
        )
    ).shapes
    told = [(s.name, s.filled, s.stroked, s.stroke_width, s.colour, s.rule) for s in shapes]
    assert told == [
        ("a", False, True, pytest.approx(2.0), "#ff0000", "nonzero"),
        ("b", True, True, pytest.approx(8.0), "#0080ff", "nonzero"),  # twice and eight times: four times in the mean
        ("c", False, False, 0.0, None, "nonzero"),
        ("d", False, False, 0.0, None, "nonzero"),
        ("e", True, False, 0.0, "#0000ff", "evenodd"),
        ("f", True, False, 0.0, "#00ff00", "nonzero"),
    ]


@pytest.mark.parametrize(
    ("sheet", "attributes", "colour"),
    [
        ("rect{fill:red}", 'fill="blue"', "#ff0000"),
        ("rect{fill:red}", 'style="fill:blue"', "#0000ff"),
        ("rect{fill:red!important}", 'style="fill:blue"', "#ff0000"),
        ("rect{fill:red!important}", 'style="fill:blue !important"', "#0000ff"),
        (".k{fill:red} rect{fill:blue}", "", "#ff0000"),
        ("#r{fill:red} g .k.l{fill:blue} rect{fill:lime}", "", "#ff0000"),
        ("rect{fill:red} rect{fill:blue}", "", "#0000ff"),
        ("g rect{fill:red} rect{fill:blue}", "", "#ff0000"),
        ("svg g .k{fill:red}", "", "#ff0000"),
        ("svg > rect{fill:red}", "", "#000000"),
        ("g > rect{fill:red}", "", "#ff0000"),
        ("svg > g > g > .k{fill:red}", "", "#ff0000"),
        ("svg > g .k{fill:red}", "", "#ff0000"),
        ("g g > g .k{fill:red}", "", "#000000"),
        ("* {fill:red}", "", "#ff0000"),
        ("circle, .k {fill:red}", "", "#ff0000"),
        (".other, #q{fill:red}", "", "#000000"),
        ("/* .k{fill:blue} */ .k{fill:red}", "", "#ff0000"),
        ("@media print { .k {fill:blue} } .k{fill:red}", "", "#ff0000"),
        (".k{fill:red", "", "#ff0000"),
        (".k:hover{fill:blue} .k[x]{fill:blue}", "", "#000000"),
        ("g{fill:red}", "", "#ff0000"),  # inherited
        ("g{fill:red}", 'fill="inherit"', "#ff0000"),
        ("g{fill:red}", 'fill="initial"', "#000000"),
        ("<![CDATA[.k{fill:red}]]>", "", "#ff0000"),
    ],
)
def test_style_sheets(sheet, attributes, colour):
    shape = only(f'<style>{sheet.replace(">", "&gt;") if "CDATA" not in sheet else sheet}</style>'
                 f'<g id="o"><g><rect id="r" class="k l" {attributes} width="1" height="1"/></g></g>')  # fmt: skip
    assert shape.colour == colour


def test_what_is_hidden_or_only_defined_is_left_out():
    drawing = read_svg(
        svg(
            '<defs><rect width="1" height="1"/></defs><symbol><rect width="1" height="1"/></symbol>'
            '<clipPath><rect width="1" height="1"/></clipPath><random><rect width="1" height="1"/></random>'
            '<g display="none"><rect width="1" height="1" display="inline"/></g>'
            '<g visibility="hidden"><rect width="1" height="1"/>'
            '<rect id="seen" width="1" height="1" visibility="visible"/></g>'
        )
    )
    assert [shape.name for shape in drawing.shapes] == ["seen"]


def test_use_symbol_and_nested_svg():
    shapes = read_svg(
        svg(
            '<symbol id="s" viewBox="0 0 10 10"><rect width="10" height="10"/></symbol>'
            '<use href="#s" x="20" y="10" width="20" height="10"/>'
            '<svg x="50" y="20" width="20" height="20" viewBox="0 0 2 2"><rect width="50%" height="1"/></svg>'
        )
    ).shapes
    assert [box(shape).round(9).tolist() for shape in shapes] == [[25, 30, 35, 40], [50, 20, 60, 30]]


def test_uses_inherit_from_where_they_stand_and_say_what_they_cannot():
    drawing = read_svg(
        svg(
            '<defs><rect id="r" width="1" height="1"/></defs><g fill="red"><use href="#r"/></g>'
            '<use href="#nowhere"/><use href="http://example.org/x.svg#a"/><use id="me" href="#me"/>'
            '<g id="g"><use href="#g"/></g>'
        )
    )
    assert [shape.colour for shape in drawing.shapes] == ["#ff0000"]
    assert len(drawing.notes) == 4 and "never read" in drawing.notes[1] and "itself" in drawing.notes[2]


def test_switch_takes_the_first_that_asks_for_nothing_special():
    shapes = read_svg(
        svg(
            '<switch><g requiredExtensions="http://x"><rect id="a" width="1" height="1"/></g>'
            '<rect id="b" systemLanguage="el, tlh" width="1" height="1"/><rect id="c" width="1" height="1"/>'
            '<rect id="d" width="1" height="1"/></switch>'
        )
    ).shapes
    assert [shape.name for shape in shapes] == ["c"]


def test_what_is_left_out_is_said():
    notes = read_svg(
        svg(
            '<text>a</text><text>b</text><image/><rect width="1" height="1" clip-path="url(#c)"/>'
            '<g mask="url(#m)"/><style>@import "x.css"; a:b{}</style>'
        )
    ).notes
    assert [any(word in note for note in notes) for word in ("text", "picture", "clip", "mask", "import", "a:b")] == [
        True
    ] * 6
    assert any(note.endswith("(2 times)") for note in notes)


def test_the_label_of_inkscape_names_a_shape():
    data = svg(
        '<rect xmlns:i="http://www.inkscape.org/namespaces/inkscape" i:label="Lid" id="r" width="1" height="1"/>'
    )
    assert read_svg(data).shapes[0].name == "Lid"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1"])
def test_encodings(encoding, tmp_path):
    text = svg('<rect id="Ü" width="1" height="1"/>').decode()
    file = tmp_path / "a.svg"
    file.write_bytes(f'<?xml version="1.0" encoding="{encoding}"?>{text}'.encode(encoding))
    assert read_drawing(file).shapes[0].name == "Ü"


DOCTYPE = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'


def test_the_plain_document_type_of_svg_is_passed_over():
    assert read_svg(DOCTYPE.encode() + svg('<rect width="1" height="1"/>')).shapes


BODY = svg('<rect width="1" height="1"/>').decode()
BOMB = "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10))


def uses(levels, each):
    """Groups each of which shows the one before `each` times."""
    first = '<defs><g id="g0"><rect width="1" height="1"/></g>'
    uses_of = "".join(f"<g id='g{i + 1}'>" + f"<use href='#g{i}'/>" * each + "</g>" for i in range(levels))
    return f'{first}{uses_of}</defs><use href="#g{levels}"/>'


HOSTILE = {
    "entity bomb": (f'<!DOCTYPE svg [<!ENTITY a0 "ha">{BOMB}]>' + BODY.replace("<rect", "&a9;<rect"), "entities"),
    "entity": (f'<!DOCTYPE svg [<!ENTITY a "1">]>{BODY}', "entit"),
    "file entity": (f'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>{BODY}', "entit"),
    "parameter entity": (f'<!DOCTYPE svg [<!ENTITY % a SYSTEM "http://127.0.0.1/x"> %a;]>{BODY}', "entit"),
    "outside DTD": (f'<!DOCTYPE svg SYSTEM "http://127.0.0.1:1/evil.dtd">{BODY}', "evil.dtd"),
    "local DTD": (f'<!DOCTYPE svg SYSTEM "file:///etc/passwd">{BODY}', "never read"),
    "unknown entity": (DOCTYPE + BODY.replace("<rect", "&nbsp;<rect"), "nbsp"),
    "nested groups": (svg("<g>" * 1_000_000).decode(), "1,000 deep"),
    "uses of uses": (svg(uses(12, 10)).decode(), "simplify"),
    "uses in a row": (svg("".join(f'<use id="u{i}" href="#u{i + 1}"/>' for i in range(5000))).decode(), "100 deep"),
    "many points by uses": (
        svg(f'<path id="p" d="M0 0{"l1 1" * 50_000}"/>' + '<use href="#p"/>' * 5000).decode(),
        "500,000 points",
    ),
    "not a number": (svg('<path d="M nan nan L 5 5"/>').decode(), "holds no outlines"),
    "huge": (svg('<path id="far" d="M 1e14 0 L 0 0"/>').decode(), "“far”"),
    "huge scale": (svg('<rect id="far" width="1" height="1" transform="scale(1e14)"/>').decode(), "“far”"),
    "cut short": (BODY[:-9], "line 1"),
    "not XML": ("Dear all, here is the drawing <svg", "no SVG file"),
    "HTML": ("<!DOCTYPE html><html><body/></html>", "“html”"),
    "another root": ('<svg xmlns="http://example.org/"/>', "no SVG file"),
    "encoding": ('<?xml version="1.0" encoding="martian"?>' + BODY, "encoding"),
    "empty": ("", "is empty"),
    "blank": (" \n", "no kind"),
    "compressed": ("\x1f\x8b\x08", "svgz"),
    "nothing in it": (svg("").decode(), "holds no outlines"),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_files_are_refused_within_seconds_by_name(case, tmp_path):
    text, words = HOSTILE[case]
    file = tmp_path / "thing.svg"
    file.write_bytes(text.encode("latin-1" if case == "compressed" else "utf-8"))
    start = time.monotonic()
    with pytest.raises(Refusal) as caught:
        read_drawing(file)
    assert time.monotonic() - start < 10
    message = str(caught.value)
    assert message.startswith("thing.svg: ") and words in message, message
    assert message.isprintable() and len(message) <= 500


def test_many_style_rules_for_many_elements_end():
    sheet = "<style>" + ".a{fill:red}" * 5000 + "</style>"
    with pytest.raises(Refusal, match="style rules"):
        read_svg(svg(sheet + '<rect class="a" width="1" height="1"/>' * 2000))


GOOD = svg(
    '<style>.a{fill:red}</style><defs><g id="s"><circle r="3"/></g></defs><use href="#s" x="5"/>'
    '<path class="a" d="M1 1a25 25 0 1025-25z" transform="rotate(30)"/><polygon points="1,2 3,4 5,0"/>'
)


def test_a_file_cut_anywhere_is_refused_or_read():
    for end in range(0, len(GOOD), 3):
        with pytest.raises(Refusal):
            read_svg(GOOD[:end])


@given(st.lists(st.tuples(st.integers(0, len(GOOD) - 1), st.integers(0, 255)), min_size=1, max_size=8))
def test_a_damaged_file_is_refused_or_read(changes):
    data = bytearray(GOOD)
    for place, byte in changes:
        data[place] = byte
    try:
        drawing = read_svg(bytes(data))
    except Refusal:
        return
    for shape in drawing.shapes:
        assert all(np.isfinite(point).all() for _, *points in shape.commands for point in points)
