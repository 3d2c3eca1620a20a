"""Where a node goes that is laid on what the pointer is on, without a window."""

from dataclasses import replace

import numpy as np
import pytest

from solidtree.model.document.placement import Placement
from solidtree.model.document.resolve import resolve
from solidtree.model.script import box, cylinder, document_of, measure, parameter
from solidtree.model.solid.places import places_of
from solidtree.model.solid.results import evaluate_document
from solidtree.render.camera import project
from solidtree.render.handles.laying import Laying
from solidtree.render.viewer import Viewer
from solidtree.render.views import standard_view


@pytest.fixture
def begin():
    """begin(others, node) -> laying, at(point): the node laid as the pointer is on a point of the world."""
    viewer = Viewer()
    viewer.resize(640, 480)

    def make(others, node, view="iso", cuts=False):
        document = document_of(others, node)
        evaluation = evaluate_document(document)
        viewer.show({result.root.id: (evaluation.display(result), None) for result in evaluation.solids})
        viewer.set_camera(viewer.fitted(standard_view(replace(viewer.camera, parallel=view == "top"), view)))
        viewer.render()
        resolved = resolve(document)
        own = document.solids[1]
        place = places_of(resolved.solids, [own.id])[own.id][0]
        bare = evaluate_document(document_of(place.node.with_(placement=Placement())))
        laying = Laying(viewer, place, own.placement, bare.display(bare.solids[0]), resolved.values, cuts)

        def pixel(point):
            x, y, _ = project(viewer.camera, [point], viewer.size)[0]
            return float(x), float(y)

        return laying, pixel, own

    yield make
    viewer.close()


def box_of(node, laid):
    return np.array(measure(node.with_(placement=laid.placement)).bounds)


def test_it_stands_over_a_hole_that_shows_nothing_but_air(begin):
    plate = box(40, 40, 5) - cylinder(12, 20).at(15, 15, -5)
    laying, pixel, pin = begin(plate, cylinder(3, 20).at(80, 0, 0), "top")
    laid = laying.at(*pixel((15, 15, 5)))
    assert laid.snap.kind == "centre" and laid.face is None
    low, high = box_of(pin, laid)
    assert np.allclose(low, (12, 12, 5), atol=0.02) and np.allclose(high, (18, 18, 25), atol=0.02)


def test_it_stands_over_a_hole_whose_wall_is_seen(begin):
    plate = box(40, 40, 5) - cylinder(12, 20).at(15, 15, -5)
    laying, pixel, pin = begin(plate, cylinder(3, 20).at(80, 0, 0))
    low, high = box_of(pin, laying.at(*pixel((15, 15, 5))))
    assert np.allclose((low + high) / 2, (15, 15, 15), atol=0.02)


def test_it_stands_on_the_crossings_of_the_ground_s_grid(begin):
    laying, pixel, part = begin(box(40, 40, 5), box(4, 6, 8).at(80, 0, 30), "top")
    laid = laying.at(*pixel((-10, -20, 0)))
    assert laid.snap.kind == "grid"
    assert np.allclose(box_of(part, laid), [(-12, -23, 0), (-8, -17, 8)])


def test_its_own_face_is_seen_as_long_as_none_is_chosen(begin):
    laying, pixel, part = begin(box(60, 60, 5), box(10, 20, 30).at(80, 0, 0))
    at = pixel((85, 0, 15))
    pick = laying.own(*at)
    mesh, face = laying.own_face(pick)
    assert face is not None and np.allclose(face.normal, (0, -1, 0)) and mesh is laying.meshes[part.id]
    laying.choose(pick)
    assert laying.own(*at) is None
    low, high = box_of(part, laying.at(*pixel((30, 30, 5))))
    assert low[2] == pytest.approx(5) and high[2] == pytest.approx(25)


def test_a_placement_s_expressions_stay(begin):
    laying, pixel, part = begin(box(60, 60, 5), box(10, 20, 30).at(parameter("away", 90), 0, 0))
    laid = laying.at(*pixel((60, 30, 2.5)))
    assert laid.placement.symbolic()
    low, _ = box_of(part, laid)
    assert low[0] == pytest.approx(60, abs=1e-4)


def test_what_is_subtracted_goes_into_the_face(begin):
    laying, pixel, drill = begin(box(40, 40, 40), cylinder(3, 12, segments=64).at(80, 0, 0), cuts=True)
    laid = laying.at(*pixel((20, 0, 15)))  # on the front side
    low, high = box_of(drill, laid)
    assert low[1] == pytest.approx(-0.01, abs=1e-6) and high[1] == pytest.approx(11.99, abs=1e-6)
    drilled = box(40, 40, 40) - drill.with_(placement=laid.placement)
    section = measure(drill).volume / 12
    assert measure(drilled).volume == pytest.approx(40**3 - 11.99 * section, rel=1e-9)
