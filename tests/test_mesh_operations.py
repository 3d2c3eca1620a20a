"""Meshes that nodes hold: made of other nodes, repaired, and edited element by element; every step can be replayed."""

import numpy as np
import pytest

from solidtree.model.checking.document_faults import document_faults
from solidtree.model.document.errors import Refusal
from solidtree.model.document.primitives import ImportedMesh
from solidtree.model.document.table import same_document
from solidtree.model.editing.session import Session
from solidtree.model.exchange.meshes_in import import_file
from solidtree.model.mesh.faults.report import find_faults
from solidtree.model.operations.meshes.mending import repair_of
from solidtree.model.operations.meshes.mesh_nodes import mesh_of_node
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, circle, cylinder, document_of, halfspace, linear_array, measure, polyhedron
from solidtree.model.solid.results import evaluate_document

POINTS = [(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0), (0, 0, 2), (4, 0, 2), (4, 3, 2), (0, 3, 2)]
FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)]


@pytest.fixture
def block():
    """A document with a block of 12 triangles as a mesh, and the node's id."""
    document = document_of(polyhedron(POINTS, FACES).named("block").coloured("#336699").at(5, 0, 0))
    node_id = document.solids[0].id
    return OPERATIONS["convert_to_mesh"](document, node_id), node_id


def volume_of(document):
    return measure(document.solids[0]).volume


def test_a_solid_becomes_a_mesh_in_its_place():
    part = (box(10) - cylinder(3, 20).at(5, 5, -1)).turned(z=30).at(1, 2, 3)
    document = document_of(part=part)
    after = OPERATIONS["convert_to_mesh"](document, document.solids[0].id)
    (node,) = after.solids
    assert isinstance(node, ImportedMesh) and not node.children
    assert (node.id, node.name, node.placement) == (document.solids[0].id, "part", part.placement)
    assert measure(node).volume == pytest.approx(measure(part).volume)
    assert measure(node).centroid == pytest.approx(measure(part).centroid)
    assert same_document(after, OPERATIONS["convert_to_mesh"](document, document.solids[0].id))


def test_an_operand_becomes_a_mesh_where_it_stands():
    row = linear_array(box(2) + box(1).at(1.5, 1.5, 1.5), count=3, step=(5, 0, 0))
    document = document_of(row.at(0, 7, 0))
    union = document.solids[0].children[0]
    after = OPERATIONS["convert_to_mesh"](document, union.id)
    assert volume_of(after) == pytest.approx(volume_of(document))
    assert after.solids[0].children[0].id == union.id


def test_what_has_no_surface_does_not():
    document = document_of(c=circle(3), h=halfspace(), m=box(1) - box(2).at(-0.5, -0.5, -0.5))
    ids = {root.name: root.id for root in document.standing}
    for name, words in (("c", "extrude it first"), ("h", "cannot become a mesh"), ("m", "is empty")):
        with pytest.raises(Refusal, match=words):
            OPERATIONS["convert_to_mesh"](document, ids[name])


def test_arrays_come_back_to_the_very_bit_and_looks_are_kept(block, tmp_path):
    document, node_id = block
    by = (1 / 3, np.pi * 1e-7, -2.5e8)
    before = mesh_of_node(document, node_id)
    after = OPERATIONS["move_mesh_vertices"](document, node_id, range(8), by)
    assert (mesh_of_node(after, node_id).vertices == before.vertices + by).all()
    assert (mesh_of_node(after, node_id).triangles == before.triangles).all()
    node = after.solids[0]
    assert (node.name, node.colour, node.placement) == ("block", "#336699", document.solids[0].placement)


def test_elements_are_found_by_their_places_in_the_world(block):
    """The numbers of a picture are others: a closed mesh has gone through manifold3d."""
    document, node_id = block
    mesh = mesh_of_node(document, node_id)
    evaluation = evaluate_document(document)
    shown = evaluation.display(evaluation.solids[0])
    numbers = mesh.vertex_numbers(shown.vertices)
    assert sorted(numbers) == list(range(8))
    assert (mesh.in_world()[0][numbers] == shown.vertices).all()
    rows = mesh.triangle_numbers(shown.vertices[shown.corners])
    assert sorted(rows) == list(range(12))
    assert (np.sort(mesh.triangles[rows], axis=1) == np.sort(numbers[shown.corners], axis=1)).all()
    assert mesh.vertex_numbers([(4.0, 0, 0), (5, 0, 0)]).tolist() == [-1, 0]


def test_an_edge_is_split_and_the_volume_stays(block):
    document, node_id = block
    after = OPERATIONS["split_mesh_edge"](document, node_id, (0, 1), 0.25)
    mesh = mesh_of_node(after, node_id)
    assert len(mesh.triangles) == 14 and mesh.vertices[8].tolist() == [1, 0, 0]
    (report,) = document_faults(after)
    assert report.faults.sound and report.faults.volume == pytest.approx(24)


def test_an_edge_is_flipped_within_a_flat_face_and_not_over_a_corner(block):
    document, node_id = block
    diagonal = (0, 2)  # of the bottom, which is cut into triangles from its first corner
    after = OPERATIONS["flip_mesh_edge"](document, node_id, diagonal)
    assert len(mesh_of_node(after, node_id).triangles) == 12 and document_faults(after)[0].faults.sound
    assert volume_of(after) == pytest.approx(24)
    with pytest.raises(Refusal, match="no edge from vertex"):
        OPERATIONS["flip_mesh_edge"](after, node_id, diagonal)
    with pytest.raises(Refusal, match="laid over another one"):
        OPERATIONS["flip_mesh_edge"](document, node_id, (0, 1))


def test_an_edge_collapses_where_the_surface_stays_one(block):
    document, node_id = block
    after = OPERATIONS["collapse_mesh_edge"](document, node_id, (0, 1), 0.0)
    mesh = mesh_of_node(after, node_id)
    assert len(mesh.vertices) == 7 and len(mesh.triangles) == 10 and mesh.vertices[0].tolist() == [0, 0, 0]
    assert document_faults(after)[0].faults.closed
    tetrahedron = document_of(polyhedron([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
                                         [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]))  # fmt: skip
    with pytest.raises(Refusal, match="too few edges"):
        OPERATIONS["collapse_mesh_edge"](tetrahedron, tetrahedron.solids[0].id, (0, 1))


def test_faces_are_split_deleted_turned_and_moved(block):
    document, node_id = block
    split = OPERATIONS["split_mesh_face"](document, node_id, 3)
    assert len(mesh_of_node(split, node_id).triangles) == 14 and document_faults(split)[0].faults.sound
    open_ = OPERATIONS["delete_mesh_faces"](document, node_id, [0, 5])
    assert document_faults(open_)[0].faults.open_edges == 6
    turned = OPERATIONS["reverse_mesh_faces"](document, node_id, [2])
    assert document_faults(turned)[0].faults.turned_edges == 3
    inside_out = OPERATIONS["reverse_mesh_faces"](document, node_id)
    assert document_faults(inside_out)[0].faults.inside_out
    mesh = mesh_of_node(document, node_id)
    top = np.flatnonzero(mesh.vertices[:, 2] == 2)
    assert volume_of(OPERATIONS["move_mesh_vertices"](document, node_id, top, (0, 0, 1))) == pytest.approx(36)
    with pytest.raises(Refusal, match="nothing would be left"):
        OPERATIONS["delete_mesh_faces"](document, node_id, range(12))
    with pytest.raises(Refusal, match="has no face 12; there are 12, counted from 0"):
        OPERATIONS["reverse_mesh_faces"](document, node_id, [12])


def test_one_hole_of_two_is_closed(block):
    document, node_id = block
    mesh = mesh_of_node(document, node_id)
    low = (mesh.vertices[mesh.triangles][:, :, 2] == 0).all(axis=1)
    high = (mesh.vertices[mesh.triangles][:, :, 2] == 2).all(axis=1)
    tube = OPERATIONS["delete_mesh_faces"](document, node_id, np.flatnonzero(low | high))
    finding = document_faults(tube)[0].faults.findings[0]
    after = OPERATIONS["close_mesh_holes"](tube, node_id, finding.vertices)
    assert document_faults(tube)[0].faults.borders == 2 and document_faults(after)[0].faults.borders == 1
    with pytest.raises(Refusal, match="no border"):
        OPERATIONS["close_mesh_holes"](after, node_id, finding.vertices)


def test_a_polyhedron_that_is_open_is_repaired_where_it_stands():
    document = document_of(box(9) + polyhedron(POINTS, FACES[:5]).scaled(-1, 1, 1).at(20, 0, 0))
    mesh = document.solids[0].children[1]
    after = OPERATIONS["repair_mesh"](document, mesh.id)
    assert volume_of(after) == pytest.approx(729 + 24)
    assert after.solids[0].children[1].placement == mesh.placement
    assert OPERATIONS["repair_mesh"](after, mesh.id) is after
    assert repair_of(document, mesh.id).words == ("1 hole closed with 2 triangles",)
    own = mesh_of_node(after, mesh.id)
    assert find_faults(own.vertices, own.triangles).volume == pytest.approx(24)


def test_a_moved_mesh_keeps_the_coordinates_that_a_repair_does_not_change():
    part = polyhedron((np.array(POINTS) / 3).tolist(), FACES[:5]).turned(x=33, y=21).scaled(1.7, 0.3, 1).at(1e4, 2, 3)
    document = document_of(part)
    node_id = document.solids[0].id
    after = OPERATIONS["repair_mesh"](document, node_id)
    assert (mesh_of_node(after, node_id).vertices == mesh_of_node(document, node_id).vertices).all()


def test_a_dirty_file_is_mended_and_the_line_replays(tmp_path):
    points, faces = np.array(POINTS, float), [f for a, b, c, d in FACES[:5] for f in ((a, b, c), (a, c, d))]
    soup = points[faces].reshape(-1, 3)
    text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in (soup + 1e-5 * (np.arange(len(soup)) % 3)[:, None]).tolist())
    file = tmp_path / "dirty.obj"
    file.write_text(text + "".join(f"f {k + 1} {k + 2} {k + 3}\n" for k in range(0, len(soup), 3)))
    document = import_file(file)
    node_id = document.solids[0].id
    session = Session(document)
    session.select([node_id])
    after = session.do("repair_mesh", node_id, tolerance=0.001)
    assert document_faults(after)[0].faults.sound and session.selection == (node_id,)
    assert session.log[-1] == f"repair_mesh('{node_id}', tolerance=0.001)"
    assert same_document(OPERATIONS["repair_mesh"](document, node_id, tolerance=0.001), after)
    session.undo()
    assert session.document is document


def test_what_cannot_be_edited_is_refused_in_words(block):
    document, node_id = block
    plain = document_of(box(3))
    for name, arguments, words in (
        ("split_mesh_edge", ((0, 1), 1.0), "between 0 and 1"),
        ("split_mesh_edge", ((0, 99),), "has no vertex 99"),
        ("split_mesh_edge", (7,), "two vertices"),
        ("move_mesh_vertices", ([0], "up"), "three plain numbers"),
        ("move_mesh_vertices", ([], (0, 0, 1)), "first"),
        ("repair_mesh", ("glue",), "no repair"),
        ("convert_to_mesh", (), "is a mesh already"),
    ):
        with pytest.raises(Refusal, match=words):
            OPERATIONS[name](document, node_id, *arguments)
    with pytest.raises(Refusal, match="no mesh: convert it to one first"):
        OPERATIONS["repair_mesh"](plain, plain.solids[0].id)
