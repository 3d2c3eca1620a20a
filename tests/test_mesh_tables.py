"""The lists of a mesh as tables, as the textbook prints them."""

import csv
import io

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.mesh.inspected import inspect_mesh
from solidtree.model.mesh.tables import Tables
from solidtree.model.mesh.winged import COLUMNS
from solidtree.model.script import box, cylinder, evaluate, inspected, mesh_lists, mesh_table, sphere, winged_edge


def numbers(cell: str) -> list[list[int]]:
    """The loops of a cell."""
    return [[int(word) for word in loop.split()] for loop in cell.split("|")]


def test_a_box_of_six_quadrilaterals_is_the_textbooks_table():
    tables = Tables(inspected(box(10, 20, 30).named("box")), ["box"])
    vertices = list(tables.vertices().rows())
    assert len(vertices) == 8 and [row[0] for row in vertices] == [str(i) for i in range(8)]
    assert {tuple(map(float, row[1:4])) for row in vertices} == {
        (x, y, z) for x in (0.0, 10.0) for y in (0.0, 20.0) for z in (0.0, 30.0)
    }
    assert all(row[4] == "3" for row in vertices)
    normals = [tuple(map(float, row[1:4])) for row in tables.normals().rows()]
    axes = np.vstack((np.eye(3), -np.eye(3)))
    assert len(normals) == 6 and set(normals) == {tuple(axis) for axis in axes.tolist()}
    faces = list(tables.faces().rows())
    assert tables.faces().titles == ["Face", "Vertices", "Normals", "Corners", "Loops", "Area", "Made by"]
    assert len(faces) == 6
    points = np.array([[float(value) for value in row[1:4]] for row in vertices])
    for row in faces:
        (corners,), (normal,) = numbers(row[1]), numbers(row[2])
        assert len(corners) == 4 and len(set(corners)) == 4 and normal == normal[:1] * 4
        # Counter-clockwise seen from outside: the corners turn about the listed normal.
        a, b, c = points[corners[:3]]
        turned = np.cross(b - a, c - b)
        assert turned / np.linalg.norm(turned) == pytest.approx(normals[normal[0]])
        assert row[3:5] == ["4", "1"] and row[6] == "box"
    assert sorted(float(row[5]) for row in faces) == [200, 200, 300, 300, 600, 600]
    edges = list(tables.edges().rows())
    assert len(edges) == 12 and sorted(float(row[9]) for row in edges) == [10] * 4 + [20] * 4 + [30] * 4
    assert {row[10] for row in edges} == {"90.0"} and {row[11] for row in edges} == {"convex"}
    assert tables.edges().titles[1:9] == [name.capitalize() for name in COLUMNS]


def test_holes_stand_behind_their_outer_loop():
    mesh = inspected(box(20) - cylinder(4, 60, centred=True, segments=12).at(10, 10, 10))
    with_holes = [row for row in Tables(mesh, ["", ""]).faces().rows() if row[4] == "2"]
    assert len(with_holes) == 2
    for row in with_holes:
        outer, hole = numbers(row[1])
        assert (len(outer), len(hole)) == (4, 12) and int(row[3]) == 16
        assert [len(loop) for loop in numbers(row[2])] == [4, 12]
    assert {row[6] for row in Tables(mesh, ["block", "drill"]).faces().rows()} == {"block", "drill"}


def test_triangles_instead_of_polygons_keep_the_vertices():
    solid = box(20) - cylinder(4, 60, centred=True, segments=12).at(10, 10, 10)
    polygons, triangles = inspected(solid), inspected(solid, triangles=True)
    assert np.array_equal(polygons.lists.vertices, triangles.lists.vertices)
    assert triangles.lists.face_count == len(polygons.triangles) and {len(t) for t in triangles.lists.face(0)} == {3}
    assert polygons.area.sum() == pytest.approx(triangles.area.sum())
    # Each triangle lies in its polygon: as much area, and the same maker.
    summed = np.bincount(polygons.triangle_face, triangles.area)
    assert summed == pytest.approx(polygons.area)
    assert np.array_equal(polygons.maker[polygons.triangle_face], triangles.maker)


def test_counting_from_one_shifts_numbers_and_nothing_else():
    table = Tables(inspected(box(10)), ["box"]).edges()
    zero, one = list(table.rows()), list(table.rows(first=1))
    for before, after in zip(zero, one, strict=True):
        assert [int(cell) + 1 for cell in before[:9]] == [int(cell) for cell in after[:9]]
        assert before[9:] == after[9:]
    counted = Tables(inspected(box(10)), ["box"]).vertices()
    assert {row[4] for row in counted.rows(first=1)} == {"3"}


def test_what_is_not_there_is_minus_one_whatever_numbers_count_from():
    mesh = inspect_mesh(open_box())
    rows = list(Tables(mesh, [""]).edges().rows(first=1))
    naked = [row for row in rows if row[11] == "naked"]
    assert len(naked) == 4 and all(row[10] == "" for row in naked)
    assert all((row[4], row[7], row[8]) == ("-1", "-1", "-1") for row in naked)


def open_box():
    """A box without its lid, as a picture's mesh."""
    from dataclasses import replace

    evaluation = evaluate(box(10))
    mesh = evaluation.display(evaluation.solids[0])
    lid = (mesh.vertices[mesh.corners][:, :, 2] == 10).all(axis=1)
    return replace(mesh, corners=mesh.corners[~lid], facet=mesh.facet[~lid], owner=mesh.owner[~lid])


def test_flat_faces_of_an_open_mesh_are_found_though_nothing_tells_them():
    from dataclasses import replace

    mesh = open_box()
    alone = inspect_mesh(replace(mesh, facet=np.arange(len(mesh.corners), dtype=np.int32)))
    assert alone.lists.face_count == 5 and alone.area == pytest.approx([100] * 5)
    evaluation = evaluate(sphere(10, segments=24))
    ball = evaluation.display(evaluation.solids[0])
    count = len(ball.corners) - 1
    cut = replace(ball, corners=ball.corners[1:], owner=ball.owner[1:], facet=np.arange(count, dtype=np.int32))
    assert inspect_mesh(cut).lists.face_count == count


def test_csv_reads_back_exactly():
    mesh = inspected(sphere(10, segments=16))
    table = Tables(mesh, ["ball, round"]).vertices()
    file = io.StringIO()
    table.write_csv(file, [3, 1])
    rows = list(csv.reader(io.StringIO(file.getvalue())))
    assert rows[0] == table.titles and [row[0] for row in rows[1:]] == ["3", "1"]
    assert [float(value) for value in rows[1][1:4]] == mesh.lists.vertices[3].tolist()
    assert table.tabbed([1]).split("\n")[1].split("\t") == rows[2]
    faces = io.StringIO()
    Tables(mesh, ["ball, round"]).faces().write_csv(faces)
    assert next(csv.DictReader(io.StringIO(faces.getvalue())))["Made by"] == "ball, round"


def test_scripts_get_lists_winged_edge_and_tables():
    part = box(10) - cylinder(2, 30, centred=True, segments=8).at(5, 5, 5)
    assert mesh_lists(part).loop_count == mesh_lists(part).face_count + 2
    assert len(winged_edge(part)) == inspected(part).topology.edges
    assert mesh_table(part, "faces", triangles=True).count == len(inspected(part).triangles)
    with pytest.raises(Refusal, match="no table is called 'edge'"):
        mesh_table(part, "edge")
    with pytest.raises(Refusal, match="one solid or outline is looked into"):
        from solidtree.model.script import document_of

        inspected(document_of(box(1), box(1).at(5)))
