"""What forms do to the document: check a value in words, preview it, make it a step of the history."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...model.document.document import Document, parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import number, resolved
from ...model.document.fields import FieldSpec
from ...model.document.nodes import Node, field_specs
from ...model.document.placement import Move, Placement, Scale, Step
from ...model.document.tree import find
from ...model.editing.session import Session
from ...model.operations.operations import OPERATIONS


class Edit:
    """One operation with all arguments but the last: `preview` and `commit` give back why not, or None.

    `keywords` gives arguments by name.
    """

    def __init__(
        self,
        session: Session,
        operation: str,
        label: str,
        arguments: Callable[[Document, Any], tuple[Any, ...]],
        check: Callable[[Document, tuple[Any, ...]], None] = lambda document, arguments: None,
        keywords: Callable[[Document, Any], dict[str, Any]] = lambda document, value: {},
    ) -> None:
        self._session = session
        self._operation = operation
        self._label = label
        self._arguments = arguments
        self._check = check
        self._keywords = keywords

    def preview(self, value: Any) -> str | None:
        try:
            arguments = self._arguments(self._session.document, value)
            self._check(self._session.document, arguments)
            keywords = self._keywords(self._session.document, value)
            self._session.preview(OPERATIONS[self._operation](self._session.document, *arguments, **keywords))
        except Refusal as refusal:
            return sentence(refusal)
        return None

    def commit(self, value: Any) -> str | None:
        try:
            arguments = self._arguments(self._session.document, value)
            self._check(self._session.document, arguments)
            keywords = self._keywords(self._session.document, value)
            self._session.do(self._operation, *arguments, label=self._label, **keywords)
        except Refusal as refusal:
            self._session.cancel()
            return sentence(refusal)
        return None

    def cancel(self) -> None:
        self._session.cancel()


def sentence(words: Refusal | str) -> str:
    """With a capital first letter."""
    text = str(words)
    return text[:1].upper() + text[1:]


def field_edit(session: Session, node_id: str, spec: FieldSpec, component: int | None = None) -> Edit:
    """Changes a field of a node, or one number of a vector."""

    def arguments(document: Document, value: Any) -> tuple[Any, ...]:
        node = find(document, node_id)
        if component is not None:
            old = getattr(node, spec.name)
            value = (*old[:component], value, *old[component + 1 :])
        return node_id, spec.name, spec.checked(value, node.title)

    return Edit(session, "set_field", f"Change {spec.label.lower()}", arguments, check_field)


def check_field(document: Document, arguments: tuple[Any, ...]) -> None:
    """Refuse what has no value, or one out of its bounds."""
    node_id, name, value = arguments
    spec = next(spec for spec in field_specs(type(find(document, node_id))) if spec.name == name)
    fault = spec.range_fault(resolved(value, parameter_values(document.parameters)[0]))
    if fault:
        raise Refusal(fault)


def position_edit(session: Session, node_id: str, component: int) -> Edit:
    """Changes one number of a node's position: the move that comes last."""

    def arguments(document: Document, value: Any) -> tuple[Any, ...]:
        placement = find(document, node_id).placement
        old = placement.position
        new = (*old[:component], number(value, f"position {'xyz'[component]}"), *old[component + 1 :])
        return node_id, *placement.moved_to(new).steps

    return Edit(session, "place", "Move", arguments, check_steps)


def step_edit(session: Session, node_id: str, place: int, component: int) -> Edit:
    """Changes one number of one placement step."""

    def arguments(document: Document, value: Any) -> tuple[Any, ...]:
        steps = list(find(document, node_id).placement.steps)
        old = steps[place]
        steps[place] = type(old)((*old.numbers[:component], value, *old.numbers[component + 1 :]))
        return node_id, *steps

    return Edit(session, "place", "Change placement", arguments, check_steps)


def check_steps(document: Document, arguments: tuple[Any, ...]) -> None:
    """Refuse steps that have no value or flatten the solid."""
    steps: tuple[Step, ...] = arguments[1:]
    values = parameter_values(document.parameters)[0]
    for step in Placement(steps).resolve(values).steps:
        if isinstance(step, Scale) and 0.0 in step.numbers:
            raise Refusal("a scale factor must not be 0: the solid would be flat")
        step.matrix()


def with_step(node: Node, step: Step) -> tuple[Step, ...]:
    """The node's steps with one more, before its position, so that the node stays where it is."""
    steps = node.placement.steps
    if steps and isinstance(steps[-1], Move):
        return (*steps[:-1], step, steps[-1])
    return (*steps, step)
