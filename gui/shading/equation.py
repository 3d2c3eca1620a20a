"""The textbook's equation with the numbers of one place put in, as rows of a table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...model.surface.intensity import colour_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.surface.light import Light
    from ...model.surface.probe import Probe

DOT = "\u00b7"
SHADING_WORDS = {
    "flat": "flat: the face's own normal",
    "gouraud": "Gouraud: at the corners, interpolated",
    "gouraud-diffuse": "Gouraud without highlights: at the corners, interpolated",
    "phong": "Phong: the interpolated normal",
}


@dataclass(frozen=True, slots=True)
class Row:
    """`values` are red, green and blue, 0 to 1, or with `levels` 0 to 255; `kind` is "", "sum" or "light"."""

    title: str
    reckoned: str
    values: tuple[float, float, float] | None
    levels: bool = False
    kind: str = ""


def rows_of(probe: Probe, ambient: tuple[Light, ...], pixel: NDArray[np.uint8] | None) -> list[Row]:
    """Ambient, diffuse and highlight of each light, their sum, what the picture shows, and the pixel that it has."""
    material, terms = probe.material, probe.terms
    around = sum((colour_of(light) for light in ambient), np.zeros(3))
    surface = _three(probe.colour)
    reckoned = f"Ia ra = {_product(f'({_three(around)})', material.ambient, f'({surface})')}"
    rows = [Row("Ambient", reckoned, _tuple(terms.ambient[0]))]
    for i, light in enumerate(probe.lights):
        reach = "" if probe.arriving[i] == 1.0 else "in the shadow: 0 \u00b7 "
        glow = _three(colour_of(light) * probe.received)
        if probe.weights is None:
            facing = max(float(terms.to_light[0, i] @ terms.normal[0]), 0.0)
            power = f"{max(float(terms.halfway[0, i] @ terms.normal[0]), 0.0):.4f}^{material.shininess:g}"
            diffuse = (
                f"Id rd max(0, s{DOT}m) = {_product(f'({glow})', material.diffuse, f'({surface})', f'{facing:.4f}')}"
            )
            highlight = f"Is rs max(0, h{DOT}m)^f = {_product(f'({glow})', material.specular, power)}"
        else:
            weights = ", ".join(f"{weight:.3f}" for weight in probe.weights)
            diffuse = highlight = f"of the corners, weighed {weights}"
        rows.append(Row(f"{light.name}: diffuse", reach + diffuse, _tuple(terms.diffuse[0, i]), kind="light"))
        rows.append(Row(f"{light.name}: highlight", reach + highlight, _tuple(terms.specular[0, i])))
    rows.append(Row("Sum", "", _tuple(terms.sum[0]), kind="sum"))
    if bool((terms.sum[0] > 1.0).any()):
        rows.append(Row("Clamped", "to 1 at most", _tuple(terms.clamped[0])))
    if probe.mirrored is not None:
        share = material.reflectivity
        rows.append(Row("Mirrored", f"{1 - share:g} of the sum, {share:g} of the panorama", _tuple(probe.mirrored)))
    shown = np.rint(255.0 * probe.shown)
    rows.append(Row("Equation", "in 256 levels", _tuple(shown), True, "sum"))
    if pixel is not None:
        rows.append(Row("Pixel", "of the picture", _tuple(pixel.astype(float)), True))
        off = _tuple(pixel.astype(float) - shown)
        rows.append(Row("Difference", "pixel less equation", off, True))
    return rows


def title_of(probe: Probe, name: str) -> str:
    """Where, on what, shaded how, in a sentence."""
    x, y, z = probe.point
    words = f"\u201c{name}\u201d at ({x:.3f}, {y:.3f}, {z:.3f}) mm, material \u201c{probe.material.name}\u201d; "
    words += SHADING_WORDS[probe.shading]
    if probe.texel is not None:
        u, v = probe.uv
        words += f"; texel at u {u:.4f}, v {v:.4f}: {_three(probe.texel[:3])}"
    if probe.bumped:
        words += "; the normal is tilted by the bump map"
    if probe.received != 1.0:
        words += f"; the light map lets {probe.received:.3f} of the light arrive"
    return words + "."


def _product(*factors: str | float) -> str:
    return f" {DOT} ".join(factor if isinstance(factor, str) else f"{factor:g}" for factor in factors)


def _three(values: NDArray[np.float64]) -> str:
    """Once, where all three are the same."""
    words = [f"{value:.3g}" for value in values]
    return words[0] if len(set(words)) == 1 else ", ".join(words)


def _tuple(values: NDArray[np.float64]) -> tuple[float, float, float]:
    red, green, blue = (float(value) for value in values)
    return red, green, blue
