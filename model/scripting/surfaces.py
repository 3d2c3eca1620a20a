"""What scripts say of surfaces: materials, textures, lights."""

from __future__ import annotations

import os
from pathlib import PurePath
from typing import Any

from ..document.errors import Refusal
from ..surface.light import Light
from ..surface.mapping import TextureMapping
from ..surface.material import BITMAPS, PRESETS, Material

_SHA_LENGTH = 64


def material(name: str, preset: str | None = None, **values: Any) -> Material:
    """A material: `colour`, `ambient`, `diffuse`, `specular`, `shininess`, `opacity` and `shading`, over those of a
    preset.

    `texture`, `bump`, `reflection` and `light_map` are bitmap files, which go with the project. `key` is a colour whose
    texels are transparent; `wrap` is repeat, mirror or clamp; `bump_height` mm from black to white, or with
    `bump_kind="normals"` a factor. See `dressed`.

    >>> box(10).dressed(material("red plastic", "Plastic", colour="red")).material.shininess
    40.0
    """
    if preset is not None and preset not in PRESETS:
        raise Refusal(f"no preset is called {preset!r:.60}; take one of {', '.join(PRESETS)}")
    for field in BITMAPS:
        value = values.get(field)
        if value and not (isinstance(value, str) and len(value) == _SHA_LENGTH and "." not in value):
            values[field] = kept(value)
    return Material(name, **{**PRESETS.get(preset or "", {}), **values})


def texture(
    bitmap: str | os.PathLike[str] | None = None, projection: str = "natural", *, name: str | None = None, **values: Any
) -> TextureMapping | tuple[Material, TextureMapping]:
    """How bitmaps lie on a solid: `projection` natural, planar, box, cylindrical or spherical, in the solid's own axes;
    with a bitmap file, a material of it too, called as the file is or by `name`.

    `origin` (mm) and `turned` (degrees about x, y, z) place it, `size` is one copy's in mm; `offset` (copies), `scale`,
    `turn` (degrees) and `mirror` (two of true or false) change the bitmap on it.

    >>> box(10).dressed(material("plain"), texture(projection="box", size=(5, 5))).mapping.size
    (5.0, 5.0)
    """
    mapping = TextureMapping(projection, **values)
    if bitmap is None:
        return mapping
    return material(name or PurePath(os.fspath(bitmap)).stem, texture=bitmap), mapping


def light(name: str = "Light", kind: str = "directional", **values: Any) -> Light:
    """A light of the document: `kind` ambient, directional or point; `colour`, `intensity`, `position` (mm),
    `direction` (that it shines towards), `with_camera`, `shadows`, `active`. Give it to `save` beside the solids.

    >>> light("sun", direction=(0, 0, -2)).direction
    (0.0, 0.0, -1.0)
    """
    return Light(name, kind, **values)


def kept(path: str | os.PathLike[str]) -> str:
    """The SHA-256 of a bitmap file, now an asset. Raises Refusal that names the file."""
    from ..surface.bitmaps import keep_bitmap

    try:
        return keep_bitmap(path)
    except Refusal as refusal:
        raise Refusal(f"{os.fspath(path)}: {refusal}") from None


__all__ = ["light", "material", "texture"]
