"""Which tree the BSP panel shows: that of the picture, or one that the textbook's builder makes of the same faces."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

if TYPE_CHECKING:
    from ...model.document.errors import Refusal
    from ...model.partition.report import Report
    from ...model.partition.tree import Tree
    from ..window import MainWindow

GOOD, TEXTBOOK = "good", "textbook"
REST = 120  # milliseconds without a change before a tree is looked at

MOST_AT_ONCE = 150_000  # fragments of a tree that is counted while the window waits


class TreeSource(QObject):
    """`changed` tells of another tree, or of another reason why there is none (`words`)."""

    changed = Signal()
    outdated = Signal()
    """The picture is another one, and `tree` is no longer that of what it shows; `changed` follows."""

    def __init__(self, window: MainWindow, parent: QObject) -> None:
        super().__init__(parent)
        self._window = window
        self._hidden = window.hidden_surfaces
        self.builder = GOOD
        self.tree: Tree | None = None
        self.solid_ids: tuple[str, ...] = ()
        self.report: Report | None = None
        self.words = ""
        self._active = False
        self._textbook: tuple[Tree, Tree, Report] | None = None
        """The picture's tree, the textbook's of the same faces, and its report."""
        self._building: Tree | None = None
        self._followed: Tree | None = None
        """The picture's tree when it was last looked at."""
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(REST)
        self._soon.timeout.connect(self._follow)
        self._hidden.changed.connect(self._later)

    @property
    def off(self) -> bool:
        """Whether the picture is drawn with the z-buffer, so that there is no tree to show."""
        return self._hidden.mode != "bsp"

    @property
    def settled(self) -> bool:
        """Whether what is shown is the last word on the present picture."""
        return not self._soon.isActive() and self._building is None and not self._hidden.sorting

    def set_active(self, active: bool) -> None:
        """Whether somebody looks. At rest it does no work, and the picture has its own tree."""
        if active != self._active:
            self._active = active
            if active:
                self._follow()
            else:
                self._soon.stop()
                self._give_back()
                self._set(None, (), None, "")

    def set_builder(self, builder: str) -> None:
        if builder != self.builder:
            self.builder = builder
            if self._active:
                self._give_back()
                self._follow()

    def _later(self) -> None:
        if self._active:
            if self._hidden.tree is not self._followed and self.report is not None:
                self.report = None
                self.outdated.emit()
            self._soon.start()

    def _follow(self) -> None:
        if not self._active:
            return
        if self._window.session.previewing:
            self._soon.start()
            return
        tree, solid_ids = self._hidden.tree, self._hidden.solid_ids
        self._followed = tree
        if tree is None:
            _, why = self._hidden.words
            self._set(None, (), None, why)
        elif self.builder == TEXTBOOK:
            self._follow_textbook(tree, solid_ids)
        elif tree is not self.tree or self.report is None:
            self._follow_good(tree, solid_ids)

    def _follow_good(self, tree: Tree, solid_ids: tuple[str, ...]) -> None:
        from ...model.partition.native import available
        from ...model.partition.report import report

        seconds = self._hidden.build_seconds
        seconds = float("nan") if seconds is None else seconds
        name = "compiled" if available() else "numpy"
        if len(tree.source) <= MOST_AT_ONCE:
            self._set(tree, solid_ids, report(tree, name, seconds), "")
            return

        def counted(found: Report) -> None:
            self._building = None
            if self._hidden.tree is tree and self._active and self.builder == GOOD:
                self._set(tree, solid_ids, found, "")
            else:
                self._follow()

        self._set(None, (), None, "The tree is being counted …")
        if self._building is None:
            self._building = tree
            self._window.files.background.run(
                "Counting the BSP tree", lambda: report(tree, name, seconds), counted, self._failed
            )

    def _follow_textbook(self, tree: Tree, solid_ids: tuple[str, ...]) -> None:
        from ...model.partition.report import builder_fault, built

        fault = builder_fault(TEXTBOOK, tree.faces.count)
        if fault:
            self._set(None, (), None, fault[0].upper() + fault[1:] + ".")
            return
        if self._textbook is not None and self._textbook[0] is tree:
            _, other, report = self._textbook
            self._window.viewport.change(lambda viewer: viewer.show_tree(other, solid_ids))
            self._set(other, solid_ids, report, "")
            return
        self._set(None, (), None, "The textbook's builder is at work …")
        if self._building is None:
            self._building = tree
            faces = tree.faces
            self._window.files.background.run(
                "Building the textbook's tree", lambda: built(faces, TEXTBOOK), self._built, self._failed
            )

    def _built(self, result: tuple[Tree, Report]) -> None:
        tree, self._building = self._building, None
        if tree is not None:
            self._textbook = (tree, *result)
        self._follow()

    def _failed(self, refusal: Refusal) -> None:
        tree, self._building = self._building, None
        if self._active and self.builder == TEXTBOOK and self._hidden.tree is tree:
            words = str(refusal)
            self._set(None, (), None, f"{words[0].upper()}{words[1:]}.")
        else:
            self._follow()

    def _give_back(self) -> None:
        """Let the picture have its own tree again."""
        if self.tree is not None and self.tree is not self._hidden.tree:
            tree, solid_ids = self._hidden.tree, self._hidden.solid_ids
            self._window.viewport.change(lambda viewer: viewer.show_tree(tree, solid_ids))

    def _set(self, tree: Tree | None, solid_ids: tuple[str, ...], report: Report | None, words: str) -> None:
        if (tree, solid_ids, words) != (self.tree, self.solid_ids, self.words) or report is not self.report:
            self.tree, self.solid_ids, self.report, self.words = tree, solid_ids, report, words
            self.changed.emit()
