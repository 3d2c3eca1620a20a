"""The textbook's figure: what the text says of it, read from the stored layout by the functions for any tree."""

import itertools

import numpy as np
import pytest

from solidtree.model.partition.cone import flat_cone, prune
from solidtree.model.partition.descent import below, counts, owned, way_down
from solidtree.model.partition.figure import (
    ALONG,
    ANGLE,
    EYE,
    HEIGHT,
    LINES,
    OBJECTS,
    SPLIT,
    WIDTH,
    back_to_front,
    figure,
)

SIGNS = {  # of every corner at h1, h2 and h3
    "A": (1, -1, -1),
    "B": (-1, -1, -1),
    "C": (1, 1, 1),
    "D": (1, -1, 1),
    "E": (1, -1, -1),
}


@pytest.mark.parametrize("name", list("ABCDE"))
def test_every_object_lies_wholly_on_one_side_of_every_plane(name):
    assert set(OBJECTS) == set(SIGNS)
    for line, sign in zip(LINES, SIGNS[name], strict=True):
        heights = [sign * line.height(corner) for corner in OBJECTS[name]]
        assert min(heights) > 1.0, (line.name, heights)
    assert all(0 < x < WIDTH and 0 < y < HEIGHT for x, y in OBJECTS[name])


def test_seen_along_h3_d_lies_right_a_and_e_left():
    h3 = LINES[2]
    assert h3.height(EYE) == 0 and h3.height((EYE[0] + ALONG[0], EYE[1] + ALONG[1])) == 0
    for name, ring in OBJECTS.items():
        # The sign of the cross product of the view's direction and the way from the eye: above 0 is left.
        across = [ALONG[0] * (y - EYE[1]) - ALONG[1] * (x - EYE[0]) for x, y in ring]
        if name in "AE":
            assert min(across) > 0
        if name == "D":
            assert max(across) < 0


def test_b_and_c_are_pruned_by_the_half_spaces_of_h1_and_h2():
    shown = figure()
    found = prune(shown.tree, flat_cone(EYE, ALONG, ANGLE))
    assert {shown.names[node] for node in found.cut} == {"B", "C"}
    above = {"B": ("h1", shown.tree.back), "C": ("h2", shown.tree.front)}
    for node in found.cut:
        name = shown.names[node]
        up = next(i for i in range(len(shown.names)) if node in (shown.tree.front[i], shown.tree.back[i]))
        line, side = above[name]
        assert shown.names[up] == line and side[up] == node
    seen = {shown.object_of[face] for face in shown.tree.source[owned(shown.tree, np.flatnonzero(found.seen))]}
    assert seen == {"A", "D", "E"}
    # The cone itself: all that it can hold lies before h1 and behind h2, as far as one goes.
    ends = np.radians(90 + np.array([-0.5, 0.5]) * ANGLE)
    for far, end in itertools.product((0, 1, 1e6), ends):
        point = (EYE[0] + far * np.cos(end), EYE[1] + far * np.sin(end))
        assert LINES[0].height(point) > 0 > LINES[1].height(point)


def test_a_turned_or_wider_cone_sees_more_and_an_eye_behind_h1_sees_b():
    shown = figure()

    def pruned(eye, direction, angle):
        return {shown.names[node] for node in prune(shown.tree, flat_cone(eye, direction, angle)).cut}

    assert pruned(EYE, ALONG, 150) == set()
    assert "B" not in pruned((10, 20), (0, 1), 20)
    assert pruned((70, 30), (1, 1), 10) == {"B", "a"}  # right of h3 the whole of its left side goes at once


def test_the_painter_draws_hidden_objects_first():
    shown = figure()
    for eye in itertools.product(np.linspace(1, WIDTH - 1, 6), np.linspace(1, HEIGHT - 1, 5)):
        order = back_to_front(shown, eye)
        assert sorted(order) == list("ABCDE")
        for far, near in itertools.combinations(order, 2):
            assert not hides(eye, OBJECTS[far], OBJECTS[near]), (eye, order)


def hides(eye, one, other):
    """Whether `one` stands before `other` somewhere, seen from the eye, by 120 rays around it."""
    return any((a := first_hit(eye, ray, one)) < first_hit(eye, ray, other) < np.inf and a > 0
               for ray in np.linspace(0, 2 * np.pi, 120, endpoint=False))  # fmt: skip


def first_hit(eye, angle, ring):
    """How far along the ray a convex ring begins, infinity where the ray misses it."""
    direction = np.array([np.cos(angle), np.sin(angle)])
    enter, leave = 0.0, np.inf
    for (x, y), (u, v) in zip(ring, (*ring[1:], ring[0]), strict=True):
        outward = np.array([v - y, x - u])
        height, slope = outward @ (eye - np.array([x, y])), outward @ direction
        if slope == 0:
            if height > 0:
                return np.inf
        elif slope < 0:
            enter = max(enter, -height / slope)
        else:
            leave = min(leave, -height / slope)
    return enter if enter < leave else np.inf


def test_the_probe_goes_down_by_the_sign_of_f():
    shown = figure()
    for name, ring in OBJECTS.items():
        middle = np.mean(ring, axis=0)
        way = way_down(shown.tree, (*middle, 0.0))
        assert shown.names[way[-1].node] == name and way[-1].side == ""
        lines = {line.name: line for line in (*LINES, SPLIT)}
        for step in way[:-1]:
            f = lines[shown.names[step.node]].height(tuple(middle))
            assert step.height == pytest.approx(f, abs=1e-12) and step.side == ("front" if f > 0 else "back")
    on = way_down(shown.tree, (52.0, 20.0, 0.0))
    assert [step.side for step in on] == ["front", "back", "in", ""] and on[2].height == 0


def test_the_figure_is_a_tree_like_any_other():
    found = counts(figure().tree)
    faces = sum(len(ring) for ring in OBJECTS.values())
    assert (found.faces, found.fragments, found.splits) == (faces, faces, 0)
    assert (found.nodes, found.depth, found.leaves, found.fragments_per_face) == (9, 5, 5, 1.0)
    assert [len(below(figure().tree, node)) for node in range(9)] == [9, 7, 1, 1, 5, 1, 3, 1, 1]
