"""The bodies of a document's solids and how pairs of them stand to each other, kept while they stay as they are."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..document.document import Document
from ..document.nodes import Node
from ..document.resolve import Resolver
from ..solid.entry import Problem
from ..solid.evaluate import ENDLESS, Evaluator
from ..solid.results import SolidResult, arrays_of, messages_of, open_surface, remarks_on_lettering, result_of
from ..worker.shown import Message
from . import bodies
from .bodies import AROUND, INSIDE, MEETING, Body, Relation, overlap_of
from .findings import EMPTY, FAILED, OPEN, UNBOUNDED, Triangles

MOST_TRIANGLES = 4 << 20
"""Of bodies that are kept, beside those of the last document."""
MOST_PAIRS = 1 << 17
MOST_OVERLAPS = 256

Key = bytes
_TURNED = {INSIDE: AROUND, AROUND: INSIDE}


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """A visible root with its body; equal keys are equal bodies in the same place."""

    root: Node
    key: Key
    body: Body
    problems: tuple[Problem, ...]

    @property
    def messages(self) -> tuple[Message, ...]:
        return messages_of(self.root, self.problems) + remarks_on_lettering(self.root)

    @property
    def kind(self) -> str:
        """Why less is known of it than of others; "" where that is not so."""
        if self.body.closed:
            return EMPTY if self.body.empty else ""
        if not self.body.empty:
            return OPEN
        return UNBOUNDED if any(p.error and p.message == ENDLESS for p in self.problems) else FAILED


def body_of(result: SolidResult) -> Body:
    """An evaluated root; a surface that is open is one that bounds no solid, and one that failed is empty."""
    surface = None if result.solid is not None else open_surface(result.root)
    vertices, triangles = surface if surface is not None else arrays_of(result.mesh())
    return Body(result.root.name, vertices, triangles, result.solid)


class PairMemo:
    """What was found out of bodies and pairs, so that of a document that changed only what changed is looked at."""

    def __init__(self, evaluator: Evaluator | None = None, resolver: Resolver | None = None) -> None:
        self._evaluator, self._resolver = evaluator or Evaluator(), resolver or Resolver()
        self._bodies: OrderedDict[Key, tuple[Body, tuple[Problem, ...]]] = OrderedDict()
        self._relations: OrderedDict[tuple[Key, Key], tuple[float, Relation | None]] = OrderedDict()
        self._overlaps: OrderedDict[tuple[Key, Key], Triangles] = OrderedDict()
        self.looked_at = 0
        """Pairs whose relation was not known."""

    def standing(
        self, document: Document, tolerance: float, progress: Callable[[str], None] | None = None
    ) -> list[Standing]:
        """The visible solids of a document, evaluated within a tolerance in mm where they are not known."""
        found = []
        for root in self._resolver.resolve(document).solids:
            if not root.visible:
                continue
            key = root.digest + f"{tolerance!r}".encode()
            if key not in self._bodies:
                entry = self._evaluator.evaluate(root, tolerance, progress)
                self._bodies[key] = body_of(result_of(root, entry)), entry.problems
            self._bodies.move_to_end(key)
            found.append(Standing(root, key, *self._bodies[key]))
        self._let_go(len({one.key for one in found}))
        return found

    def relation(self, one: Standing, other: Standing, limit: float) -> Relation | None:
        """As `bodies.relation`."""
        turned = other.key < one.key
        first, second = (other, one) if turned else (one, other)
        pair = first.key, second.key
        known = self._relations.get(pair)
        if known is None or (known[1] is None and known[0] < limit):
            self.looked_at += 1
            known = limit, bodies.relation(first.body, second.body, limit)
            self._relations[pair] = known
            while len(self._relations) > MOST_PAIRS:
                self._relations.popitem(last=False)
        self._relations.move_to_end(pair)
        found = known[1]
        if found is None or (found.gap > 0.0 and not found.gap < limit - MEETING * _size(first.body, second.body)):
            return None
        if not turned:
            return found
        points = None if found.points is None else found.points[::-1]
        return Relation(_TURNED.get(found.kind, found.kind), found.gap, points, found.overlap)

    def overlap(self, one: Standing, other: Standing) -> Triangles:
        """The surface of what two closed bodies share."""
        pair = min(one.key, other.key), max(one.key, other.key)
        if pair not in self._overlaps:
            vertices, triangles = arrays_of(overlap_of(one.body, other.body).to_mesh64())
            self._overlaps[pair] = Triangles(vertices, triangles.astype(np.int32))
            while len(self._overlaps) > MOST_OVERLAPS:
                self._overlaps.popitem(last=False)
        self._overlaps.move_to_end(pair)
        return self._overlaps[pair]

    def _let_go(self, needed: int) -> None:
        """Of the oldest bodies, which the last document has no use for."""
        held = sum(len(body.triangles) for body, _ in self._bodies.values())
        while held > MOST_TRIANGLES and len(self._bodies) > needed:
            _, (body, _) = self._bodies.popitem(last=False)
            held -= len(body.triangles)


def _size(one: Body, other: Body) -> float:
    """As `bodies.relation` has it, for what rounding may do."""
    return 2.0 * float(np.abs((one.bounds, other.bounds)).max())
