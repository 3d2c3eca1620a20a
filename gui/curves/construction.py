"""The construction of a point of the outline that is being edited: its segment, t, strings and steps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal

from ..tools.tool import Tool

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.outline.construction import Construction
    from ...model.path.path import Path, Segment
    from ...render.curves.construction_marks import ConstructionMarks, ConstructionPicture
    from ...render.viewer import Viewer
    from ..view.viewport import Viewport
    from .active import ActiveCurve

MOST_STRINGS, MOST_STEPS = 60, 100


class ConstructionView(Tool):
    """`changed` tells that anything here is another, `switched` that it is on or off now.

    The segment, (contour, number) in `at`, is the one after the first chosen node, else the first, until `go` takes
    another; it stays until other nodes are chosen. `deviation` in mm is how far the curve is from its chords.
    """

    changed = Signal()
    switched = Signal()

    def __init__(self, active: ActiveCurve, viewport: Viewport) -> None:
        super().__init__(viewport)
        self._active, self._viewport = active, viewport
        self.on = False
        self.t = 0.5
        self.strings, self.steps, self.split = 0, 0, False
        self.at: tuple[int, int] = (0, 0)
        self.segment: Segment | None = None
        self.made: Construction | None = None
        self.deviation = 0.0
        self._lines: NDArray | None = None
        self._chords: NDArray | None = None
        self._followed: tuple[object, ...] = ()
        self._marks: ConstructionMarks | None = None
        self._viewer: Viewer | None = None
        active.changed.connect(self.refresh)

    def attached(self, viewer: Viewer) -> None:
        from ...render.curves.construction_marks import ConstructionMarks

        self._viewer, self._marks = viewer, ConstructionMarks()
        viewer.overlay.add(self._marks)
        self.refresh()

    def closing(self) -> None:
        self._viewer = self._marks = None

    # What is asked for.

    def set_on(self, on: bool) -> None:
        if on != self.on:
            self.on = on
            self.refresh()
            self.switched.emit()

    def set_t(self, t: float) -> None:
        """From 0 to 1 along the segment."""
        t = min(max(t, 0.0), 1.0)
        if t != self.t:
            self.t = t
            self._construct()

    def set_counts(self, strings: int, steps: int) -> None:
        """How many strings are drawn, and of how many chords the stepped curve is; none for 0."""
        self.strings, self.steps = min(max(strings, 0), MOST_STRINGS), min(max(steps, 0), MOST_STEPS)
        self.refresh()

    def set_split(self, split: bool) -> None:
        self.split = split
        self._construct()

    def go(self, by: int) -> None:
        """To another segment, from contour to contour and round."""
        rows = self._segments()
        if rows:
            self.at = rows[(rows.index(self.at) + by) % len(rows)]
            self.refresh()

    def _segments(self) -> list[tuple[int, int]]:
        path = self._active.path
        if path is None:
            return []
        return [(number, i) for number, contour in enumerate(path.contours) for i in range(len(contour))]

    # What follows.

    def refresh(self) -> None:
        """Follow the outline, what is chosen of it, and the switches."""
        path = self._active.path
        self.segment = self._lines = self._chords = None
        self.deviation = 0.0
        if path is not None and path.contours:
            self._follow(path)
            if self.on:
                from ...model.outline.construction import steps, strings

                contour, number = self.at
                self.segment = path.contours[contour].segment(number)
                self._lines = strings(self.segment, self.strings)
                if self.steps:
                    self._chords, self.deviation = steps(self.segment, self.steps)
        self._construct()

    def _follow(self, path: Path) -> None:
        active = self._active
        chosen = frozenset() if active.by_points else active.chosen
        followed = active.node.id if active.node is not None else "", chosen
        if followed != self._followed:
            self._followed = followed
            self.at = min(chosen, default=(0, 0))
        contour = min(self.at[0], len(path.contours) - 1)
        self.at = contour, min(self.at[1], len(path.contours[contour]) - 1)

    def _construct(self) -> None:
        self.made = None
        if self.segment is not None:
            from ...model.outline.construction import construct

            self.made = construct(self.segment, self.t)
        if self._marks is not None and self._viewer is not None:
            self._marks.show(None if self.made is None else self._picture(self.made))
            self._viewer.needs_render = True
            self._viewport.refresh()
        self.changed.emit()

    def _picture(self, made: Construction) -> ConstructionPicture:
        from ...render.curves.construction_marks import ConstructionPicture

        lines, chords = self._lines, self._chords
        assert lines is not None
        frame = self._active.frame
        return ConstructionPicture(
            [self._world(level) for level in made.levels],
            made.first,
            frame[:, : len(made.tangent)] @ made.tangent,
            self._world(lines.reshape(-1, lines.shape[-1])).reshape(-1, 2, 3),
            self._world(made.point[None])[:0] if chords is None else self._world(chords),
            [self._world(half) for half in made.halves] if self.split else (),
        )

    def _world(self, points: NDArray) -> NDArray:
        frame = self._active.frame
        return points @ frame[:, : points.shape[1]].T + frame[:, 3]
