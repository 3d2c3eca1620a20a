"""Snapping in a plane: nodes, middles, curves, lines through nodes, directions, the grid, corners of solids."""

from types import SimpleNamespace

import numpy as np
import pytest
from render_meshes import box

from solidtree.gui.curves.drawing.near_pointer import REACH
from solidtree.gui.curves.drawing.snapping import Snapper
from solidtree.model.document.placement import IDENTITY
from solidtree.model.document.tree import numbered
from solidtree.model.editing.session import Session
from solidtree.model.script import circle, document_of, path
from solidtree.render.camera import Camera, project
from solidtree.render.viewer import Viewer

SHAPE = path([("move", (0, 0)), ("line", (40, 0)), ("cubic", (60, 10), (60, 20), (40, 30))])


@pytest.fixture
def viewer():
    made = Viewer()
    made.resize(800, 600)
    made.set_camera(Camera((20.0, 10.0, 300.0), (20.0, 10.0, 0.0), (0.0, 1.0, 0.0)))  # 0.27 mm a pixel, grid 5 mm
    yield made
    made.close()


@pytest.fixture
def snapper(viewer):
    return snapper_of(viewer, SHAPE)


def snapper_of(viewer, *outlines, **more):
    session = Session(document_of(**more).with_(profiles=numbered(outlines)))
    return Snapper(SimpleNamespace(viewer=viewer), session)


def pixel(viewer, x, y, z=0.0):
    return tuple(project(viewer.camera, [(x, y, z)], viewer.size)[0, :2])


def at(viewer, snapper, x, y, frame=IDENTITY, **more):
    return snapper.snap(pixel(viewer, x, y), frame, **more)


def test_a_node_within_reach_comes_before_everything_else(viewer, snapper):
    found = at(viewer, snapper, 40.9, 0.8)
    assert found.kind == "node" and found.point.tolist() == [40, 0] and found.words == "on node"
    assert at(viewer, snapper, 40.9, 0.8, free=True).kind == "free"


def test_reach_is_in_pixels(viewer, snapper):
    x, y = pixel(viewer, 40, 30)
    assert snapper.snap((x + REACH - 0.5, y), IDENTITY).kind == "node"
    assert snapper.snap((x + REACH + 0.5, y), IDENTITY).kind != "node"


def test_middles_and_points_of_curves_are_exact(viewer, snapper):
    assert at(viewer, snapper, 20.2, 0.3).point.tolist() == [20, 0]
    found = at(viewer, snapper, 46.5, 4.0)
    assert found.kind == "curve"
    t = np.linspace(0, 1, 200_001)[:, None]
    controls = np.array([(40, 0), (60, 10), (60, 20), (40, 30)], float)
    curve = ((1 - t) ** 3 * controls[0] + 3 * t * (1 - t) ** 2 * controls[1] + 3 * t**2 * (1 - t) * controls[2]
             + t**3 * controls[3])  # fmt: skip
    assert np.linalg.norm(curve - found.point, axis=1).min() < 1e-3
    best = curve[np.linalg.norm(curve - (46.5, 4.0), axis=1).argmin()]
    assert found.point == pytest.approx(best, abs=1e-3)


def test_a_point_is_in_line_with_nodes_and_says_with_which(viewer, snapper):
    found = at(viewer, snapper, 39.3, 47.2)
    assert found.kind == "guide" and found.point[0] == 40
    assert [line.tolist() for line in found.guides] == [[[40, 30], found.point.tolist()]]
    both = at(viewer, snapper, 0.6, 30.5)
    assert both.point.tolist() == [0, 30] and len(both.guides) == 2


def test_a_curve_and_a_guide_meet(viewer):
    snapper = snapper_of(viewer, path([("move", (0, 5)), ("line", (10, 5))]), circle(30))
    found = at(viewer, snapper, 29.0, 4.2)
    assert found.kind == "curve" and found.point[1] == 5 and np.hypot(*found.point) == pytest.approx(30, abs=0.02)


def test_the_grid_and_tidy_numbers(viewer, snapper):
    found = at(viewer, snapper, -24.6, 14.7)
    assert found.kind == "grid" and found.point.tolist() == [-25, 15] and found.words == "5 mm grid"
    found = at(viewer, snapper, -22.512345, 17.554321)
    assert found.kind == "free" and found.point.tolist() == [-22.5, 17.6]


def test_directions_go_in_steps_of_15_degrees(viewer):
    snapper = snapper_of(viewer)
    found = at(viewer, snapper, 21.0, 19.0, origin=(0.0, 0.0), angles=True)
    assert found.kind == "angle" and found.words.startswith("45°") and found.point[0] == pytest.approx(found.point[1])
    straight = at(viewer, snapper, 24.8, 2.0, origin=(0.0, 0.0), angles=True)
    assert straight.point.tolist() == [25, 0]


def test_what_moves_and_what_is_excluded_does_not_count(viewer, snapper):
    (root,) = snapper._session.document.profiles
    snapper._session.select([root.id])
    assert at(viewer, snapper, 40.4, 0.4).kind == "node"
    found = at(viewer, snapper, 40.4, 0.4, exclude=frozenset({(0, 1)}))
    assert found.kind not in ("node", "curve", "midpoint")
    assert at(viewer, snapper, 0.4, 0.4, exclude=frozenset({(0, 1)})).kind == "node"
    assert at(viewer, snapper, 0.4, 0.4, exclude={root.id}).kind == "grid"


def test_own_points_count_as_nodes(viewer):
    assert at(viewer, snapper_of(viewer), 13.3, 7.2, own=[(13.0, 7.0)]).point.tolist() == [13, 7]


def test_outlines_in_another_plane_or_hidden_do_not_count(viewer):
    assert at(viewer, snapper_of(viewer, SHAPE.at(0, 0, 3)), 40.6, 0.6).kind != "node"
    assert at(viewer, snapper_of(viewer, SHAPE.hidden()), 40.6, 0.6).kind != "node"
    turned = snapper_of(viewer, SHAPE.at(5, 5))
    assert at(viewer, turned, 45.3, 5.3).point.tolist() == [45, 5]


def test_coordinates_are_those_of_the_frame(viewer, snapper):
    frame = np.array([[0.0, -1.0, 0.0, 40.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
    assert at(viewer, snapper, 40.3, 29.8, frame).point == pytest.approx([30, 0])


def test_a_corner_of_a_solid_in_the_plane(viewer):
    viewer.show({"n1": (box((0, 0, 0), (17, 13, 8)), None)})
    snapper = snapper_of(viewer)
    top = np.column_stack((np.eye(3), [0.0, 0.0, 8.0]))
    x, y = pixel(viewer, 17, 13, 8)
    found = snapper.snap((x - 3, y + 2), top)
    assert found.kind == "corner" and found.point.tolist() == [17, 13]
    assert snapper.snap((x - 3, y + 2), IDENTITY).kind != "corner"


def test_a_plane_seen_from_its_edge_means_nothing(viewer, snapper):
    edge_on = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 10.0], [0.0, -1.0, 0.0, 0.0]])
    assert snapper.snap((400.0, 300.0), edge_on) is None


def test_while_something_is_previewed_what_was_there_counts(viewer, snapper):
    session = snapper._session
    at(viewer, snapper, 0.0, 0.0)
    (root,) = session.document.profiles
    session.preview(session.document.with_(profiles=(root.with_(points=tuple((x + 3.0, y) for x, y in root.points)),)))
    assert at(viewer, snapper, 40.4, 0.3).point.tolist() == [40, 0]
    session.cancel()
