"""How finely round things are cut into facets for a drawing: so that their corners are not seen on the paper."""

from __future__ import annotations

from collections.abc import Callable

from ..solid.tessellation import DEFAULT_TOLERANCE

ON_PAPER = 0.02
"""mm on paper between a curve and its chords: a tenth of the thinnest line."""
MOST_TRIANGLES, MOST_FILLED = 200_000, 50_000
"""Of a scene that is drawn, and of one whose faces are filled: a second or two of work, and files of some megabytes."""
ROUNDS = 4


def fineness(scale: float, most: int, triangles: Callable[[float], int]) -> float:
    """The tolerance in mm of the model for a drawing at a scale (paper by model), DEFAULT_TOLERANCE at most.

    It is no finer than gives `most` triangles, as far as that can be told beforehand: `triangles` counts them at a
    tolerance, and their number grows no faster than the tolerance falls, that of round walls with its root alone.
    """
    wanted = min(DEFAULT_TOLERANCE, ON_PAPER / scale)
    found = DEFAULT_TOLERANCE
    for _ in range(ROUNDS):
        if found <= wanted:
            break
        count = triangles(found)
        if 2 * count > most:
            break
        found = max(wanted, found * count / most)
    return found
