"""Stencils: no hole is left, and what is lost is the bridges alone."""

from math import asin, pi, sqrt

import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.outline.paths import path_of
from solidtree.model.path.areas.islands import islands
from solidtree.model.script import box, circle, document_of, extrude, lettering, measure, path, rectangle, stencil
from solidtree.model.solid.information import information

COUNTERS = "ABDOPQR0468&@"
FRAME = rectangle(20, 30, centred=True) - rectangle(10, 14, centred=True)


def area(node, tolerance=0.01):
    return measure(extrude(node, 1), tolerance).volume


def under_arc(radius, half):
    """Of a circle, what lies above y = 0 between x = -half and half."""
    return half * sqrt(radius**2 - half**2) + radius**2 * asin(half / radius)


@pytest.mark.parametrize("bridges", [1, 2])
@pytest.mark.parametrize("angle", [90, 0, 37])
@pytest.mark.parametrize("text", [*COUNTERS, COUNTERS, "©®%ÅB8"])
def test_no_counter_is_left(text, angle, bridges):
    plain = lettering(text, 12)
    solid = measure(extrude(stencil(plain, 0.6, angle, bridges), 1))
    assert measure(extrude(plain, 1)).genus > 0 and solid.genus == 0 and solid.closed


@pytest.mark.parametrize(
    ("fields", "lost"),
    [
        ({}, 2 * 8),  # up or down through 8 mm
        ({"bridges": 2}, 2 * 2 * 8),
        ({"angle": 0}, 2 * 5),
        ({"angle": 180, "bridges": 2}, 2 * 2 * 5),
        ({"width": 3}, 3 * 8),
    ],
)
def test_a_frame_loses_its_bridges_alone(fields, lost):
    assert area(FRAME) - area(stencil(FRAME, **{"width": 2, **fields})) == pytest.approx(lost, rel=1e-6)


def test_a_bridge_goes_through_the_thinner_wall():
    uneven = rectangle(20, 20) - rectangle(10, 10).at(5, 3)
    assert area(uneven) - area(stencil(uneven, 2)) == pytest.approx(2 * 3, rel=1e-6)
    assert area(uneven) - area(stencil(uneven, 2, bridges=2)) == pytest.approx(2 * (3 + 7), rel=1e-6)


def test_a_ring_loses_what_a_bar_cuts_of_it():
    ring = circle(10) - circle(6)
    lost = under_arc(10, 1) - under_arc(6, 1)
    errors = []
    for tolerance in (0.1, 0.01, 0.001):
        errors.append(abs(100 * pi - 36 * pi - lost - area(stencil(ring, 2), tolerance)))
    assert errors == sorted(errors, reverse=True) and errors[-1] < 0.03
    document = document_of(stencil(ring, 2))
    (row,) = information(document, 0.01)[0]["profiles"]
    assert row["area"] == pytest.approx(64 * pi - lost, abs=1e-6) and row["contours"] == 1


def test_counters_side_by_side_are_not_joined_to_each_other_alone():
    """The wall between the two holes is thinner than those to the outside."""
    hole = rectangle(8, 10, centred=True)
    eight = rectangle(20, 41, centred=True) - hole.at(0, 6) - hole.at(0, -6)
    assert area(eight) - area(stencil(eight, 1)) == pytest.approx(9.5 + 2, rel=1e-6)
    assert measure(extrude(stencil(eight, 1), 1)).genus == 0


def test_what_lies_inside_a_hole_stays_whole():
    target = (circle(10) - circle(8)) + (circle(4) - circle(2))
    solid = measure(extrude(stencil(target, 1), 1), 0.01)
    assert solid.genus == 0 and solid.components == 2


def test_bridges_are_cut_of_curves_too():
    curves = path_of(stencil(lettering("8", 12), 0.8))
    assert len(islands(curves)) == 1 and len(curves.contours) == 1
    assert {int(kind) for kind in curves.contours[0].kinds} >= {1, 2}  # its curves are still quadratics


def test_an_outline_without_holes_stays_as_it_is():
    assert area(stencil(lettering("HIT", 12))) == pytest.approx(area(lettering("HIT", 12)), rel=1e-12)


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (stencil(FRAME, bridges=3), "1 bridge or 2, not 3"),
        (stencil(FRAME, 0), "width must be above 0"),
        (stencil(path("M 0 0 H 9 V 9")), "open"),
        (stencil(box()), "a solid stands where an outline is needed"),
    ],
)
def test_what_cannot_be_a_stencil_is_said(made, words):
    with pytest.raises(Refusal, match=words):
        measure(extrude(made, 1))


def test_the_operation_makes_one_of_each_in_its_place():
    document = document_of(lettering("O", 12).at(1, 2, 3), FRAME)
    after = OPERATIONS["make_stencils"](document, ["n1", document.profiles[1].id], width=2)
    assert [(node.kind, node.width) for node in after.profiles] == [("Stencil", 2.0)] * 2
    assert after.profiles[0].placement.matrix()[:, 3].tolist() == [1, 2, 3]
    with pytest.raises(Refusal, match="is no outline"):
        OPERATIONS["make_stencils"](document_of(box()), ["n1"])
