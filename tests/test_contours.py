"""Contour curves that are curves: rims, crossings and silhouettes by formula, cut where a result is."""

import numpy as np
import pytest

from solidtree.model.pipeline.contours import Contours
from solidtree.model.pipeline.round_surfaces import round_surfaces
from solidtree.model.script import (
    box,
    circle,
    cone,
    cylinder,
    document_of,
    extrude,
    polygon,
    rectangle,
    revolve,
    sphere,
    torus,
)
from solidtree.model.solid.provenance import occurrences
from solidtree.model.solid.results import evaluate_document

EYE = np.array([60.0, -45.0, 38.0])
EXACT = 1e-9


def contours_of(node, tolerance=0.05):
    evaluation = evaluate_document(document_of(node), tolerance)
    mesh = evaluation.display(evaluation.solids[0])
    return Contours(mesh, mesh.round)


def on(curves):
    """(k, 3) the ends of all pieces and their middles."""
    ends = curves.points[curves.lines]
    return np.concatenate((ends.reshape(-1, 3), ends.mean(axis=1)))


def used(curves):
    return curves.points[np.unique(curves.lines)]


def length(curves):
    ends = curves.points[curves.lines]
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()


def test_the_rims_of_a_cylinder_are_circles():
    curves = contours_of(cylinder(5, 20)).edges(1e-4)
    places = used(curves)
    assert np.abs(np.hypot(places[:, 0], places[:, 1]) - 5).max() < EXACT
    assert np.unique(places[:, 2].round(9)).tolist() == [0.0, 20.0]
    assert length(curves) == pytest.approx(2 * 2 * np.pi * 5, rel=1e-4)


@pytest.mark.parametrize("fine", [1e-2, 1e-3, 1e-5])
def test_pieces_are_as_fine_as_asked(fine):
    away = 5 - np.hypot(*on(contours_of(cylinder(5, 20)).edges(fine)).T[:2])
    assert away.max() < 1.1 * fine


def test_a_cylinder_cut_in_two_keeps_half_of_its_rims():
    half = cylinder(5, 20) - box(20, 20, 40).at(0, -10, -10)
    curves = contours_of(half).edges(1e-5)
    places = used(curves)
    assert places[:, 0].max() < EXACT
    assert np.abs(np.hypot(places[:, 0], places[:, 1]) - 5).max() < EXACT  # the corners of the cut too
    assert length(curves) == pytest.approx(2 * np.pi * 5 + 2 * 20 + 2 * 10, rel=1e-4)


def test_a_hole_through_a_bar_has_the_curve_in_which_both_cross():
    bar = cylinder(8, 40).at(0, 0, -20) - cylinder(5, 40).at(0, 0, -20).turned(x=90)
    places = used(contours_of(bar).edges(1e-3))
    inner = places[np.abs(places[:, 2]) < 10]
    assert len(inner) > 100
    assert np.abs(np.hypot(inner[:, 0], inner[:, 1]) - 8).max() < EXACT
    assert np.abs(np.hypot(inner[:, 0], inner[:, 2]) - 5).max() < EXACT


def test_a_plane_cuts_a_cone_in_an_ellipse():
    tilted = box(60, 60, 60).at(-30, -30, 0).turned(x=20).at(0, 0, 8)
    places = used(contours_of(cone(10, 0, 20) - tilted).edges(1e-3))
    foot = np.abs(places[:, 2]) < EXACT
    normal = np.array([0, -np.sin(np.radians(20)), np.cos(np.radians(20))])
    assert np.abs(places[~foot] @ normal - 8 * normal[2]).max() < EXACT
    assert np.abs(np.hypot(places[:, 0], places[:, 1]) - 10 * (1 - places[:, 2] / 20)).max() < EXACT


def test_the_silhouette_of_a_sphere_is_the_circle_of_the_cone_from_the_eye():
    curves = contours_of(sphere(10)).silhouette(EYE, False, 1e-5)
    distance = np.linalg.norm(EYE)
    places = used(curves)
    assert np.abs(np.linalg.norm(places, axis=1) - 10).max() < EXACT
    assert np.abs(places @ EYE / distance - 100 / distance).max() < EXACT
    radius = 10 * np.sqrt(1 - 100 / distance**2)
    assert length(curves) == pytest.approx(2 * np.pi * radius, rel=1e-5)


def test_in_parallel_projection_it_is_a_great_circle_and_scaled_an_ellipse():
    curves = contours_of(sphere(10)).silhouette((0, 0, 1), True, 1e-4)
    assert np.abs(used(curves)[:, 2]).max() < EXACT and length(curves) == pytest.approx(20 * np.pi, rel=1e-4)
    places = used(contours_of(sphere(10).scaled(1, 2, 3)).silhouette((0, 0, 1), True, 1e-4))
    assert np.abs((places[:, 0] / 10) ** 2 + (places[:, 1] / 20) ** 2 - 1).max() < EXACT


@pytest.mark.parametrize(
    ("node", "slope"),
    [(cylinder(5, 20), 0.0), (cone(9, 3, 20), 0.3), (extrude(circle(5), 20), 0.0)],
)
def test_cylinders_and_cones_have_two_generators(node, slope):
    curves = contours_of(node).silhouette(EYE, False, 1e-4)
    places = used(curves)
    radius = np.hypot(places[:, 0], places[:, 1])
    normal = np.column_stack((places[:, :2] / radius[:, None], np.full(len(places), slope)))
    assert np.abs(np.einsum("ij,ij->i", normal, EYE - places)).max() < 1e-7
    angles = np.unique(np.degrees(np.arctan2(places[:, 1], places[:, 0])).round(6))
    assert len(angles) == 2
    assert length(curves) == pytest.approx(2 * 20 * np.hypot(1, slope), rel=1e-6)


def test_the_silhouette_of_a_torus_lies_on_it_and_sees_it_edge_on():
    places = used(contours_of(torus(15, 4)).silhouette(EYE, False, 1e-4))
    around = np.hypot(places[:, 0], places[:, 1])
    assert np.abs(np.hypot(around - 15, places[:, 2]) - 4).max() < EXACT
    normal = np.column_stack((places[:, :2] * (1 - 15 / around)[:, None], places[:, 2])) / 4
    rays = (EYE - places) / np.linalg.norm(EYE - places, axis=1, keepdims=True)
    assert np.abs(np.einsum("ij,ij->i", normal, rays)).max() < EXACT


def test_only_what_is_left_of_a_surface_has_a_silhouette():
    whole = contours_of(sphere(10)).silhouette((0, 0, 1), True, 1e-4)
    half = contours_of(sphere(10) - box(30, 30, 30).at(0, -15, -15)).silhouette((0, 0, 1), True, 1e-4)
    assert used(half)[:, 0].max() < 1e-6
    assert length(half) == pytest.approx(length(whole) / 2, rel=1e-3)


def test_revolved_sides_are_cones_and_cylinders():
    vase = revolve(polygon([(2, 0), (6, 0), (3, 8), (2, 8)]))
    places = used(contours_of(vase).edges(1e-3))
    radii = np.unique(np.hypot(places[:, 0], places[:, 1]).round(8))
    assert radii.tolist() == [2.0, 3.0, 6.0]
    ring = revolve(circle(2).at(6))
    assert contours_of(ring).surfaces.count == 1 and len(contours_of(ring).silhouette(EYE, False, 0.01).lines) > 10


@pytest.mark.parametrize("node", [cylinder(5, 8, segments=6), cylinder(5, 20).creased(0), sphere(5, segments=8)])
def test_facets_with_edges_among_them_stand_for_themselves(node):
    contours = contours_of(node)
    curves = contours.edges(1e-4)
    assert len(curves.lines) == len(contours.mesh.edges) > 0
    assert np.allclose(curves.points[curves.lines], contours.mesh.edge_points[contours.mesh.edges], atol=1e-5)


def test_what_the_model_knows_no_curve_of_keeps_its_chords():
    for node in (box(10), extrude(polygon([(0, 0), (9, 0), (4, 7)]), 3), extrude(rectangle(4, 5), 3, taper=10)):
        found = occurrences(document_of(node).solids[0])
        assert round_surfaces(found).count == 0
        assert length(contours_of(node).edges(1e-3)) > 0


def test_a_silhouette_joins_the_rim_where_it_ends():
    contours = contours_of(cylinder(5, 20))
    places = used(contours.silhouette(EYE, False, 1e-4))
    ends = places[(np.abs(places[:, 2]) < EXACT) | (np.abs(places[:, 2] - 20) < EXACT)]
    assert len(np.unique(ends.round(6), axis=0)) == 4
    assert np.abs(np.hypot(ends[:, 0], ends[:, 1]) - 5).max() < EXACT


def test_the_wireframe_picture_differs_from_that_of_the_chords_only_near_its_lines():
    from dataclasses import replace

    from solidtree.render.picture import picture

    evaluation = evaluate_document(document_of(cylinder(8, 20, segments=16)))
    mesh = evaluation.display(evaluation.solids[0])
    curved, plain = (
        picture([(m, None)], (400, 300), style="wireframe").astype(int) for m in (mesh, replace(mesh, round=None))
    )
    differs = np.abs(curved - plain).max(axis=2) > 40
    lines = plain.sum(axis=2) < 450
    near = np.zeros_like(lines)
    for dy in range(-6, 7):
        for dx in range(-6, 7):
            near |= np.roll(lines, (dy, dx), (0, 1))
    assert differs.sum() > 100 and not (differs & ~near).any()
