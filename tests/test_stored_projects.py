"""Every version of the project format has left a file here, and each opens to what it was made from."""

from pathlib import Path

import pytest

from solidtree.model.document.document import Document, Parameter, ParameterSet, Section
from solidtree.model.document.nodes import KINDS, Broken, Node
from solidtree.model.document.outlines import Path as Outline
from solidtree.model.document.project_font import ProjectFont
from solidtree.model.document.table import same_document
from solidtree.model.document.tree import numbered, walk
from solidtree.model.project.assets import default_store
from solidtree.model.project.project_file import FORMAT
from solidtree.model.proximity.checks import Checks, PairCheck
from solidtree.model.proximity.motion import Motion
from solidtree.model.script import (
    bezier,
    box,
    bspline,
    circle,
    cone,
    cylinder,
    displace,
    evaluate,
    extrude,
    halfspace,
    hull,
    imported_mesh,
    instance,
    lettering,
    light,
    linear_array,
    loft,
    material,
    minkowski,
    mirror,
    open_document,
    parameter,
    path,
    pipe,
    polar_array,
    polygon,
    polyhedron,
    rectangle,
    relief,
    revolve,
    save,
    sphere,
    stencil,
    sweep,
    text_on_path,
    texture,
    torus,
    union,
    wrap,
)  # fmt: skip

TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
PROJECTS = Path(__file__).parent / "projects"


def format_1() -> Document:
    """Every kind of node and step that format 1 knows, with all that can be said of a node."""
    width = parameter("width", 12, minimum=1, maximum=90, note="of the block", group="size")
    depth = parameter("depth", width / 2, choices=())
    block = box(width, depth, "2 in").named("block").coloured("#336699").noted("made of a parameter")
    tetrahedron = polyhedron([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    frame = polygon([(0, 0), (9, 0), (9, 9), (0, 9), (3, 3), (6, 3), (6, 6), (3, 6)], [(0, 1, 2, 3), (4, 5, 6, 7)])
    round_ones = [
        sphere(5, segments=24).at(30),
        cylinder(2, 9, centred=True, tolerance=0.1).turned(x=90).at(y=20),
        cone(4, 1, 6).scaled(1, 1, 2).mirrored((0, 0, 1)),
        torus(8, 2).transformed([[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7]]),
    ]
    solids = [
        ((block - union(*round_ones)) & halfspace((0, 0, -1), (0, 0, 20))).named("booleans"),
        linear_array(polar_array(mirror(tetrahedron, keep=False), 5, 180), 2, (0, 0, 30)).named("arrays"),
        hull(extrude(rectangle(3, 4), 5, twist=30), revolve(circle(1).at(5), angle=90)).named("hull").hidden(),
        minkowski(extrude(frame, 2, top_scale=0.5, centred=True), box(1)).named("sum"),
        union(instance("n99"), instance("n99").at(40)).named("instances"),
        imported_mesh(default_store().put(TETRAHEDRON.encode()), "off", 0, "1 in").named("imported"),
    ]
    roots = numbered(solids)
    definition = (sphere(3) + box(2)).named("shared").with_(id="n99")
    children = tuple(child.with_(id=f"m{i}") for i, child in enumerate(definition.children))
    return Document(
        solids=roots,
        definitions=(definition.with_(children=children),),
        parameters=(
            Parameter("width", 12, 1, 90, note="of the block", group="size"),
            Parameter("depth", "width / 2"),
        ),
        notes="Every kind of node, as format 1 writes it.",
    )


def format_2() -> Document:
    """Format 1, with saved values of the parameters and a plane that opens the picture."""
    return format_1().with_(
        sets=(ParameterSet("wide", (("width", 80), ("depth", "width / 4"))), ParameterSet("=as it was")),
        sections=(Section("middle", (0, 2.5, 0), (0, 3, 4)), Section("top", (0, 0, 9), active=False)),
        notes="Every kind of node, as format 2 writes it.",
    )


def format_3() -> Document:
    """Format 2, with curves, lettering and what is made of them, and outlines that stand by themselves."""
    before = format_2()
    rail = path([("move", (0, 0, 0)), ("cubic", (0, 0, 10), (10, 0, 10), (10, 0, 20))]).named("rail")
    ring = bspline([(8, 0), (8, 8), (-8, 8), (-8, -8), (8, -8)], 2, knots=[0, 1, 2, 3, 4, 6], closed=True)
    drop = bezier([(0, 0), ("width", 12), (12, 0)], weights=[1, 2, 1], closed=True)
    strung = Outline(
        points=((0, 0), (0, 0), (5, 9), (9, 9), (9, 0), (0, -4), (4, -2), (5, -4)),
        segments="MSLlMQl",
        joints="csyac",
        splines=((2, (0.0, 0.0, 0.0, 1.0, 1.0, 1.0), (1.0, 0.5, 1.0)),),
        even_odd=True,
    )
    solids = [
        extrude(drop, 5, below="depth", taper=3).named("drop"),
        revolve(rectangle(2, 3).at(4), 90, start=30, tolerance=0.1).named("turned"),
        sweep(circle(1), rail, twist=30, end_scale=0.5).named("swept"),
        loft(rectangle(9, 9, centred=True), circle(3).at(0, 0, 12), smooth=True).named("loft"),
        pipe(rail.named(""), 2, bore=1, rounded=True, segments=24).named("pipe"),
        wrap(lettering("Ab\nγ", "depth", "GFS Didot", alignment="right", features="kern=0"), 9).named("label"),
    ]
    profiles = [
        strung.named("strung").turned(x=90).at(0, 5, 0),
        ring.named("ring"),
        (circle(4) - circle(2)).named("washer").coloured("red").hidden(),
        instance("m9").named("again").at(30),
    ]
    roots = tuple(root.with_(id=f"k{i}") for i, root in enumerate((*solids, *profiles)))
    roots = tuple(_children_numbered(root) for root in roots)
    return before.with_(
        solids=(*before.solids, *roots[: len(solids)]),
        profiles=roots[len(solids) :],
        definitions=(*before.definitions, rectangle(3, 2).named("plate").with_(id="m9")),
        notes="Every kind of node, as format 3 writes it.",
    )


def format_4() -> Document:
    """Format 3, with a font that the project carries and has edited, the noted version of an installed one, and what
    came for lettering."""
    before = format_3()
    base = "750778dcaacf206733cf12e99e9ec66f53a6322207fcdcf2d3cdd97d3dc0d9eb"
    edited = "f860829ab83e170d89cfc8b70d62fe3180ebef4aef356f79491a017115c4afc9"
    noted = "27d80cbfb7446a627f577b3a3bc519e1cec71d53328cd3873368e9c3b54e0fc1"
    rim = lettering("Rim", 6, "GFS Didot", alignment="centre")
    made = (
        lettering("I", 20, "Bars").named("bars"),
        text_on_path(rim, circle(20), "depth", shift=1, flip=True).named("rim"),
        stencil(lettering("AB8", 12, "GFS Didot"), 0.8, 60, 2).named("stencil"),
    )
    made = tuple(_children_numbered(node.with_(id=f"j{i}")) for i, node in enumerate(made))
    raised = extrude(rectangle(9, 9), 3, bevel=1).named("raised").with_(id="j9")
    return before.with_(
        solids=(*before.solids, _children_numbered(raised)),
        profiles=(*before.profiles, *made),
        fonts=(
            ProjectFont("Bars", base, 0, edited),
            ProjectFont("GFS Didot", noted),
        ),
        notes="Every kind of node, as format 4 writes it.",
    )


HEIGHTS = b"BM\x4e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\3\0\0\0\1\0\x18\0" + bytes(24)
HEIGHTS += bytes((0, 0, 0, 90, 90, 90, 0, 0, 20, 20, 20, 255, 255, 255, 0, 0, 60, 0, 0, 0, 200, 0, 0, 0))
"""A bitmap of 2 by 3 pixels, 24 bits."""


def format_5() -> Document:
    """Format 4, with materials, how bitmaps lie, lights, shading, and solids of bitmaps."""
    before = format_4()
    heights = default_store().put(HEIGHTS)
    skin = material("skin", "Brass", colour="#336699", shading="flat", opacity=0.5, texture=heights, key="white",
                    wrap="mirror", bump=heights, bump_height=0.25, reflection=heights, light_map=heights)  # fmt: skip
    lies = texture(projection="spherical", origin=(1, 2, 3), turned=(0, 90, 0), size=(5, 6), offset=(0.5, 0),
                   scale=(2, 3), turn=30, mirror=(True, False))  # fmt: skip
    plate = relief(asset=heights, width=9, height="depth", base=1, invert=True, smoothing=0.5, samples=3)
    bumpy = displace(sphere(4), asset=heights, height=-0.5, projection="spherical", edge=2)
    made = (plate.named("plate").dressed(skin.name), bumpy.named("bumpy").dressed(lies))
    return before.with_(
        solids=(*before.solids, *(_children_numbered(node.with_(id=f"h{i}")) for i, node in enumerate(made))),
        materials=(skin, material("plain", bump=heights, bump_kind="normals")),
        lights=(
            light("sun", direction=(1, 2, -3), colour="#ffeecc", intensity=0.5, shadows=True),
            light("lamp", "point", position=(1, 2, 3), with_camera=True, active=False),
            light("around", "ambient"),
        ),
        shading="gouraud-diffuse",
        notes="Every kind of node, as format 5 writes it.",
    )


def format_6() -> Document:
    """Format 5, with crease angles."""
    before = format_5()
    creased = (box(3) + sphere(2, segments=8).creased(0)).named("creased").creased(12.5)
    return before.with_(
        solids=(*before.solids, _children_numbered(creased.with_(id="c0"))),
        notes="Every kind of node, as format 6 writes it.",
    )


def format_7() -> Document:
    """Format 6, with what is asked of pairs, and motions."""
    before = format_6()
    one, two, three = (root.id for root in before.solids[:3])
    return before.with_(
        checks=Checks(0.25, (PairCheck(one, two, touching=True), PairCheck(three, one, 1.5))),
        motions=(Motion("opening", "width", 12, 30, 2.5, 40),),
        notes="Every kind of node, as format 7 writes it.",
    )


def _children_numbered(root: Node) -> Node:
    return root.with_(children=tuple(child.with_(id=f"{root.id}_{i}") for i, child in enumerate(root.children)))


@pytest.mark.parametrize(("name", "made"), [("format_1", format_1), ("format_2", format_2), ("format_3", format_3),
                                            ("format_4", format_4), ("format_5", format_5),
                                            ("format_6", format_6), ("format_7", format_7)])  # fmt: skip
def test_every_format_opens_as_it_was_made(name, made):
    assert same_document(open_document(PROJECTS / f"{name}.solidtree"), made())


def test_the_stored_file_of_the_present_format_knows_every_kind():
    document = open_document(PROJECTS / f"format_{FORMAT}.solidtree")
    kinds = {type(node) for node in walk(*document.roots)}
    assert kinds == set(KINDS.values()) - {Node, Broken}


@pytest.mark.parametrize("path", sorted(PROJECTS.glob("*.solidtree")), ids=lambda path: path.stem)
def test_stored_files_survive_another_save(path, tmp_path):
    document = open_document(path)
    save(tmp_path / "again.solidtree", document)
    assert same_document(open_document(tmp_path / "again.solidtree"), document)
    assert not [message for message in evaluate(document).messages if message.error]
