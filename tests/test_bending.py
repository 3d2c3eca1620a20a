import numpy as np
import pytest

from solidtree.model.curve.bezier import evaluated
from solidtree.model.document.errors import Refusal
from solidtree.model.path.bending import bend
from solidtree.model.path.path import Kind, Node, Path

WAVE = Path.of_commands(
    [("move", (0, 0)), ("cubic", (0, 10), (20, 10), (20, 0)), ("cubic", (20, -10), (35, -8), (40, 0))]
).contours[0]


@pytest.mark.parametrize("t", [0.05, 1 / 6, 0.3, 0.5, 0.7, 0.9])
@pytest.mark.parametrize("kind", [Kind.LINE, Kind.QUADRATIC, Kind.CUBIC])
def test_point_that_is_caught_moves_by_what_is_asked(t: float, kind: Kind) -> None:
    commands = {
        Kind.LINE: ("line", (20, 0)),
        Kind.QUADRATIC: ("quad", (10, 9), (20, 0)),
        Kind.CUBIC: ("cubic", (0, 10), (20, 10), (20, 0)),
    }
    contour = Path.of_commands([("move", (0, 0)), commands[kind]]).contours[0]
    bent = bend(contour, 0, t, (1.5, -2.0))
    before, after = (evaluated(one.segment(0), np.array([t])) for one in (contour, bent))
    assert np.abs(after - before - (1.5, -2.0)).max() <= 1e-12
    assert (bent.places == contour.places).all()
    assert bent.kinds[0] == (Kind.CUBIC if kind == Kind.LINE else kind)


def test_share_of_the_handles_is_mirrored() -> None:
    contour = Path.of_commands([("move", (0, 0)), ("cubic", (5, 8), (15, 8), (20, 0))]).contours[0]
    one = bend(contour, 0, 0.3, (0, 3)).points
    other = bend(contour, 0, 0.7, (0, 3)).points
    assert np.allclose(one[:, 1], other[::-1, 1], rtol=0.0, atol=1e-12)


def test_handle_across_a_smooth_node_turns_with_it() -> None:
    from dataclasses import replace

    contour = replace(WAVE, nodes=np.array([Node.CUSP, Node.SMOOTH, Node.CUSP], np.uint8))
    bent = bend(contour, 0, 0.8, (4, 1))
    before, after = bent.points[3] - bent.points[2], bent.points[4] - bent.points[3]
    assert before @ after == pytest.approx(np.linalg.norm(before) * np.linalg.norm(after), rel=1e-12)
    assert np.linalg.norm(after) == pytest.approx(10.0)


@pytest.mark.parametrize("segment, t", [(5, 0.5), (-1, 0.5), (0, 0.0), (0, 1.0)])
def test_what_cannot_be_bent_is_refused(segment: int, t: float) -> None:
    with pytest.raises(Refusal):
        bend(WAVE, segment, t, (1, 1))
