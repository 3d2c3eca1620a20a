"""How hidden surfaces are removed in the picture: by the z-buffer, or by a BSP tree, which this asks for and hands on.

What is shown with a tree needs one of exactly the shown meshes. It is built here where that takes less than a picture,
else by the worker, and until it comes the picture is drawn with the z-buffer. A part that moves is put into the tree of
those that stay; that one is asked for ahead, when something is selected, and at the latest when the drag begins.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, QTimer, Signal

from ..model.document.tree import homes
from ..model.editing.session import Session, State
from .settings import Settings
from .view.kept_trees import AT_ONCE, Found, KeptTrees, Shown, meshes
from .view.viewport import Viewport

if TYPE_CHECKING:
    from ..model.partition.tree import Tree
    from .evaluation import Evaluation

ZBUFFER, BSP = "zbuffer", "bsp"
ONCE = 3 * AT_ONCE  # seconds that a drag may wait, once, for the tree of what stays
IDLE = 300  # milliseconds of rest before the tree of what stays is asked for
LOSSES = 2  # times that a drag may lose its tree; then it goes on with the z-buffer


class HiddenSurfaces(QObject):
    """`changed` tells of another mode, another tree, or another reason why there is none.

    `tree` is that of the picture, None while it is drawn with the z-buffer: its faces are the triangles of the shown
    meshes of `solid_ids`, in that order.
    """

    changed = Signal()
    mode_changed = Signal()

    def __init__(
        self, session: Session, viewport: Viewport, evaluation: Evaluation, settings: Settings, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._session, self._viewport, self._evaluation = session, viewport, evaluation
        self._settings = settings
        self.mode = BSP if settings.flag("bsp", False) else ZBUFFER
        self.tree: Tree | None = None
        self.solid_ids: tuple[str, ...] = ()
        self.builds = 0
        self._trees = KeptTrees()
        self._shown: Shown = ()
        self._before: Shown = ()
        self._wanted: Shown = ()
        """What the worker has been asked to sort."""
        self._given_up: Shown = ()
        self._sorted: Shown = ()
        """What the tree is of."""
        self._built = False
        """Whether it was built as a whole, as it is when nothing moves."""
        self._losses = 0
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._ask)
        self._idle = QTimer(self)
        self._idle.setSingleShot(True)
        self._idle.setInterval(IDLE)
        self._idle.timeout.connect(self._ask_ahead)
        viewport.displayed.connect(self._follow)
        evaluation.jobs.partitioned.connect(self._partitioned)
        evaluation.outdated.connect(self._bring)
        viewport.change(lambda viewer: viewer.set_hidden_surface(self.mode))

    @property
    def sorting(self) -> bool:
        """Whether the picture waits for its tree."""
        return self.mode == BSP and (self._soon.isActive() or (bool(self._wanted) and self._wanted == self._shown))

    @property
    def build_seconds(self) -> float | None:
        """How long `tree` took to build; None where it was put together from another one."""
        return self._trees.seconds(self.tree)

    @property
    def at_rest(self) -> bool:
        """Whether nothing more is asked for by itself, not even ahead."""
        return not (self._soon.isActive() or self._idle.isActive() or self._wanted)

    @property
    def words(self) -> tuple[str, str]:
        """What the picture is drawn with, where that has to be said, and why."""
        if self.mode == ZBUFFER:
            return "", ""
        if self.tree is not None:
            return "BSP", "Faces are drawn from back to front, in the order of a BSP tree"
        if not self._shown:
            return "BSP", "There is nothing to sort"
        if self._session.previewing:
            return "z-buffer", "While this moves; when it rests, the faces are sorted by a BSP tree"
        if self._shown == self._given_up:
            return "z-buffer", "The faces are not sorted; choosing BSP again tries again"
        return "z-buffer", "Until the faces are sorted by a BSP tree"

    def set_mode(self, mode: str) -> None:
        """ZBUFFER or BSP. BSP where it is in use already tries again what had been given up."""
        if mode != self.mode or self._given_up:
            self.mode = mode
            self._given_up = ()
            self._settings.set_flag("bsp", mode == BSP)
            self._viewport.change(lambda viewer: viewer.set_hidden_surface(mode))
            if mode == ZBUFFER:
                self._stop()
                self._use(None)
            else:
                self._bring()
            self.mode_changed.emit()
            self.changed.emit()

    def toggle(self) -> None:
        self.set_mode(ZBUFFER if self.mode == BSP else BSP)

    def find(self) -> Found | None:
        """A tree of what is shown for others than the picture, whatever its mode.

        Where there is none and it would take long to build, the worker is asked, and `changed` tells when to ask again;
        not when the worker has given it up.
        """
        if not self._shown:
            return None
        try:
            if self._shown not in self._trees and self._trees.fits(self._shown, ONCE):
                self.builds += 1
                return self._trees.build(self._shown)
            if self._shown in self._trees:
                return self._trees.find(self._shown)
        except (ValueError, OverflowError, MemoryError):
            self._given_up = self._shown
        if not self.unsortable:
            self._send(self._shown)
        return None

    @property
    def unsortable(self) -> bool:
        """Whether the worker has given up what is shown."""
        return bool(self._shown) and self._shown == self._given_up

    def session_changed(self, before: State, after: State) -> None:
        if not self._session.previewing:
            if self._losses or before.document is not after.document:
                self._losses = 0
                self._trees.start_again()
            self._idle.start()

    def document_opened(self) -> None:
        """What was shown before does not come back."""
        self._trees.clear()
        self._before = self._given_up = ()

    def close(self) -> None:
        self._soon.stop()
        self._idle.stop()

    def _follow(self, shown: Mapping[str, Any]) -> None:
        """Something is shown, perhaps what was shown before."""
        now = tuple(shown.items())
        if now != self._shown:
            self._before, self._shown = self._shown, now
            self._idle.start()
        self._bring()

    def _bring(self) -> None:
        """Give the picture its tree, or ask for it."""
        if self.mode != BSP:
            return
        if not self._shown:
            self._stop()
            self._use(None)
            return
        if self._sorted != self._shown:
            found = None
            try:
                found = self._found(self._session.previewing)
            except (ValueError, OverflowError, MemoryError):  # for the worker too, and it says so
                self._losses = LOSSES
            self._use(found)
        if not (self._session.previewing or self._built):
            self._soon.start(0)

    def _found(self, previewing: bool) -> Found | None:
        """A tree for what is shown, if there is one or one can be made at once."""
        if previewing and self._losses >= LOSSES:
            return None
        found = self._trees.find(self._shown)
        if (found is None or not found.built) and self._trees.fits(self._shown):
            self.builds += 1
            return self._trees.build(self._shown, keep=not previewing)
        if found is None and previewing:
            if self._sort_what_stays():
                return self._trees.find(self._shown)
            self._losses += self.tree is not None
        return found

    def _use(self, found: Found | None) -> None:
        tree, solid_ids = (None, ()) if found is None else (found.tree, found.solid_ids)
        self._sorted = () if found is None else self._shown
        self._built = found is not None and found.built
        if tree is not self.tree or solid_ids != self.solid_ids:
            self.tree, self.solid_ids = tree, solid_ids
            self._viewport.change(lambda viewer: viewer.show_tree(tree, solid_ids))
            self.changed.emit()

    def _sort_what_stays(self) -> bool:
        """In a drag, sort what does not move; whether that could be done at once."""
        before = set(self._before)
        still = tuple(entry for entry in self._shown if entry in before)
        if not self._may_move(still) or still in self._trees:
            return False
        if self._trees.fits(still, ONCE):
            self.builds += 1
            self._trees.build(still)
            return True
        self._send(still, ahead=True)
        return False

    def _may_move(self, still: Shown) -> bool:
        """Whether all others can be put into the tree of these fast enough."""
        held = set(still)
        return bool(still) and self._trees.fits_in(tuple(entry for entry in self._shown if entry not in held))

    def _ask(self) -> None:
        """Ask the worker for the tree of what is shown; while other meshes are on their way it is asked for then."""
        if self.mode == BSP and self._shown and not self._evaluation.waiting and not self._session.previewing:
            if self._shown not in self._trees and self._shown != self._given_up:
                self._send(self._shown)
            self.changed.emit()

    def _ask_ahead(self) -> None:
        """Ask the worker for the tree of what stays when the selected nodes are dragged, while it has nothing to do."""
        busy = self._evaluation.waiting or self._evaluation.jobs.at_work or self._session.previewing
        if self.mode != BSP or busy or self.unsortable or self._soon.isActive() or self._trees.fits(self._shown):
            return
        moving = homes(self._session.view, self._session.selection)
        still = tuple(entry for entry in self._shown if entry[0] not in moving)
        known = still in self._trees or still == self._given_up
        if len(still) < len(self._shown) and not known and self._may_move(still):
            self._send(still, ahead=True)

    def _send(self, shown: Shown, ahead: bool = False) -> None:
        if shown != self._wanted:
            self._wanted = shown
            self._evaluation.jobs.partition(meshes(shown), ahead)

    def _stop(self) -> None:
        self._soon.stop()
        self._wanted = ()
        self._evaluation.jobs.partition(())

    def _partitioned(self, tree: Tree | None, seconds: float) -> None:
        wanted, self._wanted = self._wanted, ()
        if tree is None:
            self._given_up = wanted
        else:
            self.builds += 1
            self._trees.keep(wanted, tree, seconds)
            if not self._built:
                self._sorted = ()
        self._bring()
        self._idle.start()
        self.changed.emit()
