"""Mesh files read: every format's parts, units, colours and names, and documents made of them."""

import time
from pathlib import Path

import numpy as np
import pytest
from mesh_files import CORNERS, CUBE, GOOD, MESH, PLAIN, QUADS, area, gltf, obj, stl, threemf, volume

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.primitives import Box, ImportedMesh
from solidtree.model.exchange import meshes_in
from solidtree.model.exchange.meshes_in import import_file, parts_of_asset, read_any, read_mesh_file
from solidtree.model.exchange.meshes_out import OutSolid, write_meshes
from solidtree.model.project.assets import AssetStore
from solidtree.model.project.project_file import save_project


@pytest.mark.parametrize(("file_format", "data"), GOOD)
def test_a_unit_cube_in_every_dialect(file_format, data):
    (part,) = read_mesh_file(data, file_format)
    assert volume(part) == 1 and area(part) == 6
    assert part.vertices.shape == (8, 3) and part.vertices.dtype == np.float64
    assert part.triangles.shape == (12, 3) and part.triangles.dtype == np.int32
    assert part.closed and part.fault is None and part.unit == 1
    assert not part.vertices.flags.writeable and not part.triangles.flags.writeable


def test_glb_is_metres_with_y_up():
    moved = gltf(nodes=[{"children": [1], "translation": [1, 0, 0]}, {"mesh": 0, "scale": [1, 2, 1], "name": "post"}])
    (part,) = read_mesh_file(moved, "gltf")
    assert part.name == "post" and part.unit == 1000 and part.closed
    assert part.vertices.min(axis=0).tolist() == [1000, -1000, 0]
    assert part.vertices.max(axis=0).tolist() == [2000, 0, 2000]
    assert volume(part) == pytest.approx(2e9)


def test_a_mirrored_node_stays_outside_out():
    (part,) = read_mesh_file(gltf(nodes=[{"mesh": 0, "scale": [-1, 1, 1]}]), "gltf")
    assert volume(part) == pytest.approx(1e9)
    item = '<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>'
    (part,) = read_mesh_file(threemf(PLAIN.replace('<item objectid="1"/>', item)), "3mf")
    assert volume(part) == 1 and part.vertices[:, 0].min() == -1


@pytest.mark.parametrize(("unit", "factor"), [("micron", 0.001), ("inch", 25.4), ("meter", 1000.0)])
def test_units_of_3mf_become_millimetres(unit, factor):
    (part,) = read_mesh_file(threemf(PLAIN, f'unit="{unit}"'), "3mf")
    assert part.unit == factor and volume(part) == pytest.approx(factor**3)


def test_3mf_items_components_names_and_colours():
    body = f"""<resources>
        <basematerials id="9"><base name="a" displaycolor="#FF0000"/><base name="b" displaycolor="#00ff00aa"/>
        </basematerials>
        <object id="1" name="brick" pid="9" pindex="1">{MESH}</object>
        <object id="2" name="pair"><components><component objectid="1"/>
            <component objectid="1" transform="2 0 0 0 2 0 0 0 2 10 0 0"/></components></object>
        </resources><build><item objectid="2"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 5"/></build>"""
    pair, brick = read_mesh_file(threemf(body), "3mf")
    assert (pair.name, brick.name) == ("pair", "brick")
    assert volume(pair) == pytest.approx(9) and pair.vertices[:, 0].max() == 12
    assert brick.colour == pair.colour == "#00ff00" and brick.vertices[:, 2].min() == 5


def test_3mf_meshes_in_other_files_of_the_package():
    core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    other = f'<model xmlns="{core}"><resources><object id="1">{MESH}</object></resources><build/></model>'
    body = """<resources><object id="5"><components><component objectid="1" p:path="/3D/other.model"/></components>
        </object></resources><build><item objectid="5"/></build>"""
    (part,) = read_mesh_file(threemf(body, more=[("3D/other.model", other)]), "3mf")
    assert volume(part) == 1


def test_obj_objects_are_parts_and_regions_of_one_surface_are_not():
    two = obj().replace(b"f ", b"o first\nf ", 1) + b"o second\n" + obj(offset=9)
    first, second = read_mesh_file(two, "obj")
    assert (first.name, second.name) == ("first", "second") and volume(first) == volume(second) == 1
    groups = obj().replace(b"f ", b"g lower\nf ", 1) + b"g upper\n" + obj(offset=-8)
    assert [part.name for part in read_mesh_file(groups, "obj")] == ["lower", "upper"]
    regions = b"o cube\n" + obj(QUADS[:3]) + b"g rest\n" + obj(QUADS[3:])[len(obj([])) :]
    (part,) = read_mesh_file(regions, "obj")
    assert part.name == "cube" and part.closed and volume(part) == 1


def test_obj_takes_its_colours_from_the_file_beside_it_and_from_nowhere_else(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "paint.mtl").write_text("newmtl red\nKd 1 0 0\n")
    (tmp_path / "secret.mtl").write_text("newmtl red\nKd 0 0 1\n")
    for name, colour in (("paint.mtl", "#ff0000"), ("../secret.mtl", None)):
        path = tmp_path / "in" / "cube.obj"
        path.write_bytes(f"mtllib {name}\nusemtl red\n".encode() + obj())
        assert import_file(path, AssetStore(tmp_path / "assets")).solids[0].colour == colour


def test_colours_of_gltf_are_linear():
    material = {"pbrMetallicRoughness": {"baseColorFactor": [1.0, 0.2158605, 0.0, 1.0]}}
    mesh = {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}
    assert read_mesh_file(gltf(materials=[material], meshes=[mesh]), "gltf")[0].colour == "#ff8000"


def test_open_edges_are_counted():
    (part,) = read_mesh_file(stl(CORNERS[CUBE[:-1]]), "stl")
    assert part.fault == "is not closed: 3 open edges"
    (part,) = read_mesh_file(stl(CORNERS[[*CUBE, CUBE[0]]]), "stl")
    assert part.fault == "is not closed: 3 overused edges"
    (part,) = read_mesh_file(stl(CORNERS[[*CUBE[1:], CUBE[0][::-1]]]), "stl")
    assert part.fault == "is not closed: 3 inconsistent edges"


def test_vertices_are_welded_only_where_the_file_does_not_say_better():
    # Two cubes that share an edge: as a solid it needs the edge twice, and the indices tell which faces go together.
    both = np.concatenate((CORNERS, CORNERS + np.array([1, 1, 0])))
    faces = np.concatenate((CUBE, CUBE + 8))
    text = "".join("v {} {} {}\n".format(*p) for p in both) + "".join("f {} {} {}\n".format(*f) for f in faces + 1)
    (kept,) = read_mesh_file(text.encode(), "obj")
    (welded,) = read_mesh_file(stl(both[faces]), "stl")
    assert len(kept.vertices) == 16 and len(welded.vertices) == 14
    assert kept.closed and kept.edge_faults.nonmanifold == 0 and welded.edge_faults.nonmanifold == 1
    # A cube with each face for itself, as files with hard normals have it.
    (part,) = read_mesh_file(gltf(), "gltf")
    assert len(part.vertices) == 8


def test_minus_zero_and_flat_triangles():
    soup = CORNERS[CUBE].copy()
    soup[0][soup[0] == 0] = -0.0
    flat = np.array([CORNERS[[0, 0, 1]]])
    (part,) = read_mesh_file(stl(np.concatenate((soup, flat))), "stl")
    assert len(part.vertices) == 8 and len(part.triangles) == 12
    assert not np.signbit(part.vertices).any()


def test_a_mesh_file_becomes_a_document(tmp_path):
    store = AssetStore(tmp_path / "assets")
    path = tmp_path / "bench.obj"
    path.write_bytes(obj().replace(b"f ", b"o seat\nf ", 1) + b"o seat\n" + b"o leg\n" + obj(offset=9))
    document = import_file(path, store)
    seat, leg = document.solids
    assert isinstance(seat, ImportedMesh) and (seat.name, leg.name, leg.part) == ("seat", "leg", 1.0)
    assert seat.asset == leg.asset and store.read(seat.asset) == path.read_bytes()
    parts = parts_of_asset(seat.asset, seat.file_format, store)
    assert volume(parts[0]) == 1 and parts_of_asset(seat.asset, "obj", store) is parts
    plain = tmp_path / "my part.stl"
    plain.write_bytes(stl(CORNERS[CUBE]))
    assert [root.name for root in import_file(plain, store).solids] == ["my part"]


def test_the_memory_of_parts_is_bounded(tmp_path, monkeypatch):
    store = AssetStore(tmp_path)
    monkeypatch.setattr(meshes_in, "_CACHE_BYTES", 1000)
    shas = [store.put(stl(CORNERS[CUBE] + i)) for i in range(6)]
    found = [parts_of_asset(sha, "stl", store) for sha in shas]
    assert parts_of_asset(shas[-1], "stl", store) is found[-1]
    assert parts_of_asset(shas[0], "stl", store) is not found[0]


@pytest.mark.parametrize(("file_format", "data"), GOOD)
def test_the_content_tells_the_format_whatever_the_ending(tmp_path, file_format, data):
    for ending in (file_format.upper(), *(["txt"] if file_format != "obj" else [])):
        path = tmp_path / f"cube.{ending}"
        path.write_bytes(data)
        (node,) = read_any(path, AssetStore(tmp_path / "assets")).solids
        assert node.file_format == file_format


def test_read_any_opens_projects_too(tmp_path):
    project = tmp_path / "box.solidtree"
    save_project(Document(solids=(Box(name="crate"),)), project)
    assert read_any(project).solids[0].name == "crate"
    renamed = project.rename(tmp_path / "box.zip")
    assert read_any(renamed).solids[0].name == "crate"
    for name, data, words in (
        ("a.solidtree", b"PK\3\4 cut", "is no Solidtree project: it is cut short"),
        ("a.solidtree", b"text", "is no Solidtree project: it is not a zip file"),
        ("a.3mf", b"PK\3\4 cut", "is no 3MF file"),
        ("a.step", b"ISO-10303-21;", "is of no kind that can be opened; known are .solidtree, .stl, .3mf, .obj"),
        ("a", b"", "is empty"),
    ):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(Refusal, match=words.replace(".", r"\.")):
            read_any(tmp_path / name)
    with pytest.raises(Refusal, match="there is no such file"):
        read_any(tmp_path / "none.stl")


# Read though one of the corpus's parsers refuses it, or the 3MF test suite says that it must fail.
def test_large_files_of_each_format_are_read_in_time(tmp_path):
    # A guard against a loop over vertices; the ratio to other readers is measured in bench/.
    n = 150
    u, v = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a, b = u * 2 * np.pi / n, v * 2 * np.pi / n
    around = np.stack(((3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)), axis=-1)
    a, b, c, d = (i % n * n + j % n for i, j in ((u, v), (u + 1, v), (u + 1, v + 1), (u, v + 1)))
    faces = np.concatenate((np.stack((a, b, c), -1).reshape(-1, 3), np.stack((a, c, d), -1).reshape(-1, 3)))
    for ending in ("stl", "3mf", "obj", "ply", "off", "glb"):
        path = Path(tmp_path, f"torus.{ending}")
        write_meshes(path, [OutSolid("torus", None, around.reshape(-1, 3), faces)])
        start = time.monotonic()
        (part,) = read_mesh_file(path, ending)
        assert time.monotonic() - start < 5
        assert part.closed and len(part.triangles) == 2 * n * n and len(part.vertices) == n * n
