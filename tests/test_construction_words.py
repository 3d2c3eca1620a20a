import numpy as np
import pytest

from solidtree.gui.curves.construction_words import interval, lerp, polynomial, polynomials, value
from solidtree.model.outline.construction import construct
from solidtree.model.spline.bspline import BSpline

PARABOLA = np.array([(-1.0, 1.0), (0.0, -1.0), (1.0, 1.0)])  # x = 2 t - 1, y = x²


@pytest.mark.parametrize(
    ("coefficients", "words"),
    [
        ([], "0"),
        ([0.0, 0.0], "0"),
        ([5.0], "5"),
        ([-1.0], "−1"),
        ([0.0, 1.0, -1.0], "−t² + t"),
        ([2.5, -3.0, 0.0, 1.0], "t³ − 3 t + 2.5"),
        ([1.0, 1e-15], "1"),
        ([0.0] * 12 + [2.0], "2 t¹²"),
    ],
)
def test_polynomials_are_written_as_people_write_them(coefficients, words):
    assert polynomial(coefficients, "t") == words


def test_each_axis_has_its_polynomial():
    assert polynomials(construct(PARABOLA, 0.5)) == "x(t) = 2 t − 1\ny(t) = 4 t² − 4 t + 1"


def test_where_the_point_is_and_where_it_goes():
    assert value(construct(PARABOLA, 1.0)) == "(1; 1) mm, tangent at 63.435°"
    assert value(construct(np.array([(0.0, 0.0, -2.0), (1.0, 0.0, 2.0)]), 0.25)) == "(0.25; 0; −1) mm"


def test_only_curves_without_weights_are_told_to_be_mixed_by_t_alone():
    rational = BSpline(PARABOLA, 2, np.array([0, 0, 0, 1, 1, 1.0]), np.array([1.0, 2.0, 1.0]))
    knotted = BSpline(PARABOLA[[0, 1, 2, 0]], 2, np.array([0, 0, 0, 2, 4, 4, 4.0]))
    assert "de Casteljau" in lerp(construct(PARABOLA, 0.5))
    assert "weight" in lerp(construct(rational, 0.5))
    assert "de Boor" in lerp(construct(knotted, 0.5))
    assert interval(construct(PARABOLA, 0.5)) == ""
    assert interval(construct(knotted, 0.75)) == "Parameter 3, in the knot interval 2 to 4; u = 0.5000 there"
    assert "/ w(t)" in polynomials(construct(rational, 0.5))
    assert polynomials(construct(knotted, 0.75)).startswith("x(u) = ")
