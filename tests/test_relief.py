"""Bitmaps as relief: plates and displaced faces by formula, closed, and refused in words."""

import numpy as np
import pytest
from PIL import Image

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange.meshes_in import import_file
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, cylinder, displace, document_of, evaluate, measure, relief, sphere
from solidtree.model.solid.relief import heights_of, relief_mesh


@pytest.fixture
def picture(tmp_path):
    def write(texels, name="heights.png", **more):
        Image.fromarray(np.asarray(texels), **more).save(tmp_path / name)
        return tmp_path / name

    return write


def grey(texels):
    return np.asarray(texels, np.uint8)


def test_a_plain_bitmap_is_a_box(picture):
    found = measure(relief(picture(np.full((30, 50), 255, np.uint8)), width=100, height=5, base=2))
    assert found.volume == pytest.approx(100 * 60 * 7)
    np.testing.assert_allclose(found.bounds, [(0, 0, 0), (100, 60, 7)])
    assert (found.genus, found.components, found.closed) == (0, 1, True)


def test_a_ramp_holds_what_the_trapezoids_hold(picture):
    """Heights at the middles of 256 columns, level within half a column of either side: mean 1/2 by symmetry."""
    ramp = picture(np.tile(np.arange(256, dtype=np.uint8), (16, 1)))
    found = measure(relief(ramp, width=128, height=10, base=1, samples=256))
    assert found.volume == pytest.approx(128 * 8 * (1 + 5))
    assert found.bounds[1][2] == pytest.approx(11)
    inverted = evaluate(relief(ramp, width=128, height=10, base=1, samples=256, invert=True)).solids[0].mesh()
    places = np.asarray(inverted.vert_properties)[:, :3]
    assert places[places[:, 0] == 0, 2].max() == pytest.approx(11) and places[
        places[:, 0] == 128, 2
    ].max() == pytest.approx(1)


def test_the_picture_lies_as_it_is_seen_from_above(picture):
    """White in the upper left corner is high at small x and large y."""
    texels = np.zeros((4, 6), np.uint8)
    texels[0, 0] = 255
    mesh = evaluate(relief(picture(texels), width=60, height=9, base=1)).solids[0].mesh()
    places = np.asarray(mesh.vert_properties)[:, :3]
    high = places[places[:, 2] > 9.5]
    np.testing.assert_allclose(high.max(axis=0), (5, 40, 10))
    np.testing.assert_allclose(high.min(axis=0), (0, 35, 10))


def test_sixteen_bits_make_no_terraces(picture):
    fine = picture(np.linspace(0, 65535, 4000).astype(np.uint16)[None, :].repeat(2, axis=0), "fine.png")
    assert len(np.unique(heights_of(relief(fine, samples=4000)))) == 4000


def test_alpha_is_black_and_samples_are_means(picture):
    texels = np.full((8, 8, 4), 255, np.uint8)
    texels[:, 4:, 3] = 0
    np.testing.assert_allclose(heights_of(relief(picture(texels), samples=2)), [[1, 0], [1, 0]], atol=1e-6)
    checker = grey(255 * ((np.arange(8)[:, None] + np.arange(8)) % 2))
    np.testing.assert_allclose(heights_of(relief(picture(checker, "b.png"), samples=4)), 0.5, atol=1e-6)
    checker = grey(255 * ((np.arange(40)[:, None] + np.arange(40)) % 2))
    np.testing.assert_allclose(heights_of(relief(picture(checker, "c.png"), smoothing=3))[16:24, 16:24], 0.5, atol=1e-3)


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (5, 1), (2, 2)])
def test_the_smallest_are_closed_too(picture, shape):
    texels = np.random.default_rng(1).integers(0, 255, shape).astype(np.uint8)
    found = measure(relief(picture(texels), width=shape[1], height=3, base=1))
    assert found.closed and found.genus == 0
    points, triangles = relief_mesh(np.ones(shape), float(shape[1]), 1.0, 1.0)
    corners = points[triangles.astype(int)]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert areas.min() > 0.0


@pytest.mark.parametrize(
    ("node", "words"),
    [
        (lambda p: relief(), "no bitmap is chosen"),
        (lambda p: relief(asset="ab" * 32), "its bitmap is missing from the project"),
        (lambda p: relief(p, width=0), "width must be above 0"),
        (lambda p: relief(p, smoothing=-1), "smoothing must be at least 0"),
        (lambda p: displace(box(10)), "no bitmap is chosen"),
        (lambda p: displace(box(1000), p, edge=0.01), "let the edge be longer"),
    ],
)
def test_what_cannot_be_made_is_told_on_its_row(picture, node, words):
    evaluation = evaluate(node(picture(np.zeros((2, 2), np.uint8))))
    assert evaluation.solids[0].solid is None
    assert any(words in message.message for message in evaluation.messages)


def test_too_many_samples_are_refused_before_they_cost_memory(picture):
    wide = picture(np.zeros((2100, 2000), np.uint8), "wide.png")
    evaluation = evaluate(relief(wide, samples=2100))
    assert "ask for fewer" in evaluation.messages[0].message


def test_picture_files_open_as_reliefs_and_bad_ones_are_refused(picture, tmp_path):
    (root,) = import_file(picture(np.full((4, 8), 128, np.uint8), "coin.png")).solids
    assert (root.kind, root.name) == ("Relief", "coin")
    assert measure(root).bounds[1][:2] == pytest.approx((100, 50))
    (tmp_path / "bad.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(40))
    with pytest.raises(Refusal):
        import_file(tmp_path / "bad.png")


def test_white_moves_every_face_outwards_by_the_height(picture):
    """A plain bitmap on a ball is a larger ball: each vertex moves along its own normal."""
    white = picture(np.full((2, 2), 255, np.uint8))
    ball = sphere(10, segments=48)
    found = measure(displace(ball, white, 1.5, projection="spherical", edge=1))
    points = np.asarray(evaluate(displace(ball, white, 1.5, edge=1)).solids[0].mesh().vert_properties)[:, :3]
    assert found.closed and found.genus == 0
    assert np.linalg.norm(points, axis=1).max() == pytest.approx(11.5, abs=0.02)
    assert found.volume == pytest.approx(4 / 3 * np.pi * 11.5**3, rel=0.02)


def test_waves_run_round_a_cylinder_without_a_gap(picture):
    """A cosine around: the radius is that of the formula at every angle, the seam's too."""
    u = (np.arange(256) + 0.5) / 256
    waves = picture(grey(np.rint(127.5 + 127.5 * np.cos(2 * np.pi * 6 * u)))[None, :].repeat(4, axis=0))
    made = displace(cylinder(10, 30, segments=360), waves, 2, projection="cylindrical", edge=0.7)
    solid = evaluate(made).solids[0]
    points = np.asarray(solid.mesh().vert_properties)[:, :3]
    wall = np.abs(points[:, 2] - 15) < 10
    radius, angle = np.hypot(*points[wall, :2].T), np.arctan2(points[wall, 1], points[wall, 0])
    np.testing.assert_allclose(radius, 10 + 1 + np.cos(6 * angle), atol=0.03)
    assert solid.measures().closed and solid.measures().genus == 0


def test_each_of_the_selected_solids_is_raised_in_one_step(picture):
    document = document_of(box(5), box(5).at(20), relief(picture(np.zeros((2, 2), np.uint8))))
    asset = document.solids[2].asset
    after = OPERATIONS["displace_each"](document, ["n1", "n2"], asset, height=0.5, edge=2)
    assert [root.kind for root in after.solids] == ["Displace", "Displace", "Relief"]
    assert {root.height for root in after.solids[:2]} == {0.5} and {root.asset for root in after.solids} == {asset}
    assert after.solids[0].children[0].id == "n1"
