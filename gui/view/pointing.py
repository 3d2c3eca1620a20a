"""What a click in the picture selects, and what is said of the face under the pointer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, QPoint, QPointF, Qt, Signal

from ...model.editing.session import Session
from .occurrences import Path
from .pointed import Pointed

if TYPE_CHECKING:
    from ...render.pick import Pick
    from ...render.viewer import Viewer

SLACK = 4  # pixels between two clicks at the same spot
ALT, SHIFT, CONTROL = (
    Qt.KeyboardModifier.AltModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
)


class Pointing(QObject):
    """A click selects the node that made the face, the next one at the same spot its parent, and so on up to the solid.

    Alt goes to the solid at once, Alt+Shift to the next node behind, Ctrl adds and takes away. `said` carries words on
    what lies under the pointer; `menu_asked` the nodes under it, front to back, as (id, path, words), and where on the
    screen.
    """

    said = Signal(str)
    menu_asked = Signal(list, QPoint)

    def __init__(self, session: Session, viewer: Viewer, parent: QObject) -> None:
        super().__init__(parent)
        self._session = session
        self._viewer = viewer
        self.pointed = Pointed(session)
        self._pick: Pick | None = None
        self._spot: tuple[QPointF, tuple[Any, ...], str] | None = None
        self._stepped_from: tuple[str, ...] | None = None

    def hover(self, pick: Pick | None) -> None:
        self._pick = pick
        self._viewer.set_hover(self.pointed.path(pick))
        self.said.emit(self.pointed.words(pick))

    def tip(self) -> str:
        """Of what the pointer was last found over."""
        return self.pointed.tip(self._pick)

    def click(self, position: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        held = modifiers & (ALT | SHIFT | CONTROL)
        pick = self._viewer.pick(position.x(), position.y())
        chain, selection = self.pointed.chain(pick), self._session.selection
        self._stepped_from = None
        if held & CONTROL:
            if chain:
                toggled = (i for i in selection if i != chain[0]) if chain[0] in selection else (*selection, chain[0])
                self._session.select(toggled)
        elif held == ALT | SHIFT:
            self._session.select(self._behind(position))
        elif held == ALT:
            self._session.select(chain[-1:])
        else:
            self._climb(pick, position)
        self.hover(pick)

    def _climb(self, pick: Pick | None, position: QPointF) -> None:
        chain, selection = self.pointed.chain(pick), self._session.selection
        if pick is None or not chain:
            self._spot = None
            self._session.select(())
            return
        face = (pick.solid_id, pick.path, pick.facet)
        chosen = chain[0]
        if self._spot is not None:
            before, same, last = self._spot
            near = (position - before).manhattanLength() <= SLACK
            if near and same == face and selection == (last,) and last in chain:
                chosen = chain[(chain.index(last) + 1) % len(chain)]
                self._stepped_from = selection
        self._spot = (position, face, chosen)
        self._session.select((chosen,))

    def _behind(self, position: QPointF) -> tuple[str, ...]:
        owners = list(dict.fromkeys(owner for owner, _ in self.under(position)))
        if not owners:
            return ()
        selection = self._session.selection
        now = owners.index(selection[0]) if len(selection) == 1 and selection[0] in owners else 0
        return (owners[(now + 1) % len(owners)],)

    def under(self, position: QPointF) -> list[tuple[str, Pick]]:
        """The nodes whose faces lie under the pointer, front to back, each with its first face."""
        found: dict[str, Pick] = {}
        for pick in self._viewer.pick_all(position.x(), position.y()):
            owner = self.pointed.owner(pick)
            if owner is not None:
                found.setdefault(owner, pick)
        return list(found.items())

    def double_click(self, pick: Pick | None) -> tuple[str, ...]:
        """The nodes to fit, none for all. A step up that the first of the two clicks made is taken back."""
        chain = self.pointed.makers(pick)
        if self._stepped_from is not None:
            self._session.select(self._stepped_from)
            if self._spot is not None:
                self._spot = (*self._spot[:2], self._stepped_from[0])
            self._stepped_from = None
            self.hover(pick)
        chosen = tuple(node_id for node_id in self._session.selection if node_id in chain)
        return chosen or chain[:1]

    def menu(self, position: QPointF, place: QPoint) -> None:
        """Ask for the menu on what lies under the pointer, which is selected where nothing of it is yet."""
        under = self.under(position)
        if under:
            chain = self.pointed.chain(under[0][1])
            if not set(chain) & set(self._session.selection):
                self._session.select(chain[:1])
        entries: list[tuple[str, Path, str]] = []
        for owner, pick in under:
            path = self.pointed.path(pick)
            if path is not None:
                entries.append((owner, path, self.pointed.entry(pick)))
        self.menu_asked.emit(entries, place)
