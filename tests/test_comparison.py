"""One model under several shadings side by side."""

import numpy as np
import pytest
from PIL import Image

from solidtree.model.project.project_file import save_project
from solidtree.model.script import box, document_of, material, sphere
from solidtree.model.solid.results import evaluate_document
from solidtree.model.surface.light import Light
from solidtree.render.camera import Camera
from solidtree.render.look import LIGHT, Paint
from solidtree.render.picture import picture
from solidtree.render.surfaces.comparison import Comparison, columns_of, difference

SIZE = (160, 160)
EYE = Camera((0.0, -60.0, 0.0), (0.0, 0.0, 0.0), view_angle=25.0)
SUN = (Light("Ambient", "ambient"), Light("sun", direction=(0.15, 1.0, -0.1)))


def solids(document):
    evaluation = evaluate_document(document)
    return [(result.root, evaluation.display(result)) for result in evaluation.solids]


@pytest.fixture
def drawn():
    """Columns of a document from the eye above, by name, and the columns themselves."""
    comparison = Comparison(LIGHT)

    def draw(document, **how):
        columns = columns_of(document, solids(document), **how)
        comparison.show(columns, SUN)
        return dict(zip([column.name for column in columns], comparison.draw(EYE, SIZE), strict=True)), columns

    yield draw
    comparison.close()


def test_each_column_is_the_picture_of_its_shading(drawn):
    found, columns = drawn(document_of(sphere(10, segments=12).dressed(material("red", "Plastic", colour="#c04030"))))
    for column in columns:
        alone = picture(column.solids, SIZE, EYE, shading=column.shading, lights=SUN)
        assert difference(found[column.name], alone).share(3) < 0.02  # borders are smoothed by fewer samples


def test_gouraud_loses_a_highlight_inside_a_face_and_phong_keeps_it():
    shiny = material("shiny", colour="#404040", specular=0.9, shininess=60)
    lamp = (Light("lamp", "point", position=(0, -60, 0)),)
    comparison = Comparison(LIGHT)
    try:
        document = document_of(box(20, 20, 20, centred=True).dressed(shiny))
        columns = columns_of(document, solids(document))
        comparison.show(columns, lamp)
        _, gouraud, phong, bumps = comparison.draw(EYE, SIZE)
    finally:
        comparison.close()
    middle = (SIZE[1] // 2, SIZE[0] // 2)
    assert phong[middle].min() > 200 > 100 > gouraud[middle].max()
    assert difference(gouraud, phong).greatest > 100
    assert difference(phong, bumps).share() > 0.05


def test_what_a_material_says_of_shading_does_not_count_and_its_own_bumps_do(drawn, tmp_path):
    Image.fromarray(np.tile(np.arange(0, 256, 8, dtype=np.uint8), (8, 1))).save(tmp_path / "ramp.png")
    worn = material("m", shading="flat", bump=tmp_path / "ramp.png", bump_height=3)
    _, columns = drawn(document_of(sphere(10, segments=12).dressed(worn)))
    worn_by = {column.name: column.solids[0][1].looks[0].material for column in columns}
    assert {one.shading for one in worn_by.values()} == {""}
    assert worn_by["phong"].bump == "" and worn_by["bumps"].bump == worn.bump and worn_by["bumps"].bump_height == 3


def test_differences_are_counted():
    one = np.zeros((2, 2, 3), np.uint8)
    other = one.copy()
    other[0, 1] = (0, 40, 7)
    found = difference(one, other)
    assert found.greatest == 40 and found.share() == 0.25
    np.testing.assert_array_equal(found.picture()[..., 0], [[0, 255], [0, 0]])


def test_the_command_line_puts_them_side_by_side(tmp_path, solidtree):
    save_project(document_of(sphere(10, segments=10)), tmp_path / "a.solidtree")
    drawn, out = tmp_path / "a.solidtree", tmp_path / "a.png"
    status, told, _ = solidtree("render", drawn, out, "--compare-shadings", "--size", "400x100")
    assert status == 0
    with Image.open(out) as made:
        assert made.size == (400, 100)
    rows = told.splitlines()
    assert [row.split(":")[0] for row in rows] == ["flat and gouraud", "gouraud and phong", "phong and bumps"]
    status, _, refused = solidtree("render", drawn, tmp_path / "b.png", "--compare-shadings", "--ids")
    assert status == 2 and "--ids" in refused and not (tmp_path / "b.png").exists()


def test_render_removes_hidden_surfaces_as_it_is_told(tmp_path, solidtree):
    """Translucent faces: sorted ones are smoothed by samples, peeled ones by finer pixels, so pictures tell."""
    drawn = tmp_path / "a.solidtree"
    document = document_of(box(10, 10, 10).coloured("red"), sphere(6).at(9, 9, 9).coloured("blue"))
    save_project(document, drawn)
    made = {}
    for mode in ("bsp", "zbuffer"):
        out = tmp_path / f"{mode}.png"
        solidtree("render", drawn, out, "--hidden-surface", mode, "--opacity", 0.5, "--size", "120x90")
        made[mode] = np.asarray(Image.open(out))
    pairs = [(mesh, Paint(root.colour)) for root, mesh in solids(document)]
    for mode, found in made.items():
        np.testing.assert_array_equal(found, picture(pairs, (120, 90), opacity=0.5, hidden_surface=mode))
    assert not np.array_equal(made["bsp"], made["zbuffer"])
