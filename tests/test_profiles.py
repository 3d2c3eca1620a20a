"""Outlines that stand by themselves, in figures: formulas, winding rules, and what is wrong with which node."""

import math
import random

import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.outlines import Bezier, BSpline, Path, Polygon
from solidtree.model.project.project_file import open_project, save_project
from solidtree.model.script import (
    bezier,
    box,
    bspline,
    circle,
    document_of,
    evaluate,
    extrude,
    linear_array,
    measure,
    path,
    polygon,
    rectangle,
    revolve,
    union,
)
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.information import information
from solidtree.model.solid.outlines.profiles import figures_of, profile_of

SQUARE = "M0 0H10V10H0Z "


def row(outline):
    (found,) = information(document_of(outline), 0.05)[0]["profiles"]
    return found


@pytest.mark.parametrize(
    ("outline", "area", "length"),
    [
        (circle(10), 100 * math.pi, 20 * math.pi),
        (circle(10).turned(x=90).at(1, 2, 3), 100 * math.pi, 20 * math.pi),
        (rectangle(3, 4).turned(z=30).scaled(2), 48, 28),
        # a parabola's arch: two thirds of its control triangle
        (bezier([(0, 0), (5, 10), (10, 0)], closed=True), 100 / 3, 10 + 10 * (math.sqrt(5) + math.asinh(2) / 2) / 2),
        (path(SQUARE + "M2 2V8H8V2Z"), 64, 64),
        (path(SQUARE + "M2 2H8V8H2Z"), 100, 64),
        (path(SQUARE + "M2 2H8V8H2Z", even_odd=True), 64, 64),
        (path(SQUARE + "M5 5H15V15H5Z"), 175, 80),
        (path(SQUARE + "M5 5H15V15H5Z", even_odd=True), 150, 80),
        (path("M0 0L10 10V0L0 10Z"), 50, 20 + 2 * math.hypot(10, 10)),
        (path(SQUARE + "M20 0V10H30V0Z"), 200, 80),
        (circle(10) - circle(4), 84 * math.pi, 28 * math.pi),
    ],
)
def test_area_and_length_are_those_of_the_formula(outline, area, length):
    found = row(outline)
    assert found["area"] == pytest.approx(area, rel=1e-9) and found["length"] == pytest.approx(length, rel=1e-9)


def test_bounds_lie_in_the_plane_placed_where_it_is_the_ground():
    assert row(rectangle(3, 4).at(5, 6))["bounds"] == [[5, 6], [8, 10]]
    assert row(rectangle(3, 4).at(5, 6, 7))["bounds"] == [[0, 0], [3, 4]]
    assert row(path([("move", (0, 0, 1)), ("line", (3, 4, 1))]))["bounds"] == [[0, 0, 1], [3, 4, 1]]
    arch = row(bezier([(0, 0), (5, 10), (10, 0)]))
    assert arch["bounds"] == [[0, 0], [10, pytest.approx(5)]] and arch["contours"] == 1


def test_what_has_no_inside_has_no_area():
    assert row(path("M0 0H9"))["area"] is None and row(path("M0 0H9"))["length"] == 9
    assert row(path([("move", (0, 0, 1)), ("line", (3, 4, 1)), ("line", (3, 4, 5)), ("close",)]))["area"] is None


def test_a_document_of_outlines_alone_is_in_order():
    assert information(document_of(circle(1)), 0.05)[1]
    assert not information(document_of(bspline()), 0.05)[1]
    assert information(document_of(bspline().hidden(), box(1)), 0.05)[1]
    assert not information(document_of(), 0.05)[1]


WRONG = (
    (BSpline(points=((0, 0), (1, 1))), "degree 3 needs 4 or more control points; there are 2"),
    (BSpline(points=((0, 0),) * 4, knots=(0, 0, 1)), "knots"),
    (BSpline(points=((0, 0), (1, 0), (1, 1), (0, 1)), degree=2.5), "whole number"),
    (BSpline(points=((0, 0), (1, 0), (1, 1), (0, 1)), weights=(1, 2)), "as many weights"),
    (Bezier(points=((0, 0), (1, 1)), weights=(1, -1)), "weights are above 0"),
    (Bezier(points=()), "two or more control points"),
    (Path(points=((0, 0),), segments="L"), "begin with M"),
    (Path(points=((0, 0), (1, 1)), segments="MX"), "no segment"),
    (Path(points=((0, 0), (1, 1)), segments="MC"), "points"),
    (Path(points=((0, 0), (1, 1)), segments="ML", joints="ccc"), "letters"),
    (Path(points=((0, 0), (1, 1), (2, 2)), segments="MS"), "fewer B-splines"),
    (Polygon(points=((0, 0), (1, 1), (1, 0)), loops=((0, 1, 7),)), "loop 0"),
    (Bezier(points=((0, 0), (1e300, 1))), "too far"),
)  # fmt: skip


@pytest.mark.parametrize(("outline", "words"), WRONG)
def test_what_makes_no_curve_is_told_on_its_row_and_kept_in_the_file(outline, words, tmp_path):
    alone, inside = document_of(outline.named("bad")), document_of(extrude(union(circle(1), outline.named("bad"))))
    save_project(document_of(outline), tmp_path / "bad.solidtree")
    assert open_project(tmp_path / "bad.solidtree").profiles == (outline,)
    for document in (alone, inside) if "too far" not in words else (alone,):
        (message,) = evaluate(document).messages
        assert words in message.message and message.name == "bad" and message.error


def test_no_number_that_is_none_is_taken():
    for make in (lambda n: bezier([(0, n)]), lambda n: bspline([(0, 0)], knots=[n]), lambda n: Path(points=((n, n),))):
        for number in (math.nan, math.inf):
            with pytest.raises(Refusal, match="finite"):
                make(number)


def test_outlines_of_any_letters_and_numbers_have_a_path_or_a_fault():
    draw = random.Random(5)

    def points():
        width = draw.choice([2, 2, 3])
        return tuple(tuple(draw.choice([0, 1, 2, 5, -3]) for _ in range(width)) for _ in range(draw.randrange(8)))

    def numbers():
        return tuple(sorted(draw.choice([0, 1, 1, 2, 3, 0.5]) for _ in range(draw.choice([0, 0, 3, 4, 6, 7]))))

    outcomes = set()
    for _ in range(1500):
        letters = "M" + "".join(draw.choice("LQCSM") for _ in range(draw.randrange(4))) + draw.choice("lqcsLCMX")
        splines = tuple((draw.randrange(4), numbers(), numbers()) for _ in range(draw.randrange(2)))
        outline = draw.choice([
            lambda: Path(points=points(), segments=letters, splines=splines,  # noqa: B023
                         joints=draw.choice(["", "cs", "ysa", "cccc"])),
            lambda: BSpline(points=points(), degree=draw.randrange(1, 5), knots=numbers(), weights=numbers(),
                            closed=draw.random() < 0.5),
            lambda: Bezier(points=points(), weights=numbers(), closed=draw.random() < 0.5),
        ])()  # fmt: skip
        found, problems = profile_of(outline)
        outcomes.add((type(outline), found is None))
        assert (found is None) == bool(problems)
        if found is not None:
            assert figures_of(found).length >= 0
    assert len(outcomes) == 6


ARCH = bezier([(5, 0), (15, 0), (15, 10), (5, 10)], closed=True)


def problem(solid):
    return " ".join(problem.message for problem in Evaluator().evaluate(solid, 0.05).problems)


def test_the_tolerance_of_a_solid_is_that_of_its_outline_too():
    area, middle = 60.0, 5.0 + 45 / 14  # Green; the middle of the arch, for Pappus
    before = math.inf
    for tolerance in (0.5, 0.1, 0.01, 0.001):
        drawn = abs(measure(extrude(ARCH, 3, tolerance=tolerance)).volume / (3 * area) - 1)
        turned = abs(measure(revolve(ARCH, tolerance=tolerance)).volume / (2 * math.pi * middle * area) - 1)
        assert drawn < tolerance / 5 and turned < tolerance / 2 and drawn + turned < before
        before = drawn + turned


@pytest.mark.parametrize(
    "outline",
    [
        polygon([(0, 0), (5e10, 0), (0, 5e10)]),
        rectangle(1e12, 1),
        circle(3e10),
        circle(5).at(1e11) + circle(5),
        linear_array(circle(5), count=2, step=(1e12, 0, 0)),
    ],
)
def test_an_outline_too_far_away_for_polygons_is_told_in_words(outline):
    assert "farther than 1e+10 mm" in problem(extrude(outline, 5))
    information(document_of(outline), 0.05)


def test_what_would_fill_the_memory_is_refused_before_it_is_made():
    fine = circle(1e5, segments=4096).at(2e5)
    assert "points; take a coarser tolerance" in problem(revolve(fine))
    assert "points; take a coarser tolerance" in problem(extrude(fine, 5, twist=90))
    assert "makes 585,225 points" in problem(extrude(bezier(ARCH.points, weights=[1, 1e-9, 1, 1], closed=True), 5))


def test_what_encloses_nothing_is_not_said_to_lie_left_of_the_axis():
    assert problem(revolve(path("M 5 5 L 15 5 Z"))) == "Revolution: the outline encloses nothing"
    assert "lies at x < 0" in problem(revolve(circle(4).at(-10)))
