"""Shadows: where a ray to the light meets another face, and nowhere else."""

import numpy as np
import pytest
from light_reference import first_hits
from test_shading import shown

from solidtree.model.document.document import Section
from solidtree.model.script import box, light, material
from solidtree.render.camera import Camera
from solidtree.render.picture import picture

SIZE = (160, 120)
EYE = Camera((4.0, -60.0, 55.0), (0.0, 0.0, 0.0), view_angle=40.0)
CHALK = {"ambient": 0.2, "diffuse": 0.8, "specular": 0.0, "colour": "#ffffff"}
PLATE, BRICK = 0, 1


def scene(dressed):
    plate, brick = box(50, 50, 2, centred=True).at(z=-1), box(12, 12, 2, centred=True).at(z=11)
    return (plate + brick).dressed(material("chalk", **CHALK)) if dressed else plate + brick


LAMPS = {
    "directional": (light("sun", direction=(0.5, 0.25, -1.0), shadows=True), np.array((0.5, 0.25, -1.0))),
    "point": (light("lamp", "point", position=(-30.0, -15.0, 70.0), shadows=True), None),
}


@pytest.mark.parametrize("mode", ["zbuffer", "bsp"])
@pytest.mark.parametrize("dressed", [True, False], ids=["material", "plain"])
@pytest.mark.parametrize("name", LAMPS)
def test_the_plate_is_dark_where_the_brick_is_before_the_light(name, dressed, mode):
    lamp, direction = LAMPS[name]
    document, mesh, paint = shown(scene(dressed), light("around", "ambient"), lamp)
    found = picture([(mesh, paint)], SIZE, EYE, lights=document.lights, hidden_surface=mode)
    triangle, shares, alone = first_hits(mesh, EYE, SIZE)
    places = np.einsum("ij,ijk->ik", shares, mesh.points[mesh.triangles[triangle]].astype(float))
    top = (triangle >= 0) & alone & (np.abs(places[:, 2]) < 1e-3)
    towards = -direction if direction is not None else np.array(lamp.position) - places
    # Where the way to the light passes the heights of the brick, which is 12 mm wide.
    rise = np.broadcast_to(towards, places.shape)[:, 2:]
    reach = np.array([np.abs((places + towards * z / rise)[:, :2]).max(axis=1) for z in (10, 10.5, 11, 11.5, 12)])
    level = found.reshape(-1, 3).max(axis=1)
    dark, bright = level[top & (reach.min(axis=0) < 5.5)], level[top & (reach.min(axis=0) > 6.6)]
    assert len(dark) > 100 and len(bright) > 2000
    assert dark.max() < 80 < 120 < bright.min()


def test_without_the_switch_nothing_is_dark():
    lamp, _ = LAMPS["directional"]
    document, mesh, paint = shown(scene(True), light("around", "ambient"), lamp.with_(shadows=False))
    found = picture([(mesh, paint)], SIZE, EYE, lights=document.lights)
    _, mesh, paint = shown(box(50, 50, 2, centred=True).at(z=-1).dressed(material("chalk", **CHALK)))
    bare = picture([(mesh, paint)], SIZE, EYE, lights=document.lights)
    assert found[70:].min() == bare[70:].min()


def test_what_a_section_takes_away_casts_no_shadow():
    lamp, _ = LAMPS["directional"]
    document, mesh, paint = shown(scene(True), light("around", "ambient"), lamp)
    plane = Section("s", point=(0, 0, 5), normal=(0, 0, -1))
    found = picture([(mesh, paint)], SIZE, EYE, lights=document.lights, sections=[plane])
    triangle, _, alone = first_hits(mesh, EYE, SIZE)
    level = found.reshape(-1, 3).max(axis=1)
    plate = (triangle >= 0) & alone & (np.array([owner[-1] for owner in mesh.owners])[mesh.owner[triangle]] == "n2")
    assert plate.sum() > 2000
    assert level[plate & (mesh.facet[triangle] == np.bincount(mesh.facet[triangle[plate]]).argmax())].min() > 120
