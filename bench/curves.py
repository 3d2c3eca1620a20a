"""A million points on a Bezier cubic: ours against the `bezier` package's and against a bare Horner scheme in NumPy.

The package is measured where it is importable; it is no dependency.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from overhead import alternately

from solidtree.model.curve.bezier import evaluated, polynomial
from solidtree.model.curve.lengths import length
from solidtree.model.curve.nearest import nearest

COUNT = 1_000_000
ROUNDS = 15


def horner(coefficients: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Points (m, 2 or 3) of a cubic with coefficients (4, d), an axis at a time: the fastest of its bare forms."""
    return np.stack([((d * t + c) * t + b) * t + a for a, b, c, d in coefficients.T], -1)


def report(words: str, mine: float, theirs: float) -> None:
    print(f"{words:44} {1e3 * mine:8.1f} ms {1e3 * theirs:8.1f} ms  {mine / theirs:5.2f}")


def million_points() -> None:
    rng = np.random.default_rng(1)
    t = rng.random(COUNT)
    try:
        package = importlib.import_module("bezier")
    except ImportError:
        package = None
        print("the bezier package is not here: skipped")
    for axes in (2, 3):
        controls = rng.random((4, axes))
        coefficients = polynomial(controls)
        assert np.allclose(horner(coefficients, t), evaluated(controls, t), rtol=0.0, atol=1e-13)
        mine, theirs = alternately(lambda c=controls: evaluated(c, t), lambda c=coefficients: horner(c, t), ROUNDS)
        report(f"a million points, {axes}-D, against bare Horner", mine, theirs)
        if package is not None:
            curve = package.Curve.from_nodes(np.asfortranarray(controls.T))
            assert np.allclose(curve.evaluate_multi(t).T, evaluated(controls, t), rtol=0.0, atol=1e-13)
            mine, theirs = alternately(lambda c=controls: evaluated(c, t), lambda c=curve: c.evaluate_multi(t), ROUNDS)
            report(f"a million points, {axes}-D, against bezier", mine, theirs)


def many_at_once() -> None:
    """What it brings that curves and points go together, against one after the other."""
    rng = np.random.default_rng(2)
    curves, points = rng.random((500, 4, 2)), rng.random((500, 2))
    report(
        "500 lengths against one by one", *alternately(lambda: length(curves), lambda: [length(c) for c in curves], 3)
    )
    each = (lambda: nearest(curves[0], points), lambda: [nearest(curves[0], point) for point in points])
    report("500 nearest points against one by one", *alternately(*each, 3))


if __name__ == "__main__":
    print(f"{'':44} {'ours':>8}    {'other':>8}     ratio")
    million_points()
    many_at_once()
