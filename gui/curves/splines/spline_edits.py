"""What is done to a B-spline or a Bezier curve, and by how much it moves the curve: for the page and the commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ....model.document.document import parameter_values
from ....model.document.errors import Refusal
from ....model.document.expression import Expression
from .spline_words import changes_by

if TYPE_CHECKING:
    from ..active import ActiveCurve, Call

SAMPLED = 400  # control points; of more, what would change is not looked for beforehand


class Previewed:
    """What is shown on its way and becomes one step at its end, or is forgotten."""

    def __init__(self, active: ActiveCurve) -> None:
        self._active = active
        self._pending: tuple[str, list[Call], str] | None = None  # of which node

    def show(self, calls: list[Call], label: str) -> bool:
        """Whether it could be done; else what was shown before stays."""
        node = self._active.node
        if node is None:
            return False
        try:
            self._active.preview_all(calls)
        except Refusal as refusal:
            self._active.refused.emit(str(refusal))
            return False
        self._pending = node.id, calls, label
        return True

    def keep(self) -> None:
        """Make it a step, unless another curve is edited by now."""
        pending, node = self._pending, self._active.node
        self._pending = None
        if pending is not None and node is not None and node.id == pending[0]:
            self._active.do_all(pending[1], pending[2])

    def forget(self) -> None:
        if self._pending is not None:
            self._pending = None
            self._active.cancel()


def plain(active: ActiveCurve, value: float | Expression) -> float:
    """The number that an expression has in the document. Raises Refusal."""
    if isinstance(value, Expression):
        return value.evaluate(parameter_values(active.document.parameters)[0])
    return value


def do_and_tell(active: ActiveCurve, name: str, *arguments: Any, label: str) -> str:
    """An operation that changes the shape; how far the curve moved, in words, "" where it could not be done."""
    before, node = active.document, active.node
    if node is None or not active.do(name, *arguments, label=label):
        return ""
    off = changes_by(before, active.document, node.id)
    return f"{label}: " + ("the curve is the same" if off is None else f"the curve moved by {off}")


def would(active: ActiveCurve, name: str, *arguments: Any) -> str:
    """By how much an operation would move the curve, in words."""
    node = active.node
    if node is None or len(active.rows) > SAMPLED:
        return "the curve changes"
    from ....model.operations.operations import OPERATIONS

    try:
        after = OPERATIONS[name](active.document, node.id, *arguments)
        off = changes_by(active.document, after, node.id)
    except Refusal as refusal:
        return str(refusal)
    return "the curve stays as it is" if off is None else f"the curve moves by {off}"
