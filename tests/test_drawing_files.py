"""Pages as SVG, PDF and DXF, read back by others: sizes by formula, layers, and names that mean harm."""

import re
import xml.etree.ElementTree as ET

import ezdxf
import numpy as np
import pytest
from ezdxf import bbox

from solidtree.model.document.errors import Refusal
from solidtree.model.drafting.drawing_file import write_page
from solidtree.model.drafting.drawn import Draughts
from solidtree.model.drafting.page import box_of, items_of
from solidtree.model.drafting.plan import Plan
from solidtree.model.drawing.drawing import draw
from solidtree.model.drawing.projection import standard
from solidtree.model.drawing.scene import scene_of
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.results import evaluate_document

SVG = "{http://www.w3.org/2000/svg}"
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
HOSTILE = "</g><script>alert(1)</script> & \"quoted\" 'x' \x07\n*|?%%c^Ω漢"
PART = (box(30, 20, 10).named("plate") - cylinder(4, 30, segments=32).at(10, 10, -5).named("drill")).coloured(
    "steelblue"
)


def page_of(*solids, **choices):
    return Draughts(document_of(*solids)).page(Plan(**choices)).page


def svg_of(page, tmp_path):
    write_page(tmp_path / "page.svg", page)
    return ET.parse(tmp_path / "page.svg").getroot()


def points_of(data):
    return np.reshape([float(n) for n in re.findall(r"-?\d*\.?\d+", data)], (-1, 2))


def test_svg_has_a_millimetre_for_a_unit_and_a_group_for_each_node(tmp_path):
    page = page_of(PART.named("part"), view="front", scale=2.0, faces="fill", title="part")
    root = svg_of(page, tmp_path)
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("297mm", "210mm", "0 0 297 210")
    assert root.get("data-scale") == "2:1" and root.find(SVG + "title").text == "part"
    visible = np.concatenate([points_of(e.get("d")) for e in root.iter(SVG + "path") if e.get("class") == "visible"])
    assert np.ptp(visible, axis=0) == pytest.approx((60, 20))
    hidden = [e for e in root.iter(SVG + "path") if e.get("class") == "hidden"]
    assert len(hidden) == 1 and hidden[0].get("stroke-dasharray") and hidden[0].get("stroke-width") == "0.25"
    across = points_of(hidden[0].get("d"))
    assert sorted(across[:, 0] - visible[:, 0].min()) == pytest.approx([12, 12, 28, 28])  # the drill at 2:1
    groups = {g.get(LABEL): g for g in root.iter(SVG + "g")}
    ids = {node.name: node.id for node in document_of(PART.named("part")).solids[0].children}
    assert groups["part / drill"].get("data-path").split("/")[-1] == ids["drill"]
    every = [g.get("id") for g in root.iter(SVG + "g")]
    assert len(set(every)) == len(every) and all(re.fullmatch(r"[a-z][a-z0-9-]*", one) for one in every)
    assert "2:1" in {text.text for text in root.iter(SVG + "text")}


def test_another_renderer_shows_the_svg_as_the_z_buffer_shows_the_solids(tmp_path, qapp):
    from PySide6.QtCore import QByteArray, QRectF
    from PySide6.QtGui import QImage, QPainter
    from PySide6.QtSvg import QSvgRenderer

    from solidtree.render.camera import Camera
    from solidtree.render.picture import ids_picture

    document = document_of(PART, sphere(6, segments=24).at(20, 10, 12), box(8).at(5, -12, 3))  # two of them meet
    plan = Plan(view="iso", hidden="omit", faces="fill")
    page = Draughts(document).page(plan).page
    evaluation = evaluate_document(document)
    meshes = [evaluation.display(result) for result in evaluation.solids]
    scene = scene_of(evaluation)
    projection = standard("iso", scene.extent)
    bounds = draw(scene, projection, hidden=False).bounds
    faces = box_of(items_of(page, "face"))
    shift = faces.mean(axis=0) - bounds.mean(axis=0) * page.scale

    side, half = 400, 0.6 * float(np.ptp(bounds, axis=0).max())
    root = svg_of(page, tmp_path)
    colours = {solid.id: c for solid, c in zip(document.solids, ("#0000ff", "#00ff00", "#ff0000"), strict=True)}
    for group in root.iter(SVG + "g"):
        for path in group.findall(SVG + "path"):
            if path.get("class") == "face":
                colour = colours[group.get("data-path").split("/")[0]]
                path.set("fill", colour)
                path.set("stroke", colour)
            else:
                path.set("display", "none")
    for name in ("text", "rect"):
        for element in root.iter(SVG + name):
            element.set("display", "none")
    renderer = QSvgRenderer(QByteArray(ET.tostring(root)))
    reach = half * page.scale
    renderer.setViewBox(QRectF(shift[0] - reach, page.height - shift[1] - reach, 2 * reach, 2 * reach))
    image = QImage(side, side, QImage.Format.Format_RGB32)
    image.fill(0)
    painter = QPainter(image)
    renderer.render(painter, QRectF(0, 0, side, side))
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(side, side, 4)[:, :, :3]  # blue, green, red
    drawn = np.where(pixels.max(axis=2) > 127, 1 + pixels.argmax(axis=2), 0)

    target = tuple(projection.target)
    eye = tuple(projection.target + 100 * projection.axes[2])
    camera = Camera(eye, target, tuple(projection.axes[1]), parallel=True, parallel_scale=half)
    shown = ids_picture(meshes, (side, side), camera, perspective=None)[:, :, 2].astype(int)
    border = np.zeros((side, side), bool)
    for axis in (0, 1):
        change = np.diff(shown, axis=axis) != 0
        for end in (0, 1):
            border |= np.pad(change, [(end, 1 - end) if a == axis else (0, 0) for a in (0, 1)])
    assert {1, 2, 3} <= set(drawn[~border]) and (~border).sum() > 0.9 * side * side
    assert int((drawn != shown)[~border].sum()) <= 5


def test_dxf_has_the_true_size_and_layers_for_nodes(tmp_path):
    page = page_of(PART.named("part"), view="front", scale=2.0, faces="fill", dimensions=True)
    write_page(tmp_path / "page.dxf", page)
    drawing = ezdxf.readfile(tmp_path / "page.dxf")
    assert not drawing.audit().errors and drawing.units == ezdxf.units.MM
    layers = {layer.dxf.name: layer.dxf for layer in drawing.layers}
    assert (layers["part - plate"].lineweight, layers["part - plate"].linetype) == (50, "Continuous")
    assert (layers["part - drill hidden"].lineweight, layers["part - drill hidden"].linetype) == (25, "DASHED")
    space = drawing.modelspace()
    edges = [e for e in space if e.dxf.layer in ("part - plate", "part - drill")]
    assert tuple(bbox.extents(edges).size)[:2] == pytest.approx((30, 10))
    assert all(e.dxf.linetype == "BYLAYER" and e.dxf.lineweight == -1 for e in edges)
    (hatch,) = [e for e in space.query("HATCH") if e.dxf.layer == "part - plate faces"]
    assert hatch.rgb is not None and hatch.rgb[2] > hatch.rgb[0]  # steel blue, shaded
    assert {"30", "10"} <= {text.dxf.text for text in space.query("TEXT")}
    assert tuple(bbox.extents(space).size)[:2] <= (297 / 2, 210 / 2)


def test_views_of_a_sheet_share_the_layers_of_their_nodes(tmp_path):
    write_page(tmp_path / "page.dxf", page_of(PART.named("part"), sheet="third"))
    names = [layer.dxf.name for layer in ezdxf.readfile(tmp_path / "page.dxf").layers]
    assert sorted(names) == sorted(
        {"0", "Defpoints", "Frame", "Dimensions", "part - plate", "part - drill", "part - drill hidden"}
    )


@pytest.mark.parametrize("ending", ["svg", "pdf", "dxf"])
def test_hostile_names_do_no_harm_and_files_are_the_same_every_time(ending, tmp_path):
    solids = (PART.named(HOSTILE), box(5).at(50).named("a*b"), box(5).at(60).named("a?B"))
    page = page_of(*solids, sheet="first", faces="fill", title=HOSTILE)
    for name in ("one", "two"):
        write_page(tmp_path / f"{name}.{ending}", page)
    data = (tmp_path / f"one.{ending}").read_bytes()
    assert data == (tmp_path / f"two.{ending}").read_bytes()
    if ending == "svg":
        root = ET.fromstring(data)
        assert not list(root.iter(SVG + "script"))
        assert any(HOSTILE.split("\x07")[0] in g.get(LABEL) for g in root.iter(SVG + "g"))
    elif ending == "dxf":
        drawing = ezdxf.readfile(tmp_path / "one.dxf")
        assert not drawing.audit().errors
        names = [layer.dxf.name.upper() for layer in drawing.layers]
        assert len(set(names)) == len(names)
        title = next(t.dxf.text for t in drawing.modelspace().query("TEXT") if t.dxf.text.startswith("</g>"))
        assert "\n" not in title and "\x07" not in title
    else:
        assert data.startswith(b"%PDF-") and b"DejaVuSans" in data  # the letters that Helvetica lacks


def test_a_pdf_page_has_its_size_in_points(tmp_path):
    for words, size in (("A4-portrait", (210, 297)), ("300x200", (300, 200))):
        write_page(tmp_path / "page.pdf", page_of(box(10), view="top", page=words))
        data = (tmp_path / "page.pdf").read_bytes()
        found = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+) ?\]", data)
        assert [float(n) / 72 * 25.4 for n in found.groups()] == pytest.approx(size, abs=1e-3)
        assert data.rstrip().endswith(b"%%EOF") and b"DejaVuSans" not in data


def test_other_endings_and_missing_folders_are_refused(tmp_path):
    page = page_of(box(10))
    for name, reason in (("a.png", "is no drawing"), ("a", "no ending"), ("none/a.svg", "no such file or folder")):
        with pytest.raises(Refusal, match=reason):
            write_page(tmp_path / name, page)
    assert not list(tmp_path.iterdir())
