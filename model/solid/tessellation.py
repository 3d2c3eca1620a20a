"""How many facets a round thing needs so that none is farther from the true surface than a tolerance."""

from __future__ import annotations

import math

DEFAULT_TOLERANCE = 0.05
MAX_SEGMENTS = 4096
MAX_SURFACE_SEGMENTS = 1024
"""Where facets go both ways, their number is a product: half a million for a sphere."""


def circle_segments(radius: float, tolerance: float) -> int:
    """Facets around a full turn: the sagitta r (1 - cos(pi / n)) is at most `tolerance`; by fours, 8 to 4096."""
    if tolerance >= radius:
        return 8
    return _even(math.pi / (2 * math.asin(math.sqrt(tolerance / radius / 2))))


def sphere_segments(radius: float, tolerance: float) -> int:
    """The same for manifold3d's geodesic sphere: the middle of its largest facet is 13.5 r / n^2 below the surface.

    The constant is the largest over n = 8 ... 512, measured from the facets' planes.
    """
    return _even(math.sqrt(13.5 * radius / tolerance), MAX_SURFACE_SEGMENTS)


def _even(wanted: float, most: int = MAX_SEGMENTS) -> int:
    return max(8, 4 * math.ceil(min(wanted, most) / 4 - 1e-9))
