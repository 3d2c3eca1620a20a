"""What keys mean while an outline is edited: they go to its chosen nodes before they go anywhere else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from . import node_edits

if TYPE_CHECKING:
    from ..active import ActiveCurve
    from .edit_picture import EditPicture

SHIFT, CONTROL, ALT = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
)
ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, 1.0),
    Qt.Key.Key_Down: (0.0, -1.0),
}
DELETE = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)
TAB = (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)


class EditKeys:
    """Arrows move by 1 mm (Shift 10, Alt 0.1), Delete takes out (Ctrl without a new fit), Tab goes on, Ctrl+A chooses
    all, Escape none."""

    def __init__(self, active: ActiveCurve) -> None:
        self._active = active

    def takes(self, event: QKeyEvent) -> bool:
        """Whether `press` would do something with it."""
        key, held = event.key(), event.modifiers() & (SHIFT | CONTROL | ALT)
        if key in TAB:
            return not held & (CONTROL | ALT)
        if key == Qt.Key.Key_A:
            return held == CONTROL
        if not self._active.chosen:
            return False
        if key in DELETE:
            return held in (Qt.KeyboardModifier.NoModifier, CONTROL)
        return (key in ARROWS and held in (Qt.KeyboardModifier.NoModifier, SHIFT, ALT)) or key == Qt.Key.Key_Escape

    def press(self, event: QKeyEvent, picture: EditPicture) -> bool:
        if not self.takes(event):
            return False
        active, key, held = self._active, Qt.Key(event.key()), event.modifiers()
        if key in TAB:
            node_edits.beside(active, key == Qt.Key.Key_Tab and not held & SHIFT)
        elif key == Qt.Key.Key_A:
            active.choose(active.rows)
        elif key in DELETE:
            node_edits.delete(active, not held & CONTROL)
        elif key == Qt.Key.Key_Escape:
            active.choose(())
        else:
            length = 10.0 if held & SHIFT else 0.1 if held & ALT else 1.0
            node_edits.move(active, picture.along(ARROWS[key], length))
        return True
