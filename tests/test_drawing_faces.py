"""Areas of drawings: sizes by formula, what is covered really removed, one area a flat face, hostile input."""

import itertools
import math

import numpy as np
import pytest
from manifold3d import CrossSection, FillRule
from test_drawing_lines import ISO, MODELS, imported, menger, scene, views_of

from solidtree.model.drawing.drawing import Drawing, draw
from solidtree.model.drawing.projection import looking, standard
from solidtree.model.drawing.scene import Scene
from solidtree.model.script import box, cylinder, sphere, union
from solidtree.model.section.section import SectionOutline, plane_through


def drawn(solids: Scene, view: str = "iso") -> Drawing:
    return draw(solids, standard(view, solids.extent))


def sizes(drawing: Drawing) -> list[float]:
    return sorted(area.size for area in drawing.areas)


def silhouette(solids: Scene, view) -> float:
    """The area of the union of all triangles in the picture."""
    faces = solids.faces()
    flat = view.picture(faces.points)[:, :2]
    low, scale = flat.min(axis=0), 100 / np.ptp(flat, axis=0).max()
    triangles = ((flat - low) * scale)[faces.corners.reshape(-1, 3)]
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    turn = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    triangles = np.where((turn < 0)[:, None, None], triangles[:, ::-1], triangles)[np.abs(turn) > 1e-12]
    return CrossSection(list(triangles), FillRule.NonZero).area() / scale**2


def test_an_isometric_cube_shows_three_rhombi():
    found = drawn(scene(box(10)))
    assert sizes(found) == 3 * [pytest.approx(100 / math.sqrt(3))]
    assert sorted(area.normal for area in found.areas) == [(0, -1, 0), (0, 0, 1), (1, 0, 0)]
    assert all(len(area.contours) == 1 and len(area.contours[0]) == 4 for area in found.areas)
    assert len({round(area.shade, 3) for area in found.areas}) == 3  # told apart by their light
    assert found.bounds.tolist() == [
        pytest.approx([-10 / math.sqrt(2), -10 * ISO]),
        pytest.approx([10 / math.sqrt(2), 10 * ISO]),
    ]
    assert found.extent.tolist() == [[0, 0, 0], [10, 10, 10]]


def test_what_is_covered_is_not_there():
    """From above, a plate over a larger one leaves a frame with a hole."""
    found = drawn(scene(low=box(30, 20, 1), high=box(10, 8, 1).at(5, 6, 10)), "top")
    frame, plate = sorted(found.areas, key=lambda area: -area.size)
    assert (frame.size, plate.size) == (pytest.approx(520), pytest.approx(80))
    outer, hole = sorted(frame.contours, key=len)[0], min(frame.contours, key=lambda c: np.ptp(c, axis=0).max())
    assert [len(contour) for contour in frame.contours] == [4, 4]
    signs = [turning(contour) > 0 for contour in frame.contours]
    assert sorted(signs) == [False, True] and turning(hole) < 0 and len(outer) == 4
    assert [found.layers[area.layer].name for area in (frame, plate)] == ["low", "high"]


def turning(contour) -> float:
    ahead = np.roll(contour, -1, axis=0)
    return float((contour[:, 0] * ahead[:, 1] - contour[:, 1] * ahead[:, 0]).sum())


def test_a_flat_face_is_one_area_whatever_its_triangles():
    holes = union(
        *(cylinder(radius=2, height=9, segments=32).at(6 + 8 * i, 6 + 8 * j, -2) for i in range(6) for j in range(6))
    )
    found = drawn(scene(box(52, 52, 5) - holes), "top")
    assert len(found.areas) == 1 and len(found.areas[0].contours) == 37
    hole = 32 / 2 * 4 * math.sin(2 * math.pi / 32)
    assert found.areas[0].size == pytest.approx(52 * 52 - 36 * hole, rel=1e-9)


def test_the_sponge_from_the_front_has_the_area_of_the_carpet():
    found = drawn(scene(menger(2)), "front")
    assert len(found.areas) == 1
    assert found.areas[0].size == pytest.approx(9 * 9 * (8 / 9) ** 2, rel=1e-9)


def test_the_two_halves_of_crossing_solids_are_on_their_own_layers():
    found = drawn(scene(left=box(10), right=box(10).at(5, 0, 0)), "top")
    by_layer = {layer.name: 0.0 for layer in found.layers}
    for area in found.areas:
        by_layer[found.layers[area.layer].name] += area.size
    assert sum(by_layer.values()) == pytest.approx(150) and min(by_layer.values()) >= 50 - 1e-9


@pytest.mark.parametrize("name", MODELS)
def test_areas_add_up_to_the_silhouette(name):
    solids = MODELS[name]()
    for view in views_of(solids.extent)[:3]:
        found = draw(solids, view)
        assert sum(sizes(found)) == pytest.approx(silhouette(solids, view), rel=1e-8)
        assert all(area.size > 0 for area in found.areas)


@pytest.mark.parametrize("name", MODELS)
def test_an_eye_inside_the_scene_sees_each_area_once(name):
    """What is seen in random directions by a ray is the area that holds the point."""
    solids = MODELS[name]()
    view = views_of(solids.extent)[3]
    found = draw(solids, view)
    faces = solids.faces()
    triangles = faces.points[faces.corners.reshape(-1, 3)]
    rng = np.random.default_rng(4)
    picture = rng.uniform(-1, 1, (300, 2)) * view.frame
    holding = np.array([holds(area.contours, picture) for area in found.areas])
    a, e1, e2 = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    wrong = 0
    for place, (x, y) in enumerate(picture):
        ray = view.axes.T @ np.array([x, y, -view.focal])
        normal = np.cross(e1, e2)
        down = -(normal @ ray)
        arm = view.eye - a
        with np.errstate(all="ignore"):
            share = (arm * normal).sum(axis=1) / down
            sideways = np.cross(arm, ray)
            u, v = (sideways * e2).sum(axis=1) / down, -(sideways * e1).sum(axis=1) / down
        hit = np.flatnonzero((u > 0) & (v > 0) & (u + v < 1) & (share > 1e-4) & np.isfinite(share))
        seen = holding[:, place]
        if not len(hit):
            wrong += bool(seen.any())
            continue
        nearest = hit[np.argmin(share[hit])]
        expected = normal[nearest] / np.linalg.norm(normal[nearest])
        normals = [np.array(found.areas[i].normal) for i in np.flatnonzero(seen)]
        wrong += not (len(normals) == 1 and abs(float(normals[0] @ expected)) > 1 - 1e-6)
    assert wrong <= 1  # a ray may pass within rounding of a border


def holds(contours, points):
    """(n,) by the even-odd rule."""
    sizes = [len(contour) for contour in contours]
    outline = SectionOutline(
        plane_through((0, 0, 0), (0, 0, 1)),
        np.concatenate(contours),
        np.concatenate(([0], np.cumsum(sizes))),
        np.zeros(sum(sizes), np.int32),
    )
    return outline.holds(points)


def test_an_eye_inside_a_solid_sees_its_walls():
    view = looking((5, 5, 5), (5, 9, 5), perspective=60)
    found = draw(scene(box(10)), view)
    assert sum(sizes(found)) == pytest.approx(4 * view.frame[0] * view.frame[1])
    assert (0, -1, 0) in [area.normal for area in found.areas]


def test_a_thin_wall_between_eye_and_ball_hides_it():
    found = drawn(scene(ball=sphere(5), wall=box(40, 0.001, 40, centred=True).at(0, -10, 0)), "front")
    assert sizes(found) == [pytest.approx(1600)]


def test_both_sides_of_an_open_surface_are_seen_and_its_flat_parts_are_one_area(tmp_path):
    corners = list(itertools.product((0, 10), repeat=3))
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4)]
    tub = imported(tmp_path, corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    found = drawn(tub)
    # The two outer walls, and through the open lid the two inner ones: together the hexagon.
    assert sizes(found) == [pytest.approx(size / math.sqrt(3)) for size in (50, 50, 100, 100)]
    assert all(np.dot(area.normal, (1, -1, 1)) > 0 for area in found.areas)
    assert sizes(drawn(tub, "top")) == [pytest.approx(100)]


@pytest.mark.parametrize(
    ("points", "triangles", "size"),
    [
        ([(0, 0, 0), (10, 0, 0), (0, 10, 0)], [(0, 1, 2)], 50),
        ([(0, 0, 0), (10, 0, 0), (0, 10, 0)], [(0, 1, 2), (0, 1, 2), (2, 1, 0)], 50),
        ([(0, 0, 0), (10, 0, 0), (0, 10, 0), (5, 0, 0)], [(0, 1, 2), (0, 1, 3), (0, 0, 2)], 50),
        ([(0, 0, 0), (10, 0, 0), (5, 0, 10)], [(0, 1, 2)], 0),
        ([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 1), (9, 0, -1), (0, 9, 1)], [(0, 1, 2), (3, 4, 5)], 40.5),
    ],
    ids=["one", "duplicates", "degenerate", "edge-on", "crossing"],
)
def test_hostile_triangles_cover_what_they_cover(tmp_path, points, triangles, size):
    assert sum(sizes(drawn(imported(tmp_path, points, triangles), "top"))) == pytest.approx(size)


@pytest.mark.parametrize(("scale", "away"), [(1e-4, 0.0), (1e5, 0.0), (1.0, 1e6)])
def test_size_and_place_of_a_scene_do_not_matter(scale, away):
    part = box(10 * scale) - cylinder(radius=2 * scale, height=30 * scale, segments=16).at(*(3 * [5 * scale]))
    found, plain = (
        drawn(scene(part.at(away, 0, 0))),
        drawn(scene(box(10) - cylinder(radius=2, height=30, segments=16).at(5, 5, 5))),
    )
    assert [size / scale**2 for size in sizes(found)] == [pytest.approx(size, rel=1e-6) for size in sizes(plain)]
    assert (found.lines.count, found.lines.hidden.sum()) == (plain.lines.count, plain.lines.hidden.sum())


def test_the_tree_is_built_once_for_all_views():
    solids = scene(box(10), sphere(3).at(20, 0, 0))
    draw(solids, standard("iso", solids.extent))
    tree = solids.tree()
    draw(solids, standard("front", solids.extent))
    assert solids.tree() is tree and tree.faces is solids.faces()
