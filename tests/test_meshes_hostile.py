"""Mesh files that are wrong, damaged or forged, and files of third parties with figures to compare with."""

import json
import struct
import time
import warnings

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mesh_files import (
    CORNERS,
    CUBE,
    GOOD,
    MESH,
    PLAIN,
    QUADS,
    area,
    gltf,
    obj,
    off,
    ply,
    stl,
    stl_text,
    threemf,
    volume,
)

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange import meshes_in
from solidtree.model.exchange.meshes_in import import_file, read_mesh_file
from solidtree.model.project.assets import AssetStore


def refusal_of(data, file_format):
    start = time.monotonic()
    with pytest.raises(Refusal) as caught, warnings.catch_warnings():
        warnings.simplefilter("error")
        read_mesh_file(data, file_format)
    message = str(caught.value)
    assert time.monotonic() - start < 10
    assert message.isprintable() and "Error(" not in message
    return message


@pytest.mark.parametrize(
    ("file_format", "data", "words"),
    [
        ("stl", b"", "is empty, no STL file"),
        ("stl", b"\0" * 500, "is empty"),
        ("stl", b"<!DOCTYPE html>\n<html><body>" + b"no " * 50, "is text, not STL: it begins with “<!DOCTYPE html>”"),
        ("stl", b"Dear all,\nthe model is\n" * 30, "is text, not STL"),
        ("stl", stl(CORNERS[CUBE])[:-60], "its header tells of 12 triangles, which take 684 bytes; the file has 624"),
        ("stl", b"\1" * 40, "at least 84 bytes"),
        ("stl", b"\1" * 80 + b"\xff" * 90, "4,294,967,295 triangles"),
        ("stl", stl(CORNERS[CUBE] * np.nan), "vertex 1 has a coordinate that is no finite number"),
        ("stl", stl_text(CORNERS[CUBE]).replace(b"vertex 0 1 1", b"vertex 0 1,0 1", 1), "line 6: “vertex 0 1,0 1”"),
        ("stl", stl_text(CORNERS[CUBE])[:-9], "“endsolid” is missing"),
        ("stl", stl_text(CORNERS[CUBE]).replace(b"vertex 1 1 1", b"vertex nan 1 1"), "no finite number"),
        ("stl", stl_text([]), "holds no triangles"),
        ("obj", b"v 0 0 0\nv 1 0 0\n", "holds no triangles"),
        ("obj", obj([[0, 1, 9]]), "line 9: the face asks for vertex 10; there are 8"),
        ("obj", obj([[0, 1, -12]]), "line 9: the face asks for vertex -11"),
        ("obj", obj([[0, 1, 2]]) + b"f 1 2 x\n", "line 10: “f 1 2 x” is no face"),
        ("obj", b"v 0 0\n" + obj(), "line 1: “v 0 0” is no vertex"),
        ("obj", b"v 0 0 3.1+e2\n" + obj(), "line 1: “v 0 0 3.1+e2” is no vertex"),
        ("ply", ply(QUADS)[:60], "has no “end_header”"),
        ("ply", ply(QUADS)[:-30], "is cut short"),
        ("ply", ply(QUADS).replace(b"vertex 8", b"vertex 999999999"), "is cut short: its header promises 999,999,999"),
        ("ply", ply(QUADS).replace(b"face 6", b"face -6"), "line 7"),
        ("ply", ply(QUADS).replace(b"float x", b"quad x"), "line 4: “property quad x”"),
        ("ply", ply(QUADS).replace(b"float x", b"float u"), "line 3: the vertices of this PLY file have no x, y and z"),
        ("ply", ply([[0, 1, 99]]), "triangle 1 asks for vertex 99 of 8"),
        ("ply", ply(QUADS, "").replace(b"1.0 1.0 1.0", b"1.0 one 1.0"), "line 17: “1.0 one 1.0” is no row of numbers"),
        ("off", b"OOF\n8 6 12\n", "is no OFF file: it begins with “OOF”"),
        ("off", b"OFF\n", "does not tell the numbers"),
        ("off", b"OFF BINARY\n1 1 1\n", "of a kind that is not read"),
        ("off", b"OFF\n1000000000 1 1\n0 0 0\n", "promises 1,000,000,000 vertices"),
        ("off", off(faces=[[0, 1, 8]]), "line 12: the face asks for vertex 8; there are 8, counted from 0"),
        ("off", off().replace(b"4 0 1 3 2", b"4 0 1 3 -2"), "line 12: the face asks for vertex -2; there are 8"),
        ("off", off().replace(b"1.0 1.0 1.0", b"1.0 1.0 e"), "line 11: “1.0 1.0 e” is no vertex"),
        ("3mf", b"PK\3\4" + b"x" * 90, "is no 3MF file: it is cut short or damaged"),
        ("3mf", threemf(PLAIN, start="/3D/none.model"), "3D/none.model is missing from the file"),
        ("3mf", threemf(PLAIN, start="http://x/y.model"), "is missing"),
        ("3mf", threemf(PLAIN, 'unit="furlong"'), "'furlong' is no unit"),
        ("3mf", threemf(PLAIN, 'requiredextensions="p x"'), "needs the extension x"),
        ("3mf", threemf(PLAIN + "<"), "line 1, column"),
        ("3mf", threemf(PLAIN.replace('v1="0"', 'v1="8"', 1)), "triangle 1 asks for vertex 8 of 8"),
        ("3mf", threemf(PLAIN.replace('x="0.0"', 'x="zero"', 1)), "hold 'zero', which is no number"),
        ("3mf", threemf(PLAIN.replace('x="0.0"', 'x="inf"', 1)), "no finite number"),
        ("3mf", threemf(PLAIN.replace('x="0.0"', "", 1)), "a vertex has no x"),
        ("3mf", threemf(PLAIN.replace('objectid="1"', 'objectid="2"')), "line 1: there is no object 2"),
        ("3mf", threemf(PLAIN.replace('objectid="1"', 'objectid="1" transform="1 2 3"')), "must be 12 numbers"),
        (
            "3mf",
            threemf(PLAIN.replace(MESH, '<components><component objectid="1"/></components>')),
            "object 1 holds itself, or far too many components",
        ),
        ("gltf", b"{", "is damaged: its JSON, line 1, column 2"),
        ("gltf", b'{"asset": 3}', "is damaged"),
        ("gltf", gltf(asset={"version": "1.0"}), "is no glTF 2.0 file"),
        ("gltf", gltf(buffers=[{"byteLength": 168, "uri": "cube.bin"}]), "has its data in another file, 'cube.bin'"),
        ("gltf", gltf(buffers=[{"byteLength": 168, "uri": "data:;base64,@@"}]), "not base64"),
        ("gltf", gltf(extensionsRequired=["KHR_draco_mesh_compression"]), "needs the extension KHR_draco"),
        ("gltf", gltf(nodes=[{"mesh": 0, "children": [0]}]), "node 0 has two places, or goes in a circle"),
        ("gltf", gltf(nodes=[{"mesh": 7}]), "there is no mesh 7"),
        ("gltf", gltf(bufferViews=[{"buffer": 0, "byteLength": 1 << 60}] * 2), "asks for 1,152,921,504,606,846,976"),
        (
            "gltf",
            gltf(accessors=[{"componentType": 5126, "type": "VEC3", "count": 1 << 40}] * 2),
            "triangles; up to 20,000,000 are read",
        ),
        ("glb", b"glTF\2\0\0\0\xff\xff\0\0" + b"\0" * 30, "is cut short: it should have 65,535 bytes and has 42"),
        ("step", b"ISO-10303", "'step' is no format that can be read"),
    ],
)  # fmt: skip
def test_bad_files_are_refused_with_the_place(file_format, data, words):
    assert words in refusal_of(data, file_format)


def test_bombs_are_refused_before_they_unpack():
    spaces = threemf(PLAIN.replace("<build>", "<!--" + " " * 60_000_000 + "--><build>"))
    assert "3D/3dmodel.model unpacks to more than" in refusal_of(spaces, "3mf")
    laughs = '<!DOCTYPE l [<!ENTITY a "aaaaaaaaaa">]>'
    space = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    bomb = threemf(
        PLAIN, more=[("3D/evil.model", f'{laughs}<model xmlns="{space}">&a;</model>')], start="/3D/evil.model"
    )
    assert "a document type is not allowed" in refusal_of(bomb, "3mf")
    below = '<component objectid="{}"/>'
    doubling = f'<object id="1">{MESH}</object>' + "".join(
        f'<object id="{i}"><components>{2 * below.format(i - 1)}</components></object>' for i in range(2, 40)
    )
    body = f'<resources>{doubling}</resources><build><item objectid="39"/></build>'
    assert "far too many components" in refusal_of(threemf(body), "3mf")
    many = b"".join(b"g %d\nf 1 2 3\n" % i for i in range(20_000))
    assert "has 20,000 solids" in refusal_of(obj([]) + many, "obj")


@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    st.sampled_from([*GOOD, ("gltf", gltf()), ("glb", None)]),
    st.lists(st.tuples(st.floats(0, 1), st.integers(0, 255)), max_size=8),
    st.one_of(st.none(), st.floats(0, 1)),
)
def test_damaged_files_are_read_or_refused(good, changes, cut):
    file_format, data = good
    if data is None:
        text = gltf()
        data = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text
    raw = bytearray(data)
    for place, value in changes:
        raw[int(place * (len(raw) - 1))] = value
    try:
        parts = read_mesh_file(bytes(raw[: int(cut * len(raw))] if cut is not None else raw), file_format)
    except Refusal as refusal:
        assert str(refusal).isprintable() and str(refusal) != meshes_in.UNFORESEEN
    else:
        assert all(np.isfinite(part.vertices).all() and len(part.triangles) for part in parts)


# Read though one of the corpus's parsers refuses it, or the 3MF test suite says that it must fail.
DEVIATIONS = {
    "trimesh/whitespace.off": "the counts follow the word OFF without a space; nothing else is meant by it",
    "3mf-samples/MUSTFAIL/MUSTFAIL_Chapter2.3.2c_UndefinedNameSpaceInXDS.3mf": "PrusaSlicer writes such attributes",
    "3mf-samples/MUSTFAIL/MUSTFAIL_Chapter3.4.1a_MissingMetadataName.3mf": "the suite's own MUSTPASS 3.4.1c is alike",
}


def test_files_of_third_parties(corpus, tmp_path):
    expected = json.loads((corpus / "mesh" / "expected.json").read_text(encoding="utf-8"))
    store = AssetStore(tmp_path)
    wrong = []
    for name, figures in expected.items():
        path = corpus / "mesh" / name
        want = figures.get("independent")
        fails = want is None or not want["triangles"] or "MUSTFAIL" in name
        start = time.monotonic()
        try:
            parts = read_mesh_file(path, path.suffix[1:].lower())
        except Refusal as refusal:
            if not fails or not str(refusal).isprintable():
                wrong.append(f"{name}: refused: {refusal}")
            continue
        if time.monotonic() - start > 5 or fails:
            if name not in DEVIATIONS:
                wrong.append(f"{name}: read")
            continue
        wrong += [f"{name}: {fault}" for fault in deviations(parts, want, path.suffix == ".glb")]
        assert len(import_file(path, store).solids) == len(parts)
    assert not wrong, "\n".join(wrong)


def deviations(parts, want, turned):
    """Where the parts differ from the expected figures, which are in the file's units; `turned`: with y up."""
    unit = parts[0].unit
    count = sum(len(part.triangles) for part in parts)
    if not want["triangles"] <= count <= want["triangles"] + want["degenerate_dropped"]:
        yield f"{count} triangles, not {want['triangles']}"
    total = sum(area(part) for part in parts) / unit**2
    if total != pytest.approx(want["area"], rel=1e-5):
        yield f"area {total}, not {want['area']}"
    low, high = np.array(want["bbox"])
    if turned:
        low, high = np.array([low[0], -high[2], low[1]]), np.array([high[0], -low[2], high[1]])
    bounds = np.array([[p.vertices.min(axis=0) for p in parts], [p.vertices.max(axis=0) for p in parts]]) / unit
    if np.abs(bounds[0].min(axis=0) - low).max() > 1e-5 * max(1, np.abs([low, high]).max()):
        yield f"bounds {bounds[0].min(axis=0)}, not {low}"
    if np.abs(bounds[1].max(axis=0) - high).max() > 1e-5 * max(1, np.abs([low, high]).max()):
        yield f"bounds {bounds[1].max(axis=0)}, not {high}"
    if want["closed_2manifold"]:
        if any(part.edge_faults.open or part.edge_faults.nonmanifold for part in parts):
            yield f"open: {[part.fault for part in parts]}"
        elif not any(part.edge_faults.turned for part in parts):  # which the expected figures do not look at
            volumes = sum(volume(part) for part in parts) / unit**3
            if volumes != pytest.approx(want["volume"], rel=1e-5):
                yield f"volume {volumes}, not {want['volume']}"
    elif len(parts) == 1 and (part := parts[0]).edge_faults.open != want["boundary_edges"]:
        yield f"{part.edge_faults.open} open edges, not {want['boundary_edges']}"
