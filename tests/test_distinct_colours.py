"""Colours by node: stable, on the screen's side of the gamut, apart from their neighbours."""

import math

import numpy as np
import pytest

from solidtree.model.document.colours import rgb
from solidtree.model.document.distinct_colours import distinct_colour, oklch
from solidtree.model.document.nodes import fresh_id


def oklab(colour):
    """Ottosson's way there, from the bytes of sRGB."""
    encoded = np.array(rgb(colour)) / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    cones = np.cbrt(
        np.array(
            [
                [0.4122214708, 0.5363325363, 0.0514459929],
                [0.2119034982, 0.6806995451, 0.1073969566],
                [0.0883024619, 0.2817188376, 0.6299787005],
            ]
        )
        @ linear
    )
    return (
        np.array(
            [
                [0.2104542553, 0.7936177850, -0.0040720468],
                [1.9779984951, -2.4285922050, 0.4505937099],
                [0.0259040371, 0.7827717662, -0.8086757660],
            ]
        )
        @ cones
    )


@pytest.mark.parametrize("hue", range(0, 360, 30))
def test_oklch_is_the_inverse_of_ottossons_conversion(hue):
    lightness, a, b = oklab(oklch(0.74, 0.08, hue))
    assert lightness == pytest.approx(0.74, abs=0.004)
    assert math.hypot(a, b) == pytest.approx(0.08, abs=0.004)
    assert (math.degrees(math.atan2(b, a)) - hue + 180) % 360 - 180 == pytest.approx(0, abs=4)


def test_black_white_and_less_chroma_where_there_is_no_such_colour():
    assert oklch(1, 0, 0) == "#ffffff" and oklch(0, 0, 0) == "#000000"
    assert math.hypot(*oklab(oklch(0.74, 0.4, 200))[1:]) < 0.2


def test_neighbours_differ_and_nothing_changes_between_sessions():
    colours = np.array([oklab(distinct_colour(f"n{i}")) for i in range(1, 200)])
    for apart in range(1, 6):
        # A difference of 0.02 in OKLab is just seen.
        assert np.linalg.norm(colours[apart:] - colours[:-apart], axis=1).min() > 0.08
    gaps = np.linalg.norm(colours[:24, None] - colours[None, :24], axis=2) + np.eye(24)
    assert gaps.min() > 0.025
    assert colours[:, 0].min() > 0.6 and colours[:, 0].max() < 0.86  # neither lost in the dark nor in the light
    fresh = fresh_id()
    assert distinct_colour(fresh) == distinct_colour(fresh)
    assert len({distinct_colour(fresh_id()) for _ in range(50)}) > 40
    # Of the id alone, not of a hash that Python salts.
    assert distinct_colour("nabcdefghij") == distinct_colour("n" + "abcdefghij")
