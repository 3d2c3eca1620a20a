"""Searching a tree: a line of words and of terms such as `kind:sphere`, and the nodes that answer to all of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Container
from dataclasses import dataclass

from .colours import hex_colour
from .errors import Refusal
from .nodes import Instance, Node

# One term: an optional “-”, an optional field, and a word or words in quotation marks, the last one perhaps unclosed.
_TERM = re.compile(r'(-?)(?:(\w+):)?(?:"([^"]*)"?|(\S+))')

HELP = (
    "Words stand in names, kinds and notes. Terms: kind:sphere  name:left  note:check  colour:red  colour:any  "
    "uses:width  id:n5  hidden  problem  instance  operation; a minus before a term takes its nodes out; "
    "“…” keeps words together."
)
FIELDS = frozenset({"name", "kind", "note", "colour", "color", "uses", "id"})
Test = Callable[[Node, bool], bool]
"""Of a node, and whether it has a problem."""


@dataclass(frozen=True, slots=True)
class Query:
    """`text` as typed, and its tests, all of which a node has to pass; `fault` says what cannot be understood."""

    text: str
    tests: tuple[Test, ...] = ()
    fault: str = ""

    def matches(self, node: Node, problems: Container[str] = ()) -> bool:
        """Whether the node answers to every term; `problems` are the ids of nodes that have one."""
        problem = node.id in problems
        return all(test(node, problem) for test in self.tests)


def query(text: str) -> Query:
    """Read a line. What cannot be understood becomes the query's fault and finds nothing."""
    tests: list[Test] = []
    for minus, field, quoted, word in _TERM.findall(text):
        value = (quoted or word).casefold()
        if not value or (word.endswith(":") and value[:-1] in FIELDS):
            continue  # a term being typed, such as `kind:`
        try:
            test = _test(field.casefold(), value, plain=not quoted)
        except Refusal as refusal:
            return Query(text, (lambda node, problem: False,), str(refusal))
        tests.append(_not(test) if minus else test)
    return Query(text, tuple(tests))


def _not(test: Test) -> Test:
    return lambda node, problem: not test(node, problem)


def _test(field: str, value: str, plain: bool) -> Test:
    match field:
        case "":
            state = _STATES.get(value) if plain else None
            if state is None:
                return lambda node, problem: value in _words(node)
            return lambda node, problem: state(node, problem) or value in _words(node)
        case "name":
            return lambda node, problem: value in node.name.casefold()
        case "kind":
            bare = value.replace("-", "").replace(" ", "").replace("_", "")
            return lambda node, problem: value in node.title.casefold() or bare in node.kind.casefold()
        case "note":
            return lambda node, problem: value in node.note.casefold()
        case "colour" | "color":
            if value in ("any", "none"):
                return lambda node, problem: (node.colour is None) == (value == "none")
            colour = hex_colour(value)
            return lambda node, problem: node.colour == colour
        case "uses":
            return lambda node, problem: any(value in _folded(e.names()) for e in node.expressions())
        case "id":
            return lambda node, problem: node.id.casefold() == value
        case _:
            whole = f"{field}:{value}"
            return lambda node, problem: whole in _words(node)


def _folded(names: frozenset[str]) -> set[str]:
    return {name.casefold() for name in names}


def _words(node: Node) -> str:
    return f"{node.name}\n{node.title}\n{node.note}".casefold()


_STATES: dict[str, Test] = {
    "hidden": lambda node, problem: not node.visible,
    "visible": lambda node, problem: node.visible,
    "problem": lambda node, problem: problem,
    "instance": lambda node, problem: isinstance(node, Instance),
    "operation": lambda node, problem: type(node).operands != (0, 0) and not isinstance(node, Instance),
}
