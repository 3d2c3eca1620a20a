"""The bodies of a document's solids and how pairs of them stand to each other, kept while they stay as they are."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..document.document import Document
from ..document.nodes import Node
from ..document.resolve import Resolver
from ..solid.entry import Problem
from ..solid.evaluate import ENDLESS, Evaluator
from ..solid.results import SolidResult, arrays_of, messages_of, open_surface, remarks_on_lettering, result_of
from ..worker.shown import Message
from .bodies import AROUND, INSIDE, MEETING, Body, Relation, overlap_of, relation, relations
from .findings import EMPTY, FAILED, OPEN, UNBOUNDED, Remark, Triangles

MOST_TRIANGLES = 4 << 20
"""Of bodies that are kept, beside those of the last document."""
MOST_PAIRS = 1 << 17
MOST_OVERLAPS = 1024
FIRST_STEP = 16
"""Pairs that are looked at before somebody may stop it; then so many that it takes about PAUSE seconds."""
PAUSE = 0.05

Key = bytes
_TURNED = {INSIDE: AROUND, AROUND: INSIDE}


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """A visible root with its body; equal keys are equal bodies in the same place."""

    root: Node
    key: Key
    body: Body
    problems: tuple[Problem, ...]
    reach: float
    """The largest of its coordinates, in mm."""

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

    def remark(self, meets: Sequence[str] = ()) -> Remark:
        """Of one with such a kind; `meets` names the solids that an open surface meets."""
        message = next((message.message for message in self.messages if message.error), "")
        names = tuple(meets) if self.kind == OPEN else ()
        return Remark(self.root.id, self.root.name, self.kind, message, names)


def body_of(result: SolidResult) -> Body:
    """An evaluated root; a surface that is open is one that bounds no solid, and one that failed is empty."""
    surface = None if result.solid is not None else open_surface(result.root)
    vertices, triangles = surface if surface is not None else arrays_of(result.mesh())
    return Body(result.root.name, vertices, triangles, result.solid)


class PairMemo:
    """What was found out of bodies and pairs, so that of a document that changed only what changed is looked at."""

    def __init__(self, evaluator: Evaluator | None = None, resolver: Resolver | None = None) -> None:
        self._evaluator, self._resolver = evaluator or Evaluator(), resolver or Resolver()
        self._bodies: OrderedDict[Key, tuple[Body, tuple[Problem, ...], float]] = OrderedDict()
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
                body = body_of(result_of(root, entry))
                self._bodies[key] = body, entry.problems, 0.0 if body.empty else float(np.abs(body.bounds).max())
            self._bodies.move_to_end(key)
            found.append(Standing(root, key, *self._bodies[key]))
        self._let_go(len({one.key for one in found}))
        return found

    def relations(
        self, asked: Sequence[tuple[Standing, Standing, float]], told: Callable[[int, int], None] | None = None
    ) -> list[Relation | None]:
        """How pairs of bodies, none of which is empty, stand to each other, each below a limit in mm: see
        `bodies.relation`. `told` hears how many pairs are done, and may raise to stop: what is known is kept."""
        found: list[Relation | None] = [None] * len(asked)
        new: dict[tuple[Key, Key], tuple[Standing, Standing, float]] = {}
        waiting: list[int] = []
        for place, (one, other, limit) in enumerate(asked):
            pair = _pair(one, other)
            known = self._relations.get(pair)
            if known is None or (known[1] is None and known[0] < limit):
                waiting.append(place)
                if pair not in new or new[pair][2] < limit:  # of equal bodies in one place the farther question counts
                    new[pair] = one, other, limit
            else:
                found[place] = self._answer(one, other, limit)
        rows = list(new.values())
        done, step = 0, FIRST_STEP
        while done < len(rows):
            if told is not None:
                told(len(asked) - len(rows) + done, len(asked))
            begin = time.perf_counter()
            some = rows[done : done + step]
            self._look_at(some)
            done += len(some)
            step = 2 * step if time.perf_counter() - begin < PAUSE else max(step // 2, 1)
        for place in waiting:
            found[place] = self._answer(*asked[place])
        while len(self._relations) > max(MOST_PAIRS, len(asked)):
            self._relations.popitem(last=False)
        return found

    def _look_at(self, asked: Sequence[tuple[Standing, Standing, float]]) -> None:
        self.looked_at += len(asked)
        bounded: list[tuple[Body, Body, float]] = []
        for one, other, limit in asked:
            first, second = (one, other) if one.key <= other.key else (other, one)
            if np.isfinite(limit):
                bounded.append((first.body, second.body, limit))
            else:
                self._relations[first.key, second.key] = limit, relation(first.body, second.body)
        both = [body for first, second, _ in bounded for body in (first, second)]
        places = [(2 * number, 2 * number + 1) for number in range(len(bounded))]
        answers = iter(relations(both, places, [limit for *_, limit in bounded]) if bounded else ())
        for one, other, limit in asked:
            if np.isfinite(limit):
                self._relations[_pair(one, other)] = limit, next(answers)

    def _answer(self, one: Standing, other: Standing, limit: float) -> Relation | None:
        pair = _pair(one, other)
        self._relations.move_to_end(pair)
        found = self._relations[pair][1]
        rounding = MEETING * 2.0 * max(one.reach, other.reach)  # as in `bodies.relation`
        if found is None or (found.gap > 0.0 and not found.gap < limit - rounding):
            return None
        if one.key <= other.key:
            return found
        points = None if found.points is None else found.points[::-1]
        return Relation(_TURNED.get(found.kind, found.kind), found.gap, points, found.overlap)

    def overlap(self, one: Standing, other: Standing) -> Triangles:
        """The surface of what two closed bodies share."""
        pair = _pair(one, other)
        if pair not in self._overlaps:
            vertices, triangles = arrays_of(overlap_of(one.body, other.body).to_mesh64())
            self._overlaps[pair] = Triangles(vertices, triangles.astype(np.int32))
            while len(self._overlaps) > MOST_OVERLAPS:
                self._overlaps.popitem(last=False)
        self._overlaps.move_to_end(pair)
        return self._overlaps[pair]

    def _let_go(self, needed: int) -> None:
        """Of the oldest bodies, which the last document has no use for."""
        held = sum(len(body.triangles) for body, *_ in self._bodies.values())
        while held > MOST_TRIANGLES and len(self._bodies) > needed:
            _, (body, *_) = self._bodies.popitem(last=False)
            held -= len(body.triangles)


def _pair(one: Standing, other: Standing) -> tuple[Key, Key]:
    return min(one.key, other.key), max(one.key, other.key)
