"""Pictures by pixels that are predicted, not stored."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hsr_scenes import read_scene
from render_meshes import ball, box, drilled

from solidtree.render.camera import Camera, project
from solidtree.render.look import LIGHT, LIGHTS, Paint, rgb
from solidtree.render.picture import facet_numbers, ids_picture, numbers_of, picture, write_png
from solidtree.render.views import standard_view

SIZE = (160, 120)
# Parallel, from the front: 0.25 mm a pixel, the picture's middle at x = 0, z = 0.
FRONT = Camera((0.0, -80.0, 0.0), (0.0, 0.0, 0.0), parallel=True, parallel_scale=15.0)


def test_a_box_from_the_front_covers_exactly_its_pixels():
    numbers = numbers_of(ids_picture([box((-10, 0, -5), (6, 4, 9))], SIZE, FRONT))
    wanted = np.zeros((120, 160), int)
    wanted[60 - 36 : 60 + 20, 80 - 40 : 80 + 24] = 1
    assert np.array_equal(numbers, wanted)


def test_perspective_puts_corners_where_the_camera_says():
    camera = Camera((30.0, -60.0, 40.0), (5.0, 5.0, 5.0), view_angle=25.0)
    numbers = numbers_of(ids_picture([box()], SIZE, camera))
    rows, columns = np.nonzero(numbers)
    x, y, _ = project(camera, box().points, SIZE).T
    found = np.array([columns.min(), columns.max() + 1, rows.min(), rows.max() + 1])
    assert np.abs(found - [x.min(), x.max(), y.min(), y.max()]).max() <= 1.0


def test_ids_of_two_boxes_are_exact_and_the_nearer_one_wins():
    left, right = box((-10, 0, -5), (2, 4, 5)), box((-2, 6, -5), (10, 9, 5))
    ids = ids_picture([left, right], SIZE, FRONT)
    assert ids.shape == (120, 160, 3) and ids.dtype == np.uint8
    numbers = numbers_of(ids)
    assert set(np.unique(numbers)) == {0, 1, 2}
    assert (numbers == 1).sum() == 48 * 40 and (numbers == 2).sum() == 32 * 40
    for view in ("iso", "back", "top"):
        assert set(np.unique(numbers_of(ids_picture([left, right], SIZE, view)))) == {0, 1, 2}


def test_ids_of_any_24_bits_survive():
    mesh = ball(48)
    values = np.random.default_rng(6).choice(2**24 - 1, len(mesh.triangles), replace=False) + 1
    values[0] = 2**24 - 1
    seen = np.unique(numbers_of(ids_picture([mesh], (400, 400), "iso", numbers=[values])))
    assert set(seen[1:]) <= set(values) and seen[0] == 0
    assert len(seen) > 0.4 * len(values)
    with pytest.raises(ValueError, match="numbers"):
        ids_picture([mesh], SIZE, numbers=[values + 1])
    with pytest.raises(ValueError, match="numbers"):
        ids_picture([mesh], SIZE, numbers=[values[:-1]])


def test_faces_are_numbered_through_all_solids():
    meshes = [box((0, 0, 0), (4, 4, 4)), box((5, 0, 0), (9, 4, 4))]
    numbers = facet_numbers(meshes)
    assert [set(values) for values in numbers] == [set(range(1, 7)), set(range(7, 13))]
    seen = np.unique(numbers_of(ids_picture(meshes, SIZE, "front", numbers=numbers, perspective=None)))
    assert list(seen) == [0, 3, 9]  # both faces across y at its lower end


def test_owner_maps_of_the_hidden_surface_scenes(corpus):
    """Independent ids: one ray cast in double precision for each pixel, from the corpus."""
    for name in ("chromium_three_way_split", "degenerate_triangles"):
        scene = read_scene(corpus / "hsr", name)
        for view in scene.views:
            found = numbers_of(ids_picture([scene.mesh], view.size, view.camera, numbers=[scene.numbers]))
            compared = ~view.skipped
            assert compared.sum() > 0.5 * compared.size
            assert (found == view.owners)[compared].mean() >= 0.999, (name, view.name)


def test_light_on_a_face_is_lamberts():
    """A face square to the view direction: ambient, each light's share by its cosine, and its highlight."""
    colours = picture([(box((-10, 0, -10), (10, 5, 10)), Paint("#8090a0"))], SIZE, FRONT, shading="flat")
    share = sum(strength * direction[2] / np.linalg.norm(direction) for direction, strength in LIGHTS)
    towards = np.array([direction for direction, _ in LIGHTS]) / [[np.linalg.norm(d)] for d, _ in LIGHTS]
    halfway = towards + np.array((0.0, 0.0, 1.0))
    shine = (halfway[:, 2] / np.linalg.norm(halfway, axis=1)) ** LIGHT.specular_power
    highlight = LIGHT.specular * float(shine @ [strength for _, strength in LIGHTS])
    wanted = 255.0 * np.minimum(np.array(rgb("#8090a0")) * (LIGHT.ambient + LIGHT.diffuse * share) + highlight, 1.0)
    assert np.abs(colours[60, 80].astype(float) - wanted).max() <= 1.0


def test_gouraud_is_interpolated_and_phong_is_not():
    """On a coarse ball the highlight lies inside a face: Phong finds it there, Gouraud only at the corners."""
    mesh = ball(12)
    flat, gouraud, phong = (
        picture([(mesh, None)], (200, 200), "iso", shading=shading).astype(int)
        for shading in ("flat", "gouraud", "phong")
    )
    assert np.abs(gouraud - phong).max() > 8
    assert np.abs(gouraud - flat).max() > 8
    one = picture([(box((-9, 0, -9), (9, 1, 9)), None)], SIZE, FRONT, shading="gouraud")
    assert np.ptp(one[30:90, 50:110].reshape(-1, 3), axis=0).max() <= 1


def test_backgrounds():
    solid = [(box((-10, 0, -5), (6, 4, 9)), None)]
    assert (picture(solid, SIZE, FRONT, background="#0080ff")[5, 5] == (0, 128, 255)).all()
    top, bottom = picture(solid, SIZE, FRONT)[[0, -1], 3].astype(float)
    assert np.abs(top - 255.0 * np.array(rgb(LIGHT.background_top))).max() <= 2.0
    assert np.abs(bottom - 255.0 * np.array(rgb(LIGHT.background_bottom))).max() <= 2.0
    clear = picture(solid, SIZE, FRONT, background="transparent")
    assert clear.shape == (120, 160, 4)
    assert clear[5, 5, 3] == 0 and clear[60, 80, 3] == 255
    assert (clear[..., 3] == 255).sum() == 64 * 56


def test_opacity_lets_the_far_solid_through():
    near, far = (box((-5, 0, -5), (5, 2, 5)), "#ff0000"), (box((-5, 10, -5), (5, 12, 5)), "#0000ff")
    solids = [(mesh, Paint(colour)) for mesh, colour in (near, far)]
    opaque = picture(solids, SIZE, FRONT, background="white")[60, 80].astype(int)
    clear = picture(solids, SIZE, FRONT, background="white", opacity=0.5)[60, 80].astype(int)
    assert opaque[2] < 40
    assert clear[2] > opaque[2] + 20 and clear[0] > clear[2]


def test_edges_and_hidden_lines():
    mesh = drilled()
    shaded, edges, hidden, wire = (
        picture([(mesh, Paint("white"))], (300, 300), "iso", style=style).astype(int)
        for style in ("shaded", "edges", "hidden-line", "wireframe")
    )
    dark = np.array(rgb(LIGHT.edge)) * 255.0
    count = {
        name: (np.abs(image - dark).max(axis=2) < 60).sum()
        for name, image in (("shaded", shaded), ("edges", edges), ("hidden", hidden), ("wire", wire))
    }
    assert count["shaded"] + 300 < count["edges"]
    assert count["wire"] > 1.2 * count["hidden"] > 200  # the far edges and the lower rim of the hole are hidden
    plain = np.round(255.0 * np.array(rgb(LIGHT.plain_background)))
    assert (hidden[5, 5] == plain).all() and (hidden[100, 100] == plain).all()


def test_a_smooth_ball_has_a_hidden_line_picture():
    image = picture([(ball(), None)], (120, 120), standard_view(FRONT, "front"), style="hidden-line").astype(int)
    ink = image.sum(axis=2) < 500
    rows, columns = np.nonzero(ink)
    radius = np.hypot(columns - 59.5, rows - 59.5)
    assert np.abs(radius - 40.0).max() < 2.0
    assert len(np.unique(np.round(np.degrees(np.arctan2(rows - 59.5, columns - 59.5)) / 10.0))) >= 36


def test_nothing_to_see_and_refusals():
    assert picture([], (20, 10)).shape == (10, 20, 3)
    assert not ids_picture([], (20, 10)).any()
    solid = [(box(), None)]
    for wrong in ({"size": (0, 10)}, {"size": (10, 20000)}, {"view": "above"}, {"style": "oil"}, {"shading": "none"}):
        with pytest.raises(ValueError):
            picture(solid, **{"size": (20, 10), **wrong})


def test_png_comes_back(tmp_path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    rng = np.random.default_rng(7)
    for channels in (1, 3, 4):
        image = rng.integers(0, 256, (7, 5, channels), np.uint8)
        path = tmp_path / f"{channels} färg.png"
        write_png(path, image)
        assert path.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
        reader = vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        back = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(7, 5, -1)
        assert np.array_equal(np.flipud(back), image)
    with pytest.raises(ValueError, match="bytes"):
        write_png(tmp_path / "x.png", np.zeros((3, 3)))
    with pytest.raises(OSError):
        write_png(tmp_path / "nowhere" / "x.png", image)


@pytest.mark.skipif(sys.platform != "linux", reason="only there a display is optional")
def test_without_a_display_nothing_is_said_and_the_picture_is_there():
    program = (
        "from render_meshes import box\nfrom solidtree.render.picture import ids_picture\n"
        "print(ids_picture([box()], (40, 30)).any())"
    )
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    environment["PYTHONPATH"] = os.path.dirname(__file__)
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout.strip(), done.stderr.strip()) == (0, "True", "")
