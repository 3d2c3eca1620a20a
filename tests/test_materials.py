"""Materials, mappings and lights as parts of a document: changed, undone, written as Python, kept in projects."""

import json
import zipfile

import numpy as np
import pytest
from PIL import Image
from replay import replayed

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.table import from_table, same_document, to_table
from solidtree.model.editing.echo import call
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.operations.pasting import clip
from solidtree.model.project.assets import AssetStore, default_store, references
from solidtree.model.project.project_file import open_project, save_project
from solidtree.model.script import box, document_of, evaluate, light, material, save, sphere, texture
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.surface.bitmaps import texels_of
from solidtree.model.surface.faults import bitmap_faults
from solidtree.model.surface.material import MOST_BITMAPS, PRESETS

SHA = "ab" * 32


def do(document, name, *arguments, **keywords):
    return OPERATIONS[name](document, *arguments, **keywords)


@pytest.fixture
def wood(tmp_path):
    path = tmp_path / "wood.png"
    Image.fromarray(np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)).save(path)
    return path


@pytest.fixture
def part():
    """A box with a bite out of it; n1 is the difference, n2 the box, n3 the ball."""
    return document_of(box(10) - sphere(4))


def test_every_step_is_undone_to_the_very_document_and_its_lines_make_it_again(part):
    session = Session(part)
    lines, way = [], [session.document]
    steps = [
        ("add_material", ("oak", "Oak"), {}),
        ("add_material", (), {"preset": "Glass"}),
        ("set_material", ("oak",), {"specular": 0.5, "texture": SHA, "wrap": "clamp"}),
        ("use_material", (["n2", "n3"], "oak"), {}),
        ("rename_material", ("oak", "old oak"), {}),
        ("set_mapping", (["n1"], "box"), {"size": (5, 5)}),
        ("set_mapping", (["n1"],), {"turn": 30, "mirror": (True, False)}),
        ("add_light", ("sun",), {"direction": (1, 0, -1)}),
        ("add_light", (None, "point"), {"position": (1, 2, 3), "shadows": True}),
        ("set_light", ("sun",), {"intensity": 0.5, "active": False}),
        ("rename_light", ("sun", "moon"), {}),
        ("set_shading", ("gouraud",), {}),
        ("delete_light", ("moon",), {}),
        ("delete_material", ("Glass",), {}),
        ("use_material", (["n3"], None), {}),
        ("set_mapping", (["n1"],), {}),
    ]
    for name, arguments, keywords in steps:
        session.do(name, *arguments, **keywords)
        way.append(session.document)
        lines.append(call(name, *arguments, **keywords))
        assert way[-1] is not way[-2]
        assert same_document(from_table(to_table(way[-1])), way[-1])
    assert same_document(replayed(lines, part), session.document)
    for document in reversed(way[:-1]):
        session.undo()
        assert session.document is document


def test_a_new_look_cuts_nothing_anew(part):
    evaluator = Evaluator()
    before = evaluator.evaluate(part.solids[0], 0.05).solid
    dressed = do(do(do(part, "add_material", "m"), "use_material", ["n2"], "m"), "set_mapping", ["n1"], "planar")
    assert evaluator.evaluate(dressed.solids[0], 0.05).solid is before


def test_nodes_follow_the_name_and_lose_what_is_deleted(part):
    document = do(do(part, "add_material", "a"), "use_material", ["n2"], "a")
    renamed = do(document, "rename_material", "a", "b")
    assert renamed.solids[0].children[0].material == "b"
    assert renamed.solids[0].children[1] is document.solids[0].children[1]
    assert do(renamed, "delete_material", "b").solids[0].children[0].material == ""


@pytest.mark.parametrize(
    ("name", "arguments", "keywords", "words"),
    [
        ("add_material", ("a", "Tin"), {}, "no preset is called 'Tin'"),
        ("add_material", ("a",), {"gloss": 1}, "a material has no 'gloss'"),
        ("add_material", ("oak",), {}, "there is a material called “oak” already"),
        ("add_material", ("  ",), {}, "needs a name"),
        ("set_material", ("oak",), {"diffuse": 1.5}, "the material “oak”: diffuse is from 0 to 1, not 1.5"),
        ("set_material", ("oak",), {"shininess": float("nan")}, "shininess"),
        ("set_material", ("oak",), {"texture": "wood.png"}, "the texture is told by 64 hexadecimal digits"),
        ("set_material", ("oak",), {"shading": "toon"}, "is one of flat, gouraud, gouraud-diffuse, phong"),
        ("set_material", ("ash",), {"diffuse": 1}, "there is no material called 'ash'"),
        ("use_material", (["n1"], "ash"), {}, "there is no material called 'ash'"),
        ("set_mapping", (["n1"], "round"), {}, "the projection of a texture is one of natural, planar"),
        ("set_mapping", (["n1"], "box"), {"size": (0, 5)}, "the texture's size must not be 0"),
        ("set_mapping", (["n9"], "box"), {}, "there is no node n9"),
        ("add_light", ("a", "spot"), {}, "the kind is one of ambient, directional, point"),
        ("add_light", ("a",), {"direction": (0, 0, 0)}, "the direction must not be 0, 0, 0"),
        ("add_light", ("a",), {"intensity": -1}, "the intensity is from 0 to 100"),
        ("set_shading", ("toon",), {}, "the shading of a document is one of"),
    ],
)
def test_what_cannot_be_is_refused_in_words(part, name, arguments, keywords, words):
    document = do(part, "add_material", "oak", "Oak")
    with pytest.raises(Refusal, match=words.replace("(", r"\(")):
        do(document, name, *arguments, **keywords)


def test_nine_lights_at_once_are_too_many(part):
    for i in range(8):
        part = do(part, "add_light", f"l{i}")
    with pytest.raises(Refusal, match="at most 8 lights can shine at once"):
        do(part, "add_light")
    assert len(do(part, "add_light", active=False).lights) == 9


def test_projects_carry_bitmaps_and_open_to_the_same(tmp_path, wood):
    part = box(10).dressed(texture(wood, "planar", size=(6, 4)))
    document = save(tmp_path / "a.solidtree", part, light("sun", shadows=True))
    (sha,) = references(document)
    store = AssetStore(tmp_path / "elsewhere")
    again = open_project(tmp_path / "a.solidtree", store)
    assert same_document(again, document)
    assert again.materials[0].name == "wood" and again.materials[0].texture == sha
    assert store.read(sha) == wood.read_bytes()
    np.testing.assert_array_equal(texels_of(sha)[..., :3], np.asarray(Image.open(wood)))


def test_a_key_lives_in_the_project(tmp_path, wood):
    worn = material("wood", texture=wood, key="#000102", bump=wood, bump_height=0.5)
    save(tmp_path / "a.solidtree", box(10).dressed(worn))
    assert open_project(tmp_path / "a.solidtree").materials == (worn,)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda t: t["materials"][0].update(gloss=1), "a material has no field 'gloss'"),
        (lambda t: t["materials"][0].pop("name"), "a material has no name"),
        (lambda t: t["materials"][0].update(opacity="much"), "opacity"),
        (lambda t: t.update(materials=5), "“materials” must be a list"),
        (lambda t: t["lights"][0].update(direction=[0, 0]), "direction"),
        (lambda t: t["lights"][0].update(active=1), "active must be true or false"),
        (lambda t: t["nodes"]["n1"].update(mapping={"size": "wide"}), "size"),
        (lambda t: t["nodes"]["n1"].update(material=7), "“material” must be text"),
        (lambda t: t.update(shading="toon"), "the shading of a document is one of"),
        (lambda t: t["materials"].append(t["materials"][0]), "two materials called"),
    ],
)
def test_hostile_projects_are_refused_by_name(tmp_path, change, words):
    path = tmp_path / "a.solidtree"
    save_project(document_of(box(10).dressed(material("m", "Oak")), light("sun")), path)
    with zipfile.ZipFile(path) as archive:
        table = json.loads(archive.read("document.json"))
    change(table)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("document.json", json.dumps(table))
    with pytest.raises(Refusal, match=words):
        open_project(path)


def test_copies_and_inserted_documents_bring_their_materials(part):
    red = document_of(box(1).dressed(material("m", colour="red")), light("sun"))
    blue = document_of(box(1).dressed(material("m", colour="blue")), light("sun"))
    both = do(do(part, "insert_document", red), "insert_document", blue)
    assert [one.name for one in both.materials] == ["m", "m 2"]
    assert [both.material(root.material).colour for root in both.solids[1:]] == ["#ff0000", "#0000ff"]
    assert [one.active for one in both.lights] == [True, False]
    copied = clip(both, [both.solids[2].id])
    assert [one.name for one in copied.materials] == ["m 2"]
    pasted = do(part, "paste", copied)
    assert pasted.material(pasted.solids[1].material).colour == "#0000ff"
    assert len(do(both, "paste", copied).materials) == 2, "the same material is shared"


def test_scripts_refuse_two_materials_of_one_name():
    parts = (box(1).dressed(material("m", colour="red")), box(2).dressed(material("m", colour="blue")))
    with pytest.raises(Refusal, match="two different materials called “m”"):
        document_of(*parts)
    assert len(document_of(parts[0], sphere(1).dressed(parts[0].material)).materials) == 1


def test_a_bitmap_that_is_none_is_refused_by_its_file(tmp_path):
    (tmp_path / "a.png").write_bytes(b"no picture")
    for path, words in (
        (tmp_path / "a.png", "a.png"),
        (tmp_path / "gone.png", "gone.png: it cannot be read: No such file"),
    ):
        with pytest.raises(Refusal, match=words):
            material("m", texture=path)


def test_presets_can_be_given_to_any_document():
    document = Document()
    for name in PRESETS:
        document = do(document, "add_material", preset=name)
    assert [one.name for one in document.materials] == list(PRESETS)


def test_a_look_changes_no_measure(part):
    plain = evaluate(part).solids[0].measures()
    dressed = evaluate(document_of(part.solids[0].dressed(material("m"), texture(projection="box")))).solids[0]
    assert dressed.measures().volume == plain.volume


def test_missing_bitmaps_and_too_many_are_told_once_a_material(tmp_path):
    lost = material("lost", texture="ab" * 32, bump="cd" * 32)
    document = document_of(box(5).named("a").dressed(lost), box(5).named("b").dressed(lost))
    found = bitmap_faults(document)
    assert [(fault.name, fault.message) for fault in found] == [
        ("a", "the material “lost”: its bitmap is missing from the project")
    ] * 2
    assert not any(fault.error for fault in found)
    coats = []
    for number in range(MOST_BITMAPS + 3):
        Image.fromarray(np.full((2, 2, 3), 10 * number, np.uint8)).save(tmp_path / f"{number}.png")
        coats.append(material(f"m{number}", texture=tmp_path / f"{number}.png"))
    (fault,) = bitmap_faults(document_of(*(box(1).at(2 * n).dressed(coat) for n, coat in enumerate(coats))))
    assert f"“m{MOST_BITMAPS}”" in fault.message


def test_render_tells_of_a_bitmap_that_cannot_be_read_and_draws_all_the_same(tmp_path, solidtree):
    broken = default_store().put(b"no bitmap at all")
    save(tmp_path / "a.solidtree", box(5).dressed(material("lost", texture=broken)))
    status, _, told = solidtree("render", tmp_path / "a.solidtree", tmp_path / "a.png", "--size", "40x30")
    assert status == 0 and "the material “lost”: " in told and "it is no bitmap that can be read" in told
    assert (tmp_path / "a.png").stat().st_size > 80
