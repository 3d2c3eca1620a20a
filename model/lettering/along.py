"""Lettering set along a curve: each letter rigid, upright on the curve where the middle of its advance stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..curve import bezier, lengths
from ..curve.differential import tangents
from ..document.errors import Refusal
from ..document.nodes import Instance, Node
from ..document.outlines import Lettering, TextOnPath
from ..document.placement import IDENTITY, product
from ..outline.paths import in_plane, path_of
from ..path.path import Contour, Path
from ..path.pieces import pieces_of
from .layout import Laid
from .lettering import Drawn, drawn_glyphs, listed, outline_of_glyph, rings_of_glyph

Floats = NDArray[np.float64]

SLACK = 1e-9
"""Share of its length by which a letter may miss the end of a curve and still stands on it."""


@dataclass(frozen=True, slots=True, eq=False)
class _Letter:
    """What moves as one: glyphs of one character or ligature, with its marks. `place` is that in the text."""

    glyphs: tuple[tuple[Laid, Drawn], ...]
    place: int
    begin: float  # mm along the line, of its advance
    middle: Floats  # (2,) of its advance on the baseline, in the axes of the lettering


def path_along(node: TextOnPath) -> Path:
    """A resolved text on a path in its own axes, mm, filled by the non-zero rule. Raises Refusal."""
    contours: list[Contour] = []
    for letter, matrix in _set(node)[0]:
        for one, drawn in letter.glyphs:
            contours += outline_of_glyph(*drawn).transformed(_from_origin(matrix, one)).contours
    return Path(tuple(contours))


def rings_along(node: TextOnPath, tolerance: float, most: int) -> list[Floats]:
    """The same flattened: (k, 2) points a contour, mm, within `tolerance`. Raises Refusal, also for more than `most`
    points in all."""
    rings: list[Floats] = []
    total = 0
    for letter, matrix in _set(node)[0]:
        fine = tolerance / max(float(np.linalg.norm(matrix[:, :2], 2)), 1e-12)
        for one, drawn in letter.glyphs:
            own = _from_origin(matrix, one)
            flat = rings_of_glyph(*drawn, fine)
            rings += [points @ own[:, :2].T + own[:, 2] for points in flat]
            total += sum(map(len, flat))
        if total > most:
            raise Refusal(f"a tolerance of {tolerance:g} mm makes more than {most:,} points; take a coarser one")
    return rings


def remarks_along(node: TextOnPath) -> list[str]:
    """Which characters of a resolved text on a path have no room on it, and are left out."""
    try:
        _, left = _set(node)
    except Refusal:
        return []
    if not left:
        return []
    text = lettering_of(node.children[0])[0].text
    codes = list(dict.fromkeys(ord(text[letter.place]) for letter in left))
    told = "1 letter has no room on the curve and is" if len(left) == 1 else (
        f"{len(left)} letters have no room on the curve and are")  # fmt: skip
    return [f"{told} left out: {listed(codes)}; take a smaller size, another start or a longer curve"]


def lettering_of(node: Node) -> tuple[Lettering, Floats]:
    """The lettering that an operand is, itself or through instances, and the map (2, 3) that places it.

    Raises Refusal."""
    matrix = IDENTITY
    while True:
        matrix = product(matrix, node.placement.matrix())
        if not isinstance(node, Instance) or not node.children:
            break
        node = node.children[0]
    if not isinstance(node, Lettering):
        raise Refusal(f"Text on a path: its first operand is a lettering, not “{node.label}”")
    flat = in_plane(matrix)
    if flat is None:
        raise Refusal(f"Text on a path: “{node.label}” leaves the plane z = 0; turn it about z only")
    return node, flat


def _set(node: TextOnPath) -> tuple[list[tuple[_Letter, Floats]], list[_Letter]]:
    """The letters with the maps (2, 3) that take them from the lettering's axes to their places on the curve; and
    those that have no room on it, but for what draws nothing."""
    lettering, placed = lettering_of(node.children[0])
    contour = _curve(node.children[1])
    if node.flip:
        contour = contour.reversed()
    letters = _letters(lettering)
    if not letters:
        return [], []
    curve = _Curve(contour)
    begin = {"centre": 0.5, "right": 1.0}.get(lettering.alignment, 0.0) * curve.length + float(node.start)  # type: ignore[arg-type]
    middles = np.array([letter.middle for letter in letters]) @ placed[:, :2].T + placed[:, 2]
    places = begin + middles[:, 0]
    slack = SLACK * curve.length
    if contour.closed:
        first = min(float((placed[:, :2] @ (letter.begin, letter.middle[1]))[0]) for letter in letters) + placed[0, 2]
        fits = middles[:, 0] - first <= curve.length + slack
        places = np.mod(places, curve.length)
    else:
        fits = (places >= -slack) & (places <= curve.length + slack)
    origins, along = curve.at(places)
    up = np.column_stack((-along[:, 1], along[:, 0]))
    origins = origins + float(node.shift) * up  # type: ignore[arg-type]
    found, left = [], []
    for letter, middle, origin, x, y, there in zip(letters, middles, origins, along, up, fits, strict=True):
        turn = np.column_stack((x, y))
        matrix = turn @ placed
        matrix[:, 2] += origin - turn @ (middle[0], 0.0)
        if there:
            found.append((letter, matrix))
        elif any(outline_of_glyph(*drawn).contours for _, drawn in letter.glyphs):
            left.append(letter)
    return found, left


def _letters(node: Lettering) -> list[_Letter]:
    """Clusters in the order of the text; what takes no room, as a mark that another font lends, goes with the character
    before it."""
    clusters: dict[int, list[tuple[Laid, Drawn]]] = {}
    for one, drawn in drawn_glyphs(node):
        clusters.setdefault(one.character, []).append((one, drawn))
    found: list[list[tuple[Laid, Drawn]]] = []
    for place in sorted(clusters):
        glyphs = clusters[place]
        if (
            found
            and not any(one.advance for one, _ in glyphs)
            and "\n" not in node.text[found[-1][0][0].character : place]
        ):
            found[-1] += glyphs
        else:
            found.append(glyphs)
    letters = []
    for glyphs in found:
        wide = [one for one, _ in glyphs if one.advance] or [glyphs[0][0]]
        begin = min(float(one.matrix[0, 2]) for one in wide)
        end = max(float(one.matrix[0, 2]) + one.advance for one in wide)
        line = float(wide[0].matrix[1, 2])
        letters.append(_Letter(tuple(glyphs), glyphs[0][0].character, begin, np.array((0.5 * (begin + end), line))))
    return letters


def _curve(node: Node) -> Contour:
    contours = path_of(node).contours
    if len(contours) != 1:
        told = f"has {len(contours)} contours; take one, or join them" if contours else "is empty: draw something first"
        raise Refusal(f"Text on a path: “{node.label}” {told}")
    if contours[0].dimension != 2:
        raise Refusal(f"Text on a path: “{node.label}” leaves the plane z = 0, in which the letters lie")
    return contours[0]


class _Curve:
    """A contour by its arc length."""

    def __init__(self, contour: Contour) -> None:
        groups = pieces_of((contour,))
        count = sum(len(group.place) for group in groups)
        sizes = np.zeros(count)
        self._pieces: list[tuple[Floats, Floats | None]] = [(np.zeros((0, 2)), None)] * count
        for group in groups:
            sizes[group.place] = lengths.length(group.controls, weights=group.weights)
            for row, place in enumerate(group.place.tolist()):
                self._pieces[place] = (group.controls[row], None if group.weights is None else group.weights[row])
        self._ends = np.cumsum(sizes)
        self._sizes = sizes
        self.length = float(self._ends[-1])
        if not self.length > 0.0:
            raise Refusal("Text on a path: the curve is a point; it has no direction to set letters along")

    def at(self, places: Floats) -> tuple[Floats, Floats]:
        """(k, 2) points and unit tangents at lengths (k,) from its beginning, mm; beyond its ends those of the ends."""
        places = np.clip(places, 0.0, self.length)
        number = np.minimum(np.searchsorted(self._ends, places, "right"), np.flatnonzero(self._sizes)[-1])
        points, along = np.zeros((2, len(places), 2))
        for one in np.unique(number).tolist():
            rows = number == one
            controls, weights = self._pieces[one]
            t = lengths.parameters_at(controls, places[rows] - (self._ends[one] - self._sizes[one]), weights)
            points[rows], along[rows] = bezier.evaluated(controls, t, weights), tangents(controls, t, weights)
        return points, along


def _from_origin(matrix: Floats, one: Laid) -> Floats:
    """A letter's map, of a glyph that is drawn about its own origin."""
    return np.column_stack((matrix[:, :2], matrix[:, :2] @ one.matrix[:, 2] + matrix[:, 2]))
