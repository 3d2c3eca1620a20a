"""The colours of constructions of points, as text, so that panels can have them without the picture."""

LIGHT_POINTS = ("#b3261e", "#1f5bb8", "#2e7d32", "#8a5a00", "#7b3fb3", "#007a87", "#b0257a", "#5b6472")
DARK_POINTS = ("#ff8f86", "#7fb2f2", "#7ccf82", "#edb661", "#c79bf2", "#5fd0dc", "#f78fc8", "#b4bdc8")
LIGHT_LEVELS = ("#00796b", "#6a34b8")
DARK_LEVELS = ("#58d6c3", "#c8a2ff")
"""Of the first and of the last level; those between are mixed."""


def colour_of_point(number: int, light: bool) -> str:
    """Of control point `number` and of what it weighs; eight, again and again."""
    colours = LIGHT_POINTS if light else DARK_POINTS
    return colours[number % len(colours)]
