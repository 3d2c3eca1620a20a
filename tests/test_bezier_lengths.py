"""Arc lengths and areas against mpmath's figures, formulas and scipy's quadrature."""

import json
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from solidtree.model.curve.bezier import derivatives, evaluated, extracted
from solidtree.model.curve.degree import elevated
from solidtree.model.curve.lengths import area, length, parameters_at

QUARTER = np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
QUARTER_WEIGHTS = np.array([1.0, np.sqrt(0.5), 1.0])
TURNING_BACK = "quadbez_arclen_pathological"


def cubic(seed: int, axes: int = 2) -> np.ndarray:
    return np.random.default_rng(seed).random((4, axes))


def test_lengths_and_areas_of_the_corpus(corpus):
    curves = json.loads((corpus / "curves/bezier_dhermes.json").read_text())["curves"]
    kurbo = json.loads((corpus / "curves/bezier_kurbo.json").read_text())["cases"]
    cases = [(case["points"], case["arc_length"], case["signed_area_to_origin"]) for case in curves.values()]
    # The length of the line that turns back is by its formula: the file's quadrature has nine digits of it.
    for case in kurbo:
        there_and_back = 2.0 * case["mp_bbox"][2] if case["test"] == TURNING_BACK else case["mp_arc_length"]
        cases.append((case["points"], there_and_back, case["mp_signed_area_to_origin"]))
    assert len(cases) == 34 + 11
    for points, expected, signed in cases:
        controls = np.array(points)
        assert length(controls) == pytest.approx(expected, rel=1e-13)
        assert abs(area(controls) - signed) <= 1e-15 * np.abs(controls).max() ** 2


def test_the_length_of_a_parabola_by_formula():
    assert length([[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]) == pytest.approx(
        0.5 * np.sqrt(5.0) + 0.25 * np.arcsinh(2.0), rel=1e-15
    )


@pytest.mark.parametrize("gap", [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3])
def test_a_line_that_turns_back_and_a_parabola_that_nearly_does(gap):
    # x = (2 t - 1)^2, y = gap t: with u = x', the length is the integral of sqrt(u^2 + gap^2) du / 8, from -4 to 4.
    controls = np.array([[1.0, 0.0], [-1.0, 0.5 * gap], [1.0, gap]])
    root = np.sqrt(16.0 + gap * gap)
    exact = (4.0 * root + (gap * gap * np.arcsinh(4.0 / gap) if gap else 0.0)) / 8.0
    assert length(controls) == pytest.approx(exact, rel=1e-13)


def test_a_semicubical_cusp_by_formula():
    # (t^2, t^3) between -1 and 1: 2 (13 sqrt(13) - 8) / 27, with the cusp in the middle.
    half = np.array([[0.0, 0.0], [0.0, 0.0], [1.0 / 3.0, 0.0], [1.0, 1.0]])
    whole = extracted(half, -1.0, 1.0)
    assert length(whole) == pytest.approx(2.0 * (13.0 * np.sqrt(13.0) - 8.0) / 27.0, rel=1e-13)
    assert length(half) == pytest.approx((13.0 * np.sqrt(13.0) - 8.0) / 27.0, rel=1e-13)


@pytest.mark.parametrize("open_", [1e-12, 1e-8, 1e-5, 1e-3])
def test_near_a_cusp_the_length_is_scipys_of_the_parts(open_):
    controls = np.array([[0.0, 0.0], [1.0 + open_, 1.0], [-open_, 1.0], [1.0, 0.0]])

    def speed(t: float) -> float:
        return float(np.linalg.norm(derivatives(controls, t, 1)[1]))

    cuts = [0.5, *(0.5 + sign * 10.0**power for power in range(-9, 0) for sign in (-1, 1)), 0.0, 1.0]
    cuts = np.unique(cuts)
    parts = [quad(speed, low, high, epsabs=1e-16, epsrel=1e-13)[0] for low, high in pairwise(cuts)]
    assert length(controls) == pytest.approx(sum(parts), rel=1e-13)


def test_many_curves_have_each_their_length_and_a_point_has_none():
    controls = np.stack([cubic(seed, 3) for seed in range(6)]).reshape(2, 3, 4, 3)
    controls[1, 2] = 7.0
    found = length(controls)
    assert found.shape == (2, 3)
    assert found[1, 2] == 0.0
    assert np.allclose(found[0], [length(c) for c in controls[0]], rtol=1e-14)
    assert np.allclose(length(elevated(controls, 3)), found, rtol=1e-13)


def test_lengths_of_parts_add_up_and_run_backwards():
    controls = cubic(3, 3)
    assert length(controls, 0.0, 0.3) + length(controls, 0.3, 1.0) == pytest.approx(length(controls), rel=1e-14)
    assert length(controls, 0.8, 0.3) == -length(controls, 0.3, 0.8)
    assert length(controls, 0.2, 0.7) == pytest.approx(length(extracted(controls, 0.2, 0.7)), rel=1e-13)
    assert length(controls, 0.4, 0.4) == 0.0


def test_arcs_of_the_circle():
    assert length(QUARTER, weights=QUARTER_WEIGHTS) == pytest.approx(np.pi / 2.0, rel=1e-14)
    assert area(QUARTER, QUARTER_WEIGHTS) == pytest.approx(np.pi / 4.0, rel=1e-14)
    many = length(np.stack([QUARTER, 3.0 * QUARTER]), weights=QUARTER_WEIGHTS)
    assert np.allclose(many, [np.pi / 2.0, 1.5 * np.pi], rtol=1e-14)


def test_the_parameter_at_a_length_gives_the_length_again():
    for seed in range(8):
        controls = cubic(seed)
        whole = length(controls)
        wanted = np.linspace(0.0, 1.0, 12).reshape(3, 4) * whole
        t = parameters_at(controls, wanted)
        assert t.shape == (3, 4)
        assert t[0, 0] == 0.0
        assert t[-1, -1] == 1.0
        for at, size in zip(t.ravel(), wanted.ravel(), strict=True):
            assert abs(length(controls, 0.0, at) - size) <= 4e-15 * whole


def test_the_parameter_at_a_length_of_the_circle_and_beyond_the_ends():
    angles = np.linspace(0.0, np.pi / 2.0, 9)
    points = evaluated(QUARTER, parameters_at(QUARTER, angles, QUARTER_WEIGHTS), QUARTER_WEIGHTS)
    assert np.abs(points - np.column_stack([np.cos(angles), np.sin(angles)])).max() <= 1e-14
    assert np.array_equal(parameters_at(QUARTER, [-1.0, 99.0]), [0.0, 1.0])
    assert parameters_at([[2.0, 2.0], [2.0, 2.0]], 0.0) == 0.0


def test_parameters_around_a_cusp():
    cusp = np.array([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]])
    whole = length(cusp)
    assert parameters_at(cusp, 0.5 * whole) == pytest.approx(0.5, abs=1e-7)
    t = parameters_at(cusp, [0.3 * whole, 0.7 * whole])
    assert t.sum() == pytest.approx(1.0, abs=1e-14)


def test_areas_add_up_to_that_of_the_outline_wherever_it_lies():
    k = 4.0 / 3.0 * (np.sqrt(2.0) - 1.0)
    quarter = np.array([[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]])
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    outline = np.stack([quarter @ np.linalg.matrix_power(turn, i) for i in range(4)])
    exact = 4.0 * (0.5 + 0.6 * k - 0.15 * k * k)  # Green's integral over the polynomials of a quarter
    assert area(outline).shape == (4,)
    assert area(outline).sum() == pytest.approx(exact, rel=1e-14)
    assert area(outline + 1e4).sum() == pytest.approx(exact, rel=1e-10)
    assert area(outline[:, ::-1]).sum() == pytest.approx(-exact, rel=1e-14)
