"""How triangles lie on a bitmap: what of it they use, texel density, mirrored and flat ones."""

import numpy as np
import pytest

from solidtree.model.script import box, cylinder, document_of, evaluate
from solidtree.model.surface.appearance import appearances, coordinates
from solidtree.model.surface.unwrapped import triangles_at, unwrapped, used_share

SQUARE = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], float)


def lying(node):
    """Texture coordinates (t, 3, 2) and corners (t, 3, 3) of a solid's triangles."""
    document = document_of(node)
    evaluation = evaluate(document)
    mesh = evaluation.display(evaluation.solids[0])
    looks = appearances(document, evaluation.solids[0].root, mesh.owners)
    return coordinates(mesh, looks), mesh.vertices[mesh.corners]


@pytest.mark.parametrize(
    ("size", "at", "wrap", "share"),
    [
        (1.0, 0.0, "repeat", 1.0),
        (0.5, 0.8, "repeat", 0.25),
        (0.5, 0.8, "clamp", 0.2**2),
        (0.5, 0.8, "mirror", 0.3**2),  # what goes beyond 1 comes back over 0.7 to 1
        (0.5, -0.2, "mirror", 0.3**2),
        (40.0, 0.3, "repeat", 1.0),
        (0.25, 7.1, "clamp", 0.0),
    ],
)
def test_the_share_of_the_bitmap_is_that_of_a_square_on_it(size, at, wrap, share):
    assert used_share(size * SQUARE + at, wrap) == pytest.approx(share, abs=0.004)
    assert used_share(np.concatenate([SQUARE[:, ::-1], SQUARE])[:, ::-1] * size + at, wrap) == pytest.approx(
        share, abs=0.004
    )


def test_a_long_thin_triangle_over_many_copies_uses_little_of_each():
    sliver = np.array([[[0.0, 0.0], [400.0, 0.0], [400.0, 0.01]]])
    assert used_share(sliver) == pytest.approx(0.01, abs=0.01)
    assert used_share(np.zeros((0, 3, 2))) == 0.0


def test_density_of_a_box_is_by_its_sides():
    found, corners = lying(box(10, 20, 40))
    told = unwrapped(found, corners, (200, 100))
    # One copy on each face: texels a square millimetre are 200 * 100 over the face's area.
    assert told.density[0] == pytest.approx(np.sqrt(20000 / 800))
    assert told.density[2] == pytest.approx(np.sqrt(20000 / 200))
    assert told.density[1] == pytest.approx(np.sqrt(6 * 20000 / (2 * (200 + 400 + 800))))
    assert told.count == 12 and told.used == 1.0 and not told.mirrored.any() and not told.flat.any()
    assert unwrapped(found, corners).density is None


def test_mirrored_and_flat_triangles_are_found():
    found, corners = lying(cylinder(5, 20))
    assert not unwrapped(found, corners).mirrored.any()
    mirrored = found * (-1.0, 1.0)
    assert unwrapped(mirrored, corners).mirrored.all()
    mirrored[3, :, 1] = 0.25
    told = unwrapped(mirrored, corners, (64, 64))
    assert told.flat.sum() == 1 and told.flat[3] and not told.mirrored[3]
    assert told.density[0] > 0.0


def test_the_triangles_at_a_point():
    both = np.concatenate([SQUARE, 0.5 * SQUARE[:, ::-1]])
    assert triangles_at(both, np.array((0.3, 0.1))).tolist() == [0, 2]
    assert triangles_at(both, np.array((0.6, 0.9))).tolist() == [1]
    assert triangles_at(both, np.array((1.6, 0.9))).tolist() == []
