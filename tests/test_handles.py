"""What handles mean: rays and axes, planes, rings, steps; where they are caught; what a drag of a value does."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solidtree.model.document.expression import Expression
from solidtree.model.document.nodes import KINDS, Node
from solidtree.model.operations.sizing import field_of, plane_handle, size_handles, sized
from solidtree.model.script import box, circle, cone, cylinder, extrude, halfspace, linear_array, measure, sphere, torus
from solidtree.render.camera import Camera, fit, frame, project, ray
from solidtree.render.handles.drag import (
    along_axis,
    distance_to_path,
    inside,
    on_plane,
    pixel_length,
    ring_angle,
    step_for,
    stepped,
    stepped_angle,
    unwrapped,
)
from solidtree.render.handles.gizmo import (
    RING,
    move_handles,
    plane_axes,
    plane_handles,
    scale_handles,
    size_handle,
    turn_handles,
)
from solidtree.render.handles.handle import Handle, caught
from solidtree.render.handles.handle_marks import HandleMarks, colour_of
from solidtree.render.handles.label import Label
from solidtree.render.look import DARK, LIGHT, rgb
from solidtree.render.viewer import Viewer

SIZE = (640.0, 480.0)
ISO = fit(Camera(), [[-60.0] * 3, [60.0] * 3], SIZE[0] / SIZE[1])
CAMERAS = (ISO, replace(ISO, parallel=True, parallel_scale=80.0))
unit = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1).map(
    lambda v: np.array(v) / np.linalg.norm(v)
)  # fmt: skip
places = st.tuples(*[st.floats(-40, 40)] * 3).map(np.array)


@given(places, unit, st.floats(-30, 30))
@pytest.mark.parametrize("camera", CAMERAS)
def test_the_pointer_over_a_point_of_an_axis_gives_that_point(camera, point, axis, distance):
    on_it = point + distance * axis
    x, y, _ = project(camera, [on_it], SIZE)[0]
    origin, direction = ray(camera, x, y, SIZE)
    if abs(axis @ direction) < 0.99:
        assert along_axis(origin, direction, point, axis) == pytest.approx(distance, abs=1e-6)


@given(places, unit, places)
@pytest.mark.parametrize("camera", CAMERAS)
def test_the_pointer_over_a_point_of_a_plane_gives_that_point(camera, point, normal, other):
    on_it = other - normal * (normal @ (other - point))
    x, y, _ = project(camera, [on_it], SIZE)[0]
    origin, direction = ray(camera, x, y, SIZE)
    if abs(normal @ direction) > 0.05:
        assert on_plane(origin, direction, point, normal) == pytest.approx(on_it, abs=1e-6)


def test_what_the_pointer_cannot_tell_is_none():
    assert along_axis((0, 0, 0), (0, 0, 1), (5, 0, 0), (0, 0, 1)) is None
    assert along_axis((0, 0, 0), (0, 0, 1), (5, 0, -3), (1, 0, 0)) is None  # behind the eye
    assert on_plane((0, 0, 0), (0, 0, 1), (5, 0, 0), (1, 0, 0)) is None
    assert on_plane((0, 0, 0), (0, 0, 1), (0, 0, -5), (0, 0, 1)) is None


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("angle", [-170.0, -35.0, 0.0, 10.0, 90.0, 179.0])
def test_a_ring_turns_with_the_pointer(camera, angle):
    centre, axis = np.array([5.0, -3.0, 2.0]), np.array([0.0, 0.0, 1.0])
    at = centre + 20 * np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle)), 0.0])
    x, y, _ = project(camera, [at], SIZE)[0]
    assert ring_angle(camera, SIZE, (x, y), centre, axis, np.array([25.0, -3.0, 2.0])) == pytest.approx(angle, abs=1e-6)


def test_a_ring_from_its_edge_is_turned_along_its_tangent():
    side = Camera(position=(0.0, -200.0, 0.0), parallel=True, parallel_scale=60.0)
    grabbed = np.array([0.0, -20.0, 0.0])  # the point of the ring about z that is nearest to the eye
    x, y, _ = project(side, [grabbed], SIZE)[0]
    radian = 20.0 / pixel_length(side, (0, 0, 0), SIZE)  # pixels
    found = ring_angle(side, SIZE, (x + radian * math.radians(30), y), (0, 0, 0), (0, 0, 1), grabbed)
    assert found == pytest.approx(30.0, rel=1e-3)


def test_a_ring_goes_round_several_times():
    last = 0.0
    for angle in (90, 170, -100, -10, 80, 175, -170):
        last = unwrapped(angle, last)
    assert last == 550.0


def test_steps():
    assert [step_for(length) for length in (0.125, 0.3, 0.7, 12.0, 1e-4)] == [1.0, 2.0, 5.0, 100.0, 0.001]
    assert stepped(12.34, 0.5) == 12.5 and stepped(0.1 + 0.2, 0.1) == 0.3 and stepped(-0.01, 1) == 0.0
    assert str(stepped(-0.01, 1)) == "0.0"
    assert [stepped_angle(a, False) for a in (13.1, 11.6, 47.9, -88.0, 50.0)] == [15.0, 12.0, 45.0, -90.0, 50.0]
    assert stepped_angle(44.96, True) == 45.0 and stepped_angle(43.21, True) == 43.2


@pytest.mark.parametrize("camera", CAMERAS)
def test_a_pixel_s_length_is_what_is_projected(camera):
    point = np.array([10.0, -20.0, 5.0])
    length = pixel_length(camera, point, SIZE)
    a, b = project(camera, [point, point + 50 * length * frame(camera)[0]], SIZE)[:, :2]
    assert np.hypot(*(b - a)) == pytest.approx(50.0)


def test_paths_and_areas():
    assert distance_to_path([(0, 0), (10, 0), (10, 10)], 5, 3) == 3.0
    assert distance_to_path([(0, 0), (10, 0)], 13, 4) == 5.0
    assert distance_to_path([(7, 7)], 10, 11) == 5.0
    assert distance_to_path([(math.nan, 0), (1, 1)], 0, 0) == math.inf
    square = [(0, 0), (10, 0), (10, 10), (0, 10)]
    assert inside(square, 5, 5) and not inside(square, 11, 5) and not inside([(math.nan, 0), *square], 5, 5)


def pixels_of(handle: Handle, camera: Camera, points=None) -> np.ndarray:
    world = handle.world(handle.path if points is None else points, handle.length(camera, SIZE))
    return project(camera, world, SIZE)[:, :2]


@pytest.mark.parametrize("camera", CAMERAS)
def test_each_handle_is_caught_where_it_is_drawn(camera):
    turn = np.array(plane_axes((0.3, -0.2, 0.9)))
    for made in (
        move_handles((3, 2, 1), np.eye(3)),
        scale_handles((3, 2, 1), turn),
        plane_handles("plane", (3, 2, 1), (0, 0, 1), 40),
    ):
        for handle in made:
            if handle.name.endswith("square"):
                continue
            path = pixels_of(handle, camera)
            x, y = path.mean(axis=0) if handle.area else path[-1]
            found = caught(made, camera, SIZE, x, y)
            assert found is not None and found.name == handle.name


def test_arrows_are_as_long_on_the_screen_at_every_distance():
    (arrow,) = (h for h in move_handles((0, 0, 0), np.eye(3)) if h.name == "move x")
    for scale in (10.0, 100.0, 1000.0):
        camera = replace(ISO, parallel=True, parallel_scale=scale)
        foot, tip = pixels_of(arrow, camera, np.array([(0.0, 0, 0), (90.0, 0, 0)]))
        sine = np.linalg.norm(np.cross(frame(camera)[2], (1.0, 0, 0)))
        assert np.hypot(*(tip - foot)) == pytest.approx(90.0 * sine)


def test_an_arrow_seen_from_its_end_and_a_square_from_its_edge_are_not_there():
    top = Camera(position=(0.0, 0.0, 200.0), up=(0.0, 1.0, 0.0))
    made = move_handles((0, 0, 0), np.eye(3))
    assert {h.name for h in made if h.seen(top)} == {"move", "move x", "move y", "move xy"}
    assert caught(made, top, SIZE, 320.0, 240.0).name == "move"
    behind = move_handles((0, 0, 500), np.eye(3))
    assert not any(handle.seen(top) for handle in behind)


def test_of_a_ring_only_the_half_before_its_middle_is_caught():
    made = turn_handles((0, 0, 0), np.eye(3))
    ring = next(h for h in made if h.name == "turn z")
    towards = frame(CAMERAS[1])[2] * (1, 1, 0)
    near = RING * towards / np.linalg.norm(towards)
    (x, y), (u, v) = pixels_of(ring, CAMERAS[1], np.array([near, -near]))
    assert caught(made, CAMERAS[1], SIZE, x, y).name == "turn z"
    assert ring.distance(CAMERAS[1], SIZE, u, v) > 50.0


def test_a_size_handle_is_caught_before_an_arrow():
    knob = size_handle("size 0", (0, 0, 0), (0, 1, 0))
    x, y = pixels_of(knob, ISO)[0]
    assert caught((*move_handles((0, 0, 0), np.eye(3)), knob), ISO, SIZE, x, y).name == "size 0"


SIZED = (
    box(10, 20, 30),
    box(10, 20, 30, centred=True),
    sphere(7),
    cylinder(4, 9),
    cylinder(4, 9, centred=True),
    cone(6, 2, 9),
    cone(6, 2, 9, centred=True),
    torus(12, 3),
    extrude(circle(4), 6),
    extrude(circle(4), 6, centred=True),
    linear_array(box(2), 3, (3, 4, 0)),
)


def bounds(node: Node) -> np.ndarray:
    return np.array(measure(node, tolerance=0.002).bounds)


@pytest.mark.parametrize("node", SIZED, ids=lambda node: node.kind)
def test_a_face_follows_its_handle_and_the_far_one_stays(node):
    """Where a handle's point was on the border along its direction, the border goes with the handle."""
    for handle in size_handles(node):
        axis = int(np.argmax(np.abs(handle.direction)))
        side = int(handle.direction[axis] > 0)
        value = handle.value_at(1.5)
        changes = sized(node, handle, value, value)
        shift = changes.pop("shift", (0.0, 0.0, 0.0))
        before, after = bounds(node), bounds(node.with_(**changes).at(*shift))
        moved = after - before
        if handle.along is None and before[side, axis] == pytest.approx(handle.point[axis], abs=0.01):
            assert moved[side, axis] == pytest.approx(1.5 * handle.direction[axis], abs=0.01)
            if handle.name.startswith(("size", "height")):
                centred = getattr(node, "centred", False)
                far = -1.5 * handle.direction[axis] if centred else 0.0
                assert moved[1 - side, axis] == pytest.approx(far, abs=0.01)
        else:
            assert handle.name in ("top radius", "step", "radius", "tube radius")
            assert np.abs(moved).max() > 1.0 or handle.name == "top radius"


def test_values_and_distances_are_each_other_s_inverse():
    for node in SIZED:
        for handle in size_handles(node):
            assert handle.value_at(handle.distance_to(17.0)) == pytest.approx(17.0)
            assert np.linalg.norm(handle.direction) == pytest.approx(1.0)


def test_a_step_keeps_its_direction():
    node = linear_array(box(2), 3, (3, 4, 0))
    (handle,) = size_handles(node)
    assert handle.value == 5.0
    assert sized(node, handle, 10.0, 10.0) == {"step": (6.0, 8.0, 0.0)}


def test_an_expression_stays_in_its_field():
    node = box("width", 20, 30)
    held = node.with_(size=(10.0, 20.0, 30.0))
    x, _, y, low_y, *_ = size_handles(held)
    assert field_of(node, x) == Expression("width") and field_of(node, y) == 20.0
    assert sized(node, low_y, 25.0, 25.0) == {"size": (Expression("width"), 25.0, 30.0), "shift": (0.0, -5.0, 0.0)}


def test_kinds_without_a_size_have_no_handles_and_planes_have_one():
    assert all(size_handles(KINDS[kind](children=())) == () for kind in ("Union", "Difference", "Hull"))
    plane = plane_handle(halfspace((0, 0, 2), (1, 2, 3)))
    assert plane.normal == (0, 0, 1) and plane.point == (1, 2, 3)
    assert plane_handle(sphere(1)) is None


# Pictures.


@pytest.fixture(params=[LIGHT, DARK], ids=["light", "dark"])
def picture(request):
    viewer = Viewer(theme=request.param)
    viewer.resize(*SIZE)
    viewer.set_ground(False)
    viewer.set_cube(False)
    viewer.set_camera(CAMERAS[1])
    marks, label = HandleMarks(), Label()
    viewer.overlay.add(marks)
    viewer.overlay.add(label)
    yield viewer, marks, label, request.param
    viewer.close()


def near_colour(viewer: Viewer, colour, slack=30) -> np.ndarray:
    """(height, width) which pixels have about a colour."""
    return np.abs(viewer.pixels().astype(int) - np.round(255 * np.array(colour))).max(axis=2) < slack


def test_arrows_are_drawn_in_the_axes_colours_and_the_hovered_one_brightens(picture):
    viewer, marks, _, look = picture
    marks.show(move_handles((0, 0, 0), np.eye(3)))
    viewer.render()
    counts = {axis: near_colour(viewer, colour_of(axis, look)).sum() for axis in ("x", "y", "z")}
    assert min(counts.values()) > 150
    x, y = pixels_of(marks.handles[1], viewer.camera)[-1]
    rows, columns = np.nonzero(near_colour(viewer, colour_of("x", look)))
    assert np.hypot(columns - x, rows - y).min() < 4
    marks.hover = "move x"
    viewer.render()
    assert near_colour(viewer, colour_of("x", look)).sum() < counts["x"] / 2
    marks.active, marks.hover = "move z", None
    viewer.render()
    assert near_colour(viewer, colour_of("y", look)).sum() < counts["y"] / 2  # the others are faint


def test_a_locked_handle_is_grey(picture):
    viewer, marks, _, look = picture
    red, green, blue = colour_of("locked", look)
    assert max(red, green, blue) - min(red, green, blue) < 0.25
    for locked in (False, True):
        marks.show((size_handle("size 0", (0, 0, 0), (0, 0, 1), locked),))
        viewer.render()
        x, y = (int(c) for c in pixels_of(marks.handles[0], viewer.camera)[0])
        wanted = colour_of("locked" if locked else "size", look)
        assert near_colour(viewer, wanted)[y - 2 : y + 3, x - 2 : x + 3].all()


def test_the_label_stands_beside_its_place_and_within_the_picture(picture):
    viewer, _, label, look = picture
    viewer.render()
    empty = viewer.pixels().astype(int)
    for place in ((100.0, 100.0), (630.0, 470.0)):
        label.show("Δ 12.5, 0, -3", *place)
        viewer.render()
        rows, columns = np.nonzero(np.abs(viewer.pixels().astype(int) - empty).max(axis=2) > 40)
        assert len(rows) > 100 and rows.max() < SIZE[1] - 3 and columns.max() < SIZE[0] - 3
        assert np.hypot(columns - place[0], rows - place[1]).min() < 40
    assert near_colour(viewer, rgb(look.cube_face), 12).sum() > 300
    label.show("")
    viewer.render()
    assert np.array_equal(viewer.pixels(), empty)
