"""One outline on its way into the document: the draft, its plane, what the pointer means there, what it shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ....model.document.errors import Refusal
from ....model.document.outlines import Path
from ....model.document.tree import find
from .draft import Draft, Held, Options
from .draft_picture import DraftView
from .freehand_tool import Freehand
from .pen_tool import Pen
from .shape_tools import Arc, Ellipse, Polygon, Rectangle, Star
from .snapping import Snap, Snapper
from .spline_tools import ControlPoints, ThroughPoints
from .typed_numbers import TypedNumbers
from .work_plane import WorkPlane

if TYPE_CHECKING:
    from ....model.editing.session import Session
    from ...view.viewport import Viewport
    from .draft import Floats
    from .going_on import GoingOn

DRAFTS: dict[str, type[Draft]] = {
    "pen": Pen,
    "freehand": Freehand,
    "rectangle": Rectangle,
    "ellipse": Ellipse,
    "polygon": Polygon,
    "star": Star,
    "arc": Arc,
    "control_points": ControlPoints,
    "through_points": ThroughPoints,
}
Pixel = tuple[float, float]


class Drawing:
    """Begins with nothing drawn; `settle` makes a complete draft one step of the session."""

    def __init__(
        self, kind: str, options: Options, session: Session, viewport: Viewport, plane: WorkPlane, snapper: Snapper
    ) -> None:
        self._kind, self._options, self._plane = kind, options, plane
        self._session, self._viewport, self._snapper = session, viewport, snapper
        self._snap: Snap | None = None
        self._pixel: Pixel | None = None
        self.anew()

    def anew(self) -> None:
        """Nothing is drawn any more."""
        self._take(DRAFTS[self._kind](self._options), None)

    def _take(self, draft: Draft, going_on: GoingOn | None) -> None:
        self.draft, self.typed, self._going_on = draft, TypedNumbers(draft), going_on
        self._snap = None

    @property
    def frame(self) -> Floats:
        """(3, 4) from the plane that is drawn on to the world."""
        return self._plane.frame if self._going_on is None else self._going_on.frame

    def stands(self) -> bool:
        """Whether what is gone on with is still what it was."""
        return self._going_on is None or self._going_on.stands(self._session.document)

    # The pointer, in logical pixels.

    def begin_at(self, pixel: Pixel) -> None:
        """Where the pen begins on an open end of the selected path, that is gone on with."""
        viewer, selection = self._viewport.viewer, self._session.selection
        if self._kind != "pen" or self.draft.begun or viewer is None or len(selection) != 1:
            return
        if isinstance(find(self._session.document, selection[0]), Path):
            from .going_on import going_on

            found = going_on(self._session, viewer, pixel)
            if found is not None:
                self._take(Pen(self._options, found.contour, found.ends), found)

    def look(self, pixel: Pixel, directions: bool, free: bool) -> Floats | None:
        """(2,) what a pixel means on the plane, None where that is not seen there; kept for the picture."""
        draft = self.draft
        self._pixel = pixel
        self._snap = self._snapper.snap(
            pixel, self.frame, origin=draft.origin, own=draft.places, angles=directions and draft.turns, free=free,
            exact=not draft.snaps,
        )  # fmt: skip
        return None if self._snap is None else self._snap.point

    def leave(self) -> None:
        self._snap = self._pixel = None

    # Numbers.

    def follow_typed(self) -> None:
        """Let the draft show what has been typed; what cannot be read yet is no fault yet."""
        if self.typed.typing:
            try:
                self.draft.hover(self.typed.target(self._session.document), self.draft.held)
            except Refusal:
                return

    def enter(self) -> None:
        """A click at the point that the numbers mean. Raises Refusal; then they stay to be corrected."""
        point, held = self.typed.target(self._session.document), Held(alt=self.draft.held.alt)
        self.draft.press(point, held)
        self.draft.release(point, held, False)

    def settle(self, change: Callable[[], object]) -> bool:
        """Do a press, a release or a key; whether the outline is in the document then. Raises Refusal."""
        change()
        if not self.draft.complete:
            return False
        draft, going_on = self.draft, self._going_on
        try:
            if going_on is None:
                node = draft.node().with_(placement=self._plane.placement)
                self._session.do("insert", node, label=f"Draw {draft.kind}")
            else:
                self._going_on = None  # what it goes on with is another one now
                going_on.commit(self._session, draft)
        except Refusal:
            self.anew()
            raise
        return True

    def show(self, view: DraftView) -> str:
        """Show it, and give the words for the status."""
        snap = None if self.typed.typing else self._snap  # what is typed counts, wherever the pointer is
        view.show(self.draft.sketch(), self.frame, snap, self.typed.words(), self._pixel)
        words, hint = "" if snap is None else snap.words, self.draft.hint
        return f"{words[:1].upper()}{words[1:]}. {hint}" if words else hint
