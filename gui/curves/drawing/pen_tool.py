"""The pen: a click sets a corner, a drag pulls the handles of a smooth node."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....model.document.errors import Refusal
from ....model.document.nodes import Node as TreeNode
from ....model.path import editing
from ....model.path.path import Contour, Node, Path, Segment
from .draft import Draft, Floats, Held, Options, Sketch, path_node, same

BEGIN = "Click for a corner, drag for a curve, or type x, y; Escape ends this"
GO_ON = (
    "Enter or a double click ends it, C or a click on the first node closes; Backspace takes back, Shift 15°, "
    "Alt one handle, Ctrl no snapping"
)


@dataclass(slots=True, eq=False)
class _Node:
    """A node (2,) with its handles; one that stays on the node is None."""

    place: Floats
    into: Floats | None = None
    out: Floats | None = None

    @property
    def kind(self) -> Node:
        if self.into is None or self.out is None:
            return Node.CUSP
        one, other = self.place - self.into, self.out - self.place
        if same(one, other):
            return Node.SYMMETRIC
        size = float(np.linalg.norm(one) * np.linalg.norm(other))
        return Node.SMOOTH if one @ other >= (1.0 - 1e-12) * size > 0.0 else Node.CUSP


class Pen(Draft):
    """`onto` is an open contour that is gone on with from its end, and `ends` (k, 2) those of others to join."""

    kind = "path"
    many = True

    def __init__(self, options: Options, onto: Contour | None = None, ends: Floats | None = None) -> None:
        super().__init__(options)
        self.onto = onto
        self._ends = np.zeros((0, 2)) if ends is None else ends
        self._nodes: list[_Node] = []
        self._pressed: _Node | None = None
        self.closed = False
        if onto is not None:
            self._nodes.append(_Node(onto.points[-1]))

    @property
    def hint(self) -> str:  # type: ignore[override]
        return GO_ON if self._nodes else BEGIN

    @property
    def begun(self) -> bool:
        return bool(self._nodes)

    @property
    def last(self) -> Floats | None:
        return self._nodes[-1].place if self._nodes else None

    @property
    def origin(self) -> Floats | None:
        return self.last if self._pressed is None else self._pressed.place

    @property
    def places(self) -> Floats:
        if self._pressed is not None:  # a handle needs no node to lie on
            return np.zeros((0, 2))
        first = [] if self.onto is None else [self.onto.points[0]]
        return np.array([*(node.place for node in self._nodes), *first, *self._ends]).reshape(-1, 2)

    def press(self, point: Floats, held: Held) -> None:
        self.pointer, self.held = point, held
        nodes = self._nodes
        begin = self.onto.points[0] if self.onto is not None else nodes[0].place if nodes else None
        if begin is not None and same(point, begin) and self._closable():
            self.closed = True
            self._pressed = _Node(begin) if self.onto is not None else nodes[0]
        elif nodes and same(point, nodes[-1].place):
            self._pressed = nodes[-1]
            self._pressed.out = None
        else:
            self._pressed = _Node(point)
            nodes.append(self._pressed)

    def drag(self, point: Floats, held: Held) -> None:
        """Pull the handles of the node that was pressed: both, or with Alt the one ahead alone."""
        self.pointer, self.held = point, held
        node = self._pressed
        if node is None:
            return
        if self.closed:
            node.into = 2.0 * node.place - point
            if not held.alt and (node.out is not None or self.onto is None):
                node.out = point
        else:
            node.out = point
            if not held.alt and not (self.onto is not None and node is self._nodes[0]):
                node.into = 2.0 * node.place - point

    def release(self, point: Floats, held: Held, dragged: bool) -> None:
        self.pointer, self.held = point, held
        pressed, self._pressed = self._pressed, None
        if self.closed and self.onto is not None and pressed is not None:
            self._nodes.append(pressed)
        joins = pressed is not None and any(same(pressed.place, end) for end in self._ends)
        self.complete = self.closed or (joins and len(self._nodes) > 1)

    def finish(self, closed: bool = False) -> None:
        if closed:
            if not self._closable():
                raise Refusal("three nodes or more, or two with handles, can be closed")
            self.closed = True
            if self.onto is not None:
                self._nodes.append(_Node(self.onto.points[0]))
        elif len(self._nodes) < 2:
            raise Refusal("a path needs two nodes or more; click on, or press Escape to give it up")
        self.complete = True

    def _closable(self) -> bool:
        count = len(self._nodes) + (len(self.onto) if self.onto is not None else 0)
        bent = any(node.into is not None or node.out is not None for node in self._nodes)
        return count > 2 or (count == 2 and bent)

    def back(self) -> None:
        if len(self._nodes) > (self.onto is not None):
            self._nodes.pop()

    # What comes of it.

    def contour(self) -> Contour:
        """What has been drawn; closed where it closes by itself."""
        closed = self.closed and self.onto is None
        pairs = list(zip(self._nodes, [*self._nodes[1:], *(self._nodes[:1] if closed else [])], strict=False))
        return Contour.of_segments(
            [_segment(*pair) for pair in pairs], closed, [int(node.kind) for node in self._nodes]
        )

    def whole(self) -> Contour:
        """What has been gone on with, and what has been drawn."""
        if self.onto is None:
            return self.contour()
        joined = editing.join(self.onto, self.contour(), merge=True)
        return editing.close(joined, merge=True) if self.closed else joined

    def node(self) -> TreeNode:
        return path_node(Path((self.whole(),)))

    def sketch(self) -> Sketch:
        nodes = self._nodes
        settled = Path((self.contour(),)) if len(nodes) > 1 else None
        coming = None
        if nodes and self._pressed is None and self.pointer is not None and not self.complete:
            first = nodes[0]
            closes = self.onto is None and self._closable() and same(self.pointer, first.place)
            ahead = first if closes else _Node(self.pointer)
            if not same(self.pointer, nodes[-1].place):
                coming = Path((Contour.of_segments([_segment(nodes[-1], ahead)]),))
        arms = [
            (node.place, handle)
            for node in {id(node): node for node in [*nodes[-2:], *([self._pressed] if self._pressed else [])]}.values()
            for handle in (node.into, node.out)
            if handle is not None
        ]
        places = np.array([node.place for node in nodes]).reshape(-1, 2)
        return Sketch(settled, coming, places, np.array(arms).reshape(-1, 2, 2))


def _segment(begin: _Node, end: _Node) -> Segment:
    """A line, or a cubic where a handle has been pulled."""
    if begin.out is None and end.into is None:
        return np.array([begin.place, end.place])
    out = begin.place if begin.out is None else begin.out
    into = end.place if end.into is None else end.into
    return np.array([begin.place, out, into, end.place])
