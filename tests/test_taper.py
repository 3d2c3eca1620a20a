"""Extrusions with leaning walls: volumes by formula, levels against offsets of the outline."""

from math import pi, radians, tan

import numpy as np
import pytest
from manifold3d import CrossSection, FillRule, JoinType

from solidtree.model.document.errors import Refusal
from solidtree.model.script import circle, extrude, lettering, measure, path, polygon, rectangle
from solidtree.model.solid.outlines.taper import tapered


def ring(points) -> CrossSection:
    return CrossSection([np.asarray(points, float)], FillRule.NonZero)


SQUARE = CrossSection.square((10, 10))
U = ring([(0, 0), (30, 0), (30, 10), (20, 10), (20, 5), (10, 5), (10, 10), (0, 10)])
DUMBBELL = SQUARE + CrossSection.square((10, 4)).translate((10, 3)) + SQUARE.translate((20, 0))
STAR = ring(
    [np.array((np.cos(a), np.sin(a))) * (10 if k % 2 == 0 else 4) for k, a in enumerate(np.arange(10) * pi / 5)]
)
ELLIPSE = CrossSection.circle(10, 48).scale((2, 1))
RING = CrossSection.circle(10, 48) - CrossSection.circle(5, 48)


@pytest.mark.parametrize("height, slope, volume", [
    (3, 1, (100 + 16 + 40) / 3 * 3),  # frustum
    (5, 1, 100 * 5 / 3),  # pyramid
    (9, 1, 100 * 5 / 3),  # which ends below the height
    (3, -1, (100 + 256 + 160) / 3 * 3),  # wider at the top
])  # fmt: skip
def test_a_square_becomes_a_frustum_or_a_pyramid(height, slope, volume):
    assert tapered(SQUARE, height, slope).volume() == pytest.approx(volume, rel=1e-9)


def test_a_rectangle_becomes_a_roof_with_a_ridge():
    roof = tapered(CrossSection.square((20, 10)), 9, 1)
    assert roof.volume() == pytest.approx(5 * 10 * (2 * 20 + 10) / 6, rel=1e-9)
    assert roof.bounding_box()[5] == pytest.approx(5)


@pytest.mark.parametrize(
    "section", [U, DUMBBELL, STAR, ELLIPSE, RING], ids=["U", "dumbbell", "star", "ellipse", "ring"]
)
@pytest.mark.parametrize("slope", [1.0, 0.3, -0.5])
def test_every_level_is_the_outline_moved_in_or_out(section, slope):
    """Offset by mitres is the same wavefront, found by another way."""
    solid = tapered(section, 12, slope)
    assert solid.genus() >= 0 and solid.volume() > 0
    for level in (0.37, 1.21, 2.13, 2.9, 4.3, 7.7):
        wanted = section.offset(-slope * level, JoinType.Miter, 100.0)
        assert solid.slice(level).area() == pytest.approx(wanted.area(), rel=1e-4, abs=1e-3 * section.area())


def test_two_lobes_part_where_the_bar_between_them_has_gone():
    above = tapered(DUMBBELL, 4, 1).split_by_plane((0, 0, 1), 2.5)[0]
    assert len(above.decompose()) == 2
    assert tapered(DUMBBELL, 4, 1).slice(2.5).area() == pytest.approx(50)


def test_a_hole_closes_as_it_leans_outwards():
    closed = tapered(RING, 8, -1)
    assert closed.genus() == 0
    assert tapered(RING, 2, -1).genus() == 1


def test_a_script_tapers_both_sides_away_from_the_outline():
    slope = tan(radians(30))
    top, foot = (10 - 2 * 3 * slope) ** 2, (10 - 2 * 2 * slope) ** 2
    volume = sum((100 + a + (100 * a) ** 0.5) / 3 * h for a, h in ((top, 3), (foot, 2)))
    both = extrude(rectangle(10, 10), 3, below=2, taper=30)
    assert measure(both).volume == pytest.approx(volume, rel=1e-9)
    np.testing.assert_allclose(np.array(measure(both).bounds)[:, 2], (-2, 3), atol=1e-12)


def test_a_tapered_circle_converges_to_the_cone():
    for tolerance in (0.1, 0.01, 0.001):
        volume = measure(extrude(circle(10), 10, taper=45), tolerance).volume
        assert 0 < 1000 * pi / 3 - volume < 20 * pi * 10 * tolerance


def test_both_sides_without_a_taper_are_one_prism():
    prism = extrude(path("M0 0h4v4h-4z M1 1v2h2v-2z"), 3, below=2)
    assert measure(prism).volume == pytest.approx(60)
    np.testing.assert_allclose(np.array(measure(prism).bounds)[:, 2], (-2, 3))
    centred = extrude(rectangle(1, 1), 3, below=2, centred=True)
    np.testing.assert_allclose(np.array(measure(centred).bounds)[:, 2], (-2.5, 2.5))


def test_twist_and_scale_go_on_below_the_outline():
    both = extrude(rectangle(10, 10, centred=True), 4, top_scale=0.5, below=2)
    frusta = (100 + 25 + 50) / 3 * 4 + (100 + 56.25 + 75) / 3 * 2
    assert measure(both).volume == pytest.approx(frusta, rel=1e-9)
    pointed = extrude(rectangle(10, 10, centred=True), 4, top_scale=0, below=8)
    assert measure(pointed).volume == pytest.approx(2 * 400 / 3, rel=1e-9)
    turned = extrude(rectangle(10, 10, centred=True), 4, twist=40, below=4)
    assert measure(turned, 0.001).volume == pytest.approx(800, rel=1e-3)


@pytest.mark.parametrize(
    "more, volume",
    [
        ({"bevel": 2}, 200 * 3 + (200 + 96 + 4 * 18 * 8) / 6 * 2),  # a prism and a prismatoid
        ({"bevel": 5}, 5 * 10 * (2 * 20 + 10) / 6),  # a roof from the outline on
        ({"bevel": 2, "below": 3}, 200 * 6 + (200 + 96 + 4 * 18 * 8) / 6 * 2),
        ({"bevel": 5, "height": 9}, 200 * 4 + 5 * 10 * (2 * 20 + 10) / 6),
    ],
)
def test_a_bevel_stands_on_upright_walls(more, volume):
    solid = extrude(rectangle(20, 10), **{"height": 5, **more})
    assert measure(solid).volume == pytest.approx(volume, rel=1e-9)


def test_a_bevelled_circle_converges_to_cylinder_and_frustum():
    exact = pi * 100 * 3 + pi * 2 / 3 * (100 + 64 + 80)
    for tolerance in (0.1, 0.01, 0.001):
        solid = extrude(circle(10), 5, bevel=2, centred=True)
        found = measure(solid, tolerance)
        assert 0 < exact - found.volume < 20 * pi * 5 * tolerance
        np.testing.assert_allclose(np.array(found.bounds)[:, 2], (-2.5, 2.5))


@pytest.mark.parametrize("bevel", [0.2, 0.7, 2])
def test_bevelled_letters_are_closed_and_keep_their_holes(bevel):
    """Also where the strokes are narrower than the bevel, and end in a ridge."""
    plain, bevelled = (measure(extrude(lettering("ABdo8", 10), 3, bevel=b)) for b in (0, bevel))
    assert bevelled.closed and bevelled.components == plain.components == 5
    assert bevelled.genus == plain.genus == 1 + 2 + 1 + 1 + 2
    np.testing.assert_allclose(np.array(bevelled.bounds)[:, :2], np.array(plain.bounds)[:, :2], atol=1e-6)
    assert 0 < bevelled.volume < plain.volume


def test_letters_narrower_than_the_bevel_are_lower_than_the_height():
    assert measure(extrude(lettering("l", 10), 3, bevel=2)).bounds[1][2] < 2
    assert measure(extrude(lettering("l", 10), 3, bevel=0.1)).bounds[1][2] == pytest.approx(3)


@pytest.mark.parametrize(
    "more, words",
    [
        ({"taper": 89.5}, "between -89"),
        ({"taper": 5, "twist": 3}, "neither a twist"),
        ({"bevel": 1, "twist": 3}, "no taper, twist or top scale"),
        ({"bevel": 1, "taper": 3}, "no taper, twist or top scale"),
        ({"bevel": 2.5}, "larger than the height, 2 mm"),
        ({"bevel": -1}, "bevel must be at least 0"),
    ],
)
def test_what_cannot_be_is_told(more, words):
    with pytest.raises(Refusal, match=words):
        measure(extrude(polygon([(0, 0), (4, 0), (0, 3)]), 2, **more))
