"""Nodes by themselves: where they stand, their surface in their own axes, their measures in the world."""

import numpy as np
import pytest

from solidtree.model.document.resolve import resolve
from solidtree.model.script import box, cylinder, document_of, halfspace, linear_array, sphere
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.examine import examine
from solidtree.model.solid.places import places_of


def test_every_occurrence_has_its_place():
    document = document_of(
        a=linear_array(box(2).at(1) - sphere(1).turned(z=90).at(0, 5), count=3, step=(10, 0, 0)).at(z=7)
    )
    places = places_of(resolve(document).solids, ["n4", "nowhere"])
    assert list(places) == ["n4"]
    assert [place.path for place in places["n4"]] == [("n1", i, "n2", "n4") for i in range(3)]
    assert [place.matrix[:, 3].tolist() for place in places["n4"]] == [[0, 5, 7], [10, 5, 7], [20, 5, 7]]
    assert np.allclose(places["n4"][1].outer[:, 3], [10, 0, 7])


def test_a_subtracted_operand_is_whole_in_its_own_axes():
    document = document_of(a=(box(10) - cylinder(2, height=30).at(5, 5, -10)).at(100))
    ((node_id, key, mesh, measures),) = examine(Evaluator(), resolve(document).solids, ["n3"], 0.05, ())
    assert node_id == "n3"
    assert mesh.bounds[:, 2].tolist() == [0, 30]
    assert measures.bounds[0][2] == pytest.approx(-10) and measures.centroid[0] == pytest.approx(105)
    again = examine(Evaluator(), resolve(document).solids, ["n3"], 0.05, {key})
    assert again[0][1] == key and again[0][2] is None and again[0][3] == measures


def test_a_half_space_is_shown_a_little_beyond_its_solid():
    document = document_of(a=(box(10) & halfspace(normal=(0, 0, 1), point=(0, 0, 4))))
    ((_, _, mesh, measures),) = examine(Evaluator(), resolve(document).solids, ["n3"], 0.05, ())
    assert measures is None
    assert mesh.bounds[0][2] == 4 and 10 < mesh.bounds[1][2] < 30 and mesh.bounds[0][0] < 0


def test_what_fails_has_a_part_without_a_surface():
    document = document_of(a=(box(10) + sphere(-1)))
    ((_, _, mesh, measures),) = examine(Evaluator(), resolve(document).solids, ["n3"], 0.05, ())
    assert mesh is None and measures is None
