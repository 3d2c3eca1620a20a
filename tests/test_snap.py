"""What the pointer snaps to, in pictures whose geometry is known; and the marks, by their pixels."""

from dataclasses import replace

import numpy as np
import pytest

from solidtree.model.script import box, cylinder, document_of, union
from solidtree.model.solid.results import evaluate_document
from solidtree.render.camera import project
from solidtree.render.handles.snap import REACH, Snap, Snapper, _Target
from solidtree.render.handles.snap_mark import CORE, RIM, SnapMark
from solidtree.render.look import rgb
from solidtree.render.viewer import Viewer
from solidtree.render.views import standard_view

SIZE = (480.0, 360.0)


@pytest.fixture
def look():
    """look(solids, view) -> viewer: solids n1, ... as seen from a side, fitted."""
    viewer = Viewer()
    viewer.resize(*SIZE)

    def show(*solids, view="iso", parallel=False):
        evaluation = evaluate_document(document_of(*solids))
        meshes = {result.root.id: (evaluation.display(result), None) for result in evaluation.solids}
        viewer.show(meshes)
        viewer.set_camera(viewer.fitted(standard_view(replace(viewer.camera, parallel=parallel), view)))
        return viewer

    yield show
    viewer.close()


def pixel(viewer, point):
    x, y, _ = project(viewer.camera, [point], viewer.size)[0]
    return float(x), float(y)


def snapped(viewer, point, off=(0.0, 0.0), **more):
    x, y = pixel(viewer, point)
    return Snapper(viewer).find(x + off[0], y + off[1], **more)


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize(
    ("kind", "point", "direction"),
    [
        ("vertex", (10, 0, 30), None),
        ("vertex", (0, 0, 0), None),
        ("vertex", (10, 20, 30), None),  # a corner of the outline
        ("midpoint", (5, 0, 30), (1, 0, 0)),
        ("midpoint", (10, 0, 15), (0, 0, 1)),
        ("centre", (5, 10, 30), (0, 0, 1)),
        ("centre", (10, 10, 15), (1, 0, 0)),
        ("edge", (10, 0, 22), (0, 0, 1)),
        ("face", (5, 0, 22), (0, -1, 0)),
    ],
)
def test_the_landmarks_of_a_box(look, parallel, kind, point, direction):
    viewer = look(box(10, 20, 30), parallel=parallel)
    snap = snapped(viewer, point)
    assert snap is not None and snap.kind == kind and snap.path == ("n1",)
    assert np.allclose(snap.point, point, atol=1e-4)
    if direction is None:
        assert snap.direction is None
    else:
        assert abs(np.dot(snap.direction, direction)) == pytest.approx(1)


def test_a_corner_comes_before_the_edge_that_is_nearer(look):
    viewer = look(box(10, 20, 30))
    (x0, y0), (x1, y1) = pixel(viewer, (10, 0, 30)), pixel(viewer, (10, 0, 0))
    away = np.hypot(x1 - x0, y1 - y0)
    along = ((x1 - x0) / away, (y1 - y0) / away)
    near = snapped(viewer, (10, 0, 30), tuple((REACH - 1) * c for c in along))
    beyond = snapped(viewer, (10, 0, 30), tuple((REACH + 2) * c for c in along))
    assert near.kind == "vertex" and beyond.kind == "edge"
    assert beyond.point[:2] == pytest.approx((10, 0)) and 20 < beyond.point[2] < 30


def test_the_edge_s_point_is_under_the_pointer_in_perspective(look):
    """Along an edge that runs away from the eye, where shares of the picture are not those of the edge."""
    viewer = look(box(10, 200, 10))
    for y in (30, 70, 130, 170):
        snap = snapped(viewer, (10, y, 10))
        assert snap.kind == "edge" and np.allclose(snap.point, (10, y, 10), atol=1e-3)


def test_the_outline_is_reached_from_beside(look):
    viewer = look(box(10, 20, 30), view="front")
    viewer.set_ground(False)
    left = snapped(viewer, (0, 0, 22), (-6.0, 0.0))
    assert left.kind == "edge" and left.point == pytest.approx((0, 0, left.point[2]))
    assert snapped(viewer, (0, 0, 22), (-REACH - 3, 0.0)) is None


def test_what_is_hidden_is_not_found(look):
    viewer = look(box(10, 20, 30))
    hidden = snapped(viewer, (0, 20, 0))
    assert hidden is None or not np.allclose(hidden.point, (0, 20, 0), atol=1)
    viewer.set_style("wireframe")
    assert np.allclose(snapped(viewer, (0, 20, 0)).point, (0, 20, 0))


def test_a_solid_before_another_one_hides_its_landmarks(look):
    wall, behind = box(60, 2, 60), box(10, 10, 10).at(20, 20, 20)
    viewer = look(wall, behind, view="front", parallel=True)
    snap = snapped(viewer, (22, 20, 22))
    assert snap.kind == "face" and snap.path == ("n1",)
    through = snapped(viewer, (20, 20, 20), leave_out=["n1"])
    assert through.kind == "vertex" and through.path == ("n2",) and np.allclose(through.point, (20, 20, 20))


def test_what_is_left_out_has_no_landmarks_and_those_it_made_in_others_go_too(look):
    """A boss on a plate: while it is dragged, neither its corners count nor the edges where it meets the plate."""
    viewer = look(union(box(60, 60, 5), box(10, 10, 20).at(25, 25, 0)))
    tip, foot = (25, 25, 20), (25, 25, 5)
    assert snapped(viewer, tip).kind == "vertex" and snapped(viewer, foot).kind == "vertex"
    for point in (tip, foot, (30, 25, 5)):
        snap = snapped(viewer, point, leave_out=("n3",))
        assert snap is None or (snap.kind != "vertex" and "n3" not in snap.path)
    plate = snapped(viewer, (60, 0, 5), leave_out=("n3",))
    assert plate.kind == "vertex" and np.allclose(plate.point, (60, 0, 5)) and plate.path == ("n1", "n2")


def test_the_rim_of_a_hole_gives_its_centre_where_there_is_only_air(look):
    viewer = look(box(40, 40, 5) - cylinder(12, 20).at(15, 15, -5), view="top", parallel=True)
    viewer.set_ground(False)
    snap = snapped(viewer, (15, 15, 5), (2.0, 1.0))
    assert snap.kind == "centre" and np.allclose(snap.point, (15, 15, 5), atol=1e-4)
    assert abs(snap.direction[2]) == pytest.approx(1)


def test_the_facets_of_a_cylinder_have_no_centres(look):
    viewer = look(cylinder(20, 40), view="front")
    a, b = Snapper(viewer).find(*pixel(viewer, (0, -20, 20))), Snapper(viewer).find(*pixel(viewer, (6, -19, 22)))
    assert a.kind == b.kind == "face" and a.direction[2] == pytest.approx(0, abs=1e-6)


def test_beside_all_solids_lies_the_grid(look):
    viewer = look(box(10, 10, 10), view="top")
    viewer.render()
    snap = snapped(viewer, (20, -10, 0), (2.0, -3.0))
    assert snap.kind == "grid" and snap.path == () and snap.point == pytest.approx((20, -10, 0))
    viewer.set_ground(False)
    assert snapped(viewer, (20, -10, 0)) is None


def test_meshes_of_an_earlier_moment_can_be_asked(look):
    viewer = look(box(10, 20, 30))
    before = viewer.scene.meshes
    x, y = pixel(viewer, (10, 0, 30))
    viewer.show({})
    snapper = Snapper(viewer)
    viewer.set_ground(False)
    assert snapper.find(x, y) is None
    assert snapper.find(x, y, meshes=before).kind == "vertex"
    assert snapper.mesh("n1") is before["n1"]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("kind", ["vertex", "midpoint", "centre", "edge", "face", "grid"])
def test_each_mark_is_seen_over_everything_at_one_size(look, kind, theme):
    viewer = look(box(10, 20, 30))
    viewer.set_theme(theme)
    mark, other = SnapMark(), SnapMark()
    viewer.overlay.add(mark)
    viewer.overlay.add(other)
    other.show(Snap("vertex", (10.0, 0.0, 30.0), None, ()))  # so that both pictures are smoothed
    point = (5.0, 10.0, 0.0)  # below the box: hidden, were it not over everything
    widths = []
    for distance in (1.0, 3.0):
        camera = viewer.camera
        viewer.set_camera(replace(camera, position=tuple(distance * np.array(camera.position))))
        mark.show(None)
        viewer.render()
        empty = viewer.pixels().astype(int)
        assert mark.show(Snap(kind, point, (0.0, 0.0, 1.0), ("n1",))) and not mark.show(mark.snap)
        viewer.render()
        shown = viewer.pixels().astype(int)
        rows, columns = np.nonzero(np.abs(shown - empty).sum(axis=2) > 30)
        x, y = pixel(viewer, point)
        assert np.hypot(rows - y, columns - x).min() < 14 and np.hypot(rows - y, columns - x).max() < 45
        widths.append(np.ptp(columns))
        for colour in (CORE, RIM):
            wanted = np.round(255 * np.array(rgb(colour)))
            assert (np.abs(shown[rows, columns] - wanted).sum(axis=1) < 100).sum() > 8
    assert abs(int(widths[0]) - int(widths[1])) <= 6


def test_the_signs_differ(look):
    viewer = look(box(10, 20, 30))
    mark = SnapMark()
    viewer.overlay.add(mark)
    pictures = []
    for kind in ("vertex", "midpoint", "centre", "edge", "face", "grid"):
        mark.show(Snap(kind, (5.0, 0.0, 22.0), (0.0, -1.0, 0.0), ()))
        viewer.render()
        pictures.append(viewer.pixels())
    for i, one in enumerate(pictures):
        for other in pictures[:i]:
            assert (one != other).any(axis=2).sum() > 25


def test_a_solid_that_is_dragged_whole_is_prepared_once(look, monkeypatch):
    viewer = look(box(10), box(10).at(30))
    made = []
    start = _Target.__init__
    monkeypatch.setattr(_Target, "__init__", lambda self, *arguments: made.append(start(self, *arguments)))
    snapper = Snapper(viewer)
    for x in (100.0, 110.0, 120.0):
        snapper.find(x, 150.0, ("n1",))
    assert len(made) == 2
