"""Where an outline stands in space: on its work plane, or in the solid that is made of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..document.document import Document, parameter_values
from ..document.expression import resolved
from ..document.from_outlines import Extrude, Revolve, Sweep
from ..document.nodes import Node, resolve_fields
from ..document.placement import IDENTITY, axis_turn, product
from ..document.resolve import resolve
from ..document.tree import trail
from ..solid.copies import copies

Matrix = NDArray[np.float64]  # (3, 4)

UPRIGHT = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]])
"""x stays, y becomes z: how an outline stands in the solid that turns it."""


def frame_of(document: Document, node_id: str) -> Matrix:
    """(3, 4) from an outline's own axes, before its placement, to the world, wherever it stands in the document.

    In arrays and mirrors that is its first copy; in a definition the definition's own space. Raises Refusal where an
    expression on the way has no value.
    """
    values = parameter_values(document.parameters)[0]
    nodes = trail(document, node_id)
    matrix = IDENTITY
    for above, node in zip((None, *nodes[:-1]), nodes, strict=True):
        if above is not None:
            matrix = product(matrix, _within(document, above, node, values))
        if node.placement.steps:
            matrix = product(matrix, node.placement.resolve(values).matrix())
    return matrix


def _within(document: Document, above: Node, node: Node, values: dict[str, float]) -> Matrix:
    """From the axes in which an operand is placed to those of the operation above it."""
    if isinstance(above, Extrude):
        if not above.centred:
            return IDENTITY
        height, below = (float(resolved(value, values)) for value in (above.height, above.below))
        return np.column_stack((np.eye(3), (0.0, 0.0, 0.5 * (below - height))))
    if isinstance(above, Revolve):
        turn = axis_turn(2, float(resolved(above.start, values)))
        return product(np.column_stack((turn, np.zeros(3))), UPRIGHT)
    if isinstance(above, Sweep):
        return IDENTITY if node is above.children[1] else _start(document, above)
    plain = resolve_fields(above, values, above.children) if above.symbolic else above
    return copies(plain)[0]


def _start(document: Document, sweep: Sweep) -> Matrix:
    """Where the section of a sweep stands: across the beginning of its path."""
    from .paths import path_of
    from .sweeping import start_frame

    along = sweep.children[1]
    if along.symbolic:
        along = resolve(document.with_(solids=(), profiles=(along,))).profiles[0]
    return start_frame(path_of(along))
