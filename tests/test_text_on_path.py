"""Text on a path: each letter rigid, upright on the curve where the middle of its advance stands, with its marks."""

import unicodedata
from math import cos, pi, sin

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.outlines import is_outline
from solidtree.model.document.placement import Placement
from solidtree.model.document.resolve import resolve
from solidtree.model.document.tree import numbered
from solidtree.model.lettering.fonts.library import face_of
from solidtree.model.lettering.layout import Style, lay_out
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.outline.paths import path_of
from solidtree.model.script import (
    box,
    circle,
    cylinder,
    document_of,
    extrude,
    instance,
    lettering,
    measure,
    path,
    rectangle,
    sphere,
    text_on_path,
    union,
    wrap,
)
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.information import information
from solidtree.model.solid.results import display_of, result_of
from solidtree.render.pick import Picker

DEJAVU = face_of("DejaVu Sans")
LINE = path("M 0 0 H 100")
RADIUS = 30


def contours(node):
    """(k, 2) points of each contour of a resolved outline."""
    return [contour.points for contour in path_of(node).contours]


def messages(*nodes):
    return [row["message"] for row in information(document_of(*nodes), 0.05)[0]["warnings"]]


def middles(text, size=10.0, **style):
    """Along the line the middle of each letter's advance."""
    glyphs = lay_out(text, [DEJAVU], Style(size=size, **style)).glyphs
    return [float(one.matrix[0, 2]) + one.advance / 2 for one in glyphs]


def same(one, other, tolerance=1e-9):
    assert len(one) == len(other)
    for a, b in zip(one, other, strict=True):
        np.testing.assert_allclose(a, b, atol=tolerance)


@pytest.mark.parametrize("text", ["AVTo fig", "Ὦ ἄνδρες", "x́y", "שָׁלוֹם", "سَلَام"])
def test_on_a_straight_line_letters_stand_as_they_do_without_it(text):
    letters = lettering(text, 10).at(3, 0.5)
    found, plain = (sorted(contours(node), key=lambda points: points.tolist()) for node in (
        text_on_path(letters, LINE), letters))  # fmt: skip
    same(found, plain)


@pytest.mark.parametrize("flip", [False, True])
@pytest.mark.parametrize("shift", [0, 2.5])
def test_each_letter_is_turned_about_the_middle_of_its_advance_on_a_circle(flip, shift):
    """A letter is the plain one, turned rigidly as the tangent is, at an arc length of its middle."""
    text, start = "Hexagon", 7
    found = contours(text_on_path(lettering(text, 10), circle(RADIUS), start, shift, flip))
    wanted = []
    side = -1 if flip else 1  # the other way round
    plain = lay_out(text, [DEJAVU], Style(size=10)).glyphs
    for middle, one in zip(middles(text), plain, strict=True):
        angle = side * (start + middle) / RADIUS
        along = side * np.array((-sin(angle), cos(angle)))
        up = np.array((-along[1], along[0]))
        for contour in DEJAVU.outline(one.glyph).transformed(one.matrix).contours:
            x, y = contour.points.T
            place = RADIUS * np.array((cos(angle), sin(angle))) + shift * up
            wanted.append(place + np.outer(x - middle, along) + np.outer(y, up))
    same(found, wanted, 1e-7)


def test_letters_lean_inwards_or_outwards_of_a_circle():
    inside, outside = (
        np.concatenate(contours(text_on_path(lettering("HHHH", 5), circle(RADIUS), flip=flip))) for flip in (0, 1)
    )
    assert np.linalg.norm(inside, axis=1).max() < RADIUS * 1.01
    assert np.linalg.norm(outside, axis=1).min() > RADIUS * 0.99


@pytest.mark.parametrize(("alignment", "share"), [("left", 0), ("centre", 0.5), ("right", 1)])
def test_the_lettering_stands_as_it_is_aligned(alignment, share):
    wide = lay_out("HoH", [DEJAVU], Style(size=10)).widths[0]
    plain = lettering("HoH", 10).at(share * (100 - wide) + 4)
    found = text_on_path(lettering("HoH", 10, alignment=alignment), LINE, start=4)
    if alignment == "right":
        found, plain = text_on_path(found.children[0], LINE, start=-4), lettering("HoH", 10).at(100 - wide - 4)
    same(contours(found), contours(plain))


def test_marks_and_ligatures_move_with_their_letter():
    """Decomposed and composed letters are set alike: the mark stays where it stands above its letter."""
    curve = path("M 0 0 C 10 30 40 30 50 0")
    composed, apart = (
        sorted(tuple(np.round(c.mean(axis=0), 1)) for c in contours(text_on_path(lettering(text, 8), curve)))
        for text in ("éàü", unicodedata.normalize("NFD", "éàü"))
    )
    np.testing.assert_allclose(composed, apart, atol=0.11)
    fi = lettering("office", 8, "GFS Didot")
    rigid = [np.linalg.norm(np.diff(c, axis=0), axis=1).sum() for c in contours(fi)]
    bent = [np.linalg.norm(np.diff(c, axis=0), axis=1).sum() for c in contours(text_on_path(fi, curve))]
    np.testing.assert_allclose(sorted(bent), sorted(rigid), rtol=1e-9)


def test_a_mark_of_another_font_stays_with_its_letter():
    """GFS Didot lacks the Hebrew point, which another font sets by itself, without an advance."""
    letters = lettering("a\u05b8b", 8, "GFS Didot")
    plain, set_ = (np.array([c.mean(axis=0) for c in contours(node)]) for node in (
        letters, text_on_path(letters, circle(RADIUS))))  # fmt: skip
    count = len(contours(lettering("a", 8, "GFS Didot"))) + len(contours(lettering("\u05b8", 8)))
    gaps = [np.linalg.norm(middles[:count, None] - middles[:count], axis=2) for middles in (plain, set_)]
    assert len(plain) == len(set_) > count
    np.testing.assert_allclose(gaps[1], gaps[0], atol=1e-9)


def test_hebrew_runs_from_right_to_left_along_the_curve():
    """The first letter of the text stands farthest along."""
    found = contours(text_on_path(lettering("אבג", 10), LINE))
    first = contours(text_on_path(lettering("א", 10), LINE))
    spans = [np.ptp(points, axis=0).round(6).tolist() for points in found]
    alef = next(i for i, span in enumerate(spans) if span == np.ptp(first[0], axis=0).round(6).tolist())
    assert found[alef][:, 0].max() == max(points[:, 0].max() for points in found)


# What has no room


def test_letters_beyond_the_end_of_an_open_curve_are_left_out_and_named():
    places = middles("abcdef")
    made = text_on_path(lettering("abcdef", 10), path(f"M 0 0 H {(places[3] + places[4]) / 2}"))
    same(contours(made), contours(lettering("abcd", 10)))
    (told,) = messages(made)
    assert told.startswith("2 letters have no room on the curve and are left out: “e” (U+0065")
    assert "“f”" in told and "“d”" not in told
    assert messages(extrude(made, 1)) == [told]
    assert messages(text_on_path(lettering("ab  ", 10), path(f"M 0 0 H {places[1] + 1}"))) == []


def test_a_closed_curve_is_run_round_once():
    count = int(2 * pi * 10 / 4) + 4
    text = "o" * count
    room = sum(middle <= 2 * pi * 10 for middle in middles(text, 8))
    made = text_on_path(lettering(text, 8), circle(10), start=-13, flip=True)
    assert len(contours(made)) == 2 * min(room, count)
    assert bool(messages(made)) == (room < count)
    whole = text_on_path(lettering("oooo", 8), circle(10), start=2 * pi * 10 - 3)
    same(contours(whole), contours(text_on_path(lettering("oooo", 8), circle(10), start=-3)), 1e-7)


@pytest.mark.parametrize(
    ("operands", "words"),
    [
        ((circle(3), LINE), "first operand is a lettering"),
        ((lettering("a"), path("M 0 0 H 9 M 0 5 H 9")), "has 2 contours"),
        ((lettering("a"), path([("move", (0, 0, 0)), ("line", (0, 0, 9))])), "leaves the plane"),
        ((lettering("a"), path("M 3 3 L 3 3")), "is a point|is empty"),
        ((lettering("a").turned(x=30), LINE), "turn it about z only"),
    ],
)
def test_what_cannot_be_set_is_said(operands, words):
    with pytest.raises(Refusal, match=words):
        measure(extrude(text_on_path(*operands), 2))


# As an outline like any other


def test_both_placements_count():
    moved = text_on_path(lettering("Ho", 10).scaled(2), path("M 0 0 H 50").turned(z=90).at(5, 6))
    plain = contours(lettering("Ho", 20))
    same(contours(moved), [np.column_stack((5 - y, 6 + x)) for x, y in (points.T for points in plain)])


def test_it_extrudes_and_wraps_and_its_lettering_may_be_an_instance():
    made = text_on_path(lettering("AB8", 10), path("M 0 0 C 10 20 40 20 50 0"))
    solid, plain = measure(extrude(made, 3)), measure(extrude(lettering("AB8", 10), 3))
    assert solid.closed and solid.components == 3 and solid.genus == plain.genus == 5
    assert solid.volume == pytest.approx(plain.volume, rel=1e-4)
    assert measure(wrap(made, 20)).closed
    shared = document_of(text_on_path(instance("n9"), LINE)).with_(definitions=(lettering("AB").with_(id="n9"),))
    (root,) = resolve(shared).profiles
    assert is_outline(root) and len(contours(root)) == 2 + 3


def test_the_operation_keeps_the_curve_where_it_is():
    document = document_of(circle(RADIUS).at(4, 5, 6), lettering("Round").turned(x=90).at(9))
    after = OPERATIONS["set_text_on_path"](document, ["n1", "n2"], flip=True)
    (made,) = after.profiles
    assert [child.kind for child in made.children] == ["Lettering", "Circle"] and made.flip
    np.testing.assert_allclose(made.placement.matrix()[:, 3], (4, 5, 6))
    wanted = contours(text_on_path(lettering("Round"), circle(RADIUS), flip=True))
    same(contours(made.with_(placement=Placement())), wanted)
    path_made = OPERATIONS["convert_to_path"](after, made.id).profiles[0]
    assert path_made.kind == "Path"
    solid = OPERATIONS["make_solid"](after, "extrude", made.id, height=2)
    assert solid.solids[0].children[0].kind == "TextOnPath"


@pytest.mark.parametrize(
    ("nodes", "words"),
    [
        ((circle(2), rectangle(3, 4)), "neither of these is a lettering"),
        ((lettering("a"), lettering("b")), "not two letterings"),
        ((lettering("a"),), "takes two: a lettering and a curve, not 1"),
        ((lettering("a"), box()), "is no outline"),
    ],
)
def test_the_operation_says_what_it_takes(nodes, words):
    document = document_of(*nodes)
    with pytest.raises(Refusal, match=words):
        OPERATIONS["set_text_on_path"](document, [root.id for root in document.standing])


def test_a_solid_as_its_curve_is_refused():
    with pytest.raises(Refusal, match="takes outlines"):
        OPERATIONS["insert"](document_of(circle()), text_on_path(lettering("a"), sphere()))


# Whose faces they are


def axes_at(angle):
    """Away from a bar's axis, and round it, at an angle from the front."""
    return np.array((sin(angle), -cos(angle), 0.0)), np.array((cos(angle), sin(angle), 0.0))


def test_rays_at_the_walls_of_engraved_letters_name_the_letters():
    """40 letters, each a part of its own, in two rows round a bar: a ray that comes from inside a letter's cut at its
    wall hits what the letter made, and a ray at the bar beside it the bar."""
    radius, text = 20.0, "SOLIDTREELETTERSINROWSROUNDABARTWENTYAND"
    parts, spots = [], []
    for number, letter in enumerate(text):
        x, y = -57 + 6 * (number % 20), 6 + 10 * (number // 20)
        parts.append(wrap(lettering(letter, 6).at(x, y), radius=radius, height=1, below=1))
        spots.append(np.array((x, y)))
    (root,) = numbered([cylinder(radius=radius, height=30) - union(*parts)])
    evaluator = Evaluator()
    mesh = display_of(result_of(root, evaluator.evaluate(root, 0.02)), evaluator)
    picker = Picker()
    bar, cuts = root.children[0], root.children[1].children
    assert len(cuts) == len(text) == 40
    for cut, letter, spot in zip(cuts, text, spots, strict=True):
        drawn = path_of(lettering(letter, 6))
        sides = [segment[[0, -1]] for contour in drawn.contours for segment in contour.segments() if len(segment) == 2]
        curve = drawn.contours[0].segment(0)[:2]
        begin, end = max(sides, key=lambda side: np.ptp(side, axis=0).sum()) if sides else (
            curve[0], curve[0] + 1e-3 * (curve[1] - curve[0]))  # fmt: skip
        middle, side = (begin + end) / 2, end - begin
        inwards = np.array((side[1], -side[0])) / np.hypot(*side) * np.sign(-drawn.area())
        beside, within = (middle + spot + far * inwards for far in (-0.15, 0.15))
        out, _ = axes_at(beside[0] / radius)
        pick = picker.pick({"model": mesh}, 25 * out + (0, 0, beside[1]), -out)
        assert pick is not None and pick.path[-1] == bar.id, letter
        out, around = axes_at(within[0] / radius)
        towards = -(inwards[0] * around + inwards[1] * np.array((0.0, 0.0, 1.0)))
        pick = picker.pick({"model": mesh}, (radius - 0.5) * out + (0, 0, within[1]), towards)  # half way down
        assert pick is not None and pick.path[-1] == cut.id, letter
        assert pick.distance == pytest.approx(0.15, abs=0.05), letter
