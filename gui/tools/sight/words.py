"""What the tools for lines of sight ask for, one step after the other."""

from __future__ import annotations

from typing import Literal

Mode = Literal["points", "ray", "part", "map"]

WORDS = {
    "vertex": "Corner", "midpoint": "Middle", "centre": "Centre", "edge": "Edge", "face": "Face", "grid": "Ground",
}  # fmt: skip
FIRST = {
    "points": "Click a point, then another one, to learn whether they see each other; Escape ends this",
    "ray": "Click a face to learn how far it is to what stands before it, and how thick the wall is; Escape ends this",
    "part": "Click a part to learn how much of it is seen from here, and what hides the rest; Escape ends this",
    "map": "Click the point to look from, or press Enter to look from here; then click a face; Escape ends this",
}
SECOND = {
    "points": "Click the point to look at; Escape takes the first one back",
    "map": "Click the face to look at; Escape takes the point back",
}
ANEW = {
    "points": "a click begins anew",
    "ray": "click another face",
    "part": "turn the view, or click another part",
    "map": "click another face, or press Escape for another point",
}
