"""What is done to the chosen nodes of an outline: for the commands, the keys and the mouse alike."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ....model.document.outlines import Bezier
from ....model.path.path import WORDS, Kind, Node

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..active import ActiveCurve, Place
    from .edit_picture import Hit
    from .edited import Edited

    Floats = NDArray[np.float64]

KINDS = ("cusp", "smooth", "symmetric", "auto")
"""The kinds of nodes, in the order of path.Node."""


def numbers(active: ActiveCurve) -> list[int]:
    """The chosen control points."""
    return [number for _, number in sorted(active.chosen)]


def nodes(active: ActiveCurve) -> list[Place]:
    return sorted(active.chosen)


def move(active: ActiveCurve, by: tuple[float, ...]) -> bool:
    if active.by_points:
        return active.do("move_points", numbers(active), by, label="Move control points")
    return active.do("move_nodes", nodes(active), by, label="Move nodes")


def delete(active: ActiveCurve, refit: bool = True) -> None:
    """Take the chosen nodes out; with `refit` the curve stays as near as may be to where it was."""
    if active.by_points:
        active.do("delete_points", numbers(active), label="Delete control points")
    elif refit:
        active.do("delete_nodes", nodes(active), label="Delete nodes")
    else:
        active.do("delete_nodes", nodes(active), label="Delete nodes", refit=False)


def set_kind(active: ActiveCurve, kind: str) -> None:
    active.do("set_joints", nodes(active), kind, label=f"Make {kind}" if kind != "auto" else "Make automatic")


def next_kind(active: ActiveCurve, place: Place) -> None:
    """A node's next kind, after the last one the first."""
    if active.path is None or active.by_points:
        return
    now = int(active.path.contours[place[0]].nodes[place[1]])
    kind = KINDS[(now + 1) % len(KINDS)]
    active.do("set_joints", [place], kind, label=f"Make {kind}" if kind != "auto" else "Make automatic")


def insert_at(active: ActiveCurve, edited: Edited, hit: Hit) -> None:
    """A new node where the curve was hit, which is chosen then; the curve stays as it is.

    A B-spline gets a knot there, a Bezier curve one degree more.
    """
    parameter = round(min(max(hit.parameter, 1e-4), 1.0 - 1e-4), 6)
    if not active.by_points:
        contour, segment = edited.segment_rows[hit.index].tolist()
        if active.do("insert_node", contour, segment, parameter, label="Insert node"):
            active.choose([(contour, segment + 1)])
    elif isinstance(active.node, Bezier):
        active.do("elevate_degree", label="Elevate degree")
    elif hit.index == 0:
        spline = edited.path.contours[0].splines[0]
        start, end = spline.domain
        active.do("insert_knot", round((1.0 - parameter) * start + parameter * end, 9), label="Insert knot")


def chosen_segments(active: ActiveCurve) -> list[Place]:
    """(contour, segment) whose two nodes are both chosen."""
    if active.path is None or active.by_points:
        return []
    found = []
    for number, contour in enumerate(active.path.contours):
        count = len(contour.nodes)
        mine = [node for where, node in sorted(active.chosen) if where == number]
        held = set(mine)
        found += [(number, node) for node in mine if node < len(contour) and (node + 1) % count in held]
    return found


def insert_between(active: ActiveCurve) -> None:
    """A node in the middle, by parameter, of every chosen segment; the old and the new ones are chosen then."""
    segments = chosen_segments(active)
    before = active.chosen
    # The last ones first, so that the numbers of those to come stay.
    calls = [("insert_node", (contour, segment, 0.5), {}) for contour, segment in reversed(segments)]
    if active.do_all(calls, "Insert nodes"):
        shifted = {
            (contour, node + sum(1 for where, segment in segments if where == contour and segment < node))
            for contour, node in before
        }
        fresh = {
            (contour, segment + 1 + sum(1 for where, other in segments if where == contour and other < segment))
            for contour, segment in segments
        }
        active.choose(shifted | fresh)


def join(active: ActiveCurve, merge: bool = False) -> None:
    first, second = nodes(active)
    if merge:
        active.do("join_nodes", first, second, label="Join nodes into one", merge=True)
    else:
        places = chosen_places(active)
        if active.do("join_nodes", first, second, label="Join nodes by a line"):
            choose_at(active, places)


def chosen_places(active: ActiveCurve) -> Floats:
    """(k, 2) where the chosen nodes are, in the outline's own axes."""
    return active.places[[row in active.chosen for row in active.rows]]


def choose_at(active: ActiveCurve, places: Floats, ends: bool = False) -> None:
    """Choose the nodes at these places, with `ends` those alone where open contours end."""
    assert active.path is not None
    contours = active.path.contours
    wanted = {tuple(place) for place in places.tolist()}
    active.choose(
        (number, node)
        for (number, node), place in zip(active.rows, active.places.tolist(), strict=True)
        if tuple(place) in wanted
        and not (ends and (contours[number].closed or 0 < node < len(contours[number].nodes) - 1))
    )


def close(active: ActiveCurve) -> None:
    """The contours of the chosen nodes; all open ones where none is chosen."""
    assert active.path is not None
    touched = {contour for contour, _ in active.chosen}
    opened = [
        number
        for number, contour in enumerate(active.path.contours)
        if not contour.closed and (not touched or number in touched)
    ]
    active.do("close_contours", opened, label="Close")


def set_segments(active: ActiveCurve, kind: str, title: str) -> None:
    active.do("set_segments", chosen_segments(active), kind, label=title)


def break_apart(active: ActiveCurve) -> None:
    """The ends that this makes are chosen then."""
    places = chosen_places(active)
    if active.do("break_path", nodes(active), label="Break path"):
        choose_at(active, places, ends=True)


def mend(active: ActiveCurve, operation: str, title: str) -> None:
    """smooth_joints, harmonise_joints or match_curvature on the chosen nodes."""
    active.do(operation, nodes(active), label=title)


def align(active: ActiveCurve, axis: str, to: str) -> None:
    """The chosen nodes to one coordinate: "min", "middle" or "max" of theirs."""
    active.do("align_nodes", nodes(active), axis, to, label="Align nodes")


def distribute(active: ActiveCurve, axis: str) -> None:
    """Even steps along an axis between the outermost chosen nodes."""
    active.do("distribute_nodes", nodes(active), axis, label="Distribute nodes")


def mirror_chosen(active: ActiveCurve, axis: int) -> None:
    """The chosen nodes mirrored in place: 0 left and right, 1 up and down."""
    import numpy as np

    places = active.places[[row in active.chosen for row in active.rows]]
    matrix = np.eye(2, 3)
    matrix[axis, axis] = -1.0
    matrix[axis, 2] = float(places[:, axis].min() + places[:, axis].max())
    active.do("transform_nodes", nodes(active), [tuple(row) for row in matrix.tolist()], label="Mirror nodes")


def beside(active: ActiveCurve, forward: bool) -> None:
    """Choose the node after the chosen one, or before it, round and round through all contours."""
    rows = active.rows
    if not rows:
        return
    held = [number for number, row in enumerate(rows) if row in active.chosen]
    if not held:
        active.choose([rows[0 if forward else -1]])
    else:
        active.choose([rows[(held[-1] + 1 if forward else held[0] - 1) % len(rows)]])


def kind_of_chosen(active: ActiveCurve) -> str | None:
    """The kind that all chosen nodes have, None where they differ."""
    if active.path is None or active.by_points or not active.chosen:
        return None
    kinds = {int(active.path.contours[contour].nodes[node]) for contour, node in active.chosen}
    return KINDS[Node(kinds.pop())] if len(kinds) == 1 else None


def kind_of_segments(active: ActiveCurve) -> str | None:
    """The kind that all chosen segments have, None where they differ or none is chosen."""
    if active.path is None:
        return None
    kinds = {int(active.path.contours[contour].kinds[segment]) for contour, segment in chosen_segments(active)}
    return WORDS.get(Kind(kinds.pop())) if len(kinds) == 1 else None
