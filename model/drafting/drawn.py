"""From documents to pages: evaluate, project, lay out. What two plans have in common is drawn once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..document.document import Document
from ..document.tree import chosen_solids
from ..drawing.drawing import Drawing, Progress, draw
from ..drawing.projection import Projection, looking, standard
from ..drawing.scene import Scene, scene_of
from ..solid.results import evaluate_document
from ..solid.tessellation import DEFAULT_TOLERANCE
from .page import Page
from .plan import Eye, NothingToDraw, Plan
from .sheet import lay, views_of
from .views import View

if TYPE_CHECKING:
    from ..worker.shown import Message

EYE = "view"
"""What an eye's view is called."""
MOST = 8
"""Drawings of one document that are kept."""


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """A page, and what there is to tell about the nodes on it."""

    page: Page
    messages: tuple[Message, ...]


class Draughts:
    """The drawings of one document at one tolerance: another scale or page needs none of them anew."""

    def __init__(self, document: Document, tolerance: float = DEFAULT_TOLERANCE, solid: str | None = None) -> None:
        """All visible solids, or the one of this name. Raises Refusal where there is none."""
        solids = [root.with_(visible=True) for root in chosen_solids(document, solid)]
        if not solids:
            why = "no solid is visible" if document.solids else "the document holds no solid"
            raise NothingToDraw(f"there is nothing to draw: {why}")
        self._document, self._tolerance = replace(document, solids=tuple(solids)), tolerance
        self._scene: Scene | None = None
        self._messages: tuple[Message, ...] = ()
        self._drawings: dict[tuple[object, ...], Drawing] = {}

    def page(
        self, plan: Plan, evaluating: Callable[[str], None] | None = None, progress: Progress | None = None
    ) -> Drawn:
        """The page of a plan. `evaluating` is told each node's name, `progress` what is drawn and which share is done;
        either may raise to stop. Raises Refusal."""
        scene = self._evaluated(evaluating)
        names = views_of(plan) or (EYE,)
        views = []
        for number, name in enumerate(names):
            part = None if progress is None else _part(progress, number, len(names))
            views.append(View(name.capitalize(), self._drawing(scene, plan, name, part)))
        return Drawn(lay(views, plan), self._messages)

    def _evaluated(self, evaluating: Callable[[str], None] | None) -> Scene:
        if self._scene is None:
            evaluation = evaluate_document(self._document, self._tolerance, progress=evaluating)
            self._messages = evaluation.messages
            self._scene = scene_of(evaluation, evaluating)
        if not self._scene.meshes:
            raise NothingToDraw("there is nothing to draw: every solid is empty or has failed")
        return self._scene

    def _drawing(self, scene: Scene, plan: Plan, name: str, progress: Progress | None) -> Drawing:
        hidden = plan.hidden == "dashed" and not (plan.sheet is not None and name == "iso")
        key = (name, plan.view if name == EYE else None, plan.perspective, hidden, plan.faces)
        found = self._drawings.pop(key, None)
        if found is None:
            projection = _projection(plan, name, scene.extent)
            found = draw(scene, projection, hidden, plan.faces == "fill", progress)
        self._drawings[key] = found  # the newest last
        while len(self._drawings) > MOST:
            del self._drawings[next(iter(self._drawings))]
        return found


def _projection(plan: Plan, name: str, bounds: NDArray[np.float64]) -> Projection:
    if name != EYE or not isinstance(plan.view, Eye):
        return standard(name, bounds, plan.perspective)
    view = plan.view
    target = bounds.mean(axis=0) if view.target is None else view.target
    return looking(view.position, target, view.up or (0.0, 0.0, 1.0), plan.perspective, view.aspect)


def _part(progress: Progress, number: int, count: int) -> Progress:
    return lambda label, share: progress(label, (number + share) / count)
