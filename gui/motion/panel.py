"""The Motion panel: motions of the document, played in the picture. Nothing of it is made before it is looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ..panels.property_edit import sentence
from ..status import figure
from .motion_edits import MotionEdits
from .player import Player

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.editing.session import State
    from ...model.proximity.motion import Motion
    from ...model.proximity.moving.playing import Played
    from ..window import MainWindow
    from .motion_picture import MotionPicture
    from .page import MotionPage

SOON = 300  # milliseconds of rest after which a changed document is looked at again


class MotionPanel(QWidget):
    """`refused` carries why something was not done. The document stays as it is, whatever is played."""

    refused = Signal(str)
    listed = Signal()
    """Whether there is something to play may have changed."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("motion")
        self._window = window
        self.in_front = False
        self.page: MotionPage | None = None
        self.picture: MotionPicture | None = None
        self.player = Player(self)
        self.edits = MotionEdits(window, self)
        self.edits.refused.connect(self.refused)
        self.played: Played | None = None
        self.name = ""
        self._of: tuple[Document, str, bool] | None = None
        """What was asked or played: document, motion, and whether between the steps."""
        self._own = False
        """Whether a preview that begins or ends is the motion's."""
        self._previewed = False
        """Whether the motion's preview is there."""
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(SOON)
        self._soon.timeout.connect(self._look)
        self.player.moved.connect(self._show)
        self.player.changed.connect(self._show_state)
        jobs = window.evaluation.jobs
        jobs.played.connect(self._take)
        jobs.playing_progress.connect(self._progress)

    # What happens.

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        if seen == self.in_front:
            return
        self.in_front = seen
        if seen:
            self._make()
            self.fill()
            self._look()
        else:
            self._soon.stop()
            self._window.evaluation.jobs.stop_playing()
            self.rest()
            if self.played is None:
                self._of = None
            if self.page is not None:
                self.page.show_work("")

    def session_changed(self, before: State, after: State) -> None:
        session = self._window.session
        if before.selection != after.selection and self.page is not None:
            self.page.form.show_selection(len(after.selection))
        if self._own:
            return
        foreign = before.document is not after.document and (session.previewing or self._previewed)
        if foreign and self.picture is not None and self.picture.away:
            self._give_way()
        elif self._previewed and before.selection != after.selection:
            self.rest()  # what is selected is to be worked on: as the document has it
            return
        if session.previewing:
            return
        if self._of is not None and session.document is not self._of[0]:
            self.rest()
            self.played, self._of = None, None
        if self.in_front and before.document is not after.document:
            self.fill()
            self._soon.start()

    def document_opened(self) -> None:
        self._window.evaluation.jobs.stop_playing()
        self.rest()
        self.played, self._of, self.name = None, None, ""
        if self.in_front:
            self.fill()
            self._soon.start()

    @property
    def motion(self) -> Motion | None:
        """The one that is chosen."""
        motions = self._window.session.document.motions
        return next((one for one in motions if one.name == self.name), motions[0] if motions else None)

    # The page.

    def _make(self) -> None:
        if self.page is not None:
            return
        from .motion_picture import MotionPicture
        from .page import MotionPage

        self.picture = MotionPicture(self._window, self)
        self.page = page = MotionPage(self)
        form, bar = page.form, page.bar
        form.chosen.connect(self.choose)
        form.added.connect(self.edits.add)
        form.renamed.connect(self.edits.rename)
        form.deleted.connect(self.edits.delete)
        form.set_asked.connect(self.edits.set_value)
        form.moving_asked.connect(self.edits.set_in_motion)
        form.show_selection(len(self._window.session.selection))
        bar.stepped.connect(self.go)
        bar.toggled.connect(self.toggle)
        bar.jumped.connect(self.jump)
        bar.looped.connect(self._set_looping)
        page.table.chosen.connect(lambda _: self._show(self.player.share))
        page.table.zoomed.connect(self.picture.fly)
        page.cancel_asked.connect(self._cancel)
        page.first_asked.connect(self._go_first)
        form.between.toggled.connect(self._look)
        self.picture.left.connect(self._leave)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(page)

    def fill(self) -> None:
        """Show what the document has."""
        page, motion = self.page, self.motion
        if page is None:
            return
        document = self._window.session.document
        self.name = "" if motion is None else motion.name
        page.form.show_motion(document, motion)
        page.show_there(motion is not None)
        if motion is not None:
            self.player.seconds = motion.seconds
            page.bar.set_steps(motion.steps)
            self._show_time(motion, round(self.player.share * motion.steps))
        self._tell()
        self._show_state()
        self.listed.emit()

    def _show_time(self, motion: Motion, step: int) -> None:
        if self.page is not None:
            share = self.player.share
            value = figure(motion.value(share), 4)
            self.page.bar.show_step(step)
            self.page.time.setText(f"{share * motion.seconds:.2f} s, {motion.parameter} = {value}")

    def _tell(self) -> None:
        """What meets first."""
        page, played = self.page, self.played
        if page is None:
            return
        if played is None:
            page.say("" if self._of is not None else "Contacts are not looked for yet.")
            return
        first = played.first
        failed = [message for message in played.messages if message.error]
        if first is not None:
            place = f"“{played.names[first.one]}” meets “{played.names[first.other]}”"
            page.say(f"First contact at t = {first.time:.2f} s: {place}", True)
        elif failed:
            page.say(f"“{failed[0].name}” {failed[0].message}: nothing is known of its contacts")
        elif not played.moving.any():
            page.say(f"Nothing moves: no visible solid depends on {played.motion.parameter}")
        else:
            listed = sum(map(bool, played.touches))
            page.say(f"Nothing new meets; {listed} steps have contacts" if listed else "Nothing meets in any step")

    def _show_state(self) -> None:
        if self.page is not None:
            contacts = self.played is not None and any(self.played.touches)
            self.page.bar.show_state(self.player.playing, contacts)

    # Looking at it.

    def _look(self) -> None:
        """Ask for the motion's steps and contacts, unless they are known."""
        page, motion, session = self.page, self.motion, self._window.session
        if page is None or motion is None or not self.in_front:
            return
        if session.previewing:
            self._soon.start()
            return
        asked = (session.document, motion.name, page.form.between.isChecked())
        if self._of is not None and self._of[0] is asked[0] and self._of[1:] == asked[1:]:
            return
        self.played, self._of = None, asked
        self._window.evaluation.jobs.play(asked[0], motion.name, self._window.evaluation.tolerance, asked[2])
        page.show_work("Moving the parts")
        self._tell()

    def _progress(self, done: int, total: int, label: str) -> None:
        if self.page is not None and self._window.evaluation.jobs.playing:
            self.page.show_work(label, done, total)

    def _take(self, played: Played | None, fault: str) -> None:
        if self.page is None:
            return
        self.page.show_work("")
        if played is None:
            self.page.say(sentence(fault))
            return
        self.played = played
        self._tell()
        self._show_state()
        if self.picture is not None and (self.player.playing or self.picture.away):
            self._show(self.player.share)
        self.listed.emit()

    def _cancel(self) -> None:
        self._window.evaluation.jobs.stop_playing()
        if self.page is not None:
            self.page.show_work("")
            self.page.say("Contacts were not looked for: it was cancelled")

    # Playing.

    def toggle(self) -> None:
        """Play or pause."""
        if self.player.playing:
            self.player.pause()
        elif self.played is not None:
            if self.page is not None:
                self.page.table.leave()
            self.player.play()

    def go(self, step: int) -> None:
        """Show a step."""
        motion = self.motion
        if motion is not None:
            self.player.pause()
            self.player.go(step / motion.steps)

    def jump(self, way: int) -> None:
        """To the next step (1) or the one before (-1) in which the contacts are others, and there are some."""
        played = self.played
        if played is None or self.page is None:
            return
        pairs = [{(touch.one, touch.other) for touch in listed} for listed in played.touches]
        step = self.page.bar.step + way
        while 0 <= step < len(pairs):
            if pairs[step] and (step == 0 or pairs[step] - pairs[step - 1]):
                self.page.bar.go(step)
                return
            step += way
        self.refused.emit("There is no further contact that way")

    def _go_first(self) -> None:
        played = self.played
        if played is not None and played.first is not None:
            self.player.pause()
            self.player.go(played.first.time / played.motion.seconds)

    def _set_looping(self, looping: bool) -> None:
        self.player.looping = looping

    def _show(self, share: float) -> None:
        """The picture, the bar and the list at a share of the time."""
        page, motion, played = self.page, self.motion, self.played
        if page is None or motion is None or not self.in_front:
            return
        step = int(share * motion.steps + 1e-9)
        self._show_time(motion, step)
        if played is None or self.picture is None:
            return
        listed = played.listed(share)
        page.table.show_touches(played, listed)
        if played.recut.any():
            self._preview(share)
        self.picture.show(played, share, listed, page.table.current)

    def _preview(self, share: float) -> None:
        """Parts that change their shape are cut anew, as in a drag."""
        from ...model.proximity.moving.parts import document_at

        if self._of is not None and self.motion is not None:
            self._own = True
            try:
                self._window.session.preview(document_at(self._of[0], self.motion, share))
                self._previewed = True
            except Refusal as refusal:
                self.player.pause()
                self.refused.emit(sentence(refusal))
            finally:
                self._own = False

    def rest(self) -> None:
        """Stop, and show everything where the document has it."""
        previewed = self._previewed
        self._give_way()
        if previewed and self._window.session.previewing:
            self._own = True
            try:
                self._window.session.cancel()
            finally:
                self._own = False

    def _give_way(self) -> None:
        """Take the motion out of the picture: somebody else shows something, or nobody looks any more."""
        self.player.pause()
        self._previewed = False
        if self.picture is not None and self.picture.away:
            self.picture.rest()
        if self.page is not None:
            self.page.table.blockSignals(True)  # it would show the moment again
            self.page.table.leave()
            self.page.table.blockSignals(False)

    def _leave(self) -> None:
        """Choose no contact; without one, end the motion."""
        if self.page is not None and self.page.table.current is not None:
            self.page.table.leave()
        else:
            self.rest()

    def choose(self, name: str) -> None:
        """Play another motion."""
        if name != self.name:
            self.rest()
            self.player.share = 0.0
            self.name = name
            self.fill()
            self._look()
