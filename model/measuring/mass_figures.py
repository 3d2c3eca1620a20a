"""The figures of a solid's measures, in the order in which people look for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .figure import Figure, vector

if TYPE_CHECKING:
    from .measure import Measures


def mass_figures(measures: Measures) -> tuple[Figure, ...]:
    found = []
    if measures.volume is not None:
        found.append(Figure("Volume", (measures.volume,), "mm³"))
    found.append(Figure("Area", (measures.area,), "mm²"))
    if measures.bounds is not None:
        low, high = measures.bounds
        found.append(vector("Size", (b - a for a, b in zip(low, high, strict=True))))
        found.append(vector("From", low))
        found.append(vector("To", high))
    if measures.centroid is not None:
        found.append(vector("Centroid", measures.centroid))
    if measures.inertia is not None and measures.principal_moments is not None:
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = measures.inertia
        found.append(Figure("Inertia", (xx, yy, zz), "mm⁵", parts=("xx", "yy", "zz")))
        found.append(Figure("Products", (xy, xz, yz), "mm⁵", parts=("xy", "xz", "yz")))
        found.append(Figure("Principal", measures.principal_moments, "mm⁵", parts=("least", "middle", "greatest")))
    surfaces = "" if measures.components == 1 else f"in {measures.components} surfaces"
    found.append(Figure("Triangles", (measures.triangles,), ""))
    found.append(Figure("Genus", (measures.genus,), surfaces))
    return tuple(found)
