"""The Curve panel: pages of numbers and pictures for the outline that is being edited."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QStackedLayout, QTabWidget, QVBoxLayout, QWidget

from .active import ActiveCurve

NOTHING = "Select an outline, or draw one with the tools of the menu Curve."


class CurvePanel(QWidget):
    """A tab for each page that applies, in the order given; words where there is no outline.

    A page has a method `applies` that tells whether it has something to say about the outline that is being edited.
    `seen` carries the page that is to be seen now, or None.
    """

    seen = Signal(object)

    def __init__(self, active: ActiveCurve, pages: Mapping[str, QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("curve")
        self._active, self.pages = active, dict(pages)
        self.in_front = False
        self.tabs = QTabWidget(self)
        self.tabs.setDocumentMode(True)
        for title, page in pages.items():
            self.tabs.addTab(page, title)
        self.words = QLabel(NOTHING, self)
        self.words.setProperty("muted", True)
        self.words.setWordWrap(True)
        self.words.setContentsMargins(12, 12, 12, 12)
        self._stack = QStackedLayout(self)
        empty = QWidget(self)
        layout = QVBoxLayout(empty)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.words)
        layout.addStretch(1)
        self._stack.addWidget(empty)
        self._stack.addWidget(self.tabs)
        active.changed.connect(self.follow)
        self.tabs.currentChanged.connect(self._tell)
        self._told: QWidget | None = None
        self.follow()

    def set_in_front(self, front: bool) -> None:
        """Whether its own tab among the panels is the one that is open."""
        self.in_front = front
        self._tell()

    def _tell(self) -> None:
        there = self.in_front and self._active.path is not None
        page = self.tabs.currentWidget() if there else None
        if page is not self._told:
            self._told = page
            self.seen.emit(page)

    def follow(self) -> None:
        """Show the tabs that apply."""
        there = self._active.path is not None
        for number, page in enumerate(self.pages.values()):
            applies = there and page.applies()  # type: ignore[attr-defined]
            if self.tabs.isTabVisible(number) != applies:
                self.tabs.setTabVisible(number, applies)
        fault = self._active.fault
        self.words.setText(f"This outline cannot be edited. {fault}" if fault else NOTHING)
        self._stack.setCurrentIndex(int(there))
        self._tell()

    def show_page(self, title: str) -> None:
        """Bring a page to the front, where it applies."""
        number = list(self.pages).index(title)
        if self.tabs.isTabVisible(number):
            self.tabs.setCurrentIndex(number)
