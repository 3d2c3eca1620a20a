"""The viewer off screen: what is drawn, what is under the pointer, and the view cube."""

import numpy as np
import pytest
from render_meshes import box, drilled

from solidtree.model.script import rectangle
from solidtree.model.solid.outlines.sheet import sheet_of
from solidtree.render.camera import fit, orbit, project, zoom
from solidtree.render.look import DARK, LIGHT, rgb
from solidtree.render.view_cube import MARGIN, SIDES, SIZE
from solidtree.render.viewer import Viewer
from solidtree.render.views import standard_view


@pytest.fixture
def viewer():
    viewer = Viewer()
    viewer.resize(360, 240)
    yield viewer
    viewer.close()


def test_it_draws_fits_and_follows_the_window(viewer):
    mesh = drilled()
    viewer.set_ground(False)
    viewer.set_cube(False)
    viewer.render()
    empty = viewer.pixels()
    viewer.show({"part": (mesh, None)})
    viewer.fit()
    assert viewer.needs_render
    viewer.render()
    assert not viewer.needs_render
    changed = np.abs(viewer.pixels().astype(int) - empty).max(axis=2) > 12
    x, y, _ = project(viewer.camera, mesh.points, viewer.size).T
    rows, columns = np.nonzero(changed)
    found = (columns.min(), columns.max(), rows.min(), rows.max())
    assert np.abs(np.subtract(found, (x.min(), x.max(), y.min(), y.max()))).max() < 2.5
    viewer.resize(200, 100, 1.5)
    viewer.render()
    assert viewer.pixels().shape == (150, 300, 3)


def test_what_is_picked_is_what_is_drawn(viewer):
    viewer.show({"part": (drilled(), [None, "#d04040"])})
    viewer.set_ground(False)
    viewer.set_cube(False)
    for parallel in (False, True):
        viewer.set_projection(parallel)
        viewer.fit()
        viewer.render()
        image = viewer.pixels().astype(int)
        seen = set()
        for x, y in np.random.default_rng(8).uniform((90.0, 10.0), (270.0, 230.0), (150, 2)):
            pick = viewer.pick(x, y)
            red, _, blue = image[int(y), int(x)]
            around = image[max(int(y) - 2, 0) : int(y) + 3, max(int(x) - 2, 0) : int(x) + 3]
            if np.ptp(around[..., 0] - around[..., 2]) > 15:
                continue  # a border between two colours
            seen.add(None if pick is None else pick.path)
            if pick is not None and pick.subtracted:
                assert red > blue + 30
            elif pick is not None:
                assert red < blue
        assert seen == {None, ("part", "cube"), ("part", "drill")}


def test_picking_in_parallel_projection_sees_what_is_behind_the_eye(viewer):
    viewer.show({"box": (box((-5, -5, -5), (5, 5, 5)), None)})
    viewer.set_camera(standard_view(viewer.camera, "front"))
    viewer.set_projection(True)
    viewer.set_camera(zoom(viewer.camera, 0.5))
    inside = fit(viewer.camera, [[-1, -1, -1], [1, 1, 1]], 1.5)
    viewer.set_camera(inside)
    pick = viewer.pick(180, 120)
    assert pick is not None and pick.point == pytest.approx((0.0, -5.0, 0.0))


def test_the_camera_is_announced_once(viewer):
    cameras = []
    viewer.changed_camera = cameras.append
    viewer.set_camera(orbit(viewer.camera, 10.0, 5.0))
    viewer.set_camera(viewer.camera)
    viewer.set_projection(True)
    assert len(cameras) == 2 and cameras[-1] is viewer.camera and viewer.camera.parallel


def test_cube_faces_edges_and_corners(viewer):
    middle = (360 - MARGIN - SIZE / 2, MARGIN + SIZE / 2)
    for side in SIDES:
        viewer.set_camera(standard_view(viewer.camera, side))
        viewer.render()
        assert viewer.cube_hit(*middle) == side
        assert viewer.cube_hit(middle[0] - SIZE, middle[1]) is None
        assert viewer.cube_hit(middle[0] + SIZE / 2 - 1, middle[1]) is None
    viewer.set_camera(standard_view(viewer.camera, "iso"))
    viewer.render()
    assert viewer.cube_hit(*middle) == "front-right-top"
    names = {viewer.cube_hit(middle[0] + dx, middle[1] + dy) for dx in range(-50, 51, 4) for dy in range(-50, 51, 4)}
    assert {"front", "right", "top", "front-right", "front-top", "right-top"} <= names
    for name in names - {None}:
        turned = standard_view(viewer.camera, name)
        viewer.set_camera(turned)
        viewer.render()
        assert viewer.cube_hit(*middle) == name
        viewer.set_camera(standard_view(viewer.camera, "iso"))
        viewer.render()


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_the_cube_is_drawn_readable_and_lights_up_under_the_pointer(viewer, theme):
    viewer.set_theme(theme.name)
    viewer.set_camera(standard_view(viewer.camera, "front"))
    viewer.render()
    corner = viewer.pixels()[MARGIN : MARGIN + SIZE, 360 - MARGIN - SIZE : 360 - MARGIN].astype(float)
    face = np.array([corner[SIZE // 2 - 20, SIZE // 2]])
    text = 255.0 * np.array(rgb(theme.cube_text))
    ink = np.abs(corner - text).max(axis=2) < 40
    assert ink[SIZE // 2 - 8 : SIZE // 2 + 8].sum() > 60  # FRONT
    assert np.abs(face - text).mean() > 80
    assert viewer.set_cube_hover("front")
    assert not viewer.set_cube_hover("front")
    viewer.render()
    lit = viewer.pixels()[MARGIN + SIZE // 2 - 20, 360 - MARGIN - SIZE // 2].astype(float)
    assert np.abs(lit - face).max() > 25


def test_hover_says_whether_to_draw(viewer):
    viewer.show({"box": (box(), None)})
    viewer.render()
    assert viewer.set_hover(("box", "a"))
    assert viewer.needs_render
    viewer.render()
    assert not viewer.set_hover(("box", "a"))
    assert not viewer.needs_render


def test_all_styles_and_translucency_draw_something(viewer):
    viewer.show({"part": (drilled(), None)})
    viewer.fit()
    images = []
    for style in ("shaded", "edges", "wireframe", "hidden-line"):
        viewer.set_style(style)
        viewer.render()
        images.append(viewer.pixels())
    viewer.set_style("shaded")
    viewer.set_opacity(0.4)
    viewer.render()
    images.append(viewer.pixels())
    for index, image in enumerate(images):
        assert all((image != other).any() for other in images[:index])
    middle = [image[120, 180].astype(int) for image in images]
    assert np.abs(middle[0] - middle[-1]).max() > 5


def test_after_close_nothing_happens(viewer):
    viewer.close()
    viewer.close()
    viewer.render()


def test_an_outline_on_a_face_is_seen_without_gaps(viewer):
    sheet = sheet_of(rectangle(7.3, 6.1).turned(z=20).at(3, 2, 10).with_(id="sheet"), 0.05)
    viewer.set_ground(False)
    viewer.set_cube(False)
    viewer.show({"box": (box(), None), "sheet": (sheet, ["#ff2020"])})
    for around in (0, 70, 200):
        viewer.set_camera(orbit(viewer.fitted(standard_view(viewer.camera, "iso")), around, 0))
        viewer.render()
        inside = np.random.default_rng(1).uniform((0.5, 0.5, 0), (6.8, 5.6, 0), (400, 3))
        turn = np.radians(20)
        axes = np.array([[np.cos(turn), np.sin(turn), 0], [-np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
        x, y, _ = project(viewer.camera, inside @ axes + (3, 2, 10), viewer.size).T
        pixels = viewer.pixels()[y.astype(int), x.astype(int)].astype(int)
        assert np.ptp(pixels[:, 0] - pixels[:, 2]) < 12
