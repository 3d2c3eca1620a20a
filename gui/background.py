"""Work that may take long and needs no process of its own, such as reading a file: in one thread, answers queued."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from ..model.document.errors import Refusal


class Background(QObject):
    """Runs functions one after another. `busy` tells words on what is going on, "" when nothing is."""

    busy = Signal(str)
    _finished = Signal(object, object, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pool: ThreadPoolExecutor | None = None
        self._open = 0
        self._finished.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    @property
    def working(self) -> bool:
        return self._open > 0

    def run(
        self, words: str, work: Callable[[], Any], done: Callable[[Any], None], refused: Callable[[Refusal], None]
    ) -> None:
        """Do `work` in the thread; `done` with its result or `refused` with its Refusal follow in this one."""
        if self._pool is None:
            self._pool = ThreadPoolExecutor(1, "solidtree files")
        self._open += 1
        self.busy.emit(words)

        def job() -> None:
            try:
                result: Any = work()
            except BaseException as error:
                self._finished.emit(done, refused, error)
            else:
                self._finished.emit(done, refused, (result,))

        self._pool.submit(job)

    def close(self) -> None:
        """Wait for what is under way; its answers, and what has not begun, are dropped."""
        self._finished.disconnect()
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)

    def _deliver(self, done: Callable[[Any], None], refused: Callable[[Refusal], None], outcome: Any) -> None:
        self._open -= 1
        if not self._open:
            self.busy.emit("")
        if isinstance(outcome, Refusal):
            refused(outcome)
        elif isinstance(outcome, BaseException):
            raise outcome
        else:
            done(outcome[0])
