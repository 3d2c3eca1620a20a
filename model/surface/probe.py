"""The light that one place of a picture sends to the eye, term by term: what the shader works out for its pixel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .appearance import Appearance, coordinates_on
from .bitmaps import LUMINANCE, keyed, slopes_of, texels_of
from .intensity import Eye, Terms, terms, to_light_of, unit
from .light import Light
from .mapping import Floats, turns
from .material import Material

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

NEAR = 1e-4
"""Of a triangle's sides: how far off the place coordinates are looked at to know how they change."""


CLEAR = 1e-5
"""Of the scene's size: how far off its face a point is lifted before it looks for what is in the light's way."""


@dataclass(frozen=True, slots=True, eq=False)
class Probe:
    """`terms` are of one point; `lights` those that its diffuse and specular terms belong to, of which `arriving` (l,)
    says how much reaches the place past what casts shadows. `colour` (3,) is the surface's, with the texel in it.

    `weights` (3,) are those of the triangle's corners, where Gouraud's shading takes the light there; else None.
    `texel` (4,) is the texture's, `uv` (2,) where it is, `received` what a light map leaves of the light, and
    `mirrored` (3,) the colour of the panorama, `reflectivity` its share in `shown` (3,), the colour in the picture.
    """

    point: Floats
    terms: Terms
    lights: tuple[Light, ...]
    arriving: Floats
    material: Material
    shading: str
    colour: Floats
    weights: Floats | None
    uv: Floats
    texel: Floats | None
    received: float
    bumped: bool
    mirrored: Floats | None

    @property
    def shown(self) -> Floats:
        lit = self.terms.clamped[0]
        if self.mirrored is None:
            return lit
        share = self.material.reflectivity
        return (1.0 - share) * lit + share * self.mirrored


def probe(
    mesh: DisplayMesh,
    triangle: int,
    point: Floats,
    look: Appearance,
    colour: Floats,
    shading: str,
    lights: Sequence[Light],
    eye: Eye,
    arriving: Floats | None = None,
    material: Material | None = None,
) -> Probe:
    """Of a point (3,) on a triangle of a mesh.

    `colour` (3,) is the face's, 0 to 1, before the texture; `shading` that of the picture; `material` what counts where
    the look has none. `arriving` (l,) says how much of each active light that is not ambient reaches the place. Raises
    Refusal for a bitmap that is missing.
    """
    worn = look.material or material or Material("default")
    shading = worn.shading or shading
    point = np.asarray(point, float)
    corners = mesh.points[mesh.triangles[triangle]].astype(float)
    weights = _weights(corners, point)
    face = unit(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
    # As seen from behind, the normals are those of the other side.
    side = 1.0 if float(eye.towards(point[None])[0] @ face) >= 0.0 else -1.0
    at_corners = side * mesh.normals[mesh.triangles[triangle]].astype(float)
    normal = side * face if shading == "flat" else unit(weights @ at_corners)
    uv, changes = _coordinates(corners, point, look)
    dressed = look.material is not None
    texel = _sample(keyed(texels_of(worn.texture), worn.key), uv, worn.wrap) if dressed and worn.texture else None
    bumped = dressed and bool(worn.bump) and shading == "phong"
    if bumped:
        normal = side * _bumped(side * normal, corners, uv, changes, worn)
    light_map = _sample(texels_of(worn.light_map), uv, worn.wrap) if dressed and worn.light_map else None
    received = 1.0 if light_map is None else float(light_map[:3] @ LUMINANCE)
    surface = np.asarray(colour, float) * (1.0 if texel is None else texel[:3])
    others = tuple(light for light in lights if light.active and light.kind != "ambient")
    shares = np.ones(len(others)) if arriving is None else np.asarray(arriving, float)
    by_corners = shading.startswith("gouraud")
    highlights = shading != "gouraud-diffuse"
    found = terms(point[None], normal[None], eye, worn, surface, lights, np.array([received]), highlights)
    if by_corners:
        light = terms(corners, at_corners, eye, worn, surface, lights, np.full(3, received), highlights)
        found = replace(
            found,
            diffuse=np.einsum("c,cli->li", weights, light.diffuse)[None],
            specular=np.einsum("c,cli->li", weights, light.specular)[None],
        )
        shares = np.ones(len(others))  # there, shadows are left out
    else:
        reach = shares[None, :, None]
        found = replace(found, diffuse=reach * found.diffuse, specular=reach * found.specular)
    mirrored = None
    if dressed and worn.reflection:
        mirrored = _sample(texels_of(worn.reflection), _on_panorama(found.to_eye[0], normal), "repeat")[:3]
    return Probe(point, found, others, shares, worn, shading, surface, weights if by_corners else None, uv, texel,
                 received, bumped, mirrored)  # fmt: skip


def arriving(point: Floats, normal: Floats, lights: Sequence[Light], eye: Eye, corners: Floats, size: float) -> Floats:
    """(l,) 1 for each active light that is not ambient, 0 where it casts shadows and one of the triangles `corners`
    (t, 3, 3) stands between it and a point (3,) with an outward normal (3,).

    `size` is that of the scene: lights from far away are looked for at twice its distance (Möller and Trumbore 1997).
    """
    others = [light for light in lights if light.active and light.kind != "ambient"]
    found = np.ones(len(others))
    edge, side = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    for i, light in enumerate(others):
        if not light.shadows:
            continue
        towards = to_light_of(light, point[None], eye)[0]
        reach = float(np.linalg.norm(np.array(light.position) - point)) if light.kind == "point" else 2.0 * size
        start = point + CLEAR * size * (normal if float(normal @ towards) > 0.0 else -normal)
        across = np.cross(towards, side)
        area = np.einsum("ij,ij->i", edge, across)
        inverse = 1.0 / np.where(np.abs(area) > 0.0, area, np.inf)
        away = start - corners[:, 0]
        u = np.einsum("ij,ij->i", away, across) * inverse
        along = np.cross(away, edge)
        v, far = along @ towards * inverse, np.einsum("ij,ij->i", side, along) * inverse
        if bool(((area != 0.0) & (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (far > 0.0) & (far < reach)).any()):
            found[i] = 0.0
    return found


def _weights(corners: Floats, point: Floats) -> Floats:
    """(3,) barycentric coordinates of a point of a triangle (3, 3)."""
    first, second, along = corners[1] - corners[0], corners[2] - corners[0], point - corners[0]
    across = np.cross(first, second)
    size = max(float(across @ across), 1e-300)
    one = float(np.cross(along, second) @ across) / size
    other = float(np.cross(first, along) @ across) / size
    weights = np.clip((1.0 - one - other, one, other), 0.0, 1.0)
    return weights / weights.sum()


def _coordinates(corners: Floats, point: Floats, look: Appearance) -> tuple[Floats, Floats]:
    """Texture coordinates (2,) of a point, and their changes (2, 2) along the triangle's first and second side."""
    near = np.array([point, point + NEAR * (corners[1] - corners[0]), point + NEAR * (corners[2] - corners[0])])
    found = coordinates_on(near[None], look)[0]
    return found[0], (found[1:] - found[0]) / NEAR


def _bumped(normal: Floats, corners: Floats, uv: Floats, changes: Floats, material: Material) -> Floats:
    """(3,) the normal tilted by the gradient of the heights on the surface (Mikkelsen 2010); see render/surfaces."""
    slopes = slopes_of(texels_of(material.bump), material.bump_kind, 1.0, material.wrap != "clamp")
    slope = material.bump_height * _sample(slopes, uv, material.wrap)
    right, up = corners[1] - corners[0], corners[2] - corners[0]
    across, down = changes
    area = float(across[0] * down[1] - across[1] * down[0])
    if material.bump_kind == "normals" and abs(area) > 1e-20:
        along_u, along_v = right * down[1] - up * across[1], up * across[0] - right * down[0]
        slope = slope * (np.linalg.norm(along_u), np.linalg.norm(along_v)) / abs(area)
    one, other = np.cross(up, normal), np.cross(normal, right)
    size = float(right @ one)
    gradient = np.sign(size) * (float(slope @ across) * one + float(slope @ down) * other)
    return unit(abs(size) * normal - gradient)


def _on_panorama(to_eye: Floats, normal: Floats) -> Floats:
    """(2,) where a panorama of 360 by 180 degrees is met by the ray that is mirrored to the eye."""
    x, y, z = 2.0 * float(normal @ to_eye) * normal - to_eye
    return np.array((turns(np.array([x]), np.array([y]))[0], np.arcsin(np.clip(z, -1.0, 1.0)) / np.pi + 0.5))


def _sample(texels: np.ndarray, uv: Floats, wrap: str) -> Floats:
    """(c,) the texels (h, w, c) around a place, interpolated; bytes as 0 to 1."""
    height, width = texels.shape[:2]
    x, y = uv[0] * width - 0.5, (1.0 - uv[1]) * height - 0.5
    column, row = np.floor(x), np.floor(y)
    columns = _wrapped(np.array((column, column + 1)), width, wrap)
    rows = _wrapped(np.array((row, row + 1)), height, wrap)
    four = texels[np.ix_(rows, columns)].astype(float)
    found = np.array((1.0 - y + row, y - row)) @ np.einsum("rci,c->ri", four, np.array((1.0 - x + column, x - column)))
    return found / 255.0 if texels.dtype == np.uint8 else found


def _wrapped(places: Floats, count: int, wrap: str) -> np.ndarray:
    whole = places.astype(np.int64)
    if wrap == "clamp":
        return np.clip(whole, 0, count - 1)
    if wrap == "mirror":
        whole = whole % (2 * count)
        return np.where(whole >= count, 2 * count - 1 - whole, whole)
    return whole % count
