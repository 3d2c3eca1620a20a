"""Which face a solid stands on."""

import numpy as np
import pytest
from test_landmarks import mesh_of

from solidtree.model.document.placement import IDENTITY
from solidtree.model.measuring.resting import clean_direction, digits_of, resting_face
from solidtree.model.script import box, cylinder, sphere


@pytest.mark.parametrize(
    ("solid", "placed", "point", "normal"),
    [
        (box(10, 20, 30), box().at(1, 2, 3), (6, 12, 3), (0, 0, -1)),
        (cylinder(5, 20), box().at(0, 0, 4), (0, 0, 4), (0, 0, -1)),
        (box(10, 20, 30), box().turned(x=90), (5, -15, 0), (0, 0, -1)),
        (box(10, 20, 30), box().mirrored((0, 0, 1)), (5, 10, -30), (0, 0, -1)),
        (box(10, 20, 30), box().scaled(1, 1, 2).at(0, 0, 5), (5, 10, 5), (0, 0, -1)),
        (box(10, 10, 10), box().turned(x=30), (5, 5 * np.cos(np.pi / 6), 2.5), (0, 0.5, -np.cos(np.pi / 6))),
        (sphere(10), box().at(3, 0, 0), (3, 0, -10), (0, 0, -1)),
    ],
)
def test_the_face_that_looks_down(solid, placed, point, normal):
    found, facing = resting_face(mesh_of(solid), placed.placement.matrix())
    assert np.allclose(found, point, atol=1e-4) and np.allclose(facing, normal, atol=1e-6)


def test_a_lying_cylinder_touches_along_its_lowest_line():
    point, normal = resting_face(mesh_of(cylinder(5, 20, segments=64)), box().turned(y=90).placement.matrix())
    assert np.allclose(point, (10, 0, -5), atol=1e-4) and np.allclose(normal, (0, 0, -1))


def test_a_small_foot_does_not_count():
    """A stud of 1 mm below the middle of a plate is no face to stand on, as flat as it is."""
    mesh = mesh_of(box(40, 40, 5) + cylinder(0.5, 3).at(20, 20, -3))
    point, _ = resting_face(mesh, IDENTITY)
    assert point[2] == pytest.approx(0)


def test_dust_of_single_precision():
    assert clean_direction(np.array([3e-7, -2.0, -1e-7])).tolist() == [0, -1, 0]
    assert digits_of(mesh_of(box(10))) == 5 and digits_of(mesh_of(box(2000))) == 3
