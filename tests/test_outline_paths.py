"""Outline nodes as paths: what fills what, and that a path and its node say the same."""

from math import pi, sqrt

import numpy as np
import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Instance
from solidtree.model.document.outlines import Path, is_outline
from solidtree.model.document.table import from_table, to_table
from solidtree.model.outline.paths import fields_of, path_of
from solidtree.model.path.path import Kind
from solidtree.model.script import bezier, box, bspline, circle, extrude, measure, path, polygon, rectangle
from solidtree.model.solid.outlines.sections import section_of

SQUARE = [("move", (0, 0)), ("line", (4, 0)), ("line", (4, 4)), ("line", (0, 4)), ("close",)]


def test_a_rectangle_a_circle_and_a_polygon_have_the_areas_of_their_formulas():
    assert path_of(rectangle(3, 4)).area() == pytest.approx(12, rel=1e-14)
    assert path_of(circle(5)).area() == pytest.approx(25 * pi, rel=1e-13)
    assert path_of(circle(5)).length() == pytest.approx(10 * pi, rel=1e-12)
    assert path_of(circle(5, segments=6)).area() == pytest.approx(75 * sqrt(3) / 2, rel=1e-13)
    assert path_of(polygon([(0, 0), (4, 0), (0, 3)])).area() == pytest.approx(6, rel=1e-14)


def test_a_placement_moves_the_path_in_its_plane_and_lifts_it_out_of_it():
    flat = path_of(rectangle(3, 4).turned(z=90).at(10, 0))
    np.testing.assert_allclose(flat.bounds(), [[6, 0], [10, 3]], atol=1e-12)
    upright = path_of(rectangle(3, 4).turned(x=90))
    np.testing.assert_allclose(upright.bounds(), [[0, 0, 0], [3, 0, 4]], atol=1e-12)


def test_a_bezier_curve_keeps_its_kind_up_to_degree_three_and_is_one_spline_above():
    points = [(0, 0), (1, 4), (3, 4), (4, 0), (9, 9)]
    kinds = [path_of(bezier(points[:count])).contours[0].kinds.tolist() for count in (2, 3, 4, 5)]
    assert kinds == [[Kind.LINE], [Kind.QUADRATIC], [Kind.CUBIC], [Kind.SPLINE]]


def test_a_rational_quadratic_is_a_quarter_of_a_circle():
    quarter = path_of(bezier([(1, 0), (1, 1), (0, 1)], weights=[1, sqrt(0.5), 1]))
    assert quarter.length() == pytest.approx(pi / 2, rel=1e-12)


def test_a_closed_bspline_runs_round_without_a_corner_and_an_open_one_ends_at_its_control_points():
    corners = [(0, 0), (10, 0), (10, 10), (0, 10)]
    (ring,) = path_of(bspline(corners, closed=True)).contours
    assert ring.closed and ring.splines[0].periodic
    (line,) = path_of(bspline(corners)).contours
    np.testing.assert_array_equal(line.points[[0, -1]], [(0, 0), (0, 10)])


@pytest.mark.parametrize(
    "node",
    [
        path(SQUARE),
        path([("move", (0, 0)), ("quad", (2, 3), (4, 0)), ("cubic", (5, 1), (6, -1), (7, 0)), ("close",)]),
        path([("move", (0, 0)), ("cubic", (0, 5), (9, 5), (0, 0)), ("close",), ("move", (1, 1)), ("line", (2, 2))]),
        path([("move", (0, 0, 0)), ("line", (1, 2, 3)), ("cubic", (2, 2, 2), (3, 3, 3), (9, 8, 7))]),
        path(SQUARE, joints="csya", even_odd=True),
    ],
    ids=["square", "mixed", "two contours", "in space", "kinds of nodes"],
)
def test_the_fields_of_a_path_make_the_same_node_again(node: Path):
    assert Path(**fields_of(path_of(node))) == node


def test_a_path_with_a_bspline_among_its_segments_is_made_again_from_its_fields_and_from_a_file():
    made = Path(
        points=((0, 0), (0, 0), (5, 9), (9, 9), (12, 0), (6, -3)),
        segments="MSl",
        splines=((2, (0, 0, 0, 0.5, 1, 1, 1), (1, 2, 1, 1)),),
    )
    with pytest.raises(Refusal, match="6 points are more than the 5"):
        path_of(made)
    made = made.with_(points=made.points[:-1])
    again = Path(**fields_of(path_of(made)))
    assert again == made
    stored = from_table(to_table(Document(profiles=(made,)))).profiles[0]
    assert stored == made and path_of(stored).length() == path_of(made).length()


def test_text_of_svg_paths_and_commands_say_the_same():
    assert path("M 0 0 L 4 0 4 4 0 4 Z") == path(SQUARE)
    assert path_of(path("M0 0h4v4h-4z m1 1 h2 v2 h-2 z", even_odd=True)).rule == "evenodd"


def test_numbers_of_a_path_may_be_expressions():
    from solidtree.model.document.resolve import resolve
    from solidtree.model.script import document_of, parameter

    width = parameter("width", 6)
    document = document_of(part=extrude(path([("move", (0, 0)), ("line", (width, 0)), ("line", (0, 2)), ("close",)])))
    (part,) = resolve(document).solids
    assert path_of(part.children[0]).area() == pytest.approx(6)


@pytest.mark.parametrize(
    "node, words",
    [
        (Path(points=((0, 0), (1, 1)), segments="LL"), "begin with M"),
        (Path(points=((0, 0), (1, 1)), segments="MX"), "“X” is no segment"),
        (Path(points=((0, 0), (1, 1)), segments="MC"), "take 4 points or more; there are 2"),
        (Path(points=((0, 0), (1, 1), (2, 0)), segments="MlL"), "closes a contour and stands last"),
        (Path(points=((0, 0), (1, 1)), segments="ML", joints="c"), "too few"),
        (Path(points=((0, 0), (1, 1)), segments="ML", joints="cx"), "“x” is no kind"),
        (Path(points=((0, 0), (1, 1)), segments="MS"), "fewer B-splines"),
        (bezier([(0, 0)]), "two or more"),
        (bezier([(0, 0), (1, 1)], weights=[1]), "as many weights"),
        (bspline([(0, 0), (1, 1)]), "degree 3 needs 4"),
        (bspline([(0, 0), (1, 1), (2, 2), (3, 3)], knots=[0, 1]), "B-spline: "),
        (bspline([(0, 0), (1, 1), (2, 2), (3, 3)], knots=[0, 1], closed=True), "5 knots, those of one turn"),
        (bspline([(0, 0), (1, 1), (2, 2), (3, 3)], weights=[1, 1, 0, 1]), "weights are above 0"),
        (box(3), "a solid stands where an outline is needed"),
    ],
)
def test_what_makes_no_curve_is_told_in_words(node, words: str):
    with pytest.raises(Refusal, match=words):
        path_of(node)


def test_an_open_curve_has_no_inside_and_says_where_it_ends():
    with pytest.raises(Refusal, match=r"open, it ends at \(4, 4\)"):
        measure(extrude(path([("move", (0, 0)), ("line", (4, 0)), ("line", (4, 4))])))


def test_the_winding_rule_decides_whether_a_contour_within_another_is_a_hole():
    twice = "M0 0h4v4h-4z M1 1h2v2h-2z"
    assert measure(extrude(path(twice), 1)).volume == pytest.approx(16)
    assert measure(extrude(path(twice, even_odd=True), 1)).volume == pytest.approx(12)
    assert measure(extrude(path("M0 0h4v4h-4z M1 1v2h2v-2z"), 1)).volume == pytest.approx(12)


def test_operations_on_outlines_are_outlines_and_fill_what_they_say():
    ring = circle(10, segments=64) - circle(5, segments=64)
    assert is_outline(ring) and not is_outline(extrude(ring))
    share = 32 * np.sin(2 * pi / 64)
    assert section_of(ring, 0.01).area() == pytest.approx(75 * share, rel=1e-9)
    row = (rectangle(2, 2) + rectangle(2, 2).at(1)).named("row")
    assert section_of(row, 0.01).area() == pytest.approx(6)


def test_an_instance_is_an_outline_when_what_it_stands_for_is_one():
    flat, solid = rectangle(), box()
    assert is_outline(Instance(definition=flat.id), [flat, solid])
    assert not is_outline(Instance(definition=solid.id), [flat, solid])
    assert not is_outline(Instance(definition="nowhere"), [flat, solid])


def test_outlines_nested_hundreds_deep_fill_their_area_still():
    deep = rectangle(1, 1)
    for _ in range(600):
        deep = (deep.with_(id=deep.id) + rectangle(1, 1).at(0.5)).named("level")
    assert section_of(deep, 0.01).area() == pytest.approx(1.5)
