"""What the Motion panel does to the document: steps of the history, each of which can be undone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from ...model.document.errors import Refusal
from ...model.document.tree import unique_name
from ..panels.property_edit import sentence

if TYPE_CHECKING:
    from ..window import MainWindow
    from .panel import MotionPanel


class MotionEdits(QObject):
    """Of the motion that is chosen in the panel. `refused` carries why something was not done, "" where it was."""

    refused = Signal(str)

    def __init__(self, window: MainWindow, panel: MotionPanel) -> None:
        super().__init__(panel)
        self._session, self._panel = window.session, panel

    def add(self) -> None:
        """A motion of the first parameter that may go, or of one that is made for it."""
        document = self._session.document
        name = unique_name("Motion", [one.name for one in document.motions])
        values: dict[str, Any] = {}
        parameter = "t"
        for one in document.parameters:
            if isinstance(one.value, float) and not one.choices:
                start = one.value if one.minimum is None else one.minimum
                end = start + 1.0 if one.maximum is None else one.maximum
                parameter, values = one.name, {"start": start, "end": end}
                break
        if self._do("add_motion", name, parameter, label="Add motion", **values):
            self._panel.choose(name)

    def rename(self, name: str) -> None:
        motion = self._panel.motion
        names = [one.name for one in self._session.document.motions]
        if motion is None or not name or name in names:
            return
        self._panel.name = name  # before the step, so that it stays the one that is shown
        if not self._do("rename_motion", motion.name, name, label="Rename motion"):
            self._panel.name = motion.name

    def delete(self) -> None:
        motion = self._panel.motion
        if motion is not None:
            self._do("delete_motion", motion.name, label="Delete motion")

    def set_value(self, field: str, value: object) -> None:
        """Give the motion another `parameter`, `start`, `end`, `seconds` or number of `steps`."""
        motion = self._panel.motion
        if motion is None:
            return
        if field == "steps":
            try:
                value = round(float(str(value)))
            except (ValueError, OverflowError):
                self.refused.emit(f"A motion has a whole number of steps, not “{value}”")
                self._panel.fill()
                return
        self._do("set_motion", motion.name, label=f"Set {field} of motion", **{field: value})

    def set_in_motion(self, by: tuple[Any, ...], axis: str, degrees: object) -> None:
        """Let the selected nodes go, in a motion that is made where there is none."""
        motion, session = self._panel.motion, self._session
        name = "Motion" if motion is None else motion.name
        more = {"turn": (axis, degrees)} if degrees else {}
        self._do(
            "set_in_motion", list(session.selection), name, by, label="Set in motion", select=session.selection, **more
        )

    def _do(self, name: str, *arguments: Any, **more: Any) -> bool:
        self._panel.rest()
        try:
            self._session.do(name, *arguments, **more)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            self._panel.fill()
            return False
        self.refused.emit("")
        return True
