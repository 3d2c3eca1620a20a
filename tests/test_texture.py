"""Where bitmaps lie on faces: by formula on vertices, and texel by texel in pictures."""

import numpy as np
import pytest
from light_reference import first_hits
from PIL import Image
from test_shading import shown

from solidtree.model.image.tiled_file import TiledFile
from solidtree.model.project.assets import default_store
from solidtree.model.script import box, cone, cylinder, light, linear_array, material, mirror, sphere, texture, torus
from solidtree.model.surface.appearance import coordinates
from solidtree.model.surface.bitmaps import keep_bitmap, small_texels, texels_of
from solidtree.model.surface.intensity import Eye, terms
from solidtree.model.surface.material import Material
from solidtree.model.surface.pyramid import level_of, tiles_path
from solidtree.render.camera import Camera, frame
from solidtree.render.picture import picture

SIZE = (140, 120)
FLOOD = light("flood", "ambient")
GLOW = {"ambient": 1.0, "diffuse": 0.0, "specular": 0.0}  # under FLOOD the pixel is the texel


@pytest.fixture
def written(tmp_path):
    """Writes texels (height, width, 3 or 4) and gives the file's path."""

    def write(texels, name="texels.png"):
        Image.fromarray(np.rint(texels).astype(np.uint8)).save(tmp_path / name)
        return tmp_path / name

    return write


def round_map(width=256, height=128):
    """A bitmap that tells u by an angle in red and green, without a jump at its border, and v by blue."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height)[::-1] + 0.5) / height)
    return 127.5 + 127.5 * np.dstack((np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 2 * v - 1))


def read_back(pixels):
    """u and v (n, 2) from colours (n, 3) of a round map."""
    red, green, blue = (pixels.astype(float) / 127.5 - 1.0).T
    return np.column_stack((np.arctan2(green, red) / (2 * np.pi) % 1.0, (blue + 1.0) / 2.0))


def seen(node, camera, mode="zbuffer", size=SIZE):
    """The picture's pixels, and where the rays through them meet the solid: places (n, 3) of these pixels."""
    document, mesh, paint = shown(node, FLOOD)
    found = picture([(mesh, paint)], size, camera, lights=document.lights, hidden_surface=mode)
    triangle, shares, alone = first_hits(mesh, camera, size)
    here = (triangle >= 0) & alone
    places = np.einsum("ij,ijk->ik", shares[here], mesh.points[mesh.triangles[triangle[here]]].astype(float))
    return found.reshape(-1, 3)[here], places, mesh.owner[triangle[here]]


def turn_between(a, b):
    return np.abs((a - b + 0.5) % 1.0 - 0.5)


@pytest.mark.parametrize("mode", ["zbuffer", "bsp"])
@pytest.mark.parametrize("eye", [(40.0, 3.0, 8.0), (-30.0, -20.0, -15.0)], ids=["seam", "below"])
def test_a_sphere_shows_the_texel_of_the_formula_and_no_seam(written, mode, eye):
    globe = sphere(10, segments=32).dressed(material("globe", texture=written(round_map()), **GLOW))
    pixels, places, _ = seen(globe, Camera(eye, (0.0, 0.0, 0.0), view_angle=34.0), mode)
    found = read_back(pixels)
    x, y, z = places.T
    u, v = np.arctan2(y, x) / (2 * np.pi) % 1.0, np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5
    assert len(found) > 2000
    assert (turn_between(u, 0.0) < 0.01).any() == (eye[0] > 0)  # the seam is in the picture
    assert np.abs(found[:, 1] - v).max() < 1.0 / 128
    away = np.hypot(x, y) > 3.0  # near a pole a pixel covers many texels of one row
    assert turn_between(found[away, 0], u[away]).max() < 1.0 / 256


def test_a_cut_leaves_the_coordinates_as_they_were(written):
    """What is left of a sphere has the formula's coordinates at every vertex, and the same texels in the picture."""
    skin = material("globe", texture=written(round_map()), **GLOW)
    whole = sphere(10, segments=32).dressed(skin)
    cut = whole - cylinder(3, 40, centred=True).turned(x=90).at(y=-5)
    _, mesh, paint = shown(cut, FLOOD)
    found = coordinates(mesh, paint.looks)
    mine = mesh.owner == 0
    places = mesh.vertices[mesh.corners[mine]].reshape(-1, 3)
    assert mine.sum() > 500 and (~mine).any()
    x, y, z = places.T
    away = np.hypot(x, y) > 1e-6
    np.testing.assert_allclose(turn_between(found[mine][..., 0].reshape(-1), np.arctan2(y, x) / (2 * np.pi))[away], 0,
                               atol=1e-12)  # fmt: skip
    np.testing.assert_allclose(found[mine][..., 1].reshape(-1), np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5, atol=1e-12)
    camera = Camera((8.0, -40.0, 12.0), (0.0, 0.0, 0.0), view_angle=34.0)
    before = picture([shown(whole)[1:]], SIZE, camera, lights=(FLOOD,)).astype(int)
    after = picture([(mesh, paint)], SIZE, camera, lights=(FLOOD,)).astype(int)
    triangle, _, alone = first_hits(mesh, camera, SIZE)
    left = ((triangle >= 0) & alone & (mesh.owner[triangle] == 0)).reshape(before.shape[:2])
    assert left.sum() > 1000
    assert np.abs(after - before)[left].max() <= 2


NATURAL = {
    "box": (box(4, 6, 8), 6),
    "centred": (box(4, 6, 8, centred=True), 6),
    "cylinder": (cylinder(5, 12), 3),
    "cone": (cone(5, 0, 12), 2),
    "torus": (torus(8, 3), 1),
}


@pytest.mark.parametrize("name", NATURAL)
def test_natural_coordinates_fill_the_bitmap_once(name):
    """Each face of a box, each wall and cap has all of the bitmap, and no triangle jumps across it."""
    node, _ = NATURAL[name]
    _, mesh, paint = shown(node.dressed(material("m", colour="red")))
    found = coordinates(mesh, paint.looks)
    assert found.min() == pytest.approx(0.0, abs=1e-9) and found.max() == pytest.approx(1.0, abs=1e-9)
    if name in ("box", "centred"):
        one, other = found[:, 1] - found[:, 0], found[:, 2] - found[:, 0]
        assert 0.5 * np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() == pytest.approx(6.0)
    if name == "torus":
        assert np.ptp(found, axis=1).max() < 0.25


def test_planar_coordinates_follow_their_frame():
    """u along the turned frame's x, one copy 10 by 5 mm, moved by a quarter of a copy."""
    lies = texture(projection="planar", origin=(2, 3, 0), turned=(0, 0, 90), size=(10, 5), offset=(0.25, 0))
    _, mesh, paint = shown(box(10).dressed(material("m"), lies).at(100, 50))
    found = coordinates(mesh, paint.looks).reshape(-1, 2)
    places = mesh.vertices[mesh.corners].reshape(-1, 3) - (100, 50, 0)
    np.testing.assert_allclose(found[:, 0], (places[:, 1] - 3) / 10 - 0.25, atol=1e-12)
    np.testing.assert_allclose(found[:, 1], -(places[:, 0] - 2) / 5, atol=1e-12)


def test_scale_turn_and_mirror():
    """A point of a planar mapping, by hand: twice as large, turned by 90 degrees, mirrored along u."""
    lies = texture(projection="planar", size=(10, 10), scale=(2, 1), turn=90, mirror=(True, False))
    found = lies.finished(np.array([[0.2, 0.6]]))
    np.testing.assert_allclose(found, [[1 - 0.6 / 2, -0.2]], atol=1e-12)


def test_coordinates_go_with_copies_and_with_what_they_stand_in():
    """A mapping on a leaf goes with each of its copies; one on what holds them runs on over all of them."""
    skin = material("m")
    row = linear_array(box(4), 3, (10, 0, 0))
    lies = texture(projection="planar", size=(10, 10))
    _, mesh, paint = shown(row.dressed(skin).with_(children=(box(4).dressed(lies),)))
    found = coordinates(mesh, paint.looks)[..., 0]
    assert found.min() == pytest.approx(0.0) and found.max() == pytest.approx(0.4)
    _, mesh, paint = shown(row.dressed(skin, lies))
    found = coordinates(mesh, paint.looks)[..., 0]
    np.testing.assert_allclose(found, mesh.vertices[mesh.corners][..., 0] / 10, atol=1e-12)
    _, mesh, paint = shown(mirror(box(4).at(3).dressed(skin, lies)))
    found = coordinates(mesh, paint.looks)[..., 0]
    np.testing.assert_allclose(found, (np.abs(mesh.vertices[mesh.corners][..., 0]) - 3) / 10, atol=1e-12)


def test_the_nearest_material_and_mapping_count(written):
    inner = box(10).dressed(material("inner", colour="red"))
    _, mesh, paint = shown((inner + sphere(4).coloured("blue")).dressed(material("outer", colour="green")))
    worn = {mesh.owners[i][-1]: (look.material.name, look.colour) for i, look in enumerate(paint.looks)}
    assert sorted(worn.values()) == [("inner", "#ff0000"), ("outer", "#0000ff")]


TILTED = Camera((3.0, -9.0, 30.0), (0.0, 0.0, 0.0), view_angle=20.0)
SUN = light("sun", direction=(0.5, 0.4, -1.0))
CHALK = {"ambient": 0.0, "diffuse": 1.0, "specular": 0.3, "shininess": 12.0, "colour": "#a0a0a0"}


def level(plate, camera=TILTED):
    """The grey level in the middle of the picture of a plate's upper side."""
    document, mesh, paint = shown(plate, SUN)
    return picture([(mesh, paint)], SIZE, camera, lights=document.lights)[55:65, 65:75].astype(float).mean()


def tilted(slope):
    """The same by the equation, of a plane that rises by `slope` along x."""
    eye = Eye(np.array(TILTED.position), frame(TILTED))
    normal = np.array((-slope, 0.0, 1.0))
    value = terms(np.zeros((1, 3)), normal, eye, Material("m", **CHALK), np.full(3, 160 / 255), (SUN,)).clamped
    return 255.0 * value[0, 0]


@pytest.fixture
def ramp(written):
    """Heights that rise by one level a texel, to the right."""
    return written(np.tile(np.arange(256.0)[None, :, None], (8, 1, 3)), "ramp.png")


def plate(**values):
    lies = {"projection": "planar", "size": (20, 20), "origin": (-10, -10, 0), **values.pop("lies", {})}
    return box(20, 20, 2, centred=True).at(0, 0, -1).dressed(material("m", **CHALK, **values), texture(**lies))


@pytest.mark.parametrize(("lies", "sign"), [({}, 1), ({"mirror": (True, False)}, -1), ({"turned": (0, 0, 180)}, -1),
                                            ({"mirror": (False, True)}, 1)])  # fmt: skip
def test_a_tilted_plane_of_heights_lights_like_the_tilted_plane(ramp, lies, sign):
    """256 levels over 20 mm: 6 mm of height are a slope of 6 / 255 * 256 / 20; mirrored, the slope is the other way."""
    if lies.get("turned"):
        lies = {**lies, "origin": (10, 10, 0)}
    slope = sign * 6.0 / 255.0 * 256.0 / 20.0
    assert abs(tilted(slope) - tilted(0.0)) > 10.0
    assert level(plate(bump=ramp, bump_height=6.0, wrap="clamp", lies=lies)) == pytest.approx(tilted(slope), abs=2.0)
    assert level(plate()) == pytest.approx(tilted(0.0), abs=2.0)


def test_a_bump_on_a_mirrored_solid_is_mirrored_with_it(ramp):
    slope = 6.0 / 255.0 * 256.0 / 20.0
    bumped = plate(bump=ramp, bump_height=6.0, wrap="clamp")
    assert level(bumped.mirrored((1, 0, 0))) == pytest.approx(tilted(-slope), abs=2.0)
    assert level(bumped.mirrored((0, 1, 0))) == pytest.approx(tilted(slope), abs=2.0)


def test_a_normal_map_tilts_as_its_normals_say(written):
    """One normal everywhere, that of a plane that rises by 0.3 along u."""
    normal = np.array((-0.3, 0.0, 1.0)) / np.hypot(0.3, 1.0)
    flat = written(np.tile((normal + 1.0) * 127.5, (4, 4, 1)), "normals.png")
    found = level(plate(bump=flat, bump_kind="normals"))
    assert found == pytest.approx(tilted(0.3), abs=2.5)
    assert level(plate(bump=flat, bump_kind="normals", lies={"mirror": (True, False)})) == pytest.approx(
        tilted(-0.3), abs=2.5
    )


def test_flat_and_gouraud_leave_bumps_out(ramp):
    for shading in ("flat", "gouraud"):
        bumped = level(plate(bump=ramp, bump_height=6.0, shading=shading))
        assert bumped == pytest.approx(level(plate(shading=shading)), abs=0.5)


@pytest.mark.parametrize("mode", ["zbuffer", "bsp"])
def test_texels_of_the_key_and_alpha_let_through_what_is_behind(written, mode):
    """A wall of which the left half is keyed away, before a red one."""
    texels = np.full((8, 8, 3), 255.0)
    texels[:, :4] = (255, 0, 255)
    front = box(20, 1, 20, centred=True).at(y=-10).dressed(
        material("grid", texture=written(texels), key="#ff00ff", wrap="clamp", **GLOW),
        texture(projection="planar", size=(20, 20), origin=(-10, 0, -10), turned=(90, 0, 0)),
    )  # fmt: skip
    behind = box(20, 1, 20, centred=True).at(y=10).dressed(material("red", colour="red", **GLOW))
    solids = [shown(front, FLOOD)[1:], shown(behind, FLOOD)[1:]]
    camera = Camera((0.0, -60.0, 0.0), (0.0, 0.0, 0.0), parallel=True, parallel_scale=12.0)
    found = picture(solids, SIZE, camera, lights=(FLOOD,), hidden_surface=mode).astype(int)
    assert np.abs(found[60, 40] - (255, 0, 0)).max() <= 2
    assert np.abs(found[60, 100] - (255, 255, 255)).max() <= 2


def test_reflections_come_from_the_panorama_and_light_maps_scale_light(written):
    """A mirror that looks at the eye from the front shows what is behind the eye; half of the light is half as much."""
    room = np.zeros((64, 128, 3))
    room[:, 88:104] = (0, 200, 0)  # u from 0.69 to 0.81: around -y
    mirror_like = material("mirror", reflection=written(room, "room.png"), reflectivity=1.0)
    camera = Camera((0.0, -60.0, 0.0), (0.0, 0.0, 0.0), view_angle=30.0)
    _, mesh, paint = shown(box(20, 1, 20, centred=True).dressed(mirror_like))
    found = picture([(mesh, paint)], SIZE, camera)[60, 70].astype(int)
    assert np.abs(found - (0, 200, 0)).max() <= 3
    grey = written(np.full((2, 2, 3), 51.0), "grey.png")
    whole, dim = (
        level(plate(**{**extra}))
        for extra in ({}, {"light_map": grey})
    )  # fmt: skip
    assert dim == pytest.approx(0.2 * whole, abs=2.0)


def test_large_bitmaps_lie_in_tiles_and_are_read_at_the_size_wanted(tmp_path):
    """A ramp of 5,000 by 4,000 pixels, more than are held at once: what is read is its mean over squares."""
    across = (np.arange(5000) * 255 // 4999).astype(np.uint8)
    plain = np.full((4000, 5000), 9, np.uint8)
    pixels = np.dstack((np.tile(across, (4000, 1)), plain, plain))
    Image.fromarray(pixels).save(tmp_path / "large.png", compress_level=1)
    sha = keep_bitmap(tmp_path / "large.png")
    whole = texels_of(sha)
    np.testing.assert_array_equal(whole[..., :3], pixels)
    assert tiles_path(default_store().path(sha)).exists()
    small = small_texels(sha, 256)
    assert small.shape[:2] == (125, 157)
    expected = pixels[:4000, : 156 * 32].reshape(125, 32, 156, 32, 3).mean(axis=(1, 3))
    assert np.abs(small[:, :156, :3] - expected).max() <= 1.5
    file = TiledFile(tiles_path(default_store().path(sha)))
    level_of(file, 256)
    assert file.bytes_read < 4 * 256 * 256 * 2
