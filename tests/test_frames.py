"""Where outlines stand in space, told by where their points come to lie in the solid."""

import numpy as np
import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.outline.frames import frame_of
from solidtree.model.script import (
    box,
    document_of,
    extrude,
    linear_array,
    loft,
    measure,
    mirror,
    parameter,
    pipe,
    polygon,
    rectangle,
    revolve,
)  # fmt: skip

CORNERS = np.array([(1, 2, 0), (4, 2, 0), (1, 7, 0)], float)
OUTLINE = polygon([tuple(corner[:2]) for corner in CORNERS]).named("outline")


def seen(document: Document) -> np.ndarray:
    """(3, 3) the corners of the node called “outline” in the world."""
    from solidtree.model.document.tree import walk

    (node,) = (node for node in walk(*document.roots) if node.name == "outline")
    frame = frame_of(document, node.id)
    return CORNERS @ frame[:, :3].T + frame[:, 3]


def test_a_profile_stands_where_it_is_placed():
    np.testing.assert_allclose(
        seen(document_of(OUTLINE.turned(x=90).at(5, 6, 7))), CORNERS @ [[1, 0, 0], [0, 0, 1], [0, -1, 0]] + (5, 6, 7)
    )


@pytest.mark.parametrize("solid", [extrude(OUTLINE, 3), extrude(OUTLINE.at(0, 9), 3).turned(y=40).at(1, 2, 3)])
def test_an_extruded_outline_is_the_foot_of_its_solid(solid):
    document = document_of(solid)
    corners = seen(document)
    rest = solid.with_(placement=solid.placement, height=1e-6)
    bounds = np.array(measure(rest).bounds)
    np.testing.assert_allclose([corners.min(axis=0), corners.max(axis=0)], bounds, atol=2e-6)


def test_the_outline_of_a_centred_extrusion_lies_at_half_the_height_below():
    np.testing.assert_allclose(seen(document_of(extrude(OUTLINE, 6, centred=True)))[:, 2], -3)
    np.testing.assert_allclose(seen(document_of(extrude(OUTLINE, 6, centred=True, below=2)))[:, 2], -2)


def test_a_revolved_outline_is_where_the_turn_begins():
    turned = revolve(OUTLINE, 90, start=30)
    corners = seen(document_of(turned))
    np.testing.assert_allclose(corners[:, 2], CORNERS[:, 1])
    np.testing.assert_allclose(np.hypot(*corners[:, :2].T), CORNERS[:, 0])
    np.testing.assert_allclose(np.degrees(np.arctan2(corners[:, 1], corners[:, 0])), 30)


def test_an_outline_within_operations_and_arrays_is_its_first_copy():
    nested = extrude(linear_array((rectangle() - OUTLINE.at(1)).at(10), 3, (50, 0, 0)), 2)
    np.testing.assert_allclose(seen(document_of(nested)), CORNERS + np.array((11, 0, 0)))
    image = extrude(mirror(OUTLINE, (1, 0, 0), keep=False), 2)
    np.testing.assert_allclose(seen(document_of(image)), CORNERS * (-1, 1, 1))


def test_the_outlines_of_lofts_and_the_paths_of_pipes_stand_as_they_are_placed():
    np.testing.assert_allclose(
        seen(document_of(loft(rectangle(), OUTLINE.at(0, 0, 5)).at(1))), CORNERS + np.array((1, 0, 5))
    )
    np.testing.assert_allclose(seen(document_of(pipe(OUTLINE.at(0, 0, 5)).at(1))), CORNERS + np.array((1, 0, 5)))


def test_numbers_may_be_expressions_and_one_without_a_value_is_refused():
    lift = parameter("lift", 4)
    document = document_of(extrude(OUTLINE, lift, centred=True).at(0, 0, lift))
    np.testing.assert_allclose(seen(document)[:, 2], 2)
    with pytest.raises(Refusal, match="lift"):
        seen(document.with_(parameters=()))


def test_what_is_not_there_is_refused():
    with pytest.raises(Refusal, match="no node"):
        frame_of(document_of(box()), "nowhere")
