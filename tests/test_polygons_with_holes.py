"""What outlines fill, as polygons with holes and as triangles: by formula, and against published areas."""

import json
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import Qt

from solidtree.model.document.errors import Refusal
from solidtree.model.script import Document, circle, document_of, inspected, path, polygon, rectangle
from solidtree.model.script import winged_edge as winged_edge_of

pytest_plugins = ["window_driver"]


def outline(rings):
    """Filled where an odd number of rings goes round."""
    starts = np.concatenate(([0], np.cumsum([len(ring) for ring in rings]))).tolist()
    loops = [list(range(*ends)) for ends in pairwise(starts)]
    return polygon([point for ring in rings for point in ring], loops=loops)


def judged(mesh, triangles):
    """Triangles cover the polygons: of n corners and h holes in a polygon come n + 2 h - 2; and their areas agree."""
    lists = mesh.lists
    corners = np.bincount(lists.loop_faces(), np.diff(lists.loop_starts), lists.face_count)
    holes = np.diff(lists.face_loops) - 1
    assert triangles.lists.face_count == int((corners + 2 * holes - 2).sum())
    assert triangles.area.sum() == pytest.approx(mesh.area.sum(), rel=1e-9)
    flat = np.linalg.norm(triangles.lists.normals, axis=1) == 0  # of corners in a line
    assert np.allclose(triangles.lists.normals[~flat], (0, 0, 1))


def test_a_plate_with_two_holes_and_an_island():
    plate = outline([
        [(0, 0), (20, 0), (20, 10), (0, 10)],
        [(2, 2), (2, 8), (8, 8), (8, 2)],
        [(12, 2), (12, 8), (18, 8), (18, 2)],
        [(4, 4), (6, 4), (6, 6), (4, 6)],
    ])  # fmt: skip
    mesh = inspected(plate)
    assert sorted(mesh.area.tolist()) == [4, 200 - 72]
    assert sorted(np.diff(mesh.lists.face_loops).tolist()) == [1, 3]
    (outer,) = np.flatnonzero(np.diff(mesh.lists.face_loops) == 3)
    areas = mesh.lists.loop_areas()[mesh.lists.face_loops[outer] : mesh.lists.face_loops[outer + 1], 2]
    assert areas.tolist() == [200, -36, -36]  # the outer loop counter-clockwise, holes clockwise
    judged(mesh, inspected(plate, triangles=True))
    found = mesh.topology
    assert (found.faces, found.loops, found.borders, found.components, found.closed) == (2, 4, 4, 2, False)
    edges = winged_edge_of(plate)
    assert len(edges) == 16 and all(len(edges.border(edge)) == 4 for edge in range(16))


def test_a_placed_outline_lies_in_its_plane_and_a_curved_one_within_the_tolerance():
    mesh = inspected(rectangle(4, 2).turned(x=90).at(0, 5, 0))
    assert np.allclose(mesh.lists.vertices[:, 1], 5) and np.allclose(np.abs(mesh.lists.normals), (0, 1, 0))
    disc = inspected(circle(10), tolerance=0.01)
    assert 0 < np.pi * 100 - disc.area.sum() < 2 * np.pi * 10 * 0.01


def test_what_fills_nothing_is_refused_in_words():
    with pytest.raises(Refusal, match="fills nothing"):
        inspected(path("M 0 0 L 5 0 L 5 5"))
    with pytest.raises(Refusal, match="there are 2"):
        inspected(document_of(rectangle(1, 1), rectangle(2, 2).at(5)))
    with pytest.raises(Refusal, match="there are 0"):
        inspected(Document())


def test_published_polygons_have_their_areas_and_are_covered_by_their_triangles(corpus):
    folder = corpus / "polygons"
    files = {file.stem: file for file in (folder / "earcut").rglob("*.json")}
    done = 0
    for case in json.loads((folder / "earcut.json").read_text()):
        rings = json.loads(files[case["name"]].read_text()) if case["name"] in files else []
        if not rings or min(map(len, rings)) < 3 or not case["evenodd_area"] > 1e-9 or case["vertices"] > 1200:
            continue  # a loop of one point, and what is no wider than rounding
        shape = outline(rings)
        mesh = inspected(shape, tolerance=0.001)
        assert mesh.area.sum() == pytest.approx(case["evenodd_area"], rel=1e-9), case["name"]
        judged(mesh, inspected(shape, triangles=True, tolerance=0.001))
        done += 1
    assert done >= 24


def test_the_panel_lists_a_polygon_that_was_cut_by_hand(make_window):
    """A triangle is subtracted from a rectangle; the Mesh panel shows one face of two loops, then its triangles."""
    driver = make_window(
        document_of(rectangle(20, 20).named("plate"), polygon([(5, 5), (12, 6), (8, 12)]).named("window"))
    )
    driver.click_row(driver.node("plate"))
    driver.click_row(driver.node("window"), Qt.KeyboardModifier.ControlModifier)
    driver.keys("Ctrl+Minus", driver.window.viewport)
    driver.qtbot.waitUntil(lambda: len(driver.document.profiles) == 1)
    driver.settle()
    driver.keys("Alt+W", driver.window.viewport)
    inspector = driver.window.mesh.inspector
    driver.qtbot.waitUntil(lambda: inspector.source.settled and inspector.mesh is not None, timeout=15000)
    assert np.diff(inspector.mesh.lists.face_loops).tolist() == [2]
    assert len(inspector.mesh.lists.corners) == 7
    inspector.source.set_polygons(False)
    driver.qtbot.waitUntil(lambda: inspector.source.settled and not inspector.mesh.polygons)
    assert inspector.mesh.lists.face_count == 7  # 7 + 2 - 2
    driver.keys("Ctrl+Z", driver.window.viewport)
    driver.settle()
    assert len(driver.document.profiles) == 2
