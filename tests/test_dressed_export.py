"""Materials, textures and coordinates in GLB and OBJ, read back by trimesh."""

import json
import struct

import numpy as np
import pytest
import trimesh
from PIL import Image

from solidtree.model.document.errors import Refusal
from solidtree.model.script import box, cylinder, document_of, material, save, sphere, texture

TEXELS = np.random.default_rng(3).integers(0, 255, (16, 32, 3)).astype(np.uint8)


@pytest.fixture
def wood(tmp_path):
    Image.fromarray(TEXELS).save(tmp_path / "wood.png")
    return tmp_path / "wood.png"


def content(path):
    data = path.read_bytes()
    (length,) = struct.unpack("<I", data[12:16])
    return json.loads(data[20 : 20 + length])


def meshes(path):
    scene = trimesh.load(path, process=False)
    return list(scene.geometry.values()) if isinstance(scene, trimesh.Scene) else [scene]


@pytest.mark.parametrize("ending", ["glb", "obj"])
def test_a_planar_texture_comes_back_with_its_formula_and_its_bitmap(tmp_path, wood, ending):
    lies = texture(projection="planar", size=(20, 10), offset=(0.25, 0))
    save(tmp_path / f"a.{ending}", box(10, 8, 6).dressed(material("oak", texture=wood), lies))
    (mesh,) = meshes(tmp_path / f"a.{ending}")
    points = mesh.vertices @ ([[1000, 0, 0], [0, 0, 1000], [0, -1000, 0]] if ending == "glb" else np.eye(3))
    np.testing.assert_allclose(
        mesh.visual.uv, np.column_stack((points[:, 0] / 20 - 0.25, points[:, 1] / 10)), atol=1e-6
    )
    image = mesh.visual.material.baseColorTexture if ending == "glb" else mesh.visual.material.image
    np.testing.assert_array_equal(np.asarray(image)[..., :3], TEXELS)
    assert mesh.volume == pytest.approx((480e-9 if ending == "glb" else 480.0), rel=1e-5)


@pytest.mark.parametrize("ending", ["glb", "obj"])
def test_spheres_have_no_triangle_across_the_seam_and_cuts_keep_the_formula(tmp_path, wood, ending):
    ball = sphere(10, segments=32).dressed(material("skin", texture=wood))
    save(tmp_path / f"a.{ending}", ball - cylinder(3, 40, centred=True))
    whole = meshes(tmp_path / f"a.{ending}")
    skin = max(whole, key=lambda mesh: len(mesh.faces))
    points = skin.vertices @ ([[1000, 0, 0], [0, 0, 1000], [0, -1000, 0]] if ending == "glb" else np.eye(3))
    round_ = np.linalg.norm(points, axis=1) > 9.8  # trimesh may give both coats in one
    faces = skin.faces[round_[skin.faces].all(axis=1)]
    assert len(faces) > 200
    assert np.ptp(skin.visual.uv[faces][..., 0], axis=1).max() < 0.5
    at = np.unique(faces)
    u, v = skin.visual.uv[at].T
    x, y, z = points[at].T
    np.testing.assert_allclose((u - np.arctan2(y, x) / (2 * np.pi) + 0.5) % 1.0, 0.5, atol=1e-5)
    np.testing.assert_allclose(v, np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5, atol=1e-5)


def test_glb_holds_each_material_and_bitmap_once(tmp_path, wood):
    oak = material("oak", texture=wood, wrap="mirror", bump=wood, opacity=0.5)
    parts = [box(10).dressed(oak), box(10).at(20).dressed(oak), (box(5) + sphere(2).dressed(oak)).at(40)]
    save(tmp_path / "a.glb", *parts, box(4).at(60).coloured("red"))
    found = content(tmp_path / "a.glb")
    assert len(found["images"]) <= 3  # the bitmap, and normals of one or two densities
    names = [row["name"] for row in found["materials"]]
    assert "#ff0000" in names and names.count("oak") <= 2
    oaks = [row for row in found["materials"] if row["name"] == "oak"]
    assert all(row["alphaMode"] == "BLEND" for row in oaks)
    assert all(row["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.5 for row in oaks)
    assert found["samplers"][0]["wrapS"] == 33648
    primitives = [primitive for mesh in found["meshes"] for primitive in mesh["primitives"]]
    assert sum("TEXCOORD_0" in primitive["attributes"] for primitive in primitives) == 3
    assert all(view["byteOffset"] % 4 == 0 for view in found["bufferViews"])


def test_a_normal_map_has_the_slope_of_the_heights(tmp_path):
    """256 levels over 20 mm and 4 mm high: the slope is 4 / 255 * 256 / 20."""
    Image.fromarray(np.tile(np.arange(256, dtype=np.uint8), (8, 1))).save(tmp_path / "ramp.png")
    bumped = material("m", bump=tmp_path / "ramp.png", bump_height=4, wrap="clamp")
    save(tmp_path / "a.glb", box(20, 20, 1).dressed(bumped, texture(projection="box", size=(20, 20))))
    (mesh,) = meshes(tmp_path / "a.glb")
    normals = np.asarray(mesh.visual.material.normalTexture)[4, 128, :3] / 127.5 - 1.0
    assert -normals[0] / normals[2] == pytest.approx(4 / 255 * 256 / 20, abs=0.01)


def test_the_key_becomes_alpha(tmp_path):
    texels = np.zeros((2, 2, 3), np.uint8)
    texels[0, 0] = (255, 0, 255)
    Image.fromarray(texels).save(tmp_path / "key.bmp")
    save(tmp_path / "a.glb", box(5).dressed(material("m", texture=tmp_path / "key.bmp", key="#ff00ff")))
    (mesh,) = meshes(tmp_path / "a.glb")
    alpha = np.asarray(mesh.visual.material.baseColorTexture)[..., 3]
    np.testing.assert_array_equal(alpha, [[0, 255], [255, 255]])


def test_obj_names_files_that_are_there(tmp_path, wood):
    named = material("my oak / “best”", "Brass", texture=wood, bump=wood, wrap="clamp")
    save(tmp_path / "a part.obj", box(5).dressed(named), box(5).at(9).coloured("#102030"))
    text = (tmp_path / "a part.mtl").read_text()
    files = {path.name for path in tmp_path.iterdir()}
    for row in text.splitlines():
        if row.startswith("map_"):
            assert row.split()[-1] in files and "-clamp on" in row
    assert "newmtl my_oak_best" in text and "Ns 28" in text and "newmtl 102030" in text
    assert (tmp_path / "a part.obj").read_text().splitlines()[1] == "mtllib a part.mtl"


def test_without_materials_files_are_as_ever(tmp_path):
    save(tmp_path / "a.obj", box(5).coloured("red"))
    assert not (tmp_path / "a.mtl").exists()
    save(tmp_path / "a.glb", box(5))
    assert "materials" not in content(tmp_path / "a.glb")


def test_a_missing_bitmap_is_told_and_nothing_is_written(tmp_path):
    document = document_of(box(5).dressed(material("oak", texture="ab" * 32)))
    with pytest.raises(Refusal, match="the material “oak”: its bitmap is missing"):
        save(tmp_path / "a.glb", document)
    assert not (tmp_path / "a.glb").exists()


def rows_of(path):
    return [line.split() for line in path.read_text().splitlines()]


def test_bare_solids_wear_nothing_of_the_one_before_in_obj(tmp_path, wood):
    solids = [box(5).dressed(material("oak", texture=wood)), box(5).at(9), box(5).at(20).coloured("#102030")]
    save(tmp_path / "a.obj", *solids, box(5).at(30) + box(2).dressed(material("wax")).at(34))
    worn, names = None, []
    for word, *rest in rows_of(tmp_path / "a.obj"):
        if word == "o":
            names.append(set())
        elif word == "usemtl":
            worn = rest[0]
        elif word == "f":
            names[-1].add(worn)
    assert names[:3] == [{"oak"}, {"bare"}, {"102030"}] and names[3] == {"bare", "wax"}
    defined = {rest[0] for word, *rest in filter(None, rows_of(tmp_path / "a.mtl")) if word == "newmtl"}
    assert set().union(*names) <= defined


def test_normal_maps_stay_normal_maps_in_obj(tmp_path):
    texels = np.full((4, 4, 3), (188, 127, 238), np.uint8)  # leans by about 30 degrees to the right
    Image.fromarray(texels).save(tmp_path / "lean.png")
    worn = material("m", bump=tmp_path / "lean.png", bump_kind="normals", bump_height=1)
    save(tmp_path / "a.obj", box(5).dressed(worn))
    (row,) = (row for row in rows_of(tmp_path / "a.mtl") if row and row[0] == "norm")
    np.testing.assert_allclose(np.asarray(Image.open(tmp_path / row[-1])), texels, atol=2)
    assert "map_Bump" not in (tmp_path / "a.mtl").read_text()


def test_a_normal_map_of_copies_that_are_wider_than_high(tmp_path):
    """Heights along u over copies of 40 by 10 mm: only the width counts for the slope."""
    Image.fromarray(np.tile(np.arange(256, dtype=np.uint8), (8, 1))).save(tmp_path / "ramp.png")
    bumped = material("m", bump=tmp_path / "ramp.png", bump_height=8, wrap="clamp")
    save(tmp_path / "a.glb", box(40, 10, 1).dressed(bumped, texture(projection="planar", size=(40, 10))))
    (mesh,) = meshes(tmp_path / "a.glb")
    normals = np.asarray(mesh.visual.material.normalTexture)[4, 128, :3] / 127.5 - 1.0
    assert -normals[0] / normals[2] == pytest.approx(8 / 255 * 256 / 40, abs=0.01)


@pytest.mark.parametrize("ending", ["stl", "3mf", "ply", "off"])
def test_formats_without_materials_need_no_bitmap(tmp_path, ending):
    save(tmp_path / f"a.{ending}", box(5).dressed(material("oak", texture="ab" * 32)))
    assert (tmp_path / f"a.{ending}").stat().st_size > 80


def test_files_beside_an_obj_differ_in_more_than_capitals_and_keep_short(tmp_path, wood):
    Image.fromarray(255 - TEXELS).save(tmp_path / "other.png")
    names = ["Oak", "oak", "oak_bump", "x" * 150]
    coats = [material(name, texture=wood if n % 2 else tmp_path / "other.png", bump=wood)
             for n, name in enumerate(names)]  # fmt: skip
    save(tmp_path / "a.obj", *(box(5).at(9 * n).dressed(coat) for n, coat in enumerate(coats)))
    textures = [row[-1] for row in rows_of(tmp_path / "a.mtl") if row and row[0] in ("map_Kd", "map_Bump")]
    assert len({name.casefold() for name in textures}) == 8
    assert max(len(name) for name in textures) < 100
    for n, name in enumerate(textures[::2]):
        expected = TEXELS if n % 2 else 255 - TEXELS
        np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / name))[..., :3], expected)
