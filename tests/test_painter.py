"""Faces in the order of a tree: the picture of the depth buffer where they are opaque, exact where they are not."""

import itertools

import manifold3d
import numpy as np
import pytest
from hsr_scenes import flat_mesh, names_of_scenes, read_scene
from render_meshes import ball, box, drilled
from vtkmodules.vtkRenderingCore import vtkRenderer

from solidtree.model.document.document import Section
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import faces_of_meshes, joined
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.solid.display import display_mesh
from solidtree.model.surface.material import SHADINGS
from solidtree.render.actors import faces_actor
from solidtree.render.camera import Camera, apply, orbit
from solidtree.render.look import STYLES, Paint
from solidtree.render.painter.closed import is_closed
from solidtree.render.painter.corners import corners_of
from solidtree.render.painter.painter import Painter
from solidtree.render.picture import facet_numbers, ids_picture, numbers_of, picture
from solidtree.render.polydata import set_cell_colours, surface_of
from solidtree.render.shading import unlit
from solidtree.render.viewer import Viewer
from solidtree.render.window import close, offscreen_window, pixels

SIZE = (240, 200)
MODES = ("zbuffer", "bsp")
FRONT = Camera((0.0, -80.0, 0.0), (0.0, 0.0, 0.0), parallel=True, parallel_scale=15.0)
INSIDE = Camera((6.0, 0.5, 1.0), (-10.0, 3.0, 0.0), view_angle=90.0)
# From within the drill's hole, within the ball, above, below, in parallel projection.
CAMERAS = (
    "iso",
    "bottom",
    INSIDE,
    Camera((0.0, 0.3, 14.0), (0.0, 0.0, 0.0), view_angle=70.0),
    Camera((40.0, 30.0, -35.0), (0.0, 0.0, 0.0), view_angle=40.0),
    orbit(FRONT, 25.0, 35.0),
)


def crossing():
    """A drilled cube, a ball that pokes through its wall, and a bar through both."""
    return [drilled(24), ball(20, 8.0), box((-14.0, -3.0, -3.5), (14.0, 3.2, 3.0), "bar")]


def solids():
    paints = (Paint("#cc7755", (None, "#44aa66")), Paint("#5577cc"), Paint(None, ("#ddcc44", None)))
    return list(zip(crossing(), paints, strict=True))


def bordering(numbers: np.ndarray) -> np.ndarray:
    """The pixels within one pixel of a change."""
    edge = np.pad(numbers, 1, mode="edge")
    near = np.zeros(numbers.shape, bool)
    for dy, dx in itertools.product((0, 1, 2), repeat=2):
        near |= edge[dy : dy + numbers.shape[0], dx : dx + numbers.shape[1]] != numbers
    return near


def differing(meshes, camera, numbers=None, size=SIZE) -> tuple[int, int]:
    """How many pixels away from borders differ between both modes, and how many show something."""
    depth, order = (
        numbers_of(ids_picture(meshes, size, camera, numbers=numbers, hidden_surface=mode)) for mode in MODES
    )
    return int(((depth != order) & ~bordering(depth)).sum()), int((depth > 0).sum())


def test_crossing_solids_show_what_the_depth_buffer_shows_from_outside_and_inside():
    meshes = crossing()
    for numbers in (None, facet_numbers(meshes)):
        for camera in CAMERAS:
            wrong, shown = differing(meshes, camera, numbers)
            assert shown > 3000 and wrong <= 0.0002 * shown, camera


def test_a_wrong_order_is_seen(monkeypatch):
    """The comparison above can fail: triangles sorted by their middles are not the painter's order."""
    from solidtree.render.painter import painter

    class ByMiddles(painter.Sorter):
        def triangles(self, eye, parallel=False, front_first=False):
            middles = self.tree.points[self.tree.corners[self.fans]].mean(axis=1)
            return np.argsort(-np.linalg.norm(middles - eye, axis=1))

    monkeypatch.setattr(painter, "Sorter", ByMiddles)
    wrong = sum(differing(crossing(), camera)[0] for camera in CAMERAS[2:5])
    assert wrong > 100


def test_owner_maps_of_all_hidden_surface_scenes(corpus):
    folder = corpus / "hsr"
    for name in names_of_scenes(folder):
        scene = read_scene(folder, name)
        for view in scene.views:
            found = numbers_of(
                ids_picture([scene.mesh], view.size, view.camera, numbers=[scene.numbers], hidden_surface="bsp")
            )
            wrong = (found != view.owners) & ~view.skipped
            assert wrong.sum() <= 0.0002 * (~view.skipped).sum(), (view.name, int(wrong.sum()))


def test_imported_models_closed_and_open(corpus):
    from solidtree.model.exchange.meshes_in import read_any
    from solidtree.model.solid.results import evaluate_document

    for name in ("cork/ballA.off", "assimp/Wuson.off", "assimp/sphereWithHole.stl"):
        evaluation = evaluate_document(read_any(corpus / "mesh" / name), 0.05)
        meshes = [mesh for result in evaluation.visible if (mesh := evaluation.display(result)) is not None]
        low, high = meshes[0].bounds
        within = low + 0.4 * (high - low)
        for camera in ("iso", "bottom", Camera(tuple(within), tuple(high), view_angle=80.0)):
            wrong, shown = differing(meshes, camera, facet_numbers(meshes))
            assert shown > 3000 and wrong <= 0.0002 * shown, (name, camera)


def square(half, y=0.0):
    return [[-half, y, -half], [half, y, -half], [half, y, half], [-half, y, half]]


def test_of_coplanar_squares_the_later_one_lies_on_top():
    points = np.array(square(10) + square(7) + square(4), float)
    triangles = np.array([[4 * n + i for i in pair] for n in range(3) for pair in ((0, 1, 2), (0, 2, 3))], np.int32)
    numbers = [np.repeat([1, 2, 3], 2)]
    for camera in (FRONT, orbit(FRONT, 180.0, 0.0)):
        seen = numbers_of(
            ids_picture([flat_mesh(points, triangles)], SIZE, camera, numbers=numbers, hidden_surface="bsp")
        )
        assert [seen[100, 120 + i] for i in (5, 36, 55, 75)] == [3, 2, 1, 0]


def test_nothing_one_triangle_and_an_open_shell():
    assert not ids_picture([], (20, 10), hidden_surface="bsp").any()
    assert picture([], (20, 10), hidden_surface="bsp").shape == (10, 20, 3)
    one = flat_mesh(np.array([[-9, 0, -9], [9, 0, -9], [0, 0, 9]], float), np.array([[0, 1, 2]], np.int32))
    for camera in (FRONT, orbit(FRONT, 150.0, 10.0)):
        assert differing([one], camera) == (0, differing([one], camera)[1])
        assert differing([one], camera)[1] > 1000
    whole = ball(16)
    shell = flat_mesh(whole.vertices, whole.corners[whole.vertices[whole.corners].mean(axis=1)[:, 2] < 4.0])
    assert is_closed(whole) and not is_closed(shell)
    for camera in ("iso", "top", INSIDE):
        wrong, shown = differing([shell, box((-2, -2, -14), (2, 2, 14))], camera)
        assert shown > 3000 and wrong <= 0.0002 * shown


def test_a_body_turned_inside_out_keeps_its_near_faces():
    mesh = box()
    assert is_closed(flat_mesh(*welded(mesh)))
    points, triangles = welded(mesh)
    assert not is_closed(flat_mesh(points, triangles[:, ::-1].copy()))
    assert differing([flat_mesh(points, triangles[:, ::-1].copy())], "iso")[0] == 0


def test_one_shell_of_two_turned_inside_out_keeps_its_near_faces():
    points, triangles = welded(box())
    aside = points * 0.8 + (1.5 * np.ptp(points[:, 0]), 0.0, 0.0)
    for turned, closed in ((triangles, True), (triangles[:, ::-1], False)):
        two = flat_mesh(np.concatenate([points, aside]), np.concatenate([triangles, turned + len(points)]))
        assert is_closed(two) == closed
        for camera in ("iso", "front"):
            wrong, shown = differing([two], camera, facet_numbers([two]))
            assert shown > 1000 and wrong <= 0.0002 * shown


def test_a_painter_goes_with_its_picture():
    import gc

    from solidtree.render.painter.depth import DepthAlways

    for mode in MODES:
        picture(solids(), (40, 30), hidden_surface=mode)
    gc.collect()
    assert not any(isinstance(found, DepthAlways) for found in gc.get_objects())


def welded(mesh):
    points, corners = np.unique(mesh.vertices, axis=0, return_inverse=True)
    return points, corners.reshape(-1)[mesh.corners].astype(np.int32)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("look", ("light", "dark"))
def test_styles_look_the_same(style, look):
    depth, order = (
        picture(solids(), SIZE, "iso", style=style, look=look, hidden_surface=mode).astype(int) for mode in MODES
    )
    assert agreeing(depth, order)


@pytest.mark.parametrize("shading", SHADINGS)
def test_shadings_look_the_same(shading):
    for camera in ("iso", INSIDE):
        depth, order = (
            picture(solids(), SIZE, camera, shading=shading, hidden_surface=mode).astype(int) for mode in MODES
        )
        assert agreeing(depth, order)


def agreeing(depth, order) -> bool:
    """Whether two pictures differ by two grey levels at most where both are smooth around.

    Where solids cross, the painter smooths; the depth buffer does not, and is some pixels off: VTK makes up for lines
    in the same place by offsets of faces that lean away.
    """
    steps = np.zeros(depth.shape[:2], bool)
    for image, axis in itertools.product((depth, order), (0, 1)):
        steps |= np.abs(np.diff(image, axis=axis, append=image.take([-1], axis))).max(axis=2) > 6
    rough = steps
    for _ in range(4):
        rough = rough | bordering(rough.astype(int))
    difference = np.abs(depth - order).max(axis=2)
    assert rough.mean() < 0.4
    return (difference[~rough] > 2).mean() <= 0.0005 and difference.mean() < 0.8


def test_sections_open_both_alike():
    plane = Section("cut", (0.0, 1.0, 0.0), (0.0, 1.0, 0.0))
    depth, order, closed = (
        picture(solids(), SIZE, "iso", sections=planes, hidden_surface=mode).astype(int)
        for planes, mode in (([plane], "zbuffer"), ([plane], "bsp"), ([], "bsp"))
    )
    # Cut faces of solids that stand in one another lie in one place.
    assert np.median(np.abs(depth - order)) == 0 and (np.abs(depth - order).max(axis=2) > 8).mean() < 0.01
    assert (np.abs(closed - order).max(axis=2) > 8).mean() > 0.1


# The viewer


@pytest.fixture
def viewer():
    viewer = Viewer()
    viewer.resize(*SIZE)
    viewer.set_ground(False)
    viewer.set_cube(False)
    yield viewer
    viewer.close()


def drawn(viewer) -> np.ndarray:
    viewer.render()
    return viewer.pixels().astype(int)


def tree_of(*meshes):
    return build(faces_of_meshes(meshes))


def test_the_viewer_paints_once_there_is_a_tree_of_what_is_drawn(viewer):
    meshes = crossing()[:2]
    viewer.show({"a": (meshes[0], Paint("#cc5533")), "b": (meshes[1], None)})
    viewer.fit()
    depth = drawn(viewer)
    viewer.set_hidden_surface("bsp")
    assert viewer.needs_render and not viewer.painting
    assert (drawn(viewer) == depth).all()
    viewer.show_tree(tree_of(*meshes), ("a", "b"))
    assert viewer.painting
    assert (np.abs(drawn(viewer) - depth).max(axis=2) > 8).mean() < 0.02
    assert hidden_faces(viewer) == [True, True]
    viewer.set_hidden_surface("zbuffer")
    assert not viewer.painting and (drawn(viewer) == depth).all()
    viewer.set_hidden_surface("bsp")
    assert viewer.painting

    viewer.show({"a": (meshes[0], Paint("#cc5533")), "b": (meshes[1], Paint("#33cc55"))})
    assert viewer.painting  # other colours are no other solids
    other = ball(20, 8.0)
    viewer.show({"a": (meshes[0], None), "b": (other, None)})
    assert not viewer.painting
    drawn(viewer)
    assert hidden_faces(viewer) == [False, False]
    viewer.show_tree(tree_of(meshes[0], other), ("a", "b"))
    assert viewer.painting
    viewer.show({"a": (meshes[0], None)})
    assert not viewer.painting
    viewer.show_tree(tree_of(meshes[0], other), ("a", "b"))
    assert not viewer.painting
    viewer.show_tree(tree_of(other), ("a",))
    assert not viewer.painting
    viewer.show_tree(None)
    with pytest.raises(ValueError, match="bsp"):
        viewer.set_hidden_surface("centroids")


def test_shadings_and_trees_change_at_once(viewer):
    """Gouraud's light comes with arrays of its own, which another tree and another shading leave behind."""
    meshes = [ball(12), ball(16)]
    viewer.set_hidden_surface("bsp")
    for shading in ("gouraud", "phong", "gouraud", "flat"):
        viewer.set_shading(shading)
        for mesh in meshes:
            viewer.show({"ball": (mesh, None)})
            viewer.show_tree(tree_of(mesh), ("ball",))
            viewer.fit()
            order = drawn(viewer)
            assert viewer.painting
            viewer.show_tree(None)
            assert agreeing(drawn(viewer), order)


def hidden_faces(viewer) -> list[bool]:
    return [not entry.faces.GetVisibility() for entry in viewer.scene._solids.values()]


def test_selection_hover_and_colours_look_the_same(viewer):
    mesh = drilled()
    tree = tree_of(mesh)
    seen = {}
    for mode in MODES:
        viewer.set_hidden_surface(mode)
        viewer.set_selection(())
        viewer.show({"part": (mesh, Paint("#8899aa"))})
        viewer.show_tree(tree, ("part",))
        viewer.fit()
        pictures = [drawn(viewer)]
        for change in (
            lambda: viewer.set_hover(("part", "cube")),
            lambda: viewer.set_hover(None),
            lambda: viewer.set_selection([("part", "drill")]),
            lambda: viewer.show({"part": (mesh, Paint("#8899aa", ("#22cc22", None)))}),
            lambda: viewer.set_theme("dark"),
            lambda: viewer.set_theme("light"),
        ):
            change()
            pictures.append(drawn(viewer))
        seen[mode] = pictures
        assert viewer.painting == (mode == "bsp")
    for depth, order in zip(*seen.values(), strict=True):
        # Along silhouettes faces turned away shine through in a depth buffer.
        assert np.abs(depth - order).mean() < 0.2 and (np.abs(depth - order).max(axis=2) > 8).mean() < 0.008
    assert hidden_faces(viewer) == [True]
    assert np.abs(seen["bsp"][1] - seen["bsp"][0]).mean() > 1.0
    assert np.abs(seen["bsp"][3] - seen["bsp"][0]).mean() > 1.0


def test_what_stands_behind_painted_faces_is_hidden(viewer):
    """Lines and ghosts are compared with the depths that the painter leaves: edges of a box behind a wall."""
    wall, hidden = box((-9, 0, -9), (9, 1, 9), "wall"), box((-4, 5, -4), (4, 9, 4), "hidden")
    viewer.set_style("edges")
    viewer.show({"wall": (wall, None), "hidden": (hidden, None)})
    viewer.set_hidden_surface("bsp")
    viewer.show_tree(tree_of(wall, hidden), ("wall", "hidden"))
    viewer.set_camera(FRONT)
    image = drawn(viewer)
    middle = image[60:140, 80:160].reshape(-1, 3)
    assert viewer.painting and np.ptp(middle, axis=0).max() <= 2
    viewer.set_camera(orbit(FRONT, 180.0, 0.0))
    assert np.ptp(drawn(viewer)[60:140, 80:160].reshape(-1, 3), axis=0).max() > 60


def test_the_first_fragments_alone(viewer):
    near, far = box((-4, -2, -4), (4, 0, 4), "near"), box((-4, 6, -4), (4, 9, 4), "far")
    viewer.show({"near": (near, Paint("#ff0000")), "far": (far, Paint("#0000ff"))})
    viewer.set_hidden_surface("bsp")
    tree = tree_of(near, far)
    viewer.show_tree(tree, ("near", "far"))
    viewer.set_camera(FRONT)

    def share() -> tuple[float, float]:
        image = drawn(viewer)
        return (image[..., 0] > image[..., 2] + 40).mean(), (image[..., 2] > image[..., 0] + 40).mean()

    assert share()[0] > 0.05 and share()[1] == 0.0
    viewer.set_painted(0)
    assert share() == (0.0, 0.0)
    counts = []
    for count in range(1, tree.fragments + 1):
        viewer.set_painted(count)
        counts.append(share())
    assert any(blue > 0.05 and red == 0.0 for red, blue in counts)
    assert counts[-1][0] > 0.05 and counts[-1][1] == 0.0
    viewer.set_painted(None)
    assert share() == counts[-1]


def test_orbiting_sorts_and_builds_nothing(viewer, monkeypatch):
    from solidtree.render.painter import painter

    mesh = drilled()
    made = []
    monkeypatch.setattr(painter, "corners_of", lambda *a: made.append(1) or corners_of(*a))
    viewer.show({"part": (mesh, None)})
    viewer.set_hidden_surface("bsp")
    viewer.show_tree(tree_of(mesh), ("part",))
    viewer.fit()
    pictures = []
    for _ in range(100):
        viewer.set_camera(orbit(viewer.camera, 3.6, 0.1))
        pictures.append(drawn(viewer))
    assert made == [1]
    assert np.abs(pictures[0] - pictures[30]).mean() > 1.0


def test_a_moving_part_leaves_the_corners_of_the_others_in_place():
    """The tree of the parts that stay comes first, whatever is put in afterwards."""
    still, first, second = ball(12), box((20, 0, 0), (24, 4, 4)), box((30, 0, 0), (34, 4, 4))
    static = build_in_order(faces_of_meshes([still]))

    def with_part(part):
        faces = joined([faces_of_meshes([still]), faces_of_meshes([part])])
        moved = build_in_order(faces)
        assert np.array_equal(moved.source[: static.fragments], static.source)
        return moved

    before = corners_of(with_part(first), [still, first])
    after = corners_of(with_part(second), [still, second], before)
    fresh = corners_of(after.tree, [still, second])
    for name in ("points", "normals", "weights", "face"):
        assert np.array_equal(getattr(after, name), getattr(fresh, name)), name
    other = ball(12)
    assert np.array_equal(corners_of(after.tree, [other, second], after).points, fresh.points)
    with pytest.raises(ValueError, match="triangles"):
        corners_of(static, [second])


def test_normals_and_weights_at_cut_corners_are_those_between_the_triangles_own():
    meshes = crossing()
    corners = corners_of(tree_of(*meshes), meshes)
    places = np.concatenate([mesh.vertices[mesh.corners] for mesh in meshes])[corners.face]
    normals = np.concatenate([mesh.normals[mesh.triangles] for mesh in meshes])[corners.face]
    assert (corners.weights.max(axis=1) < 0.999).sum() > 100
    assert np.abs(np.einsum("ij,ijk->ik", corners.weights, places) - corners.points).max() < 1e-4
    assert np.abs(np.einsum("ij,ijk->ik", corners.weights, normals) - corners.normals).max() < 1e-5


# Translucent faces


def flat_colours(meshes) -> list[np.ndarray]:
    rng = np.random.default_rng(4)
    return [rng.integers(0, 256, (len(mesh.triangles), 3), np.uint8) for mesh in meshes]


def layered(meshes, colours, opacity: float, camera: Camera) -> np.ndarray:
    """An A-buffer: for every pixel all triangles on its ray, sorted by depth and blended in floating point."""
    width, height = SIZE
    half = camera.parallel_scale
    x = ((np.arange(width) + 0.5) * 2.0 / width - 1.0) * half * width / height
    z = (1.0 - (np.arange(height) + 0.5) * 2.0 / height) * half
    x, z = (values.reshape(-1) for values in np.meshgrid(x, z))
    depths, inks = [], []
    for mesh, own in zip(meshes, colours, strict=True):
        for (a, b, c), ink in zip(mesh.vertices[mesh.corners], own, strict=True):
            u, v = b - a, c - a
            det = u[0] * v[2] - u[2] * v[0]
            if det == 0.0:
                continue
            s = ((x - a[0]) * v[2] - (z - a[2]) * v[0]) / det
            t = (u[0] * (z - a[2]) - u[2] * (x - a[0])) / det
            inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0)
            if inside.any():
                depths.append(np.where(inside, a[1] + s * u[1] + t * v[1], -np.inf))
                inks.append(ink)
    depth = np.array(depths)
    order = np.argsort(-depth, axis=0)
    result = np.full((width * height, 3), 255.0)
    for row in order:
        there = np.isfinite(depth[row, np.arange(len(x))])
        ink = np.array(inks, float)[row]
        result[there] = opacity * ink[there] + (1.0 - opacity) * result[there]
    return result.reshape(height, width, 3)


def blended(meshes, colours, opacity: float, camera: Camera, mode: str) -> np.ndarray:
    """The same by VTK without light and smoothing: painted, or depth-peeled as the viewer does."""
    window = offscreen_window(SIZE)
    try:
        renderer = vtkRenderer()
        window.AddRenderer(renderer)
        renderer.SetBackground(1.0, 1.0, 1.0)
        renderer.SetUseOIT(False)
        if mode == "bsp":
            painter = Painter(renderer)
            painter.show(build(faces_of_meshes(meshes)), meshes)
            painter.colour(np.concatenate(colours))
            painter.turn(camera, opaque=False, cull=True)
            actors = [painter.actor]
        else:
            renderer.SetUseDepthPeeling(True)
            renderer.SetMaximumNumberOfPeels(24)
            renderer.SetOcclusionRatio(0.0)
            actors = []
            for mesh, own in zip(meshes, colours, strict=True):
                surface = surface_of(mesh)
                set_cell_colours(surface, own)
                actors.append(faces_actor(surface))
                renderer.AddActor(actors[-1])
        for actor in actors:
            unlit(actor)
            actor.GetProperty().SetOpacity(opacity)
        apply(camera, renderer.GetActiveCamera(), np.array([[-20.0] * 3, [20.0] * 3]))
        window.Render()
        return pixels(window)[..., :3].astype(float)
    finally:
        close(window)


def test_translucent_faces_are_those_of_an_a_buffer():
    shells = [
        display_mesh(manifold3d.Manifold.sphere(r, 16).to_mesh64(), np.zeros(1, np.int32), (("s",),)) for r in (6, 9)
    ]
    meshes = [*shells, *crossing()[::2], *(box((-12, y, -11), (12, y + 0.5, 11)) for y in np.arange(-12.0, 12.0, 2.0))]
    colours = flat_colours(meshes)
    camera = FRONT
    wanted = layered(meshes, colours, 0.12, camera)
    order, depth = (np.abs(blended(meshes, colours, 0.12, camera, mode) - wanted) for mode in ("bsp", "zbuffer"))
    assert np.abs(wanted - 255.0).mean() > 20.0
    assert order.mean() < 1.0
    assert order.mean() < depth.mean()


def test_the_grounds_lines_are_blended_where_they_lie(viewer):
    """Half of a translucent box stands above the ground and half below; the picture is that of depth peeling."""
    mesh = box((-8, -8, -8), (8, 8, 8))
    viewer.set_ground(True)
    viewer.set_opacity(0.5)
    viewer.show({"box": (mesh, None)})
    viewer.show_tree(tree_of(mesh), ("box",))
    for camera in (
        Camera((50, -60, 40)),
        Camera((50, -60, -40)),
        Camera((50, -60, 40), parallel=True, parallel_scale=15),
    ):
        viewer.set_camera(camera)
        for low in (-8.0, 0.0, 8.0):
            mesh = box((-8, -8, low), (8, 8, low + 16))
            viewer.show({"box": (mesh, None)})
            viewer.show_tree(tree_of(mesh), ("box",))
            viewer.set_hidden_surface("zbuffer")
            peeled = drawn(viewer)
            viewer.set_hidden_surface("bsp")
            assert viewer.painting
            assert np.abs(drawn(viewer) - peeled).mean() < 1.0
            viewer.set_ground(False)
            assert np.abs(drawn(viewer) - peeled).mean() > 0.5
            viewer.set_ground(True)


def test_render_paints_on_the_command_line(solidtree, tmp_path):
    script = tmp_path / "make.py"
    file = tmp_path / "part.solidtree"
    script.write_text(
        f"part = box(20, 20, 20) - cylinder(radius=5, height=30).at(10, 10, -5)\nsave({str(file)!r}, part=part)\n"
    )
    assert solidtree("run", script)[0] == 0
    images = []
    for mode in MODES:
        out = tmp_path / f"{mode}.png"
        assert solidtree("render", file, out, "--size", "200x150", "--ids", "faces", "--hidden-surface", mode)[0] == 0
        images.append(out.read_bytes())
        assert solidtree("render", file, out, "--size", "200x150", "--opacity", "0.5", "--hidden-surface", mode)[0] == 0
    assert images[0] == images[1]
    assert solidtree("render", file, tmp_path / "x.png", "--hidden-surface", "gl2ps")[0] == 2
