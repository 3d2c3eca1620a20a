"""Flat, Gouraud and Phong shading against the intensity equation in NumPy, ray by ray."""

import numpy as np
import pytest
from light_reference import lit

from solidtree.model.script import box, document_of, evaluate, light, material, sphere
from solidtree.model.surface.appearance import appearances
from solidtree.model.surface.intensity import Eye, terms
from solidtree.model.surface.light import PROGRAM, Light, lights_of
from solidtree.model.surface.material import PRESETS, SHADINGS, Material
from solidtree.render.camera import Camera, frame
from solidtree.render.look import Paint
from solidtree.render.picture import picture

SIZE = (120, 100)
EYE = Camera((6.0, -30.0, 14.0), (0.0, 0.0, 0.0), view_angle=26.0)
FAR = Camera((6.0, -30.0, 14.0), (0.0, 0.0, 0.0), parallel=True, parallel_scale=6.5)
LIGHTS = (
    Light("around", "ambient", colour="#8090a0"),
    Light("sun", direction=(0.3, 1.0, -0.6), colour="#fff0d0", intensity=0.7),
    Light("lamp", "point", position=(-9.0, -12.0, 8.0), colour="#c0d0ff", intensity=0.6),
    Light("on the eye", direction=(0.2, -0.3, -1.0), intensity=0.25, with_camera=True),
    Light("off", direction=(0.0, 0.0, 1.0), active=False),
)
SHINY = {"ambient": 0.3, "diffuse": 0.6, "specular": 0.5, "shininess": 30.0}


def shown(node, *lights):
    """A document of one solid, its mesh, and what its owners look like."""
    document = document_of(node, *lights)
    evaluation = evaluate(document)
    mesh = evaluation.display(evaluation.solids[0])
    looks = appearances(document, evaluation.solids[0].root, mesh.owners)
    return document, mesh, Paint(None, tuple(look.colour for look in looks), looks)


@pytest.mark.parametrize("mode", ["zbuffer", "bsp"])
@pytest.mark.parametrize("camera", [EYE, FAR], ids=["perspective", "parallel"])
@pytest.mark.parametrize("shading", SHADINGS)
def test_pictures_are_the_equation_s(shading, camera, mode):
    worn = material("red", colour="#c04030", **SHINY)
    document, mesh, paint = shown(sphere(5, segments=12).dressed(worn), *LIGHTS)
    found = picture([(mesh, paint)], SIZE, camera, shading=shading, lights=document.lights, hidden_surface=mode)
    wanted, counts = lit(mesh, camera, SIZE, worn, np.array((0xC0, 0x40, 0x30)) / 255.0, LIGHTS, shading)
    assert counts.sum() > 1500
    assert np.abs(found.astype(float) - wanted)[counts].max() <= 2.0


@pytest.mark.parametrize("shading", SHADINGS)
def test_what_wears_no_material_takes_light_alike(shading):
    _, mesh, paint = shown(sphere(5, segments=12))
    assert not any(look.material for look in paint.looks)
    found = picture([(mesh, Paint("#8090a0"))], SIZE, EYE, shading=shading)
    usual = Material("usual")
    wanted, counts = lit(mesh, EYE, SIZE, usual, np.array((0x80, 0x90, 0xA0)) / 255.0, PROGRAM, shading)
    assert np.abs(found.astype(float) - wanted)[counts].max() <= 2.0


def test_a_highlight_inside_a_face_is_phong_s_alone():
    """A lamp before the middle of a large face: Gouraud, which has light at the corners only, misses it."""
    lamp = light("lamp", "point", position=(0.0, -8.0, 0.0), intensity=1.0)
    middle = {}
    for shading in SHADINGS:
        worn = material("dark", colour="#202020", ambient=0.0, diffuse=0.2, specular=0.9, shininess=60.0)
        document, mesh, paint = shown(box(20, 20, 20, centred=True).at(y=13).dressed(worn), lamp)
        camera = Camera((0.0, -40.0, 0.0), (0.0, 0.0, 0.0), view_angle=40.0)
        found = picture([(mesh, paint)], SIZE, camera, shading=shading, lights=document.lights)
        middle[shading] = int(found[50, 60].max())
    assert middle["phong"] > 200
    assert middle["gouraud"] < 40
    assert middle["gouraud-diffuse"] <= middle["gouraud"]


def test_nodes_have_a_shading_of_their_own():
    facets = material("facets", colour="#c04030", shading="flat", **SHINY)
    document, mesh, paint = shown(sphere(5, segments=12).dressed(facets), *LIGHTS)
    found = picture([(mesh, paint)], SIZE, EYE, shading="phong", lights=document.lights)
    wanted, counts = lit(mesh, EYE, SIZE, facets, np.array((0xC0, 0x40, 0x30)) / 255.0, LIGHTS, "flat")
    assert np.abs(found.astype(float) - wanted)[counts].max() <= 2.0


def test_terms_are_those_of_a_textbook_s_example():
    """A light at 60 degrees from the normal, the eye at the normal: s.m = 1/2, and h is 30 degrees off."""
    eye = Eye(np.array((0.0, 0.0, 10.0)), np.eye(3), parallel=True)
    sun = Light("sun", direction=(-np.sqrt(0.75), 0.0, -0.5), intensity=0.8)
    around = Light("around", "ambient", intensity=0.5)
    worn = Material("m", ambient=0.4, diffuse=0.5, specular=0.25, shininess=4.0)
    found = terms(np.zeros((1, 3)), np.array((0.0, 0.0, 1.0)), eye, worn, np.array((1.0, 0.5, 0.0)), (around, sun))
    np.testing.assert_allclose(found.ambient[0], (0.2, 0.1, 0.0))
    np.testing.assert_allclose(found.diffuse[0, 0], (0.2, 0.1, 0.0))
    np.testing.assert_allclose(found.specular[0, 0], np.full(3, 0.8 * 0.25 * 0.75**2))
    np.testing.assert_allclose(found.halfway[0, 0], (0.5, 0.0, np.sqrt(0.75)))


def test_light_from_behind_leaves_no_highlight():
    eye = Eye(np.array((10.0, 0.0, 1.0)), frame(Camera((10.0, 0.0, 1.0), (0.0, 0.0, 0.0))))
    low = Light("low", "point", position=(-10.0, 0.0, -0.5))
    found = terms(np.zeros((1, 3)), np.array((0.0, 0.0, 1.0)), eye, Material("m"), np.ones(3), (low,))
    assert not found.specular.any() and not found.diffuse.any()


def test_sums_are_clamped_and_lights_that_are_off_give_nothing():
    eye = Eye(np.array((0.0, 0.0, 1.0)), np.eye(3), parallel=True)
    lights = (Light("a", intensity=3.0), Light("b", intensity=5.0, active=False))
    found = terms(np.zeros((1, 3)), np.array((0.0, 0.0, 1.0)), eye, Material("m"), np.ones(3), lights)
    assert found.sum[0, 0] == pytest.approx(3.0 * (0.9 + 0.16))
    assert found.clamped[0, 0] == 1.0
    assert lights_of(()) is PROGRAM
    assert [one.name for one in lights_of(lights)] == ["a"]


def test_presets_are_materials():
    for name, values in PRESETS.items():
        assert material("x", name) == Material("x", **values)
