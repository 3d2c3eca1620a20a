"""From documents to pages: evaluate, project, lay out. What two plans have in common is drawn once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..document.document import Document
from ..document.tree import chosen_solids
from ..drawing.drawing import Drawing, Progress, draw, measured
from ..drawing.projection import Projection, looking, standard
from ..drawing.scene import Scene, scene_of
from ..solid.results import evaluate_document
from ..solid.tessellation import DEFAULT_TOLERANCE
from .fineness import MOST_FILLED, MOST_TRIANGLES, fineness
from .page import Page
from .plan import Eye, NothingToDraw, Plan
from .sheet import lay, scale_of, views_of
from .views import View

if TYPE_CHECKING:
    from ..worker.shown import Message

EYE = "view"
"""What an eye's view is called."""
MOST = 8
"""Drawings of one document that are kept."""
MOST_SCENES = 3


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """A page, and what there is to tell about the nodes on it."""

    page: Page
    messages: tuple[Message, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Evaluated:
    scene: Scene
    messages: tuple[Message, ...]


class Draughts:
    """The drawings of one document: another page needs none of them anew, nor does another scale where the tolerance is
    given or changes nothing."""

    def __init__(self, document: Document, tolerance: float | None = None, solid: str | None = None) -> None:
        """All visible solids, or the one of this name; without a tolerance in mm it follows the scale, see `fineness`.
        Raises Refusal where there is no solid."""
        solids = [root.with_(visible=True) for root in chosen_solids(document, solid)]
        if not solids:
            why = "no solid is visible" if document.solids else "the document holds no solid"
            raise NothingToDraw(f"there is nothing to draw: {why}")
        self._document, self._tolerance = replace(document, solids=tuple(solids)), tolerance
        self._evaluated: dict[float, _Evaluated] = {}
        self._drawings: dict[tuple[object, ...], tuple[Scene, Drawing]] = {}

    def page(
        self, plan: Plan, evaluating: Callable[[str], None] | None = None, progress: Progress | None = None
    ) -> Drawn:
        """The page of a plan. `evaluating` is told each node's name, `progress` what is drawn and which share is done;
        either may raise to stop. Raises Refusal."""
        tolerance = self._tolerance or self._fineness(plan, evaluating)
        evaluated = self._at(tolerance, evaluating)
        names = views_of(plan) or (EYE,)
        views = []
        for number, name in enumerate(names):
            part = None if progress is None else _part(progress, number, len(names))
            views.append(View(name.capitalize(), self._drawing(evaluated.scene, plan, name, part)))
        return Drawn(lay(views, plan), evaluated.messages)

    def _fineness(self, plan: Plan, evaluating: Callable[[str], None] | None) -> float:
        """The tolerance that the scale asks for. Whether a plan fits on its page shows at the default one."""
        scene = self._at(DEFAULT_TOLERANCE, evaluating).scene
        names = views_of(plan) or (EYE,)
        views = [View(name, measured(scene, _projection(plan, name, scene.extent))) for name in names]
        scale = scale_of(views, plan)
        if scale is None:
            return DEFAULT_TOLERANCE
        most = MOST_FILLED if plan.faces == "fill" else MOST_TRIANGLES
        return fineness(scale, most, lambda tolerance: self._at(tolerance, evaluating).scene.triangles)

    def _at(self, tolerance: float, evaluating: Callable[[str], None] | None) -> _Evaluated:
        """The document evaluated; the scene of the default tolerance where this one has no other facets."""
        found = self._evaluated.pop(tolerance, None)
        if found is None:
            evaluation = evaluate_document(self._document, tolerance, progress=evaluating)
            scene = scene_of(evaluation, evaluating)
            coarse = self._evaluated.get(DEFAULT_TOLERANCE)
            if coarse is not None and _same(coarse.scene, scene):
                scene = coarse.scene
            found = _Evaluated(scene, evaluation.messages)
        self._evaluated[tolerance] = found  # the newest last
        for old in list(self._evaluated)[:-MOST_SCENES]:
            if old != DEFAULT_TOLERANCE:
                del self._evaluated[old]
        if not found.scene.meshes:
            raise NothingToDraw("there is nothing to draw: every solid is empty or has failed")
        return found

    def _drawing(self, scene: Scene, plan: Plan, name: str, progress: Progress | None) -> Drawing:
        hidden = plan.hidden == "dashed" and not (plan.sheet is not None and name == "iso")
        key = (id(scene), name, plan.view if name == EYE else None, plan.perspective, hidden, plan.faces)
        found = self._drawings.pop(key, None)
        if found is None:
            projection = _projection(plan, name, scene.extent)
            found = scene, draw(scene, projection, hidden, plan.faces == "fill", progress)
        self._drawings[key] = found  # the newest last
        while len(self._drawings) > MOST:
            del self._drawings[next(iter(self._drawings))]
        return found[1]


def _same(one: Scene, other: Scene) -> bool:
    """Whether two scenes of one document have the same facets."""
    return len(one.meshes) == len(other.meshes) and all(
        np.array_equal(a.corners, b.corners) and np.array_equal(a.vertices, b.vertices)
        for a, b in zip(one.meshes, other.meshes, strict=True)
    )


def _projection(plan: Plan, name: str, bounds: NDArray[np.float64]) -> Projection:
    if name != EYE or not isinstance(plan.view, Eye):
        return standard(name, bounds, plan.perspective)
    view = plan.view
    target = bounds.mean(axis=0) if view.target is None else view.target
    return looking(view.position, target, view.up or (0.0, 0.0, 1.0), plan.perspective, view.aspect)


def _part(progress: Progress, number: int, count: int) -> Progress:
    return lambda label, share: progress(label, (number + share) / count)
