"""Picked elements and what is measured on one or two of them, by formula."""

import math

import numpy as np
import pytest

from solidtree.model.document.nodes import Node
from solidtree.model.measuring.elements import Element, edge_element, face_element, point_element, short, written
from solidtree.model.measuring.figure import Figure, parameter_name, vector
from solidtree.model.measuring.measurement import measurement
from solidtree.model.script import box, cylinder, document_of, polyhedron, sphere
from solidtree.model.solid.results import evaluate_document
from solidtree.render.pick import Picker


class Solid:
    """A solid as the window shows it, with a pointer."""

    def __init__(self, solid: Node) -> None:
        evaluation = evaluate_document(document_of(part=solid))
        self.root = evaluation.solids[0].root
        self.mesh = evaluation.display(evaluation.solids[0])

    def face(self, eye, point) -> Element:
        """The face that is seen from `eye` towards a point."""
        pick = Picker().pick({"part": self.mesh}, eye, np.subtract(point, eye))
        assert pick is not None
        return face_element(self.root, self.mesh, pick.triangle, pick.point)

    def edge(self, point) -> Element:
        return edge_element(self.root, self.mesh, point)


def values(figures: tuple[Figure, ...], name: str) -> tuple[float, ...]:
    return next(figure.values for figure in figures if figure.name == name)


PLATE = Solid(box(40, 30, 12.3) - cylinder(4.3, 40, centred=True).at(10, 10) - cylinder(3, 40, centred=True).at(30, 18))


def test_a_flat_face_tells_area_normal_and_wall():
    face = PLATE.face((20, 5, 50), (20, 5, 0))
    assert face.words == "Face" and face.normal == pytest.approx((0, 0, 1))
    assert values(face.figures, "Area")[0] == pytest.approx(1200 - math.pi * (4.3**2 + 9), rel=2e-3)
    assert values(face.figures, "Wall")[0] == pytest.approx(12.3, rel=1e-6)
    assert face.line is not None and face.line.text == "12.3 mm"
    assert len(face.outline) > 4 and np.allclose(face.outline[..., 2], 12.3)


def test_a_hole_has_its_typed_radius_and_axis():
    hole = PLATE.face((10, 5, 20), (10, 14.3, 8))
    assert hole.words == "Round hole" and values(hole.figures, "Radius") == (4.3,)
    assert values(hole.figures, "Diameter") == (8.6,)
    assert hole.axis is not None and hole.axis.point[:2] == (10, 10)
    start, end = np.array(hole.line.start), np.array(hole.line.end)
    assert np.linalg.norm(end - start) == pytest.approx(4.3) and hole.line.text == "R 4.3"
    assert np.ptp(hole.outline[..., 2]) == pytest.approx(12.3, rel=1e-6)


def test_edges_are_whole_and_what_was_typed_comes_back():
    edge = PLATE.edge((40, 12, 12.3))
    assert edge.words == "Edge" and values(edge.figures, "Length") == (30,)
    assert sorted(map(tuple, edge.thing)) == [(40, 0, 12.3), (40, 30, 12.3)]
    rim = PLATE.edge((14.3, 10, 12.3))
    assert rim.words == "Circle" and values(rim.figures, "Radius") == (4.3,)
    assert values(rim.figures, "Centre") == pytest.approx((10, 10, 12.3), abs=1e-6)
    assert values(rim.figures, "Length")[0] == pytest.approx(2 * math.pi * 4.3)
    arc = Solid(cylinder(5, 10) - box(20).at(0, -10, -1)).edge((-5, 0, 10))
    assert arc.words == "Arc" and values(arc.figures, "Length")[0] == pytest.approx(math.pi * 5, rel=1e-6)


def test_two_holes():
    found = measurement(PLATE.edge((14.3, 10, 12.3)), PLATE.edge((33, 18, 12.3)))
    apart = math.hypot(20, 8)
    assert values(found.figures, "Distance")[0] == pytest.approx(apart - 7.3, abs=1e-5)
    assert values(found.figures, "Centres")[0] == pytest.approx(apart)
    assert values(found.figures, "Centres Δ") == pytest.approx((20, 8, 0), abs=1e-6)
    assert found.line.text == "21.5407 mm" and found.legs and len(found.outline) > 30
    walls = measurement(PLATE.face((10, 5, 20), (10, 14.3, 8)), PLATE.face((30, 15.5, 20), (30, 21, 8)))
    assert values(walls.figures, "Axes")[0] == pytest.approx(apart) and values(walls.figures, "Angle") == (0,)


def test_points_planes_and_angles():
    corners = measurement(point_element((0, 0, 0)), point_element((3, 4, 12)))
    assert values(corners.figures, "Distance") == (13,) and values(corners.figures, "Δ") == (3, 4, 12)
    top, bottom = PLATE.face((20, 5, 50), (20, 5, 0)), PLATE.face((20, 5, -50), (20, 5, 0))
    assert values(measurement(top, bottom).figures, "Between planes")[0] == pytest.approx(12.3)
    front = PLATE.face((20, -50, 5), (20, 0, 5))
    assert values(measurement(top, front).figures, "Angle")[0] == pytest.approx(90)
    upright = PLATE.edge((0, 0, 5))
    assert values(measurement(upright, top).figures, "Angle")[0] == pytest.approx(90)
    assert values(measurement(upright, front).figures, "Angle")[0] == pytest.approx(0, abs=1e-9)
    axis = measurement(PLATE.face((10, 5, 20), (10, 14.3, 8)), upright)
    assert values(axis.figures, "From the axis")[0] == pytest.approx(math.hypot(10, 10))


def test_edges_that_meet_have_the_angle_of_their_corner():
    wedge = Solid(
        polyhedron(
            [(0, 0, 0), (10, 0, 0), (-10, 10, 0), (0, 0, 5), (10, 0, 5), (-10, 10, 5)],
            [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
        )
    )
    found = measurement(wedge.edge((5, 0, 5)), wedge.edge((-5, 5, 5)))
    assert values(found.figures, "Angle")[0] == pytest.approx(135) and found.line is None
    crossing = measurement(wedge.edge((5, 0, 5)), wedge.edge((-5, 5, 0)))
    assert values(crossing.figures, "Angle")[0] == pytest.approx(45)


def test_a_ball_and_its_centre():
    ball = Solid(sphere(8).at(20, 15, 20)).face((20, 15, 90), (20.3, 15.2, 0))
    assert ball.words == "Sphere" and values(ball.figures, "Radius") == (8,)
    assert values(ball.figures, "Centre") == (20, 15, 20)
    assert math.dist(ball.line.start, ball.line.end) == pytest.approx(8)


def test_single_precision_is_read_as_the_decimals_that_were_typed():
    typed = np.array([[6.3, -0.1, 1e-7], [123456.7, 0, 1 / 3]])
    back = written(typed.astype(np.float32))
    assert (back[0] == typed[0]).all() and back[1, 0] == 123456.7 and back[1, 2] == pytest.approx(1 / 3, rel=1e-7)


def test_figures_are_copied_whole_and_shown_short():
    assert Figure("Volume", (4188.790204786391,), "mm³").text(0) == "4188.79020478639"
    assert vector("Centre", (1, -0.0, 2.5)).line() == "Centre\t1\t0\t2.5\tmm"
    assert [short(value) for value in (4188.790204, 0.1 + 0.2, 1234567.8, -0.0, 12.0, 1e-7)] == [
        "4188.79", "0.3", "1234568", "0", "12", "1e-07",
    ]  # fmt: skip


def test_names_of_parameters_are_free_and_proper():
    assert parameter_name("Sphere Volume", ()) == "sphere_volume"
    assert parameter_name("Sphere Volume", ("sphere_volume",)) == "sphere_volume_2"
    assert parameter_name("3 holes: Δ x", ()) == "m_3_holes_d_x" and parameter_name("sin", ()) == "sin_2"
    assert parameter_name("\u2013", ()) == "measure"
