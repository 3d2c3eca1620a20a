"""Windows beside the main one: each made when it is first asked for, ended with the main one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, cast

if TYPE_CHECKING:
    from .window import MainWindow


class SideWindow(Protocol):
    def end(self) -> None:
        """Let go of the session and close: the main window goes."""


S = TypeVar("S", bound=SideWindow)


class SideWindows:
    """One of each kind for a main window."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self._open: dict[Any, SideWindow] = {}

    def of(self, kind: Callable[[MainWindow], S]) -> S:
        """The window of this class, which is made with the main window as its only argument."""
        if kind not in self._open:
            self._open[kind] = kind(self._window)
        return cast(S, self._open[kind])

    def end(self) -> None:
        while self._open:
            self._open.popitem()[1].end()
