"""Outlines become paths and B-splines without leaving their place."""

import numpy as np
import pytest
from curve_session import LEAF, contour, curves, moved_by, one, refused, session

from solidtree.model.curve.bezier import evaluated as on_bezier
from solidtree.model.document.document import Parameter
from solidtree.model.document.nodes import Union
from solidtree.model.document.outlines import Bezier, BSpline, Circle, Path, Polygon, Rectangle
from solidtree.model.document.tree import find
from solidtree.model.operations.curves.deviations import deviation
from solidtree.model.outline.paths import path_of
from solidtree.model.path.path import Kind
from solidtree.model.scripting.outlines import path


@pytest.mark.parametrize(
    "node",
    [
        Rectangle(width=30, height=20, centred=True), Polygon(points=((0, 0), (9, 0), (4, 8))), Circle(segments=7),
        Bezier(points=((0, 0), (5, 9), (12, 1)), closed=True), Bezier(points=((0, 0), (5, 9), (12, 1), (20, 4))),
        BSpline(points=((0, 0), (5, 9), (12, 1), (20, 4), (30, 0))),
        BSpline(points=((0, 0), (5, 9), (12, 1), (20, 4), (30, 0)), degree=2, closed=True),
        BSpline(points=((0, 0, 0), (5, 9, 2), (12, 1, 8), (20, 4, 0))),
        Union(children=(Rectangle(), Rectangle().at(5, 5))),
    ],
    ids=lambda node: node.kind,
)  # fmt: skip
def test_as_a_path_an_outline_of_polynomials_stays_exactly(node):
    work = one(node.coloured("red").noted("mind").at(1, 2, 3))
    before = find(work.document, "n1")
    work.do("convert_to_path", "n1")
    after = find(work.document, "n1")
    assert isinstance(after, Path) and after.name == "Path" and not after.splines
    assert (after.colour, after.note, after.placement) == (before.colour, before.note, before.placement)
    assert deviation(before, after) < 1e-12
    assert [one.closed for one in curves(work).contours] == [one.closed for one in path_of(before).contours]


def test_a_circle_becomes_four_even_cubics_or_as_many_as_a_tolerance_asks_for():
    work = one(Circle(radius=10).named("Bore"))
    work.do("convert_to_path", "n1")
    off = np.abs(np.linalg.norm(on_bezier(np.array(contour(work).segments()), np.linspace(0, 1, 99)), axis=-1) - 10)
    assert len(contour(work)) == 4 and 2.7e-3 < off.max() < 2.8e-3
    assert find(work.document, "n1").joints == "yyyy" and find(work.document, "n1").name == "Bore"
    work.undo()
    work.do("convert_to_path", "n1", tolerance=1e-5)
    assert deviation(Circle(radius=10.0), find(work.document, "n1")) < 1e-5


def test_what_cubics_cannot_be_exactly_keeps_the_tolerance():
    arcs = Union(children=(Circle(radius=10), Circle(radius=10).at(8)))
    high = Bezier(points=tuple((float(i), float((i * 7) % 5)) for i in range(8)), weights=(1, 2, 1, 3, 1, 1, 2, 1))
    for node in (arcs, high):
        work = one(node)
        before = find(work.document, "n1")
        size = np.ptp(path_of(before).bounds(), axis=0).max()
        work.do("convert_to_path", "n1")
        assert set(contour(work).kinds.tolist()) == {Kind.CUBIC}
        assert 0.0 < moved_by(before, work) <= 1e-4 * size
        work.undo()
        work.do("convert_to_path", "n1", 1e-7)
        assert moved_by(before, work) <= 1e-7


def test_conversion_keeps_the_expressions_of_points_and_of_a_rectangle():
    corners = Polygon(points=((0, 0), ("w", 0), (3, "w")))
    work = session(
        corners.with_(id="n1", name="A"),
        Rectangle(id="n2", name="B", width="w", height=4, centred=True),
        parameters=(Parameter("w", 8.0),),
    )
    work.do("convert_to_path", ["n1", "n2"])
    work.do("set_parameter", "w", 20)
    assert curves(work).bounds().tolist() == [[0, 0], [20, 20]]
    assert curves(work, "n2").bounds().tolist() == [[-10, -2], [10, 2]]


@pytest.mark.parametrize(
    "node",
    [
        path(LEAF), path("M 0 0 C 8 -4 16 2 20 10 C 24 18 30 20 40 0"), path("M 0 0 L 5 5 Q 9 9 12 0"), Rectangle(),
        Circle(radius=7), Bezier(points=((0, 0), (5, 9), (12, 1), (3, 3), (8, 8))),
        Bezier(points=((0, 0), (5, 9), (12, 1), (3, 3)), weights=(1, 3, 1, 2), closed=True),
        Polygon(points=((0, 0), (9, 0), (4, 8))),
    ],
    ids=lambda node: node.kind,
)  # fmt: skip
def test_as_a_b_spline_an_outline_stays_exactly_and_closed(node):
    work = one(node)
    before = find(work.document, "n1")
    work.do("convert_to_bspline", "n1")
    after = find(work.document, "n1")
    assert isinstance(after, BSpline) and after.closed == path_of(before).contours[0].closed
    assert deviation(before, after) < 1e-12 * 40
    assert abs(path_of(after).area()) == pytest.approx(abs(path_of(before).area()), rel=1e-12, abs=1e-12)
    if after.closed:
        refused(work, "no solid", "make_solid", "nothing", "n1")
        work.do("make_solid", "extrude", "n1", height=2)  # its inside is still one


def test_several_contours_are_no_one_b_spline():
    refused(one(path("M0 0H1V1Z M5 0H6V1Z")), "2 contours", "convert_to_bspline", "n1")
