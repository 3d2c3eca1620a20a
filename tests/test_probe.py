"""The light of one place, term by term, against the picture's pixel there."""

import numpy as np
import pytest
from light_reference import first_hits
from PIL import Image
from test_shading import EYE, LIGHTS, SHINY, SIZE, shown

from solidtree.model.script import box, material, sphere
from solidtree.model.surface.intensity import Eye
from solidtree.model.surface.light import PROGRAM, Light
from solidtree.model.surface.mapping import TextureMapping
from solidtree.model.surface.material import SHADINGS, Material
from solidtree.model.surface.probe import arriving, probe
from solidtree.render.camera import frame
from solidtree.render.look import Paint, rgb
from solidtree.render.picture import picture

SEEN = Eye(np.array(EYE.position, float), frame(EYE))


@pytest.fixture
def waves(tmp_path):
    """A soft bitmap: a few waves, of other phases in red, green and blue."""
    u, v = np.meshgrid((np.arange(64) + 0.5) / 64, (np.arange(48) + 0.5) / 48)
    levels = [127.5 + 80.0 * np.sin(2 * np.pi * (2 * u + k / 3)) * np.cos(2 * np.pi * (v + k / 5)) for k in range(3)]
    path = tmp_path / "waves.png"
    Image.fromarray(np.rint(np.dstack(levels)).astype(np.uint8)).save(path)
    return path


def differences(node, lights, shading="phong", colour=None):
    """By how many grey levels the probe and the picture differ, at a few pixels away from the borders of triangles."""
    document, mesh, paint = shown(node, *lights)
    lights = document.lights or PROGRAM
    found = picture([(mesh, paint if colour is None else Paint(colour))], SIZE, EYE, shading=shading, lights=lights)
    triangle, shares, alone = first_hits(mesh, EYE, SIZE)
    inside = ((triangle >= 0) & alone).reshape(SIZE[1], SIZE[0])
    for axis in (0, 1):
        inside = inside & np.roll(inside, 1, axis) & np.roll(inside, -1, axis)
    places = np.flatnonzero(inside)[::23]
    assert len(places) > 15
    wrong = []
    for place in places:
        at = int(triangle[place])
        look = paint.looks[mesh.owner[at]]
        base = np.array(rgb(colour or look.colour))
        point = shares[place] @ mesh.points[mesh.triangles[at]].astype(float)
        told = probe(mesh, at, point, look, base, shading, lights, SEEN)
        wrong.append(np.abs(255.0 * told.shown - found.reshape(-1, 3)[place]).max())
    return np.array(wrong)


@pytest.mark.parametrize("shading", SHADINGS)
def test_the_sum_is_the_pixel(shading):
    ball = sphere(5, segments=12)
    assert differences(ball.dressed(material("red", colour="#c04030", **SHINY)), LIGHTS, shading).max() <= 2.0
    assert differences(ball, (), shading, "#8090a0").max() <= 2.0


@pytest.mark.parametrize("kind", ["heights", "normals"])
def test_bitmaps_count_as_they_do_in_the_picture(waves, kind):
    plain = {"colour": "#d0c0a0", **SHINY}
    brick = box(7, 7, 7, centred=True)
    for maps in (
        {"texture": waves},
        {"bump": waves, "bump_kind": kind, "bump_height": 0.4},
        {"light_map": waves, "reflection": waves, "reflectivity": 0.4},
    ):
        wrong = differences(brick.dressed(material("worn", **plain, **maps)), LIGHTS)
        assert np.median(wrong) <= 1.0
        # The picture takes changes from a pixel to the next: where heights bend, a few pixels are off by more.
        assert np.quantile(wrong, 0.9) <= 8.0
    worn = material("ball", bump=waves, bump_kind=kind, bump_height=0.4, **plain)
    ball = sphere(5, segments=16).dressed(worn).with_(mapping=TextureMapping("spherical", turn=20.0))
    assert np.median(differences(ball, LIGHTS)) <= 1.0


def test_light_that_does_not_arrive_has_no_terms_and_corners_have_weights():
    _, mesh, paint = shown(box(10, 10, 10).dressed(material("red", colour="#c04030", **SHINY)), *LIGHTS)
    facing = np.flatnonzero((mesh.normals[mesh.triangles[:, 0]] == (0, -1, 0)).all(axis=1))
    at = int(facing[0])
    corners = mesh.points[mesh.triangles[at]].astype(float)
    weights = np.array((0.2, 0.3, 0.5))
    given = (mesh, at, weights @ corners, paint.looks[0], np.ones(3))
    dark = probe(*given, "phong", LIGHTS, SEEN, np.zeros(3))
    assert not dark.terms.diffuse.any() and not dark.terms.specular.any()
    np.testing.assert_allclose(dark.shown, dark.terms.ambient[0])
    soft = probe(*given, "gouraud", LIGHTS, SEEN)
    np.testing.assert_allclose(soft.weights, weights, atol=1e-9)
    assert soft.shading == "gouraud" and probe(*given, "phong", LIGHTS, SEEN).weights is None
    assert [light.name for light in soft.lights] == ["sun", "lamp", "on the eye"]


def test_without_a_material_the_given_one_counts():
    _, mesh, paint = shown(box(10, 10, 10))
    point = mesh.points[mesh.triangles[0]].mean(axis=0)
    dull = Material("dull", ambient=0.5, diffuse=0.0, specular=0.0)
    told = probe(mesh, 0, point, paint.looks[0], np.ones(3), "phong", PROGRAM, SEEN, material=dull)
    np.testing.assert_allclose(told.shown, np.full(3, 0.5))


def test_shadows_are_where_something_stands_before_the_light():
    """A ball of radius 2, 10 above the ground, under a light from straight above and a lamp below the ball."""
    _, mesh, _ = shown(sphere(2).at(0, 0, 10))
    corners = mesh.points[mesh.triangles].astype(float)
    sun = Light("sun", direction=(0, 0, -1), shadows=True)
    lamp = Light("lamp", "point", position=(0, 0, 5), shadows=True)
    plain = Light("plain", direction=(0, 0, -1))
    up = np.array((0.0, 0.0, 1.0))
    for x, lit in ((0.0, 0.0), (1.9, 0.0), (2.1, 1.0)):
        found = arriving(np.array((x, 0.0, 0.0)), up, (Light("a", "ambient"), sun, lamp, plain), SEEN, corners, 20.0)
        assert found.tolist() == [lit, 1.0, 1.0]
    high = Light("high", "point", position=(0, 0, 30), shadows=True)
    assert arriving(np.zeros(3), up, (high,), SEEN, corners, 20.0).tolist() == [0.0]
    on_top = np.array((0.0, 0.0, float(corners[..., 2].max())))
    assert arriving(on_top, up, (sun,), SEEN, corners, 20.0).tolist() == [1.0]  # it does not shade itself
