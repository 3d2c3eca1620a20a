"""Project files from outside: nothing in them is believed, and each is refused in one line or opens."""

import json
import random
import struct
import time
import zipfile
from hashlib import sha256

import pytest
from project_files import CUBE, packed, project, sample

from solidtree.model.document.errors import Refusal
from solidtree.model.project.assets import AssetStore
from solidtree.model.project.project_file import FORMAT, open_project, save_project


@pytest.fixture
def store(tmp_path):
    return AssetStore(tmp_path / "assets")


@pytest.fixture
def document(store):
    return sample(store)


def refusal_of(path, data=None):
    """The one line with which a file is refused, in less than ten seconds."""
    if data is not None:
        path.write_bytes(data)
    start = time.monotonic()
    with pytest.raises(Refusal) as caught:
        open_project(path, AssetStore(path.parent / "opened"))
    message = str(caught.value)
    assert time.monotonic() - start < 10
    assert message and "\n" not in message and "Traceback" not in message and "Error(" not in message
    return message


def test_places_that_cannot_be_read(tmp_path):
    assert refusal_of(tmp_path / "none.solidtree") == "there is no such file or folder"
    assert refusal_of(tmp_path) == "this is a folder, not a file"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "it is not a zip file"),
        (b"solid cube\n" * 50, "it is not a zip file"),
        (packed([("readme.txt", b"hello")]), "holds no document.json"),
        (project(b'{\n  "format": 1,\n  "nodes": {]\n}'), "line 3, column 13"),
        (project(b""), "line 1, column 1"),
        (project(b'{"format": 1, "notes": "\xff"}'), "line 1: byte 24 is not UTF-8"),
        (project(b"[1, 2]"), "the outermost value must be an object"),
        (project(b'{"format": 1,\n"notes": "NaN", "nodes": {"n1": NaN}}'), "line 2: NaN is no number"),
        (project(b'{"format": 1, "nodes": [-Infinity]}'), "-Infinity is no number"),
        (project(b'{"format": 1, "nodes": {"a": {}, "a": {}}}'), "the key 'a' stands twice"),
        (project(b'{"format": ' + b"1" * 5000 + b"}"), "more than 4,300 digits"),
        (project(b"[" * 100_000 + b"]" * 100_000), "nested too deeply"),
        (project(b'{"a":' * 100_000 + b"1" + b"}" * 100_000), "nested too deeply"),
        (project({"nodes": {}}), "“format” must be a whole number"),
        (project({"format": True}), "“format” must be a whole number"),
        (project({"format": 0}), "“format” must be a whole number"),
        (project({"format": 2, "sections": [{"name": "a"}]}), "a section has no field 'active'"),
        (project({"format": 2, "sections": [{"name": "", "point": [0, 0, 0], "normal": [0, 0, 1], "active": True}]}),
         "a section needs a name"),
        (project({"format": 2, "sections": [{"name": "a", "point": [0, 0, 0], "normal": [0, 0, 0], "active": True}]}),
         "section “a”: the normal must be a direction"),
        (project({"format": 2, "sets": [{"name": "a", "values": [["w"]]}]}), "is no pair of a parameter's name"),
        (project({"format": 2, "sets": [{"name": "a", "values": [["w", "=w +"]]}]}), "w +"),
        (project({"format": FORMAT + 1}), f"(format {FORMAT + 1}); this one reads up to {FORMAT}"),
        (project({"format": 1, "nodes": {"n1": {"kind": "Teapot"}}, "solids": ["n1"]}), "n1 is of an unknown kind"),
        (project({"format": 1, "nodes": {}, "solids": ["a\nb\ud800"]}), "node a·b·, asked for"),
        (project({"format": 1, "nodes": {"n1": {"kind": "Box", "size": [1, 1]}}, "solids": ["n1"]}), "node n1"),
        (project({"format": 1, "nodes": {"n1": {"kind": "Sphere", "radius": 1e999}}, "solids": ["n1"]}), "no number"),
        (project(b'{"format":1,"nodes":{"n1":{"kind":"Sphere","radius":1e999}},"solids":["n1"]}'), "finite number"),
        (project({"format": 1, "nodes": {"n1": {"kind": "Union", "children": ["n1"]}}, "solids": ["n1"]}), "a circle"),
        (
            project({"format": 1, "solids": ["a"], "nodes": {
                "a": {"kind": "Union", "children": ["b"]}, "b": {"kind": "Union", "children": ["a"]}}}),
            "a circle",
        ),
        (project({"format": 1, "nodes": {}, "solids": ["n1"]}), "n1, asked for by “solids”, is missing"),
        (
            project({"format": 1, "parameters": [{"name": "a", "value": 1, "choices": ["b", 2]}]}),
            "the parameter a",
        ),
        (project(CUBE, ("../../evil", b"x")), "leads out of the file"),
        (project(CUBE, ("/etc/evil", b"x")), "leads out of the file"),
        (project(CUBE, ("C:/evil", b"x")), "leads out of the file"),
        (
            project({"format": 1, "nodes": {"n1": {"kind": "ImportedMesh", "asset": "../x"}}, "solids": ["n1"]}),
            "node n1 (“Imported mesh”): '../x' names no asset",
        ),
        (
            project({"format": 1, "nodes": {"n1": {"kind": "ImportedMesh", "asset": "a" * 64}}, "solids": ["n1"]}),
            "node n1 (“Imported mesh”): its file assets/aaaaaaaaaaaa… is missing",
        ),
        (
            project(
                {"format": 1, "nodes": {"n1": {"kind": "ImportedMesh", "asset": "a" * 64}}, "solids": ["n1"]},
                ("assets/" + "a" * 64, b"not it"),
            ),
            "so it is not the file that was stored",
        ),
        (packed([("document.json", json.dumps(CUBE))], zipfile.ZIP_BZIP2), "compressed by method 12"),
    ],
)  # fmt: skip
def test_bad_files_are_refused_with_the_place(tmp_path, data, words):
    assert words in refusal_of(tmp_path / "bad.solidtree", data)


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_member_that_stands_twice(tmp_path):
    assert "holds 'document.json' twice" in refusal_of(
        tmp_path / "twice.solidtree", project(CUBE, ("document.json", b"{}"))
    )


def test_an_encrypted_member(tmp_path):
    data = bytearray(project(CUBE))
    data[data.index(b"PK\x03\x04") + 6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1
    assert "is encrypted" in refusal_of(tmp_path / "locked.solidtree", bytes(data))


def test_a_truncated_project(document, store, tmp_path):
    path = tmp_path / "cut.solidtree"
    save_project(document, path, store=store)
    data = path.read_bytes()
    for size in (len(data) - 1, len(data) // 2, 100, 4):
        message = refusal_of(path, data[:size])
        assert ("cut short or damaged" in message) if size >= 100 else ("zip" in message or "cut short" in message)


def test_a_project_with_a_flipped_bit(tmp_path):
    data = bytearray(packed([("document.json", json.dumps(CUBE))], zipfile.ZIP_STORED))
    data[data.index(b"Box")] ^= 1
    assert "document.json is damaged" in refusal_of(tmp_path / "flip.solidtree", bytes(data))


def test_zip_bombs(tmp_path):
    path = tmp_path / "bomb.solidtree"
    assert "unpacks to more than 20 MB" in refusal_of(
        path, project(b'{"format": 1, "notes": "' + b"a" * 40_000_000 + b'"}')
    )
    mesh = b"\0" * 40_000_000
    table = {"format": 1, "nodes": {"n": {"kind": "ImportedMesh", "asset": sha256(mesh).hexdigest()}}, "solids": ["n"]}
    assert "unpacks to more than 20 MB" in refusal_of(
        path, project(table, ("assets/" + sha256(mesh).hexdigest(), mesh))
    )
    assert list((tmp_path / "opened").iterdir()) == []
    assert "more than 8,000,000 values" in refusal_of(
        path, project(b'{"format": 1, "x": [' + b"[]," * 4_500_000 + b"[]]}")
    )


def test_sizes_that_lie_are_not_believed(tmp_path):
    data = bytearray(project(b'{"format": 1, "notes": "' + b"a" * 40_000_000 + b'"}'))
    struct.pack_into("<I", data, data.index(b"PK\x01\x02") + 24, 500)
    struct.pack_into("<I", data, data.index(b"PK\x03\x04") + 22, 500)
    assert "document.json" in refusal_of(tmp_path / "liar.solidtree", bytes(data))


ODD = [
    None,
    True,
    -1,
    0,
    1e308,
    10**400,
    "",
    "=",
    "=1/0",
    "=a" * 900,
    "n1",
    "\ud800",
    [],
    [[]],
    {},
    {"kind": "Box"},
    ["n1"] * 3,
]


def mutated(value, chance):
    """`value` with a few of its parts swapped, dropped, doubled or replaced by odd ones."""
    if chance.random() < 0.006:
        return chance.choice(ODD)
    if isinstance(value, dict):
        result = {key: mutated(item, chance) for key, item in value.items() if chance.random() > 0.004}
        if result and chance.random() < 0.02:
            result[chance.choice([*result, "kind", "children", "x"])] = chance.choice([*result.values(), *ODD])
        return result
    if isinstance(value, list):
        result = [mutated(item, chance) for item in value if chance.random() > 0.004]
        if chance.random() < 0.01:
            result += result[:3]
        return result
    return value


def test_mutated_projects_open_or_are_refused(document, store, tmp_path):
    path = tmp_path / "good.solidtree"
    save_project(document, path, store=store)
    whole = path.read_bytes()
    with zipfile.ZipFile(path) as archive:
        table = json.loads(archive.read("document.json"))
        asset = archive.namelist()[1], archive.read(archive.namelist()[1])
    opened = refused = 0
    for seed in range(600):
        chance = random.Random(seed)
        if seed % 3:
            data = project(mutated(table, chance), asset)
        else:
            raw = bytearray(whole)
            for _ in range(chance.randrange(1, 6)):
                raw[chance.randrange(len(raw))] = chance.randrange(256)
            data = bytes(raw[: chance.randrange(len(raw))] if chance.random() < 0.3 else raw)
        path.write_bytes(data)
        try:
            found = open_project(path, store)
        except Refusal as refusal:
            refused += 1
            assert "\n" not in str(refusal) and str(refusal).isprintable(), seed
        else:
            opened += 1
            save_project(found, tmp_path / "again.solidtree", store=store)
    assert opened > 20 and refused > 20
    assert {entry.name for entry in tmp_path.iterdir()} == {"good.solidtree", "again.solidtree", "assets"}
