"""Flattening a path of 10,000 segments against fontTools and ezdxf at equal tolerance, ratios within one run."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np
from ezdxf.math import Bezier4P, Vec2
from fontTools.misc.bezierTools import COMPILED, splitCubicAtT

from solidtree.model.path.flatten import chord_counts, flatten
from solidtree.model.path.path import Path

SEGMENTS = 10_000
MOST = 2.0
"""Times the fastest of the others that flattening may take."""


def least(function: Callable[[], object], rounds: int = 3) -> float:
    found = []
    for _ in range(rounds):
        start = time.perf_counter()
        function()
        found.append(time.perf_counter() - start)
    return min(found)


def main() -> int:
    points = np.random.default_rng(1).random((SEGMENTS, 3, 2)) * 10.0
    path = Path.of_commands([("move", (0.0, 0.0)), *(("cubic", *three) for three in points)])
    curves = np.array(path.contours[0].segments())
    as_tuples = [tuple(map(tuple, curve)) for curve in curves.tolist()]
    as_vectors = [Bezier4P([Vec2(point) for point in curve]) for curve in as_tuples]
    kept = True
    print(f"fontTools compiled: {COMPILED}")
    print(f"{'tolerance':>10} {'points':>10} {'here':>10} {'fontTools':>10} {'ezdxf':>10}   ratio to the faster")
    for tolerance in (0.1, 0.01, 0.001):
        # fontTools has no flattening: its cut of a cubic at the same parameters is the fastest way to the same points.
        counts = chord_counts(curves, tolerance).tolist()
        steps = [[i / count for i in range(1, count)] for count in counts]

        def by_font_tools(steps: list[list[float]] = steps) -> None:
            for curve, at in zip(as_tuples, steps, strict=True):
                [piece[3] for piece in splitCubicAtT(*curve, *at)]

        def by_ezdxf(tolerance: float = tolerance) -> None:
            for curve in as_vectors:
                list(curve.flattening(tolerance))

        here = least(lambda tolerance=tolerance: flatten(path, tolerance))
        fonts, drawings = least(by_font_tools, 1), least(by_ezdxf, 1)
        ratio = here / min(fonts, drawings)
        kept &= ratio <= MOST
        print(
            f"{tolerance:10g} {sum(counts) + 1:10,} {here * 1e3:7.1f} ms {fonts * 1e3:7.1f} ms "
            f"{drawings * 1e3:7.1f} ms   {ratio:.3f}"
        )
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
