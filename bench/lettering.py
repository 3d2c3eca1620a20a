"""1,000 letters to one solid, against HarfBuzz's shaping and manifold3d's extrusion of the same outlines."""

from __future__ import annotations

import statistics
import sys
import time
from importlib.resources import files
from pathlib import Path

import numpy as np
import uharfbuzz
from manifold3d import CrossSection, FillRule, Manifold

from solidtree.model.lettering.fonts.library import face_of
from solidtree.model.lettering.lettering import path_of_lettering
from solidtree.model.path.flatten import flatten
from solidtree.model.script import extrude, lettering
from solidtree.model.solid.evaluate import Evaluator

LINES, ROUNDS, MOST, TOLERANCE = 20, 15, 1.3, 0.05
TEXT = "\n".join(("The quick brown fox jumps over the lazy dog, twice " * 2)[:50] for _ in range(LINES))
hb = uharfbuzz  # type: ignore[attr-defined]


def timed(function) -> float:
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def main() -> int:
    node = extrude(lettering(TEXT), 2)
    face_of("DejaVu Sans")  # opened once, as in a session
    rings = [np.ascontiguousarray(ring) for ring in flatten(path_of_lettering(node.children[0]), TOLERANCE)]
    font_file = (Path(str(files("solidtree.resources"))) / "fonts" / "DejaVuSans.ttf").read_bytes()
    font = hb.Font(hb.Face(font_file))

    def here() -> None:
        entry = Evaluator().evaluate(node, TOLERANCE)
        assert entry.solid is not None and entry.solid.num_tri() > 0

    def bare() -> None:
        for line in TEXT.split("\n"):
            buffer = hb.Buffer()
            buffer.add_str(line)
            buffer.guess_segment_properties()
            hb.shape(font, buffer, {})
        assert Manifold.extrude(CrossSection(rings, FillRule.NonZero), 2.0).num_tri() > 0

    here()
    pairs = [(timed(here), timed(bare)) for _ in range(ROUNDS)]
    ratio = statistics.median(mine / other for mine, other in pairs)
    mine, other = (statistics.median(times) * 1e3 for times in zip(*pairs, strict=True))
    letters = len(TEXT.replace("\n", ""))
    print(f"{letters:,} letters to one solid: {mine:.0f} ms, bare {other:.0f} ms, ratio {ratio:.2f} (at most {MOST})")
    return 0 if ratio <= MOST else 1


if __name__ == "__main__":
    sys.exit(main())
