"""Views put on a page: one alone, or front, top and side aligned as first- or third-angle projection has them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from .dimensions import ROOM, box_dimensions
from .page import VISIBLE, Item, Page, box_of
from .paper import SIZES, Paper, papers, scale_words, standard_scales
from .plan import Angle, Eye, NothingToDraw, Plan
from .title import Title, frame_group, room
from .views import View

Floats = NDArray[np.float64]

BETWEEN = 14.0  # mm between two views without dimensions
DIMENSIONED = ROOM + 6.0  # mm between two views with some
RIGHT, BELOW, ABOVE = (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)
TOLERANCE = 1e-6  # mm that a drawing may be larger than its room


@dataclass(frozen=True, slots=True, eq=False)
class Arranged:
    """Views at a scale, in mm of paper: each with its origin and what is drawn beside it; and the box around all."""

    views: tuple[tuple[View, tuple[float, float], list[Item]], ...]
    box: Floats


class Arrangement(Protocol):
    """How views stand to each other at a scale."""

    def __call__(self, scale: float) -> Arranged: ...


def views_of(plan: Plan) -> tuple[str, ...]:
    """The names of the views that a plan needs, as standard views have them; () for an eye's."""
    if plan.sheet is not None:
        side = "left" if plan.sheet == "first" else "right"
        return ("front", "top", side, "iso") if plan.iso else ("front", "top", side)
    return () if isinstance(plan.view, Eye) else (plan.view,)


def lay(views: Sequence[View], plan: Plan) -> Page:
    """The page with these views: in the order of `views_of`, or the one of an eye. Raises Refusal where they do not fit
    or nothing is to be seen."""
    if all(view.drawing.empty for view in views):
        raise NothingToDraw("there is nothing to draw: nothing is in view")
    arrangement = _arrangement(views, plan)
    paper, scale = fitted(arrangement, plan)
    arranged = arrangement(scale)
    left, low, width, height = room(paper)
    shift = np.array([left + width / 2.0, low + height / 2.0]) - arranged.box.mean(axis=0)
    groups = [
        view.group(scale, (float(at[0] + shift[0]), float(at[1] + shift[1])), extra)
        for view, at, extra in arranged.views
    ]
    title = Title(plan.title, _view_words(plan), _scale_title(plan, scale), plan.sheet)
    return Page(paper.width, paper.height, (frame_group(paper, title), *groups), plan.title, scale)


def scale_of(views: Sequence[View], plan: Plan) -> float | None:
    """The scale of the page with these views, of which only the bounds count; None where nothing is to be seen. Raises
    Refusal where they do not fit."""
    if not any(max(view.size) for view in views):
        return None
    return fitted(_arrangement(views, plan), plan)[1]


def _arrangement(views: Sequence[View], plan: Plan) -> Arrangement:
    return _sheet(views, plan) if plan.sheet is not None else _single(views[0], plan)


def fitted(arrangement: Arrangement, plan: Plan) -> tuple[Paper, float]:
    """The page and the scale: those of the plan, else the page that takes the larger one, and the largest standard
    scale that fits. Raises Refusal, which says what would fit."""
    choices = papers(plan.page)
    if plan.scale is None:
        best = [(scale, paper) for paper in choices if (scale := largest_scale(arrangement, paper)) is not None]
        if not best:
            raise Refusal(f"the page {choices[0].words} has no room for a drawing; take a larger one")
        scale = max(scale for scale, _ in best)
        return next(paper for found, paper in best if found == scale), scale
    for paper in choices:
        if _fits(arrangement, paper, plan.scale):
            return paper, plan.scale
    raise Refusal(_too_large(arrangement, choices, plan.scale))


def largest_scale(arrangement: Arrangement, paper: Paper) -> float | None:
    """The largest standard scale at which views fit on a page, None where none does."""
    return next((scale for scale in standard_scales() if _fits(arrangement, paper, scale)), None)


def _fits(arrangement: Arrangement, paper: Paper, scale: float) -> bool:
    _, _, width, height = room(paper)
    wanted = np.ptp(arrangement(scale).box, axis=0)
    return bool(wanted[0] <= width + TOLERANCE and wanted[1] <= height + TOLERANCE)


def _too_large(arrangement: Arrangement, choices: Sequence[Paper], scale: float) -> str:
    wanted = np.ptp(arrangement(scale).box, axis=0)
    offers = [(found, one) for one in choices if (found := largest_scale(arrangement, one)) is not None]
    best = max((found for found, _ in offers), default=None)
    paper = next((one for found, one in offers if found == best), choices[0])  # the one that the offer is for
    _, _, width, height = room(paper)
    words = (
        f"at {scale_words(scale)} the drawing takes {_mm(wanted[0])} × {_mm(wanted[1])} mm, and {paper.words} has room "
        f"for {width:.0f} × {height:.0f} mm"
    )
    larger = next((name for name in SIZES if name.startswith("A") and any(
        _fits(arrangement, one, scale) for one in papers(name))), None)  # fmt: skip
    advice = []
    if best is not None:
        advice.append(f"take {scale_words(best)}")
    if larger is not None:
        advice.append(f"the page {larger}" if advice else f"take the page {larger}")
    return words + ("; " + " or ".join(advice) if advice else "")


def _mm(value: float) -> str:
    return f"{np.ceil(value - TOLERANCE):.0f}"


def _single(view: View, plan: Plan) -> Arrangement:
    def arrange(scale: float) -> Arranged:
        drawing = view.drawing
        extra = box_dimensions(drawing.projection, drawing.extent, scale) if plan.measured else []
        box = _with_lines(drawing.bounds * scale)
        around = box_of(extra)
        if around is not None:
            box = np.array([np.minimum(box[0], around[0]), np.maximum(box[1], around[1])])
        return Arranged(((view, (0.0, 0.0), extra),), box)

    return arrange


def _sheet(views: Sequence[View], plan: Plan) -> Arrangement:
    """Front, top and side share the middle of the model as their origin, so that views in line have one coordinate."""
    front, top, side = views[:3]
    first = plan.sheet == "first"
    gap = DIMENSIONED if plan.measured else BETWEEN
    beside = {2: RIGHT, 0: BELOW if first else ABOVE}

    def extra(view: View, sides: Mapping[int, tuple[float, float]], scale: float) -> list[Item]:
        if not plan.measured:
            return []
        return box_dimensions(view.drawing.projection, view.drawing.extent, scale, sides)

    def arrange(scale: float) -> Arranged:
        boxes = [_with_lines(view.drawing.bounds * scale) for view in views]
        sizes = [np.ptp(box, axis=0) for box in boxes]
        iso = sizes[3] if len(views) > 3 else np.zeros(2)
        right = boxes[0][1, 0] + gap  # the left edge of the second column, the front view's origin at zero
        wide, high = max(sizes[2][0], iso[0]), max(sizes[1][1], iso[1])
        if first:
            low, high_edge = boxes[0][0, 1] - gap - high, boxes[0][0, 1] - gap
            top_at = (0.0, high_edge - boxes[1][1, 1])
        else:
            low, high_edge = boxes[0][1, 1] + gap, boxes[0][1, 1] + gap + high
            top_at = (0.0, low - boxes[1][0, 1])
        placed = [
            (front, (0.0, 0.0), extra(front, beside, scale)),
            (top, top_at, extra(top, {1: RIGHT}, scale)),
            (side, (right - boxes[2][0, 0], 0.0), []),
        ]
        if len(views) > 3:
            middle = np.array([right + wide / 2.0, (low + high_edge) / 2.0]) - boxes[3].mean(axis=0)
            placed.append((views[3], (float(middle[0]), float(middle[1])), []))
        bottom = min(low, boxes[0][0, 1], boxes[2][0, 1])
        roof = max(high_edge, boxes[0][1, 1], boxes[2][1, 1])
        left = min(boxes[0][0, 0], boxes[1][0, 0])
        return Arranged(tuple(placed), np.array([[left, bottom], [right + wide, roof]]))

    return arrange


def _with_lines(box: Floats) -> Floats:
    half = VISIBLE.weight / 2.0
    return np.array([box[0] - half, box[1] + half])


ANGLES: dict[Angle, str] = {"first": "First angle", "third": "Third angle"}


def _view_words(plan: Plan) -> str:
    if plan.sheet is not None:
        return ANGLES[plan.sheet]
    name = "View" if isinstance(plan.view, Eye) else "Isometric" if plan.view == "iso" else plan.view.capitalize()
    return name if plan.perspective is None else f"{name}, {plan.perspective:g}° perspective"


def _scale_title(plan: Plan, scale: float) -> str:
    return scale_words(scale) if plan.perspective is None else f"{scale_words(scale)} at the target"
