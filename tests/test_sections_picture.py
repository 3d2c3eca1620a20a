"""Sections in pictures: what is cut away, what the caps show, and what is under the pointer."""

import numpy as np
import pytest
from render_meshes import ball, box, drilled

from solidtree.model.document.document import Section
from solidtree.render.camera import Camera
from solidtree.render.look import LIGHT, Paint, mixed, rgb
from solidtree.render.picture import picture
from solidtree.render.sections import Sections
from solidtree.render.viewer import Viewer

SIZE = (160, 120)
# Parallel, from the front: 0.25 mm a pixel, the picture's middle at x = 0, z = 0.
FRONT = Camera((0.0, -80.0, 0.0), (0.0, 0.0, 0.0), parallel=True, parallel_scale=15.0)
TOP = Camera((0.0, 0.0, 80.0), (0.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), parallel=True, parallel_scale=15.0)
PLAIN = (1.0, 1.0, 1.0)


def taken(solids, *sections, camera=FRONT, style="shaded"):
    return picture(solids, SIZE, camera, style=style, background=PLAIN, sections=sections).astype(int)


def colour(*parts):
    return np.round(255 * np.array(mixed(*parts)))


def close_to(pixels, wanted, slack=3):
    return np.abs(pixels - wanted).max(axis=2) <= slack


@pytest.fixture
def viewer():
    viewer = Viewer()
    viewer.resize(*SIZE)
    viewer.set_ground(False)
    viewer.set_cube(False)
    viewer.set_camera(FRONT)
    yield viewer
    viewer.close()


@pytest.mark.parametrize("style", ["shaded", "edges", "wireframe", "hidden-line"])
def test_what_lies_behind_the_plane_is_gone_in_every_style(style):
    block = box((-10, -10, -5), (10, 10, 5))
    pixels = taken([(block, None)], Section("s", (2, 0, 0), (-1, 0, 0)), style=style)
    drawn = ~close_to(pixels, 255, 1)
    assert not drawn[:, 80 + 8 + 3 :].any()  # to the right of x = 2, and half a bold line
    assert drawn[:, 80 - 40 : 80 + 8].any()
    assert np.array_equal(taken([(block, None)], Section("s", (2, 0, 0), (-1, 0, 0), active=False), style=style),
                          taken([(block, None)], style=style))  # fmt: skip


def test_a_cap_fills_the_cut_with_the_solids_colour_and_leaves_the_hole_open():
    part = drilled(size=20.0)  # the drill has 6 mm of radius, along z
    pixels = taken([(part, Paint("#c04020"))], Section("s", (0, 0, 0), (0, 0, -1)), camera=TOP)
    fill = close_to(pixels, colour(rgb("#c04020"), rgb(LIGHT.cut), 0.5))
    y, x = np.mgrid[0:120, 0:160]
    u, v = (x + 0.5 - 80) / 4, (60 - y - 0.5) / 4
    inside = (np.abs(u) < 9.5) & (np.abs(v) < 9.5) & (np.hypot(u, v) > 6.5)
    assert 0.6 < fill[inside].mean() < 0.98  # the rest is hatched
    assert not fill[np.hypot(u, v) < 5.5].any() and not fill[np.maximum(np.abs(u), np.abs(v)) > 10.5].any()


def test_hatches_of_neighbours_lean_to_other_sides():
    left, right = box((-12, -5, -9), (-1, 5, 9)), box((1, -5, -9), (12, 5, 9))
    pixels = taken([(left, None), (right, None)], Section("s", (0, 0, 0), (0, 1, 0)))
    fill = colour(rgb(LIGHT.solid), rgb(LIGHT.cut), 0.5)
    lean = []
    for columns in (slice(40, 72), slice(88, 120)):
        lines = np.abs(pixels[35:85, columns] - fill).max(axis=2).astype(float)
        lines -= lines.mean()
        lean.append([float((lines[1:, 1:] * lines[:-1, :-1]).sum()), float((lines[1:, :-1] * lines[:-1, 1:]).sum())])
    (falls, rises), (other_falls, other_rises) = lean
    assert rises > 2 * falls and other_falls > 2 * other_rises


def test_the_hatch_is_as_wide_on_the_screen_at_every_distance():
    shares = []
    for zoom in (0.37, 1.0, 14.0):
        wide = box((-16 * zoom, -5, -12 * zoom), (16 * zoom, 5, 12 * zoom))
        camera = Camera((0, -80, 0), (0, 0, 0), parallel=True, parallel_scale=15.0 * zoom)
        pixels = taken([(wide, None)], Section("s", (0, 0, 0), (0, 1, 0)), camera=camera)[20:100, 30:130]
        shares.append((~close_to(pixels, colour(rgb(LIGHT.solid), rgb(LIGHT.cut), 0.5))).mean())
    assert max(shares) < 1.6 * min(shares) and min(shares) > 0.05


def test_caps_are_cut_by_the_other_planes():
    block = box((-10, -10, -10), (10, 10, 10))
    both = Section("a", (0, 0, 0), (0, 1, 0)), Section("b", (0, 0, 3), (0, 0, -1))
    pixels = taken([(block, None)], *both)
    drawn = ~close_to(pixels, 255, 1)
    assert not drawn[: 60 - 12 - 3].any()  # above z = 3, and half a bold line
    assert drawn[60 - 12 + 2 : 60 + 40, 80 - 38 : 80 + 38].all()


def test_hidden_line_and_wireframe_hatch_without_a_fill():
    block = box((-10, -10, -10), (10, 10, 10))
    cut = Section("s", (0, 0, 0), (0, 1, 0))
    for style in ("hidden-line", "wireframe"):
        inner = taken([(block, None)], cut, style=style)[30:90, 50:110]
        assert 0.3 < close_to(inner, 255).mean() < 0.97


def test_a_pick_finds_the_cap_and_nothing_that_is_cut_away(viewer):
    viewer.show({"n1": (drilled(root="n1"), None)})
    hit = viewer.pick(80.5, 60.5)
    assert hit is not None and hit.point[1] == pytest.approx(-10) and not hit.section
    viewer.set_sections([Section("cut", (0, 0, 0), (0, 1, 0))])
    wall = viewer.pick(80.5, 60.5)  # through the drilled hole, onto its far wall
    assert wall is not None and wall.point[1] == pytest.approx(6, abs=0.1) and wall.path == ("n1", "drill")
    cap = viewer.pick(80.5 + 4 * 8, 60.5)
    assert cap is not None and cap.section == "cut" and cap.path == ("n1",) and cap.triangle == cap.facet == -1
    assert cap.point == pytest.approx((8.125, 0, -0.125)) and cap.normal == pytest.approx((0, -1, 0))
    assert viewer.pick(80.5 + 4 * 11, 60.5) is None
    viewer.set_sections([Section("cut", (0, 0, 0), (0, 1, 0)), Section("top", (0, 0, -2), (0, 0, -1))])
    assert viewer.pick(80.5 + 4 * 8, 60.5) is None  # that cap is cut away in turn
    viewer.set_sections([Section("all", (0, 0, 99), (0, 0, 1))])
    assert viewer.pick(80.5, 60.5) is None
    viewer.set_sections([])
    assert viewer.pick(80.5, 60.5) == hit


def test_picks_and_pixels_agree_on_a_cut_ball(viewer):
    viewer.show({"a": (ball(48, root="a"), None)})
    viewer.set_sections([Section("s", (0, 0, 0), (0.5, 0.8, -0.3))])
    viewer.render()
    drawn = np.abs(viewer.pixels().astype(int) - viewer.pixels()[0, 0]).max(axis=2) > 24
    for x, y in [(40, 60), (60, 40), (80, 60), (100, 80), (110, 60), (70, 95), (20, 20), (150, 60), (80, 25)]:
        patch = drawn[y - 2 : y + 3, x - 2 : x + 3]
        if patch.all() or not patch.any():
            assert (viewer.pick(x + 0.5, y + 0.5) is not None) == bool(patch.all()), (x, y)


def test_only_what_changed_is_cut_anew(viewer):
    still, moved = box(root="a"), box((20, 0, 0), (30, 10, 10), root="b")
    viewer.show({"a": (still, None), "b": (moved, None)})
    viewer.set_sections([Section("s", (0, 0, 5), (0, 0, -1)), Section("t", (0, 5, 0), (0, 1, 0))])
    before, other = viewer.scene.sections.outlines("s"), viewer.scene.sections.outlines("t")
    viewer.show({"a": (still, None), "b": (box((21, 0, 0), (31, 10, 10), root="b"), None)})
    after = viewer.scene.sections.outlines("s")
    assert after["a"] is before["a"] and after["b"] is not before["b"]
    assert after["a"].area == pytest.approx(100.0) and after["b"].bounds[0][0] == 21.0
    viewer.set_sections([Section("s", (0, 0, 6), (0, 0, -1)), Section("t", (0, 5, 0), (0, 1, 0))])
    assert viewer.scene.sections.outlines("s")["a"] is not after["a"]
    assert viewer.scene.sections.outlines("t")["a"] is other["a"]
    assert viewer.scene.sections.outlines("none") == {}


def test_a_theme_and_a_selection_recolour_the_cap(viewer):
    viewer.show({"a": (box((-10, -10, -10), (10, 10, 10), root="a"), None)})
    viewer.set_sections([Section("s", (0, 0, 0), (0, 1, 0))])
    seen = []
    for change in (lambda: None, lambda: viewer.set_selection({("a",)}), lambda: viewer.set_theme("dark")):
        change()
        viewer.render()
        seen.append(np.median(viewer.pixels()[30:90, 50:110].reshape(-1, 3), axis=0))
    assert seen[1][0] > seen[1][2] and seen[0][2] >= seen[0][0]  # the orange of the selection
    assert np.abs(seen[2] - seen[1]).max() > 20


def test_seven_planes_are_cut_by_six(viewer):
    sections = Sections(viewer.renderer)
    sections.set_planes([Section(f"s{i}", (0, 0, i), (0, 0, -1)) for i in range(7)])
    assert len(sections.planes) == 6
    near, far = sections.span((0, 0, 10), (0, 0, -1))
    assert near == pytest.approx(10.0) and far == np.inf
    assert sections.span((0, 0, 10), (1, 0, 0))[0] > sections.span((0, 0, 10), (1, 0, 0))[1]
