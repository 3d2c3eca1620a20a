"""Ghosts of operands, by pixels and by formula."""

import numpy as np
import pytest
from render_meshes import ball, box

from solidtree.render.camera import fit, project
from solidtree.render.ghosts.ghosts import MANY, Ghost, Manner
from solidtree.render.ghosts.placed_cells import Cells
from solidtree.render.ghosts.plane_grid import plane_grid
from solidtree.render.viewer import Viewer
from solidtree.render.views import standard_view

BLOCK = box((0, 0, 0), (40, 40, 40))
DRILL = box((10, -20, 10), (30, 20, 30))  # half of it sticks out of the block's front


def at(x=0.0, y=0.0, z=0.0):
    return np.column_stack([np.eye(3), (x, y, z)])


@pytest.fixture
def viewer():
    viewer = Viewer()
    viewer.resize(300, 300)
    viewer.set_ground(False)
    viewer.set_cube(False)
    viewer.show({"block": (BLOCK, None)})
    look(viewer, "right")
    yield viewer
    viewer.close()


def look(viewer, view):
    viewer.set_camera(fit(standard_view(viewer.camera, view), ((-20, -25, -20), (60, 55, 60)), 1.0))


def picture(viewer, *ghosts):
    viewer.show_ghosts(ghosts)
    viewer.render()
    return viewer.pixels().astype(float)


def patch(viewer, image, point, half=12):
    """The pixels (n, 3) around a point of the world."""
    (x, y, _) = project(viewer.camera, [point], viewer.size)[0]
    return image[int(y) - half : int(y) + half, int(x) - half : int(x) + half].reshape(-1, 3)


def test_a_drill_is_seen_outside_and_weaker_within(viewer):
    bare = picture(viewer)
    image = picture(viewer, Ghost(DRILL, at(), Manner.TINTED))
    outside = np.abs(patch(viewer, image - bare, (40, -10, 20))).mean()
    within = np.abs(patch(viewer, image - bare, (40, 10, 20))).mean()
    assert outside > 2 * within > 2
    assert (np.abs(patch(viewer, image - bare, (40, 30, 20))) == 0).all()
    red, _, blue = (patch(viewer, image, (40, -10, 20)) - patch(viewer, bare, (40, -10, 20))).mean(axis=0)
    assert blue > red  # bluish, and not the red of an error
    assert (picture(viewer) == bare).all()


def test_what_is_subtracted_is_hatched_and_the_rest_is_not(viewer):
    spread = {}
    for manner in (Manner.HATCHED, Manner.TINTED):
        image = picture(viewer, Ghost(DRILL, at(), manner))
        spread[manner] = patch(viewer, image, (40, -10, 20)).std(axis=0).max()
    assert spread[Manner.HATCHED] > 8 > 4 * spread[Manner.TINTED]


def test_ghosts_follow_their_matrix_and_are_not_clipped(viewer):
    ghost = Ghost(DRILL, at(0, -10, 0), Manner.HATCHED)
    picture(viewer, Ghost(DRILL, at(), Manner.HATCHED))
    moved = picture(viewer, ghost)
    assert (viewer.ghosts.bounds == [[10, -30, 10], [30, 10, 30]]).all()
    picture(viewer)
    assert viewer.ghosts.bounds is None and viewer.ghosts.count == 0
    assert np.abs(picture(viewer, ghost) - moved).max() < 2
    look(viewer, "front")
    bare = picture(viewer)
    near = picture(viewer, Ghost(DRILL, at(0, -25, 0), Manner.TINTED))  # before all that the scene knows of
    assert np.abs(patch(viewer, near - bare, (20, -45, 20))).mean() > 5


def test_a_mirrored_ghost_shows_the_same_side(viewer):
    mirrored = np.column_stack([np.diag([-1.0, 1.0, 1.0]), (40.0, 0.0, 0.0)])
    one = picture(viewer, Ghost(DRILL, at(), Manner.TINTED))
    other = picture(viewer, Ghost(DRILL, mirrored, Manner.TINTED))  # symmetric about x = 20
    assert (np.abs(one - other).max(axis=2) > 2).mean() < 1e-3  # a line may fall on other pixels


def test_many_places_look_like_few(viewer):
    small = box((0, 0, 0), (3, 3, 3))
    places = [at(41, -18 + 4 * i, 20) for i in range(MANY + 1)]
    merged = picture(viewer, *(Ghost(small, place, Manner.HATCHED) for place in places))
    twin = box((0, 0, 0), (3, 3, 3))
    half = len(places) // 2
    apart = [Ghost(small, p, Manner.HATCHED) for p in places[:half]]
    apart += [Ghost(twin, p, Manner.HATCHED) for p in places[half:]]
    assert np.abs(picture(viewer, *apart) - merged).mean() < 0.01
    assert viewer.ghosts.count == MANY + 1


def test_cells_at_several_places():
    mesh = ball(24)
    maps = [at(5, 6, 7), np.column_stack([np.diag([2.0, -1.0, 1.0]), (0, 0, 30)])]
    cells = Cells(mesh.points, mesh.triangles, mesh.normals).at(maps)
    corners = cells.points[cells.cells].astype(float).reshape(2, -1, 3, 3)
    volumes = np.einsum("mti,mti->m", corners[:, :, 0], np.cross(corners[:, :, 1], corners[:, :, 2])) / 6
    assert volumes[1] == pytest.approx(2 * volumes[0], rel=1e-4) and volumes[0] > 0
    count = len(mesh.points)
    assert cells.points[:count] == pytest.approx(np.add(mesh.points, (5, 6, 7)), abs=1e-5)
    # The normal of a sphere stretched by a matrix goes by the inverse's transpose.
    expected = mesh.normals / (2, -1, 1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    assert cells.normals[count:] == pytest.approx(expected, abs=1e-5)


def test_the_plane_of_a_half_space_is_a_grid_where_it_meets_the_box(viewer):
    grid = plane_grid((1, 2, 2), (3, 0, 0), np.array([[-10.0] * 3, [10.0] * 3]))
    normal = np.array([1, 2, 2]) / 3
    for points in (grid.faces.points, grid.lines.points):
        assert np.abs((points - (3, 0, 0)) @ normal).max() < 1e-9
    corners = np.array([[-10, 6.5, 0], [-10, 0, 6.5], [10, -3.5, 0], [10, 0, -3.5]])  # on the plane and in the box
    a, b, d = grid.faces.points[[0, 1, 3]]
    shares = np.linalg.lstsq(np.column_stack([b - a, d - a]), (corners - a).T, rcond=None)[0]
    assert (shares > -1e-9).all() and (shares < 1 + 1e-9).all()
    assert not len(plane_grid((0, 0, 1), (0, 0, 30), np.array([[-10.0] * 3, [10.0] * 3])).faces.points)

    look(viewer, "iso")
    bare = picture(viewer)
    image = picture(viewer, Ghost(box((-10, -10, -10), (50, 50, 50)), at(), Manner.PLANE, ((0, 0, 1), (0, 0, 20))))
    assert np.abs(patch(viewer, image - bare, (46, 20, 20), 4)).mean() > 2
    assert viewer.ghosts.bounds[:, 2] == pytest.approx(20)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_themes_and_scale(viewer, theme):
    ghost = Ghost(DRILL, at(), Manner.HATCHED)
    viewer.set_theme(theme)
    bare = picture(viewer)
    assert np.abs(patch(viewer, picture(viewer, ghost) - bare, (40, -10, 20))).mean() > 8
    viewer.resize(300, 300, 2.0)
    viewer.render()
    assert viewer.pixels().shape == (600, 600, 3)
