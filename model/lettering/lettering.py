"""Lettering nodes as outlines, and what there is to say about them."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.outlines import Lettering
from ..path.path import Contour, Path
from ..project.assets import default_store
from .fonts.face import Face
from .fonts.library import face_of, fallbacks, version_of
from .layout import Laid, Layout, Style, lay_out
from .runs import missing_in

LONGEST = 20_000
"""Characters of one lettering."""
_SETTING = re.compile(r"([A-Za-z0-9 ]{1,4}?)\s*(?:[=:]\s*([-+]?\d+(?:\.\d+)?))?")
NAMED = 6
"""Characters that a remark names."""
BOLD = 1e-3
"""Share of the em within which outlines are grown."""
Place = tuple[tuple[str, float], ...]
Scale = tuple[float, float, float]
Drawn = tuple[Face, str, Place, Scale, float]
"""A face, a glyph, a place in the design space, a map (across, shear, up) from font units to mm, and a weight in mm."""


def path_of_lettering(node: Lettering) -> Path:
    """A resolved lettering in its own axes, mm, filled by the non-zero rule. Raises Refusal."""
    contours: list[Contour] = []
    for one, drawn in drawn_glyphs(node):
        x, y = one.matrix[:, 2].tolist()
        contours += outline_of_glyph(*drawn).transformed(((1.0, 0.0, x), (0.0, 1.0, y))).contours
    return Path(tuple(contours))


def rings_of_lettering(node: Lettering, tolerance: float, most: int) -> list[NDArray[np.float64]]:
    """The same flattened: (k, 2) points a contour, mm, within `tolerance`. Raises Refusal, also for more than `most`
    points in all."""
    rings: list[NDArray[np.float64]] = []
    total = 0
    for one, drawn in drawn_glyphs(node):
        flat = rings_of_glyph(*drawn, tolerance)
        rings += [np.add(points, one.matrix[:, 2]) for points in flat]
        total += sum(map(len, flat))
        if total > most:
            raise Refusal(f"a tolerance of {tolerance:g} mm makes more than {most:,} points; take a coarser one")
    return rings


def drawn_glyphs(node: Lettering) -> Iterator[tuple[Laid, Drawn]]:
    """Each glyph of a resolved lettering as it is laid out, and what draws it about its own origin. Raises Refusal."""
    faces, layout, location = _laid_out(node)
    weight, own = float(node.weight), tuple(sorted(location.items()))  # type: ignore[arg-type]
    for one in layout.glyphs:
        (across, shear, _), (_, up, _) = one.matrix.tolist()
        source = faces[one.face].source(one.glyph)  # what is not edited is drawn once for all edits
        yield one, (source, one.glyph, () if one.face else own, (across, shear, up), weight)


# What has been drawn before is placed alone: of a text that is edited, the letters that were there.


@lru_cache(maxsize=2048)
def outline_of_glyph(face: Face, glyph: str, location: Place, scale: Scale, weight: float) -> Path:
    """A glyph about its own origin, mm."""
    across, shear, up = scale
    path = face.outline(glyph, dict(location)).transformed(((across, shear, 0.0), (0.0, up, 0.0)))
    if weight and path.contours:
        from ..path.areas.offsetting import offset

        path = offset(path, weight, BOLD * up * face.units_per_em, "miter")
    return path


@lru_cache(maxsize=4096)
def rings_of_glyph(
    face: Face, glyph: str, location: Place, scale: Scale, weight: float, tolerance: float
) -> list[NDArray[np.float64]]:
    from ..path.flatten import flatten

    return flatten(outline_of_glyph(face, glyph, location, scale, weight), tolerance)


@dataclass(frozen=True, slots=True)
class Chain:
    """The fonts that a text is set in: the chosen one, those after it in order, the characters that each of them lends
    as (font, code points), and those that no font has."""

    own: str
    then: tuple[str, ...]
    lent: tuple[tuple[str, tuple[int, ...]], ...]
    lost: tuple[int, ...]


def chain_of(node: Lettering) -> Chain:
    """The fonts of a resolved lettering. Raises Refusal."""
    faces = _chain(node)
    lost = missing_in(node.text, faces)
    lent: dict[int, list[int]] = {}
    for code in missing_in(node.text, faces[:1]):
        if code not in lost:
            number = next(n for n, face in enumerate(faces) if code in face.characters)
            lent.setdefault(number, []).append(code)
    names = [face.name for face in faces]
    lends = tuple((names[number], tuple(codes)) for number, codes in sorted(lent.items()))
    return Chain(names[0], tuple(names[1:]), lends, tuple(lost))


def remarks_on(node: Lettering) -> list[str]:
    """What a reader should know of how a resolved lettering is set: fonts that stand in, characters without a glyph."""
    try:
        chain = chain_of(node)
    except Refusal:
        return []
    remarks = _on_version(node)
    for name, codes in chain.lent:
        remarks.append(f"{chain.own} has no {listed(codes)}: set in {name}")
    if chain.lost:
        remarks.append(f"no font of the chain has {listed(chain.lost)}: shown as a box; choose a font that has it")
    return remarks


def _on_version(node: Lettering) -> list[str]:
    """Of an installed font, which the project does not carry: whether it is the one that the project was made with."""
    if not node.asset or default_store().has(node.asset):
        return []
    here = version_of(node.font)
    if here is None or here[0] == node.asset:
        return []
    return [f"{node.font} is not the version here that the project was made with: letters may look and run otherwise"]


def settings_of(text: str, what: str) -> list[tuple[str, float | None]]:
    """Tags and values of "wght=700, smcp": None where none is given. Raises Refusal."""
    found = []
    for part in re.split(r"[,;\s]+", re.sub(r"\s*[=:]\s*", "=", text.strip())):
        if not part:
            continue
        match = _SETTING.fullmatch(part)
        if match is None:
            raise Refusal(
                f"{what} are written as “{'wght=700' if what == 'axes' else 'kern=0 smcp'}”, not “{part:.40}”"
            )
        found.append((match[1], None if match[2] is None else float(match[2])))
    return found


def location_of(text: str) -> dict[str, float]:
    """Values of axes from "wght=700 wdth=85". Raises Refusal."""
    location = {}
    for tag, value in settings_of(text, "axes"):
        if value is None:
            raise Refusal(f"the axis {tag} has no value")
        location[tag] = value
    return location


def features_of(text: str) -> tuple[tuple[str, int], ...]:
    """OpenType features from "kern=0 smcp". Raises Refusal."""
    return tuple((tag, 1 if value is None else int(value)) for tag, value in settings_of(text, "features"))


def style_of(node: Lettering) -> Style:
    """Raises Refusal."""
    numbers = {
        "size": node.size,
        "line_spacing": node.line_spacing,
        "spacing": node.letter_spacing,
        "slant": node.slant,
    }
    return Style(
        **{name: float(value) for name, value in numbers.items()},  # type: ignore[arg-type]
        width=None if node.width is None else float(node.width),  # type: ignore[arg-type]
        alignment=node.alignment,
        anchor=node.anchor,
        direction=node.direction,
        language=node.language,
        features=features_of(node.features),
    )


def _laid_out(node: Lettering) -> tuple[list[Face], Layout, dict[str, float]]:
    if len(node.text) > LONGEST:
        raise Refusal(f"{node.title}: {len(node.text):,} characters are too many; {LONGEST:,} are the most")
    try:
        location = location_of(node.axes)
        faces = _chain(node)
        return faces, lay_out(node.text, faces, style_of(node), location), location
    except Refusal as refusal:
        raise Refusal(f"{node.title}: {refusal}") from None


def _chain(node: Lettering) -> list[Face]:
    """The font of the lettering, and those that lend it what it lacks."""
    own = face_of(node.font, node.asset, int(float(node.face)))  # type: ignore[arg-type]
    return [own, *(face for face in fallbacks() if face is not own and face.name != own.name)]


def listed(codes: Sequence[int]) -> str:
    """Characters by their code points, with their names."""
    shown = [_character(code) for code in codes[:NAMED]]
    more = f" and {len(codes) - NAMED} more" if len(codes) > NAMED else ""
    return ", ".join(shown) + more


def _character(code: int) -> str:
    name = unicodedata.name(chr(code), "")
    return f"“{chr(code)}” (U+{code:04X}{', ' + name.lower() if name else ''})"
