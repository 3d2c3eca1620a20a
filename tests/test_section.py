"""Plane sections: figures by formula, against a brute-force cut in NumPy, against peers, and on what is degenerate."""

import itertools

import numpy as np
import pytest
import trimesh
from csg_reader import read_csg
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold
from render_meshes import drilled

from solidtree.model.document.errors import Refusal
from solidtree.model.script import box, circle, cylinder, document_of, extrude, sphere
from solidtree.model.script import section as section_of
from solidtree.model.section.section import Plane, cycles, plane_through, section
from solidtree.model.section.solid_sections import document_sections
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import arrays_of

CUBE = [(x, y, z) for x in (0.0, 10.0) for y in (0.0, 10.0) for z in (0.0, 10.0)]


def arrays(solid):
    return arrays_of(solid.to_mesh64())


def brute_force_area(points, triangles, point, normal):
    """The cut of every triangle as a segment, and Green's theorem over them: the area needs no contours.

    A corner in the plane, within rounding, counts as above it.
    """
    normal = np.asarray(normal, float) / np.linalg.norm(normal)
    rounding = 16 * np.finfo(float).eps * max(np.abs(points).max(), abs(np.dot(normal, point)))
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    total = 0.0
    for corners in (points[triangles] - np.asarray(point, float)).astype(float):
        heights = corners @ normal
        heights[np.abs(heights) <= rounding] = 0.0
        above = heights >= 0.0
        if above.all() or not above.any():
            continue
        ends = []
        for i, j in ((0, 1), (1, 2), (2, 0)):
            if above[i] != above[j]:
                a, b = heights[i], heights[j]
                place = corners[i] + a / (a - b) * (corners[j] - corners[i])
                ends.append((above[i], place @ first, place @ second))
        (_, *start), (_, *end) = sorted(ends, key=lambda entry: not entry[0])  # from the edge that leads down
        total += start[0] * end[1] - start[1] * end[0]
    return total / 2.0


@pytest.mark.parametrize(
    ("point", "normal", "area"),
    [
        ((0, 0, 5), (0, 0, 1), 100.0),
        ((0, 0, 10), (0, 0, 1), 100.0),  # the top lies in the plane, and counts as above
        ((0, 0, 0), (0, 0, 1), 0.0),
        ((0, 0, 0), (0, 0, -1), 100.0),  # seen from below it is the bottom that does
        ((5, 5, 5), (1, 1, 0), 100.0 * np.sqrt(2)),  # through two edges
        ((5, 5, 5), (1, 1, 1), 75.0 * np.sqrt(3)),  # the regular hexagon through six midpoints
        ((10, 0, 0), (1, 1, 1), 50.0 * np.sqrt(3)),  # the triangle through three corners
        ((0, 0, 0), (1, 1, 1), 0.0),  # a corner alone
        ((0, 0, 11), (0, 0, 1), 0.0),
    ],
)
def test_sections_of_a_cube_have_the_area_of_the_formula(point, normal, area):
    outline = section(*arrays(Manifold.cube([10, 10, 10])), point, normal)
    assert outline.area == pytest.approx(area, rel=1e-12, abs=1e-12)
    assert (outline.bounds is None) == (area == 0)


def test_a_square_has_four_corners_perimeter_centroid_and_bounds():
    outline = section(*arrays(Manifold.cube([10, 20, 30]).refine(3)), (0, 0, 7), (0, 0, 1))
    assert len(outline.points) == 4  # those on the diagonals and on the refined sides are joined
    assert outline.perimeter == pytest.approx(60.0) and outline.centroid == pytest.approx((5.0, 10.0))
    assert np.array_equal(outline.bounds, [[0, 0], [10, 20]])
    assert np.array_equal(outline.contours_3d[0][:, 2], [7, 7, 7, 7])


def test_a_ball_is_cut_in_its_inscribed_polygon():
    ball = Manifold.sphere(10, 128)
    outline = section(*arrays(ball), (0, 0, 0), (0, 0, 1))
    assert outline.area == pytest.approx(0.5 * 128 * 100 * np.sin(2 * np.pi / 128), rel=1e-12)
    assert section(*arrays(ball), (0, 0, 6), (0, 0, 1)).area == pytest.approx(np.pi * 64, rel=2e-3)


def test_outer_contours_go_counter_clockwise_and_holes_clockwise():
    pipe = Manifold.cylinder(10, 5, 5, 32) - Manifold.cylinder(30, 3, 3, 32).translate([0, 0, -5])
    rod = Manifold.cylinder(10, 1, 1, 32)
    outline = section(*arrays(pipe + rod), (0, 0, 5), (0, 0, 1))
    order = np.argsort(outline.areas)
    assert (np.sign(outline.areas[order]) == [-1, 1, 1]).all()
    hole, inner, outer = order
    assert outline.parents[hole] == outer and outline.parents[inner] == hole and outline.parents[outer] == -1
    assert sorted(outline.regions) == sorted([(int(outer), [int(hole)]), (int(inner), [])])
    assert outline.holds([(0, 0), (2, 0), (4, 0), (6, 0)]).tolist() == [True, False, True, False]
    corners = outline.points[outline.triangles]
    sides = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    filled = 0.5 * (sides[0][:, 0] * sides[1][:, 1] - sides[0][:, 1] * sides[1][:, 0])
    assert filled.min() >= 0 and filled.sum() == pytest.approx(outline.area, rel=1e-12)


@pytest.mark.parametrize(
    ("normal", "u", "v"),
    [
        ((0, 0, 1), (1, 0, 0), (0, 1, 0)),  # from above
        ((0, 0, -2), (1, 0, 0), (0, -1, 0)),  # from below
        ((0, -1, 0), (1, 0, 0), (0, 0, 1)),  # from the front
        ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),  # from behind
        ((3, 0, 0), (0, 1, 0), (0, 0, 1)),  # from the right
        ((-1, 0, 0), (0, -1, 0), (0, 0, 1)),  # from the left
    ],
)
def test_standard_planes_are_drawn_as_they_are_seen(normal, u, v):
    plane = plane_through((4, 5, 6), normal)
    assert plane.u == u and plane.v == v
    assert plane.flat([(7, 8, 9)])[0].tolist() == [np.dot((7, 8, 9), u), np.dot((7, 8, 9), v)]


@given(
    st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: np.linalg.norm(n) > 1e-3), st.tuples(*[st.floats(-9, 9)] * 3)
)
def test_a_planes_axes_are_right_handed_and_hold_its_points(normal, point):
    plane = plane_through(point, normal)
    assert np.allclose(plane.axes @ plane.axes.T, np.eye(3), atol=1e-12) and np.linalg.det(plane.axes) > 0
    assert np.allclose(plane.world(plane.flat([point])), [point], atol=1e-9)
    assert plane.v[2] >= -1e-12 or abs(plane.normal[2]) == 1.0


def test_what_is_no_plane_is_refused():
    for point, normal in (((0, 0, 0), (0, 0, 0)), ((0, 0, np.nan), (0, 0, 1)), ((0, 0, 0), (np.inf, 0, 0))):
        with pytest.raises(Refusal):
            plane_through(point, normal)


_holed = (
    Manifold.cube([20, 20, 20], True)
    - Manifold.cylinder(50, 4, 4, 24, True)
    - Manifold.sphere(7, 24).translate([9, 9, 9])
)
HOLED = arrays(_holed)


@settings(deadline=None)
@given(
    st.tuples(*[st.integers(-2, 2)] * 3).filter(any) | st.tuples(*[st.integers(-1000, 1000)] * 3).filter(any),
    st.sampled_from(range(len(HOLED[0]))) | st.tuples(*[st.floats(-11, 11)] * 3),
)
def test_random_planes_agree_with_the_brute_force_cut(normal, place):
    point = HOLED[0][place] if isinstance(place, int) else place  # many of them go through vertices, edges and faces
    outline = section(*HOLED, point, normal)
    assert outline.area == pytest.approx(brute_force_area(*HOLED, point, normal), rel=1e-9, abs=1e-9)
    assert outline.area >= -1e-9
    assert all(len(contour) >= 3 for contour in outline.contours)


def test_sections_of_corpus_solids_agree_with_brute_force_and_with_the_kernel(corpus):
    folder = corpus / "boolean"
    cut = 0
    for path in sorted(folder.rglob("*.csg"))[:40]:
        try:
            solid = Evaluator().evaluate(read_csg(path.read_text())).solid
        except (KeyError, ValueError):  # kinds of node that the reader does not know
            continue
        if solid is None or solid.is_empty() or solid.num_tri() > 20000:
            continue
        points, triangles = arrays(solid)
        low, high = points.min(axis=0), points.max(axis=0)
        for share in (0.25, 0.5, 0.8123):
            point = low + share * (high - low)
            for normal in ((0, 0, 1), (1, 0.3, -0.2)):
                outline = section(points, triangles, point, normal)
                scale = float(np.ptp(points, axis=0).max()) ** 2
                expected = brute_force_area(points, triangles, point, normal)
                assert outline.area == pytest.approx(expected, rel=1e-9, abs=1e-11 * scale), (path.name, share)
                cut += outline.area > 0
            sliced = solid.slice(point[2]).area()
            level = section(points, triangles, point, (0, 0, 1)).area
            if share == 0.8123:  # the kernel takes what lies in the plane otherwise
                assert level == pytest.approx(sliced, rel=1e-6, abs=1e-7 * scale), path.name
    assert cut > 40


def test_trimesh_finds_the_same_contours():
    points, triangles = arrays(_holed)
    peer = trimesh.Trimesh(points, triangles, process=False).section(plane_origin=(0, 0, 3.3), plane_normal=(0, 1, 2))
    flat, _ = peer.to_2D()
    outline = section(points, triangles, (0, 0, 3.3), (0, 1, 2))
    lengths = sorted(np.linalg.norm(np.diff(p, axis=0), axis=1).sum() for p in flat.discrete)
    own = sorted(np.linalg.norm(np.roll(c, -1, axis=0) - c, axis=1).sum() for c in outline.contours)
    assert own == pytest.approx(lengths, rel=1e-9)


def test_each_side_names_what_was_cut_there():
    mesh = drilled(segments=32)
    outline = section(mesh.points, mesh.triangles, (0, 0, 1), (0, 0, 1), mesh.owner)
    made = {len(contour): set(owners) for contour, owners in zip(
        outline.contours, np.split(outline.owners, outline.starts[1:-1]), strict=True)}  # fmt: skip
    assert made == {4: {0}, 32: {1}}  # split at its creases, and with single precision, it closes all the same


def test_a_corner_between_two_owners_stays_though_it_is_straight():
    pair = box(10, 10, 10) + box(10, 10, 10).at(10)
    (found,), _ = document_sections(document_of(pair), (0, 0, 5), (0, 0, 1))
    assert len(found.outline.points) == 6 and set(found.outline.owners) == {0, 1}
    assert [path[-1] for path in found.owners] == ["n2", "n3"] and found.outline.area == pytest.approx(200.0)


def test_an_open_surface_is_refused_where_it_is_cut():
    points, triangles = arrays(Manifold.cube([1, 1, 1]))
    with pytest.raises(Refusal, match="not closed"):
        section(points, triangles[1:], (0.5, 0.5, 0.5), (1, 2, 3))


def test_contours_close_where_solids_touch_in_an_edge_or_a_corner():
    both = Manifold.compose([Manifold.cube([1, 1, 1]), Manifold.cube([1, 1, 1]).translate([1, 1, 0])])
    outline = section(*arrays(both), (0, 0, 0.5), (0, 0, 1))
    assert outline.area == pytest.approx(2.0) and sum(map(len, outline.contours)) == 8
    for normal in itertools.product((-1, 0, 1), repeat=3):
        if any(normal):
            outline = section(*arrays(both), (1, 1, 1), normal)
            assert outline.area == pytest.approx(brute_force_area(*arrays(both), (1, 1, 1), normal), abs=1e-12)


@given(st.permutations(range(12)))
def test_cycles_of_a_permutation_are_complete_and_in_order(following):
    order, starts = cycles(np.array(following))
    assert sorted(order) == list(range(12)) and starts[0] == 0 and starts[-1] == 12
    for first, last in itertools.pairwise(starts):
        cycle = order[first:last]
        assert [following[i] for i in cycle] == [*cycle[1:], cycle[0]]


def test_equal_points_have_equal_heights_wherever_they_stand():
    plane = Plane((0.6, 0.48, 0.64), 1.0, (1, 0, 0), (0, 1, 0))
    points = np.tile(np.random.default_rng(1).normal(size=(1, 3)), (1001, 1)).astype(np.float32)
    assert len(set(plane.heights(points).tolist())) == 1


def test_scripts_have_it_by_the_same_name(tmp_path):
    outline = section_of(cylinder(5, 10, segments=64) - box(2, 2, 99).at(-1, -1, -9), (0, 0, 5))
    assert outline.area == pytest.approx(0.5 * 64 * 25 * np.sin(2 * np.pi / 64) - 4, rel=1e-9)
    outline.save(tmp_path / "cut.svg")
    assert (tmp_path / "cut.svg").read_text().count("M") == 2
    tube = extrude(circle(3, segments=3), 5)
    assert section_of(sphere(5).at(9) + tube, (0, 0, 2)).bounds is not None
    with pytest.raises(Refusal, match=r"\.svg or \.dxf"):
        outline.save(tmp_path / "cut.pdf")
