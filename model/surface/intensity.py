"""The textbook's equation for the light that a surface sends to the eye, term by term.

    I = Ia ra + sum over the lights of (Id rd max(0, s.m) + Is rs max(0, h.m)^f)

after Phong (1975) with the halfway vector of Blinn (1977): m is the unit normal, s the unit vector to the light, v the
one to the eye, h the unit vector halfway between s and v. Ia, Id and Is are the lights' colours times their
intensities, ra and rd the surface's colour times its shares, rs a share of white, f the shininess. The highlight is
left out where the light does not reach the surface (s.m <= 0). Values are those of sRGB as it is stored, 0 to 1, and
the sum is clamped to them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from .light import Light
from .material import Material

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Eye:
    """Where light is seen from: `position` (3,) mm, or with `parallel` from far away in that direction; `axes` (3, 3)
    are the eye's x, y and z in the world, as rows."""

    position: Floats
    axes: Floats
    parallel: bool = False

    def towards(self, points: Floats) -> Floats:
        """(n, 3) unit vectors from points (n, 3) to the eye."""
        return unit(np.broadcast_to(self.axes[2], points.shape) if self.parallel else self.position - points)


@dataclass(frozen=True, slots=True, eq=False)
class Terms:
    """Of n points and l lights that are not ambient: `ambient` (n, 3), `diffuse` and `specular` (n, l, 3), and the unit
    vectors `normal` (n, 3), `to_eye` (n, 3), `to_light` and `halfway` (n, l, 3)."""

    ambient: Floats
    diffuse: Floats
    specular: Floats
    normal: Floats
    to_eye: Floats
    to_light: Floats
    halfway: Floats

    @property
    def sum(self) -> Floats:
        return self.ambient + self.diffuse.sum(axis=1) + self.specular.sum(axis=1)

    @property
    def clamped(self) -> Floats:
        return np.clip(self.sum, 0.0, 1.0)


def terms(
    points: Floats,
    normals: Floats,
    eye: Eye,
    material: Material,
    colours: Floats,
    lights: Sequence[Light],
    received: Floats | None = None,
    specular: bool = True,
) -> Terms:
    """The terms at `points` (n, 3) with `normals` (n, 3), of a surface of `colours` (n, 3) or (3,) under the active
    ones of `lights`. `received` (n,) scales the light that arrives, as a light map does; `specular` False leaves
    highlights out."""
    points = np.asarray(points, float).reshape(-1, 3)
    normal = unit(np.broadcast_to(np.asarray(normals, float), points.shape))
    surface = np.broadcast_to(np.asarray(colours, float), points.shape)
    arriving = np.ones(len(points)) if received is None else np.asarray(received, float)
    to_eye = eye.towards(points)
    shining = [light for light in lights if light.active]
    around = sum((colour_of(light) for light in shining if light.kind == "ambient"), np.zeros(3))
    others = [light for light in shining if light.kind != "ambient"]
    shape = (len(points), len(others), 3)
    diffuse, highlight, to_light, halfway = (np.zeros(shape) for _ in range(4))
    for i, light in enumerate(others):
        s = to_light[:, i] = to_light_of(light, points, eye)
        h = halfway[:, i] = unit(s + to_eye)
        facing = np.einsum("ij,ij->i", s, normal)
        arrives = arriving[:, None] * colour_of(light)
        diffuse[:, i] = arrives * material.diffuse * surface * np.maximum(facing, 0.0)[:, None]
        shine = np.maximum(np.einsum("ij,ij->i", h, normal), 0.0) ** material.shininess
        if specular:
            highlight[:, i] = arrives * material.specular * np.where(facing > 0.0, shine, 0.0)[:, None]
    ambient = around * material.ambient * surface
    return Terms(ambient, diffuse, highlight, normal, to_eye, to_light, halfway)


def to_light_of(light: Light, points: Floats, eye: Eye) -> Floats:
    """(n, 3) unit vectors from points (n, 3) to a light that is not ambient."""
    if light.kind == "point":
        place = np.array(light.position)
        if light.with_camera:
            place = eye.position + place @ eye.axes
        return unit(place - points)
    direction = -np.array(light.direction)
    if light.with_camera:
        direction = direction @ eye.axes
    return unit(np.broadcast_to(direction, points.shape))


def colour_of(light: Light) -> Floats:
    """(3,) the light's colour times its intensity."""
    return light.intensity * np.array(rgb(light.colour)) / 255.0


def unit(vectors: Floats) -> Floats:
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(size > 0.0, size, 1.0)
